"""Working set of the CPU engine: indices of its points, vectors as compressed arrays."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays import RealArray
from .blocks import Blocks
from .protocol import Load, Products

ROW_PAD = 16
"""Gap in floats between the rows of a field in single precision."""

_NO_CAP = np.full(1, np.inf)


@dataclass(frozen=True, eq=False)
class CpuFace:
    """Working set of points at the flat ``index`` (ascending) of arrays of ``shape``; ``start`` is its residual."""

    blocks: Blocks
    shape: tuple[int, int]
    index: Any
    start: RealArray
    entering: int

    @property
    def size(self) -> int:
        """Number of points."""
        return int(self.index.size)

    @cached_property
    def rows(self) -> Any:
        """Where the points of every row begin in ``index``, and the number of points."""
        return np.searchsorted(self.index, np.arange(self.shape[0] + 1, dtype=np.int64) * self.shape[1])

    @cached_property
    def _apart(self) -> Any:
        return self.index + self.index // self.shape[1] * self.index.dtype.type(ROW_PAD)

    def place(self, field: RealArray) -> Any:
        """Indices of the points in the memory of ``field``."""
        return self.index if field.flags.c_contiguous else self._apart

    def residual(self, *, centred: bool) -> RealArray:
        """Residual vector."""
        if centred and self.size:
            self.start[...] -= self.start.mean(dtype=np.float64)
        return self.start

    def copied(self, vector: RealArray) -> RealArray:
        """Copy of ``vector``."""
        return vector.copy()

    def zeros(self) -> RealArray:
        """Vector of zeros."""
        return np.zeros_like(self.start)

    def lay(self, values: RealArray, field: RealArray, added: float | None = None) -> None:
        """Lay ``values`` out in the field, or add to it."""
        if added is None:
            self._run("scatter", self.place(field), values, memory(field))
        else:
            self._run("scatter_more", self.place(field), values, values.dtype.type(added), memory(field))

    def press(self, p: RealArray, factor: float, scale: float) -> RealArray:
        """p = factor max(p, 0) and the change over scale, in the memory of the residual."""
        self._run("press", self.index, p.ravel(), factor, scale, self.start)
        return self.start

    def lay_change(self, old: RealArray, values: RealArray, r: RealArray, field: RealArray) -> tuple[RealArray, float]:
        """Lay ``values`` - ``old`` out in the field."""
        change = np.empty_like(r)
        arguments = (self.index, self.place(field), old, values.ravel(), r, change, memory(field))
        return change, self._sums("lay_change", 1, *arguments)[0]

    def gather(self, field: RealArray, a: RealArray, b: RealArray, out: RealArray) -> Products:
        """Vector of ``field`` in ``out``."""
        total, first, second = self._sums("gather", 3, self.place(field), memory(field), a, b, out)
        return Products(out, total, first, second)

    def direct(
        self, z: RealArray, mean: float, ratio: float, t: RealArray, r: RealArray, field: RealArray
    ) -> tuple[RealArray, float]:
        """t = (z - mean) + ratio t in place, laid out in the field."""
        kind = t.dtype.type
        arguments = (self.place(field), z, kind(mean), kind(ratio), t, r, memory(field))
        return t, self._sums("direct", 1, *arguments)[0]

    def advance(
        self, length: float, t: RealArray, kt: RealArray, mean: float, d: RealArray, r: RealArray
    ) -> tuple[RealArray, RealArray]:
        """d += length t and r -= length (kt - mean) in place."""
        kind = t.dtype.type
        self._run("advance", kind(length), t, kt, kind(mean), d, r)
        return d, r

    def pick(self, values: RealArray) -> tuple[RealArray, float]:
        """Vector of ``values`` and its sum."""
        out = np.empty(self.size, values.dtype)
        return out, self._sums("pick", 1, self.index, values.ravel(), out)[0]

    def blend(self, old: RealArray, share: float, values: RealArray) -> None:
        """values = old + share (values - old)."""
        self._run("blend", self.index, old, share, values.ravel())

    def shift(self, p: RealArray, d: RealArray, scale: float) -> tuple[int, float]:
        """p += scale d."""
        below, lack = self._sums("shift", 2, self.index, p.ravel(), d, scale)
        return int(below), lack

    def move(self, p: RealArray, d: RealArray, scale: float, cap: RealArray | None) -> tuple[Load, int]:
        """p += scale d, clipped."""
        total, movable, below, clipped = self._sums("move", 4, self.index, p.ravel(), d, scale, bound(cap))
        return Load(total, movable, int(below)), int(clipped)

    def scale(self, p: RealArray, factor: float, shift: float, cap: RealArray | None) -> Load:
        """p = factor p + shift below the cap, clipped."""
        total, movable, below = self._sums("scale", 3, self.index, p.ravel(), factor, shift, bound(cap))
        return Load(total, movable, int(below))

    def _run(self, kernel: str, *arguments: Any) -> None:
        self.blocks.run(getattr(self.blocks.face_kernels, kernel), self.size, *arguments)

    def _sums(self, kernel: str, columns: int, *arguments: Any) -> list[float]:
        found = self.blocks.sums(getattr(self.blocks.face_kernels, kernel), self.size, columns, *arguments)
        return [float(value) for value in found.sum(axis=0)]


def memory(field: RealArray) -> RealArray:
    """All memory of a field made by ``CpuEngine.field``, gaps between rows included; of others the field itself."""
    base = field if field.flags.c_contiguous or not isinstance(field.base, np.ndarray) else field.base
    return base.reshape(-1)


def bound(cap: RealArray | None) -> RealArray:
    """Flat cap for the kernels: one value for all points, infinity for none, or one for each."""
    return _NO_CAP if cap is None else cap.ravel()
