"""A lying cylinder pressed between two flats, whose approach is defined by the second contact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.values import Length
from ..ask import LINE_LOAD, Way
from ..protocol import CONTACT_RADIUS, Bound, ContactAnswer, Modulus, Theory, checked
from .hertz import HertzLine


@dataclass(frozen=True)
class CompressedCylinder(Theory):
    """Lying cylinder pressed between two rigid flats; P per length, δ how far they approach each
    other.

        δ = 2 P/(π E*) (2 ln(4 R/a) - 1),  a² = 4 P R/(π E*),  1/k = 2/(π E*) (2 ln(4 R/a) - 2).

    What lies beyond is 2 (1 - 2ν) P a/(3 π G R) and less. Between elastic flats a follows from
    the modulus of both, and δ, without the flats' own share, from that of the cylinder.

    Examples
    --------
    >>> roller = CompressedCylinder(E_star=230e9, radius=5e-3)
    >>> answer = roller.at_load(1e6)
    >>> f"{answer.approach * 1e6:.1f} µm, {answer.radius * 1e6:.0f} µm"
    '23.7 µm, 166 µm'
    """

    E_star: Modulus
    radius: Annotated[Length, "radius R of the cylinder"]
    name: ClassVar[str] = "compressed-cylinder"
    title: ClassVar[str] = "Cylinder between two flats"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hertz1882", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = (CONTACT_RADIUS,)
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """Each of the two contacts under ``load`` in N/m, >= 0, of any shape, and the approach of
        the flats (Johnson 1985, sec. 5.6)."""
        P = checked(load, "load per length (N/m)")
        line = HertzLine(self.E_star, self.radius).at_load(P)
        width = np.where(P > 0.0, line.radius, self.radius)
        twice: RealArray = 2.0 * np.log(4.0 * self.radius / width)
        compliance = 2.0 / (np.pi * self.E_star)
        approach = compliance * P * (twice - 1.0)
        stiffness = np.where(P > 0.0, 1.0 / (compliance * (twice - 2.0)), 0.0)
        return ContactAnswer(P, approach, line.radius, line.area, line.max_pressure, stiffness)
