"""What closed forms make of the hottest spot, beside its temperature."""

from __future__ import annotations

import math

from ...theories.heating.estimates import interpolated, together
from .answer import FrictionalHeating


def disc_estimate(found: FrictionalHeating) -> float:
    """Largest rise in K of a disc with Hertzian heat that has the area and the heat of the hottest
    spot and is alone, on both bodies without their layers: both maxima of Tian & Kennedy together
    (Blok). NaN without heat.
    """
    if not found.rubs or not found.contact.any():
        return math.nan
    mean = float(found.heat[found.spot].mean())
    rises = []
    for conductor, velocity in zip(found.conductors, found.motion.velocities, strict=True):
        if conductor is not None:
            peclet = math.hypot(*velocity) * found.spot_radius / (2.0 * conductor.diffusivity)
            unit = mean * found.spot_radius / conductor.conductivity
            rises.append(unit * float(interpolated(peclet, hertzian=True)))
    return float(together(*rises)) if len(rises) == 2 else rises[0]
