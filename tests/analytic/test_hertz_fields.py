"""Stresses below Hertz contacts, pressed and sliding: point and line forces summed, closed forms,
first yield."""

from __future__ import annotations

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.quadrature import gauss
from asperity.core.tensor import AXES, STRESSES
from asperity.theories.subsurface.hertz import (
    hertz_ellipse_normal,
    hertz_line_normal,
    hertz_line_shear,
    hertz_normal,
    hertz_shear,
)
from asperity.theories.subsurface.loads import boussinesq, cerruti, flamant_normal, flamant_tangential
from asperity.theories.subsurface.sliding_yield import cylinder_yield_onset, sphere_yield_onset

FRICTION, ONSET = reference("friction_yield"), reference("hertz_yield_onset")
BODY = {"shear": 0.7, "nu": 0.2}
POINTS = [(0.3, -0.2, 0.5), (1.2, 0.4, 0.7), (-2.0, 0.0, 0.3), (0.0, 0.0, 1.0)]


def components(fields):
    return [getattr(fields.displacement, a) for a in AXES] + [getattr(fields.stress, s) for s in STRESSES]


@pytest.mark.parametrize(("force", "field"), [(boussinesq, hertz_normal), (cerruti, hertz_shear)])
@pytest.mark.parametrize("point", POINTS, ids=str)
def test_the_circular_contact_is_a_sum_of_point_forces(force, field, point):
    """r = a sqrt(1 - s²) makes the traction polynomial; 80 x 256 points are exact to rounding at
    depths from 0.3 a on."""
    a, (x, y, z) = 1.0, point
    s, weight = gauss(np.array([0.0, 1.0]), 80)
    angle = (np.arange(256) + 0.5) * 2.0 * np.pi / 256
    r = a * np.sqrt(1.0 - s**2)[:, None]
    weight = (a**2 * s**2 * weight * 2.0 * np.pi / 256)[:, None]
    summed = components(force(x - r * np.cos(angle), y - r * np.sin(angle), z, **BODY))
    closed = components(field(np.array(x), np.array(y), z, a, **BODY))
    for one, other in zip(summed, closed, strict=True):
        assert np.sum(one * weight) == pytest.approx(float(other), abs=2e-14)


@pytest.mark.parametrize(
    ("force", "field"), [(flamant_normal, hertz_line_normal), (flamant_tangential, hertz_line_shear)]
)
@pytest.mark.parametrize("point", POINTS, ids=str)
def test_the_line_contact_is_a_sum_of_line_forces(force, field, point):
    """Displacements too, datum included. 400 points in the angle; rounding of some hundred terms of
    order ten."""
    a, (x, _, z) = 1.5, point
    angle, weight = gauss(np.array([-0.5 * np.pi, 0.5 * np.pi]), 400)
    weight = a * np.cos(angle) ** 2 * weight
    summed = components(force(x - a * np.sin(angle), z, **BODY))
    closed = components(field(np.array(x), z, a, **BODY))
    for one, other in zip(summed, closed, strict=True):
        assert np.sum(one * weight) == pytest.approx(float(other), abs=2e-13)


@pytest.mark.parametrize("point", [(0.3, 0.2, 0.3), (2.0, 1.0, 0.4), (-3.5, 0.0, 0.5), (0.0, 0.0, 0.4)], ids=str)
def test_the_elliptical_contact_is_a_sum_of_point_forces(point):
    """Ellipse 3 x 0.5; the sum of 80 x 512 forces is good for 1e-11 at depths from 0.6 b on."""
    (x, y, z), (a, b) = point, (3.0, 0.5)
    s, weight = gauss(np.array([0.0, 1.0]), 80)
    angle = (np.arange(512) + 0.5) * 2.0 * np.pi / 512
    r = np.sqrt(1.0 - s**2)[:, None]
    weight = (a * b * s**2 * weight * 2.0 * np.pi / 512)[:, None]
    summed = boussinesq(x - a * r * np.cos(angle), y - b * r * np.sin(angle), z, **BODY).stress
    closed = hertz_ellipse_normal(np.array(x), np.array(y), z, (a, b), nu=BODY["nu"])
    turned = hertz_ellipse_normal(np.array(y), np.array(x), z, (b, a), nu=BODY["nu"]).exchanged()
    for one in STRESSES:
        value = float(getattr(closed, one))
        assert np.sum(getattr(summed, one) * weight) == pytest.approx(value, abs=3e-11)
        assert float(getattr(turned, one)) == pytest.approx(value, abs=1e-14)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_circles_and_lines_are_ellipses(nu):
    rng = np.random.default_rng(1)
    x, y, z = rng.uniform([[-2.0], [-2.0], [-1.0]], 2.0, (3, 200))
    z = np.maximum(z, 0.0)  # a third on the surface
    ellipse = hertz_ellipse_normal(x, y, z, (1.0, 1.0), nu=nu)
    circle = hertz_normal(x, y, z, 1.0, shear=1.0, nu=nu).stress
    # a/b = 1e4: the pressure varies along the line by (1/1e4)², what is far away adds of the order
    # b/a
    slender = hertz_ellipse_normal(0.0 * y, y, z, (1e4, 1.0), nu=nu)
    line = hertz_line_normal(y, z, 1.0, shear=1.0, nu=nu).stress
    for one in STRESSES:
        assert getattr(ellipse, one) == pytest.approx(getattr(circle, one), abs=1e-11)
    for one, other in (("yy", "xx"), ("zz", "zz"), ("yz", "xz"), ("xx", "yy")):
        assert getattr(slender, one) == pytest.approx(getattr(line, other), abs=1e-3)


@pytest.mark.parametrize(
    ("ratio", "shear", "depth"), [(0.2, 0.322, 0.745), (0.4, 0.325, 0.665), (0.6, 0.323, 0.590), (0.8, 0.317, 0.530)]
)
def test_largest_shear_below_an_ellipse(ratio, shear, depth):
    """Johnson (1985, table 4.1) for ν = 0.3: three digits of τ/p0 and z/b, the last one rounded."""
    z = np.linspace(0.4, 0.9, 501) * ratio
    s = hertz_ellipse_normal(0.0 * z, 0.0 * z, z, (1.0, ratio), nu=0.3)
    principal = np.sort([s.xx, s.yy, s.zz], axis=0)
    tau = 0.5 * (principal[2] - principal[0])
    assert tau.max() == pytest.approx(shear, abs=1.5e-3)
    assert z[np.argmax(tau)] / ratio == pytest.approx(depth, abs=7e-3)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_closed_forms_on_the_surface_and_the_axis(nu):
    """Johnson (1985, eq. 3.41-3.47): independent formulas of the pressed contact, and of the shear
    on the surface."""
    x = np.array([0.02, 0.4, 0.9, 1.0, 1.5, 4.0])
    inside = np.minimum(x, 1.0)
    s = np.sqrt(1.0 - inside**2)
    ring = (1.0 - 2.0 * nu) / 3.0 / x**2 * (1.0 - s**3)
    fields = hertz_normal(x, 0.0 * x, 0.0, 1.0, shear=1.0, nu=nu)
    # (1 - s³)/x² of the check itself loses digits at x = 0.02
    assert fields.stress.zz == pytest.approx(-s, abs=1e-14)
    assert fields.stress.xx == pytest.approx(ring - s, abs=1e-12)
    assert fields.stress.yy == pytest.approx(-ring - 2.0 * nu * s, abs=1e-12)
    assert fields.displacement.x == pytest.approx(-ring * x / 2.0, abs=1e-12)  # (1 + ν)/E = 1/2G
    shear = hertz_shear(x[:4], 0.0 * x[:4], 0.0, 1.0, shear=1.0, nu=nu).stress
    assert shear.xx == pytest.approx(-0.5 * np.pi * (1.0 + 0.25 * nu) * x[:4], abs=1e-13)
    assert shear.yy == pytest.approx(-0.375 * np.pi * nu * x[:4], abs=1e-13)
    assert shear.xz == pytest.approx(-s[:4], abs=1e-13)
    z = np.array([0.0, 0.1, 0.48, 2.0])
    axis = hertz_normal(0.0 * z, 0.0 * z, z, 1.0, shear=1.0, nu=nu).stress
    radial = -((1.0 + nu) * (1.0 - z * np.arctan2(1.0, z)) - 0.5 / (1.0 + z**2))
    assert axis.zz == pytest.approx(-1.0 / (1.0 + z**2), abs=1e-14)
    assert axis.xx == pytest.approx(radial, abs=1e-14)
    line = hertz_line_normal(0.0 * z, z, 1.0, shear=1.0, nu=nu).stress
    root = np.sqrt(1.0 + z**2)
    assert line.xx == pytest.approx(-((1.0 + 2.0 * z**2) / root - 2.0 * z), abs=1e-14)
    assert line.zz == pytest.approx(-1.0 / root, abs=1e-14)


@pytest.mark.parametrize("field", [hertz_normal, hertz_shear])
def test_fields_are_in_equilibrium_everywhere(field):
    """Divergence by central differences of step 1e-4: truncation 1e-8 and rounding 1e-12 of
    stresses of order one."""
    h = 1e-4
    rng = np.random.default_rng(0)
    x, y, z = rng.uniform([[-2.0], [-2.0], [0.2]], 2.0, (3, 50))

    def derivative(one, axis):
        shift = [h * (axis == k) for k in range(3)]
        plus, minus = (
            getattr(field(x + n * shift[0], y + n * shift[1], z + n * shift[2], 1.0, shear=1.0, nu=0.3).stress, one)
            for n in (1, -1)
        )
        return (plus - minus) / (2.0 * h)

    for row in (("xx", "xy", "xz"), ("xy", "yy", "yz"), ("xz", "yz", "zz")):
        assert sum(derivative(one, axis) for axis, one in enumerate(row)) == pytest.approx(np.zeros(50), abs=1e-6)


@every_row(FRICTION, label=lambda row: f"nu{row['nu']:g}-mu{row['mu']:g}")
def test_friction_moves_first_yield(row):
    """The table is good to 1e-5; its places come from a search of its own, 1e-5 for smooth maxima,
    1e-3 on the surface.

    Its maxima below the surface are maxima only where yield starts there; else they lie where its
    search ended.
    """
    onset = sphere_yield_onset(row["nu"], row["mu"])
    assert onset.root_J2 == pytest.approx(row["sqrtJ2max_over_p0"], rel=1e-5)
    assert onset.peak_over_k == pytest.approx(row["p0_over_k"], rel=1e-5)
    assert onset.peak_over_Y == pytest.approx(row["p0_over_Y"], rel=1e-5)
    assert onset.surface_root_J2 == pytest.approx(row["sqrtJ2max_surface"], rel=1e-5)
    assert (onset.x, onset.z) == pytest.approx(
        (row["x_over_a"], row["z_over_a"]), abs=1e-3 if onset.at_surface else 1e-5
    )

    below = row["sqrtJ2max_subsurface"]
    assert below == pytest.approx(onset.root_J2, rel=1e-5) if not onset.at_surface else below < onset.root_J2
    x, y = np.array(-1.0), np.array(0.0)
    normal = hertz_normal(x, y, 0.0, 1.0, shear=1.0, nu=row["nu"])
    edge = (normal + hertz_shear(x, y, 0.0, 1.0, shear=1.0, nu=row["nu"]) * row["mu"]).stress
    assert edge.xx == pytest.approx(row["sigma_xx_trailing_edge_over_p0"], abs=1e-9)


@every_row(ONSET, label=lambda row: f"nu{row['nu']:g}")
def test_first_yield_without_friction(row):
    """On the axis sqrt(J2) = 2τ/√3; the place of a maximum is known to the root of the rounding,
    2e-8."""
    onset = sphere_yield_onset(row["nu"])
    assert onset.root_J2 * np.sqrt(3.0) / 2.0 == pytest.approx(row["tau_max_over_p0"], rel=1e-13)
    assert onset.z == pytest.approx(row["z_over_a"], abs=1e-7)
    assert onset.x == pytest.approx(0.0, abs=1e-7)
    assert onset.peak_over_Y == pytest.approx(row["p0_over_Y"], rel=1e-13)
    assert 2.0 / 3.0 * onset.peak_over_Y == pytest.approx(row["pm_over_Y"], rel=1e-13)
    assert onset.peak_over_k == pytest.approx(row["p0_over_k_mises"], rel=1e-13)
    # Tresca meets von Mises on the axis: k = Y/2 in place of Y/√3
    assert 2.0 * onset.peak_over_Y == pytest.approx(row["p0_over_k_tresca"], rel=1e-13)


@pytest.mark.parametrize(
    ("nu", "root_J2", "z"),
    [(0.2, 0.351209, 0.587), (0.3, 0.321882, 0.704), (0.4, 0.305561, 0.766), (0.5, 0.300283, 0.786)],
)
def test_first_yield_of_a_line_contact(nu, root_J2, z):
    """Six and three printed digits; ν = 0.5 is the largest shear stress in the plane, 0.300283 p0
    at 0.786 a."""
    onset = cylinder_yield_onset(nu)
    assert onset.root_J2 == pytest.approx(root_J2, abs=6e-7)
    assert onset.z == pytest.approx(z, abs=6e-4)


def test_a_line_contact_of_small_poisson_ratio_yields_on_the_surface():
    onset = cylinder_yield_onset(0.1)
    assert onset.at_surface
    assert onset.root_J2 == pytest.approx(0.8 / np.sqrt(3.0), rel=1e-12)
    with refused(InputError, "Poisson's ratio"):
        cylinder_yield_onset(0.6)


def test_reference_rows_exist():
    assert len(FRICTION) == 25
    assert len(ONSET) == 7
