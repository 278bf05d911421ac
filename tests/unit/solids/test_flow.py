"""Which law each region of a body flows by, and how far a plastic strain is from the one that the
return mapping gives."""

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.solids.eigenstrain.cells import DepthCells
from asperity.solids.eigenstrain.flow import Flowed, VolumeFlow
from asperity.solids.eigenstrain.operator import EigenstrainOperator
from asperity.solids.elastic import Strength
from asperity.solids.flow import flow_of, regions_of
from asperity.solids.plasticity import J2, LinearHardening, PlasticState, Swift

SOFT, HARD = asp.Elastic(1e9, 0.3, Strength(yield_stress=1e7)), asp.Elastic(2e9, 0.2)
PLAIN = asp.Elastic(1e9, 0.3)
BODY = asp.Layered([asp.Layer(HARD, 1e-6), asp.Layer(HARD, 0.0)], SOFT)


def test_laws_of_strengths() -> None:
    """Where a yield stress is known the material flows, with its hardening if it has one, elsewhere
    it is elastic; vanished layers are no region."""
    hard = asp.Elastic(1e9, 0.3, Strength(hardening=Swift(1e7, 1e-2, 0.1), kinematic=1e8, recall=2.0))
    assert flow_of(hard) == (J2(PLAIN, Swift(1e7, 1e-2, 0.1), 1e8, 2.0),)
    assert regions_of(BODY) == (HARD, SOFT)
    assert flow_of(BODY) == (HARD, J2(PLAIN, LinearHardening(1e7)))
    assert regions_of(asp.Layered([asp.Layer(HARD, 1e-6)], asp.RigidBase())) == (HARD,)


def test_given_laws() -> None:
    law = LinearHardening(2e7, 1e6)
    assert flow_of(BODY, law) == (J2(HARD, law), J2(SOFT, law))
    assert flow_of(BODY, [None, law]) == (HARD, J2(SOFT, law))
    assert flow_of(BODY, None) == (HARD, SOFT)
    whole = J2(SOFT, law, kinematic=1e8)
    assert flow_of(BODY, [law, whole])[1] is whole


@pytest.mark.parametrize(
    ("given", "shown"),
    [([None], "1 laws"), ([None, J2(HARD, LinearHardening(1e7))], "E = 2e+09"), ([1e7, None], "1e+07")],
)
def test_what_is_refused(given: list, shown: str) -> None:
    with refused(InputError, "plasticity", shown if shown != "1e+07" else "10000000.0"):
        flow_of(BODY, given)


def test_plastic_strain_that_the_return_mapping_takes_away_is_not_settled() -> None:
    """Of a load on the way that was too large: under a smaller one none is left, which is a change
    by all of it."""
    grid, solid = Grid((6, 5), (1e-6, 1e-6)), asp.Elastic(200e9, 0.3)
    cells = DepthCells(solid, np.linspace(0.0, 4e-6, 5))
    operator = EigenstrainOperator.prepared(grid, cells, free=False, threads=1)
    law = J2(solid, LinearHardening(1e9))
    flow = VolumeFlow(operator, [law] * 4, Flowed.virgin())
    flow.points, flow.before = np.array([7]), PlasticState.virgin((1,))
    flow.delta = 1e-5 * np.array([[1.0, -0.5, -0.5, 0.0, 0.0, 0.0]])
    flow.spread()
    step, residual = flow.returned(operator.loads(np.zeros(grid.shape), None))
    np.testing.assert_array_equal(step, -flow.delta)
    assert residual == 1.0
    flow.delta = np.zeros((1, 6))
    flow.spread()
    assert flow.returned(operator.loads(np.zeros(grid.shape), None))[1] == 0.0
