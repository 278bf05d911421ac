"""Point forces, line forces and strips: independent numbers, equilibrium, resultants."""

import numpy as np
import pytest
from elastic_fields import constants, expected, found, label
from reference_data import every_row, reference

from asperity.theories.subsurface import loads as line_loads
from asperity.theories.subsurface import loads as point_loads

POINTS, LINES = reference("point_loads"), reference("line_and_strip_loads")
KINDS = {
    "flamant_normal": line_loads.flamant_normal,
    "flamant_tangential": line_loads.flamant_tangential,
    "strip_normal": line_loads.strip_pressure,
    "strip_tangential": line_loads.strip_shear,
}


@every_row(POINTS, label=label)
def test_point_forces_agree_with_the_verified_closed_forms(row):
    """All digits of the table are good; 1e-14 of the largest field are some ten roundings. Worst
    found: 7e-16."""
    fields = found(getattr(point_loads, row["kind"])(row["x"], row["y"], row["z"], **constants(row)))
    np.testing.assert_allclose(fields, expected(row), atol=1e-14 * np.abs(expected(row)).max(), rtol=0)


@every_row(LINES, label=label)
def test_line_forces_and_strips_agree_with_quadrature(row):
    """Displacements relative to (0, 1). Quadrature in 22 digits; worst error found: 1e-15 of the
    largest field."""
    width = (row["a"],) if row["kind"].startswith("strip") else ()
    here, datum = (KINDS[row["kind"]](x, z, *width, **constants(row)) for x, z in ((row["x"], row["z"]), (0.0, 1.0)))
    u, u0, s = here.displacement, datum.displacement, here.stress
    values = np.array([u.x - u0.x, u.z - u0.z, s.xx, s.yy, s.zz, s.xz])
    wanted = np.array([row[name] for name in ("dux", "duz", "sxx", "syy", "szz", "sxz")])
    np.testing.assert_allclose(values, wanted, atol=1e-14 * np.abs(wanted).max(), rtol=0)


def test_reference_rows_exist():
    assert len(POINTS) >= 30
    assert {row["kind"] for row in LINES} == set(KINDS)


@pytest.mark.parametrize(("load", "axis"), [(point_loads.boussinesq, "zz"), (point_loads.cerruti, "xz")])
def test_a_hemisphere_carries_the_force(load, axis):
    """Traction of a hemisphere of radius 1 around the force sums to -1 along it; Gauss rule, exact
    to rounding."""
    cosine, weight = np.polynomial.legendre.leggauss(24)
    cosine, weight = 0.5 * (cosine + 1.0), 0.5 * weight
    angle = np.arange(32) * 2.0 * np.pi / 32
    z, sine = cosine[:, None], np.sqrt(1.0 - cosine[:, None] ** 2)
    x, y = sine * np.cos(angle), sine * np.sin(angle)
    s = load(x, y, z, shear=1.0, nu=0.3).stress
    traction = s.xz * x + s.yz * y + s.zz * z if axis == "zz" else s.xx * x + s.xy * y + s.xz * z
    assert (traction * weight[:, None]).sum() * 2.0 * np.pi / 32 == pytest.approx(-1.0, abs=1e-13)


def test_strips_tile_and_far_away_are_lines():
    whole = line_loads.strip_shear(np.array(0.3), 0.7, 2.0, shear=1.0, nu=0.2)
    halves = [line_loads.strip_shear(np.array(0.3) + d, 0.7, 1.0, shear=1.0, nu=0.2) for d in (-1.0, 1.0)]
    np.testing.assert_allclose(found(whole).ravel()[3:], found(halves[0] + halves[1]).ravel()[3:], atol=1e-15)
    far = line_loads.strip_pressure(np.array(300.0), 400.0, 0.5, shear=1.0, nu=0.2).stress
    line = line_loads.flamant_normal(np.array(300.0), 400.0, shear=1.0, nu=0.2).stress
    assert far.zz == pytest.approx(line.zz, rel=1e-5)  # (half width / distance)² = 1e-6 times a number of order one
