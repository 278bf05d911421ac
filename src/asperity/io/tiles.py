"""Generated surfaces larger than the memory: an endless surface written tile by tile."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ..core import require
from ..core.errors import InputError
from ..core.progress import NoProgress, Progress
from ..surfaces.generate import EndlessSurface
from .atomic import atomic_file
from .surface_files import require_ending

BYTES_PER_NODE = 56
"""Memory of a tile over its nodes, those of the margin included: noise and its translation, field, spectrum, transfer
function and what the transform takes; seven numbers of eight bytes."""

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
    """Write the window of ``shape`` (nx, ny) at node (0, 0) of an endless ``surface`` to the file ``path``, an .npy array.

    Tiles are generated one after another with a margin of the reach of the kernel, and need no seam: their heights are those
    of the whole, up to rounding. ``numpy.load(path, mmap_mode="r")`` opens the array without reading it.

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
        ``double`` or ``single`` (half the file; differences of neighbouring heights keep fewer digits).
    overwrite
        Replace the file if it exists.
    progress
        Told the tiles done and the share that is left.

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
            # opened anew for each row of tiles, so that what is written does not stay in the memory of the process
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
    """Largest tile (tx, ty), as square as the surface allows, whose generation fits into ``memory`` bytes."""
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
