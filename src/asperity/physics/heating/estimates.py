"""What closed forms make of the hottest spot, beside its temperature."""

from __future__ import annotations

import math

import numpy as np

from ...contact.measure import labelled
from ...theories.heating.impedance import HeatConductor
from ...theories.heating.sources import MovingSource, disc
from .answer import FrictionalHeating


def disc_estimate(found: FrictionalHeating) -> float:
    """Largest rise in K of a disc with Hertzian heat that has the area and the heat of the hottest
    spot and is alone, on both bodies without their layers: both maxima in parallel (Blok, Jaeger).
    NaN without heat.
    """
    if not found.rubs or not found.contact.any():
        return math.nan
    labels, _ = labelled(found.contact, wraps=found.problem.boundary.wraps)
    mean = float(found.heat[labels == labels[found.hottest]].mean())
    inverse = 0.0
    for conductor, velocity in zip(found.conductors, found.motion.velocities, strict=True):
        if conductor is not None:
            base = HeatConductor(conductor.conductivity, conductor.diffusivity)
            source = MovingSource(disc(found.spot_radius, hertzian=True), base, float(np.hypot(*velocity)))
            inverse += 1.0 / (mean * source.hottest().temperature) if mean else math.inf
    return 1.0 / inverse
