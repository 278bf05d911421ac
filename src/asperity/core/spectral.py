"""Real two-dimensional Fourier transforms, prepared once and applied many times.

The only module that touches an FFT library: ducc0 (extra ``fast``) when it is installed, NumPy
otherwise. The forward transform is unnormalised, the backward one carries 1/(nx·ny).
"""

from __future__ import annotations

import importlib
import importlib.util
import os
import sys
from dataclasses import dataclass
from functools import cached_property
from typing import Any, cast

import numpy as np

from . import require
from .arrays import ComplexArray, RealArray
from .grid import Grid
from .values import Whole

_CACHE_LINE = 64  # bytes
# Data so many bytes apart share one of about ten places in the cache: enough for the eight rows of
# double precision that are transformed at once, not for sixteen of single precision, which take 2.6
# times as long.
_SAME_PLACE = 4096
_ROWS = 64  # of single precision that go through rows elsewhere at a time


def thread_count(threads: int | None = None) -> int:
    """Number of threads: ``threads``, else the environment variable ASPERITY_THREADS, else the
    usable cores."""
    if threads is not None:
        return require.integer(threads, 1, "number of threads")
    from_environment = os.environ.get("ASPERITY_THREADS")
    if from_environment is not None:
        return Whole(1, 4096).read(from_environment, "environment variable ASPERITY_THREADS")
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def mode_sum(grid: Grid, half: RealArray) -> float:
    """(1/A) Σ over all modes of ``grid`` of a quantity given on the half spectrum (nx, ny // 2 +
    1).

    For the spectrum C (m⁴) this is the mean square height (m²); for q²C the mean square gradient.
    """
    return float(half.sum(axis=0) @ multiplicity(grid)) / grid.area


def multiplicity(grid: Grid) -> RealArray:
    """How many modes of the full plane each column (ny // 2 + 1,) of a half spectrum stands for."""
    weights = np.full(grid.shape[1] // 2 + 1, 2.0)
    weights[0] = 1.0
    if grid.shape[1] % 2 == 0:
        weights[-1] = 1.0
    return weights


def fft_library() -> str:
    """Name of the FFT library in use: ``ducc0`` or ``numpy``."""
    return "ducc0" if importlib.util.find_spec("ducc0") else "numpy"


def _ducc_transforms() -> Any:
    """Module of ducc0's transforms, or None where NumPy serves."""
    if fft_library() == "numpy":
        return None
    # importing again what is there takes as long as to transform a short line
    return sys.modules.get("ducc0.fft") or importlib.import_module("ducc0.fft")


def fast_length(minimum: int) -> int:
    """Smallest transform length of at least ``minimum`` without prime factors above 11."""
    length = require.integer(minimum, 1, "transform length")
    while True:
        left = length
        for prime in (2, 3, 5, 7, 11):
            while left % prime == 0:
                left //= prime
        if left == 1:
            return length
        length += 1


def line_transform(field: RealArray, axis: int, threads: int = 1, out: ComplexArray | None = None) -> ComplexArray:
    """Unnormalised real transform of every line of ``field`` along ``axis``, whose length becomes
    n // 2 + 1, into ``out``."""
    ducc = _ducc_transforms()
    lines: ComplexArray
    if ducc is None:
        lines = np.fft.rfft(field, axis=axis, out=cast(Any, out))
    else:
        lines = ducc.r2c(field, axes=(axis,), out=out, nthreads=threads)
    return lines


def complex_lines(
    values: ComplexArray, axis: int, *, backward: bool = False, threads: int = 1, out: ComplexArray | None = None
) -> ComplexArray:
    """Unnormalised, or if ``backward`` normalised inverse, transform of every line of ``values``
    along ``axis``.

    Written into ``out`` if given, which may be ``values``.
    """
    ducc = _ducc_transforms()
    lines: ComplexArray
    if ducc is None:
        lines = (np.fft.ifft if backward else np.fft.fft)(values, axis=axis, out=cast(Any, out))
    else:
        norm = 2 if backward else 0
        lines = ducc.c2c(values, axes=(axis,), forward=not backward, inorm=norm, out=out, nthreads=threads)
    return lines


def real_lines(spectrum: ComplexArray, length: int, threads: int = 1, out: RealArray | None = None) -> RealArray:
    """Normalised inverse of :func:`line_transform` along the last axis, for lines of ``length``
    points, into ``out``."""
    ducc = _ducc_transforms()
    lines: RealArray
    if ducc is None:
        lines = np.fft.irfft(spectrum, n=length, axis=-1, out=cast(Any, out))
    else:
        last = (spectrum.ndim - 1,)
        lines = ducc.c2r(spectrum, axes=last, lastsize=length, forward=False, inorm=2, out=out, nthreads=threads)
    return lines


def linear_autocorrelation(values: RealArray) -> RealArray:
    """Σ_j v_j v_(j+l) of the ``values`` (n,) at the lags l = 0 … n - 1, without wrapping around."""
    n = values.size
    half = line_transform(np.concatenate([values, np.zeros(n)]), 0)
    return real_lines(np.square(np.abs(half)).astype(complex), 2 * n)[:n]


@dataclass(frozen=True)
class RealTransform:
    """Transform pair between real fields (nx, ny) and half spectra (nx, ny // 2 + 1).

    Parameters
    ----------
    shape
        (nx, ny), any lengths >= 1.
    threads
        Number of threads used by the library (ducc0 only).
    """

    shape: tuple[int, int]
    threads: int = 1

    @cached_property
    def _ducc(self) -> Any:
        return _ducc_transforms()

    @property
    def spectrum_shape(self) -> tuple[int, int]:
        """Shape of the half spectrum."""
        return self.shape[0], self.shape[1] // 2 + 1

    def forward(self, field: RealArray, out: ComplexArray | None = None) -> ComplexArray:
        """Unnormalised transform of ``field``; written into ``out`` if given."""
        spectrum: ComplexArray
        if self._ducc is None:
            spectrum = np.fft.rfft2(field, out=cast(Any, out))
        else:
            spectrum = self._ducc.r2c(field, axes=(0, 1), out=out, nthreads=self.threads)
        return spectrum

    def backward(self, spectrum: ComplexArray, out: RealArray | None = None) -> RealArray:
        """Normalised inverse transform of ``spectrum``, which may be overwritten."""
        field: RealArray
        if self._ducc is None:
            # axis by axis: numpy 2.4's irfft2 does not write into the array it is given
            columns = np.fft.ifft(spectrum, axis=0)
            field = np.fft.irfft(columns, n=self.shape[1], axis=1, out=cast(Any, out))
        else:
            field = self._ducc.c2r(
                spectrum,
                axes=(0, 1),
                lastsize=self.shape[1],
                forward=False,
                inorm=2,
                out=out,
                nthreads=self.threads,
                allow_overwriting_input=True,
            )
        return field


@dataclass(frozen=True)
class SplitTransform:
    """Transform pair between real fields (nx, ny) and half spectra turned over, (ny // 2 + 1, nx),
    the inverse in two steps.

    Lines of a spectrum, which run along x, can so be transformed while they are in the cache of
    whoever made them. Both steps use one thread and take a part of the whole, for callers to share
    out.
    """

    shape: tuple[int, int]

    def forward(self, field: RealArray, threads: int = 1) -> ComplexArray:
        """Unnormalised transform of ``field``."""
        ducc = _ducc_transforms()
        spectrum = np.fft.rfft2(field.T, axes=(1, 0)) if ducc is None else ducc.r2c(field.T, (1, 0), nthreads=threads)
        return np.ascontiguousarray(spectrum)

    def lines(self, fields: int, count: int, dtype: Any) -> ComplexArray:
        """Uninitialised array for ``count`` lines of ``fields`` to be made in, (fields, count, nx
        and a few)."""
        return np.asarray(_apart((fields, count, self.shape[0]), dtype))

    def between(self, fields: int, dtype: Any) -> ComplexArray:
        """Uninitialised array for ``fields`` between the steps, (fields, nx, ny // 2 + 1 and a
        few)."""
        return np.asarray(_apart((fields, self.shape[0], self.shape[1] // 2 + 1), dtype))

    def lines_back(self, made: ComplexArray, span: tuple[int, int], out: ComplexArray) -> None:
        """Step one: put the lines ``span`` (first, last + 1) of spectra, the first ones ``made``,
        between the steps."""
        start, stop = span
        lines = made[..., : stop - start, : self.shape[0]]
        complex_lines(lines, lines.ndim - 1, backward=True, out=np.swapaxes(out[..., start:stop], -1, -2))

    def rows_back(self, between: ComplexArray, span: tuple[int, int], out: RealArray) -> None:
        """Step two: write the rows ``span`` of fields into the array (…, rows, ny) ``out``."""
        start, stop = span
        ny = self.shape[1]
        waves = between[..., start:stop, : ny // 2 + 1]
        if out.itemsize > 4 or out.strides[-2] % _SAME_PLACE:
            real_lines(waves, ny, out=out)
            return
        block = _apart((_ROWS, ny), out.dtype)[:, :ny]
        for index in np.ndindex(*out.shape[:-2]):
            for first in range(0, stop - start, _ROWS):
                last = min(stop - start, first + _ROWS)
                out[index][first:last] = real_lines(waves[index][first:last], ny, out=block[: last - first])


def _apart(shape: tuple[int, ...], dtype: Any) -> Any:
    """Uninitialised lines, the last axis of ``shape``, each a little longer.

    By an odd number of cache lines, since lines a power of two apart would share places in the
    cache.
    """
    together = _CACHE_LINE // np.dtype(dtype).itemsize
    return np.empty((*shape[:-1], (-(-shape[-1] // together) | 1) * together), dtype)


@dataclass(frozen=True)
class PaddedTransform:
    """Transform pair between fields (nx, ny), zero beyond, and half spectra of the larger grid
    ``padded``.

    Pruned: along y only the nx rows that hold data are transformed, and back only the rows that are
    kept.
    """

    shape: tuple[int, int]
    padded: tuple[int, int]
    threads: int = 1

    @property
    def spectrum_shape(self) -> tuple[int, int]:
        """Shape of the half spectrum."""
        return self.padded[0], self.padded[1] // 2 + 1

    def forward(self, field: RealArray, out: ComplexArray) -> ComplexArray:
        """Unnormalised transform of the padded ``field`` into ``out``."""
        nx, ny = self.shape
        rows = np.zeros((nx, self.padded[1]), field.dtype)
        rows[:, :ny] = field
        out[nx:] = 0.0
        line_transform(rows, 1, self.threads, out[:nx])
        return complex_lines(out, 0, threads=self.threads, out=out)

    def backward(self, spectrum: ComplexArray, out: RealArray) -> RealArray:
        """First (nx, ny) points of the normalised inverse transform of ``spectrum``, which is
        overwritten."""
        nx, ny = self.shape
        complex_lines(spectrum, 0, backward=True, threads=self.threads, out=spectrum)
        out[...] = real_lines(spectrum[:nx], self.padded[1], self.threads)[:, :ny]
        return out


def wrapped(coefficients: RealArray, padded: tuple[int, int], *, odd_x: bool = False, odd_y: bool = False) -> RealArray:
    """Kernel of a cyclic convolution on the grid ``padded`` from coefficients at offsets (0…nx-1,
    0…ny-1).

    Those at negative offsets follow by symmetry; the kernel is zero at offsets that fields (nx, ny)
    never reach.
    """
    nx, ny = coefficients.shape
    kernel = np.zeros(padded)
    kernel[:nx, :ny] = coefficients
    kernel[padded[0] - nx + 1 :, :ny] = (-1.0 if odd_x else 1.0) * coefficients[:0:-1, :]
    kernel[:, padded[1] - ny + 1 :] = (-1.0 if odd_y else 1.0) * kernel[:, ny - 1 : 0 : -1]
    return kernel
