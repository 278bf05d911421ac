"""Polynomials on panels: fits, tables over a logarithmic grid, integrals and Hankel transforms
against closed forms."""

import numpy as np
import pytest
from scipy import special

from asperity.core.grid import Grid
from asperity.core.interpolation import STEP, TERMS, log_grid, log_hankel, log_table, panels

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
    """870 (STEP/w)^10 with the distance w of the nearest singularity, 1.05 for the plate: far below
    rounding.

    Rounding of the logarithm, 43 epsilon, counts as often as the logarithmic slope, which
    reaches 5.
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
    """∫ k exp(-k) J_m(kr) dk by the Laplace transform of Bessel functions; r times it falls like
    1/r only."""
    r = 1.0 / GRID[::-1]
    root = np.hypot(1.0, r)
    expected = r * (r / (1.0 + root)) ** order * (1.0 + order * root) / root**3
    np.testing.assert_allclose(log_hankel(GRID * np.exp(-GRID), order), expected, rtol=0, atol=2e-14)


def test_hankel_transform_is_its_own_inverse():
    values = GRID**2 * np.exp(-GRID) * special.jv(1, GRID)
    np.testing.assert_allclose(log_hankel(log_hankel(values, 1.0), 1.0), values, rtol=0, atol=2e-14)


def evaluated(table, values, alpha):
    """Panel polynomials at ``alpha``, straightforwardly."""
    coefficients = table.fitted(values[None])[:, 0]
    panel = np.clip(np.searchsorted(table.breaks, alpha, side="right") - 1, 0, len(table.breaks) - 2)
    low, high = table.breaks[panel], table.breaks[panel + 1]
    t = (alpha - 0.5 * (low + high)) / (0.5 * (high - low))
    return sum(coefficients[panel, k] * t**k for k in range(TERMS))


RESPONSES = {
    "decay": lambda a: (1.0 + a) * np.exp(-a),
    "fast decay": lambda a: 1e2 * a * np.exp(-1e2 * a),
    "slow decay": lambda a: np.exp(-1e-4 * a),
    "plate on a soft base": lambda a: 1.0 / (1.0 + (3.0 * a) ** 3),
    "poles at 45 degrees": lambda a: 1.0 / (1.0 + (0.2 * a) ** 4),
}


@pytest.mark.parametrize("name", RESPONSES)
@pytest.mark.parametrize("shape", [(1024, 1024), (64, 200), (1, 30)])
def test_panels_hold_responses_of_layers_to_rounding(name, shape):
    """Ten terms on panels that grow by 2^(1/8) leave 1e-13 of the functions' size, 1, wherever
    their scale lies."""
    grid = Grid(shape, (0.3, 0.2))
    table, function = panels(grid), RESPONSES[name]
    q = np.unique(grid.wavenumber())[1:]
    assert table.breaks[0] <= q[0]
    assert table.breaks[-1] >= q[-1]
    np.testing.assert_allclose(evaluated(table, function(table.points), q), function(q), atol=1e-13, rtol=0)


def test_a_single_point_has_panels_too():
    assert np.isfinite(panels(Grid((1, 1), (1.0, 1.0))).points).all()
