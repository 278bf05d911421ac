"""The fast tangential solver against two independent ones, on every operator and kind of bound."""

import numpy as np
import pytest
from contact_cases import rough

import asperity as asp
from asperity.physics.friction.operator import TangentialOperator
from asperity.physics.friction.solver.newton import StickSlipNewton
from asperity.physics.friction.solver.problem import TangentialQP
from asperity.physics.friction.solver.reference import AcceleratedGradient, ProjectedGradients

COATED = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.25), 1.5)], base=asp.Elastic(1.0, 0.3))
ON_RIGID = asp.Layered([asp.Layer(asp.Elastic(1.0, 0.4), 5.0)], base=asp.RigidBase())
CASES = {
    "periodic": ((24, 20), asp.Elastic(1.0, 0.3), asp.Periodic()),
    "oblong pixels": ((24, 24), asp.Elastic(1.0, 0.3), asp.Periodic()),
    "coated": ((24, 24), COATED, asp.Periodic()),
    "film on a rigid base": ((25, 24), ON_RIGID, asp.Periodic()),
    "free": ((20, 24), asp.Elastic(1.0, 0.45), asp.Free()),
    "free coated": ((20, 20), COATED, asp.Free()),
    "line": ((64, 1), asp.Elastic(1.0, 0.3), asp.FreeLine()),
    "periodic line": ((64, 1), COATED, asp.Periodic()),
}
BOUNDS = ("coulomb", "constant", "map", "none slips")
LOADS = ("shift", "force", "field")


def posed(case, bound, load):
    """A tangential problem with the pressure of a rough contact."""
    shape, body, boundary = CASES[case]
    spacing = (1.0, 3.0) if case == "oblong pixels" else (1.0, 1.0)
    surface = rough(shape, 5, spacing=spacing, power=1.5)
    problem = asp.ContactProblem(surface, body, boundary=boundary)
    result = asp.solve(problem, asp.MeanPressure(0.2), keep=asp.Keep(stiffness=False))
    rng = np.random.default_rng(2)
    limit = {
        "coulomb": 0.4 * result.pressure,
        "constant": np.where(result.contact, 0.1, 0.0),
        "map": np.where(result.contact, rng.uniform(0.0, 0.3, shape), 0.0),
        "none slips": np.where(result.contact, np.inf, 0.0),
    }[bound]
    operator = TangentialOperator(problem.grid, (body, asp.Rigid()), boundary)
    if load == "force":
        most = 0.2 if bound == "none slips" else limit.mean()
        return TangentialQP(operator, limit, np.zeros((2, *shape)), np.array([0.5, 0.3]) * most)
    target = np.zeros((2, *shape)) + np.array([0.15, -0.05])[:, None, None]
    if load == "field":
        target = target + 0.1 * rng.standard_normal((2, *shape))
    return TangentialQP(operator, limit, target)


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("bound", BOUNDS)
@pytest.mark.parametrize("case", CASES)
def test_three_methods_agree(case, bound, load):
    """Tractions within the bound that the errors give: ½|q - q*|² in the energy norm is at most the
    duality gap."""
    qp = posed(case, bound, load)
    found = StickSlipNewton(tolerance=1e-10).solve(qp)
    assert found.status.converged, found.status.message
    assert np.all(np.hypot(*found.traction) <= qp.bound * (1.0 + 1e-9) + 1e-300)
    if qp.mean_traction is not None:
        assert found.traction.mean(axis=(1, 2)) == pytest.approx(qp.mean_traction, rel=1e-10)
    for method in (AcceleratedGradient(), ProjectedGradients()):
        other = method.solve(qp)
        assert other.status.converged, (method.name, other.status.message)
        step = other.traction - found.traction
        energy = float((step * qp.operator.displacement(step)).sum())
        scale = float((found.traction * qp.operator.displacement(found.traction)).sum()) + float(
            (np.hypot(*found.traction) * np.hypot(*found.slip)).sum()
        )
        assert 0.5 * energy <= 2e-6 * scale
