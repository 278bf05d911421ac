"""Where a surface comes from: a file, a shape or a random process."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import Field

from .base import FileSurface
from .random_surfaces import RandomSurface
from .shapes import Shape

Generated: TypeAlias = Annotated[Shape | RandomSurface, Field(discriminator="kind")]
"""One generated surface, told apart by the key ``kind``."""

SurfaceTable: TypeAlias = Annotated[FileSurface | Shape | RandomSurface, Field(discriminator="kind")]
"""One surface, told apart by the key ``kind``."""

__all__ = ["FileSurface", "Generated", "RandomSurface", "Shape", "SurfaceTable"]
