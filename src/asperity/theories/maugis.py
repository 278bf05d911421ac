"""Adhesive sphere between JKR and DMT: constant attraction over a finite range (Maugis 1992)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from .protocol import E_STAR, Input, Limit
from .single_contact import ContactAnswer, bisected, checked, small_slope
from .ways import Column

LENNARD_JONES = 1.157
"""λ/μ_T if the attraction is the largest of a Lennard-Jones surface, 16w/(9√3 z0)."""


_WIDEST, _NARROWEST = 46.0, -46.0  # ln s between which any contact lies


@dataclass(frozen=True, eq=False)
class MaugisState:
    """Contact in units of Maugis: radius (πwR²/K)^(1/3), load πwR, approach (π²w²R/K²)^(1/3), K = 4E*/3.

    ``ring`` is s = sqrt(m² - 1) with the outer radius of the attraction over that of the contact, m = c/a.
    """

    radius: RealArray
    ring: RealArray
    load: RealArray
    approach: RealArray

    @property
    def outer_over_inner(self) -> RealArray:
        """m = c/a."""
        return np.asarray(np.hypot(1.0, self.ring))


def maugis_state(transition: float, contact_radius: ArrayLike) -> MaugisState:
    """Attracting ring, load and approach at the normalised ``contact_radius`` A > 0 (any shape), λ = ``transition`` > 0.

    With m = c/a, s = sqrt(m² - 1), ϑ = arctan s

    (λA²/2)[s + (m² - 2)ϑ] + (4λ²A/3)[sϑ - m + 1] = 1,  P = A³ - λA²[s + m²ϑ],  δ = A² - (4/3)λAs.
    """
    require.positive(transition, "transition parameter")
    A = checked(contact_radius, "normalised contact radius", lowest=np.finfo(float).tiny)
    ends = np.full_like(A, _NARROWEST), np.full_like(A, _WIDEST)
    return maugis_at_ring(transition, np.exp(bisected(lambda y: A - _radius(transition, np.exp(y)), *ends)))


def maugis_at_ring(transition: float, ring: RealArray) -> MaugisState:
    """The same contact from s = ``ring`` > 0 of any shape, without a search."""
    A, theta = _radius(transition, ring), np.arctan(ring)
    load = A**3 - transition * A**2 * (ring + (1.0 + ring**2) * theta)
    return MaugisState(A, ring, load, A**2 - 4.0 / 3.0 * transition * A * ring)


def maugis_pull_off(transition: float) -> MaugisState:
    """The contact of the least load, for λ = ``transition`` > 0: P = -1.5 for JKR, -2 for DMT."""
    require.positive(transition, "transition parameter")
    low, high = -30.0, 30.0
    for _ in range(16):  # each a tenth of the one before
        log_s = np.linspace(low, high, 41)
        best = int(np.argmin(maugis_at_ring(transition, np.exp(log_s)).load))
        low, high = log_s[max(best - 2, 0)], log_s[min(best + 2, 40)]
    return maugis_at_ring(transition, np.exp(log_s[best]))


def _radius(lam: float, s: RealArray) -> RealArray:
    """A > 0 of the first equation, quadratic in A: uA² + 2vA = 1."""
    theta = np.arctan(s)
    u = 0.5 * lam * _ring(s, theta)
    # sϑ - m + 1 with m - 1 = s²/(m + 1)
    v = 2.0 / 3.0 * lam**2 * (s * theta - s**2 / (1.0 + np.hypot(1.0, s)))
    radius: RealArray = 1.0 / (v + np.sqrt(v**2 + u))
    return radius


@dataclass(frozen=True)
class MaugisDugdale:
    """Sphere that attracts with the stress σ0 where the gap is below w/σ0, around a contact that Hertz's pressure lifts.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    radius
        Relative radius of curvature R in m, > 0.
    work
        Work of adhesion w in J/m², > 0.
    attraction
        Stress σ0 in Pa, > 0. The largest of a Lennard-Jones surface is 16w/(9√3 z0).
    """

    E_star: float
    radius: float
    work: float
    attraction: float
    name: ClassVar[str] = "maugis-dugdale"
    title: ClassVar[str] = "Maugis-Dugdale, adhesive sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Maugis1992",)
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("radius", "m", "relative radius of curvature"),
        Input("work", "J/m^2", "work of adhesion"),
        Input("attraction", "Pa", "attractive stress"),
    )
    numbers: ClassVar[tuple[Column, ...]] = (
        Column("pull_off", "N", "force that separates the bodies"),
        Column("transition", "", "parameter λ: DMT for small, JKR for large values"),
    )

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E_star (Pa)")
        require.positive(self.radius, "radius of curvature (m)")
        require.positive(self.work, "work of adhesion (J/m^2)")
        require.positive(self.attraction, "attractive stress (Pa)")

    @property
    def transition(self) -> float:
        """λ = 2σ0 (R/πwK²)^(1/3): DMT for small, JKR for large values."""
        return 2.0 * self.attraction * float(np.cbrt(self.radius / (np.pi * self.work * self._K**2)))

    @property
    def pull_off(self) -> float:
        """Force in N that separates the bodies under dead load."""
        return -float(maugis_pull_off(self.transition).load) * np.pi * self.work * self.radius

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The stable contact under ``load`` in N, not below minus the pull-off force, of any shape.

        Raises
        ------
        InputError
            If a load is below the pull-off force.
        """
        least = maugis_pull_off(self.transition)
        unit = np.pi * self.work * self.radius
        P = checked(load, "load (N)", float(least.load) * unit, "A stronger pull parts the bodies.") / unit
        ends = np.full_like(P, _NARROWEST), np.full_like(P, np.log(least.ring))
        s = np.exp(bisected(lambda y: P - maugis_at_ring(self.transition, np.exp(y)).load, *ends))
        return self._answer(maugis_at_ring(self.transition, s))

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, > 0, of any shape."""
        a = checked(contact_radius, "contact radius (m)")
        return self._answer(maugis_state(self.transition, a / self._unit_radius))

    def _answer(self, state: MaugisState) -> ContactAnswer:
        step = 1e-5
        ends = [maugis_at_ring(self.transition, state.ring * (1.0 + s)) for s in (-step, step)]
        rise = (ends[1].load - ends[0].load) / (ends[1].approach - ends[0].approach)
        unit_load = np.pi * self.work * self.radius
        unit_approach = self._unit_radius**2 / self.radius
        a = state.radius * self._unit_radius
        # (2E*/πR) a of Hertz less the pull of the ring, 2σ0/π arctan s, at the centre
        pull = 2.0 / np.pi * self.attraction * np.arctan(state.ring)
        return ContactAnswer(
            load=state.load * unit_load,
            approach=state.approach * unit_approach,
            radius=a,
            area=np.pi * a**2,
            max_pressure=2.0 / np.pi * self.E_star * a / self.radius - pull,
            stiffness=rise * unit_load / unit_approach,
        )

    def validity(self, answer: ContactAnswer) -> tuple[Limit, ...]:
        """Small slopes."""
        return (small_slope("contact radius over radius of curvature", answer.radius / self.radius),)

    @property
    def _K(self) -> float:
        return 4.0 / 3.0 * self.E_star

    @property
    def _unit_radius(self) -> float:
        return float(np.cbrt(np.pi * self.work * self.radius**2 / self._K))


def _ring(s: RealArray, theta: RealArray) -> RealArray:
    """s + (s² - 1) arctan s; by its series for small s, where the terms cancel to (4/3) s³."""
    small = np.minimum(s, 0.2)
    terms = [(-1.0) ** (k - 1) * (1.0 / (2 * k - 1) + 1.0 / (2 * k + 1)) * small ** (2 * k + 1) for k in range(1, 12)]
    ring: RealArray = np.where(s < 0.2, sum(terms), s + (s**2 - 1.0) * theta)
    return ring
