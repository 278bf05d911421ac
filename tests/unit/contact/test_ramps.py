"""Courses of loads: turning points, steps, zero is no load; turns of a path."""

from __future__ import annotations

import numpy as np
import pytest
from contact_cases import elastic, rough
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

import asperity as asp


def values(controls):
    return [control.value for control in controls]


def test_positions_go_in_equal_steps():
    course = asp.contact.ramps(asp.Approach, [1.0, 0.5], steps=5)
    np.testing.assert_allclose(values(course), [0.2, 0.4, 0.6, 0.8, 1.0, 0.9, 0.8, 0.7, 0.6, 0.5])
    assert all(isinstance(control, asp.Approach) for control in course)


@pytest.mark.parametrize("kind", [asp.MeanPressure, asp.Force])
def test_loads_grow_with_the_square_from_zero(kind):
    course = asp.contact.ramps(kind, [16.0, 0.0, 16.0, 8.0], steps=4)
    np.testing.assert_allclose(values(course), [1, 4, 9, 16, 9, 4, 1, 0, 1, 4, 9, 16, 14, 12, 10, 8])
    assert course[7] == asp.Unloaded()
    assert sum(isinstance(control, kind) for control in course) == 15


def test_a_leading_zero_says_nothing_new():
    assert asp.contact.ramps(asp.Force, [0.0, 2.0], steps=3) == asp.contact.ramps(asp.Force, [2.0], steps=3)


def test_a_mean_gap_starts_at_its_first_value():
    course = asp.contact.ramps(asp.MeanGap, [3.0, 1.0, 2.0], steps=2)
    assert values(course) == [3.0, 2.0, 1.0, 1.5, 2.0]


@given(st.lists(st.floats(1e-3, 1e3), min_size=1, max_size=5, unique=True), st.integers(1, 7))
def test_every_turning_point_is_met_exactly(points, steps):
    course = values(asp.contact.ramps(asp.MeanPressure, points, steps=steps))
    assert len(course) == steps * len(points)
    assert course[steps - 1 :: steps] == points


@pytest.mark.parametrize(
    ("kind", "points", "subject", "shown"),
    [
        (asp.Force, [], "turning points of a load path", "none"),
        (asp.Force, [0.0], "turning points of a load path", "none"),
        (asp.MeanGap, [], "turning points of a load path", "none"),
        (asp.Force, [1.0, 1.0], "neighbouring turning points of a load path", "[1.0, 1.0]"),
        (asp.Force, [1.0, -1.0], "turning point of a load path (N)", "-1.0"),
        (asp.MeanGap, [1.0, 0.0], "mean gap (m)", "0.0"),
        (asp.Unloaded, [1.0], "kind of a ramp", "Unloaded"),
        ("force", [1.0], "kind of a ramp", "'force'"),
    ],
)
def test_what_cannot_be_run_through(kind, points, subject, shown):
    with refused(asp.InputError, subject, shown):
        asp.contact.ramps(kind, points)


def test_the_turns_of_a_path():
    problem = asp.ContactProblem(rough((12, 10), 1), elastic(1.0), law=asp.Hardness(0.5))
    path = asp.solve(problem, asp.History(asp.contact.ramps(asp.MeanPressure, [0.2, 0.0, 0.3], steps=3)))
    assert path.turns == (2, 5, 8)
    assert asp.solve(problem, asp.History([asp.MeanPressure(0.1)])).turns == (0,)
    assert path.start is None
    np.testing.assert_allclose(path.force, path.mean_pressure * problem.grid.area, rtol=1e-14)
