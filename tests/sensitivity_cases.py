"""Contacts whose derivatives are tested, and their solutions on a frozen set by dense matrices."""

from __future__ import annotations

from functools import cache

import numpy as np

import asperity as asp
from asperity.contact.boundary import Free, FreeLine, Periodic
from asperity.contact.operators import prepare_operator
from asperity.contact.problem import ContactProblem
from asperity.contact.result import ContactResult
from asperity.core.arrays import RealArray
from asperity.physics.sensitivities.outputs import Output, State
from asperity.solvers import ActiveSet

MPA, NM = 1e6, 1e-9
COATED = asp.Layered(
    [asp.Layer(asp.Elastic(300e9, 0.2), 60 * NM), asp.Layer(asp.Elastic(40e9, 0.35), 150 * NM)], asp.Elastic(110e9, 0.3)
)


def rough(shape: tuple[int, int], seed: int = 3) -> RealArray:
    """Smooth random heights (nx, ny) of rms 20 nm that repeat."""
    noise = np.fft.fft2(np.random.default_rng(seed).standard_normal(shape))
    q2 = np.add.outer(np.fft.fftfreq(shape[0]) ** 2 * shape[0] ** 2, np.fft.fftfreq(shape[1]) ** 2 * shape[1] ** 2)
    heights = np.fft.ifft2(noise * np.exp(-q2 / 18.0)).real
    return np.asarray(20 * NM * heights / heights.std())


def problem_of(boundary: object, law: object = None, body: object = COATED) -> ContactProblem:
    """Rough contact on 20 x 16 points, of one line on a line boundary."""
    shape = (48, 1) if isinstance(boundary, FreeLine) else (20, 16)
    surface = asp.Surface(rough(shape), 50 * NM)
    law = {} if law is None else {"law": law}
    return ContactProblem(surface, body, counter_body=asp.Elastic(200e9, 0.28), boundary=boundary, **law)  # type: ignore[arg-type]


@cache
def solved(boundary: object, capped: bool = False, control: object = asp.MeanPressure(400 * MPA)) -> ContactResult:
    """Contact solved to where its pressure is that of its set."""
    law = asp.Hardness(2.2e9) if capped else None
    return asp.solve(problem_of(boundary, law), control, solver=ActiveSet(tolerance=1e-10))  # type: ignore[arg-type]


def frozen(result: ContactResult, problem: ContactProblem, total: float | None, offset: float) -> State:
    """Contact of ``problem`` on the set of ``result`` by its dense matrix; at the position
    ``offset`` where no sum of pressures is given."""
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    K, h = operator.matrix(), problem.profile().ravel()
    capped = result.plastic.ravel()
    free = result.contact.ravel() & ~capped
    p = np.where(capped, problem.law.pressure_cap(), 0.0) if capped.any() else np.zeros(h.size)
    right = (h - K @ p)[free]
    if total is None:
        p[free] = np.linalg.solve(K[np.ix_(free, free)], right - offset)
    else:
        n, unit = int(free.sum()), np.abs(K).max()
        matrix = np.block([[K[np.ix_(free, free)], np.full((n, 1), unit)], [np.full((1, n), unit), np.zeros((1, 1))]])
        found = np.linalg.solve(matrix, np.append(right, unit * (total - p.sum())))
        p[free], offset = found[:-1], unit * float(found[-1])
    field, shape = p.reshape(h.size), problem.grid.shape
    return State(
        problem,
        operator,
        field.reshape(shape),
        (K @ field).reshape(shape),
        h.reshape(shape),
        offset,
        free.reshape(shape),
        capped.reshape(shape),
    )


def frozen_value(result: ContactResult, problem: ContactProblem, of: Output, held: str, scale: float = 1.0) -> float:
    """Output of ``problem`` on the set of ``result``, load or approach multiplied by ``scale``."""
    if held == "load":
        return of.at(frozen(result, problem, scale * result.mean_pressure * problem.grid.n_points, 0.0)).value
    top = float(problem.profile().max())
    return of.at(frozen(result, problem, None, top - scale * result.approach)).value


CASES = {
    "periodic": (Periodic(), False, asp.MeanPressure(400 * MPA)),
    "free": (Free(), False, asp.MeanPressure(400 * MPA)),
    "line": (FreeLine(), False, asp.MeanPressure(400 * MPA)),
    "hardness": (Periodic(), True, asp.MeanPressure(400 * MPA)),
    "free at an approach": (Free(), False, asp.Approach(38 * NM)),
    "hardness at an approach": (Periodic(), True, asp.Approach(38 * NM)),
}
