"""Tables of what is rows of numbers: answers of theories, measured roughness, libraries of
materials and liquids."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from html import escape
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from ..core.late import Tabled
from ..core.quantity import Quantity
from ..core.units import DIMENSIONS, show
from ..core.words import printable
from ..solids.library import LiquidRecord, MaterialRecord, Records
from ..theories.ask import Evaluation, ways_of
from ..theories.catalogue import FAMILIES
from ..theories.statistics.roughness import Roughness

MOST, SHOWN = 12, 5
"""Points of a curve up to which all are shown, and how many of its beginning and end are shown
beyond."""


class Listing(NamedTuple):
    """What a table holds: its ``heading``, those of its columns (none of a list of names and
    values), and its rows."""

    heading: str
    headings: tuple[str, ...]
    rows: list[tuple[str, ...]]


RECORDS = {
    MaterialRecord: (
        ("youngs_modulus", "E", "Pa"),
        ("poisson_ratio", "ν", "1"),
        ("hardness", "hardness", "Pa"),
        ("yield_stress", "yield stress", "Pa"),
        ("thermal_conductivity", "k", "W/(m*K)"),
        ("electrical_resistivity", "ρ", "ohm*m"),
    ),
    LiquidRecord: (
        ("surface_tension", "surface tension", "N/m"),
        ("temperature", "at", "K"),
        ("molar_volume", "molar volume", "m**3/mol"),
        ("viscosity", "viscosity", "Pa*s"),
    ),
}
"""Values of a record that lists show: key, heading and SI unit. A line has room for so many; others
stand in the material itself."""


def entry_text(record: MaterialRecord | LiquidRecord, key: str) -> str:
    """Value of ``key`` with its unit; a star behind an assumed one, a dash where it is not
    known."""
    if key not in record.values:
        return "–"
    item = record.values[key]
    unit = {name: unit for name, _, unit in RECORDS[type(record)]}.get(key) or DIMENSIONS[record.kinds()[key]]
    if unit == "dimensionless":
        return f"{item.value:.5g}{' *' if item.assumed else ''}"
    # prefixes of m³/mol are hard to read
    text = f"{1e6 * item.value:.4g} cm³/mol" if unit == "m**3/mol" else show(item.value, unit, 5)
    return f"{text} *" if item.assumed else text


def records_listing(records: Sequence[MaterialRecord | LiquidRecord]) -> Listing:
    """All ``records``, one a row."""
    kind = type(records[0])
    rows = [
        (record.name, *(entry_text(record, key) for key, _, _ in RECORDS[kind]), ", ".join(record.aliases))
        for record in records
    ]
    headings = (kind.noun, *(heading for _, heading, _ in RECORDS[kind]), "also called")
    return Listing(f"{kind.noun.capitalize()}s (* assumed)", headings, rows)


def listing(thing: Tabled) -> Listing:
    """What the table of a ``thing`` holds."""
    if isinstance(thing, Records):
        return records_listing(thing) if thing else Listing("Nothing", (), [])
    if isinstance(thing, Roughness):
        return Listing("Roughness", (), list(_roughness(thing)))
    return _evaluated(thing) if isinstance(thing, Evaluation) else _answer(thing)


def _roughness(rough: Roughness) -> Iterator[tuple[str, str]]:
    """What is known of it, name and value."""
    if rough.assumption:
        yield "assumption", rough.assumption
    yield from (
        ("rms height", show(rough.rms_height, "m")),
        ("rms slope of the surface", f"{rough.rms_gradient:.4g}"),
        ("moments m0, m2, m4", f"{show(rough.m0, 'm**2')}, {rough.m2:.4g}, {rough.m4:.4g} 1/m²"),
        ("bandwidth parameter of Nayak m0 m4/m2²", f"{rough.alpha:.4g}"),
        ("skewness, kurtosis of the heights", f"{rough.skewness:.4g}, {rough.kurtosis:.4g}"),
    )
    if not math.isnan(rough.area):
        yield "nominal area", show(rough.area, "m**2")
    if rough.anisotropy is not None:
        yield "anisotropy, ratio of mean square slopes", f"{rough.anisotropy:.4g}"
    if not math.isnan(rough.correlation_length):
        yield "correlation length, to 1/e", show(rough.correlation_length, "m")
    if rough.summits is not None:
        found = rough.summits
        yield "summits", f"{found.count}, of mean radius {show(found.mean_radius, 'm')}"
        yield "standard deviation of the summit heights", show(found.height_deviation, "m")
    elif (numbers := rough.summit_numbers) is not None:
        yield "summits", f"{show(numbers.density, '1/m**2')}, of mean radius {show(numbers.mean_radius, 'm')}"
        yield "standard deviation of the summit heights", show(numbers.height_deviation, "m")
    if rough.spectrum is not None:
        longest, shortest = (2.0 * math.pi / float(rough.spectrum.q[end]) for end in (0, -1))
        yield "waves of the spectrum", f"{show(longest, 'm')} to {show(shortest, 'm')}"
    if rough.fractal is not None:
        dimension, length = rough.fractal.dimension, rough.fractal.roughness
        yield "fractal dimension and roughness of profiles", f"{dimension:.4g}, {show(length, 'm')}"


def _answer(thing: Tabled) -> Listing:
    """The curve of a theory, one row a point; of one point or number one row a quantity."""
    known = _quantities(type(thing))
    found: list[tuple[str, list[str]]] = []
    for name in known or vars(thing):
        values = np.asarray(attrgetter(name)(thing))
        if values.dtype.kind in "fi" and values.ndim <= 1 and values.size and not np.isnan(values).all():
            alike = known.get(name, [])
            # where theories differ, as in the plane, where loads are per length: numbers without
            # prefixes
            one = alike[0].unit if len(alike) == 1 else ""
            unit = f" ({' or '.join(item.unit for item in alike)})" if len(alike) > 1 else ""
            texts = [show(float(value), one) if one else f"{value:.4g}" for value in values.reshape(-1)]
            found.append((name.rpartition("normal.")[2].replace("_", " ") + unit, texts))
    return _curve(type(thing).__name__, found)


def _evaluated(found: Evaluation) -> Listing:
    """The curve, or of one point or none what depends on the inputs alone beside it; where limits
    do not hold they are named."""
    columns = [
        (column.name.replace("_", " "), [show(float(value), column.unit) for value in values])
        for column, values in found.columns
    ]
    left = [limit.criterion for limit in found.limits if not limit.holds.all()]
    beyond = f"; beyond its limits in {', '.join(left)}" if left else ""
    numbers = [(column.name.replace("_", " "), [show(value, column.unit)]) for column, value in found.numbers]
    many = bool(columns) and len(columns[0][1]) > 1
    return _curve(f"{found.theory.title}{beyond}", columns if many else [*numbers, *columns])


def _curve(heading: str, found: list[tuple[str, list[str]]]) -> Listing:
    """Names and texts of quantities, one row a point; of one point one row a quantity; of many
    points the first and the last."""
    points = max((len(texts) for _, texts in found), default=0)
    if points < 2:
        return Listing(heading, (), [(name, texts[0]) for name, texts in found])
    rows = [tuple(texts[at % len(texts)] for _, texts in found) for at in range(points)]
    if points > MOST:
        rows = [*rows[:SHOWN], ("…",) * len(found), *rows[-SHOWN:]]
        heading = f"{heading}, {points} points"
    return Listing(heading, tuple(name for name, _ in found), rows)


def _quantities(kind: type) -> dict[str, list[Quantity]]:
    """What theories that answer with ``kind`` say of its values, by their names; more than one of a
    name where their units differ."""
    found: dict[str, dict[str, Quantity]] = {}
    names = {base.__name__ for base in kind.__mro__}
    for theory in (theory for family in FAMILIES.values() for theory in family):
        for way in ways_of(theory):
            if getattr(theory, way.method).__annotations__.get("return") in names:
                for column in way.columns:
                    found.setdefault(column.name, {}).setdefault(column.unit, column)
    return {name: list(units.values()) for name, units in found.items()}


def lines(thing: Tabled) -> str:
    """The table of ``thing`` as lines of text."""
    heading, headings, rows = listing(thing)
    cells = [tuple(printable(cell) for cell in row) for row in ([headings] if headings else []) + rows]
    wide = [max(len(row[at]) for row in cells) for at in range(len(cells[0]) if cells else 0)]
    body = [
        "  " + "  ".join(f"{cell:<{width}}" for cell, width in zip(row, wide, strict=True)).rstrip() for row in cells
    ]
    return "\n".join([heading, *body])


def table(thing: Tabled) -> str:
    """The table of ``thing`` as HTML that needs no other file."""
    heading, headings, rows = listing(thing)
    left, quiet = "text-align:left", "text-align:left;font-weight:normal;color:#55606c"

    def cell(text: str, of: str = "td", style: str = left) -> str:
        return f"<{of} style='{style}'>{escape(printable(text))}</{of}>"

    above = f"<tr>{''.join(cell(text, 'th') for text in headings)}</tr>" if headings else ""
    body = "".join(
        f"<tr>{cell(row[0], 'th', quiet)}{''.join(map(cell, row[1:]))}</tr>"
        if not headings
        else f"<tr>{''.join(map(cell, row))}</tr>"
        for row in rows
    )
    return f"<div><b>{escape(heading)}</b><table>{above}{body}</table></div>"
