"""Point forces on the surface of a half-space (Boussinesq 1885; Cerruti 1882; Johnson 1985, ch. 3)."""

from __future__ import annotations

import numpy as np

from ..core.arrays import RealArray
from ..core.tensor import Displacement, ElasticFields, StressTensor


def boussinesq(x: RealArray, y: RealArray, z: RealArray | float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement (m/N) and stress (Pa/N) of a unit normal force at the origin, pushing along +z into the body.

    Parameters
    ----------
    x, y, z
        Field points in m, broadcast against each other, z >= 0; singular at the origin.
    shear, nu
        Shear modulus G in Pa and Poisson's ratio, up to 0.5.
    """
    x, y, z = np.broadcast_arrays(x, y, z)
    r = np.sqrt(x**2 + y**2 + z**2)
    k, s = 1.0 - 2.0 * nu, r + z
    radial = z / r**3 - k / (r * s)
    displacement = Displacement(x * radial, y * radial, z**2 / r**3 + 2.0 * (1.0 - nu) / r)
    bend = k * (2.0 * r + z) / (r**3 * s**2) - 3.0 * z / r**5
    common = k * (z / r**3 - 1.0 / (r * s))
    stress = StressTensor(
        xx=x**2 * bend + common,
        yy=y**2 * bend + common,
        zz=-3.0 * z**3 / r**5,
        xy=x * y * bend,
        xz=-3.0 * x * z**2 / r**5,
        yz=-3.0 * y * z**2 / r**5,
    )
    return ElasticFields(displacement * (0.25 / (np.pi * shear)), stress * (0.5 / np.pi))


def cerruti(x: RealArray, y: RealArray, z: RealArray | float, *, shear: float, nu: float) -> ElasticFields:
    """Displacement (m/N) and stress (Pa/N) of a unit tangential force at the origin along +x.

    Parameters and units as for ``boussinesq``; the force along +y follows by ``exchanged`` coordinates and fields.
    """
    x, y, z = np.broadcast_arrays(x, y, z)
    r = np.sqrt(x**2 + y**2 + z**2)
    k, s = 1.0 - 2.0 * nu, r + z
    displacement = Displacement(
        1.0 / r + x**2 / r**3 + k * (1.0 / s - x**2 / (r * s**2)),
        x * y / r**3 - k * x * y / (r * s**2),
        x * z / r**3 + k * x / (r * s),
    )
    bend = k * (3.0 * r + z) / (r**3 * s**3) - 3.0 / r**5
    turn = k / (r * s**2)
    stress = StressTensor(
        xx=x**3 * bend + k * x / r**3 - 3.0 * x * turn,
        yy=x * y**2 * bend + k * x / r**3 - x * turn,
        zz=-3.0 * x * z**2 / r**5,
        xy=x**2 * y * bend - y * turn,
        xz=-3.0 * x**2 * z / r**5,
        yz=-3.0 * x * y * z / r**5,
    )
    return ElasticFields(displacement * (0.25 / (np.pi * shear)), stress * (0.5 / np.pi))
