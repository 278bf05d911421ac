"""Positions beyond full yield, and between plateaus: where a hardness bounds the pressure, every
approach has an answer."""

import numpy as np
import pytest
from refusals import refused

import asperity as asp

BODY = asp.Elastic(5e9, 0.3)
HARDNESS = 1e8


def posed(heights: np.ndarray, law: asp.Hardness = asp.Hardness(HARDNESS)) -> asp.ContactProblem:
    return asp.ContactProblem(asp.Surface(heights, 1e-6, periodic=True), BODY, law=law)


@pytest.mark.parametrize("approach", [1e-12, 1e-9, 1e-7])
def test_flat_bodies_yield_as_a_whole(approach: float) -> None:
    """Without strain to speak of: the search for a load went on for ever."""
    result = asp.solve(posed(np.full((14, 14), 1e-7)), asp.Approach(approach))
    np.testing.assert_allclose(result.pressure, HARDNESS, rtol=1e-9)
    np.testing.assert_allclose(result.permanent_indentation, approach, rtol=1e-6)
    assert result.approach == pytest.approx(approach, rel=1e-9)


@pytest.mark.parametrize("beyond", [1.001, 1.5, 5.0])
def test_beyond_full_yield_the_indentation_takes_the_rest(beyond: float) -> None:
    heights = 1e-7 * np.random.default_rng(1).standard_normal((12, 10))
    result = asp.solve(posed(heights), asp.Approach(beyond * np.ptp(heights)))
    np.testing.assert_allclose(result.pressure, HARDNESS, rtol=1e-9)
    depth = heights - heights.max() + beyond * np.ptp(heights)
    np.testing.assert_allclose(result.permanent_indentation, depth, rtol=1e-6, atol=1e-9 * np.ptp(heights))


@pytest.mark.parametrize("share", [0.3, 0.9])
def test_a_plateau_that_yields_sinks_at_one_load(share: float) -> None:
    """Half of the points at the hardness, half free of load, wherever between first yield and first
    touch the approach is."""
    heights = np.zeros((8, 8))
    heights[:4] = 1e-5
    result = asp.solve(posed(heights), asp.Approach(share * 1e-5))
    np.testing.assert_allclose(result.pressure, np.where(heights > 0.0, HARDNESS, 0.0), atol=1e-6 * HARDNESS)
    assert result.approach == pytest.approx(share * 1e-5, rel=1e-6)


@pytest.mark.parametrize("share", [0.1, 0.4])
def test_so_it_does_at_a_mean_gap(share: float) -> None:
    heights = np.zeros((8, 8))
    heights[:4] = 1e-5
    result = asp.solve(posed(heights), asp.MeanGap(share * 1e-5))
    np.testing.assert_allclose(result.pressure, np.where(heights > 0.0, HARDNESS, 0.0), atol=1e-6 * HARDNESS)
    assert result.mean_gap == pytest.approx(share * 1e-5, rel=1e-6)
    assert result.control == asp.MeanGap(share * 1e-5)


@pytest.mark.parametrize("control", [asp.Approach(1e-9), asp.MeanGap(1e-9)], ids=lambda c: c.name)
def test_a_position_of_flat_elastic_bodies_is_refused_in_plain_words(control: asp.Approach | asp.MeanGap) -> None:
    problem = asp.ContactProblem(asp.Surface(np.full((14, 14), 1e-7), 1e-6, periodic=True), BODY)
    with refused(asp.errors.NoSolutionError, f"{control.name} of flat bodies", "1e-09"):
        asp.solve(problem, control)
