"""Greenwood and Williamson against high-precision quadrature (15 digits), closed forms and
limits."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError, NoSolutionError
from asperity.theories.rough.greenwood_williamson import (
    FittedGreenwoodWilliamson,
    FittedLaws,
    GreenwoodWilliamson,
    plastic_area_share,
    plastic_area_share_beyond,
    plastic_number_share,
    separation_at_plastic_onset,
)
from asperity.theories.statistics.heights import NAMED_HEIGHTS, AnyHeights, GaussianHeights, HistogramHeights

HEIGHTS = dict(NAMED_HEIGHTS)
UNIT = GreenwoodWilliamson(1.0, 1.0, 1.0, 1.0)
# sums of a hundred positive terms in double precision, and powers with rounded arguments of up to
# 6² / 2
ROUNDING = 1e-13


def test_moments_of_summit_heights():
    for row in reference("gw_Fm"):
        found = HEIGHTS[row["pdf"]].tail_moment(np.array(row["D"]), row["m"])
        assert float(found) == pytest.approx(row["F_m"], rel=ROUNDING), row


def test_dimensionless_curves():
    for row in reference("gw_curves"):
        heights = HEIGHTS[row["pdf"]]
        theory = GreenwoodWilliamson(1.0, 1.0, 1.0, 1.0, heights=heights)
        found = theory.at_separation(row["D"] - heights.mean)
        assert found.pressure == pytest.approx(row["Pa"], rel=ROUNDING)
        assert found.area_fraction == pytest.approx(row["area_norm"], rel=ROUNDING)
        assert found.contact_density == pytest.approx(row["n_norm"], rel=ROUNDING)
        assert found.mean_real_pressure == pytest.approx(row["pr_norm"], rel=ROUNDING)
        assert found.area_fraction / found.pressure == pytest.approx(row["eq14"], rel=ROUNDING)
        assert found.contact_density / found.pressure == pytest.approx(row["eq15"], rel=ROUNDING)
        assert found.area_fraction / found.contact_density == pytest.approx(row["mean_area_norm"], rel=ROUNDING)
        # ln P_a changes by at least its error over a change of D of the same size
        assert theory.at_pressure(row["Pa"]).separation + heights.mean == pytest.approx(row["D"], abs=ROUNDING)


def test_table_1_and_its_fits():
    power, linear = FittedLaws(), FittedLaws("linear")
    for row in reference("gw_table1"):
        P_a = np.array([row["Pa"]])
        found = UNIT.at_pressure(P_a)
        for name, value in (
            ("D", found.separation),
            ("pr_norm", found.mean_real_pressure),
            ("area_norm", found.area_fraction),
            ("n_norm", found.contact_density),
            ("mean_area_norm", found.area_fraction / found.contact_density),
            ("pr_fit", power.real_pressure(P_a)),
            ("area_fit", power.area(P_a)),
            ("n_fit", power.number(P_a)),
            ("mean_area_fit", power.mean_area(P_a)),
            ("pr_const", linear.real_pressure(P_a)),
            ("area_linear", linear.area(P_a)),
            ("n_linear", linear.number(P_a)),
            ("mean_area_const", linear.mean_area(P_a)),
        ):
            assert value == pytest.approx(row[name], rel=ROUNDING, abs=1e-14), name
        if row["Pa"] < 0.57:
            assert power.separation(P_a) == pytest.approx(row["D_fit"], rel=ROUNDING)
        else:
            assert np.isnan(power.separation(P_a)).all()


def test_fits_are_as_good_as_stated():
    fitted = FittedGreenwoodWilliamson(1.0, 1.0, 1.0, 1.0)
    pressures = np.geomspace(1e-6, 0.1, 60)
    exact, found = UNIT.at_pressure(pressures), fitted.at_pressure(pressures)
    # the largest errors of the fits in their range: 5.1, 6.1 and 19 per cent
    for name, worst in (("mean_real_pressure", 0.051), ("area_fraction", 0.061), ("contact_density", 0.19)):
        error = np.abs(getattr(found, name) / getattr(exact, name) - 1.0)
        assert error.max() == pytest.approx(worst, abs=0.006)
    assert all(limit.holds.all() for limit in fitted.validity(found)[:1])
    outside = fitted.validity(fitted.at_pressure([1e-9, 0.5]))[0]
    assert not outside.holds.any()


def test_plastic_shares():
    for row in reference("gw_plastic_fraction"):
        for name, share in (
            ("plastic_area_fraction", plastic_area_share),
            ("plastic_area_fraction_shifted", plastic_area_share_beyond),
            ("plastic_number_fraction", plastic_number_share),
        ):
            assert float(share(row["D"], row["psi"])) == pytest.approx(row[name], rel=ROUNDING)


@every_row(reference("gw_plastic_onset_002"), label=lambda row: f"{row['psi']:g}")
def test_onset_of_plastic_flow(row):
    for suffix, beyond in (("", False), ("_shifted", True)):
        D = separation_at_plastic_onset(row["psi"], beyond=beyond)
        assert pytest.approx(row[f"D_onset{suffix}"], rel=1e-12, abs=1e-12) == D
        # ln P_a is steeper than D by up to eight
        assert UNIT.at_separation(D).pressure == pytest.approx(row[f"Pa_onset{suffix}"], rel=1e-11)


def test_there_is_no_onset_where_everything_flows():
    with refused(NoSolutionError, "plastic share 0.02"):
        separation_at_plastic_onset(1e3)


def test_exponential_heights_give_amontons_law():
    theory = GreenwoodWilliamson(2.0, 3.0, 5.0, 0.1, heights=HEIGHTS["exponential"])
    found = theory.at_separation(np.linspace(-0.1, 1.0, 30))  # from the lowest summit upwards
    assert found.mean_real_pressure == pytest.approx(2.0 * math.sqrt(0.1 / 5.0) / math.sqrt(math.pi), rel=ROUNDING)
    constants = {row["name"]: row["value"] for row in reference("constants")}
    assert constants["gw_exponential_pr_over_Estar_sqrt_sigma_over_R"] == pytest.approx(1.0 / math.sqrt(math.pi))
    assert found.area_fraction / found.contact_density == pytest.approx(math.pi * 5.0 * 0.1, rel=ROUNDING)


@pytest.mark.parametrize("name", HEIGHTS)
def test_the_stiffness_is_the_slope_of_the_pressure(name):
    theory = GreenwoodWilliamson(1e11, 1e12, 1e-6, 1e-8, mean_height=3e-9, heights=HEIGHTS[name])
    h, step = np.linspace(-5e-9, 2e-8, 9), 1e-12
    higher, lower = (theory.at_separation(h + sign * step).pressure for sign in (1.0, -1.0))
    # central differences: (step/σ)² of the third derivative, and rounding over the step
    expected = (lower - higher) / (2.0 * step)
    assert theory.at_separation(h).stiffness == pytest.approx(expected, rel=1e-5, abs=1e-5 * expected.max())


@given(
    name=st.sampled_from(sorted(HEIGHTS)),
    D=st.floats(-5.0, 2.0),
    scale=st.floats(0.1, 10.0),
)
def test_pressures_are_found_again(name, D, scale):
    theory = GreenwoodWilliamson(1e11 * scale, 1e12, 1e-6 / scale, 1e-8, mean_height=2e-8, heights=HEIGHTS[name])
    h = theory.mean_height + 1e-8 * min(D, HEIGHTS[name].support[1] - HEIGHTS[name].mean - 0.1)
    pressure = theory.at_separation(h).pressure
    assert theory.at_pressure(pressure).separation == pytest.approx(h, abs=1e-8 * 1e-10)


def test_the_gaussian_as_a_density_of_ones_own():
    gaussian = GaussianHeights()
    own = AnyHeights(gaussian.density, tuple(np.linspace(-9.0, 9.0, 13)))
    D = np.linspace(-6.0, 6.0, 25)
    for m in (0.0, 0.5, 1.0, 1.5, 2.5):
        assert own.tail_moment(D, m) == pytest.approx(gaussian.tail_moment(D, m), rel=1e-8, abs=1e-15)
    assert own.density(np.array([0.0, 20.0])) == pytest.approx([gaussian.density(0.0), 0.0])


def test_densities_that_are_not_standardised_are_refused():
    with refused(InputError, "density of standardised heights", "1"):
        AnyHeights(lambda s: np.exp(-s), (0.0, 5.0, 40.0))
    with refused(InputError, "breaks of a density"):
        AnyHeights(GaussianHeights().density, (1.0, 0.0))


def test_a_histogram_of_one_bin_is_uniform_whatever_its_unit():
    histogram = HistogramHeights(np.array([3e-9, 8e-9]), np.array([17.0]))
    D = np.linspace(-3.0, 2.0, 21)
    for m in (0.0, 0.5, 1.5):
        expected = HEIGHTS["uniform"].tail_moment(D, m)
        assert histogram.tail_moment(D, m) == pytest.approx(expected, rel=1e-12, abs=1e-14)
    assert histogram.density(D) == pytest.approx(HEIGHTS["uniform"].density(D))


def test_histograms_of_many_samples_tend_to_their_distribution():
    samples = np.random.default_rng(5).standard_normal(400_000)
    histogram = HistogramHeights.from_samples(samples, 400)
    D = np.linspace(-2.0, 2.0, 9)
    # four standard errors of <(s - D)^1.5>, plus bins of 0.02 σ whose effect is of second order
    spread = np.sqrt(GaussianHeights().tail_moment(D, 3.0) / samples.size)
    difference = histogram.tail_moment(D, 1.5) - GaussianHeights().tail_moment(D, 1.5)
    assert np.all(np.abs(difference) < 4.0 * spread + 1e-3)


def test_unusable_histograms_are_refused():
    with refused(InputError, "histogram"):
        HistogramHeights(np.array([0.0, 0.0, 1.0]), np.ones(2))
    with refused(InputError, "counts of a histogram"):
        HistogramHeights(np.array([0.0, 1.0]), np.zeros(1))
    with refused(InputError, "summit heights of a histogram"):
        HistogramHeights.from_samples(np.ones(5))


def test_unusable_parameters_are_refused():
    with refused(InputError, "radius (m) of greenwood-williamson"):
        GreenwoodWilliamson(1e11, 1e12, -1e-6, 1e-8)
    with refused(InputError, "form of greenwood-williamson-fits"):
        FittedGreenwoodWilliamson(1e11, 1e12, 1e-6, 1e-8, form="cubic")
    with refused(InputError, "pressures"):
        GreenwoodWilliamson(1e11, 1e12, 1e-6, 1e-8, heights=HEIGHTS["uniform"]).at_pressure(1e20)


def test_validity_says_where_contacts_are_too_many():
    theory = GreenwoodWilliamson(1e11, 1e12, 1e-6, 1e-8)
    area, blunt = theory.validity(theory.at_separation([-1e-8, 3e-8]))
    assert area.holds.tolist() == [True, True]
    assert blunt.holds.all()
    crowded = GreenwoodWilliamson(1e11, 2e13, 1e-6, 1e-8)
    assert crowded.validity(crowded.at_separation([-1e-8, 3e-8]))[0].holds.tolist() == [False, True]
