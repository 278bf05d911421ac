"""Hardness as a coupling: it limits the pressure, and remembers the permanent indentation that the limit has caused.

A load ends where p <= H(w) everywhere and p = H(w) wherever the surface went deeper, w being the indentation *reached*.
Taking H at the indentation before the load instead would make the answer depend on the number of steps; here a step of
any size ends in agreement, and steps are needed only for loads that go up and down.

With a constant hardness this takes one round. A hardness that changes with depth is itself the unknown; it starts at the
indentation so far. Where the solid softens with depth (hard film), limits fall and the indentation grows from round to
round towards the smallest that agrees: the one a growing load meets first, though others may agree, too. What the error of
a normal solve breaks on the way stays broken, so all of them are solved to the full tolerance. Where the solid
hardens there is only one answer, and plain rounds would overshoot: there every pixel springs back by its own compliance as
its limit rises, and the limits are extrapolated with the other smooth unknowns (rounds at a film of 0.01 to 0.5 times
the rms height under 0.2 E*: 84, 27, 11 with the depth as unknown and Newton's step for the pixel; 39, 16, 10 so).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

import numpy as np

from ...core.arrays import RealArray
from ..laws import InterfaceLaw, LimitByDepth, work_density
from ..operators.convolution import Operator
from .protocol import Contact, Coupling, Exchange, Memory, Posed, Share

TOLERANCE = 1e-5
"""Relative difference of the limit used and the limit at the indentation reached; the law itself is good to per cents."""

_HALVINGS = 40
_MORE_DEPTHS = tuple(10.0**power for power in range(-12, 7))


def added_indentation(contact: Contact) -> RealArray:
    """Permanent indentation (nx, ny) in m that ``contact`` adds: the overlap of the bodies where the pressure is at its limit."""
    if contact.qp.elastic:
        return np.zeros_like(contact.qp.profile)
    p = contact.pressure
    return np.where((p > 0.0) & (p >= contact.qp.cap), np.maximum(contact.overlap, 0.0), 0.0)


def _before(posed: Posed, memory: Memory) -> RealArray:
    return memory["indentation"] if "indentation" in memory else np.zeros_like(posed.profile)


def _after(law: InterfaceLaw, note: _Note, contact: Contact) -> Memory:
    """Indentation (m) and plastic work (J) since the virgin surface, after ``contact``."""
    after, work = note.before, float(note.memory.get("work", 0.0))
    if not contact.qp.elastic:
        after = note.before + added_indentation(contact)
        work += float(work_density(law, note.before, after).sum()) * contact.posed.operator.grid.pixel_area
    return {"indentation": after, "work": np.asarray(work)}


@dataclass(frozen=True)
class _Note:
    """Indentation before the step (nx, ny) in m, its memory, and the last limits (nx, ny) in Pa that bore the load."""

    before: RealArray
    memory: Memory
    bearing: RealArray | None = None


@dataclass(frozen=True)
class ConstantHardness(Coupling):
    """Limit of the pressure that does not change with depth, or none at all: passive."""

    law: InterfaceLaw
    name: ClassVar[str] = "hardness"
    feedback: ClassVar[bool] = False
    remedy: ClassVar[str] = ""

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The indentation so far, (nx, ny) in m."""
        before = _before(posed, memory)
        return Exchange(before, before, note=_Note(before, memory))

    def share(self, exchange: Exchange) -> Share:
        """The limit, and the indentation before the step as a lift."""
        return Share(lift=exchange.x, cap=self.law.pressure_cap())

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, None]:
        """Indentation and work."""
        return _after(self.law, exchange.note, contact), None


@dataclass(frozen=True)
class DepthHardness(Coupling):
    """Limit of the pressure that follows the indentation reached; the unknown is that limit (nx, ny) in Pa."""

    law: LimitByDepth
    own_compliance: float = field(repr=False)
    tolerance: float = TOLERANCE
    name: ClassVar[str] = "hardness"
    feedback: ClassVar[bool] = True
    remedy: ClassVar[str] = (
        "Take smaller steps of load or a finer grid; a soft layer more than a hundred times thinner than the indentation can be "
        "left out, the hardness being that of what lies below."
    )

    @classmethod
    def prepared(cls, law: LimitByDepth, operator: Operator, tolerance: float) -> Self:
        """Coupling on the grid of ``operator``, whose displacement (m) of a pixel by one Pa on it alone it needs."""
        unit = np.zeros(operator.grid.shape)
        unit[0, 0] = 1.0
        return cls(law, float(operator.apply(unit)[0, 0]), tolerance)

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The limit at the indentation so far."""
        before = _before(posed, memory)
        cap = np.asarray(self.law.cap_at(before))
        return Exchange(cap, cap, np.inf, self.tolerance, exact=True, note=_Note(before, memory))

    def share(self, exchange: Exchange) -> Share:
        """The limit, and the indentation before the step as a lift."""
        return Share(lift=exchange.note.before, cap=exchange.x)

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        """The limit at the depth reached; where the solid hardens, at the one that a pixel on its own would reach."""
        before, x = exchange.note.before, exchange.x
        reached = before + added_indentation(contact)
        limit, virgin = np.asarray(self.law.cap_at(reached)), self.law.cap_at(before)
        smooth = exchange.smooth and not bool(np.any(limit < virgin))
        return replace(
            exchange,
            target=self._sprung_back(before, reached, x) if smooth else limit,
            residual=_disagreement(contact, limit),
            smooth=smooth,
            exact=not smooth,
            scale=float(np.linalg.norm(x)),
            lowest=virgin if smooth else 0.0,
            note=replace(exchange.note, bearing=x),
        )

    def _sprung_back(self, before: RealArray, reached: RealArray, cap: RealArray) -> RealArray:
        """Limit H(w) (nx, ny) in Pa of a pixel that reached a depth (m) with ``cap`` and springs back while its limit rises.

        Its depth w solves w + c (H(w) - cap) = reached. By bisection: the limit of a soft film is flat, steep and flat again,
        which leads Newton's method astray.
        """
        moved = reached > before
        low, wanted, start = before[moved], reached[moved], cap[moved]
        high = wanted + self.own_compliance * start
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            below = middle + self.own_compliance * (self.law.cap_at(middle) - start) < wanted
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        found = np.array(self.law.cap_at(reached))
        found[moved] = self.law.cap_at(0.5 * (low + high))
        return found

    def rescued(self, exchange: Exchange, mean: float) -> Exchange | None:
        """Half the way to limits that bear ``mean``: the last that did, or those at the first depth that is the same more everywhere."""
        note, bearing = exchange.note, exchange.note.bearing
        if bearing is None or not np.mean(bearing) >= mean:
            caps = (np.asarray(self.law.cap_at(note.before + more)) for more in _MORE_DEPTHS)
            bearing = next((cap for cap in caps if np.mean(cap) >= mean), None)
        if bearing is None:
            return None
        return replace(exchange, x=0.5 * (exchange.x + bearing), note=replace(note, bearing=bearing))

    def settled(self, exchange: Exchange) -> str:
        """That the limit is."""
        return "The hardness agrees with the depth of the indentation"

    def unsettled(self, exchange: Exchange) -> str:
        """The change of the limit."""
        return f"The hardness still changes by {exchange.residual:.1e} with the depth of the indentation"

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, None]:
        """Indentation and work."""
        return _after(self.law, exchange.note, contact), None


def _disagreement(contact: Contact, limit: float | RealArray) -> float:
    """Largest relative excess of the pressure over the ``limit``, or at yielding points difference from it either way."""
    p = contact.pressure
    off = np.where(p >= contact.qp.cap, np.abs(p - limit), p - limit) / limit
    return max(float(off.max()), 0.0)
