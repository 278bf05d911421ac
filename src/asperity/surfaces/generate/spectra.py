"""Power spectra of random surfaces in the convention C of Jacobs, Junge & Pastewka (2017).

m0 = (1/A) Σ C(q) over the modes of a periodic map, → (1/4π²) ∫ C d²q; C in m⁴, wavenumbers q = 2π/λ in rad/m.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Protocol, TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid

_ROUNDING = 1e-9  # relative slack on a cut-off wavenumber, so that a mode exactly on it is kept


class Spectrum(Protocol):
    """Isotropic or anisotropic spectrum from which a periodic random surface can be generated."""

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0."""

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""


@dataclass(frozen=True)
class RmsHeight:
    """Amplitude of a spectrum given by the rms height (m) of the surface, about its mean."""

    value: float

    def __post_init__(self) -> None:
        require.positive(self.value, "rms height (m)")


@dataclass(frozen=True)
class RmsSlope:
    """Amplitude of a spectrum given by the rms gradient sqrt(<|∇h|²>) of the surface (spectral, dimensionless)."""

    value: float

    def __post_init__(self) -> None:
        require.positive(self.value, "rms slope")


@dataclass(frozen=True)
class PlateauPSD:
    """Amplitude of a spectrum given by its plateau C0 (m⁴)."""

    value: float

    def __post_init__(self) -> None:
        require.positive(self.value, "plateau of the power spectrum (m^4)")


Amplitude: TypeAlias = RmsHeight | RmsSlope | PlateauPSD


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
        λ_r, λ_s, λ_L in m with λ_s <= λ_r <= λ_L; λ_L = λ_r has no plateau, λ_L = inf excludes only the mean.

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
        if not isinstance(self.amplitude, (RmsHeight, RmsSlope, PlateauPSD)):
            raise InputError(
                "amplitude of a self-affine spectrum must be an RmsHeight, RmsSlope or PlateauPSD, "
                f"but is {self.amplitude!r}. Write for example RmsHeight(1e-9)."
            )
        require.at_most(self.hurst, 1.0, "Hurst exponent")
        require.positive(self.shortest_wavelength, "shortest wavelength (m)")
        require.positive(self.rolloff_wavelength, "roll-off wavelength (m)")
        if not self.shortest_wavelength <= self.rolloff_wavelength <= self.longest_wavelength:
            raise InputError(
                "wavelengths of a self-affine spectrum must satisfy shortest <= roll-off <= longest, but are "
                f"{self.shortest_wavelength:g}, {self.rolloff_wavelength:g} and {self.longest_wavelength:g} m."
            )

    def psd(self, q: RealArray | float) -> RealArray:
        """C(q) in m⁴ of the continuous surface at wavenumbers ``q`` (rad/m, any shape)."""
        values: RealArray = self._plateau() * self._relative(np.asarray(q, dtype=float))
        return values

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0.

        Raises
        ------
        InputError
            If the grid cannot resolve the shortest wavelength or holds no mode of the spectrum.
        """
        finest = 2.0 * max(grid.spacing)
        if self.shortest_wavelength < finest * (1.0 - _ROUNDING):
            raise InputError(
                f"shortest wavelength must be at least two pixels ({finest:g} m), "
                f"but is {self.shortest_wavelength:g} m. Refine the grid or raise the shortest wavelength."
            )
        q = grid.wavenumber()
        relative = self._relative(q)
        if not relative.any():
            raise InputError(
                f"grid must hold waves between {self.shortest_wavelength:g} and {self.longest_wavelength:g} m, "
                f"but has the size {grid.size[0]:g} x {grid.size[1]:g} m. Enlarge the grid."
            )
        if isinstance(self.amplitude, PlateauPSD):
            return self.amplitude.value * relative
        moment = mode_sum(grid, relative if isinstance(self.amplitude, RmsHeight) else q**2 * relative)
        return self.amplitude.value**2 / moment * relative

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        names = {RmsHeight: "rms height {:.4g} m", RmsSlope: "rms slope {:.4g}", PlateauPSD: "plateau {:.4g} m^4"}
        amplitude = names[type(self.amplitude)].format(self.amplitude.value)
        waves = f"roll-off {self.rolloff_wavelength:.4g} m, shortest wave {self.shortest_wavelength:.4g} m"
        longest = "" if math.isinf(self.longest_wavelength) else f", longest wave {self.longest_wavelength:.4g} m"
        return f"self-affine, Hurst exponent {self.hurst:.4g}, {waves}{longest}, {amplitude}"

    def _relative(self, q: RealArray) -> RealArray:
        q_r, q_s = 2.0 * np.pi / self.rolloff_wavelength, 2.0 * np.pi / self.shortest_wavelength
        q_long = 2.0 * np.pi / self.longest_wavelength
        inside = (q > 0.0) & (q >= q_long * (1.0 - _ROUNDING)) & (q <= q_s * (1.0 + _ROUNDING))
        return np.where(inside, np.maximum(q / q_r, 1.0) ** (-2.0 - 2.0 * self.hurst), 0.0)

    def _plateau(self) -> float:
        """C0 of the continuous surface from <h²> = (1/2π) ∫ q C dq or <|∇h|²> = (1/2π) ∫ q³ C dq."""
        if isinstance(self.amplitude, PlateauPSD):
            return self.amplitude.value
        power = 2 if isinstance(self.amplitude, RmsHeight) else 4
        q_r = 2.0 * np.pi / self.rolloff_wavelength
        low = self.rolloff_wavelength / self.longest_wavelength
        high = self.rolloff_wavelength / self.shortest_wavelength
        exponent = power - 2.0 - 2.0 * self.hurst
        tail = math.log(high) if exponent == 0.0 else (high**exponent - 1.0) / exponent
        integral = (1.0 - low**power) / power + tail
        return 2.0 * np.pi * self.amplitude.value**2 / (q_r**power * integral)


def mode_sum(grid: Grid, half: RealArray) -> float:
    """(1/A) Σ over all modes of ``grid`` of a quantity given on the half spectrum (nx, ny // 2 + 1).

    For the spectrum C (m⁴) this is the mean square height (m²); for q²C the mean square gradient.
    """
    columns = half.sum(axis=0)
    weights = np.full(columns.shape, 2.0)
    weights[0] = 1.0
    if grid.shape[1] % 2 == 0:
        weights[-1] = 1.0
    return float(columns @ weights) / grid.area
