"""Full surface compliance, tractions (q_x, q_y, p) to displacements (u_x, u_y, u_z), of a periodic cell."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import RealArray
from ...core.grid import Grid
from ..body import Body, deformable
from ..elastic import Elastic, Rigid
from ..layers import Layered
from .hybrid import PlaneCompliance, half_space
from .layered import LayerStack


@dataclass(frozen=True, eq=False)
class SurfaceTensor:
    """Hermitian tensor on the half spectrum (nx, ny // 2 + 1) of a grid, in m/Pa.

    ``xx``, ``yy``, ``zz`` and ``xy`` are real; ``xz`` and ``yz`` are the imaginary parts: C_xz = i xz, C_zx = -i xz.
    """

    xx: RealArray
    yy: RealArray
    zz: RealArray
    xy: RealArray
    xz: RealArray
    yz: RealArray


def plane_compliance(body: Elastic | Layered, wavenumber: RealArray) -> PlaneCompliance:
    """Compliances along, across and normal to the wavevector at each ``wavenumber`` > 0 (rad/m)."""
    if isinstance(body, Elastic):
        return half_space(wavenumber, shear_modulus=body.shear_modulus, nu=body.poisson_ratio)
    reduced = body.reduced
    if not reduced.layers and isinstance(reduced.base, Elastic):
        return plane_compliance(reduced.base, wavenumber)
    return LayerStack(body).plane(wavenumber)


def surface_tensor(grid: Grid, body: Body, counter_body: Body = Rigid()) -> SurfaceTensor:
    """Displacement of ``body`` relative to ``counter_body`` per traction on ``body``, in Fourier space.

    Compliances of both bodies add up, but their coupling between normal and tangential directions subtracts, for the two
    carry opposite tractions in a common frame. Odd entries are zero on the Nyquist lines, where their sign
    is undefined, so that real tractions give real displacements. The mean mode is zero, its displacement being the datum,
    but for the compression and shear of layers on a rigid base.

    Parameters
    ----------
    grid
        Periodic cell.
    body, counter_body
        Bodies below and above; one of them may be rigid.

    Raises
    ------
    InputError
        If both bodies are rigid.
    """
    both = _relative(grid.wavenumber(), body, counter_body)
    qx, qy = grid.wavevector()
    q = grid.wavenumber()
    q[0, 0] = 1.0
    c, s = qx / q, qy / q
    odd_x, odd_y = _without_nyquist(c, grid.shape[0], 0), _without_nyquist(s, grid.shape[1], 1)
    difference = both.LL - both.T
    tensor = SurfaceTensor(
        xx=c * c * difference + both.T,
        yy=s * s * difference + both.T,
        zz=both.zz,
        xy=odd_x * odd_y * difference,
        xz=odd_x * both.Lz,
        yz=odd_y * both.Lz,
    )
    shear, normal = _mean_modes(body, counter_body)
    for entry, value in ((tensor.xx, shear), (tensor.yy, shear), (tensor.zz, normal)):
        entry[0, 0] = value
    for entry in (tensor.xy, tensor.xz, tensor.yz):
        entry[0, 0] = 0.0
    return tensor


def _relative(q: RealArray, body: Body, counter_body: Body) -> PlaneCompliance:
    """Sum of both compliances, with the difference of their couplings; any value at the mean mode."""
    q[0, 0] = 1.0
    parts = [(plane_compliance(solid, q), sign) for solid, sign in deformable(body, counter_body)]
    return PlaneCompliance(
        LL=np.add.reduce([part.LL for part, _ in parts]),
        zz=np.add.reduce([part.zz for part, _ in parts]),
        Lz=np.add.reduce([sign * part.Lz for part, sign in parts]),
        T=np.add.reduce([part.T for part, _ in parts]),
    )


def _without_nyquist(direction: RealArray, count: int, axis: int) -> RealArray:
    result = direction.copy()
    if count % 2 == 0:
        result[(slice(None),) * axis + (count // 2,)] = 0.0
    return result


def _mean_modes(body: Body, counter_body: Body) -> tuple[float, float]:
    """Shear and compression of the layers per traction in m/Pa where all deformable bodies stand on rigid bases, else 0."""
    shears, normals = [], []
    for solid, _ in deformable(body, counter_body):
        stack = solid.reduced if isinstance(solid, Layered) else None
        if stack is None or isinstance(stack.base, Elastic):
            return 0.0, 0.0
        shears.append(
            0.0 if stack.slips else sum(layer.thickness / layer.material.shear_modulus for layer in stack.layers)
        )
        normals.append(LayerStack(stack).mean_mode())
    return (sum(shears) if all(shears) else 0.0), sum(normals)
