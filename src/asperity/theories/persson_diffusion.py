"""Persson's diffusion of the pressure, solved by finite differences from one magnification to the next."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from .isotropic_spectrum import IsotropicSpectrum

_REACH = 8.0  # standard deviations of the pressure beyond the mean at which the density is zero: exp(-32)
_DAMPED = 2  # first steps that are halved and implicit (Rannacher 1984), or the delta they start from rings


@dataclass(frozen=True, eq=False)
class PressureHistory:
    """Density of the pressure while shorter and shorter waves are taken into account.

    Attributes
    ----------
    wavenumber
        Shortest wave so far, q in rad/m, (m,), ascending.
    pressure
        Local pressure in Pa, (n,), from zero.
    density
        P in 1/Pa, (m, n), zero at zero pressure.
    """

    wavenumber: RealArray
    pressure: RealArray
    density: RealArray
    citation_keys: ClassVar[tuple[str, ...]] = ("Persson2001", "Persson2002", "Rannacher1984")

    @property
    def area_fraction(self) -> RealArray:
        """∫ P dp at each wavenumber, (m,)."""
        return np.asarray(self.density.sum(axis=1) * self.pressure[1])

    @property
    def mean_pressure(self) -> RealArray:
        """∫ p P dp in Pa at each wavenumber, (m,): the nominal pressure, whatever the roughness."""
        return np.asarray(self.density @ self.pressure * self.pressure[1])


def diffused_pressure(
    spectrum: IsotropicSpectrum,
    E_star: float,
    pressure: float,
    *,
    points: int = 1000,
    steps: int = 200,
) -> PressureHistory:
    """Solve ∂P/∂ζ = f(ζ) ∂²P/∂p², P = 0 at p = 0, from P = δ(p - p_a) without roughness, along the spectrum.

    f dζ = (E*²/16π) q³ C dq is half the growth of the variance of the pressure in full contact, so equal steps of the
    integral of q³ C are equal steps of time. Crank-Nicolson on ``points`` pressures after a damped start; the error
    falls with the square of both numbers. It needs no image source, and so checks the closed form of ``Persson``.

    Parameters
    ----------
    spectrum
        Spectrum of the composite surface.
    E_star
        Contact modulus E* in Pa, > 0.
    pressure
        Nominal pressure p_a in Pa, > 0.
    points
        Number of intervals of pressure, at least 20, between zero and beyond the last pressure that occurs.
    steps
        Number of steps of equal variance, at least 4.

    Raises
    ------
    InputError
        If a number is out of its range.
    """
    from scipy.linalg import solve_banded

    modulus = require.positive(E_star, "contact modulus E* (Pa)")
    nominal = require.positive(pressure, "nominal pressure (Pa)")
    count = require.integer(points, 20, "number of pressures")
    rounds = require.integer(steps, 4, "number of steps")
    variance = (0.5 * modulus * spectrum.rms_slope) ** 2
    grid = _pressure_grid(nominal, nominal + _REACH * math.sqrt(variance), count)
    density = _delta(grid, nominal)
    kept = [density]
    diffusion = 0.5 * variance / rounds / grid[1] ** 2  # of one step, in intervals²
    for number in range(rounds):
        implicit = number < _DAMPED
        for _ in range(2 if implicit else 1):
            share, step = (1.0, 0.5 * diffusion) if implicit else (0.5, diffusion)
            right = density[1:-1] + (1.0 - share) * step * np.diff(density, 2)
            density = np.zeros_like(density)
            density[1:-1] = solve_banded((1, 1), _bands(right.size, share * step), right)
        kept.append(density)
    return PressureHistory(_wavenumbers(spectrum, rounds), grid, np.stack(kept))


def _pressure_grid(nominal: float, highest: float, count: int) -> RealArray:
    """Equal pressures from zero to ``highest`` or a little beyond, one of them the nominal pressure if it is not tiny."""
    interval = highest / count
    if nominal >= interval:
        interval = nominal / math.floor(nominal / interval)
    grid: RealArray = interval * np.arange(math.ceil(highest / interval) + 1)
    return grid


def _delta(grid: RealArray, nominal: float) -> RealArray:
    """Density of one at ``nominal``, shared between its neighbours on the grid so that its mean is right."""
    place = nominal / grid[1]
    below = min(round(place) if abs(place - round(place)) < 1e-6 else int(place), grid.size - 2)
    density = np.zeros_like(grid)
    density[below + 1] = max(0.0, place - below) / grid[1]
    density[below] = 1.0 / grid[1] - density[below + 1] if below > 0 else 0.0
    return density


def _bands(size: int, weight: float) -> RealArray:
    """Bands of 1 - weight × second difference, for ``solve_banded``."""
    bands = np.empty((3, size))
    bands[0], bands[1], bands[2] = -weight, 1.0 + 2.0 * weight, -weight
    return bands


def _wavenumbers(spectrum: IsotropicSpectrum, steps: int) -> RealArray:
    """Wavenumbers (steps + 1,) at which the integral of q³ C has grown by equal parts."""
    from scipy.optimize import brentq

    whole, last = spectrum.moment(3), float(spectrum.span[-1])

    def lacking(span: float, part: float) -> float:
        return float(spectrum.partial_moment(3, np.array([span]))[0]) - part * whole

    inner = [brentq(lacking, 0.0, last, args=(number / steps,), xtol=1e-14) for number in range(1, steps)]
    spans = np.array([0.0, *inner, last])
    values: RealArray = np.asarray(spectrum.wavenumber)[0] * np.exp(spans)
    return values
