"""True compliance of the larger cells of the preconditioner, where constants over nested cells are too crude.

Where the compliance falls much more steeply than 1/q, as that of a bending film does (up to q^-4), the smooth deflection
under a smooth load is badly given by constants over cells. It is cheap to have it from a convolution on a coarse grid:

    B = sum over levels l < n of c(pi / H_l) (P_l - P_l+1) + K_n,

with K_n the compliance itself for pressures constant on the cells of level n, of 8 x 8 points. Reduction of the residual
per step at 512², self-affine surface, a tenth in contact, without and with: films of E 10, h 4 and 20 pixels 0.39 and 0.36,
0.34 and 0.27; E 2, h 4 pixels 0.25 and 0.27; half-space 0.20 and 0.23. Pairs of a whole solve at 1024², a sixth and a tenth
in contact: the first film 36 and 33, the second 22 and 18; none are saved where a fortieth is. A step costs 6 % more.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.engine import CellWaves
from ...core.grid import Grid
from ..operators import prepare_operator
from ..operators.protocol import Operator
from .cells import merges_of, octaves

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
