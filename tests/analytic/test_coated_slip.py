"""Partial slip and torsion of coated twins from their compliances."""

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.solids.compliance.tensor import plane_compliance
from asperity.theories import CoatedLine, CoatedTwist, HertzPoint, LubkinSphere, MindlinLine


def spectrum(row, component):
    """Compliance of two equal bodies."""
    layer = asp.Layer(asp.Elastic(row["E1"], row["nu1"]), thickness=row["h"])
    body = asp.Layered([layer], base=asp.Elastic(row["E2"], row["nu2"]))
    return lambda alpha: 2.0 * getattr(plane_compliance(body, alpha), component)


@every_row(reference("friction/line_layered_twins"), label=lambda row: f"case{row['case']:g}")
def test_lines(row):
    shear = spectrum(row, "LL" if row["mode"] == "inplane" else "T")
    slip = CoatedLine(spectrum(row, "zz"), shear, row["R"], row["mu"]).at_stick_width(row["a"], row["c_over_a"])
    assert slip.load == pytest.approx(row["P"], rel=1e-9)
    assert slip.tangential == pytest.approx(row["Q"], rel=5e-9)
    assert slip.reduced == pytest.approx(row["Q_reduced_rule"], rel=1e-9)
    a, c = row["a"], row["a"] * row["c_over_a"]
    assert slip.pressure([0.0, 0.5 * a]) == pytest.approx([row["p_0"], row["p_05a"]], rel=1e-9)
    places = [0.0, 0.5 * c, 0.5 * (a + c)]
    assert slip.traction(places) == pytest.approx([row["q_0"], row["q_c2"], row["q_mid"]], rel=5e-9)
    # the tangent at c is vertical: rounding of c to 1e-16 is 1e-8 times the slope; the traction
    # there is μp
    assert slip.traction(c) == pytest.approx(row["q_c"], rel=2e-7)
    assert slip.traction(c) == pytest.approx(row["mu"] * float(slip.pressure(c)), rel=1e-12)


@every_row(reference("friction/torsion_layered_twins"), label=lambda row: f"case{row['case']:g}")
def test_torsion(row):
    twist = CoatedTwist(spectrum(row, "zz"), spectrum(row, "T"), row["R"], row["mu"])
    slip = twist.at_stick_radius(row["a"], row["c_over_a"])
    found = [slip.load, slip.approach, slip.rotation, slip.torque]
    assert found == pytest.approx([row["P"], row["delta"], row["twist"], row["M"]], rel=1e-10)


COAT = {"E1": 7.0, "nu1": 0.2, "E2": 1.0, "nu2": 0.3}


def test_thick_coats_are_homogeneous():
    row, modulus, nu, within = {**COAT, "h": 1e5}, 7.0, 0.2, 1e-8
    E_star, G = modulus / (2.0 * (1.0 - nu**2)), modulus / (2.0 * (1.0 + nu))
    slip = CoatedLine(spectrum(row, "zz"), spectrum(row, "LL"), 10.0, 0.4).at_stick_width(1.0, 0.5)
    line = MindlinLine(E_star, 10.0, 0.4)
    assert slip.load == pytest.approx(0.25 * np.pi * E_star / 10.0, rel=within)
    assert slip.tangential == pytest.approx(0.4 * slip.load * 0.75, rel=within)
    x = np.linspace(0.0, 0.95, 6)
    assert slip.traction(x) == pytest.approx(line.traction(x, slip.load, slip.tangential), rel=1e-6)
    twist = CoatedTwist(spectrum(row, "zz"), spectrum(row, "T"), 10.0, 0.4).at_stick_radius(1.0, 0.5)
    lubkin = LubkinSphere(E_star, 10.0, 0.5 * G, 0.4)
    load = float(HertzPoint(E_star, 10.0).at_radius(1.0).load)
    assert twist.load == pytest.approx(load, rel=within)
    assert twist.torque == pytest.approx(float(lubkin.torque(load, 0.5)), rel=within)
    assert twist.rotation == pytest.approx(float(lubkin.at_stick_radius(load, 0.5).rotation), rel=within)


def test_thin_coats_approach_the_body_below():
    E_star = 1.0 / (2.0 * (1.0 - 0.3**2))
    misses = []
    for thickness in (0.16, 0.08, 0.04):
        row = {**COAT, "E1": 2.0, "h": thickness}
        slip = CoatedLine(spectrum(row, "zz"), spectrum(row, "LL"), 10.0, 0.4).at_stick_width(1.0, 0.5)
        misses.append(abs(slip.load / (0.25 * np.pi * E_star / 10.0) - 1.0))
    # of first order in the thickness
    assert misses[0] / misses[1] == pytest.approx(2.0, rel=0.25)
    assert misses[1] / misses[2] == pytest.approx(2.0, rel=0.25)
    assert misses[2] < 0.08


def test_little_stick_is_as_by_the_reduced_rule():
    """The rule is off by what the kernel of the coat changes over the stick zone, its square."""
    row = {**COAT, "h": 0.7}
    line = CoatedLine(spectrum(row, "zz"), spectrum(row, "LL"), 10.0, 0.4)
    ratios = [
        (slip.tangential / slip.reduced - 1.0) for slip in (line.at_stick_width(1.0, k) for k in (0.4, 0.1, 0.02))
    ]
    assert abs(ratios[0]) > abs(ratios[1]) > abs(ratios[2])
    assert abs(ratios[2]) < 1e-3


def test_refusals():
    line = CoatedLine(lambda alpha: 1.0 / alpha, lambda alpha: 1.0 / alpha, 1.0, 0.3)
    with refused(InputError, "stick zone over contact"):
        line.at_stick_width(1.0, 1.0)
    with refused(InputError, "half-width (m)"):
        line.at_stick_width(-1.0, 0.5)
