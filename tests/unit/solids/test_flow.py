"""Which law each region of a body flows by."""

import pytest
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.solids.elastic import Strength
from asperity.solids.flow import flow_of, regions_of
from asperity.solids.plasticity import J2, LinearHardening, Swift

SOFT, HARD = asp.Elastic(1e9, 0.3, Strength(yield_stress=1e7)), asp.Elastic(2e9, 0.2)
PLAIN = asp.Elastic(1e9, 0.3)
BODY = asp.Layered([asp.Layer(HARD, 1e-6), asp.Layer(HARD, 0.0)], SOFT)


def test_laws_of_strengths() -> None:
    """Where a yield stress is known the material flows, with its hardening if it has one, elsewhere it is elastic; vanished layers are no region."""
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
