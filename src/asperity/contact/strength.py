"""What the surfaces of a contact bear before they yield plastically, and how that is known."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..solids.layers import Body, surface_material
from ..solids.strength import never_yields, yield_pressure
from .problem import ContactProblem


@dataclass(frozen=True)
class SurfaceStrength:
    """Contact pressure at which a body of a contact yields plastically at its surface.

    Attributes
    ----------
    body
        Which of the two bodies of the problem it is.
    material
        Name of the material at its surface, of a coated body that of its top layer; ``"the body"`` or ``"the counter body"`` without a name.
    pressure
        Hardness, else 2.8 Y (Tabor 1951), in Pa; None where neither hardness nor yield stress is known.
    known_as
        How it is known, such as ``"H of DLC"`` or ``"2.8 Y of stainless steel"``; empty where it is not.
    """

    body: Literal["body", "counter_body"]
    material: str
    pressure: float | None
    known_as: str

    @property
    def by_hardness(self) -> bool:
        """Whether it is a stated hardness."""
        return self.known_as.startswith("H ")


def strength_of(problem: ContactProblem) -> tuple[SurfaceStrength, ...]:
    """Strength of the surfaces of the two bodies of ``problem``, those left out that never yield: rigid ones and elastomers without a known strength."""
    found = (_surface("body", problem.body), _surface("counter_body", problem.counter_body))
    return tuple(strength for strength in found if strength is not None)


def _surface(which: Literal["body", "counter_body"], body: Body) -> SurfaceStrength | None:
    solid = surface_material(body)
    if solid is None or never_yields(solid):
        return None
    found, name = yield_pressure(solid.strength), solid.name or body.name or f"the {which.replace('_', ' ')}"
    return SurfaceStrength(which, name, found.value, f"{found.symbol} of {name}" if found.symbol else "")
