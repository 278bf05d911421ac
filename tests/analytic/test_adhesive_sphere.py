"""JKR, DMT and Maugis: every reference row, limits of Maugis, energy, stability."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.quadrature import gauss
from asperity.theories.adhesion.spheres import (
    DMT,
    JKR,
    LENNARD_JONES,
    MaugisDugdale,
    approach_ratio,
    contact_ratio,
    load_ratio,
    maugis_fold,
    maugis_pull_off,
    maugis_state,
    tabor_parameter,
)
from asperity.theories.ask import evaluate
from asperity.theories.single.hertz import HertzPoint

DIGITS = 1e-13  # the tables carry 16 digits (found: 7e-15)
SPHERES = {"JKR": JKR, "DMT": DMT}


def name(row):
    return f"case{row['case']:g}"


@every_row(reference("jkr_dmt"), label=name)
def test_jkr_and_dmt(row):
    theory = SPHERES[row["model"]](row["E_star"], row["R"], row["w"])
    answer = theory.at_load(row["P"])
    assert answer.radius == pytest.approx(row["a"], rel=DIGITS)
    assert answer.approach == pytest.approx(row["delta"], rel=DIGITS)
    assert answer.load == pytest.approx(row["P"], rel=1e-12)  # a difference of larger terms
    assert -theory.pull_off == pytest.approx(row["P_pulloff"], rel=DIGITS)
    assert theory.pressure(0.0, row["P"]) == pytest.approx(row["p_r0"], rel=DIGITS)
    assert answer.max_pressure == pytest.approx(row["p_r0"], rel=DIGITS)


@every_row(reference("jkr_normalised"), label=lambda row: f"{row['delta_over_delta_c']:g}")
def test_jkr_with_fixed_grips(row):
    """Where the contact breaks, δ(a) has its minimum and the radius is known to the root of the
    rounding alone."""
    x = contact_ratio(row["delta_over_delta_c"])
    breaks = row["delta_over_delta_c"] == -1.0
    assert x == pytest.approx(row["a_over_a_c"], rel=1e-7 if breaks else DIGITS)
    assert load_ratio(x) == pytest.approx(row["P_over_Pc"], rel=1e-7 if breaks else DIGITS)
    sphere = JKR(1e9, 1e-6, 0.05)
    answer = sphere.at_approach(row["delta_over_delta_c"] * sphere.critical_extension)
    assert answer.load == pytest.approx(row["P_over_Pc"] * sphere.pull_off, rel=1e-7 if breaks else 1e-12)


@every_row(reference("adhesion_parameters"), label=lambda row: f"R{row['R_m']:g}")
def test_adhesion_parameters(row):
    sphere = JKR(row["Estar_Pa"], row["R_m"], row["w_J_per_m2"], row["z0_m"])
    assert sphere.critical_extension == pytest.approx(row["delta_c_m"], rel=DIGITS)
    assert sphere.pull_off == pytest.approx(row["Pc_N"], rel=DIGITS)
    assert sphere.critical_radius == pytest.approx(row["ac_m"], rel=DIGITS)
    assert sphere.tabor == pytest.approx(row["tabor_mu"], rel=DIGITS)
    assert row["sigma_m"] / sphere.critical_extension == pytest.approx(row["inv_Delta_c"], rel=DIGITS)


@every_row(reference("maugis_dugdale"), label=name)
def test_maugis(row):
    state = maugis_state(row["lambda"], row["A"])
    assert state.outer_over_inner == pytest.approx(row["m_c_over_a"], rel=DIGITS)
    # both are differences: absolute in their units as well
    assert state.load == pytest.approx(row["P_norm"], rel=DIGITS, abs=1e-13)
    assert state.approach == pytest.approx(row["delta_norm"], rel=DIGITS, abs=1e-13)


@every_row(reference("maugis_pulloff"), label=name)
def test_pull_off_of_maugis(row):
    """The place of a minimum is known to the root of the rounding over its curvature: 4e-6 of A was
    found at A = 0.02."""
    least = maugis_pull_off(row["lambda"])
    load, radius = float(least.load), float(least.radius)
    assert load == pytest.approx(row["P_pulloff_norm"], rel=DIGITS)
    assert 0.5 * load == pytest.approx(-row["minus_P_over_2piwR"], rel=DIGITS)
    assert radius == pytest.approx(row["A_at_pulloff_load"], rel=2e-5)
    assert row["lambda"] / LENNARD_JONES == pytest.approx(row["tabor_mu_approx"], rel=DIGITS)


def test_maugis_goes_to_dmt_and_to_jkr():
    """Toward DMT the load is off by πλA² and the approach by 1.5 sqrt(λ), toward JKR both by the
    order 1/λ²."""
    A = np.array([0.8, 1.5, 3.0])
    stiff, soft = maugis_state(1e-5, A), maugis_state(1e4, A)
    assert stiff.load == pytest.approx(A**3 - 2.0, abs=1.1e-5 * np.pi * A.max() ** 2)
    assert stiff.approach == pytest.approx(A**2, abs=1.6 * np.sqrt(1e-5))
    assert soft.load == pytest.approx(A**3 - A * np.sqrt(6.0 * A), abs=1e-6)
    assert soft.approach == pytest.approx(A**2 - 2.0 / 3.0 * np.sqrt(6.0 * A), abs=1e-6)
    assert float(maugis_pull_off(1e-4).load) == pytest.approx(-2.0, abs=1e-4)
    assert float(maugis_pull_off(1e3).load) == pytest.approx(-1.5, abs=1e-6)
    # in units: with all dimensions, against the classes
    jkr, dmt = JKR(1e9, 1e-6, 0.05), DMT(1e9, 1e-6, 0.05)
    loads = np.array([0.0, 1e-7, 1e-6])
    for theory, attraction, tolerance in ((jkr, 1e12, 1e-5), (dmt, 1.0, 1e-3)):
        near = MaugisDugdale(1e9, 1e-6, 0.05, attraction).at_load(loads)
        for quantity in ("radius", "approach", "load", "max_pressure", "stiffness"):
            wanted = getattr(theory.at_load(loads), quantity)
            assert getattr(near, quantity) == pytest.approx(wanted, rel=tolerance, abs=tolerance * np.abs(wanted).max())


def test_maugis_curves_reach_the_pull_off():
    sphere = MaugisDugdale(1e9, 1e-6, 0.05, 1e8)
    loads = np.linspace(-sphere.pull_off, 5.0 * sphere.pull_off, 200)
    answer = sphere.at_load(loads)
    # at pull-off the radius is known to 1e-8, the load to its square
    assert answer.load == pytest.approx(loads, rel=1e-9, abs=1e-12 * sphere.pull_off)
    assert np.all(np.diff(answer.radius) > 0.0)
    with refused(InputError, "load (N)"):
        sphere.at_load(-1.01 * sphere.pull_off)


@every_row(reference("adhesion/maugis_transition"), label=lambda row: f"{row['lambda']:g}")
def test_maugis_with_fixed_grips(row):
    """The fold in units of Maugis, and the same sphere with all dimensions: approach, load, and the
    outer radius of the attraction."""
    least = maugis_fold(row["lambda"])
    if row["delta_fold_norm"] != "":
        assert float(least.approach) == pytest.approx(row["delta_fold_norm"], rel=1e-12)
        assert float(least.load) == pytest.approx(row["P_at_delta_fold_norm"], rel=1e-5)
        assert float(least.radius) == pytest.approx(row["A_at_delta_fold"], rel=2e-5)
    else:
        assert float(least.radius) < 1e-3  # it shrinks to a point, found to the root of the rounding
    E_star, R, w = 1e9, 1e-6, 0.05
    K = 4.0 / 3.0 * E_star
    sphere = MaugisDugdale(E_star, R, w, 0.5 * row["lambda"] * np.cbrt(np.pi * w * K**2 / R))
    length, depth = np.cbrt(np.pi * w * R**2 / K), np.cbrt((np.pi * w / K) ** 2 * R)
    free = sphere.at_approach(row["delta_zero_load_norm"] * depth)
    assert free.radius == pytest.approx(row["A_zero_load"] * length, rel=1e-10)
    assert free.load == pytest.approx(0.0, abs=1e-10 * sphere.pull_off)
    apart = sphere.at_radius(row["A_at_pulloff"] * length)
    assert apart.outer_radius == pytest.approx(row["m_at_pulloff"] * row["A_at_pulloff"] * length, rel=1e-7)
    with refused(InputError, "approach (m)"):
        sphere.at_approach(1.001 * float(least.approach) * depth)


def test_columns_of_maugis_hold_the_outer_radius():
    sphere = MaugisDugdale(1e9, 1e-6, 0.05, 1e8)
    for way, value in (("load", 0.0), ("approach", 1e-9), ("contact_radius", 1e-7)):
        columns = {column.name: values for column, values in evaluate(sphere, **{way: [value]}).columns}
        assert columns["outer_radius"] > columns["radius"] > 0.0


@given(depth=st.floats(0.0, 1e-6))
def test_dmt_with_fixed_grips_is_hertz_less_the_pull_off(depth):
    dmt, hertz = DMT(1e9, 1e-6, 0.05), HertzPoint(1e9, 1e-6)
    assert dmt.at_approach(depth).load == pytest.approx(
        float(hertz.at_approach(depth).load) - dmt.pull_off, rel=1e-12, abs=1e-12 * dmt.pull_off
    )
    assert dmt.at_approach(depth).approach == pytest.approx(depth, rel=1e-12, abs=1e-30)
    with refused(InputError, "approach (m)"):
        dmt.at_approach(-1e-12)


@given(x=st.floats(1.01, 30.0))
def test_the_stiffness_of_jkr_is_its_derivative(x):
    sphere, step = JKR(1.0, 1.0, 0.3), 1e-5
    ends = [sphere.at_radius(x * sphere.critical_radius * (1.0 + s)) for s in (-step, step)]
    slope = (ends[1].load - ends[0].load) / (ends[1].approach - ends[0].approach)
    assert sphere.at_radius(x * sphere.critical_radius).stiffness == pytest.approx(float(slope), rel=1e-5, abs=1e-6)


def test_jkr_breaks_where_it_says():
    sphere = JKR(1e9, 1e-6, 0.05)
    x = np.linspace(0.9, 4.0, 3101)
    assert approach_ratio(x).min() == pytest.approx(-1.0)
    assert x[np.argmin(approach_ratio(x))] == pytest.approx(1.0, abs=1e-3)
    assert load_ratio(x).min() == pytest.approx(-1.0, abs=1e-6)
    at = sphere.at_load(-sphere.pull_off)
    # a³ = 3πwR²/2K there
    assert at.radius**3 == pytest.approx(9.0 / 8.0 * np.pi * 0.05 * 1e-12 / 1e9, rel=1e-7)
    with refused(InputError, "load (N)"):
        sphere.at_load(-1.001 * sphere.pull_off)
    with refused(InputError, "approach (m)"):
        sphere.at_approach(-1.001 * sphere.critical_extension)


def test_pressures_carry_the_load():
    """r = a sin θ removes both roots; the integrand is then a polynomial of sines."""
    angle, weight = gauss(np.array([0.0, 0.5 * np.pi]), 40)
    for theory, load, extra in ((JKR(1e9, 1e-6, 0.05), 2e-7, 0.0), (DMT(1e9, 1e-6, 0.05), 2e-7, 2.0 * np.pi * 0.05e-6)):
        a = float(theory.at_load(load).radius)
        rings = np.pi * a**2 * np.sin(2.0 * angle)
        total = np.sum(theory.pressure(a * np.sin(angle), load) * rings * weight)
        assert total == pytest.approx(load + extra, rel=1e-12)


def test_without_adhesion_it_is_hertz():
    hertz = HertzPoint(1e9, 1e-6).at_load([1e-7, 1e-6])
    for kind in (JKR, DMT):
        near = kind(1e9, 1e-6, 1e-18).at_load([1e-7, 1e-6])
        assert near.radius == pytest.approx(hertz.radius, rel=1e-5)  # the root of w over the load
        assert near.approach == pytest.approx(hertz.approach, rel=1e-4)


def test_validity_is_tabors():
    assert tabor_parameter(1e9, 1e-6, 0.05, 0.3e-9) == pytest.approx((1e-6 * (0.05 / 1e9) ** 2 / 0.3e-9**3) ** (1 / 3))
    soft, stiff = (1e6, 1e-6, 0.05), (1e12, 1e-9, 0.05)
    for kind, right, wrong in ((JKR, soft, stiff), (DMT, stiff, soft)):
        assert kind(*right).validity(kind(*right).at_load([0.0, 1e-9]))[0].holds.all()
        assert not kind(*wrong).validity(kind(*wrong).at_load([0.0, 1e-9]))[0].holds.any()
