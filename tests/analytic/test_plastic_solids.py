"""Plastic flow of a material point, cavities and shakedown against independent solutions and
laws."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference_data import Row, every_row, reference
from refusals import refused

import asperity as asp
from asperity import theories
from asperity.core.errors import InputError
from asperity.solids.plasticity import J2, WEIGHTS, LinearHardening, PlasticState, Swift, Voce, von_mises

PATHS: dict[object, list[Row]] = {}
for line in reference("j2_material_point"):
    PATHS.setdefault(line["case"], []).append(line)


def solid_of(row: Row) -> J2:
    def number(name: str) -> float:
        return float(row[name] or 0.0)

    laws: dict[str, Any] = {
        "swift": lambda: Swift(number("Y"), number("e0"), number("n")),
        "voce": lambda: Voce(number("Y"), number("Q"), number("b")),
    }
    hardening = laws.get(str(row["law"]), lambda: LinearHardening(number("Y"), number("H")))()
    return J2(asp.Elastic(number("E"), number("nu")), hardening, number("Hk"))


def components(row: Row, letter: str) -> np.ndarray:
    return np.array([row[f"{letter}{pair}"] for pair in ("11", "22", "33", "12", "13", "23")], dtype=float)


@pytest.mark.parametrize("case", sorted(PATHS, key=str))
def test_paths_of_a_material_point(case: object) -> None:
    """Stress, plastic strain and consistent tangent of implicit steps, computed elsewhere with 40
    digits."""
    solid, state = solid_of(PATHS[case][0]), None
    for row in PATHS[case]:
        step = solid.step(components(row, "e"), state, tangent=True)
        state, wanted = step.state, components(row, "s")
        np.testing.assert_allclose(step.stress, wanted, atol=1e-13 * np.abs(wanted).max())
        np.testing.assert_allclose(step.state.accumulated, row["eqps"], rtol=1e-13)
        assert step.tangent is not None
        found = [step.tangent[0, 0], step.tangent[1, 0], step.tangent[2, 0], step.tangent[3, 3]]
        names = ("D1111", "D2211", "D3311", "D1212")
        np.testing.assert_allclose(found, [row[name] for name in names], atol=1e-13 * float(row["D1111"]))


HARDENING = {"linear": LinearHardening(1.0, 5.0), "swift": Swift(1.0, 0.01, 0.2), "voce": Voce(1.0, 0.5, 20.0)}


@pytest.mark.parametrize("law", HARDENING)
@pytest.mark.parametrize(("kinematic", "recall"), [(0.0, 0.0), (20.0, 0.0), (20.0, 30.0)])
def test_the_tangent_is_the_derivative(law: str, kinematic: float, recall: float) -> None:
    """Central differences of 1e-6 err by their square and by rounding over them; symmetric unless
    back stress is recalled."""
    random = np.random.default_rng(3)
    solid = J2(asp.Elastic(200.0, 0.3), HARDENING[law], kinematic, recall)
    first = solid.step(0.02 * random.standard_normal((40, 6)))
    strain, turn = 0.02 * random.standard_normal((40, 6)), random.standard_normal((40, 6))
    step = solid.step(strain, first.state, tangent=True)
    assert step.tangent is not None
    ahead, behind = (solid.step(strain + sign * 1e-6 * turn, first.state).stress for sign in (1.0, -1.0))
    slope = np.einsum("pij,pj->pi", step.tangent, WEIGHTS * turn)
    np.testing.assert_allclose((ahead - behind) / 2e-6, slope, atol=1e-6 * np.abs(slope).max())
    if recall == 0.0:
        np.testing.assert_allclose(step.tangent, np.swapaxes(step.tangent, 1, 2), atol=1e-12 * 200.0)


@given(st.lists(st.floats(-0.05, 0.05), min_size=6, max_size=6), st.floats(0.0, 50.0), st.floats(0.0, 0.45))
def test_laws_of_plastic_flow(strain: list[float], modulus: float, nu: float) -> None:
    """The stress stays within yield, plastic strain keeps the volume, and plastic work is not
    negative."""
    solid = J2(asp.Elastic(200.0, nu), LinearHardening(1.0, modulus))
    step = solid.step(strain)
    q = step.state.accumulated
    assert von_mises(step.stress) <= solid.hardening.yield_stress(q) * (1.0 + 1e-10)
    assert abs(step.state.plastic_strain[:3].sum()) < 1e-15
    assert (step.stress * step.state.plastic_strain) @ WEIGHTS >= 0.0
    assert math.isclose(math.sqrt(2.0 / 3.0 * step.state.plastic_strain**2 @ WEIGHTS), q, rel_tol=1e-9, abs_tol=1e-15)


def test_one_large_radial_step_is_many_small_ones() -> None:
    """Along a ray from the virgin state radial return is exact."""
    solid, ray = J2(asp.Elastic(200.0, 0.3), Swift(1.0, 0.01, 0.2)), np.array([0.03, -0.01, -0.02, 0.01, 0.0, 0.02])
    state: PlasticState | None = None
    for share in np.linspace(0.05, 1.0, 20):
        state = solid.step(share * ray, state).state
    assert state is not None
    np.testing.assert_allclose(state.accumulated, solid.step(ray).state.accumulated, rtol=1e-12)


def test_recall_bounds_the_back_stress() -> None:
    """Under ever growing strain the back stress tends to H_k/γ (Armstrong and Frederick); Prager's
    grows on."""
    solid, state = J2(asp.Elastic(200.0, 0.3), LinearHardening(1.0), 20.0, 30.0), None
    for strain in np.linspace(0.005, 0.5, 100):
        state = solid.step(np.array([1.0, -0.5, -0.5, 0.0, 0.0, 0.0]) * strain, state).state
    assert state is not None
    assert float(von_mises(state.back_stress)) == pytest.approx(20.0 / 30.0, rel=1e-5)


@every_row(reference("expanding_cavity"))
def test_expanding_cavity(row: Row) -> None:
    found = theories.expanding_cavity(row["c_over_a"], row["E_over_Y"], row["nu"])
    np.testing.assert_allclose([found.pressure, found.displacement], [row["p_over_Y"], row["u_a_over_a"]], rtol=1e-13)


@every_row(reference("cavity_model_sphere"))
def test_cavity_model(row: Row) -> None:
    found = theories.cavity_model(row["Estar_a_over_YR"], row["nu"], most=math.inf)
    np.testing.assert_allclose(found, row["pm_over_Y"], rtol=1e-13)


@pytest.mark.slow
@every_row(reference("shakedown_line"))
def test_shakedown_of_a_sliding_cylinder(row: Row) -> None:
    """Within 1e-5, the error of the table; depths within 1e-3."""
    found = theories.cylinder_shakedown(float(row["mu"]))
    np.testing.assert_allclose(found.peak_over_k, row["p0_over_k_shakedown"], rtol=1e-5)
    np.testing.assert_allclose(found.depth, row["z_over_a"], atol=1e-3)
    assert found.residual <= 1e-9  # compression protects


def test_pure_rolling() -> None:
    """4k at half a half-width, protected by a residual compression of 0.134 p_0 (Johnson 1962)."""
    found = theories.cylinder_shakedown()
    assert found.peak_over_k == pytest.approx(4.0, rel=1e-7)
    assert found.depth == pytest.approx(0.5, abs=1e-4)
    assert found.residual == pytest.approx(-0.134, abs=1e-4)


def test_shakedown_from_the_stresses_of_a_solved_contact() -> None:
    """The limit of a solved cylinder is 4k p_0 within the error of its stresses, of first order in
    the pixel; a coating of the body's own material changes nothing."""
    x = (np.arange(256) - 127.5) * 1e-5
    cylinder = asp.Surface((-(x**2) / 0.2)[:, None], 1e-5, 1e-5)
    steel = asp.Elastic(2e11, 0.3)
    limits = []
    for body in (steel, asp.Layered([asp.Layer(steel, 2e-4)], base=steel)):
        problem = asp.ContactProblem(cylinder, body, boundary=asp.FreeLine())
        result = asp.solve(problem, asp.MeanPressure(1e8))
        half_width = 0.5 * result.contact.sum() * 1e-5
        field = asp.stress(result, half_width * np.linspace(0.3, 0.7, 9))
        along = field.tensor.map(lambda component: component.reshape(9, -1))
        limits.append(theories.line_shakedown(along, 1.0).limit * result.pressure.max())
    assert limits[0] == pytest.approx(4.0, rel=0.02)
    assert limits[1] == pytest.approx(limits[0], rel=1e-9)


def test_refusals() -> None:
    with refused(InputError, "strain"):
        J2(asp.Elastic(1.0, 0.3), LinearHardening(1.0)).step(np.zeros(5))
    with refused(InputError, "exponent of Swift hardening", "1.5"):
        Swift(1.0, 0.01, 1.5)
    with refused(InputError, "Poisson's ratio of a J2 solid", "0.5"):
        J2(asp.Elastic(1.0, 0.5), LinearHardening(1.0))
    with refused(InputError, "ratio"):
        theories.expanding_cavity(0.5, 100.0, 0.3)
    with refused(InputError, "friction coefficient", "-1"):
        theories.cylinder_shakedown(-1.0)
