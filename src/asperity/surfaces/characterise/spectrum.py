"""Power spectra in the convention of Jacobs, Junge & Pastewka (2017).

C(q) = (dx dy/(nx ny)) |FFT h|² in m⁴ with m0 = (1/A) Σ C → (1/4π²) ∫ C d²q; for profiles C1D =
(d/n) |FFT h|² in m³, two-sided, with m0 = (1/L) Σ C1D → (1/π) ∫₀ C1D dq. Wavenumbers q = 2π/λ in
rad/m. The mean height is removed first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar, TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.quadrature import gauss
from ...core.scipy_parts import special
from ...core.spectral import RealTransform, line_transform, mode_sum, multiplicity, thread_count
from ..prepare.level import require_complete
from ..surface import Surface, maps_only, of_lines
from .slopes import axis_index

# Windows by which heights are multiplied before a Fourier transform, normalised to a mean square of
# one.


WINDOWS = ("none", "hann", "radial hann")
"""Kinds of window."""

LOST_MODES = {"none": 1.0, "hann": 35.0 / 18.0, "radial hann": 2.0}
"""Factor per axis by which a window reduces the number of independent modes: <w⁴>/<w²>², in one
dimension."""


def chosen_window(window: str, surface: Surface) -> str:
    """Kind of window for ``surface``: as named; ``auto`` gives none for a periodic surface and hann
    otherwise.

    Raises InputError if the name is unknown.
    """
    require.one_of(window, ("auto", *WINDOWS), "window of a spectrum")
    if window == "auto":
        return "none" if surface.periodic else "hann"
    return window


def line_window(kind: str, n: int) -> RealArray:
    """Weights at ``n`` points of a line; all one if the line is too short for a Hann window (one or
    two points)."""
    if kind == "none" or n < 3:
        return np.ones(n)
    weights = 0.5 * (1.0 - np.cos(2.0 * np.pi * np.arange(n) / n))
    return np.asarray(weights / np.sqrt(np.mean(np.square(weights))))


_ROUNDING = 1e-9  # upper bound of the rounding error of Parseval's identity, relative


@dataclass(frozen=True, eq=False)
class PowerSpectrum:
    """Two-dimensional spectrum: ``psd`` C in m⁴ on the half plane of modes (nx, ny // 2 + 1) of
    ``grid``.

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
    """Mean of C over rings of modes.

    A ring holds the modes with ``low`` < q <= ``high`` (rad/m); empty rings are omitted.

    ``q`` log-mean wavenumber (rad/m), ``psd`` arithmetic mean of C (m⁴), ``modes`` number of modes
    of both half planes, of which half are independent; ``window`` of the spectrum.
    """

    q: RealArray
    psd: RealArray
    modes: RealArray
    low: RealArray
    high: RealArray
    window: str


@dataclass(frozen=True, eq=False)
class ProfileSpectrum:
    """Two-sided spectrum ``psd`` C1D in m³ of the profiles along ``axis`` at ``q`` > 0 (rad/m),
    averaged over them."""

    axis: str
    q: RealArray
    psd: RealArray
    window: str


@maps_only
def power_spectrum(surface: Surface, window: str = "auto") -> PowerSpectrum:
    """Two-dimensional power spectrum of the heights about their mean.

    Raises InputError if points are missing or the window is unknown.

    Parameters
    ----------
    surface
        Complete surface; level a measured one first.
    window
        ``auto`` (none for a periodic surface, hann otherwise), ``none``, ``hann`` (separable) or
        ``radial hann``. Without a window, the jump between opposite borders of a non-periodic map
        masks spectra steeper than q^-3.
    """
    require_complete(surface, "transformed")
    kind = chosen_window(window, surface)
    heights = surface.heights.astype(np.float64)
    heights -= heights.mean()
    if kind == "radial hann":  # 1 + cos(2π r/L) within r < L/2 of the centre, L the shorter side, and zero outside
        x, y = surface.grid.centred_coordinates()
        shorter, radius = min(surface.size), np.hypot(x, y)
        weights = np.where(radius < 0.5 * shorter, 1.0 + np.cos(2.0 * np.pi * radius / shorter), 0.0)
        heights *= weights / np.sqrt(np.mean(np.square(weights)))
    elif kind != "none":
        heights *= line_window(kind, surface.shape[0])[:, None] * line_window(kind, surface.shape[1])[None, :]
    amplitudes = RealTransform(surface.shape, thread_count()).forward(heights)
    psd: RealArray = np.square(amplitudes.real) + np.square(amplitudes.imag)
    psd *= surface.grid.pixel_area / surface.grid.n_points
    spectrum = PowerSpectrum(surface.grid, psd, kind)
    direct = float(np.mean(np.square(heights)))
    if abs(spectrum.mean_square - direct) > _ROUNDING * direct:
        raise ArithmeticError(
            f"sum over the spectrum is {spectrum.mean_square:g} m^2 but the mean square of the heights is "
            f"{direct:g} m^2: the Fourier transform is wrong."
        )
    psd[0, 0] = 0.0  # the window restores a mean height, which is no roughness
    return spectrum


@of_lines
def profile_spectrum(surface: Surface, *, axis: str = "x", window: str = "auto") -> ProfileSpectrum:
    """Mean over all lines of the spectrum of the profiles along ``axis``, each about its own mean.

    ``window`` as for :func:`power_spectrum`, except ``radial hann``. Raises InputError if points
    are missing, the axis or window is unknown, or the lines have a single point.
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
    """Arithmetic mean of C over rings of modes (the mean of log C would be low by Euler's
    constant).

    Parameters
    ----------
    spectrum
        Two-dimensional spectrum.
    edges
        Increasing wavenumbers in rad/m that bound the rings; ``per_decade`` rings per factor of ten
        from the longest wave to the last complete ring (π over the larger pixel) if omitted.
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

    With ``corners`` to the largest wavenumber of the grid: beyond the circle rings are not
    complete, and their mean is that of all directions only where the surface is isotropic. A mode
    on an edge counts in the ring below, independent of rounding: the edges are 1e-9 above their
    nominal wavenumbers.
    """
    shortest = 2.0 * np.pi / max(spectrum.grid.size)
    dx, dy = spectrum.grid.spacing
    last = float(np.hypot(np.pi / dx, np.pi / dy)) if corners else spectrum.nyquist
    high = max(last, 2.0 * shortest)
    count = max(2, round(per_decade * np.log10(high / shortest)))
    edges = np.geomspace(shortest, high, count + 1) * (1.0 + _ROUNDING)
    edges[0] = shortest * (1.0 - _ROUNDING)
    return edges


# Expected moments of an isotropic random surface of known spectrum C(q) on a window of finite size
# and pixel.


IsotropicPsd: TypeAlias = Callable[[RealArray], RealArray]
"""C in m⁴ at wavenumbers in rad/m, such as the method ``psd`` of ``SpectralModel`` or
``SelfAffine``."""

DEGREES = {"mean": 0, "plane": 1, "quadratic": 2}
"""Degree of the polynomial that levelling by a form removes."""

_NODES = 10  # Gauss-Legendre nodes of a piece
_PIECES = 12  # pieces per factor of ten of wavenumber
_UNFILTERED = 150.0  # q L/2 beyond which levelling removes less than 1e-4 of the power
_ANGLES = 3.0  # trapezoidal points on a quarter circle per unit of q L/2
_CHUNK = 2**17  # angles at once


def mean_square_after_levelling(
    psd: IsotropicPsd,
    size: tuple[float, float],
    form: str = "plane",
    *,
    shortest_wavelength: float,
    longest_wavelength: float = math.inf,
) -> float:
    """Expected mean square height in m² of a window after removal of the mean, plane or quadratic.

    E = (1/4π²) ∫ C(q) [1 - Σ_(a+b<=d) (2a+1)(2b+1) j_a²(q_x Lx/2) j_b²(q_y Ly/2)] d²q, spherical
    Bessel functions j, for the continuous window ``size`` (Lx, Ly) in m and waves between the two
    wavelengths in m. Accurate to about 1e-4. Raises InputError if the form is unknown or a length
    is not positive.
    """
    degree = DEGREES[require.one_of(form, DEGREES, "form to be removed")]
    shorter, longer = sorted(require.positive(side, "side of a window (m)") for side in size)
    high = 2.0 * np.pi / require.positive(shortest_wavelength, "shortest wavelength (m)")
    low = max(2.0 * np.pi / longest_wavelength, 1e-3 / longer)  # longer waves are planes on the window to 1e-6
    bend = min(high, 2.0 * _UNFILTERED / shorter)
    filtered = 0.0
    if bend > low:
        # resolves the oscillations of the Bessel functions, of period π in q L/2
        q, weight = gauss(_with_ripples(low, bend, longer), _NODES)
        # share of the power that remains, averaged over all directions
        count = 16 + np.ceil(0.5 * _ANGLES * max(size) * q).astype(np.int64)
        passed = np.empty_like(q)
        for part in np.array_split(np.arange(q.size), 1 + int(count.sum()) // _CHUNK):
            n = count[part]
            first, points = np.cumsum(n) - n, np.repeat(n, n)
            angle = (np.arange(points.size) - np.repeat(first, n) + 0.5) * (0.5 * np.pi / points)
            radius = np.repeat(0.5 * q[part], n)
            along_x, along_y = (
                [(2 * order + 1) * np.square(special.spherical_jn(order, x)) for order in range(degree + 1)]
                for x in (radius * size[0] * np.cos(angle), radius * size[1] * np.sin(angle))
            )
            fitted = sum(along_x[a] * along_y[b] for a in range(degree + 1) for b in range(degree + 1 - a))
            passed[part] = 1.0 - np.add.reduceat(fitted, first) / n
        filtered = float((weight * q * psd(q)) @ passed)
    if high > bend:
        start = max(bend, low)
        edges = np.geomspace(start, high, 2 + math.ceil(_PIECES * math.log10(high / start)))
        q, weight = gauss(edges, _NODES)
        filtered += float(weight @ (q * psd(q)))
    return filtered / (2.0 * np.pi)


def expected_difference_moments(
    psd: IsotropicPsd,
    spacing: float,
    *,
    shortest_wavelength: float,
    longest_wavelength: float,
    bends: Sequence[float] = (),
) -> tuple[float, float]:
    """Expected mean squares of the first (m2) and second (m4, 1/m²) differences over ``spacing`` Δ
    in m along a line.

    m2 = (1/2π) ∫ q C 2[1 - J0(qΔ)]/Δ² dq, m4 = (1/2π) ∫ q C 2[3 - 4 J0(qΔ) + J0(2qΔ)]/Δ⁴ dq over
    the waves between the two wavelengths in m. Compared with the moments of the continuous surface
    they show the error of the pixel size. ``bends``: wavelengths in m at which C has a kink, for
    accuracy beyond 1e-4. Raises InputError if the spacing or a wavelength is not positive.
    """
    require.positive(spacing, "spacing (m)")
    low = 2.0 * np.pi / require.positive(longest_wavelength, "longest wavelength (m)")
    high = 2.0 * np.pi / require.positive(shortest_wavelength, "shortest wavelength (m)")
    kinks = [wavenumber for wavenumber in (2.0 * np.pi / bend for bend in bends) if low < wavenumber < high]
    q, weight = gauss(np.unique(np.append(_with_ripples(low, high, 2.0 * spacing), kinks)), _NODES)
    density = weight * q * psd(q) / (2.0 * np.pi)
    # 1 - J0 cancels for waves much longer than the spacing; its series there is exact to rounding
    x = q * spacing
    first = np.where(x < 0.05, x**2 / 4.0 - x**4 / 64.0 + x**6 / 2304.0, 1.0 - special.j0(x))
    second = 3.0 / 16.0 * x**4 - 5.0 / 192.0 * x**6 + 7.0 / 4096.0 * x**8
    second = np.where(x < 0.05, second, 3.0 - 4.0 * special.j0(x) + special.j0(2.0 * x))
    return float(density @ (2.0 * first)) / spacing**2, float(density @ (2.0 * second)) / spacing**4


def effective_samples(spectrum: PowerSpectrum) -> float:
    """Number of independent heights N_eff = (Σ C)²/Σ C² of a Gaussian surface with this
    periodogram; NaN if flat.

    The relative scatter from map to map is sqrt(2/N_eff) for the mean square height and sqrt(1/(2
    N_eff)) for the rms height. The squares of a periodogram are on average twice the squared
    spectrum, which is accounted for.
    """
    columns = multiplicity(spectrum.grid)
    total = float(spectrum.psd.sum(axis=0) @ columns)
    squares = float(np.einsum("ij,ij->j", spectrum.psd, spectrum.psd) @ columns)
    return 2.0 * total**2 / squares if squares > 0.0 else math.nan


def _with_ripples(low: float, high: float, length: float) -> RealArray:
    """Edges of pieces, logarithmic and nowhere longer than one oscillation 2π/``length``."""
    edges = np.geomspace(low, high, 2 + math.ceil(_PIECES * math.log10(high / low)))
    pieces = [np.linspace(a, b, 2 + int((b - a) * length / (2.0 * np.pi)))[:-1] for a, b in pairwise(edges)]
    return np.append(np.concatenate(pieces), high)
