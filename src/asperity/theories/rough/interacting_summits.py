"""Spherical summits of a map that press each other down, and contacts that merge as they touch."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Annotated, ClassVar, Literal, Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import BoolArray, RealArray
from ...core.parameters import Help
from ...core.scipy_parts import optimize
from ...core.values import Number, Several
from ..protocol import (
    BLUNT_SUMMITS,
    FEW_CONTACTS,
    Bound,
    Modulus,
    Prediction,
    Theory,
    curve,
    highest_first,
)
from ..statistics.roughness import Roughness
from .interacting_crests import CrestSystem, InteractingCrests, settled, solve_complementarity

# Hertz contacts on the summits of a map, each of its own radius, that displace each other: the
# system of interacting crests with paraboloids and the displacement by the pressure of Hertz, in
# place of that by a point force, also inside a contact (Johnson 1985).


_NEAR = 0.02
"""Contact radius over distance below which the displacement is a series, whose next term is 1e-12
of it there, as the rounding of the closed form."""


def hertz_displacement(w: RealArray, radius: RealArray, distance: RealArray) -> RealArray:
    """Displacement u in m of the surface at the ``distance`` (…, n) in m from Hertz contacts of
    squared radii ``w`` (n,) in m² on summits of the ``radius`` (n,) in m.

        u = (1/(π R)) [(2 a² - r²) arcsin(a/r) + a sqrt(r² - a²)]  (r > a),
        u = (a² - r²/2)/R  (r ≤ a).
    """
    a, outside = np.sqrt(w), distance > np.sqrt(w)
    share = np.where(outside, a / np.where(outside, distance, 1.0), 1.0)  # zero infinitely far away
    large = np.maximum(share, _NEAR)
    closed = (2.0 - 1.0 / large**2) * np.arcsin(large) + np.sqrt(1.0 - large**2) / large
    series = share * (4.0 / 3.0 + share**2 * (2.0 / 15.0 + share**2 * 3.0 / 70.0))
    inside = w - 0.5 * np.where(outside, 0.0, distance) ** 2
    return np.asarray(np.where(outside, w / math.pi * np.where(share > _NEAR, closed, series), inside) / radius)


@dataclass(frozen=True, eq=False)
class HertzSystem(CrestSystem):
    """The system whose summits, of the radius 1/(2 A1), are displaced by the pressures of Hertz on
    the others."""

    @cached_property
    def distance(self) -> RealArray:
        """(n, n) distances in m; infinite on the diagonal and without interaction."""
        with np.errstate(divide="ignore"):
            return np.asarray(np.reciprocal(math.pi * self.coupling), dtype=float)

    def residual(self, w: RealArray, delta: RealArray) -> RealArray:
        """r_i in m."""
        touching = w > 0.0
        pressed = hertz_displacement(w[touching], 0.5 / self.A1[touching], self.distance[:, touching]).sum(axis=1)
        return np.asarray(self.own_approach(w) + pressed - delta)

    def jacobian(self, w: RealArray, among: BoolArray) -> RealArray:
        """dr_i/dw_j of the summits ``among``."""
        a = np.sqrt(w)[among]
        share = a / np.maximum(self.distance[np.ix_(among, among)], a)
        matrix: RealArray = np.asarray(4.0 / math.pi * self.A1[among] * np.arcsin(share))
        matrix[np.diag_indices_from(matrix)] = self.own_slope(w)[among]
        return matrix


_FRESH = 0.1
"""Share of the area of a summit alone from which one starts that comes into contact."""

_UNIT_DEPTH = 1.0
"""Depth in m of the crests that stand for paraboloids, whose radius alone counts."""


@dataclass(frozen=True, eq=False)
class _HertzCrests(InteractingCrests):
    """Paraboloidal crests with the displacements of Hertz, around the ends of a cell that
    repeats."""

    period: tuple[float, float] | None = None
    equations: ClassVar[type[CrestSystem]] = HertzSystem

    def _distances(self, x: RealArray, y: RealArray) -> RealArray:
        return np.asarray(np.hypot(*(_apart(values, values, side) for values, side in self._sides(x, y))))

    def _sides(self, x: RealArray, y: RealArray) -> tuple[tuple[RealArray, float], ...]:
        sides = self.period or (math.inf, math.inf)
        return (x, sides[0]), (y, sides[1])


def _apart(one: RealArray, other: RealArray, side: float) -> RealArray:
    """``one`` (n,) less ``other`` (m,) in m, (n, m), to the nearest image in a cell of this
    ``side``."""
    difference = np.subtract.outer(one, other)
    return difference if math.isinf(side) else np.asarray(difference - side * np.round(difference / side))


Displacement: TypeAlias = Literal["hertz", "point", "none"]

Heights: TypeAlias = Annotated[ArrayLike, Several(Number("length")), "heights of the summits above the mean plane"]
Radii: TypeAlias = Annotated[ArrayLike, Several(Number("length", above=0.0)), "radii of the summits"]
Places: TypeAlias = Annotated[ArrayLike, Several(Number("length")), "positions of the summits"]
NominalArea: TypeAlias = Annotated[float, Number("area", above=0.0), "nominal area"]
Period: TypeAlias = Annotated[
    tuple[float, float] | None, Several(Number("length", above=0.0), 2), "sides of a cell that repeats"
]

TOUCHING = Bound(
    "contact radii over the distance of two summits",
    lambda theory, answer: theory.closeness(answer.separation),
    0.0,
    1.0,
    "Afferrante2012",
    "Contacts overlap, which the sum of their areas counts twice; merging-summits makes one of two.",
)


@dataclass(frozen=True, eq=False)
class InteractingSummits(Theory):
    """Hertz contacts on the summits of a map, each of its own radius, that press each other down.

    With the height z_i and radius R_i of a summit and the displacement u_ij at it by the pressure
    of Hertz on another, at every contact

        a_i²/R_i = z_i - h - Σ_j u_(ij),  F_i = 4 E* a_i³/(3 R_i),
        u = (1/(π R)) [(2 a² - r²) arcsin(a/r) + a sqrt(r² - a²)]  (r > a),
        u = (a² - r²/2)/R  (r ≤ a).

    Elsewhere the right side of the first is negative. ``displacement``: of Hertz's pressure
    (``hertz``), of a point force F/(π E* r) (``point``), 0.4 % more load where neighbours first
    touch, or ``none``. A cell that repeats (``period``) counts the nearest image of each other
    summit, and its mean plane sinks by no more.

    Interaction hardly changes the area at a load: beside solved maps both are 2 to 20 % small,
    mostly because summits are no paraboloids. It matters for the separation. The interaction of
    neighbours and that of the mean plane (``mean-field-summits``) are two forms of one thing, and
    must not be added.

    InputError if the arrays differ in length, a radius or the area is not positive, or two summits
    lie at one place.

    Examples
    --------
    Two summits 5 µm apart, of which the lower one is pressed down by the other:

    >>> pair = {"x": [0.0, 5e-6], "y": [0, 0], "height": [0.0, -9.6e-9], "radius": [50e-6, 50e-6]}
    >>> for displacement in ("none", "hertz"):
    ...     pressed = InteractingSummits(1e11, **pair, area=1e-10, displacement=displacement)
    ...     found = pressed.at_separation([-10e-9])
    ...     print(f"{found.contact_density[0] * 1e-10:.0f}", f"{found.area_fraction[0]:.5f}")
    2 0.01634
    1 0.01571
    """

    E_star: Modulus
    x: Places = field(repr=False)
    y: Places = field(repr=False)
    height: Heights = field(repr=False)
    radius: Radii = field(repr=False)
    area: NominalArea
    displacement: Annotated[Displacement, Help("what summits do to each other", of="choice")] = "hertz"
    period: Period = None
    name: ClassVar[str] = "interacting-summits"
    title: ClassVar[str] = "Greenwood-Williamson with interacting summits"
    citation_keys: ClassVar[tuple[str, ...]] = ("Ciavarella2008", "Johnson1985", "Greenwood1966")
    limits: ClassVar[tuple[Bound, ...]] = (FEW_CONTACTS, BLUNT_SUMMITS, TOUCHING)

    def __post_init__(self) -> None:
        super().__post_init__()
        highest_first(self, "summits", {"radius": "radii"})

    @classmethod
    def of_roughness(cls, roughness: Roughness, E_star: float, *, displacement: Displacement = "hertz") -> Self:
        """Theory for the summits of a map, with the radii of their mean curvatures; one that
        repeats counts nearest images."""
        summits = roughness.known(roughness.summits, "its summits", cls.name)
        places = (summits.x, summits.y, summits.height, summits.radius)
        return cls(E_star, *places, summits.area, displacement, summits.period)

    @property
    def highest(self) -> float:
        """Height of the highest summit in m, where contact begins."""
        return float(np.asarray(self.height)[0])

    @property
    def roughness_ratio(self) -> float:
        """Standard deviation of the heights over the mean radius."""
        return float(np.std(np.asarray(self.height)) / np.mean(np.asarray(self.radius)))

    def contact_radii(self, separation: float) -> RealArray:
        """(n,) contact radii in m of the summits, the highest first, at the ``separation`` in m."""
        radii = np.zeros(np.size(self.height))
        if separation < self.highest:
            squares = self._spots.crests.squared_radii(self.highest - separation)
            radii[: squares.size] = np.sqrt(squares)
        return radii

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m of the plane from the mean plane of the undeformed
        surface."""
        return self._spots.crests.at_separation(separation)

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, positive; times as of ``InteractingCrests``.

        InputError if a pressure is not positive; ConvergenceError if the iteration does not
        converge.
        """
        return self._spots.crests.at_pressure(pressure)

    def closeness(self, separation: ArrayLike) -> RealArray:
        """(n,) largest a_i + a_j over the distance of a pair of contacts; above one they
        overlap."""
        states = self._spots.crests._states(self.highest - curve(separation, "separations (m)"))
        return np.array([self._spots.overlap(w).largest for _, w in states])

    def displaced(self, w: RealArray, radius: RealArray, distance: RealArray) -> float:
        """Displacement in m of a place at the ``distance`` (n,) in m from contacts of squared radii
        ``w`` in m² on summits of the ``radius`` in m."""
        if self.displacement == "none":
            return 0.0
        if self.displacement == "hertz":
            return float(hertz_displacement(w, radius, distance).sum())
        return float(np.sum(4.0 * w**1.5 / (3.0 * math.pi * radius * distance)))

    @cached_property
    def _spots(self) -> _Spots:
        return _Spots(self, *(np.asarray(column) for column in (self.x, self.y, self.height, self.radius)))


@dataclass(frozen=True)
class _Overlap:
    """The ``largest`` a_i + a_j over the distance of two contacts, the ``pair`` with it, and the
    ``count`` of pairs above one."""

    largest: float
    pair: tuple[int, int]
    count: int


@dataclass(frozen=True, eq=False)
class _Spots:
    """Summits, some of which may stand for merged contacts, the highest first; lengths in m."""

    theory: InteractingSummits
    x: RealArray
    y: RealArray
    height: RealArray
    radius: RealArray

    @cached_property
    def crests(self) -> InteractingCrests:
        """The same as crests, whose equations are solved."""
        theory, count = self.theory, self.height.size
        made = _PointCrests if theory.displacement == "point" else _HertzCrests
        return made(
            theory.E_star,
            self.x,
            self.y,
            self.height,
            np.full(count, _UNIT_DEPTH),
            math.pi * np.sqrt(2.0 * self.radius * _UNIT_DEPTH),
            theory.area,
            "off" if theory.displacement == "none" else "far field",
            "complementarity",
            "paraboloid",
            theory.period,
        )

    def overlap(self, w: RealArray) -> _Overlap:
        """How close the contacts of squared radii ``w`` are."""
        touching = np.flatnonzero(w > 0.0)
        if touching.size < 2:
            return _Overlap(0.0, (0, 0), 0)
        a, distance = np.sqrt(w[touching]), self.crests._distances(self.x[touching], self.y[touching])
        distance[np.diag_indices_from(distance)] = math.inf
        ratio = np.add.outer(a, a) / distance
        i, j = divmod(int(np.argmax(ratio)), touching.size)
        pairs = int(np.count_nonzero(ratio > 1.0)) // 2
        return _Overlap(float(ratio[i, j]), (int(touching[i]), int(touching[j])), pairs)

    def first_overlap(self, high: float, low: float, near: RealArray) -> float:
        """Separation in m at which contacts touch, which they do not at ``high`` and do at ``low``,
        where the state is ``near``."""

        def excess(separation: float) -> float:
            return self.overlap(self.squares(separation, near)).largest - 1.0

        unit = abs(self.crests.highest) + abs(low)
        return float(optimize.brentq(excess, high, low, xtol=1e-15 * unit, rtol=1e-14))

    def pressure(self, w: RealArray) -> float:
        """Nominal pressure in Pa of contacts of squared radii ``w``."""
        return self.theory.E_star * 4.0 / 3.0 * float(np.sum(w**1.5 / self.radius)) / self.theory.area

    def squares(self, separation: float, near: RealArray) -> RealArray:
        """(n,) squares of the contact radii in m², from those of a state ``near`` it."""
        w, count = np.zeros(self.height.size), int(np.count_nonzero(self.height > separation))
        if count:
            system, own = self.crests._system(count), self.height[:count] - separation
            fresh = near[:count] <= 0.0
            start = np.where(fresh & (system.residual(near[:count], own) < 0.0), _FRESH * own / system.A1, near[:count])
            w[:count] = settled(solve_complementarity, system, own, start)
        return w

    def merged(self, separation: float, w: RealArray, pair: tuple[int, int]) -> tuple[_Spots, RealArray]:
        """The summits with one in place of the ``pair``, which has the area and the load of their
        contacts at this ``separation``; and the squares of the contact radii."""
        i, j = pair
        kept = np.ones(w.size, dtype=bool)
        kept[[i, j]] = False
        share = float(w[j] / (w[i] + w[j]))
        sides = self.theory.period or (math.inf, math.inf)
        place = [
            float(at[i]) + share * float(_apart(at[[j]], at[[i]], side).item())
            for at, side in zip((self.x, self.y), sides, strict=True)
        ]
        # 4 E* a³/3 over the sum of the forces
        radius = float(w[i] + w[j]) ** 1.5 / float(np.sum(w[[i, j]] ** 1.5 / self.radius[[i, j]]))
        distance = np.hypot(
            *(
                _apart(np.array([one]), at[kept], side)[0]
                for one, at, side in zip(place, (self.x, self.y), sides, strict=True)
            )
        )
        sunk = self.theory.displaced(w[kept], self.radius[kept], distance)
        new = (*place, separation + sunk + float(w[i] + w[j]) / radius, radius)
        old = (self.x, self.y, self.height, self.radius)
        columns = [np.append(values[kept], value) for values, value in zip(old, new, strict=True)]
        order = np.argsort(-columns[2], kind="stable")
        squares = np.append(w[kept], w[i] + w[j])
        return _Spots(self.theory, *(column[order] for column in columns)), squares[order]


@dataclass(frozen=True, eq=False)
class _PointCrests(_HertzCrests):
    """The same with displacements of point forces."""

    equations: ClassVar[type[CrestSystem]] = CrestSystem


# Contacts that touch become one (Afferrante, Carbone & Demelio 2012, whose equations were not at
# hand: a definition of their kind, which keeps the area).


_FIRST_STEP, _STEP = 0.01, 1.15
"""First approach over the range of the heights, and the ratio of an approach to the one before."""

_AT_ONCE = 0.01
"""Share of the contacts that may merge in one step."""

_NARROWEST = 1e-9
"""Step over the approach that is not halved."""


@dataclass(frozen=True, eq=False)
class _Stretch:
    """``spots`` that stay apart from the separation ``high`` down to ``low``, in m, with the
    ``pressure`` in Pa at ``low``."""

    spots: _Spots
    high: float
    low: float
    pressure: float


@dataclass(frozen=True, eq=False)
class MergedSpots:
    """Contacts at one separation: ``x``, ``y``, ``height`` and ``radius`` of the summits and the
    ``contact_radius``, (n,) in m; the highest first, zero where a summit does not touch."""

    x: RealArray
    y: RealArray
    height: RealArray
    radius: RealArray
    contact_radius: RealArray


@dataclass(frozen=True, eq=False)
class MergingSummits(InteractingSummits):
    """Interacting summits whose contacts become one where they touch.

    At the first separation h at which a_i + a_j reaches the distance of two contacts, one takes
    their place that has their area and their load,

        a_e² = a_i² + a_j²,  F_e = F_i + F_j,  R_e = 4 E* a_e³/(3 F_e),
        x_e = (a_i² x_i + a_j² x_j)/a_e²,  z_e = h + Σ_k u_k(x_e) + a_e²/R_e,

    and all others are solved anew: they move by about a thousandth, because the place of the load
    did. Afferrante, Carbone & Demelio (2012) keep the area in this way; their equations were not at
    hand, and this is a definition of its own. Contacts merge one at a time, the deepest overlap
    first, and of many at most a hundredth in one step. What has merged stays one: the answer is
    that of loading. As a load falls slightly where contacts merge, ``at_pressure`` takes the first
    separation that carries it.

    Displacements, ``period`` and what the theory is worth, see ``InteractingSummits``: beside
    solved maps merging moves the area at a load by less than 2 %.

    Examples
    --------
    >>> pair = {"x": [0.0, 5e-6], "y": [0.0, 0.0], "height": [0.0, 0.0], "radius": [50e-6, 50e-6]}
    >>> two = MergingSummits(1e11, **pair, area=1e-10)
    >>> (two.at_separation([-100e-9, -300e-9]).contact_density * 1e-10).round()
    array([2., 1.])
    """

    name: ClassVar[str] = "merging-summits"
    title: ClassVar[str] = "Greenwood-Williamson with merging summits"
    citation_keys: ClassVar[tuple[str, ...]] = ("Afferrante2012", "Ciavarella2008", "Johnson1985", "Greenwood1966")
    limits: ClassVar[tuple[Bound, ...]] = (FEW_CONTACTS, BLUNT_SUMMITS)

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane, each on the path from first
        touch."""
        h = curve(separation, "separations (m)")
        return self._collected(h, lambda stretch: h >= stretch.low, "at_separation")

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, positive, at the first separation that
        carries them."""
        p = curve(pressure, "pressures (Pa)", positive=True)
        return self._collected(p, lambda stretch: p <= stretch.pressure, "at_pressure")

    def contact_radii(self, separation: float) -> RealArray:
        """(n,) contact radii in m of what the summits have become, the highest first."""
        return self.spots(separation).contact_radius

    def spots(self, separation: float) -> MergedSpots:
        """What the summits have become at the ``separation`` in m; of contacts that merge there,
        the one that they become."""
        for stretch in self._path():
            if separation > stretch.low:
                break
        found = stretch.spots
        squares = found.squares(separation, np.zeros(found.height.size))
        return MergedSpots(found.x, found.y, found.height, found.radius, np.sqrt(squares))

    def _collected(self, asked: RealArray, reached: Callable[[_Stretch], BoolArray], way: str) -> Prediction:
        """Answers at the values ``asked``, each from the first stretch that has reached it."""
        left = np.ones(asked.size, dtype=bool)
        parts: dict[str, RealArray] = {}
        for stretch in self._path():
            here = left & reached(stretch)
            if here.any():
                found = vars(getattr(stretch.spots.crests, way)(asked[here]))
                for name, values in found.items():
                    parts.setdefault(name, np.empty(asked.size))[here] = values
                left &= ~here
            if not left.any():
                break
        return Prediction(**parts)

    def _path(self) -> Iterator[_Stretch]:
        """Stretches from first touch on, without end."""
        spots, high = self._spots, self.highest
        w: RealArray = np.zeros(np.size(self.height))
        approach = _FIRST_STEP * (float(np.ptp(spots.height)) or _FIRST_STEP * float(spots.radius[0]))
        while True:
            low = self.highest - approach
            w = spots.squares(low, w)
            found = spots.overlap(w)
            most = _AT_ONCE * float(np.count_nonzero(w))
            if found.largest > 1.0 and most < 1.0:
                low = spots.first_overlap(high, low, w)
            else:
                while found.count > most and high - low > _NARROWEST * approach:
                    low = 0.5 * (high + low)
                    w = spots.squares(low, w)
                    found = spots.overlap(w)
            if found.largest > 1.0 and most < 1.0:
                w = spots.squares(low, w)
                found = replace(spots.overlap(w), largest=math.inf)
            yield _Stretch(spots, high, low, spots.pressure(w))
            while found.largest > 1.0:
                spots, w = spots.merged(low, w, found.pair)
                w = spots.squares(low, w)
                found = spots.overlap(w)
            high, approach = low, _STEP * (self.highest - low)
