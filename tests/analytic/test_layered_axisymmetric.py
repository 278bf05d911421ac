"""Axisymmetric loads on layered bodies, the rigid sphere on a layer (O'Sullivan & King 1988), the
sliding Hertz contact."""

import functools

import numpy as np
import pytest
from axisymmetric import Disc, Hertz, SphereOnLayer, fields
from elastic_fields import label
from layered_bodies import body_of, plane_of
from reference_data import every_row, reference

import asperity as asp
from asperity.physics.stress.criteria import max_shear, sqrt_J2
from asperity.physics.stress.regions import planes

AXISYMMETRIC = reference("layered_axisym_fields")
SPHERES, LARGEST = reference("sphere_layered_stress"), reference("sphere_layered_sqrtJ2_max")
ONSET, FRICTION = reference("hertz_yield_onset"), reference("friction_yield")


@functools.cache
def sphere(ratio, nu1, nu2, thickness):
    return SphereOnLayer(ratio, nu1, nu2, thickness)


def sphere_of(row):
    return sphere(row["E1_over_E2"], row["nu1"], row["nu2"], row["h_over_a0"])


@every_row(AXISYMMETRIC, label=label)
def test_disc_and_hertz_loads_on_layered_bodies(row):
    """The table is accurate to 1e-13 per unit pressure; 1e-12 adds the quadrature here. Worst
    found: 6e-13."""
    body = body_of(row)
    load = (Disc if row["load"] == "disc" else Hertz)(row["a"])
    u, s = fields(body, plane_of(row, body, row["z"]), load, row["r"])
    wanted = [row[name] for name in ("ur", "uz", "srr", "stt", "szz", "srz")]
    np.testing.assert_allclose([u.x, u.z, s.xx, s.yy, s.zz, s.xz], wanted, atol=1e-12, rtol=0)


@pytest.mark.slow
@every_row(SPHERES, label=label)
def test_stress_under_a_sphere_on_a_layer(row):
    """The table is accurate to 1e-10 over p0. Worst difference found: 5e-12."""
    indenter = sphere_of(row)
    plane = plane_of(row, indenter.body, row["z_over_h"] * row["h_over_a0"])
    (_, axis), (_, still), (_, shorn) = (
        fields(indenter.body, plane, indenter, x, mu) for x, mu in ((0.0, 0.0), (0.5, 0.0), (0.5, 1.0))
    )
    np.testing.assert_allclose([axis.zz, axis.xx], [row["szz_axis"], row["sxx_axis"]], atol=1e-10)
    for mu, name in ((0.0, "sxz_x05_mu0"), (0.25, "sxz_x05_mu025"), (0.5, "sxz_x05_mu05")):
        assert still.xz + mu * (shorn.xz - still.xz) == pytest.approx(row[name], abs=1e-10)
    for name in ("zz", "xx", "yy"):
        normal, both = getattr(still, name), getattr(shorn, name)
        assert normal == pytest.approx(row[f"s{name}_x05_normal"], abs=1e-10)
        assert both - normal == pytest.approx(row[f"s{name}_x05_shear_per_mu"], abs=1e-10)


@every_row(LARGEST, label=label)
def test_largest_stress_under_a_sliding_sphere_on_a_layer(row):
    """The table is accurate to 1e-7 (cusps at the edge of the contact). Worst difference found:
    3e-8.

    That it is the largest is checked on points around it in its region.
    """
    indenter, number = sphere_of(row), 0 if row["region"] == "layer" else 1
    h = row["h_over_a0"]

    def at(x, z):
        (plane,) = (p for p in planes(indenter.body, [z]) if p.region.index == number)
        return float(sqrt_J2(fields(indenter.body, plane, indenter, x, row["mu"])[1]))

    x, z = row["x_over_a0"], row["z_over_h"] * h
    value = at(x, z)
    assert value == pytest.approx(row["max_sqrtJ2_over_p0"], abs=1e-7)
    top = 0.0 if number == 0 else h
    assert at(row["x_top_plane_over_a0"], top) == pytest.approx(row["max_on_top_plane_over_p0"], abs=1e-7)
    low, high = (0.0, h) if number == 0 else (h, np.inf)
    for dx, dz in ((0.05, 0.0), (-0.05, 0.0), (0.0, 0.05), (0.0, -0.05)):
        if low <= z + dz <= high:
            assert at(x + dx, z + dz) < value


@every_row(FRICTION, label=lambda row: f"nu{row['nu']:g}-mu{row['mu']:g}")
def test_friction_moves_the_onset_of_yield_of_a_sphere(row):
    """Hankel integrals of the table to 1e-5 relative; found equal to rounding. The largest tension
    is in closed form."""
    body = asp.Layered([], asp.Elastic(1.0, row["nu"]))
    x, z = row["x_over_a"], row["z_over_a"]

    def at(x, z):
        return fields(body, planes(body, [z])[0], Hertz(1.0), x, row["mu"])[1]

    value = float(sqrt_J2(at(x, z)))
    assert value == pytest.approx(row["sqrtJ2max_over_p0"], rel=1e-5)
    assert 1.0 / value == pytest.approx(row["p0_over_k"], rel=1e-5)
    assert 1.0 / (np.sqrt(3.0) * value) == pytest.approx(row["p0_over_Y"], rel=1e-5)
    edge = (1 - 2 * row["nu"]) / 3 + (4 + row["nu"]) / 8 * np.pi * row["mu"]
    assert at(-1.0, 0.0).xx == pytest.approx(edge, abs=1e-9)
    assert row["sigma_xx_trailing_edge_over_p0"] == pytest.approx(edge, abs=1e-9)


@every_row(ONSET, label=lambda row: f"nu{row['nu']:g}")
def test_onset_of_yield_of_a_sphere(row):
    """All digits of the table are good; second order around the maximum leaves the depth's rounding
    out."""
    body = asp.Layered([], asp.Elastic(1.0, row["nu"]))
    s = fields(body, planes(body, [row["z_over_a"]])[0], Hertz(1.0), 0.0)[1]
    assert max_shear(s) == pytest.approx(row["tau_max_over_p0"], rel=1e-10)
    assert 0.5 / max_shear(s) == pytest.approx(row["p0_over_Y"], rel=1e-10)
    zeta = row["z_over_a"]
    assert s.zz == pytest.approx(-1.0 / (1.0 + zeta**2), rel=1e-12)
    radial = -((1 + row["nu"]) * (1 - zeta * np.arctan(1 / zeta)) - 0.5 / (1 + zeta**2))
    assert s.xx == pytest.approx(radial, abs=1e-12)


def test_reference_rows_exist():
    assert len(AXISYMMETRIC) == 221
    assert len(SPHERES) == 104
    assert len(LARGEST) == 30
    assert len(FRICTION) == 25
    assert len(ONSET) == 7
