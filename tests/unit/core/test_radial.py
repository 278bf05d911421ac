"""Polynomials on growing panels, kernels of cyclic convolutions, values with named components."""

import numpy as np
import pytest

from asperity.core.grid import Grid
from asperity.core.radial import TERMS, panels
from asperity.core.spectral import RealTransform, fast_length, wrapped
from asperity.core.tensor import STRESSES, Displacement, ElasticFields, StressTensor


def evaluated(table, values, alpha):
    """Panel polynomials at ``alpha``, straightforwardly."""
    coefficients = table.coefficients(values[None])[:, 0]
    panel = np.clip(np.searchsorted(table.breaks, alpha, side="right") - 1, 0, len(table.breaks) - 2)
    low, high = table.breaks[panel], table.breaks[panel + 1]
    t = (alpha - 0.5 * (low + high)) / (0.5 * (high - low))
    return sum(coefficients[panel, k] * t**k for k in range(TERMS))


FUNCTIONS = {
    "decay": lambda a: (1.0 + a) * np.exp(-a),
    "fast decay": lambda a: 1e2 * a * np.exp(-1e2 * a),
    "slow decay": lambda a: np.exp(-1e-4 * a),
    "plate on a soft base": lambda a: 1.0 / (1.0 + (3.0 * a) ** 3),
    "poles at 45 degrees": lambda a: 1.0 / (1.0 + (0.2 * a) ** 4),
}


@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.parametrize("shape", [(1024, 1024), (64, 200), (1, 30)])
def test_panels_hold_responses_of_layers_to_rounding(name, shape):
    """Ten terms on panels that grow by 2^(1/8) leave 1e-13 of the functions' size, 1, wherever their scale lies."""
    grid = Grid(shape, (0.3, 0.2))
    table, function = panels(grid), FUNCTIONS[name]
    q = np.unique(grid.wavenumber())[1:]
    assert table.breaks[0] <= q[0]
    assert table.breaks[-1] >= q[-1]
    np.testing.assert_allclose(evaluated(table, function(table.points), q), function(q), atol=1e-13, rtol=0)


def test_a_single_point_has_panels_too():
    assert np.isfinite(panels(Grid((1, 1), (1.0, 1.0))).points).all()


@pytest.mark.parametrize("odd_x", [False, True])
@pytest.mark.parametrize("odd_y", [False, True])
def test_wrapped_kernels_convolve_as_sums(odd_x, odd_y):
    rng = np.random.default_rng(0)
    coefficients, field = rng.standard_normal((2, 4, 3))
    coefficients[0] *= not odd_x
    coefficients[:, 0] *= not odd_y
    padded = (fast_length(7), fast_length(5))
    transform = RealTransform(padded)
    whole = np.zeros(padded)
    whole[:4, :3] = field
    kernel = wrapped(coefficients, padded, odd_x=odd_x, odd_y=odd_y)
    found = transform.backward(transform.forward(kernel) * transform.forward(whole))[:4, :3]
    wanted = np.zeros((4, 3))
    for i, j, k, m in np.ndindex(4, 3, 4, 3):
        sign = (-1.0 if odd_x and i < k else 1.0) * (-1.0 if odd_y and j < m else 1.0)
        wanted[i, j] += sign * coefficients[abs(i - k), abs(j - m)] * field[k, m]
    np.testing.assert_allclose(found, wanted, atol=1e-14)


def test_tensors_add_scale_and_exchange_axes():
    one = StressTensor(*(np.array([float(k)]) for k in range(6)))
    total = one + one * 2.0
    assert [float(getattr(total, name)[0]) for name in STRESSES] == [0.0, 3.0, 6.0, 9.0, 12.0, 15.0]
    turned = one.exchanged()
    assert (turned.xx, turned.yy, turned.xz, turned.yz) == (one.yy, one.xx, one.yz, one.xz)
    assert turned.exchanged().xz is one.xz
    moved = Displacement(np.array([1.0]), np.array([2.0]), np.array([3.0]))
    assert moved.exchanged().x is moved.y
    both = ElasticFields(moved, one) + ElasticFields(moved, one) * -1.0
    assert both.displacement.z[0] == both.stress.yz[0] == 0.0
    assert (one.map(np.negative).yz == -one.yz).all()
