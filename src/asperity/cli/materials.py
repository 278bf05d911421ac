"""The commands ``materials`` and ``liquids``: libraries of named substances and where their values come from."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Annotated

import typer

from ..core.units import DIMENSIONS, show
from ..solids import library
from ..solids.library import LiquidRecord, MaterialRecord
from .show import console, say, table


@dataclass(frozen=True)
class _Listing:
    """What a list of records shows: its ``command`` and ``title``, and heading and SI unit of each value by key."""

    command: str
    title: str
    columns: tuple[tuple[str, str, str], ...]

    def text(self, record: MaterialRecord | LiquidRecord, key: str) -> str:
        """Value of ``key`` with its unit; a star behind an assumed one, a dash where it is not known."""
        if key not in record.values:
            return "–"
        item = record.values[key]
        unit = {name: unit for name, _, unit in self.columns}.get(key) or DIMENSIONS[record.kinds()[key]]
        if unit == "dimensionless":
            return f"{item.value:.5g}{' *' if item.assumed else ''}"
        # prefixes of m³/mol are hard to read
        text = f"{1e6 * item.value:.4g} cm³/mol" if unit == "m**3/mol" else show(item.value, unit, 5)
        return f"{text} *" if item.assumed else text


MATERIALS = _Listing(
    "materials",
    "Materials",
    (
        ("youngs_modulus", "E", "Pa"),
        ("poisson_ratio", "ν", "1"),
        ("hardness", "hardness", "Pa"),
        ("yield_stress", "yield stress", "Pa"),
    ),
)
LIQUIDS = _Listing(
    "liquids",
    "Liquids",
    (
        ("surface_tension", "surface tension", "N/m"),
        ("temperature", "at", "K"),
        ("molar_volume", "molar volume", "m**3/mol"),
        ("viscosity", "viscosity", "Pa*s"),
    ),
)
NAMES = MappingProxyType({MATERIALS.command: "material", LIQUIDS.command: "liquid"})
"""What one record of each command is called."""


def materials(
    name: Annotated[str | None, typer.Argument(help="Name or alias of one material.")] = None,
    file: Annotated[Path | None, typer.Option("--file", help="Your own materials, a TOML file.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON, pressures in Pa.")] = False,
) -> None:
    """List the named materials with their values and sources."""
    wanted = None if name is None else library.material(name, library=file).name
    _print(MATERIALS, library.materials(file), wanted, as_json=as_json)


def liquids(
    name: Annotated[str | None, typer.Argument(help="Name or alias of one liquid.")] = None,
    file: Annotated[Path | None, typer.Option("--file", help="Your own liquids, a TOML file.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON, in SI units.")] = False,
) -> None:
    """List the named liquids for films between surfaces, with their values and sources."""
    wanted = None if name is None else library.liquid(name, library=file).name
    _print(LIQUIDS, library.liquids(file), wanted, as_json=as_json)


def _print(
    listing: _Listing, records: Sequence[MaterialRecord | LiquidRecord], wanted: str | None, *, as_json: bool
) -> None:
    """Print all ``records``, or with every source the one that is ``wanted``."""
    if wanted is not None:
        records = [record for record in records if record.name == wanted]
    if as_json:
        # of a viscoelastic one with relaxed modulus (Pa), terms (Pa, s), whether the bulk is elastic, and the shift
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
        rows = [
            (record.name, *(listing.text(record, key) for key, _, _ in listing.columns), ", ".join(record.aliases))
            for record in records
        ]
        headings = (NAMES[listing.command], *(heading for _, heading, _ in listing.columns), "also called")
        console().print(table(f"{listing.title} (* assumed)", rows, headings))
        sources = [
            (record.name if number == 0 else "", source)
            for record in records
            for number, source in enumerate(dict.fromkeys(item.source for item in record.values.values()))
        ]
        console().print(table("Sources", sources, (NAMES[listing.command], "source")))
        say(f"`asperity {listing.command} NAME` shows the source of every value.")
        return
    record = records[0]
    rows = [(key.replace("_", " "), listing.text(record, key), item.source) for key, item in record.values.items()]
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
