"""Dependence of roughness parameters on the size of the scan and on the sampling interval (Poon &
Bhushan 1995)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ..prepare.level import levelled
from ..surface import Origin, Surface
from .correlation import DROP_1E, DROP_TENTH, autocovariance, fractal_parameters
from .heights import height_parameters
from .moments import nayak_parameter
from .slopes import rms_profile_curvature, rms_profile_slope
from .summits import summit_statistics, summits

STUDIED = (
    "Sq",
    "Sp",
    "Sz",
    "m2_x",
    "m2_y",
    "m4_x",
    "m4_y",
    "alpha_x",
    "alpha_y",
    "beta_e_x",
    "beta_e_y",
    "beta_01_x",
    "beta_01_y",
    "dimension_x",
    "dimension_y",
    "summit_density",
    "summit_radius",
)
"""Quantities of a study, in SI units: heights, mean square slopes and curvatures, Nayak's
parameter, correlation lengths, fractal dimension, density (1/m²) and radius 1/<κ> (m) of the
summits."""

MODES = ("pick", "average")
"""Ways to coarsen a map: every n-th point is picked (which aliases), or blocks are averaged (which
removes variance)."""


@dataclass(frozen=True, eq=False)
class SamplingStudy:
    """Quantities of parts of one surface against their ``length`` (m): the scan size or the
    sampling interval.

    ``kind`` of the study and ``form`` removed from every part; ``length`` increasing; ``parts``
    number of parts for each length; ``mean`` and ``scatter`` (standard deviation over the parts) by
    name of the quantity, see ``STUDIED``, NaN where it is not defined on any part.
    """

    kind: str
    form: str
    length: RealArray
    parts: RealArray
    mean: dict[str, RealArray]
    scatter: dict[str, RealArray]
    citation_keys: ClassVar[tuple[str, ...]] = ("Poon1995",)

    def independent_range(self, name: str, tolerance: float = 0.05) -> tuple[float, float]:
        """Longest range of lengths (m) over which the means of ``name`` differ by ``tolerance`` at
        most.

        Two NaN if there is none: the quantity then depends on the scan at every length.
        Raises InputError if the name is unknown.
        """
        values = self.mean[require.one_of(name, self.mean, "quantity of a study")]
        best = (0, 0)
        for start in range(values.size):
            end = start
            while end + 1 < values.size and _spread(values[start : end + 2]) <= tolerance:
                end += 1
            best = max(best, (start, end), key=lambda span: span[1] - span[0])
        if best[0] == best[1]:
            return math.nan, math.nan
        return float(self.length[best[0]]), float(self.length[best[1]])


def scan_size_study(surface: Surface, *, form: str = "plane", smallest: int = 16, most: int = 64) -> SamplingStudy:
    """Study of windows of size L/2^k at all positions that do not overlap, at the sampling interval
    of the map.

    Windows of which more than half is missing are left out.

    Raises InputError if the form is unknown or the map has fewer points than ``smallest`` along a
    side.

    Parameters
    ----------
    surface
        Measured surface; missing points are left out.
    form
        Form removed from every window: ``mean``, ``plane`` or ``quadratic``.
    smallest
        Least number of points along a side of a window.
    most
        Largest number of windows of one size; if there are more, evenly spread ones are taken.
    """
    least = require.integer(smallest, 4, "least number of points along a side")
    sides = _halvings(min(surface.shape), least)
    origin = Origin(surface.origin.source)
    lengths, levels = [], []
    for power in reversed(sides):
        shape = tuple(n >> power for n in surface.shape)
        lengths.append(math.sqrt(shape[0] * surface.dx * shape[1] * surface.dy))
        along_x, along_y = (range(0, n - width + 1, width) for n, width in zip(surface.shape, shape, strict=True))
        periodic, level = surface.periodic and shape == surface.shape, []
        offsets = [(i, j) for i in along_x for j in along_y]
        for i, j in (offsets[round(k)] for k in np.linspace(0, len(offsets) - 1, min(most, len(offsets)))):
            part = (slice(i, i + shape[0]), slice(j, j + shape[1]))
            if np.count_nonzero(surface.mask[part]) <= 0.5 * shape[0] * shape[1]:
                window = Surface(surface.heights[part], surface.dx, surface.dy, periodic=periodic, origin=origin)
                level.append(_measured(window, form))
        levels.append(level)
    return _study("scan size", form, lengths, levels)


def sampling_interval_study(
    surface: Surface, *, mode: str = "pick", form: str = "plane", smallest: int = 16, most: int = 16
) -> SamplingStudy:
    """Study of the map at 1, 2, 4, … times its sampling interval, over its full size.

    Raises InputError if the mode or form is unknown or the map has fewer points than ``smallest``
    along a side.

    Parameters
    ----------
    surface
        Measured surface; an average over a block with a missing point is missing.
    mode
        ``pick`` takes every n-th point, with all offsets; ``average`` takes the means of blocks of
        n x n points.
    form
        Form removed from every map: ``mean``, ``plane`` or ``quadratic``.
    smallest
        Least number of points along a side.
    most
        Largest number of offsets; if there are more, evenly spread ones are taken.
    """
    require.one_of(mode, MODES, "mode of a sampling-interval study")
    least = require.integer(smallest, 4, "least number of points along a side")
    lengths, levels = [], []
    for power in _halvings(min(surface.shape), least):
        step = 2**power
        lengths.append(math.sqrt(surface.grid.pixel_area) * step)
        periodic = surface.periodic and all(n % step == 0 for n in surface.shape)
        if mode == "pick":
            offsets = [divmod(round(k), step) for k in np.linspace(0, step**2 - 1, min(most, step**2))]
            parts = [surface.heights[i::step, j::step] for i, j in offsets]
        else:
            nx, ny = (n // step for n in surface.shape)
            whole = surface.heights[: nx * step, : ny * step].astype(np.float64, copy=False)
            parts = [whole.reshape(nx, step, ny, step).mean(axis=(1, 3))]
        dx, dy, origin = step * surface.dx, step * surface.dy, Origin(surface.origin.source)
        maps = (Surface(part, dx, dy, periodic=periodic, origin=origin) for part in parts)
        levels.append([_measured(map_, form) for map_ in maps])
    return _study(f"sampling interval, {mode}", form, lengths, levels)


def _halvings(points: int, least: int) -> list[int]:
    if points < least:
        raise InputError(f"surface must have at least {least} points along each side for a study, but has {points}.")
    return list(range(int(math.log2(points / least)) + 1))


def _measured(part: Surface, form: str) -> dict[str, float]:
    flat = levelled(part, form)
    heights, covariance = height_parameters(flat), autocovariance(flat)
    values = {"Sq": heights.Sq, "Sp": heights.Sp, "Sz": heights.Sz}
    for axis in "xy":
        m2 = _or_nan(partial(rms_profile_slope, flat, axis=axis)) ** 2
        m4 = _or_nan(partial(rms_profile_curvature, flat, axis=axis)) ** 2
        values |= {f"m2_{axis}": m2, f"m4_{axis}": m4, f"alpha_{axis}": nayak_parameter(heights.Sq**2, m2, m4)}
        values[f"beta_e_{axis}"] = covariance.correlation_length(DROP_1E, axis=axis)
        values[f"beta_01_{axis}"] = covariance.correlation_length(DROP_TENTH, axis=axis)
        values[f"dimension_{axis}"] = _or_nan(partial(_dimension, flat, axis))
    found = summit_statistics(summits(flat))
    return values | {"summit_density": found.density, "summit_radius": found.radius}


def _dimension(surface: Surface, axis: str) -> float:
    return fractal_parameters(surface, axis=axis).dimension


def _or_nan(measure: Callable[[], float]) -> float:
    try:
        return measure()
    except InputError:  # undefined on a part with too few valid points
        return math.nan


def _study(kind: str, form: str, lengths: list[float], levels: list[list[dict[str, float]]]) -> SamplingStudy:
    mean, scatter = {}, {}
    for name in STUDIED:
        columns = [np.array([values[name] for values in level]) for level in levels]
        defined = [column[np.isfinite(column)] for column in columns]
        mean[name] = np.array([column.mean() if column.size else math.nan for column in defined])
        scatter[name] = np.array([column.std(ddof=1) if column.size > 1 else math.nan for column in defined])
    parts = np.array([float(len(level)) for level in levels])
    return SamplingStudy(kind, form, np.array(lengths), parts, mean, scatter)


def _spread(values: RealArray) -> float:
    """Largest relative difference of ``values``; infinite where one is not defined."""
    if not np.all(np.isfinite(values)):
        return math.inf
    return float((values.max() - values.min()) / max(abs(values.max()), abs(values.min()), np.finfo(float).tiny))
