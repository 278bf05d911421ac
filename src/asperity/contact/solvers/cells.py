"""Compliance of nested cells: a model of the half-space whose exact inverse on any set of points costs no transform.

The wavelengths of a surface are sorted into octaves: differences between the parts of a cell of side H deflect by the
compliance at q = pi / H (the mean over the Haar functions of the cell, to one percent, for 1/q), so

    B = sum over levels l of c(pi / H_l) (P_l - P_l+1),     P_l: means over the cells of level l,

which is a sum of constants over nested cells. Two hierarchies, shifted against each other by a third of a cell at every
level, hide where the cells meet. On a periodic grid the second is moved round it as a whole, so that its cells reach over
the borders: at 512² this takes the reduction of the residual per step from 0.37 to 0.28 (0.44 to 0.29 at four times the
load). Points on both sides of a border still hang together less in the model than they do, and it gives too large a
deflection to what differs between them; less compliance of each point of its own makes up for that: 0.28 becomes 0.20, and
on films of E 10, h 4 and 20 pixels 0.43 and 0.40 become 0.39 and 0.34 (shares of 0.5 to 0.7 serve as well).
"""

from __future__ import annotations

from typing import Protocol

import numpy as np

from ...core.arrays import RealArray
from ...core.engine import Hierarchy, Merge
from ...core.grid import Grid

_SQUARE = 1.5

OWN_SHARE = 0.6
"""Share of c(pi / a) that a pixel of side a is given of its own."""

OWN_SHARE_BELOW_WAVES = 0.8
"""The same where large cells have their true compliance, which leaves fewer borders."""


class Spectral(Protocol):
    """Compliance, or what is known of it."""

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """Displacement per pressure c(q) in m/Pa at each ``wavenumber`` q > 0 (rad/m)."""


def hierarchies(compliance: Spectral, grid: Grid, *, periodic: bool, share: float) -> tuple[Hierarchy, Hierarchy]:
    """Nested cells on ``grid`` that follow the normal ``compliance``, as square as its pixels allow.

    Single points are given this ``share`` of their compliance.
    """
    merges = merges_of(grid)
    sides, points = octaves(grid, merges)
    detail = np.asarray(compliance.spectral(np.pi / sides), dtype=float)
    weights = np.diff(detail) / points[1:] / (share * detail[0])
    if periodic:
        cells = tuple(Merge(x, y, 0, 0, float(weight)) for (x, y), weight in zip(merges, weights, strict=True))
        return Hierarchy(cells), Hierarchy(cells, (_third(grid.shape[0]), _third(grid.shape[1])))
    first, second = (
        tuple(
            Merge(x, y, int(x and (level + start) % 2 == 0), int(y and (level + start) % 2 == 1), float(weight))
            for level, ((x, y), weight) in enumerate(zip(merges, weights, strict=True))
        )
        for start in (0, 1)
    )
    return Hierarchy(first), Hierarchy(second)


def _third(n: int) -> int:
    """Number of the binary digits ...10101 below ``n``: a third of a cell, or two, of any 2^k points."""
    third = 0
    while 4 * third + 1 < n:
        third = 4 * third + 1
    return third


def pixel_compliance(compliance: Spectral, grid: Grid) -> float:
    """Deflection (m/Pa) of a point of ``grid`` under its own pressure, in the model of nested cells."""
    sides, _ = octaves(grid, merges_of(grid))
    return float(np.asarray(compliance.spectral(np.pi / sides[:1]))[0])


def merges_of(grid: Grid) -> list[tuple[bool, bool]]:
    """Axes along which the cells of each level merge in pairs, until one cell is left."""
    counts, sides = list(grid.shape), list(grid.spacing)
    merges: list[tuple[bool, bool]] = []
    while max(counts) > 1 or not merges:
        x = counts[0] > 1 and (counts[1] == 1 or sides[0] <= _SQUARE * sides[1])
        y = counts[1] > 1 and (counts[0] == 1 or sides[1] <= _SQUARE * sides[0])
        merges.append((x, y))
        for axis, pairs in enumerate((x, y)):
            if pairs:
                counts[axis], sides[axis] = -(-counts[axis] // 2), 2.0 * sides[axis]
    return merges


def octaves(grid: Grid, merges: list[tuple[bool, bool]]) -> tuple[RealArray, RealArray]:
    """Side (m) of the cells of every level along the axes in which they merge, and their number of points."""
    cell, points, sides, numbers = list(grid.spacing), 1.0, [], []
    for x, y in (*merges, merges[-1]):
        merged = [side for side, pairs in zip(cell, (x, y), strict=True) if pairs] or cell
        sides.append(float(np.prod(merged)) ** (1.0 / len(merged)))
        numbers.append(points)
        for axis, pairs in enumerate((x, y)):
            if pairs:
                cell[axis], points = 2.0 * cell[axis], 2.0 * points
    return np.array(sides), np.array(numbers)
