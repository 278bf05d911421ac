"""Engine of any array-API library, such as CuPy on a GPU: whole-array passes, working sets as masks."""

from __future__ import annotations

import math
from functools import cached_property
from typing import Any

from ..arrays import RealArray
from .generic_cells import ArrayCells
from .generic_survey import ArraySurvey
from .library import Library, bound, compat
from .protocol import Cells, CellWaves, Convolution, Face, Hierarchy, Violation


class ArrayEngine:
    """Engine on the arrays of a library that follows the array-API standard with its ``fft`` extension.

    Parameters
    ----------
    namespace
        The library, such as the module ``cupy``. Its arrays must be writable and may be float64.
    device
        Device in the library's own words; its default device if not given.
    """

    def __init__(self, namespace: Any, *, device: Any = None) -> None:
        self._library = library = Library.of(namespace, device)
        where = str(compat().device(library.zeros((1, 1), "float64"))).strip("<>")
        self.name = f"{namespace.__name__} ({where})"

    def array(self, values: RealArray | float, dtype: str) -> Any:
        """``values`` on the device."""
        return self._library.array(values, dtype)

    def numpy(self, values: Any) -> RealArray:
        """``values`` in the memory of the host."""
        return self._library.numpy(values)

    def zeros(self, shape: tuple[int, int], dtype: str) -> Any:
        """Field of zeros."""
        return self._library.zeros(shape, dtype)

    field = zeros

    def convolution(self, kernel: RealArray, shape: tuple[int, int], dtype: str) -> Convolution:
        """Periodic convolution."""
        return _Convolution(self._library, kernel, shape, shape, dtype)

    def padded_convolution(
        self, kernel: RealArray, shape: tuple[int, int], padded: tuple[int, int], dtype: str
    ) -> Convolution:
        """Free convolution with pruned transforms."""
        return _Convolution(self._library, kernel, shape, padded, dtype)

    def cells(
        self, shape: tuple[int, int], hierarchies: tuple[Hierarchy, Hierarchy], waves: CellWaves | None, dtype: str
    ) -> Cells:
        """Nested cells."""
        product = None
        if waves is not None:
            product = _Convolution(self._library, waves.kernel, waves.cells, waves.padded, dtype)
        return ArrayCells(self._library, hierarchies, waves, product, dtype)

    def refined(self, coarse: RealArray, coarse_heights: RealArray, heights: RealArray, stiffness: float) -> RealArray:
        """Pressure on the points of ``heights`` from a coarser one."""
        xp, fine = self._library.xp, self.array(heights, "float64")
        nx, ny = fine.shape
        p, base = (
            xp.repeat(xp.repeat(self.array(values, "float64"), 2, axis=0), 2, axis=1)[:nx, :ny]
            for values in (coarse, coarse_heights)
        )
        raised = p + float(stiffness) * (fine - base)
        return self.numpy(self._library.select((p > 0.0) & (raised > 0.0), raised))

    def survey(self, p: Any, u: Any, h: Any, cap: Any) -> ArraySurvey:
        """Survey of an iterate."""
        double = self._library.xp.float64
        p, u, h = (self._library.xp.astype(values, double, copy=False) for values in (p, u, h))
        return ArraySurvey.of(self._library, p, u, h, cap)

    def violation(self, p: Any, u: Any, h: Any, cap: Any, level: float) -> Violation:
        """How far an iterate is from the contact conditions."""
        xp, select, numbers = self._library.xp, self._library.select, self._library.numbers
        gap = u - h - float(level)
        p = select(p > 0.0, p)
        above = xp.sum(select(gap > 0.0, gap) * p)
        if cap is None:
            first, deepest = numbers([above, xp.max(select(gap < 0.0, -gap))])
            return Violation(first, math.inf if deepest > 0.0 else 0.0, deepest)
        room = bound(self._library, cap, p) - p
        overlap = select((gap < 0.0) & (room > 0.0), -gap)
        return Violation(*numbers([above, xp.sum(overlap * room), xp.max(overlap)]))

    def add(self, field: Any, factor: float, values: Any) -> None:
        """values += factor field."""
        values[...] = values + float(factor) * self._library.xp.astype(field, values.dtype)

    def release(self, face: Face, field: Any) -> None:
        """Zero everywhere."""
        field[...] = 0.0


class _Convolution:
    """Transform, product with the kernel, transform back; along y only the rows that hold data."""

    def __init__(
        self, library: Library, kernel: RealArray, shape: tuple[int, int], padded: tuple[int, int], dtype: str
    ) -> None:
        self._library = library
        self._kernel = library.array(kernel, dtype)
        self._mean_factor = 0.5 / float(kernel.max() or 1.0)
        self._shape = shape
        self._padded = padded

    @cached_property
    def _inverse(self) -> Any:
        kernel = self._library.numpy(self._kernel).copy()
        kernel[0, 0] = 1.0 / self._mean_factor
        return self._library.array(1.0 / kernel, str(kernel.dtype))

    def apply(self, field: Any, out: Any) -> Any:
        """Convolve ``field`` into ``out``."""
        return self._multiply(field, self._kernel, out)

    def solve(self, field: Any, out: Any) -> Any:
        """Divide by the kernel in Fourier space, the mean mode by twice its largest entry."""
        return self._multiply(field, self._inverse, out)

    def _multiply(self, field: Any, factor: Any, out: Any) -> Any:
        fft, (mx, my) = self._library.xp.fft, self._padded
        if self._shape == self._padded:
            out[...] = fft.irfftn(fft.rfftn(field, axes=(0, 1)) * factor, s=(mx, my), axes=(0, 1))
            return out
        nx, ny = self._shape
        spectrum = fft.fft(fft.rfft(field, n=my, axis=1), n=mx, axis=0) * factor
        out[...] = fft.irfft(fft.ifft(spectrum, axis=0)[:nx, :], n=my, axis=1)[:, :ny]
        return out
