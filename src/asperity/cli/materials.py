"""The command ``materials``: the library of named materials and where its values come from."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from ..solids.library import MaterialRecord


def materials(
    name: Annotated[str | None, typer.Argument(help="Name or alias of one material.")] = None,
    file: Annotated[Path | None, typer.Option("--file", help="Your own materials, a TOML file.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON, pressures in Pa.")] = False,
) -> None:
    """List the named materials with their values and sources."""
    import json

    from ..solids.library import material
    from ..solids.library import materials as library
    from .show import console

    records = library(file)
    if name is not None:
        wanted = material(name, library=file).name
        records = tuple(record for record in records if record.name == wanted)
    if as_json:
        console().out(json.dumps([_described(record) for record in records], indent=2), highlight=False)
    elif name is not None:
        _print_one(records[0])
    else:
        _print_all(records)


def _described(record: MaterialRecord) -> dict[str, Any]:
    values = {key: {"value": item.value, "source": item.source} for key, item in record.values.items()}
    return {"name": record.name, "aliases": list(record.aliases), "note": record.note, **values}


def _text(record: MaterialRecord, key: str) -> str:
    from ..core.units import show

    if key not in record.values:
        return "–"
    item = record.values[key]
    text = f"{item.value:g}" if key == "poisson_ratio" else show(item.value, "Pa")
    return f"{text} *" if item.assumed else text


def _print_all(records: tuple[MaterialRecord, ...]) -> None:
    from .show import console, say, table

    keys = ("youngs_modulus", "poisson_ratio", "hardness", "yield_stress")
    rows = [(record.name, *(_text(record, key) for key in keys), ", ".join(record.aliases)) for record in records]
    headings = ("material", "E", "ν", "hardness", "yield stress", "also called")
    console().print(table("Materials (* assumed)", rows, headings))
    for source in dict.fromkeys(item.source for record in records for item in record.values.values()):
        say(f"  source: {source}", "dim")
    say("`asperity materials NAME` shows the source of every value.")


def _print_one(record: MaterialRecord) -> None:
    from .show import console, say, table

    rows = [(key.replace("_", " "), _text(record, key), item.source) for key, item in record.values.items()]
    console().print(table(record.name, rows, ("quantity", "value", "source")))
    if record.aliases:
        say(f"also called {', '.join(record.aliases)}")
    if record.note:
        say(record.note)
