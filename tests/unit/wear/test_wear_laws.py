"""Laws of wear: depth by dose, stages, thresholds, and sides of a contact."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from asperity.core.errors import InputError
from asperity.wear import Sides, WearLaw, archard, dissipated_energy

COEFFICIENTS = st.floats(1e-17, 1e-12)
THICKNESS = st.floats(1e-9, 1e-5)
DOSES = st.lists(st.floats(0.0, 1e9), min_size=1, max_size=20)


@given(COEFFICIENTS, st.lists(st.tuples(THICKNESS, COEFFICIENTS), max_size=3), DOSES)
def test_the_depth_is_the_integral_of_its_slope(
    base: float, layers: list[tuple[float, float]], doses: list[float]
) -> None:
    """Exactly: the depth is piecewise linear, so that trapezia between the places where the slope
    changes give it; it never falls, and is the inverse of the dose at a depth."""
    law = archard(base, layers=layers)
    dose = np.sort(np.array(doses))
    knots = np.cumsum([thickness / k for thickness, k in layers])
    for at, depth in zip(dose, law.depth(dose), strict=True):
        ends = np.array([0.0, *knots[knots < at], at])
        middles = law.slope(0.5 * (ends[1:] + ends[:-1]))
        assert depth == pytest.approx(float(middles @ np.diff(ends)), rel=1e-9, abs=1e-300)
        if depth > 1e-30:
            assert law.dose_at(float(depth)) == pytest.approx(at, rel=1e-9)
    assert np.all(np.diff(law.depth(dose)) >= 0.0)


def test_a_coating_is_worn_through_where_its_dose_is() -> None:
    law = archard(1e-14, layers=[(1e-6, 1e-15)])
    assert law.depth(np.array([1e9])) == pytest.approx([1e-6])
    assert law.depth(np.array([1.5e9])) == pytest.approx([1e-6 + 0.5e9 * 1e-14])
    assert law.stage(np.array([0.9e9, 1.1e9])).tolist() == [0, 1]
    assert (law.thickness, law.dose_of_layers) == pytest.approx((1e-6, 1e9))


def test_energy_below_the_threshold_wears_nothing() -> None:
    """V = alpha (E - E_th), with E = mu P s."""
    law = dissipated_energy(2e-14, 0.5, threshold=1e3)
    dose = np.array([1e3, 2e3, 4e3])
    assert law.depth(dose) == pytest.approx([0.0, 0.0, 2e-14 * (0.5 * 4e3 - 1e3)])
    assert law.slope(dose[-1:]) == pytest.approx([0.5 * 2e-14])
    assert archard(1e-14).depth(dose) == pytest.approx(dissipated_energy(2e-14, 0.5).depth(dose))


def test_a_map_of_factors_multiplies_coefficients() -> None:
    factor = np.array([[1.0, 2.0], [0.5, 1.0]])
    law = archard(1e-15, factor=factor)
    assert law.depth(np.full((2, 2), 1e9)) == pytest.approx(1e-6 * factor)
    with refused(InputError, "factor on the wear coefficient"):
        law.dose_at(1e-6)


@pytest.mark.parametrize(
    ("make", "subject"),
    [
        (lambda: archard(-1.0), "wear coefficient (m²/N)"),
        (lambda: archard(1e-15, layers=[(0.0, 1e-15)]), "thickness of a layer that wears (m)"),
        (lambda: archard(1e-15, factor=0.0), "factor on a wear coefficient"),
        (lambda: archard(1e-15, threshold_pressure=-1.0), "pressure from which on a body wears (Pa)"),
        (lambda: WearLaw(((1e-6, 1e-15),)), "stages of a law of wear"),
        (lambda: dissipated_energy(1e-14, 0.0), "friction coefficient of a law of wear by energy"),
        (lambda: dissipated_energy(1e-14, 0.5, threshold=-1.0), "energy per area from which on a body wears (J/m²)"),
        (lambda: Sides(), "sides of a contact that wears"),
        (lambda: Sides(body=archard(1e-15), body_track=0.0), "length of the track of the body (m)"),
        (lambda: Sides(body=archard(1e-15), counter_track=1.0), "counter that is a track"),
        (
            lambda: Sides(archard(1e-15), archard(1e-15), body_track=1.0, counter_track=1.0),
            "one body at most can be a track, but both are. A point of one of them",
        ),
    ],
)
def test_what_is_no_law_is_refused(make: object, subject: str) -> None:
    with pytest.raises(InputError) as caught:
        make()  # type: ignore[operator]
    assert str(caught.value).startswith(subject)


def test_without_an_end_the_base_may_not_wear() -> None:
    law = archard(0.0, layers=[(1e-6, 1e-15)])
    assert law.depth(np.array([1e12])) == pytest.approx([1e-6])
    assert law.dose_at(2e-6) == math.inf
