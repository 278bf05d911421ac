"""Tables over a logarithmic grid: interpolation, integrals and Hankel transforms against closed forms."""

import numpy as np
import pytest
from scipy import special

from asperity.core.hankel import log_hankel
from asperity.core.log_table import STEP, log_grid, log_table

COUNT = 8192
START = float(np.exp(-COUNT // 2 * STEP))
GRID = log_grid(START, COUNT)
POINTS = np.exp(np.random.default_rng(0).uniform(-20.0, 20.0, 40000))
FUNCTIONS = {
    "rational": lambda x: x / (1.0 + x) ** 2,
    "plate": lambda x: 1.0 / (1.0 + x**3),  # poles at an angle of 60 degrees
    "power": lambda x: x**1.5,
    "exponential": lambda x: np.exp(-x) + 1e-3,
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_interpolation_is_nearly_exact(name):
    """870 (STEP/w)^10 with the distance w of the nearest singularity, 1.05 for the plate: far below rounding.

    Rounding of the logarithm, 43 epsilon, counts as often as the logarithmic slope, which reaches 5.
    """
    f = FUNCTIONS[name]
    np.testing.assert_allclose(log_table(START, f(GRID))(POINTS), f(POINTS), rtol=6e-14)


def test_any_shape_and_ends():
    table = log_table(1.0, log_grid(1.0, 11))
    assert table.end == pytest.approx(table.start * np.exp(2.0 * STEP), rel=1e-14)
    inside = np.array([[table.start, 0.5 * (table.start + table.end)], [table.end, table.start]])
    np.testing.assert_allclose(table(inside), inside, rtol=1e-14)
    assert table(inside[:0]).shape == (0, 2)


def test_integral_over_the_logarithm():
    integral = log_table(START, GRID / (1.0 + GRID) ** 2).integral()
    x = np.geomspace(1e-3, 1e3, 50)
    expected = x / (1.0 + x) - integral.start / (1.0 + integral.start)
    np.testing.assert_allclose(integral(x), expected, rtol=1e-13)


@pytest.mark.parametrize("order", [0.0, 0.5, 1.0, 2.0, 3.0])
def test_hankel_transform_of_a_gaussian(order):
    """∫ k^(m+1) exp(-k²/2) J_m(kr) dk = r^m exp(-r²/2); the error is that of rounding."""
    r = 1.0 / GRID[::-1]
    found = log_hankel(GRID ** (order + 1.0) * np.exp(-0.5 * GRID**2), order)
    np.testing.assert_allclose(found, r * r**order * np.exp(-0.5 * r**2), rtol=0, atol=2e-14)


@pytest.mark.parametrize("order", [0, 1, 2])
def test_hankel_transform_with_a_long_tail(order):
    """∫ k exp(-k) J_m(kr) dk by the Laplace transform of Bessel functions; r times it falls like 1/r only."""
    r = 1.0 / GRID[::-1]
    root = np.hypot(1.0, r)
    expected = r * (r / (1.0 + root)) ** order * (1.0 + order * root) / root**3
    np.testing.assert_allclose(log_hankel(GRID * np.exp(-GRID), order), expected, rtol=0, atol=2e-14)


def test_hankel_transform_is_its_own_inverse():
    values = GRID**2 * np.exp(-GRID) * special.jv(1, GRID)
    np.testing.assert_allclose(log_hankel(log_hankel(values, 1.0), 1.0), values, rtol=0, atol=2e-14)
