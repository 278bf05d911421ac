"""Transforms and array accelerators are chosen in one place, ``core``; nobody else names such a library."""

from __future__ import annotations

import ast

import pytest
from architecture.source import Module, imports, library

FFT_LIBRARIES = ("numpy.fft", "scipy.fft", "scipy.fftpack", "ducc0", "pyfftw", "mkl_fft")
ACCELERATORS = ("numba", "cupy", "jax", "torch", "array_api_compat")
RESERVED = FFT_LIBRARIES + ACCELERATORS
FFT_ATTRIBUTES = {"np.fft", "numpy.fft", "sp.fft", "scipy.fft", "scipy.fftpack"}


def violations(module: Module) -> list[str]:
    """One sentence for each use of a reserved library in ``module``."""
    found = [f"{module.name}:{item.line} imports {item.target}" for item in imports(module) if reserved(item.target)]
    for node in ast.walk(module.tree):
        text = ast.unparse(node) if isinstance(node, ast.Attribute) else ""
        if text in FFT_ATTRIBUTES:
            found.append(f"{module.name}:{node.lineno} uses {text}")
    return found


def reserved(target: str) -> bool:
    """Whether ``target`` is a reserved library or a part of one."""
    return any(target == name or target.startswith(name + ".") for name in RESERVED)


@pytest.mark.parametrize("module", [m for m in library() if m.folder != "core"], ids=lambda module: module.name)
def test_only_core_names_an_fft_or_accelerator_library(module: Module) -> None:
    assert violations(module) == [], "use core.spectral and core.grid instead"


@pytest.mark.parametrize(
    "text",
    [
        "import numpy.fft",
        "from numpy import fft",
        "from numpy.fft import rfft2",
        "from scipy.fft import dctn",
        "import scipy.fft as f",
        "import ducc0",
        "from ducc0 import fft",
        "def f():\n    import cupy as cp",
        "from numba import njit",
        "import array_api_compat.numpy",
        "importlib.import_module('torch')",
        "q = np.fft.fftfreq(8)",
        "q = numpy.fft.rfft2(h)",
    ],
)
def test_reserved_libraries_are_found(text: str) -> None:
    assert violations(Module("asperity.contact.x", text))


@pytest.mark.parametrize("text", ["import numpy as np\nnp.sum(h)", "from scipy import optimize", "t.fft(h)"])
def test_ordinary_code_is_allowed(text: str) -> None:
    assert violations(Module("asperity.contact.x", text)) == []
