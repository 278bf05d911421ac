"""Displacement and stress below a circular Hertz contact, pressed and sliding, in closed form.

The semi-ellipsoidal traction is a row of point sources on an imaginary axis: ∫ sqrt(1 - s²/a²)/ρ dA equals
(π/2a) ∫ (a² - t²)/sqrt(r² + (z + it)²) dt over -a < t < a. The integrals of Boussinesq and Cerruti (Johnson 1985,
sec. 3.2) are then elementary functions of one complex root; they are Hamilton's (1983), in a form without 0/0 on the axis.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import ComplexArray, RealArray
from ..core.tensor import Displacement, ElasticFields, StressTensor


def hertz_normal(
    x: RealArray, y: RealArray, z: RealArray | float, contact_radius: float, *, shear: float, nu: float
) -> ElasticFields:
    """Displacement (m/Pa) and stress under the pressure sqrt(1 - r²/a²) per unit peak on r < a = ``contact_radius``.

    Parameters
    ----------
    x, y, z
        Field points in m, broadcast against each other, z >= 0.
    contact_radius
        a in m.
    shear, nu
        Shear modulus G in Pa and Poisson's ratio, up to 0.5.
    """
    x, y, z = np.broadcast_arrays(x, y, z)
    f = _Potentials.of(x, y, z, contact_radius)
    k = 1.0 - 2.0 * nu
    along_r = -(k * f.chi_1 + z * f.V_1)
    displacement = Displacement(x * along_r, y * along_r, 2.0 * (1.0 - nu) * f.V - z * f.V_z)
    bend = -(z * f.V_2 + k * f.chi_2)
    common = 2.0 * nu * f.V_z - z * f.V_1 - k * f.chi_1
    stress = StressTensor(
        xx=common + x**2 * bend,
        yy=common + y**2 * bend,
        zz=f.V_z - z * f.V_zz,
        xy=x * y * bend,
        xz=-z * x * f.V_1z,
        yz=-z * y * f.V_1z,
    )
    return ElasticFields(displacement * (0.25 / (np.pi * shear)), stress * (0.5 / np.pi))


def hertz_shear(
    x: RealArray, y: RealArray, z: RealArray | float, contact_radius: float, *, shear: float, nu: float
) -> ElasticFields:
    """Displacement (m/Pa) and stress under the shear traction sqrt(1 - r²/a²) along +x on r < a.

    Parameters and units as for ``hertz_normal``. With friction μ and peak pressure p0 the sliding contact has
    ``hertz_normal(...) * p0 + hertz_shear(...) * (μ * p0)``: the counter-body moves toward +x, the trailing edge is at -a.
    """
    x, y, z = np.broadcast_arrays(x, y, z)
    f = _Potentials.of(x, y, z, contact_radius)
    displacement = Displacement(
        2.0 * f.V + 2.0 * nu * (f.Xi_1 + x**2 * f.Xi_2) - z * (f.chi_1 + x**2 * f.chi_2),
        x * y * (2.0 * nu * f.Xi_2 - z * f.chi_2),
        x * ((1.0 - 2.0 * nu) * f.chi_1 - z * f.V_1),
    )
    second = 2.0 * nu * f.Xi_2 - z * f.chi_2
    third = 2.0 * nu * f.Xi_3 - z * f.chi_3
    stress = StressTensor(
        xx=x * (2.0 * (1.0 + nu) * f.V_1 + 3.0 * second + x**2 * third),
        yy=x * (2.0 * nu * f.V_1 + second + y**2 * third),
        zz=-z * x * f.V_1z,
        xy=y * (f.V_1 + second + x**2 * third),
        xz=f.V_z - z * (f.V_1 + x**2 * f.V_2),
        yz=-z * x * y * f.V_2,
    )
    return ElasticFields(displacement * (0.25 / (np.pi * shear)), stress * (0.5 / np.pi))


@dataclass(frozen=True, eq=False)
class _Potentials:
    """V = ∫ p/ρ dA, χ and Ξ with ∂χ/∂z = V, ∂Ξ/∂z = χ; the digit says how often D = (1/r) ∂/∂r was applied."""

    V: RealArray
    V_z: RealArray
    V_zz: RealArray
    V_1: RealArray
    V_1z: RealArray
    V_2: RealArray
    chi_1: RealArray
    chi_2: RealArray
    chi_3: RealArray
    Xi_1: RealArray
    Xi_2: RealArray
    Xi_3: RealArray

    @classmethod
    def of(cls, x: RealArray, y: RealArray, z: RealArray, a: float) -> _Potentials:
        """At the points ``x``, ``y``, ``z`` in m, z >= 0.

        For a kernel f(r, z) of the point source, two integrations by parts leave (2π/a) Im[f⁻³ - i a f⁻²] at
        ζ = z + ia, f⁻ⁿ being the n-th antiderivative by ζ. Those of 1/R, R² = r² + ζ², and what D makes of them, hold
        R, L = ln(ζ + R) and k = 1/(ζ + R) alone.
        """
        r2 = x**2 + y**2
        zeta: ComplexArray = np.asarray(z + 1j * a)
        R: ComplexArray = np.sqrt(r2 + zeta**2)
        R = np.where(R == 0.0, 1e-150, R)  # the edge: 1/R comes with a factor z = 0
        L: ComplexArray = np.log(zeta + R)
        k: ComplexArray = 1.0 / (zeta + R)
        c: ComplexArray = zeta * k

        def value(third: ComplexArray | RealArray, second: ComplexArray | RealArray) -> RealArray:
            part: RealArray = 2.0 * np.pi / a * (third - 1j * a * second).imag
            return part

        h0, h1, h2, h3 = 1.0 / R, L, zeta * L - R, 0.25 * ((2.0 * zeta**2 - r2) * L - 3.0 * zeta * R)
        # D once: g, twice: e, three times: d
        g1, g2, g3 = k / R, -k, -0.5 * (L + c)
        g4 = -0.5 * (zeta * L - 2.0 / 3.0 * R + zeta * c / 3.0)
        g5 = -0.5 * ((0.5 * zeta**2 - 0.125 * r2) * L - 13.0 / 24.0 * zeta * R + zeta**2 * c / 12.0)
        e2, e3, e4, e5 = k**2 / R, -0.5 * k**2, k * (2.0 - c) / 6.0, 0.125 * L + c * (5.0 - c) / 24.0
        d3, d4, d5 = k**3 / R, -(k**3) / 3.0, k**2 * (3.0 - 2.0 * c) / 24.0
        return cls(
            V=value(h3, h2),
            V_z=value(h2, h1),
            V_zz=value(h1, h0),
            V_1=value(g3, g2),
            V_1z=value(g2, g1),
            V_2=value(e3, e2),
            chi_1=value(g4, g3),
            chi_2=value(e4, e3),
            chi_3=value(d4, d3),
            Xi_1=value(g5, g4),
            Xi_2=value(e5, e4),
            Xi_3=value(d5, d4),
        )
