"""Options for a liquid film between the surfaces, and the table of the document they stand for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Annotated, Any

from .panel import options_of
from .stressing import StressOptions

FILM = "Liquid film (with --friction for the static friction)"

_option = options_of(FILM)


@dataclass(frozen=True)
class FilmOptions:
    """A liquid film; none unless one of these is given."""

    liquid: Annotated[str | None, _option("--liquid", "Name: water, PFPE; `asperity liquids` lists all.")] = None
    liquids_file: Annotated[Path | None, _option("--liquids-file", "Your own liquids, a TOML file.")] = None
    surface_tension: Annotated[
        str | None, _option("--surface-tension", "Instead of that of the liquid: 25mN/m.", "TENSION")
    ] = None
    humidity: Annotated[
        str | None, _option("--humidity", "Relative humidity, for the height of the menisci: 80%.", "SHARE")
    ] = None
    film: Annotated[str | None, _option("--film", "Thickness; from the humidity by default, for water.", "LENGTH")] = (
        None
    )
    meniscus_height: Annotated[
        str | None, _option("--meniscus-height", "Gap at the rim of a meniscus; --film by default.", "LENGTH")
    ] = None
    contact_angle: Annotated[
        str | None,
        _option("--contact-angle", "Opposite the film, or on both surfaces: 10deg; 60deg,60deg.", "ANGLE[,ANGLE]"),
    ] = None
    viscosity: Annotated[str | None, _option("--viscosity", "For the viscous part of friction: 10mPa*s.")] = None
    speed: Annotated[str | None, _option("--speed", "Sliding speed of that part: 1mm/s.", "SPEED")] = None


_KEYS = {"film": "thickness"}


def with_film(table: Mapping[str, Any], options: FilmOptions, stress: StressOptions) -> dict[str, Any]:
    """``table`` of a document with the film that the ``options`` ask for, over what it says of one already.

    The friction coefficient given for stresses is that of the film too.
    """
    values = {_KEYS.get(f.name, f.name): getattr(options, f.name) for f in fields(options)}
    given = {key: str(value) for key, value in values.items() if value is not None}
    before = table.get("film")
    if stress.friction is not None and (given or before is not None):
        given["friction"] = stress.friction  # type: ignore[assignment]
    return {**table, "film": {**(before if isinstance(before, dict) else {}), **given}} if given else dict(table)


def without_shared_friction(stress: StressOptions, table: Mapping[str, Any]) -> StressOptions:
    """``stress`` without its friction coefficient if that is all it says: beside a film in ``table`` it asks for none."""
    if "film" not in table or stress != StressOptions(friction=stress.friction):
        return stress
    return replace(stress, friction=None)


def film_names() -> dict[str, str]:
    """What the user calls the keys of the film."""
    names = {f"film.{_KEYS.get(f.name, f.name)}": f"--{f.name.replace('_', '-')}" for f in fields(FilmOptions)}
    names |= {f"film.contact_angle[{number}]": f"part {number} of --contact-angle" for number in (1, 2)}
    return {**names, "film.friction": "--friction", "film": "the film"}
