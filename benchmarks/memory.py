"""Peak memory of an elastic periodic solve, in real float64 fields of the grid.

Each size is solved in a fresh process that has loaded the heights and solved a small problem
before. Counted is the rise of the largest resident set (ru_maxrss) over the resident set just
before the solve: everything but the heights themselves, native buffers included. Linux only. Usage:
python benchmarks/memory.py [--sizes 1024 2048] [--write]
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from surfaces import BODY, self_affine
from tables import add_option, made, show

import asperity as asp

_KIB = 1024


class Watch:
    """Progress that notes the largest resident set (bytes) at every iteration: that of the solver
    alone."""

    def __init__(self) -> None:
        self.largest = 0

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        self.largest = _largest()


def _largest() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * _KIB


def _resident() -> int:
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def _solve(heights: np.ndarray, load: float, tolerance: float, watch: Watch) -> None:
    surface = asp.Surface(heights, 1.0, 1.0, periodic=True)
    asp.solve(
        asp.ContactProblem(surface, BODY),
        asp.MeanPressure(load),
        solver=asp.solvers.ActiveSet(tolerance=tolerance),
        keep=asp.Keep(stiffness=False),
        progress=watch,
    )


def measured(file: str, load: float, tolerance: float) -> dict[str, float]:
    """Fields in the solver (operator and first guess included) and in all of ``solve`` (result
    included)."""
    _solve(np.array(self_affine(128).heights), load, tolerance, Watch())
    heights, watch = np.load(file), Watch()
    before, high = _resident(), _largest()
    _solve(heights, load, tolerance, watch)
    scale = heights.nbytes
    return {
        "solver": (watch.largest - before) / scale,
        "all": (_largest() - before) / scale,
        "uncertainty": max(high - before, 0) / scale,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[1024, 2048])
    parser.add_argument("--load", type=float, default=0.2)
    parser.add_argument("--tolerance", type=float, default=1e-6)
    parser.add_argument("--file", help=argparse.SUPPRESS)
    add_option(parser)
    given = parser.parse_args()
    if given.file:
        print(json.dumps(measured(given.file, given.load, given.tolerance)))
        return
    rows = []
    for n in given.sizes:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "heights.npy"
            np.save(file, self_affine(n).heights)
            command = [sys.executable, __file__, "--file", str(file), "--load", str(given.load)]
            command += ["--tolerance", str(given.tolerance)]
            found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        rows.append([n, given.load, *(f"{found[key]:.1f}" for key in ("solver", "all", "uncertainty"))])
    columns = ("n", "load", "fields, solver", "fields, all of `solve`", "not seen below")
    show(made("memory", columns, rows), write=given.write)


if __name__ == "__main__":
    main()
