"""Guidance for the least real area without plasticity against the numbers of its source."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from asperity.core.errors import InputError
from asperity.theories.hardness.plasticity import LeastArea


def test_the_numbers_of_the_source():
    """A_r/A_a = 5.3 p_a/H at ψ = 0.6 (Bhushan 1998, sec. 3.2.3)."""
    design = LeastArea(hardness=6e9)
    assert design.area_fraction(1e6) == pytest.approx(5.3 * 1e6 / 6e9, rel=0.01)  # printed with two digits
    assert design.area_fraction(1e6) > design.plastic_area_fraction(1e6) == pytest.approx(1e6 / 6e9)


@given(hardness=st.floats(1e8, 5e10), modulus=st.floats(1e9, 1e12), index=st.floats(0.2, 1.0))
def test_roughness_and_modulus_belong_together(hardness, modulus, index):
    design = LeastArea(hardness, index)
    ratio = design.summit_ratio(modulus)
    assert modulus / hardness * ratio**0.5 == pytest.approx(index, rel=1e-12)
    assert design.contact_modulus(ratio) == pytest.approx(modulus, rel=1e-12)
    # the area of the elastic working formula for that very surface
    assert design.area_fraction(1e5) == pytest.approx(3.2 * 1e5 / (modulus * ratio**0.5), rel=1e-12)
    assert modulus / hardness * design.profile_ratio(modulus) == pytest.approx(0.25, rel=1e-12)


@given(index=st.floats(0.2, 1.0))
def test_what_must_be_more_elastic_has_more_area(index):
    careful, usual = LeastArea(1e9, 0.5 * index), LeastArea(1e9, index)
    assert careful.area_fraction(1e5) > usual.area_fraction(1e5)
    assert careful.summit_ratio(1e11) < usual.summit_ratio(1e11)


def test_what_is_not_positive_is_refused():
    with refused(InputError, "hardness (Pa) of least-area"):
        LeastArea(0.0)
    with refused(InputError, "contact modulus E* (Pa)"):
        LeastArea(1e9).summit_ratio(-1.0)
