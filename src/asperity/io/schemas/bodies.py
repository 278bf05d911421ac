"""Bodies of a problem document: rigid, one material, or layers on a base; as tables or in one line of text.

DLC                               a material of the library
E=140GPa,nu=0.25,H=15GPa          elastic constants: E, nu, and if known hardness H, yield stress Y, name
DLC:5nm/Cr:2nm/steel              5 nm of DLC on 2 nm of Cr on steel
DLC:5nm~/rigid                    ~ : the layer slips without friction on what lies below it
E=3MPa+10MPa@10ms,nu=0.5          10 MPa of Young's modulus relax in 10 ms; further ways in ``relaxation``
"""

from __future__ import annotations

from types import MappingProxyType
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BeforeValidator, ConfigDict, Field, model_validator

from ...core.errors import InputError
from ...core.settings import Settings, setting
from ...core.values import Count, Length, NonEmpty, NonNegativeLength, PoissonRatio, Positive, Pressure
from .relaxation import SYMBOLS as RELAXING
from .relaxation import RelaxationTable, relaxation_from_symbols, relaxes

CONSTANTS = ("youngs_modulus", "poisson_ratio")
"""Keys of the elastic constants, which go together."""

BESIDE = ("hardness", "yield_stress")
"""Keys that elastic constants may bring along; a named material has its own."""


def _text_too(schema: dict[str, Any]) -> None:
    """Let the JSON ``schema`` of a table accept text, which stands for the table."""
    table = dict(schema)
    schema.clear()
    schema.update({"title": table["title"], "anyOf": [{"type": "string"}, table]})


class MaterialTable(Settings):
    """One material: a name of the library, or elastic constants with what is known of the strength; ``relaxation`` instead of Young's modulus.

    It may be text, such as ``"steel"``, ``"E=140GPa,nu=0.25"`` or ``"E=3MPa+10MPa@10ms,nu=0.5"``.
    """

    model_config = ConfigDict(json_schema_extra=_text_too)

    material: NonEmpty | None = None
    youngs_modulus: Pressure | None = None
    poisson_ratio: PoissonRatio | None = None
    relaxation: RelaxationTable | None = setting(None, help="how a viscoelastic material relaxes")
    hardness: Pressure | None = None
    yield_stress: Pressure | None = None
    name: NonEmpty | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_text(cls, value: Any) -> Any:
        return material_from_text(value) if isinstance(value, str) else value

    @model_validator(mode="after")
    def _check(self) -> MaterialTable:
        self._one_of({})
        return self

    def _one_of(self, others: dict[str, bool]) -> None:
        """Refuse all but one way to describe it: a material, constants, or one of the ``others`` that are given."""
        pair = CONSTANTS if self.relaxation is None else ("relaxation", "poisson_ratio")
        constants = [key for key in pair if getattr(self, key) is not None]
        ways = [*(way for way, given in others.items() if given), *(["material"] if self.material else [])]
        ways += constants[:1]
        ways += ["youngs_modulus"] if self.relaxation is not None and self.youngs_modulus is not None else []
        if len(ways) != 1:
            choices = ", or ".join(["a material", "youngs_modulus (or relaxation) and poisson_ratio", *others])
            raise InputError(f" must give {choices}, but gives {' and '.join(ways) or 'none of these'}.")
        if len(constants) == 1:
            raise InputError(f" must give {pair[0]} and poisson_ratio together, but gives only {constants[0]}.")
        allowed = (*BESIDE, "name") if constants else ("name",) if "layers" in ways else ()
        beside = [key for key in (*BESIDE, "name") if getattr(self, key) is not None and key not in allowed]
        if beside:
            raise InputError(f" may give {beside[0]} only together with youngs_modulus, but gives it with {ways[0]}.")


class LayerTable(MaterialTable):
    """Homogeneous layer; ``interface`` is how it is joined to what lies below it."""

    model_config = ConfigDict(json_schema_extra=None)

    kind: Literal["layer"] = "layer"
    thickness: NonNegativeLength
    interface: Literal["bonded", "frictionless"] = "bonded"


class GradedTable(Settings):
    """Coating whose Young's modulus changes from that of ``top`` to that of ``bottom``, as thin homogeneous layers.

    ``kind`` is the law of its change with depth: ``"linear"``, ``"exponential"``, or ``"power"`` with its ``exponent``.
    """

    kind: Literal["linear", "exponential", "power"]
    top: MaterialTable
    bottom: MaterialTable
    thickness: Length
    exponent: Positive | None = None
    sublayers: Count = 32
    interface: Literal["bonded", "frictionless"] = "bonded"

    @model_validator(mode="after")
    def _exponent(self) -> GradedTable:
        if self.kind == "power" and self.exponent is None:
            raise InputError(".exponent must be given for a graded layer of kind power, but is missing.")
        if self.kind != "power" and self.exponent is not None:
            raise InputError(f".exponent must be left out for a graded layer of kind {self.kind}, but is given.")
        return self


def _layers(value: object) -> object:
    """Layers as a tuple, each with its kind: a table without one is a homogeneous layer."""
    if not isinstance(value, list | tuple):
        return value
    return tuple({"kind": "layer"} | layer if isinstance(layer, dict) else layer for layer in value)


AnyLayer: TypeAlias = Annotated[LayerTable | GradedTable, Field(discriminator="kind")]
"""One layer or graded coating, identified by the key ``kind``."""


class BaseTable(MaterialTable):
    """What lies under all layers: a material, or ``rigid = true``."""

    rigid: bool = False

    @model_validator(mode="before")
    @classmethod
    def _from_text(cls, value: Any) -> Any:
        return base_from_text(value) if isinstance(value, str) else value

    @model_validator(mode="after")
    def _check(self) -> BaseTable:
        self._one_of({"rigid = true": self.rigid})
        return self


class BodyTable(BaseTable):
    """One body: a named ``material``, elastic constants, ``rigid = true``, or ``layers`` from the surface down on a ``base``.

    In a document it may be text as on the command line, such as ``"DLC:5nm/Cr:2nm/steel"``. ``materials_file`` holds
    the named materials of all its parts; a relative path starts at the folder of the document.
    """

    materials_file: NonEmpty | None = setting(None, help="your own materials, a TOML file")
    layers: Annotated[tuple[AnyLayer, ...], BeforeValidator(_layers)] = ()
    base: BaseTable | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_text(cls, value: Any) -> Any:
        return body_from_text(value) if isinstance(value, str) else value

    @model_validator(mode="after")
    def _check(self) -> BodyTable:
        self._one_of({"rigid = true": self.rigid, "layers": "layers" in self.model_fields_set})
        if "layers" in self.model_fields_set and not self.layers:
            raise InputError(".layers must hold at least one layer, but is empty; give the material alone.")
        if self.layers and self.base is None:
            raise InputError('.base must be given together with layers, such as base = { material = "steel" }.')
        if self.base is not None and not self.layers:
            raise InputError(" may give a base only together with layers, but gives it without.")
        if self.materials_file is not None and self.material is None and not self.layers:
            raise InputError(" may give a materials_file only together with a material, but gives it without.")
        return self


SYMBOLS = MappingProxyType(
    {"E": "youngs_modulus", "nu": "poisson_ratio", "H": "hardness", "Y": "yield_stress", "name": "name"}
)
"""Key of the document for each symbol in the text of a material."""

SLIP = "~"
"""Mark behind the thickness of a layer that slips on what lies below."""

EXAMPLE = '"DLC:5nm/Cr:2nm/steel"'


def body_from_text(text: str) -> dict[str, Any]:
    """Table of a body for the ``text``.

    Raises
    ------
    InputError
        If the text is no body; the message lacks the name of the option or key at its beginning.
    """
    if ":" not in text and ("=" in text or "/" not in text):  # a unit such as N/mm**2 may hold a slash
        return base_from_text(text)
    *layers, base = (part.strip() for part in text.split("/"))
    bare = [part for part in layers if part and ":" not in part]
    if ":" in base and bare:
        raise InputError(
            f" must have the base as its last part, but {bare[0]!r}, without thickness, stands before {base!r}; "
            f"write layers from the surface down, such as {EXAMPLE}."
        )
    if ":" in base:
        raise InputError(
            f' must end in the base, without thickness, such as {EXAMPLE} or "DLC:5nm/rigid", but ends in {base!r}.'
        )
    found = [_layer(part, number) for number, part in enumerate(layers, start=1)]
    if not base:
        raise InputError(f" must end in the base, such as {EXAMPLE}, but nothing stands behind the last slash.")
    return {"layers": found, "base": base_from_text(base)}


def _layer(part: str, number: int) -> dict[str, Any]:
    name, _, thickness = (piece.strip() for piece in part.partition(":"))
    if not name:
        found = repr(part) if part else "empty"
        raise InputError(f" must name a material in each part, such as {EXAMPLE}, but layer {number} is {found}.")
    if not thickness.rstrip(SLIP).strip():
        raise InputError(
            f" must give the thickness of every layer, such as {name.rstrip(SLIP)}:5nm, but layer {number} is {part!r}; "
            "only the last part, the base, has none."
        )
    if name.casefold() == "rigid":
        raise InputError(f" must have rigid as its last part only, but layer {number} is {part!r}.")
    slips = thickness.endswith(SLIP)
    if SLIP in name or SLIP in thickness[:-1]:
        raise InputError(
            f" must have {SLIP} behind the thickness of the layer that slips, such as DLC:5nm{SLIP}/steel, "
            f"but layer {number} is {part!r}."
        )
    joined = {"interface": "frictionless"} if slips else {}
    return {**material_from_text(name), "thickness": thickness.rstrip(SLIP).strip(), **joined}


def base_from_text(text: str) -> dict[str, Any]:
    """Table of a body without layers, or of what lies under them; errors as above."""
    return {"rigid": True} if text.strip().casefold() == "rigid" else material_from_text(text)


def material_from_text(text: str) -> dict[str, Any]:
    """Table of a material by its name or its constants; errors as above."""
    if "=" not in text:
        return {"material": text.strip()}
    given = dict(_constant(part) for part in text.split(","))
    relaxing = {"relaxation": relaxation_from_symbols(given)} if relaxes(given) else {}
    plain = {SYMBOLS[symbol]: _number(value) if symbol == "nu" else value for symbol, value in given.items()}
    return {**plain, **relaxing}


def _constant(part: str) -> tuple[str, str]:
    symbol, _, value = (piece.strip() for piece in part.partition("="))
    if symbol not in SYMBOLS and symbol not in RELAXING:
        raise InputError(
            f' must be a material, constants such as "E=140GPa,nu=0.25,H=15GPa" ({", ".join(SYMBOLS)}), viscoelastic ones such as '
            f'"E=3MPa+10MPa@10ms,nu=0.5" ({", ".join(RELAXING)}), or layers such as {EXAMPLE}, but holds {part.strip()!r}.'
        )
    return symbol, value


def _number(text: str) -> float | str:
    """The number, or the ``text`` that is none and that the schema refuses under its key."""
    try:
        return float(text)
    except ValueError:
        return text
