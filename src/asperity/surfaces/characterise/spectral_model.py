"""Model of a measured spectrum: a plateau, one or two power laws and a floor."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ..generate.power_laws import PowerLaws


@dataclass(frozen=True, kw_only=True)
class SpectralModel:
    """C(q) = C0 up to q_r, C0 (q/q_r)^-a1 up to q_c, from there on with the exponent a2, plus a
    floor.

    Zero beyond the longest and the shortest wave; a spectrum without plateau begins at its
    roll-off. Convention of Jacobs, Junge & Pastewka (2017). ``asperity.generate.gaussian`` accepts
    it as a spectrum. Raises InputError if a number is out of range or the wavelengths are out of
    order.

    Parameters
    ----------
    level
        C0 in m⁴, the value at the roll-off.
    rolloff_wavelength
        λ_r = 2π/q_r in m.
    exponents
        (a1,) or (a1, a2), any real numbers; a = 2 + 2H of a self-affine surface with the Hurst
        exponent H.
    crossover_wavelength
        λ_c = 2π/q_c <= λ_r in m where the exponent changes; needed with two exponents.
    floor
        Added constant C_n in m⁴: white noise of the mean square height C_n/(dx dy).
    shortest_wavelength
        Shortest wave in m; 0 for no limit but the grid.
    longest_wavelength
        Longest wave in m, at least λ_r; equal to it, there is no plateau.
    rounded
        Whether the plateau goes over into the first power law as C0 (1 + q²/q_r²)^(-a1/2), the
        K-correlation or Matérn spectrum, without a corner.
    """

    level: float
    rolloff_wavelength: float
    exponents: tuple[float, ...]
    crossover_wavelength: float = math.nan
    floor: float = 0.0
    shortest_wavelength: float = 0.0
    longest_wavelength: float = math.inf
    rounded: bool = False
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
        if not self.shortest_wavelength < self.rolloff_wavelength <= self.longest_wavelength:
            raise InputError(
                "wavelengths of a spectrum must satisfy shortest < roll-off <= longest, but are "
                f"{self.shortest_wavelength:g}, {self.rolloff_wavelength:g} and {self.longest_wavelength:g} m."
            )

    @property
    def has_plateau(self) -> bool:
        """Whether there are waves longer than the roll-off."""
        return self.rolloff_wavelength < self.longest_wavelength

    @property
    def hurst(self) -> tuple[float, ...]:
        """(a - 2)/2 for each exponent; a Hurst exponent only if it lies between 0 and 1."""
        return tuple(0.5 * (exponent - 2.0) for exponent in self.exponents)

    @cached_property
    def law(self) -> PowerLaws:
        """Shape of the spectrum without its floor, with a corner at the roll-off."""
        bends = [self.rolloff_wavelength] + [self.crossover_wavelength] * (len(self.exponents) - 1)
        shortest = 2.0 * math.pi / self.shortest_wavelength if self.shortest_wavelength > 0.0 else math.inf
        longest = 2.0 * math.pi / self.longest_wavelength
        return PowerLaws(tuple(2.0 * math.pi / bend for bend in bends), self.exponents, longest, shortest)

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are taken as uncorrelated: two roll-off
        wavelengths."""
        return 2.0 * self.rolloff_wavelength

    def psd(self, q: RealArray | float) -> RealArray:
        """C(q) in m⁴ at the wavenumbers ``q`` (rad/m, any shape), zero at q = 0."""
        number = np.asarray(q, dtype=float)
        relative = self.law.relative(number.ravel()).reshape(number.shape) * self._rounding(number)
        return np.where(relative > 0.0, self.level * relative + self.floor, 0.0)

    def moments(self, shortest_wavelength: float = 0.0, longest_wavelength: float = math.inf) -> tuple[float, ...]:
        """Profile moments m0 (m²), m2, m4 (1/m²) of the continuous surface between two wavelengths
        (m), without floor.

        m0 = (1/2π) ∫ q C dq, m2 = (1/4π) ∫ q³ C dq, m4 = (3/16π) ∫ q⁵ C dq. Infinite where an
        integral diverges.
        """
        from scipy.integrate import quad

        high = min(self.law.high, 2.0 * math.pi / shortest_wavelength if shortest_wavelength > 0.0 else math.inf)
        law = replace(self.law, low=max(self.law.low, 2.0 * math.pi / longest_wavelength), high=high)
        found = []
        for power, factor in ((1.0, 0.5), (3.0, 0.25), (5.0, 0.1875)):  # power and factor of 1/π
            integral = law.integral(power)
            if self.rounded and math.isfinite(integral):  # less what the corner has too much
                corner, near = 2.0 * math.pi / self.rolloff_wavelength, (1e-8, 1e-4, 0.1, 1.0, 10.0, 1e4, 1e8)
                edges = np.clip(corner * np.array(near), law.low, law.high)
                for low, top in zip(np.log(edges[:-1]), np.log(edges[1:]), strict=True):

                    def missing(log_q: float, power: float = power) -> float:
                        q = np.array([math.exp(log_q)])
                        return float((q ** (power + 1.0) * law.relative(q) * (1.0 - self._rounding(q)))[0])

                    integral -= quad(missing, low, top, limit=200)[0]
            found.append(self.level * factor / math.pi * integral)
        return tuple(found)

    def _rounding(self, q: RealArray) -> RealArray:
        """Factor at the wavenumbers ``q`` (rad/m) by which a rounded roll-off lowers the
        spectrum."""
        if not self.rounded:
            return np.ones(q.shape)
        x = q * self.rolloff_wavelength / (2.0 * math.pi)
        near = np.minimum(x, 1.0 / np.maximum(x, 1.0))  # q/q_r or q_r/q, whichever is less than one
        return np.asarray((1.0 + near**2) ** (-0.5 * self.exponents[0]))

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0.

        Raises InputError if the grid holds no mode of the spectrum.
        """
        values = self.psd(grid.wavenumber())
        if not values.any():
            raise InputError(
                f"grid of {grid.size[0]:g} x {grid.size[1]:g} m must hold waves of the spectrum, but has none. "
                "Change its size."
            )
        return values

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        laws = " and ".join(f"q^-{exponent:.4g}" for exponent in self.exponents)
        start = ("rounded plateau" if self.rounded else "plateau") if self.has_plateau else "no plateau"
        bend = f", crossover {self.crossover_wavelength:.4g} m" if len(self.exponents) == 2 else ""
        floor = f", floor {self.floor:.4g} m^4" if self.floor > 0.0 else ""
        return f"{start}, {self.level:.4g} m^4 at {self.rolloff_wavelength:.4g} m, {laws}{bend}{floor}"
