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
from .differences import axis_index, increments, mean_square
from .stencils import stencil_sums


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
    values = [stencil_sums(surface, axis, 1, step).square for step in steps]
    return StructureFunction(axis, np.array(steps) * surface.grid.spacing[number], np.array(values))


def scale_dependence(
    surface: Surface,
    *,
    axis: str = "x",
    steps: Sequence[int] | None = None,
    structure: StructureFunction | None = None,
) -> ScaleDependence:
    """Scale-dependent slope and curvature of ``surface`` along ``axis``.

    Parameters
    ----------
    surface
        Surface; missing points are left out, a periodic surface wraps.
    axis
        ``x`` or ``y``.
    steps
        Distances between neighbouring points of the stencils in pixels; by default geometric, five per factor of two,
        up to a quarter of the map.
    structure
        Structure function along the axis, from which the slopes follow, if it is known already.

    Raises
    ------
    InputError
        If the map is too small for a stencil or no stencil is valid.
    """
    number = axis_index(axis)
    chosen = geometric_lags(surface.shape[number] // 4) if steps is None else tuple(steps)
    known = structure_function(surface, axis=axis, lags=chosen) if structure is None else structure
    spacing = surface.grid.spacing[number]
    sums = [stencil_sums(surface, axis, 2, step) for step in chosen]
    areas = (spacing * np.array(chosen)) ** 2
    return ScaleDependence(
        axis,
        slope_length=known.lag,
        slope=np.sqrt(known.value) / known.lag,
        curvature_length=2.0 * spacing * np.array(chosen),
        curvature=np.sqrt([found.square for found in sums]) / areas,
        sharpest=np.array([found.least for found in sums]) / areas,
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
    """Whole numbers up to ``largest`` (1 at least), ``per_octave`` to a factor of two where there are so many.

    The same numbers for every ``largest``, so that curves of different reach share their points.
    """
    count = 1 + math.ceil(per_octave * math.log2(max(1, largest)))
    spaced = np.unique(np.rint(2.0 ** (np.arange(count) / per_octave)).astype(int))
    return tuple(int(lag) for lag in spaced if lag <= max(1, largest))
