"""The table [film] of a document: a liquid between the surfaces, its menisci and its friction."""

from __future__ import annotations

from pydantic import model_validator

from ...core.errors import InputError
from ...core.settings import Settings, setting
from ...core.values import Angle, Humidity, Length, NonEmpty, NonNegative, Pressure, Speed, SurfaceTension, Viscosity


class FilmTable(Settings):
    """A liquid film, and friction where it is wanted.

    The liquid is a named one or given by its ``surface_tension``, which else replaces that of the named one. Either the
    ``humidity`` fixes the height of the menisci, and for water the thickness of the film, or ``thickness`` and
    ``meniscus_height`` are given, the second being the first by default. One ``contact_angle`` is that on the surface
    opposite the film. ``friction`` is the dry coefficient, ``speed`` that of the viscous part.
    """

    liquid: NonEmpty | None = None
    liquids_file: NonEmpty | None = None
    surface_tension: SurfaceTension | None = None
    humidity: Humidity | None = None
    thickness: Length | None = None
    meniscus_height: Length | None = None
    contact_angle: tuple[Angle, ...] = setting(("0 deg",))
    viscosity: Viscosity | None = None
    shear_strength: Pressure | None = None
    friction: NonNegative = 0.0
    speed: Speed | None = None

    @model_validator(mode="after")
    def _whole(self) -> FilmTable:
        if len(self.contact_angle) not in (1, 2):
            raise InputError(
                f'.contact_angle must be one or two angles, such as "10 deg" or ["60 deg", "60 deg"], but is {len(self.contact_angle)}.'
            )
        if self.liquid is None and self.surface_tension is None:
            raise InputError(' must give a liquid, such as "water", or its surface_tension, but gives neither.')
        if self.liquid is None and self.humidity is not None:
            raise InputError(" must name its liquid beside a humidity, which needs the molar volume, but does not.")
        if self.humidity is None and self.thickness is None:
            raise InputError(' must give the thickness of the film, such as "2 nm", or a humidity, but gives neither.')
        if self.humidity is not None and self.meniscus_height is not None:
            raise InputError(" must not give both a humidity and a meniscus_height: the second follows from the first.")
        return self
