"""Hardness and modulus from an indentation curve (Oliver & Pharr 1992)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

from ...core.errors import InputError
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Force, Length, Number, Positive
from ..protocol import Theory

CONE, PARABOLOID, PUNCH = 0.72, 0.75, 1.0
"""ε of h_c = h_max - ε W/S by the shape of the indenter; Berkovich indenters behave as the paraboloid."""

BERKOVICH = 24.5
"""Area over depth squared of an ideal Berkovich pyramid."""


@dataclass(frozen=True)
class OliverPharr(Theory):
    """Results from the initial unloading: h_c = h_max - ε W_max/S, H = W_max/A(h_c), E_r = (√π/2) S/√A.

    InputError if a value is not positive, or the indenter would rebound further than it went in.
    """

    load: Annotated[Force, Help("peak load W_max", of="bodies")]
    depth: Annotated[Length, Help("depth h_max at peak load", of="bodies")]
    stiffness: Annotated[
        float, Number("N/m", above=0.0), Help("contact stiffness S = dW/dh at the start of unloading", of="bodies")
    ]
    shape: Annotated[
        float, Number(above=0.0, most=1.0), Help("ε: 0.72 cone, 0.75 paraboloid and Berkovich, 1 punch", of="bodies")
    ] = PARABOLOID
    area_factor: Annotated[Positive, Help("area over contact depth squared", of="bodies")] = BERKOVICH
    name: ClassVar[str] = "oliver-pharr"
    title: ClassVar[str] = "Oliver-Pharr, hardness and modulus from unloading"
    citation_keys: ClassVar[tuple[str, ...]] = ("Oliver1992",)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("hardness", "Pa", "hardness"),
        Quantity("contact_modulus", "Pa", "reduced modulus of indenter and body"),
        Quantity("contact_depth", "m", "depth of the contact"),
        Quantity("area", "m^2", "area of the contact"),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.contact_depth <= 0.0:
            raise InputError(
                f"depth at peak load must exceed the elastic part {self.depth - self.contact_depth:.4g} m, "
                f"but is {self.depth:.4g} m. Check the unit of the stiffness (N/m)."
            )

    @property
    def contact_depth(self) -> float:
        """h_c in m."""
        return self.depth - self.shape * self.load / self.stiffness

    @property
    def area(self) -> float:
        """A(h_c) in m²."""
        return self.area_factor * self.contact_depth**2

    @property
    def hardness(self) -> float:
        """H in Pa."""
        return self.load / self.area

    @property
    def contact_modulus(self) -> float:
        """E_r in Pa, 1/E_r = (1 - ν1²)/E1 + (1 - ν0²)/E0 with the indenter 0."""
        return 0.5 * math.sqrt(math.pi / self.area) * self.stiffness
