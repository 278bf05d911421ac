"""Bracket of the force at which menisci and contact balance: the meniscus force counts pixels, so
that the balance may lie in a jump of it.

The larger the load L the more pixels are wet, F_m(L) rises by whole pixels, and L = W + F_m(L)
holds exactly where it does. Where contact takes the place of liquid F_m falls instead, and L - W
may lie between its values on both sides of the fall. A pixel that comes into contact there has
neither gap nor pressure, and one at the height of the menisci is as good wet as dry: any share of
it may be under liquid without a change of the contact, and one share balances the forces. An island
that loses its last touch to the film is no such pixel: it dries as a whole, and there is no
balance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ...core.arrays import RealArray
from .film import Wetting, between

_INSIDE = 1e-3
"""Share of the bracket that a step keeps from its ends."""

_GEOMETRIC = 4.0
"""Ratio of the loads at both ends from which their geometric mean halves the bracket instead."""

_SLOW = 0.5
"""Width over that two rounds ago above which the bracket is halved."""

_WIDER = 4.0
"""Factor by which a bracket that has lost the balance, because something else moved it, is searched
ever wider."""

_MARGINAL = 1e-3
"""Distance from contact or from the height of the menisci, over that height, within which a pixel
is there."""

SMALL = 1e-3
"""Force of the pixels that may not be wet in part, and change of the pressure in a jump, over the
force of the contact, which do not count."""


@dataclass(frozen=True, eq=False)
class End:
    """A force ``posed`` (N) with which the contact was solved, what the menisci pull there (N),
    where the liquid stands, and the contact.

    ``gap`` (nx, ny) in m, ``pressure`` (nx, ny) in Pa.
    """

    posed: float
    pulls: float
    stands: Wetting
    gap: RealArray
    pressure: RealArray

    @property
    def step(self) -> float:
        """What is pulled beyond what was posed (N)."""
        return self.pulls - self.posed


@dataclass(frozen=True, eq=False)
class Bracket:
    """Ends with too little posed (``low``) and too much (``high``), and how wide (N) the bracket
    was in the rounds before.

    ``stride`` is the largest step (N) while one end is not known.
    """

    low: End | None = None
    high: End | None = None
    widths: tuple[float, ...] = ()
    stride: float = math.inf

    def with_end(self, end: End) -> Bracket:
        """The same with one more ``end``; the other one is forgotten where it contradicts."""
        rises = end.step >= 0.0
        low, high = (end, self.high) if rises else (self.low, end)
        if low is None or high is None:
            return replace(self, low=low, high=high)
        if low.posed >= high.posed:
            stride = _WIDER * (self.stride if math.isfinite(self.stride) else self.width)
            lost = Bracket(stride=stride if math.isfinite(stride) and stride > 0.0 else math.inf)
            return replace(lost, low=end) if rises else replace(lost, high=end)
        found = Bracket(low, high, stride=self.stride)
        return replace(found, widths=(*self.widths[-1:], found.width))

    @property
    def width(self) -> float:
        """Length (N) within which the balance lies."""
        return math.inf if self.low is None or self.high is None else self.high.posed - self.low.posed

    def other(self, end: End) -> End | None:
        """The end across from ``end``."""
        return self.high if end is self.low else self.low

    def further(self, end: End, external: float) -> float:
        """Force (N) to pose next after ``end``, at the ``external`` force (N).

        What is pulled at one end, which from below passes no balance where F_m rises; the middle
        where that leads out of the bracket or too slowly on.
        """
        if self.low is None or self.high is None:
            return end.posed + min(max(end.step, -self.stride), self.stride)
        low, high = self.low.posed, self.high.posed
        margin = _INSIDE * self.width
        slow = len(self.widths) > 1 and self.widths[-1] > _SLOW * self.widths[0]
        if not slow and low + margin < end.pulls < high - margin:
            return end.pulls
        ends = external + low, external + high
        if ends[0] > 0.0 and ends[1] > _GEOMETRIC * ends[0]:
            return math.sqrt(ends[0] * ends[1]) - external
        return 0.5 * (low + high)

    def balanced(self, end: End) -> Wetting:
        """Where the liquid stands with the force posed at ``end``: what differs at the end across
        is wet in part."""
        across = self.other(end)
        if across is None or across.pulls == end.pulls:
            return end.stands
        share = min(max(end.step / (end.pulls - across.pulls), 0.0), 1.0)
        return between(end.stands, across.stands, share)


def astray(here: End, there: End, height: float) -> int:
    """Number of pixels wet at one end alone that may not be so in part, for menisci of this
    ``height`` (m).

    A pixel may if it comes into contact or to the height of the menisci itself, rather than with
    its island. Where the pressure jumps too the contact is not that in between, and the pixel has
    to be there at both ends. It is in between where fully yielded points sink at one load.
    """
    touches = here.pressure > 0.0, there.pressure > 0.0
    turns = (touches[0] != touches[1]) | ((here.gap <= height) != (there.gap <= height))
    if float(np.abs(here.pressure - there.pressure).sum()) > SMALL * float(here.pressure.sum()):
        margin = _MARGINAL * height
        closed = (here.gap <= margin) & (there.gap <= margin)
        turns &= closed | ((np.abs(here.gap - height) <= margin) & (np.abs(there.gap - height) <= margin))
    return int(np.count_nonzero((here.stands.menisci != there.stands.menisci) & ~turns))
