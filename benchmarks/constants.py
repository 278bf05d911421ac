"""FFT pairs of the solver for other values of its constants: figures beside them in
``contact/solvers/active_set`` and ``couplings/position``.

Usage: python benchmarks/constants.py [NAME ...]
"""

from __future__ import annotations

import argparse
from collections import Counter, defaultdict
from collections.abc import Iterator
from statistics import mean
from typing import Any

from surfaces import BODY, self_affine

import asperity as asp
from asperity.contact.couplings import position
from asperity.contact.solvers.active_set import bounds, first_guess, linear_system, solver, spline_model
from asperity.contact.solvers.active_set.linear_system import Stopping
from asperity.core.engine import cpu

VALUES: dict[tuple[Any, str], list[Any]] = {
    (bounds, "_PRIOR"): [1.0, 2.0, 8.0, 16.0],
    (bounds, "_SCATTER_SHARE"): [0.0, 0.3, 0.7, 1.0],
    (bounds, "_SCATTER_SHARE_WIDE"): [0.5, 0.0, -0.3, -0.75, -1.0],
    (solver, "_SETTLED"): [0.0, 0.001, 0.01, 0.03],
    (solver, "_REDUCTION"): [0.1, 0.2, 0.5],
    (solver, "_UNSETTLED_STEPS"): [2, 4, 6],
    (solver, "_NEARLY_SETTLED"): [Stopping(x, 8) for x in (0.03, 0.2, 0.3)] + [Stopping(0.1, n) for n in (3, 5, 12)],
    (solver, "_SETTLED_SET"): [Stopping(x, 14) for x in (1e-6, 1e-3, 1e-2)] + [Stopping(1e-4, n) for n in (8, 20, 40)],
    (solver, "_SINGLE"): [0.01, 0.02, 0.06, 0.3],
    (solver, "_CLOSELY"): [0.0, 0.1, 1.0],
    (solver, "_LAST_STEP"): [0.03, 0.15, 0.3],
    (solver, "_LAST_REDUCTION"): [0.02, 0.05],
    (solver, "_MARGIN"): [0.3, 0.5, 1.0],
    (bounds, "LEAST_SHARE"): [0.01, 0.03, 0.3],
    (solver, "_MOST_UNSUCCESSFUL"): [0, 1, 4],
    (solver, "_MOST_REFINEMENTS"): [0, 1, 2, 4],
    (solver, "_CLOSER"): [0.03, 0.3],
    (solver, "_CLOSER_DOUBLINGS"): [1, 3],
    (solver, "_REFRESH"): [1e-3, 1e-4, 1e-7],
    (first_guess, "COARSEST"): [32, 128],
    (first_guess, "COARSE_ITERATIONS"): [3, 10, 100],
    (first_guess, "_HIDDEN_SHARE"): [0.2, 0.5, 2.0],
    (first_guess, "_LOOSEST"): [0.01, 0.03, 0.3],
    (first_guess, "_FINE_STIFFNESS"): [0.0, 0.1, 0.2, 0.3],
    (first_guess, "_FINE_STIFFNESS_RISING"): [0.0, 0.03, 0.1, 0.15],
    (first_guess, "_RISING_FROM"): [1.01, 2.0, 1e9],
    (first_guess, "_NARROWED"): [(1, 1, 1), (2, 2, 2), (1, 3, 3)],
    (first_guess, "_SETTLING_FROM"): [3.0, 1e9],
    (first_guess, "_AREA_PER_LOAD"): [1.4, 2.4, 100.0],
    (linear_system, "_STEP_LENGTH"): [0.8, 0.9, 1.1, 1.2],
    (spline_model, "_STEEP"): [2.0, 1e9],
    (linear_system, "_MODEL_STEPS"): [1, 3, 4],
    (linear_system, "_FIRST_STEPS"): [0, 2],
    (linear_system, "_LAST_LENGTH"): [0.7, 1.0],
    (spline_model, "_FALL"): [0.0, 0.2, 0.5],
    (spline_model, "_BEND"): [0.0, 0.12, 0.4],
    (spline_model, "_STIFF"): [1.1, 3.0, 1e9],
    (spline_model, "_STIFF_MIDDLE"): [2.0, 2.8],
    (spline_model, "_STIFF_FALL"): [-0.3, 0.1],
    (spline_model, "_STIFF_BEND"): [0.4, 1.0],
    (spline_model, "_CORRECTION"): [0.0, 0.5, 1.0],
    (spline_model, "_AHEAD"): [1, 2, 9],
    (spline_model, "_TRUST"): [1e-4, 0.01, 0.05],
    (cpu, "SQUARE_SIDE"): [8, 32, 64],
    (position, "TARGET_ERROR"): [1e-11, 1e-7],
    (position, "_HEIGHT_ERROR"): [0.0, 1e-7],
    (position, "_LARGEST_SHARE"): [1.0, 10.0, 1e4],
    (position, "_SOLVER_SHARE"): [1e-3, 0.1],
    (position, "_FINEST"): [1e-12, 1e-8],
    (position, "_LOOSE"): [1.0, 10.0, 1e5],
    (position, "_PERSSON"): [0.2, 0.3, 0.6, 0.9],
    (position, "_LIGHT"): [0.5, 0.65, 1.0],
    (position, "_AT_FULL"): [0.0, 0.4, 1.2, 2.0],
    (position, "_FARTHEST"): [0.69, 1.39, 3.47],
    (position, "_INSIDE"): [0.0, 0.01, 0.1, 0.3],
    (position, "_CLOSED"): [0.0, 1e-14, 1e-9],
    (position, "_TOWARDS"): [0.0, 0.25, 1.0],
}


FOR_VERY_STIFF_FILMS = (
    "_STEEP",
    "_SETTLING_FROM",
    "_MODEL_STEPS",
    "_MOST_UNSUCCESSFUL",
    "_MOST_REFINEMENTS",
    "_CLOSER",
    "_CLOSER_DOUBLINGS",
)
"""Constants that bear on them alone."""

Case = tuple[str, asp.ContactProblem, Any, asp.solvers.ActiveSet]


def positions() -> Iterator[Case]:
    """Kind, problem, position, and solver."""
    for seed in (1, 2):
        surface = self_affine(128, seed=seed)
        top, rms = float(surface.heights.max() - surface.heights.mean()), float(surface.heights.std())
        film = asp.LiquidFilm(surface_tension=0.01 * rms, thickness=0.3 * rms)
        elastic, hard = asp.ContactProblem(surface, BODY), asp.ContactProblem(surface, BODY, law=asp.Hardness(0.3))
        found = [("periodic", elastic, asp.MeanGap(top * (1.0 - share))) for share in (0.02, 0.3, 0.7, 0.97)]
        found += [("full", elastic, asp.MeanGap(1e-3 * rms)), ("full", elastic, asp.Approach(0.9999 * top))]
        for share in (0.3, 0.8):
            found.append(("cap", hard, asp.MeanGap(top * (1.0 - share))))
            found.append(("wet", asp.ContactProblem(surface, BODY, film=film), asp.Approach(top * share)))
        yield from ((*case, asp.solvers.ActiveSet()) for case in found)


def loads() -> Iterator[Case]:
    """Kind, problem, mean pressure, which is that over E*, and solver."""
    loose, tight = asp.solvers.ActiveSet(tolerance=1e-6), asp.solvers.ActiveSet(tolerance=1e-10)
    monotone = asp.solvers.ActiveSet(tolerance=1e-6, monotone=True)
    for seed in (1, 2):
        large, small = self_affine(512, seed=seed), self_affine(256, seed=seed)
        for load in (0.01, 0.05, 0.2):
            yield "elastic", asp.ContactProblem(large, BODY), asp.MeanPressure(load), loose
        for thickness, load in ((4.0, 0.2), (20.0, 0.4)):
            film = asp.Layered([asp.Layer(asp.Elastic(10.0, 0.3), thickness)], base=asp.Elastic(1.0, 0.3))
            yield "film", asp.ContactProblem(large, film), asp.MeanPressure(load), loose
        for load in (0.02, 0.1):
            yield "free", asp.ContactProblem(small, BODY, boundary=asp.Free()), asp.MeanPressure(load), loose
            yield "cap", asp.ContactProblem(small, BODY, law=asp.Hardness(0.3)), asp.MeanPressure(load), loose
            yield "tight", asp.ContactProblem(small, BODY), asp.MeanPressure(load), tight
            yield "monotone", asp.ContactProblem(small, BODY), asp.MeanPressure(load), monotone


def very_stiff_films() -> Iterator[Case]:
    """Kind, problem, mean pressure and solver, for films on which unclipped steps fail."""
    for seed in (1, 2):
        for n in (128, 256):
            for ratio, thickness in ((300.0, 1.0), (1000.0, 1.0), (1000.0, 2.0)):
                film = asp.Layered([asp.Layer(asp.Elastic(ratio, 0.3), thickness)], base=asp.Elastic(1.0, 0.3))
                problem = asp.ContactProblem(self_affine(n, seed=seed), film)
                for load in (0.3, 0.75):
                    yield "stiff", problem, asp.MeanPressure(load), asp.solvers.ActiveSet(tolerance=1e-6)


def pairs(module: Any, name: str = "") -> str:
    """Mean pairs of each kind of case on which the constant ``name`` of ``module`` bears, as one
    line; those without a solution do not count."""
    cases = very_stiff_films if name in FOR_VERY_STIFF_FILMS else positions if module is position else loads
    for models in (spline_model._fit, spline_model._levels):  # fitted with other constants
        models.cache_clear()
    found, failed = defaultdict(list), Counter[str]()
    for kind, problem, control, method in cases():
        keep = asp.Keep(stiffness=False)
        try:
            result = asp.solve(problem, control, solver=method, keep=keep, engine=asp.engines.CpuEngine(1))
        except asp.ConvergenceError:
            failed[kind] += 1
            continue
        found[kind].append(result.certificate.fft_pairs)
    means = [f"{kind} {mean(values):.1f}" for kind, values in found.items()]
    return ", ".join(means + [f"{number} of {kind} without a solution" for kind, number in failed.items()])


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*", help="constants; all by default")
    names = parser.parse_args().names
    print("loads, as it is:", pairs(solver))
    print("positions, as it is:", pairs(position))
    print("very stiff films, as it is:", pairs(solver, FOR_VERY_STIFF_FILMS[0]))
    for (module, name), values in VALUES.items():
        if names and name not in names:
            continue
        usual = getattr(module, name)
        for value in values:
            setattr(module, name, value)
            print(f"{name} {usual} -> {value}:", pairs(module, name), flush=True)
        setattr(module, name, usual)


if __name__ == "__main__":
    main()
