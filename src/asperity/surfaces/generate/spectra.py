"""Power spectra of random surfaces in the convention C of Jacobs, Junge & Pastewka (2017).

m0 = (1/A) Σ C(q) over the modes of a periodic map, → (1/4π²) ∫ C d²q; C in m⁴, wavenumbers q = 2π/λ in rad/m.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import ClassVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.units import show
from .amplitude import Amplitude, PlateauPSD, RmsHeight, RmsSlope, amplitude_text, require_amplitude
from .embedding import Spectrum
from .modes import mode_sum
from .power_laws import PowerLaws, continuous_level, lattice_psd

__all__ = ["PlateauPSD", "RmsHeight", "RmsSlope", "SelfAffine", "Spectrum", "TwoSlopes", "mode_sum"]


@dataclass(frozen=True, kw_only=True)
class SelfAffine:
    """Plateau and power law: C = C0 for q_L <= q <= q_r, C0 (q/q_r)^(-2-2H) for q_r < q <= q_s, zero elsewhere.

    ``amplitude`` fixes C0; on a grid an rms height or rms slope is met exactly by the sum over the modes of that grid
    (ensemble average), in :meth:`psd` by the integral. Source: Jacobs, Junge & Pastewka (2017), section 2.

    Parameters
    ----------
    amplitude
        ``RmsHeight``, ``RmsSlope`` or ``PlateauPSD``.
    hurst
        Hurst exponent H, 0 < H <= 1.
    rolloff_wavelength, shortest_wavelength, longest_wavelength
        λ_r, λ_s, λ_L in m with λ_s <= λ_r <= λ_L; λ_L = λ_r has no plateau, λ_L = inf excludes only the mean, λ_s = 0
        keeps all modes of the grid, those in the corners of the Nyquist square too.

    Raises
    ------
    InputError
        If a value is out of range or the wavelengths are out of order.
    """

    amplitude: Amplitude
    hurst: float
    rolloff_wavelength: float
    shortest_wavelength: float
    longest_wavelength: float = math.inf
    citation_keys: ClassVar[tuple[str, ...]] = ("Jacobs2017",)

    def __post_init__(self) -> None:
        require_amplitude(self.amplitude, "self-affine")
        require.at_most(self.hurst, 1.0, "Hurst exponent")
        waves = (self.shortest_wavelength, self.rolloff_wavelength, self.longest_wavelength)
        _require_ascending(waves, "shortest <= roll-off <= longest", "self-affine")

    @cached_property
    def law(self) -> PowerLaws:
        """Shape of the spectrum."""
        low, high = _limits(self.longest_wavelength, self.shortest_wavelength)
        return PowerLaws((2.0 * np.pi / self.rolloff_wavelength,), (2.0 + 2.0 * self.hurst,), low, high)

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are uncorrelated: two roll-off wavelengths or the longest wave."""
        return _correlation_range(self.rolloff_wavelength, self.longest_wavelength)

    def psd(self, q: RealArray | float) -> RealArray:
        """C(q) in m⁴ of the continuous surface at wavenumbers ``q`` (rad/m, any shape)."""
        return continuous_level(self.law, self.amplitude) * self.law.relative(np.asarray(q, dtype=float))

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0.

        Raises
        ------
        InputError
            If the grid cannot resolve the shortest wavelength or holds no mode of the spectrum.
        """
        return lattice_psd(self.law, self.amplitude, grid)

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        waves = (
            f"roll-off {show(self.rolloff_wavelength, 'm')}, {_ends(self.shortest_wavelength, self.longest_wavelength)}"
        )
        return f"self-affine, Hurst exponent {self.hurst:.4g}, {waves}, {amplitude_text(self.amplitude)}"


@dataclass(frozen=True, kw_only=True)
class TwoSlopes:
    """Plateau and two power laws: C0 up to q_r, C0 (q/q_r)^-a1 up to q_c, then continued as q^-a2 up to q_s.

    Films whose asperities are smooth, or rounded by the tip of the instrument, fall faster than q^-4 (H > 1): such a
    spectrum is no fractal, and is accepted. ``amplitude`` as for ``SelfAffine``.

    Parameters
    ----------
    amplitude
        ``RmsHeight``, ``RmsSlope`` or ``PlateauPSD``.
    exponents
        (a1, a2), positive: C falls as q^-a1 between λ_r and λ_c, as q^-a2 below λ_c.
    rolloff_wavelength, crossover_wavelength
        λ_r and λ_c <= λ_r in m.
    shortest_wavelength, longest_wavelength
        λ_s <= λ_c and λ_L >= λ_r in m; λ_s = 0 keeps all modes of the grid, those in the corners of the Nyquist square too.

    Raises
    ------
    InputError
        If a value is out of range or the wavelengths are out of order.
    """

    amplitude: Amplitude
    exponents: tuple[float, float]
    rolloff_wavelength: float
    crossover_wavelength: float
    shortest_wavelength: float = 0.0
    longest_wavelength: float = math.inf
    citation_keys: ClassVar[tuple[str, ...]] = ("Jacobs2017",)

    def __post_init__(self) -> None:
        require_amplitude(self.amplitude, "two-slope")
        for exponent in require.two(self.exponents, "exponents of a two-slope spectrum", "Write (a1, a2)."):
            require.positive(exponent, "exponent of a two-slope spectrum")
        waves = (
            self.shortest_wavelength,
            self.crossover_wavelength,
            self.rolloff_wavelength,
            self.longest_wavelength,
        )
        _require_ascending(waves, "shortest <= crossover <= roll-off <= longest", "two-slope")

    @cached_property
    def law(self) -> PowerLaws:
        """Shape of the spectrum."""
        low, high = _limits(self.longest_wavelength, self.shortest_wavelength)
        bends = (2.0 * np.pi / self.rolloff_wavelength, 2.0 * np.pi / self.crossover_wavelength)
        return PowerLaws(bends, tuple(self.exponents), low, high)

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are uncorrelated: two roll-off wavelengths or the longest wave."""
        return _correlation_range(self.rolloff_wavelength, self.longest_wavelength)

    def psd(self, q: RealArray | float) -> RealArray:
        """C(q) in m⁴ of the continuous surface at wavenumbers ``q`` (rad/m, any shape)."""
        return continuous_level(self.law, self.amplitude) * self.law.relative(np.asarray(q, dtype=float))

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0.

        Raises
        ------
        InputError
            If the grid cannot resolve the shortest wavelength or holds no mode of the spectrum.
        """
        return lattice_psd(self.law, self.amplitude, grid)

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        first, second = self.exponents
        bends = f"q^-{first:.4g} from {show(self.rolloff_wavelength, 'm')}, q^-{second:.4g} from {show(self.crossover_wavelength, 'm')}"
        ends = _ends(self.shortest_wavelength, self.longest_wavelength)
        return f"two slopes, {bends}, {ends}, {amplitude_text(self.amplitude)}"


def _require_ascending(waves: tuple[float, ...], order: str, what: str) -> None:
    if not waves[0] >= 0.0:
        raise InputError(f"shortest wavelength (m) must be zero or greater, but is {waves[0]!r}.")
    require.positive(waves[1], "roll-off or crossover wavelength (m)")
    if not all(short <= long for short, long in pairwise(waves)):
        listed = ", ".join(f"{wave:g}" for wave in waves)
        raise InputError(f"wavelengths of a {what} spectrum must satisfy {order}, but are {listed} m.")


def _limits(longest: float, shortest: float) -> tuple[float, float]:
    """Smallest and largest wavenumber in rad/m."""
    return 2.0 * np.pi / longest, math.inf if shortest == 0.0 else 2.0 * np.pi / shortest


def _correlation_range(rolloff: float, longest: float) -> float:
    return 2.0 * rolloff if math.isinf(longest) else max(2.0 * rolloff, longest)


def _ends(shortest: float, longest: float) -> str:
    short = "all short waves of the grid" if shortest == 0.0 else f"shortest wave {show(shortest, 'm')}"
    return short if math.isinf(longest) else f"{short}, longest wave {show(longest, 'm')}"
