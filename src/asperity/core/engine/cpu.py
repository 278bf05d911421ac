"""Engine of the CPU: FFT library with threads, compiled fused passes on blocks, vectors compressed to the working set."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import RealArray
from ..spectral import PaddedTransform, RealTransform, fft_library, thread_count
from .blocks import FEW, Blocks
from .cpu_cells import CpuCells
from .cpu_face import ROW_PAD, CpuFace, bound, memory
from .cpu_waves import CpuWaves
from .neighbourhood import SIDE, entering_levels
from .protocol import Cells, CellWaves, Convolution, Face, Hierarchy, Totals, Violation


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
        """Array of zeros."""
        return np.zeros(shape, dtype)

    def field(self, shape: tuple[int, int], dtype: str) -> RealArray:
        """Field of zeros; rows in single precision are apart by some more than their length.

        Rows of 2^k floats map to the same cache lines, which doubles the time of ducc0's last transform back.
        """
        pad = ROW_PAD if dtype == "float32" else 0
        return np.zeros((shape[0], shape[1] + pad), dtype)[:, : shape[1]]

    def convolution(self, kernel: RealArray, shape: tuple[int, int], dtype: str) -> Convolution:
        """Periodic convolution."""
        return _Convolution(self.blocks, RealTransform(shape, self._threads_for(shape)), kernel, dtype)

    def padded_convolution(
        self, kernel: RealArray, shape: tuple[int, int], padded: tuple[int, int], dtype: str
    ) -> Convolution:
        """Free convolution with pruned transforms."""
        return _Convolution(self.blocks, PaddedTransform(shape, padded, self._threads_for(padded)), kernel, dtype)

    def _threads_for(self, shape: tuple[int, int]) -> int:
        """Threads for transforms of this ``shape``."""
        return self.threads if shape[0] * shape[1] >= FEW else 1

    def cells(
        self, shape: tuple[int, int], hierarchies: tuple[Hierarchy, Hierarchy], waves: CellWaves | None, dtype: str
    ) -> Cells:
        """Nested cells. Two hierarchies work side by side, so their transforms share the threads."""
        cells = CpuCells(self.blocks, shape, hierarchies, dtype)
        if waves is None:
            return cells
        threads = max(1, self.threads // len(hierarchies))
        parts = waves.cells, waves.padded
        transform = RealTransform(parts[0], threads) if parts[0] == parts[1] else PaddedTransform(*parts, threads)
        alone = Blocks(1)
        products = tuple(_Convolution(alone, transform, waves.kernel, dtype) for _ in hierarchies)
        return CpuWaves(self.blocks, cells, waves, products, dtype)

    def refined(self, coarse: RealArray, coarse_heights: RealArray, heights: RealArray, stiffness: float) -> RealArray:
        """Pressure on the points of ``heights`` from a coarser one."""
        out = np.empty_like(heights)
        fine = _read_only(heights).reshape(heights.shape)
        arguments = (coarse, coarse_heights, fine, stiffness, out)
        self.blocks.share(self.blocks.kernels.refine, len(out), *arguments, alone=out.size < FEW)
        return out

    def survey(self, p: RealArray, u: RealArray, h: RealArray, cap: RealArray | None) -> CpuSurvey:
        """Survey of an iterate."""
        nx, ny = p.shape
        flat = p.ravel(), u.ravel(), _read_only(h)
        squares = np.zeros((-(-nx // SIDE), -(-ny // SIDE), 3))
        s = np.zeros((len(squares), 3 if cap is None else 7))
        kernels, alone = self.blocks.kernels, p.size < FEW
        if cap is None:
            self.blocks.share(kernels.survey, len(s), *flat, ny, SIDE, s, squares, alone=alone)
            pressure, work = (float(v) for v in s[:, :2].sum(axis=0))
            lowest = float(s[:, 2].min())
            totals = Totals(pressure, work, pressure, work, lowest, -np.inf, lowest)
        else:
            self.blocks.share(kernels.survey_capped, len(s), *flat, bound(cap), ny, SIDE, s, squares, alone=alone)
            pressure, work, weight, weighted = (float(v) for v in s[:, :4].sum(axis=0))
            bounds = float(s[:, 4].min()), float(s[:, 5].max()), float(s[:, 6].min())
            totals = Totals(pressure, work, weight, weighted, *bounds)
        return CpuSurvey(totals, self.blocks, (nx, ny), *flat, cap, squares)

    def violation(self, p: RealArray, u: RealArray, h: RealArray, cap: RealArray | None, level: float) -> Violation:
        """How far an iterate is from the contact conditions."""
        arguments = (p.ravel(), u.ravel(), _read_only(h), bound(cap), level)
        s = self.blocks.sums(self.blocks.kernels.violation, p.size, 3, *arguments)
        return Violation(float(s[:, 0].sum()), float(s[:, 1].sum()), float(s[:, 2].max()))

    def add(self, field: RealArray, factor: float, values: RealArray) -> None:
        """values += factor field."""
        row, stride = field.shape[1], field.strides[0] // field.itemsize
        self.blocks.run(self.blocks.kernels.add, values.size, memory(field), row, stride, factor, values.ravel())

    def release(self, face: Face, field: RealArray) -> None:
        """Zero on the face."""
        assert isinstance(face, CpuFace)
        self.blocks.run(self.blocks.face_kernels.clear, face.size, face.place(field), memory(field))


@dataclass(frozen=True, eq=False)
class CpuSurvey:
    """Sums over an iterate of flat fields."""

    totals: Totals
    blocks: Blocks
    shape: tuple[int, int]
    p: RealArray
    u: RealArray
    h: RealArray
    cap: RealArray | None
    squares: RealArray

    def face(self, level: float, scale: float, dtype: str) -> CpuFace:
        """Working set at ``level``."""
        kernels, size, row = self.blocks.kernels, self.p.size, self.shape[1]
        levels = entering_levels(self.squares, level)
        mask = np.zeros(-(-size // 8) * 8, np.uint8)
        counts = np.zeros((len(levels), 2), dtype=np.int64)
        if self.cap is None:
            loaded = self.squares[..., 0]
            self._share(kernels.mark_elastic, self.p, self.u, self.h, row, SIDE, levels, loaded, mask, counts)
        else:
            self._share(kernels.mark_face, self.p, self.u, self.h, bound(self.cap), row, SIDE, levels, mask, counts)
        starts = np.concatenate([[0], np.cumsum(counts[:, 0])])
        padded = self.shape[0] * (self.shape[1] + ROW_PAD)
        index = np.empty(int(starts[-1]), dtype=np.int32 if padded < 2**31 else np.int64)
        residual = np.empty(index.size, dtype=dtype)
        self._share(kernels.fill_face, self.u, self.h, level, scale, SIDE // 8 * row, mask, starts, index, residual)
        return CpuFace(self.blocks, self.shape, index, residual, int(counts[:, 1].sum()))

    def _share(self, kernel: Any, *arguments: Any) -> None:
        self.blocks.share(kernel, len(self.squares), *arguments, alone=self.p.size < FEW)


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


def _read_only(values: RealArray) -> RealArray:
    """Flat view that cannot be written to: passes are compiled once, whatever heights a user brings."""
    flat = values.ravel()
    flat.setflags(write=False)
    return flat
