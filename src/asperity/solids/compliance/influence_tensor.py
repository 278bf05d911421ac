"""Full surface compliance of pixels under uniform traction, without periodicity."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ..body import Body, deformable
from ..elastic import Elastic, Rigid
from ..layers import Layered
from .patch_average import COS_1, COS_2, ISOTROPIC, SIN_1, SIN_2, patch_coefficients
from .samples import Samples, samples


@dataclass(frozen=True, eq=False)
class InfluenceTensor:
    """Displacement (m/Pa) at pixel offsets (0…nx-1, 0…ny-1) from a pixel under unit traction, arrays (nx, ny).

    ``xx``, ``yy`` and ``zz`` are even in both offsets, ``xy`` is odd in both; ``xz``, u_x under unit pressure, is odd in x
    and even in y, ``yz`` even in x and odd in y. Reciprocity gives the rest: yx = xy, zx = -xz, zy = -yz.
    """

    xx: RealArray
    yy: RealArray
    zz: RealArray
    xy: RealArray
    xz: RealArray
    yz: RealArray


def influence_tensor(grid: Grid, body: Body, counter_body: Body = Rigid()) -> InfluenceTensor:
    """Displacement of ``body`` relative to ``counter_body`` at every offset on ``grid`` from a loaded pixel.

    Tractions act on ``body``. Compliances of the two add up; their coupling between normal and tangential directions
    subtracts. The relative error is below 1e-8, as for ``patch_coefficients``.

    Raises
    ------
    InputError
        If both bodies are rigid, or a layer may slip: its displacement under a tangential force has no limit.
    """
    total: dict[str, RealArray] = {}
    for solid, _ in deformable(body, counter_body):
        for name, values in _components(grid, solid).items():
            total[name] = total.get(name, 0.0) + values
    xz, yz = coupling_influence(grid, body, counter_body)
    return InfluenceTensor(**total, xz=xz, yz=yz)


def coupling_influence(grid: Grid, body: Body, counter_body: Body = Rigid()) -> tuple[RealArray, RealArray]:
    """``xz`` and ``yz`` of ``influence_tensor`` alone, which layers that may slip have, too."""
    total = [np.zeros(grid.shape), np.zeros(grid.shape)]
    for solid, sign in deformable(body, counter_body):
        kernel = _samples(grid, solid).kernel(lambda c: c.Lz, order=1)
        for found, angular in zip(total, (COS_1, SIN_1), strict=True):
            found -= sign * patch_coefficients(kernel, grid, angular)
    return total[0], total[1]


def _samples(grid: Grid, body: Elastic | Layered) -> Samples:
    depth = body.reduced.thickness if isinstance(body, Layered) else 0.0
    return samples(body, depth or max(grid.spacing))


def _components(grid: Grid, body: Elastic | Layered) -> dict[str, RealArray]:
    """From the spectrum: C_xx = (LL + T)/2 + cos 2phi (LL - T)/2, C_xy = sin 2phi (LL - T)/2; C_xz = i cos phi Lz elsewhere.

    A factor cos(m phi) or sin(m phi) becomes i^m cos(m theta) or i^m sin(m theta) and J_m.
    """
    if isinstance(body, Layered) and body.reduced.slips:
        raise InputError(
            "layers under a tangential traction must be bonded on the free boundary, but one is Frictionless(): "
            "it would slip without end. Use Bonded() or the periodic boundary."
        )
    known = _samples(grid, body)
    mean = patch_coefficients(known.kernel(lambda c: 0.5 * (c.LL + c.T)), grid)
    bending = known.kernel(lambda c: 0.5 * (c.LL - c.T), order=2)
    along_x = patch_coefficients(bending, grid, COS_2)
    return {
        "xx": mean - along_x,
        "yy": mean + along_x,
        "zz": patch_coefficients(known.kernel(lambda c: c.zz), grid, ISOTROPIC),
        "xy": -patch_coefficients(bending, grid, SIN_2),
    }
