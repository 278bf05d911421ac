"""The search for the largest stress of a plane: no point is missed, whatever the stresses are."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from asperity.core.tensor import StressTensor
from asperity.physics.stress import criteria as invariants
from asperity.physics.stress.kernels.extremes import CLOSE, QUANTITIES, candidates, overview

EXACT = {
    "von_mises": invariants.von_mises,
    "tension": lambda s: invariants.principal_stresses(s)[0],
    "shear": invariants.max_shear,
    "in_plane": invariants.principal_tensile,
    "shear_xz": lambda s: np.abs(s.xz),
    "shear_yz": lambda s: np.abs(s.yz),
    "traction": lambda s: np.hypot(s.xz, s.yz),
    "zz": lambda s: s.zz,
}


def of_rows(name, rows):
    """Exact values of the quantity ``name`` at all points of ``rows`` (6, n, m)."""
    return EXACT[name](StressTensor(*rows.astype(float)))


def search(name, rows, least):
    """Largest value among the candidates, evaluated exactly, and whether the overview admits one
    above ``least``."""
    number = QUANTITIES.index(name)
    bounds = np.full(len(QUANTITIES), np.inf)
    bounds[number] = least
    beyond, _, _ = overview(rows, bounds, True)
    places, _, _ = candidates(number, rows, least)
    exact = of_rows(name, rows)
    return max((exact[i, k] for i, k in places), default=-np.inf), bool(beyond[number])


@given(
    values=st.lists(st.lists(st.floats(-1e3, 1e3), min_size=6, max_size=6), min_size=1, max_size=6),
    pressure=st.sampled_from([0.0, 1.0, -1e5]),
)
@settings(max_examples=100, deadline=None)
def test_the_largest_is_found_for_any_stress(values, pressure):
    """Down to the rounding of sums of squares, 64 epsilon of the largest component, and what
    trigonometry may be wrong by."""
    rows = np.array(values).T.copy()[:, None, :]
    rows[:3] += pressure
    largest = np.abs(rows).max()
    slack = 64 * np.finfo(float).eps * largest + CLOSE * largest + 1e-100
    for name in QUANTITIES:
        wanted = of_rows(name, rows).max()
        found, _ = search(name, rows, -np.inf)
        assert found >= wanted - slack, name


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("name", QUANTITIES)
def test_many_points(name, dtype):
    """What is known already is found no more; anything above it is, at more than two runs of points
    of a row."""
    rows = np.random.default_rng(0).standard_normal((6, 5, 600)).astype(dtype)
    exact = of_rows(name, rows)
    slack = 1e-6  # rounding of single precision, and what trigonometry may be wrong by
    wanted = exact.max()
    found, beyond = search(name, rows, wanted - 0.05)
    assert beyond
    assert found >= wanted - slack
    if name not in ("tension", "shear"):  # these are compared with bounds that lie above them
        assert not search(name, rows, wanted + 10.0 * slack)[1]
    assert search(name, rows, wanted + 10.0 * slack)[0] == -np.inf


def test_few_points_are_looked_at_under_uniaxial_strain():
    """Far below a contact σxx = σyy > σzz: the bound of tension is nearly exact there, or every
    point would be a candidate."""
    spread = 1e-3 * np.random.default_rng(1).standard_normal((6, 8, 512))
    rows = np.array([-0.4, -0.4, -1.0, 0.0, 0.0, 0.0])[:, None, None] + spread
    places, values, _ = candidates(QUANTITIES.index("tension"), rows, -np.inf)
    assert len(places) < 20
    assert values.max() == pytest.approx(of_rows("tension", rows).max(), rel=1e-9)
