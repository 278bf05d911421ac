"""Sensitivities of contacts against dense systems on the frozen set, differences of solutions, and
relations that must hold."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from reference_data import reference
from refusals import refused
from sensitivity_cases import CASES, COATED, MPA, NM, frozen_value, problem_of, rough, solved

import asperity as asp
from asperity.contact.boundary import Free, FreeLine, Periodic
from asperity.contact.operators import prepare_operator
from asperity.contact.operators.convolution import FreeOperator
from asperity.contact.problem import ContactProblem
from asperity.core.arrays import RealArray
from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.physics.sensitivities.outputs import OUTPUTS, Output, output
from asperity.physics.sensitivities.parameters import changed, parameters
from asperity.physics.sensitivities.system import FixedSet
from asperity.sensitivities import PressureNorm, Sensitivities, SmoothArea, sensitivities
from asperity.solvers import ActiveSet

OUTPUTS_TESTED: tuple[Any, ...] = (
    *OUTPUTS,
    PressureNorm(8.0),
    SmoothArea(300 * MPA),
)


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("of", OUTPUTS_TESTED, ids=lambda of: of if isinstance(of, str) else of.name)
def test_derivatives_are_those_of_differences_on_the_frozen_set(case: str, of: str | Output) -> None:
    result, step = solved(*CASES[case]), 1e-5
    found, wanted = sensitivities(result, of), output(of)
    problem, held = result.problem, found.held
    assert found.certificate.adjoint_residual <= 1e-8
    assert found.certificate.changed == 0
    assert result.plastic.any() == ("hardness" in case)
    relative, given = found.relative, {each.name: each.value for each in parameters(problem)}
    if "hardness" in case:
        given["hardness"] = problem.law.pressure_cap()
    last = "force" if held == "load" else "approach"
    assert {*given, last, "heights"} == {*found.values}
    largest = max(abs(relative[name]) for name in given)
    for name in (last, *given):

        def at(scale: float, name: str = name) -> float:
            if name == last:
                return frozen_value(result, problem, wanted, held, scale)
            return frozen_value(result, changed(problem, name, scale * given[name]), wanted, held)

        # five points leave an error of step⁴; near hardness few points carry what the load adds
        near, far = (at(1.0 + s) - at(1.0 - s) for s in (step, 2.0 * step))
        difference = (8.0 * near - far) / (12.0 * step * found.value)
        assert relative[name] == pytest.approx(difference, rel=1e-6, abs=1e-8 * largest + 1e-9), name


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("of", OUTPUTS_TESTED, ids=lambda of: of if isinstance(of, str) else of.name)
def test_heights_one_by_one(case: str, of: str | Output) -> None:
    result, wanted = solved(*CASES[case]), output(of)
    found = sensitivities(result, of, "heights")
    slope, problem = np.asarray(found["heights"]), result.problem
    top = int(np.argmax(problem.profile()))
    inside = np.flatnonzero(result.contact.ravel() & ~result.plastic.ravel())
    chosen = [top, inside[len(inside) // 3], inside[-1], int(np.flatnonzero(~result.contact.ravel())[0])]
    step = 1e-4 * NM
    for index in chosen:
        bump = np.zeros(problem.profile().shape)
        bump.flat[index] = step
        values = [
            frozen_value(result, changed(problem, "heights", k * bump), wanted, found.held) for k in (2, 1, -1, -2)
        ]
        difference = (8.0 * (values[1] - values[2]) - (values[0] - values[3])) / (12.0 * step)
        rounding = 1e-13 * abs(found.value) / step
        assert slope.ravel()[index] == pytest.approx(difference, rel=1e-6, abs=1e-7 * np.abs(slope).max() + rounding)


@pytest.mark.parametrize("case", CASES)
def test_adjoint_and_tangent_agree(case: str) -> None:
    result = solved(*CASES[case])
    problem = result.problem
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    free, generator = result.contact & ~result.plastic, np.random.default_rng(8)
    for held in ("load", "approach"):
        fixed = FixedSet(operator, free, held)  # type: ignore[arg-type]
        slope, rise = generator.standard_normal((2, *free.shape))
        total, change = generator.standard_normal(2) if held == "load" else (0.0, 0.0)
        adjoint, tangent = fixed.solve(slope, total), fixed.solve(rise, change)
        one = (adjoint.values * rise)[free].sum() + adjoint.multiplier * change
        other = (tangent.values * slope)[free].sum() + tangent.multiplier * total
        size = np.abs(adjoint.values[free] * rise[free]).sum()
        assert abs(one - other) <= 1e-8 * size


class _Inverse:
    """Influence 1/(1 + n) of points n apart on a line."""

    citation_keys = ()

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """Some decay, for the preconditioner."""
        return 1.0 / (1.0 + np.asarray(wavenumber))

    def mean_mode(self) -> float:
        """Of no meaning here."""
        return 1.0

    def influence(self, grid: Grid) -> RealArray:
        """Coefficients (nx, 1)."""
        return (1.0 / (1.0 + np.arange(grid.shape[0])))[:, None]

    line_influence = influence


@pytest.mark.parametrize("problem", [0.0, 2.0, 4.0])
def test_small_problems_with_rational_answers(problem: float) -> None:
    rows = [row for row in reference("sensitivities/small_contact") if row["problem"] == problem]
    column = {key: np.array([float(row[key]) for row in rows])[:, None] for key in rows[0] if key != "p_exact"}
    operator = FreeOperator(_Inverse(), Grid((len(rows), 1), (1.0, 1.0)))  # type: ignore[arg-type]
    p = column["p"]
    fixed = FixedSet(operator, p > 0.0, "load")
    adjoint, tangent = fixed.solve(p, 0.0, 1e-11), fixed.solve(np.zeros(p.shape), 1.0, 1e-11)
    assert adjoint.values == pytest.approx(column["dJ_dh"], abs=1e-9)
    assert adjoint.multiplier == pytest.approx(column["dJ_dP"][0, 0], rel=1e-9)
    assert tangent.values == pytest.approx(column["dp_dP"], abs=1e-9)
    assert -tangent.multiplier == pytest.approx(column["dapproach_dP"][0, 0], rel=1e-9)


@pytest.mark.parametrize("boundary", [Periodic(), Free()], ids=["periodic", "free"])
@pytest.mark.parametrize("of", OUTPUTS_TESTED, ids=lambda of: of if isinstance(of, str) else of.name)
def test_relations_of_scaling_and_of_the_datum(boundary: object, of: str | Output) -> None:
    result = solved(boundary)
    found = sensitivities(result, of)
    if found.output.degree is not None:
        assert abs(found.euler_defect) <= 1e-8
    slope = np.asarray(found["heights"])
    datum = {"offset": 1.0, "complementary_energy": -result.force}.get(found.output.name, 0.0)
    assert abs(slope.sum() - datum) <= 1e-8 * np.abs(slope).sum()
    # lengths of heights, layers, pixels and offset all scale alike: of a number that is a length
    # the sum over them is the number, of periodic contacts whose size scales too


def test_shifted_and_turned_surfaces_have_shifted_and_turned_derivatives() -> None:
    result, of = solved(Periodic()), PressureNorm(8.0)
    surface, slope = result.problem.surface, np.asarray(sensitivities(result, of, "heights")["heights"])
    for move in (lambda a: np.roll(a, (5, -3), (0, 1)), lambda a: np.ascontiguousarray(a.T)):
        moved = replace(result.problem, surface=asp.Surface(move(surface.heights), 50 * NM))
        again = asp.solve(moved, result.control, solver=ActiveSet(tolerance=1e-10))
        there = np.asarray(sensitivities(again, of, "heights")["heights"])
        assert np.abs(there - move(slope)).max() <= 1e-7 * np.abs(slope).max()


@pytest.mark.parametrize("boundary", [Periodic(), Free()], ids=["periodic", "free"])
def test_remainders_fall_as_the_square_of_the_step(boundary: object) -> None:
    found = sensitivities(solved(boundary), PressureNorm(8.0))
    for name in ("heights", "force", "body.layers[0].thickness", "body.layers[1].poisson_ratio"):
        test = found.taylor(name, (1e-3, 5e-4))
        assert not test.changed.any()
        assert test.orders == pytest.approx(2.0, abs=0.1), name


def test_stiffness_is_the_derivative_of_the_approach() -> None:
    result = solved(Free())
    found = sensitivities(result, "approach", "force")
    assert found["force"] == pytest.approx(1.0 / (result.normal_stiffness * result.problem.grid.area), rel=1e-5)
    assert sensitivities(result, "force", "approach", held="approach")["approach"] == pytest.approx(
        1.0 / float(found["force"]), rel=1e-8
    )
    share = -np.asarray(sensitivities(result, "approach", "heights")["heights"])
    share.flat[int(np.argmax(result.problem.profile()))] += 1.0
    assert share.min() >= 0.0


def test_the_dual_weighted_residual_is_the_error_of_a_rough_solve() -> None:
    rough_solve = asp.solve(problem_of(Free()), asp.MeanPressure(400 * MPA), solver=ActiveSet(tolerance=1e-4))
    close = solved(Free())
    if not np.array_equal(rough_solve.contact, close.contact):
        pytest.skip("the rough solve has another set")
    found = sensitivities(rough_solve, "approach", "force")
    error = close.approach - rough_solve.approach
    assert found.certificate.output_error == pytest.approx(error, abs=0.05 * abs(error) + 1e-9 * close.approach)
    assert found.value == pytest.approx(close.approach, rel=1e-9)


def test_names_are_chosen_by_their_beginning() -> None:
    result = solved(Periodic())
    assert {*sensitivities(result, to="body.base").values} == {"body.base.youngs_modulus", "body.base.poisson_ratio"}
    assert len(sensitivities(result, to=("body.layers", "force")).values) == 7
    found = sensitivities(result, to="body")
    assert found.influence[0] == max(found.relative, key=lambda name: abs(found.relative[name]))
    assert "approach" in repr(found)
    with refused(InputError, "parameter of a sensitivity", "'counter_body.thickness'"):
        sensitivities(result, to="counter_body.thickness")
    with refused(InputError, "parameter of the sensitivities", "'force'"):
        found["force"]


@pytest.mark.parametrize("of", ["contact_area", "max_pressure", "n_spots"])
def test_what_jumps_has_no_derivative(of: str) -> None:
    with refused(InputError, "output of a sensitivity", repr(of)):
        sensitivities(solved(Periodic()), of)


def test_contacts_without_derivatives_are_refused() -> None:
    plain, load = problem_of(Periodic()), asp.MeanPressure(100 * MPA)
    rubbing = asp.solve(plain.with_physics(friction=asp.Coulomb(0.2)), load)
    with refused(InputError, "contact of sensitivities", "friction"):
        sensitivities(rubbing)
    hard = asp.solve(problem_of(Periodic(), asp.Hardness(1e9)), asp.History([asp.MeanPressure(400 * MPA), load]))
    with refused(InputError, "contact of sensitivities"):
        sensitivities(hard.last)
    with refused(InputError, "result of sensitivities", "HistoryResult"):
        sensitivities(hard)  # type: ignore[arg-type]
    layered = asp.solve(replace(plain, law=asp.plasticity.LayeredHardness(_hard_body())), load)
    with refused(InputError, "law of sensitivities", "LayeredHardness"):
        sensitivities(layered)
    at_gap = asp.solve(plain, asp.MeanGap(20 * NM))
    with refused(InputError, "held of sensitivities", "None"):
        sensitivities(at_gap)
    assert isinstance(sensitivities(at_gap, held="load", to="force"), Sensitivities)
    with refused(InputError, "exponent of a norm of the pressure", "0.5"):
        PressureNorm(0.5)
    with refused(InputError, "pressure of a smooth area (Pa)"):
        SmoothArea(0.0)


def _hard_body() -> asp.Layered:
    hard = asp.Elastic(300e9, 0.2, asp.Strength(hardness=20e9))
    return asp.Layered([asp.Layer(hard, 60 * NM)], asp.Elastic(110e9, 0.3, asp.Strength(hardness=5e9)))


def test_full_periodic_contact() -> None:
    surface = asp.Surface(0.01 * rough((16, 16)), 50 * NM)
    problem = ContactProblem(surface, COATED)
    result = asp.solve(problem, asp.MeanPressure(5e9), solver=ActiveSet(tolerance=1e-10))
    assert result.contact.all()
    found = sensitivities(result, PressureNorm(2.0))
    assert abs(found.euler_defect) <= 1e-8
    assert sensitivities(result, "approach", "force")["force"] == pytest.approx(0.0, abs=1e-20)
    with refused(InputError, "contact of sensitivities at a held approach"):
        sensitivities(result, "force", held="approach")


@pytest.mark.parametrize("boundary", [Periodic(), Free(), FreeLine()], ids=["periodic", "free", "line"])
def test_films_on_a_rigid_base_and_layers_on_both_bodies(boundary: object) -> None:
    film = asp.Layered([asp.Layer(asp.Elastic(3e9, 0.4), 200 * NM)], asp.RigidBase())
    slipping = asp.Layered([asp.Layer(asp.Elastic(30e9, 0.3), 80 * NM, asp.Frictionless())], asp.Elastic(90e9, 0.2))
    plain = problem_of(boundary, body=film)
    for counter in (asp.Rigid(), slipping):
        problem = replace(plain, counter_body=counter)
        result = asp.solve(problem, asp.MeanPressure(60 * MPA), solver=ActiveSet(tolerance=1e-10))
        found, step = sensitivities(result, "approach"), 1e-4
        assert abs(found.euler_defect) <= 1e-8
        for each in parameters(problem):
            up, down = (
                frozen_value(result, changed(problem, each.name, each.value * scale), OUTPUTS["approach"], "load")
                for scale in (1.0 + step, 1.0 - step)
            )
            difference = (up - down) / (2.0 * step * found.value)
            assert found.relative[each.name] == pytest.approx(difference, rel=1e-6, abs=1e-7), each.name


def test_a_step_of_a_history_is_a_contact_like_any_other() -> None:
    loads = [asp.MeanPressure(value * MPA) for value in (100, 250, 400)]
    path = asp.solve(problem_of(Periodic()), asp.History(loads), solver=ActiveSet(tolerance=1e-10))
    step, alone = sensitivities(path.last, PressureNorm(8.0)), sensitivities(solved(Periodic()), PressureNorm(8.0))
    for name, value in alone.relative.items():
        assert step.relative[name] == pytest.approx(value, rel=1e-6, abs=1e-8)


@pytest.mark.parametrize("boundary", [Periodic(), Free()], ids=["periodic", "free"])
def test_a_tolerance_is_the_error_of_the_derivatives(boundary: object) -> None:
    result = solved(boundary)
    close = sensitivities(result, PressureNorm(8.0))
    wide = sensitivities(result, PressureNorm(8.0), tolerance=1e-4)
    assert 1e-8 < wide.certificate.adjoint_residual <= 1e-4
    assert wide.certificate.fft_pairs < close.certificate.fft_pairs
    largest = max(map(abs, close.relative.values()))
    for name, value in close.relative.items():
        assert wide.relative[name] == pytest.approx(value, abs=1e-3 * largest)
    with refused(InputError, "tolerance of sensitivities"):
        sensitivities(result, tolerance=0.0)
