"""Engine of any array-API library, such as CuPy on a GPU: whole-array passes, working sets as masks."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from typing import Any, cast

import numpy as np

from ..arrays import RealArray
from ..errors import InputError
from .protocol import Convolution, Face, Totals, Violation


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
        self._library = library = _Library.of(namespace, device)
        where = str(_compat().device(library.zeros((1, 1), "float64"))).strip("<>")
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

    def totals(self, p: Any, u: Any, h: Any, cap: Any) -> Totals:
        """Sums over an iterate."""
        xp, select, numbers = self._library.xp, self._library.select, self._library.numbers
        r, loaded = u - h, p > 0.0
        p = select(loaded, p)
        sums = [xp.sum(p), xp.sum(p * r), xp.sum(p * h), xp.min(r), xp.min(select(~loaded, r, math.inf))]
        if cap is None:
            pressure, work, height, lowest, lowest_open = numbers(sums)
            return Totals(pressure, work, height, pressure, work, lowest, -math.inf, lowest_open)
        capped = loaded & (p >= _bound(self._library, cap, p))
        inner = select(~capped, p)
        sums += [xp.sum(inner), xp.sum(inner * r), xp.max(select(capped, r, -math.inf))]
        pressure, work, height, lowest, lowest_open, weight, weighted, highest_capped = numbers(sums)
        return Totals(pressure, work, height, weight, weighted, lowest, highest_capped, lowest_open)

    def violation(self, p: Any, u: Any, h: Any, cap: Any, level: float) -> Violation:
        """How far an iterate is from the contact conditions."""
        xp, select, numbers = self._library.xp, self._library.select, self._library.numbers
        gap = u - h - float(level)
        above = xp.sum(select(gap > 0.0, gap) * p)
        if cap is None:
            first, deepest = numbers([above, xp.max(select(gap < 0.0, -gap))])
            return Violation(first, math.inf if deepest > 0.0 else 0.0, deepest)
        room = _bound(self._library, cap, p) - p
        overlap = select((gap < 0.0) & (room > 0.0), -gap)
        return Violation(*numbers([above, xp.sum(overlap * room), xp.max(overlap)]))

    def face(self, p: Any, u: Any, h: Any, cap: Any, level: float, scale: float, field: Any) -> ArrayFace:
        """Working set at ``level``."""
        library = self._library
        gap, loaded = u - h - float(level), p > 0.0
        entering = ~loaded & (gap < 0.0)
        inside = loaded | entering
        if cap is not None:
            capped = loaded & (p >= _bound(library, cap, p))
            leaving_cap = capped & (gap > 0.0)
            entering = entering | leaving_cap
            inside = (inside & ~capped) | leaving_cap
        start = library.select(inside, library.xp.astype(gap * (-1.0 / float(scale)), field.dtype))
        size, arrived = library.numbers([library.count(inside), library.count(entering)])
        return ArrayFace(library, inside, start, field, int(size), int(arrived))

    def release(self, face: Face, field: Any) -> None:
        """Zero everywhere."""
        field[...] = 0.0

    def rescale(self, p: Any, factor: float) -> None:
        """p *= factor."""
        p[...] = p * float(factor)

    def copy(self, source: Any, out: Any) -> None:
        """out[...] = source."""
        out[...] = source

    def segment(self, p: Any, q: Any, u: Any, v: Any, h: Any) -> tuple[float, float]:
        """Slope and curvature of the energy from p to q."""
        xp, step = self._library.xp, q - p
        slope, curvature = self._library.numbers([xp.sum(step * (u - h)), xp.sum(step * (v - u))])
        return slope, curvature

    def blend(self, a: Any, b: Any, weight: float) -> None:
        """b = a + weight (b - a)."""
        b[...] = a + float(weight) * (b - a)


@dataclass(frozen=True, eq=False)
class ArrayFace:
    """Working set as a mask; vectors are fields that are zero outside it, ``start`` the residual."""

    library: _Library
    inside: Any
    start: Any
    field: Any
    size: int
    entering: int

    def residual(self, *, centred: bool) -> Any:
        """Residual vector, laid out in the field."""
        r = self.start
        if centred and self.size:
            mean = self.library.numbers([self._sum(r)])[0] / self.size
            r = self.library.select(self.inside, r - mean)
        self.field[...] = r
        return r

    def zeros(self) -> Any:
        """Vector of zeros."""
        return self.library.xp.zeros_like(self.start)

    def lay(self, values: Any) -> None:
        """Lay ``values`` out in the field."""
        self.field[...] = values

    def copied(self, values: Any) -> Any:
        """``values``, which nothing changes in place."""
        return values

    def product(self, a: Any, b: Any) -> float:
        """Sum of a b."""
        return self.library.numbers([self._sum(a * b)])[0]

    def gather(self, field: Any, other: Any) -> tuple[Any, tuple[float, float]]:
        """Vector of ``field``, its sum and its product with ``other``."""
        values = self.library.select(self.inside, field)
        total, product = self.library.numbers([self._sum(values), self._sum(values * other)])
        return values, (total, product)

    def direct(self, z: Any, mean: float, ratio: float, t: Any) -> Any:
        """(z - mean) + ratio t, laid out in the field."""
        t = self.library.select(self.inside, (z - float(mean)) + float(ratio) * t)
        self.field[...] = t
        return t

    def advance(self, length: float, t: Any, kt: Any, mean: float, d: Any, r: Any) -> tuple[Any, Any]:
        """d + length t and r - length (kt - mean), the latter laid out in the field."""
        r = self.library.select(self.inside, r - float(length) * (kt - float(mean)))
        self.field[...] = r
        return d + float(length) * t, r

    def pressure(self, p: Any, d: Any, scale: float, cap: Any, out: Any) -> tuple[float, int]:
        """out = p + scale d, clipped."""
        library = self.library
        q = p + float(scale) * library.xp.astype(d, p.dtype)
        clipped = self.inside & (q < 0.0)
        out[...] = library.select(~clipped, q)
        if cap is not None:
            bound = _bound(library, cap, p)
            over = self.inside & (q > bound)
            out[...] = library.xp.where(over, bound, out)
            clipped = clipped | over
        change, number = library.numbers([library.xp.sum(out - p), library.count(clipped)])
        return change, int(number)

    def _sum(self, values: Any) -> Any:
        """Sum in double precision."""
        return self.library.xp.sum(values, dtype=self.library.xp.float64)


class _Convolution:
    """Transform, product with the kernel, transform back; along y only the rows that hold data."""

    def __init__(
        self, library: _Library, kernel: RealArray, shape: tuple[int, int], padded: tuple[int, int], dtype: str
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


@dataclass(frozen=True)
class _Library:
    """Array-API namespace ``xp`` with the few operations that need to know the device."""

    xp: Any
    device: Any

    @classmethod
    def of(cls, namespace: Any, device: Any) -> _Library:
        """Library of the module ``namespace``; its gaps to the standard are filled by array_api_compat."""
        if not hasattr(namespace, "zeros") or not hasattr(namespace, "__name__"):
            raise InputError(f"namespace of ArrayEngine must be a module such as cupy, but is {namespace!r}.")
        probe = namespace.zeros(1)
        xp = _compat().array_namespace(probe)
        if not hasattr(xp, "fft"):
            raise _unfit("Fourier transforms", namespace)
        try:
            probe[...] = 1.0
        except TypeError:
            raise _unfit("writable arrays", namespace) from None
        return cls(xp, device)

    def array(self, values: RealArray | float, dtype: str) -> Any:
        """``values`` on the device."""
        host = np.ascontiguousarray(values, dtype=dtype)
        return self.xp.asarray(host, dtype=getattr(self.xp, dtype), device=self.device)

    def numpy(self, values: Any) -> RealArray:
        """``values`` in the memory of the host."""
        compat = _compat()
        if compat.is_numpy_array(values):
            return np.asarray(values)
        if compat.is_cupy_array(values) or compat.is_torch_array(values):
            return np.asarray(compat.to_device(values, "cpu"))
        return cast(RealArray, np.from_dlpack(values, device="cpu"))

    def zeros(self, shape: tuple[int, int], dtype: str) -> Any:
        """Field of zeros."""
        return self.xp.zeros(shape, dtype=getattr(self.xp, dtype), device=self.device)

    def numbers(self, scalars: list[Any]) -> list[float]:
        """Double-precision ``scalars`` of the device as Python numbers, in one transfer."""
        return [float(value) for value in self.numpy(self.xp.stack(scalars))]

    def select(self, mask: Any, values: Any, other: float = 0.0) -> Any:
        """``values`` where ``mask``, else ``other``."""
        return self.xp.where(mask, values, self.xp.full((), other, dtype=values.dtype, device=self.device))

    def count(self, mask: Any) -> Any:
        """Number of points of ``mask`` as a double."""
        return self.xp.sum(self.xp.astype(mask, self.xp.uint8), dtype=self.xp.float64)


def _bound(library: _Library, cap: Any, p: Any) -> Any:
    """Flat ``cap`` in a shape that fits ``p``: one number, or one for each point."""
    return library.xp.reshape(cap, p.shape if math.prod(cap.shape) > 1 else ())


def _unfit(what: str, namespace: Any) -> InputError:
    return InputError(
        f"namespace of ArrayEngine must be a library with {what}, but is {namespace.__name__}. Use for example cupy."
    )


def _compat() -> Any:
    """array_api_compat; only who uses an array engine imports it."""
    return import_module("array_api_compat")
