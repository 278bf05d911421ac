"""The structure function, and slopes and curvatures as functions of the scale over which they are taken."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ..surface import Surface
from .differences import axis_index, increments, mean_square, second_differences


@dataclass(frozen=True, eq=False)
class StructureFunction:
    """S(τ) = <[h(x + τ) - h(x)]²> along ``axis``: ``lag`` τ in m, ``value`` S in m²."""

    axis: str
    lag: RealArray
    value: RealArray


@dataclass(frozen=True, eq=False)
class ScaleDependence:
    """Slope and curvature of profiles along ``axis`` over stencils of total length ℓ (Sanner et al. 2022).

    ``slope_length`` (m) and ``slope`` = <[(h(x+ℓ) - h(x))/ℓ]²>^½; ``curvature_length`` (m), ``curvature`` (1/m) =
    <[(h(x+ℓ/2) - 2h(x) + h(x-ℓ/2))/(ℓ/2)²]²>^½ and ``sharpest`` (1/m), the least of these second derivatives, negative
    at peaks. At the shortest stencils they are the finite-difference slope and curvature of the map.
    """

    axis: str
    slope_length: RealArray
    slope: RealArray
    curvature_length: RealArray
    curvature: RealArray
    sharpest: RealArray
    citation_keys: ClassVar[tuple[str, ...]] = ("Sanner2022",)


def mean_square_increment(surface: Surface, lag: tuple[int, int]) -> float:
    """S in m² at the ``lag`` (k, l) in pixels, of either sign: mean over all valid pairs; a periodic surface wraps.

    Raises
    ------
    InputError
        If there is no valid pair.
    """
    return mean_square(increments(surface, lag), "structure function")


def structure_function(surface: Surface, *, axis: str = "x", lags: Sequence[int] | None = None) -> StructureFunction:
    """Structure function of the profiles along ``axis``, averaged over all lines; needs no mean and no filling.

    Parameters
    ----------
    surface
        Surface; a tilt adds (slope τ)², so level it first.
    axis
        ``x`` or ``y``.
    lags
        Whole numbers of pixels >= 1; by default geometrically spaced, five per factor of two, up to half the map.

    Raises
    ------
    InputError
        If a lag has no valid pair or is not a whole number >= 1.
    """
    number = axis_index(axis)
    steps = geometric_lags(surface.shape[number] // 2) if lags is None else tuple(lags)
    for step in steps:
        require.integer(step, 1, "lag of a structure function (pixels)")
    values = [mean_square_increment(surface, (step, 0) if number == 0 else (0, step)) for step in steps]
    return StructureFunction(axis, np.array(steps) * surface.grid.spacing[number], np.array(values))


def scale_dependence(surface: Surface, *, axis: str = "x", steps: Sequence[int] | None = None) -> ScaleDependence:
    """Scale-dependent slope and curvature of ``surface`` along ``axis``.

    ``steps``: distances between neighbouring points of the stencils in pixels; by default geometric, five per factor
    of two, up to a quarter of the map. Missing points need no filling; a periodic surface wraps.

    Raises
    ------
    InputError
        If the map is too small for a stencil or no stencil is valid.
    """
    number = axis_index(axis)
    chosen = geometric_lags(surface.shape[number] // 4) if steps is None else tuple(steps)
    structure = structure_function(surface, axis=axis, lags=chosen)
    lengths, root_means, least = structure.lag, [], []
    for step in chosen:
        second = second_differences(surface, axis, step) / (step * surface.grid.spacing[number]) ** 2
        root_means.append(math.sqrt(mean_square(second, "curvature")))
        least.append(float(np.nanmin(second)))
    return ScaleDependence(
        axis, lengths, np.sqrt(structure.value) / lengths, 2.0 * lengths, np.array(root_means), np.array(least)
    )


def tip_cutoff(dependence: ScaleDependence, tip_radius: float, *, factor: float = 0.5) -> float:
    """Stencil length in m below which a tip of ``tip_radius`` (m) may have shaped the map; discard shorter waves.

    It is where the least scale-dependent second derivative reaches -``factor``/``tip_radius``, interpolated between
    the stencils (Sanner et al. 2022, eq. 10, which found the factor 1/2 empirically). 0 if the sharpest peak is
    blunter than that at every length, infinity if sharper at every length.

    Raises
    ------
    InputError
        If the radius or the factor is not positive, or there is no stencil.
    """
    require.positive(tip_radius, "radius of the tip (m)")
    require.positive(factor, "factor of the tip criterion")
    if dependence.sharpest.size == 0:
        raise InputError("scale dependence must hold at least one stencil for a tip cut-off, but is empty.")
    limit = -factor / tip_radius
    sharper = np.flatnonzero(dependence.sharpest < limit)
    if sharper.size == 0:
        return 0.0
    last = int(sharper[-1])
    if last + 1 == dependence.sharpest.size:
        return math.inf
    inner, outer = dependence.sharpest[last], dependence.sharpest[last + 1]
    share = (limit - inner) / (outer - inner)
    lengths = dependence.curvature_length
    return float(lengths[last] + share * (lengths[last + 1] - lengths[last]))


def geometric_lags(largest: int, per_octave: int = 5) -> tuple[int, ...]:
    """Whole numbers from 1 to ``largest``, ``per_octave`` to a factor of two where there are so many; 1 at least."""
    count = 1 + math.ceil(per_octave * math.log2(max(1, largest)))
    spaced = np.rint(np.geomspace(1, max(1, largest), count)).astype(int)
    return tuple(int(lag) for lag in np.unique(spaced))
