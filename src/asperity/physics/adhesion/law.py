"""Adhesion laws: the attraction σ(g) of two surfaces at the gap g, its energy and its slope.

The energy φ(g) = -∫_g^∞ σ dg' is that per area, J/m², so that φ' = σ; the work of adhesion w is -φ
at the smallest gap of equilibrium: zero at a hard wall, the spacing z0 of a law with a repulsive
core. σ > 0 attracts.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Protocol, Self, runtime_checkable

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError


@runtime_checkable
class Adhesion(Protocol):
    """Attraction of two surfaces; all methods take gaps of any shape in m, >= 0 (> 0 for a law with
    a core)."""

    @property
    def name(self) -> str:
        """Name for reports and documents."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the law rests on."""

    @property
    def work(self) -> float:
        """Work of adhesion w in J/m²."""

    @property
    def strength(self) -> float:
        """Largest attraction σ0 in Pa."""

    @property
    def range(self) -> float:
        """ϱ = w/σ0 in m."""

    @property
    def steepest(self) -> float:
        """Largest fall of the attraction with the gap, max(-σ') in Pa/m."""

    @property
    def spacing(self) -> float:
        """Gap in m at which the attraction is zero and below which the surfaces repel; zero for a
        law beside a hard wall."""

    def attraction(self, gap: RealArray) -> RealArray:
        """σ in Pa."""

    def slope(self, gap: RealArray) -> RealArray:
        """σ' in Pa/m."""

    def energy(self, gap: RealArray) -> RealArray:
        """φ in J/m², <= 0 beside a hard wall."""


@runtime_checkable
class SoftAdhesion(Adhesion, Protocol):
    """Attraction with a core that repels below the ``spacing``, which stands for the wall."""

    @property
    def peak(self) -> float:
        """Gap in m of the largest attraction, nearer than which the surfaces count as touching."""


class _BesideWall:
    """What laws of a work and a range have in common: ϱ = w/σ0, a hard wall at no gap."""

    work: float
    range: float
    spacing: ClassVar[float] = 0.0

    def __post_init__(self) -> None:
        require.magnitude(self.work, "work of adhesion (J/m^2)")
        require.positive(self.range, "range of the adhesion (m)", "It is the work of adhesion over the largest stress.")
        require.magnitude(self.range, "range of the adhesion (m)")

    @property
    def strength(self) -> float:
        """Largest attraction σ0 = w/ϱ in Pa."""
        return self.work / self.range

    @classmethod
    def of_strength(cls, work: float, strength: float) -> Self:
        """Law with this work of adhesion (J/m²) and largest attraction (Pa), both > 0; InputError
        if one is not."""
        require.magnitude(strength, "strength of the adhesion (Pa)")
        return cls(work, require.magnitude(work, "work of adhesion (J/m^2)") / strength)  # type: ignore[call-arg]


DUGDALE_SMOOTHING = 0.2
"""Usual share of the range over which the attraction of Dugdale's law falls: a step takes seven
times as many pixels (``couplings.adhesion``)."""


@dataclass(frozen=True)
class DugdaleAdhesion(_BesideWall):
    """σ = σ0 for g < ϱ, else 0, with σ0 = w/ϱ (Maugis 1992).

    Parameters
    ----------
    work
        Work of adhesion w in J/m², > 0.
    range
        ϱ in m, > 0, beyond which there is no attraction.
    smoothing
        Share ε of the range, from 0 to 2, over which the attraction falls to zero, from ϱ(1 - ε/2)
        to ϱ(1 + ε/2), with the same work; 0.2 by default. A step, zero, makes the zone advance
        pixel by pixel on a grid: it takes seven times as many pixels for a pull-off to 1e-2.
    """

    work: float
    range: float
    smoothing: float = DUGDALE_SMOOTHING
    name: ClassVar[str] = "Dugdale"
    citation_keys: ClassVar[tuple[str, ...]] = ("Maugis1992",)

    def __post_init__(self) -> None:
        super().__post_init__()
        if not 0.0 <= self.smoothing <= 2.0:
            raise InputError(f"smoothing of Dugdale's law must be from 0 to 2, but is {self.smoothing:g}.")

    @property
    def steepest(self) -> float:
        """σ0/(εϱ) in Pa/m: infinity for a step."""
        return self.strength / (self.smoothing * self.range) if self.smoothing else math.inf

    def _left(self, gap: RealArray) -> RealArray:
        """Share of σ0 where the attraction falls, 1 before and 0 behind."""
        if not self.smoothing:
            return np.where(gap < self.range, 1.0, 0.0)
        return np.asarray(np.clip((1.0 + 0.5 * self.smoothing - gap / self.range) / self.smoothing, 0.0, 1.0))

    def attraction(self, gap: RealArray) -> RealArray:
        """σ in Pa."""
        return self.strength * self._left(gap)

    def slope(self, gap: RealArray) -> RealArray:
        """σ' in Pa/m, zero but where the attraction falls."""
        if not self.smoothing:
            return np.zeros_like(gap)
        falls = np.abs(gap / self.range - 1.0) < 0.5 * self.smoothing
        return np.where(falls, -self.steepest, 0.0)

    def energy(self, gap: RealArray) -> RealArray:
        """φ in J/m²: -σ0 (ϱ - g) before the fall."""
        before = np.maximum(1.0 - 0.5 * self.smoothing - gap / self.range, 0.0)
        left = self._left(gap)
        within = left * left if self.smoothing else np.zeros_like(left)
        return np.asarray(-self.work * (before + 0.5 * self.smoothing * within))


@dataclass(frozen=True)
class LinearAdhesion(_BesideWall):
    """σ = σ0 (1 - g/2ϱ) for g < 2ϱ, else 0, with σ0 = w/ϱ: linear softening.

    Parameters
    ----------
    work
        Work of adhesion w in J/m², > 0.
    range
        ϱ in m, > 0; the attraction ends at twice as much.
    """

    work: float
    range: float
    name: ClassVar[str] = "linear"
    citation_keys: ClassVar[tuple[str, ...]] = ("Maugis1992",)

    @property
    def steepest(self) -> float:
        """σ0/2ϱ in Pa/m."""
        return 0.5 * self.strength / self.range

    def attraction(self, gap: RealArray) -> RealArray:
        """σ in Pa."""
        return np.asarray(self.strength * np.maximum(1.0 - 0.5 * gap / self.range, 0.0))

    def slope(self, gap: RealArray) -> RealArray:
        """σ' in Pa/m."""
        return np.where(gap < 2.0 * self.range, -self.steepest, 0.0)

    def energy(self, gap: RealArray) -> RealArray:
        """φ = -w (1 - g/2ϱ)² within twice the range, in J/m²."""
        return np.asarray(-self.work * np.maximum(1.0 - 0.5 * gap / self.range, 0.0) ** 2)


@dataclass(frozen=True)
class ExponentialAdhesion(_BesideWall):
    """σ = (w/ϱ) exp(-g/ϱ): smooth, falls and curves up everywhere (Rey, Anciaux & Molinari 2017).

    Parameters
    ----------
    work
        Work of adhesion w in J/m², > 0.
    range
        ϱ in m, > 0.

    Examples
    --------
    >>> law = ExponentialAdhesion(work=0.05, range=1e-9)
    >>> float(law.attraction(np.array(0.0))), float(law.energy(np.array(0.0)))
    (50000000.0, -0.05)
    """

    work: float
    range: float
    name: ClassVar[str] = "exponential"
    citation_keys: ClassVar[tuple[str, ...]] = ("Rey2017",)

    @property
    def steepest(self) -> float:
        """σ0/ϱ in Pa/m."""
        return self.strength / self.range

    def attraction(self, gap: RealArray) -> RealArray:
        """σ in Pa."""
        return np.asarray(self.strength * np.exp(-gap / self.range))

    def slope(self, gap: RealArray) -> RealArray:
        """σ' in Pa/m."""
        return np.asarray(-self.steepest * np.exp(-gap / self.range))

    def energy(self, gap: RealArray) -> RealArray:
        """φ = -w exp(-g/ϱ) in J/m²."""
        return np.asarray(-self.work * np.exp(-gap / self.range))


@dataclass(frozen=True)
class VanDerWaalsAdhesion:
    """σ = A/(6π (D0 + g)³) beside a hard wall, so that w = A/(12π D0²) (Israelachvili 2011, ch.
    13).

    Parameters
    ----------
    work
        Work of adhesion w in J/m², > 0.
    spacing_at_contact
        D0 in m, > 0: distance of the atomic planes where the gap is zero.
    reach
        Distance D0 + g in m from which on there is no attraction, more than D0: σ is lowered by its
        value there, so that it ends continuously, and all of it raised to keep w. Infinite by
        default.
    """

    work: float
    spacing_at_contact: float = 0.165e-9
    reach: float = math.inf
    name: ClassVar[str] = "van der Waals"
    citation_keys: ClassVar[tuple[str, ...]] = ("Israelachvili2011",)
    spacing: ClassVar[float] = 0.0

    def __post_init__(self) -> None:
        require.magnitude(self.work, "work of adhesion (J/m^2)")
        require.magnitude(self.spacing_at_contact, "spacing at contact (m)")
        if not self.reach > self.spacing_at_contact:
            raise InputError(
                "reach of the adhesion (m) must be more than the spacing at contact "
                f"{self.spacing_at_contact:g}, but is {self.reach:g}."
            )

    @classmethod
    def of_hamaker(cls, constant: float, spacing_at_contact: float = 0.165e-9, reach: float = math.inf) -> Self:
        """Law of the Hamaker ``constant`` A in J, > 0; w = A/(12π D0²). InputError if it is not
        positive."""
        require.positive(constant, "Hamaker constant (J)")
        require.positive(spacing_at_contact, "spacing at contact (m)")
        return cls(constant / (12.0 * math.pi * spacing_at_contact**2), spacing_at_contact, reach)

    @property
    def hamaker(self) -> float:
        """A = 12π w D0² in J of the law without a reach."""
        return 12.0 * math.pi * self.work * self.spacing_at_contact**2

    @property
    def range(self) -> float:
        """ϱ = w/σ0 in m; D0/2 without a reach."""
        return self.work / self.strength

    @property
    def strength(self) -> float:
        """Largest attraction σ0, 2w/D0 without a reach, in Pa."""
        return float(self.attraction(np.zeros(())))

    @property
    def steepest(self) -> float:
        """6w/D0² in Pa/m, raised as all of it."""
        return self._raised * 6.0 * self.work / self.spacing_at_contact**2

    @property
    def _cut(self) -> float:
        return self.spacing_at_contact / self.reach

    @property
    def _raised(self) -> float:
        """1/((1 - c)² (1 + 2c)) with c = D0/reach; 1/0.84375 for a reach of 4 D0."""
        return 1.0 / ((1.0 - self._cut) ** 2 * (1.0 + 2.0 * self._cut))

    def attraction(self, gap: RealArray) -> RealArray:
        """σ in Pa."""
        x = self.spacing_at_contact / (self.spacing_at_contact + gap)
        unit = self._raised * 2.0 * self.work / self.spacing_at_contact
        return np.asarray(unit * np.maximum(x**3 - self._cut**3, 0.0))

    def slope(self, gap: RealArray) -> RealArray:
        """σ' in Pa/m."""
        x = self.spacing_at_contact / (self.spacing_at_contact + gap)
        return np.where(x > self._cut, -self.steepest * x**4, 0.0)

    def energy(self, gap: RealArray) -> RealArray:
        """φ in J/m²."""
        x, c = self.spacing_at_contact / (self.spacing_at_contact + gap), self._cut
        return np.asarray(-self._raised * self.work * np.maximum(x - c, 0.0) ** 2 * (1.0 + 2.0 * c / x))


@dataclass(frozen=True)
class LennardJonesAdhesion:
    """σ = (8w/3z0) [(z0/g)³ - (z0/g)⁹]: two half-spaces of Lennard-Jones' atoms; no wall, the
    repulsion is in the law.

    In a contact approaches count from where the undeformed surfaces are z0 apart, and points nearer
    than the gap of the largest attraction as touching, under the wall pressure σ0 - σ(g); the net
    traction is that less the attraction, as with other laws.

    Parameters
    ----------
    work
        Work of adhesion w in J/m², > 0.
    equilibrium
        z0 in m, > 0: gap at which two flats neither attract nor repel.
    """

    work: float
    equilibrium: float
    name: ClassVar[str] = "Lennard-Jones 3-9"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood1997",)

    def __post_init__(self) -> None:
        require.magnitude(self.work, "work of adhesion (J/m^2)")
        require.magnitude(self.equilibrium, "equilibrium gap (m)")

    @property
    def spacing(self) -> float:
        """z0 in m."""
        return self.equilibrium

    @property
    def peak(self) -> float:
        """3^(1/6) z0 in m."""
        return math.pow(3.0, 1.0 / 6.0) * self.equilibrium

    @property
    def range(self) -> float:
        """ϱ = w/σ0 = 9√3 z0/16 in m."""
        return self.work / self.strength

    @property
    def strength(self) -> float:
        """σ0 = 16w/(9√3 z0) in Pa, at 3^(1/6) z0."""
        return 16.0 * self.work / (9.0 * math.sqrt(3.0) * self.equilibrium)

    @property
    def steepest(self) -> float:
        """-σ' in Pa/m at 7.5^(1/6) z0 + ..., where σ'' = 0: g = (90/12)^(1/6) z0."""
        return -float(self.slope(np.asarray(7.5 ** (1.0 / 6.0) * self.equilibrium)))

    def attraction(self, gap: RealArray) -> RealArray:
        """σ in Pa."""
        x = self.equilibrium / gap
        return 8.0 * self.work / (3.0 * self.equilibrium) * (x**3 - x**9)

    def slope(self, gap: RealArray) -> RealArray:
        """σ' in Pa/m."""
        x = self.equilibrium / gap
        return 8.0 * self.work / self.equilibrium**2 * (3.0 * x**10 - x**4)

    def energy(self, gap: RealArray) -> RealArray:
        """φ = -(4w/3) [(z0/g)² - (z0/g)⁸/4] in J/m²."""
        x = self.equilibrium / gap
        return -4.0 / 3.0 * self.work * (x**2 - 0.25 * x**8)


Curve = Callable[[RealArray], RealArray]


@dataclass(frozen=True)
class CustomAdhesion:
    """A law of one's own: σ(g) with its energy and its slope, beside a hard wall, or with a core
    that repels.

    Beside a wall σ >= 0 does not rise with the gap. With an ``equilibrium`` σ is negative nearer
    than that, rises to its largest value and falls from there on.

    Parameters
    ----------
    of_gap
        σ in Pa of gaps (any shape) in m.
    energy_of_gap
        φ in J/m² of gaps in m: φ' = σ, and zero far away.
    slope_of_gap
        σ' in Pa/m of gaps in m.
    far
        Gap in m, > 0, beyond which the attraction is negligible; up to there the three functions
        are checked.
    equilibrium
        Gap z0 in m at which a law with a core has no traction; zero, the default, for a law beside
        a wall. A law with a core is checked from z0/2 on.

    Raises
    ------
    InputError
        If σ does not have that form, or the energy or the slope do not belong to it.
    """

    of_gap: Curve
    energy_of_gap: Curve
    slope_of_gap: Curve
    far: float
    equilibrium: float = 0.0
    name: ClassVar[str] = "own law"
    citation_keys: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self) -> None:
        require.not_negative(self.equilibrium, "equilibrium gap (m)")
        if not require.positive(self.far, "far gap of the adhesion (m)") > self.equilibrium:
            raise InputError(
                f"far gap of the adhesion (m) must be more than the equilibrium gap {self.equilibrium:g}, but "
                f"is {self.far:g}."
            )
        g = self._gaps
        s, phi, fall = self.attraction(g), self.energy(g), self.slope(g)
        if self.equilibrium > 0.0:
            most, at = float(s.max()), int(np.argmax(s))
            crossing = abs(float(self.attraction(np.array([self.equilibrium]))[0])) <= 1e-9 * most
            if not (
                np.isfinite(s).all()
                and most > 0.0
                and crossing
                and (s[g < self.equilibrium * (1.0 - 1e-9)] < 0.0).all()
                and (np.diff(s[: at + 1]) > 0.0).all()
                and np.diff(s[at:]).max(initial=0.0) <= 1e-9 * most
                and s[-1] >= 0.0
            ):
                raise InputError(
                    "attraction of an adhesion law with a core must be finite, negative below the equilibrium "
                    f"gap {self.equilibrium:g} m, zero there, and rise to one largest value from which it "
                    f"falls, but its values from {s.min():g} to {s.max():g} Pa are not so. See "
                    "LennardJonesAdhesion(...)."
                )
        elif not (np.isfinite(s).all() and s.min() >= 0.0 and np.diff(s).max() <= 1e-9 * s[0] and s[0] > 0.0):
            raise InputError(
                "attraction of an adhesion law must be finite, not negative and not rise with the gap, but "
                f"its values from {s.min():g} to {s.max():g} Pa are not so. Give the equilibrium gap for a "
                "core that repels."
            )
        for values, rate, what in ((phi, s, "energy"), (s, fall, "slope")):
            step = np.diff(g)
            miss = np.abs(np.diff(values) - 0.5 * step * (rate[1:] + rate[:-1]))
            # a trapezium misses by the second difference of the rate; kinks lie in one interval
            # each, extrema between two
            turns = np.abs(np.diff(rate))
            if self.equilibrium > 0.0:
                turns = np.maximum(turns, np.maximum(np.roll(turns, 1), np.roll(turns, -1)))
            allowed = 0.5 * step * turns + 1e-9 * np.abs(values).max()
            if not (miss <= allowed).all():
                where = g[int(np.argmax(miss - allowed))]
                raise InputError(
                    f"{what} of an adhesion law must belong to its attraction, but at the gap {where:.4g} m it "
                    "does not: φ' = σ, and slope σ'."
                )

    @property
    def _gaps(self) -> RealArray:
        return np.linspace(0.5 * self.equilibrium, self.far, 4001 if self.equilibrium == 0.0 else 40001)

    @property
    def spacing(self) -> float:
        """z0 in m."""
        return self.equilibrium

    @cached_property
    def peak(self) -> float:
        """Gap in m of the largest attraction."""
        if self.equilibrium == 0.0:
            return 0.0
        from scipy.optimize import brentq

        g = self._gaps
        at = int(np.argmax(self.attraction(g)))
        ends = float(g[max(at - 1, 0)]), float(g[min(at + 1, g.size - 1)])
        slopes = [float(self.slope(np.array([end]))[0]) for end in ends]
        if not slopes[0] > 0.0 > slopes[1]:
            return float(g[at])
        return float(brentq(lambda gap: float(self.slope(np.array([gap]))[0]), *ends, xtol=1e-12 * ends[1]))

    @property
    def work(self) -> float:
        """w = -φ at no gap, or at z0, in J/m²."""
        return -float(self.energy(np.array([self.equilibrium]))[0])

    @property
    def range(self) -> float:
        """ϱ = w/σ0 in m."""
        return self.work / self.strength

    @property
    def strength(self) -> float:
        """Largest σ in Pa, beside a wall σ(0)."""
        return float(self.attraction(np.array([self.peak]))[0])

    @property
    def steepest(self) -> float:
        """max(-σ') in Pa/m up to the far gap."""
        return float(-self.slope(np.geomspace(self.peak, self.far, 4001) if self.peak else self._gaps).min())

    def attraction(self, gap: RealArray) -> RealArray:
        """σ in Pa."""
        return np.asarray(self.of_gap(gap), dtype=float)

    def slope(self, gap: RealArray) -> RealArray:
        """σ' in Pa/m."""
        return np.asarray(self.slope_of_gap(gap), dtype=float)

    def energy(self, gap: RealArray) -> RealArray:
        """φ in J/m²."""
        return np.asarray(self.energy_of_gap(gap), dtype=float)


def cohesive_length(law: Adhesion, E_star: float) -> float:
    """ℓ = E* w/σ0² in m: the attracting zone around a contact is about as wide; a grid must resolve
    it.

    InputError if ``E_star`` (Pa) is not positive.
    """
    return require.positive(E_star, "contact modulus E_star (Pa)") * law.work / law.strength**2
