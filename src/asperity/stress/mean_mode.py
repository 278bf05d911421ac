"""The uniform part of a periodic load: uniaxial strain in every region, with shear that reaches through.

No mean lateral strain; the mean displacement counts from the rigid base, or without one from that of the surface, since
a half-space under uniform load sinks without bound.
"""

from __future__ import annotations

import math

from ..core.errors import InputError
from ..solids.elastic import Elastic
from ..solids.interface import Frictionless
from ..solids.layers import RigidBase
from .regions import Plane, Region, regions, stack
from .tractions import Tractions


def mean_stress(loads: tuple[float, float, float], region: Region) -> tuple[float, ...]:
    """Mean of xx, yy, zz, xy, xz, yz (Pa) in ``region`` under mean ``loads`` q_x, q_y, p: σ_xx = σ_yy = -ν/(1-ν) p."""
    x, y, pressure = loads
    nu = region.material.poisson_ratio
    lateral = -nu / (1.0 - nu) * pressure
    return lateral, lateral, -pressure, 0.0, -x, -y


def mean_displacement(loads: tuple[float, float, float], body: object, plane: Plane) -> tuple[float, ...]:
    """Mean displacement (m) of ``plane`` under mean ``loads`` (Pa): these times the compliance down to the datum."""
    parts = regions(body)
    from_base = isinstance(stack(body).base, RigidBase)
    direct = shear = 0.0
    for region in parts:
        low, high = (
            (max(plane.depth, region.top), region.bottom)
            if from_base
            else (region.top, min(plane.depth, region.bottom))
        )
        if high > low:
            direct += (high - low) * _uniaxial(region.material)
            shear += (high - low) / region.material.shear_modulus
    sign = 1.0 if from_base else -1.0
    return tuple(sign * load * c for load, c in zip(loads, (shear, shear, direct), strict=True))


def require_held(tractions: Tractions, body: object) -> None:
    """Refuse shear traction on layers that nothing holds.

    Raises
    ------
    InputError
        If there is shear traction above a frictionless interface.
    """
    if tractions.sheared and any(isinstance(layer.interface, Frictionless) for layer in stack(body).layers):
        raise InputError(
            "shear traction must be zero on a body with a Frictionless() interface, which holds no layer above it, "
            "but is not. Use Bonded() interfaces, or friction=0."
        )


def _uniaxial(material: Elastic) -> float:
    """1/M = (1-2ν) / 2G(1-ν) in 1/Pa, the compliance in uniaxial strain."""
    nu = material.poisson_ratio
    return 0.0 if math.isclose(nu, 0.5) else (1.0 - 2.0 * nu) / (2.0 * material.shear_modulus * (1.0 - nu))
