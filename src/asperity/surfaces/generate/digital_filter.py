"""Surfaces by the two-dimensional digital filter of Hu & Tønder (1992): finite windows of an endless surface, or periodic."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.citations import citation_keys
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.pearson import require_possible
from ...core.spectral import RealTransform, fast_length, thread_count
from ...core.units import show
from ..surface import Origin, Surface
from .embedding import Spectrum, lattice_eigenvalues
from .height_law import HeightLaw, height_law
from .kernel import FilterKernel, cumulant_factors, filter_kernel, zero_phase_weights
from .noise import BLOCK, block_noise

_KEYS = ("HuTonder1992", "Salmon2011")
_NON_GAUSSIAN_KEY = "Chilamakuri1998"


@dataclass(frozen=True, eq=False)
class PreparedFilter:
    """The filter for windows of one ``shape``: transfer function (px, py // 2 + 1) in m on the padded window."""

    shape: tuple[int, int]
    padded: tuple[int, int]
    reach: tuple[int, int]
    transfer: RealArray

    def filtered(self, noise: RealArray) -> RealArray:
        """Heights (nx, ny) in m from the ``noise`` of the window and of ``reach`` nodes around it (overlap-save)."""
        transform = RealTransform(self.padded, thread_count())
        field = np.zeros(self.padded)
        field[: noise.shape[0], : noise.shape[1]] = noise
        spectrum = transform.forward(field)
        spectrum *= self.transfer
        transform.backward(spectrum, out=field)
        (k, m), (nx, ny) = self.reach, self.shape
        return field[k : k + nx, m : m + ny]


@dataclass(frozen=True, eq=False)
class EndlessSurface:
    """Surface without borders, of which any window can be had: the same node has the same height in every window.

    Heights are those of the infinite surface, of zero mean; mean and rms height of a window scatter. Windows agree
    up to rounding of the transform (1e-14 of the rms height). Made by :func:`endless`.
    """

    kernel: FilterKernel
    noise: HeightLaw
    seed: int
    origin: Origin

    def window(self, shape: tuple[int, int], first: tuple[int, int] = (0, 0)) -> Surface:
        """Surface on ``shape`` (nx, ny) nodes from the node ``first`` (i, j) of the endless one on, of either sign.

        Raises
        ------
        InputError
            If a number is not whole or a number of points is below 1.
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
        """Heights in m of the window at ``first`` by the ``prepared`` filter."""
        (k, m), (nx, ny) = prepared.reach, prepared.shape
        noise = block_noise((first[0] - k, first[1] - m), (nx + 2 * k, ny + 2 * m), self.seed)
        return prepared.filtered(self.noise.of_normal(noise))


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
    """Endless surface with the given spectrum, for windows of any size and place, and for maps larger than the memory.

    White noise is drawn in blocks of 64 x 64 nodes, each with its own stream of the counter-based generator Philox,
    and filtered by a kernel of finite reach. Heights of other skewness or kurtosis come from noise whose cumulants are
    raised by what the filter takes away (Chilamakuri & Bhushan 1998).

    Parameters
    ----------
    spectrum
        ``SelfAffine`` or ``TwoSlopes`` with a plateau, an autocorrelation, or any with ``correlation_range``.
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

    Raises
    ------
    InputError
        If the kernel does not die out, or no noise gives these heights through the filter.
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
    origin = _origin(spectrum, _embedded(spectrum, grid), (skewness, kurtosis), noise, how)
    return EndlessSurface(kernel, noise, seed, origin)


def digital_filter(
    grid: Grid,
    spectrum: Spectrum,
    *,
    seed: int,
    skewness: float = 0.0,
    kurtosis: float = 3.0,
    system: str = "johnson",
    periodic: bool = False,
) -> Surface:
    """Surface by the digital filter of Hu & Tønder (1992), with given skewness and kurtosis of the heights.

    The autocovariance is exact; skewness and kurtosis are those of the infinite surface, and scatter in a realisation.
    The mean is not removed. The closer the noise must come to the limit of what a distribution can be, the rarer
    and higher its spikes, and the larger this scatter.

    Parameters
    ----------
    grid
        Nodes of the surface.
    spectrum
        As for :func:`endless`; a periodic surface needs no ``correlation_range``.
    seed, skewness, kurtosis, system
        As for :func:`endless`.
    periodic
        Filter a periodic field of noise. Otherwise the surface is the window at node (0, 0) of the endless one.

    Raises
    ------
    InputError
        If no noise gives these heights through the filter, or the grid does not suit the spectrum.
    """
    if not periodic:
        made = endless(spectrum, grid.spacing, seed=seed, skewness=skewness, kurtosis=kurtosis, system=system)
        return made.window(grid.shape)
    seed = require.integer(seed, 0, "seed of a random surface")
    eigenvalues = lattice_eigenvalues(spectrum, grid)
    noise = input_noise(zero_phase_weights(eigenvalues, grid), skewness, kurtosis, system)
    transform = RealTransform(grid.shape, thread_count())
    modes = transform.forward(noise.of_normal(block_noise((0, 0), grid.shape, seed)))
    modes *= np.sqrt(eigenvalues)
    dx, dy = grid.spacing
    origin = _origin(spectrum, grid, (skewness, kurtosis), noise, f"periodic noise, Philox seed {seed}")
    return Surface(transform.backward(modes), dx, dy, periodic=True, origin=origin)


def input_noise(weights: RealArray, skewness: float, kurtosis: float, system: str = "johnson") -> HeightLaw:
    """Distribution of the noise from which the filter ``weights`` make heights of this skewness and kurtosis.

    Third and fourth cumulants are reduced by N3 and N4, so Ssk_η = Ssk/N3 and Sku_η = 3 + (Sku - 3)/N4.

    Raises
    ------
    InputError
        If that noise would have a kurtosis below 1 + skewness².
    """
    require_possible(skewness, kurtosis)
    third, fourth = cumulant_factors(weights)
    skew, kurt = skewness / third, 3.0 + (kurtosis - 3.0) / fourth
    if kurt < 1.0 + skew**2:
        least = 3.0 - 2.0 * fourth + skewness**2 * fourth / third**2
        raise InputError(
            f"kurtosis of the heights at skewness {skewness:.4g} must be at least {least:.4g} for this digital filter, which "
            f"averages over many nodes (N3 = {third:.3g}, N4 = {fourth:.3g}), but is {kurtosis:.4g}. "
            "Use rank_ordered() or translated(), or larger pixels."
        )
    return height_law(skew, kurt, system)


def _embedded(spectrum: Spectrum, grid: Grid) -> Grid:
    """A grid on which ``spectrum`` can be described: at least as large as its embedding."""
    sides = getattr(spectrum, "embedding_lengths", (0.0, 0.0))
    nx, ny = (max(n, int(np.ceil(side / d))) for n, side, d in zip(grid.shape, sides, grid.spacing, strict=True))
    return Grid((nx, ny), grid.spacing)


def _origin(spectrum: Spectrum, grid: Grid, moments: tuple[float, float], noise: HeightLaw, how: str) -> Origin:
    gaussian = moments == (0.0, 3.0)
    heights = "" if gaussian else f", skewness {moments[0]:.4g}, kurtosis {moments[1]:.4g} ({noise.label} noise)"
    text = f"generated: digital filter in blocks of {BLOCK} nodes, {spectrum.describe(grid)}{heights}, {how}"
    keys = (*citation_keys(spectrum), *_KEYS, *(() if gaussian else (_NON_GAUSSIAN_KEY, *noise.citation_keys)))
    return Origin(source="digital filter", history=(text,), citation_keys=tuple(dict.fromkeys(keys)))
