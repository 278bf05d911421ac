"""Sliding and sticking contacts of dissimilar bodies, elliptic punch, conforming contacts: against
the solver and integrals."""

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.core.quadrature import gauss
from asperity.theories import (
    CylinderInHole,
    EllipticPunch,
    FlatPunch,
    HertzLine,
    HertzPoint,
    LineFlatPunch,
    PinInHole,
    PowerLawIndenter,
    SlidingCylinder,
    SlidingPunch,
    SphereInCavity,
    StickingIndenter,
    StickingPunch,
    StickingPunchLine,
)

BODY = asp.Elastic(0.91, 0.3)
"""E* = 1 under a rigid indenter."""

BETA = 0.4 / 1.4
"""(1 - 2ν)/2(1 - ν)."""


def row(n, length=2.4):
    grid = asp.Grid((n, 1), (length / n, length / n))
    return grid, grid.coordinates()[0] - 0.5 * (n - 1) * length / n


@pytest.mark.parametrize("friction", [0.5, 1.5])
def test_sliding_cylinder_against_the_solver(friction):
    """800 pixels on the contact; its ends are known to a pixel, and the pressure is compared away
    from them."""
    theory = SlidingCylinder(1.0, 50.0, BETA, friction)
    load = 1.0 / float(theory.at_load(1.0).radius) ** 2  # half-width 1
    grid, x = row(1120, 2.8)
    pixel = grid.spacing[0]
    profile = -(x**2) / 100.0
    problem = asp.ContactProblem(
        asp.Surface(profile, *grid.spacing), BODY, boundary=asp.FreeLine(), friction=asp.Coulomb(friction)
    )
    result = asp.solve(
        problem, asp.MeanPressure(load / grid.size[0]), rounds=asp.solvers.Rounds(tolerances={"sliding": 1e-6})
    )
    answer = theory.at_load(load)
    assert float(answer.radius) == pytest.approx(1.0)
    ends = x[result.contact[:, 0], 0][[0, -1]]
    middle = theory.shift
    assert ends == pytest.approx([middle - 1.0, middle + 1.0], abs=1.5 * pixel)
    inside = np.abs(x - middle) < 0.9
    expected = theory.pressure(x, load)
    assert result.pressure[inside] == pytest.approx(expected[inside], rel=3e-3)
    assert result.max_pressure == pytest.approx(float(answer.max_pressure), rel=1e-3)


def test_sliding_contacts_without_coupling_are_those_without_friction():
    x, load = np.linspace(-0.99, 0.99, 9), 0.25 * np.pi / 50.0
    for theory in (SlidingCylinder(1.0, 50.0, 0.0, 0.7), SlidingCylinder(1.0, 50.0, 0.3, 0.0)):
        hertz = HertzLine(1.0, 50.0)
        assert theory.pressure(x, load) == pytest.approx(hertz.pressure(x, load), rel=1e-12)
        assert theory.at_load(load).max_pressure == pytest.approx(hertz.at_load(load).max_pressure, rel=1e-12)
    punch = SlidingPunch(1.0, 1.0, 0.0, 0.7)
    assert punch.pressure(x, load) == pytest.approx(LineFlatPunch(1.0, 1.0).pressure(x, load), rel=1e-12)


def test_tractions_of_punches_move_the_surface_as_a_rigid_punch():
    """Slope of the normal displacement under the punch, and that of the tangential one where it
    sticks, from 4000 pixels."""
    grid, x = row(4000, 2.0)
    inside = np.abs(x[:, 0]) < 0.8
    ends = np.concatenate([x[:, 0] - 0.5 * grid.spacing[0], [1.0]])
    t, w = gauss(np.stack([ends[:-1], ends[1:]], axis=-1), 8)
    t = np.clip(t, -1.0 + 1e-15, 1.0 - 1e-15)

    def mean(values):
        return np.sum(w * values, axis=-1)[:, None] / grid.spacing[0]

    sliding, sticking = SlidingPunch(1.0, 1.0, BETA, 0.8), StickingPunchLine(1.0, 1.0, BETA)
    cases = {
        "sliding": (mean(sliding.pressure(t, 1.0)), 0.8 * mean(sliding.pressure(t, 1.0))),
        "sticking": (mean(sticking.pressure(t, 1.0)), mean(sticking.traction(t, 1.0))),
    }
    for name, (p, q) in cases.items():
        assert p.sum() * grid.spacing[0] == pytest.approx(1.0, rel=0.02), name  # the edges are singular
        shear = asp.stresses.ShearTraction(q, np.zeros_like(q))
        loaded = asp.stresses.LoadedBody(BODY, asp.stresses.Tractions(grid, p, shear, "free line"))
        moved = asp.stress(loaded, [0.0], displacement=True).displacement
        assert np.ptp(moved.z[0, inside]) < 3e-3, name  # the frictionless punch of this load sinks by about ln 2
        if name == "sticking":
            assert np.ptp(moved.x[0, inside]) < 3e-3
            assert np.abs(q).max() > 0.05
    assert float(np.sum(w * t * sliding.pressure(t, 1.0))) == pytest.approx(sliding.centre, abs=5e-3)


def test_round_punch_without_slip():
    """Tractions on pixels of a/48: the displacements under the punch are those of a rigid one to
    the size of the pixel."""
    theory = StickingPunch(1.0, 1.0, BETA)
    load = float(theory.at_load(0.0).stiffness)  # approach 1
    r, w = gauss(np.stack([1.0 - 0.5 ** np.arange(30.0), 1.0 - 0.5 ** np.arange(1.0, 31.0)], axis=-1), 12)
    assert float(np.sum(w * 2.0 * np.pi * r * theory.pressure(r, load))) == pytest.approx(load, rel=1e-4)
    n = 97
    grid = asp.Grid((n, n), (2.04 / n, 2.04 / n))
    x, y = grid.centred_coordinates()
    fine = ((np.arange(6) + 0.5) / 6.0 - 0.5) * grid.spacing[0]
    X, Y = (v[..., None, None] + f for v, f in ((x, fine[:, None]), (y, fine)))
    distance = np.hypot(X, Y)
    table = np.sin(np.linspace(1e-3, 0.5 * np.pi, 2000)[:-1])  # of values times the root that they are infinite with
    root = np.sqrt(np.clip(1.0 - distance**2, 1e-9, None))
    p, q = (
        np.where(distance < 1.0, np.interp(distance, table, f(table, load) * np.sqrt(1.0 - table**2)) / root, 0.0)
        for f in (theory.pressure, theory.traction)
    )
    qx, qy = ((q * part / np.maximum(distance, 1e-9)).mean(axis=(2, 3)) for part in (X, Y))
    p = p.mean(axis=(2, 3)) * np.ones(grid.shape)
    loaded = asp.stresses.LoadedBody(BODY, asp.stresses.Tractions(grid, p, asp.stresses.ShearTraction(qx, qy), "free"))
    moved = asp.stress(loaded, [0.0], displacement=True).displacement
    inside = np.hypot(x, y) < 0.7
    assert moved.z[0][inside] == pytest.approx(1.0, rel=0.02)
    assert np.abs(moved.x[0][inside]).max() < 0.01
    without = asp.stress(
        asp.stresses.LoadedBody(BODY, asp.stresses.Tractions(grid, p, boundary="free")), [0.0], displacement=True
    ).displacement
    assert np.abs(without.x[0][inside]).max() > 0.05


@every_row(reference("friction/full_stick_power_law"), label=lambda row: f"case{row['case']:g}")
def test_indenters_without_slip(row):
    if row["n"] == 0:
        assert StickingPunch(1.0, 1.0, row["beta"]).gain == pytest.approx(row["C_flat"], rel=1e-12)
        return
    theory = StickingIndenter(1.0, 0.1, row["n"], row["beta"])
    assert theory.approach_gain == pytest.approx(row["delta_ratio_same_a"], rel=1e-9)
    assert theory.load_gain == pytest.approx(row["P_ratio_same_a"], rel=1e-9)
    free = PowerLawIndenter(1.0, 0.1, row["n"]).at_load(0.02)
    stuck = theory.at_load(0.02)
    assert stuck.radius / free.radius == pytest.approx(row["a_ratio_same_P"], rel=1e-9)
    ahead, behind = (theory.at_load(0.02 * f).approach for f in (1.0 + 1e-4, 1.0 - 1e-4))
    assert 0.02 * 2e-4 / (ahead - behind) == pytest.approx(stuck.stiffness, rel=1e-6)


def test_elliptic_punch_against_the_solver():
    """The staircase edge is uncertain by half a pixel, and so is the load."""
    theory = EllipticPunch(1.0, 1.0, 0.5)
    grid = asp.Grid((128, 64), (2.2 / 128, 1.1 / 64))
    x, y = grid.centred_coordinates()
    punch = np.where(x**2 + (2.0 * y) ** 2 <= 1.0, 0.0, -1.0)
    problem = asp.ContactProblem(asp.Surface(punch, *grid.spacing), BODY, boundary=asp.Free())
    result = asp.solve(problem, asp.Approach(0.01))
    expected = theory.at_approach(0.01)
    assert result.pressure.sum() * grid.pixel_area == pytest.approx(float(expected.load), rel=grid.spacing[0])
    inside = x**2 + (2.0 * y) ** 2 < 0.6
    near = theory.pressure(x, y, float(expected.load))
    assert result.pressure[inside] == pytest.approx(near[inside], rel=0.02)


def test_round_elliptic_punch():
    punch, round_ = EllipticPunch(1.0, 2.0, 2.0), FlatPunch(1.0, 2.0)
    for quantity in ("load", "approach", "radius", "area", "max_pressure", "stiffness"):
        one, other = (getattr(theory.at_load([0.0, 0.3]), quantity) for theory in (punch, round_))
        assert one == pytest.approx(other, rel=1e-14)
    turned = EllipticPunch(1.0, 0.3, 2.0), EllipticPunch(1.0, 2.0, 0.3)
    assert turned[0].stiffness == turned[1].stiffness


def test_cylinder_in_hole_against_the_solver():
    theory = CylinderInHole(1.0, 1.0, 1.1)
    answer = theory.at_half_width(0.6)
    load = float(answer.load)
    grid, x = row(700, 1.4)
    inner = np.minimum(np.abs(x), 0.99)
    gap = (1.0 - np.sqrt(1.0 - inner**2)) - (1.1 - np.sqrt(1.1**2 - inner**2))
    problem = asp.ContactProblem(asp.Surface(-gap, *grid.spacing), BODY, boundary=asp.FreeLine())
    result = asp.solve(problem, asp.MeanPressure(load / grid.size[0]))
    assert result.contact.sum() * grid.spacing[0] == pytest.approx(1.2, abs=2.0 * grid.spacing[0])
    assert result.max_pressure == pytest.approx(float(answer.max_pressure), rel=1e-3)
    inside = np.abs(x) < 0.5
    assert result.pressure[inside] == pytest.approx(theory.pressure(x, load)[inside], rel=2e-3)


def test_load_of_the_cylinder_in_a_hole_is_the_difference_of_elliptic_integrals():
    from scipy.special import ellipe, ellipk

    theory, a = CylinderInHole(1.0, 1.0, 1.1), np.array([0.1, 0.5, 0.9])
    sums = [R * (ellipk((a / R) ** 2) - ellipe((a / R) ** 2)) for R in (1.0, 1.1)]
    assert theory.at_half_width(a).load == pytest.approx(sums[0] - sums[1], rel=1e-9)
    load = float(theory.at_half_width(0.5).load)
    x, w = gauss(np.array([0.0, 0.5]), 200)
    assert 2.0 * float(np.sum(w * theory.pressure(x, load))) == pytest.approx(load, rel=1e-6)


def test_sphere_in_cavity_against_the_solver():
    theory = SphereInCavity(1.0, 1.0, 1.2)
    answer = theory.at_radius(0.5)
    n = 96
    grid = asp.Grid((n, n), (1.2 / n, 1.2 / n))
    x, y = grid.centred_coordinates()
    r2 = np.minimum(x**2 + y**2, 0.98)
    gap = (1.0 - np.sqrt(1.0 - r2)) - (1.2 - np.sqrt(1.44 - r2))
    problem = asp.ContactProblem(asp.Surface(-gap, *grid.spacing), BODY, boundary=asp.Free())
    result = asp.solve(problem, asp.Force(float(answer.load)))
    assert result.approach == pytest.approx(float(answer.approach), rel=2e-3)
    assert result.max_pressure == pytest.approx(float(answer.max_pressure), rel=2e-3)
    assert np.sqrt(result.contact_area / np.pi) == pytest.approx(0.5, rel=0.02)


@pytest.mark.parametrize("angle", [0.7, 1.3])
def test_pin_in_hole_satisfies_the_contact_condition(angle):
    """A pressure p_n cos nθ opens disc and hole by (2R/E*) n/(n² - 1) p_n, and R p_0/E* (Michell);
    the rest is a shift.

    2000 harmonics of a pressure that ends like a root leave 1e-5 of the clearance's order.
    """
    theory = PinInHole(1.0, 1.0, 1.001)
    load = next(P for P in 10.0 ** np.linspace(-6.0, 2.0, 1000) if float(theory.angle(P)) >= angle)
    width = float(theory.angle(load))
    s, w = gauss(np.array([0.0, 0.5 * np.pi]), 800)
    theta, w = width * np.sin(s), w * width * np.cos(s)
    p = theory.pressure(theta, load)
    assert 2.0 * float(np.sum(w * p * np.cos(theta))) == pytest.approx(load, rel=1e-9)
    n = np.arange(2, 2000)
    coefficients = 2.0 / np.pi * (np.cos(np.outer(n, theta)) @ (w * p))
    at = width * np.linspace(0.0, 0.9, 10)
    opened = np.cos(np.outer(at, n)) @ (2.0 * n / (n**2 - 1.0) * coefficients) + np.sum(w * p) / np.pi
    # opened + clearance - shift cos θ = 0
    fit, *_ = np.linalg.lstsq(np.stack([np.ones_like(at), -np.cos(at)], axis=1), -opened, rcond=None)
    residual = opened + fit[0] - fit[1] * np.cos(at)
    assert np.abs(residual).max() < 5e-3 * np.ptp(opened)
    assert fit[0] == pytest.approx(0.001, rel=5e-3)


def test_narrow_pin_is_that_of_hertz_and_no_load_is_wider_than_the_limit():
    pin = PinInHole(1.0, 1.0, 1.001)
    hertz = HertzLine(1.0, 1.0 / (1.0 - 1.0 / 1.001)).at_load(1e-8)
    answer = pin.at_load(1e-8)
    assert answer.radius == pytest.approx(float(hertz.radius), rel=2e-3)
    assert answer.max_pressure == pytest.approx(float(hertz.max_pressure), rel=2e-3)
    assert np.degrees(pin.largest_angle) == pytest.approx(84.9, abs=0.1)
    assert pin.angle(1e9) == pytest.approx(pin.largest_angle, rel=1e-6)


def test_conforming_contacts_of_small_arcs_are_those_of_hertz():
    hole, cavity = CylinderInHole(1.0, 1.0, 1.1), SphereInCavity(1.0, 1.0, 1.1)
    line, point = HertzLine(1.0, 11.0).at_half_width(1e-2), HertzPoint(1.0, 11.0).at_radius(1e-2)
    assert hole.at_half_width(1e-2).load == pytest.approx(float(line.load), rel=2e-4)
    assert hole.at_half_width(1e-2).max_pressure == pytest.approx(float(line.max_pressure), rel=2e-4)
    assert cavity.at_radius(1e-2).load == pytest.approx(float(point.load), rel=3e-4)
    assert hole.at_load(line.load).radius == pytest.approx(1e-2, rel=2e-4)


def test_refusals():
    with refused(InputError, "radius of the hole (m)"):
        PinInHole(1.0, 1.0, 0.9)
    with refused(InputError, "half-width"):
        CylinderInHole(1.0, 1.0, 1.1).at_half_width(1.0)
    with refused(InputError, "load of a cylinder in a hole"):
        CylinderInHole(1.0, 1.0, 1.1).at_load(1e9)
    with refused(InputError, "load of a sphere in a cavity"):
        SphereInCavity(1.0, 1.0, 1.1).at_load(1e9)
    with refused(InputError, "distance from the axis"):
        StickingPunch(1.0, 1.0, 0.2).pressure(1.0, 1.0)
    with refused(InputError, "place under the punch"):
        StickingPunchLine(1.0, 1.0, 0.2).pressure(1.0, 1.0)
    with refused(InputError, "beta of sticking-punch"):
        StickingPunch(1.0, 1.0, 1.0)
