"""What lies outside the grid: the same surface again, or free half-space."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, TypeAlias


@dataclass(frozen=True)
class Periodic:
    """The contact repeats in x and y; pressures and displacements are trigonometric (spectral discretisation)."""

    name: ClassVar[str] = "periodic"
    citation_keys: ClassVar[tuple[str, ...]] = ("Stanley1997",)


@dataclass(frozen=True)
class Free:
    """No load outside the grid; pressure is constant on each pixel and the displacement exact (DC-FFT)."""

    name: ClassVar[str] = "free"
    citation_keys: ClassVar[tuple[str, ...]] = ("Liu2000", "Love1929")


Boundary: TypeAlias = Periodic | Free
"""A lateral boundary condition."""
