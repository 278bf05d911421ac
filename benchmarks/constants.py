"""FFT pairs of the fast solver for other values of its constants: the figures beside them in ``contact/solvers/active_set``.

Usage: python benchmarks/constants.py [NAME ...]
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from collections.abc import Iterator
from statistics import mean
from typing import Any

from surfaces import BODY, self_affine

import asperity as asp
from asperity.contact.solvers.active_set import linear_system, solver
from asperity.contact.solvers.active_set.linear_system import Stopping
from asperity.core.engine import cpu

VALUES: dict[tuple[Any, str], list[Any]] = {
    (solver, "_PRIOR"): [1.0, 2.0, 8.0, 16.0],
    (solver, "_SCATTER_SHARE"): [0.0, 0.3, 0.7, 1.0],
    (solver, "_SETTLED"): [0.0, 0.001, 0.01, 0.03],
    (solver, "_REDUCTION"): [0.1, 0.2, 0.5],
    (solver, "_UNSETTLED_STEPS"): [2, 4, 6],
    (solver, "_NEARLY_SETTLED"): [Stopping(x, 8) for x in (0.03, 0.2, 0.3)] + [Stopping(0.1, n) for n in (3, 5, 12)],
    (solver, "_SETTLED_SET"): [Stopping(x, 14) for x in (1e-6, 1e-3, 1e-2)] + [Stopping(1e-4, n) for n in (8, 20, 40)],
    (solver, "_MARGIN"): [0.3, 0.5, 1.0],
    (solver, "LEAST_SHARE"): [0.01, 0.03, 0.3],
    (solver, "_MOST_UNSUCCESSFUL"): [0, 1, 4],
    (solver, "_REFRESH"): [1e-3, 1e-4, 1e-7],
    (solver, "COARSEST"): [32, 128],
    (solver, "_COARSE_ITERATIONS"): [3, 10, 100],
    (solver, "_HIDDEN_SHARE"): [0.02, 0.05, 0.2, 0.5],
    (solver, "_LOOSEST"): [0.003, 0.01, 0.1],
    (solver, "_FINE_STIFFNESS"): [0.0, 0.1, 0.2, 0.3],
    (linear_system, "_STEP_LENGTH"): [0.4, 0.55, 0.85, 1.0],
    (linear_system, "PIXEL_SHARE"): [0.4, 0.5, 0.7, 0.8, 1.0],
    (linear_system, "PIXEL_SHARE_COARSE"): [0.6, 0.7, 1.0],
    (linear_system, "_DEPTH"): [2, 4],
    (linear_system, "_STEEP"): [1.5, 4.0],
    (cpu, "SQUARE_SIDE"): [8, 32, 64],
}


def cases() -> Iterator[tuple[str, asp.ContactProblem, float, asp.solvers.ActiveSet]]:
    """Kind, problem, load over E*, and solver."""
    loose, tight = asp.solvers.ActiveSet(tolerance=1e-6), asp.solvers.ActiveSet(tolerance=1e-10)
    monotone = asp.solvers.ActiveSet(tolerance=1e-6, monotone=True)
    for seed in (1, 2):
        large, small = self_affine(512, seed=seed), self_affine(256, seed=seed)
        for load in (0.01, 0.05, 0.2):
            yield "elastic", asp.ContactProblem(large, BODY), load, loose
        for thickness, load in ((4.0, 0.2), (20.0, 0.4)):
            film = asp.Layered([asp.Layer(asp.Elastic(10.0, 0.3), thickness)], base=asp.Elastic(1.0, 0.3))
            yield "film", asp.ContactProblem(large, film), load, loose
        for load in (0.02, 0.1):
            yield "free", asp.ContactProblem(small, BODY, boundary=asp.Free()), load, loose
            yield "cap", asp.ContactProblem(small, BODY, law=asp.Hardness(0.3)), load, loose
            yield "tight", asp.ContactProblem(small, BODY), load, tight
            yield "monotone", asp.ContactProblem(small, BODY), load, monotone


def pairs() -> str:
    """Mean pairs of each kind, as one line."""
    found = defaultdict(list)
    for kind, problem, load, method in cases():
        keep = asp.Keep(stiffness=False)
        result = asp.solve(problem, asp.MeanPressure(load), solver=method, keep=keep, engine=asp.CpuEngine(1))
        found[kind].append(result.certificate.fft_pairs)
    return ", ".join(f"{kind} {mean(values):.1f}" for kind, values in found.items())


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*", help="constants; all by default")
    names = parser.parse_args().names
    print("as it is:", pairs())
    for (module, name), values in VALUES.items():
        if names and name not in names:
            continue
        usual = getattr(module, name)
        for value in values:
            setattr(module, name, value)
            print(f"{name} {usual} -> {value}:", pairs(), flush=True)
        setattr(module, name, usual)


if __name__ == "__main__":
    main()
