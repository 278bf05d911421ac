"""Criteria for the stickiness of rough surfaces from the moments of their roughness: numbers in,
numbers out."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

from ...core import require
from ...core.quantity import Quantity
from ...core.values import Length, Number, Positive
from ..protocol import Modulus, Theory, Work

PASTEWKA_ROBBINS_LIMIT = math.pi * math.pow(3.0 / 16.0, 2.0 / 3.0)
"""1.029: surfaces whose number is smaller are sticky (Pastewka & Robbins 2014)."""


@dataclass(frozen=True)
class Stickiness:
    """Pastewka and Robbins' number, and the work of adhesion that is left by Persson and Tosatti.

    Attributes
    ----------
    repulsive_diameter
        d_rep = 4 h'/h'' in m, diameter of a contact region.
    number
        (h' Δr/κ ℓ_a) (h' d_rep/4Δr)^(2/3) with ℓ_a = w/E*, κ = 2; sticky below 1.029.
    effective_work
        w - U_el/A in J/m²: energy gained by full contact; negative if there is none.
    """

    repulsive_diameter: float
    number: float
    effective_work: float

    @property
    def share_of_limit(self) -> float:
        """The number over its limit: sticky below 1."""
        return self.number / PASTEWKA_ROBBINS_LIMIT


def stickiness_of(
    slope: float, laplacian: float, full_contact_energy: float, *, E_star: float, work: float, reach: float
) -> Stickiness:
    """Criteria of a surface of isotropic roughness.

    Parameters
    ----------
    slope
        h', rms slope, > 0.
    laplacian
        h'', rms of the Laplacian of the heights in 1/m, > 0.
    full_contact_energy
        U_el/A in J/m², >= 0, elastic energy of full contact over nominal area: (E*/4) ∫ q C d²q of
        a half-space.
    E_star, work, reach
        Contact modulus in Pa, work of adhesion in J/m², range Δr of the attraction in m, >= 0,
        without which the number is zero.

    Raises
    ------
    InputError
        If a number is out of range.
    """
    require.positive(slope, "rms slope")
    require.positive(laplacian, "rms Laplacian (1/m)")
    require.not_negative(full_contact_energy, "elastic energy of full contact (J/m^2)")
    for value, what in ((E_star, "contact modulus (Pa)"), (work, "work of adhesion (J/m^2)")):
        require.positive(value, what)
    require.not_negative(reach, "range (m)")
    diameter = 4.0 * slope / laplacian
    number = slope * E_star / (2.0 * work) * math.pow(slope * diameter / 4.0, 2.0 / 3.0) * math.cbrt(reach)
    return Stickiness(diameter, number, work - full_contact_energy)


@dataclass(frozen=True)
class PastewkaRobbins(Theory):
    """Stickiness of a rough surface from its slope and Laplacian: whether the area of contact would
    grow under no load.

        (h' Δr/κ ℓ_a) (h' d_rep/4Δr)^(2/3) < π (3/16)^(2/3),  ℓ_a = w/E*,  d_rep = 4 h'/h'',  κ = 2.

    Examples
    --------
    >>> rubber = PastewkaRobbins(E_star=1e6, slope=0.1, laplacian=1e6, work=0.05, reach=1e-9)
    >>> f"{rubber.share_of_limit:.2g}: sticky"
    '0.0045: sticky'
    """

    E_star: Modulus
    slope: Annotated[Positive, "rms slope h'"]
    laplacian: Annotated[float, Number("1/m", above=0.0), "rms of the Laplacian of the heights h''"]
    work: Work
    reach: Annotated[Length, "range Δr of the attraction"]
    name: ClassVar[str] = "pastewka-robbins"
    title: ClassVar[str] = "Pastewka-Robbins, stickiness"
    citation_keys: ClassVar[tuple[str, ...]] = ("PastewkaRobbins2014",)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("share_of_limit", "1", "number over its limit: sticky below 1"),
        Quantity("repulsive_diameter", "m", "diameter of a contact region d_rep"),
    )

    @property
    def share_of_limit(self) -> float:
        """The number over its limit."""
        found = stickiness_of(self.slope, self.laplacian, 0.0, E_star=self.E_star, work=self.work, reach=self.reach)
        return found.share_of_limit

    @property
    def repulsive_diameter(self) -> float:
        """d_rep in m."""
        found = stickiness_of(self.slope, self.laplacian, 0.0, E_star=self.E_star, work=self.work, reach=self.reach)
        return found.repulsive_diameter


@dataclass(frozen=True)
class PerssonTosatti(Theory):
    """Work of adhesion that full contact of a rough surface leaves; there is no full contact where
    it is negative.

        w_eff = w - U_el/A,  U_el/A = (E*/4) ∫ q C(q) d²q.

    Examples
    --------
    >>> f"{PerssonTosatti(work=0.05, elastic_energy=0.02).effective_work:.3g} J/m²"
    '0.03 J/m²'
    """

    work: Work
    elastic_energy: Annotated[
        float, Number("J/m^2", least=0.0), "elastic energy of full contact over nominal area, (E*/4) ∫ q C d²q"
    ]
    name: ClassVar[str] = "persson-tosatti"
    title: ClassVar[str] = "Persson-Tosatti, full contact"
    citation_keys: ClassVar[tuple[str, ...]] = ("PerssonTosatti2001",)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("effective_work", "J/m^2", "work of adhesion left by full contact"),
    )

    @property
    def effective_work(self) -> float:
        """w - U_el/A in J/m²."""
        return self.work - self.elastic_energy
