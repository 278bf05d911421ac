"""Vectors on the CPU: convolutions with tensors, and nested cells whose points yield along
directions of their own."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from importlib import import_module
from typing import Any, NamedTuple

import numpy as np

from ..arrays import RealArray
from ..spectral import PaddedTransform, RealTransform
from .blocks import SERIAL_BELOW
from .cpu import CpuEngine


@dataclass(frozen=True)
class Merge:
    """How the cells of one level form those of the next: pairs along the axes that ``x`` and ``y``
    name.

    ``offset_x`` and ``offset_y`` (0 or 1) are one where the first cell stays single; ``weight`` is
    the deflection that a unit load on a merged cell adds to all of its points, over that of a point
    under its own load.
    """

    x: bool
    y: bool
    offset_x: int
    offset_y: int
    weight: float


@dataclass(frozen=True)
class Hierarchy:
    """Nested cells from single points up by ``merges``, after the points have been rolled by
    ``roll`` along x and y.

    Rolled points re-enter at the other end, so that cells of a periodic grid reach over its
    borders.
    """

    merges: tuple[Merge, ...]
    roll: tuple[int, int] = (0, 0)


class VectorConvolution:
    """Product of fields with two or three components with a tensor in Fourier space; owns its
    buffers.

    The ``entries`` are real half spectra of the grid ``padded``: xx, yy and xy of a symmetric
    tensor of the two components in the plane; with the normal direction also zz, and zx, zy of the
    coupling i zx, i zy. ``shape`` is that of the fields, which are zero beyond it.
    """

    def __init__(
        self,
        engine: CpuEngine,
        entries: tuple[RealArray, ...],
        shape: tuple[int, int],
        padded: tuple[int, int],
        dtype: str,
    ) -> None:
        self._blocks = engine.blocks
        threads = engine.threads_for(padded)
        self._transform: RealTransform | PaddedTransform
        if padded == shape:
            self._transform = RealTransform(shape, threads)
        else:
            self._transform = PaddedTransform(shape, padded, threads)
        self._entries = [np.ascontiguousarray(entry, dtype=dtype).ravel() for entry in entries]
        kind = np.complex128 if dtype == "float64" else np.complex64
        in_plane = len(entries) == 3
        self._product = self._blocks.kernels.tensor_product if in_plane else self._blocks.kernels.coupled_product
        self._spectra = [np.empty(self._transform.spectrum_shape, kind) for _ in range(2 if in_plane else 3)]

    def apply(self, fields: tuple[RealArray, ...], out: tuple[RealArray, ...]) -> None:
        """Convolve the components ``fields`` into ``out``."""
        spectra = [self._transform.forward(field, to) for field, to in zip(fields, self._spectra, strict=True)]
        flat = [spectrum.ravel() for spectrum in spectra]
        self._blocks.run(self._product, flat[0].size, *flat, *self._entries)
        for spectrum, component in zip(spectra, out, strict=True):
            self._transform.backward(spectrum, component)


class VectorCells:
    """Exact inverse of nested cells for loads (2, n) along two directions on a free set (see
    ``vector_kernels``), a hierarchy per thread."""

    def __init__(
        self, engine: CpuEngine, shape: tuple[int, int], hierarchies: tuple[Hierarchy, Hierarchy], dtype: str
    ) -> None:
        self._blocks, self._shape = engine.blocks, shape
        self._kernels: Any = import_module(".vector_kernels", __package__)
        cells = _layout(shape, hierarchies)
        self.levels, size = cells.levels, cells.size
        self.weights = np.array([1.0, *(merge.weight for merge in hierarchies[0].merges)], dtype)
        self.g, self.s = np.zeros((3, size), dtype), np.zeros((2, size), dtype)
        self._t = np.zeros((3, size), dtype)

    def factorise(self, free: Any, conductance: RealArray) -> None:
        """g of all cells for the points of ``free``, which yield by the ``conductance``, entries
        xx, xy, yy (3, n), times their own load."""
        self._sweep("factorise_tensors", free, conductance, self._t)

    def solve(self, free: Any, r: RealArray, conductance: RealArray) -> RealArray:
        """Inverse times ``r`` (2, n)."""
        self._sweep("vector_deflections", free, _times(conductance, r), self.s)
        out, sums = np.empty_like(r), np.zeros((self._shape[0], 3))
        subtract = self._kernels.subtract_deflections
        for component in range(2):
            fields = r[component], r[component], self.s[component], out[component]
            arguments = self.levels, self._shape, free.rows, free.index, *fields, sums
            self._blocks.share(subtract, self._shape[0], *arguments, serial=free.size < SERIAL_BELOW)
        return _times(conductance, out)

    def _sweep(self, kernel: str, free: Any, values: RealArray, s: RealArray) -> None:
        arguments = (self.levels, self.weights, self._shape, free.rows, free.index, values, self.g, s)
        call = getattr(self._kernels, kernel)
        self._blocks.share(call, len(self.levels), *arguments, serial=self.s[0].size < SERIAL_BELOW)


def _times(tensor: RealArray, vectors: RealArray) -> RealArray:
    """Symmetric tensors (3, n) times vectors (2, n)."""
    xx, xy, yy = tensor
    return np.stack([xx * vectors[0] + xy * vectors[1], xy * vectors[0] + yy * vectors[1]])


class _Layout(NamedTuple):
    """Table ``levels`` of ``vector_kernels`` (hierarchy, level, column), and the ``size`` of all
    cells in elements. Shared: not to be written to."""

    levels: Any
    size: int


@lru_cache(maxsize=32)
def _layout(shape: tuple[int, int], hierarchies: tuple[Hierarchy, Hierarchy]) -> _Layout:
    """Layout of the cells of ``hierarchies`` on a grid of ``shape``."""
    levels, size = np.zeros((len(hierarchies), len(hierarchies[0].merges) + 1, 10), np.int64), 0
    for number, hierarchy in enumerate(hierarchies):
        nx, ny = shape
        for depth, merge in enumerate(hierarchy.merges, start=1):
            # pairs merge, the first cell alone where there is an offset
            nx = ((nx - 1 + merge.offset_x) >> 1) + 1 if merge.x else nx
            ny = ((ny - 1 + merge.offset_y) >> 1) + 1 if merge.y else ny
            stride = ny + 2
            flags = int(merge.x), int(merge.y), merge.offset_x, merge.offset_y, *hierarchy.roll
            levels[number, depth] = size + stride + 1, nx, ny, stride, *flags
            size += (nx + 2) * stride
    return _Layout(levels, size)
