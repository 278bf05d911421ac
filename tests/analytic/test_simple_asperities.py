"""Identical and sinusoidal asperities, indentation curves, rebound: reference rows and limits."""

from __future__ import annotations

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.theories.dynamics.restitution import rebound
from asperity.theories.hardness.effective_hardness import CONE, PARABOLOID, PUNCH, OliverPharr
from asperity.theories.rough.discrete_summits import IdenticalAsperities
from asperity.theories.single.hertz import HertzPoint
from asperity.theories.single.waves import TWO_TERMS, SinusoidalAsperity, two_term_approach, two_term_load, two_terms

DIGITS = 1e-13  # the tables carry 15 digits (found: 6e-15)


@every_row(reference("identical_asperities"), label=lambda row: f"N{row['N']:g}")
def test_identical_asperities(row):
    """Loads and areas per unit area are those of N asperities on 1 m²."""
    theory = IdenticalAsperities(row["Estar_Pa"], row["N"], row["R_m"], height=0.0)
    found, one = theory.at_pressure(row["W_N"]), theory.asperity.at_load(row["W_N"] / row["N"])
    assert found.separation[0] == pytest.approx(-row["delta_m"], rel=DIGITS)
    assert one.radius == pytest.approx(row["a_m"], rel=DIGITS)
    assert found.area_fraction[0] == pytest.approx(row["A_m2"], rel=DIGITS)
    assert found.mean_real_pressure[0] == pytest.approx(row["pm_Pa"], rel=DIGITS)
    assert one.max_pressure == pytest.approx(row["p0_Pa"], rel=DIGITS)
    assert theory.pressure_at_yield(row["H_Pa"]) == pytest.approx(row["Wcrit_N"], rel=DIGITS)
    again = theory.at_separation(found.separation)
    assert again.pressure[0] == pytest.approx(row["W_N"], rel=1e-12)


def test_identical_asperities_touch_together():
    theory = IdenticalAsperities(1e11, 1e10, 1e-6, height=5e-9)
    found = theory.at_separation([6e-9, 5e-9, 4e-9])
    assert found.contact_density.tolist() == [0.0, 0.0, 1e10]
    assert found.pressure[:2].tolist() == [0.0, 0.0]
    p = np.geomspace(1e3, 1e9, 200)
    curve = theory.at_pressure(p)
    assert np.polyfit(np.log(p), np.log(curve.area_fraction), 1)[0] == pytest.approx(2.0 / 3.0, rel=1e-12)
    slope = -np.gradient(curve.pressure, curve.separation)[1:-1]
    assert curve.stiffness[1:-1] == pytest.approx(slope, rel=5e-3)
    area, radius = theory.validity(curve)
    assert area.holds[0]
    assert radius.value[-1] == pytest.approx(float(theory.asperity.at_load(1e-1).radius) / 1e-6)


@every_row(reference("sinusoidal_asperity"), label=lambda row: f"{row['a_over_lambda']:g}")
def test_sinusoidal_asperity(row):
    height, wavelength, E_star = 0.3, 2.0, 5.0
    a = row["a_over_lambda"] * wavelength
    answer = SinusoidalAsperity(E_star, height, wavelength).at_radius(a)
    scale = E_star * height * wavelength
    assert answer.approach / height == pytest.approx(row["delta_over_h_exact"], rel=DIGITS)
    assert answer.load / scale == pytest.approx(row["F_over_Estar_h_lambda_exact"], rel=DIGITS)
    A = two_terms(height, wavelength)
    assert two_term_approach(a, *A) / height == pytest.approx(row["delta_over_h_two_term"], rel=DIGITS)
    assert two_term_load(a, E_star, *A) / scale == pytest.approx(row["F_over_Estar_h_lambda_two_term"], rel=DIGITS)


def test_a_low_cap_is_a_sphere_and_two_terms_end_where_they_say():
    cap = SinusoidalAsperity(1.0, 0.01, 1.0)
    sphere = HertzPoint(1.0, cap.radius)
    a = 1e-4
    # the next term of the cosine is of the order (2πa/λ)²/3
    assert cap.at_radius(a).load == pytest.approx(float(sphere.at_radius(a).load), rel=4e-7)
    assert cap.at_radius(a).approach == pytest.approx(float(sphere.at_radius(a).approach), rel=4e-7)
    fine = np.linspace(0.3, 0.37, 7001)
    A = two_terms(0.01, 1.0)
    assert fine[np.argmax(two_term_approach(fine, *A))] == pytest.approx(TWO_TERMS, abs=1e-5)
    assert fine[np.argmax(two_term_load(fine, 1.0, *A))] == pytest.approx(TWO_TERMS, abs=1e-5)


def test_loads_of_a_cap_find_their_contact():
    cap = SinusoidalAsperity(1.0, 0.01, 1.0)
    widest = float(cap.at_radius(0.35).load)
    loads = np.linspace(0.0, widest, 200)
    answer = cap.at_load(loads)
    assert answer.load == pytest.approx(loads, rel=1e-12, abs=1e-16)
    slope = np.gradient(answer.load, answer.approach)[50:-1]
    assert answer.stiffness[50:-1] == pytest.approx(slope, rel=1e-3)  # differences of a fiftieth, second order
    assert cap.validity(answer)[0].value.max() == pytest.approx(0.01 * np.pi, rel=1e-3)
    with refused(InputError, "load of a cap"):
        cap.at_load(1.1 * widest)


@every_row(reference("oliver_pharr"), label=lambda row: f"{row['W_max_N']:g}")
def test_oliver_and_pharr(row):
    test = OliverPharr(row["W_max_N"], row["h_max_m"], row["S_max_N_per_m"], row["epsilon"])
    assert test.contact_depth == pytest.approx(row["h_c_m"], rel=DIGITS)
    assert test.area == pytest.approx(row["A_c_m2"], rel=DIGITS)
    assert test.hardness == pytest.approx(row["H_Pa"], rel=DIGITS)
    assert test.contact_modulus == pytest.approx(row["E_r_Pa"], rel=DIGITS)


def test_an_indentation_of_a_paraboloid_returns_its_modulus():
    """Elastic paraboloid: S = 2E*a, and h_c = δ/2 with ε = 0.75, since W/S = 2δ/3; a² = 2R h_c is
    its true area."""
    sphere = HertzPoint(7e10, 1e-5)
    answer = sphere.at_load(1e-3)
    test = OliverPharr(1e-3, float(answer.approach), float(answer.stiffness), PARABOLOID)
    assert test.contact_depth == pytest.approx(0.5 * float(answer.approach), rel=1e-12)
    true = OliverPharr(
        1e-3, float(answer.approach), float(answer.stiffness), PARABOLOID, float(answer.area) / test.contact_depth**2
    )
    assert true.contact_modulus == pytest.approx(7e10, rel=1e-12)
    assert CONE < PARABOLOID < PUNCH
    with refused(InputError, "depth at peak load"):
        OliverPharr(1e-3, 1e-8, 1.0)


@every_row(reference("compliance_restitution"), label=lambda row: f"{row['alpha_v_in']:g}")
def test_rebound(row):
    out = rebound(row["alpha_v_in"])
    assert out == pytest.approx(row["alpha_v_out"], rel=DIGITS)
    assert out / row["alpha_v_in"] == pytest.approx(row["restitution"], rel=DIGITS)


def test_slow_impacts_lose_two_thirds_of_their_speed_times_damping():
    """v_out = v_in (1 - (2/3)βv_in + …): nothing is lost in a slow impact, and no rebound exceeds
    1/β."""
    slow = np.array([1e-8, 1e-5, 2e-3])
    assert 1.0 - rebound(slow) / slow == pytest.approx(2.0 / 3.0 * slow, rel=2e-3, abs=1e-15)
    assert rebound(0.0) == 0.0
    assert rebound(1e6) == pytest.approx(1.0)


def test_rebound_between_series_and_logarithm():
    """v - ln(1 + v) before and -v - ln(1 - v) after by forty terms of their series, 0.3^40 =
    1e-21."""
    speed = np.geomspace(1e-5, 0.3, 60)
    out = rebound(speed)
    powers = np.arange(2, 42)
    before = np.sum((-speed[:, None]) ** powers / powers, axis=1)
    after = np.sum(out[:, None] ** powers / powers, axis=1)
    np.testing.assert_allclose(after, before, rtol=1e-13)
