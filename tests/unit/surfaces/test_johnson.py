"""Johnson's system: reference parameters, moments by independent quadrature, limits and
refusals."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused
from scipy.special import ndtri

from asperity.core.errors import InputError
from asperity.surfaces.generate.non_gaussian import johnson, translated_correlation

ROWS = reference("surfaces_johnson")
KINDS = {"SU": "unbounded", "SB": "bounded"}


def moments(law):
    """First four moments by Gauss-Legendre panels over the probability, independent of the rule in
    the library."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    edges = np.concatenate([np.linspace(-38.0, 38.0, 153)])
    middle, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges)
    g = (middle[:, None] + half[:, None] * nodes).ravel()
    w = (half[:, None] * weights).ravel() * np.exp(-0.5 * g**2) / np.sqrt(2.0 * np.pi)
    with np.errstate(over="ignore"):
        z = law.of_normal(g)
    use = w > 1e-300
    return [float(w[use] @ z[use] ** power) for power in (1, 2, 3, 4)]


def row_id(row):
    return f"{row['Ssk']}, {row['Sku']}"


@every_row(ROWS, label=row_id)
def test_parameters_are_those_of_the_reference(row):
    law = johnson(row["Ssk"], row["Sku"])
    assert law.kind == KINDS[row["type"]]
    found = (law.gamma, law.delta, law.xi, law.scale)
    # the file gives twelve digits; parameters far out (bounded near normal) magnify its rounding to
    # 4e-11
    assert found == pytest.approx([row[name] for name in ("gamma", "delta", "xi", "lambda")], rel=1e-10, abs=1e-11)
    values = law.of_normal(np.array([-2.0, 0.0, 2.0]))
    assert values == pytest.approx([row[f"z_at_G={g}"] for g in (-2, 0, 2)], rel=1e-10, abs=1e-11)


@every_row(ROWS, label=row_id)
def test_correlation_of_translated_heights(row):
    law = johnson(row["Ssk"], row["Sku"])
    rho = np.array([0.9, 0.5, -0.5, -0.9])
    expected = [row[f"rho_z_at_rho_g_{r}"] for r in ("0.9", "0.5", "-0.5", "-0.9")]
    assert translated_correlation(law, rho) == pytest.approx(expected, rel=1e-9)
    assert translated_correlation(law, np.array([0.0, 1.0])) == pytest.approx([0.0, 1.0], abs=1e-14)


@settings(max_examples=80)
@given(skewness=st.floats(-4.0, 4.0), above=st.floats(0.05, 20.0))
def test_moments_are_those_asked_for(skewness, above):
    kurtosis = (1.0 + skewness**2) * (1.0 + above)
    law = johnson(skewness, kurtosis)
    assume(law.kind != "bounded" or law.delta > 0.15)  # steeper ones outrun the panels of this test
    mean, square, third, fourth = moments(law)
    assert mean == pytest.approx(0.0, abs=1e-8)
    assert square == pytest.approx(1.0, rel=1e-8)
    assert third == pytest.approx(skewness, rel=1e-6, abs=1e-6)
    assert fourth == pytest.approx(kurtosis, rel=1e-6)


@settings(max_examples=40)
@given(skewness=st.floats(-3.0, 3.0), above=st.floats(0.05, 20.0))
def test_mirror_image_and_monotony(skewness, above):
    kurtosis = (1.0 + skewness**2) * (1.0 + above)
    normal = np.linspace(-4.0, 4.0, 41)
    heights = johnson(skewness, kurtosis).of_normal(normal)
    assert (np.diff(heights) >= 0.0).all()
    np.testing.assert_allclose(johnson(-skewness, kurtosis).of_normal(-normal), -heights, rtol=1e-9, atol=1e-9)


def test_normal_and_lognormal_lie_between():
    normal = ndtri(np.array([0.01, 0.3, 0.9]))
    assert johnson(0.0, 3.0).kind == "normal"
    np.testing.assert_array_equal(johnson(0.0, 3.0).of_normal(normal), normal)
    w = 1.1
    skewness, kurtosis = np.sqrt((w - 1) * (w + 2) ** 2), w**4 + 2 * w**3 + 3 * w**2 - 3
    law = johnson(skewness, kurtosis)
    assert law.kind == "lognormal"
    s = np.sqrt(np.log(w))
    np.testing.assert_allclose(
        law.of_normal(normal), (np.exp(s * normal) - np.sqrt(w)) / np.sqrt(w * (w - 1)), rtol=1e-12
    )
    # continuous across the line from either side
    for nearby in (kurtosis * (1 + 1e-5), kurtosis * (1 - 1e-5)):
        assert johnson(skewness, nearby).kind in ("unbounded", "bounded")
        np.testing.assert_allclose(johnson(skewness, nearby).of_normal(normal), law.of_normal(normal), atol=1e-4)
    np.testing.assert_allclose(johnson(-skewness, kurtosis).of_normal(-normal), -law.of_normal(normal), rtol=1e-12)


@pytest.mark.parametrize(
    ("skewness", "kurtosis", "subject", "shown"),
    [
        (0.0, 0.5, "kurtosis of the heights", "0.5"),
        (2.0, 4.0, "kurtosis of the heights", "4"),
        (0.0, 1.0005, "kurtosis 1 of the heights at skewness 0", "= 1"),
        (1.0, 2.0, "kurtosis 2 of the heights at skewness 1", "= 2"),
        (np.nan, 3.0, "skewness of the heights", "nan"),
        (0.0, np.inf, "kurtosis of the heights", "inf"),
    ],
)
def test_impossible_pairs_are_refused(skewness, kurtosis, subject, shown):
    with refused(InputError, subject, shown):
        johnson(skewness, kurtosis)
