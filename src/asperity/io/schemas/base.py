"""What all surfaces of a document have in common, and the surface that is read from a file."""

from __future__ import annotations

from typing import Literal

from ...core.settings import Settings
from ...core.values import Angle, Length, NonEmpty, Points, SignedLength, Size
from .preparation import Step
from .values import Channel, HeightUnit


class Place(Settings):
    """Where a counter surface lies: ``shift`` of its middle from that of the surface, ``angle`` from +x towards +y.

    Both surfaces are resampled on one grid that covers their overlap, with the finer pixel or the given one.
    """

    shift: tuple[SignedLength, SignedLength] | None = None
    angle: Angle | None = None
    pixel: tuple[Length, Length] | None = None


class AnySurface(Settings):
    """What all surfaces have: preparation steps, and for a counter surface how it is turned over and where it lies.

    ``mirror`` is ``"x"`` or ``"y"`` for a map measured facing its own body, and ``"none"`` for one that is already
    in the lateral frame of the other surface. With ``place`` the two need not have the same grid.
    """

    prepare: tuple[Step, ...] = ()
    mirror: Literal["x", "y", "none"] | None = None
    place: Place | None = None


class GeneratedSurface(AnySurface):
    """What all generated surfaces have: a grid."""

    points: Points
    size: Size


class FileSurface(AnySurface):
    """Heights from a file; a relative ``path`` starts at the folder of the document."""

    kind: Literal["file"]
    path: NonEmpty
    channel: Channel | None = None
    size: Size | None = None
    height_unit: HeightUnit | None = None
    z_scale: Length | None = None
