"""Indentation without slip and with friction: tables, tractions, limits, and the equations on
another mesh."""

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.quadrature import gauss
from asperity.theories import (
    FrictionalIndenter,
    FrictionalPunch,
    GoodmanLine,
    LinePowerLawIndenter,
    PowerLawIndenter,
    StickingIndenter,
    StickingIndenterLine,
    StickingPunch,
    friction_of_stick,
)
from asperity.theories.friction.finite_friction import goodman_friction, stick_share


@every_row(reference("friction/full_stick_sphere_tractions"), label=lambda row: f"case{row['case']:g}")
def test_tractions_of_the_sphere_without_slip(row):
    ball, load = StickingIndenter(1.0, 0.05, 2.0, row["beta"]), 1e-3
    a = float(ball.at_load(load).radius)
    mean = load / (np.pi * a**2)
    p, q = (f(row["r_over_a"] * a, load) / mean for f in (ball.pressure, ball.traction))
    assert [p, q] == pytest.approx([row["p_over_pmean"], row["q_over_pmean"]], rel=1e-9)
    assert q / p == pytest.approx(row["q_over_p"], rel=1e-9)


@every_row(
    [row for row in reference("friction/full_stick_power_law") if row["n"] != 0],
    label=lambda row: f"case{row['case']:g}",
)
def test_lines_without_slip(row):
    assert StickingIndenterLine(1.0, 1.0, row["n"], row["beta"]).load_gain == pytest.approx(
        row["line_P_ratio_same_a"], rel=1e-12
    )


@pytest.mark.parametrize("exponent", [1.0, 2.5])
def test_tractions_without_slip_carry_the_load_and_are_hertz_without_coupling(exponent):
    t, w = gauss(np.concatenate([[0.0], 0.2 ** np.arange(9.0, 0.0, -1.0), 1.0 - 0.2 ** np.arange(1.0, 11.0)]), 6)
    round_, line = (kind(1.0, 0.2, exponent, 0.3) for kind in (StickingIndenter, StickingIndenterLine))
    a = float(round_.at_load(1e-3).radius)
    total = np.sum(w * 2.0 * np.pi * t * a**2 * round_.pressure(t * a, 1e-3))
    assert total == pytest.approx(1e-3, rel=1e-6)
    a = float(line.at_load(1e-3).radius)
    assert 2.0 * np.sum(w * a * line.pressure(t * a, 1e-3)) == pytest.approx(1e-3, rel=1e-6)
    x = np.array([0.1, 0.6, 0.95]) * a
    assert line.traction(-x, 1e-3) == pytest.approx(-line.traction(x, 1e-3))
    assert line.traction(0.0, 1e-3) == 0.0
    assert line.pressure(0.0, 1e-3) == pytest.approx(float(line.pressure(1e-6 * a, 1e-3)), rel=1e-5) or exponent == 1.0
    for kind, free in ((StickingIndenter, PowerLawIndenter), (StickingIndenterLine, LinePowerLawIndenter)):
        uncoupled, other = kind(1.0, 0.2, exponent, 0.0), free(1.0, 0.2, exponent)
        r = np.array([0.1, 0.6, 0.95]) * float(other.at_load(1e-3).radius)
        assert uncoupled.pressure(r, 1e-3) == pytest.approx(other.pressure(r, 1e-3), rel=1e-9)
        assert uncoupled.traction(r, 1e-3) == pytest.approx(0.0, abs=1e-15)


def test_stuck_wedge():
    beta = 2.0 / 7.0
    wedge = StickingIndenterLine(1.0, 0.1, 1.0, beta)
    assert wedge.load_gain == pytest.approx((1.0 - beta**2) ** -0.5, rel=1e-13)
    assert np.isinf(StickingIndenter(1.0, 0.1, 1.0, beta).pressure(0.0, 1.0))


FINITE = reference("friction/finite_friction_indentation")


def friction_row(row):
    """Three finer meshes agree with ours to 1e-11; the table, nearly singular at the edge, to
    1.4e-8 at β = 0.5."""
    beta, share = row["beta"], row["c_over_a"]
    mu = friction_of_stick(beta, share)
    assert mu == pytest.approx(row["mu"], rel=2e-8)
    cone, ball = (FrictionalIndenter(1.0, 0.1, n, beta, mu) for n in (1.0, 2.0))
    punch = FrictionalPunch(1.0, 1.0, beta, mu)
    for theory in (cone, ball, punch):  # found again from μ in one row below
        theory.__dict__["stick_share"] = share
    assert punch.gain == pytest.approx(row["C_flat"], rel=1e-8)
    found = [cone.approach_gain, cone.load_gain, ball.approach_gain, ball.load_gain]
    expected = [row[f"{name}_ratio_{shape}"] for shape in ("cone", "sphere") for name in ("delta", "P")]
    assert found == pytest.approx(expected, rel=1e-8)


@pytest.mark.slow
@every_row(FINITE, label=lambda row: f"case{row['case']:g}")
def test_finite_friction(row):
    friction_row(row)


@every_row(FINITE, label=lambda row: f"case{row['case']:g}")
def test_goodman(row):
    assert goodman_friction(row["beta"], row["c_over_a"]) == pytest.approx(row["mu_plane_goodman"], rel=1e-10)


def test_one_row_of_finite_friction():
    friction_row(FINITE[16])


def test_much_friction_sticks_and_little_slips():
    beta = 2.0 / 7.0
    much, little = (FrictionalIndenter(1.0, 0.1, 2.0, beta, mu) for mu in (5.0, 1e-3))
    stuck = StickingIndenter(1.0, 0.1, 2.0, beta)
    assert much.load_gain == pytest.approx(stuck.load_gain, rel=1e-9)
    assert little.stick_share == 0.0
    # of first order in friction
    assert little.load_gain - 1.0 == pytest.approx(
        10.0 * (FrictionalIndenter(1.0, 0.1, 2.0, beta, 1e-4).load_gain - 1.0), rel=1e-2
    )
    assert stick_share(0.0, 0.1) == 1.0


@pytest.mark.slow
def test_gain_grows_with_friction():
    beta = 2.0 / 7.0
    gains = [FrictionalPunch(1.0, 1.0, beta, mu).gain for mu in (0.01, 0.2, 1.0)]
    assert 1.0 < gains[0] < gains[1] < gains[2] < StickingPunch(1.0, 1.0, beta).gain
    assert stick_share(-beta, 0.2) == pytest.approx(stick_share(beta, 0.2), rel=1e-12)


def test_goodman_and_its_inverse():
    for mu in (0.05, 0.2, 2.0 / 7.0, 0.5, 2.0):
        share = GoodmanLine(2.0 / 7.0, mu).stick_share
        if share < 0.9999:
            assert goodman_friction(2.0 / 7.0, share) == pytest.approx(mu, rel=1e-9)
    assert GoodmanLine(0.3, 0.3).stick_share == pytest.approx(np.sqrt(0.5), rel=1e-14)


def test_frictional_indenter_is_one_contact():
    row = FINITE[16]
    ball = FrictionalIndenter(1.0, 0.1, 2.0, row["beta"], row["mu"])
    assert ball.stick_share == pytest.approx(row["c_over_a"], rel=1e-8)
    at, ahead, behind = (ball.at_load(1e-3 * s) for s in (1.0, 1.0 + 1e-5, 1.0 - 1e-5))
    assert 2e-8 / (ahead.approach - behind.approach) == pytest.approx(float(at.stiffness), rel=1e-8)
    assert ball.at_radius(at.radius).load == pytest.approx(1e-3, rel=1e-12)


def test_refusals():
    with refused(InputError, "stick radius over contact radius"):
        friction_of_stick(0.3, 1.0)
    with refused(InputError, "stick radius over contact radius"):
        friction_of_stick(0.75, 0.999)  # the tractions without slip change their sign before
    with refused(InputError, "distance from the axis"):
        StickingIndenter(1.0, 0.1, 2.0, 0.2).pressure(1e3, 1.0)
    with refused(InputError, "place"):
        StickingIndenterLine(1.0, 0.1, 2.0, 0.2).pressure(1e3, 1.0)
