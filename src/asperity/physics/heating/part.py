"""Frictional heating: how hot the spots of a sliding contact get, and which body takes the heat."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Angle, Choice, Length, Number, StepOfPath, Temperature, ThermalResistance, Voltage
from ...parts.part import Part

WORDS = {"counter_body": "counter body", "body": "body", "opposite": "opposite", "rolling": "rolling"}

Moving = Annotated[str, Choice({name: name for name in WORDS})]
SlidingSpeed = Annotated[float, Number("speed", above=0.0)]
RollingSpeed = Annotated[float, Number("speed")]
Coefficient = Annotated[float, Number(least=0.0)]


class HeatingSettings(Settings):
    """Steady flash temperature of the contact while the counter body slides over the body, and the
    share of the heat that each takes, by the conductivities and heat capacities of the materials.

    The spots rest with one of the bodies, whose roughness makes them, and the other moves under
    them; in opposite or rolling motion both do. Temperatures of a contact that repeats are those
    over the mean planes of the bodies, which have the bulk temperatures.
    """

    speed: SlidingSpeed | None = setting(None, option="--flash-speed", help="Sliding speed, which must be given: 1m/s")
    friction: Coefficient | None = setting(
        None, option="--flash-friction", help="Coefficient, where the contact is solved without friction: 0.2"
    )
    moving: Moving = setting(
        "counter_body", option="--moving", help="What moves under the spots: counter_body, body, opposite or rolling"
    )
    rolling: RollingSpeed | None = setting(
        None, option="--rolling-speed", help="Mean speed of both surfaces, of rolling with slip: 5m/s"
    )
    direction: Angle | None = setting(
        None, option="--flash-direction", help="Of the sliding counter body, from x towards y: 90deg"
    )
    bulk_body: Temperature = setting("293.15 K", option="--bulk-body", help="Temperature of the body: 350K")
    bulk_counter_body: Temperature = setting(
        "293.15 K", option="--bulk-counter-body", help="Temperature of the counter body: 350K"
    )
    resistance_body: ThermalResistance = setting(
        "0 m^2*K/W", option="--heat-film-body", help="Between the rubbing plane and the body: 1e-7m^2*K/W"
    )
    resistance_counter_body: ThermalResistance = setting(
        "0 m^2*K/W", option="--heat-film-counter-body", help="The same on the side of the counter body"
    )
    sink_body: Length | None = setting(
        None, option="--sink-body", help="Depth in which the body has its bulk temperature, for the mean heat: 5mm"
    )
    sink_counter_body: Length | None = setting(None, option="--sink-counter-body", help="The same of the counter body")
    voltage: Voltage | None = setting(
        None, option="--flash-voltage", help="Between the bodies, for Joule heat of the same spots: 20mV"
    )
    allowed: Temperature | None = setting(
        None, option="--allowed-temperature", help="Of the hottest point, to compare with: 450K"
    )
    section: Length | None = setting(
        None, option="--heat-section", help="How deep a section below the hottest point is computed: 20um"
    )
    step: StepOfPath = setting(
        "peak",
        option="--flash-step",
        help="Of a load path: peak for that of the largest load, last, or its number from 1",
    )

    @model_validator(mode="after")
    def _whole(self) -> HeatingSettings:
        if self.speed is None:
            raise InputError(".speed must be given, but is not. Give the sliding speed ({heating.speed=1m/s}).")
        if (self.rolling is None) != (self.moving != "rolling"):
            given = "is not" if self.rolling is None else f"is {self.rolling:g} m/s, and {WORDS[self.moving]} moves"
            raise InputError(
                f".rolling must be given for rolling bodies, and for these alone, but {given}. Give both "
                "{heating.moving=rolling} and {heating.rolling=5m/s}, or neither."
            )
        if (self.sink_body is None) != (self.sink_counter_body is None):
            given = "sink_body" if self.sink_counter_body is None else "sink_counter_body"
            other = "sink_counter_body" if given == "sink_body" else "sink_body"
            raise InputError(
                f".{other} must be given together with {given}, which shares the mean heat, but is not. Give both "
                "{heating.sink_body=5mm} and {heating.sink_counter_body=5mm}."
            )
        return self


_GRID = ("x", "y")
SCALARS = (
    Quantity("flash_temperature", "K", "flash temperature: largest rise over the bulk"),
    Quantity("hottest_temperature", "K", "temperature of the hottest point, with the bulk"),
    Quantity("flash_heat_mean", "K", "mean rise on the contact, weighted with the heat"),
    Quantity("flash_mean", "K", "mean rise on the contact"),
    Quantity("heat_share", "1", "share of the heat that goes into the body"),
    Quantity("frictional_power", "W", "heat made per time"),
    Quantity("flash_x", "m", "x of the hottest point"),
    Quantity("flash_y", "m", "y of the hottest point"),
    Quantity("flash_blok", "K", "flash temperature by Blok from both largest rises"),
    Quantity("flash_disc", "K", "flash temperature of a Hertzian disc like the hottest spot (Tian & Kennedy)"),
    Quantity("flash_all_body", "K", "largest rise with all heat in the body"),
    Quantity("flash_all_counter_body", "K", "largest rise with all heat in the counter body"),
    Quantity("flash_joule", "K", "rise by Joule heat"),
    Quantity("flash_peclet", "1", "Péclet number of the hottest spot, v a/2κ"),
    Quantity("flash_pixel_peclet", "1", "Péclet number of a pixel"),
    Quantity("flash_pixels", "1", "pixels across the hottest spot"),
    Quantity("flash_spot_radius", "m", "radius of a circle of the area of the hottest spot"),
    Quantity("flash_mismatch", "K", "largest difference of both temperatures on the contact"),
    Quantity("critical_wavelength", "m", "length from which on thermal expansion makes sliding unstable"),
)
"""Numbers of a heated contact; NaN where there is no such thing."""

FIELDS = (
    Quantity("flash_rise", "K", "temperature rise on the contact", _GRID),
    Quantity("flash_body", "K", "temperature rise of the surface of the body", _GRID),
    Quantity("flash_counter_body", "K", "temperature rise of the surface of the counter body", _GRID),
    Quantity("friction_heat", "W/m**2", "heat made per area", _GRID),
    Quantity("friction_heat_body", "W/m**2", "heat into the body per area", _GRID),
)
DISTRIBUTION = (
    Quantity("flash_level", "K", "rise that a share of the contact exceeds", ("flash_part",)),
    Quantity("flash_part", "1", "share of the contact that is hotter", ("flash_part",)),
)
SECTION = (
    Quantity("heat_depth", "m", "depth below the surface", ("heat_depth",)),
    Quantity("heat_section_body", "K", "rise in the body below the hottest line", ("heat_depth", "x")),
    Quantity("heat_section_counter_body", "K", "rise in the counter body below it", ("heat_depth", "x")),
)
PATH = (
    Quantity("path_flash_load", "Pa", "mean contact pressure at each step", ("step",)),
    Quantity("path_flash_temperature", "K", "flash temperature at each step", ("step",)),
    Quantity("path_heat_share", "1", "share of the heat into the body at each step", ("step",)),
)
QUANTITIES = (*SCALARS, *FIELDS, *DISTRIBUTION, *SECTION, *PATH)


class Heating(Part):
    """Flash temperature of the sliding contact."""

    name = "heating"
    title = "Frictional heating"
    purpose = "How hot the rubbing spots become, and how the heat divides between the bodies."
    table = "heating"
    settings = HeatingSettings
    basic = ("speed", "friction", "moving")
    quantities = QUANTITIES
    work = "physics.heating.work:HeatingWork"
    headline = "flash_temperature"
    whole_path = True

    def asked(self, document: Any, folder: Path) -> HeatingSettings:
        """The settings, with coefficient and direction of the table [friction] where they give none
        and all points slide."""
        ask: HeatingSettings = document.heating
        rubbing, more = getattr(document, "friction", None), dict[str, Any]()
        if rubbing is None or getattr(document, "rolling", None) is not None:
            return ask
        slides = rubbing.law == "coulomb" and rubbing.limit is None and getattr(document, "shear", None) is None
        if ask.friction is None and slides and rubbing.coefficient:
            more["friction"] = rubbing.coefficient
        if ask.direction is None and (rubbing.coefficient or not slides):
            more["direction"] = rubbing.direction
        return ask.model_copy(update=more)
