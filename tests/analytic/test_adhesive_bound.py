"""The lower bound of the energy of adhesive contacts: below every branch, near where there is one
minimum, exact without attraction."""

from __future__ import annotations

import numpy as np
import pytest
from adhesive_cases import APPROACH, WORK, sphere, strength_of
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.physics.adhesion.law import DugdaleAdhesion, ExponentialAdhesion, LinearAdhesion, VanDerWaalsAdhesion

RANGE = WORK / strength_of(1.5)
LAWS = (
    ExponentialAdhesion(WORK, RANGE),
    LinearAdhesion(WORK, RANGE),
    DugdaleAdhesion(WORK, RANGE, smoothing=0.0),
    VanDerWaalsAdhesion(WORK, 2.0 * RANGE),
    asp.adhesion.JKRAdhesion(WORK),
)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
def test_no_branch_is_below_the_bound(law):
    """Both branches of a bistable contact at each approach: the bound from either is below both."""
    problem = sphere(32, 4.0, law)
    way = np.array([-1.3, -0.9, -0.6, 0.2, -0.6, -0.9, -1.3]) * APPROACH
    found = asp.solve(problem, asp.History([asp.FixedGrips(float(d)) for d in way]))
    bounds = [asp.adhesion.energy_bound(step) for step in found.steps]
    for k in range(3):
        there, back = bounds[k], bounds[-1 - k]
        rounding = 1e-9 * there.available
        assert max(there.lower, back.lower) <= min(there.energy, back.energy) + rounding
    assert all(bound.gap >= -1e-9 for bound in bounds)


def test_bound_closes_where_the_attraction_is_weak():
    """What is between energy and bound falls with the work of adhesion to zero."""
    apart = []
    for share in (1e-1, 1e-2, 1e-3, 1e-6):
        law = ExponentialAdhesion(share * WORK, 5.0 * APPROACH)
        found = asp.solve(sphere(32, 4.0, law), asp.FixedGrips(0.5 * APPROACH))
        bound = asp.adhesion.energy_bound(found)
        apart.append((bound.energy - bound.lower) / abs(bound.energy))
    rounding = 32**2 * np.finfo(float).eps  # of a sum over the grid; reached at the second share
    assert apart[0] > 1e3 * rounding
    assert np.abs(apart[1:]).max() < rounding


def test_bound_of_two_flats_in_closed_form():
    """Undeformed flats at the gap g: Π = A φ(g), and no state is below -wA."""
    law = ExponentialAdhesion(WORK, 2e-8)
    problem = asp.ContactProblem(asp.Surface(np.zeros((16, 16)), 1e-7), asp.Elastic(0.91e6, 0.3), adhesion=law)
    bound = asp.adhesion.energy_bound(asp.solve(problem, asp.MeanGap(1e-7)))
    assert bound.energy == pytest.approx(-WORK * np.exp(-5.0) * problem.grid.area, rel=1e-6)
    assert -WORK * problem.grid.area <= bound.lower <= bound.energy
    assert bound.available == pytest.approx(WORK * problem.grid.area, rel=1e-12)


def test_rounds_tighten_the_bound():
    problem = sphere(32, 4.0, LAWS[0])
    found = asp.solve(problem, asp.FixedGrips(0.0))
    bound = asp.adhesion.energy_bound(found)
    assert 0.0 < bound.displacement < np.inf
    assert bound.lower >= asp.adhesion.energy_bound(found, rounds=1).lower


def test_what_has_no_bound_is_refused():
    soft = asp.adhesion.LennardJonesAdhesion(WORK, RANGE)
    with refused(InputError, "adhesion"):
        asp.adhesion.energy_bound(asp.solve(sphere(16, 4.0, soft), asp.FixedGrips(0.1 * APPROACH)))
    hard = sphere(16, 4.0, LAWS[0], friction=asp.Coulomb(0.3))
    with refused(InputError, "problem of a bound of the energy"):
        asp.adhesion.energy_bound(asp.solve(hard, asp.FixedGrips(0.1 * APPROACH)))
