"""A comparison as files: the labelled dataset as NetCDF-4, and a table with a row for every curve and load as CSV."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..core.arrays import BoolArray, RealArray
from ..io.atomic import atomic_file
from ..io.tree import node_of, write_tree
from .comparison import Comparison

NUMERICAL = "numerical"
"""Name of the numerical solution among the curves."""

COLUMNS = (
    "curve",
    "pressure (Pa)",
    "relative_pressure",
    "area_fraction",
    "area_fraction_pixels",
    "kappa",
    "slope",
    "gap (m)",
    "contact_density (1/m^2)",
    "valid",
    "area_fraction_deviation",
    "contact_density_deviation",
    "gap_deviation (rms heights)",
    "gap_valid",
    "contact_density_valid",
)
"""Head of the table."""


def save_comparison(comparison: Comparison, path: str | Path, *, overwrite: bool = False) -> None:
    """Write the dataset of ``comparison`` to the NetCDF-4 file ``path``, which ``open_tree`` reads.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    write_tree(node_of(comparison.dataset), path, overwrite=overwrite)


def export_comparison_csv(comparison: Comparison, path: str | Path, *, overwrite: bool = False) -> None:
    """Write one row for every curve and load of ``comparison`` to ``path``, SI, exact; what is not defined is empty.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    with atomic_file(path, overwrite=overwrite) as partial, partial.open("w", newline="", encoding="utf-8") as text:
        writer = csv.writer(text)
        writer.writerow(COLUMNS)
        writer.writerows(_rows(comparison))


def _rows(comparison: Comparison) -> Iterator[tuple[object, ...]]:
    nothing: RealArray = np.full_like(comparison.pressures, np.nan)
    if comparison.numerical is not None:
        solved = comparison.numerical
        areas = (solved.area_fraction_corrected, solved.area_fraction)
        rest: tuple[RealArray | BoolArray, ...] = (
            solved.mean_gap,
            solved.contact_density,
            np.isfinite(solved.mean_gap),
            *(3 * [nothing]),
            *(2 * [np.isfinite(solved.mean_gap)]),
        )
        yield from _curve_rows(comparison, NUMERICAL, areas, rest)
    for curve in comparison.curves:
        deviations = [comparison.deviation(curve.name, name) for name in ("area_fraction", "contact_density", "gap")]
        areas = (curve.prediction.area_fraction, nothing)
        rest = (
            curve.gap,
            curve.prediction.contact_density,
            curve.valid,
            *deviations,
            curve.valid_for["gap"],
            curve.valid_for["contact_density"],
        )
        yield from _curve_rows(comparison, curve.name, areas, rest)


def _curve_rows(
    comparison: Comparison,
    name: str,
    areas: tuple[RealArray, RealArray],
    rest: tuple[RealArray | BoolArray, ...],
) -> Iterator[tuple[object, ...]]:
    area, p = areas[0], comparison.pressures
    columns = (p, p / comparison.E_star, *areas, comparison.kappa(area), comparison.slope(area), *rest)
    for row in zip(*columns, strict=True):
        yield (name, *(_cell(value.item()) for value in row))


def _cell(value: float | bool) -> float | bool | str:
    return "" if isinstance(value, float) and math.isnan(value) else value
