"""Periodic Gaussian surfaces larger than the memory: white noise filtered by a Fourier transform on the disk."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryFile

import numpy as np

from ..core import require
from ..core.arrays import ComplexArray, RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.progress import NoProgress, Progress
from ..core.spectral import complex_lines, line_transform, real_lines, thread_count
from ..surfaces.generate.gaussian import Spectrum, noise_rows
from ..surfaces.generate.spectra import Columns, column_slices, spectrum_columns
from .atomic import atomic_file
from .surface_files import require_ending
from .tiles import PRECISIONS

BYTES_PER_MODE = 112
"""Memory of a block of columns over its modes: three complex fields, the spectrum and what its power laws take."""


def save_gaussian(
    grid: Grid,
    spectrum: Spectrum,
    path: str | Path,
    *,
    seed: int,
    memory: float = 1e9,
    precision: str = "double",
    overwrite: bool = False,
    progress: Progress = NoProgress(),
) -> None:
    """Write the periodic surface ``generate.gaussian(grid, spectrum, seed=seed)`` to the file ``path``, an .npy array.

    Rows and columns are transformed in turn, block by block; in between the waves lie in a temporary file beside ``path`` of
    the size of the surface in double precision. Heights are those of ``gaussian``, up to rounding.

    Parameters
    ----------
    grid
        Nodes of the surface, as many as the disk holds.
    spectrum
        ``SelfAffine`` or ``TwoSlopes``, with or without roll-off, or ``TabulatedSpectrum``.
    path
        File name that ends in .npy; heights [x, y] in m.
    seed
        Whole number >= 0.
    memory
        Bytes that the blocks may take.
    precision
        ``double`` or ``single`` (half the file; differences of neighbouring heights keep fewer digits).
    overwrite
        Replace the file if it exists.
    progress
        Told the blocks done and the share that is left.

    Raises
    ------
    InputError
        If a value is out of range, the memory too small for one row or column, or the spectrum no function of the wavenumber.
    OutputError
        If the file cannot be written.
    """
    seed = require.integer(seed, 0, "seed of a random surface")
    kind = PRECISIONS[require.one_of(precision, PRECISIONS, "precision of the heights")]
    require_ending(Path(path), (".npy",))
    rows, width = _blocks(grid, require.positive(memory, "memory of the blocks (bytes)"))
    columns = spectrum_columns(spectrum, grid, width)
    with atomic_file(path, overwrite=overwrite) as partial, TemporaryFile(dir=partial.parent) as scratch:
        waves: ComplexArray = np.memmap(
            scratch, dtype=complex, mode="w+", shape=(grid.shape[0], grid.shape[1] // 2 + 1)
        )
        heights = np.lib.format.open_memmap(partial, mode="w+", dtype=kind, shape=grid.shape)
        passes = itertools.chain(
            _noise_into(waves, grid, seed, rows),
            _filter_into(waves, columns, grid, width),
            _heights_into(heights, waves, rows),
        )
        steps = 2 * -(-grid.shape[0] // rows) + -(-waves.shape[1] // width)
        for step, _ in enumerate(passes, start=1):
            progress.update(step, 1.0 - step / steps, 0.0)
        heights.flush()


def _noise_into(waves: ComplexArray, grid: Grid, seed: int, rows: int) -> Iterator[None]:
    """White noise, transformed along y."""
    start = 0
    for noise in noise_rows(grid.shape, seed, rows):
        waves[start : start + len(noise)] = line_transform(noise, 1, thread_count())
        start += len(noise)
        yield


def _filter_into(waves: ComplexArray, columns: Columns, grid: Grid, width: int) -> Iterator[None]:
    """Transformed along x, given their power and transformed back."""
    for part in column_slices(grid, width):
        along_x = complex_lines(np.array(waves[:, part]), 0, threads=thread_count())
        along_x *= np.sqrt(columns(part) / grid.pixel_area)
        waves[:, part] = complex_lines(along_x, 0, backward=True, threads=thread_count())
        yield


def _heights_into(heights: RealArray, waves: ComplexArray, rows: int) -> Iterator[None]:
    """Transformed back along y."""
    for start in range(0, heights.shape[0], rows):
        block = np.array(waves[start : start + rows])
        heights[start : start + rows] = real_lines(block, heights.shape[1], thread_count())
        yield


def _blocks(grid: Grid, memory: float) -> tuple[int, int]:
    """Rows and columns at a time."""
    nx, ny = grid.shape
    rows, width = int(memory / (BYTES_PER_MODE * (ny // 2 + 1))), int(memory / (BYTES_PER_MODE * nx))
    if min(rows, width) < 1:
        least = BYTES_PER_MODE * max(nx, ny // 2 + 1)
        raise InputError(f"memory of the blocks must be at least {least:.3g} bytes for this grid, but is {memory:.3g}.")
    return min(rows, nx), min(width, ny // 2 + 1)
