"""Effective hardness of a coated solid against independently computed rows, and its limits."""

from __future__ import annotations

import doctest

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.theories.hardness import effective_hardness
from asperity.theories.hardness.effective_hardness import EffectiveHardness

ratios = st.floats(0.02, 50.0)
depths = st.floats(0.0, 20.0)


@every_row(reference("effective_hardness"))
def test_rows(row):
    law = EffectiveHardness(
        row["H_layer_GPa"] * 1e9,
        row["H_substrate_GPa"] * 1e9,
        row["E_layer_GPa"] / row["E_substrate_GPa"],
        row["Y_layer_GPa"] / row["Y_substrate_GPa"],
    )
    # 15 digits are given
    assert float(law.at(row["hc_over_h"])) == pytest.approx(row["He_GPa"] * 1e9, rel=1e-13)
    assert float(law.at(row["hc_over_h"])) / law.substrate == pytest.approx(row["He_over_Hs"], rel=1e-13)


def test_rows_of_known_yield_strength_are_near_those_of_tabor():
    """The yield strengths of the rows are hardnesses over 2.8, rounded to four digits for 5.357 and
    3.214 GPa."""
    law = EffectiveHardness(15e9, 9e9, 140 / 190)
    row = next(r for r in reference("effective_hardness") if r["H_layer_GPa"] == 15 and r["hc_over_h"] == 0.3)
    assert float(law.at(0.3)) == pytest.approx(row["He_GPa"] * 1e9, rel=1e-4)


@given(ratios, ratios, st.none() | ratios, depths, depths)
def test_falls_from_film_to_substrate(hardness_ratio, modulus_ratio, yield_ratio, first, second):
    law = EffectiveHardness(hardness_ratio, 1.0, modulus_ratio, yield_ratio)
    assert float(law.at(0.0)) == pytest.approx(hardness_ratio, rel=1e-14)
    assert float(law.at(1e9)) == 1.0
    shallow, deep = law.coating_share(sorted((first, second)))
    assert 1.0 >= shallow >= deep >= 0.0


@given(ratios, depths)
def test_equal_hardness_is_that_hardness(modulus_ratio, depth):
    assert float(EffectiveHardness(3.0, 3.0, modulus_ratio).at(depth)) == 3.0


def test_without_yield_strengths_the_exponents_are_those_of_hardness():
    """Y = H/2.8: (H1/H2)/(E1/E2) (h_c/h)² for soft films, (E1/E2)^-1/2 h_c/h for hard ones (Peng
    2001, app. C)."""
    assert float(EffectiveHardness(0.5, 1.0, 2.0).coating_share(1.5)) == pytest.approx(np.exp(-0.25 * 2.25), rel=1e-14)
    assert float(EffectiveHardness(4.0, 1.0, 2.0).coating_share(1.5)) == pytest.approx(np.exp(-1.5 / 2**0.5), rel=1e-14)


def test_the_example_runs():
    found = doctest.testmod(effective_hardness)
    assert found.attempted == 2
    assert found.failed == 0


@pytest.mark.parametrize(
    ("values", "subject"),
    [
        ((0.0, 1.0, 1.0), "coating (Pa) of effective-hardness"),
        ((1.0, -1.0, 1.0), "substrate (Pa) of effective-hardness"),
        ((1.0, 1.0, 0.0), "modulus_ratio of effective-hardness"),
        ((1.0, 1.0, 1.0, 0.0), "yield_ratio of effective-hardness"),
    ],
)
def test_values_must_be_positive(values, subject):
    with refused(InputError, subject):
        EffectiveHardness(*values)


def test_depth_must_not_be_negative():
    with refused(InputError, "depth of an indentation", "0", "0.1"):
        EffectiveHardness(2.0, 1.0, 1.0).at([-0.1])
