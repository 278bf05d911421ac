"""The commands ``materials`` and ``liquids``: libraries of named substances and where their values
come from."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from ..core.units import show
from ..io.listing import entry_text, records_listing
from ..solids import library
from ..solids.library import LiquidRecord, MaterialRecord
from .show import console, say, table


def materials(
    name: Annotated[str | None, typer.Argument(help="Name or alias of one material.", metavar="NAME")] = None,
    file: Annotated[Path | None, typer.Option("--file", help="Your own materials, a TOML file.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON, pressures in Pa.")] = False,
) -> None:
    """List the named materials with their values and sources."""
    wanted = None if name is None else library.material(name, library=file).name
    _print(library.materials(file), wanted, as_json=as_json)


def liquids(
    name: Annotated[str | None, typer.Argument(help="Name or alias of one liquid.", metavar="NAME")] = None,
    file: Annotated[Path | None, typer.Option("--file", help="Your own liquids, a TOML file.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON, in SI units.")] = False,
) -> None:
    """List the named liquids for films between surfaces, with their values and sources."""
    wanted = None if name is None else library.liquid(name, library=file).name
    _print(library.liquids(file), wanted, as_json=as_json)


def _print(records: Sequence[MaterialRecord | LiquidRecord], wanted: str | None, *, as_json: bool) -> None:
    """Print all ``records``, or with every source the one that is ``wanted``."""
    if wanted is not None:
        records = [record for record in records if record.name == wanted]
    if as_json:
        # of a viscoelastic one with relaxed modulus (Pa), terms (Pa, s), whether the bulk is
        # elastic, and the shift
        described = []
        for record in records:
            values = {key: {"value": item.value, "source": item.source} for key, item in record.values.items()}
            made = {"name": record.name, "aliases": list(record.aliases), "note": record.note, **values}
            if isinstance(record, MaterialRecord) and record.relaxation is not None:
                shift = None if record.shift is None else {"kind": record.shift.name, **asdict(record.shift)}
                series = {
                    "relaxed": record.relaxation.relaxed,
                    "terms": [list(term) for term in record.relaxation.terms],
                }
                made["relaxation"] = {**series, "elastic_bulk": record.elastic_bulk, "shift": shift}
            described.append(made)
        console().out(json.dumps(described, indent=2), highlight=False)
        return
    if wanted is None:
        heading, headings, rows = records_listing(records)
        console().print(table(heading, rows, headings))
        sources = [
            (record.name if number == 0 else "", source)
            for record in records
            for number, source in enumerate(dict.fromkeys(item.source for item in record.values.values()))
        ]
        console().print(table("Sources", sources, (records[0].noun, "source")))
        say(f"`asperity {records[0].noun}s NAME` shows the source of every value.")
        return
    record = records[0]
    rows = [(key.replace("_", " "), entry_text(record, key), item.source) for key, item in record.values.items()]
    if isinstance(record, MaterialRecord) and record.relaxation is not None:
        relaxation, source = record.relaxation, record.youngs_modulus.source
        bulk = "; the bulk modulus does not relax" if record.elastic_bulk else ""
        rows.append(("relaxed modulus", f"{show(relaxation.relaxed, 'Pa', 5)}{bulk}", source))
        for part, time in relaxation.terms:
            rows.append(("relaxes", f"{show(part, 'Pa', 5)} in {show(time, 's', 5)}", source))
        rows += [("shift", record.shift.name, record.shift_source)] if record.shift is not None else []
    console().print(table(record.name, rows, ("quantity", "value", "source")))
    if record.aliases:
        say(f"also called {', '.join(record.aliases)}")
    if record.note:
        say(record.note)
