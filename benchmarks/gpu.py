"""The array engine on a GPU: agreement with the CPU to 1e-6, then seconds of a solve by grid size.

Usage: python benchmarks/gpu.py [--sizes 1024 2048 4096 8192 16384] [--load 0.05] [--check-size 512] [--library cupy]

``--library array_api_strict`` runs the same on the CPU, to see that it works where there is no GPU; its times mean nothing.
"""

from __future__ import annotations

import argparse
import importlib
import statistics
import sys
import time
from collections.abc import Callable
from typing import Any

from checks import relative_l2
from surfaces import BODY, LOADS, self_affine

import asperity as asp

AGREEMENT = 1e-6
"""Largest relative L2 difference of the pressures, both solved to 1e-10."""

FILM = asp.Layered([asp.Layer(asp.Elastic(10.0, 0.3), 4.0)], base=asp.Elastic(1.0, 0.3))


def problems(n: int) -> dict[str, tuple[asp.ContactProblem, float]]:
    """Contacts on which the engines must agree, with their mean pressures (E*)."""
    surface = self_affine(n)
    elastic = {f"elastic, load {load}": (asp.ContactProblem(surface, BODY), load) for load in LOADS}
    return elastic | {
        "free boundary": (asp.ContactProblem(surface, BODY, boundary=asp.Free()), 0.05),
        "hardness 0.3 E*": (asp.ContactProblem(surface, BODY, law=asp.Hardness(0.3)), 0.05),
        "film E 10, h 4 pixels": (asp.ContactProblem(surface, FILM), 0.2),
    }


def solved(
    problem: asp.ContactProblem, load: float, engine: Any, tolerance: float, precision: str
) -> asp.ContactResult:
    """Contact of ``problem`` on ``engine``."""
    solver = asp.solvers.ActiveSet(tolerance=tolerance, precision=precision)  # type: ignore[arg-type]
    return asp.solve(problem, asp.MeanPressure(load), solver=solver, engine=engine, keep=asp.Keep(stiffness=False))


def agree(n: int, engine: Any) -> bool:
    """Print how far the pressures are apart; whether all agree."""
    worst = 0.0
    for name, (problem, load) in problems(n).items():
        ours, reference = (solved(problem, load, machine, 1e-10, "mixed") for machine in (engine, asp.CpuEngine()))
        apart = relative_l2(ours.pressure, reference.pressure)
        pairs = f"{ours.certificate.fft_pairs:.1f} and {reference.certificate.fft_pairs:.1f} pairs"
        print(f"{n}² {name:<24} apart {apart:.1e}, {pairs}", flush=True)
        worst = max(worst, apart)
    return worst <= AGREEMENT


def seconds(work: Callable[[], asp.ContactResult], repeats: int) -> tuple[float, asp.ContactResult]:
    """Median wall time (s) of ``work``, which ends with its arrays on the host, and its last result."""
    found, result = [], work()  # the first one compiles and plans
    for _ in range(repeats):
        started = time.perf_counter()
        result = work()
        found.append(time.perf_counter() - started)
    return statistics.median(found), result


def timed(n: int, given: argparse.Namespace, engine: Any) -> str:
    """Row: seconds on the GPU, on all cores of the CPU where the grid is small enough for its patience, ratio."""
    problem, precision = asp.ContactProblem(self_affine(n), BODY), "single" if n >= given.single_from else "mixed"
    tolerance = 1e-5 if precision == "single" else 1e-6
    repeats = given.repeats if n <= 4096 else 1
    ours, result = seconds(lambda: solved(problem, given.load, engine, tolerance, precision), repeats)
    row = f"{n:>6} {precision:<7} {result.certificate.fft_pairs:>6.1f} {ours:>9.3f}"
    if n > given.largest_cpu:
        return row
    theirs, _ = seconds(lambda: solved(problem, given.load, asp.CpuEngine(), tolerance, precision), 1)
    return f"{row} {theirs:>9.3f} {theirs / ours:>7.1f}"


def main() -> None:
    """Check, then print one row for each size; exits with an error if the engines disagree."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--library", default="cupy", help="array-API library")
    parser.add_argument("--sizes", type=int, nargs="+", default=[1024, 2048, 4096, 8192, 16384])
    parser.add_argument("--load", type=float, default=0.05)
    parser.add_argument("--check-size", type=int, default=512)
    parser.add_argument("--single-from", type=int, default=16384, help="size from which single precision is used")
    parser.add_argument("--largest-cpu", type=int, default=4096, help="largest size that the CPU solves too")
    parser.add_argument("--repeats", type=int, default=5)
    given = parser.parse_args()
    engine = asp.ArrayEngine(importlib.import_module(given.library))
    print(f"asperity {asp.__version__}, {engine.name} against {asp.CpuEngine().name}")
    if not agree(given.check_size, engine):
        sys.exit(f"the pressures differ by more than {AGREEMENT:.0e}")
    print("size   precision pairs     GPU/s     CPU/s   ratio")
    for n in given.sizes:
        print(timed(n, given, engine), flush=True)


if __name__ == "__main__":
    main()
