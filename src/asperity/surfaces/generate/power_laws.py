"""Isotropic spectra made of a plateau and power laws: the shape, its integrals and its level on a
grid."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Annotated, TypeAlias

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.parameters import Declared
from ...core.spectral import mode_sum, multiplicity
from ...core.units import show
from ...core.values import Length, Positive, Psd

# How the amplitude of a spectrum is given: alternatives, of which a spectrum takes one.


@dataclass(frozen=True)
class RmsHeight(Declared):
    """Amplitude of a spectrum given by the rms height (m) of the surface, about its mean."""

    value: Annotated[Length, "rms height"]


@dataclass(frozen=True)
class RmsSlope(Declared):
    """Amplitude of a spectrum given by the rms gradient sqrt(<|∇h|²>) of the surface (spectral,
    dimensionless)."""

    value: Annotated[Positive, "rms slope; one of rms height, rms slope and plateau is given"]


@dataclass(frozen=True)
class PlateauPSD(Declared):
    """Amplitude of a spectrum given by its plateau C0 (m⁴)."""

    value: Annotated[Psd, "plateau C0 of the spectrum"]


Amplitude: TypeAlias = RmsHeight | RmsSlope | PlateauPSD


def require_amplitude(amplitude: object, what: str) -> None:
    """Raise InputError for what is not an ``Amplitude``; ``what`` names the spectrum."""
    if not isinstance(amplitude, (RmsHeight, RmsSlope, PlateauPSD)):
        raise InputError(
            f"amplitude of a {what} spectrum must be an RmsHeight, RmsSlope or PlateauPSD, "
            f"but is {amplitude!r}. Write for example RmsHeight(1e-9)."
        )


def amplitude_text(amplitude: Amplitude) -> str:
    """Words and number of ``amplitude`` for the history of a surface."""
    if isinstance(amplitude, RmsHeight):
        return f"rms height {show(amplitude.value, 'm')}"
    name, unit = ("rms slope", "") if isinstance(amplitude, RmsSlope) else ("plateau", " m^4")
    return f"{name} {amplitude.value:.4g}{unit}"


# Sums over the modes of a periodic grid.


def mean_square(grid: Grid, psd: RealArray) -> float:
    """Mean square height in m² of the spectrum C on the modes of ``grid`` in m⁴.

    Raises InputError if it is zero.
    """
    square = mode_sum(grid, psd)
    if not square > 0.0:
        raise InputError("spectrum of a random surface must be positive at some mode, but is zero on this grid.")
    return square


_ROUNDING = 1e-9  # relative slack on a cut-off wavenumber, so that a mode exactly on it is kept


@dataclass(frozen=True)
class PowerLaws:
    """C(q)/C0: 1 up to the first of ``bends``, then falling as q to the power -``exponents[i]``
    beyond bend i.

    Zero for q < ``low`` and q > ``high``, and at q = 0; wavenumbers in rad/m, bends in ascending
    order.
    """

    bends: tuple[float, ...]
    exponents: tuple[float, ...]
    low: float
    high: float

    def relative(self, q: RealArray) -> RealArray:
        """C/C0 at the wavenumbers ``q``, any shape."""
        inside = (q > 0.0) & (q >= self.low * (1.0 - _ROUNDING)) & (q <= self.high * (1.0 + _ROUNDING))
        values = np.array(inside, dtype=np.float64)
        before = 0.0
        for bend, exponent in zip(self.bends, self.exponents, strict=True):
            # only the inside beyond the bend takes the power, the slow part on large grids
            beyond = inside & (q > bend)
            values[beyond] *= (q[beyond] / bend) ** (before - exponent)
            before = exponent
        return values

    def integral(self, power: float) -> float:
        """∫ q^power C/C0 dq from ``low`` to ``high``; infinite where it diverges."""
        edges, level, total = [0.0, *self.bends, math.inf], 1.0, 0.0
        for number, exponent in enumerate((0.0, *self.exponents)):
            start, end = edges[number], edges[number + 1]
            low, high = max(self.low, start), min(self.high, end)
            scale = start if start > 0.0 else end
            if high > low:  # ∫ x^p dx from a to b; infinite where it diverges
                p, a, b = power - exponent, low / scale, high / scale
                if p == -1.0:
                    part = math.inf if a == 0.0 or math.isinf(b) else math.log(b / a)
                elif (p < -1.0 and a == 0.0) or (p > -1.0 and math.isinf(b)):
                    part = math.inf
                else:
                    upper = 0.0 if math.isinf(b) else b ** (p + 1.0)
                    part = (upper - (0.0 if a == 0.0 else a ** (p + 1.0))) / (p + 1.0)
                total += level * scale ** (power + 1.0) * part
            if 0 < number < len(self.bends):
                level *= (end / start) ** -exponent
        return total


def lattice_psd(law: PowerLaws, amplitude: Amplitude, grid: Grid) -> RealArray:
    """C in m⁴ on the modes of ``grid``, shape (nx, ny // 2 + 1): ``law`` at the level that meets
    ``amplitude`` there.

    Raises InputError if the grid cannot resolve the shortest wavelength or holds no mode of the
    spectrum.
    """
    relative = law.relative(grid.wavenumber())
    relative *= lattice_level(law, amplitude, grid, [(slice(None), relative)])
    return relative


def lattice_level(law: PowerLaws, amplitude: Amplitude, grid: Grid, parts: Iterable[tuple[slice, RealArray]]) -> float:
    """C0 in m⁴ at which ``law`` meets the ``amplitude`` on ``grid``.

    ``parts`` are C/C0 on all modes, in pieces for consecutive columns of the half spectrum. Raises
    InputError if the grid cannot resolve the shortest wavelength or holds no mode of the spectrum.
    """
    finest, shortest = 2.0 * max(grid.spacing), 2.0 * np.pi / law.high
    if 0.0 < shortest < finest * (1.0 - _ROUNDING):
        raise InputError(
            f"shortest wavelength must be at least two pixels ({finest:g} m), or 0 for all that the grid holds, "
            f"but is {shortest:g} m. Refine the grid or raise the shortest wavelength."
        )
    (qx, qy), weights, moment = grid.wavevector(), multiplicity(grid), 0.0
    for columns, relative in parts:
        squares = qx**2 + qy[:, columns] ** 2 if isinstance(amplitude, RmsSlope) else 1.0
        moment += float((relative * squares).sum(axis=0) @ weights[columns]) / grid.area
    if moment == 0.0:
        longest = math.inf if law.low == 0.0 else 2.0 * np.pi / law.low
        raise InputError(
            f"grid must hold waves between {shortest:g} and {longest:g} m, "
            f"but has the size {grid.size[0]:g} x {grid.size[1]:g} m. Enlarge the grid."
        )
    return amplitude.value if isinstance(amplitude, PlateauPSD) else amplitude.value**2 / moment
