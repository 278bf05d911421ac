"""Solved problems that files must carry whole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import asperity as asp
from asperity.surfaces.surface import Origin


def rough(shape: tuple[int, int], seed: int, dtype: type = np.float64, periodic: bool = True) -> asp.Surface:
    noise = np.random.default_rng(seed).standard_normal(shape)
    smooth = sum(np.roll(noise, (i, j), (0, 1)) for i in range(3) for j in range(3)) * 1e-9
    history = ("levelled by a plane", "cropped")
    origin = Origin("disk <1> & ü.x3p", "height", {"model": 'NV "7300"'}, history, ("Roettger2022",))
    return asp.Surface(np.asarray(smooth).astype(dtype), 1.1e-8, 0.7e-8, periodic=periodic, origin=origin)


def make(kind: str) -> asp.ContactResult:
    """One of the results in ``KINDS``; shapes differ in x and y so that a transposition cannot
    hide."""
    steel = asp.Elastic(2.1e11, 0.29, asp.Strength(hardness=6e9), name="steel", sources=("E: handbook", "nu: guess"))
    if kind == "elastic":
        return asp.solve(asp.ContactProblem(rough((18, 12), 1), asp.Elastic(1e11, 0.3)), asp.MeanPressure(2e8))
    if kind == "plastic":
        law = asp.Hardness(np.random.default_rng(2).uniform(2e9, 5e9, (18, 12)))
        problem = asp.ContactProblem(rough((18, 12), 2), steel, rough((18, 12), 3), asp.Elastic(7e10, 0.2), law=law)
        return asp.solve(problem, asp.Force(2e-5))
    if kind == "free":
        problem = asp.ContactProblem(
            rough((9, 14), 4, np.float32, periodic=False), steel, boundary=asp.Free(), law=asp.Hardness(4e9)
        )
        return asp.solve(problem, asp.Approach(3e-9), keep=asp.Keep(stiffness=False))
    if kind == "not converged":
        from asperity.solvers import ConjugateGradient

        problem = asp.ContactProblem(rough((16, 16), 5), asp.Elastic(1e11, 0.3))
        solver = ConjugateGradient(max_iterations=2)
        return asp.solve(problem, asp.MeanPressure(2e8), solver=solver, on_failure="return")
    assert kind == "line"
    problem = asp.ContactProblem(rough((1, 33), 6), asp.Elastic(1e11, 0.3))
    return replace(asp.solve(problem, asp.MeanPressure(2e8)), control=asp.MeanGap(1e-9))


KINDS = ("elastic", "plastic", "free", "not converged", "line")


@pytest.fixture(scope="session", params=KINDS)
def result(request: pytest.FixtureRequest) -> asp.ContactResult:
    return make(request.param)


@pytest.fixture(scope="session")
def plastic() -> asp.ContactResult:
    return make("plastic")


@pytest.fixture(scope="session")
def elastic() -> asp.ContactResult:
    return make("elastic")
