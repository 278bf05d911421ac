"""Bounds of stresses in blocks of points: never below the exact values, tight where that decides how much is searched."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from asperity.core.tensor import StressTensor
from asperity.stress import criteria as invariants
from asperity.stress.kernels.planes import BLOCK, BOUNDS, block_bounds

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


def bounds(components):
    flat = tuple(np.ascontiguousarray(c) for c in components)
    out = np.empty((-(-flat[0].size // BLOCK), len(BOUNDS)))
    block_bounds((0, len(out)), flat, out)
    return dict(zip(BOUNDS, out.T, strict=True))


@given(
    values=st.lists(st.lists(st.floats(-1e3, 1e3), min_size=6, max_size=6), min_size=1, max_size=5),
    pressure=st.sampled_from([0.0, 1.0, -1e5]),
)
@settings(max_examples=100, deadline=None)
def test_bounds_hold_for_any_stress(values, pressure):
    """Rounding of sums of squares: 64 epsilon of the largest component; cubes of 1e-103 Pa are zero."""
    components = np.array(values).T.copy()
    components[:3] += pressure
    found, tensor = bounds(components), StressTensor(*components)
    rounding = 64 * np.finfo(float).eps * np.abs(components).max() + 1e-100
    for name, exact in EXACT.items():
        assert found[name][0] >= exact(tensor).max() - rounding, name


@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_bounds_of_blocks(dtype):
    """All but tension and shear are the largest values; those two exceed them by a few per cent of √J2."""
    components = np.random.default_rng(0).standard_normal((6, 3 * BLOCK + 17)).astype(dtype)
    found, tensor = bounds(components), StressTensor(*components)
    for name, exact in EXACT.items():
        values = exact(tensor)
        largest = [values[k : k + BLOCK].max() for k in range(0, values.size, BLOCK)]
        if name in ("tension", "shear"):
            assert np.all(found[name] >= np.array(largest) * (1 - 1e-6))
            assert np.all(found[name] <= np.array(largest) * 1.15)
        else:
            np.testing.assert_allclose(found[name], largest, rtol=1e-5 if dtype == "float32" else 1e-13)


def test_bounds_are_tight_under_uniaxial_strain():
    """Far below a contact σxx = σyy > σzz: the bound of tension is exact there, or every point would have to be searched."""
    spread = 1e-3 * np.random.default_rng(1).standard_normal((6, BLOCK))
    components = np.array([-0.4, -0.4, -1.0, 0.0, 0.0, 0.0])[:, None] + spread
    tension = EXACT["tension"](StressTensor(*components)).max()
    assert tension <= bounds(components)["tension"][0] <= tension + 1e-4
