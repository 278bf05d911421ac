"""An upright cylinder between two rigid platens, bonded to them or held by friction."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.quantity import measured
from ..solids.elastic import Elastic
from .contact import ContactSurface, Pressed, Target
from .elements import axisymmetric
from .linear import held
from .mesh import Mesh, tensor_mesh
from .quadratic import cornered_line, quadratic_mesh, quadratic_rings
from .solid import Solid

_FINEST = 1e-4
"""Side of the elements in the corner over that of the others: with 1e-2 the force of a bonded
cylinder of ν = 0.45 is 1e-5 larger."""


@dataclass(frozen=True, eq=False)
class CylinderCompression:
    """An elastic cylinder compressed along its axis; all is proportional to the compression.

    Attributes
    ----------
    apparent_modulus
        Force over section and strain.
    stiffness
        Force over compression.
    oedometer_modulus
        Apparent modulus where the side cannot move, the limit of a flat disc bonded to platens.
    stick_radius
        Radius up to which the platens stick; the radius of the cylinder where they are bonded.
    depths
        Distances from the platen down to the middle of the cylinder.
    bulge
        Displacement of the side outwards over the compression.
    """

    apparent_modulus: float = measured("Pa", "force over section and strain")
    stiffness: float = measured("N/m", "force over compression")
    oedometer_modulus: float = measured("Pa", "modulus without strain across")
    stick_radius: float = measured("m", "radius up to which the platens stick")
    depths: RealArray = measured("m", "distance from the platen", "depth")
    bulge: RealArray = measured("1", "displacement of the side outwards over the compression", "depth")


def compressed_cylinder(
    solid: Elastic, height: float, diameter: float, *, friction: float = math.inf, parts: int = 16
) -> CylinderCompression:
    """Compress an upright cylinder between two rigid platens (Yastrebov's lectures, pp. 19-21).

    Without friction the strain is uniform and the apparent modulus E. Friction keeps the ends from
    spreading: for small μ, where they slip everywhere, it adds (2/3) μ ν d/h of E.

    Parameters
    ----------
    solid
        Of the cylinder, ν < 0.5.
    height, diameter
        In m, > 0.
    friction
        Coefficient μ >= 0 at both ends; ``inf``: bonded, with rings of nine points, whose force is
        within 1e-6 at ν = 0.2 and 2e-5 at 0.45. With friction rings have four points (3e-4).
    parts
        Elements over the shorter of radius and half height, >= 4, beside those in the corner.

    Raises
    ------
    InputError
        If a number is out of its range.

    Examples
    --------
    >>> rubber = Elastic(2e6, 0.45)
    >>> [round(compressed_cylinder(rubber, 0.02, 0.02, friction=mu).apparent_modulus / 2e6, 3)
    ...  for mu in (0.0, 0.1, math.inf)]
    [1.0, 1.031, 1.146]
    """
    require.instance(solid, Elastic, "solid of the cylinder")
    half = 0.5 * require.magnitude(height, "height of the cylinder (m)")
    radius = 0.5 * require.magnitude(diameter, "diameter of the cylinder (m)")
    require.integer(parts, 4, "elements over radius or half height")
    bonded = friction == math.inf
    if not bonded:
        require.not_negative(friction, "friction of the platens")
    size = min(half, radius)
    # In units of the radius, and compressed by half the height.
    across = cornered_line(1.0, math.ceil(parts * radius / size), _FINEST if bonded else 1e-2, (False, True))
    down = cornered_line(half / radius, math.ceil(parts * half / size), _FINEST if bonded else 1e-2, (True, False))
    if bonded:
        force, displacement, mesh = _bonded(across, down, solid.poisson_ratio)
        stick = 1.0
    else:
        force, displacement, mesh, stick = _rubbing(across, down, solid.poisson_ratio, friction)
    E, nu = solid.youngs_modulus, solid.poisson_ratio
    modulus = E * force / math.pi
    side = np.flatnonzero(mesh.points[:, 0] == mesh.points[:, 0].max())
    return CylinderCompression(
        apparent_modulus=modulus,
        stiffness=modulus * math.pi * radius**2 / (2.0 * half),
        oedometer_modulus=E * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)),
        stick_radius=stick * radius,
        depths=mesh.points[side, 1] * radius,
        bulge=displacement[2 * side] * 0.5 * radius / half,
    )


def _bonded(across: RealArray, down: RealArray, nu: float) -> tuple[float, RealArray, Mesh]:
    """Force in units of E R², displacement and mesh at a strain of 1."""
    mesh = quadratic_mesh(across, down)
    body = Solid(quadratic_rings(mesh), (Elastic(1.0, nu),))
    stiffness = body.elements.pattern.matrix(body.entries)
    known, prescribed = np.zeros(body.elements.size), np.zeros(body.elements.size, dtype=bool)
    top = mesh.surface
    prescribed[[*(2 * top), *(2 * top + 1), *(2 * mesh.lower + 1), *(2 * mesh.side(-1))]] = True
    known[2 * top + 1] = down[-1]
    displacement = held(stiffness, known, prescribed)
    return float((stiffness @ displacement)[2 * top + 1].sum()), displacement, mesh


def _rubbing(across: RealArray, down: RealArray, nu: float, friction: float) -> tuple[float, RealArray, Mesh, float]:
    """The same between platens with ``friction``, and the radius that sticks."""
    mesh = tensor_mesh(across, down, np.zeros(len(down) - 1, dtype=np.intp))
    top, size = mesh.surface, 2 * len(mesh.points)
    fixed = np.zeros(size, dtype=bool)
    fixed[[*(2 * mesh.lower + 1), *(2 * mesh.side(-1))]] = True
    tangential = 2 * top[:, None] if friction else np.zeros((len(top), 0), dtype=np.intp)
    body = Pressed(
        Solid(axisymmetric(mesh), (Elastic(1.0, nu),)), ContactSurface(2 * top + 1, fixed, tangential, friction)
    )
    shift = np.zeros(tangential.shape[1])
    found = body.advance(
        body.undeformed(), lambda part: Target(np.zeros(len(top)), approach=part * float(down[-1]), shift=shift)
    )
    sticking = mesh.points[top, 0][found.touching & ~found.slipping]
    stick = float(sticking.max(initial=0.0)) if friction else 0.0
    return found.force, found.displacement, mesh, stick
