"""Compliance of a coated half-space under waves of pressure, in closed form."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray


def softening(
    wavenumber: RealArray, coating: float, base: float, thickness: float, coating_nu: float, base_nu: float
) -> RealArray:
    """M of ``wavenumber`` q in rad/m, >= 0, of any shape: by how much the base makes the coating
    more compliant, in C(q) = 2 [1 + M(q)]/(E1* q), E1* = E1/(1 - ν1²).

    Young's moduli of ``coating`` and ``base`` in Pa, ``thickness`` in m. With ξ = q h, μ = G1/G2,
    κ = (μ - 1)/(μ + 3 - 4ν1) and λ = 1 - 4(1 - ν1)/[1 + μ(3 - 4ν2)] (O'Sullivan & King 1988)

        1 + M = [1 + 4κξ e^(-2ξ) - λκ e^(-4ξ)]/[1 - (λ + κ + 4κξ²) e^(-2ξ) + λκ e^(-4ξ)].
    """
    shear = (coating / (1.0 + coating_nu)) / (base / (1.0 + base_nu))
    kappa = (shear - 1.0) / (shear + 3.0 - 4.0 * coating_nu)
    lam = 1.0 - 4.0 * (1.0 - coating_nu) / (1.0 + shear * (3.0 - 4.0 * base_nu))
    xi = wavenumber * thickness
    e = np.exp(-2.0 * xi)
    rise = e * (lam + kappa + 4.0 * kappa * xi * (1.0 + xi) - 2.0 * lam * kappa * e)
    return np.asarray(rise / (1.0 - e * (lam + kappa + 4.0 * kappa * xi**2 - lam * kappa * e)))
