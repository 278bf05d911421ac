"""The kernels of the GPU compiled as C++, blocks of one thread one after the other: the engine of a
GPU where there is none."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

from asperity.core.arrays import RealArray
from asperity.core.engine.gpu import GpuEngine, Passes

_PRELUDE = """
#include <math.h>
#define EMULATED
#define __global__
#define __device__ static
#define __shared__ static
struct Coordinate { unsigned x; };
static Coordinate blockIdx, threadIdx, blockDim = {1}, gridDim;
static void __syncthreads() {}
extern "C" void select_block(unsigned block, unsigned blocks) { blockIdx.x = block; gridDim.x = blocks; }
"""


class EmulatedGpu(GpuEngine):
    """Engine of a GPU on the CPU; the test is skipped where there is no compiler of C++."""

    def __init__(self) -> None:
        super().__init__(_cupy())

    def _device(self) -> str:
        return "emulated"

    def _compiled(self, iterate: str, vector: str) -> Passes:
        return Passes(self.cupy, iterate, vector, threads=1)

    def _planned(self, shape: tuple[int, int], dtype: str) -> _Transforms:
        return _Transforms(shape, dtype)


class _Transforms:
    """Transforms without normalisation, as those of cuFFT."""

    def __init__(self, shape: tuple[int, int], dtype: str) -> None:
        self.shape, self.dtype = shape, dtype

    def forward(self, field: RealArray) -> Any:
        found = np.fft.rfft2(field.view(np.ndarray))
        return _on_device(found.astype(np.complex64) if self.dtype == "float32" else found)

    def backward(self, spectrum: Any, out: RealArray) -> None:
        out[...] = np.fft.irfft2(spectrum.view(np.ndarray), s=self.shape, norm="forward")


class _Array(np.ndarray):
    """Array in the memory of the device: NumPy's operations do not mix it with arrays of the
    host."""

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        return _on_device(getattr(ufunc, method)(*_plain(inputs), **{k: _plain(value) for k, value in options.items()}))

    def __array_function__(self, function: Any, types: Any, inputs: Any, options: Any) -> Any:
        return _on_device(function(*_plain(inputs), **{k: _plain(value) for k, value in options.items()}))


def _plain(value: Any) -> Any:
    """The same as arrays of NumPy."""
    if isinstance(value, list | tuple):
        return type(value)(_plain(part) for part in value)
    if isinstance(value, _Array):
        return _view(value)
    assert not isinstance(value, np.ndarray) or not value.ndim, "an array of the host among those of the device"
    return value


def _on_device(values: Any) -> Any:
    return values.view(_Array) if isinstance(values, np.ndarray) else values


def _to_host(values: _Array, out: RealArray | None = None) -> RealArray:
    found = np.array(values.view(np.ndarray))
    if out is None:
        return found
    out[...] = found
    return out


def _made(function: Callable[..., Any]) -> Callable[..., Any]:
    return lambda *given, **options: _on_device(function(*(_view(value) for value in given), **options))


def _view(value: Any) -> Any:
    return value.view(np.ndarray) if isinstance(value, _Array) else value


@cache
def _cupy() -> ModuleType:
    """What the engine needs of the module ``cupy``, by NumPy."""
    module = ModuleType("numpy_for_cupy")
    for name in ("empty", "empty_like", "zeros", "zeros_like"):
        setattr(module, name, _made(getattr(np, name)))
    vars(module).update(
        ndarray=_Array,
        asarray=_made(np.array),
        ascontiguousarray=_made(np.ascontiguousarray),
        asnumpy=_to_host,
        RawModule=_Module,
        fft=SimpleNamespace(**{name: _made(getattr(np.fft, name)) for name in ("rfft", "fft", "ifft", "irfft")}),
    )
    return module


class _Module:
    """Kernels of ``code``, compiled with those of the ``options`` that define a word."""

    def __init__(self, code: str, options: tuple[str, ...]) -> None:
        self._library = _library(code, tuple(option for option in options if option.startswith("-D")))

    def get_function(self, name: str) -> Callable[..., None]:
        kernel, select = getattr(self._library, name), self._library.select_block

        def launch(grid: tuple[int], block: tuple[int], arguments: tuple[Any, ...]) -> None:
            assert block == (1,)
            given = [_argument(value) for value in arguments]
            for number in range(grid[0]):
                select(number, grid[0])
                kernel(*given)

        return launch


def _argument(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        assert value.flags.c_contiguous, "a kernel takes the memory as it lies"
        return ctypes.c_void_p(value.ctypes.data)
    return ctypes.c_double(value) if isinstance(value, float) else ctypes.c_longlong(value)


@cache
def _library(code: str, options: tuple[str, ...]) -> ctypes.CDLL:
    compiler = shutil.which("c++")
    if compiler is None:
        pytest.skip("needs a compiler of C++ to emulate a GPU: c++ is not installed")
    with tempfile.TemporaryDirectory() as folder:
        text, library = Path(folder, "kernels.cpp"), Path(folder, "kernels.so")
        text.write_text(_PRELUDE + code, encoding="utf-8")
        command = [compiler, "-O1", "-shared", "-fPIC", *options, "-o", str(library), str(text)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return ctypes.CDLL(str(library))
