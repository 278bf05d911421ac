"""Power spectra in the convention of Jacobs, Junge & Pastewka (2017).

C(q) = (dx dy/(nx ny)) |FFT h|² in m⁴ with m0 = (1/A) Σ C → (1/4π²) ∫ C d²q; for profiles C1D = (d/n) |FFT h|² in m³,
two-sided, with m0 = (1/L) Σ C1D → (1/π) ∫₀ C1D dq. Wavenumbers q = 2π/λ in rad/m. The mean height is removed first.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.spectral import RealTransform, line_transform, thread_count
from ..generate.modes import mode_sum, multiplicity
from ..prepare.steps import require_complete
from ..surface import Surface
from .differences import axis_index
from .windows import chosen_window, line_window, map_window

_ROUNDING = 1e-9  # relative error of Parseval's identity that rounding can make on any map


@dataclass(frozen=True, eq=False)
class PowerSpectrum:
    """Two-dimensional spectrum: ``psd`` C in m⁴ on the half plane of modes (nx, ny // 2 + 1) of ``grid``.

    ``window`` by which the heights were multiplied ("none" for a periodic surface).
    """

    grid: Grid
    psd: RealArray
    window: str
    citation_keys: ClassVar[tuple[str, ...]] = ("Jacobs2017",)

    @property
    def mean_square(self) -> float:
        """(1/A) Σ C over all modes in m²: the mean square of the heights that were transformed."""
        return mode_sum(self.grid, self.psd)

    @property
    def nyquist(self) -> float:
        """Largest wavenumber in rad/m whose ring of modes is complete: π/max(dx, dy)."""
        return float(np.pi / max(self.grid.spacing))


@dataclass(frozen=True, eq=False)
class RadialSpectrum:
    """Mean of C over rings of modes: a ring holds the modes with ``low`` < q <= ``high`` (rad/m); empty ones are left out.

    ``q`` log-mean wavenumber (rad/m), ``psd`` arithmetic mean of C (m⁴), ``modes`` number of modes of both half planes,
    of which half are independent; ``window`` of the spectrum.
    """

    q: RealArray
    psd: RealArray
    modes: RealArray
    low: RealArray
    high: RealArray
    window: str


@dataclass(frozen=True, eq=False)
class ProfileSpectrum:
    """Two-sided spectrum ``psd`` C1D in m³ of the profiles along ``axis`` at ``q`` > 0 (rad/m), averaged over them."""

    axis: str
    q: RealArray
    psd: RealArray
    window: str


def power_spectrum(surface: Surface, window: str = "auto") -> PowerSpectrum:
    """Two-dimensional power spectrum of the heights about their mean.

    Parameters
    ----------
    surface
        Complete surface; level a measured one first.
    window
        ``auto`` (none for a periodic surface, hann otherwise), ``none``, ``hann`` (separable) or ``radial hann``.
        Without a window, the jump between opposite borders of a non-periodic map hides spectra steeper than q^-3.

    Raises
    ------
    InputError
        If points are missing or the window is unknown.
    """
    require_complete(surface, "transformed")
    kind = chosen_window(window, surface)
    heights = surface.heights.astype(np.float64)
    heights -= heights.mean()
    if kind != "none":
        heights *= map_window(kind, surface.grid)
    amplitudes = RealTransform(surface.shape, thread_count()).forward(heights)
    psd: RealArray = np.square(amplitudes.real) + np.square(amplitudes.imag)
    psd *= surface.grid.pixel_area / surface.grid.n_points
    spectrum = PowerSpectrum(surface.grid, psd, kind)
    _require_parseval(spectrum.mean_square, float(np.mean(np.square(heights))))
    psd[0, 0] = 0.0  # a window gives the mean back; it carries no roughness
    return spectrum


def profile_spectrum(surface: Surface, *, axis: str = "x", window: str = "auto") -> ProfileSpectrum:
    """Mean over all lines of the spectrum of the profiles along ``axis``, each about its own mean.

    ``window`` as for :func:`power_spectrum`, ``radial hann`` excepted.

    Raises
    ------
    InputError
        If points are missing, the axis or window is unknown, or the lines have a single point.
    """
    number = axis_index(axis)
    require_complete(surface, "transformed")
    kind = chosen_window(window, surface)
    if kind == "radial hann":
        raise InputError("window of a profile must be auto, none or hann, but is 'radial hann'.")
    n, d = surface.shape[number], surface.grid.spacing[number]
    if n < 2:
        raise InputError(f"surface must have at least two points along {axis} for a spectrum, but has {n}.")
    heights = surface.heights.astype(np.float64)
    heights -= heights.mean(axis=number, keepdims=True)
    if kind != "none":
        weights = line_window(kind, n)
        heights *= weights[:, None] if number == 0 else weights[None, :]
    power = np.abs(line_transform(heights, number, thread_count())) ** 2
    psd = (d / n) * power.mean(axis=1 - number)[1:]
    q = 2.0 * np.pi / (n * d) * np.arange(1, n // 2 + 1)
    return ProfileSpectrum(axis, q, psd, kind)


def radial_spectrum(spectrum: PowerSpectrum, edges: RealArray | None = None, *, per_decade: int = 20) -> RadialSpectrum:
    """Arithmetic mean of C over rings of modes (never of log C, which is low by Euler's constant).

    Parameters
    ----------
    spectrum
        Two-dimensional spectrum.
    edges
        Increasing wavenumbers in rad/m that bound the rings; ``per_decade`` rings per factor of ten from the longest
        wave to the last complete ring (π over the larger pixel) if omitted.
    per_decade
        Rings per decade.
    """
    q = spectrum.grid.wavenumber()
    bounds = default_edges(spectrum, per_decade) if edges is None else np.asarray(edges, dtype=float)
    ring = np.searchsorted(bounds, q.ravel(), side="left") - 1
    inside = (ring >= 0) & (ring < bounds.size - 1) & (q.ravel() > 0.0)
    weight = np.broadcast_to(multiplicity(spectrum.grid), q.shape).ravel()[inside]
    ring, count = ring[inside], bounds.size - 1
    modes = np.bincount(ring, weight, count).astype(np.float64)
    power = np.bincount(ring, weight * spectrum.psd.ravel()[inside], count)
    log_q = np.bincount(ring, weight * np.log(q.ravel()[inside]), count)
    found = np.flatnonzero(modes)
    modes = modes[found]
    mean_q, psd = np.exp(log_q[found] / modes), power[found] / modes
    return RadialSpectrum(mean_q, psd, modes, bounds[found], bounds[found + 1], spectrum.window)


def default_edges(spectrum: PowerSpectrum, per_decade: int = 20, *, corners: bool = False) -> RealArray:
    """Edges in rad/m of logarithmic rings from just below the longest wave to the Nyquist circle.

    With ``corners`` to the largest wavenumber of the grid: beyond the circle rings are not complete, and their mean is that
    of all directions only where the surface is isotropic.
    """
    shortest = 2.0 * np.pi / max(spectrum.grid.size)
    dx, dy = spectrum.grid.spacing
    last = float(np.hypot(np.pi / dx, np.pi / dy)) if corners else spectrum.nyquist
    high = max(last, 2.0 * shortest)
    count = max(2, round(per_decade * np.log10(high / shortest)))
    return np.geomspace(shortest * (1.0 - _ROUNDING), high * (1.0 + _ROUNDING), count + 1)


def _require_parseval(spectral: float, direct: float) -> None:
    if abs(spectral - direct) > _ROUNDING * direct:
        raise ArithmeticError(
            f"sum over the spectrum is {spectral:g} m^2 but the mean square of the heights is {direct:g} m^2: "
            "the Fourier transform went wrong."
        )
