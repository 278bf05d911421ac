"""Numbers that no float holds, and lengths whose squares no float holds, are refused with what is
allowed."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core import values
from asperity.core.values import Hurst, Number, PoissonRatio, Positive, Real, Seed

HUGE = 10**400


@pytest.mark.parametrize("kind", [Real, Positive, Hurst, PoissonRatio, Seed])
@pytest.mark.parametrize("number", [HUGE, -HUGE])
def test_integers_of_400_digits(kind, number) -> None:
    with refused(asp.InputError, "the number", "an integer of 401 digits"):
        get_args(kind)[1].read(number, "the number")


def test_every_kind_of_numbers_refuses_them() -> None:
    """No quantity of any unit ends in an error of Python."""
    kinds = [
        get_args(item)[1]
        for item in vars(values).values()
        if len(get_args(item)) == 2 and isinstance(get_args(item)[1], Number)
    ]
    assert len(kinds) > 10
    for kind in kinds:
        with refused(asp.InputError, "x", "an integer of 401 digits"):
            kind.check(HUGE, "x")


@pytest.mark.parametrize("height", [1e200, -1e41])
def test_heights_beyond_every_instrument(height: float) -> None:
    heights = np.zeros((4, 4))
    heights[1, 2] = height
    with refused(asp.InputError, "largest height of a surface (m)", "1e-41"):
        asp.Surface(heights, 1e-6)


@pytest.mark.parametrize("height", [1e-41, 1e-60, 1e-82, 1e-100, 1e-200, 5e-324])
def test_heights_below_every_atom(height: float) -> None:
    """Statistics are numbers as long as squares of heights are, the contact is that of a flat
    surface."""
    surface = asp.Surface(height * np.random.default_rng(1).standard_normal((8, 8)), 1e-6, periodic=True)
    if height > 1e-150:
        assert asp.roughness_of(surface).rms_height == pytest.approx(height, rel=0.3)
    else:
        with refused(asp.InputError, "moment m0 (m^2)", "0.0"):
            asp.roughness_of(surface)
    assert asp.solve(asp.ContactProblem(surface, asp.Elastic(1e9, 0.3)), asp.MeanPressure(1e5)).area_fraction == 1.0
