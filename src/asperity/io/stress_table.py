"""Largest stresses of a body as a CSV table for other programs."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..stress.field import Peak
from ..stress.survey import StressSurvey
from .atomic import atomic_file

HEADINGS = ("part", "name", "top", "bottom", "quantity", "value", "unit", "x", "y", "depth", "side")
"""Columns; lengths in m, stresses in Pa, x and y those of nodes."""


def export_stress_csv(survey: StressSurvey, path: str | Path, *, overwrite: bool = False) -> None:
    """Write the maxima, interface tractions and load factors of ``survey`` to ``path``, one row each, SI, exact.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    with atomic_file(path, overwrite=overwrite) as partial, partial.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(HEADINGS)
        writer.writerows(_rows(survey))


def _rows(survey: StressSurvey) -> Iterator[tuple[Any, ...]]:
    for part in survey.maxima:
        region = ("layer", part.region.name, part.region.top, part.region.bottom)
        yield (*region, "max_von_mises", *_at(part.von_mises))
        yield (*region, "max_sqrt_J2", part.von_mises.value / math.sqrt(3.0), *_at(part.von_mises)[1:])
        yield (*region, "max_principal", *_at(part.tension))
        yield (*region, "max_shear", *_at(part.shear))
    for item in survey.interfaces:
        pair = ("interface", f"{item.above}/{item.below}", item.shear.depth, item.shear.depth)
        yield (*pair, "max_shear", *_at(item.shear))
        yield (*pair, "max_peel", *_at(item.peel))
    for state in survey.yielding.regions:
        region = ("layer", state.region.name, state.region.top, state.region.bottom)
        place = _at(state.peak)[2:]
        yield (*region, "yield_stress", state.limit.value, "Pa", "", "", "", "")
        yield (*region, "load_factor_to_yield", state.load_factor, "1", *place)
        yield (*region, "yielded_volume", state.yielded_volume, "m**3", "", "", "", "")


def _at(peak: Peak) -> tuple[Any, ...]:
    return peak.value, "Pa", peak.x, peak.y, peak.depth, peak.side
