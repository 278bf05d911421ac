"""Contacts of every shape a figure must cope with."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import asperity as asp


def contact(shape: tuple[int, int], *, hardness: float | None = None, dx: float = 2e-8) -> asp.ContactResult:
    noise = np.random.default_rng(7).standard_normal(shape)
    heights = sum(np.roll(noise, (i, j), (0, 1)) for i in range(3) for j in range(3)) * 1e-9
    surface = asp.Surface(heights, dx, 1e-8, periodic=True)
    law = asp.plasticity.HardWall() if hardness is None else asp.Hardness(hardness)
    problem = asp.ContactProblem(surface, asp.Elastic(1e11, 0.3), law=law)
    return asp.solve(problem, asp.MeanPressure(4e8))


def without_contact(result: asp.ContactResult) -> asp.ContactResult:
    none = np.zeros_like(result.pressure)
    return replace(result, pressure=none, gap=result.gap + 1e-9, force=0.0, max_pressure=0.0)


MAKERS = {
    "elastic": lambda: contact((24, 16)),
    "plastic": lambda: contact((24, 16), hardness=3e9),
    "row": lambda: contact((40, 1)),
    "column": lambda: contact((1, 40)),
    "slender": lambda: contact((4, 90)),
    "wide": lambda: contact((60, 16)),
    "point": lambda: asp.solve(
        asp.ContactProblem(asp.Surface([[1e-9]], 1e-8), asp.Elastic(1e11, 0.3), boundary=asp.Free()), asp.Force(1e-9)
    ),
    "full": lambda: asp.solve(
        asp.ContactProblem(asp.Surface(np.zeros((8, 6)), 1e-8, periodic=True), asp.Elastic(1e11, 0.3)),
        asp.MeanPressure(1e6),
    ),
    "none": lambda: without_contact(contact((24, 16))),
    "none in a row": lambda: without_contact(contact((40, 1))),
}


@pytest.fixture(scope="session", params=MAKERS)
def result(request: pytest.FixtureRequest) -> asp.ContactResult:
    return MAKERS[request.param]()


@pytest.fixture(scope="session")
def elastic() -> asp.ContactResult:
    return MAKERS["elastic"]()


@pytest.fixture(scope="session")
def plastic() -> asp.ContactResult:
    return MAKERS["plastic"]()
