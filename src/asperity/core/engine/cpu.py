"""Engine of the CPU: FFT library with threads, compiled fused passes on blocks, vectors compressed to the working set."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from importlib import import_module
from itertools import pairwise
from typing import Any

import numpy as np

from ..arrays import RealArray
from ..spectral import PaddedTransform, RealTransform, fft_library, thread_count
from .protocol import Convolution, Face, Totals, Violation

_NO_CAP = np.full(1, np.inf)
_ROW_PAD = 16


def _compiled() -> Any:
    """Compiled passes; numba takes a third of a second to import, so only when something is computed."""
    return import_module(".kernels", __package__)


class Blocks:
    """Runs compiled passes on fixed blocks with a given number of threads."""

    def __init__(self, threads: int) -> None:
        self.kernels = _compiled()
        self.threads = threads
        self._pool = ThreadPoolExecutor(threads - 1) if threads > 1 else None

    def run(self, kernel: Callable[..., None], size: int, *arguments: Any) -> None:
        """Call ``kernel`` over all blocks of ``size`` elements."""
        blocks = -(-size // self.kernels.BLOCK)
        if self._pool is None or blocks < 2 * self.threads:
            kernel((0, blocks), *arguments)
            return
        cuts = [blocks * i // self.threads for i in range(self.threads + 1)]
        own, *others = pairwise(cuts)
        jobs = [self._pool.submit(kernel, span, *arguments) for span in others]
        kernel(own, *arguments)
        for job in jobs:
            job.result()

    def sums(self, kernel: Callable[..., None], size: int, columns: int, *arguments: Any) -> RealArray:
        """Per-block sums (blocks, columns) that ``kernel`` leaves in its last argument."""
        partial = np.zeros((-(-size // self.kernels.BLOCK), columns))
        self.run(kernel, size, *arguments, partial)
        return partial


class CpuEngine:
    """The usual engine. ``threads``: see ``core.spectral.thread_count``."""

    def __init__(self, threads: int | None = None) -> None:
        self.threads = thread_count(threads)
        self.blocks = Blocks(self.threads)
        self.name = f"cpu ({fft_library()}, {self.threads} thread{'s' if self.threads > 1 else ''})"

    def array(self, values: RealArray | float, dtype: str) -> RealArray:
        """Contiguous NumPy array of ``values``."""
        return np.ascontiguousarray(values, dtype=dtype)

    def numpy(self, values: Any) -> RealArray:
        """``values`` itself."""
        return np.asarray(values)

    def zeros(self, shape: tuple[int, int], dtype: str) -> RealArray:
        """Field of zeros."""
        return np.zeros(shape, dtype)

    def field(self, shape: tuple[int, int], dtype: str) -> RealArray:
        """Field of zeros; rows in single precision are apart by some more than their length.

        Rows of 2^k floats map to the same cache lines, which doubles the time of ducc0's last transform back.
        """
        pad = _ROW_PAD if dtype == "float32" else 0
        return np.zeros((shape[0], shape[1] + pad), dtype)[:, : shape[1]]

    def convolution(self, kernel: RealArray, shape: tuple[int, int], dtype: str) -> Convolution:
        """Periodic convolution."""
        return _Convolution(self.blocks, RealTransform(shape, self.threads), kernel, dtype)

    def padded_convolution(
        self, kernel: RealArray, shape: tuple[int, int], padded: tuple[int, int], dtype: str
    ) -> Convolution:
        """Free convolution with pruned transforms."""
        return _Convolution(self.blocks, PaddedTransform(shape, padded, self.threads), kernel, dtype)

    def totals(self, p: RealArray, u: RealArray, h: RealArray, cap: RealArray | None) -> Totals:
        """Sums over an iterate."""
        arguments = (p.ravel(), u.ravel(), h.ravel(), _cap(cap))
        s = self.blocks.sums(self.blocks.kernels.assess, p.size, 8, *arguments)
        added = s[:, :5].sum(axis=0)
        total, work, height, weight, weighted = (float(v) for v in added)
        bounds = float(s[:, 5].min()), float(s[:, 6].max()), float(s[:, 7].min())
        return Totals(total, work, height, weight, weighted, *bounds)

    def violation(self, p: RealArray, u: RealArray, h: RealArray, cap: RealArray | None, level: float) -> Violation:
        """How far an iterate is from the contact conditions."""
        arguments = (p.ravel(), u.ravel(), h.ravel(), _cap(cap), level)
        s = self.blocks.sums(self.blocks.kernels.violation, p.size, 3, *arguments)
        return Violation(float(s[:, 0].sum()), float(s[:, 1].sum()), float(s[:, 2].max()))

    def face(
        self,
        p: RealArray,
        u: RealArray,
        h: RealArray,
        cap: RealArray | None,
        level: float,
        scale: float,
        field: RealArray,
    ) -> CpuFace:
        """Working set at ``level``."""
        arguments = (p.ravel(), u.ravel(), h.ravel(), _cap(cap), level)
        counts = np.zeros((-(-p.size // self.blocks.kernels.BLOCK), 2), dtype=np.int64)
        self.blocks.run(self.blocks.kernels.count_face, p.size, *arguments, counts)
        starts = np.concatenate([[0], np.cumsum(counts[:, 0])])
        index = np.empty(int(starts[-1]), dtype=np.int32 if _flat(field).size < 2**31 else np.int64)
        residual = np.empty(index.size, dtype=field.dtype)
        self.blocks.run(self.blocks.kernels.fill_face, p.size, *arguments, scale, starts, index, residual)
        place = index if _flat(field).size == p.size else index + index // p.shape[1] * index.dtype.type(_ROW_PAD)
        entering = int(counts[:, 1].sum())
        return CpuFace(self.blocks, index, place, residual, _flat(field), entering, np.empty_like(residual))

    def release(self, face: Face, field: RealArray) -> None:
        """Zero on the face."""
        assert isinstance(face, CpuFace)
        self.blocks.run(self.blocks.kernels.clear, face.size, face.place, _flat(field))

    def rescale(self, p: RealArray, factor: float) -> None:
        """p *= factor."""
        self.blocks.run(self.blocks.kernels.multiply, p.size, p.ravel(), factor)

    def copy(self, source: RealArray, out: RealArray) -> None:
        """out[...] = source."""
        np.copyto(out, source)

    def segment(self, p: RealArray, q: RealArray, u: RealArray, v: RealArray, h: RealArray) -> tuple[float, float]:
        """Slope and curvature of the energy from p to q."""
        arguments = (p.ravel(), q.ravel(), u.ravel(), v.ravel(), h.ravel())
        slope, curvature = self.blocks.sums(self.blocks.kernels.segment, p.size, 2, *arguments).sum(axis=0)
        return float(slope), float(curvature)

    def blend(self, a: RealArray, b: RealArray, weight: float) -> None:
        """b = a + weight (b - a)."""
        self.blocks.run(self.blocks.kernels.blend, a.size, a.ravel(), b.ravel(), weight)


@dataclass(frozen=True, eq=False)
class CpuFace:
    """Working set as indices: ``index`` of its points, ``place`` of the same in the memory of the field."""

    blocks: Blocks
    index: Any
    place: Any
    start: RealArray
    field: RealArray
    entering: int
    scratch: RealArray

    @property
    def size(self) -> int:
        """Number of points."""
        return int(self.index.size)

    def residual(self, *, centred: bool) -> RealArray:
        """Residual vector, laid out in the field."""
        if centred and self.size:
            self.start[...] -= self.start.mean(dtype=np.float64)
        self.blocks.run(self.blocks.kernels.scatter, self.size, self.place, self.start, self.field)
        return self.start

    def zeros(self) -> RealArray:
        """Vector of zeros."""
        return np.zeros_like(self.start)

    def lay(self, values: RealArray) -> None:
        """Lay ``values`` out in the field."""
        self.blocks.run(self.blocks.kernels.scatter, self.size, self.place, values, self.field)

    def copied(self, values: RealArray) -> RealArray:
        """Copy of ``values``."""
        return values.copy()

    def product(self, a: RealArray, b: RealArray) -> float:
        """Sum of a b."""
        return float(self.blocks.sums(self.blocks.kernels.dot, self.size, 1, a, b).sum())

    def gather(self, field: RealArray, other: RealArray) -> tuple[RealArray, tuple[float, float]]:
        """Vector of ``field`` (in scratch memory), its sum and its product with ``other``."""
        arguments = (self.place, _flat(field), other, self.scratch)
        total, product = self.blocks.sums(self.blocks.kernels.gather, self.size, 2, *arguments).sum(axis=0)
        return self.scratch, (float(total), float(product))

    def direct(self, z: RealArray, mean: float, ratio: float, t: RealArray) -> RealArray:
        """t = (z - mean) + ratio t in place, laid out in the field."""
        kind = t.dtype.type
        self.blocks.run(self.blocks.kernels.direct, self.size, self.place, z, kind(mean), kind(ratio), t, self.field)
        return t

    def advance(
        self, length: float, t: RealArray, kt: RealArray, mean: float, d: RealArray, r: RealArray
    ) -> tuple[RealArray, RealArray]:
        """d += length t and r -= length (kt - mean) in place, r laid out in the field."""
        kind = t.dtype.type
        self.blocks.run(
            self.blocks.kernels.advance, self.size, self.place, kind(length), t, kt, kind(mean), d, r, self.field
        )
        return d, r

    def pressure(
        self, p: RealArray, d: RealArray, scale: float, cap: RealArray | None, out: RealArray
    ) -> tuple[float, int]:
        """out = p + scale d, clipped."""
        np.copyto(out, p)
        arguments = (self.index, p.ravel(), d, scale, _cap(cap), out.ravel())
        change, clipped = self.blocks.sums(self.blocks.kernels.step_pressure, self.size, 2, *arguments).sum(axis=0)
        return float(change), int(clipped)


class _Convolution:
    """Transform, fused product with the kernel, transform back."""

    def __init__(
        self, blocks: Blocks, transform: RealTransform | PaddedTransform, kernel: RealArray, dtype: str
    ) -> None:
        self._blocks = blocks
        self._transform = transform
        self._kernel = np.ascontiguousarray(kernel, dtype=dtype).ravel()
        self._mean_factor = 0.5 / float(kernel.max() or 1.0)
        self._spectrum = np.empty(transform.spectrum_shape, np.complex128 if dtype == "float64" else np.complex64)

    def apply(self, field: RealArray, out: RealArray) -> RealArray:
        """Convolve ``field`` into ``out``."""
        spectrum = self._transform.forward(field, self._spectrum)
        self._blocks.run(self._blocks.kernels.scale_spectrum, spectrum.size, spectrum.ravel(), self._kernel)
        return self._transform.backward(spectrum, out)

    def solve(self, field: RealArray, out: RealArray) -> RealArray:
        """Divide by the kernel in Fourier space, the mean mode by twice its largest entry."""
        spectrum = self._transform.forward(field, self._spectrum)
        mean = spectrum[0, 0]
        self._blocks.run(self._blocks.kernels.divide_spectrum, spectrum.size, spectrum.ravel(), self._kernel)
        spectrum[0, 0] = mean * self._mean_factor
        return self._transform.backward(spectrum, out)


def _flat(field: RealArray) -> RealArray:
    """All memory of a field made by ``CpuEngine.field``, gaps between rows included; of others the field itself."""
    base = field if field.flags.c_contiguous or not isinstance(field.base, np.ndarray) else field.base
    return base.reshape(-1)


def _cap(cap: RealArray | None) -> RealArray:
    """Flat cap for the kernels: one value for all points, infinity for none, or one for each."""
    return _NO_CAP if cap is None else cap.ravel()
