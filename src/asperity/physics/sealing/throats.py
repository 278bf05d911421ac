"""Throats of a flow: where most of its pressure is lost, how many pixels they are wide, and what
that leaves open; the closed path of contact where nothing flows.

A throat is a saddle of the gap, g = g_c + x²/2R_x - y²/2R_y with the flow along x. Its conductance
for 12 η = 1 lies between 5/6 and 6/7 of g_c³ √(R_y/R_x): from below without flow across, from above
with a pressure that varies along x only.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import ndimage, sparse
from scipy.sparse import csgraph

from ...core.arrays import BoolArray
from ...theories.sealing.gaps import Bounds
from .flow import GapFlow
from .network import clusters, face_transmissivity, open_cells

CARRIED = 0.5
"""Share of the dissipation in the throats that are looked at."""

RESOLVED = 8
"""Pixels across a throat from which its conductance is resolved to some per cent."""

SMALL = 0.05
"""Share of the pressure that throats of fewer pixels may lose: the rate then errs by less than that
where their conductance is off by two."""

SADDLE = (5.0 / 6.0, 6.0 / 7.0)
"""Conductance of a saddle over g_c³ √(R_y/R_x): without flow across, and with a pressure that
varies along the flow only. ∫(1 - t²)^(5/2) dt · 8/3π = 5/6; 32/35 · 15/16 = 6/7."""

MOST = 12
"""Throats that are kept, those of the largest shares."""

NOISE = 1e-3
"""Gap over the rms gap of the open cells below which it is noise of the contact solver."""


@dataclass(frozen=True)
class Throat:
    """A place where much of the pressure is lost.

    Attributes
    ----------
    x, y
        Its narrowest place in m from the corner of the grid, in the middle of a pixel.
    share
        Of the dissipation.
    pixels
        Width across the flow in pixels.
    gap
        Gap at its crest in m.
    carried
        Flow through it over that through the whole gap.
    correction
        Its resistance by the brackets of a saddle over that of the pixels; NaN where the gap has
        no saddle there.
    """

    x: float
    y: float
    share: float
    pixels: float
    gap: float
    carried: float
    correction: tuple[float, float]

    @property
    def resolved(self) -> bool:
        """Whether it is ``RESOLVED`` pixels wide."""
        return self.pixels >= RESOLVED


@dataclass(frozen=True, eq=False)
class Throats:
    """Throats that carry half of the dissipation, those of the largest shares first.

    Attributes
    ----------
    places
        The throats, ``MOST`` at most.
    count
        Number of all of them.
    cells
        (nx, ny) True in them.
    flow
        The flow.
    """

    places: tuple[Throat, ...]
    count: int
    cells: BoolArray
    flow: GapFlow

    @property
    def pixels(self) -> float:
        """Width of the narrowest in pixels; NaN where there is none."""
        return min((item.pixels for item in self.places), default=float("nan"))

    @property
    def resolved(self) -> bool:
        """Whether those that are not lose little of the pressure."""
        return self.narrow <= SMALL

    @property
    def narrow(self) -> float:
        """Share of the pressure that is lost in throats that are not resolved."""
        return float(sum(item.share for item in self.places if not item.resolved))

    @property
    def refinement(self) -> int:
        """Times as many points along x and y that would resolve the narrowest; 1 where all are."""
        return 1 if self.resolved else int(np.ceil(RESOLVED / max(self.pixels, 1.0)))

    @property
    def bracket(self) -> Bounds:
        """Flow (m³) between those with each unresolved throat replaced by the brackets of its
        saddle; the throats stand for all of the resistance.

        Without unresolved throats of known shape: with the faces taken as harmonic and arithmetic
        means (``GapFlow.face_bounds``).
        """
        known = [item for item in self.places if not item.resolved and np.isfinite(item.correction).all()]
        if not known:
            return self.flow.face_bounds
        weight = sum(item.share for item in self.places)
        low, high = (
            sum(item.share * (item.correction[side] if item in known else 1.0) for item in self.places) / weight
            for side in (0, 1)
        )
        rate = self.flow.rate
        return Bounds(min(rate / high, rate), max(rate / low, rate))


def throats(flow: GapFlow) -> Throats:
    """Throats of a ``flow``; none where it is sealed."""
    spent = flow.dissipated
    total = float(spent.sum())
    if flow.sealed or total <= 0.0:
        return Throats((), 0, np.zeros(spent.shape, bool), flow)
    order = np.argsort(spent, axis=None)[::-1]
    enough = int(np.searchsorted(np.cumsum(spent.ravel()[order]), CARRIED * total)) + 1
    cells = np.zeros(spent.shape, bool)
    cells.ravel()[order[:enough]] = True
    labels, count = _islands(cells, flow.wraps)
    shares = np.bincount(labels.ravel(), spent.ravel(), count + 1)[1:] / total
    largest = np.argsort(shares)[::-1][:MOST]
    places = []
    for number in largest:
        at = np.unravel_index(np.argmax(np.where(labels == number + 1, spent, -1.0)), spent.shape)
        places.append(_throat(flow, (int(at[0]), int(at[1])), float(shares[number])))
    return Throats(tuple(places), count, cells, flow)


def _islands(cells: BoolArray, wraps: tuple[bool, bool]) -> tuple[Any, int]:
    """Labels of groups of cells that touch at faces or corners, and their number."""
    labels, count = ndimage.label(cells, structure=np.ones((3, 3)))
    pairs = [np.zeros((2, 0), int)]
    for axis in (0, 1):
        if wraps[axis]:
            low, high = np.take(labels, 0, axis), np.take(labels, -1, axis)
            for shift in (-1, 0, 1):
                other = np.roll(low, shift)
                there = (high > 0) & (other > 0)
                pairs.append(np.stack([high[there], other[there]]))
    ends = np.concatenate(pairs, axis=1)
    graph = sparse.coo_array((np.ones(ends.shape[1]), (ends[0], ends[1])), shape=(count + 1, count + 1))
    number, joined = csgraph.connected_components(graph.tocsr(), directed=False)
    return joined[labels], number - 1


def _throat(flow: GapFlow, at: tuple[int, int], share: float) -> Throat:
    """The throat whose dissipation is largest in the cell ``at``."""
    passing = [abs(part[at]) + abs(np.roll(part, 1, axis)[at]) for axis, part in enumerate(flow.flux)]
    along = int(np.argmax(passing))
    across = 1 - along
    section = _section(flow, at, across)
    crest, middle = max((float(np.take(flow.gap, at[along], along)[place]), place) for place in section)
    lines = [np.take(flow.flux[along], (at[along] - before) % flow.gap.shape[along], along) for before in (0, 1)]
    through = 0.5 * sum(float(line[section].sum()) for line in lines)
    diagonals = [_run(flow, at, step) for step in ((1, 1), (1, -1))]
    pixels = min(float(len(section)), *(float(np.sqrt(2.0)) * length for length in diagonals))
    centre = list(at)
    centre[across] = middle
    place = (int(centre[0]), int(centre[1]))
    dx, dy = flow.grid.spacing
    return Throat(
        (place[0] + 0.5) * dx,
        (place[1] + 0.5) * dy,
        share,
        pixels,
        crest,
        abs(through) / flow.rate,
        _correction(flow, place, along, len(section), crest),
    )


def _run(flow: GapFlow, at: tuple[int, int], step: tuple[int, int]) -> float:
    """Open cells in a row through the cell ``at``, in ``step`` and against it, between closed ones;
    infinite where the row leaves the grid."""
    length, shape, carrying = 1, flow.gap.shape, flow.net.carrying
    for sign in (1, -1):
        i, j = at
        for _ in range(max(shape)):
            i, j = i + sign * step[0], j + sign * step[1]
            if not all(flow.wraps[axis] or 0 <= place < shape[axis] for axis, place in enumerate((i, j))):
                return float("inf")
            if not carrying[i % shape[0], j % shape[1]]:
                break
            length += 1
    return float(length)


def _section(flow: GapFlow, at: tuple[int, int], across: int) -> list[int]:
    """Places of the open cells of the section across the flow through ``at``."""
    carrying = np.take(flow.net.carrying, at[1 - across], 1 - across)
    count, wraps = carrying.size, flow.wraps[across]
    places = [at[across]]
    for sign in (1, -1):
        for step in range(1, count):
            place = at[across] + sign * step
            if not (wraps or 0 <= place < count) or not carrying[place % count] or place % count in places:
                break
            places.append(place % count)
    return places


def _correction(flow: GapFlow, at: tuple[int, int], along: int, run: int, crest: float) -> tuple[float, float]:
    """Resistance of the saddle at ``at`` over that of its pixels, between the widths and crests
    that the pixels allow: the edges of the contact lie between their last open and first closed
    centre, and the crest up to half a pixel beside the middle of a pixel."""
    spacing, shape = flow.grid.spacing, flow.gap.shape
    step, width = spacing[along], spacing[1 - along]
    beside = []
    for sign in (1, -1):
        place = list(at)
        place[along] += sign
        if not (flow.wraps[along] or 0 <= place[along] < shape[along]):
            return float("nan"), float("nan")
        lines = []
        for shift in (-1, 0, 1):
            side = place.copy()
            side[1 - along] += shift
            lines.append(flow.gap[side[0] % shape[0], side[1] % shape[1]])
        beside.append(max(lines))
    bend = (beside[0] + beside[1] - 2.0 * crest) / step**2
    if bend <= 0.0 or run >= shape[1 - along]:
        return float("nan"), float("nan")
    radius = 1.0 / bend

    def resistance(half: float, top: float, factor: float) -> float:
        return float(np.sqrt(radius * 2.0 * top / half**2) / (factor * top**3))

    pixels = _pixel_resistance(crest, radius, 0.5 * run * width, (step, width))
    wide, narrow = 0.5 * (run + 1) * width, 0.5 * max(run - 1.0, 0.5) * width
    higher = crest / (1.0 - (0.5 * width / wide) ** 2)
    low, high = resistance(wide, higher, SADDLE[1]), resistance(narrow, crest, SADDLE[0])
    return low / pixels, high / pixels


def _pixel_resistance(crest: float, radius: float, half: float, spacing: tuple[float, float]) -> float:
    """Resistance of a saddle on pixels, as their network has it where the pressure varies along the
    flow only: its section closes at the distance ``half`` from the crest."""
    step, width = spacing
    far = int(np.ceil(6.0 * np.sqrt(2.0 * radius * crest) / step)) + 2
    x = np.arange(-far, far + 1) * step
    bend = 2.0 * crest / half**2
    most = int(np.ceil(np.sqrt(2.0 * (crest + x[-1] ** 2 / (2.0 * radius)) / bend) / width)) + 1
    y = (np.arange(-most, most + 1)) * width
    gap = np.maximum(crest + x[:, None] ** 2 / (2.0 * radius) - 0.5 * bend * y[None] ** 2, 0.0)
    passing = face_transmissivity(gap[:-1], gap[1:]).sum(axis=1) * width / step
    return float((1.0 / passing).sum())


# Where nothing flows.


def closed_path(flow: GapFlow) -> Any:
    """(k, 2) cells of a shortest path of closed cells, joined at faces or corners, that leads
    across the direction of the flow and closes it; empty where fluid flows.

    On a grid that repeats across the flow the path comes back to the cell where it started, beyond
    the seam.
    """
    axis = flow.axis
    closed = ~open_cells(flow.gap) if flow.gap.any() else np.ones(flow.gap.shape, bool)
    closed = closed if axis == 0 else closed.T  # [along, across]
    if not flow.sealed:
        return np.zeros((0, 2), int)
    around = flow.wraps[1 - axis]
    path = _around(closed, flow.wraps[axis] and flow.repeats) if around else _from_side_to_side(closed)
    return path if axis == 0 else path[:, ::-1]


def _graph(closed: BoolArray, wraps: bool) -> Any:
    """Graph of the ``closed`` cells [along, across], joined at faces and corners, with the lengths
    of their steps; it ``wraps`` along the first axis."""
    shape = closed.shape
    index = np.arange(closed.size).reshape(shape)
    first, second, size = [], [], []
    padded, numbers = closed, index
    for di, dj in ((1, 0), (0, 1), (1, 1), (-1, 1)):
        other, number = np.roll(padded, (-di, -dj), (0, 1)), np.roll(numbers, (-di, -dj), (0, 1))
        there = padded & other
        if dj:
            there[:, -1] = False
        if di and not wraps:
            there[-1 if di == 1 else 0] = False
        first.append(numbers[there])
        second.append(number[there])
        size.append(np.full(int(there.sum()), np.hypot(di, dj)))
    place = np.concatenate(first), np.concatenate(second)
    return sparse.coo_array((np.concatenate(size), place), shape=(closed.size, closed.size)).tocsr()


def _back(before: Any, end: int, start: int, columns: int) -> Any:
    """(k, 2) cells from ``start`` to ``end`` by the ``before`` of each."""
    path = [end]
    while path[-1] != start and before[path[-1]] >= 0:
        path.append(int(before[path[-1]]))
    return np.stack(np.divmod(np.array(path[::-1]), columns), axis=1)


def _from_side_to_side(closed: BoolArray) -> Any:
    columns = closed.shape[1]
    starts = np.flatnonzero(closed[:, 0]) * columns
    ends = np.flatnonzero(closed[:, -1]) * columns + columns - 1
    if not starts.size or not ends.size:
        return np.zeros((0, 2), int)
    length, before, source = csgraph.dijkstra(
        _graph(closed, False), directed=False, indices=starts, return_predecessors=True, min_only=True
    )
    end = int(ends[np.argmin(length[ends])])
    return _back(before, end, int(source[end]), columns)


TRIED = 24
"""Runs of closed cells at the seam from which a path around the grid is looked for."""


def _around(closed: BoolArray, wraps: bool) -> Any:
    """Path that leads once around the second axis and back to its start."""
    columns = closed.shape[1]
    tiled = np.concatenate([closed, closed[:, :1]], axis=1)
    graph = _graph(tiled, wraps)
    starts = np.flatnonzero(closed[:, 0])
    heads = [run[run.size // 2] for run in np.split(starts, np.flatnonzero(np.diff(starts) > 1) + 1) if run.size]
    best, shortest = np.zeros((0, 2), int), np.inf
    for row in heads[:TRIED]:
        start = int(row) * (columns + 1)
        length, before = csgraph.dijkstra(
            graph, directed=False, indices=start, return_predecessors=True, limit=shortest
        )
        end = start + columns
        if length[end] < shortest:
            shortest, best = length[end], _back(before, end, start, columns + 1)[:-1] % (closed.shape[0], columns)
    return best


def through_corners(flow: GapFlow) -> bool:
    """Whether a ``flow`` that is sealed would pass if cells were joined at their corners, too."""
    if not flow.sealed:
        return False
    across = flow.wraps[0] and flow.axis == 1, flow.wraps[1] and flow.axis == 0
    labels, _ = _islands(open_cells(flow.gap), across)
    low, high = np.take(labels, 0, flow.axis), np.take(labels, -1, flow.axis)
    return bool(np.intersect1d(low[low > 0], high[high > 0]).size)


def through_noise(flow: GapFlow) -> bool:
    """Whether a ``flow`` passes only where the gap is below ``NOISE`` times the rms of the open
    ones."""
    if flow.sealed:
        return False
    opened = open_cells(flow.gap)
    wide = flow.gap > NOISE * np.sqrt(np.mean(flow.gap[opened] ** 2))
    found = clusters(wide, flow.wraps)
    through = found.winds if flow.repeats else found.spans
    return not bool(through[flow.axis].any())
