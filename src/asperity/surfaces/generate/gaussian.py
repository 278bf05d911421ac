"""Gaussian random surfaces by filtered white noise."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal, Protocol, TypeAlias, runtime_checkable

import numpy as np

from ...core.arrays import ComplexArray, RealArray
from ...core.citations import citation_keys
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.parameters import checked
from ...core.spectral import RealTransform, fast_length, mode_sum, thread_count
from ...core.units import show
from ...core.values import Seed
from ..surface import Surface, generated
from .power_laws import mean_square

SurfaceSeed: TypeAlias = Annotated[Seed, "seed of the random numbers; equal seeds give equal surfaces"]

# From an autocovariance function to the spectrum of a periodic lattice: circulant embedding.
#
# The autocovariance is sampled at the shortest periodic lags and transformed, so that every lag of
# the lattice up to half the domain is met exactly. Cutting the continuous spectrum at the Nyquist
# wavenumber instead would lose variance, and even more slope. Source: Dietrich & Newsam (1997).


CLIP_LIMIT = 1e-4
"""Largest negative part of a circulant spectrum, relative to its positive part, that may be
clipped."""


class Spectrum(Protocol):
    """Isotropic or anisotropic spectrum from which a periodic random surface can be generated.

    Optional attributes: ``correlation_range`` (m), the distance beyond which heights are
    uncorrelated, for surfaces that are not periodic; ``citation_keys``.
    """

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0."""

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""


@runtime_checkable
class Autocovariance(Protocol):
    """Autocovariance function of a surface."""

    @property
    def embedding_lengths(self) -> tuple[float, float]:
        """Sides in m of a periodic domain that is large enough for this autocovariance."""

    def autocovariance(self, x: RealArray, y: RealArray) -> RealArray:
        """R(x, y) in m² at the lags ``x`` and ``y`` in m, broadcast against each other."""


def lattice_eigenvalues(spectrum: Spectrum, grid: Grid) -> RealArray:
    """Mean square of the waves of a random field in m², C/(dx dy), shape (nx, ny // 2 + 1).

    The zero mode is that of the autocovariance where ``spectrum`` is given by one, so that the mean
    of a realisation fluctuates as in any window of an infinite surface; it is zero for a spectrum
    given by C.
    """
    if isinstance(spectrum, Autocovariance):
        return clipped_eigenvalues(spectrum, grid)
    return spectrum.lattice_psd(grid) / grid.pixel_area


def eigenvalues(model: Autocovariance, grid: Grid) -> RealArray:
    """FFT of the wrapped autocovariance in m², shape (nx, ny // 2 + 1); C = dx dy times it; may be
    negative."""
    (nx, ny), (dx, dy) = grid.shape, grid.spacing
    x, y = np.arange(nx), np.arange(ny)
    lag_x, lag_y = (
        np.minimum(x, nx - x)[:, None] * dx,
        np.minimum(y, ny - y)[None, :] * dy,
    )  # the shortest, not negative
    return RealTransform(grid.shape, thread_count()).forward(model.autocovariance(lag_x, lag_y)).real


def clipped_eigenvalues(model: Autocovariance, grid: Grid) -> RealArray:
    """Eigenvalues in m² without their negative part.

    Raises InputError if the grid is so small that the negative part exceeds 1e-4 of the positive
    one.
    """
    values = eigenvalues(model, grid)
    if negative_part(grid, values) > CLIP_LIMIT:
        length_x, length_y = model.embedding_lengths
        raise InputError(
            f"grid size must be about {length_x:.3g} x {length_y:.3g} m or more for a periodic surface of this "
            f"autocorrelation, but is {grid.size[0]:.3g} x {grid.size[1]:.3g} m. Enlarge the grid and crop the result."
        )
    return np.maximum(values, 0.0)


def negative_part(grid: Grid, values: RealArray) -> float:
    """Sum of the negative eigenvalues over that of the positive ones."""
    return mode_sum(grid, np.maximum(-values, 0.0)) / mode_sum(grid, np.maximum(values, 0.0))


# White noise: standard normal numbers in an order that no machine, thread count or tiling changes.
#
# Streams are those of NumPy's bit generators PCG64 and Philox (Salmon et al. 2011), which NumPy
# keeps fixed, turned into normal numbers by ``Generator.standard_normal``; a test holds their first
# values.


BLOCK = 64
"""Nodes along the side of a block of noise that has a stream of its own."""


def sub_seeds(seed: int, count: int) -> tuple[int, ...]:
    """Seeds of ``count`` independent streams that belong to one ``seed``, by NumPy's
    ``SeedSequence``."""
    return tuple(int(number) for number in np.random.SeedSequence(seed).generate_state(count, np.uint64))


def node_noise(shape: tuple[int, int], seed: int) -> RealArray:
    """White noise at the nodes (nx, ny): PCG64 of ``seed``, drawn in the order of the array."""
    return np.random.Generator(np.random.PCG64(seed)).standard_normal(shape)


def noise_rows(shape: tuple[int, int], seed: int, rows: int) -> Iterator[RealArray]:
    """:func:`node_noise`, ``rows`` rows (the last time fewer) at a time."""
    draw = np.random.Generator(np.random.PCG64(seed))
    for start in range(0, shape[0], rows):
        yield draw.standard_normal((min(rows, shape[0] - start), shape[1]))


def block_noise(first: tuple[int, int], shape: tuple[int, int], seed: int) -> RealArray:
    """White noise (nx, ny) at the nodes of an infinite lattice from the node ``first`` (of either
    sign) on.

    The lattice is cut into blocks of 64 x 64 nodes. Block (bx, by) is drawn from Philox with the
    key ``seed`` and the counter (0, 0, bx, by), so that each node has the same number in whatever
    window it is asked for.
    """
    noise = np.empty(shape)
    starts_x, starts_y = (range(f // BLOCK, -(-(f + n) // BLOCK)) for f, n in zip(first, shape, strict=True))
    for block_x in starts_x:
        for block_y in starts_y:
            inside, part = [], []
            for block, f, n in zip((block_x, block_y), first, shape, strict=True):
                low, high = max(f, block * BLOCK), min(f + n, (block + 1) * BLOCK)
                inside.append(slice(low - f, high - f))
                part.append(slice(low - block * BLOCK, high - block * BLOCK))
            counter = np.array([0, 0, block_x % 2**64, block_y % 2**64], dtype=np.uint64)
            draw = np.random.Generator(np.random.Philox(key=seed, counter=counter))
            noise[inside[0], inside[1]] = draw.standard_normal((BLOCK, BLOCK))[part[0], part[1]]
    return noise


def wave_noise(shape: tuple[int, int], seed: int) -> ComplexArray:
    """FFT (nx, ny // 2 + 1) of white noise whose waves are numbered by their whole wavenumbers (kx,
    ky).

    The complex amplitudes are drawn (PCG64 of ``seed``) ring by ring of max(|kx|, |ky|), so a finer
    grid of the same size has the waves of the coarser one and further ones. The zero mode is zero.
    """
    (nx, ny), draw = shape, np.random.Generator(np.random.PCG64(seed))
    half = np.zeros((nx, ny // 2 + 1), dtype=complex)
    for ring in range(1, max(nx, ny) // 2 + 1):
        waves = draw.standard_normal(8 * ring).view(complex)  # 4 ring waves; the opposite ones are their conjugates
        # in the order (r, 0…r), (-r, 1…r), (-r+1…r-1, r), where the grid has them
        if ring <= nx // 2:
            count = min(ring, ny // 2)
            half[ring, : count + 1] = waves[: count + 1]
            if 2 * ring != nx:
                half[-ring, 1 : count + 1] = waves[ring + 1 : ring + 1 + count]
        if ring <= ny // 2:
            across = waves[2 * ring + 1 :]  # kx from -r + 1 to r - 1
            reach = min(ring - 1, nx // 2)
            half[: reach + 1, ring] = across[ring - 1 : ring + reach]
            negative = min(ring - 1, (nx - 1) // 2)
            if negative:
                half[-negative:, ring] = across[ring - 1 - negative : ring - 1]
    # the columns that are their own mirror image (ky = 0 and the Nyquist column) have the symmetry
    # of a real field
    for column in (0, ny // 2) if ny % 2 == 0 else (0,):
        positive = half[1 : (nx - 1) // 2 + 1, column]
        if positive.size:
            half[-positive.size :, column] = positive[::-1].conj()
        for row in (0, nx // 2) if nx % 2 == 0 else (0,):
            half[row, column] = np.sqrt(2.0) * half[row, column].real
    half *= np.sqrt(0.5 * nx * ny)
    return half


VARIANTS = {"random": "PCG64", "fixed": "fixed amplitudes and phases of PCG64", "nested": "nested waves of PCG64"}
"""How the waves of a realisation are drawn, with the words for its history."""

_LARGEST_PARENT = 2**29  # points of the periodic map from which a window is cut: 4 GB of heights


@checked
def gaussian(
    grid: Grid,
    spectrum: Annotated[Spectrum, "spectrum"],
    *,
    seed: SurfaceSeed,
    variant: Annotated[
        Literal["random", "fixed", "nested"], "how waves are drawn; nested shows one surface on grids of any pixel"
    ] = "random",
    exact_rms: Annotated[bool, "rescale the surface to the expected rms height"] = False,
    periodic: Annotated[bool, "periodic surface, or a window of one"] = True,
) -> Surface:
    """Gaussian surface with the given power spectrum.

    White noise η (standard normal) is filtered: h = IFFT[FFT[η] sqrt(C/(dx dy))]. Equal seeds give
    equal surfaces on every machine and for every number of threads, up to rounding of the
    transform. Raises InputError if the seed is not a whole number >= 0, the variant is unknown or
    the grid does not suit the spectrum.

    Parameters
    ----------
    grid, spectrum, seed
        Nodes; ``SelfAffine``, ``ExponentialAutocorrelation`` or any object with ``lattice_psd`` and
        ``describe`` (and ``citation_keys``); whole number >= 0.
    variant
        ``random``: noise at the nodes (PCG64, in the order of the array); amplitudes and phases are
        random, so a mode has the power C only on average and the rms height of one realisation
        scatters. ``fixed``: the same phases with all amplitudes equal to sqrt(C); spectrum and rms
        height are exact in every realisation, heights are Gaussian by the central limit theorem
        only (Wu 2000). ``nested``: noise numbered by wave instead of by node, so that grids of one
        size and different pixels show the same surface: for studies of the mesh.
    exact_rms
        Rescale this realisation to the expected rms height. That is another ensemble: mean square
        slopes and curvatures are then biased by up to the relative variance of the mean square
        height.
    periodic
        If false, a window of a periodic surface that is longer by ``spectrum.correlation_range``
        (twice as long if the spectrum has none), so that opposite borders are independent. Its
        mean, tilt and rms height scatter.
    """
    parent = grid
    if not periodic:
        reach = getattr(spectrum, "correlation_range", None)
        sides = getattr(spectrum, "embedding_lengths", (0.0, 0.0))
        margins = grid.size if reach is None else (float(reach), float(reach))
        lengths = [max(size + margin, side) for size, margin, side in zip(grid.size, margins, sides, strict=True)]
        nx, ny = (fast_length(int(np.ceil(length / d))) for length, d in zip(lengths, grid.spacing, strict=True))
        if nx * ny > _LARGEST_PARENT:
            raise InputError(
                "grid of a window must not be much smaller than the longest waves of the spectrum, but "
                f"{grid.size[0]:.3g} x {grid.size[1]:.3g} m would be cut from {nx} x {ny} points. Enlarge the "
                "window or shorten the waves."
            )
        parent = Grid((nx, ny), grid.spacing)
    psd = spectrum.lattice_psd(parent)
    target = np.sqrt(mean_square(parent, psd))
    transform = RealTransform(parent.shape, thread_count())
    nested = variant == "nested"
    modes = wave_noise(parent.shape, seed) if nested else transform.forward(node_noise(parent.shape, seed))
    if variant == "fixed":
        modes *= np.sqrt(parent.n_points) / np.abs(modes)
    modes *= np.sqrt(psd / parent.pixel_area)
    heights = transform.backward(modes)
    text = f"Gaussian, {spectrum.describe(parent)}, {VARIANTS[variant]} seed {seed}"
    if not periodic:
        heights = heights[: grid.shape[0], : grid.shape[1]]
        text += f", window of a periodic surface of {parent.shape[0]} x {parent.shape[1]} points"
    if exact_rms:
        heights *= target / heights.std()
        text += f", rescaled to the rms height {show(target, 'm')}"
    keys = (*citation_keys(spectrum), *(("Wu2000",) if variant == "fixed" else ()))
    return generated(grid, heights, "gaussian", text, periodic=periodic, citation_keys=keys)


def random_field(grid: Grid, spectrum: Spectrum, seed: int) -> RealArray:
    """Heights (nx, ny) in m of a periodic Gaussian field, a window of which an autocovariance
    describes: see ``lattice_eigenvalues`` for its mean.
    """
    return filtered_noise(grid, lattice_eigenvalues(spectrum, grid), seed)


def filtered_noise(grid: Grid, eigenvalues: RealArray, seed: int) -> RealArray:
    """White noise (nx, ny) whose waves are given the mean square ``eigenvalues`` (nx, ny // 2 +
    1)."""
    transform = RealTransform(grid.shape, thread_count())
    modes = transform.forward(node_noise(grid.shape, seed))
    modes *= np.sqrt(eigenvalues)
    return transform.backward(modes)
