"""Long steps of adhesive contacts: the same branch, jumps and losses as with short ones, under
every control."""

from __future__ import annotations

import numpy as np
import pytest

import asperity as asp
from asperity.physics.adhesion.loop import adhesion_loop

SPACING = 1e-4


def ball(tabor: float, points: int, *, periodic: bool = False) -> asp.ContactProblem:
    """Lennard-Jones sphere of E* = R = 1 on a square of side 10.4 sqrt(z0 R)."""
    law = asp.adhesion.LennardJonesAdhesion((tabor * SPACING) ** 1.5, SPACING)
    pixel = 10.4 * np.sqrt(SPACING) / points
    x = (np.arange(points) - 0.5 * (points - 1)) * pixel
    surface = asp.Surface(-(x[:, None] ** 2 + x**2) / 2.0, pixel, periodic=periodic)
    boundary = asp.Periodic() if periodic else asp.Free()
    return asp.ContactProblem(surface, asp.Elastic(0.91, 0.3), boundary=boundary, adhesion=law)


def gripped(problem: asp.ContactProblem, positions: object) -> asp.HistoryResult:
    """Grips at these ``positions`` in z0, one after the other."""
    return asp.solve(problem, asp.History([asp.FixedGrips(float(value) * SPACING) for value in positions]))


def test_a_long_step_stays_on_its_branch():
    """The branch of Tabor's parameter 1.5 ends at -2.57 z0; at once the contact came to -0.324 of
    πwR where it holds -1.362."""
    problem = ball(1.5, 80)
    ways = [gripped(problem, way).last for way in ((-0.6, -2.3), (-0.6, *np.linspace(-0.6, -2.3, 11)[1:]))]
    unit = np.pi * problem.adhesion.work
    forces = [result.external_force / unit for result in ways]
    # traction and law agree to 1e-5 of the strength; compliance of the contact magnifies that by
    # 1 / margin
    error = 2e-5 / min(result.adhesion.margin for result in ways)
    assert forces[0] == pytest.approx(forces[1], rel=error)
    assert forces[0] == pytest.approx(-1.362, abs=1e-3)
    assert not any(result.adhesion.jumped for result in ways)


@pytest.mark.parametrize("periodic", [False, True])
def test_reversible_loops_of_few_steps_lose_nothing(periodic):
    problem = ball(1.0, 32, periodic=periodic)
    found = gripped(problem, [1.0, -1.4, 1.0])
    loop = adhesion_loop(found.steps)
    assert not loop.jumped.any()
    assert abs(loop.hysteresis) <= 1e-9 * problem.adhesion.work * SPACING
    assert found.external_force[2] == pytest.approx(found.external_force[0], rel=1e-5)


def test_real_jumps_happen_between_the_same_positions():
    """Loss and places of few steps are those of many to within what both state."""
    problem = ball(1.5, 64, periodic=True)
    many, few = (adhesion_loop(gripped(problem, there_and_back(steps)).steps) for steps in (40, 6))
    assert many.jumped.sum() == few.jumped.sum() == 2
    for (a, b), (c, d) in zip(many.jump_intervals, few.jump_intervals, strict=True):
        assert min(c, d) <= 0.5 * (a + b) <= max(c, d)
    assert few.force[-1] == pytest.approx(many.force[-1], rel=1e-4)
    assert abs(few.hysteresis - many.hysteresis) <= few.hysteresis_error + many.hysteresis_error
    assert few.hysteresis > 0.0


def there_and_back(steps: int) -> np.ndarray:
    """Positions in z0 of approach and parting."""
    way = np.linspace(-4.0, 1.5, steps + 1)
    return np.concatenate([way, way[-2::-1]])


@pytest.mark.parametrize("kind", ["force", "mean gap", "approach"])
def test_every_control_follows_the_branch(kind):
    problem = ball(1.0, 32, periodic=kind == "mean gap")
    unit, z = np.pi * problem.adhesion.work, SPACING
    starts = {"force": asp.Force(2.0 * unit), "approach": asp.Approach(3.0 * z), "mean gap": asp.MeanGap(3.5 * z)}
    make = {
        "force": lambda share: (
            asp.contact.Pull((3.0 * share - 2.0) * unit) if share > 0.7 else asp.Force((2.0 - 3.0 * share) * unit)
        ),
        "approach": lambda share: asp.Approach((3.0 - 2.9 * share) * z),
        "mean gap": lambda share: asp.MeanGap((3.5 + 2.0 * share) * z),
    }[kind]
    few, many = (
        asp.solve(problem, asp.History([starts[kind], *map(make, shares)])).last
        for shares in ((1.0,), (0.2, 0.4, 0.6, 0.8, 1.0))
    )
    assert few.control == many.control
    # 1e-5 of the strength on every point of the zone
    assert few.external_force == pytest.approx(many.external_force, abs=1e-4 * unit)
    assert few.approach == pytest.approx(many.approach, abs=1e-4 * z)
    assert not few.adhesion.jumped
