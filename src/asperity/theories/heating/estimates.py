"""Estimates of frictional heating: limits at rest and fast, interpolations between them, and two
bodies from what each would be alone."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Choice, Length, Number
from ..ask import Way, asked
from ..protocol import Bound, Theory, curve
from .impedance import HeatConductor
from .sources import BandSource, EllipticSource, MovingSource, RectangularSource, Source, disc_source

Conductivity = Annotated[float, Number("thermal conductivity", above=0.0), Help("thermal conductivity k", of="bodies")]
Diffusivity = Annotated[float, Number("m^2/s", above=0.0), Help("thermal diffusivity κ = k/ρc", of="bodies")]
Flux = Annotated[float, Number("W/m^2", above=0.0), "mean flux q̄ over the source"]

# Limits of θ = k T/(q̄ a).


class Limits(NamedTuple):
    """θ at rest, and θ sqrt(π Pe) of a fast source: the largest one and the mean."""

    rest: float
    rest_mean: float
    fast: float
    fast_mean: float


UNIFORM_DISC = Limits(
    1.0, 8.0 / (3.0 * math.pi), 2.0, 8.0 / (3.0 * math.sqrt(math.pi)) * math.gamma(1.75) / math.gamma(2.25)
)
HERTZIAN_DISC = Limits(0.375 * math.pi, 9.0 * math.pi / 32.0, 2.32105, 1.27181)
"""The hottest point of a fast one lies at x = 0.6522 a; that of uniform sources at their trailing
edge."""
SQUARE = Limits(
    4.0 / math.pi * math.asinh(1.0),
    4.0 / math.pi * (math.asinh(1.0) - (math.sqrt(2.0) - 1.0) / 3.0),
    2.0,
    4.0 / 3.0,
)
BAND = Limits(math.inf, math.inf, 2.0, 4.0 / 3.0)


class Interpolated(NamedTuple):
    """θ = c/sqrt(π (d + Pe)) of a disc: c and d of the largest temperature, and of the mean."""

    c: float
    d: float
    c_mean: float
    d_mean: float


UNIFORM = Interpolated(2.0, 1.273, 1.2204, 0.658)
"""Largest temperature within -0.7 and +2.3 %, worst at Pe = 0.5; mean up to 3.7 % low near Pe =
1."""
HERTZIAN = Interpolated(2.32, 1.234, 1.2718, 0.6595)
"""Largest temperature within -1.1 and +0.2 %, worst at Pe = 5; mean up to 4.6 % low near Pe = 1."""


def interpolated(peclet: ArrayLike, *, hertzian: bool = False) -> RealArray:
    """θ of the hottest point of a disc at Péclet numbers >= 0, of any shape (Tian & Kennedy
    1994)."""
    pe, of = np.asarray(peclet, dtype=float), HERTZIAN if hertzian else UNIFORM
    return np.asarray(of.c / np.sqrt(math.pi * (of.d + pe)))


# Two bodies.


def together(first: ArrayLike, second: ArrayLike) -> RealArray:
    """(1/T1 + 1/T2)⁻¹ of the temperatures that either body would have with all heat (Blok 1937).

    Of the largest ones within 0.5 % of the exact largest temperature of a Hertzian disc at rest on
    a body that moves; 7 % low at Pe = ∓3 and 14 % at ∓30 of bodies in opposite motion. Of the means
    0 to 7 % low.
    """
    one, two = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    return np.asarray(one * two / (one + two))


def share(first: ArrayLike, second: ArrayLike) -> RealArray:
    """T2/(T1 + T2), the part of the heat that enters the first body.

    By the largest temperatures up to 46 % too large, by means from -4 to +7 %.
    """
    one, two = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    return np.asarray(two / (one + two))


# Theories of the catalogue.

_SPEED = asked("speed", "m/s", "speed of the material relative to the source")


@dataclass(frozen=True, eq=False, repr=False)
class HeatAnswer(Tabled):
    """One source at some speeds (m/s), (n,) each, NaN where a theory does not give it.

    ``peclet`` v a/2κ; ``max_temperature``, ``mean_temperature`` over the source and
    ``flux_mean_temperature`` weighted with the flux in K above the bulk; ``hottest`` is the place
    of the largest behind the centre in m.
    """

    speed: RealArray
    peclet: RealArray
    max_temperature: RealArray
    hottest: RealArray
    mean_temperature: RealArray
    flux_mean_temperature: RealArray


_HEAT = (
    Quantity("peclet", "1", "Péclet number v a/2κ"),
    Quantity("max_temperature", "K", "largest temperature rise"),
    Quantity("hottest", "m", "distance of the hottest point behind the centre"),
    Quantity("mean_temperature", "K", "mean temperature rise of the source"),
    Quantity("flux_mean_temperature", "K", "mean temperature rise weighted with the flux"),
)


def _along(source: Source, flux: float, body: HeatConductor, speed: RealArray) -> HeatAnswer:
    """The source at each speed."""
    rows = []
    for v in speed:
        moving = MovingSource(source, body, float(v))
        hot = moving.hottest()
        rows.append(
            (moving.peclet, flux * hot.temperature, hot.x, flux * moving.mean(), flux * moving.mean(weighted=True))
        )
    return HeatAnswer(speed, *np.array(rows).T)


@dataclass(frozen=True)
class MovingHeatSource(Theory):
    """One source of heat on a half-space that moves by under it; uniform or Hertzian flux on an
    ellipse, or uniform flux on a rectangle:

        T = 1/(2 π k) ∫∫ q exp(-v (r - x)/2κ)/r dA.
    """

    flux: Flux
    half_length: Annotated[Length, "half length a along the motion"]
    half_width: Annotated[Length, "half width b across the motion"]
    conductivity: Conductivity
    diffusivity: Diffusivity
    shape: Annotated[
        str,
        Choice({"ellipse": "ellipse", "hertzian": "hertzian", "rectangle": "rectangle"}),
        Help("uniform or Hertzian ellipse, or rectangle", of="choice"),
    ] = "ellipse"
    name: ClassVar[str] = "moving-source"
    title: ClassVar[str] = "Rosenthal & Jaeger, moving source of heat"
    citation_keys: ClassVar[tuple[str, ...]] = ("Rosenthal1946", "Jaeger1942", "CarslawJaeger1959")
    limits: ClassVar[tuple[Bound, ...]] = ()
    ways: ClassVar[tuple[Way, ...]] = (Way(_SPEED, "at_speed", _HEAT),)

    def at_speed(self, speed: ArrayLike) -> HeatAnswer:
        """The source at speeds (n,) in m/s of either sign."""
        if self.shape == "rectangle":
            source: Source = RectangularSource(self.half_length, self.half_width)
        else:
            source = EllipticSource(self.half_length, self.half_width, self.shape == "hertzian")
        body = HeatConductor(self.conductivity, self.diffusivity)
        return _along(source, self.flux, body, curve(speed, "speeds (m/s)"))


@dataclass(frozen=True)
class JaegerBand(Theory):
    """A uniform band of heat across the motion, in closed form with X = v x/2κ:

        T = 2 q κ/(π k v) (P(X + Pe) - P(X - Pe)),  P(U) = ∫_0^U exp(u) K_0(u) du

    with the size of u in K_0.
    """

    flux: Flux
    half_length: Annotated[Length, "half width l of the band, along the motion"]
    conductivity: Conductivity
    diffusivity: Diffusivity
    name: ClassVar[str] = "jaeger-band"
    title: ClassVar[str] = "Jaeger, moving band of heat"
    citation_keys: ClassVar[tuple[str, ...]] = ("Jaeger1942", "CarslawJaeger1959")
    limits: ClassVar[tuple[Bound, ...]] = ()
    ways: ClassVar[tuple[Way, ...]] = (Way(_SPEED, "at_speed", _HEAT),)

    def at_speed(self, speed: ArrayLike) -> HeatAnswer:
        """The band at speeds (n,) in m/s; InputError at rest, where it grows hotter for ever."""
        body = HeatConductor(self.conductivity, self.diffusivity)
        return _along(BandSource(self.half_length), self.flux, body, curve(speed, "speeds (m/s)"))


@dataclass(frozen=True)
class TianKennedy(Theory):
    """A disc of heat on a half-space that moves by under it, between its limits at rest and fast:

        T = c q̄ a/(k sqrt(π (d + Pe))).

    Under even flux c = 2 and d = 1.273, under Hertz's c = 2.32 and d = 1.234. Largest temperatures
    are within -1.1 and +2.3 %; means of the same form are up to 4.6 % low.
    """

    flux: Flux
    radius: Annotated[Length, "radius a of the disc"]
    conductivity: Conductivity
    diffusivity: Diffusivity
    shape: Annotated[
        bool,
        Choice({"uniform": False, "hertzian": True}),
        Help("uniform or Hertzian flux", of="choice"),
    ] = False
    name: ClassVar[str] = "tian-kennedy"
    title: ClassVar[str] = "Tian & Kennedy, moving disc of heat"
    citation_keys: ClassVar[tuple[str, ...]] = ("TianKennedy1994",)
    limits: ClassVar[tuple[Bound, ...]] = ()
    ways: ClassVar[tuple[Way, ...]] = (Way(_SPEED, "at_speed", (_HEAT[0], _HEAT[1], _HEAT[3])),)

    def at_speed(self, speed: ArrayLike) -> HeatAnswer:
        """The disc at speeds (n,) in m/s of either sign."""
        v = curve(speed, "speeds (m/s)")
        pe = 0.5 * np.abs(v) * self.radius / self.diffusivity
        of = HERTZIAN if self.shape else UNIFORM
        unit = self.flux * self.radius / self.conductivity
        mean = unit * of.c_mean / np.sqrt(math.pi * (of.d_mean + pe))
        unknown = np.full_like(v, np.nan)
        weighted = unknown if self.shape else mean
        return HeatAnswer(v, pe, unit * interpolated(pe, hertzian=self.shape), unknown, mean, weighted)


@dataclass(frozen=True, eq=False, repr=False)
class FlashAnswer(Tabled):
    """A Hertzian contact at sliding speeds (m/s), (n,) each.

    ``peclet`` of the body that moves; ``share`` of the heat that enters the body at rest, by mean
    temperatures; ``max_temperature`` and ``mean_temperature`` in K above the bulk of both.
    """

    speed: RealArray
    peclet: RealArray
    heat: RealArray
    share: RealArray
    max_temperature: RealArray
    mean_temperature: RealArray


@dataclass(frozen=True)
class BlokFlash(Theory):
    """Flash temperature of a circular Hertzian contact that rests on body 1 and slides over body 2,
    from the temperatures T1 and T2 of each with all heat μ W v:

        T = 1/(1/T1 + 1/T2),  Q1/Q = T2/(T1 + T2).

    The largest temperature by the largest of each is within 0.5 % of that with equal temperatures
    everywhere; share and mean are by the means of each, -4 to +7 % and 0 to 7 % low.
    """

    friction: Annotated[float, Number(above=0.0), "coefficient of friction μ"]
    load: Annotated[float, Number("force", above=0.0), "normal force W"]
    contact_radius: Annotated[Length, "contact radius a"]
    conductivity_1: Annotated[
        float, Number("thermal conductivity", above=0.0), Help("conductivity k1 of the body that rests", of="bodies")
    ]
    conductivity_2: Annotated[
        float, Number("thermal conductivity", above=0.0), Help("conductivity k2 of the body that moves", of="bodies")
    ]
    diffusivity_2: Annotated[
        float, Number("m^2/s", above=0.0), Help("diffusivity κ2 of the body that moves", of="bodies")
    ]
    name: ClassVar[str] = "blok-flash"
    title: ClassVar[str] = "Blok, flash temperature of two bodies"
    citation_keys: ClassVar[tuple[str, ...]] = ("Blok1937", "Jaeger1942")
    limits: ClassVar[tuple[Bound, ...]] = ()
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            _SPEED,
            "at_speed",
            (
                Quantity("peclet", "1", "Péclet number of body 2"),
                Quantity("heat", "W", "heat of friction"),
                Quantity("share", "1", "share of the heat that enters body 1"),
                Quantity("max_temperature", "K", "largest temperature rise"),
                Quantity("mean_temperature", "K", "mean temperature rise of the contact"),
            ),
        ),
    )

    def at_speed(self, speed: ArrayLike) -> FlashAnswer:
        """The contact at sliding speeds (n,) in m/s, >= 0."""
        v = curve(speed, "sliding speeds (m/s)")
        if np.any(v < 0.0):
            raise InputError(f"sliding speeds (m/s) must not be negative, but the smallest is {v.min():g}.")
        source = disc_source(self.contact_radius, hertzian=True)
        heat = self.friction * self.load * v
        flux = heat / (math.pi * self.contact_radius**2)
        still = MovingSource(source, HeatConductor(self.conductivity_1, 1.0))  # κ does not count at rest
        first, first_mean = still.hottest().temperature, still.mean()
        body = HeatConductor(self.conductivity_2, self.diffusivity_2)
        moving = [MovingSource(source, body, float(each)) for each in v]
        second = np.array([each.hottest().temperature for each in moving])
        second_mean = np.array([each.mean() for each in moving])
        return FlashAnswer(
            v,
            np.array([each.peclet for each in moving]),
            heat,
            share(first_mean, second_mean),
            flux * together(first, second),
            flux * together(first_mean, second_mean),
        )


def fast_share(
    conductivities: tuple[float, float], diffusivities: tuple[float, float], speeds: tuple[float, float]
) -> float:
    """b1 sqrt(v1)/(b1 sqrt(v1) + b2 sqrt(v2)) of two fast bodies of effusivities b = k/sqrt(κ)
    (Jaeger 1942), by their ``conductivities``, ``diffusivities`` and ``speeds`` > 0."""
    first, second = (
        require.positive(k, "thermal conductivity (W/m/K)")
        * math.sqrt(require.positive(v, "speed (m/s)") / require.positive(kappa, "thermal diffusivity (m²/s)"))
        for k, kappa, v in zip(conductivities, diffusivities, speeds, strict=True)
    )
    return first / (first + second)
