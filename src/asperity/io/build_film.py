"""Liquid film and friction of a problem document."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

from ..contact.wet import Friction
from ..contact.wetting import LiquidFilm
from ..solids.library import Liquid, liquid
from .quantities import si_values
from .schemas.film import FilmTable


def build_film(table: FilmTable, folder: Path) -> tuple[LiquidFilm, Friction]:
    """Film and friction that ``table`` describes; the path of its liquids file starts at ``folder``.

    Raises
    ------
    InputError
        If the liquid is unknown, does not wet, or lacks a value that is needed.
    """
    given = si_values(table, leave=("liquid", "liquids_file", "friction"))
    substance = _liquid(table, given.get("surface_tension", math.nan), folder)
    angles = given["contact_angle"]
    sides = (angles[0], angles[1] if len(angles) == 2 else 0.0)
    if "humidity" in given:
        thickness = given.get("thickness", math.nan)
        film = LiquidFilm.at_humidity(substance, given["humidity"], thickness=thickness, contact_angles=sides)
    else:
        height = given.get("meniscus_height", math.nan)
        film = LiquidFilm.of(substance, given["thickness"], meniscus_height=height, contact_angles=sides)
    known = {key: given[key] for key in ("viscosity", "shear_strength") if key in given}
    return replace(film, **known), Friction(table.friction, given.get("speed", 0.0))


def _liquid(table: FilmTable, surface_tension: float, folder: Path) -> Liquid:
    """The named liquid, with the given surface tension if any."""
    if table.liquid is None:
        return Liquid(surface_tension)
    found = liquid(table.liquid, library=None if table.liquids_file is None else folder / table.liquids_file)
    return found if math.isnan(surface_tension) else replace(found, surface_tension=surface_tension)
