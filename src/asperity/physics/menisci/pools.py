"""Liquid that rises in the islands of a gap: which point each meniscus takes next, and when islands
meet.

Between surfaces at rest the volume of an island is V = ∫ g dA over its points, so that dV = s dA
where its edge stands at the gap s; a hollow behind the edge fills with its own gap. Every island
takes the volume that its feed brings. Islands that meet stay one, of one height: the higher one,
which sucks less, gives what stands above the common height. What a closing gap lifts above
equilibrium goes back to the feed at once.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from ...contact.measure import Labels, labelled
from ...core.arrays import BoolArray, RealArray
from ...core.grid import Grid
from ...theories.wet.feeds import Feed


@dataclass
class Pool:
    """One island: the points it holds, those around it by their gap, its height (m), the volume
    (m³) it has beyond that of its points, the time (s) at which this was so, and its area out of
    contact (m²)."""

    height: float
    time: float
    points: list[int] = field(default_factory=list)
    around: list[tuple[float, int]] = field(default_factory=list)
    spare: float = 0.0
    area: float = 0.0
    stamp: int = 0


class Pools:
    """All islands of liquid in a ``gap`` (nx, ny) in m with the points ``touching``, each fed by
    ``feed``; ``suction`` times the height is γ c in N/m."""

    def __init__(
        self, gap: RealArray, touching: BoolArray, grid: Grid, wraps: tuple[bool, bool], feed: Feed, pull: float
    ) -> None:
        self.gap, self.grid, self.wraps, self.feed, self.pull = gap.ravel().tolist(), grid, wraps, feed, pull
        self.shape, self.touching = gap.shape, touching.ravel().tolist()
        self.owner = [0] * gap.size
        self.pools: dict[int, Pool] = {}
        self.queue: list[tuple[float, int, int]] = []
        self.force = self.area = 0.0
        self._next = 1

    def wet(self, mask: BoolArray, height: float, time: float) -> None:
        """New islands on the points of ``mask`` (nx, ny) that nobody holds, at this ``height`` (m)
        from ``time`` (s) on."""
        free = mask & (np.reshape(self.owner, self.shape) == 0)
        labels, count = labelled(free, wraps=self.wraps)
        for points in _members(labels, count):
            self._add(Pool(height, time), points)

    def _add(self, pool: Pool, points: Sequence[int]) -> None:
        number, self._next = self._next, self._next + 1
        self.pools[number] = pool
        for point in points:
            self._take(number, pool, point)
        self._count(pool, 1.0)
        self._schedule(number, pool)

    def _take(self, number: int, pool: Pool, point: int) -> None:
        self.owner[point] = number
        pool.points.append(point)
        if not self.touching[point]:
            pool.area += self.grid.pixel_area
        for other in self._beside(point):
            if self.owner[other] != number:
                heapq.heappush(pool.around, (self.gap[other], other))

    def _beside(self, point: int) -> Iterator[int]:
        nx, ny = self.shape
        i, j = divmod(point, ny)
        for along, size, wraps, step in ((i, nx, self.wraps[0], ny), (j, ny, self.wraps[1], 1)):
            for to in (along - 1, along + 1):
                if 0 <= to < size:
                    yield point + (to - along) * step
                elif wraps and size > 2:
                    yield point + (to % size - along) * step

    def _count(self, pool: Pool, sign: float) -> None:
        """Add an island to the sums, or take it out."""
        self.area += sign * pool.area
        self.force += sign * pool.area * self.pull / pool.height

    def _schedule(self, number: int, pool: Pool) -> None:
        """When it takes its next point."""
        pool.stamp += 1
        while pool.around and self.owner[pool.around[0][1]] == number:
            heapq.heappop(pool.around)
        if not pool.around:
            return
        gap = pool.around[0][0]
        flow = self.feed.flow(0.5 * (pool.height + max(pool.height, gap)))
        if flow <= 0.0 or max(pool.height, gap) > self.feed.equilibrium_height:
            self._count(pool, -1.0)  # nothing more comes: it stands in equilibrium between two points
            pool.height = max(pool.height, min(gap, self.feed.equilibrium_height))
            self._count(pool, 1.0)
            return
        missing = max(gap * self.grid.pixel_area - pool.spare, 0.0)
        heapq.heappush(self.queue, (pool.time + missing / flow, number, pool.stamp))

    @property
    def following(self) -> float:
        """Time (s) at which the next point is taken; infinite if none is."""
        while self.queue:
            time, number, stamp = self.queue[0]
            if number in self.pools and self.pools[number].stamp == stamp:
                return time
            heapq.heappop(self.queue)
        return math.inf

    def advance(self) -> None:
        """Let the next point be taken, or the next two islands meet."""
        time, number, _ = heapq.heappop(self.queue)
        pool = self.pools[number]
        gap, point = heapq.heappop(pool.around)
        pool.time, pool.spare = time, 0.0
        if self.owner[point]:
            pool.spare = gap * self.grid.pixel_area  # what was to fill the point between them
            self._meet(number, self.owner[point], time)
            return
        self._count(pool, -1.0)
        pool.height = max(pool.height, gap)
        self._take(number, pool, point)
        self._count(pool, 1.0)
        self._schedule(number, pool)

    def _meet(self, one: int, other: int, time: float) -> None:
        """Make one island of two, at the height at which it holds the volume of both."""
        low, high = sorted((one, other), key=lambda each: self.pools[each].height)
        kept, given = self.pools[low], self.pools[high]
        for pool in (kept, given):
            self._count(pool, -1.0)
        kept.spare += given.spare + self._fed(kept if one == high else given, time)
        kept.time = time
        pixel, level = self.grid.pixel_area, kept.height
        above = [point for point in given.points if self.gap[point] > level]
        below = [point for point in given.points if self.gap[point] <= level]
        del self.pools[high]
        for point in above:
            self.owner[point] = 0
            kept.spare += self.gap[point] * pixel
        for point in below:
            self._take(low, kept, point)
        for entry in (*given.around, *((self.gap[point], point) for point in above)):
            heapq.heappush(kept.around, entry)
        self._fill(low, kept)
        self._count(kept, 1.0)
        self._schedule(low, kept)

    def _fed(self, pool: Pool, time: float) -> float:
        """Volume (m³) that came since its last point."""
        return max(self.feed.flow(pool.height), 0.0) * max(time - pool.time, 0.0)

    def _fill(self, number: int, pool: Pool) -> None:
        """Let it take the points for which it has the volume."""
        pixel = self.grid.pixel_area
        while pool.around:
            gap, point = pool.around[0]
            owner = self.owner[point]
            if owner == number:
                heapq.heappop(pool.around)
            elif owner or gap * pixel > pool.spare or gap > self.feed.equilibrium_height:
                return
            else:
                heapq.heappop(pool.around)
                pool.spare -= gap * pixel
                pool.height = max(pool.height, gap)
                self._take(number, pool, point)

    def begun(self, film: float) -> Pools:
        """With islands where the gap is not larger than that of the ``film`` (m), at its height."""
        gap, touching = (np.reshape(values, self.shape) for values in (self.gap, self.touching))
        self.wet((gap <= film) | touching, film, 0.0)
        return self

    def moved(self, gap: RealArray, touching: BoolArray, time: float, film: float) -> Pools:
        """The same volumes in another ``gap`` of the surfaces; points that come into the ``film``
        (m) hold liquid, too."""
        made = Pools(gap, touching, self.grid, self.wraps, self.feed, self.pull)
        pixel = self.grid.pixel_area
        flat = gap.ravel()
        for pool in self.pools.values():
            held = np.asarray(pool.points)
            volume = float(np.asarray(self.gap)[held].sum()) * pixel + pool.spare + self._fed(pool, time)
            order = held[np.argsort(flat[held], kind="stable")]
            filled = np.cumsum(flat[order]) * pixel
            count = max(int(np.searchsorted(filled, volume, side="right")), 1)
            borne = max(int(np.searchsorted(flat[order], self.feed.equilibrium_height, side="right")), 1)
            spare = max(volume - float(filled[count - 1]), 0.0) if count <= borne else 0.0
            count = min(count, borne)  # what stands above equilibrium goes back at once
            height = max(float(flat[order[count - 1]]), film)
            number, fresh = made._next, Pool(height, time, spare=spare)
            made._next += 1
            made.pools[number] = fresh
            for point in order[:count].tolist():
                made._take(number, fresh, point)
        for number, pool in made.pools.items():
            made._fill(number, pool)
            made._count(pool, 1.0)
            made._schedule(number, pool)
        made.wet((gap <= film) | touching, film, time)
        return made

    @property
    def volume(self) -> float:
        """Liquid in m³."""
        points = [point for pool in self.pools.values() for point in pool.points]
        spare = sum(pool.spare for pool in self.pools.values())
        return float(np.asarray(self.gap)[points].sum()) * self.grid.pixel_area + spare

    @property
    def height(self) -> float:
        """Largest height in m."""
        return max((pool.height for pool in self.pools.values()), default=0.0)

    @property
    def held(self) -> BoolArray:
        """(nx, ny), True where liquid stands or the surfaces touch within it."""
        found: BoolArray = np.reshape(self.owner, self.shape) > 0
        return found


def _members(labels: Labels, count: int) -> Iterator[list[int]]:
    """Flat places of each island, by its label from 1."""
    flat = labels.ravel()
    order = np.argsort(flat, kind="stable")
    edges = np.searchsorted(flat[order], np.arange(1, count + 2))
    for low, high in pairwise(edges):
        if high > low:
            yield order[low:high].tolist()
