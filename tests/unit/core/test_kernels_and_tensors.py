"""Kernels of cyclic convolutions, values with named components."""

import numpy as np
import pytest

from asperity.core.spectral import RealTransform, fast_length, wrapped
from asperity.core.tensor import STRESSES, Displacement, ElasticFields, StressTensor


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
