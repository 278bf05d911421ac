"""Scalars of a problem document by dotted path, such as ``control.mean_pressure`` or
``body.layers.0.thickness``, and changes of them."""

from __future__ import annotations

import difflib
import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias, get_args

from pydantic.fields import FieldInfo

from ..core import units
from ..core.arrays import file_digest
from ..core.errors import InputError
from ..core.settings import Settings, declared
from ..core.values import Interval, Lengths, Number, Several, Written, WrittenPair
from ..io.schemas.problem import CONTROLS, NONE, ProblemDocument
from ..run.document import renamed, tidy

Key: TypeAlias = str | int
"""Key of a table, or number of an item of a list."""


@dataclass(frozen=True)
class Place:
    """One scalar of a problem document.

    ``keys`` lead to it from the root; ``quantity`` is the kind of quantity that its text holds,
    None for plain numbers and words; ``whole`` for whole numbers.
    """

    path: str
    keys: tuple[Key, ...]
    quantity: str | None
    whole: bool = False

    @property
    def unit(self) -> str:
        """SI unit of the scalar; "1" for plain numbers and words."""
        if self.quantity in (None, "number"):
            return "1"
        return "m" if self.quantity == "size" else units.DIMENSIONS.get(str(self.quantity), str(self.quantity))

    @property
    def is_load(self) -> bool:
        """Whether it is a load: cases that differ in nothing else share surfaces and operators."""
        return self.keys[0] == "control"

    def number(self, value: object) -> float:
        """SI value of ``value``, text with a unit where the scalar has one.

        Raises
        ------
        InputError
            If it is none.
        """
        if self.quantity is not None and self.quantity != "size":
            if not isinstance(value, str | Written):
                raise InputError(f"{self.path} must be text with a number and a unit, but is {value!r}.")
            return 0.0 if value == NONE else units.parse(value, self.quantity, self.path)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise InputError(f"{self.path} must be a number, but is {value!r}.")
        return float(value)

    def written(self, number: float) -> Any:
        """What a document holds for the SI ``number``."""
        if self.whole or self.keys[-1] == "points":
            return round(number)
        return float(number) if self.quantity is None else f"{float(number)!r} {self.unit}"

    def content(self, value: Any, folder: Path) -> Any:
        """``value`` freed of its wording, for comparison: SI numbers, and digests of files in
        ``folder``."""
        if self.quantity is None:
            return _file_content(self.keys[-1], value, folder)
        return _si(value, self.quantity, self.path)


def quantity(field: FieldInfo) -> str | None:
    """Kind of quantity that the ``field`` of a table holds as text, None for any other."""
    values = declared("", field).values
    values = values.item if isinstance(values, Several) else values
    if isinstance(values, Lengths | Interval):
        return "size" if isinstance(values, Lengths) else "length"
    return values.quantity or None if isinstance(values, Number) else None


def locate(document: ProblemDocument, path: str) -> Place:
    """The scalar of ``document`` at the dotted ``path``.

    Raises
    ------
    InputError
        If there is none; the message names the nearest ones that there are.
    """
    path = renamed().get(path, path)
    known = {place.path: place for place in scalars(document)}
    if path not in known:
        near = difflib.get_close_matches(path, known, n=3, cutoff=0.5)
        near += [other for other in known if other.rpartition(".")[2] == path.rpartition(".")[2] and other not in near]
        hint = f"did you mean {' or '.join(near[:3])}?" if near else f"there are {', '.join(sorted(known)[:12])} …"
        raise InputError(f"path must lead to a scalar of the problem, but {path!r} does not; {hint}")
    return known[path]


def scalars(document: ProblemDocument) -> Iterator[Place]:
    """Every scalar of ``document``, also those that it leaves to their defaults."""
    for key in type(document).model_fields:
        if key not in ("version", "title"):
            yield from _below(getattr(document, key), type(document).model_fields[key], (key,))


def content(document: ProblemDocument, folder: Path) -> dict[str, Any]:
    """Content of ``document`` as nested dictionaries: quantities in SI, files by digest, without
    title and threads."""
    table: dict[str, Any] = _content(document, folder)
    table.pop("title", None)
    table["solver"].pop("threads", None)
    return table


def replaced(table: dict[str, Any], keys: tuple[Key, ...], value: Any) -> dict[str, Any]:
    """``table`` with ``value`` at ``keys``; only the tables on the way are copied. One control
    replaces another."""
    changed: Any = dict(table)
    root, node = changed, changed
    for key in keys[:-1]:
        child = node.get(key, {}) if isinstance(node, dict) else node[key]
        node[key] = list(child) if isinstance(child, list) else dict(child)
        node = node[key]
    if keys[0] == "control" and len(keys) == 2:
        for other in CONTROLS:
            node.pop(other, None)
    node[keys[-1]] = value
    return dict(root)


def problem_table(document: ProblemDocument) -> dict[str, Any]:
    """``document`` as nested dictionaries and lists, as it is checked."""
    return tidy(document.model_dump(mode="json", exclude_none=True))


def _below(value: Any, field: FieldInfo, keys: tuple[Key, ...]) -> Iterator[Place]:
    if isinstance(value, Settings):
        for key in type(value).model_fields:
            yield from _below(getattr(value, key), type(value).model_fields[key], (*keys, key))
        return
    several = value if isinstance(value, tuple) and not isinstance(value, WrittenPair) else None
    parts = list(_kinds(field.annotation))
    tables = value is None and any(isinstance(part, type) and issubclass(part, Settings) for part in parts)
    if keys[-1] == "points" if several is not None else not tables:
        kinds = {part for part in parts if part in (int, float, str, bool)}
        yield Place(".".join(map(str, keys)), keys, quantity(field), keys[-1] != "points" and kinds == {int})
    for number, item in enumerate(several or ()):
        yield from _below(item, field, (*keys, number))


def _kinds(annotation: Any) -> Iterator[Any]:
    parts = get_args(annotation)
    if not parts:
        yield annotation
    for part in parts:
        yield from _kinds(part)


def _content(value: Any, folder: Path) -> Any:
    if isinstance(value, tuple):
        return [_content(item, folder) for item in value]
    if not isinstance(value, Settings):
        return value
    found: dict[str, Any] = {}
    for key, field in type(value).model_fields.items():
        entry = getattr(value, key)
        if entry is None:
            continue
        kind = quantity(field)
        found[key] = _content(entry, folder) if kind is None else _si(entry, kind, key)
        if kind is None:
            found[key] = _file_content(key, found[key], folder)
    return found


def _file_content(key: Key, value: Any, folder: Path) -> Any:
    """The digest of the file that ``value`` names at a key ``path`` or ``…_file``; the name where
    there is none, which the case will report."""
    if not (key == "path" or str(key).endswith("_file")) or not isinstance(value, str):
        return value
    file = Path(os.path.normpath(folder / value))  # ".." leads nowhere from a folder that is made later
    return file_digest(file) if file.is_file() else value


def _si(value: Any, kind: str, what: str) -> Any:
    """SI values of text or a tuple of texts; words such as "from body" as they are."""
    if isinstance(value, WrittenPair):
        return list(value)
    if isinstance(value, tuple | list):
        return [_si(item, kind, what) for item in value]
    if value == NONE:
        return 0.0
    if not isinstance(value, str) or not any(letter.isdigit() for letter in value):
        return value
    return list(units.parse_size(value, what)) if kind == "size" else units.parse(value, kind, what)


Change: TypeAlias = Literal["set", "without", "endless"]
"""What is done at the keys: a value is set, a layer is taken away, or it reaches down for ever."""


@dataclass(frozen=True)
class Edit:
    """One change of a document: ``value`` at ``keys``, and the ``content`` it stands for; of a
    layer only what to do."""

    keys: tuple[Key, ...]
    value: Any = None
    content: Any = None
    change: Change = "set"


def edited(table: dict[str, Any], edits: Iterable[Edit], *, by_content: bool = False) -> dict[str, Any]:
    """The document ``table`` after ``edits``, one after the other; its content after theirs where
    ``by_content``."""
    for edit in edits:
        if edit.change == "set":
            table = replaced(table, edit.keys, edit.content if by_content else edit.value)
            continue
        key, number = str(edit.keys[0]), int(edit.keys[2])
        body = table[key]
        layers, base = list(body["layers"]), body["base"]
        if edit.change == "without":
            del layers[number]
        else:  # the layer reaches down for ever
            base = {k: v for k, v in layers[number].items() if k not in ("kind", "thickness", "interface")}
            del layers[number:]
        bare = {**base}  # of one material, from the same library
        if "materials_file" in body and "material" in base:
            bare["materials_file"] = body["materials_file"]
        table = {**table, key: {**body, "layers": layers, "base": base} if layers else bare}
    return table


def plain(edit: Edit) -> list[Any]:
    """``edit`` as a list of plain values, for another process; the content stays here."""
    return [list(edit.keys), edit.value, edit.change]


def from_plain(values: Sequence[Any]) -> Edit:
    """The edit of which ``plain`` made ``values``."""
    keys, value, change = values
    return Edit(tuple(keys), value, None, change)
