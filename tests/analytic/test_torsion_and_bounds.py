"""Torsion with stick and slip, and contacts whose traction is bounded by a constant."""

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.quadrature import gauss
from asperity.theories import HertzPoint, LubkinSphere, StickingTwist, TrescaDisc, TrescaLine, TrescaTwist
from asperity.theories.friction.torsion import slip_transform

BALL = LubkinSphere(1.0, 1.0, 0.4, 0.3)


@every_row(reference("friction/torsion_sphere"), label=lambda row: f"c/a {row['c_over_a']:g}")
def test_lubkin(row):
    load, k = 2e-3, row["c_over_a"]
    answer, largest = BALL.at_stick_radius(load, k), BALL.largest_torque(load)
    a, p0 = float(answer.normal.radius), float(answer.normal.max_pressure)
    torque = float(BALL.torque(load, k))
    assert torque / (0.3 * load * a) == pytest.approx(row["M_over_muPa"], rel=1e-13)
    assert torque / largest == pytest.approx(row["M_over_Mmax"], rel=1e-13)
    assert 0.4 * answer.rotation * a**2 / (0.3 * load) == pytest.approx(row["Gstar_beta_a2_over_muP"], rel=1e-13)
    assert 0.4 * answer.rotation / (0.3 * p0) == pytest.approx(row["Gstar_beta_over_mu_p0"], rel=1e-13)
    if k > 0.05:  # of a smaller stick zone the torque holds a few digits
        assert BALL.at_load(load, torque).stick_radius == pytest.approx(k * a, rel=1e-11)


def test_traction_of_lubkin_carries_the_torque_and_joins_the_slipping_rim():
    load = 2e-3
    torque = 0.6 * BALL.largest_torque(load)
    answer = BALL.at_load(load, torque)
    a, c = float(answer.normal.radius), float(answer.stick_radius)
    t, weight = gauss(np.array([0.0, 1.0]), 40)
    total = 0.0
    for low, high in ((0.0, c), (c, a)):  # roots at both ends of the slipping rim
        s = t**3 * (10.0 - 15.0 * t + 6.0 * t**2)
        r = low + (high - low) * s
        w = (high - low) * 30.0 * t**2 * (1.0 - t) ** 2 * weight
        total += 2.0 * np.pi * np.sum(w * r**2 * BALL.traction(r, load, torque))
    assert total == pytest.approx(torque, rel=1e-6)
    inner, outer = BALL.traction([c * (1.0 - 1e-9), c * (1.0 + 1e-9)], load, torque)
    assert inner == pytest.approx(outer, rel=1e-4)
    assert np.all(BALL.traction(np.linspace(0.0, c, 20)[:-1], load, torque) < 0.3 * BALL.normal.pressure(0.0, load))


def test_first_twist_is_without_slip():
    answer = BALL.at_load(2e-3, 1e-9 * BALL.largest_torque(2e-3))
    stuck = StickingTwist(0.4, float(answer.normal.radius))
    assert answer.stiffness == pytest.approx(stuck.stiffness, rel=1e-3)
    r, w = gauss(np.array([0.0, 0.5 * np.pi]), 40)
    sines = stuck.radius * np.sin(r)
    traction = stuck.traction(sines, 1.0)
    assert 2.0 * np.pi * np.sum(w * stuck.radius * np.cos(r) * sines**2 * traction) == pytest.approx(1.0, rel=1e-12)
    ahead, behind = (BALL.at_load(2e-3, s * BALL.largest_torque(2e-3)) for s in (0.5 + 1e-5, 0.5 - 1e-5))
    slope = 2e-5 * BALL.largest_torque(2e-3) / (ahead.rotation - behind.rotation)
    assert slope == pytest.approx(float(BALL.at_load(2e-3, 0.5 * BALL.largest_torque(2e-3)).stiffness), rel=1e-7)


def test_transform_of_any_pressure():
    """Hertz's pressure, P = E*(a² - x²)/2R, gives Lubkin's x (K - E); a punch of constant P gives
    (2x/πa) K."""
    from scipy.special import ellipe, ellipk

    x = np.array([1e-4, 0.1, 0.5, 0.9, 0.999])
    m = 1.0 - x**2
    hertz = HertzPoint(1.0, 1.0).at_radius(1.0)
    found = slip_transform(lambda t: 0.5 * (1.0 - t**2), x, 1.0)
    assert found == pytest.approx(float(hertz.max_pressure) * x * (ellipk(m) - ellipe(m)), rel=1e-10)
    assert slip_transform(np.ones_like, x, 1.0) == pytest.approx(2.0 * x / np.pi * ellipk(m), rel=1e-10)


@every_row(reference("friction/tresca_partial_slip"), label=lambda row: f"case{row['case']:g}")
def test_bounded_traction(row):
    G, a, tau, c = row["G_each"], row["a"], row["tau0"], row["a"] * row["c_over_a"]
    if row["kind"] == "line":
        theory = TrescaLine(a, tau)
        answer = theory.at_force(row["load"])
    elif row["kind"] == "torsion":
        theory = TrescaTwist(0.5 * G, a, tau)
        answer = theory.at_torque(row["load"])
    else:
        theory = TrescaDisc(G, a, tau)
        answer = theory.at_force(row["load"])
    assert answer.stick_radius == pytest.approx(c, rel=1e-11)
    if row["displacement"] != "":
        assert answer.displacement == pytest.approx(row["displacement"], rel=1e-11)
    found = theory.traction([0.0, 0.5 * c], row["load"])
    assert found == pytest.approx([row["q_centre"], row["q_c2"]], rel=1e-11, abs=1e-15 * tau)


@pytest.mark.parametrize(
    ("theory", "ask", "power"),
    [(TrescaDisc(0.8, 1.0, 0.1), "at_force", 1), (TrescaTwist(0.4, 1.0, 0.1), "at_torque", 2)],
)
def test_bounded_traction_carries_its_load_and_gives_way_as_its_stiffness(theory, ask, power):
    largest = np.pi * 0.1 if power == 1 else 2.0 * np.pi / 3.0 * 0.1
    load = 0.7 * largest
    answer = getattr(theory, ask)(load)
    c = float(answer.stick_radius)
    s, w = gauss(np.array([0.0, 0.5 * np.pi]), 60)
    r = c * np.sin(s)
    inner = 2.0 * np.pi * np.sum(w * c * np.cos(s) * r**power * theory.traction(r, load))
    outer = 2.0 * np.pi * 0.1 * (1.0 - c ** (power + 1)) / (power + 1)
    assert inner + outer == pytest.approx(load, rel=1e-10)
    ahead, behind = (getattr(theory, ask)(load * (1.0 + e)).displacement for e in (1e-6, -1e-6))
    assert 2e-6 * load / (ahead - behind) == pytest.approx(float(answer.stiffness), rel=1e-6)
    assert theory.traction([1.0, 1.1], load) == pytest.approx([0.1, 0.0])


def test_refusals():
    with refused(InputError, "torque"):
        BALL.at_load(1e-3, 1.0)
    with refused(InputError, "stick radius over contact radius"):
        BALL.at_stick_radius(1e-3, 0.0)
    with refused(InputError, "tangential force (N)"):
        TrescaDisc(1.0, 1.0, 1.0).at_force(3.2)
    with refused(InputError, "tangential force per length (N/m)"):
        TrescaLine(1.0, 1.0).at_force(2.1)
