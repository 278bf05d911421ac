"""Full surface compliance of pixels under uniform traction, without periodicity."""

from __future__ import annotations

from dataclasses import dataclass

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ..body import Body, deformable
from ..elastic import Elastic, Rigid
from ..interface import Frictionless
from ..layers import Layered
from .patch_average import COS_1, COS_2, ISOTROPIC, SIN_1, SIN_2, patch_coefficients
from .samples import samples


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
    for solid, sign in deformable(body, counter_body):
        for name, values in _components(grid, solid).items():
            total[name] = total.get(name, 0.0) + (sign * values if name in ("xz", "yz") else values)
    return InfluenceTensor(**total)


def _components(grid: Grid, body: Elastic | Layered) -> dict[str, RealArray]:
    """From the spectrum: C_xx = (LL + T)/2 + cos 2phi (LL - T)/2, C_xy = sin 2phi (LL - T)/2, C_xz = i cos phi Lz.

    A factor cos(m phi) or sin(m phi) becomes i^m cos(m theta) or i^m sin(m theta) and J_m.
    """
    depth = max(grid.spacing)
    if isinstance(body, Layered):
        depth = body.reduced.thickness or depth
        if any(isinstance(layer.interface, Frictionless) for layer in body.reduced.layers):
            raise InputError(
                "layers under a tangential traction must be bonded on the free boundary, but one is Frictionless(): "
                "it would slip without end. Use Bonded() or the periodic boundary."
            )
    known = samples(body, depth)
    mean = patch_coefficients(known.kernel(lambda c: 0.5 * (c.LL + c.T)), grid)
    bending = known.kernel(lambda c: 0.5 * (c.LL - c.T), order=2)
    coupling = known.kernel(lambda c: c.Lz, order=1)
    along_x = patch_coefficients(bending, grid, COS_2)
    return {
        "xx": mean - along_x,
        "yy": mean + along_x,
        "zz": patch_coefficients(known.kernel(lambda c: c.zz), grid, ISOTROPIC),
        "xy": -patch_coefficients(bending, grid, SIN_2),
        "xz": -patch_coefficients(coupling, grid, COS_1),
        "yz": -patch_coefficients(coupling, grid, SIN_1),
    }
