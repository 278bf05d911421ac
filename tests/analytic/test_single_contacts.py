"""Closed forms of single contacts: every reference row, equilibrium, limits of one theory in
another."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.quadrature import gauss
from asperity.theories.ask import evaluate
from asperity.theories.friction.partial_slip import MindlinLine, MindlinPoint, tangential_modulus
from asperity.theories.single.hertz import HertzBodies, HertzEllipse, HertzLine, HertzPoint, axis_ratio
from asperity.theories.single.indenters import (
    FlatPunch,
    LineFlatPunch,
    LinePowerLawIndenter,
    PowerLawIndenter,
    SphericalIndenter,
)
from asperity.theories.single.waves import AREA_ERROR, CrossedWaves, Westergaard

DIGITS = 1e-13  # the tables carry 16 digits; some hundred roundings in the longest formulas (found: 3e-14)
AXISYMMETRIC, PLANE = reference("axisymmetric_indenters"), reference("plane_strain_indenters")
MINDLIN, JGH = reference("cattaneo_mindlin"), reference("johnson_greenwood_higginson")


def name(row):
    return f"case{row['case']:g}"


def indenter(row):
    if row["shape"] == "flat":
        return FlatPunch(row["E_star"], row["a"])
    if row["shape"] == "sphere_exact":
        return SphericalIndenter(row["E_star"], row["R"])
    return PowerLawIndenter(row["E_star"], row["B"], row["n"])


@every_row(reference("hertz_elliptical"), label=name)
def test_ellipse(row):
    theory = HertzEllipse(row["E_star"], row["R_x"], row["R_y"])
    answer = theory.at_load(row["P"])
    assert np.array(theory.semi_axes(row["P"])) == pytest.approx([row["a"], row["b"]], rel=DIGITS)
    assert answer.max_pressure == pytest.approx(row["p0"], rel=DIGITS)
    assert answer.approach == pytest.approx(row["delta"], rel=DIGITS)
    assert theory.eccentricity == pytest.approx(row["eccentricity"], rel=DIGITS)
    turned = HertzEllipse(row["E_star"], row["R_y"], row["R_x"])
    assert np.array(turned.semi_axes(row["P"])) == pytest.approx([row["b"], row["a"]], rel=DIGITS)
    assert turned.pressure(0.5 * row["b"], 0.5 * row["a"], row["P"]) == pytest.approx(
        row["p0"] / np.sqrt(2.0), rel=1e-12
    )


@every_row(reference("hertz_elliptical"), label=name)
def test_answers_of_an_ellipse_hold_its_semi_axes(row):
    columns = {
        c.name: v[0] for c, v in evaluate(HertzEllipse(row["E_star"], row["R_x"], row["R_y"]), load=[row["P"]]).columns
    }
    assert [columns["semi_x"], columns["semi_y"]] == pytest.approx([row["a"], row["b"]], rel=DIGITS)


@given(
    curvatures=st.tuples(st.floats(0.0, 1e3), st.floats(1.0, 1e3), st.floats(-0.4, 1e3), st.floats(1.0, 1e3)),
    angle=st.floats(-7.0, 7.0),
)
def test_two_bodies_have_the_curvatures_of_their_gap(curvatures, angle):
    """Against the eigenvalues of the sum of both tensors of curvature, the second one turned."""
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    curvatures = [0.0 if abs(kappa) < 1e-9 else kappa for kappa in curvatures]
    tensor = np.diag(curvatures[:2]) + turn @ np.diag(curvatures[2:]) @ turn.T
    (flat, steep), axes = np.linalg.eigh(tensor)
    assume(flat > 1e-3)
    bodies = HertzBodies(1e9, *(math.inf if kappa == 0.0 else 1.0 / kappa for kappa in curvatures), angle)
    rounding = 1e-14 * (abs(flat) + abs(steep))
    assert [1.0 / bodies.radius_x, 1.0 / bodies.radius_y] == pytest.approx([flat, steep], rel=1e-12, abs=rounding)
    if steep - flat > 1e-3 * steep:
        along = np.array([math.cos(bodies.turn), math.sin(bodies.turn)])
        assert abs(along @ axes[:, 0]) == pytest.approx(1.0, abs=1e-8)
    answer, ellipse = bodies.at_load(2.0), HertzEllipse(1e9, bodies.radius_x, bodies.radius_y).at_load(2.0)
    assert (answer.semi_x, answer.semi_y, answer.approach) == (ellipse.semi_x, ellipse.semi_y, ellipse.approach)


def test_spheres_and_cylinders_as_two_bodies():
    """Equal crossed cylinders are a sphere on a plane; parallel ones a line contact, which is
    refused as a ball too wide for its cup."""
    crossed = HertzBodies(1e9, math.inf, 0.01, math.inf, 0.01, 0.5 * math.pi).at_load(3.0)
    ball = HertzPoint(1e9, 0.01).at_load(3.0)
    assert [crossed.radius, crossed.approach] == pytest.approx([float(ball.radius), float(ball.approach)], rel=1e-12)
    for radii in ((math.inf, 0.01, math.inf, 0.01), (0.02, 0.02, -0.01, -0.01), (0.0, 1.0, 1.0, 1.0)):
        with refused(InputError, "principal radii (m)"):
            HertzBodies(1e9, *radii)


@given(radius=st.floats(1e-9, 1e3), load=st.floats(1e-12, 1e6), modulus=st.floats(1e3, 1e13))
def test_a_circle_is_an_ellipse(radius, load, modulus):
    circle, ellipse = HertzPoint(modulus, radius).at_load(load), HertzEllipse(modulus, radius, radius).at_load(load)
    for quantity in ("approach", "radius", "area", "max_pressure", "stiffness", "load"):
        assert getattr(ellipse, quantity) == pytest.approx(getattr(circle, quantity), rel=1e-12)


def test_nearly_circular_and_very_slender_ellipses():
    """ln(b/a) = -(2/3) ln(B/A) to first order; B/A ~ (a/b)²/(ln 4a/b - 1), whose error is of the
    order (b/a)²."""
    assert 1.0 - axis_ratio(1.0 + 1e-7) == pytest.approx(2.0 / 3.0 * 1e-7, rel=1e-6)
    slender = axis_ratio(1e9)
    assert slender**-2 / (np.log(4.0 / slender) - 1.0) == pytest.approx(1e9, rel=1e-6)
    with refused(InputError, "ratio of the curvatures"):
        axis_ratio(0.5)


def test_hertz_in_three_ways():
    theory = HertzPoint(E_star=70e9, radius=1e-3)
    answer = theory.at_load([1e-3, 2.0])
    for again in (
        theory.at_approach(answer.approach),
        theory.at_radius(answer.radius),
        theory.at_peak(answer.max_pressure),
    ):
        assert again.load == pytest.approx(answer.load, rel=1e-13)
    assert answer.mean_pressure == pytest.approx(2.0 / 3.0 * answer.max_pressure, rel=1e-13)
    step = 1e-5
    rise = (
        theory.at_approach(answer.approach * (1.0 + step)).load
        - theory.at_approach(answer.approach * (1.0 - step)).load
    )
    # central difference of P ~ δ^1.5: error (step²)/24
    assert answer.stiffness == pytest.approx(rise / (2.0 * step * answer.approach), rel=1e-9)


def test_line_contact_in_three_ways():
    theory = HertzLine(E_star=70e9, radius=1e-3)
    answer = theory.at_load([1.0, 2e4])
    for again in (theory.at_half_width(answer.radius), theory.at_peak(answer.max_pressure)):
        assert again.load == pytest.approx(answer.load, rel=1e-13)
    assert answer.load == pytest.approx(0.5 * np.pi * answer.max_pressure * answer.radius, rel=1e-13)


def test_hertz_displacements_flatten_the_sphere_and_decay_as_a_point_force():
    theory, load = HertzPoint(1.0, 2.0), 0.3
    answer = theory.at_load(load)
    r = np.linspace(0.0, 1.0, 11) * float(answer.radius)
    assert theory.displacement(r, load) + r**2 / 4.0 == pytest.approx(np.full(11, float(answer.approach)), rel=1e-13)
    far = 1e3 * float(answer.radius)
    # P/(πE*r) is exceeded by (a/r)²/10
    assert theory.displacement(far, load) == pytest.approx(load / (np.pi * far), rel=2e-7)


@every_row(AXISYMMETRIC, label=name)
def test_axisymmetric_indenters(row):
    theory, a = indenter(row), row["a"]
    answer = theory.at_load(row["P"])
    assert answer.radius == pytest.approx(a, rel=DIGITS)
    assert answer.approach == pytest.approx(row["delta"], rel=DIGITS)
    assert answer.mean_pressure == pytest.approx(row["p_mean"], rel=DIGITS)
    assert theory.pressure([0.25 * a, 0.5 * a, 0.9 * a], row["P"]) == pytest.approx(
        [row["p_r025a"], row["p_r05a"], row["p_r09a"]], rel=DIGITS
    )
    step = 1e-5
    if row["shape"] != "flat":
        ends = [theory.at_radius(a * (1.0 + s)) for s in (-step, step)]
        slope = (ends[1].load - ends[0].load) / (ends[1].approach - ends[0].approach)
        assert answer.stiffness == pytest.approx(slope, rel=1e-7)  # step² times the square of the exponent


@every_row(PLANE, label=name)
def test_plane_indenters(row):
    flat, a = row["shape"] == "flat", row["a"]
    theory = LineFlatPunch(row["E_star"], a) if flat else LinePowerLawIndenter(row["E_star"], row["B"], row["n"])
    assert theory.at_load(row["P"]).radius == pytest.approx(a, rel=DIGITS)
    assert theory.pressure([0.1 * a, 0.5 * a, 0.9 * a], row["P"]) == pytest.approx(
        [row["p_x01a"], row["p_x05a"], row["p_x09a"]], rel=DIGITS
    )


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0, 3.0, 6.0])
def test_pressures_carry_the_load(exponent):
    """200 Gauss points in u, r = a sin(πu³/2): smooth at the edge, and u² ln u at the apex of a
    cone is good for 1e-9."""
    u, weight = gauss(np.array([0.0, 1.0]), 200)
    sine, cosine = np.sin(0.5 * np.pi * u**3), np.cos(0.5 * np.pi * u**3)
    weight = weight * 1.5 * np.pi * u**2 * cosine
    round_, plane = PowerLawIndenter(2.0, 0.1, exponent), LinePowerLawIndenter(2.0, 0.1, exponent)
    for theory, around in ((round_, lambda r: 2.0 * np.pi * r), (plane, lambda x: 2.0)):
        a = float(theory.at_load(0.2).radius)
        total = np.sum(theory.pressure(a * sine, 0.2) * around(a * sine) * a * weight)
        assert total == pytest.approx(0.2, rel=1e-9)
        outside = theory.pressure([1.0001 * a, 3.0 * a], 0.2)
        assert outside.tolist() == [0.0, 0.0]
        peak = float(theory.at_load(0.2).max_pressure)
        samples = theory.pressure(np.linspace(0.0, a, 400), 0.2)
        if np.isfinite(peak):
            assert samples.max() == pytest.approx(peak, rel=1e-5)  # 400 points miss the top by their distance squared


def test_power_laws_are_cone_sphere_and_punch():
    answer, sphere = PowerLawIndenter(3.0, 0.5 / 0.7, 2.0).at_load(0.1), HertzPoint(3.0, 0.7).at_load(0.1)
    for quantity in ("approach", "radius", "area", "max_pressure", "stiffness"):
        assert getattr(answer, quantity) == pytest.approx(getattr(sphere, quantity), rel=1e-13)
    cone = PowerLawIndenter(3.0, 0.1, 1.0).at_radius(2.0)
    assert cone.approach == pytest.approx(0.5 * np.pi * 2.0 * 0.1, rel=1e-13)
    assert cone.load == pytest.approx(0.5 * np.pi * 3.0 * 4.0 * 0.1, rel=1e-13)
    wedge = LinePowerLawIndenter(3.0, 0.1, 1.0)
    assert wedge.at_half_width(2.0).load == pytest.approx(3.0 * 2.0 * 0.1, rel=1e-13)
    cylinder, hertz = LinePowerLawIndenter(3.0, 0.5 / 0.7, 2.0).at_load(0.1), HertzLine(3.0, 0.7).at_load(0.1)
    assert cylinder.radius == pytest.approx(hertz.radius, rel=1e-13)
    assert cylinder.max_pressure == pytest.approx(hertz.max_pressure, rel=1e-13)
    # the punch: a profile flat up to r = 1; the load departs from 2E*aδ by 1/n
    steep = PowerLawIndenter(3.0, 1.0, 1e5).at_radius(1.0)
    assert steep.load == pytest.approx(FlatPunch(3.0, 1.0).at_approach(steep.approach).load, rel=1.1e-5)


def test_the_exact_sphere_departs_from_its_paraboloid_by_a_third_of_the_slope_squared():
    exact, hertz = SphericalIndenter(1.0, 1.0), HertzPoint(1.0, 1.0)
    for a in (1e-4, 1e-2, 0.1):
        one, other = exact.at_radius(a), hertz.at_radius(a)
        assert one.approach / other.approach - 1.0 == pytest.approx(a**2 / 3.0, rel=a**2, abs=1e-12)
        assert one.load / other.load - 1.0 == pytest.approx(0.4 * a**2, rel=a**2, abs=1e-12)
        assert float(exact.pressure(0.0, float(one.load))) == pytest.approx(float(one.max_pressure), rel=1e-10)


def test_flat_punches():
    punch = FlatPunch(2.0, 0.5)
    assert punch.at_load(0.3).stiffness == pytest.approx(2.0)
    assert punch.displacement([0.0, 0.5], 0.3) == pytest.approx([0.15, 0.15])
    assert punch.displacement(500.0, 0.3) == pytest.approx(0.3 / (np.pi * 2.0 * 500.0), rel=1e-6)
    assert punch.pressure([0.5, 0.6], 0.3).tolist() == [np.inf, 0.0]
    angle, weight = gauss(np.array([0.0, 0.5 * np.pi]), 40)
    rings = np.pi * 0.25 * np.sin(2.0 * angle)
    assert np.sum(punch.pressure(0.5 * np.sin(angle), 0.3) * rings * weight) == pytest.approx(0.3, rel=1e-12)


@every_row(reference("westergaard"), label=name)
def test_westergaard(row):
    wave, p = Westergaard(row["E_star"], row["amplitude"], row["lambda"]), row["pbar"]
    a = 0.5 * row["contact_fraction"] * row["lambda"]
    assert wave.full_contact_pressure == pytest.approx(row["pstar"], rel=DIGITS)
    assert wave.area_fraction(p) == pytest.approx(row["contact_fraction"], rel=DIGITS)
    assert wave.max_pressure(p) == pytest.approx(row["p_x0"], rel=DIGITS)
    expected = [row["p_x0"], row["p_x_a2"], row["p_x_09a"]]
    assert wave.pressure([0.0, 0.5 * a, 0.9 * a], p) == pytest.approx(expected, rel=DIGITS)
    assert wave.approach(p) / row["amplitude"] == pytest.approx(row["approach_over_amplitude"], rel=DIGITS)
    assert wave.at_pressure(p).area_fraction[0] == pytest.approx(row["contact_fraction"], rel=DIGITS)
    assert wave.mean_gap(p) + wave.approach(p) == pytest.approx(row["amplitude"], rel=DIGITS)


def test_a_wave_from_the_first_touch_to_beyond_full_contact():
    wave = Westergaard(1.0, 0.01, 1.0)
    full = wave.full_contact_pressure
    x = np.linspace(0.0, 1.0, 4096, endpoint=False)
    for share, tolerance in ((0.3, 1e-4), (1.0, 1e-12), (1.7, 1e-12)):  # square roots at the edges on 4096 points
        assert wave.pressure(x, share * full).mean() == pytest.approx(share * full, rel=tolerance)
    assert wave.area_fraction([0.0, full, 2.0 * full]).tolist() == [0.0, 1.0, 1.0]
    assert wave.mean_gap([full, 2.0 * full]).tolist() == [0.0, 0.0]
    assert wave.max_pressure(2.0 * full) == pytest.approx(3.0 * full)
    assert wave.stiffness(full) == np.inf
    # light loads: a row of Hertz line contacts with R = λ²/4π²Δ, to the square of the half-width in
    # wavelengths
    line = HertzLine(1.0, 1.0 / (4.0 * np.pi**2 * 0.01)).at_load(1e-8 * full)
    assert wave.area_fraction(1e-8 * full) == pytest.approx(float(line.area), rel=1e-7)
    step = 1e-4
    ends = [wave.approach(0.3 * full * (1.0 + s)) for s in (-step, step)]
    assert wave.stiffness(0.3 * full) == pytest.approx(0.6 * step * full / (ends[1] - ends[0]), rel=1e-7)


@every_row(JGH, label=name)
def test_crossed_waves(row):
    waves = CrossedWaves(1.0, 0.01, 1.0)
    full = waves.full_contact_pressure
    p = row["pbar_over_pstar"] * full
    assert waves.area_fraction_at_low_load(p) == pytest.approx(row["area_fraction_low_load"], rel=DIGITS)
    assert waves.area_fraction_at_high_load(p) == pytest.approx(row["area_fraction_high_load"], rel=DIGITS)
    assert waves.max_pressure_at_low_load(p) / full == pytest.approx(row["pmax_over_pstar_low_load"], rel=DIGITS)
    if row["area_fraction_numeric"] != "":
        assert waves.area_fraction(p) == pytest.approx(row["area_fraction_numeric"], abs=AREA_ERROR)
    if row["area_fraction_numeric"] != "" and row["pbar_over_pstar"] > 0.95:
        assert waves.area_fraction_at_high_load(p) == pytest.approx(row["area_fraction_numeric"], abs=3e-4)
    assert waves.at_pressure(p).area_fraction[0] == pytest.approx(float(waves.area_fraction(p)))
    assert waves.area_fraction_at_high_load(1.2 * full) == 1.0
    with refused(InputError, "mean pressure"):
        waves.full_contact(0.0, 0.0, 0.9 * full)


def test_tabulated_area_of_crossed_waves_has_both_asymptotes():
    waves = CrossedWaves(1.0, 0.01, 1.0)
    p = waves.full_contact_pressure * np.linspace(0.0, 1.2, 1201)
    area = waves.area_fraction(p)
    assert np.all(np.diff(area[p <= waves.full_contact_pressure]) > 0.0)
    assert area[0] == 0.0
    assert area[p >= waves.full_contact_pressure] == pytest.approx(1.0, rel=1e-12)
    light, nearly = np.array([1e-6, 1e-4]), np.array([0.985, 0.99, 0.998])
    full = waves.full_contact_pressure
    assert waves.area_fraction(light * full) == pytest.approx(waves.area_fraction_at_low_load(light * full), rel=2e-3)
    high = waves.area_fraction_at_high_load(nearly * full)
    assert waves.area_fraction(nearly * full) == pytest.approx(high, abs=AREA_ERROR / 2.0)


def mindlin(row):
    E, nu = row["E_each"], row["nu_each"]
    G, E_star = E / (2.0 * (1.0 + nu)), E / (2.0 * (1.0 - nu**2))
    if row["geometry"] == "cylinder":
        return MindlinLine(E_star, row["R"], row["mu"])
    return MindlinPoint(E_star, row["R"], tangential_modulus(G, nu, G, nu), row["mu"])


@every_row(MINDLIN, label=name)
def test_cattaneo_and_mindlin(row):
    """At r = c the traction of the stick zone goes as the root of c - r, so rounding of c shows as
    its root, 3e-8."""
    theory, P, Q = mindlin(row), row["P"], row["Q"]
    normal, slip = theory.normal.at_load(P), theory.at_load(P, Q)
    assert normal.radius == pytest.approx(row["a"], rel=DIGITS)
    assert normal.max_pressure == pytest.approx(row["p0"], rel=DIGITS)
    assert slip.stick_radius == pytest.approx(row["c"], rel=DIGITS)
    c, middle = row["c"], 0.5 * (row["a"] + row["c"])
    expected = [row["q_0"], row["q_c2"], row["q_mid"]]
    assert theory.traction([0.0, 0.5 * c, middle], P, Q) == pytest.approx(expected, rel=1e-12)
    assert theory.traction(c, P, Q) == pytest.approx(row["q_c"], rel=2e-7)
    if row["geometry"] == "sphere":
        assert slip.displacement == pytest.approx(row["delta_x"], rel=DIGITS)
        step = 1e-5
        ends = [float(theory.at_load(P, Q * (1.0 + s)).displacement) for s in (-step, step)]
        assert slip.stiffness == pytest.approx(2.0 * step * Q / (ends[1] - ends[0]), rel=1e-7)


def test_tangential_loading_up_to_sliding():
    theory = MindlinPoint(1.0, 2.0, tangential_modulus(0.7, 0.3, 0.7, 0.3), 0.4)
    P = 0.01
    slip = theory.at_load(P, [0.0, 0.4 * P])
    assert slip.stick_radius == pytest.approx([float(theory.normal.at_load(P).radius), 0.0])
    # the ratio of the first tangential to the normal stiffness of equal bodies is 2(1 - ν)/(2 - ν);
    # here E* = G/(1 - ν)
    equal = MindlinPoint(0.7 / 0.7, 2.0, theory.G_star, 0.4)
    ratio = equal.at_load(P, 0.0).stiffness / equal.normal.at_load(P).stiffness
    assert ratio == pytest.approx(2.0 * 0.7 / 1.7, rel=1e-13)
    r = np.linspace(0.0, 1.0, 30) * float(theory.normal.at_load(P).radius)
    assert theory.traction(r, P, 0.4 * P) == pytest.approx(0.4 * theory.normal.pressure(r, P))
    with refused(InputError, "tangential force"):
        theory.at_load(P, 0.41 * P)
    line = MindlinLine(1.0, 2.0, 0.4)
    a, p0 = float(line.normal.at_load(P).radius), float(line.normal.at_load(P).max_pressure)
    assert line.stick_shift(P, 0.3 * P, 0.2 * p0) == pytest.approx(0.2 * a / 1.6)
    with refused(InputError, "bulk stress"):
        line.stick_shift(P, 0.01 * P, 1.0 * p0)


CURVES = {
    "hertz": lambda p: HertzPoint(1.0, 1.0).at_load(p),
    "line": lambda p: HertzLine(1.0, 1.0).at_load(p),
    "ellipse": lambda p: HertzEllipse(1.0, 2.0, 1.0).at_load(p),
    "power": lambda p: PowerLawIndenter(1.0, 0.5, 3.0).at_load(p),
    "sphere": lambda p: SphericalIndenter(1.0, 1.0).at_load(p),
    "punch": lambda p: FlatPunch(1.0, 1.0).at_load(p),
    "plane": lambda p: LinePowerLawIndenter(1.0, 0.5, 3.0).at_load(p),
    "strip": lambda p: LineFlatPunch(1.0, 1.0).at_load(p),
}


@pytest.mark.parametrize("curve", CURVES)
def test_curves_rise(curve):
    loads = np.linspace(0.0, 1e-2, 200)
    answer = CURVES[curve](loads)
    assert answer.load == pytest.approx(loads, rel=1e-12)
    assert np.all(np.diff(answer.radius) >= 0.0)
    assert np.all(answer.area[1:] * answer.mean_pressure[1:] == pytest.approx(loads[1:]))


def test_validity_is_about_slopes():
    theory = HertzPoint(1.0, 1.0)
    (limit,) = theory.validity(theory.at_radius([0.01, 0.2, 0.5]))
    assert limit.holds.tolist() == [True, True, False]
    punch = LineFlatPunch(1.0, 1.0)
    assert punch.validity(punch.at_load([0.1, 1.0]))[0].value == pytest.approx([0.05, 0.5])
    wave = Westergaard(1.0, 0.1, 1.0)
    assert not wave.validity(wave.at_pressure([0.01, 0.1]))[0].holds.any()


@pytest.mark.parametrize(
    ("attempt", "subject"),
    [
        (lambda: HertzPoint(1.0, 1.0).at_load([1.0, -1.0]), "load (N)"),
        (lambda: HertzPoint(0.0, 1.0), "E_star (Pa) of hertz"),
        (lambda: PowerLawIndenter(1.0, 1.0, 0.5), "exponent of power-law-indenter"),
        (lambda: LinePowerLawIndenter(1.0, 1.0, 0.5), "exponent of line-power-law-indenter"),
        (lambda: SphericalIndenter(1.0, 1.0).at_radius(1.0), "contact radius"),
        (lambda: FlatPunch(1.0, 1.0).at_approach(-1.0), "approach (m)"),
        (lambda: HertzEllipse(1.0, 1.0, 0.0), "radius_y (m) of hertz-ellipse"),
        (lambda: CrossedWaves(1.0, 1.0, 1.0).full_contact(0.0, 0.0, 1.0), "mean pressure"),
        (lambda: tangential_modulus(0.0, 0.3, 1.0, 0.3), "shear modulus (Pa)"),
    ],
)
def test_unusable_values_are_refused(attempt, subject):
    with refused(InputError, subject):
        attempt()
