"""What an isotropic random surface of known spectrum shows on a window of finite size and pixel.

The spectra are functions C(q) in the convention of Jacobs, Junge & Pastewka (2017), such as the method ``psd`` of
``SpectralModel`` or ``SelfAffine``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from .spectrum import PowerSpectrum

IsotropicPsd: TypeAlias = Callable[[RealArray], RealArray]
"""C in m⁴ at wavenumbers in rad/m."""

DEGREES = {"mean": 0, "plane": 1, "quadratic": 2}
"""Degree of the polynomial that levelling by a form removes."""

_NODES = 10  # Gauss-Legendre nodes of a piece
_PIECES = 12  # pieces per factor of ten of wavenumber
_UNFILTERED = 150.0  # q L/2 beyond which levelling passes all but 1e-4 of the power
_ANGLES = 3.0  # trapezoidal points on a quarter circle per unit of q L/2


def mean_square_after_levelling(
    psd: IsotropicPsd,
    size: tuple[float, float],
    form: str = "plane",
    *,
    shortest_wavelength: float,
    longest_wavelength: float = math.inf,
) -> float:
    """Expected mean square height in m² of a window after removal of the mean, plane or quadratic.

    E = (1/4π²) ∫ C(q) [1 - Σ_(a+b<=d) (2a+1)(2b+1) j_a²(q_x Lx/2) j_b²(q_y Ly/2)] d²q, spherical Bessel functions j, for
    the continuous window ``size`` (Lx, Ly) in m and waves between the two wavelengths in m. Accurate to about 1e-4.

    Raises
    ------
    InputError
        If the form is unknown or a length is not positive.
    """
    degree = DEGREES[require.one_of(form, DEGREES, "form to be removed")]
    shorter, longer = sorted(require.positive(side, "side of a window (m)") for side in size)
    high = 2.0 * np.pi / require.positive(shortest_wavelength, "shortest wavelength (m)")
    low = max(2.0 * np.pi / longest_wavelength, 1e-3 / longer)  # longer waves are planes to 1e-6 of the window
    bend = min(high, 2.0 * _UNFILTERED / shorter)
    filtered = 0.0
    if bend > low:
        # as fine as the ripples of the Bessel functions, which repeat every π in q L/2
        q, weight = _nodes(_with_ripples(low, bend, longer))
        passed = np.array([_passed(float(wavenumber), size, degree) for wavenumber in q])
        filtered = float((weight * q * psd(q)) @ passed)
    if high > bend:
        q, weight = _nodes(_logarithmic(max(bend, low), high))
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
    """Expected mean squares of the first (m2) and second (m4, 1/m²) differences over ``spacing`` Δ in m along a line.

    m2 = (1/2π) ∫ q C 2[1 - J0(qΔ)]/Δ² dq, m4 = (1/2π) ∫ q C 2[3 - 4 J0(qΔ) + J0(2qΔ)]/Δ⁴ dq over the waves between the
    two wavelengths in m. Against the moments of the continuous surface they tell how far the pixel is too coarse.
    ``bends``: wavelengths in m at which C has a kink, for accuracy beyond 1e-4.

    Raises
    ------
    InputError
        If the spacing or a wavelength is not positive.
    """
    from scipy.special import j0

    require.positive(spacing, "spacing (m)")
    low = 2.0 * np.pi / require.positive(longest_wavelength, "longest wavelength (m)")
    high = 2.0 * np.pi / require.positive(shortest_wavelength, "shortest wavelength (m)")
    kinks = [wavenumber for wavenumber in (2.0 * np.pi / bend for bend in bends) if low < wavenumber < high]
    q, weight = _nodes(np.unique(np.append(_with_ripples(low, high, 2.0 * spacing), kinks)))
    density = weight * q * psd(q) / (2.0 * np.pi)
    # 1 - J0 cancels for waves much longer than the spacing; its series there is exact to rounding
    x = q * spacing
    first = np.where(x < 0.05, x**2 / 4.0 - x**4 / 64.0 + x**6 / 2304.0, 1.0 - j0(x))
    second = 3.0 / 16.0 * x**4 - 5.0 / 192.0 * x**6 + 7.0 / 4096.0 * x**8
    second = np.where(x < 0.05, second, 3.0 - 4.0 * j0(x) + j0(2.0 * x))
    return float(density @ (2.0 * first)) / spacing**2, float(density @ (2.0 * second)) / spacing**4


def effective_samples(spectrum: PowerSpectrum) -> float:
    """Number of independent heights N_eff = (Σ C)²/Σ C² of a Gaussian surface with this periodogram; NaN if it is flat.

    The mean square height then scatters by sqrt(2/N_eff) from map to map, the rms height by sqrt(1/(2 N_eff)). The
    squares of a periodogram are twice the squared spectrum on average, which is taken into account.
    """
    grid = spectrum.grid
    columns = np.full(spectrum.psd.shape[1], 2.0)
    columns[0] = 1.0
    if grid.shape[1] % 2 == 0:
        columns[-1] = 1.0
    total = float(spectrum.psd.sum(axis=0) @ columns)
    squares = float(np.einsum("ij,ij->j", spectrum.psd, spectrum.psd) @ columns)
    return 2.0 * total**2 / squares if squares > 0.0 else math.nan


def _passed(q: float, size: tuple[float, float], degree: int) -> float:
    """Share of a wave of wavenumber ``q`` that the levelling of a window passes, averaged over all directions."""
    reach = 0.5 * q * max(size)
    count = 16 + math.ceil(_ANGLES * reach)
    angle = (np.arange(count) + 0.5) * (0.5 * np.pi / count)
    along_x = _bessel_squares(0.5 * q * size[0] * np.cos(angle), degree)
    along_y = _bessel_squares(0.5 * q * size[1] * np.sin(angle), degree)
    fitted = sum(along_x[a] @ along_y[b] for a in range(degree + 1) for b in range(degree + 1 - a))
    return 1.0 - float(fitted) / count


def _bessel_squares(x: RealArray, degree: int) -> list[RealArray]:
    from scipy.special import spherical_jn

    return [(2 * order + 1) * np.square(spherical_jn(order, x)) for order in range(degree + 1)]


def _logarithmic(low: float, high: float) -> RealArray:
    return np.geomspace(low, high, 2 + math.ceil(_PIECES * math.log10(high / low)))


def _with_ripples(low: float, high: float, length: float) -> RealArray:
    """Edges of pieces, logarithmic and nowhere longer than one ripple 2π/``length``."""
    edges = _logarithmic(low, high)
    pieces = [np.linspace(a, b, 2 + int((b - a) * length / (2.0 * np.pi)))[:-1] for a, b in pairwise(edges)]
    return np.append(np.concatenate(pieces), high)


def _nodes(edges: RealArray) -> tuple[RealArray, RealArray]:
    """Gauss-Legendre nodes and weights on the pieces between ``edges``."""
    x, w = np.polynomial.legendre.leggauss(_NODES)
    half = 0.5 * np.diff(edges)[:, None]
    middle = 0.5 * (edges[1:] + edges[:-1])[:, None]
    return (middle + half * x).ravel(), (half * w).ravel()
