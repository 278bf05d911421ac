"""From surface traction to displacement and stress on a plane at depth, wavenumber by wavenumber.

In the frame (L, T, z) of a wavevector, with the real amplitudes of ``solids.compliance.hybrid``.
Inside a layer the plane cuts it in two: the part below is added to what lies under the layer, the
part above passes the traction on, so nothing grows with depth. In a half-space τ(z) = e^-x [[1-x,
-x], [x, 1+x]] τ(0), x = αz (Johnson 1985, sec. 13.2).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....core.arrays import RealArray
from ....solids.compliance.layered import (
    LayerMatrices,
    PlaneVector,
    half_space,
    interface_compliances,
    layer_matrices,
    lower_face,
    lowered,
    raised,
)
from ....solids.layers import Layer, Layered
from ..regions import Plane


@dataclass(frozen=True, eq=False)
class Transfer:
    """Amplitudes on a plane per unit amplitude of the surface traction; arrays over wavenumbers.

    ``tau_ab`` is the traction τ_a under the load τ_b, ``LL_b`` the stress σ_LL; ``U_b`` and ``W_b``
    (m/Pa) are the displacements u_L = iU and u_z = W; ``tau_T`` and ``u_T`` (m/Pa) belong to the
    antiplane load τ_T = 1, and ``LT`` is the amplitude Gα u_T of σ_LT = i LT. The other stresses:
    σ_zz = -τ_z, σ_Lz = -iτ_L, σ_Tz = -τ_T and σ_TT = ν(σ_LL - τ_z).
    """

    tau_zz: RealArray
    tau_Lz: RealArray
    LL_z: RealArray
    tau_zL: RealArray
    tau_LL: RealArray
    LL_L: RealArray
    tau_T: RealArray
    LT: RealArray
    U_z: RealArray
    W_z: RealArray
    U_L: RealArray
    W_L: RealArray
    u_T: RealArray


def transfer(body: Layered, plane: Plane, alpha: RealArray) -> Transfer:
    """Transfer from the surface of ``body`` to ``plane`` at the wavenumbers ``alpha`` (rad/m, > 0,
    one-dimensional).

    ``body`` has layers of finite, positive thickness only, see ``regions.stack``. Accurate to 5e-13
    of the local field.
    """
    return Transfers(body, alpha).to(plane)


class Transfers:
    """Transfer to any plane of ``body`` at the wavenumbers ``alpha``; what planes have in common is
    computed once."""

    def __init__(self, body: Layered, alpha: RealArray) -> None:
        self._body = body
        self._alpha = alpha
        self._below = interface_compliances(body, alpha)
        one, zero = np.ones_like(alpha), np.zeros_like(alpha)
        self._tops = [PlaneVector(L=np.stack([zero, one]), z=np.stack([one, zero]), T=one)]

    def to(self, plane: Plane) -> Transfer:
        """Transfer to ``plane``; costs two layer matrices, however many layers lie above."""
        number, alpha, material = plane.region.index, self._alpha, plane.region.material
        G, nu = material.shear_modulus, material.poisson_ratio
        while len(self._tops) <= number:  # tractions on the tops of the regions
            k = len(self._tops) - 1
            layer = self._body.layers[k]
            matrices = _matrices(layer, alpha, layer.thickness)
            self._tops.append(lowered(self._tops[k], self._below[k + 1], matrices, layer.interface))
        traction = self._tops[number]
        if number == len(self._body.layers):  # in the half-space
            x = alpha * plane.local_depth
            e = np.exp(-x)
            traction = PlaneVector(
                L=e * ((1.0 - x) * traction.L - x * traction.z),
                z=e * (x * traction.L + (1.0 + x) * traction.z),
                T=e * traction.T,
            )
            displacement = half_space(alpha, shear_modulus=G, nu=nu).displacement(traction)
        elif plane.side in ("surface", "below"):
            displacement = self._below[number].displacement(traction)
        else:
            layer, below = self._body.layers[number], self._below[number + 1]
            if plane.side == "above":  # at the lower face the interface decides
                whole = _matrices(layer, alpha, layer.thickness)
                displacement = lower_face(traction, below, whole, layer.interface)
                traction = lowered(traction, below, whole, layer.interface)
            else:
                lower = _matrices(layer, alpha, plane.region.bottom - plane.depth)
                compliance = raised(below, lower, layer.interface)
                traction = lowered(traction, compliance, _matrices(layer, alpha, plane.local_depth))
                displacement = compliance.displacement(traction)
        t, u = traction, displacement
        LL = -(2.0 * G * alpha * u.L + nu * t.z) / (1.0 - nu)
        arrays: list[RealArray] = [
            *(t.z[0], t.L[0], LL[0], t.z[1], t.L[1], LL[1], t.T, G * alpha * u.T),  # type: ignore[list-item]
            *(u.L[0], u.z[0], u.L[1], u.z[1], u.T),  # type: ignore[list-item]
        ]
        return Transfer(*arrays)


def _matrices(layer: Layer, alpha: RealArray, thickness: float) -> LayerMatrices:
    solid = layer.material
    return layer_matrices(alpha, thickness, shear_modulus=solid.shear_modulus, nu=solid.poisson_ratio)
