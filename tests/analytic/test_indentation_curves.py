"""Unloading curves: exact for elastic indenters, beside the unloading of an elastic-plastic sphere,
and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import reference
from refusals import refused

from asperity import theories
from asperity.core.errors import InputError

MODULUS, RADIUS = 100e9, 10e-6
DOWN = np.linspace(0.0, 1e-6, 41)
DEPTH = np.concatenate([DOWN, DOWN[::-1]])


@pytest.mark.parametrize(
    ("exponent", "factor"), [(1.0, 2e3), (1.5, 4.0 / 3.0 * MODULUS * math.sqrt(RADIUS)), (2.0, 3e12)]
)
@pytest.mark.parametrize("final", [0.0, 2.5e-7])
def test_a_power_law_is_found_again(exponent: float, factor: float, final: float) -> None:
    force = factor * np.maximum(DEPTH - final, 0.0) ** exponent
    fit = theories.fit_unloading(DEPTH, force)
    assert fit.exponent == pytest.approx(exponent, rel=1e-5)
    assert fit.final_depth == pytest.approx(final, abs=1e-5 * DOWN[-1])
    assert fit.stiffness == pytest.approx(exponent * factor * (1e-6 - final) ** (exponent - 1.0), rel=1e-6)
    assert fit.error < 1e-6
    np.testing.assert_allclose(fit.force(DEPTH), force, atol=1e-5 * force.max())


def test_elastic_paraboloid_gives_its_own_modulus_and_area() -> None:
    """Hertz: h_c = δ/2 and A = π R δ hold exactly with ε = 3/4, and no work is lost."""
    force = 4.0 / 3.0 * MODULUS * math.sqrt(RADIUS) * DEPTH**1.5
    area = math.pi * RADIUS * DOWN[-1]
    found = theories.analyse_indentation(DEPTH, force, theories.paraboloid_area(RADIUS), true_area=area)
    assert found.contact_depth == pytest.approx(0.5 * DOWN[-1], rel=1e-6)
    assert found.contact_modulus == pytest.approx(MODULUS, rel=1e-6)
    assert found.hardness == pytest.approx(found.true_hardness, rel=1e-6)
    assert found.pile_up == pytest.approx(1.0, rel=1e-6)
    assert found.dissipated_work == pytest.approx(0.0, abs=1e-12 * found.loading_work)
    # trapezia of x^1.5 on 40 steps err by 40^-2 (f'(1) - f'(0))/12 = 8e-5, of 0.4
    assert found.loading_work == pytest.approx(0.4 * force.max() * DOWN[-1], rel=3e-4)


def test_elastic_cone_by_its_exact_factor() -> None:
    """Sneddon: h_c = 2δ/π with ε = 2(π - 2)/π; the usual 0.72 errs by 0.5 % in depth."""
    angle = math.radians(70.3)
    force = 2.0 / math.pi * MODULUS * math.tan(angle) * DEPTH**2
    exact = theories.analyse_indentation(DEPTH, force, theories.cone_area(angle), shape=2.0 * (math.pi - 2.0) / math.pi)
    assert exact.contact_depth == pytest.approx(2.0 / math.pi * DOWN[-1], rel=1e-6)
    assert exact.contact_modulus == pytest.approx(MODULUS, rel=1e-6)
    usual = theories.analyse_indentation(DEPTH, force, theories.cone_area(angle), shape=0.72)
    assert usual.contact_modulus == pytest.approx(MODULUS, rel=6e-3)


def test_analysis_is_that_of_the_theory_at_the_same_stiffness() -> None:
    force = 3e12 * np.maximum(DEPTH - 3e-7, 0.0) ** 1.4
    found = theories.analyse_indentation(DEPTH, force)
    theory = theories.OliverPharr(found.unloading.peak_force, found.unloading.peak_depth, found.unloading.stiffness)
    assert found.hardness == pytest.approx(theory.hardness)
    assert found.contact_modulus == pytest.approx(theory.contact_modulus)


def test_unloading_of_a_sphere_that_yielded() -> None:
    """Initial slope 2 E* a of the table, within its 1 %; Hertz between the new radii leaves 3.0
    δ_y.

    The table ends at 0.7 of the largest approach; over that range the exponent is that of
    instruments (Oliver and Pharr 1992 found 1.25 to 1.51).
    """
    rows = reference("sphere_unloading")
    depth = np.array([float(row["delta_over_delta_y"]) for row in rows])
    force = np.array([float(row["P_over_Py"]) for row in rows])
    fit = theories.fit_unloading(depth, force)
    radius = 5.42 / 1.5  # a/a_y at the peak, from 2 E* a = 5.42 P_y/δ_y and P_y/δ_y = 4/3 E* a_y
    assert fit.stiffness == pytest.approx(1.5 * radius, rel=0.02)
    assert fit.peak_depth - 1.5 * fit.peak_force / fit.stiffness == pytest.approx(3.0, abs=0.1)
    assert 1.2 < fit.exponent < 1.51
    assert fit.error < 0.005


def test_residual_depth_of_the_fit() -> None:
    assert theories.residual_depth([0.5, 1.0]) == pytest.approx([0.0, 0.0])
    assert 10.0 * theories.residual_depth(10.0) == pytest.approx(2.7, abs=0.05)  # as the handbook of the field quotes
    many = theories.residual_depth(np.geomspace(1.0, 170.0, 50))
    assert (np.diff(many) > 0.0).all()
    assert many[-1] < 1.0


def test_only_the_first_unloading_counts() -> None:
    force = 2e9 * DEPTH**1.5
    again = theories.fit_unloading(np.concatenate([DEPTH, DOWN]), np.concatenate([force, 0.5 * force[:41]]))
    assert again.stiffness == pytest.approx(theories.fit_unloading(DEPTH, force).stiffness)


def test_refusals() -> None:
    with refused(InputError, "depth and force of a curve", "(3,)", "(2,)"):
        theories.fit_unloading([0.0, 1.0, 2.0], [0.0, 1.0])
    with refused(InputError, "depth and force of a curve"):
        theories.fit_unloading([0.0, math.nan], [0.0, 1.0])
    with refused(InputError, "force (N)", "0"):
        theories.fit_unloading([0.0, 1.0], [0.0, 0.0])
    with refused(InputError, "unloading", "1"):
        theories.fit_unloading(DOWN, DOWN**1.5)  # loading alone
    with refused(InputError, "contact depth (m)"):
        theories.analyse_indentation(DEPTH - 2e-6, 1e3 * DEPTH)
    with refused(InputError, "ratio", "not"):
        theories.residual_depth(-1.0)
