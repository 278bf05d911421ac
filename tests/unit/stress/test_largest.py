"""Largest stresses by bounds, against the stress at every point."""

from __future__ import annotations

import numpy as np
import pytest

from asperity.core.tensor import StressTensor
from asperity.physics.stress.largest import _FEW, EXACT, largest

POINTS = (90, 80)


def stresses(seed: int, dtype: str) -> StressTensor:
    rng = np.random.default_rng(seed)
    return StressTensor(*(1e9 * rng.standard_normal((6, *POINTS)).astype(dtype)))


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("name", EXACT)
def test_the_largest_is_that_of_all_points(name: str, dtype: str) -> None:
    assert np.prod(POINTS) > _FEW, "bounds are used"
    for seed in range(3):
        s = stresses(seed, dtype)
        for sign in (1.0, -1.0, 0.0):  # tension, compression, and all points alike
            shifted = StressTensor(s.xx + sign * 5e9, s.yy + sign * 5e9, s.zz + sign * 5e9, s.xy, s.xz, s.yz)
            every = EXACT[name](shifted).ravel()
            numbers, values = largest(name, shifted)
            assert numbers[np.argmax(values)] == np.argmax(every)
            assert values.max() == every.max()


@pytest.mark.parametrize("name", EXACT)
def test_no_point_that_its_margin_takes_to_the_top_is_left_out(name: str) -> None:
    s, slack = stresses(3, "float64"), np.random.default_rng(4).uniform(0.0, 3e8, np.prod(POINTS))
    every = EXACT[name](s).ravel()
    reach = every + 0.05 * np.abs(every) + slack
    numbers, values = largest(name, s, 0.05, slack)
    assert set(np.flatnonzero(reach >= every.max())) <= set(numbers)
    assert values == pytest.approx(every[numbers], rel=1e-13)


@pytest.mark.parametrize("name", EXACT)
def test_a_stress_that_is_no_number_is_not_passed_over(name: str) -> None:
    s = stresses(5, "float64")
    s.xx[3, 4] = np.nan
    numbers, values = largest(name, s)
    assert numbers[np.argmax(values)] == 3 * POINTS[1] + 4
    assert np.isnan(values.max())
