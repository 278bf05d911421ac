"""Pressure and shear traction solved for together against the alternation between them."""

from dataclasses import replace

import numpy as np
import pytest
from contact_cases import rough

import asperity as asp
from asperity.physics.friction.solver.joint import JointProblem
from asperity.solvers import ActiveSet

TIGHT = {"solver": ActiveSet(tolerance=1e-12), "rounds": asp.solvers.Rounds(tolerances={"stick_slip": 1e-9})}
SOFT = asp.Elastic(1.0, 0.3)
COATED = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.25), 1.5)], base=SOFT)
ON_RIGID = asp.Layered([asp.Layer(asp.Elastic(1.0, 0.4), 5.0)], base=asp.RigidBase())
FORCE = asp.TangentialForce(6.0, 2.0)
MAP = asp.Coulomb(np.random.default_rng(0).uniform(0.0, 0.5, (24, 24)))
CASES = {
    "shift": ({}, asp.MeanPressure(0.1), asp.Shift(0.2, 0.1)),
    "force": ({}, asp.MeanPressure(0.1), FORCE),
    "coated": ({"body": COATED}, asp.MeanPressure(0.1), asp.Shift(0.2, 0.1)),
    "film on a rigid base": ({"body": ON_RIGID}, asp.Approach(1.0), asp.Shift(0.2, 0.1)),
    "free": ({"boundary": asp.Free()}, asp.MeanPressure(0.05), asp.Shift(0.1, 0.1, twist=0.02)),
    "map": ({"friction": MAP}, asp.MeanPressure(0.1), asp.Shift(0.2, 0.1)),
    "limit": ({"friction": asp.Coulomb(0.5, limit=0.1)}, asp.MeanPressure(0.1), asp.Shift(0.3, 0.1)),
    "full stick": ({"friction": asp.friction.FullStick()}, asp.MeanPressure(0.1), asp.Shift(0.2, 0.1)),
    "line": ({"surface": rough((64, 1), 5, power=1.5)}, asp.MeanPressure(0.1), asp.Shift(0.1, 0.1)),
}


@pytest.mark.parametrize("case", CASES)
def test_both_ways_lead_to_the_same_contact(case, monkeypatch):
    options, normal, tangential = CASES[case]
    settings = {"surface": rough((24, 24), 7, power=1.6), "body": SOFT, "friction": asp.Coulomb(0.4), **options}
    problem = asp.ContactProblem(**settings)
    steps = asp.History([asp.Step(normal, replace(tangential, x=0.0, y=0.0)), asp.Step(normal, tangential)])
    jointly = asp.solve(problem, steps, **TIGHT)
    with monkeypatch.context() as patch:
        patch.setattr(JointProblem, "solvable", False)
        in_turn = asp.solve(problem, steps, **TIGHT)
    for one, two in zip(jointly.steps, in_turn.steps, strict=True):
        assert np.linalg.norm(one.pressure - two.pressure) <= 1e-7 * np.linalg.norm(two.pressure)
        difference = np.linalg.norm(one.stick_slip.traction - two.stick_slip.traction)
        assert difference <= 1e-6 * np.linalg.norm(two.stick_slip.traction)
        assert one.stick_slip.shift_x == pytest.approx(two.stick_slip.shift_x, rel=1e-6, abs=1e-9)
    rounds = [sum(step.certificate.rounds for step in found.steps) for found in (jointly, in_turn)]
    assert rounds[0] <= 0.7 * rounds[1]
