"""Changes of a problem document, and of its content: scalars set, and layers taken away or made endless."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from .places import Key, replaced

Change: TypeAlias = Literal["set", "without", "endless"]
"""What is done at the keys: a value is set, a layer is taken away, or it reaches down for ever."""


@dataclass(frozen=True)
class Edit:
    """One change of a document: ``value`` at ``keys``, and the ``content`` it stands for; of a layer only what to do."""

    keys: tuple[Key, ...]
    value: Any = None
    content: Any = None
    change: Change = "set"


def edited(table: dict[str, Any], edits: Iterable[Edit]) -> dict[str, Any]:
    """The document ``table`` after ``edits``, one after the other."""
    for edit in edits:
        table = _after(table, edit, edit.value)
    return table


def edited_content(table: dict[str, Any], edits: Iterable[Edit]) -> dict[str, Any]:
    """The content ``table`` after ``edits``, one after the other."""
    for edit in edits:
        table = _after(table, edit, edit.content)
    return table


def plain(edit: Edit) -> list[Any]:
    """``edit`` as a list of plain values, for another process; the content stays here."""
    return [list(edit.keys), edit.value, edit.change]


def from_plain(values: Sequence[Any]) -> Edit:
    """The edit of which ``plain`` made ``values``."""
    keys, value, change = values
    return Edit(tuple(keys), value, None, change)


def _after(table: dict[str, Any], edit: Edit, value: Any) -> dict[str, Any]:
    if edit.change == "set":
        return replaced(table, edit.keys, value)
    key, number = str(edit.keys[0]), int(edit.keys[2])
    return {**table, key: _LAYERS[edit.change](table[key], number)}


def _without(body: Mapping[str, Any], number: int) -> dict[str, Any]:
    """``body`` without its layer ``number``."""
    rest = [layer for index, layer in enumerate(body["layers"]) if index != number]
    return {**body, "layers": rest} if rest else _bare(body, body["base"])


def _endless(body: Mapping[str, Any], number: int) -> dict[str, Any]:
    """``body`` whose layer ``number`` reaches down for ever."""
    layer = body["layers"][number]
    material = {key: value for key, value in layer.items() if key not in ("kind", "thickness", "interface")}
    above = list(body["layers"][:number])
    return {**body, "layers": above, "base": material} if above else _bare(body, material)


def _bare(body: Mapping[str, Any], material: Mapping[str, Any]) -> dict[str, Any]:
    """A body of one ``material``, from the same library as ``body``."""
    named = "materials_file" in body and "material" in material
    return {**material, **({"materials_file": body["materials_file"]} if named else {})}


_LAYERS: dict[str, Callable[[Mapping[str, Any], int], dict[str, Any]]] = {"without": _without, "endless": _endless}
"""What makes each change of a layer."""
