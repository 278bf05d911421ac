"""Menisci of a solved contact that grow in time: from those of the film at first touch to
equilibrium, with the contact that their force changes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np

from ...contact.controls import Control, Force
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import solve
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError, NoSolutionError
from ...core.quantity import Quantity
from ...core.status import NoProgress, Progress
from ...theories.wet.feeds import Feed
from ...theories.wet.meniscus import wetting_factor
from .film import FLOODED
from .pools import Pools

UPDATED = 0.02
"""Change of the meniscus force over that of the contact after which the contact is solved again."""

SETTLED = 0.99
"""Share of the last force that menisci are said to have settled at."""

_SOLVES = 1000
"""Contacts at most."""

_SHORTER, _SHORTEST = 0.7, 0.1
"""Factor from one step of the load to the next at the same time, and the shortest."""

MOMENTS = 60
"""Times at which is told what there is, where none are given."""

COLUMNS = (
    Quantity("time", "s", "time after contact"),
    Quantity("meniscus_force", "N", "meniscus force"),
    Quantity("meniscus_area_fraction", "1", "area of the menisci / nominal area"),
    Quantity("liquid_volume", "m^3", "volume of the liquid in the menisci"),
    Quantity("height", "m", "largest height of a meniscus"),
    Quantity("n_menisci", "1", "number of menisci"),
    Quantity("area_fraction", "1", "area of the points in contact / nominal area"),
)
"""What growing menisci do in time."""


@dataclass(frozen=True, eq=False, repr=False)
class GrowingMeniscusForce:
    """Menisci on a map in time, all values SI.

    Attributes
    ----------
    time
        (n,) in s after contact.
    meniscus_force, meniscus_area_fraction, liquid_volume, height, n_menisci, area_fraction
        (n,) at those times: the force in N, the share of the nominal area that liquid bridges, the
        volume of the liquid in m³, the largest height in m, the number of menisci, and the share of
        the points in contact.
    external_force
        W in N.
    equilibrium_height
        Height in m at which a meniscus takes no more.
    last
        The contact at the last time.
    held
        (nx, ny), where liquid stands then; the contact within it, too.
    solves
        Number of contacts that were solved.
    imbalance
        Largest force of the menisci less that in the load of the contact, over that load.
    """

    time: RealArray
    meniscus_force: RealArray
    meniscus_area_fraction: RealArray
    liquid_volume: RealArray
    height: RealArray
    n_menisci: RealArray
    area_fraction: RealArray
    external_force: float
    equilibrium_height: float
    last: ContactResult
    held: BoolArray
    solves: int
    imbalance: float
    citation_keys: ClassVar[tuple[str, ...]] = ("BhushanKotwal1998", "TianBhushan1996")

    @property
    def settling(self) -> float:
        """Time in s from which on the force stays within a hundredth of the last one."""
        last = float(self.meniscus_force[-1])
        off = np.flatnonzero(np.abs(self.meniscus_force - last) > (1.0 - SETTLED) * last)
        return float(self.time[off[-1] + 1]) if off.size else float(self.time[0])


@dataclass
class _March:
    """The contact and its liquid at one time."""

    problem: ContactProblem
    feed: Feed
    external: float
    feeds_back: bool
    progress: Progress
    rows: list[tuple[float, ...]] = field(default_factory=list)
    solves: int = 0
    worst: float = 0.0
    tried: float = 0.0
    result: ContactResult | None = None
    posed: float = 0.0
    pools: Pools | None = None

    def begin(self, control: Control) -> None:
        """The contact with the menisci of the film."""
        self.result = solve(self.problem, control)
        self.solves += 1
        found = self.result.require_menisci()
        self.external = found.external_force
        self.posed = found.meniscus_force if self.feeds_back else 0.0
        film, wraps = found.film, self.problem.boundary.wraps
        pull = film.surface_tension * wetting_factor(*film.contact_angles)
        gap, touching = np.asarray(self.result.gap), np.asarray(self.result.contact)
        self.pools = Pools(gap, touching, self.problem.grid, wraps, self.feed, pull).begun(film.thickness)

    def settle(self, time: float) -> None:
        """Solve the contact again until its load has the force of the menisci in it.

        Their force on a map jumps by points, so that steps become shorter; what is missed after the
        last of them is kept.
        """
        assert self.pools is not None
        assert self.result is not None
        film, before, step = self.problem.film, self.pools, 1.0
        assert film is not None
        if abs(before.force - self.tried) <= UPDATED * (self.external + self.posed):
            return
        while self.feeds_back and self.missed > UPDATED and step >= _SHORTEST:
            if self.solves >= _SOLVES:
                raise NoSolutionError(
                    f"growing meniscus force does not come to rest: under {self.external:.4g} N menisci pull with "
                    f"{self.pools.force:.4g} N at {time:.3g} s, after {self.solves} solves. Take a shorter time, or "
                    "the force in the gap of the load alone, {film.feedback=false}."
                )
            self.posed += step * (self.pools.force - self.posed)
            dry = self.problem.with_physics(film=None, friction=None)
            self.result = solve(dry, Force(self.external + self.posed), state=self.result.state)
            self.solves += 1
            step *= _SHORTER
            gap, touching = np.asarray(self.result.gap), np.asarray(self.result.contact)
            self.pools = before.moved(gap, touching, time, film.thickness)
        self.tried = self.pools.force

    @property
    def missed(self) -> float:
        """Force of the menisci less that in the load of the contact, over that load."""
        assert self.pools is not None
        return abs(self.pools.force - self.posed) / (self.external + self.posed) if self.feeds_back else 0.0

    def note(self, time: float) -> None:
        """Keep what there is at this time."""
        assert self.pools is not None
        assert self.result is not None
        pools, area = self.pools, self.problem.grid.area
        self.worst = max(self.worst, self.missed)
        found = (pools.force, pools.area / area, pools.volume, pools.height)
        self.rows.append((time, *found, float(len(pools.pools)), self.result.area_fraction))

    def go(self, time: float) -> None:
        """Let the liquid rise until ``time`` in s."""
        assert self.pools is not None
        while self.pools.following <= time:
            moment = self.pools.following
            self.pools.advance()
            self.settle(moment)

    @property
    def flooded(self) -> bool:
        """Whether liquid or contact fills nearly all of the interface."""
        return self.pools is not None and float(self.pools.held.mean()) >= FLOODED


def growing_menisci(
    problem: ContactProblem,
    control: Control,
    feed: Feed,
    times: Sequence[float] | RealArray | None = None,
    *,
    progress: Progress | None = None,
) -> GrowingMeniscusForce:
    """Menisci of ``problem`` with a film, under a load, as ``feed`` brings them liquid.

    At time zero each island of gaps up to the film thickness is a meniscus as high as the film, and
    the contact carries the load and their force. From then on every island takes the volume that
    its feed brings, s dA = Q dt on the points of the map; islands that meet become one. The contact
    is solved again, at constant volumes, after each change of the force by 2 % of that of the
    contact, unless the film has no ``feedback``: then the gap stays.

    Parameters
    ----------
    problem
        With ``film``; its meniscus height is that of the film at first.
    control
        ``MeanPressure`` or ``Force``.
    feed
        ``FilmFeed``, ``FloodedFeed``, ``VapourFeed``, or an own one.
    times
        Times (n,) in s after contact, >= 0 and rising, at which is told what there is; by default
        60 on a logarithmic scale, from the first point taken to where nothing comes any more or
        liquid fills the interface.
    progress
        Is told the share of the times.

    Raises
    ------
    InputError
        If the problem has no film, the load no external force, or times do not rise.
    NoSolutionError
        If the force does not come to rest.

    Sources: Bhushan, Kotwal & Chilamakuri (1998) for one meniscus; islands after Tian & Bhushan
    (1996).
    """
    film = problem.film
    if film is None:
        raise InputError("problem with growing menisci must have a film, but has none. Give film=LiquidFilm.of(...).")
    first = replace(film, meniscus_height=film.thickness)
    march = _March(problem.with_physics(film=first), feed, 0.0, film.feedback, progress or NoProgress())
    march.begin(control)
    if not march.external > 0.0:
        raise InputError(
            f"external force (N) must be greater than zero for menisci to grow, but is {march.external:.4g}. Prescribe "
            "a load, {load}."
        )
    moments = _default_times(march) if times is None else _checked(times)
    for number, moment in enumerate(moments):
        if march.flooded:
            break
        march.progress.update(number, 1.0 / (1 + number), 1.0 / len(moments))
        march.go(float(moment))
        march.note(float(moment))
    columns = np.array(march.rows).T
    assert march.result is not None
    assert march.pools is not None
    time, force, area, volume, height, count, touching = columns
    return GrowingMeniscusForce(
        time=time,
        meniscus_force=force,
        meniscus_area_fraction=area,
        liquid_volume=volume,
        height=height,
        n_menisci=count,
        area_fraction=touching,
        external_force=march.external,
        equilibrium_height=feed.equilibrium_height,
        last=march.result,
        held=march.pools.held,
        solves=march.solves,
        imbalance=march.worst,
    )


def _checked(times: Sequence[float] | RealArray) -> RealArray:
    found = np.asarray(times, dtype=float)
    rising = (
        found.ndim == 1 and found.size > 0 and bool(np.isfinite(found).all()) and bool((np.diff(found) > 0.0).all())
    )
    if not rising or found[0] < 0.0:
        raise InputError("times (s) of growing menisci must be a rising sequence of numbers from 0 on, but are not.")
    return found


def _default_times(march: _March) -> RealArray:
    """From zero and the first point taken to well beyond the time in which the liquid would rise in
    the gap of the first contact, without feedback."""
    assert march.pools is not None
    begin = end = march.pools.following
    if not math.isfinite(begin):
        return np.array([0.0])
    assert march.result is not None
    gap, touching, film = np.asarray(march.result.gap), np.asarray(march.result.contact), march.problem.film
    assert film is not None
    grid, wraps = march.problem.grid, march.problem.boundary.wraps
    ahead = Pools(gap, touching, grid, wraps, march.feed, march.pools.pull).begun(film.thickness)
    while math.isfinite(ahead.following) and ahead.area < FLOODED * grid.area:
        end = ahead.following
        ahead.advance()
    return np.concatenate([[0.0], np.geomspace(max(begin, 1e-6 * end), 2.0 * end, MOMENTS - 1)])
