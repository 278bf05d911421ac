"""(1, 3, 4) Points at the bounds of the pressure: which the next step may change, and how its
pressures are kept within; constants and cases as in ``solver``."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ....core.arrays import RealArray
from ....core.engine import FreeSet, Survey, Totals
from ..protocol import LOAD_ROUNDING, LOAD_SWEEPS, ContactQP, FixedOffset, multiplier
from .linear_system import LinearSystem, PressureChange, Workspace

# (1) The plane level, and the free set.


def plane_level(qp: ContactQP, totals: Totals) -> float:
    """Plane level (the multiplier) in the heights of the workspace, as ``protocol.level``."""
    return 0.0 if isinstance(qp.constraint, FixedOffset) else multiplier(totals)


_PRIOR = 4.0
"""Loaded points as which the mean over the wider square counts in that of a square, so that few
points do not decide alone."""

_SCATTER_SHARE = 0.5
"""Share of the scatter by which a point must stand out to enter, so that noise does not enter on
stiff films and rough pixels."""

_SCATTER_SHARE_WIDE = -0.5
"""The same for a ``wide`` set, which narrowing and clearing only make smaller: points enter that do
not stand out."""

_RESOLVED = 1e-14
"""Scatter² over mean square below which it is lost in the rounding of sums of squares."""


def free_set(survey: Survey, level: float, scale: float, dtype: str, *, wide: bool = False) -> FreeSet:
    """Free set of an iterate at the plane ``level``, with the residual (level - r) / ``scale``; a
    larger one if ``wide``.

    Points at a bound enter by the mean residual of the loaded points near them: while an iterate is
    not yet solved for, its residual is smooth, whole regions being too high or too low. Judged by
    the plane level, too many points would enter in the one and too few in the other, and the set
    would follow the error instead of the surface. At the solution all means are the plane level.

    What the residual scatters about that mean from point to point is error as well: a step on
    points that enter by less than it is mostly undone by the next, and a stiff film, whose
    pressures change sign within a few pixels, may never settle. Points enter that are beyond the
    mean by half of the scatter, which vanishes at the solution.
    """
    share = _SCATTER_SHARE_WIDE if wide else _SCATTER_SHARE
    return survey.free_set(entering_levels(survey.squares, level, share), level, scale, dtype)


def entering_levels(squares: RealArray, level: float, share: float) -> RealArray:
    """Levels of r for each square (..., 2): unloaded points enter below the first, points at their
    cap above the second; ``share`` of the scatter beyond the mean.

    ``squares`` holds the number of its points strictly between the bounds, their sum of r and of
    r². Where there are few, the square of twice the side counts as well, and so on; where there are
    none at all the levels are ``level``.
    """
    from ....core.engine import kernels

    nx, ny, _ = squares.shape
    sums, levels = np.empty((2 * (nx + 1) * (ny + 1) + 64, 3)), np.empty((nx, ny, 2))
    kernels.entering_levels(squares, level, _PRIOR, share, _RESOLVED, sums, levels)
    return levels


# (3, 4) Tension cleared, steps on the model alone, steps clipped.

LEAST_SHARE = 0.1
"""Share of a clipped step below which one along the projected gradient replaces it: so little left
shows that the set was wrong."""

_PARTS = 4
"""Parts of a step at most that are clipped, one product each, before it is shortened: stiff films
of rough pixels under a cap do not all converge with one."""


class _Clipping(NamedTuple):
    """Number of points ``clipped`` by a step, the ``share`` of the step that was taken, and the
    ``products`` it needed."""

    clipped: int
    share: float
    products: int


def clear_tension(work: Workspace, free: FreeSet, total: float) -> PressureChange:
    """Clear the tensile points of ``free`` and scale the others, of the sum ``total``, to the load;
    the change."""
    factor = work.load / total if work.load is not None and total > 0.0 else 1.0
    return PressureChange(free, free.clear_tension(work.pressure, factor, work.unit))


class Narrowed(NamedTuple):
    """A ``free`` set without the points that a step on the model alone made tensile, the residual
    ``r`` on it before that step, and the ``change`` by it."""

    free: FreeSet
    r: Any
    change: PressureChange


def narrowed(work: Workspace, free: FreeSet, r: Any, *, rounds: int = 1) -> Narrowed:
    """Steps for the residual ``r`` on ``free`` by the model of the compliance alone; after each the
    points that have become tensile are cleared and leave the set.

    They cost no product: whoever computes the deflection by ``change`` does so together with that
    by a step on what is left.
    """
    splines = work.scaled.splines
    before, _ = free.gather(work.pressure)
    left, values, after, change = free, before, before, None
    for _ in range(rounds):
        predicted = r if change is None else splines.predicted_residual(left, r, free, change)
        system = LinearSystem(work.scaled, left, work.load is not None)
        system.factorise()
        z = system.preconditioned(predicted, predicted, left.empty())
        # beyond single precision the step fails, and says so, as others do
        with np.errstate(over="ignore", invalid="ignore"):
            d = left.shifted(z.vector, -system.mean(z.total))
            left, values, r = left.loaded(values + work.unit * d, work.load, r)
            after = free.spread(left, values)
            change = free.change(after, before, work.unit)
    free.put(after, work.pressure)
    return Narrowed(left, r, PressureChange(free, change))


def clipped_update(work: Workspace, free: FreeSet, d: Any, r: Any, total: float) -> _Clipping:
    """Add ``d``, clipped and scaled to the load, to the pressure of sum ``total``.

    The deflection by the whole step is left in the response of the scaled operator. The energy
    falls: it changes by -r·step + step·K step / 2, ``r`` being the residual on the set. Where it
    would rise, a part of d is clipped instead, so that points still reach their bounds; after some
    attempts the step is shortened to its minimum.
    """
    qp, scaled, p = work.qp, work.scaled, work.pressure
    old, load = free.gather(p)
    part, products = 1.0, 0
    while True:
        clipped = add_clipped(work, free, d, part, total - load)
        change, along = free.scatter_change(old, p, r, scaled.field)
        scaled.product.apply(scaled.field, scaled.response)
        products += 1
        reaction = free.gather_products(scaled.response, change, change, free.empty()).first
        slope, curvature = -along * qp.height_scale, reaction * scaled.scale
        if slope + 0.5 * curvature <= 0.0:
            return _Clipping(clipped, 1.0, products)
        share = -slope / curvature if slope < 0.0 else 0.0
        if products == _PARTS:
            share = share if share >= LEAST_SHARE else 0.0
            free.interpolate(old, share, p)
            return _Clipping(clipped, share, products)
        free.put(old, p)
        part *= max(share, LEAST_SHARE)


def add_clipped(work: Workspace, free: FreeSet, d: Any, part: float, elsewhere: float) -> int:
    """Add ``part`` of ``d``, clipped and scaled to the load, of which ``elsewhere`` is outside
    ``free``; the number of points clipped."""
    found, clipped = free.add_clipped(work.pressure, d, part * work.unit, work.cap)
    if work.load is not None:
        target = max(work.load - elsewhere, 0.0)
        for _ in range(LOAD_SWEEPS):
            missing = target - found.pressure
            if abs(missing) <= LOAD_ROUNDING * target:
                break
            if found.movable > 0.0 and found.movable + missing > 0.0:
                found = free.rescale(work.pressure, (found.movable + missing) / found.movable, 0.0, work.cap)
            elif missing < 0.0:
                found = free.rescale(work.pressure, target / found.pressure, 0.0, None)
            elif found.below == 0:
                break  # all are at their cap: what is missing is rounding of the sum over all points
            else:  # every loaded point is at its cap: the rest of the load is spread over those below it
                found = free.rescale(work.pressure, 1.0, missing / found.below, work.cap)
    return clipped
