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

from dataclasses import dataclass, replace
from typing import Protocol, Self

import numpy as np

from ....core.arrays import RealArray
from ....core.engine import CellWaves, Hierarchy, Merge
from ....core.grid import Grid
from ...operators import prepare_operator
from ...operators.convolution import restricted
from ...operators.protocol import Operator
from ..protocol import ContactQP, FixedMean, Solver, feasible_start, run

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


# True compliance of the larger cells of the preconditioner, where constants over nested cells are too crude.
#
# Where the compliance falls much more steeply than 1/q, as that of a bending film does (up to q^-4), the smooth deflection
# under a smooth load is badly given by constants over cells. It is cheap to have it from a convolution on a coarse grid:
#
# B = sum over levels l < n of c(pi / H_l) (P_l - P_l+1) + K_n,
#
# with K_n the compliance itself for pressures constant on the cells of level n, of 8 x 8 points. Reduction of the residual
# per step at 512², self-affine surface, a tenth in contact, without and with: films of E 10, h 4 and 20 pixels 0.39 and 0.36,
# 0.34 and 0.27; E 2, h 4 pixels 0.25 and 0.27; half-space 0.20 and 0.23. Pairs of a whole solve at 1024², a sixth and a tenth
# in contact: the first film 36 and 33, the second 22 and 18; none are saved where a fortieth is. A step costs 6 % more.


_DEPTH = 3
_STEEP = 3.0
_FEWEST = 4
_PRODUCTS = 4


@dataclass(frozen=True, eq=False)
class Waves:
    """Compliance of cells in the ``form`` an engine takes, and the FFT ``pairs`` of the fine grid for one use of it."""

    form: CellWaves
    pairs: float


def waves_of(operator: Operator) -> Waves | None:
    """Compliance of ``operator`` on cells of 8 x 8 points.

    None where it does not fall to a third over any octave beyond them, where pixels are too oblong, and where the grid is
    too small, a line, or periodic with sides that such cells do not divide.
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
    nx, ny = (n // side if periodic else -(-(n + side - 1) // side) for n in grid.shape)  # the cells may lie anywhere
    coarse = Grid((nx, ny), (side * grid.spacing[0], side * grid.spacing[1]))
    of_cells = prepare_operator(operator.compliance, coarse, operator.boundary, engine=operator.engine)
    kernel = np.maximum(of_cells.kernel - detail[_DEPTH - 1], 0.0) / (detail[0] * points[_DEPTH])
    pairs = _PRODUCTS * of_cells.pairs_per_application * coarse.n_points / grid.n_points
    return Waves(CellWaves(_DEPTH, kernel, coarse.shape, of_cells.padded), pairs)


# First guesses from coarser grids.


COARSEST = 64
"""Points per side at which there is no coarser grid."""

_TOLERANCE = 0.1
_LOOSEST = 0.03
_FINE_STIFFNESS = 0.15


class Adjustable(Solver, Protocol):
    """Solver whose tolerance can be set."""

    def loosened(self, tolerance: float) -> Self:
        """Same solver for a first guess: with ``tolerance``."""


def coarsened(qp: ContactQP) -> ContactQP:
    """Same problem on half as many points per side."""
    profile = restricted(qp.profile)
    cap = restricted(qp.cap) if isinstance(qp.cap, np.ndarray) else qp.cap
    scale = float(profile.std()) or qp.height_scale
    return replace(qp, operator=qp.operator.coarsened, profile=profile, cap=cap, height_scale=scale)


def nested_start(qp: ContactQP, solver: Adjustable) -> tuple[RealArray, float]:
    """Feasible pressure (Pa) prolonged from the solution of ``solver`` on the coarser grid, and its FFT pairs.

    The coarse problem is solved to a fraction of the roughness that its grid cannot show. Its pressures are constant on
    2 x 2 points; what is higher there carries more: ``_FINE_STIFFNESS`` of what alternating pixels would (the
    roughness of a resolved surface is longer), which saves a tenth of the pairs at 1024² and a quarter at 2048².

    Pairs are counted in pairs of the grid of ``qp``: those of half as many points per side count a quarter.
    """
    if min(qp.profile.shape) <= COARSEST:
        return feasible_start(qp, None), 0.0
    coarse = coarsened(qp)
    hidden = np.sqrt(max(0.0, 1.0 - (coarse.height_scale / qp.height_scale) ** 2))
    tolerance = max(min(_TOLERANCE * float(hidden), _LOOSEST), solver.tolerance)
    state = run(solver.loosened(tolerance), coarse).state
    pairs = state.applications * coarse.operator.pairs_per_application + state.extra_pairs
    share = coarse.profile.size / qp.profile.size
    stiffness = _FINE_STIFFNESS / pixel_compliance(qp.operator.octaves, qp.operator.grid)
    start = qp.operator.engine.refined(state.pressure, coarse.profile, qp.profile, stiffness)
    if not (qp.elastic and isinstance(qp.constraint, FixedMean) and start.any()):
        return feasible_start(qp, start), pairs * share
    start *= qp.constraint.mean_pressure / start.mean()
    return start, pairs * share
