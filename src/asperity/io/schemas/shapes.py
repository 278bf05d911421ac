"""Deterministic shapes and textures. Every kind is named as the function of ``asperity.generate`` that makes it."""

from __future__ import annotations

from typing import Literal, TypeAlias

from ...core.values import Length, NonNegativeLength, Positive
from .base import GeneratedSurface


class Sphere(GeneratedSurface):
    """Sphere, by default its paraboloid."""

    kind: Literal["sphere"]
    radius: Length
    exact: bool = False


class EllipticParaboloid(GeneratedSurface):
    """Paraboloid with principal radii ``radius_x`` and ``radius_y``."""

    kind: Literal["elliptic_paraboloid"]
    radius_x: Length
    radius_y: Length


class Cylinder(GeneratedSurface):
    """Parabolic cylinder along ``axis``."""

    kind: Literal["cylinder"]
    radius: Length
    axis: Literal["x", "y"] = "y"


class Cone(GeneratedSurface):
    """Cone; ``slope`` is the tangent of the angle between flank and surface."""

    kind: Literal["cone"]
    slope: Positive


class Wedge(GeneratedSurface):
    """Wedge with its edge along ``axis``; ``slope`` as for the cone."""

    kind: Literal["wedge"]
    slope: Positive
    axis: Literal["x", "y"] = "y"


class PowerLaw(GeneratedSurface):
    """Indenter of the shape r^``exponent`` that has fallen by ``height`` at the distance ``radius``."""

    kind: Literal["power_law"]
    exponent: Positive
    radius: Length
    height: Length


class FlatPunch(GeneratedSurface):
    """Flat-ended circular punch standing ``depth`` above its surroundings, its edge rounded by ``edge_radius``."""

    kind: Literal["flat_punch"]
    radius: Length
    depth: Length
    edge_radius: NonNegativeLength | None = None


class Sinusoid(GeneratedSurface):
    """Wave along ``axis``."""

    kind: Literal["sinusoid"]
    amplitude: Length
    wavelength: Length
    axis: Literal["x", "y"] = "x"


class Bisinusoid(GeneratedSurface):
    """Egg-box wave."""

    kind: Literal["bisinusoid"]
    amplitude: Length
    wavelength: Length


class FlatSurface(GeneratedSurface):
    """Flat surface."""

    kind: Literal["flat"]


class LaserBumps(GeneratedSurface):
    """Laser-textured bumps at the distances ``pitch``: a rim around a crater, or a dome for a rim of radius 0."""

    kind: Literal["laser_bumps"]
    pitch: tuple[Length, Length]
    rim_height: Length
    rim_radius: NonNegativeLength
    rim_width: Length
    depth: NonNegativeLength | None = None
    crater_radius: Length | None = None


class Dimples(GeneratedSurface):
    """Dimples, or with ``raised`` pillars, at the distances ``pitch``; walls are steep for a large ``sharpness``."""

    kind: Literal["dimples"]
    pitch: tuple[Length, Length]
    radius: Length
    depth: Length
    sharpness: Positive = 1.0
    raised: bool = False


class Grooves(GeneratedSurface):
    """Grooves along ``axis``."""

    kind: Literal["grooves"]
    pitch: Length
    width: Length
    depth: Length
    section: Literal["vee", "round", "cosine"] = "vee"
    axis: Literal["x", "y"] = "y"


Shape: TypeAlias = (
    Sphere
    | EllipticParaboloid
    | Cylinder
    | Cone
    | Wedge
    | PowerLaw
    | FlatPunch
    | Sinusoid
    | Bisinusoid
    | FlatSurface
    | LaserBumps
    | Dimples
    | Grooves
)
"""A deterministic shape or texture."""
