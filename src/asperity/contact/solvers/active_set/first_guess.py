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
"""Points per side at which there is no coarser grid: a solve there costs next to nothing."""

COARSE_ITERATIONS = 30
"""Most steps on a coarse grid; two to four are the rule."""

_HIDDEN_SHARE, _HIDDEN_SHARE_CAPPED = 1.0, 0.1
"""Tolerance on a coarse grid over the roughness that it cannot show, both relative to the rms
height, without and with a cap, under which a poor guess costs more."""

_LOOSEST, _LOOSEST_CAPPED = 0.1, 0.03
"""Loosest tolerance on a coarse grid, without and with a cap."""

_FINE_STIFFNESS, _FINE_STIFFNESS_RISING = 0.15, 0.05
"""Stiffness of what stands out of 2 x 2 points, over that of alternating pixels (the roughness of a
resolved surface is longer), and where c(q) q rises; under a cap there is none, for crests loaded
beyond it yield."""

_RISING_FROM, _RISING_CELLS = 1.2, 4
"""Rise of c(q) q over that of the shortest waves, at waves up to 32 points (twice the side of cells
of this level), from which on a guess is that of a film."""

_NARROWED = 1, 2, 3
"""How often the set of a guess is narrowed: as a rule and always on the coarsest grid, where c(q) q
rises, and where the guess is settled before."""

_SETTLING_FROM = 8.0
"""Steepness of a compliance from which on ``settle`` is worth its time: thin films of E 30 and
stiffer."""


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
small shares then grow like 2.26 p / E* s, as those of computed rough contacts."""


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
