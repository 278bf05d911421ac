"""What is wrong with a document, in plain words: one line for every problem."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from typing import Any

from pydantic import ValidationError

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

    ``schema`` is the JSON schema of the document; ``names`` replaces dotted keys by what the user wrote instead, such
    as the option of a command.
    """
    found: dict[str, None] = {}
    for detail in error.errors():
        key, allowed = _located(schema, detail["loc"])
        shown = names.get(key, key)
        found[_sentence(dict(detail), shown, allowed)] = None
    return list(found)


def _sentence(detail: Mapping[str, Any], key: str, allowed: Sequence[str]) -> str:
    kind, context, received = detail["type"], detail.get("ctx", {}), detail["input"]
    if kind == "value_error":
        text = str(context["error"])
        return (key or "document") + text if text.startswith((" ", ".")) else text
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
    if kind in _TYPES:
        return f"{key} must be {_TYPES[kind]}, but is {_shown(received)}."
    rule = str(detail["msg"]).replace("Input should", "must", 1)
    return f"{key} {rule}, but is {_shown(received)}."


def _shown(value: object) -> str:
    text = str(value).lower() if isinstance(value, bool) else repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _located(schema: Mapping[str, Any], loc: Sequence[int | str]) -> tuple[str, list[str]]:
    """Dotted key of ``loc`` without the names of union members, and what may stand in its place."""
    key, node = "", _resolved(schema, schema)
    allowed: list[str] = []
    for part in loc:
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
    return key, list(mapping) if mapping else allowed


def _resolved(node: Mapping[str, Any], schema: Mapping[str, Any]) -> Mapping[str, Any]:
    """``node`` with references followed, and of alternatives the one that is neither null nor text taken."""
    while True:
        alternatives = [item for item in node.get("anyOf", ()) if item.get("type") not in ("null", "string")]
        if "$ref" in node:
            node = schema["$defs"][node["$ref"].rpartition("/")[2]]
        elif len(alternatives) == 1:
            node = alternatives[0]
        else:
            return node
