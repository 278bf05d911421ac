"""How far a pressure may be from the solution: the duality gap bounds the energy, and the stiffest wave of the bodies the pressure."""

from __future__ import annotations

import math

import numpy as np

from ...core.arrays import RealArray
from ...core.engine import Totals
from ...solids.compliance.halfspace import HalfSpace
from .protocol import MOST_DEFLECTIONS, ContactQP, SolverState, least_length


def pressure_error(qp: ContactQP, pressure: RealArray, gap: float) -> float:
    """Bound on the relative error of ``pressure`` (nx, ny) in Pa, in the L2 norm, from its duality ``gap`` (Pa·m); infinite where there is none.

    An error e raises the energy by e·Ke/2 at least and by the gap at most, and e·Ke is at least c e·e, c being the compliance of the wave that
    gives way least: |e| <= (2 gap/c)^1/2. At a prescribed position it is the error from the solution under the load reached.
    """
    squares = float((pressure * pressure).sum(dtype=np.float64))
    if gap <= 0.0:
        return 0.0
    softest = qp.operator.smallest * squares
    return math.sqrt(2.0 * gap / softest) if softest > 0.0 else math.inf


_PRESSURE_BOUND = 0.05
"""Bound on the error of the pressure that suffices: it is 1e-3 in usual contacts, and the true error is far below it, 1.4e-4 for 0.05
on a stiff plate on a soft layer whose compliances are 6e6 apart."""

_USUAL = 1e-7
"""Relative error, that of the solvers unless told otherwise, at which pressures are to be bound so; bounds go with its root."""

_FINEST = 1e-13
"""Relative error below which none is asked for: rounding."""


def error_for_pressure(qp: ContactQP, state: SolverState, totals: Totals, asked: float) -> float:
    """Relative error at which the pressure of ``state``, of these ``totals``, is bound well enough; infinite where it is.

    Waves that give way little, as those of a stiff plate on a soft layer, change the pressure much and the energy little. On a half-space they
    give way in proportion to their length, and the error of the energy serves. Who has ``asked`` for a larger relative error gets one.
    """
    total, energy = totals.pressure, 0.5 * totals.deflected
    if total <= 0.0 or state.error <= _FINEST or isinstance(qp.operator.compliance, HalfSpace):
        return math.inf
    length = max(min(qp.height_scale, MOST_DEFLECTIONS * energy / total), least_length(qp, total, energy))
    bound = pressure_error(qp, state.pressure, state.error * length * total)
    wanted = _PRESSURE_BOUND * max(math.sqrt(asked / _USUAL), 1.0)
    return max(0.5 * state.error * (wanted / bound) ** 2, _FINEST) if bound > wanted else math.inf
