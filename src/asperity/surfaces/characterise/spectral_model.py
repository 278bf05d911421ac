"""Isotropic spectra made of a plateau and power laws, and their moments."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid

_ROUNDING = 1e-9  # relative slack on a cut-off wavenumber, so that a mode exactly on it is kept


@dataclass(frozen=True, kw_only=True)
class SpectralModel:
    """C(q) = C0 (plateau) up to q_r, C0 (q/q_r)^-a1 up to q_c, from there on with the exponent a2, plus a floor.

    Zero below ``longest`` and beyond ``shortest`` waves; convention of Jacobs, Junge & Pastewka (2017). It serves
    ``asperity.generate.gaussian`` as a spectrum.

    Parameters
    ----------
    level
        C0 in m⁴, the value at the roll-off.
    rolloff_wavelength
        λ_r = 2π/q_r in m; without a plateau merely the wavelength at which ``level`` is stated.
    exponents
        (a1,) or (a1, a2), any real numbers; a = 2 + 2H of a self-affine surface with the Hurst exponent H.
    crossover_wavelength
        λ_c = 2π/q_c <= λ_r in m where the exponent changes; needed with two exponents.
    plateau
        Whether C is constant below q_r; otherwise the first power law goes on.
    floor
        Constant C_n in m⁴ that is added: white noise of the mean square height C_n/(dx dy).
    shortest_wavelength, longest_wavelength
        Limits in m of the spectrum, 0 and infinity if there is none.

    Raises
    ------
    InputError
        If a number is out of range or the wavelengths are out of order.
    """

    level: float
    rolloff_wavelength: float
    exponents: tuple[float, ...]
    crossover_wavelength: float = math.nan
    plateau: bool = True
    floor: float = 0.0
    shortest_wavelength: float = 0.0
    longest_wavelength: float = math.inf
    citation_keys: ClassVar[tuple[str, ...]] = ("Jacobs2017",)

    def __post_init__(self) -> None:
        require.positive(self.level, "level of a spectrum (m^4)")
        require.positive(self.rolloff_wavelength, "roll-off wavelength (m)")
        if len(self.exponents) not in (1, 2):
            raise InputError(f"exponents of a spectrum must be one or two, but are {self.exponents!r}.")
        for exponent in self.exponents:
            require.finite(exponent, "exponent of a spectrum")
        if len(self.exponents) == 2:
            require.at_most(self.crossover_wavelength, self.rolloff_wavelength, "crossover wavelength (m)")
        if not self.shortest_wavelength < self.longest_wavelength:
            raise InputError(
                f"shortest wave of a spectrum must be below the longest, {self.longest_wavelength:g} m, "
                f"but is {self.shortest_wavelength:g} m."
            )

    @property
    def hurst(self) -> tuple[float, ...]:
        """(a - 2)/2 for each exponent; a Hurst exponent only if it lies between 0 and 1."""
        return tuple(0.5 * (exponent - 2.0) for exponent in self.exponents)

    def psd(self, q: RealArray | float) -> RealArray:
        """C(q) in m⁴ at the wavenumbers ``q`` > 0 (rad/m, any shape)."""
        number = np.asarray(q, dtype=float)
        with np.errstate(divide="ignore"):
            log_q = np.log(number * self.rolloff_wavelength / (2.0 * np.pi))
        bent = np.maximum(log_q, 0.0) if self.plateau else log_q
        decay = self.exponents[0] * bent
        if len(self.exponents) == 2:
            bend = math.log(self.rolloff_wavelength / self.crossover_wavelength)
            decay = decay + (self.exponents[1] - self.exponents[0]) * np.maximum(log_q - bend, 0.0)
        longest, shortest = 2.0 * np.pi / self.longest_wavelength, self._shortest_wavenumber
        inside = (number >= longest * (1.0 - _ROUNDING)) & (number <= shortest * (1.0 + _ROUNDING)) & (number > 0.0)
        values: RealArray = np.where(inside, self.level * np.exp(np.where(inside, -decay, 0.0)) + self.floor, 0.0)
        return values

    def moments(self, shortest_wavelength: float = 0.0, longest_wavelength: float = math.inf) -> tuple[float, ...]:
        """Profile moments m0 (m²), m2, m4 (1/m²) of the continuous surface between two wavelengths (m), without floor.

        m0 = (1/2π) ∫ q C dq, m2 = (1/4π) ∫ q³ C dq, m4 = (3/16π) ∫ q⁵ C dq, piece by piece in closed form. Infinite
        where an integral diverges.
        """
        low = 2.0 * np.pi / min(longest_wavelength, self.longest_wavelength)
        shortest = max(shortest_wavelength, self.shortest_wavelength)
        high = 2.0 * np.pi / shortest if shortest > 0.0 else math.inf
        factors = (1.0 / (2.0 * np.pi), 1.0 / (4.0 * np.pi), 3.0 / (16.0 * np.pi))
        return tuple(
            factor * self._integral(order + 1, low, high) for factor, order in zip(factors, (0, 2, 4), strict=True)
        )

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0 and beyond the last complete ring.

        Raises
        ------
        InputError
            If the grid holds no mode of the spectrum.
        """
        q = grid.wavenumber()
        values: RealArray = np.where(q <= np.pi / max(grid.spacing) * (1.0 + _ROUNDING), self.psd(q), 0.0)
        if not values.any():
            raise InputError(
                f"grid of {grid.size[0]:g} x {grid.size[1]:g} m must hold waves of the spectrum, but has none."
            )
        return values

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        laws = " and ".join(f"q^-{exponent:.4g}" for exponent in self.exponents)
        start = "plateau" if self.plateau else "level"
        bend = f", crossover {self.crossover_wavelength:.4g} m" if len(self.exponents) == 2 else ""
        floor = f", floor {self.floor:.4g} m^4" if self.floor > 0.0 else ""
        return f"{start} {self.level:.4g} m^4 at {self.rolloff_wavelength:.4g} m, {laws}{bend}{floor}"

    @property
    def _shortest_wavenumber(self) -> float:
        return 2.0 * math.pi / self.shortest_wavelength if self.shortest_wavelength > 0.0 else math.inf

    def _integral(self, power: int, low: float, high: float) -> float:
        """∫ q^power C dq between two wavenumbers, without the floor."""
        q_r = 2.0 * math.pi / self.rolloff_wavelength
        bounds, exponents = [q_r], [0.0 if self.plateau else self.exponents[0], self.exponents[0]]
        if len(self.exponents) == 2:
            bounds.append(2.0 * math.pi / self.crossover_wavelength)
            exponents.append(self.exponents[1])
        edges = [0.0, *bounds, math.inf]
        total, at_edge = 0.0, self.level  # C at the reference wavenumber of each piece
        for number, exponent in enumerate(exponents):
            reference = edges[max(1, number)]
            if number > 1:
                at_edge *= math.pow(reference / edges[number - 1], -exponents[number - 1])
            a, b = max(low, edges[number]), min(high, edges[number + 1])
            if b > a:
                total += (
                    at_edge
                    * _power_integral(power - exponent, a / reference, b / reference)
                    * math.pow(reference, power + 1)
                )
        return total


def _power_integral(power: float, a: float, b: float) -> float:
    """∫_a^b x^power dx, infinite where it diverges."""
    if abs(power + 1.0) < 1e-12:
        return math.inf if a == 0.0 or math.isinf(b) else math.log(b / a)
    if (power < -1.0 and a == 0.0) or (power > -1.0 and math.isinf(b)):
        return math.inf
    upper = 0.0 if math.isinf(b) else math.pow(b, power + 1.0)
    lower = 0.0 if a == 0.0 else math.pow(a, power + 1.0)
    return (upper - lower) / (power + 1.0)
