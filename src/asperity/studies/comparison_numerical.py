"""The boundary-element solution of a comparison: one load path, of which a few numbers a load are kept."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass

import numpy as np

from ..contact.advice import advise, review
from ..contact.problem import ContactProblem, MeanPressure
from ..contact.result import ContactResult
from ..contact.solve import default_solver, steps
from ..contact.solvers.protocol import Solver
from ..core.arrays import RealArray
from ..core.engine import Engine
from ..core.errors import NoSolutionError
from ..core.status import Advice, Progress
from .comparison import NumericalCurve


@dataclass(frozen=True, eq=False)
class Solved:
    """The ``curve``, the ``findings`` at the lowest and highest load, the mean radius in m of the spots at the highest."""

    curve: NumericalCurve
    findings: tuple[Advice, ...]
    mean_radius: float


def solved(
    problem: ContactProblem,
    pressures: RealArray,
    *,
    solver: Solver | None = None,
    progress: Progress | None = None,
    engine: Engine | None = None,
) -> Solved:
    """Solution of ``problem`` at rising ``pressures`` (n,) in Pa, each from the interface the last one left.

    Loads that do not converge, or that the law cannot bear, are NaN and noted.
    """
    method = solver or default_solver(problem)
    columns = np.full((4, pressures.size), np.nan)
    faults: list[str] = []
    findings: dict[str, Advice] = {}
    last: ContactResult | None = None
    started = time.perf_counter()
    controls = map(MeanPressure, pressures)
    path = steps(problem, controls, solver=method, progress=progress, engine=engine, on_failure="return")
    try:
        for number, result in enumerate(path):
            if not result.converged:
                faults.append(f"At {pressures[number]:.4g} Pa: {result.status.message}")
                continue
            columns[:, number], last = _numbers(result), result
            findings |= _checks(result) if number in (0, pressures.size - 1) else {}
    except NoSolutionError as error:
        faults.append(str(error))
    seconds, keys = time.perf_counter() - started, problem.citation_keys if last is None else last.citation_keys
    radius = math.sqrt(last.mean_spot_area / math.pi) if last is not None and last.n_spots else math.nan
    pixels, area, spots, gap = columns
    curve = NumericalCurve(pixels, area, spots, gap, seconds, method.name, tuple(faults), keys)
    return Solved(curve, tuple(findings.values()), radius)


def _numbers(result: ContactResult) -> tuple[float, ...]:
    """Area by pixels and corrected, spots per nominal area in 1/m², mean gap in m."""
    nominal = math.prod(result.problem.grid.size)
    return result.area_fraction, result.area_fraction_corrected, result.n_spots / nominal, result.mean_gap


def _checks(result: ContactResult) -> dict[str, Advice]:
    """Findings before and after the solve by their criterion."""
    found = (*advise(result.problem, result.control), *review(result))
    return {item.criterion: item for item in found}
