"""Moving-average kernel of a random surface: each height is a weighted sum of white noise around its node.

Hu & Tønder (1992): z(I, J) = Σ α(k, l) η(I + k, J + l) with α = IFFT sqrt(FFT R), the zero-phase filter, has the
autocovariance R. A kernel of finite reach needs no periodic domain.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.spectral import RealTransform, fast_length, thread_count
from .amplitude import RmsHeight
from .embedding import Spectrum, lattice_eigenvalues
from .modes import mode_sum

_LARGEST_DOMAIN = 2**29  # points on which a kernel is computed: 4 GB
_ERROR_LIMIT = 1e-2  # largest error of the autocorrelation that cutting the kernel may make


@dataclass(frozen=True, eq=False)
class FilterKernel:
    """Kernel ``weights`` α(k, l) in m, shape (2K + 1, 2M + 1), centre in the middle, symmetric.

    ``spacing`` (dx, dy) in m for which it was made; ``error``: largest difference between its autocovariance and the
    one asked for, in units of the mean square.
    """

    weights: RealArray
    spacing: tuple[float, float]
    error: float

    @property
    def reach(self) -> tuple[int, int]:
        """Pixels (K, M) from the centre to the last weight along x and y."""
        return self.weights.shape[0] // 2, self.weights.shape[1] // 2

    @property
    def rms_height(self) -> float:
        """sqrt(Σ α²) in m."""
        return float(np.sqrt(np.sum(np.square(self.weights))))


def filter_kernel(spectrum: Spectrum, spacing: tuple[float, float], *, reach: float | None = None) -> FilterKernel:
    """Kernel of the digital filter for surfaces of ``spectrum`` with pixels ``spacing`` (dx, dy) in m.

    Parameters
    ----------
    spectrum
        With ``correlation_range``, as have ``SelfAffine``, ``TwoSlopes`` and the autocorrelations.
    spacing
        (dx, dy) in m.
    reach
        Distance in m beyond which the weights are dropped (the rest is scaled to the same mean square);
        ``spectrum.correlation_range`` if omitted.

    Raises
    ------
    InputError
        If the range is unknown, or the kernel decays so slowly that dropping changes the autocorrelation by 1e-2.
    """
    length = _reach(spectrum, reach)
    domain = _domain(spectrum, spacing, length)
    values = _endless_eigenvalues(spectrum, domain)
    whole = zero_phase_weights(values, domain)
    counts = tuple(min(int(np.ceil(length / d)), (n - 1) // 4) for d, n in zip(spacing, domain.shape, strict=True))
    centred = np.roll(whole, [n // 2 for n in domain.shape], axis=(0, 1))
    kept = centred[tuple(slice(n // 2 - k, n // 2 + k + 1) for k, n in zip(counts, domain.shape, strict=True))]
    kept = kept * np.sqrt(np.sum(whole**2) / np.sum(kept**2))
    error = _autocovariance_error(kept, values, domain)
    if error > _ERROR_LIMIT:
        raise InputError(
            f"spectrum of a digital filter must have a kernel that dies out within {length:.3g} m, but dropping the rest "
            f"changes the autocorrelation by {error:.2g}. Give a longer reach, or use gaussian() with a roll-off."
        )
    return FilterKernel(kept, spacing, error)


def zero_phase_weights(eigenvalues: RealArray, grid: Grid) -> RealArray:
    """α (nx, ny) in m of the periodic filter, centre at node (0, 0), from the mean squares of the waves in m²."""
    return RealTransform(grid.shape, thread_count()).backward(np.sqrt(eigenvalues).astype(complex))


def cumulant_factors(weights: RealArray) -> tuple[float, float]:
    """N3 = Σα³/(Σα²)^(3/2) and N4 = Σα⁴/(Σα²)²: by what the filter reduces skewness and excess kurtosis of its input."""
    square = float(np.sum(weights**2))
    return float(np.sum(weights**3)) / square**1.5, float(np.sum(weights**4)) / square**2


def _reach(spectrum: Spectrum, reach: float | None) -> float:
    if reach is not None:
        return require.positive(reach, "reach of a digital filter (m)")
    known = getattr(spectrum, "correlation_range", None)
    if known is None:
        raise InputError(
            "reach of a digital filter must be given for a spectrum without correlation_range, but is not."
        )
    return float(known)


def _domain(spectrum: Spectrum, spacing: tuple[float, float], reach: float) -> Grid:
    """Periodic grid on which neither kernel nor autocovariance meets itself."""
    sides = getattr(spectrum, "embedding_lengths", (0.0, 0.0))
    nx, ny = (fast_length(int(np.ceil(max(4.0 * reach, side) / d)) + 5) for side, d in zip(sides, spacing, strict=True))
    if nx * ny > _LARGEST_DOMAIN:
        raise InputError(
            f"pixel of a digital filter must not be much smaller than its reach of {reach:.3g} m, but {spacing[0]:.3g} x "
            f"{spacing[1]:.3g} m take {nx} x {ny} points. Enlarge the pixel or shorten the reach."
        )
    return Grid((nx, ny), spacing)


def _endless_eigenvalues(spectrum: Spectrum, domain: Grid) -> RealArray:
    """Mean squares of the waves in m² of an endless surface: those longer than the domain belong to it."""
    values = lattice_eigenvalues(spectrum, domain)
    if values[0, 0] == 0.0 and np.isinf(getattr(spectrum, "longest_wavelength", np.inf)):
        values[0, 0] = min(values[1, 0], values[0, 1])
        amplitude = getattr(spectrum, "amplitude", None)
        if isinstance(amplitude, RmsHeight):  # of all waves together
            values *= amplitude.value**2 / (mode_sum(domain, values) * domain.pixel_area)
    return values


def _autocovariance_error(kept: RealArray, eigenvalues: RealArray, domain: Grid) -> float:
    transform = RealTransform(domain.shape, thread_count())
    field = np.zeros(domain.shape)
    field[: kept.shape[0], : kept.shape[1]] = kept
    power = np.square(np.abs(transform.forward(field))) - eigenvalues
    return float(np.abs(transform.backward(power.astype(complex))).max() / np.sum(kept**2))
