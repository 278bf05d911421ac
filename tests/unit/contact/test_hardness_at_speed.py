"""Islands of a contact with the hardness of their strain rate."""

from __future__ import annotations

import math

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.contact.measure import labelled
from asperity.plasticity import solve_at_speed
from asperity.theories import RateHardness


@pytest.fixture(scope="module")
def problem() -> asp.ContactProblem:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.2), hurst=0.8, rolloff_wavelength=6e-7, shortest_wavelength=2e-7
    )
    surface = asp.generate.gaussian(asp.Grid((64, 64), (2e-8, 2e-8)), spectrum, seed=1)
    return asp.ContactProblem(surface, asp.Elastic(210e9, 0.3))


LAW = RateHardness(3e9, "johnson-cook", 0.014, 1.0)


def test_islands_have_the_hardness_of_their_size(problem):
    found = solve_at_speed(problem, asp.MeanPressure(1e8), LAW, 1.0)
    result = found.result
    assert result.mean_pressure == pytest.approx(1e8)
    labels, count = labelled(result.contact, wraps=(True, True))
    assert count == found.diameter.size > 3
    pixel = problem.grid.pixel_area
    for island in range(1, count + 1):
        here = labels == island
        diameter = 2.0 * math.sqrt(np.count_nonzero(here) * pixel / math.pi)
        expected = float(LAW.at_diameter(1.0, diameter))
        # rounds end at a change of a thousandth
        assert found.hardness[here] == pytest.approx(expected, rel=1e-3)
        assert result.pressure[here].max() <= expected * (1.0 + 2e-3)
    smallest, largest = np.argmin(found.diameter), np.argmax(found.diameter)
    assert found.island_hardness[smallest] > found.island_hardness[largest] > LAW.hardness


def test_slow_contacts_have_the_hardness_of_slow_loads(problem):
    slow = solve_at_speed(problem, asp.MeanPressure(1e8), LAW, 1e-9)
    plain = asp.solve(asp.ContactProblem(problem.surface, problem.body, law=asp.Hardness(3e9)), asp.MeanPressure(1e8))
    assert slow.rounds == 1
    assert slow.result.area_fraction == plain.area_fraction
    fast = solve_at_speed(problem, asp.MeanPressure(1e8), LAW, 10.0)
    assert fast.result.area_fraction < slow.result.area_fraction


def test_a_speed_must_be_positive(problem):
    with refused(asp.InputError, "sliding speed (m/s)", "0"):
        solve_at_speed(problem, asp.MeanPressure(1e8), LAW, 0.0)
