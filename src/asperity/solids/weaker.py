"""Which of two bodies gives way first."""

from __future__ import annotations

import math

from .body import Body, surface_material


def weaker_strength(*bodies: Body) -> dict[str, float]:
    """Lowest known ``hardness`` and ``yield_stress`` (Pa) of the materials at the surfaces of ``bodies``, and ``nu``.

    Poisson's ratio is that of the material which yields first, else of the softest, else of the first. What is not known
    is left out.
    """
    materials = [material for material in map(surface_material, bodies) if material is not None]
    found = {"nu": materials[0].poisson_ratio} if materials else {}
    for name in ("hardness", "yield_stress"):
        known = [
            (getattr(m.strength, name), m.poisson_ratio) for m in materials if not math.isnan(getattr(m.strength, name))
        ]
        if known:
            found[name], found["nu"] = min(known)
    return found
