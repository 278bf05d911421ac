"""Fractal dimension and amplitude of the profiles of a surface, from the structure function.

S(τ) = C η^(2D-3) τ^(4-2D) (Ganti & Bhushan 1995) with the resolution η of the map; the Weierstrass-Mandelbrot profile of
Majumdar & Bhushan (1990) has S = B(D) G^(2(D-1)) τ^(4-2D)/ln γ, which turns C into G.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core import require
from ...core.errors import InputError
from ..surface import Surface
from .differences import axis_index
from .heights import rms_height
from .structure import StructureFunction, geometric_lags, structure_function

GAMMA = 1.5
"""Ratio γ of neighbouring frequencies of the Weierstrass-Mandelbrot profile that defines G (Majumdar & Bhushan 1990)."""

_FIRST_LAGS = (4, 2)  # pixels; below four the instrument and interpolation have a share, below two they rule
_MARGIN = 0.04  # accuracy of D on sampled Weierstrass-Mandelbrot profiles; smooth profiles give 1 within it
_FEWEST = 3  # lags of a line with a residual


@dataclass(frozen=True)
class FractalParameters:
    """Fit of a power law to the structure function along ``axis``.

    ``dimension`` D of the profile (that of the surface is D + 1) and ``dimension_error``, the standard error of the
    straight line: the lags are correlated, so it tells of curvature rather than of sampling; ``amplitude`` C and
    ``resolution`` η (= pixel) in m; ``roughness`` G in m for γ = 1.5, NaN if not self-affine; ``first_lag``,
    ``last_lag`` of the fit in m; ``residual`` rms of ln S about the line.
    """

    axis: str
    dimension: float
    dimension_error: float
    amplitude: float
    resolution: float
    roughness: float
    first_lag: float
    last_lag: float
    residual: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1998", "Ganti1995", "Majumdar1990")

    @property
    def hurst(self) -> float:
        """Hurst exponent 2 - D of the fitted range."""
        return 2.0 - self.dimension

    @property
    def self_affine(self) -> bool:
        """Whether D lies clearly between 1 and 2, without which the profile is no fractal in the fitted range."""
        return _is_fractal(self.dimension)


def fractal_parameters(
    surface: Surface,
    *,
    axis: str = "x",
    lags: Sequence[int] | None = None,
    structure: StructureFunction | None = None,
) -> FractalParameters:
    """Fit the structure function of ``surface`` along ``axis`` by a power law.

    Parameters
    ----------
    surface
        Levelled surface; missing points are left out.
    axis
        ``x`` or ``y``.
    lags
        Lags of the fit in pixels; by default geometrically spaced from 4 pixels (2 if fewer than three would remain) to
        a tenth of the map, or to where the structure function reaches the mean square height, half of its limit.
    structure
        Structure function along the axis, if it is known already; its lags in the default range are fitted.

    Raises
    ------
    InputError
        If fewer than three lags remain, or the surface is flat.
    """
    number = axis_index(axis)
    if lags is not None:
        return fitted_fractal(structure_function(surface, axis=axis, lags=lags), surface.grid.spacing[number])
    spacing, points = surface.grid.spacing[number], surface.shape[number]
    if structure is None:
        structure = structure_function(surface, axis=axis, lags=geometric_lags(points // 10))
    pixels = structure.lag / spacing
    below = int(np.argmax(np.append(structure.value > rms_height(surface) ** 2, True)))
    upper = (pixels < points // 10 + 0.5) & (np.arange(pixels.size) < below)
    ranges = [upper & (pixels > first - 0.5) for first in _FIRST_LAGS]
    part = next((chosen for chosen in ranges if np.count_nonzero(chosen) >= _FEWEST), ranges[-1])
    return fitted_fractal(StructureFunction(axis, structure.lag[part], structure.value[part]), spacing)


def fitted_fractal(curve: StructureFunction, resolution: float) -> FractalParameters:
    """Least-squares line through ln S over ln τ of ``curve``; ``resolution`` η in m.

    Raises
    ------
    InputError
        If the curve has fewer than three lags or is zero somewhere.
    """
    require.positive(resolution, "resolution (m)")
    if curve.lag.size < _FEWEST or not np.all(curve.value > 0.0):
        raise InputError(
            f"structure function must be positive at three lags or more for a fractal dimension, but has only {curve.lag.size} "
            f"along {curve.axis} between {_FIRST_LAGS[-1]} pixels and the correlation length. Name the lags, or use a finer map."
        )
    x, y = np.log(curve.lag / resolution), np.log(curve.value)
    centred = x - x.mean()
    slope = float(centred @ y / (centred @ centred))
    rest = y - y.mean() - slope * centred
    square = float(rest @ rest)
    error = math.sqrt(square / (x.size - 2) / float(centred @ centred))
    dimension = 0.5 * (4.0 - slope)
    # S = C η^(2D-3) τ^(4-2D) = C η (τ/η)^(4-2D)
    amplitude = math.exp(float(y.mean()) - slope * float(x.mean())) / resolution
    return FractalParameters(
        curve.axis,
        dimension=dimension,
        dimension_error=0.5 * error,
        amplitude=amplitude,
        resolution=resolution,
        roughness=fractal_roughness(dimension, amplitude, resolution) if _is_fractal(dimension) else math.nan,
        first_lag=float(curve.lag[0]),
        last_lag=float(curve.lag[-1]),
        residual=math.sqrt(square / x.size),
    )


def structure_coefficient(dimension: float) -> float:
    """B(D) = π (2π)^(4-2D)/[2 Γ(5-2D) sin π(2-D)], the factor of S = B G^(2(D-1)) τ^(4-2D)/ln γ.

    For a profile of frequencies γ^n in cycles per length; papers that count them in radians lack (2π)^(4-2D).

    Raises
    ------
    InputError
        If not 1 < ``dimension`` < 2.
    """
    require.between(dimension, 1.0, 2.0, "fractal dimension of a profile")
    power = 4.0 - 2.0 * dimension
    return (
        math.pi
        * math.pow(2.0 * math.pi, power)
        / (2.0 * math.gamma(1.0 + power) * math.sin(math.pi * (2.0 - dimension)))
    )


def spectrum_coefficient(dimension: float) -> float:
    """c1/C = Γ(5-2D) sin[π(2-D)]/2π of the two-sided spectrum P = c1 η^(2D-3)/ω^(5-2D), ω in rad/m.

    Source: Ganti & Bhushan (1995); Bhushan (1998), eq. 33b, whose printed denominator is incomplete.

    Raises
    ------
    InputError
        If not 1 < ``dimension`` < 2.
    """
    require.between(dimension, 1.0, 2.0, "fractal dimension of a profile")
    return math.gamma(5.0 - 2.0 * dimension) * math.sin(math.pi * (2.0 - dimension)) / (2.0 * math.pi)


def fractal_roughness(dimension: float, amplitude: float, resolution: float, gamma: float = GAMMA) -> float:
    """G in m from C η^(2D-3) = B(D) G^(2(D-1))/ln γ; NaN unless 1 < D < 2."""
    if not 1.0 < dimension < 2.0:
        return math.nan
    # in logarithms: G of a smooth surface underflows
    log_power = math.log(amplitude) + (2.0 * dimension - 3.0) * math.log(resolution)
    log_power += math.log(math.log(gamma) / structure_coefficient(dimension))
    return math.exp(log_power / (2.0 * (dimension - 1.0)))


def _is_fractal(dimension: float) -> bool:
    return 1.0 + _MARGIN < dimension < 2.0 - _MARGIN
