"""A liquid film between the bodies: its menisci, and the theory of summits beside them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Angle, Humidity, Length, NonEmpty, Pressure, SurfaceTension, Viscosity
from ...parts.part import Part
from ..friction.part import friction_law, sticks
from .quantities import WET_SCALARS

if TYPE_CHECKING:
    from ...solids.library import Liquid
    from ..friction.law import FrictionLaw
    from .film import LiquidFilm


class FilmSettings(Settings):
    """A liquid film.

    The liquid is a named one or given by its ``surface_tension``, which else replaces that of the
    named one. Either the ``humidity`` fixes the height of the menisci, and for water the thickness
    of the film, or ``thickness`` and ``meniscus_height`` are given, the second being the first by
    default. One ``contact_angle`` is that on the surface opposite the film. Friction is that of the
    table [friction].
    """

    liquid: NonEmpty | None = setting(None, option="--liquid", help="Name: water, PFPE; `asperity liquids` lists all")
    liquids_file: NonEmpty | None = setting(None, option="--liquids-file", help="Your own liquids, a TOML file")
    surface_tension: SurfaceTension | None = setting(
        None, option="--surface-tension", help="Instead of that of the liquid: 25mN/m"
    )
    humidity: Humidity | None = setting(
        None, option="--humidity", help="Relative humidity, for the height of the menisci: 80%"
    )
    thickness: Length | None = setting(None, option="--film", help="Thickness; from the humidity by default, for water")
    meniscus_height: Length | None = setting(
        None, option="--meniscus-height", help="Gap at the rim of a meniscus; the thickness of the film by default"
    )
    contact_angle: tuple[Angle, ...] = setting(
        ("0 deg",), option="--contact-angle", help="Opposite the film, or on both surfaces: 10deg; 60deg,60deg"
    )
    viscosity: Viscosity | None = setting(None, option="--viscosity", help="For the viscous part of friction: 10mPa*s")
    shear_strength: Pressure | None = setting(
        None, option="--shear-strength", help="Of the liquid, at which its viscous stress ends: 10MPa"
    )
    feedback: bool = setting(
        True,
        option="--meniscus-feedback",
        help="Let the menisci press the surfaces together; else their force is that in the gap of the load alone",
    )

    @model_validator(mode="after")
    def _whole(self) -> FilmSettings:
        if len(self.contact_angle) not in (1, 2):
            raise InputError(
                '.contact_angle must be one or two angles, such as "10 deg" or ["60 deg", "60 deg"], but is '
                f"{len(self.contact_angle)}."
            )
        if self.liquid is None and self.surface_tension is None:
            raise InputError(
                " must give a liquid, such as {film.liquid=water}, or its surface tension "
                "({film.surface_tension}), but gives neither."
            )
        if self.liquid is None and self.humidity is not None:
            raise InputError(
                " must name its liquid ({film.liquid}) beside a humidity, which needs the molar volume, but does not."
            )
        if self.humidity is None and self.thickness is None:
            raise InputError(
                " must give the thickness of the film, such as {film.thickness=2 nm}, or a humidity "
                "({film.humidity}), but gives neither."
            )
        if self.humidity is not None and self.meniscus_height is not None:
            raise InputError(" must not give both a humidity and a meniscus_height: the second follows from the first.")
        return self


@dataclass(frozen=True)
class Wetted:
    """The film that is asked for, and its friction."""

    film: LiquidFilm
    friction: FrictionLaw


def substance_of(document: Any, folder: Path) -> Liquid:
    """The liquid of the table [film], whose liquids file starts at ``folder``.

    InputError if it is unknown.
    """
    from ...solids.library import Liquid, liquid

    table: FilmSettings = document.film
    tension = math.nan if table.surface_tension is None else table.surface_tension
    if table.liquid is None:
        return Liquid(tension)
    own = None if table.liquids_file is None else folder / table.liquids_file
    named = liquid(table.liquid, library=own)
    return named if math.isnan(tension) else replace(named, surface_tension=tension)


class Menisci(Part):
    """Menisci that press the surfaces together."""

    name = "film"
    title = "Liquid film and menisci"
    purpose = "How a thin liquid film wets the contact, where menisci form and how hard they pull."
    table = "film"
    settings = FilmSettings
    basic = ("liquid", "humidity", "thickness")
    of_result = "menisci"
    work = "physics.menisci.work:MenisciWork"
    headline = "meniscus_force"
    takes_friction = static_friction = True
    moved = MappingProxyType({"friction": "friction.coefficient", "speed": "friction.speed"})
    quantities = WET_SCALARS

    def asked(self, document: Any, folder: Path) -> Wetted:
        """The film of the table [film], whose liquids file starts at ``folder``, with the friction
        of the table [friction].

        Raises
        ------
        InputError
            If the liquid is unknown, does not wet, or lacks a value that is needed.
        """
        from .film import LiquidFilm

        table: FilmSettings = document.film
        substance = substance_of(document, folder)
        angles = table.contact_angle
        sides = (angles[0], angles[1] if len(angles) == 2 else 0.0)
        if table.humidity is not None:
            thickness = math.nan if table.thickness is None else table.thickness
            film = LiquidFilm.at_humidity(substance, table.humidity, thickness=thickness, contact_angles=sides)
        else:
            height = math.nan if table.meniscus_height is None else table.meniscus_height
            film = LiquidFilm.of(substance, float(table.thickness or 0.0), meniscus_height=height, contact_angles=sides)
        known = {key: value for key in ("viscosity", "shear_strength") if (value := getattr(table, key)) is not None}
        return Wetted(
            replace(film, feedback=table.feedback, **known), friction_law(document.friction, sheared=sticks(document))
        )

    def coupling(self, ask: Wetted) -> Mapping[str, Any]:
        """The film joins the solve."""
        return {"film": ask.film, "friction": ask.friction}


class WetTheory(Part):
    """The theory of summits beside the menisci of the map."""

    name = "wet_theory"
    title = "Statistical theory beside it"
    table = "film"
    quantities = (Quantity("statistical_meniscus_force", "N", "meniscus force of the theory of summits", costly=True),)
    work = "physics.menisci.work:WetTheoryWork"
