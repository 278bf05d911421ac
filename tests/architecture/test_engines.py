"""Transforms and array accelerators are chosen in one place, ``core``; besides it, the kernels of
stresses are compiled."""

from __future__ import annotations

import ast

from architecture.source import Module, imports, library

FFT_LIBRARIES = ("numpy.fft", "scipy.fft", "scipy.fftpack", "ducc0", "pyfftw", "mkl_fft")
ACCELERATORS = ("numba", "cupy", "cupyx", "jax", "torch", "array_api_compat")
RESERVED = FFT_LIBRARIES + ACCELERATORS
FFT_ATTRIBUTES = {"np.fft", "numpy.fft", "sp.fft", "scipy.fft", "scipy.fftpack"}


def violations(module: Module) -> list[str]:
    """One sentence for each use of a reserved library in ``module``."""
    found = [f"{module.name}:{item.line} imports {item.target}" for item in imports(module) if reserved(item.target)]
    for node in ast.walk(module.tree):
        if isinstance(node, ast.Attribute) and node.attr in {"fft", "fftpack"} and ast.unparse(node) in FFT_ATTRIBUTES:
            found.append(f"{module.name}:{node.lineno} uses {ast.unparse(node)}")
    return found


def reserved(target: str) -> bool:
    """Whether ``target`` is a reserved library or a part of one."""
    return any(target == name or target.startswith(name + ".") for name in RESERVED)


COMPILED = ("asperity.core.", "asperity.physics.stress.kernels.", "asperity.solids.eigenstrain.kernels")
"""Where such libraries may be named: the kernels of stresses are compiled beside the physics that
they compute."""


def test_only_core_names_an_fft_or_accelerator_library() -> None:
    found = [text for module in library() if not module.name.startswith(COMPILED) for text in violations(module)]
    assert found == [], "use core.spectral and core.grid instead"


def test_reserved_libraries_are_found() -> None:
    samples = [
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
    ]
    assert [text for text in samples if not violations(Module("asperity.contact.x", text))] == []


def test_ordinary_code_is_allowed() -> None:
    samples = ["import numpy as np\nnp.sum(h)", "from scipy import optimize", "t.fft(h)"]
    assert [text for text in samples if violations(Module("asperity.contact.x", text))] == []
