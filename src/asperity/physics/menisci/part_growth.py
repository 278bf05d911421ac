"""Menisci of a solved contact that grow in time, asked for by a document."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, Humidity, Number, Pressure
from ...parts.part import Part

if TYPE_CHECKING:
    from ...theories.wet.feeds import Feed
    from .film import LiquidFilm

Feeding = Annotated[str, Choice({name: name for name in ("film", "flooded", "vapour")})]

MOMENT = "moment"
"""Axis of the times."""

SCALARS = (
    Quantity("grown_first_force", "N", "meniscus force at first touch", costly=True),
    Quantity("grown_last_force", "N", "meniscus force at the last time", costly=True),
    Quantity("grown_relative_force", "1", "meniscus force at the last time / external force", costly=True),
    Quantity("grown_settling", "s", "time from which on it is within 1 % of that", costly=True),
    Quantity("grown_equilibrium_height", "m", "height at which a meniscus takes no more", costly=True),
)
"""Numbers of growing menisci."""


class GrowthSettings(Settings):
    """Growth of the menisci of the film in the table [film], from its thickness to equilibrium.

    Liquid comes from the film around each meniscus (``film``), from a gap that is flooded outside
    (``flooded``), both by viscous flow, or from vapour by diffusion (``vapour``). The film holds
    its liquid back with the disjoining pressure of its Hamaker constant. Without feedback of the
    film the gap stays that of the load alone.
    """

    feed: Feeding = setting("film", option="--growth-feed", help="What brings the liquid")
    until: Annotated[float, Number("time", above=0.0)] | None = setting(
        None, option="--growth-until", help="Last time after contact: 10s; twice that of the end of growth by default"
    )
    hamaker_constant: Annotated[float, Number("energy", above=0.0)] = setting(
        "1e-19 J", option="--growth-hamaker", help="Of solid, liquid and vapour, which holds the film"
    )
    radius_ratio: Annotated[float, Number(above=1.0)] = setting(
        10.0, option="--growth-radius-ratio", help="Outer over inner radius of the film that feeds a meniscus"
    )
    humidity: Humidity | None = setting(
        None, option="--growth-humidity", help="Of the vapour; that of the film by default: 80%"
    )
    vapour_pressure: Pressure = setting(
        "2339 Pa", option="--growth-vapour-pressure", help="Of saturation; that of water at 20 °C by default"
    )
    diffusivity: Annotated[float, Number("m^2/s", above=0.0)] = setting(
        "2.42e-5 m^2/s", option="--growth-diffusivity", help="Of the vapour in air; that of water by default"
    )


@dataclass(frozen=True)
class Growing:
    """The film, what feeds its menisci, and the last time (s); NaN for the default."""

    film: LiquidFilm
    feed: Feed
    until: float


class Growth(Part):
    """How the menisci of the map grow."""

    name = "meniscus_growth"
    title = "Growth of the menisci"
    purpose = "How fast the menisci grow after contact, and with them their force."
    table = "meniscus_growth"
    settings = GrowthSettings
    basic = ("feed", "until")
    work = "physics.menisci.work_growth:GrowthWork"
    headline = "grown_last_force"
    sheet = ("menisci.csv", MOMENT)

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars, and columns of all times."""
        from .growth import COLUMNS

        return (*SCALARS, *(replace(item, name=f"growth_{item.name}", dims=(MOMENT,)) for item in COLUMNS))

    def asked(self, document: Any, folder: Path) -> Growing:
        """The film of the table [film] with the feed of this one.

        Raises
        ------
        InputError
            If there is no film, or the feed lacks a value.
        """
        from ...theories.wet.feeds import FilmFeed, FloodedFeed, VapourFeed
        from ...theories.wet.meniscus import wetting_factor
        from .part import Menisci, substance_of

        ask: GrowthSettings = document.meniscus_growth
        if getattr(document, "film", None) is None:
            raise InputError(
                "meniscus_growth must be asked for beside a film ({film.liquid=water}), but is asked for without."
            )
        film = Menisci().asked(document, folder).film
        wetting = wetting_factor(*film.contact_angles)
        feed: Feed
        if ask.feed == "vapour":
            humidity = document.film.humidity if ask.humidity is None else ask.humidity
            if humidity is None:
                raise InputError(
                    "meniscus_growth.humidity must be given for menisci that grow from vapour "
                    "({meniscus_growth.humidity=80 %}), but is not."
                )
            liquid = substance_of(document, folder)
            volume = liquid.require_molar_volume()
            vapour = (ask.vapour_pressure, ask.diffusivity, wetting, liquid.temperature)
            feed = VapourFeed(film.surface_tension, volume, humidity, *vapour)
        else:
            if math.isnan(film.viscosity):
                raise InputError(
                    "viscosity of the liquid must be known for menisci that grow by flow, but is not. Give it "
                    "({film.viscosity=10 mPa*s})."
                )
            held = ask.hamaker_constant / (6.0 * math.pi * film.thickness**3)
            if ask.feed == "film":
                feed = FilmFeed(film.surface_tension, film.thickness, film.viscosity, held, wetting, ask.radius_ratio)
            else:
                feed = FloodedFeed(film.surface_tension, film.viscosity, held, wetting)
        return Growing(film, feed, math.nan if ask.until is None else ask.until)
