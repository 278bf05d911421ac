"""Compile the numerical kernels before worker processes begin, each of which would else compile all
of them.

``python tests/compile_kernels.py mixed`` solves small problems that need the kernels of one share;
others are ``double`` and ``stress``. The compiled kernels are kept beside the sources (or in
NUMBA_CACHE_DIR), so only the first run takes time.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

import asperity as asp
from asperity.core.engine import kernels
from asperity.physics.stress.survey import StressRequest, survey

SHARES = ("mixed", "double", "stress")
"""About a third of the time each."""


def problems(body: asp.Elastic | asp.Layered) -> list[asp.ContactProblem]:
    heights = np.random.default_rng(1).standard_normal((64, 64))
    surface = asp.Surface(heights, 1.0, periodic=True)
    hard = np.full(heights.shape, 0.4)
    return [
        asp.ContactProblem(surface, body, law=law, boundary=boundary)
        for law in (asp.plasticity.HardWall(), asp.Hardness(0.5), asp.Hardness(hard))
        for boundary in (asp.Periodic(), asp.Free())
    ]


def compile_share(share: str) -> None:
    bodies = asp.Elastic(1.0, 0.3), asp.Layered([asp.Layer(asp.Elastic(4.0, 0.3), 2.0)], asp.Elastic(1.0, 0.2))
    if share != "stress":
        precision: Any = share
        for posed in [problem for body in bodies for problem in problems(body)]:
            asp.solve(posed, asp.MeanPressure(0.1), solver=asp.solvers.ActiveSet(precision=precision))
        return
    for body in bodies:
        gradients = asp.solvers.ConjugateGradient()  # with few kernels, which the other shares compile
        solved = asp.solve(problems(body)[0], asp.MeanPressure(0.1), solver=gradients, keep=asp.Keep(stiffness=False))
        for dtype in ("float64", "float32"):
            survey(StressRequest(friction=0.3, dtype=dtype), solved)


def compile_all() -> None:
    """All shares side by side, unless something is compiled already."""
    folder = Path(kernels.__file__).parent / "__pycache__"
    if "NUMBA_CACHE_DIR" not in os.environ and any(folder.glob("*.nbi")):
        return
    running = [subprocess.Popen([sys.executable, __file__, share]) for share in SHARES]
    for process in running:
        process.wait()


if __name__ == "__main__":
    compile_share(*sys.argv[1:])
