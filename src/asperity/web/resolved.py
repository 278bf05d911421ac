"""Constants of a material as the document resolves them: what its body will really use, where each
value comes from, and what the library says beside."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..core.errors import AsperityError
from ..core.settings import declared
from ..core.units import show
from ..core.words import label_of
from ..io.schemas.bodies import BESIDE, CONSTANTS, MaterialTable, base_from_text, body_from_text
from ..run.build import build_material
from ..run.document import validated
from ..solids.elastic import Elastic
from ..solids.library import MaterialRecord, materials

SHOWN = {"youngs_modulus": "E", "poisson_ratio": "ν", "hardness": "H", "yield_stress": "Y"}
"""Constants that every row shows, with their symbols."""

TYPED = "typed here"
"""Source of a value that the document states itself."""

FOLLOWS = "follows from the hardness, at which the hardening begins"
"""Source of a yield stress that is not given."""


@dataclass(frozen=True)
class Value:
    """One constant of a material.

    Attributes
    ----------
    key, label
        Key in the table of the material, and what it is called.
    text
        The value with its unit; empty where it is not known.
    source
        Where it comes from; empty where that is not said.
    own, assumed, relaxes
        Whether the document states it itself, the library assumes it, or it falls with time.
    library
        The value of the library that the document replaces by its own; empty without one.
    """

    key: str
    label: str
    text: str = ""
    source: str = ""
    own: bool = False
    assumed: bool = False
    relaxes: bool = False
    library: str = ""


@dataclass(frozen=True)
class Resolved:
    """A material as the document resolves it.

    Attributes
    ----------
    name
        What the drawing calls it; empty where no material has been chosen.
    values
        Its constants by key, those of a row first.
    note
        Condition or caveat of the library.
    record
        What the library knows of it; None for own constants.
    """

    name: str
    values: Mapping[str, Value]
    note: str = ""
    record: MaterialRecord | None = None

    @property
    def identity(self) -> str:
        """Name and elastic constants, by which drawings colour it."""
        return " ".join((self.name, *(self.values[key].text for key in CONSTANTS)))

    @property
    def known(self) -> bool:
        """Whether its elastic constants are known."""
        return all(self.values[key].text for key in CONSTANTS)


@dataclass(frozen=True)
class Materials:
    """Materials of one page, each resolved once; relative paths start at ``folder``."""

    folder: Path
    found: dict[tuple[str, str | None], Resolved] = field(default_factory=dict)
    lists: dict[str | None, tuple[str, ...]] = field(default_factory=dict)

    def names(self, library: str | None) -> tuple[str, ...]:
        """Names of the library, with those of the own file ``library`` if it can be read."""
        if library not in self.lists:
            try:
                self.lists[library] = tuple(record.name for record in materials(library))
            except AsperityError:
                self.lists[library] = tuple(record.name for record in materials())
        return self.lists[library]

    def of(self, part: Any, library: str | None) -> Resolved:
        """The material of the table ``part`` of a draft, which may be incomplete, with the own
        materials in the file ``library``."""
        table = {key: part[key] for key in MaterialTable.model_fields if part.get(key) is not None} if part else {}
        asked = (json.dumps(table, sort_keys=True, default=str), library)
        if asked not in self.found:
            self.found[asked] = resolved(table, library, self.folder)
        return self.found[asked]


def resolved(part: Mapping[str, Any], library: str | None, folder: Path) -> Resolved:
    """The material of the table ``part``, as of ``Materials``."""
    record = record_of(part, library)
    made = _built(part, library, folder)
    named = part.get("name") or (part.get("material") if record is None else record.name)
    name = str(named or ("viscoelastic" if part.get("relaxation") else "own material" if is_own(part) else ""))
    values = {key: _value(key, part, record, made) for key in (*SHOWN, *(key for key in BESIDE if key not in SHOWN))}
    return Resolved(name, values, record.note if record else "", record)


def is_own(part: Mapping[str, Any]) -> bool:
    """Whether the table of a material is one of own constants."""
    return not part.get("material") and not part.get("rigid") and bool({*CONSTANTS, "relaxation", "name"} & part.keys())


def record_of(part: Mapping[str, Any], library: str | None) -> MaterialRecord | None:
    """What the library knows of the material that the table ``part`` names; None for no such
    material."""
    try:
        return MaterialRecord.find(str(part["material"]), library) if part.get("material") else None
    except AsperityError:
        return None


def _built(part: Mapping[str, Any], library: str | None, folder: Path) -> Elastic | None:
    """The material that the body will have; None while its table is incomplete or wrong."""
    table = {key: value for key, value in part.items() if key in MaterialTable.model_fields}
    try:
        own = None if library is None else folder / library
        return build_material(validated(MaterialTable, table, "material"), own, folder)
    except AsperityError:
        return None


def _value(key: str, part: Mapping[str, Any], record: MaterialRecord | None, made: Elastic | None) -> Value:
    own = part.get(key) is not None
    relaxes = key == "youngs_modulus" and bool(part.get("relaxation") or (record is not None and record.relaxation))
    known = None if record is None else record.values.get(key)
    number: float | None = _of(made, key) if made is not None else None
    if number is None and own:
        number = _read(key, part[key])
    if number is None and known is not None and not own:
        number = known.value
    given = own or (relaxes and record is None)
    follows = FOLLOWS if number and key == "yield_stress" else ""
    return Value(
        key,
        label_of(key),
        "" if number is None else shown(key, number),
        TYPED if given else known.source if known is not None else follows,
        own=given,
        assumed=not own and known is not None and known.assumed,
        relaxes=relaxes,
        library=shown(key, known.value) if own and known is not None else "",
    )


def _of(made: Elastic, key: str) -> float | None:
    """Value ``key`` of a material; None where it is not known or no number."""
    holder = next((one for one in (made, made.strength, made.conduction) if hasattr(one, key)), None)
    number = getattr(holder, key, None)
    return float(number) if isinstance(number, int | float) and not math.isnan(number) else None


def _read(key: str, text: Any) -> float | None:
    """The number that ``text`` is at the ``key`` of a material; None if it is none."""
    try:
        found = declared(key, MaterialTable.model_fields[key]).values.read(text, key)
        return float(found)
    except (AsperityError, TypeError, ValueError):
        return None


def shown(key: str, number: float, digits: int = 4) -> str:
    """``number`` at the ``key`` of a material with its unit."""
    values = declared(key, MaterialTable.model_fields[key]).values
    unit = str(getattr(values, "unit", "") or "")
    return show(number, unit, digits) if number or not unit else f"0 {unit}"


# Bodies as tables, whichever way they were written.


def as_tables(body: Any) -> Any:
    """The ``body`` of a draft with tables in place of the texts that stand for them; text that
    cannot be read stands for the name of a material."""
    if isinstance(body, str):
        body = _table(body, body_from_text)
    if not isinstance(body, Mapping):
        return body
    made = dict(body)
    if isinstance(made.get("base"), str):
        made["base"] = _table(made["base"], base_from_text)
    if isinstance(made.get("layers"), list | tuple):
        made["layers"] = [_layer(layer) for layer in made["layers"]]
    return made


def _layer(layer: Any) -> Any:
    if not isinstance(layer, Mapping):
        return layer
    ends = {key: _table(layer[key], base_from_text) for key in ("top", "bottom") if isinstance(layer.get(key), str)}
    return {**layer, **ends}


def _table(text: str, read: Callable[[str], dict[str, Any]]) -> dict[str, Any]:
    try:
        return read(text)
    except AsperityError:
        return {"material": text}
