"""(0) First guesses from coarser grids, and from the heights on the coarsest; constants and cases as in ``solver``."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Protocol

import numpy as np

from ....core.arrays import RealArray
from ...operators.convolution import restricted
from ..protocol import ContactQP, FixedMean, Solver, feasible_start, run
from .spline_model import pixel_compliance

COARSEST = 64
"""Points per side at which there is no coarser grid. Pairs for 32, 128: film 9.7, 9.6; free 25.4, 26.2; cap 6.3, 7.2."""

COARSE_ITERATIONS = 30
"""Most steps on a coarse grid; two to four are the rule. Pairs for 3, 10, 100: the same."""

_HIDDEN_SHARE, _HIDDEN_SHARE_CAPPED = 0.5, 0.1
"""Tolerance on a coarse grid over the roughness that it cannot show, both relative to the rms height, without and with a cap. Pairs for
0.05, 0.1, 0.2, 1: elastic 8.3, 8.3, 8.1, 7.9; film 9.8, 9.7, 9.6, 9.3; free 26.3, 26.2, 25.6, 25.3; tight
14.8, 14.8, 14.5, 15.1. Fewer steps on coarse grids save more time than pairs. With a cap 0.5 takes 7.1
and 10.4 pairs at a hardness of 0.3 and 0.1 E* (512²), 0.1 takes 5.8 and 6.8."""

_LOOSEST, _LOOSEST_CAPPED = 0.1, 0.03
"""Loosest tolerance on a coarse grid. Pairs for 0.01, 0.03, 0.3: film 9.7, 9.2, 9.7; free 26.3, 25.5, 25.3."""

_FINE_STIFFNESS = 0.15
"""Stiffness of what stands out of 2 x 2 points, over that of alternating pixels (the roughness of a resolved surface is longer).
Pairs for 0, 0.1, 0.2, 0.3: elastic 9.0, 8.0, 7.8, 8.2; film 10.3, 9.7, 9.4, 10.2; free 28.3, 26.8, 25.3, 25.3; tight 15.7, 15.2, 14.7, 14.7.
Under a cap there is none: crests that it would load beyond the cap yield. With it a hardness of 0.3 and 0.1 E* takes 8.2 and 15.3 pairs
at 256² instead of 5.8 and 8.6, 9.8 and 18.5 at 512² instead of 5.8 and 6.8."""


class Adjustable(Solver, Protocol):
    """Solver whose tolerance can be set."""

    def loosened(self, tolerance: float) -> Solver:
        """Same solver for a first guess: with ``tolerance``, of which only the pressure is used."""


def coarsened(qp: ContactQP) -> ContactQP:
    """Same problem on half as many points per side."""
    profile = restricted(qp.profile)
    cap = restricted(qp.cap) if isinstance(qp.cap, np.ndarray) else qp.cap
    scale = float(profile.std()) or qp.height_scale
    return replace(qp, operator=qp.operator.coarsened, profile=profile, cap=cap, height_scale=scale)


def coarse_tolerance(qp: ContactQP, coarse: ContactQP, solver: Adjustable) -> float:
    """Tolerance of the ``coarse`` problem: a fraction of the roughness of ``qp`` that its grid cannot show."""
    hidden = np.sqrt(max(0.0, 1.0 - (coarse.height_scale / qp.height_scale) ** 2))
    share, loosest = (_HIDDEN_SHARE, _LOOSEST) if qp.elastic else (_HIDDEN_SHARE_CAPPED, _LOOSEST_CAPPED)
    return max(min(share * float(hidden), loosest), solver.tolerance)


def nested_start(qp: ContactQP, solver: Adjustable) -> tuple[RealArray, float]:
    """Feasible pressure (Pa) prolonged from the solution of ``solver`` on the coarser grid, and its FFT pairs.

    On the coarsest grid it is uniform on the highest points. The coarse problem is solved to a fraction of the roughness that its grid cannot show. Its pressures are constant on
    2 x 2 points; without a cap, pressure is added in proportion to what stands out of them. Pairs are counted in pairs of the grid of
    ``qp``: those of half as many points per side count a quarter.
    """
    if min(qp.profile.shape) <= COARSEST:
        return feasible_start(qp, highest_points(qp)), 0.0
    coarse = coarsened(qp)
    state = run(solver.loosened(coarse_tolerance(qp, coarse, solver)), coarse).state
    pairs = state.applications * coarse.operator.pairs_per_application + state.extra_pairs
    share = coarse.profile.size / qp.profile.size
    stiffness = _FINE_STIFFNESS / pixel_compliance(qp.operator.octaves, qp.operator.grid) if qp.elastic else 0.0
    start = qp.operator.engine.prolonged(state.pressure, coarse.profile, qp.profile, stiffness)
    if not (qp.elastic and isinstance(qp.constraint, FixedMean) and start.any()):
        return feasible_start(qp, start), pairs * share
    start *= qp.constraint.mean_pressure / start.mean()
    return start, pairs * share


_AREA_PER_LOAD = 2.0
"""Factor a in the share erf(a p / E* s) of the points that are loaded first, s being the rms slope: small shares then grow like 2.26 p / E* s, as
those of computed rough contacts. Pairs for 1.4: film 9.4, cap 6.4; for 2.4: film 9.4; for all points free 25.9. On 64² points two or
three steps do instead of three to seven."""


def highest_points(qp: ContactQP) -> RealArray | None:
    """One on the highest points, zero elsewhere; as many as a rough surface of this slope would have in contact.

    None, for all points, at a prescribed position and for flat surfaces.
    """
    heights, spacing = qp.profile, qp.operator.grid.spacing
    if not isinstance(qp.constraint, FixedMean):
        return None
    steps = [np.diff(heights, axis=axis) / spacing[axis] for axis in (0, 1) if heights.shape[axis] > 1]
    slope = math.sqrt(sum(float((step * step).mean()) for step in steps))
    shortest = math.prod(spacing) ** 0.5
    yielding = 0.5 * pixel_compliance(qp.operator.octaves, qp.operator.grid) * math.pi / shortest  # 1 / E*
    if slope == 0.0:
        return None
    loaded = math.ceil(math.erf(_AREA_PER_LOAD * qp.constraint.mean_pressure * yielding / slope) * heights.size)
    lowest = np.partition(heights, heights.size - loaded, axis=None)[heights.size - loaded]
    return np.asarray(heights >= lowest, dtype=float)
