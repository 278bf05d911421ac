"""Stick and slip against independent solutions of discrete Coulomb problems, and against the
reduced theorem."""

import numpy as np
import pytest
from contact_cases import rough
from reference_data import reference

import asperity as asp
from asperity.physics.friction.operator import TangentialOperator
from asperity.physics.friction.solver.newton import StickSlipNewton
from asperity.physics.friction.solver.problem import TangentialQP
from asperity.solvers import ActiveSet

TIGHT = {"solver": ActiveSet(tolerance=1e-14), "rounds": asp.solvers.Rounds(tolerances={"stick_slip": 1e-11})}


def coated(base, *layers):
    return asp.Layered([asp.Layer(asp.Elastic(E, nu), h) for E, nu, h in layers], base=asp.Elastic(*base))


BODIES = {
    "identical_nu0": (asp.Elastic(2.0, 0.0), asp.Elastic(2.0, 0.0)),
    "identical_nu03": (asp.Elastic(2.0, 0.3), asp.Elastic(2.0, 0.3)),
    "rigid_on_homogeneous": (asp.Elastic(1.0, 0.2), asp.Rigid()),
    "rigid_on_layered": (coated((1.0, 0.3), (4.0, 0.25, 1.5)), asp.Rigid()),
    "layered_on_layered": (
        coated((2.0, 0.1), (5.0, 0.2, 0.8), (1.0, 0.45, 2.0)),
        coated((3.0, 0.3), (0.5, 0.4, 1.0)),
    ),
}
"""Bodies of the discrete problems: the lower one, and the counter body."""


@pytest.mark.parametrize("name", sorted({row["name"] for row in reference("discrete_coulomb_steps")}))
def test_discrete_problems(name):
    """Six implicit steps: every traction, number of slipping points, and the work of the slip
    (error of the data: 1e-12)."""
    rows = [row for row in reference("discrete_coulomb_steps") if row["name"] == name]
    heights = np.zeros((15, 15))
    for row in reference("discrete_coulomb_heights"):
        if row["case"] == rows[0]["case"]:
            heights[int(row["i"]), int(row["j"])] = row["h"]
    body, counter = BODIES[name]
    surface = asp.Surface(heights, 1.0, 1.0, periodic=True)
    problem = asp.ContactProblem(surface, body, counter_body=counter, friction=asp.Coulomb(rows[0]["mu"]))
    steps = [asp.Step(asp.MeanPressure(r["pbar"]), asp.Shift(r["delta_x"], r["delta_y"])) for r in rows]
    found = asp.solve(problem, asp.History(steps), **TIGHT)
    points = [row for row in reference("discrete_coulomb_fields") if row["case"] == rows[0]["case"]]
    for row, result in zip(rows, found.steps, strict=True):
        expected = np.zeros((3, 15, 15))
        for point in points:
            if point["step"] == row["step"]:
                expected[:, int(point["i"]), int(point["j"])] = point["p"], point["qx"], point["qy"]
        shear = result.stick_slip
        error = max(np.abs(result.pressure - expected[0]).max(), np.abs(shear.traction - expected[1:]).max())
        assert error <= 1e-10 * row["p_max"]
        assert np.count_nonzero(result.contact) == row["n_contact"]
        assert np.count_nonzero(shear.slipping) == row["n_slip"]
        assert shear.dissipated == pytest.approx(row["W_step"], rel=1e-9, abs=1e-14)
        assert abs(shear.complementarity) < 1e-10


@pytest.mark.parametrize("direction", [0.0, 0.7])
@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()])
def test_reduced_theorem(boundary, direction):
    """Equal bodies of ν = 0: q = μ [p(P) - p(P*)] and slip = μ times the gap at P*, on any grid
    (Ciavarella 1998; Jäger 1998)."""
    mu, load, share = 0.3, 0.02, 0.5
    body = asp.Elastic(2.0, 0.0)
    problem = asp.ContactProblem(rough((48, 48), 3, power=1.8), body, counter_body=body, boundary=boundary)
    tight = ActiveSet(tolerance=1e-12)
    full, less = (asp.solve(problem, asp.MeanPressure(p), solver=tight) for p in (load, load * (1.0 - share)))
    along = np.array([np.cos(direction), np.sin(direction)])
    target = (mu * (less.offset - full.offset) * along)[:, None, None] * np.ones((1, 48, 48))
    operator = TangentialOperator(problem.grid, (body, body), boundary)
    expected = mu * (full.pressure - less.pressure) * along[:, None, None]
    by_shift = TangentialQP(operator, mu * full.pressure, target)
    by_force = TangentialQP(operator, mu * full.pressure, 0.0 * target, mu * load * share * along)
    for qp in (by_shift, by_force):
        found = StickSlipNewton(tolerance=1e-10).solve(qp)
        assert found.status.converged
        assert np.linalg.norm(found.traction - expected) <= 1e-8 * np.linalg.norm(expected)
        gap = np.where(full.contact, mu * less.gap, 0.0) * along[:, None, None]
        assert np.abs(found.slip - gap).max() <= 1e-7 * np.abs(gap).max()
    assert found.shift == pytest.approx(target[:, 0, 0], rel=1e-8, abs=1e-10 * np.abs(target).max())
