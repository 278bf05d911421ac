"""Laws of normal compliance: their limits, their fit to curves, and what they refuse."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

import asperity as asp
from asperity import dynamics as dyn
from asperity.core.errors import InputError


@given(st.floats(1.0, 5.0), st.floats(1e5, 1e25), st.floats(1e-9, 1e-5))
def test_a_law_is_consistent(power: float, coefficient: float, depth: float) -> None:
    """Stiffness and pressure are derivatives of the energy, and the approach is the inverse of the
    pressure."""
    law = dyn.NormalCompliance(coefficient, power)
    step = 1e-4 * depth
    slope = (law.energy(depth + step) - law.energy(depth - step)) / (2.0 * step)
    np.testing.assert_allclose(slope, law.pressure(depth), rtol=1e-6)  # (m h/δ)² / 6
    slope = (law.pressure(depth + step) - law.pressure(depth - step)) / (2.0 * step)
    np.testing.assert_allclose(slope, law.stiffness(depth), rtol=1e-6)
    np.testing.assert_allclose(law.approach(law.pressure(depth)), depth, rtol=1e-12)
    assert law.pressure(-depth) == law.friction(-depth) == law.energy(-depth) == 0.0


def test_damping_never_pulls() -> None:
    law = dyn.NormalCompliance.amontons(1e18, 2.0, relative_damping=50.0)
    assert law.pressure(1e-7, -1.0) == 0.0
    assert law.pressure(1e-7, 1e-2) == pytest.approx(1.5 * float(law.pressure(1e-7)))


@given(st.floats(0.2, 2.0), st.floats(1.2, 4.0), st.floats(1.2, 4.0))
def test_friction_coefficient_is_a_power_of_the_pressure(strength: float, normal: float, tangential: float) -> None:
    """μ = C p^α with α = m_t/m_n - 1 and C = c_t c_n^(-m_t/m_n)."""
    law = dyn.NormalCompliance(1e18, normal, friction_coefficient=strength * 1e18, friction_exponent=tangential)
    depth = law.approach(1e6)
    np.testing.assert_allclose(law.coefficient(1e6), law.friction(depth) / law.pressure(depth), rtol=1e-10)


def test_metal_joints() -> None:
    """0.6 µm/MPa^0.5 is 2.8e18 Pa/m², and 1 MPa closes such a joint by 0.6 µm."""
    law = dyn.metal_joint(0.6)
    assert law.normal_coefficient == pytest.approx(2.8e18, rel=0.01)
    assert float(law.approach(1e6)) == pytest.approx(0.6e-6, rel=1e-12)


@given(st.floats(1.2, 4.0), st.floats(1e15, 1e20), st.floats(-5.0, 5.0))
def test_a_fit_finds_the_law_of_its_curve(power: float, coefficient: float, offset: float) -> None:
    """An exact curve gives its law back: with its offset to rounding, without to the search of
    1e-10 in the logarithm."""
    depth = np.geomspace(1e-7, 1e-6, 9)
    pressure = coefficient * depth**power
    given_offset = dyn.fit_compliance(depth + offset * 1e-7, pressure, offset=offset * 1e-7)
    assert given_offset.law.normal_exponent == pytest.approx(power, rel=1e-8)
    assert given_offset.largest_error < 1e-6
    free = dyn.fit_compliance(depth + offset * 1e-7, pressure)
    assert free.law.normal_exponent == pytest.approx(power, rel=1e-4)
    assert free.offset == pytest.approx(offset * 1e-7, abs=1e-11)


def test_the_error_of_the_exponent_covers_scatter() -> None:
    """With 3 % of scatter the exponent is within two standard errors in 95 % of the cases, here in
    at least 85 of 100."""
    random, depth = np.random.default_rng(7), np.geomspace(1e-8, 1e-7, 12)
    inside = 0
    for _ in range(100):
        pressure = np.sort(1e20 * depth**2.5 * np.exp(0.03 * random.standard_normal(12)))
        fit = dyn.fit_compliance(depth, pressure, offset=0.0)
        inside += abs(fit.law.normal_exponent - 2.5) < 2.0 * fit.exponent_error
    assert inside >= 85


def test_the_law_of_a_solved_contact_has_its_stiffness() -> None:
    """dp/du of the fitted law about the middle of the curve agrees with the stiffness that the
    contact itself reports."""
    spectrum = asp.generate.GaussianAutocorrelation(1e-7, 2e-6)
    surface = asp.generate.gaussian(asp.Grid((64, 64), (1e-5 / 64, 1e-5 / 64)), spectrum, seed=3)
    problem = asp.ContactProblem(surface, asp.Elastic(2.1e11, 0.3))
    pressures = np.geomspace(1e7, 1e8, 9)
    path = asp.solve(problem, asp.History([asp.MeanPressure(p) for p in pressures]))
    fit = dyn.fit_compliance([s.approach for s in path.steps], pressures, offset=0.0)
    middle = asp.solve(problem, asp.MeanPressure(pressures[4]), keep=asp.Keep(stiffness=True))
    found = float(fit.law.stiffness(middle.approach))
    # the error of a slope is that of the pressure times the exponent over the step in the
    # logarithm, about 1 here
    assert found == pytest.approx(middle.normal_stiffness, rel=4.0 * fit.largest_error)
    assert fit.stiffness_exponent == pytest.approx(1.0 - 1.0 / fit.law.normal_exponent)


def test_friction_of_a_shear_strength() -> None:
    """Shear that grows as the area gives the power of the friction; Amontons friction that of the
    pressure."""
    depth = np.geomspace(1e-8, 1e-7, 6)
    fit = dyn.fit_compliance(depth, 1e20 * depth**2.5, offset=0.0, shear=1e15 * depth**2.0)
    assert fit.law.friction_power == pytest.approx(2.0, rel=1e-10)
    amontons = dyn.fit_compliance(depth, 1e20 * depth**2.5, offset=0.0, shear=0.3e20 * depth**2.5)
    np.testing.assert_allclose(amontons.law.coefficient([1e4, 1e6]), 0.3, rtol=1e-8)


def test_refusals() -> None:
    depth = np.geomspace(1e-8, 1e-7, 6)
    with refused(InputError, "approach and pressure"):
        dyn.fit_compliance(depth[:3], depth[:3])
    with refused(InputError, "pressure"):
        dyn.fit_compliance(depth, depth[::-1])
    with refused(InputError, "offset (m)", "1e-08"):
        dyn.fit_compliance(depth, depth**2, offset=1e-8)
    with refused(InputError, "shear"):
        dyn.fit_compliance(depth, depth**2, offset=0.0, shear=[1.0, 0.0, 1.0, 1.0, 1.0, 1.0])
    with refused(InputError, "power of the approach that the pressure follows", "14"):
        dyn.fit_compliance(depth, depth**14.0, offset=0.0)
    with refused(InputError, "normal_exponent of law of normal compliance", "20"):
        dyn.NormalCompliance(1e18, 20.0)
