"""Surfaces by the two-dimensional digital filter of Hu & Tønder (1992): finite windows of an
endless surface, or periodic."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.citations import citation_keys
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.parameters import checked
from ...core.pearson import require_possible
from ...core.spectral import RealTransform, fast_length, mode_sum, thread_count
from ...core.units import show
from ..surface import Origin, Surface
from .gaussian import BLOCK, Spectrum, SurfaceSeed, block_noise, lattice_eigenvalues
from .non_gaussian import HeightKurtosis, HeightLaw, HeightSkewness, HeightSystem, height_law
from .power_laws import RmsHeight

# Moving-average kernel of a random surface: each height is a weighted sum of white noise around its
# node.
#
# Hu & Tønder (1992): z(I, J) = Σ α(k, l) η(I + k, J + l) with α = IFFT sqrt(FFT R), the zero-phase
# filter, has the autocovariance R. A kernel of finite reach needs no periodic domain.


_LARGEST_DOMAIN = 2**29  # points on which a kernel is computed: 4 GB
_ERROR_LIMIT = 1e-2  # largest error of the autocorrelation that cutting the kernel may make


@dataclass(frozen=True, eq=False)
class FilterKernel:
    """Kernel ``weights`` α(k, l) in m, shape (2K + 1, 2M + 1), centre in the middle, symmetric.

    ``spacing`` (dx, dy) in m for which it was made; ``error``: largest difference between its
    autocovariance and the one asked for, in units of the mean square.
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
    """Kernel of the digital filter for surfaces of ``spectrum`` with pixels ``spacing`` (dx, dy) in
    m.

    Raises InputError if the range is unknown, or the kernel decays so slowly that dropping changes
    the autocorrelation by 1e-2.

    Parameters
    ----------
    spectrum
        With ``correlation_range``, as have ``SelfAffine``, ``TwoSlopes`` and the autocorrelations.
    spacing
        (dx, dy) in m.
    reach
        Distance in m beyond which the weights are dropped (the rest is scaled to the same mean
        square); ``spectrum.correlation_range`` if omitted.
    """
    known = getattr(spectrum, "correlation_range", None)
    if reach is not None:
        length = require.positive(reach, "reach of a digital filter (m)")
    elif known is not None:
        length = float(known)
    else:
        raise InputError(
            "reach of a digital filter must be given for a spectrum without correlation_range, but is not."
        )
    # a periodic domain on which neither kernel nor autocovariance meets itself
    sides = getattr(spectrum, "embedding_lengths", (0.0, 0.0))
    nx, ny = (
        fast_length(int(np.ceil(max(4.0 * length, side) / d)) + 5) for side, d in zip(sides, spacing, strict=True)
    )
    if nx * ny > _LARGEST_DOMAIN:
        raise InputError(
            f"pixel of a digital filter must not be much smaller than its reach of {length:.3g} m, but "
            f"{spacing[0]:.3g} x {spacing[1]:.3g} m take {nx} x {ny} points. Enlarge the pixel or shorten the "
            "reach."
        )
    domain = Grid((nx, ny), spacing)
    values = lattice_eigenvalues(spectrum, domain)
    if values[0, 0] == 0.0 and np.isinf(getattr(spectrum, "longest_wavelength", np.inf)):
        # waves longer than the domain belong to an endless surface
        values[0, 0] = min(values[1, 0], values[0, 1])
        amplitude = getattr(spectrum, "amplitude", None)
        if isinstance(amplitude, RmsHeight):  # of all waves together
            values *= amplitude.value**2 / (mode_sum(domain, values) * domain.pixel_area)
    whole = zero_phase_weights(values, domain)
    counts = tuple(min(int(np.ceil(length / d)), (n - 1) // 4) for d, n in zip(spacing, domain.shape, strict=True))
    centred = np.roll(whole, [n // 2 for n in domain.shape], axis=(0, 1))
    kept = centred[tuple(slice(n // 2 - k, n // 2 + k + 1) for k, n in zip(counts, domain.shape, strict=True))]
    kept = kept * np.sqrt(np.sum(whole**2) / np.sum(kept**2))
    transform = RealTransform(domain.shape, thread_count())
    field = np.zeros(domain.shape)
    field[: kept.shape[0], : kept.shape[1]] = kept
    missed = np.square(np.abs(transform.forward(field))) - values
    error = float(np.abs(transform.backward(missed.astype(complex))).max() / np.sum(kept**2))
    if error > _ERROR_LIMIT:
        raise InputError(
            f"spectrum of a digital filter must have a kernel that dies out within {length:.3g} m, but "
            f"dropping the rest changes the autocorrelation by {error:.2g}. Give a longer reach, or use "
            "gaussian() with a roll-off."
        )
    return FilterKernel(kept, spacing, error)


def zero_phase_weights(eigenvalues: RealArray, grid: Grid) -> RealArray:
    """α (nx, ny) in m of the periodic filter, centre at node (0, 0), from the mean squares of the
    waves in m²."""
    return RealTransform(grid.shape, thread_count()).backward(np.sqrt(eigenvalues).astype(complex))


def cumulant_factors(weights: RealArray) -> tuple[float, float]:
    """N3 = Σα³/(Σα²)^(3/2) and N4 = Σα⁴/(Σα²)²: by what the filter reduces skewness and excess
    kurtosis of its input."""
    square = float(np.sum(weights**2))
    return float(np.sum(weights**3)) / square**1.5, float(np.sum(weights**4)) / square**2


_KEYS = ("HuTonder1992", "Salmon2011")
_NON_GAUSSIAN_KEY = "Chilamakuri1998"


@dataclass(frozen=True, eq=False)
class PreparedFilter:
    """The filter for windows of one ``shape``: transfer function (px, py // 2 + 1) in m on the
    padded window."""

    shape: tuple[int, int]
    padded: tuple[int, int]
    reach: tuple[int, int]
    transfer: RealArray


@dataclass(frozen=True, eq=False)
class EndlessSurface:
    """Surface without borders, of which any window can be had: the same node has the same height in
    every window.

    Heights are those of the infinite surface, of zero mean; mean and rms height of a window
    scatter. Windows agree up to rounding of the transform (1e-14 of the rms height). Made by
    :func:`endless`.
    """

    kernel: FilterKernel
    noise: HeightLaw
    seed: int
    origin: Origin

    def window(self, shape: tuple[int, int], first: tuple[int, int] = (0, 0)) -> Surface:
        """Surface on ``shape`` (nx, ny) nodes from the node ``first`` (i, j) of the endless one on,
        of either sign.

        Raises InputError if a number is not whole or a number of points is below 1.
        """
        nx, ny = (require.integer(n, 1, f"number of points along {a}") for n, a in zip(shape, "xy", strict=True))
        i, j = (require.integer(n, -(2**62), f"first node along {a}") for n, a in zip(first, "xy", strict=True))
        heights = self.heights(self.prepared((nx, ny)), (i, j))
        dx, dy = self.kernel.spacing
        origin = self.origin if (i, j) == (0, 0) else self.origin.continued(f"window from node ({i}, {j}) on")
        return Surface(heights, dx, dy, origin=origin)

    def prepared(self, shape: tuple[int, int]) -> PreparedFilter:
        """The filter for windows of ``shape``, to be applied many times."""
        k, m = self.kernel.reach
        padded = fast_length(shape[0] + 2 * k), fast_length(shape[1] + 2 * m)
        centred = np.zeros(padded)
        centred[: 2 * k + 1, : 2 * m + 1] = self.kernel.weights
        centred = np.roll(centred, (-k, -m), axis=(0, 1))
        # symmetric about node (0, 0), so its transform is real
        transfer = RealTransform(padded, thread_count()).forward(centred).real.copy()
        return PreparedFilter(shape, padded, (k, m), transfer)

    def heights(self, prepared: PreparedFilter, first: tuple[int, int]) -> RealArray:
        """Heights in m of the window at ``first`` by the ``prepared`` filter, from the noise of the
        window and around it (overlap-save)."""
        (k, m), (nx, ny) = prepared.reach, prepared.shape
        normal = block_noise((first[0] - k, first[1] - m), (nx + 2 * k, ny + 2 * m), self.seed)
        noise = self.noise.of_normal(normal)
        transform = RealTransform(prepared.padded, thread_count())
        field = np.zeros(prepared.padded)
        field[: noise.shape[0], : noise.shape[1]] = noise
        spectrum = transform.forward(field)
        spectrum *= prepared.transfer
        transform.backward(spectrum, out=field)
        return field[k : k + nx, m : m + ny]


def endless(
    spectrum: Spectrum,
    spacing: tuple[float, float],
    *,
    seed: int,
    skewness: float = 0.0,
    kurtosis: float = 3.0,
    system: str = "johnson",
    reach: float | None = None,
) -> EndlessSurface:
    """Endless surface with the given spectrum, for windows of any size and place, and for maps
    larger than the memory.

    White noise is drawn in blocks of 64 x 64 nodes, each with its own stream of the counter-based
    generator Philox, and filtered by a kernel of finite reach. Heights of other skewness or
    kurtosis come from noise whose cumulants are raised by what the filter takes away (Chilamakuri &
    Bhushan 1998). Raises InputError if the kernel does not die out, or no noise gives these heights
    through the filter.

    Parameters
    ----------
    spectrum
        ``SelfAffine`` or ``TwoSlopes`` with a plateau, an autocorrelation, or any with
        ``correlation_range``.
    spacing
        Pixel (dx, dy) in m.
    seed
        Whole number >= 0.
    skewness, kurtosis
        Of the heights of the infinite surface; 0 and 3 for Gaussian ones.
    system
        ``johnson`` or ``pearson``: of the distribution of the noise.
    reach
        Distance in m at which the kernel is cut; ``spectrum.correlation_range`` if omitted.
    """
    pair = require.two(spacing, "pixel of an endless surface (m)", "Write (dx, dy).")
    dx, dy = (
        require.positive(d, f"pixel of an endless surface along {a} (m)") for d, a in zip(pair, "xy", strict=True)
    )
    seed = require.integer(seed, 0, "seed of a random surface")
    kernel = filter_kernel(spectrum, (dx, dy), reach=reach)
    noise = input_noise(kernel.weights, skewness, kurtosis, system)
    grid = Grid((2 * kernel.reach[0] + 1, 2 * kernel.reach[1] + 1), (dx, dy))
    length = f"{show(kernel.reach[0] * dx, 'm')} x {show(kernel.reach[1] * dy, 'm')}"
    how = f"reach {length}, error of the autocorrelation {kernel.error:.1e}, Philox seed {seed}"
    # a grid on which the spectrum can be described: at least as large as its embedding
    sides = getattr(spectrum, "embedding_lengths", (0.0, 0.0))
    nx, ny = (max(n, int(np.ceil(side / d))) for n, side, d in zip(grid.shape, sides, grid.spacing, strict=True))
    origin = _origin(spectrum, Grid((nx, ny), grid.spacing), (skewness, kurtosis), noise, how)
    return EndlessSurface(kernel, noise, seed, origin)


@checked
def digital_filter(
    grid: Grid,
    spectrum: Annotated[Spectrum, "spectrum"],
    *,
    seed: SurfaceSeed,
    skewness: HeightSkewness = 0.0,
    kurtosis: HeightKurtosis = 3.0,
    system: HeightSystem = "johnson",
    periodic: Annotated[bool, "periodic surface, or a window of an endless one"] = False,
) -> Surface:
    """Surface by the digital filter of Hu & Tønder (1992), with given skewness and kurtosis of the
    heights.

    The autocovariance is exact; skewness and kurtosis are those of the infinite surface, and
    scatter in a realisation. The mean is not removed. The closer the noise must come to the limit
    of what a distribution can be, the rarer and higher its spikes, and the larger this scatter. A
    window lies at node (0, 0) of the endless surface; a periodic one needs no ``correlation_range``
    of its spectrum. Raises InputError if no noise gives these heights through the filter, or the
    grid does not suit the spectrum.
    """
    if not periodic:
        made = endless(spectrum, grid.spacing, seed=seed, skewness=skewness, kurtosis=kurtosis, system=system)
        return made.window(grid.shape)
    eigenvalues = lattice_eigenvalues(spectrum, grid)
    noise = input_noise(zero_phase_weights(eigenvalues, grid), skewness, kurtosis, system)
    transform = RealTransform(grid.shape, thread_count())
    modes = transform.forward(noise.of_normal(block_noise((0, 0), grid.shape, seed)))
    modes *= np.sqrt(eigenvalues)
    dx, dy = grid.spacing
    origin = _origin(spectrum, grid, (skewness, kurtosis), noise, f"periodic noise, Philox seed {seed}")
    return Surface(transform.backward(modes), dx, dy, periodic=True, origin=origin)


def input_noise(weights: RealArray, skewness: float, kurtosis: float, system: str = "johnson") -> HeightLaw:
    """Distribution of the noise from which the filter ``weights`` make heights of this skewness and
    kurtosis.

    Third and fourth cumulants are reduced by N3 and N4, so Ssk_η = Ssk/N3 and Sku_η = 3 + (Sku -
    3)/N4. Raises InputError if that noise would have a kurtosis below 1 + skewness².
    """
    require_possible(skewness, kurtosis)
    third, fourth = cumulant_factors(weights)
    skew, kurt = skewness / third, 3.0 + (kurtosis - 3.0) / fourth
    if kurt < 1.0 + skew**2:
        least = 3.0 - 2.0 * fourth + skewness**2 * fourth / third**2
        raise InputError(
            f"kurtosis of the heights at skewness {skewness:.4g} must be at least {least:.4g} for this digital "
            f"filter, which averages over many nodes (N3 = {third:.3g}, N4 = {fourth:.3g}), but is "
            f"{kurtosis:.4g}. Use rank_ordered() or translated(), or larger pixels."
        )
    return height_law(skew, kurt, system)


def _origin(spectrum: Spectrum, grid: Grid, moments: tuple[float, float], noise: HeightLaw, how: str) -> Origin:
    gaussian = moments == (0.0, 3.0)
    heights = "" if gaussian else f", skewness {moments[0]:.4g}, kurtosis {moments[1]:.4g} ({noise.label} noise)"
    text = f"generated: digital filter in blocks of {BLOCK} nodes, {spectrum.describe(grid)}{heights}, {how}"
    keys = (*citation_keys(spectrum), *_KEYS, *(() if gaussian else (_NON_GAUSSIAN_KEY, *noise.citation_keys)))
    return Origin(source="digital filter", history=(text,), citation_keys=tuple(dict.fromkeys(keys)))
