"""Tables of a document: pydantic models whose values are declared by ``core.parameters``, and what
is wrong with a table.

Import this where documents are read, not in the physics: pydantic takes a tenth of a second.
"""

from __future__ import annotations

import copy
import difflib
import inspect
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Annotated, Any, ClassVar, Literal, Optional, TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError, create_model, model_validator
from pydantic.fields import FieldInfo

from .errors import InputError
from .parameters import REQUIRED, Parameter, parameter, parameters, taken_apart, values_of
from .values import Choice, Flag, Number, Several, Values, Whole, WrittenPair
from .words import alike, key_in_words

T = TypeVar("T", bound="Settings")


class Settings(BaseModel):
    """Base of all tables: unknown keys are errors, nothing changes after loading, defaults are
    checked too.

    Every value may be the text that the command line takes: ``"5 nm"``, ``"0.3"``, ``"1nm,5nm"``
    for a list.
    """

    model_config = ConfigDict(
        extra="forbid", frozen=True, strict=True, allow_inf_nan=False, validate_default=True, defer_build=True
    )

    makes: ClassVar[Callable[..., Any]] = dict
    """What is called with the values, for the table of a function."""

    @model_validator(mode="before")
    @classmethod
    def _from_text(cls, table: Any) -> Any:
        """Text and lists as what the types of the fields ask for; what cannot be read is left to
        their checks."""
        if not isinstance(table, Mapping):
            return table
        made = dict(table)
        for key in made.keys() & cls.model_fields.keys():
            made[key] = _prepared(made[key], declared(key, cls.model_fields[key]).values)
        return made

    def given(self, *leave: str) -> dict[str, Any]:
        """Values by key in SI, without those that are None and without the keys to ``leave``."""
        values = {key: _plain(getattr(self, key)) for key in type(self).model_fields if key not in leave}
        return {key: value for key, value in values.items() if value is not None}


def setting(default: Any = ..., *, help: str = "", option: str | None = None, of: str = "") -> Any:
    """Field of a table with one line of ``help`` and, if it is not the usual one, the name of its
    ``option``."""
    extra: Any = {key: value for key, value in (("option", option), ("of", of)) if value}
    return Field(default, description=help or None, json_schema_extra=extra or None)


def declared(name: str, field: FieldInfo) -> Parameter:
    """What the ``field`` of a table declares."""
    annotation: Any = field.annotation
    for mark in field.metadata:
        annotation = Annotated[annotation, mark]
    default = REQUIRED if field.is_required() else field.default
    extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
    found = parameter(name, annotation, default)
    if found is None:
        found = Parameter(name, annotation, values_of(*taken_apart(annotation)), default)
    option, of = extra.get("option") or found.option, extra.get("of") or found.of
    return replace(found, help=field.description or found.help, option=str(option) if option else None, of=str(of))


def table_of(
    function: Callable[..., Any],
    base: type[T],
    kind: str,
    *,
    tables: Mapping[Any, Any] | None = None,
) -> type[T]:
    """Table with a key for every declared parameter of a ``function`` or dataclass, beside those of
    ``base``.

    Parameters
    ----------
    function
        What is called with the values of the table.
    base
        Table whose keys are added.
    kind
        Name of the key that distinguishes this table from others, and its only value:
        ``"kind=sphere"``.
    tables
        What stands in a document for parameters of types that are no numbers: annotations by type,
        None for no key.

    A default with a unit, and one that has no text, stays that of the function: None in the
    document.
    """
    tag, _, value = kind.partition("=")
    made: dict[str, Any] = {tag: (Literal[value], ...)}
    for item in parameters(function):
        shown = (tables or {}).get(taken_apart(item.annotation)[0], item.annotation)
        if shown is None:
            continue
        plain = isinstance(item.default, bool | int | str | float) and not item.unit and item.default != float("inf")
        default = ... if item.required else item.default if plain else None
        optional = Optional[shown] if default is None else shown  # noqa: UP045  (shown is a value here, no annotation)
        made[item.name] = (optional, setting(default, help=item.help, option=item.option or "", of=item.of))
    doc = inspect.cleandoc(function.__doc__ or "").partition("\n\n")[0]
    table = create_model(function.__name__, __base__=base, __doc__=doc, __module__=base.__module__, **made)
    table.makes = staticmethod(function)
    return table


COMMAND_LINE = "command line"
"""What is checked if options are: they name themselves, so that a message on one problem does not
begin with it."""


def validated(model: type[T], table: Mapping[str, Any], where: str, names: Mapping[str, str] | None = None) -> T:
    """The ``model`` made of the nested ``table``; ``names`` replaces dotted keys in messages, such
    as by an option.

    Raises
    ------
    InputError
        If anything is missing, unknown or out of range; the message names ``where`` and has one
        line for each problem.
    """
    try:
        return model.model_validate(dict(table))
    except ValidationError as error:
        meant = _as_meant(table, error)
        if meant is not None:
            return validated(model, meant, where, names)
        lines = problems(error, json_schema(model), names or {})
    if len(lines) == 1:
        raise InputError(lines[0] if where == COMMAND_LINE else f"{where}: {lines[0]}")
    raise InputError(f"{where} has {len(lines)} problems:\n" + "\n".join(f"  {line}" for line in lines), subject=where)


def _as_meant(table: Mapping[str, Any], error: ValidationError) -> dict[str, Any] | None:
    """``table`` with the words that are known but for capitals, spaces, hyphens and underscores;
    None if there are none in the ``error``."""
    found, changed = copy.deepcopy(dict(table)), False
    for detail in error.errors():
        place, context = list(detail["loc"]), detail.get("ctx", {})
        if detail["type"] == "union_tag_invalid":
            place.append(context["discriminator"].strip("'"))
            expected, given = context["expected_tags"], context["tag"]
        elif detail["type"] == "literal_error":
            expected, given = context["expected"], detail["input"]
        else:
            continue
        node: Any = found
        for part in place[:-1]:  # names of members of unions stand among the keys
            if (isinstance(node, dict) and part in node) or (isinstance(node, list) and isinstance(part, int)):
                node = node[part]  # type: ignore[index]
        same = [
            word
            for word in re.findall(r"'([^']*)'", expected)
            if isinstance(given, str) and alike(word) == alike(given)
        ]
        if len(same) == 1 and isinstance(node, dict) and node.get(place[-1]) == given:
            node[place[-1]], changed = same[0], True
    return found if changed else None


@lru_cache(maxsize=8)
def json_schema(model: type[BaseModel]) -> Mapping[str, Any]:
    """The JSON schema of a table."""
    return model.model_json_schema()


def _prepared(value: Any, values: Values) -> Any:
    """``value`` of a table with text taken apart where a list is expected, and as a number where
    one is."""
    if isinstance(values, Several):
        if isinstance(value, str) and type(values.item) is not Values:
            return tuple(part.strip() for part in value.split(","))
        return (value,) if isinstance(value, str | dict) else tuple(value) if isinstance(value, list) else value
    if isinstance(value, str) and isinstance(values, Whole | Flag | Choice | Number):
        try:
            read = values.read(value, "")
        except InputError:
            return value
        return value if isinstance(values, Number) and values.unit else read
    return value


_TYPES = {
    "string_type": "text",
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "float_type": "a number",
    "finite_number": "a finite number",
    "bool_type": "true or false",
    "tuple_type": "a list",
    "model_type": "a table",
    "model_attributes_type": "a table",
    "dict_type": "a table",
}


def problems(error: ValidationError, schema: Mapping[str, Any], names: Mapping[str, str]) -> list[str]:
    """One sentence for each problem in ``error``, in the order of the document.

    ``schema`` is the JSON schema of the document; ``names`` replaces dotted keys by what the user
    wrote instead, such as the option of a command.
    """
    found: dict[str, None] = {}
    for detail in error.errors():
        # dotted key without the names of union members, and what may stand in its place
        key, node = "", _resolved(schema, schema)
        allowed: list[str] = []
        for part in detail["loc"]:
            mapping = node.get("discriminator", {}).get("mapping", {})
            properties = node.get("properties", {})
            if isinstance(part, int):
                key, node = f"{key}[{part + 1}]", _resolved(node.get("items", {}), schema)
            elif part in mapping:
                node = _resolved({"$ref": mapping[part]}, schema)
            else:
                allowed = list(properties)
                key, node = f"{key}.{part}".lstrip("."), _resolved(properties.get(part, {}), schema)
        mapping = node.get("discriminator", {}).get("mapping")
        allowed = list(mapping) if mapping else allowed
        if detail["type"] == "value_error" and (own := re.match(r"[.\[][\w.\[\]]*", str(detail["ctx"]["error"]))):
            found[f"{_called((key + own[0]).lstrip('.'), names)}{str(detail['ctx']['error'])[own.end() :]}"] = None
        else:
            called = _called(key, names, unknown=detail["type"] == "extra_forbidden")
            found[_sentence(dict(detail), called, allowed)] = None
    return list(found)


def _plain(value: Any) -> Any:
    """``value`` without the texts of its numbers; a size keeps its own, which distinguishes one
    length from two."""
    if isinstance(value, tuple) and not isinstance(value, WrittenPair):
        return tuple(_plain(item) for item in value)
    return float(value) if isinstance(value, float) else value


def _called(key: str, names: Mapping[str, str], *, unknown: bool = False) -> str:
    """What the user calls the dotted ``key``: its name, or that of the list or table it is in and
    its place there; an ``unknown`` one as it is written."""
    parts, whole = [], key
    while whole not in names:
        match = re.fullmatch(r"(.+)(?:\[(\d+)\]|\.(\w+))", whole)
        if match is None:
            return key if unknown else key_in_words(key)
        parts.append(f"part {match[2]} of" if match[2] else f"{match[3]} of")
        whole = match[1]
    return " ".join([*parts, names[whole]])


def _sentence(detail: Mapping[str, Any], key: str, allowed: Sequence[str]) -> str:
    kind, context, received = detail["type"], detail.get("ctx", {}), detail["input"]
    if kind == "value_error":
        text = str(context["error"])
        return (key or "document") + text if text.startswith(" ") else text
    if kind == "missing":
        return f"{key} must be given, but is missing."
    if kind == "extra_forbidden":
        near = difflib.get_close_matches(key.rpartition(".")[2], allowed, n=1)
        hint = f"did you mean {near[0]}?" if near else f"the keys here are {', '.join(allowed)}."
        return f"{key} is not a known key; {hint}"
    if kind == "literal_error":
        return f"{key} must be {context['expected']}, but is {received!r}."
    if kind == "union_tag_invalid":
        tag = context["discriminator"].strip("'")
        return f"{key}.{tag} must be one of {context['expected_tags']}, but is {context['tag']!r}."
    if kind == "union_tag_not_found":
        tag, choices = context["discriminator"].strip("'"), ", ".join(repr(choice) for choice in allowed)
        return f"{key}.{tag} must be given, one of {choices}, but is missing."
    shown = str(received).lower() if isinstance(received, bool) else repr(received)
    shown = shown if len(shown) <= 60 else shown[:57] + "..."
    rule = f"must be {_TYPES[kind]}" if kind in _TYPES else str(detail["msg"]).replace("Input should", "must", 1)
    return f"{key} {rule}, but is {shown}."


def _resolved(node: Mapping[str, Any], schema: Mapping[str, Any]) -> Mapping[str, Any]:
    """``node`` with references followed, and of alternatives the one that is neither null nor text
    taken."""
    while True:
        alternatives = [item for item in node.get("anyOf", ()) if item.get("type") not in ("null", "string")]
        if "$ref" in node:
            node = schema["$defs"][node["$ref"].rpartition("/")[2]]
        elif len(alternatives) == 1:
            node = alternatives[0]
        else:
            return node
