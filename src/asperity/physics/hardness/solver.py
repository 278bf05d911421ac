"""Newton's method on pressures and limits together, where the limit falls gently with the depth to
which a point yields.

Where a point yields, p = H(w) with w = level - r, the depth by which r = K p - h is below the
level. With s = -H'(w) a change d of the pressures obeys, up to the change of the level,

    (K d) = level - r                  at free points,
    (K d) - d / s = (p - H(w)) / s     at yielding points:

one symmetric system, solved with the model of nested splines in place of K, on the sets of the fast
solver. Since it is indefinite, conjugate gradients are replaced by conjugate residuals, which make
the sum of squares of the residual smaller with every step, that of a yielding point counted as the
pressure that it stands for. The inverse of nested splines is the preconditioner: a yielding point
is one of own compliance c - 1/s.

A step solves twice: for the whole set, and for what the bounds leave of it. The change of pressure
is then multiplied by K itself: one FFT pair a step. On self-affine surfaces of 512² points with a
film of hardness 0.6 E*, 4 pixels thick, on 0.3 E* limits that agree with their depths to 1e-5 take
7.0 to 8.1 pairs, the confirming contact included, elastic contact 6.7 to 8.0. Newton's method with
products with K took 20.2, rounds of solves at given limits six times those of elastic contact.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Protocol

import numpy as np

from ...contact.operators.convolution import restricted
from ...contact.solvers.active_set.bounds import free_set, plane_level
from ...contact.solvers.active_set.first_guess import COARSEST, coarse_tolerance, coarsened
from ...contact.solvers.active_set.linear_system import Workspace
from ...contact.solvers.active_set.solver import ActiveSet, relative_error
from ...contact.solvers.active_set.spline_model import OWN_YIELDING
from ...contact.solvers.protocol import LOAD_ROUNDING, LOAD_SWEEPS, ContactQP, FixedMean, feasible_start
from ...core.arrays import BoolArray, RealArray
from ...core.engine import CpuEngine
from ...core.status import NoProgress, Progress

_REDUCTION = 0.05
"""Reduction of the residual of the model in a solution. FFT pairs, mean of 27 contacts of 256²
points with three films, for 0.1, 0.2: 1 %, 6 % more."""

_MOST_PRODUCTS = 7
"""Products with the model at most in a step; three are the rule."""

_MOST_STEPS, _MOST_COARSE = 40, 8
"""Steps after which it is given up, and after which a coarser grid gives what it has; four to six
are the rule. A pixel of twice the width gives way twice as much under a pressure, so that limits
which fall gently on the fine grid may let points of the coarser one rest at several depths, between
which they go to and fro. Of 204 contacts of 256² points with nine films 28 were given up when
coarser grids had to be solved; now none to two, by rounding, in which more than half of all points
yield."""

_COARSE_LIMITS = 0.03
"""Relative difference of limits that suffices on coarser grids."""

_DIFFERENCE = 1e-6, 1e-9
"""Increment of a depth for the slope of the limit: over the depth, and over the rms height at
least."""

_FLATTEST = 1e-6
"""Slope of a limit over the stiffness of a pixel below which its fall does not count."""


class Limit(Protocol):
    """Limit of the pressure by depth."""

    def cap_at(self, indentation: RealArray) -> float | RealArray:
        """Largest pressure in Pa at ``indentation`` (nx, ny) in m."""


@dataclass(frozen=True, eq=False)
class FallingLimit:
    """Limit (Pa) that falls with the depth ``before`` (nx, ny) in m plus what is added, from
    ``highest`` to ``lowest`` (nx, ny) in Pa.

    It is settled when it agrees to the relative ``tolerance`` with the depth reached.
    """

    law: Limit
    before: RealArray
    highest: RealArray
    lowest: RealArray
    tolerance: float

    def at(self, index: Any, depth: RealArray) -> RealArray:
        """Limit (n,) at the points of the flat ``index``, indented by ``depth`` (n,) beyond what
        they were before."""
        found = np.asarray(self.law.cap_at((self.before.reshape(-1)[index] + depth)[None]), dtype=float)
        limits: RealArray = np.broadcast_to(found, (1, depth.size))[0]
        return limits

    @property
    def coarsened(self) -> FallingLimit:
        """The same on half as many points per side."""
        before, highest, lowest = (restricted(field) for field in (self.before, self.highest, self.lowest))
        return FallingLimit(self.law, before, highest, lowest, max(self.tolerance, _COARSE_LIMITS))


class Followed(NamedTuple):
    """The work, FFT ``pairs`` and ``iterations`` on the fine grid; if it was not in vain,
    ``pressure`` and the limits ``cap`` (nx, ny) in Pa that agree with it."""

    pairs: float = 0.0
    iterations: int = 0
    pressure: RealArray | None = None
    cap: RealArray | None = None


def follow(
    qp: ContactQP,
    limit: FallingLimit,
    solver: ActiveSet,
    start: RealArray | None = None,
    progress: Progress | None = None,
) -> Followed:
    """Contact of ``qp``, whose cap is ignored, under the falling ``limit``, unless it was not found
    or may not exist.

    It is a first guess: limits are found with the pressure, but what is called a solution must be a
    contact at these limits whose depths agree.
    """
    engine, constraint = qp.operator.engine, qp.constraint
    if not isinstance(engine, CpuEngine) or min(qp.profile.shape) < 2:
        return Followed()
    if isinstance(constraint, FixedMean) and constraint.mean_pressure > limit.lowest.mean():
        return Followed()
    with np.errstate(all="ignore"):  # what is not finite is given up
        return _nested(qp, limit, solver, start, progress or NoProgress())


def _nested(
    qp: ContactQP, limit: FallingLimit, solver: ActiveSet, start: RealArray | None, progress: Progress | None
) -> Followed:
    """Contact from ``start``, or from that of the coarser grid; without ``progress``, a guess at
    it."""
    if (start is not None and start.any()) or min(qp.profile.shape) <= COARSEST:
        begin = feasible_start(replace(qp, cap=limit.highest), start)
        return _Iteration(qp, limit, solver, begin, limit.highest).found(0.0, progress)
    coarse = coarsened(replace(qp, cap=limit.highest))
    rough = _nested(coarse, limit.coarsened, solver.loosened(coarse_tolerance(qp, coarse, solver)), None, None)
    pairs = rough.pairs * coarse.profile.size / qp.profile.size
    if rough.pressure is None or rough.cap is None:
        return Followed(pairs, 0)
    pressure = qp.operator.engine.prolonged(rough.pressure, coarse.profile, qp.profile, 0.0)
    nx, ny = qp.profile.shape
    cap = np.minimum(rough.cap.repeat(2, axis=0).repeat(2, axis=1)[:nx, :ny], limit.highest)
    begin = feasible_start(replace(qp, cap=cap), pressure)
    return _Iteration(qp, limit, solver, begin, cap).found(pairs, progress)


class _Points(NamedTuple):
    """Points of the joint system: their flat ``index``, pressures (Pa) and residuals r (m); which
    of them yield; their limits (Pa); the set of the engine."""

    index: Any
    pressure: RealArray
    r: RealArray
    yields: BoolArray
    limits: RealArray
    points: Any


class _Iteration:
    """Steps on one grid. ``unit`` is the deflection of a yielding point under its own load, over
    the scale of the operator."""

    def __init__(self, qp: ContactQP, limit: FallingLimit, solver: ActiveSet, begin: RealArray, cap: RealArray) -> None:
        self.limit, self.solver = limit, solver
        self.work = Workspace.of(replace(qp, cap=np.array(cap)), solver.precision, begin)
        self.pressure, self.cap = self.work.pressure.reshape(-1), self.work.cap
        self.highest, self.lowest = limit.highest.reshape(-1), limit.lowest.reshape(-1)
        engine, scaled = qp.operator.engine, self.work.scaled
        assert isinstance(engine, CpuEngine)
        self.engine = engine
        self.splines = engine.splines(qp.profile.shape, scaled.modelled.model, scaled.dtype)
        self.unit = OWN_YIELDING / scaled.modelled.model.stiffness
        self.pairs = qp.operator.pairs_per_application

    def found(self, pairs: float, progress: Progress | None) -> Followed:
        """The contact; ``pairs`` have been spent before. Without ``progress`` what a few steps
        give."""
        solver, limit, most = self.solver, self.limit, _MOST_STEPS if progress else _MOST_COARSE
        for count in range(most + 1):
            survey = self.work.survey()
            level, error = plane_level(self.work.qp, survey.totals), relative_error(self.work, survey.totals)
            set_ = self._points(survey, level)
            limits = set_.limits[set_.yields]
            off = float(np.max(np.abs(set_.pressure[set_.yields] - limits) / limits, initial=0.0))
            if not (np.isfinite(error) and np.isfinite(off)):
                break
            if progress:
                progress.update(count, max(error, min(off / limit.tolerance * solver.tolerance, 1.0)), solver.tolerance)
            if (error <= solver.tolerance and off <= limit.tolerance) or (count == most and not progress):
                cap = self.highest.copy()
                at = set_.index[set_.yields]
                cap[at] = self.pressure[at]
                return Followed(pairs + self.pairs, count, self.work.pressure, cap.reshape(self.work.pressure.shape))
            if count == most or not set_.index.size or set_.yields.all():
                break
            new, work, scaled, index = self._step(set_, level), self.work, self.work.scaled, set_.index
            self.pressure[index] = new
            self.cap[index] = np.where(set_.yields, self.pressure[index], self.highest[index])
            set_.points.scatter(((new - set_.pressure) / work.unit).astype(scaled.dtype), scaled.field)
            scaled.product.apply(scaled.field, scaled.response)
            self.engine.clear_field(set_.points, scaled.field)
            self.pairs += scaled.operator.pairs_per_application
            self.engine.add(scaled.response, work.qp.height_scale, work.deflection)
        return Followed(pairs + self.pairs, count)

    def _points(self, survey: Any, level: float) -> _Points:
        """Free and yielding points, and the limits at the depths of those that yield."""
        work, scaled = self.work, self.work.scaled
        free: Any = free_set(survey, level, work.qp.height_scale, scaled.dtype)
        member = np.zeros(self.pressure.size, bool)
        member[free.index] = True
        yields = (self.pressure > 0.0) & (self.pressure >= self.cap) & ~member
        index = np.flatnonzero(member | yields)
        at = yields[index]
        r = work.deflection.reshape(-1)[index] - np.asarray(work.heights.reshape(-1)[index], dtype=float)
        return self._set(index, self.pressure[index].astype(float), r, at, level)

    def _set(self, index: Any, pressure: RealArray, r: RealArray, yields: BoolArray, level: float) -> _Points:
        """The points of the ``index``, and the limits at the depths of those that yield."""
        limits = np.full(index.size, np.inf)
        limits[yields] = self.limit.at(index[yields], np.maximum(level - r[yields], 0.0))
        points = self.engine.points(self.work.qp.profile.shape, index, self.work.scaled.dtype)
        return _Points(index, pressure, r, yields, limits, points)

    def _correction(self, set_: _Points, level: float) -> RealArray:
        """Solution d (n,) of the joint system with the model of K by preconditioned conjugate
        residuals, in units of ``Workspace.unit``.

        The system is over the scale of the operator, its residual over the rms height; ``stiff`` is
        what the diagonal of K is less, ``w`` the weights of squares.
        """
        work, load_prescribed = self.work, self.work.load is not None
        scaled, scale = work.scaled, work.qp.height_scale
        index, at = set_.index, set_.yields
        residual, stiff, unit = (level - set_.r) / scale, np.zeros(index.size), self.unit
        depth = np.maximum(level - set_.r[at], 0.0)
        step = np.maximum(_DIFFERENCE[0] * depth, _DIFFERENCE[1] * scale)
        slope = (set_.limits[at] - self.limit.at(index[at], depth + step)) / step
        slope = np.maximum(slope * scaled.scale, _FLATTEST / unit)  # over the stiffness 1/scale
        residual[at] = (set_.pressure[at] - set_.limits[at]) / slope / work.unit
        stiff[at] = 1.0 / slope
        softer = stiff / unit
        conductance, w = (1.0 / (1.0 - softer)).astype(scaled.dtype), 1.0 / (1.0 + softer) ** 2
        heavy = w / w.sum()
        self.splines.factorise(set_.points, conductance)

        def centred(values: RealArray) -> RealArray:
            return values - float(heavy @ values) if load_prescribed else values

        r = centred(residual)
        d, before = np.zeros(r.size), list[tuple[RealArray, RealArray, float]]()
        target = _REDUCTION**2 * float(w @ (r * r))
        for _ in range(_MOST_PRODUCTS):
            z = self.splines.solve_with(set_.points, r.astype(scaled.dtype), conductance).astype(float)
            if load_prescribed:  # at a sum of zero
                z[~at] -= z.sum() / np.count_nonzero(~at)
            az = centred(self._by_model(set_, z) - stiff * z)
            for other, product, square in before:
                share = float((w * az) @ product) / square
                z -= share * other
                az -= share * product
            square = float(w @ (az * az))
            if not square > 0.0:
                break
            length = float((w * r) @ az) / square
            d += length * z
            r -= length * az
            if float(w @ (r * r)) <= target:
                break
            before.append((z, az, square))
        return d

    def _by_model(self, set_: _Points, values: RealArray) -> RealArray:
        """K times ``values`` (n,) on the set, over its scale, by the model of nested splines."""
        single = values.astype(self.work.scaled.dtype)
        found = self.splines.deflection(set_.points, single, single, np.empty_like(single))
        return np.asarray(found.vector, dtype=float)

    def _step(self, set_: _Points, level: float) -> RealArray:
        """Pressures (n,) in Pa after a step, within their bounds and of the prescribed load.

        Points that a first pass takes to a bound stay there, and the others are solved for once
        more, with the deflection by the first change from the model: 2.1 pairs of 9.4 fewer than
        with one pass, at 512² (a third pass: 2.2; a second in the first step alone: 1.0).
        """
        work, constraint, load = self.work, self.work.qp.constraint, 0.0
        if isinstance(constraint, FixedMean):
            elsewhere = float(self.pressure.sum(dtype=float) - set_.pressure.sum())
            load = constraint.mean_pressure * self.pressure.size - elsewhere
        new = self._within(set_, self._correction(set_, level), load)
        free = ~set_.yields & (new > 0.0) & (new < self.highest[set_.index])
        if not free.any():
            return new
        left, change = free | set_.yields, (new - set_.pressure) / work.unit
        r = set_.r + work.qp.height_scale * self._by_model(set_, change)
        level = float(r[free].mean()) if work.load is not None else level
        rest = self._set(set_.index[left], new[left], r[left], set_.yields[left], level)
        new[left] = self._within(rest, self._correction(rest, level), load - float(new[~left].sum()))
        return new

    def _within(self, set_: _Points, d: RealArray, load: float) -> RealArray:
        """Pressures (n,) in Pa of the set after the change ``d``, within their bounds, and where
        the load is prescribed of the sum ``load`` (Pa)."""
        free, highest = ~set_.yields, self.highest[set_.index]
        new = set_.pressure + self.work.unit * d
        inside = np.clip(new, np.where(free, 0.0, self.lowest[set_.index]), highest)
        if self.work.load is not None:
            for _ in range(LOAD_SWEEPS):  # all of them where scaling the free ones does not suffice
                missing = load - float(inside.sum())
                if abs(missing) <= LOAD_ROUNDING * load:
                    break
                below = free & (inside > 0.0) & (inside < highest)
                movable = float(inside[below].sum())
                if movable > 0.0 and movable + missing > 0.0:
                    inside[below] = np.minimum(inside[below] * ((movable + missing) / movable), highest[below])
                elif missing < 0.0:
                    inside *= load / (load - missing)
                else:
                    below = free & (inside < highest)
                    if not below.any():
                        break
                    inside[below] = np.minimum(inside[below] + missing / np.count_nonzero(below), highest[below])
        return inside
