"""Line forces and uniform strips on a half-space in plane strain (Flamant 1892; Johnson 1985, ch. 2).

Plane problems fix displacements up to a constant only; here surface displacements along the force are multiples of ln r.
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import RealArray
from ..core.tensor import Displacement, ElasticFields, StressTensor


def flamant_normal(x: RealArray, z: RealArray | float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement and stress per unit normal force per length (N/m) along +z on the line x = z = 0.

    Parameters
    ----------
    x, z
        Field points in m, broadcast against each other, z >= 0; singular at the origin.
    shear, nu
        Shear modulus G in Pa and Poisson's ratio, up to 0.5.
    """
    x, z = np.broadcast_arrays(x, z)
    r2 = x**2 + z**2
    theta = np.arctan2(x, z)
    u = Displacement(-(1.0 - 2.0 * nu) * theta + x * z / r2, 0.0 * x, -(1.0 - nu) * np.log(r2) + z**2 / r2)
    k = -2.0 / (np.pi * r2**2)
    return ElasticFields(u * (0.5 / (np.pi * shear)), _plane_strain(k * x**2 * z, k * z**3, k * x * z**2, nu))


def flamant_tangential(x: RealArray, z: RealArray | float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement and stress per unit tangential force per length (N/m) along +x on the line x = z = 0.

    Parameters and units as for ``flamant_normal``.
    """
    x, z = np.broadcast_arrays(x, z)
    r2 = x**2 + z**2
    theta = np.arctan2(x, z)
    u = Displacement(-(1.0 - nu) * np.log(r2) - z**2 / r2, 0.0 * x, (1.0 - 2.0 * nu) * theta + x * z / r2)
    k = -2.0 / (np.pi * r2**2)
    return ElasticFields(u * (0.5 / (np.pi * shear)), _plane_strain(k * x**3, k * x * z**2, k * x**2 * z, nu))


def flamant_out_of_plane(x: RealArray, z: RealArray | float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement and stress per unit force per length (N/m) along +y on the line x = z = 0 (antiplane strain).

    u_y = -ln(r)/πG, whatever Poisson's ratio ``nu``. Parameters and units as for ``flamant_normal``.
    """
    x, z = np.broadcast_arrays(x, z)
    r2, zero = x**2 + z**2, 0.0 * x * nu
    stress = StressTensor(zero, zero, zero, xy=-x / (np.pi * r2), xz=zero, yz=-z / (np.pi * r2))
    return ElasticFields(Displacement(zero, -0.5 * np.log(r2) / (np.pi * shear), zero), stress)


def strip_pressure(x: RealArray, z: RealArray | float, half_width: float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement (m/Pa) and stress under unit pressure on |x| < half_width (m); elsewhere as ``flamant_normal``.

    At z = 0 the edges get the mean of both sides.
    """
    ends = [_end(x, z, half_width), _end(x, z, -half_width)]
    fields = []
    for X, z_, angle, log, r2 in ends:
        u = Displacement(
            -(1.0 - 2.0 * nu) * (X * angle - 0.5 * z_ * log) + 0.5 * z_ * log,
            0.0 * X,
            -(1.0 - nu) * (X * log - 2.0 * X + 2.0 * z_ * angle) + z_ * angle,
        )
        twist = z_ * X / r2
        s = _plane_strain((twist - angle) / np.pi, -(twist + angle) / np.pi, z_**2 / r2 / np.pi, nu)
        fields.append(ElasticFields(u * (0.5 / (np.pi * shear)), s))
    return fields[0] + fields[1] * -1.0


def strip_shear(x: RealArray, z: RealArray | float, half_width: float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement (m/Pa) and stress under unit shear traction along +x on |x| < half_width (m).

    As ``strip_pressure``; the stress xx is logarithmically infinite at the edges of the surface.
    """
    ends = [_end(x, z, half_width), _end(x, z, -half_width)]
    fields = []
    for X, z_, angle, log, r2 in ends:
        u = Displacement(
            -(1.0 - nu) * (X * log - 2.0 * X + 2.0 * z_ * angle) - z_ * angle,
            0.0 * X,
            (1.0 - 2.0 * nu) * (X * angle - 0.5 * z_ * log) + 0.5 * z_ * log,
        )
        dip = z_**2 / r2
        s = _plane_strain(-(log + dip) / np.pi, dip / np.pi, (z_ * X / r2 - angle) / np.pi, nu)
        fields.append(ElasticFields(u * (0.5 / (np.pi * shear)), s))
    return fields[0] + fields[1] * -1.0


def strip_out_of_plane(
    x: RealArray, z: RealArray | float, half_width: float, *, shear: float, nu: float
) -> ElasticFields:
    """Displacement (m/Pa) and stress under unit shear traction along +y on |x| < half_width (m); see ``strip_pressure``."""
    fields = []
    for X, z_, angle, log, _ in (_end(x, z, half_width), _end(x, z, -half_width)):
        zero = 0.0 * X * nu
        u = Displacement(zero, (X - 0.5 * X * log - z_ * angle) / (np.pi * shear), zero)
        s = StressTensor(zero, zero, zero, xy=-0.5 * log / np.pi, xz=zero, yz=-angle / np.pi)
        fields.append(ElasticFields(u, s))
    return fields[0] + fields[1] * -1.0


def _end(x: RealArray, z: RealArray | float, shift: float) -> tuple[RealArray, ...]:
    """X = x + shift, z, arctan(X/z), ln(X² + z²) and X² + z², kept finite at the end of the strip."""
    X, z = np.broadcast_arrays(x + shift, z)
    r2 = np.maximum(X**2 + z**2, 1e-290)
    return X, z, np.arctan2(X, z), np.log(r2), r2


def _plane_strain(xx: RealArray, zz: RealArray, xz: RealArray, nu: float) -> StressTensor:
    return StressTensor(xx=xx, yy=nu * (xx + zz), zz=zz, xy=0.0 * xx, xz=xz, yz=0.0 * xx)
