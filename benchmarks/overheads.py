"""What a call of ``asp.solve`` takes beyond its solver, in bare FFT pairs, under caps and on stiff
films, and a stress survey.

Usage: python benchmarks/overheads.py [--sizes 256 512 1024 2048] [--repeats 5] [--write]

Processor seconds of one thread, the least of several interleaved runs, and only ratios of them:
other work on the machine hardly changes them. FFT pairs do not depend on the machine at all.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from surfaces import BODY, LOADS, self_affine
from tables import Table, add_option, made, show

import asperity as asp
from asperity.core.spectral import RealTransform
from asperity.physics.stress.regions import planes
from asperity.physics.stress.survey import StressRequest, WantedSection, survey, survey_depths

SOLVER = asp.solvers.ActiveSet(tolerance=1e-6)
BASE = asp.Elastic(1.0, 0.3)
DX = 10e-9
QUESTIONS = ("call", "pairs", "survey")


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


def in_pairs(n: int, load: float, repeats: int) -> list[str]:
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
    return [f"{call / (0.1 * pair):.0f}", f"{min(shares):.3f}"]


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


def surveyed(n: int, repeats: int) -> list[str]:
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
    return [str(n), str(number), f"{whole:.2f}", f"{whole / transforms:.2f}"]


def tables(given: argparse.Namespace) -> Iterator[Table]:
    """One table for each question that is asked."""
    if "call" in given.only:
        rows = [[n, load, *in_pairs(n, load, given.repeats)] for n in given.sizes for load in LOADS]
        yield made("call", ("n", "load", "in bare pairs", "over its solver"), rows)
    if "pairs" in given.only:
        rows = [[name, f"{ratio:.2f}"] for name, ratio in ratios(512)]
        yield made("pairs-of-bodies", ("512²", "pairs over those of the elastic half-space"), rows)
    if "survey" in given.only:
        columns = ("n", "planes", "s", "over the bare transforms of the planes")
        yield made("survey", columns, [surveyed(512, given.repeats)])


def main() -> None:
    """One table for each question."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512, 1024, 2048])
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--only", nargs="+", choices=QUESTIONS, default=list(QUESTIONS))
    add_option(parser)
    given = parser.parse_args()
    solved(asp.ContactProblem(self_affine(128), BODY), 0.1)  # compiles
    show(*tables(given), write=given.write)


if __name__ == "__main__":
    main()
