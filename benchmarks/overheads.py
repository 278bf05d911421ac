"""What a call of ``asp.solve`` takes beyond its solver, in bare FFT pairs, along paths, under caps
and on stiff films.

Usage: python benchmarks/overheads.py [--sizes 256 512 1024 2048] [--repeats 5]

Processor seconds of one thread, the least of several interleaved runs, and only ratios of them:
other work on the machine hardly changes them. FFT pairs do not depend on the machine at all.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from surfaces import BODY, LOADS, self_affine

import asperity as asp
from asperity.core.spectral import RealTransform
from asperity.physics.stress.regions import planes
from asperity.physics.stress.survey import StressRequest, WantedSection, survey, survey_depths

SOLVER = asp.solvers.ActiveSet(tolerance=1e-6)
BASE = asp.Elastic(1.0, 0.3)
DX = 10e-9


class Watched:
    """Progress that notes the processor time at the first and the last iteration of the fine
    grid."""

    def __init__(self) -> None:
        self.spent = 0.0

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        self.spent = time.process_time()


def seconds(work: Callable[[], object]) -> float:
    """Processor time of ``work``."""
    started = time.process_time()
    work()
    return time.process_time() - started


def least(repeats: int, *works: Callable[[], object]) -> list[float]:
    """Least processor time of each of the ``works``, run in turn."""
    rounds = [[seconds(work) for work in works] for _ in range(repeats)]
    return [min(column) for column in zip(*rounds, strict=True)]


def solved(problem: asp.ContactProblem, load: float) -> asp.ContactResult:
    """Contact at the mean pressure ``load``, with all that a user gets."""
    return asp.solve(problem, asp.MeanPressure(load), solver=SOLVER, engine=asp.engines.CpuEngine(1))


def in_pairs(n: int, load: float, repeats: int) -> str:
    """Whole call in bare FFT pairs of double precision, and over its solver."""
    problem, transform = asp.ContactProblem(self_affine(n), BODY), RealTransform((n, n), 1)
    field, spectrum = np.random.default_rng(0).random((n, n)), np.empty(transform.spectrum_shape, complex)
    shares = []

    def whole() -> None:
        watched, started = Watched(), time.process_time()
        options: dict[str, Any] = {"solver": SOLVER, "engine": asp.engines.CpuEngine(1), "progress": watched}
        asp.solve(problem, asp.MeanPressure(load), **options)
        shares.append((time.process_time() - started) / (watched.spent - started))

    pair, call = least(
        repeats, lambda: [transform.backward(transform.forward(field, spectrum), field) for _ in range(10)], whole
    )
    return f"{call / (0.1 * pair):>8.0f} {min(shares):>8.3f}"


def path(n: int, steps: int, repeats: int) -> str:
    """Step of a path over a cold solve: processor time, FFT pairs."""
    problem = asp.ContactProblem(self_affine(n), BODY)
    controls = [asp.MeanPressure(float(load)) for load in np.linspace(LOADS[0], LOADS[-1], steps)]
    options: dict[str, Any] = {"solver": SOLVER, "engine": asp.engines.CpuEngine(1), "keep": asp.Keep(stiffness=False)}
    found: dict[str, float] = {}

    def along() -> None:
        done = asp.solve(problem, asp.History(controls), **options).steps
        found["path"] = sum(result.certificate.fft_pairs for result in done)

    def cold() -> None:
        found["cold"] = sum(asp.solve(problem, c, **options).certificate.fft_pairs for c in controls)

    stepwise, alone = least(repeats, along, cold)
    return f"{stepwise / alone:>8.2f} {found['path'] / found['cold']:>8.2f} {found['path'] / steps:>8.1f} pairs a step"


def ratios(n: int) -> list[tuple[str, float]]:
    """FFT pairs of capped, layered-hard and filmed contacts over those of the elastic half-space,
    mean over two surfaces."""
    coated = [asp.Layered([asp.Layer(asp.Elastic(10.0, 0.3), h)], base=BASE) for h in (4.0, 20.0)]
    hard = asp.Layered(
        [asp.Layer(asp.Elastic(0.91, 0.3, asp.Strength(hardness=0.6)), 4.0)],
        base=asp.Elastic(0.91, 0.3, asp.Strength(hardness=0.3)),
    )
    cases = {
        "hardness 0.3 E*": (BODY, BODY, asp.Hardness(0.3), (0.02, 0.1)),
        "hardness of a layer 0.6, base 0.3 E*": (hard, BODY, None, (0.02, 0.1)),
        "film E 10, h 4 pixels": (coated[0], BASE, asp.plasticity.HardWall(), (0.2,)),
        "film E 10, h 20 pixels": (coated[1], BASE, asp.plasticity.HardWall(), (0.4,)),
    }
    rows = []
    for name, (body, plain, law, loads) in cases.items():
        pairs, alone = 0.0, 0.0
        for seed in (1, 2):
            surface = self_affine(n, seed=seed)
            for load in loads:
                limits = asp.plasticity.LayeredHardness(body) if law is None else law
                posed = asp.ContactProblem(surface, body, law=limits)
                pairs += solved(posed, load).certificate.fft_pairs
                alone += solved(asp.ContactProblem(surface, plain), min(load, 0.1)).certificate.fft_pairs
        rows.append((name, pairs / alone))
    return rows


def surveyed(n: int, repeats: int) -> str:
    """Stress survey with three sections of a coated contact over the inverse transforms of the six
    components on its planes."""
    body = asp.Layered([asp.Layer(asp.Elastic(280e9, 0.25), 5 * DX)], asp.Elastic(70e9, 0.33))
    surface = asp.Surface(DX * self_affine(n).heights, DX, periodic=True)
    result = asp.solve(asp.ContactProblem(surface, body), asp.MeanPressure(2e9), engine=asp.engines.CpuEngine(1))
    request = StressRequest(friction=0.3, sections=(WantedSection("y", "max"),))
    number = len(planes(body, list(map(float, survey_depths(request, result)))))
    transform = RealTransform((n, n), 1)
    spectrum, field = transform.forward(result.pressure), np.empty((n, n))
    spectra = [spectrum.copy() for _ in range(6)]

    def bare() -> float:
        for one in spectra:  # which transforms overwrite
            one[...] = spectrum
        return seconds(lambda: [transform.backward(one, field) for one in spectra])

    survey(request, result, threads=1)  # compiles
    rounds = [
        (sum(bare() for _ in range(number)), seconds(lambda: survey(request, result, threads=1)))
        for _ in range(repeats)
    ]
    transforms, whole = (min(column) for column in zip(*rounds, strict=True))
    return f"{number} planes: {whole / transforms:.2f}"


def main() -> None:
    """Print one table for each question."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512, 1024, 2048])
    parser.add_argument("--path-size", type=int, default=512)
    parser.add_argument("--steps", type=int, default=20, help="of the path")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument(
        "--only", nargs="+", choices=("call", "path", "pairs", "survey"), default=["call", "path", "pairs", "survey"]
    )
    given = parser.parse_args()
    print(f"asperity {asp.__version__}, one thread, processor time")
    solved(asp.ContactProblem(self_affine(128), BODY), 0.1)  # compiles
    if "call" in given.only:
        print("asp.solve, everything included: in bare FFT pairs; over its solver")
        for n in given.sizes:
            for load in LOADS:
                print(f"{n:>5} {load:>5} {in_pairs(n, load, given.repeats)}", flush=True)
    if "path" in given.only:
        print(f"path of {given.steps} loads over cold solves: time, pairs")
        print(f"{given.path_size:>5} {path(given.path_size, given.steps, max(2, given.repeats // 2))}", flush=True)
    if "pairs" in given.only:
        print("FFT pairs over those of elastic contact of the homogeneous body, 512²")
        for name, ratio in ratios(512):
            print(f"{name:<40} {ratio:.2f}", flush=True)
    if "survey" in given.only:
        print("stress survey of a coated 512² contact with sections over the bare transforms of its planes")
        print(surveyed(512, given.repeats))


if __name__ == "__main__":
    main()
