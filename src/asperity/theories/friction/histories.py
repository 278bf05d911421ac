"""Any path of normal and tangential loading in partial slip, from the normal contact alone (Jäger
1998; Popov & Heß 2015).

Two bodies whose tangential compliance is κ times the normal one: identical ones of ν = 0, in plane
strain all without coupling, otherwise an approximation with κ = E*/G*. The shear traction is then a
sum of differences of normal contacts,

    q = Σ m_i [p(P_i) - p(P_(i-1))],  Q = Σ m_i (P_i - P_(i-1)),  δ_t = κ Σ m_i (δ_i - δ_(i-1)),
    |m_i| ≤ μ,

and the levels P_i with their slopes m_i are the memory of the contact, which slip erases from the
edge inwards. Both on paths that are straight in the forces (P, Q), and on those straight in
approach and shift (δ, δ_t/κ), a step of any length is exact: with X the normal and Y the tangential
member of the pair the new slip annulus X* < X_i < X follows from Y(X*) + sμ(X - X*) = Y, s = ±1.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import ClassVar, Protocol, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quadrature import gauss
from ..protocol import ContactAnswer, curve


class NormalContact(Protocol):
    """A theory of one contact without friction, such as ``HertzPoint`` or ``PowerLawIndenter``."""

    def at_load(self, load: ArrayLike, /) -> ContactAnswer:
        """The contact under loads."""
        ...

    def pressure(self, r: ArrayLike, load: float, /) -> RealArray:
        """Pressure at places."""
        ...


Contacts: TypeAlias = Callable[[RealArray], ContactAnswer]
"""Normal contacts at loads, or at approaches."""


@dataclass(frozen=True, eq=False)
class SlipMemory:
    """State of a contact in partial slip.

    Parameters
    ----------
    load, approach
        (n + 1,) levels of the normal contact in N and m, rising from zero to the present ones;
        approaches NaN where the theory gives none.
    slopes
        (n,) tangential over normal force that was added between the levels, -μ to μ.
    shift
        Tangential displacement of distant points so far in m.
    height
        Approach at present in m, negative by the distance without contact.
    """

    load: RealArray
    approach: RealArray
    slopes: RealArray
    shift: float = 0.0
    height: float = 0.0

    @property
    def tangential(self) -> float:
        """Tangential force in N."""
        return float(np.sum(self.slopes * np.diff(self.load)))

    @property
    def drawn(self) -> float:
        """Elastic part of the shift over κ in m."""
        return float(np.sum(self.slopes * np.diff(self.approach)))

    def stick_load(self, friction: float) -> float:
        """Load in N whose contact is the stick zone: the highest level below which the slope is not
        ±μ."""
        sticking = np.flatnonzero(np.abs(self.slopes) < friction * (1.0 - 1e-12))
        return float(self.load[sticking[-1] + 1]) if sticking.size else 0.0


UNTOUCHED = SlipMemory(np.zeros(1), np.zeros(1), np.zeros(0))
"""State before the first touch."""


@dataclass(frozen=True, eq=False)
class SlipPath:
    """A contact along a path: (n,) values after each step.

    Parameters
    ----------
    load, tangential
        Normal and tangential force P and Q in N.
    approach, shift
        Normal and tangential displacement of distant points δ and δ_t in m; NaN where the theory
        gives no approach.
    stick_load
        Load in N whose contact is the stick zone.
    dissipated
        Work of friction since the start in J.
    memories
        States after the steps; each may start another path.
    """

    load: RealArray
    tangential: RealArray
    approach: RealArray
    shift: RealArray
    stick_load: RealArray
    dissipated: RealArray
    memories: tuple[SlipMemory, ...]


@dataclass(frozen=True)
class PartialSlip:
    """Histories of a ``normal`` contact with ``friction`` coefficient μ and ``ratio`` κ of
    tangential over normal compliance.

    Examples
    --------
    A sphere is pressed, pulled to half the limit of friction, and back: what is left at zero force
    is the memory of the reversal (Mindlin & Deresiewicz 1953).

    >>> from asperity.theories import HertzPoint
    >>> contact = PartialSlip(HertzPoint(E_star=1e9, radius=1e-2), friction=0.3)
    >>> path = contact.under_forces(load=[1.0, 1.0, 1.0], tangential=[0.0, 0.15, 0.0])
    >>> [f"{shift * 1e9:.1f} nm" for shift in path.shift]
    ['0.0 nm', '425.3 nm', '24.1 nm']
    """

    normal: NormalContact
    friction: float
    ratio: float = 1.0
    citation_keys: ClassVar[tuple[str, ...]] = ("Ciavarella1998", "Jager1998", "Popov2015")

    def __post_init__(self) -> None:
        """InputError unless coefficient and ratio are positive."""
        require.positive(self.friction, "friction coefficient")
        require.positive(self.ratio, "ratio of the compliances")

    def under_forces(self, load: ArrayLike, tangential: ArrayLike, start: SlipMemory = UNTOUCHED) -> SlipPath:
        """Path through ``load`` P and ``tangential`` force Q in N, (n,) each, straight in between.

        InputError if P is negative or |Q| exceeds μP at a step.
        """
        P, Q = _paired(curve(load, "load (N)"), curve(tangential, "tangential force (N)"))
        if np.any(P < 0.0) or np.any(np.abs(Q) > self.friction * P * (1.0 + 1e-12)):
            raise InputError(
                "tangential force must be at most friction coefficient times load at every step, but exceeds it by "
                f"{float((np.abs(Q) - self.friction * P).max()):.4g} N. Beyond it the contact slides."
            )
        return self._path(P, Q, start, self.normal.at_load, of_shifts=False)

    def under_shifts(self, approach: ArrayLike, shift: ArrayLike, start: SlipMemory = UNTOUCHED) -> SlipPath:
        """Path through ``approach`` δ and ``shift`` δ_t in m, (n,) each, straight in between; δ < 0
        is out of contact."""
        delta, moved = _paired(curve(approach, "approach (m)"), curve(shift, "shift (m)"))
        at_approach = getattr(self.normal, "at_approach", None)
        if at_approach is None:
            raise InputError(
                "normal contact must be a theory with at_approach on a path of shifts, but is "
                f"{type(self.normal).__name__} which has none. Prescribe the forces instead."
            )
        return self._path(delta, moved, start, at_approach, of_shifts=True)

    def traction(self, r: ArrayLike, memory: SlipMemory) -> RealArray:
        """Shear traction in Pa at the distance ``r`` in m (any shape) from the axis in the state
        ``memory``."""
        place = np.asarray(r, dtype=float)
        pressures = [self.normal.pressure(place, float(P)) if P > 0.0 else 0.0 * place for P in memory.load]
        parts = (m * (p - q) for m, p, q in zip(memory.slopes, pressures[1:], pressures, strict=False))
        return np.asarray(sum(parts, start=0.0 * place))

    def cycle_dissipation(self, load: float, amplitude: float) -> float:
        """Work of friction in J of a cycle of Q between ±``amplitude`` in N under the ``load`` in
        N."""
        path = self.under_forces([load] * 4, amplitude * np.array([0.0, 1.0, -1.0, 1.0]))
        return float(path.dissipated[-1] - path.dissipated[1])

    def _path(
        self, normal: RealArray, tangential: RealArray, memory: SlipMemory, contacts: Contacts, *, of_shifts: bool
    ) -> SlipPath:
        """Straight steps of X and Y: load and tangential force, or approach and shift over κ;
        ``contacts`` are those at levels of X."""
        memories, work = [], []
        for x, y in zip(normal.tolist(), tangential.tolist(), strict=True):
            if of_shifts:
                x0, y0, levels, unit = memory.height, memory.shift, memory.approach, self.ratio
            else:
                x0, y0, levels, unit = float(memory.load[-1]), memory.tangential, memory.load, 1.0
            drive = (y - y0) / unit
            if min(x0, x) < 0.0:  # the part of the step in which the bodies touch
                drive *= (max(x, 0.0) - max(x0, 0.0)) / (x - x0) if x != x0 else 0.0
            leg = _Leg(_Stack(levels, memory.slopes), max(x0, 0.0), max(x, 0.0), drive, self.friction)
            after = leg.end()
            found = contacts(after.levels)
            if of_shifts:
                memory = SlipMemory(found.load, after.levels, after.slopes, shift=y, height=x)
            else:
                grown = SlipMemory(after.levels, found.approach, after.slopes)
                shift = memory.shift + self.ratio * (grown.drawn - memory.drawn)
                memory = replace(grown, shift=shift, height=float(found.approach[-1]))
            memories.append(memory)
            work.append(self.friction * self.ratio * _work(leg, contacts, of_shifts=of_shifts))
        return SlipPath(
            load=np.array([one.load[-1] for one in memories]),
            tangential=np.array([one.tangential for one in memories]),
            approach=np.array([one.height for one in memories]),
            shift=np.array([one.shift for one in memories]),
            stick_load=np.array([one.stick_load(self.friction) for one in memories]),
            dissipated=np.cumsum(work),
            memories=tuple(memories),
        )


@dataclass(frozen=True, eq=False)
class _Stack:
    """Y(X) as a broken line: ``levels`` X_i (n + 1,) and ``slopes`` (n,)."""

    levels: RealArray
    slopes: RealArray

    @property
    def values(self) -> RealArray:
        return np.concatenate([[0.0], np.cumsum(self.slopes * np.diff(self.levels))])

    def cut(self, x: float) -> _Stack:
        """The part up to ``x``."""
        kept = int(np.searchsorted(self.levels, x, side="left"))
        return (
            self
            if kept == self.levels.size
            else _Stack(np.append(self.levels[:kept], x), self.slopes[:kept])
            if kept
            else _Stack(np.zeros(1), np.zeros(0))
        )

    def extended(self, x: float, slope: float) -> _Stack:
        """With a piece up to ``x`` added; pieces of one slope are one."""
        if x <= self.levels[-1]:
            return self
        if self.slopes.size and self.slopes[-1] == slope:
            return _Stack(np.append(self.levels[:-1], x), self.slopes)
        return _Stack(np.append(self.levels, x), np.append(self.slopes, slope))


@dataclass(frozen=True, eq=False)
class _Leg:
    """Straight step of a ``stack`` from the level ``x0`` to ``x1`` while Y is driven by
    ``drive``."""

    stack: _Stack
    x0: float
    x1: float
    drive: float
    friction: float

    def at(self, t: float) -> tuple[float, float]:
        """X and what Y would be without gross slip, at the part ``t`` of the step."""
        return self.x0 + t * (self.x1 - self.x0), self.stack.values[-1] + t * self.drive

    def sign(self, t: float) -> float:
        """Direction of slip, zero where all sticks."""
        (x, y), bound = self.at(t), 0.0
        rest = y - self.stack.cut(x).values[-1]
        if x > self.x0:
            bound = self.friction * (x - self.x0) * (1.0 + 1e-13)
        # a part of the limit of friction below rounding is no slip
        return math.copysign(1.0, rest) if abs(rest) > max(bound, 1e-15 * self.friction * max(x, self.x0)) else 0.0

    def front(self, t: float) -> tuple[float, float]:
        """X*, and its slope in the old stack; of gross slip 0 and NaN."""
        (x, y), s = self.at(t), self.sign(t)
        old = self.stack.cut(x)
        # along the stack s (Y_i + sμ(x - X_i) - y) falls; the front is where it vanishes
        excess = s * (old.values - y) + self.friction * (x - old.levels)
        inside = np.flatnonzero(excess >= 0.0)
        if not inside.size:
            return 0.0, math.nan
        i = int(inside[-1])
        if i == old.slopes.size:
            return float(old.levels[i]), math.nan
        return float(old.levels[i] + excess[i] / (self.friction - s * old.slopes[i])), float(old.slopes[i])

    def end(self) -> _Stack:
        """The stack after the step."""
        s = self.sign(1.0)
        if s:
            return self.stack.cut(self.front(1.0)[0]).extended(self.x1, s * self.friction)
        slope = self.drive / (self.x1 - self.x0) if self.x1 > self.x0 else 0.0
        return self.stack.cut(self.x1).extended(self.x1, min(max(slope, -self.friction), self.friction))

    def events(self) -> RealArray:
        """Rising parts t of the step, 0 to 1, between which X, X* and the direction of slip change
        smoothly."""
        old, dx, mu = self.stack, self.x1 - self.x0, self.friction
        with np.errstate(divide="ignore", invalid="ignore"):
            times = [(old.levels - self.x0) / dx]  # the edge passes a level
            for s in (-mu, mu):  # the front passes a level: Y_i + s (X - X_i) = Y
                times.append((old.values + s * (self.x0 - old.levels) - old.values[-1]) / (self.drive - s * dx))
            # between levels the edge may meet the front: Y = old Y(X)
            times.append(
                (old.values[:-1] + old.slopes * (self.x0 - old.levels[:-1]) - old.values[-1])
                / (self.drive - old.slopes * dx)
            )
        found = np.concatenate(times)
        found = found[np.isfinite(found) & (found > 0.0) & (found < 1.0)]
        return np.unique(np.concatenate([[0.0], found, [1.0]]))


_NODES = 48
_POWER = 6  # of the distance from the ends: makes roots and powers of multiples of 1/6 smooth there


def _work(leg: _Leg, contacts: Contacts, *, of_shifts: bool) -> float:
    """Work of friction over μκ: all of the annulus slips alike, ∫ [P - P* - P*'(δ - δ*)] dσ."""
    total = 0.0
    for low, high in pairwise(leg.events().tolist()):
        middle = 0.5 * (low + high)
        s = leg.sign(middle)
        if not s:
            continue
        # a rule for powers of the distance from both ends
        u, part = gauss(np.array([0.0, 1.0]), _NODES)
        density = (u * (1.0 - u)) ** (_POWER - 1)
        step = math.factorial(2 * _POWER - 1) / math.factorial(_POWER - 1) ** 2
        powers = range(_POWER, 2 * _POWER)
        terms = [math.comb(2 * _POWER - 1, k) * u**k * (1.0 - u) ** (2 * _POWER - 1 - k) for k in powers]
        t, weight = low + (high - low) * np.sum(terms, axis=0), (high - low) * step * density * part
        x = np.maximum(leg.x0 + t * (leg.x1 - leg.x0), 0.0)
        start, slope = leg.front(middle)
        rate = leg.drive - s * leg.friction * (leg.x1 - leg.x0)
        advance = 0.0 if math.isnan(slope) else rate / (slope - s * leg.friction)
        front = np.clip(start + advance * (t - middle), 0.0, x)
        edge, inner = contacts(x), contacts(front)
        force = edge.load - inner.load - inner.stiffness * (edge.approach - inner.approach)
        # slip over κ per unit of Y - sμX
        speed = 1.0 if of_shifts else 1.0 / np.maximum(inner.stiffness, np.finfo(float).tiny)
        total += abs(rate) * float(np.sum(weight * force * speed))
    return total


def _paired(first: RealArray, second: RealArray) -> tuple[RealArray, RealArray]:
    """Both of the length of the longer one."""
    try:
        one, other = np.broadcast_arrays(first, second)
    except ValueError:
        raise InputError(
            f"path must hold as many normal as tangential values, but has {first.size} and {second.size}."
        ) from None
    return one, other
