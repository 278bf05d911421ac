"""Displacement and stress below a Hertz line contact, pressed and sliding, in plane strain (McEwen 1949; Johnson 1985, sec. 4.2c).

With w = x + iz the row of line forces sums to S(w) = ∫ p(s) ds/(w - s) = (π/a)(w - sqrt(w² - a²)) for
p = sqrt(1 - s²/a²); every component is a combination of S, its derivative and its integral.
"""

from __future__ import annotations

import math

import numpy as np

from ..core.arrays import ComplexArray, RealArray
from ..core.tensor import Displacement, ElasticFields, StressTensor


def hertz_line_normal(
    x: RealArray, z: RealArray | float, half_width: float, *, shear: float, nu: float
) -> ElasticFields:
    """Displacement (m/Pa) and stress under the pressure sqrt(1 - x²/a²) per unit peak on |x| < a = ``half_width`` (m).

    Parameters
    ----------
    x, z
        Field points in m, broadcast against each other, z >= 0.
    half_width
        a in m.
    shear, nu
        Shear modulus G in Pa and Poisson's ratio, up to 0.5. Displacements along the force are multiples of ln r far
        away, as those of a line force at the origin.
    """
    x, z = np.broadcast_arrays(x, z)
    S, slope, T = _sums(x, z, half_width)
    force = 0.5 * np.pi * half_width
    angle = 0.5 * np.pi * force - T.imag  # of the line forces with the z axis
    u = Displacement(-(1.0 - 2.0 * nu) * angle + z * S.real, 0.0 * x, -2.0 * (1.0 - nu) * T.real - z * S.imag)
    stress = _plane_strain(S.imag + z * slope.real, S.imag - z * slope.real, -z * slope.imag, nu)
    return ElasticFields(u * (0.5 / (np.pi * shear)), stress)


def hertz_line_shear(
    x: RealArray, z: RealArray | float, half_width: float, *, shear: float, nu: float
) -> ElasticFields:
    """Displacement (m/Pa) and stress under the shear traction sqrt(1 - x²/a²) along +x on |x| < a.

    Parameters and units as for ``hertz_line_normal``.
    """
    x, z = np.broadcast_arrays(x, z)
    S, slope, T = _sums(x, z, half_width)
    angle = 0.25 * np.pi**2 * half_width - T.imag
    u = Displacement(-2.0 * (1.0 - nu) * T.real + z * S.imag, 0.0 * x, (1.0 - 2.0 * nu) * angle + z * S.real)
    stress = _plane_strain(-2.0 * S.real + z * slope.imag, -z * slope.imag, S.imag + z * slope.real, nu)
    return ElasticFields(u * (0.5 / (np.pi * shear)), stress)


def _sums(x: RealArray, z: RealArray, a: float) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """S, dS/dw and T = ∫ p(s) ln(w - s) ds at w = x + iz."""
    w = x + 1j * z
    root = np.sqrt(w - a) * np.sqrt(w + a)
    safe = np.where(root == 0.0, 1e-150, root)  # the edge: the slope comes with a factor z = 0
    force = 0.5 * math.pi * a
    # w - root loses digits far away, a²/(w + root) does not
    S = math.pi * a / (w + root)
    slope = -S / safe
    T = 0.5 * w * S + force * (np.log(w + root) - math.log(2.0) - 0.5)
    return S, slope, T


def _plane_strain(xx: RealArray, zz: RealArray, xz: RealArray, nu: float) -> StressTensor:
    """Plane strain from π times the components in the plane."""
    xx, zz, xz = xx / np.pi, zz / np.pi, xz / np.pi
    return StressTensor(xx=xx, yy=nu * (xx + zz), zz=zz, xy=0.0 * xx, xz=xz, yz=0.0 * xx)
