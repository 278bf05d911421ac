"""Pearson's system of distributions against tables, closed forms, its differential equation and its
moments."""

from __future__ import annotations

import math

import numpy as np
import pytest
import scipy
from hypothesis import assume, given
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused
from scipy import stats

from asperity.core.errors import InputError
from asperity.core.pearson import TYPES, Pearson

# SciPy's distribution of the same four moments, for the types that have one (type VII is Student's
# t of 4 + 6/(kurtosis - 3) degrees of freedom, type V an inverse gamma distribution, which the row
# of the table is taken for)
CLOSED = {
    "uniform": (0.0, 1.8, stats.uniform(-math.sqrt(3.0), 2.0 * math.sqrt(3.0))),
    "normal": (0.0, 3.0, stats.norm()),
    "student": (0.0, 4.0, stats.t(10.0, scale=math.sqrt(0.8))),
    "exponential": (2.0, 9.0, stats.expon(-1.0)),
    "gamma": (1.0, 4.5, stats.gamma(4.0, -2.0, 0.5)),
    "beta": (0.0, 2.25, stats.beta(2.5, 2.5, -math.sqrt(6.0), 2.0 * math.sqrt(6.0))),
}
PAIRS = [(row["skewness"], row["kurtosis"]) for row in reference("pearson_types")]
BESIDE_LINES = [
    (0.5, 3.375 + 1e-4),
    (0.5, 3.375 - 1e-4),
    (1.0, 4.9703),
    (1.0, 4.9704),
    (2.0, 9.3),
    (1e-4, 3.0),
    (1e-11, 3.0),
    (3.0, 20.0),
]
U_SHAPED = [(0.0, 1.3), (1.0, 2.3)]


@every_row(reference("pearson_types"), label=lambda row: f"{row['skewness']:g}-{row['kurtosis']:g}")
def test_types_against_the_table(row):
    law = Pearson(row["skewness"], row["kurtosis"])
    assert law.type == row["type"]
    # the table has 15 digits; sums of its moments lose one or two in Δ
    assert law.coefficients == pytest.approx((row["c0"], row["c1"], row["c2"]), rel=1e-13, abs=1e-14)
    assert law.support == pytest.approx((row["support_lo"], row["support_hi"]), rel=1e-12)
    assert law.mode == pytest.approx(row["mode_or_antimode"], rel=1e-13)
    if not math.isinf(row["kappa"]):
        assert law.criterion == pytest.approx(row["kappa"], rel=1e-13)


def test_densities_against_the_table():
    rows = reference("pearson_pdf")
    densities = [float(Pearson(row["skewness"], row["kurtosis"]).pdf(row["x"])) for row in rows]
    assert densities == pytest.approx([row["pdf"] for row in rows], rel=5e-12)  # its quadrature: 3e-12


@pytest.mark.parametrize(("column", "order"), [("F0", 0.0), ("F1", 1.0), ("F1_5", 1.5)])
def test_moments_of_the_excess_against_the_table(column, order):
    rows = reference("pearson_gw")
    moments = [float(Pearson(row["skewness"], row["kurtosis"]).excess_moment(order, row["D"])) for row in rows]
    assert moments == pytest.approx([row[column] for row in rows], rel=5e-12)  # its quadrature: 3e-12


@pytest.mark.parametrize("name", CLOSED)
def test_known_distributions(name):
    skewness, kurtosis, known = CLOSED[name]
    assert [float(value) for value in known.stats("mvsk")] == pytest.approx(
        [0.0, 1.0, skewness, kurtosis - 3.0], abs=1e-12
    )
    law, p = Pearson(skewness, kurtosis), np.array([1e-9, 1e-4, 0.03, 0.5, 0.9, 0.9999])
    x = known.ppf(p)
    np.testing.assert_allclose(law.pdf(x), known.pdf(x), rtol=1e-11)
    np.testing.assert_allclose(law.cdf(x), known.cdf(x), rtol=1e-7)  # x itself loses digits next to a bound
    np.testing.assert_allclose(law.survival(x), known.sf(x), rtol=1e-11)
    np.testing.assert_allclose(law.quantile(p), x, rtol=1e-11, atol=1e-13)


@pytest.mark.parametrize("pair", [*PAIRS, *BESIDE_LINES, *U_SHAPED], ids=str)
def test_the_four_moments_are_those_asked_for(pair):
    law = Pearson(*pair)
    low = law.support[0]
    start = low if math.isfinite(low) else -1e3  # beyond which lies less than (1e-3)^9 of the fourth moment of type IV
    raw = [float(law.excess_moment(order, start)) for order in (0.0, 1.0, 2.0, 3.0)]
    shifted = [1.0, -start, 1.0 + start**2, pair[0] - 3.0 * start - start**3]
    np.testing.assert_allclose(raw, shifted, rtol=1e-9)
    # the fourth from the quantiles: E x⁴ = ∫ x(G)⁴ φ(G) dG, whose tails hold less than 1e-6 unless
    # the kurtosis is large
    normal = np.linspace(-9.5, 9.5, 9501)
    weight = np.exp(-0.5 * normal**2) / math.sqrt(2.0 * math.pi) * (normal[1] - normal[0])
    if pair[1] < 7.0:
        assert weight @ law.of_normal(normal) ** 4 == pytest.approx(pair[1], rel=1e-5)


@pytest.mark.parametrize("pair", [pair for pair in PAIRS if pair[1] > 2.5], ids=str)
def test_the_density_obeys_its_differential_equation(pair):
    law = Pearson(*pair)
    c0, c1, c2 = law.coefficients
    x, step = law.quantile(np.array([0.02, 0.2, 0.5, 0.8, 0.98])), 1e-6
    slope = (np.log(law.pdf(x + step)) - np.log(law.pdf(x - step))) / (2.0 * step)
    # central difference: step²/6 times the third derivative of ln f, here below 1e6; rounding
    # 1e-16/step
    np.testing.assert_allclose(slope, -(x + c1) / (c0 + c1 * x + c2 * x**2), rtol=1e-6, atol=1e-8)


@given(skewness=st.floats(-1.8, 1.8), above=st.floats(0.3, 8.0), p=st.floats(1e-6, 1.0 - 1e-6))
def test_distribution_function_and_quantiles_invert_each_other(skewness, above, p):
    law = Pearson(skewness, 1.0 + skewness**2 + above)
    x = law.quantile(p)
    rounding = 4e-16 * max(1.0, abs(float(x))) * float(law.pdf(x))  # of x, in probability: large next to a bound
    assume(law.support[0] < x < law.support[1] and rounding < 1e-10 * min(p, 1.0 - p))
    assert float(law.cdf(x)) == pytest.approx(p, rel=1e-9)
    assert float(law.survival(x)) == pytest.approx(1.0 - p, rel=1e-8)
    mirrored = Pearson(-skewness, law.kurtosis)
    assert float(mirrored.quantile(1.0 - p)) == pytest.approx(-float(x), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("pair", [*PAIRS, *BESIDE_LINES], ids=str)
def test_numbers_from_normal_ones_keep_the_probability(pair):
    if pair == (0.0001, 3.0) and tuple(map(int, scipy.__version__.split(".")[:2])) < (1, 17):
        pytest.skip("quantiles of the gamma distribution of shape 4e8 are exact to 4e-7 only")
    law, normal = Pearson(*pair), np.linspace(-6.0, 6.0, 241)
    x = law.of_normal(normal)
    assert (np.diff(x) >= 0.0).all()
    # cubic splines of step 0.02: 0.02⁴/384 of the fourth derivative, which is below 20 (1 + |x|)
    # for G < 6
    exact = np.where(
        normal < 0.0, law.quantile(stats.norm.cdf(normal)), -Pearson(-pair[0], pair[1]).quantile(stats.norm.sf(normal))
    )
    np.testing.assert_allclose(x, exact, rtol=1e-8, atol=1e-8)


def test_far_numbers_are_not_read_from_the_table():
    law = Pearson(0.0, 3.0)
    assert law.of_normal(np.array([-12.0, 12.0])) == pytest.approx([-12.0, 12.0], rel=1e-12)


@given(skewness=st.floats(-1.5, 1.5), above=st.floats(0.2, 6.0))
def test_moments_of_the_excess_are_integrals_of_each_other(skewness, above):
    law = Pearson(skewness, 1.0 + skewness**2 + above)
    low, high = max(law.support[0], -3.0), min(law.support[1], 3.0)
    d, step = 0.3 * low + 0.7 * high, 1e-4
    slope = float(np.diff(law.excess_moment(2.0, [d - step, d + step]))[0]) / (2.0 * step)
    assert slope == pytest.approx(-2.0 * float(law.excess_moment(1.0, d)), rel=1e-6)  # F_m' = -m F_(m-1)
    assert float(law.excess_moment(0.0, d)) == pytest.approx(float(law.survival(d)), rel=1e-9)


def test_small_probabilities_next_to_the_line_of_type_three():
    law, p = Pearson(0.5, 3.375 - 1e-8), np.array([1e-22, 1e-18, 1e-12])  # a beta distribution with a shape above 1e8
    np.testing.assert_allclose(law.cdf(law.quantile(p)), p, rtol=1e-9)


def test_all_types_are_met():
    assert {Pearson(*pair).type for pair in [*PAIRS, *BESIDE_LINES]} == set(TYPES)


@pytest.mark.parametrize(
    ("pair", "subject", "shown"),
    [
        ((0.0, 0.9), "kurtosis of the heights", "0.9"),
        ((1.0, 2.0), "kurtosis of the heights", "= 2"),
        ((math.nan, 3.0), "skewness of the heights", "nan"),
        ((0.0, math.inf), "kurtosis of the heights", "inf"),
    ],
)
def test_impossible_moments_are_refused(pair, subject, shown):
    with refused(InputError, subject, shown):
        Pearson(*pair)


def test_orders_without_a_moment_are_refused():
    with refused(InputError, "order of the moment of the excess"):
        Pearson(0.0, 4.0).excess_moment(5.0, 0.0)
