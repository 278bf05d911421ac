"""The uniform part of a periodic load: uniaxial strain in every region, with shear that reaches through.

No mean lateral strain; the mean displacement counts from the rigid base, or without one from that of the surface, since
a half-space under uniform load sinks without bound.
"""

from __future__ import annotations

import math

from ..core.errors import InputError
from ..solids.elastic import Elastic
from ..solids.layers import RigidBase
from .regions import Plane, Region, regions, stack
from .tractions import Tractions

_BALANCED = 1e-9  # mean over largest shear traction: rounding, in single precision that of a sum


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
    """Refuse a mean shear traction on layers that nothing holds.

    At every other wavelength the layers above a frictionless interface carry shear as a sheet does. In a periodic cell
    the mean would push them away; without periodicity the unloaded parts of the layers hold them.

    Raises
    ------
    InputError
        If the boundary is periodic and there is a mean shear traction above a frictionless interface.
    """
    x, y, _ = tractions.means
    mean = math.hypot(x, y)
    if tractions.boundary == "periodic" and stack(body).slips and tractions.sheared:
        largest = max(float(abs(tractions.shear_x).max()), float(abs(tractions.shear_y).max()))
        if mean > _BALANCED * largest:
            raise InputError(
                "mean shear traction must be zero on a periodic body with a Frictionless() interface, where nothing holds the "
                "layers above it, but is not. Use Bonded() interfaces, the boundary Free() (--boundary free), whose unloaded parts "
                "hold the layers, a ShearTraction without its mean, or friction=0."
            )


def require_displacement(tractions: Tractions, body: object) -> None:
    """Refuse displacements that have no limit: of sheared layers that slip and are held at infinity only.

    Raises
    ------
    InputError
        If the boundary is not periodic and there is shear traction above a frictionless interface.
    """
    if tractions.boundary != "periodic" and tractions.sheared and stack(body).slips:
        raise InputError(
            "displacement under shear traction must not be asked of a body with a Frictionless() interface on the boundary "
            f"{tractions.boundary}: its layers are held at infinity only and slip without end. Stresses are defined; use "
            "displacement=False."
        )


def _uniaxial(material: Elastic) -> float:
    """1/M = (1-2ν) / 2G(1-ν) in 1/Pa, the compliance in uniaxial strain."""
    nu = material.poisson_ratio
    return 0.0 if math.isclose(nu, 0.5) else (1.0 - 2.0 * nu) / (2.0 * material.shear_modulus * (1.0 - nu))
