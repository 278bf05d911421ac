"""Surfaces written for other programs and for later, and surfaces larger than the memory."""

from __future__ import annotations

import itertools
import math
import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryFile

import numpy as np

from ..core import require
from ..core.arrays import ComplexArray, RealArray
from ..core.errors import InputError, OutputError
from ..core.grid import Grid
from ..core.spectral import complex_lines, line_transform, real_lines, thread_count
from ..core.status import NoProgress, Progress
from ..surfaces.formats_netcdf import write_netcdf
from ..surfaces.generate.digital_filter import EndlessSurface
from ..surfaces.generate.gaussian import Spectrum, noise_rows
from ..surfaces.generate.spectra import Columns, column_slices, spectrum_columns
from ..surfaces.profile import Profile
from ..surfaces.profile_netcdf import write_profile
from ..surfaces.surface import Surface
from .atomic import atomic_file

# Surfaces written for other programs and for later.


ENDINGS = (".nc", ".gsf", ".x3p", ".xyz", ".npy", ".txt", ".asc")
"""Endings of files a surface can be written to."""

LINE_ENDINGS = (".nc", ".txt", ".asc", ".xyz", ".npy")
"""Endings of files a line scan can be written to: .gsf holds maps only, and of .x3p the reader
library writes and reads no profiles."""


def save_surface(surface: Surface | Profile, path: str | Path, *, overwrite: bool = False) -> None:
    """Write ``surface``, a map or a line scan, to ``path``; the ending chooses the form.

    * ``.nc``: classic NetCDF with units, period, missing points and the whole history. ``read``
      returns an equal surface; SurfaceTopography and contact.engineering read it too.
    * ``.txt``, ``.asc``: matrix of heights in m with a header that states size and unit, top row
      (largest y) first, as Gwyddion exports and reads it; ``read`` needs no further argument.
      ``nan`` marks a missing point. A text does not tell that a surface is periodic.
    * ``.gsf``: Gwyddion Simple Field, 32-bit floats (seven digits of every height) with size, unit
      and missing points.
    * ``.x3p``: ISO 25178-72, written by SurfaceTopography in 64-bit floats, with size, unit and
      missing points. History and period are left out, as in all that follow.
    * ``.xyz``: list of all points x, y, z in m, ten digits, with the units in the headings; ``nan``
      marks a missing point.
    * ``.npy``: the bare array [x, y] of heights in m; ``read`` needs size and unit.

    A line scan comes back equal from ``.nc``, with its instrument, angle to the lay and cut-off;
    ``.txt``, ``.asc`` and ``.xyz`` are two columns x, z in m, ten digits, with the units in the
    headings, which ``read`` needs no further argument for; ``.npy`` is the bare array (n,), for
    ``Profile(numpy.load(path), spacing)``. The other forms hold maps only.

    Raises
    ------
    OutputError
        If the ending is another, the file exists and ``overwrite`` is false, or it cannot be
        written.
    """
    target = Path(path)
    require_ending(target)
    ending = target.suffix.lower()
    if isinstance(surface, Profile):
        _save_profile(surface, target, overwrite=overwrite)
        return
    with atomic_file(target, overwrite=overwrite) as partial:
        if ending == ".nc":
            write_netcdf(surface, partial)
        elif ending == ".gsf":
            write_gsf(surface.heights, surface.size, partial)
        elif ending == ".x3p":
            write_x3p(surface.heights, surface.size, partial)
        elif ending == ".xyz":
            x, y = (np.arange(n) * step for n, step in zip(surface.shape, surface.grid.spacing, strict=True))
            places = (found.ravel() for found in np.broadcast_arrays(x[:, None], y[None, :]))
            write_points(dict(zip("xyz", (*places, surface.heights.ravel()), strict=True)), partial)
        elif ending == ".npy":
            np.save(partial, surface.heights)
        else:
            (length_x, length_y), (nx, ny) = surface.size, surface.shape
            header = (
                f"Channel: heights\nWidth: {length_x!r} m\nHeight: {length_y!r} m\nValue units: "
                f"m\nx-pixels: {nx}\ny-pixels: {ny}"
            )
            with partial.open("w", encoding="utf-8", newline="\n") as file:
                np.savetxt(file, np.flipud(surface.heights.T), fmt="%.10g", delimiter="\t", header=header)


def _save_profile(profile: Profile, target: Path, *, overwrite: bool) -> None:
    """Write a line scan to the file ``target``."""
    ending = target.suffix.lower()
    if ending not in LINE_ENDINGS:
        raise OutputError(
            f"file of a line scan must end in {', '.join(LINE_ENDINGS)}, but is {target}: {ending} holds maps only. "
            "Take .nc, which keeps all that is known of it, or .xyz for other programs."
        )
    with atomic_file(target, overwrite=overwrite) as partial:
        if ending == ".nc":
            write_profile(profile, partial)
        elif ending == ".npy":
            np.save(partial, profile.heights)
        else:
            write_points({"x": profile.x, "z": profile.heights}, partial)


def write_gsf(heights: RealArray, size: tuple[float, float], path: Path) -> None:
    """Write ``heights`` (nx, ny) in m, NaN where missing, over ``size`` (Lx, Ly) in m as a Gwyddion
    Simple Field.

    Lines ``key = value``, one to four zero bytes up to a multiple of four, then 32-bit floats,
    little end first, top row (largest y) first.
    """
    nx, ny = heights.shape
    header = (
        f"Gwyddion Simple Field 1.0\nXRes = {nx}\nYRes = {ny}\nXReal = {size[0]!r}\nYReal = {size[1]!r}\n"
        "XYUnits = m\nZUnits = m\nTitle = heights\n"
    ).encode("ascii")
    with path.open("wb") as file:
        file.write(header + b"\0" * (4 - len(header) % 4))
        file.write(np.flipud(heights.T).astype("<f4").tobytes())


def write_x3p(heights: RealArray, size: tuple[float, float], path: Path) -> None:
    """Write ``heights`` (nx, ny) in m, NaN where missing, over ``size`` (Lx, Ly) in m as an .x3p
    file of 64-bit floats."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the library warns where MPI is missing
        from SurfaceTopography import Topography
    masked = np.ma.masked_invalid(heights[:, ::-1].astype(np.float64))  # the library counts y downwards from the top
    with path.open("wb") as file:
        Topography(masked, size, unit="m").to_x3p(file, manufacturer="asperity", model="asperity", version="unknown")


def write_points(columns: Mapping[str, RealArray], path: Path) -> None:
    """Write ``columns`` (n,) in m, such as x, y, z of a map or x, z of a profile, with their names
    and units in the first line."""
    with path.open("w", encoding="utf-8", newline="\n") as file:
        head = "\t".join(f"{name} (m)" for name in columns)
        np.savetxt(file, np.column_stack([*columns.values()]), fmt="%.10g", delimiter="\t", header=head, comments="")


def require_ending(path: Path, endings: tuple[str, ...] = ENDINGS) -> None:
    """Refuse a ``path`` whose ending is none of ``endings``.

    Raises
    ------
    OutputError
        If it is another.
    """
    if path.suffix.lower() not in endings:
        raise OutputError(f"file of a surface must end in {', '.join(endings)}, but is {path}.")


# Generated surfaces larger than the memory: an endless surface written tile by tile.


BYTES_PER_NODE = 56
"""Memory of a tile over its nodes, those of the margin included: noise and its translation, field,
spectrum, transfer function and what the transform takes; seven numbers of eight bytes."""

PRECISIONS = {"single": np.float32, "double": np.float64}
"""Types of the heights in a file."""


def save_endless(
    surface: EndlessSurface,
    shape: tuple[int, int],
    path: str | Path,
    *,
    memory: float = 1e9,
    precision: str = "double",
    overwrite: bool = False,
    progress: Progress = NoProgress(),
) -> None:
    """Write the window of ``shape`` (nx, ny) at node (0, 0) of an endless ``surface`` to the file
    ``path``, an .npy array.

    Tiles are generated one after another with a margin of the reach of the kernel, and need no
    seam: their heights are those of the whole, up to rounding. ``numpy.load(path, mmap_mode="r")``
    opens the array without reading it.

    Parameters
    ----------
    surface
        Made by ``generate.endless``.
    shape
        Number of points (nx, ny), as many as the disk holds.
    path
        File name that ends in .npy; heights [x, y] in m.
    memory
        Bytes that the tiles may take; the fewer, the more of the time goes into margins.
    precision
        ``double`` or ``single`` (half the file; differences of neighbouring heights keep fewer
        digits).
    overwrite
        Replace the file if it exists.
    progress
        Receives the number of tiles done and the share that is left.

    Raises
    ------
    InputError
        If a value is out of range or the memory too small for a tile as wide as its margins.
    OutputError
        If the file cannot be written.
    """
    nx, ny = (require.integer(n, 1, f"number of points along {a}") for n, a in zip(shape, "xy", strict=True))
    kind = PRECISIONS[require.one_of(precision, PRECISIONS, "precision of the heights")]
    target = Path(path)
    require_ending(target, (".npy",))
    tile = _tile(surface, (nx, ny), require.positive(memory, "memory of the tiles (bytes)"))
    prepared = surface.prepared(tile)
    rows, columns = math.ceil(nx / tile[0]), math.ceil(ny / tile[1])
    with atomic_file(target, overwrite=overwrite) as partial:
        np.lib.format.open_memmap(partial, mode="w+", dtype=kind, shape=(nx, ny)).flush()
        for row in range(rows):
            # opened anew for each row of tiles, so that what is written does not stay in the memory
            # of the process
            heights = np.lib.format.open_memmap(partial, mode="r+")
            for column in range(columns):
                i, j = row * tile[0], column * tile[1]
                part = heights[i : i + tile[0], j : j + tile[1]]
                part[...] = surface.heights(prepared, (i, j))[: part.shape[0], : part.shape[1]]
                done = row * columns + column + 1
                progress.update(done, 1.0 - done / (rows * columns), 0.0)
            heights.flush()
            del heights, part


def _tile(surface: EndlessSurface, shape: tuple[int, int], memory: float) -> tuple[int, int]:
    """Largest tile (tx, ty), as square as the surface allows, whose generation fits into ``memory``
    bytes."""
    margins = [2 * reach for reach in surface.kernel.reach]
    nodes = memory / BYTES_PER_NODE
    side = math.isqrt(int(nodes))
    ty = min(shape[1], max(1, side - margins[1]))
    tx = min(shape[0], int(nodes / (ty + margins[1])) - margins[0])
    if min(side - margins[0], side - margins[1]) < max(1, *margins) and (tx, ty) != shape:
        least = BYTES_PER_NODE * (2 * max(margins) + 1) ** 2
        raise InputError(
            f"memory of the tiles must be at least {least:.3g} bytes for a kernel that reaches {margins[0] // 2} x "
            f"{margins[1] // 2} pixels, but is {memory:.3g}."
        )
    return tx, ty


# Periodic Gaussian surfaces larger than the memory: white noise filtered by a Fourier transform on
# the disk.


BYTES_PER_MODE = 112
"""Memory of a block of columns over its modes: three complex fields, the spectrum and what its
power laws take."""


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
    """Write the periodic surface ``generate.gaussian(grid, spectrum, seed=seed)`` to the file
    ``path``, an .npy array.

    Rows and columns are transformed in turn, block by block; in between the waves lie in a
    temporary file beside ``path`` of the size of the surface in double precision. Heights are those
    of ``gaussian``, up to rounding.

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
        ``double`` or ``single`` (half the file; differences of neighbouring heights keep fewer
        digits).
    overwrite
        Replace the file if it exists.
    progress
        Receives the number of blocks done and the share that is left.

    Raises
    ------
    InputError
        If a value is out of range, the memory too small for one row or column, or the spectrum no
        function of the wavenumber.
    OutputError
        If the file cannot be written.
    """
    seed = require.integer(seed, 0, "seed of a random surface")
    kind = PRECISIONS[require.one_of(precision, PRECISIONS, "precision of the heights")]
    require_ending(Path(path), (".npy",))
    memory, (nx, ny) = require.positive(memory, "memory of the blocks (bytes)"), grid.shape
    rows, width = int(memory / (BYTES_PER_MODE * (ny // 2 + 1))), int(memory / (BYTES_PER_MODE * nx))  # at a time
    if min(rows, width) < 1:
        least = BYTES_PER_MODE * max(nx, ny // 2 + 1)
        raise InputError(f"memory of the blocks must be at least {least:.3g} bytes for this grid, but is {memory:.3g}.")
    rows, width = min(rows, nx), min(width, ny // 2 + 1)
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
