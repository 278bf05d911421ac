"""The numbers of studies: samples and stopping, order of convergence, critical thickness,
sensitivity."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused
from study_cases import plan

from asperity.core.errors import InputError
from asperity.io.schemas.study import StopTable
from asperity.studies.convergence import convergence
from asperity.studies.critical_thickness import critical_thickness
from asperity.studies.monte_carlo import Stop, estimate, student
from asperity.studies.sensitivity import sensitivity

MODULUS, POISSON = "body.base.youngs_modulus", "body.base.poisson_ratio"


def columns(samples: int, *random):
    axis = plan(monte_carlo={"seed": 5, "samples": samples, "random": list(random)}).axes[0]
    return {name: np.array([point.columns[name] for point in axis.points]) for name in axis.columns}


def test_distributions_have_the_moments_they_are_given():
    n = 2000
    found = columns(
        n,
        {"path": MODULUS, "distribution": "lognormal", "mean": "200 GPa", "deviation": "60 GPa"},
        {"path": POISSON, "distribution": "normal", "mean": 0.3, "deviation": 0.01},
        {"path": "surface.spectrum.rms_height", "distribution": "uniform", "low": "1 nm", "high": "3 nm"},
    )
    modulus, ratio, height = found["youngs_modulus"], found["poisson_ratio"], found["spectrum_rms_height"]
    # four standard errors: of a mean s/√n, of a deviation s√((κ-1)/4n), κ = 3 (normal), 1.8
    # (uniform), 4.6 (this lognormal)
    for values, mean, deviation, kurtosis in (
        (modulus, 2e11, 6e10, 4.6),
        (ratio, 0.3, 0.01, 3.0),
        (height, 2e-9, 2e-9 / math.sqrt(12.0), 1.8),
    ):
        assert values.mean() == pytest.approx(mean, abs=4.0 * deviation / math.sqrt(n))
        assert values.std() == pytest.approx(deviation, rel=4.0 * math.sqrt((kurtosis - 1.0) / (4.0 * n)), abs=0.0)
    assert modulus.min() > 0.0
    assert 1e-9 <= height.min() < height.max() <= 3e-9
    assert abs(np.corrcoef([modulus, ratio, height])[np.triu_indices(3, 1)]).max() < 4.0 / math.sqrt(n)


def test_a_sample_depends_on_its_number_and_path_alone():
    seed = {"path": "surface.seed", "distribution": "seed"}
    ratio = {"path": POISSON, "distribution": "uniform", "low": 0.2, "high": 0.4}
    few, many = columns(5, seed), columns(50, ratio, seed)
    np.testing.assert_array_equal(few["seed"], many["seed"][:5])
    assert len(set(many["seed"])) == 50


@pytest.mark.parametrize(
    ("random", "subject"),
    [
        ({"path": MODULUS, "distribution": "seed"}, "body.base.youngs_modulus"),
        ({"path": MODULUS, "distribution": "normal", "mean": "1 GPa"}, "study document: monte_carlo.random[1]"),
        (
            {"path": MODULUS, "distribution": "uniform", "low": "2 GPa", "high": "1 GPa"},
            "high of body.base.youngs_modulus",
        ),
        (
            {"path": MODULUS, "distribution": "lognormal", "mean": "1 GPa", "deviation": "0 GPa"},
            "deviation of body.base.youngs_modulus",
        ),
        ({"path": "surface.seeds", "distribution": "seed"}, "path"),
    ],
)
def test_impossible_distributions_are_refused(random, subject):
    with refused(InputError, subject):
        columns(3, random)


def test_the_interval_of_a_mean_is_that_of_students_t():
    # the classical table: t(0.975) = 12.7062 (1), 2.5706 (5), 1.9623 (1000 degrees of freedom)
    assert [student(n, 0.95) for n in (2, 6, 1001)] == pytest.approx([12.7062, 2.5706, 1.9623], abs=5e-5)
    found = estimate([1.0, 2.0, 3.0, math.nan, 4.0])
    assert (found.mean, found.count) == (2.5, 4)
    assert found.deviation == pytest.approx(math.sqrt(5.0 / 3.0))
    assert found.half_width == pytest.approx(3.18245 * math.sqrt(5.0 / 3.0) / 2.0, rel=1e-5, abs=0.0)
    assert math.isnan(estimate([1.0]).half_width)


def test_the_interval_holds_the_mean_as_often_as_it_says():
    rng = np.random.default_rng(3)
    hits = sum(abs((found := estimate(rng.normal(7.0, 2.0, 6))).mean - 7.0) <= found.half_width for _ in range(1000))
    assert hits == pytest.approx(950, abs=4.0 * math.sqrt(1000 * 0.95 * 0.05))


def stop(**rule) -> StopTable:
    return StopTable(quantity="approach", **rule)


def test_samples_end_at_the_first_number_at_which_the_interval_is_narrow():
    values = np.random.default_rng(1).normal(10.0, 1.0, 200)
    rule = Stop(stop(width=0.3, at_least=5), 1)
    for number, value in enumerate(values):
        rule.take(number, 0, float(value))
    widths = [estimate(values[:n]).half_width for n in range(5, 200)]
    assert rule.end == 5 + next(i for i, width in enumerate(widths) if width <= 0.3)


@given(st.permutations(range(60)))
def test_the_end_does_not_depend_on_the_order_of_arrival(order):
    values = np.random.default_rng(2).normal([5.0, 50.0], 1.0, (60, 2))
    values[7, 1] = math.nan  # a failed case
    rule = Stop(stop(relative_width=0.1), 2)
    for sample in order:
        for point in (1, 0):
            rule.take(sample, point, float(values[sample, point]))
    straight = Stop(stop(relative_width=0.1), 2)
    for sample in range(60):
        for point in (0, 1):
            straight.take(sample, point, float(values[sample, point]))
    assert rule.end == straight.end is not None


@given(
    st.floats(0.3, 6.0),
    st.floats(-5.0, 5.0),
    st.floats(0.5, 3.0),
    st.tuples(st.floats(1.3, 4.0), st.floats(1.3, 4.0)),
)
def test_a_power_of_the_step_is_found_exactly(order, limit, factor, ratios):
    """Y(h) = Y(0) + C h^p on levels of any ratios; the differences lose digits, the finer ones
    most."""
    h = np.array([ratios[0] * ratios[1], ratios[1], 1.0])
    y = limit + factor * h**order
    found = convergence(h, y)
    lost = 1e-13 * max(abs(limit), float(y.max())) / (y[1] - y[2])
    assert found.order == pytest.approx(order, rel=1e-9 + 100.0 * lost, abs=0.0)
    assert found.extrapolated == pytest.approx(limit, abs=(1e-9 + 100.0 * lost) * factor)


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ([1.0, 2.0, 1.5], "swing"),
        ([1.0, 2.0, 4.0], "do not fall"),
        ([1.0, 2.0, 2.0], "two finest levels agree"),
        ([2.0, 2.0, 1.0], "two coarser levels agree"),
        ([2.0, math.nan, 1.0], "failed"),
    ],
)
def test_values_without_an_order_say_so(values, said):
    found = convergence([4.0, 2.0, 1.0], values)
    assert said in found.remark
    assert math.isnan(found.order)
    assert math.isnan(found.extrapolated)


def test_steps_must_fall():
    with refused(InputError, "steps of a convergence study"):
        convergence([1.0, 2.0, 4.0], [1.0, 2.0, 3.0])


CURVES = {
    "rational": lambda x: x / (x + 1.0),
    "exponential": lambda x: -np.expm1(-x),
    "loglogistic": lambda x: x**2 / (x**2 + 1.0),
}


@every_row(reference("critical_thickness_examples"), label=lambda row: f"{row['curve']}-{row['h0_m']}")
def test_reference_thicknesses(row):
    h0, zero, infinity = row["h0_m"], row["Y_at_0"], row["Y_at_infinity"]
    # 100 thicknesses per decade: a curve is straight in ln h between them to (Δ ln h)² / 8 of its
    # curvature, 7e-5 of the transition at most, and at 5 % a transition changes by 0.045 or more
    # per unit of ln h
    thickness = h0 * np.geomspace(1e-4, 1e4, 801)
    values = zero + (infinity - zero) * CURVES[row["curve"]](thickness / h0)
    found = critical_thickness(thickness, values, zero, infinity)
    assert found.floor == pytest.approx(row["h_floor_m"], rel=7e-5 / 0.045, abs=0.0)
    assert found.ceiling == pytest.approx(row["h_ceiling_m"], rel=7e-5 / 0.045, abs=0.0)


def test_of_several_crossings_the_outermost_counts():
    h = [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4]
    done = [0.01, 0.2, 0.02, 1.0, 0.9, 1.01]
    found = critical_thickness(h, done, 0.0, 1.0)
    assert found.floor == pytest.approx(10 ** (-9 + 0.04 / 0.19), rel=1e-9, abs=0.0)
    assert found.ceiling == pytest.approx(10 ** (-5 + 0.05 / 0.11), rel=1e-9, abs=0.0)


def test_the_bound_is_on_both_sides():
    """A quantity that first moves away from its other limit leaves the floor as well."""
    found = critical_thickness([1.0, 10.0, 100.0], [-0.1, 0.5, 1.2], 0.0, 1.0)
    assert math.isnan(found.floor)
    assert math.isnan(found.ceiling)


def test_what_never_leaves_its_limit_within_the_thicknesses_given():
    found = critical_thickness([1.0, 2.0], [0.0, 0.0], 0.0, 1.0)
    assert found.floor == 2.0
    assert math.isnan(found.ceiling)
    assert math.isnan(critical_thickness([1.0, 2.0], [1.0, 1.0], 1.0, 1.0).floor), "without a difference there is none"


@given(st.floats(-3.0, 3.0), st.floats(0.1, 10.0), st.floats(0.5, 2.0))
def test_the_elasticity_of_a_power_is_its_exponent(exponent, factor, x):
    low, high = 0.95 * x, 1.05 * x
    found = sensitivity((low, high), (factor * low**exponent, factor * high**exponent))
    assert found.elasticity == pytest.approx(exponent, abs=1e-9)


def test_a_quantity_that_changes_sign_has_a_slope_only():
    found = sensitivity((1.0, 3.0), (-2.0, 4.0))
    assert found.slope == 3.0
    assert math.isnan(found.elasticity)
