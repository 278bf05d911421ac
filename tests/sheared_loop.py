"""A sphere that is sheared, and the energy that a loop leaves over, for the tests of viscoelastic
half-spaces and of layers."""

from __future__ import annotations

import numpy as np

import asperity as asp
from asperity.solids.layers import Body

LOAD, MU = asp.Force(0.05), 0.4


def sphere(body: Body, points: int = 24, **more: object) -> asp.ContactProblem:
    x = (np.arange(points) - 0.5 * (points - 1)) * 2.4 / points
    surface = asp.Surface(-(x[:, None] ** 2 + x**2) / 20.0, 2.4 / points)
    settings = {"boundary": asp.Free(), "counter_body": asp.Rigid(), "friction": asp.Coulomb(MU)}
    return asp.ContactProblem(surface, body, **{**settings, **more})  # type: ignore[arg-type]


def left_of_a_loop(problem: asp.ContactProblem, shift: float) -> tuple[list[float], float]:
    """What the balance leaves (J) with 4 and with 12 steps of time a ramp, and the whole work (J);
    heat of bodies and slip never falls."""
    steps = [
        asp.Step(LOAD, asp.Shift()),
        asp.Step(LOAD, asp.Shift(shift), duration=0.5),
        asp.Step(LOAD, asp.Shift(shift), duration=3.0),
        asp.Step(LOAD, asp.Shift(-shift), duration=0.5),
    ]
    left = []
    for number in (4, 12):
        energies = asp.solve(problem, asp.History(steps), time_steps=asp.TimeSteps(number=number)).energies
        left.append(float(np.abs(energies.residual - energies.residual[0]).max()))
        assert (np.diff(energies.viscous_work) > 0.0).all()
        assert (np.diff(energies.slip_work) >= 0.0).all()
    return left, float(energies.external_work[-1] + energies.tangential_work[-1])
