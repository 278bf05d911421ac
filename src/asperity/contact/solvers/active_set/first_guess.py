"""(0) First guesses from coarser grids, and from the heights on the coarsest; constants and cases
as in ``solver``."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple, Protocol

import numpy as np

from ....core.arrays import RealArray
from ...operators.convolution import restricted
from ..protocol import ContactQP, FixedMean, Solver, feasible_start, iterated
from .bounds import free_set, narrowed, plane_level
from .linear_system import Workspace
from .spline_model import pixel_compliance, steepness

COARSEST = 64
"""Points per side at which there is no coarser grid. Pairs for 32: the same; for 128: cap 6.5,
tight 13.2."""

COARSE_ITERATIONS = 30
"""Most steps on a coarse grid; two to four are the rule. Pairs for 3, 10, 100: the same."""

_HIDDEN_SHARE, _HIDDEN_SHARE_CAPPED = 1.0, 0.1
"""Tolerance on a coarse grid over the roughness that it cannot show, both relative to the rms
height, without and with a cap. Pairs for 0.2, 0.5, 2: film 5.9, 5.7, 5.7; free 19.5, 19.3, 19.3;
monotone 8.2, 8.0, 7.8. With a cap 0.5 takes 7.1 and 10.4 pairs at a hardness of 0.3 and 0.1 E*
(512²), 0.1 takes 5.8 and 6.8."""

_LOOSEST, _LOOSEST_CAPPED = 0.1, 0.03
"""Loosest tolerance on a coarse grid. Pairs for 0.01, 0.03, 0.3: film 5.9, 5.7, 5.7; free 20.2,
19.4, 19.3; monotone 8.2, 8.0, 7.9."""

_FINE_STIFFNESS, _FINE_STIFFNESS_RISING = 0.15, 0.05
"""Stiffness of what stands out of 2 x 2 points, over that of alternating pixels (the roughness of a
resolved surface is longer), and where c(q) q rises. Pairs for 0, 0.1, 0.2, 0.3: elastic 5.8, 5.7,
5.7, 5.8; free 20.1, 19.3, 18.6, 18.6; tight 12.7, 12.9, 12.9, 12.4; monotone 8.4, 7.9, 7.7, 7.7;
where it rises for 0, 0.03: the same; for 0.1, 0.15: film 5.9, 5.9 (E 10 on 4 pixels, 1024², 0.02,
0.05, 0.08: 6.0, 5.8, 6.2). Under a cap there is none: crests that it would load beyond the cap
yield. With it a hardness of 0.3 and 0.1 E* takes 8.2 and 15.3 pairs at 256² instead of 5.8 and 8.6,
9.8 and 18.5 at 512² instead of 5.8 and 6.8."""

_RISING_FROM, _RISING_CELLS = 1.2, 4
"""Rise of c(q) q over that of the shortest waves, at waves up to 32 points (twice the side of cells
of this level), from which on a guess is that of a film. Pairs for a rise of 1.01, 2: the same; for
1e9 (never): film 6.3."""

_NARROWED = 1, 2, 3
"""How often the set of a guess is narrowed: as a rule and always on the coarsest grid, where c(q) q
rises, and where the guess is settled, before that as well. Pairs for once everywhere: film 6.4; for
twice: elastic 6.0, free 17.8, tight 13.9. Settled guesses of films of E 100 on 2 pixels, of E 50 on
2 and of E 30 on 2 (1024², means over loads and surfaces) take 7.7, 7.7 and 8.3 pairs with three,
9.9, 8.3 and 9.3 with two."""

_SETTLING_FROM = 8.0
"""Steepness of a compliance from which on ``settle`` is worth its time. Films of E 30 on 2 pixels
(steepness 8.5) take 8.3 pairs with it and 10.0 without, five measured surfaces with such films 8.7
and 9.3; of E 10 on 2 (4.9) 7.0 and 7.3, in more time. Pairs for 3: stiff the same; for 1e9 (never):
stiff 35.3."""


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
    """Tolerance of the ``coarse`` problem: a fraction of the roughness of ``qp`` that its grid
    cannot show."""
    hidden = np.sqrt(max(0.0, 1.0 - (coarse.height_scale / qp.height_scale) ** 2))
    share, loosest = (_HIDDEN_SHARE, _LOOSEST) if qp.elastic else (_HIDDEN_SHARE_CAPPED, _LOOSEST_CAPPED)
    return max(min(share * float(hidden), loosest), solver.tolerance)


class Start(NamedTuple):
    """Feasible ``pressure`` (Pa), the FFT ``pairs`` it took, and how often its set is to be
    ``narrowed``: never where it is no guess from a coarser grid or the heights, with many points
    that will not touch.

    ``deflection`` (m), not quite that by it, is given where it is to ``settle``.
    """

    pressure: RealArray
    pairs: float = 0.0
    deflection: RealArray | None = None
    narrowed: int = 0


def nested_start(qp: ContactQP, solver: Adjustable) -> Start:
    """Pressure prolonged from the solution of ``solver`` on the coarser grid.

    On the coarsest grid it is uniform on the highest points. The coarse problem is solved to a
    fraction of the roughness that its grid cannot show. Its pressures are constant on 2 x 2 points;
    without a cap, pressure is added in proportion to what stands out of them, or ``settle`` finds
    what is to be added on thin films that are very stiff. Pairs are counted in pairs of the grid of
    ``qp``: those of half as many points per side count a quarter.
    """
    if min(qp.profile.shape) <= COARSEST:
        qp = replace(qp, profile=qp.operator.engine.numpy(qp.profile))
        return Start(feasible_start(qp, highest_points(qp)), narrowed=_NARROWED[0])
    rises = qp.elastic and steepness(qp.operator, _RISING_CELLS) > _RISING_FROM
    settles = qp.elastic and steepness(qp.operator) > _SETTLING_FROM
    rounds = _NARROWED[int(rises) + int(settles)]
    coarse, engine = coarsened(qp), qp.operator.engine
    state = iterated(solver.loosened(coarse_tolerance(qp, coarse, solver)), coarse).state
    pairs = state.applications * coarse.operator.pairs_per_application + state.extra_pairs
    share = coarse.profile.size / qp.profile.size
    adds = qp.elastic and not settles
    stiffness = 0.0
    if adds:
        stiffness = _FINE_STIFFNESS_RISING if rises else _FINE_STIFFNESS
        stiffness /= pixel_compliance(qp.operator.octaves, qp.operator.grid)
    start = engine.prolonged(state.pressure, coarse.profile, qp.profile, stiffness)
    deflection = None
    if settles:
        deflection = engine.interpolated(state.deflection, qp.profile.shape, qp.operator.boundary.wraps)
    if not (qp.elastic and isinstance(qp.constraint, FixedMean) and start.any()):
        return Start(feasible_start(qp, engine.numpy(start)), pairs * share, deflection, narrowed=rounds)
    start *= qp.constraint.mean_pressure / float(start.mean())
    return Start(start, pairs * share, deflection, narrowed=rounds)


def settle(work: Workspace, rounds: int) -> None:
    """Change the pressure of ``work``, prolonged from a coarser grid, by some steps on the model of
    its compliance, and leave the deflection to be computed.

    On a stiff film many of the 2 x 2 points that touch on the coarser grid do not touch on this
    one. The model finds most of them from the interpolated deflection, without a product. Else
    steps make so many points tensile that unclipped ones may fail, after which hundreds follow.
    """
    qp = work.qp
    survey = work.survey()
    free = free_set(survey, plane_level(qp, survey.totals), qp.height_scale, work.scaled.dtype, wide=True)
    narrowed(work, free, free.residual(centred=work.load is not None), rounds=rounds)


_AREA_PER_LOAD = 2.0
"""Factor a in the share erf(a p / E* s) of the points that are loaded first, s being the rms slope:
small shares then grow like 2.26 p / E* s, as those of computed rough contacts. Pairs for 1.4: tight
12.9; for 2.4: the same; for all points free 19.9. On 64² points two or three steps do instead of
three to seven."""


def highest_points(qp: ContactQP) -> RealArray | None:
    """One on the highest points, zero elsewhere; as many as a rough surface of this slope would
    have in contact.

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
