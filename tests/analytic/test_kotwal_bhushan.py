"""Kotwal and Bhushan's theory against quadrature (11 digits), its Gaussian limit and the published
trend."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference_data import reference
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.theories import KotwalBhushan, PearsonHeights
from asperity.theories.rough.greenwood_williamson import GreenwoodWilliamson

QUADRATURE = 5e-12  # of the table: 3e-12 on moments 0 to 4


def unit(skewness, kurtosis):
    """Theory with η R σ_s = E* = σ_s/R = 1, of which pressures are P_a and area fractions A_r/(A_a
    η R σ_s)."""
    return KotwalBhushan(1.0, 1.0, 1.0, 1.0, skewness=skewness, kurtosis=kurtosis)


def test_curves_against_the_table():
    for row in reference("pearson_gw"):
        found = unit(row["skewness"], row["kurtosis"]).at_separation(row["D"])
        assert found.contact_density == pytest.approx(row["F0"], rel=QUADRATURE), row
        assert found.pressure == pytest.approx(row["Pa"], rel=QUADRATURE), row
        assert found.area_fraction == pytest.approx(row["area_norm"], rel=QUADRATURE), row
        if row["Pa"] > 0.0:
            assert found.mean_real_pressure == pytest.approx(row["pr_norm"], rel=QUADRATURE), row


def test_gaussian_heights_are_greenwood_and_williamson():
    parameters = (1e11, 3e12, 2e-7, 5e-9, 4e-9)
    h = np.linspace(-1e-8, 4e-8, 21)
    found, expected = (kind(*parameters).at_separation(h) for kind in (KotwalBhushan, GreenwoodWilliamson))
    for name in ("pressure", "area_fraction", "contact_density", "stiffness"):
        # rules of 1e-11 (double exponential) and 1e-13 (Gauss)
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=1e-10), name


def test_published_trend_at_a_light_load():
    """Positive skewness with a large kurtosis halves the area, negative skewness enlarges it
    (Kotwal & Bhushan 1996)."""
    areas = [
        float(unit(*moments).at_pressure(1e-3).area_fraction[0]) for moments in ((0.0, 3.0), (0.5, 5.0), (-1.0, 5.0))
    ]
    assert areas == pytest.approx([3.29e-3, 1.67e-3, 4.75e-3], abs=5e-6)  # three digits are printed


def test_no_summit_touches_above_the_highest():
    theory = unit(0.0, 1.9)
    highest = PearsonHeights(0.0, 1.9).support[1]
    found = theory.at_separation([highest + 1e-9, highest - 0.05])
    assert found.pressure[0] == found.area_fraction[0] == found.contact_density[0] == 0.0
    assert found.pressure[1] > 0.0


@settings(max_examples=25)
@given(skewness=st.floats(-1.0, 1.0), above=st.floats(0.9, 6.0), load=st.floats(1e-5, 0.3))
def test_pressures_are_inverted(skewness, above, load):
    theory = unit(skewness, 1.0 + skewness**2 + above)
    found = theory.at_pressure(load)
    assert theory.at_separation(found.separation).pressure == pytest.approx(load, rel=1e-9)


def test_the_summits_of_a_map_give_its_parameters():
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=5e-7, shortest_wavelength=1.2e-7
    )
    grid = asp.Grid((128, 128), (2e-8, 2e-8))
    roughness = asp.roughness_of(
        asp.generate.translated(grid, spectrum, seed=1, skewness=0.8, kurtosis=5.0, predistorted=False)
    )
    made = KotwalBhushan.from_roughness(roughness, 1e11)
    assert made.skewness == roughness.summits.height_skewness > 0.3
    assert made.kurtosis == roughness.summits.height_kurtosis > 3.0
    plain = GreenwoodWilliamson.from_roughness(roughness, 1e11)
    assert (made.density, made.radius, made.height_deviation) == (plain.density, plain.radius, plain.height_deviation)


@pytest.mark.parametrize(
    ("parameters", "subject", "shown"),
    [
        ({"kurtosis": 1.0}, "kurtosis of the heights", "= 1"),
        ({"skewness": 2.0}, "kurtosis of the heights", "= 5"),
        ({"skewness": math.nan}, "skewness of kotwal-bhushan", "nan"),
    ],
)
def test_impossible_heights_are_refused(parameters, subject, shown):
    with refused(InputError, subject, shown):
        KotwalBhushan(1.0, 1.0, 1.0, 1.0, **parameters)


@pytest.mark.parametrize(("skewness", "kurtosis"), [(1.1, 3.0), (1.5, 4.0)])
def test_heights_whose_density_is_infinite_at_both_ends_bear_every_pressure(skewness, kurtosis):
    pressure = np.geomspace(1e3, 1e9, 25)
    found = KotwalBhushan(1e11, 3e12, 2e-7, 5e-9, skewness=skewness, kurtosis=kurtosis).at_pressure(pressure)
    np.testing.assert_allclose(found.pressure, pressure, rtol=1e-9)
    assert np.isfinite(found.area_fraction).all()
    assert (np.diff(found.area_fraction) > 0.0).all()
    assert (np.diff(found.separation) < 0.0).all()
