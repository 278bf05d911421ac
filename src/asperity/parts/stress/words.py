"""Stresses inside a body in words and tables: maxima of each layer, interfaces, onset of yield."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import Any, TypeVar

from ...core.units import show
from ...stress.criteria import TABOR
from ...stress.field import Peak, RegionMaxima
from ...stress.regions import Region
from ...stress.survey import StressSurvey
from ...stress.yielding import RegionYield
from ..part import Rows, Table, Words

Part = TypeVar("Part", RegionMaxima, RegionYield)


def words(survey: StressSurvey) -> Words:
    """Settings, and the largest stresses of layers and interfaces."""
    tables = (
        ("Largest stresses inside each layer", maxima_table(survey)),
        ("Interfaces", interface_table(survey)),
        ("Given strengths", strength_table(survey)),
    )
    shown = tuple((heading, table) for heading, table in tables if table.cells)
    return Words(rows=setting_rows(survey), tables=shown, remarks=tuple(remarks(survey)))


def yield_words(survey: StressSurvey) -> Words:
    """Which part of the body yields first, and when."""
    table = yield_table(survey)
    return Words(yield_sentence(survey), tables=(("", table),) if table.cells else (), alarming=survey.yielding.yields)


def setting_rows(survey: StressSurvey) -> Rows:
    """What the stresses are those of, and where they were computed."""
    request, depths = survey.request, survey.depths
    rows = [("inside", "the body" if request.of == "body" else "the counter body")]
    rows.append(("friction coefficient", f"{request.friction:g}"))
    if request.friction:
        rows.append(
            ("direction of the shear traction on the body", f"{math.degrees(request.direction):g}° from x towards y")
        )
        effect = "changes the pressure (coupled)" if request.coupled else "does not change the pressure (uncoupled)"
        rows.append(("shear traction", effect))
    top, bottom = _length(float(depths[0])), _length(float(depths[-1]))
    rows.append(("planes", f"{depths.size} from {top} to {bottom}" if depths.size > 1 else f"1 at a depth of {top}"))
    return rows


def maxima_table(survey: StressSurvey) -> Table:
    """Largest stresses of each region, with their places; layers of one name are one."""
    cells: list[tuple[str, ...]] = []
    for regions, parts in _together(survey.maxima):
        von_mises, tension, shear = (
            max((getattr(part, name) for part in parts), key=_value) for name in ("von_mises", "tension", "shear")
        )
        rows = [
            ("von Mises", von_mises.value, von_mises),
            ("√J2", von_mises.value / math.sqrt(3.0), von_mises),
            ("tension σ1", tension.value, tension),
            ("shear (σ1 − σ3)/2", shear.value, shear),
        ]
        label = region_text(regions)
        cells += [(label, name, show(value, "Pa"), *_place(survey, peak)) for name, value, peak in rows]
    return Table(("Layer", "Largest stress", "Value", "x", "y", "Depth"), tuple(cells))


def interface_table(survey: StressSurvey) -> Table:
    """Largest shear and peel of each interface, with their places; those within a graded coating are left out."""
    cells: list[tuple[str, ...]] = []
    for item in survey.interfaces:
        if item.above == item.below:
            continue
        label = f"{item.above} / {item.below}, {show(item.shear.depth, 'm')}"
        peel = show(item.peel.value, "Pa") if item.peel.value > 0.0 else "none"
        cells.append((label, "shear", show(item.shear.value, "Pa"), *_place(survey, item.shear)[:2]))
        cells.append((label, "peel (tension)", peel, *_place(survey, item.peel)[:2]))
    return Table(("Interface, depth", "Largest stress", "Value", "x", "y"), tuple(cells))


def yield_table(survey: StressSurvey) -> Table:
    """Strength and load factor to first yield of each region."""
    cells = []
    for regions, parts in _together(survey.yielding.regions):
        known = [part for part in parts if not math.isnan(part.load_factor)]
        worst = min(known, key=lambda part: part.load_factor) if known else max(parts, key=lambda part: part.peak.value)
        strength = show(worst.limit.value, "Pa") + (f" (H/{TABOR:g})" if worst.limit.inferred else "")
        cells.append(
            (
                region_text(regions),
                show(worst.peak.value, "Pa"),
                strength if known else "not known",
                f"{worst.load_factor:.3g}" if known else "not known",
                _depth_text(worst.peak),
            )
        )
    name = survey.yielding.criterion.name
    return Table(("Layer", f"Largest {name} stress", "Yield stress", "Load factor", "Depth"), tuple(cells))


def strength_table(survey: StressSurvey) -> Table:
    """Largest tension, shear and peel over the strengths that were given for them."""
    given = survey.request.strengths
    wanted = [
        ("tension", given.tensile, [part.tension for part in survey.maxima]),
        ("shear of an interface", given.interface_shear, [item.shear for item in survey.interfaces]),
        ("peel of an interface", given.interface_peel, [item.peel for item in survey.interfaces]),
    ]
    cells = []
    for name, strength, peaks in wanted:
        if not math.isnan(strength) and peaks:
            worst = max(peaks, key=_value)
            ratio = max(worst.value, 0.0) / strength
            text = f"{ratio:.3g}: {'fails' if ratio >= 1.0 else 'holds'}"
            cells.append((name, show(max(worst.value, 0.0), "Pa"), show(strength, "Pa"), text, _depth_text(worst)))
    return Table(("Largest", "Value", "Strength", "Value / strength", "Depth"), tuple(cells))


def yield_sentence(survey: StressSurvey) -> str:
    """Which part of the body yields first, and when."""
    report, first = survey.yielding, survey.yielding.first
    if first is None:
        return "No strength of any part of the body is known, so yield cannot be assessed; give a hardness or yield stress."
    unknown = list(dict.fromkeys(part.region.name for part in report.regions if math.isnan(part.load_factor)))
    beside = f" The strength of {' and '.join(unknown)} is not known." if unknown else ""
    where = _where(first.peak)
    if report.yields:
        return (
            f"The body yields: {where}, the {report.criterion.name} stress is {1.0 / report.load_factor:.3g} times the "
            f"yield stress (load factor {report.load_factor:.3g}).{beside}"
        )
    return (
        f"No part of known strength yields. First would be {where}, at {report.load_factor:.3g} times these stresses "
        f"({report.criterion.name}).{beside}"
    )


def remarks(survey: StressSurvey) -> list[str]:
    """What to know about these stresses before using them."""
    found = [
        "The load factor multiplies the stresses of this contact. A rough contact grows with its load, so that its "
        "stresses rise more slowly than the load.",
        "Largest values are those on the planes that were computed; at the surface they are resolved no better than the "
        "pixels are.",
    ]
    if survey.result.plastic.any():
        found.append(
            "Pressures are limited by the hardness here, but the stresses are those of an elastic body under these "
            "pressures: where they pass the yield stress they say that it yields, not how large they really are."
        )
    return found


def region_text(regions: Sequence[Region]) -> str:
    """Name and depths of a region, or of several of one name."""
    first, last = regions[0], regions[-1]
    count = f" ({len(regions)} layers)" if len(regions) > 1 else ""
    if math.isinf(last.bottom):
        return f"{first.name}{count}, below {show(first.top, 'm')}" if first.top > 0.0 else f"{first.name}{count}"
    return f"{first.name}{count}, {_length(first.top)} to {_length(last.bottom)}"


def _together(parts: Iterable[Part]) -> list[tuple[list[Region], list[Part]]]:
    """Regions and what is known of them; neighbours of one name, as of a graded coating, together."""
    runs = groupby(parts, key=lambda part: part.region.name)
    lists = [list(run) for _, run in runs]
    return [([part.region for part in run], run) for run in lists]


def _length(value: float) -> str:
    return show(value, "m") if value > 0.0 else "0"


def _value(peak: Any) -> float:
    return float(peak.value)


def _place(survey: StressSurvey, peak: Peak) -> tuple[str, str, str]:
    """x and y as in figures, in the middle of a pixel, but on a grid of one row; depth."""
    grid = survey.result.problem.grid
    x, y = (
        show(at + 0.5 * step, "m") if n > 1 else "–"
        for at, step, n in zip((peak.x, peak.y), grid.spacing, grid.shape, strict=True)
    )
    return x, y, _depth_text(peak)


def _where(peak: Peak) -> str:
    """Place of a ``peak`` within a sentence."""
    name = peak.region.name
    if peak.side == "surface":
        return f"at the surface of {name}"
    face = {"above": " (its lower face)", "below": " (its upper face)"}.get(peak.side, "")
    return f"in {name} at a depth of {show(peak.depth, 'm')}{face}"


def _depth_text(peak: Peak) -> str:
    if peak.side == "surface":
        return "at the surface"
    face = {"above": ", lower face", "below": ", upper face"}.get(peak.side, "")
    return f"{show(peak.depth, 'm')}{face}"
