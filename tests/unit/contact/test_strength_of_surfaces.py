"""What the surfaces of a contact bear: the hardness, else 2.8 times the yield stress, and how that
is known."""

from __future__ import annotations

import pytest

import asperity as asp
from asperity.solids.layers import SurfaceStrength, strength_of


def strengths(body: object, counter: object | None = None) -> tuple[SurfaceStrength, ...]:
    counter = asp.Rigid() if counter is None else counter
    return strength_of(body, counter)  # type: ignore[arg-type]


def test_hardness_comes_before_the_yield_stress() -> None:
    solid = asp.Elastic(200e9, 0.3, asp.Strength(hardness=2e9, yield_stress=400e6), name="steel A")
    assert strengths(solid) == (SurfaceStrength("body", "steel A", 2e9, "H of steel A"),)


def test_yield_stress_serves_where_no_hardness_is_known() -> None:
    solid = asp.Elastic(200e9, 0.3, asp.Strength(yield_stress=400e6), name="steel A")
    (found,) = strengths(solid)
    assert (found.pressure, found.known_as) == (pytest.approx(2.8 * 400e6), "2.8 Y of steel A")


def test_the_unknown_is_said() -> None:
    first, second = strengths(asp.Elastic(200e9, 0.3), asp.Elastic(70e9, 0.3, asp.Strength(hardness=1e9)))
    assert first == SurfaceStrength("body", "the body", None, "")
    assert second == SurfaceStrength("counter_body", "the counter body", 1e9, "H of the counter body")


def test_what_never_yields_is_left_out() -> None:
    rubber = asp.Elastic(2e6, 0.499, name="rubber")
    assert strengths(rubber) == ()
    assert len(strengths(asp.Elastic(2e6, 0.499, asp.Strength(yield_stress=1e6)))) == 1


def test_of_a_coated_body_the_top_layer_counts() -> None:
    coated = asp.Layered([asp.Layer(asp.material("DLC"), 5e-9)], asp.material("steel"))
    (found,) = strengths(coated)
    assert (found.pressure, found.known_as) == (15e9, "H of DLC")
