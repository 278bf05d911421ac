"""The pages of the problem document and of units, from the schema and the table of units."""

from __future__ import annotations

import re
from typing import Any

from asperity.core.units import DIMENSIONS, EXAMPLES
from asperity.run.document import json_schema
from asperity.run.tractions import TractionsDocument

Schema = dict[str, Any]

HEAD = """# Problem document

Every table and key of the document that `asperity contact --from`, `asperity run` and `asp.run` read, from
its schema; how to write one: [problem documents](../how-to/problem-document.md). Quantities are text with
[units](units.md). Keys without a default must be given.
"""

UNITS = """# Units

Quantities in text are a number and a unit, "50 kPa" or "5nm"; lengths of two sides are "20 um x 20 um". A
missing unit is an error and is never guessed. Prefixes (n, u or µ, m, k, M, G) and powers (`um**2`,
`1/mm**2`) may be used with every unit. In Python every number is in SI units, and arrays and results are SI
as well.

| kind | in SI | example |
|---|---|---|
"""


def pages() -> dict[str, str]:
    """Both pages by their place on the site."""
    rows = [
        f"| {kind} | {'–' if unit == 'dimensionless' else f'`{unit}`'} | {_example(kind, unit)} |"
        for kind, unit in DIMENSIONS.items()
    ]
    return {"reference/document.md": _document(), "reference/units.md": UNITS + "\n".join(rows) + "\n"}


def _example(kind: str, unit: str) -> str:
    return "`0.3`" if unit == "dimensionless" else f"`{EXAMPLES.get(kind, f'1 {unit}')}`"


def _document() -> str:
    schema = json_schema()
    kinds: dict[str, Schema] = schema["$defs"]
    groups = {
        "Tables": [name for name in kinds if _selector(kinds[name]) is None],
        "Surfaces": _mapped(schema["properties"]["surface"]),
        "Steps of preparation": _mapped(kinds["FileSurface"]["properties"]["prepare"]["items"]),
    }
    listed = [name for names in groups.values() for name in names]
    groups["Spectra, statistics and laws"] = [name for name in kinds if name not in listed]
    parts = [HEAD, "## The document\n", _table(schema, kinds)]
    for title, names in groups.items():
        parts.append(f"## {title}\n")
        parts += [_section(name, kinds) for name in sorted(names, key=lambda name: _title(name, kinds[name]).lower())]
    loaded = TractionsDocument.model_json_schema()
    own = loaded["$defs"]
    parts += ["## Prescribed tractions\n", _about(loaded), _table(loaded, own)]
    parts += [_section(name, own) for name in sorted(own.keys() - kinds.keys())]
    return "\n".join(parts)


def _mapped(key: Schema) -> list[str]:
    return [aim.rpartition("/")[2] for aim in key["discriminator"]["mapping"].values()]


def _section(name: str, kinds: dict[str, Schema]) -> str:
    kind = _whole(kinds[name])
    return f"({_anchor(name)})=\n### {_title(name, kinds[name])}\n\n{_about(kind)}{_table(kind, kinds)}"


def _whole(kind: Schema) -> Schema:
    """The table itself of what may also be text."""
    return next((one for one in kind.get("anyOf", ()) if one.get("properties")), kind)


def _selector(kind: Schema) -> str | None:
    """The key and value that select a table among others, if it has them."""
    for key in ("kind", "step"):
        constant = _whole(kind).get("properties", {}).get(key, {}).get("const")
        if constant:
            return f'{key} = "{constant}"'
    return None


def _title(name: str, kind: Schema) -> str:
    selector = _selector(kind)
    if selector:
        return f"`{selector}`"
    words = re.sub(r"(Table|Settings|Surface)$", "", name)
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", words).lower().capitalize()


def _anchor(name: str) -> str:
    return f"document-{name.lower().replace('_', '-')}"


def _about(kind: Schema) -> str:
    text = str(kind.get("description", "")).split("\n\n")[0]
    return _escaped(" ".join(text.split())) + "\n\n" if text else ""


def _escaped(text: str) -> str:
    code = re.sub(r"``([^`]*)``", r"`\1`", text)
    return "".join(
        part if part.startswith("`") else re.sub(r"([|*_<\[\]$])", r"\\\1", part)
        for part in re.split(r"(`[^`]*`)", code)
    )


def _table(schema: Schema, kinds: dict[str, Schema]) -> str:
    required = schema.get("required", [])
    lines = ["| key | value | default | meaning |", "|---|---|---|---|"]
    for name, key in schema.get("properties", {}).items():
        default = "" if name in required else _default(key)
        lines.append(f"| `{name}` | {_value(key, kinds)} | {default} | {_meaning(key)} |")
    return "\n".join(lines) + "\n" if len(lines) > 2 else ""


def _default(key: Schema) -> str:
    value = key.get("default")
    if value in (None, "", []) or isinstance(value, dict):
        return "–"
    return f"`{str(value).lower() if isinstance(value, bool) else value}`"


def _meaning(key: Schema) -> str:
    option = key.get("option")
    return _escaped(" ".join(str(key.get("description", "")).split())) + (f" (`{option}`)" if option else "")


_KINDS = {
    "string": "text",
    "boolean": "`true` or `false`",
    "integer": "integer",
    "number": "number",
    "object": "table",
}


def _value(key: Schema, kinds: dict[str, Schema]) -> str:
    """What a key takes, in words and links."""
    if "$ref" in key:
        name = key["$ref"].rpartition("/")[2]
        selector = _selector(kinds[name])
        text = _title(name, kinds[name]) if selector is None else selector.split(" = ")[1].strip('"')
        return f"[{text}](#{_anchor(name)})"
    if "discriminator" in key and len(key["discriminator"]["mapping"]) > 6:
        word = key["discriminator"]["propertyName"]
        return f"a table of {'[surfaces](#surfaces)' if word == 'kind' else '[steps](#steps-of-preparation)'}"
    for word in ("anyOf", "oneOf", "allOf"):
        if word in key:
            found = dict.fromkeys(_value(one, kinds) for one in key[word] if one.get("type") != "null")
            return " or ".join(found)
    if not key:
        return "text"
    if "const" in key:
        return f"`{key['const']}`"
    if "enum" in key:
        return ", ".join(f"`{one}`" for one in key["enum"])
    if key.get("type") == "array":
        items = key.get("items") or {}
        return f"list of {_value(items, kinds)}" if items else "list"
    if "quantity" in key:
        return f"{key['quantity']}{_range(key)}"
    return f"{_KINDS.get(str(key.get('type')), 'value')}{_range(key)}"


def _range(key: Schema) -> str:
    """The range of a number, where it has one."""
    words = {"exclusiveMinimum": "&gt;", "minimum": "≥", "exclusiveMaximum": "&lt;", "maximum": "≤"}
    found = [f"{sign} {key[name]:g}" for name, sign in words.items() if name in key]
    return f" {', '.join(found)}" if found else ""
