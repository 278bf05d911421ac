"""The table [film] of a document: a liquid between the surfaces, its menisci and its friction."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import AfterValidator, BeforeValidator, Field, model_validator

from ...core import require, units
from ...core.errors import InputError
from .values import Angle, Length, Pressure, SurfaceTension, Table, Text, Viscosity


def _humidity(value: object) -> object:
    """Text of a share of one, such as "80 %"; a bare number is one too."""
    text = repr(value) if isinstance(value, float) else value
    if isinstance(text, str):
        share = units.parse(text, "number", "")
        try:
            require.between(share, 0.0, 1.0, "")
        except InputError:
            raise InputError(f" must be greater than 0 % and less than 100 %, but is {value!r}.") from None
    return text


def _angles(value: object) -> object:
    """One or two angles as a tuple of texts."""
    if isinstance(value, str):
        value = [part.strip() for part in value.split(",")]
    if not isinstance(value, list | tuple) or len(value) not in (1, 2):
        raise InputError(f' must be one or two angles, such as "10 deg" or ["60 deg", "60 deg"], but is {value!r}.')
    return tuple(value)


def _speed(value: object) -> object:
    if isinstance(value, str):
        require.not_negative(units.parse(value, "speed", ""), "")
    return value


Humidity: TypeAlias = Annotated[
    str, BeforeValidator(_humidity), Field(json_schema_extra={"quantity": "number"}, examples=["80 %"])
]
"""Text of a relative humidity between 0 and 1."""

Speed: TypeAlias = Annotated[
    str, BeforeValidator(_speed), Field(json_schema_extra={"quantity": "speed"}, examples=["1 mm/s"])
]
"""Text of a speed >= 0."""

Angles: TypeAlias = Annotated[tuple[Angle, ...], BeforeValidator(_angles)]
"""One angle, or two."""


class FilmTable(Table):
    """A liquid film, and friction where it is wanted.

    The liquid is a named one or given by its ``surface_tension``, which else replaces that of the named one. Either the
    ``humidity`` fixes the height of the menisci, and for water the thickness of the film, or ``thickness`` and
    ``meniscus_height`` are given, the second being the first by default. One ``contact_angle`` is that on the surface
    opposite the film. ``friction`` is the dry coefficient, ``speed`` that of the viscous part.
    """

    liquid: Text | None = None
    liquids_file: Text | None = None
    surface_tension: SurfaceTension | None = None
    humidity: Humidity | None = None
    thickness: Length | None = None
    meniscus_height: Length | None = None
    contact_angle: Angles = ("0 deg",)
    viscosity: Viscosity | None = None
    shear_strength: Pressure | None = None
    friction: Annotated[float, AfterValidator(lambda value: require.not_negative(value, ""))] = 0.0
    speed: Speed | None = None

    @model_validator(mode="after")
    def _whole(self) -> FilmTable:
        if self.liquid is None and self.surface_tension is None:
            raise InputError(' must give a liquid, such as "water", or its surface_tension, but gives neither.')
        if self.liquid is None and self.humidity is not None:
            raise InputError(" must name its liquid beside a humidity, which needs the molar volume, but does not.")
        if self.humidity is None and self.thickness is None:
            raise InputError(' must give the thickness of the film, such as "2 nm", or a humidity, but gives neither.')
        if self.humidity is not None and self.meniscus_height is not None:
            raise InputError(" must not give both a humidity and a meniscus_height: the second follows from the first.")
        return self
