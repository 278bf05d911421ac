"""The open cells of a gap as a network: which of them carry flow, and how well their faces let it
through.

Cells are joined through their four faces (4-connected), so that the solid is 8-connected: where two
spots of contact meet at a corner, nothing passes between them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse
from scipy.sparse import csgraph

from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError

Labels: TypeAlias = NDArray[np.integer]
"""Numbers of clusters, 0 where a cell is closed."""

FLOOR = 1e-6
"""Gap over the largest gap below which a cell counts as closed: its conductance, with the cube of
the gap, is below the rounding of the others."""


def face_transmissivity(first: RealArray, second: RealArray) -> RealArray:
    """Transmissivity (m³) between the centres of two cells of these gaps (m): zero at a closed one.

    T = 2 g1² g2² / (g1 + g2), exact for a gap that changes linearly between the centres.
    """
    total = first + second
    there = (first > 0.0) & (second > 0.0)
    return np.divide(2.0 * (first * second) ** 2, total, out=np.zeros_like(total), where=there)


def face_slip(first: RealArray, second: RealArray) -> RealArray:
    """The same for a conductance that goes with the square of the gap (m²), as slip at the walls
    has it: g1 g2."""
    return first * second


def harmonic(first: RealArray, second: RealArray) -> RealArray:
    """Harmonic mean of the cubes (m³), that of two cells of constant gap: below the exact value."""
    cubes = first**3, second**3
    total = cubes[0] + cubes[1]
    there = (first > 0.0) & (second > 0.0)
    return np.divide(2.0 * cubes[0] * cubes[1], total, out=np.zeros_like(total), where=there)


def arithmetic(first: RealArray, second: RealArray) -> RealArray:
    """Arithmetic mean of the cubes (m³), above the exact value; zero at a closed cell."""
    there = (first > 0.0) & (second > 0.0)
    return np.where(there, 0.5 * (first**3 + second**3), 0.0)


@dataclass(frozen=True, eq=False)
class Clusters:
    """Clusters of open cells.

    Attributes
    ----------
    labels
        (nx, ny) number of the cluster of each cell from 1, 0 where it is closed.
    winds
        (2, n + 1) whether cluster n goes around the grid along x and y, where that wraps.
    spans
        (2, n + 1) whether cluster n touches both sides of the grid along x and y.
    """

    labels: Labels
    winds: BoolArray
    spans: BoolArray


def clusters(opened: BoolArray, wraps: tuple[bool, bool]) -> Clusters:
    """Clusters of the ``opened`` cells (nx, ny) on a grid that ``wraps`` along x and y.

    A cluster winds along x if a closed path through it leads once or more around the grid along x:
    the pieces of the cluster within the grid are joined across the seams, each with the number of
    turns that lead to it, and a seam that leads back with another number closes such a path.
    """
    pieces, count = ndimage.label(opened)
    first, second, turns = [], [], []
    for axis in (0, 1):
        if wraps[axis] and opened.shape[axis] > 1:
            low, high = np.take(pieces, 0, axis), np.take(pieces, -1, axis)
            there = (low > 0) & (high > 0)
            pairs = np.unique(np.stack([high[there], low[there]]), axis=1)
            first.append(pairs[0])
            second.append(pairs[1])
            turns.append(np.tile(np.eye(2, dtype=int)[:, axis : axis + 1], pairs.shape[1]))
    ends = np.concatenate([*first, np.zeros(0, int)]), np.concatenate([*second, np.zeros(0, int)])
    graph = sparse.coo_matrix((np.ones(ends[0].size), ends), shape=(count + 1, count + 1)).tocsr()
    number, joined = csgraph.connected_components(graph, directed=False)
    winds = np.zeros((2, number), bool)
    if ends[0].size:
        at = _turns(graph, ends, np.concatenate(turns, axis=1), joined)
        extra = at[:, ends[0]] + np.concatenate(turns, axis=1) - at[:, ends[1]]
        for axis in (0, 1):
            winds[axis, joined[ends[0][extra[axis] != 0]]] = True
    for axis in (0, 1):
        winds[axis] |= wraps[axis] and opened.shape[axis] == 1
    labels = joined[pieces]  # the closed cells are piece 0, which is joined to nothing and counted first
    spans = np.zeros_like(winds)
    for axis in (0, 1):
        both = np.intersect1d(np.take(labels, 0, axis), np.take(labels, -1, axis))
        spans[axis, both] = True
    spans[:, 0] = winds[:, 0] = False
    return Clusters(labels, winds, spans)


def _turns(graph: sparse.csr_matrix, ends: tuple[Labels, Labels], turns: Labels, joined: Labels) -> Labels:
    """(2, pieces) turns around the grid at which each piece is reached from the first of its
    cluster."""
    at = np.zeros((2, graph.shape[0]), int)
    known: dict[tuple[int, int], Labels] = {}
    for start, end, turn in zip(*ends, turns.T, strict=True):
        known.setdefault((int(start), int(end)), turn)
        known.setdefault((int(end), int(start)), -turn)
    touched = np.unique(np.concatenate(ends))
    _, heads = np.unique(joined[touched], return_index=True)
    for head in touched[heads]:
        order, before = csgraph.breadth_first_order(graph, int(head), directed=False)
        for piece in order[1:]:
            parent = int(before[piece])
            at[:, piece] = at[:, parent] + known[parent, int(piece)]
    return at


@dataclass(frozen=True, eq=False)
class Network:
    """Open cells that carry flow, and the conductances of their faces.

    Attributes
    ----------
    carrying
        (nx, ny) True where a cell is open and its cluster leads from one end to the other.
    across
        (2, nx, ny) conductance of the faces to the next cell along x and along y, zero where there
        is none. Flow over difference of pressure, without 12 η.
    ends
        (2, nx, ny) conductance from a cell to the sides of higher and lower pressure; zero for a
        mean gradient.
    drop
        (2, nx, ny) or (2, 1, 1) difference of pressure that is applied along each face beside that
        between the cells: 1/n of a mean gradient along x with one unit on its n faces.
    """

    carrying: BoolArray
    across: RealArray
    ends: RealArray
    drop: RealArray

    def flux(self, pressure: RealArray) -> RealArray:
        """(2, nx, ny) flow through the faces to the next cells under this ``pressure`` (nx, ny)."""
        return self.across * (self.drop + self.differences(pressure))

    @staticmethod
    def differences(pressure: RealArray) -> RealArray:
        """(2, nx, ny) pressure of each cell less that of the next along x and y."""
        return np.stack([pressure - np.roll(pressure, -1, axis) for axis in (0, 1)])

    def inflow(self, pressure: RealArray) -> RealArray:
        """(2, nx, ny) flow from the sides of higher and of lower pressure into each cell."""
        return self.ends * np.stack([1.0 - pressure, -pressure])

    def imbalance(self, pressure: RealArray) -> RealArray:
        """(nx, ny) what flows into each cell less what flows out."""
        return self.gathered(self.flux(pressure), self.inflow(pressure))

    @staticmethod
    def gathered(flux: RealArray, inflow: RealArray) -> RealArray:
        """(nx, ny) what a ``flux`` (2, nx, ny) through faces and an ``inflow`` bring into each
        cell."""
        out = sum(part - np.roll(part, 1, axis) for axis, part in enumerate(flux))
        return np.asarray(inflow.sum(axis=0) - out)

    def along(self, axis: int) -> Network:
        """The same under one unit of pressure per period along ``axis``, as a mean gradient."""
        drop = np.zeros((2, 1, 1))
        drop[axis] = 1.0 / self.carrying.shape[axis]
        return replace(self, drop=drop)


def network(
    gap: RealArray,
    spacing: tuple[float, float],
    wraps: tuple[bool, bool],
    *,
    axis: int | None = None,
    faces: str = "exact",
) -> Network:
    """The network of a ``gap`` (nx, ny) in m, zero in contact.

    Parameters
    ----------
    gap
        Distance of the surfaces in m, >= 0.
    spacing
        Size of the cells in m.
    wraps
        Whether the grid repeats along x and y.
    axis
        That along which fluid flows from one side of the grid to the other, at whose ends the cells
        are half a cell from the sides; None for a mean gradient on a grid that repeats.
    faces
        ``"exact"``; ``"slip"`` for conductances with the square of the gap; ``"harmonic"`` and
        ``"arithmetic"``, which are below and above the exact ones.

    Raises
    ------
    InputError
        If the gap is not a map of finite numbers >= 0.
    """
    rule = {"exact": face_transmissivity, "slip": face_slip, "harmonic": harmonic, "arithmetic": arithmetic}
    require.one_of(faces, tuple(rule), "kind of faces")
    gap = checked_gap(gap)
    if axis is not None:
        wraps = (wraps[0] and axis != 0, wraps[1] and axis != 1)
    carrying = carrying_cells(gap, wraps, axis)
    inside = np.where(carrying, gap, 0.0)
    across = np.zeros((2, *gap.shape))
    for along in (0, 1):
        if gap.shape[along] == 1 and not (axis is None and wraps[along]):
            continue
        width = spacing[1 - along] / spacing[along]
        across[along] = width * rule[faces](inside, np.roll(inside, -1, along))
        if not wraps[along]:
            across[along][(slice(None),) * along + (-1,)] = 0.0
    ends = np.zeros((2, *gap.shape))
    if axis is not None:
        power = 2 if faces == "slip" else 3
        half = 2.0 * spacing[1 - axis] / spacing[axis] * inside**power
        for side, at in ((0, 0), (1, -1)):
            place = (slice(None),) * axis + (at,)
            ends[side][place] = half[place]
    return Network(carrying, across, ends, np.zeros((2, 1, 1)))


def checked_gap(gap: RealArray) -> RealArray:
    """``gap`` (nx, ny) in m as float64.

    Raises
    ------
    InputError
        If it is not a map of finite numbers >= 0.
    """
    values = np.asarray(gap, dtype=np.float64)
    if values.ndim != 2 or not values.size or not np.isfinite(values).all() or values.min() < 0.0:
        raise InputError(
            f"gap must be an array (nx, ny) of finite numbers >= 0 in m, but has the shape {values.shape} and "
            f"numbers from {np.min(values, initial=np.inf):.3g} to {np.max(values, initial=-np.inf):.3g}."
        )
    return values


def open_cells(gap: RealArray) -> BoolArray:
    """(nx, ny) True where fluid is: above ``FLOOR`` times the largest gap."""
    return np.asarray(gap > FLOOR * gap.max())


def carrying_cells(
    gap: RealArray, wraps: tuple[bool, bool], axis: int | None, *, along: int | None = None
) -> BoolArray:
    """(nx, ny) True in open clusters that lead from one side to the other along ``axis``, or around
    the grid where it is None; then ``along`` one axis, if it is given."""
    found = clusters(open_cells(gap), wraps)
    if axis is not None:
        return np.asarray(found.spans[axis][found.labels])
    through: BoolArray = np.asarray(found.winds.any(axis=0)) if along is None else found.winds[along]
    return np.asarray(through[found.labels])
