"""Cost of the default solver in units of a bare FFT pair of the same grid, both timed in this run.

Usage: python benchmarks/run.py [--sizes 256 512 1024] [--threads 1]
"""

from __future__ import annotations

import argparse
import platform
import statistics
import time
from collections.abc import Callable

import numpy as np

import asperity as asp
from asperity.core.spectral import RealTransform, fft_library

LOADS = (0.01, 0.05, 0.2)
"""Mean pressure over contact modulus, at unit rms slope."""


def median_seconds(work: Callable[[], object], repeats: int) -> float:
    """Median wall time of ``work`` after one warm-up."""
    work()
    seconds = []
    for _ in range(repeats):
        started = time.perf_counter()
        work()
        seconds.append(time.perf_counter() - started)
    return statistics.median(seconds)


def pair_seconds(n: int, threads: int) -> float:
    """Median time of one real transform pair with preallocated outputs."""
    transform = RealTransform((n, n), threads)
    field = np.random.default_rng(0).standard_normal((n, n))
    spectrum, back = transform.forward(field), np.empty_like(field)
    return median_seconds(lambda: transform.backward(transform.forward(field, spectrum), back), 15)


def self_affine(n: int) -> asp.Surface:
    """Periodic surface of Hurst exponent 0.8, roll-off L/4, cut-off 8 pixels, unit rms slope."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(1.0), hurst=0.8, rolloff_wavelength=n / 4, shortest_wavelength=8.0
    )
    return asp.generate.gaussian(asp.Grid((n, n), (1.0, 1.0)), spectrum, seed=1)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512, 1024])
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--tolerance", type=float, default=1e-6)
    options = parser.parse_args()

    print(
        f"asperity {asp.__version__}, {fft_library()}, {options.threads} thread(s), numpy {np.__version__}, "
        f"python {platform.python_version()}, {platform.machine()}"
    )
    print("self-affine, H = 0.8, roll-off L/4, cut-off 8 pixels, rms slope 1, periodic; tolerance", options.tolerance)
    print(
        f"{'n':>5} {'load':>5} {'area':>7} {'iter':>5} {'pairs':>6} {'time/s':>7} {'pair/ms':>8} {'time/(pairs*pair)':>18}"
    )
    for n in options.sizes:
        pair = pair_seconds(n, options.threads)
        problem = asp.ContactProblem(self_affine(n), asp.Elastic(0.91, 0.3))
        operator = asp.prepare_operator(
            problem.compliance, problem.grid, problem.boundary, engine=asp.CpuEngine(options.threads)
        )
        solver = asp.solvers.ConjugateGradient(tolerance=options.tolerance)
        for load in LOADS:
            result = asp.solve(
                problem, asp.MeanPressure(load), solver=solver, operator=operator, keep=asp.Keep(stiffness=False)
            )
            work = result.certificate
            ratio = work.wall_time / (work.fft_pairs * pair)
            print(
                f"{n:>5} {load:>5} {result.area_fraction:>7.4f} {work.iterations:>5} {work.fft_pairs:>6.0f} "
                f"{work.wall_time:>7.2f} {1e3 * pair:>8.2f} {ratio:>18.2f}"
            )


if __name__ == "__main__":
    main()
