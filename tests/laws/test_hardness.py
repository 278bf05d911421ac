"""Hardness-limited contact: bounds, permanent indentation, reload, work, errors (Almqvist et al.
2007)."""

import dataclasses

import numpy as np
import pytest
from contact_cases import TIGHT, elastic, rough
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused

import asperity as asp

few = settings(max_examples=20)
BOUNDARIES = st.sampled_from([asp.Periodic(), asp.Free()])


def posed(seed=0, hardness=0.4, boundary=None):
    return asp.ContactProblem(
        rough((20, 16), seed), elastic(1.0), boundary=boundary or asp.Periodic(), law=asp.Hardness(hardness)
    )


@few
@given(st.integers(0, 10**6), BOUNDARIES, st.floats(0.05, 0.35))
def test_reload_to_the_same_load_is_elastic(seed, boundary, load):
    problem = posed(seed, boundary=boundary)
    first = asp.solve(problem, asp.MeanPressure(load), solver=TIGHT)
    again = asp.solve(problem, asp.MeanPressure(load), solver=TIGHT, state=first.state)
    np.testing.assert_allclose(again.pressure, first.pressure, rtol=0, atol=1e-4 * first.max_pressure)
    assert again.plastic_work <= 1e-6 * max(first.plastic_work, first.elastic_energy)
    assert again.approach == pytest.approx(first.approach, rel=1e-5)


@few
@given(st.integers(0, 10**6), BOUNDARIES)
def test_unloading_is_elastic_and_keeps_the_indentation(seed, boundary):
    problem = posed(seed, boundary=boundary)
    loaded = asp.solve(problem, asp.MeanPressure(0.2), solver=TIGHT)
    unloaded = asp.solve(problem, asp.MeanPressure(0.1), solver=TIGHT, state=loaded.state)
    # the pressure falls almost everywhere; where neighbours lose contact it may rise, but a cap
    # holds it
    assert unloaded.plastic_work <= 0.05 * loaded.plastic_work
    assert (unloaded.permanent_indentation >= loaded.permanent_indentation).all()
    virgin = asp.solve(problem, asp.MeanPressure(0.1), solver=TIGHT)
    assert unloaded.approach > virgin.approach


@few
@given(st.integers(0, 10**6), BOUNDARIES)
def test_an_unreached_hardness_is_elastic(seed, boundary):
    elastic_result = asp.solve(
        asp.ContactProblem(rough((20, 16), seed), elastic(1.0), boundary=boundary), asp.MeanPressure(0.1), solver=TIGHT
    )
    capped = asp.solve(posed(seed, 1.001 * elastic_result.max_pressure, boundary), asp.MeanPressure(0.1), solver=TIGHT)
    np.testing.assert_allclose(
        capped.pressure, elastic_result.pressure, rtol=0, atol=1e-4 * elastic_result.max_pressure
    )
    assert capped.plastic_area_fraction == 0.0
    assert capped.plastic_work == 0.0


def test_softer_means_more_area_and_more_indentation():
    results = [asp.solve(posed(3, h), asp.MeanPressure(0.1), solver=TIGHT) for h in (2.0, 0.6, 0.3, 0.15)]
    areas = [r.area_fraction for r in results]
    assert areas == sorted(areas)
    assert areas[-1] > areas[0]
    indentations = [r.max_permanent_indentation for r in results]
    assert indentations == sorted(indentations)


def test_fully_plastic_area_is_load_over_hardness():
    """The rigid-plastic limit: as E*/H grows the real area tends to load over hardness (Bowden &
    Tabor)."""
    problem = asp.ContactProblem(rough((64, 64), 2), elastic(1e4), law=asp.Hardness(1.0))
    result = asp.solve(problem, asp.MeanPressure(0.1), solver=TIGHT)
    assert result.is_plastic
    assert result.mean_real_pressure == pytest.approx(1.0, rel=0.02)
    assert result.area_fraction == pytest.approx(0.1, rel=0.02)


def test_plastic_work_is_hardness_times_volume():
    result = asp.solve(posed(1), asp.MeanPressure(0.2), solver=TIGHT)
    volume = result.permanent_indentation.sum() * result.problem.grid.pixel_area
    assert volume > 0.0
    assert result.plastic_work == pytest.approx(0.4 * volume, rel=1e-12)


def test_two_percent_criterion():
    """Plastic is what yields on more than 2 % of its real area (Greenwood & Williamson 1966)."""
    harsh = asp.solve(posed(1, 0.3), asp.MeanPressure(0.1), solver=TIGHT)
    assert harsh.plastic_area_fraction == np.count_nonzero(harsh.plastic) / np.count_nonzero(harsh.contact)
    assert harsh.is_plastic
    assert dataclasses.replace(harsh, plastic_area_fraction=0.0201).is_plastic
    assert not dataclasses.replace(harsh, plastic_area_fraction=0.0199).is_plastic


def test_hardness_map_limits_each_point():
    cap = np.where(np.arange(20)[:, None] < 10, 0.3, 0.6) * np.ones((20, 16))
    problem = asp.ContactProblem(rough((20, 16), 4), elastic(1.0), law=asp.Hardness(cap))
    result = asp.solve(problem, asp.MeanPressure(0.2), solver=TIGHT)
    assert (result.pressure <= cap).all()
    assert result.pressure[:10].max() == pytest.approx(0.3)
    assert result.pressure[10:].max() > 0.3


def test_load_equal_to_the_hardness_yields_everywhere():
    result = asp.solve(posed(0, 0.4), asp.MeanPressure(0.4))
    np.testing.assert_allclose(result.pressure, 0.4, rtol=1e-12)
    assert result.plastic_area_fraction == 1.0


@pytest.mark.parametrize("control", [asp.MeanPressure(0.41), asp.Force(0.41 * 320)])
def test_load_above_hardness_times_area_has_no_solution(control):
    with refused(asp.errors.NoSolutionError, "mean pressure", "0.4", "0.41"):
        asp.solve(posed(), control)


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf])
def test_hardness_must_be_positive_and_finite(bad):
    with refused(asp.InputError, "hardness (Pa)"):
        asp.Hardness(bad)
