"""Limits found together with the pressure against rounds of contacts at given limits, which share
no step of the method."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from contact_cases import rough

import asperity as asp
from asperity.physics.hardness import coupling as hardness
from asperity.physics.hardness import solver as yielding
from asperity.physics.hardness.solver import Followed
from asperity.solvers import ActiveSet

LIMIT_TOLERANCE = 1e-5
BOUNDARIES = pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)


def hard_film(thickness: float, film: float = 0.6, base: float = 0.3) -> asp.Layered:
    """Film harder than its base, both of unit contact modulus."""
    upper, lower = (asp.Elastic(0.91, 0.3, asp.Strength(hardness=h)) for h in (film, base))
    return asp.Layered([asp.Layer(upper, thickness)], lower)


def posed(body: asp.Layered, n: int, seed: int, boundary=asp.Periodic()) -> asp.ContactProblem:
    """Rough surface of unit spacing and rms slope along x."""
    heights = rough((n, n), seed, power=2.3).heights
    slope = np.diff(heights, axis=0).std()
    surface = asp.Surface(heights / slope, 1.0, periodic=isinstance(boundary, asp.Periodic))
    return asp.ContactProblem(surface, body, boundary=boundary, law=asp.plasticity.LayeredHardness(body))


def in_rounds(monkeypatch, problem: asp.ContactProblem, control, tolerance: float) -> asp.ContactResult:
    """The same without the joint method."""
    with monkeypatch.context() as patch:
        patch.setattr(hardness, "follow", lambda *_: Followed())
        return asp.solve(problem, control, solver=ActiveSet(tolerance=tolerance))


@BOUNDARIES
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_pressures_are_those_of_rounds(monkeypatch, boundary, seed):
    """Limits agree to 1e-5 with their depths in both; a limit that falls by s c < 0.3 of what a
    point sinks doubles that at most."""
    problem, load = posed(hard_film(8.0), 96, seed, boundary), asp.MeanPressure(0.05)
    found = asp.solve(problem, load, solver=ActiveSet(tolerance=1e-10))
    other = in_rounds(monkeypatch, problem, load, 1e-10)
    assert found.plastic.sum() > 50
    assert found.certificate.rounds == 1 < other.certificate.rounds
    np.testing.assert_allclose(found.pressure, other.pressure, rtol=0.0, atol=10.0 * LIMIT_TOLERANCE * 0.6)
    assert found.plastic_work == pytest.approx(other.plastic_work, rel=20.0 * LIMIT_TOLERANCE)
    limit = problem.law.cap_at(found.permanent_indentation)
    assert (found.pressure <= limit * (1.0 + 1.01 * LIMIT_TOLERANCE)).all()
    np.testing.assert_allclose(found.pressure[found.plastic], limit[found.plastic], rtol=1.01 * LIMIT_TOLERANCE)


def test_a_prescribed_approach():
    """Held by the solver itself on a free boundary: the force is that which gives this approach."""
    problem, solver = posed(hard_film(8.0), 96, 1, asp.Free()), ActiveSet(tolerance=1e-10)
    aim = asp.solve(problem, asp.MeanPressure(0.05), solver=solver)
    found = asp.solve(problem, asp.Approach(aim.approach), solver=solver)
    assert found.certificate.rounds == 1
    assert found.mean_pressure == pytest.approx(0.05, rel=1e-4)
    np.testing.assert_allclose(found.pressure, aim.pressure, rtol=0.0, atol=20.0 * LIMIT_TOLERANCE * 0.6)


def test_later_loads_of_a_path(monkeypatch):
    """An indented surface, unloaded and loaded further, by both methods."""
    problem = posed(hard_film(8.0), 96, 2)
    path = asp.History([asp.MeanPressure(load) for load in (0.03, 0.01, 0.05)])
    found = asp.solve(problem, path, solver=ActiveSet(tolerance=1e-10)).steps
    other = in_rounds(monkeypatch, problem, path, 1e-10).steps
    for one, two in zip(found, other, strict=True):
        np.testing.assert_allclose(one.pressure, two.pressure, rtol=0.0, atol=20.0 * LIMIT_TOLERANCE * 0.6)
        assert one.permanent_indentation == pytest.approx(two.permanent_indentation, abs=1e-4)


def test_a_stiff_film_and_odd_sizes(monkeypatch):
    """A film five times as stiff as the base, on a grid that does not halve evenly."""
    upper, lower = (
        asp.Elastic(4.55, 0.3, asp.Strength(hardness=0.6)),
        asp.Elastic(0.91, 0.3, asp.Strength(hardness=0.4)),
    )
    problem = posed(asp.Layered([asp.Layer(upper, 8.0)], lower), 135, 4)
    found = asp.solve(problem, asp.MeanPressure(0.05), solver=ActiveSet(tolerance=1e-10))
    other = in_rounds(monkeypatch, problem, asp.MeanPressure(0.05), 1e-10)
    assert found.plastic.any()
    np.testing.assert_allclose(found.pressure, other.pressure, rtol=0.0, atol=20.0 * LIMIT_TOLERANCE * 0.6)


def test_pairs_of_transforms():
    """As many as for the elastic contact, in which the same part of the work is on coarser grids,
    in the mean of some surfaces, since each takes whole pairs; rounds took six times as many."""
    body, solver, pairs = hard_film(8.0), ActiveSet(tolerance=1e-6), []
    for seed in (1, 2, 3):
        problem = posed(body, 256, seed)
        found = asp.solve(problem, asp.MeanPressure(0.05), solver=solver)
        elastic = asp.solve(replace(problem, law=asp.plasticity.HardWall()), asp.MeanPressure(0.05), solver=solver)
        assert found.plastic.any()
        pairs.append((found.certificate.fft_pairs, elastic.certificate.fft_pairs))
    layered, plain = np.mean(pairs, axis=0)
    assert layered <= 1.2 * plain


@pytest.mark.parametrize("seed", [2, 3])
def test_a_film_thinner_than_the_points_of_coarser_grids(monkeypatch, seed):
    """Limits fall gently on the fine grid and steeply on the coarser ones, where points may rest at
    several depths: what a few steps there give is enough."""
    problem, load, coarse = posed(hard_film(2.0, base=0.2), 128, seed), asp.MeanPressure(0.02), []
    found_on = yielding._Iteration.found

    def watched(iteration, pairs, progress):
        followed = found_on(iteration, pairs, progress)
        coarse.append((progress is None, followed.iterations))
        return followed

    with monkeypatch.context() as patch:
        patch.setattr(yielding._Iteration, "found", watched)
        patch.setattr(yielding, "_MOST_COARSE", 3)
        found = asp.solve(problem, load, solver=ActiveSet(tolerance=1e-10))
    assert (True, 3) in coarse
    other = in_rounds(monkeypatch, problem, load, 1e-10)
    assert found.plastic.any()
    assert found.certificate.rounds == 1 < other.certificate.rounds
    np.testing.assert_allclose(found.pressure, other.pressure, rtol=0.0, atol=20.0 * LIMIT_TOLERANCE * 0.6)


def test_what_is_not_found_is_left_to_rounds(monkeypatch):
    """Where the joint method gives up the answer is that of rounds, to the bit, and its transforms
    count as well."""
    problem, load = posed(hard_film(8.0), 96, 1), asp.MeanPressure(0.05)
    other = in_rounds(monkeypatch, problem, load, 1e-8)
    monkeypatch.setattr(yielding, "_MOST_STEPS", 1)
    found = asp.solve(problem, load, solver=ActiveSet(tolerance=1e-8))
    np.testing.assert_array_equal(found.pressure, other.pressure)
    assert found.certificate.fft_pairs > other.certificate.fft_pairs + 2.0


@pytest.mark.parametrize("load", [0.31, 0.62])
def test_a_load_that_the_base_does_not_bear(monkeypatch, load):
    """No limits may be borne once all have fallen: then nothing is foreseen."""
    problem = posed(hard_film(8.0), 48, 1)
    outcomes = []
    for foreseen in (True, False):
        with monkeypatch.context() as patch:
            if not foreseen:
                patch.setattr(hardness, "follow", lambda *_: Followed())
            try:
                outcomes.append(asp.solve(problem, asp.MeanPressure(load)).max_permanent_indentation)
            except asp.errors.NoSolutionError as error:
                outcomes.append(str(error))
    assert outcomes[0] == outcomes[1]
