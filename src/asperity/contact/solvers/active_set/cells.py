"""Compliance of nested cells: a model of the half-space whose exact inverse on any set of points costs no transform.

The wavelengths of a surface are sorted into octaves: differences between the parts of a cell of side H deflect by the
compliance at q = pi / H (the mean over the Haar functions of the cell, to one percent, for 1/q), so

    B = sum over levels l of c(pi / H_l) (P_l - P_l+1),     P_l: means over the cells of level l,

which is a sum of constants over nested cells. Two hierarchies, shifted against each other by a third of a cell at every
level, hide the borders between cells. On a periodic grid the second is rolled round it as a whole, so that its cells reach
over the borders of the grid: at 512² this takes the reduction of the residual per step from 0.37 to 0.28 (0.44 to 0.29 at
four times the load).
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np

from ....core.arrays import RealArray
from ....core.engine import CoarseCompliance, Hierarchy, Merge
from ....core.grid import Grid
from ...operators import Operator, prepare_operator

_SQUARE = 1.5
"""Ratio of sides up to which cells merge along both axes; beyond, only along the shorter side, so that ratios stay below 2.
It does not matter for square pixels."""

PIXEL_SHARE = 0.6
"""Share of c(pi / a) that a pixel of side a is given of its own in the model.

Points on both sides of a border between cells are coupled less in the model than in truth, so that it deflects too much by
what differs between them; a smaller compliance of each point of its own compensates. At 512² the residual falls by 0.20
instead of 0.28 a step, on films of E 10, h 4 and 20 pixels by 0.39 and 0.34 instead of 0.43 and 0.40. Pairs (cases: see
``solver``) for 0.4, 0.5, 0.7, 0.8, 1: elastic 15.1, 14.7, 14.9, 14.7, 16.7; free 44.5, 44.5, 43.8, 46.4, 44.2; cap 21.6, 20.0,
19.6, 19.0, 18.4; tight 25.2, 23.4, 25.2, 24.7, 25.7.
"""

PIXEL_SHARE_COARSE = 0.8
"""The same with the coarse correction, which leaves fewer borders. Pairs on films for 0.6, 0.7, 1: 22.2, 22.5, 23.0."""


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


# Coarse correction: the true compliance of the larger cells, where constants over nested cells are too crude.
#
# Where the compliance falls much more steeply than 1/q, as that of a bending film does (up to q^-4), the smooth deflection
# under a smooth load is poorly represented by constants over cells. A convolution on a coarse grid has it cheaply:
#
# B = sum over levels l < n of c(pi / H_l) (P_l - P_l+1) + K_n,
#
# with K_n the compliance itself for pressures constant on the cells of level n, of 8 x 8 points. Reduction of the residual
# per step at 512², self-affine surface, a tenth in contact, without and with: films of E 10, h 4 and 20 pixels 0.39 and 0.36,
# 0.34 and 0.27; E 2, h 4 pixels 0.25 and 0.27; half-space 0.20 and 0.23. Pairs of a whole solve at 1024², a sixth and a tenth
# in contact: the first film 36 and 33, the second 22 and 18; none are saved where a fortieth is. A step costs 6 % more.


_DEPTH = 3
"""Level of the corrected cells, of 8 x 8 points: a product on their grid costs 1/64 of an FFT pair. Pairs on films for 2, 4: 25.6,
22.2 (3: 22.8)."""

_STEEP = 3.0
"""Factor by which the compliance must fall over an octave for the correction to pay (1/q: 2). On a half-space it costs
pairs: with the threshold below 2 the means at 512² are 15.9 for 13.9, free at 256² 49.8 for 43.8."""

_FEWEST = 4
"""Corrected cells along a side at least: smaller grids cost little either way."""

_PRODUCTS = 4
"""Products with the coarse compliance per use: two for each hierarchy."""


class CoarseCorrection(NamedTuple):
    """True compliance of large cells in the ``form`` an engine takes, and the FFT ``pairs`` of the fine grid for one use."""

    form: CoarseCompliance
    pairs: float


def coarse_correction(operator: Operator) -> CoarseCorrection | None:
    """True compliance of ``operator`` on cells of 8 x 8 points.

    None where it does not fall to a third over any octave beyond them, where pixels are too oblong, and where the grid is
    too small, a line, or periodic with sides that are no multiples of such cells.
    """
    grid, periodic, side = operator.grid, all(operator.boundary.wraps), 1 << _DEPTH
    merges = merges_of(grid)
    if min(grid.shape) < _FEWEST * side or not all(x and y for x, y in merges[:_DEPTH]):
        return None
    if periodic and any(n % side for n in grid.shape):
        return None
    sides, points = octaves(grid, merges)
    detail = operator.octaves.spectral(np.pi / sides)
    if np.max(detail[_DEPTH:] / detail[_DEPTH - 1 : -1]) < _STEEP:
        return None
    # on a free grid the first cell may begin up to side - 1 points outside
    nx, ny = (n // side if periodic else -(-(n + side - 1) // side) for n in grid.shape)
    coarse = Grid((nx, ny), (side * grid.spacing[0], side * grid.spacing[1]))
    of_cells = prepare_operator(operator.compliance, coarse, operator.boundary, engine=operator.engine)
    # over c(pi / a) of a whole pixel; over PIXEL_SHARE_COARSE of it, as the weights are, films take 22.2 pairs for 22.8
    kernel = np.maximum(of_cells.kernel - detail[_DEPTH - 1], 0.0) / (detail[0] * points[_DEPTH])
    pairs = _PRODUCTS * of_cells.pairs_per_application * coarse.n_points / grid.n_points
    return CoarseCorrection(CoarseCompliance(_DEPTH, kernel, coarse.shape, of_cells.padded), pairs)
