"""Adhesive spheres: Johnson, Kendall and Roberts; Derjaguin, Muller and Toporov; Maugis and
Dugdale."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.quantity import Quantity
from ...core.values import Length, Pressure
from ..ask import BY_CONTACT, Way
from ..protocol import CONTACT_RADIUS, Bound, ContactAnswer, Modulus, Radius, Theory, Work, bisected, checked
from ..single.hertz import hertz_profile

# Adhesive spheres in the two limits: JKR, compliant, and DMT, stiff (Johnson 1971; Derjaguin 1975;
# Tabor 1977).


ADHESION = (
    Quantity("pull_off", "N", "force that separates the bodies"),
    Quantity("tabor", "1", "Tabor's parameter: JKR for large, DMT for small values"),
)
"""Results of adhesive spheres that do not depend on the load."""


def tabor_parameter(E_star: float, radius: float, work: float, spacing: float) -> float:
    """μ_T = (R w²/E*² z0³)^(1/3): elastic stretch of the neck over the equilibrium ``spacing`` z0
    in m; all > 0."""
    for value, what in (
        (radius, "radius (m)"),
        (E_star, "contact modulus E_star (Pa)"),
        (work, "work of adhesion (J/m^2)"),
    ):
        require.positive(value, what)
    return float(np.cbrt(radius * (work / E_star) ** 2) / require.positive(spacing, "equilibrium spacing (m)"))


_ALLOWED = "Adhesion {}; MaugisDugdale allows for that."


@dataclass(frozen=True)
class _AdhesiveSphere(Theory):
    """Base of the two limits of adhesive spheres."""

    E_star: Modulus
    radius: Radius
    work: Work
    spacing: Annotated[Length, "equilibrium spacing"] = 3e-10
    numbers: ClassVar[tuple[Quantity, ...]] = ADHESION

    @property
    def tabor(self) -> float:
        """Tabor's parameter."""
        return tabor_parameter(self.E_star, self.radius, self.work, self.spacing)


@dataclass(frozen=True)
class JKR(_AdhesiveSphere):
    """Sphere with adhesion inside of the contact alone.

        P = K a³/R - sqrt(6 π w K a³),  δ = a²/R - sqrt(2 π w a/E*),  K = (4/3) E*.

    Loads may be negative down to the pull-off force -1.5πwR; approaches down to -δc (fixed grips).

    Examples
    --------
    >>> tip = JKR(E_star=1e6, radius=10e-6, work=0.05)
    >>> f"{tip.pull_off * 1e6:.2f} µN, {tip.at_load(0.0).radius * 1e6:.2f} µm without load"
    '2.36 µN, 4.13 µm without load'
    """

    name: ClassVar[str] = "jkr"
    title: ClassVar[str] = "JKR, adhesive sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1971", "Tabor1977")
    limits: ClassVar[tuple[Bound, ...]] = (
        Bound(
            "Tabor's parameter",
            lambda theory, answer: theory.tabor,
            5.0,
            math.inf,
            "Tabor1977",
            _ALLOWED.format("reaches beyond the contact"),
        ),
        CONTACT_RADIUS,
    )

    @property
    def pull_off(self) -> float:
        """Pc = 1.5πwR in N, the force that separates the bodies under dead load."""
        return 1.5 * np.pi * self.work * self.radius

    @property
    def critical_radius(self) -> float:
        """ac in m at which the contact breaks with fixed grips: ac³ = πwR²/8E*."""
        return float(np.cbrt(np.pi * self.work * self.radius**2 / (8.0 * self.E_star)))

    @property
    def critical_extension(self) -> float:
        """δc = (3/4)(π²w²R/E*²)^(1/3) in m, the extension at which the contact breaks with fixed
        grips."""
        return 0.75 * float(np.cbrt((np.pi * self.work / self.E_star) ** 2 * self.radius))

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The stable contact under ``load`` in N, >= -1.5πwR, of any shape.

        InputError if a load is below the pull-off force.
        """
        P = checked(load, "load (N)", -self.pull_off, "A larger tensile force separates the bodies.")
        adhesive = 2.0 * self.pull_off  # 3πwR
        # the root vanishes at pull-off, where rounding may make it negative
        root = np.sqrt(np.maximum(adhesive * (adhesive + 2.0 * P), 0.0))
        return self.at_radius(np.cbrt(0.75 * self.radius / self.E_star * (P + adhesive + root)))

    def at_approach(self, approach: ArrayLike) -> ContactAnswer:
        """The stable contact with fixed grips at the ``approach`` δ in m, >= -δc, of any shape."""
        delta = (
            checked(approach, "approach (m)", -self.critical_extension, "Further apart there is no contact.")
            / self.critical_extension
        )
        return self.at_radius(self.critical_radius * contact_ratio(delta))

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, >= 0, of any shape: stable under dead load
        where dP/dδ > 0."""
        a = checked(contact_radius, "contact radius (m)")
        x = a / self.critical_radius
        with np.errstate(divide="ignore", invalid="ignore"):
            slope = (np.sqrt(x) * x - 3.0) / (np.sqrt(x) * x - 1.0)  # dP/dδ = 2E*a (x^1.5 - 3)/(x^1.5 - 1)
            pull = np.sqrt(2.0 * self.E_star * self.work / (np.pi * a))
        return ContactAnswer(
            load=self.pull_off * load_ratio(x),
            approach=self.critical_extension * approach_ratio(x),
            radius=a,
            area=np.pi * a**2,
            max_pressure=2.0 / np.pi * self.E_star * a / self.radius - pull,
            stiffness=2.0 * self.E_star * a * slope,
        )

    def pressure(self, r: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``r`` in m (any shape) from the axis, negative where it
        pulls.

        (2E*/πR) sqrt(a² - r²) - sqrt(2E*w/πa)/sqrt(1 - r²/a²), minus infinity at the edge.
        """
        a = float(self.at_load(load).radius)
        s = np.sqrt(np.maximum(1.0 - (np.asarray(r, dtype=float) / a) ** 2, 0.0))
        pull = np.sqrt(2.0 * self.E_star * self.work / (np.pi * a))
        with np.errstate(divide="ignore"):
            inside = 2.0 / np.pi * self.E_star * a / self.radius * s - pull / s
        return np.where(np.abs(np.asarray(r)) <= a, inside, 0.0)


def load_ratio(x: RealArray) -> RealArray:
    """P/Pc of JKR at x = a/ac: (x³/6 - x^(3/2))/1.5."""
    return (x**3 / 6.0 - x * np.sqrt(x)) / 1.5


def approach_ratio(x: RealArray) -> RealArray:
    """δ/δc of JKR at x = a/ac: (x² - 4 sqrt(x))/3."""
    return (x**2 - 4.0 * np.sqrt(x)) / 3.0


def contact_ratio(approach: ArrayLike) -> RealArray:
    """a/ac >= 1 of JKR at δ/δc = ``approach`` >= -1 of any shape: the branch that is stable with
    fixed grips.

    Largest root of y⁴ - 4y - 3δ = 0, y² = a/ac, by Ferrari's resolvent u³ + 12δu - 16 = 0 and a
    step of Newton's method.
    """
    delta = np.asarray(approach, dtype=float)
    v = np.cbrt(1.0 + np.sqrt(np.maximum(1.0 + delta**3, 0.0)))
    u = 2.0 * (v - delta / v)
    for _ in range(2):  # the difference loses digits for large δ
        u = u - (u**3 + 12.0 * delta * u - 16.0) / np.maximum(3.0 * u**2 + 12.0 * delta, 1.0)
    y = 0.5 * (np.sqrt(u) + np.sqrt(np.maximum(8.0 / np.sqrt(u) - u, 0.0)))
    slope = 4.0 * (y**3 - 1.0)  # nothing where the contact breaks
    step = np.divide(y**4 - 4.0 * y - 3.0 * delta, slope, out=np.zeros_like(y), where=slope > 1e-3)
    return np.asarray((y - step) ** 2)


@dataclass(frozen=True)
class DMT(_AdhesiveSphere):
    """Sphere with adhesion outside of a Hertz contact.

    P = K a³/R - 2 π w R,  δ = a²/R,  K = (4/3) E*.
    """

    name: ClassVar[str] = "dmt"
    title: ClassVar[str] = "DMT, adhesive sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Derjaguin1975", "Tabor1977")
    limits: ClassVar[tuple[Bound, ...]] = (
        Bound(
            "Tabor's parameter",
            lambda theory, answer: theory.tabor,
            0.0,
            0.1,
            "Tabor1977",
            _ALLOWED.format("deforms the bodies around the contact"),
        ),
        CONTACT_RADIUS,
    )

    @property
    def pull_off(self) -> float:
        """Pc = 2πwR in N."""
        return 2.0 * np.pi * self.work * self.radius

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= -2πwR, of any shape; ``max_pressure`` is that of the
        contact, p0.

        InputError if a load is below the pull-off force.
        """
        P = checked(load, "load (N)", -self.pull_off, "A larger tensile force separates the bodies.")
        return self.at_radius(np.cbrt(0.75 * self.radius / self.E_star * (P + self.pull_off)))

    def at_approach(self, approach: ArrayLike) -> ContactAnswer:
        """The contact with fixed grips at the ``approach`` δ in m, >= 0, of any shape: that of
        Hertz.

        InputError if an approach is negative: apart from each other the bodies attract, but do not
        touch.
        """
        return self.at_radius(np.sqrt(self.radius * checked(approach, "approach (m)")))

    def at_radius(self, contact_radius: ArrayLike) -> ContactAnswer:
        """The contact of the ``contact_radius`` a in m, >= 0, of any shape."""
        a = checked(contact_radius, "contact radius (m)")
        return ContactAnswer(
            load=4.0 / 3.0 * self.E_star * a**3 / self.radius - self.pull_off,
            approach=a**2 / self.radius,
            radius=a,
            area=np.pi * a**2,
            max_pressure=2.0 / np.pi * self.E_star * a / self.radius,
            stiffness=2.0 * self.E_star * a,
        )

    def pressure(self, r: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa inside of the contact at the distance ``r`` in m (any shape): that of
        Hertz at P + 2πwR."""
        return hertz_profile(np.asarray(r, dtype=float), self.at_load(load))


# Adhesive sphere between JKR and DMT: constant attraction over a finite range (Maugis 1992).


LENNARD_JONES = 1.157
"""λ/μ_T if the attraction is the largest of a Lennard-Jones surface, 16w/(9√3 z0)."""


_WIDEST, _NARROWEST = 46.0, -46.0  # ln s between which any contact lies


@dataclass(frozen=True, eq=False)
class MaugisState:
    """Contact in units of Maugis: radius (πwR²/K)^(1/3), load πwR, approach (π²w²R/K²)^(1/3), K =
    4E*/3.

    ``ring`` is s = sqrt(m² - 1) with the outer radius of the attraction over that of the contact,
    m = c/a.
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
    """Attracting ring, load and approach at the normalised ``contact_radius`` A > 0 (any shape),
    λ = ``transition`` > 0.

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
    return _least(transition, lambda state: state.load)


def maugis_fold(transition: float) -> MaugisState:
    """The contact of the least approach, for λ = ``transition`` > 0, below which rigid grips hold
    no contact.

    Up to λ = 0.94 the contact shrinks to a point there, and the bodies go on attracting each other.
    """
    return _least(transition, lambda state: state.approach)


def _least(transition: float, quantity: Callable[[MaugisState], RealArray]) -> MaugisState:
    """The contact with the least value of a ``quantity``."""
    require.positive(transition, "transition parameter")
    low, high = -30.0, 30.0
    for _ in range(16):  # each a tenth of the one before
        log_s = np.linspace(low, high, 41)
        best = int(np.argmin(quantity(maugis_at_ring(transition, np.exp(log_s)))))
        low, high = log_s[max(best - 2, 0)], log_s[min(best + 2, 40)]
    return maugis_at_ring(transition, np.exp(log_s[best]))


def _radius(lam: float, s: RealArray) -> RealArray:
    """A > 0 of the first equation, quadratic in A: uA² + 2vA = 1."""
    theta = np.arctan(s)
    # s + (s² - 1) arctan s; by its series for small s, where the terms cancel to (4/3) s³
    small = np.minimum(s, 0.2)
    terms = [(-1.0) ** (k - 1) * (1.0 / (2 * k - 1) + 1.0 / (2 * k + 1)) * small ** (2 * k + 1) for k in range(1, 12)]
    u = 0.5 * lam * np.where(s < 0.2, sum(terms), s + (s**2 - 1.0) * theta)
    # sϑ - m + 1 with m - 1 = s²/(m + 1)
    v = 2.0 / 3.0 * lam**2 * (s * theta - s**2 / (1.0 + np.hypot(1.0, s)))
    return 1.0 / (v + np.sqrt(v**2 + u))


@dataclass(frozen=True, eq=False)
class MaugisAnswer(ContactAnswer):
    """Contacts with the ``outer_radius`` c in m of the attraction around them."""

    outer_radius: RealArray


_OUTER = Quantity("outer_radius", "m", "outer radius of the attraction around the contact")


@dataclass(frozen=True)
class MaugisDugdale(Theory):
    """Sphere that attracts with the stress σ0 where the gap is below w/σ0, around a contact that
    Hertz's pressure lifts.

    In Maugis' units of radius, (πwR²/K)^(1/3), load, πwR, and approach, (π²w²R/K²)^(1/3), K =
    4E*/3, with m = c/a the outer over the inner radius of the attraction, s = sqrt(m² - 1) and θ =
    arctan s,

        (λ A²/2) [s + (m² - 2) θ] + (4 λ² A/3) [s θ - m + 1] = 1,  λ = 2 σ_0 (R/(π w K²))^(1/3),
        P = A³ - λ A² [s + m² θ],  δ = A² - (4/3) λ A s.
    """

    E_star: Modulus
    radius: Radius
    work: Work
    attraction: Annotated[Pressure, "stress σ0. The largest of a Lennard-Jones surface is 16w/(9√3 z0)"]
    name: ClassVar[str] = "maugis-dugdale"
    title: ClassVar[str] = "Maugis-Dugdale, adhesive sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Maugis1992",)
    limits: ClassVar[tuple[Bound, ...]] = (CONTACT_RADIUS,)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("pull_off", "N", "force that separates the bodies"),
        Quantity("transition", "1", "parameter λ: DMT for small, JKR for large values"),
    )
    ways: ClassVar[tuple[Way, ...]] = tuple(replace(way, columns=(*way.columns, _OUTER)) for way in BY_CONTACT)

    @property
    def transition(self) -> float:
        """λ = 2σ0 (R/πwK²)^(1/3): DMT for small, JKR for large values."""
        return (
            2.0 * self.attraction * float(np.cbrt(self.radius / (np.pi * self.work * (4.0 / 3.0 * self.E_star) ** 2)))
        )

    @property
    def pull_off(self) -> float:
        """Force in N that separates the bodies under dead load."""
        return -float(maugis_pull_off(self.transition).load) * np.pi * self.work * self.radius

    def at_load(self, load: ArrayLike) -> MaugisAnswer:
        """The stable contact under ``load`` in N, not below minus the pull-off force, of any shape.

        InputError if a load is below the pull-off force.
        """
        least = maugis_pull_off(self.transition)
        unit = np.pi * self.work * self.radius
        P = checked(load, "load (N)", float(least.load) * unit, "A larger tensile force separates the bodies.") / unit
        ends = np.full_like(P, _NARROWEST), np.full_like(P, np.log(least.ring))
        s = np.exp(bisected(lambda y: P - maugis_at_ring(self.transition, np.exp(y)).load, *ends))
        return self._answer(maugis_at_ring(self.transition, s))

    def at_approach(self, approach: ArrayLike) -> MaugisAnswer:
        """The stable contact with fixed grips at the ``approach`` δ in m of any shape; negative
        down to where it breaks.

        InputError if an approach is below that: from λ = 0.94 on the contact jumps off there, else
        it has shrunk to a point.
        """
        least, unit = maugis_fold(self.transition), self._unit_radius**2 / self.radius
        delta = (
            checked(approach, "approach (m)", float(least.approach) * unit, "Further apart there is no contact.") / unit
        )
        ends = np.full_like(delta, _NARROWEST), np.full_like(delta, np.log(least.ring))
        s = np.exp(bisected(lambda y: delta - maugis_at_ring(self.transition, np.exp(y)).approach, *ends))
        return self._answer(maugis_at_ring(self.transition, s))

    def at_radius(self, contact_radius: ArrayLike) -> MaugisAnswer:
        """The contact of the ``contact_radius`` a in m, > 0, of any shape."""
        a = checked(contact_radius, "contact radius (m)")
        return self._answer(maugis_state(self.transition, a / self._unit_radius))

    def _answer(self, state: MaugisState) -> MaugisAnswer:
        step = 1e-5
        ends = [maugis_at_ring(self.transition, state.ring * (1.0 + s)) for s in (-step, step)]
        rise = (ends[1].load - ends[0].load) / (ends[1].approach - ends[0].approach)
        unit_load = np.pi * self.work * self.radius
        unit_approach = self._unit_radius**2 / self.radius
        a = state.radius * self._unit_radius
        # (2E*/πR) a of Hertz less the pull of the ring, 2σ0/π arctan s, at the centre
        pull = 2.0 / np.pi * self.attraction * np.arctan(state.ring)
        return MaugisAnswer(
            load=state.load * unit_load,
            approach=state.approach * unit_approach,
            radius=a,
            area=np.pi * a**2,
            max_pressure=2.0 / np.pi * self.E_star * a / self.radius - pull,
            stiffness=rise * unit_load / unit_approach,
            outer_radius=a * state.outer_over_inner,
        )

    @property
    def _unit_radius(self) -> float:
        return float(np.cbrt(np.pi * self.work * self.radius**2 / (4.0 / 3.0 * self.E_star)))
