"""What a problem and a control refuse, and how they say it."""

import numpy as np
import pytest
from contact_cases import elastic, rough
from refusals import refused

import asperity as asp


@pytest.mark.parametrize("control", [asp.MeanPressure, asp.Force, asp.Approach, asp.MeanGap])
@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf, "10 kPa"])
def test_controls_must_be_positive(control, bad):
    with refused(asp.InputError, f"{control.name} ({control.unit})", str(bad)):
        control(bad)


@pytest.mark.parametrize(
    ("modulus", "ratio"), [(0, 0.3), (-1e9, 0.3), (np.nan, 0.3), (1e9, 0.51), (1e9, -1.0), (1e9, 0.7)]
)
def test_elastic_constants_have_ranges(modulus, ratio):
    subject, value = ("Poisson's ratio", ratio) if modulus == 1e9 else ("Young's modulus (Pa)", modulus)
    with refused(asp.InputError, subject, str(value)):
        asp.Elastic(modulus, ratio)


def test_contact_modulus():
    steel, rubber = asp.Elastic(210e9, 0.3), asp.Elastic(1e6, 0.49)
    expected = 1.0 / (0.91 / 210e9 + (1 - 0.49**2) / 1e6)
    assert asp.solids.contact_modulus(steel, rubber) == pytest.approx(expected, rel=1e-15)
    assert asp.solids.contact_modulus(asp.Rigid(), steel) == pytest.approx(210e9 / 0.91, rel=1e-15)


def test_two_rigid_bodies_are_refused():
    with refused(asp.InputError, "body and counter_body"):
        asp.ContactProblem(rough((4, 4)), asp.Rigid())


def test_missing_points_are_refused_with_the_remedy():
    heights = rough((6, 6)).heights.copy()
    heights[2, 3] = np.nan
    holed = asp.Surface(heights, 1.0)
    with refused(asp.InputError, "surface", "1"):
        asp.ContactProblem(holed, elastic(1.0))
    with refused(asp.InputError, "counter_surface"):
        asp.ContactProblem(rough((6, 6)), elastic(1.0), counter_surface=holed)


def test_surfaces_must_share_a_grid():
    with refused(asp.InputError, "the two surfaces of a pair"):
        asp.ContactProblem(rough((6, 6)), elastic(1.0), counter_surface=rough((6, 8)))


@pytest.mark.parametrize(
    ("field", "value"),
    [("surface", np.zeros((4, 4))), ("body", "steel"), ("boundary", "periodic"), ("counter_body", None)],
)
def test_wrong_types_are_named(field, value):
    arguments = {"surface": rough((4, 4)), "body": elastic(1.0), field: value}
    with refused(asp.InputError, f"{field} of a ContactProblem", type(value).__name__):
        asp.ContactProblem(**arguments)


def test_hardness_map_must_fit():
    with refused(asp.InputError, "hardness array", "4"):
        asp.ContactProblem(rough((4, 4)), elastic(1.0), law=asp.Hardness(np.ones((3, 4))))


def test_position_beyond_full_contact_is_refused():
    problem = asp.ContactProblem(rough((8, 8)), elastic(1.0))
    profile = problem.profile()
    limit = profile.max() - profile.mean()
    with refused(asp.errors.NoSolutionError, "approach"):
        asp.solve(problem, asp.Approach(limit))
    with refused(asp.errors.NoSolutionError, "mean gap"):
        asp.solve(problem, asp.MeanGap(limit))


def test_unconverged_is_an_exception_that_holds_the_result_or_a_flag():
    problem = asp.ContactProblem(rough((32, 32)), elastic(1.0))
    hasty = asp.solvers.ConjugateGradient(max_iterations=2)
    with pytest.raises(asp.ConvergenceError, match="max_iterations") as caught:
        asp.solve(problem, asp.MeanPressure(0.05), solver=hasty)
    assert caught.value.result.status.outcome == "iteration limit"
    assert caught.value.result.certificate.iterations == 2
    returned = asp.solve(problem, asp.MeanPressure(0.05), solver=hasty, on_failure="return")
    assert not returned.converged
    assert returned.status.remedy
    for control in (asp.Approach(0.5), asp.MeanGap(1.0)):
        assert not asp.solve(problem, control, solver=hasty, on_failure="return").converged
    with refused(asp.InputError, "on_failure"):
        asp.solve(problem, asp.MeanPressure(0.05), on_failure="ignore")


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (7, 1), (2, 3)])
@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()])
@pytest.mark.parametrize("method", list(asp.solvers.SOLVERS))
@pytest.mark.parametrize("law", [asp.plasticity.HardWall(), asp.Hardness(1.0)], ids=["elastic", "hardness"])
def test_tiny_grids(shape, boundary, method, law):
    heights = np.arange(shape[0] * shape[1], dtype=float).reshape(shape)
    problem = asp.ContactProblem(asp.Surface(heights, 1.0), elastic(1.0), boundary=boundary, law=law)
    result = asp.solve(problem, asp.MeanPressure(0.01), solver=asp.solvers.solver_by_name(method))
    assert result.mean_pressure == pytest.approx(0.01)
    assert result.pressure.argmax() == heights.argmax()


def test_flat_on_flat():
    flat = asp.generate.flat(asp.Grid((16, 16), (1.0, 1.0)))
    everywhere = asp.solve(asp.ContactProblem(flat, elastic(1.0)), asp.MeanPressure(0.1))
    np.testing.assert_allclose(everywhere.pressure, 0.1, rtol=1e-12)
    punch = asp.solve(asp.ContactProblem(flat, elastic(1.0), boundary=asp.Free()), asp.MeanPressure(0.1))
    assert punch.pressure[0, 0] > punch.pressure[8, 8] > 0.0
    assert punch.area_fraction == 1.0


def test_prepared_operator_is_reused_and_checked():
    problem = asp.ContactProblem(rough((16, 16)), elastic(1.0))
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary)
    a, b = (asp.solve(problem, asp.MeanPressure(0.05), operator=o) for o in (operator, None))
    np.testing.assert_array_equal(a.pressure, b.pressure)
    other = asp.solvers.prepare_operator(problem.compliance, asp.Grid((8, 8), (1.0, 1.0)), problem.boundary)
    with refused(asp.InputError, "operator"):
        asp.solve(problem, asp.MeanPressure(0.05), operator=other)
    stiffer = asp.ContactProblem(rough((16, 16)), elastic(2.0))
    free = asp.ContactProblem(rough((16, 16)), elastic(1.0), boundary=asp.Free())
    for wrong, what in ((stiffer, "compliance"), (free, "boundary")):
        with refused(asp.InputError, "operator", what):
            asp.solve(wrong, asp.MeanPressure(0.05), operator=operator)
    with refused(asp.InputError, "boundary of an operator", "'periodic'"):
        asp.solvers.prepare_operator(problem.compliance, problem.grid, "periodic")


def test_an_approach_above_the_dented_surface_has_no_solution():
    soft = asp.ContactProblem(rough((16, 16)), elastic(1.0), law=asp.Hardness(0.3))
    dented = asp.solve(soft, asp.MeanPressure(0.1)).state
    with refused(asp.errors.NoSolutionError, "approach", "1e-09 m"):
        asp.solve(soft, asp.Approach(1e-9), state=dented)


def test_a_position_that_no_load_reaches_is_flagged():
    """Nearly every point of this sphere yields before its last gaps close: the mean gap jumps over
    values near rounding."""
    sphere = asp.generate.sphere(asp.Grid((24, 16), (1e-6, 1.25e-6)), radius=1e-3)
    law = asp.Hardness(200e6)
    problem = asp.ContactProblem(sphere, asp.Elastic(135e9, 0.3), boundary=asp.Free(), law=law)
    for gap in (1e-9, 1e-12):
        reached = asp.solve(problem, asp.MeanGap(gap))
        assert reached.mean_gap == pytest.approx(gap, rel=1e-4)
        assert reached.max_pressure <= 200e6
    missed = asp.solve(problem, asp.MeanGap(1e-18), on_failure="return")
    assert not missed.converged
    assert "No load reaches the prescribed position" in missed.status.message
    with pytest.raises(asp.ConvergenceError) as caught:
        asp.solve(problem, asp.MeanGap(1e-18))
    assert caught.value.result.status == missed.status


def test_solver_by_its_name_only_is_refused_with_the_way_out():
    problem = asp.ContactProblem(rough((4, 4)), elastic(1.0))
    with refused(asp.InputError, "solver", "solver_by_name"):
        asp.solve(problem, asp.MeanPressure(0.1), solver="nnls")


def test_control_of_another_type_is_refused():
    flat = asp.ContactProblem(asp.generate.flat(asp.Grid((4, 4), (1.0, 1.0))), elastic(1.0))
    for wrong in (50e3, "50 kPa", None):
        with refused(asp.InputError, "control"):
            asp.solve(flat, wrong)


@pytest.mark.parametrize(
    "settings", [{"tolerance": -1.0}, {"tolerance": 2.0}, {"tolerance": np.nan}, {"max_iterations": 0}]
)
@pytest.mark.parametrize("method", list(asp.solvers.SOLVERS))
def test_solvers_check_their_settings(method, settings):
    subject = "tolerance" if "tolerance" in settings else "iteration limit"
    with refused(asp.InputError, f"{subject} of the solver {method}", *map(str, settings.values())):
        asp.solvers.SOLVERS[method](**settings)


@pytest.mark.parametrize("bad", [-1e-9, np.nan, np.inf])
def test_impossible_state_is_refused(bad):
    sound, broken = np.zeros((4, 4)), np.full((4, 4), bad)
    with refused(asp.InputError, "permanent indentation (m) of an interface state"):
        asp.solvers.InterfaceState.dented(broken, sound)
    with refused(asp.InputError, "pressure (Pa) of an interface state"):
        asp.solvers.InterfaceState.dented(sound, broken)


@pytest.mark.parametrize("bad", ["1 GPa", True])
def test_hardness_is_a_number(bad):
    with refused(asp.InputError, "hardness (Pa)"):
        asp.Hardness(bad)


def test_law_of_another_type_is_refused():
    with refused(asp.InputError, "law of a ContactProblem"):
        asp.ContactProblem(rough((4, 4)), elastic(1.0), law="hard wall")


def test_state_of_another_grid_is_refused():
    state = asp.solve(asp.ContactProblem(rough((8, 8)), elastic(1.0)), asp.MeanPressure(0.05)).state
    with refused(asp.InputError, "permanent indentation of the state"):
        asp.solve(asp.ContactProblem(rough((8, 9)), elastic(1.0)), asp.MeanPressure(0.05), state=state)
