"""Which of two bodies gives way first."""

from __future__ import annotations

import asperity as asp
from asperity.solids.layers import weaker_strength


def body(nu: float, **strength: float) -> asp.Elastic:
    return asp.Elastic(100e9, nu, strength=asp.Strength(**strength))


def test_each_strength_is_the_lower_one_and_nu_that_of_the_body_that_yields() -> None:
    one, other = body(0.2, hardness=3e9, yield_stress=2e9), body(0.4, hardness=5e9, yield_stress=1e9)
    assert weaker_strength(one, other) == {"hardness": 3e9, "yield_stress": 1e9, "nu": 0.4}
    assert weaker_strength(other, one) == weaker_strength(one, other)


def test_what_is_not_known_is_left_out() -> None:
    assert weaker_strength(body(0.2), asp.Rigid()) == {"nu": 0.2}
    assert weaker_strength(asp.Rigid(), body(0.3, hardness=1e9)) == {"hardness": 1e9, "nu": 0.3}
    assert weaker_strength(body(0.2), body(0.3, hardness=1e9)) == {"hardness": 1e9, "nu": 0.3}
    assert weaker_strength(asp.Rigid()) == {}
    coated = asp.Layered([asp.Layer(body(0.25, hardness=7e9), 1e-9)], body(0.3, hardness=1e9))
    assert weaker_strength(coated) == {"hardness": 7e9, "nu": 0.25}
