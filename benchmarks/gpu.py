"""The engine of a GPU: agreement with the CPU to 1e-6, then seconds of a whole solve by grid size.

Usage: python benchmarks/gpu.py [--sizes 1024 2048 4096 8192 16384] [--load 0.05] [--check-size 512]
[--threads 2]

``--arrays LIBRARY`` runs ``ArrayEngine(LIBRARY)`` instead, array operations of for example cupy.
With array_api_strict that shows that this script works where there is no GPU; its times then mean
nothing.
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


def agree(n: int, engine: Any, reference: Any) -> bool:
    """Print how far the pressures are apart; whether all agree."""
    worst = 0.0
    for name, (problem, load) in problems(n).items():
        ours, theirs = (solved(problem, load, machine, 1e-10, "mixed") for machine in (engine, reference))
        apart = relative_l2(ours.pressure, theirs.pressure)
        pairs = f"{ours.certificate.fft_pairs:.1f} and {theirs.certificate.fft_pairs:.1f} pairs"
        print(f"{n}² {name:<24} apart {apart:.1e}, {pairs}", flush=True)
        worst = max(worst, apart)
    return worst <= AGREEMENT


def seconds(work: Callable[[], asp.ContactResult], repeats: int) -> tuple[float, float, asp.ContactResult]:
    """Wall time (s) of the first call of ``work``, which ends with its arrays on the host, the
    median of more, and the last result."""
    found = []
    for _ in range(repeats + 1):
        started = time.perf_counter()
        result = work()
        found.append(time.perf_counter() - started)
    return found[0], statistics.median(found[1:]), result


def timed(problem: asp.ContactProblem, precision: str, given: argparse.Namespace, engine: Any, reference: Any) -> str:
    """Row: FFT pairs, seconds of the first solve and of more; and on the CPU, where the grid is
    small enough for its patience, with the ratio."""
    n, tolerance = problem.grid.shape[0], 1e-5 if precision == "single" else 1e-6
    first, ours, result = seconds(lambda: solved(problem, given.load, engine, tolerance, precision), given.repeats)
    row = f"{n:>6} {precision:<7} {result.certificate.fft_pairs:>6.1f} {first:>9.3f} {ours:>9.3f}"
    if n > given.largest_cpu:
        return row
    repeats = given.repeats if n <= 2048 else 1
    _, theirs, _ = seconds(lambda: solved(problem, given.load, reference, tolerance, precision), repeats)
    return f"{row} {theirs:>9.3f} {theirs / ours:>7.1f}"


def main() -> None:
    """Check, then print one row for each size; exits with an error if the engines disagree."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--arrays", metavar="LIBRARY", help="array-API library to use in place of the engine of a GPU")
    parser.add_argument("--sizes", type=int, nargs="+", default=[1024, 2048, 4096, 8192, 16384])
    parser.add_argument("--load", type=float, default=0.05)
    parser.add_argument("--check-size", type=int, default=512)
    parser.add_argument("--threads", type=int, default=2, help="threads of the CPU")
    parser.add_argument("--single-from", type=int, default=16384, help="size from which single precision is tried, too")
    parser.add_argument("--largest-cpu", type=int, default=8192, help="largest size that the CPU solves too")
    parser.add_argument("--repeats", type=int, default=3)
    given = parser.parse_args()
    engine = asp.engines.ArrayEngine(importlib.import_module(given.arrays)) if given.arrays else asp.engines.GpuEngine()
    reference = asp.engines.CpuEngine(given.threads)
    print(f"asperity {asp.__version__}, {engine.name} against {reference.name}")
    if not agree(given.check_size, engine, reference):
        sys.exit(f"the pressures differ by more than {AGREEMENT:.0e}")
    print("size   precision pairs   first/s     GPU/s     CPU/s   ratio")
    for n in given.sizes:
        problem = asp.ContactProblem(self_affine(n), BODY)
        for precision in ("mixed", "single") if n >= given.single_from else ("mixed",):
            print(timed(problem, precision, given, engine, reference), flush=True)


if __name__ == "__main__":
    main()
