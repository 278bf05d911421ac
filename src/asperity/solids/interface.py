"""How a layer is joined to what lies below it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, TypeAlias


@dataclass(frozen=True)
class Bonded:
    """Perfect bond: all displacements and all tractions are continuous."""

    name: ClassVar[str] = "bonded"


@dataclass(frozen=True)
class Frictionless:
    """Free slip without opening: normal displacement and pressure are continuous, the shear traction is zero.

    The interface is taken to stay closed; add the mean pressure to see whether tension arises.
    """

    name: ClassVar[str] = "frictionless"


Interface: TypeAlias = Bonded | Frictionless
"""Lower interface of a layer."""
