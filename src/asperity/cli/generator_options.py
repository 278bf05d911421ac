"""The keys of a generated surface's table as options: their names, types and words, and the table they make."""

from __future__ import annotations

import inspect
from dataclasses import dataclass
from types import MappingProxyType
from typing import Annotated, Any, Literal, get_args, get_origin

import typer
from pydantic.fields import FieldInfo

from ..core.errors import InputError
from ..core.settings import Settings
from ..io.quantities import quantity
from ..io.schemas.base import FileSurface
from ..io.schemas.random_surfaces import RandomSurface
from ..io.schemas.shapes import Shape
from .generator_help import HELP
from .preparing import PreparationOptions, points, steps

KINDS: MappingProxyType[str, type[Settings]] = MappingProxyType(
    {
        get_args(model.model_fields["kind"].annotation)[0]: model
        for model in (*get_args(RandomSurface), *get_args(Shape))
    }
)
"""Schema of every kind of generated surface."""

PARTS = ("spectrum", "heights")
"""Tables within a table whose keys are options without prefix; those of all other tables carry the name of the table."""

_LEFT_OUT = ("kind", "prepare", "mirror", "place", "surface")
_FILE_KEYS = ("path", "channel", "size", "height_unit")


@dataclass(frozen=True)
class Key:
    """One option: the ``path`` of its key in the table, its ``field``, and whether the table needs it."""

    path: tuple[str, ...]
    field: FieldInfo
    required: bool

    @property
    def option(self) -> str:
        """Name of the option."""
        words = [part for part in self.path[:-1] if part not in PARTS and part != "surface"]
        if "surface" in self.path[:-1]:
            words = [part for part in self.path[:-1] if part != "surface"]
            last = ["file"] if self.path[-1] == "path" else ["file", self.path[-1]]
        elif self.path[-1] == "kind":
            words, last = [], [self.path[-2]]
        else:
            last = [self.path[-1]]
        return "--" + "-".join((*words, *last)).replace("_", "-")

    @property
    def parameter(self) -> str:
        """Name of the parameter of the command."""
        return self.option[2:].replace("-", "_")


def keys(model: type[Settings]) -> list[Key]:
    """All options of a kind, those of its own first."""
    own, nested = [], []
    for name, field in model.model_fields.items():
        members = _members(field.annotation)
        if members:
            nested += _part_keys(name, members)
        elif name not in _LEFT_OUT:
            own.append(Key((name,), field, field.is_required()))
    return own + nested


def _part_keys(name: str, members: tuple[type[Settings], ...]) -> list[Key]:
    """Keys of a table within the table, of whatever kind it may be; its members share options of the same name."""
    found: dict[str, Key] = {}
    for member in members:
        for key, field in member.model_fields.items():
            inner: list[tuple[tuple[str, ...], FieldInfo]] = [((key,), field)]
            if key == "surface":
                inner = [(("surface", k), FileSurface.model_fields[k]) for k in _FILE_KEYS]
            for path, own in inner:
                made = Key((name, *path), own, path == ("kind",))
                found.setdefault(made.option, made)
    return list(found.values())


def _members(annotation: Any) -> tuple[type[Settings], ...]:
    """Models of a union of tables, empty for any other type."""
    parts = get_args(annotation) or (annotation,)
    if parts and get_origin(annotation) is Annotated:
        parts = get_args(parts[0])
    tables = tuple(part for part in parts if isinstance(part, type) and issubclass(part, Settings))
    return tables if len(tables) == len(parts) else ()


def parameter(key: Key) -> inspect.Parameter:
    """Parameter of the command for ``key``, annotated with its option."""
    names = [key.option, "--rms"] if key.option == "--rms-height" else [key.option]
    annotation = _simple(key.field.annotation) if quantity(key.field) is None else str
    default: Any = inspect.Parameter.empty if key.required else None
    if annotation is bool:
        default = bool(key.field.default)
        names = [f"{key.option}/--no-{key.option[2:]}" if default else key.option]
    option = typer.Option(*names, help=explained(key), metavar=_metavar(key))
    return keyword(key.parameter, annotation if default is not None else annotation | None, option, default)


def keyword(name: str, annotation: Any, option: Any, default: Any) -> inspect.Parameter:
    """Keyword parameter annotated with an ``option`` of typer."""
    return inspect.Parameter(
        name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=Annotated[annotation, option]
    )


def _simple(annotation: Any) -> Any:
    """Type of an option: bool, int, float or text."""
    kinds = [part for part in _flat(annotation) if part is not type(None)]
    for kind in (bool, int, float):
        if kinds == [kind]:
            return kind
    return str


def _flat(annotation: Any) -> list[Any]:
    if get_origin(annotation) is Annotated:
        return _flat(get_args(annotation)[0])
    if get_origin(annotation) is Literal:
        return [str]
    if get_origin(annotation) is tuple:
        return [tuple]
    parts = get_args(annotation)
    return [item for part in parts for item in _flat(part)] if parts else [annotation]


def _choices(annotation: Any) -> tuple[str, ...]:
    """Words of a ``Literal``, also within a union."""
    if get_origin(annotation) is Literal:
        return tuple(str(word) for word in get_args(annotation))
    return tuple(word for part in get_args(annotation) for word in _choices(part))


def explained(key: Key) -> str:
    """Text of the option in the help."""
    if key.path[-1] == "kind":
        return f"Kind of the {HELP.get('table ' + key.path[0], key.path[0])}: {', '.join(_kinds_of(key.path[0]))}."
    text = HELP.get(".".join(key.path), HELP.get(key.path[-1], ""))
    words = _choices(key.field.annotation)
    default = key.field.default
    text += f" One of {', '.join(words)}." if words else ""
    shown = not key.required and not key.field.is_required() and default is not None and not isinstance(default, bool)
    return f"{text} Default: {default}." if shown else text


def _metavar(key: Key) -> str | None:
    if key.path[-1] == "points":
        return "NX[xNY]"
    kind = quantity(key.field)
    if kind is None or kind == "size":
        return None if kind is None else "LENGTH[xLENGTH]"
    word = {"power spectrum": "PSD"}.get(kind, kind.upper())
    return f"{word},{word}" if tuple in _flat(key.field.annotation) else word


def _kinds_of(table: str) -> list[str]:
    """Names of the members of the unions that stand for ``table`` in any kind."""
    for model in KINDS.values():
        if table in model.model_fields:
            members = _members(model.model_fields[table].annotation)
            return [get_args(member.model_fields["kind"].annotation)[0] for member in members]
    return []


def table_of(kind: str, options: list[Key], values: dict[str, Any]) -> dict[str, Any]:
    """Nested table of the options that were given."""
    table: dict[str, Any] = {"kind": kind}
    for key in options:
        value = values[key.parameter]
        if value is None or (isinstance(value, bool) and value == key.field.default):
            continue
        if key.path[-1] == "points":
            value = points(value, key.option)
        elif tuple in _flat(key.field.annotation) and key.path[-1] not in ("points", "size"):
            value = _listed(value, key)
        inner = table
        for part in key.path[:-1]:
            inner = inner.setdefault(part, {})
        inner[key.path[-1]] = value
    for part in table.values():
        if isinstance(part, dict) and "surface" in part:
            part["surface"] = {"kind": "file", **part["surface"], "prepare": steps(PreparationOptions())}
    return table


def _listed(text: str, key: Key) -> list[Any]:
    parts = [part.strip() for part in text.split(",")]
    if Ellipsis not in get_args(key.field.annotation) and len(parts) != 2:
        raise InputError(f"{key.option} must be two values with a comma between, but is {text!r}.")
    if quantity(key.field) is not None:
        return parts
    try:
        return [float(part) for part in parts]
    except ValueError:
        raise InputError(f"{key.option} must be numbers with commas between, but is {text!r}.") from None
