"""Where a surface comes from: a file, a shape or a random process."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field, model_validator

from ...core.errors import InputError
from .preparation import Step
from .values import ORDERED, Channel, Fraction, HeightUnit, Hurst, Length, Number, Points, Seed, Size, Table, Text


class _Surface(Table):
    """What all surfaces have: preparation steps, and for a counter surface how it is turned over.

    ``mirror`` is ``"x"`` or ``"y"`` for a map measured facing its own body, and ``"none"`` for one that is already
    in the lateral frame of the other surface.
    """

    prepare: Annotated[tuple[Step, ...], ORDERED] = ()
    mirror: Literal["x", "y", "none"] | None = None


class _Generated(_Surface):
    """What all generated surfaces have: a grid."""

    points: Points
    size: Size


class FileSurface(_Surface):
    """Heights from a file; a relative ``path`` starts at the folder of the document."""

    kind: Literal["file"]
    path: Text
    channel: Channel | None = None
    size: Size | None = None
    height_unit: HeightUnit | None = None
    z_scale: Length | None = None


class Sphere(_Generated):
    """Sphere, by default its paraboloid."""

    kind: Literal["sphere"]
    radius: Length
    exact: bool = False


class EllipticParaboloid(_Generated):
    """Paraboloid with principal radii ``radius_x`` and ``radius_y``."""

    kind: Literal["elliptic_paraboloid"]
    radius_x: Length
    radius_y: Length


class Cylinder(_Generated):
    """Parabolic cylinder along ``axis``."""

    kind: Literal["cylinder"]
    radius: Length
    axis: Literal["x", "y"] = "y"


class Cone(_Generated):
    """Cone; ``slope`` is the tangent of the angle between flank and surface."""

    kind: Literal["cone"]
    slope: Number


class FlatPunch(_Generated):
    """Flat-ended circular punch standing ``depth`` above its surroundings."""

    kind: Literal["flat_punch"]
    radius: Length
    depth: Length


class Sinusoid(_Generated):
    """Wave along ``axis``."""

    kind: Literal["sinusoid"]
    amplitude: Length
    wavelength: Length
    axis: Literal["x", "y"] = "x"


class Bisinusoid(_Generated):
    """Egg-box wave."""

    kind: Literal["bisinusoid"]
    amplitude: Length
    wavelength: Length


class FlatSurface(_Generated):
    """Flat surface."""

    kind: Literal["flat"]


class ExponentialSpectrum(Table):
    """Exponential autocorrelation; at ``correlation_length`` it has dropped to ``drop`` (0.1 unless said otherwise)."""

    kind: Literal["exponential"]
    rms_height: Length
    correlation_length: Length
    correlation_length_y: Length | None = None
    drop: Fraction = 0.1


class SelfAffineSpectrum(Table):
    """Plateau and power law with exactly one amplitude, an rms height or an rms slope."""

    kind: Literal["self_affine"]
    rms_height: Length | None = None
    rms_slope: Number | None = None
    hurst: Hurst
    rolloff_wavelength: Length
    shortest_wavelength: Length
    longest_wavelength: Length | None = None

    @model_validator(mode="after")
    def _one_amplitude(self) -> SelfAffineSpectrum:
        if (self.rms_height is None) == (self.rms_slope is None):
            given = "neither" if self.rms_height is None else "both"
            raise InputError(f" must give exactly one of rms_height and rms_slope, but gives {given}.")
        return self


class Rough(_Generated):
    """Periodic Gaussian random surface; equal seeds give equal surfaces."""

    kind: Literal["rough"]
    seed: Seed
    exact_rms: bool = False
    spectrum: Annotated[ExponentialSpectrum | SelfAffineSpectrum, Field(discriminator="kind")]


Shape: TypeAlias = Sphere | EllipticParaboloid | Cylinder | Cone | FlatPunch | Sinusoid | Bisinusoid | FlatSurface
"""A deterministic shape."""

SurfaceTable: TypeAlias = Annotated[FileSurface | Shape | Rough, Field(discriminator="kind")]
"""One surface, told apart by the key ``kind``."""
