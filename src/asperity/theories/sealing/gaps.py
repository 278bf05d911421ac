"""Flow of a thin film through gaps of simple shapes, in closed form.

Reynolds' equation with a pressure that varies along the flow only, where it does not say otherwise.
A transmissivity is K = 12 η Q L / (W ΔP) in m³, the cube of the even gap that lets as much through.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.quantity import Quantity
from ...core.values import Length, NonNegativeLength, Viscosity
from ..ask import Way, asked
from ..protocol import Bound, Theory, checked

ATMOSPHERE = 101325.0
"""Pressure in Pa at which mean free paths are given."""

SLIP = 0.1
"""Knudsen number up to which slip of first order holds."""


@dataclass(frozen=True, eq=False)
class Bounds:
    """Lower and upper bound of a number."""

    lower: float
    upper: float


def sinusoidal_gap(amplitude: float, *, along: bool) -> float:
    """K over the cube of the mean gap of a sinusoidal gap, its ``amplitude`` over the mean gap
    from 0 to 1, with the flow along or across the grooves.

    Examples
    --------
    >>> sinusoidal_gap(0.5, along=True)
    1.375
    """
    e = require.finite(amplitude, "amplitude over mean gap")
    if not 0.0 <= e <= 1.0:
        raise InputError(f"amplitude over mean gap must be from 0 to 1, but is {e:g}.")
    return float(1.0 + 1.5 * e**2 if along else (1.0 - e**2) ** 2.5 / (1.0 + 0.5 * e**2))


def tapered_gap(inlet: float, outlet: float) -> float:
    """K in m³ of a gap that changes linearly from ``inlet`` to ``outlet`` (m, > 0)."""
    first, last = require.positive(inlet, "gap at the inlet (m)"), require.positive(outlet, "gap at the outlet (m)")
    return float(2.0 * (first * last) ** 2 / (first + last))


def parabolic_throat(gap: float, radius: float) -> float:
    """12 η Q/(W ΔP) in m² of a throat g + x²/(2 R) across the flow, without ends."""
    g, curved = require.positive(gap, "gap of a throat (m)"), require.positive(radius, "radius of a throat (m)")
    return float(8.0 * g**2.5 / (3.0 * np.pi * np.sqrt(2.0 * curved)))


def parabolic_channel(height: float) -> float:
    """K in m³ of a channel along the flow whose section is a parabola, closed at both sides."""
    return 16.0 / 35.0 * require.positive(height, "height of a channel (m)") ** 3


def annular_gap(gap: float, ratio: float) -> float:
    """12 η Q/ΔP in m³ of an even ``gap`` (m) between circles whose radii have the ``ratio`` > 1."""
    if not require.finite(ratio, "ratio of radii") > 1.0:
        raise InputError(f"ratio of radii must be greater than 1, but is {ratio:g}.")
    return float(2.0 * np.pi * require.positive(gap, "gap of an annulus (m)") ** 3 / np.log(ratio))


def saddle_throat(gap: float, along: float, across: float) -> Bounds:
    """12 η Q/ΔP in m³ of a throat g + x²/(2 R_x) - y²/(2 R_y) with the flow along x: from below
    without flow across, from above with a pressure that varies along x only; 5/6 and 6/7 of
    g³ √(R_y/R_x)."""
    g = require.positive(gap, "gap of a saddle (m)")
    radii = require.positive(along, "radius along the flow (m)"), require.positive(across, "radius across (m)")
    size = g**3 * np.sqrt(radii[1] / radii[0])
    return Bounds(5.0 / 6.0 * size, 6.0 / 7.0 * size)


# Theories of the catalogue.


@dataclass(frozen=True, eq=False, repr=False)
class FilmFlow(Tabled):
    """What flows: ``drop`` of the pressure in Pa and ``rate`` in m³/s, arrays of one shape."""

    drop: RealArray
    rate: RealArray


@dataclass(frozen=True, eq=False, repr=False)
class GasFlow(Tabled):
    """What flows of an ideal gas: ``inlet`` pressure in Pa, ``throughput`` in Pa m³/s, and the
    ``knudsen`` number at the mean pressure, arrays of one shape."""

    inlet: RealArray
    throughput: RealArray
    knudsen: RealArray


@dataclass(frozen=True, eq=False, repr=False)
class BracketedFlow(Tabled):
    """What flows at least and at most, ``lower`` and ``upper`` in m³/s, at the ``drop`` of the
    pressure in Pa, arrays of one shape."""

    drop: RealArray
    lower: RealArray
    upper: RealArray


DROP = asked("drop", "Pa", "pressure at the inlet less that at the outlet")
BY_DROP = Way(DROP, "at_drop", (Quantity("rate", "m**3/s", "volume of a liquid that leaks per time"),), checked=False)
BY_INLET = Way(
    asked("inlet", "Pa", "absolute pressure at the inlet"),
    "at_inlet",
    (
        Quantity("throughput", "Pa*m**3/s", "leak rate of an ideal gas, pressure times volume per time"),
        Quantity("knudsen", "1", "mean free path at the mean pressure over the gap"),
    ),
    (asked("outlet", "Pa", "absolute pressure at the outlet", 0.0),),
)
THIN = "The film is no longer thin, and the pressure varies across the gap."
RAREFIED = Bound(
    "Knudsen number",
    lambda theory, answer: answer.knudsen,
    0.0,
    SLIP,
    "Burgdorfer1959",
    "A rarer gas flows as its molecules do; slip of first order gives too little.",
)


def _thin(criterion: str, ratio: str) -> Bound:
    """Bound on a property of a theory, gap over length."""
    return Bound(criterion, lambda theory, answer: getattr(theory, ratio), 0.0, 0.1, "Reynolds1886", THIN)


class _Film(Theory):
    """A gap that lets ``passing`` = 12 η Q/ΔP through."""

    citation_keys: ClassVar[tuple[str, ...]] = ("Reynolds1886",)
    ways: ClassVar[tuple[Way, ...]] = (BY_DROP,)
    viscosity: float

    @property
    def passing(self) -> float:
        """12 η Q/ΔP in m³."""
        raise NotImplementedError

    def at_drop(self, drop: ArrayLike) -> FilmFlow:
        """What leaks at the ``drop`` of the pressure (any shape) in Pa, >= 0."""
        fall = checked(drop, "drop of the pressure (Pa)")
        return FilmFlow(fall, self.passing * fall / (12.0 * self.viscosity))


Gap = Annotated[Length, "gap g"]
Along = Annotated[Length, "length L along the flow"]
Across = Annotated[Length, "width W across the flow"]
OfFluid = Annotated[Viscosity, "viscosity η of the fluid"]


@dataclass(frozen=True)
class ParallelGap(_Film):
    """An even gap, of a liquid:

        Q = W g³ ΔP/(12 η L).

    Of an ideal gas with slip the throughput is W g³ (P_i² - P_o²)/(24 η L) (1 + 6 Kn), Kn the mean
    free path at the mean pressure over the gap.

    Examples
    --------
    >>> gap = ParallelGap(gap=1e-6, viscosity=1e-3, width=1e-2, length=1e-3)
    >>> print(f"{gap.at_drop(1e5).rate:.3g} m³/s")
    8.33e-11 m³/s
    """

    gap: Gap
    viscosity: OfFluid
    width: Across
    length: Along
    mean_free_path: Annotated[NonNegativeLength, "mean free path of a gas at one atmosphere, for its slip"] = 0.0
    name: ClassVar[str] = "parallel-gap"
    title: ClassVar[str] = "Reynolds, even gap"
    citation_keys: ClassVar[tuple[str, ...]] = ("Reynolds1886", "Burgdorfer1959")
    limits: ClassVar[tuple[Bound, ...]] = (_thin("gap over length", "slenderness"), RAREFIED)
    ways: ClassVar[tuple[Way, ...]] = (BY_DROP, BY_INLET)

    @property
    def passing(self) -> float:
        """12 η Q/ΔP in m³."""
        return self.width / self.length * self.gap**3

    @property
    def slenderness(self) -> float:
        """Gap over length."""
        return self.gap / self.length

    def at_inlet(self, inlet: ArrayLike, outlet: float = 0.0) -> GasFlow:
        """What leaks of an ideal gas from the absolute pressure at the ``inlet`` (any shape) to
        that at the ``outlet``, Pa; InputError where it is not above that."""
        last = require.not_negative(outlet, "pressure at the outlet (Pa)")
        first = checked(inlet, "pressure at the inlet (Pa)", last)
        mean = 0.5 * (first + last)
        path = np.divide(self.mean_free_path * ATMOSPHERE, mean, out=np.full_like(mean, math.inf), where=mean > 0.0)
        knudsen = path / self.gap if self.mean_free_path else np.zeros_like(mean)
        # mean pressure and slip in one, which has no pole without pressure
        slipping = mean + 6.0 * self.mean_free_path * ATMOSPHERE / self.gap
        return GasFlow(first, self.passing * (first - last) * slipping / (12.0 * self.viscosity), knudsen)


@dataclass(frozen=True)
class TaperedGap(_Film):
    """A gap that changes linearly along the flow from g_1 to g_2:

    K = 2 g_1² g_2²/(g_1 + g_2).
    """

    first_gap: Annotated[Length, "gap g_1 at one end"]
    last_gap: Annotated[Length, "gap g_2 at the other end"]
    viscosity: OfFluid
    width: Across
    length: Along
    name: ClassVar[str] = "tapered-gap"
    title: ClassVar[str] = "Reynolds, tapered gap"
    limits: ClassVar[tuple[Bound, ...]] = (_thin("larger gap over length", "slenderness"),)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("transmissivity", "m**3", "cube of the even gap that lets as much through"),
    )

    @property
    def transmissivity(self) -> float:
        """K in m³."""
        return tapered_gap(self.first_gap, self.last_gap)

    @property
    def passing(self) -> float:
        """12 η Q/ΔP in m³."""
        return self.width / self.length * self.transmissivity

    @property
    def slenderness(self) -> float:
        """Larger gap over length."""
        return max(self.first_gap, self.last_gap) / self.length


@dataclass(frozen=True)
class AnnularGap(_Film):
    """An even gap between two flat rings with flow along the radius, as of a flange:

        Q = π g³ ΔP/(6 η ln(r_o/r_i)).

    InputError if the outer radius is not the larger.
    """

    gap: Gap
    viscosity: OfFluid
    inner_radius: Annotated[Length, "inner radius r_i"]
    outer_radius: Annotated[Length, "outer radius r_o"]
    name: ClassVar[str] = "annular-gap"
    title: ClassVar[str] = "Reynolds, even gap of a flange"
    limits: ClassVar[tuple[Bound, ...]] = (_thin("gap over difference of the radii", "slenderness"),)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.outer_radius <= self.inner_radius:
            raise InputError(
                f"outer radius of an annular gap must be above the inner one, {self.inner_radius:g} m, but is "
                f"{self.outer_radius:g} m."
            )

    @property
    def passing(self) -> float:
        """12 η Q/ΔP in m³."""
        # ln(1 + x) keeps its digits for nearly equal radii
        return 2.0 * math.pi * self.gap**3 / math.log1p((self.outer_radius - self.inner_radius) / self.inner_radius)

    @property
    def slenderness(self) -> float:
        """Gap over the difference of the radii."""
        return self.gap / (self.outer_radius - self.inner_radius)


@dataclass(frozen=True)
class ParabolicThroat(_Film):
    """A throat across the flow, as under a cylinder, of the gap g + x²/(2 R):

    Q = (W ΔP/(12 η)) 8 g^(5/2)/(3 π √(2 R)).
    """

    gap: Annotated[Length, "smallest gap g"]
    viscosity: OfFluid
    radius: Annotated[Length, "radius of curvature R along the flow"]
    width: Across
    name: ClassVar[str] = "parabolic-throat"
    title: ClassVar[str] = "Reynolds, throat under a cylinder"
    limits: ClassVar[tuple[Bound, ...]] = (_thin("gap over radius", "slenderness"),)

    @property
    def passing(self) -> float:
        """12 η Q/ΔP in m³."""
        return self.width * parabolic_throat(self.gap, self.radius)

    @property
    def slenderness(self) -> float:
        """Gap over radius."""
        return self.gap / self.radius


@dataclass(frozen=True)
class ParabolicChannel(_Film):
    """A channel along the flow, as a groove or a scratch: its section is a parabola that closes at
    both sides, at the height h in the middle:

        K = (16/35) h³.
    """

    height: Annotated[Length, "height in the middle"]
    viscosity: OfFluid
    width: Annotated[Length, "width between the sides that close"]
    length: Along
    name: ClassVar[str] = "parabolic-channel"
    title: ClassVar[str] = "Reynolds, scratch along the flow"
    limits: ClassVar[tuple[Bound, ...]] = (_thin("height over width", "slenderness"),)

    @property
    def passing(self) -> float:
        """12 η Q/ΔP in m³."""
        return self.width / self.length * parabolic_channel(self.height)

    @property
    def slenderness(self) -> float:
        """Height over width: the walls must not hold the fluid."""
        return self.height / self.width


@dataclass(frozen=True)
class SaddleThroat(Theory):
    """A constriction between two spots of contact: gap g + x²/(2 R_x) - y²/(2 R_y) with the flow
    along x.

        5/6 ≤ 12 η Q/(ΔP g³ √(R_y/R_x)) ≤ 6/7

    From below without flow across, from above with a pressure that varies along x only.
    """

    gap: Annotated[Length, "gap g in the middle"]
    viscosity: OfFluid
    radius_along: Annotated[Length, "radius R_x by which the gap grows along the flow"]
    radius_across: Annotated[Length, "radius R_y by which it falls across the flow"]
    name: ClassVar[str] = "saddle-throat"
    title: ClassVar[str] = "Reynolds, saddle between two spots"
    citation_keys: ClassVar[tuple[str, ...]] = ("Reynolds1886", "Dapp2012")
    limits: ClassVar[tuple[Bound, ...]] = (_thin("gap over the smaller radius", "slenderness"),)
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            DROP,
            "at_drop",
            (
                Quantity("lower", "m**3/s", "volume of a liquid that leaks per time, at least"),
                Quantity("upper", "m**3/s", "volume of a liquid that leaks per time, at most"),
            ),
            checked=False,
        ),
    )

    def at_drop(self, drop: ArrayLike) -> BracketedFlow:
        """What leaks at the ``drop`` of the pressure (any shape) in Pa, >= 0."""
        fall = checked(drop, "drop of the pressure (Pa)")
        found = saddle_throat(self.gap, self.radius_along, self.radius_across)
        unit = fall / (12.0 * self.viscosity)
        return BracketedFlow(fall, found.lower * unit, found.upper * unit)

    @property
    def slenderness(self) -> float:
        """Gap over the smaller radius."""
        return self.gap / min(self.radius_along, self.radius_across)
