"""First guesses from coarser grids."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...core.arrays import RealArray
from ..operators.coarse import prolonged, restricted
from .feasible import feasible_start
from .protocol import ContactQP, Solver, run

COARSEST = 64
"""Points per side at which there is no coarser grid."""


def coarsened(qp: ContactQP) -> ContactQP:
    """Same problem on half as many points per side."""
    profile = restricted(qp.profile)
    cap = restricted(qp.cap) if isinstance(qp.cap, np.ndarray) else qp.cap
    scale = float(profile.std()) or qp.height_scale
    return replace(qp, operator=qp.operator.coarsened, profile=profile, cap=cap, height_scale=scale)


def nested_start(qp: ContactQP, solver: Solver) -> tuple[RealArray, float]:
    """Feasible pressure (Pa) prolonged from the solution of ``solver`` on the coarser grid, and its FFT pairs.

    Pairs are counted in pairs of the grid of ``qp``: those of half as many points per side count a quarter.
    """
    if min(qp.profile.shape) <= COARSEST:
        return feasible_start(qp, None), 0.0
    coarse = coarsened(qp)
    state = run(solver, coarse).state
    pairs = state.applications * coarse.operator.pairs_per_application + state.extra_pairs
    share = coarse.profile.size / qp.profile.size
    return feasible_start(qp, prolonged(state.pressure, qp.operator.grid.shape)), pairs * share
