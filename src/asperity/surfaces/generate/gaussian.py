"""Gaussian random surfaces by filtered white noise."""

from __future__ import annotations

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.citations import citation_keys
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.spectral import RealTransform, fast_length, thread_count
from ...core.units import show
from ..surface import Origin, Surface
from .embedding import Spectrum, lattice_eigenvalues
from .modes import mean_square
from .noise import node_noise, wave_noise

VARIANTS = {"random": "PCG64", "fixed": "fixed amplitudes and phases of PCG64", "nested": "nested waves of PCG64"}
"""How the waves of a realisation are drawn, with the words for its history."""

_LARGEST_PARENT = 2**29  # points of the periodic map from which a window is cut: 4 GB of heights


def gaussian(
    grid: Grid,
    spectrum: Spectrum,
    *,
    seed: int,
    variant: str = "random",
    exact_rms: bool = False,
    periodic: bool = True,
) -> Surface:
    """Gaussian surface with the given power spectrum.

    White noise η (standard normal) is filtered: h = IFFT[FFT[η] sqrt(C/(dx dy))]. Equal seeds give equal surfaces on
    every machine and for every number of threads, up to rounding of the transform.

    Parameters
    ----------
    grid
        Nodes of the surface.
    spectrum
        ``SelfAffine``, ``ExponentialAutocorrelation`` or any object with ``lattice_psd`` and ``describe``; the
        surface cites the papers in its ``citation_keys``, if it has any.
    seed
        Whole number >= 0.
    variant
        ``random``: noise at the nodes (PCG64, in the order of the array); amplitudes and phases are random, so a mode has
        the power C only on average and the rms height of one realisation scatters. ``fixed``: the same phases with all
        amplitudes equal to sqrt(C); spectrum and rms height are exact in every realisation, heights are Gaussian by
        the central limit theorem only (Wu 2000). ``nested``: noise numbered by wave instead of by node, so that grids
        of one size and different pixels show the same surface: for studies of the mesh.
    exact_rms
        Rescale this realisation to the expected rms height. That is another ensemble: mean square slopes and
        curvatures are then biased by up to the relative variance of the mean square height.
    periodic
        If false, a window of a periodic surface that is longer by ``spectrum.correlation_range`` (twice as long if the
        spectrum has none), so that opposite borders are independent. Its mean, tilt and rms height scatter.

    Raises
    ------
    InputError
        If the seed is not a whole number >= 0, the variant is unknown or the grid does not suit the spectrum.
    """
    seed = require.integer(seed, 0, "seed of a random surface")
    require.one_of(variant, VARIANTS, "variant of a Gaussian surface")
    parent = grid if periodic else parent_grid(grid, spectrum)
    psd = spectrum.lattice_psd(parent)
    target = np.sqrt(mean_square(parent, psd))
    heights = _synthesised(parent, psd, seed, variant)
    text = f"generated: Gaussian, {spectrum.describe(parent)}, {VARIANTS[variant]} seed {seed}"
    if not periodic:
        heights = heights[: grid.shape[0], : grid.shape[1]]
        text += f", window of a periodic surface of {parent.shape[0]} x {parent.shape[1]} points"
    if exact_rms:
        heights *= target / heights.std()
        text += f", rescaled to the rms height {show(target, 'm')}"
    dx, dy = grid.spacing
    keys = (*citation_keys(spectrum), *(("Wu2000",) if variant == "fixed" else ()))
    origin = Origin(source="gaussian", history=(text,), citation_keys=keys)
    return Surface(heights, dx, dy, periodic=periodic, origin=origin)


def parent_grid(grid: Grid, spectrum: object) -> Grid:
    """Grid of the periodic surface from which a window on ``grid`` is cut.

    Raises
    ------
    InputError
        If it would have more than 2^29 points.
    """
    reach = getattr(spectrum, "correlation_range", None)
    sides = getattr(spectrum, "embedding_lengths", (0.0, 0.0))
    margins = grid.size if reach is None else (float(reach), float(reach))
    lengths = [max(size + margin, side) for size, margin, side in zip(grid.size, margins, sides, strict=True)]
    nx, ny = (fast_length(int(np.ceil(length / d))) for length, d in zip(lengths, grid.spacing, strict=True))
    if nx * ny > _LARGEST_PARENT:
        raise InputError(
            f"grid of a window must not be much smaller than the longest waves of the spectrum, but {grid.size[0]:.3g} x "
            f"{grid.size[1]:.3g} m would be cut from {nx} x {ny} points. Enlarge the window or shorten the waves."
        )
    return Grid((nx, ny), grid.spacing)


def random_field(grid: Grid, spectrum: Spectrum, seed: int) -> RealArray:
    """Heights (nx, ny) in m of a periodic Gaussian field, a window of which an autocovariance describes: see
    ``lattice_eigenvalues`` for its mean.
    """
    return filtered_noise(grid, lattice_eigenvalues(spectrum, grid), seed)


def filtered_noise(grid: Grid, eigenvalues: RealArray, seed: int) -> RealArray:
    """White noise (nx, ny) whose waves are given the mean square ``eigenvalues`` (nx, ny // 2 + 1)."""
    transform = RealTransform(grid.shape, thread_count())
    modes = transform.forward(node_noise(grid.shape, seed))
    modes *= np.sqrt(eigenvalues)
    return transform.backward(modes)


def _synthesised(grid: Grid, psd: RealArray, seed: int, variant: str) -> RealArray:
    transform = RealTransform(grid.shape, thread_count())
    nested = variant == "nested"
    spectrum = wave_noise(grid.shape, seed) if nested else transform.forward(node_noise(grid.shape, seed))
    if variant == "fixed":
        spectrum *= np.sqrt(grid.n_points) / np.abs(spectrum)
    spectrum *= np.sqrt(psd / grid.pixel_area)
    return transform.backward(spectrum)
