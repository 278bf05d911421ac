"""First guesses from coarser grids."""

from __future__ import annotations

from dataclasses import replace
from typing import Protocol, Self

import numpy as np

from ...core.arrays import RealArray
from ..operators.coarse import restricted
from .cells import pixel_compliance
from .feasible import feasible_start
from .protocol import ContactQP, FixedMean, Solver, run

COARSEST = 64
"""Points per side at which there is no coarser grid."""

_TOLERANCE = 0.1
_LOOSEST = 0.03
_FINE_STIFFNESS = 0.15


class Adjustable(Solver, Protocol):
    """Solver whose tolerance can be set."""

    def loosened(self, tolerance: float) -> Self:
        """Same solver for a first guess: with ``tolerance``."""


def coarsened(qp: ContactQP) -> ContactQP:
    """Same problem on half as many points per side."""
    profile = restricted(qp.profile)
    cap = restricted(qp.cap) if isinstance(qp.cap, np.ndarray) else qp.cap
    scale = float(profile.std()) or qp.height_scale
    return replace(qp, operator=qp.operator.coarsened, profile=profile, cap=cap, height_scale=scale)


def nested_start(qp: ContactQP, solver: Adjustable) -> tuple[RealArray, float]:
    """Feasible pressure (Pa) prolonged from the solution of ``solver`` on the coarser grid, and its FFT pairs.

    The coarse problem is solved to a fraction of the roughness that its grid cannot show. Its pressures are constant on
    2 x 2 points; what is higher there carries more: ``_FINE_STIFFNESS`` of what alternating pixels would (the
    roughness of a resolved surface is longer), which saves a tenth of the pairs at 1024² and a quarter at 2048².

    Pairs are counted in pairs of the grid of ``qp``: those of half as many points per side count a quarter.
    """
    if min(qp.profile.shape) <= COARSEST:
        return feasible_start(qp, None), 0.0
    coarse = coarsened(qp)
    hidden = np.sqrt(max(0.0, 1.0 - (coarse.height_scale / qp.height_scale) ** 2))
    tolerance = max(min(_TOLERANCE * float(hidden), _LOOSEST), solver.tolerance)
    state = run(solver.loosened(tolerance), coarse).state
    pairs = state.applications * coarse.operator.pairs_per_application + state.extra_pairs
    share = coarse.profile.size / qp.profile.size
    stiffness = _FINE_STIFFNESS / pixel_compliance(qp.operator.octaves, qp.operator.grid)
    start = qp.operator.engine.refined(state.pressure, coarse.profile, qp.profile, stiffness)
    if not (qp.elastic and isinstance(qp.constraint, FixedMean) and start.any()):
        return feasible_start(qp, start), pairs * share
    start *= qp.constraint.mean_pressure / start.mean()
    return start, pairs * share
