"""What the sweeps over depth cells need of a body at every wavenumber; see ``kernels`` for the
equations."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...core.arrays import RealArray
from ..compliance.layered import (
    LayerMatrices,
    PlaneCompliance,
    half_space,
    interface_compliances,
    layer_matrices,
    raised,
)
from ..elastic import Elastic
from ..layers import Layer, Layered
from .cells import DepthCells

ENTRIES = 12
"""Numbers for each cell and wavenumber: Lz, zz, T of C below the cell; LL, Lz, zL, zz, T of F; LL,
Lz, zz, T of K."""


@dataclass(frozen=True, eq=False)
class SweepTable:
    """Coefficients of the sweeps at the wavenumbers ``alpha`` (rows, columns) in rad/m, > 0.

    Attributes
    ----------
    top
        (rows, 4, columns): LL, Lz, zz, T of the compliance of the surface in m/Pa.
    cells
        (rows, cells, 12, columns), see ``ENTRIES``.
    solids
        (cells, 3): shear modulus in Pa, Poisson's ratio, thickness in m.
    """

    alpha: RealArray
    top: RealArray = field(repr=False)
    cells: RealArray = field(repr=False)
    solids: RealArray = field(repr=False)

    @classmethod
    def of(cls, cells: DepthCells, alpha: RealArray) -> SweepTable:
        """Table for ``cells``; costs one layer matrix for each of them."""
        solids = np.array(
            [(m.shear_modulus, m.poisson_ratio, h) for m, h in zip(cells.materials, cells.thickness, strict=True)]
        )
        table = np.empty((alpha.shape[0], cells.count, ENTRIES, alpha.shape[1]))
        stack, bottom = cells.stack, float(cells.edges[-1])
        rest, depth = [], 0.0  # what lies under the last cell
        for layer in stack.layers:
            depth += layer.thickness
            if depth > bottom * (1.0 + 1e-9):
                rest.append(Layer(layer.material, min(depth - bottom, layer.thickness), layer.interface))
        if not rest and isinstance(stack.base, Elastic):
            below = half_space(alpha, shear_modulus=stack.base.shear_modulus, nu=stack.base.poisson_ratio)
        else:
            below = interface_compliances(Layered(rest, stack.base), alpha)[0]
        for number in range(cells.count - 1, -1, -1):
            shear, nu, thickness = solids[number]
            matrices = layer_matrices(alpha, thickness, shear_modulus=shear, nu=nu)
            for entry, values in enumerate(_entries(below, matrices)):
                table[:, number, entry] = values
            below = raised(below, matrices)
        top = np.stack([below.LL, below.Lz, below.zz, below.T], axis=1)
        return cls(alpha, top, table, solids)


def _entries(below: PlaneCompliance, m: LayerMatrices) -> tuple[RealArray, ...]:
    """Lz, zz, T of C; F = B (1 + C D)^-1; K = (D^-1 + C)^-1 = (D + det D adj C)/det(1 + C D)."""
    c, g = below.scaled(m.g_alpha), m.g_alpha
    det_D = m.D_LL * m.D_zz - m.D_Lz**2
    LL, Lz = 1.0 + c.LL * m.D_LL + c.Lz * m.D_Lz, c.LL * m.D_Lz + c.Lz * m.D_zz
    zL, zz = c.Lz * m.D_LL + c.zz * m.D_Lz, 1.0 + c.Lz * m.D_Lz + c.zz * m.D_zz
    det_C = c.LL * c.zz - c.Lz**2
    scale = 1.0 / (1.0 + c.LL * m.D_LL + c.zz * m.D_zz + 2.0 * c.Lz * m.D_Lz + det_C * det_D)
    across = 1.0 / (1.0 + m.D_T * c.T)
    return (
        below.Lz,
        below.zz,
        below.T,
        (m.B_LL * zz - m.B_Lz * zL) * scale,
        (m.B_Lz * LL - m.B_LL * Lz) * scale,
        (m.B_zL * zz - m.B_zz * zL) * scale,
        (m.B_zz * LL - m.B_zL * Lz) * scale,
        m.B_T * across,
        (m.D_LL + det_D * c.zz) * scale * g,
        (m.D_Lz - det_D * c.Lz) * scale * g,
        (m.D_zz + det_D * c.LL) * scale * g,
        m.D_T * across * g,
    )
