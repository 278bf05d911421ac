"""Tangential stiffness by its own linear solve: against finite differences of steps, Mindlin, and
Cattaneo and Mindlin; contraction of rounds."""

import numpy as np
import pytest
from contact_cases import rough
from refusals import refused

import asperity as asp
from asperity.solvers import ActiveSet

TIGHT = {"solver": ActiveSet(tolerance=1e-13), "rounds": asp.solvers.Rounds(tolerances={"stick_slip": 1e-10})}
SOFT = asp.Elastic(1.0, 0.3)
COATED = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.25), 1.5)], base=SOFT)
CASES = {
    "unlike bodies": ({}, asp.MeanPressure(0.1)),
    "equal bodies": ({"counter_body": SOFT}, asp.MeanPressure(0.1)),
    "coated": ({"body": COATED}, asp.MeanPressure(0.1)),
    "position held": ({}, asp.MeanGap(1.0)),
    "free": ({"boundary": asp.Free()}, asp.MeanPressure(0.05)),
    "full stick": ({"friction": asp.friction.FullStick()}, asp.MeanPressure(0.1)),
    "pressure left": ({"friction": asp.Coulomb(0.4, coupled=False)}, asp.MeanPressure(0.1)),
    "hardness": ({"law": asp.Hardness(2.0), "counter_body": SOFT}, asp.MeanPressure(0.1)),
}


@pytest.mark.parametrize("case", CASES)
def test_derivative_of_the_force_by_the_shift(case):
    """Central differences of steps of 1e-5 of the shift, in which hardly any point changes between
    stick and slip."""
    options, normal = CASES[case]
    settings = {"surface": rough((24, 24), 7, power=1.6), "body": SOFT, "friction": asp.Coulomb(0.4), **options}
    problem = asp.ContactProblem(**settings)
    pressed = asp.solve(problem, asp.Step(normal, asp.Shift()), **TIGHT)

    def reached(shift):
        return asp.solve(problem, asp.Step(normal, asp.Shift(*shift)), state=pressed.state, **TIGHT)

    at, step = np.array([0.2, 0.1, 0.0]), 2e-6
    found = asp.friction.tangential_stiffness(reached(at)).matrix
    kinds = len(found)
    assert kinds == (3 if case == "free" else 2)
    columns = []
    for unit in np.eye(3)[:kinds]:
        ends = [reached(at + sign * step * unit).stick_slip for sign in (1.0, -1.0)]
        forces = [np.array([end.force_x, end.force_y, end.torque])[:kinds] for end in ends]
        columns.append((forces[0] - forces[1]) / (2.0 * step))
    wanted = np.stack(columns, axis=1)
    assert np.abs(found - wanted).max() <= 1e-4 * np.abs(wanted).max()


def test_stiffness_of_a_sphere():
    """Mindlin's 2 E* a without slip for ν = 0, and 2 E* a (1 - Q/μP)^(1/3) of Cattaneo and Mindlin
    under a rising force."""
    n, a, R, mu = 96, 0.1, 1.0, 0.4
    body = asp.Elastic(2.0, 0.0)
    P = 4.0 / 3.0 * a**3 / R
    spacing = 2.4 * a / n
    x = (np.arange(n) - 0.5 * (n - 1)) * spacing
    surface = asp.Surface(-(x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * R), spacing, spacing)
    problem = asp.ContactProblem(surface, body, counter_body=body, boundary=asp.Free(), friction=asp.Coulomb(mu))
    sticking = asp.ContactProblem(
        surface, body, counter_body=body, boundary=asp.Free(), friction=asp.friction.FullStick()
    )
    full = asp.solve(sticking, asp.Step(asp.Force(P), asp.TangentialForce(0.1 * mu * P)))
    mindlin = asp.friction.tangential_stiffness(full)
    assert mindlin.along(1.0, 0.0) == pytest.approx(2.0 * a, rel=0.02)  # the area of pixels is off by about 1 %
    assert mindlin.matrix[0, 0] == pytest.approx(mindlin.matrix[1, 1], rel=1e-4)
    assert mindlin.matrix[2, 2] == pytest.approx(16.0 / 3.0 * 0.5 * a**3, rel=0.04)  # 16/3 G* a³ without slip, G* = 1/2
    assert full.stick_slip.force_x / full.stick_slip.shift_x == pytest.approx(mindlin.along(1.0, 0.0), rel=1e-4)
    for share in (0.3, 0.7):
        found = asp.solve(problem, asp.Step(asp.Force(P), asp.TangentialForce(share * mu * P)))
        stiffness = asp.friction.tangential_stiffness(found).along(1.0, 0.0)
        assert stiffness == pytest.approx(2.0 * a * (1.0 - share) ** (1.0 / 3.0), rel=0.03)
        assert stiffness < found.stick_slip.force_x / found.stick_slip.shift_x  # the secant


def test_rounds_contract_by_friction_times_coupling():
    """None for equal bodies; in proportion to friction, and near one for a coefficient of several
    units, where all slides."""
    factors = {}
    for mu in (0.2, 0.4, 5.0):
        problem = asp.ContactProblem(rough((24, 24), 7, power=1.6), SOFT, friction=asp.Coulomb(mu))
        found = asp.solve(problem, asp.Step(asp.MeanPressure(0.1), asp.Shift(1e4)))
        factors[mu] = asp.friction.contraction_factor(found)
        if mu < 1.0:
            (check,) = (item for item in found.certificate.couplings if item.name == "stick_slip")
            assert found.certificate.complementarity == found.stick_slip.complementarity <= 1e-5
            assert check.residual <= check.tolerance
    assert 0.0 < factors[0.2] < 0.2 * 0.5  # μ β, β <= 1/2
    assert factors[0.4] == pytest.approx(2.0 * factors[0.2], rel=0.3)
    assert factors[5.0] > 0.5  # 0.8: 44 rounds
    twins = asp.ContactProblem(rough((24, 24), 7, power=1.6), SOFT, counter_body=SOFT, friction=asp.Coulomb(0.4))
    assert asp.friction.contraction_factor(asp.solve(twins, asp.Step(asp.MeanPressure(0.1), asp.Shift(0.1)))) == 0.0


def test_what_does_not_touch_has_no_stiffness():
    problem = asp.ContactProblem(rough((16, 16), 7, power=1.6), SOFT, friction=asp.Coulomb(0.4))
    apart = asp.solve(problem, asp.Step(asp.Unloaded(), asp.Shift()))
    with refused(asp.InputError, "result of a tangential stiffness"):
        asp.friction.tangential_stiffness(apart)
