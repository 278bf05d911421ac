"""A load path against cold solves of its steps, and free against periodic boundaries.

Usage: python benchmarks/paths.py [--sizes 512 1024] [--steps 20] [--threads 2] [--write]
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable

import numpy as np
from checks import relative_l2
from surfaces import BODY, self_affine
from tables import add_option, made, show

import asperity as asp
from asperity.core.spectral import PaddedTransform, RealTransform, fast_length, thread_count

_LEAST, _MOST = 0.01, 0.2
_KEEP = asp.Keep(stiffness=False)


def timed(work: Callable[[], list[asp.ContactResult]]) -> tuple[float, list[asp.ContactResult]]:
    """Wall time (s) and results of ``work``."""
    started = time.perf_counter()
    results = work()
    return time.perf_counter() - started, results


def compare_path(problem: asp.ContactProblem, steps: int, tolerance: float, threads: int) -> list[str]:
    """Row: path, cold solves, their ratio in time and in FFT pairs, largest difference of the
    pressures."""
    controls = [asp.MeanPressure(float(load)) for load in np.linspace(_LEAST, _MOST, steps)]
    solver, engine = asp.solvers.ActiveSet(tolerance=tolerance), asp.engines.CpuEngine(threads)

    def along() -> list[asp.ContactResult]:
        return list(asp.solve(problem, asp.History(controls), solver=solver, engine=engine, keep=_KEEP).steps)

    def cold() -> list[asp.ContactResult]:
        return [asp.solve(problem, control, solver=solver, engine=engine, keep=_KEEP) for control in controls]

    path_seconds, path = timed(along)
    cold_seconds, alone = timed(cold)
    pairs, cold_pairs = (sum(result.certificate.fft_pairs for result in some) for some in (path, alone))
    apart = max(relative_l2(one.pressure, other.pressure) for one, other in zip(path, alone, strict=True))
    times = [f"{value:.2f}" for value in (path_seconds, cold_seconds, path_seconds / cold_seconds)]
    return [*times, f"{pairs:.0f}", f"{cold_pairs:.0f}", f"{pairs / cold_pairs:.2f}", f"{apart:.1e}"]


def compare_boundaries(surface: asp.Surface, load: float, tolerance: float, threads: int, repeats: int) -> list[str]:
    """Row: medians of periodic and free solves (alternating), their ratio, FFT pairs of each."""
    solver, engine = asp.solvers.ActiveSet(tolerance=tolerance), asp.engines.CpuEngine(threads)
    seconds: dict[str, list[float]] = {"periodic": [], "free": []}
    pairs: dict[str, float] = {}
    problems = {
        "periodic": asp.ContactProblem(surface, BODY),
        "free": asp.ContactProblem(surface, BODY, boundary=asp.Free()),
    }
    for _ in range(repeats):
        for name, problem in problems.items():
            result = asp.solve(problem, asp.MeanPressure(load), solver=solver, engine=engine, keep=_KEEP)
            seconds[name].append(result.certificate.wall_time)
            pairs[name] = result.certificate.fft_pairs
    periodic, free = (statistics.median(seconds[name]) for name in ("periodic", "free"))
    times = [f"{periodic:.3f}", f"{free:.3f}", f"{free / periodic:.2f}"]
    return [*times, f"{pairs['periodic']:.0f}", f"{pairs['free']:.0f}"]


def compare_pruning(n: int, threads: int, repeats: int = 15) -> list[str]:
    """Row: medians of a pair on the padded grid with all rows and with those that hold data only
    (float32), ratio."""
    padded = fast_length(2 * n - 1), fast_length(2 * n - 1)
    whole, pruned = RealTransform(padded, threads), PaddedTransform((n, n), padded, threads)
    spectrum = np.empty(whole.spectrum_shape, np.complex64)
    small, large = np.ones((n, n), np.float32), np.zeros(padded, np.float32)
    seconds: dict[str, list[float]] = {"whole": [], "pruned": []}
    for _ in range(repeats):
        for name, transform, field in (("whole", whole, large), ("pruned", pruned, small)):
            started = time.perf_counter()
            transform.backward(transform.forward(field, spectrum), field)
            seconds[name].append(time.perf_counter() - started)
    full, part = (statistics.median(seconds[name]) for name in ("whole", "pruned"))
    return [f"{1e3 * full:.2f}", f"{1e3 * part:.2f}", f"{part / full:.2f}"]


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024])
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--load", type=float, default=0.05, help="mean pressure of the comparison of boundaries")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--threads", type=int, default=thread_count())
    parser.add_argument("--tolerance", type=float, default=1e-6)
    add_option(parser)
    given = parser.parse_args()
    print(f"asperity {asp.__version__}, {given.threads} thread(s), tolerance {given.tolerance}")
    compare_boundaries(self_affine(128), given.load, 1e-4, given.threads, 1)  # compiles
    paths, boundaries, pruning = [], [], []
    for n in given.sizes:
        surface, work = self_affine(n), (given.tolerance, given.threads)
        paths.append([n, *compare_path(asp.ContactProblem(surface, BODY), given.steps, *work)])
        boundaries.append([n, *compare_boundaries(surface, given.load, *work, given.repeats)])
        pruning.append([n, *compare_pruning(n, given.threads)])
    of_path = ("n", "path (s)", "cold solves (s)", "ratio", "pairs", "pairs, cold", "ratio of pairs", "pressures apart")
    of_free = ("n", "periodic (s)", "free (s)", "ratio", "pairs, periodic", "pairs, free")
    of_rows = ("n", "padded pair, all rows (ms)", "rows with data (ms)", "ratio")
    show(made("padded-transforms", of_rows, pruning), write=False)
    show(made("path", of_path, paths), made("free-boundary", of_free, boundaries), write=given.write)


if __name__ == "__main__":
    main()
