"""Plane strain: normal displacement of strips under a shear traction along x, which couples friction to pressure."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray
from ...core.grid import Grid
from ..body import Body, deformable
from ..elastic import Rigid
from ..layers import Layered
from .line_integral import line_integral
from .point_kernel import wavenumber_grid
from .samples import samples


def coupling_strips(grid: Grid, body: Body, counter_body: Body = Rigid()) -> RealArray:
    """Normal displacement (m/Pa), shape (nx, 1), at offsets (0…nx-1) dx from a strip of width dx under unit shear along +x.

    It is that of ``body``, which carries the traction, relative to ``counter_body``, and odd in the offset. A line force Q
    lifts a half-space behind it and lowers it ahead by the same amount at every distance, (1-2ν)/4G times Q (Johnson 1985,
    eq. 2.24); with layers the step changes from that of the top layer to that of the base. No datum is needed.

    Raises
    ------
    InputError
        If both bodies are rigid.
    """
    edges = (np.arange(grid.shape[0]) + 0.5) * grid.spacing[0]
    total = np.zeros(grid.shape[0])
    for solid, sign in deformable(body, counter_body):
        depth = (solid.reduced.thickness if isinstance(solid, Layered) else 0.0) or grid.spacing[0]
        known, alpha = samples(solid, depth), wavenumber_grid(depth)
        near = float(known.high.Lz)
        rest = line_integral(alpha, (known.values.Lz - near) / alpha, depth, cosine=False)
        integral = 0.5 * near * edges + rest(edges)  # of the response from zero, even: the first strip cancels
        total += sign * np.diff(integral, prepend=integral[0])
    return total[:, None]
