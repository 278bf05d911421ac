"""Influence coefficients of a body: displacements and stresses by unit pressure on one pixel."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ...core import require
from ...core.grid import Grid
from ...solids.layers import Body
from .compute import stress
from .field import StressField
from .tractions import LoadedBody, ShearTraction, Tractions


def influence_coefficients(body: Body, grid: Grid, depths: Iterable[float], *, shear: bool = False) -> StressField:
    """Influence coefficients C(x, y, z) of ``body``: what a pressure of 1 Pa on one pixel does at
    every point around it.

    The pixel is the one in the middle of the ``grid``, of index (nx // 2, ny // 2). Displacements
    are in m (``displacement.z`` is C of the normal displacement, m/Pa), stresses plain numbers,
    Pa/Pa. A contact with the pressures p then has at the point (x, y, z)

        u_z(x, y, z) = Σ_(ij) C(x - x_i, y - y_j, z) p_(ij).

    Nothing lies outside the loaded pixel: displacements are zero far away. Their transforms along x
    and y are C(ξ, η, z).

    Parameters
    ----------
    body
        ``Elastic`` or ``Layered``.
    grid
        Shape and spacing in m; its spacing is the size of the pixel.
    depths
        Depths in m, >= 0.
    shear
        Whether the pixel carries 1 Pa of shear along +x instead.

    Raises
    ------
    InputError
        If the body is rigid, or a depth negative.

    Sources: Love (1929) and Peng (2001, eqs 3.17-3.26).

    Examples
    --------
    >>> import asperity as asp
    >>> grid = asp.Grid((5, 5), (1e-7, 1e-7))
    >>> C = influence_coefficients(asp.Elastic(200e9, 0.3), grid, [0.0, 1e-7])
    >>> print((1e19 * C.displacement.z[0, 2:, 2]).round(2))
    [5.11 1.5  0.73]
    """
    require.instance(grid, Grid, "grid of influence coefficients", "Write Grid(shape, spacing).")
    one = np.zeros(grid.shape)
    one[grid.shape[0] // 2, grid.shape[1] // 2] = 1.0
    none = np.zeros(grid.shape)
    if shear:
        tractions = Tractions(grid, none, ShearTraction(one, none), boundary="free")
    else:
        tractions = Tractions(grid, one, boundary="free")
    return stress(LoadedBody(body, tractions), depths, displacement=True)
