"""Adhesive sphere and waves in the units of Maugis, for tests."""

from __future__ import annotations

import numpy as np

import asperity as asp
from asperity.physics.adhesion.law import Adhesion

E_STAR, RADIUS, WORK = 1e6, 1e-4, 0.05
K = 4.0 / 3.0 * E_STAR
LENGTH = float(np.cbrt(np.pi * WORK * RADIUS**2 / K))
APPROACH = LENGTH**2 / RADIUS
FORCE = np.pi * WORK * RADIUS
BODY = asp.Elastic(E_STAR * (1.0 - 0.3**2), 0.3)


def strength_of(transition: float) -> float:
    """σ0 in Pa of Maugis' λ."""
    return float(0.5 * transition / np.cbrt(RADIUS / (np.pi * WORK * K**2)))


def sphere(points: int, size: float, attraction: Adhesion, **more: object) -> asp.ContactProblem:
    """Sphere on a free square of ``size`` in units of the contact radius."""
    x = (np.arange(points) - 0.5 * (points - 1)) * size * LENGTH / points
    heights = -(x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * RADIUS)
    surface = asp.Surface(heights, size * LENGTH / points)
    settings = {"body": BODY, "boundary": asp.Free(), "adhesion": attraction} | more
    return asp.ContactProblem(surface, **settings)  # type: ignore[arg-type]
