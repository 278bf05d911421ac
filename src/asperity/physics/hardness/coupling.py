"""Hardness as a coupling: it limits the pressure; its memory is the permanent indentation that the
limit has caused.

A load ends where p <= H(w) everywhere and p = H(w) wherever the surface went deeper, w being the
indentation *reached*. Taking H at the indentation before the load instead would make the answer
depend on the number of steps; here a step of any size ends in agreement, and steps are needed only
for loads that go up and down.

With a constant hardness this takes one round. A hardness that changes with depth is itself the
unknown; it starts at the indentation so far. Where the solid softens with depth (hard film), limits
fall and the indentation grows from round to round towards the smallest that agrees: the one a
growing load meets first, though others may agree, too. Where limits fall so steeply that a pixel
may come to rest at several depths, one that yields by the error of a normal solve stays indented,
so all solves are to the full tolerance. Where they fall gently, the fast solver finds limits and
pressure together (``solver``), and one round confirms them: on self-affine surfaces of 512² points,
with a film of hardness 0.6 E*, 4 pixels thick, on 0.3 E*, in as many FFT pairs as elastic contact
takes. With other solvers, or beside other couplings with feedback, it takes rounds, in which solves
follow the residual, and limits are foreseen: a point sinks by some compliance times the fall of its
limit, at least twice its own since the points around it give way as well, later as much as it did
in the last round. This and starts in which yielding points go along with their limits take 6.1
times the pairs instead of 12.9.

Where the solid hardens (soft film) there is only one answer. A pixel whose limit rises springs back
by its own compliance c, along the line p + w/c = y, which crosses the curve p = H(w) once: the
place y of that crossing is the unknown, extrapolated with the other smooth ones. Where the curve is
flat (slope below 1/c) the limit H(w) is posed and the depth follows; where it is steep, as that of
a film far thinner than the indentation, the depth w is posed and the pressure follows. Either way
an error of what is posed shrinks. 24 random soft films of 1e-4 to 3 times the rms height (24 x 20):
all settle in 3 to 17 rounds, 205 in all and 2804 FFT pairs; with limits everywhere 12 of them did
not settle (791 rounds, 5578 pairs).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

import numpy as np

from ...contact.couplings.protocol import Ahead, Contact, Coupling, Exchange, Memory, Posed, Share
from ...contact.law import LimitByDepth, added_indentation, indentation_before, indented
from ...contact.operators.convolution import Operator
from ...contact.solvers.active_set.solver import ActiveSet
from ...contact.solvers.protocol import ContactQP, Solver
from ...core.arrays import RealArray
from ...core.status import Progress
from .solver import FallingLimit, follow

TOLERANCE = 1e-5
"""Relative difference of the limit used and the limit at the indentation reached; the law itself is
good to per cents."""

_HALVINGS = 60

_STEEP = 1.0
"""Slope of H(w) over 1/c, the stiffness of a pixel, above which the depth is prescribed and the
pressure follows."""

_STEP = 1e-3
"""Relative change of a depth over which the slope of the limit is taken."""

_ROUNDING = 1e-12

_RESOLVED = 1e-10
"""Depth over the rms height below which differences do not count: the limit of the thinnest films
changes within them."""

_CHANGING = 0.1
"""Change of the limit over its tolerance down to which it matters."""

_FINAL = 1e-11
"""Error of the last normal solve where depths are prescribed: of the pressures there, which go with
its root, it is 3e-6."""

_SINKING = 2.0
"""Compliance by which a yielding point sinks over that of its pixel alone, at least. Pairs over
those of elastic contact, 512² as above, for this alone: 8.1; together with the compliance of the
last round: 6.1; with 0.6 of that, 6.4."""

_GENTLE = 0.6
"""Slope -H'(w) times such a compliance, at most: from one on there is no depth at which the point
would come to rest."""

_RESOLVED_FALL = 1e-7
"""Fall of a limit, relative to the pressure, from which it tells by what compliance the point
sank."""

_FORESEEN = 0.8
"""Share of the tolerance to which limits are found with the pressure, before the round that
confirms it."""

_FALL = 0.6
"""Factor by which residuals of softening films at best fall from round to round."""

_MORE_DEPTHS = tuple(10.0**power for power in range(-12, 7))


@dataclass(frozen=True)
class _Note:
    """Indentation before the step (nx, ny) in m, its memory, the last unknown (nx, ny) in Pa whose
    limits bore the load, and whether some did not: then depths are prescribed everywhere, for where
    all points yield limits alone do not determine the contact. Limits (Pa) and depths (m) of the
    last round.
    """

    before: RealArray
    memory: Memory
    bearing: RealArray | None = None
    weak: bool = False
    last: tuple[RealArray, RealArray] | None = None


@dataclass(frozen=True)
class DepthHardness(Coupling):
    """Limit of the pressure that follows the indentation reached.

    The unknown (nx, ny) in Pa is the place H(w) + w/c where the solid hardens, else the limit
    itself. ``own_compliance`` c is the displacement (m) of a pixel by one Pa on it alone,
    ``deepest`` (m) where the limit no longer changes, ``fall`` (Pa/m) the steepest fall of the
    limit with depth, ``falls`` whether it nowhere rises.
    """

    law: LimitByDepth
    own_compliance: float = field(repr=False)
    deepest: float = field(repr=False)
    tolerance: float = TOLERANCE
    fall: float = field(default=np.inf, repr=False)
    falls: bool = field(default=False, repr=False)
    name: ClassVar[str] = "hardness"
    settled_text: ClassVar[str] = "The hardness agrees with the depth of the indentation"
    unsettled_text: ClassVar[str] = "The hardness still changes by {change:.1e} with the depth of the indentation"
    feedback: ClassVar[bool] = True
    bounds: ClassVar[bool] = True
    remedy: ClassVar[str] = (
        "Take smaller steps of load or a finer grid; a layer that is a billion times thinner than the "
        "roughness can be left out."
    )

    @classmethod
    def prepared(cls, law: LimitByDepth, operator: Operator, tolerance: float | None = None) -> Self:
        """Coupling on the grid of ``operator``, by default with the usual tolerance."""
        tolerance = TOLERANCE if tolerance is None else tolerance
        unit = np.zeros(operator.grid.shape)
        unit[0, 0] = 1.0
        depths = np.array([_MORE_DEPTHS])
        limits = np.asarray(law.cap_at(depths))
        changing = np.flatnonzero(np.abs(limits - limits[0, -1]) > _CHANGING * tolerance * limits[0, -1])
        deepest = float(depths[0, min(changing[-1] + 1, depths.size - 1)]) if changing.size else 0.0
        fine = np.geomspace(_MORE_DEPTHS[0], _MORE_DEPTHS[-1], 20 * len(_MORE_DEPTHS))
        slopes = np.diff(np.asarray(law.cap_at(fine[None])).ravel()) / np.diff(fine)
        own, falls = float(operator.apply(unit)[0, 0]), bool(np.all(slopes <= 0.0) and np.any(slopes < 0.0))
        return cls(law, own, deepest, tolerance, max(0.0, -float(slopes.min())), falls)

    @property
    def _gentle(self) -> bool:
        """Whether a pixel can come to rest at one depth only."""
        return self.fall * _SINKING * self.own_compliance <= _GENTLE

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The limit at the indentation so far."""
        before = indentation_before(posed, memory)
        x = self._place(before)
        note = _Note(before, memory)
        return Exchange(x, x, np.inf, self.tolerance, exact=not self._gentle, lowest=x, note=note)

    def ahead(
        self, exchange: Exchange, qp: ContactQP, start: RealArray | None, solver: Solver, progress: Progress
    ) -> Ahead:
        """Limits that fall gently are found with the pressure."""
        if not (self.falls and self._gentle and isinstance(solver, ActiveSet)):
            return Ahead()
        before = exchange.note.before
        highest, lowest = (self._limits(depth) for depth in (before, np.maximum(before, self.deepest)))
        found = follow(
            qp, FallingLimit(self.law, before, highest, lowest, _FORESEEN * self.tolerance), solver, start, progress
        )
        if found.cap is None:
            return Ahead(found.pairs, found.iterations)
        known = replace(exchange, x=found.cap, target=found.cap, smooth=False, lowest=0.0, pressure=found.pressure)
        return Ahead(found.pairs, found.iterations, known)

    def _limits(self, depth: RealArray) -> RealArray:
        """Limit (nx, ny) in Pa at a depth (nx, ny) in m; most points are not indented, and all of
        these have the same."""
        index = np.flatnonzero(depth)
        limits = np.full(depth.shape, self.law.cap_at(np.zeros((1, 1))))
        limits.reshape(-1)[index] = self.law.cap_at(depth.reshape(-1)[index][None])
        return limits

    def share(self, exchange: Exchange) -> Share:
        """The limit, or the indentation that goes with it where the limit is steep; the indentation
        before the step as a lift."""
        before = exchange.note.before
        if not exchange.smooth:
            return Share(lift=before, cap=exchange.x)
        depth = self._depth(before, exchange.x)
        limit, deeper = (self._limits(at) for at in (depth, depth * (1.0 + _STEP)))
        slope = self.own_compliance * (deeper - limit) / (_STEP * np.maximum(depth, np.finfo(float).tiny))
        steep = (exchange.x > exchange.lowest * (1.0 + _ROUNDING)) & ((slope > _STEEP) | exchange.note.weak)
        most = self._limits(np.maximum(before, self.deepest))
        return Share(lift=before, cap=np.where(steep, most, limit), indentation=np.where(steep, depth - before, 0.0))

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        """The limit at the depth reached; where the solid hardens, at the one that a pixel on its
        own would reach."""
        before = exchange.note.before
        reached = before + added_indentation(contact)
        limit = self._limits(reached)
        # relative excess of the pressure over the limit, at yielding points its difference from it
        # either way
        p, resolved = contact.pressure, _RESOLVED * contact.posed.height_scale
        index, nearest = np.flatnonzero(reached > exchange.note.before), limit.copy()
        deep, first, there = (field.reshape(-1)[index] for field in (reached, exchange.note.before, limit))
        near = np.concatenate(
            [there[None], *(self.law.cap_at(np.maximum(deep + by, first)[None]) for by in (-resolved, resolved))]
        )
        nearest.reshape(-1)[index] = np.clip(p.reshape(-1)[index], near.min(axis=0), near.max(axis=0))
        off = np.where(p >= contact.cap, np.abs(p - nearest), p - nearest) / nearest
        residual = max(float(off.max()), 0.0)
        smooth = exchange.smooth and not bool(np.any(limit < self._limits(before)))
        if smooth:
            place = contact.pressure + reached / self.own_compliance
            target = np.clip(place, exchange.lowest, self._place(np.maximum(before, self.deepest)))
        else:
            target, sinking, last = limit, contact.pressure > limit, exchange.note.last
            if residual > self.tolerance and self._gentle and sinking.any():
                # the limit falls gently: at sinking points that at the depth to which they sink
                # while their pressure follows it
                begin, pressure = reached[sinking], contact.pressure[sinking]
                compliance = np.full(begin.shape, _SINKING * self.own_compliance)
                if last is not None:
                    fell, sank = (last[0] - exchange.x)[sinking], (reached - last[1])[sinking]
                    known = (fell > _RESOLVED_FALL * pressure) & (last[1] > before)[sinking]
                    most = _GENTLE / max(self.fall, np.finfo(float).tiny)
                    compliance[known] = np.clip(sank[known] / fell[known], compliance[known], most)
                depth = begin
                for _ in range(_HALVINGS):
                    depth = begin + compliance * np.maximum(pressure - self.law.cap_at(depth), 0.0)
                target = limit.copy()
                target[sinking] = self.law.cap_at(depth)
        return replace(
            exchange,
            target=target,
            final=_FINAL if np.any(contact.indentation) else np.inf,
            residual=residual,
            smooth=smooth,
            exact=not smooth and not self._gentle,
            slowest=0.0 if smooth else _FALL,
            scale=float(np.linalg.norm(exchange.x)),
            lowest=exchange.lowest if smooth else 0.0,
            pressure=None,
            note=replace(exchange.note, bearing=exchange.x, last=(exchange.x, reached)),
        )

    def _place(self, depth: RealArray) -> RealArray:
        """y (nx, ny) in Pa of a depth (nx, ny) in m."""
        return self._limits(depth) + depth / self.own_compliance

    def _depth(self, before: RealArray, place: RealArray) -> RealArray:
        """Depth w (nx, ny) in m, at least ``before``, of a ``place`` y = H(w) + w/c in Pa.

        By bisection: the limit of a soft film is flat, steep and flat again, on which Newton's
        method fails.
        """
        wanted = self.own_compliance * place
        most = wanted - self.own_compliance * self._limits(before)
        index = np.flatnonzero(most > before)
        depth = np.array(before, dtype=float)
        start, high, wanted = (field.reshape(-1)[index][None] for field in (before, most, wanted))
        low = start
        for _ in range(_HALVINGS if index.size else 0):
            middle = 0.5 * (low + high)
            below = middle + self.own_compliance * self.law.cap_at(middle) < wanted
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        depth.reshape(-1)[index] = np.where(low > start, 0.5 * (low + high), start)[0]
        return depth

    def rescued(self, exchange: Exchange, mean: float) -> Exchange | None:
        """Half the way to limits that bear ``mean``: the last that did, or those at the first depth
        that is the same more everywhere."""
        note, bearing, smooth = exchange.note, exchange.note.bearing, exchange.smooth
        last = self._limits(self._depth(note.before, bearing)) if smooth and bearing is not None else bearing
        if last is None or not np.mean(last) >= mean:
            depths = (note.before + more for more in _MORE_DEPTHS)
            depth = next((depth for depth in depths if np.mean(self._limits(depth)) >= mean), None)
            if depth is None:
                return None
            bearing = self._place(depth) if smooth else self._limits(depth)
        return replace(exchange, x=0.5 * (exchange.x + bearing), note=replace(note, bearing=bearing, weak=True))

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, None]:
        """Indentation and work."""
        return indented(self.law, exchange.note.memory, contact), None
