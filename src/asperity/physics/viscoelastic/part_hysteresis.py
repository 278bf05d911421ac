"""Hysteresis: steady sliding of a rough body over a viscoelastic one, its friction, area and heat,
and Persson's theory beside it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Angle, Length, Number, Whole
from ...parts.part import Part

if TYPE_CHECKING:
    pass

SlidingSpeed = Annotated[float, Number("speed", above=0.0)]
Share = Annotated[float, Number(above=0.0, most=1.0)]

USUAL_POINTS = 9
"""Speeds of the curve, if not said otherwise."""


class HysteresisSettings(Settings):
    """Steady sliding of the rough body over the flat viscoelastic one at a ``speed``; with
    ``slowest`` and ``fastest`` a curve against speed.

    With a ``distance`` also the start of the motion at this speed, in steps of time from the load
    at once.
    """

    speed: SlidingSpeed | None = setting(
        None, option="--sliding-speed", help="Of the rough body over the viscoelastic one, steadily: 1cm/s"
    )
    direction: Angle = setting("0 deg", option="--sliding-direction", help="Of the rough body, from x towards y: 90deg")
    slowest: SlidingSpeed | None = setting(None, option="--slowest", help="First speed of a curve: 0.1mm/s")
    fastest: SlidingSpeed | None = setting(None, option="--fastest", help="Last speed of a curve: 10m/s")
    points: Annotated[int, Whole(2, 1000)] = setting(USUAL_POINTS, option="--speed-points", help="Speeds of the curve")
    reduction: Share | None = setting(
        None,
        option="--reduction",
        help="Of the deformation in partial contact, gamma of Persson's theory; 1, for none, by default",
    )

    distance: Length | None = setting(
        None, option="--sliding-distance", help="From the first load on, for the start of sliding in time: 2mm"
    )
    steps_per_pixel: Annotated[int, Whole(1, 100)] | None = setting(
        None, option="--steps-per-pixel", help="Steps of time in which the rough body moves by a pixel; 2 by default"
    )

    @model_validator(mode="after")
    def _whole(self) -> HysteresisSettings:
        if self.speed is None:
            raise InputError(" must give the speed, such as {hysteresis.speed=1 cm/s}, but does not.")
        if (self.slowest is None) != (self.fastest is None):
            raise InputError(" must give both {hysteresis.slowest} and {hysteresis.fastest} or neither, but gives one.")
        if self.slowest is not None and self.fastest is not None and not float(self.slowest) < float(self.fastest):
            raise InputError(
                f".fastest must be greater than the slowest speed {float(self.slowest):g} m/s, but is "
                f"{float(self.fastest):g} m/s."
            )
        if self.slowest is None and self.points != USUAL_POINTS:
            raise InputError(
                ".points must be given together with {hysteresis.slowest} and {hysteresis.fastest}, but is "
                "given without."
            )
        if self.distance is None and self.steps_per_pixel is not None:
            raise InputError(
                ".steps_per_pixel must be given together with the distance ({hysteresis.distance}), but is "
                "given without."
            )
        return self


SCALARS = (
    Quantity(
        "hysteresis_friction",
        "1",
        "coefficient of hysteretic friction, by the loss in all waves, over the load from outside",
    ),
    Quantity("hysteresis_slope_friction", "1", "coefficient of hysteretic friction, by the slope of the surface"),
    Quantity("hysteresis_friction_force", "N", "force of hysteretic friction"),
    Quantity("hysteresis_heat", "W/m^2", "heat of hysteretic friction per nominal area and time"),
    Quantity("sliding_area_fraction", "1", "real contact area / nominal area while sliding"),
    Quantity("sliding_max_pressure", "Pa", "maximum pressure while sliding"),
    Quantity("sliding_mean_gap", "m", "mean gap while sliding"),
    Quantity("sliding_energy_error", "1", "bound on the error of the pressure while sliding, in energy"),
    Quantity("persson_friction", "1", "coefficient of hysteretic friction by Persson's theory"),
    Quantity(
        "persson_sliding_area_fraction", "1", "real contact area / nominal area while sliding by Persson's theory"
    ),
)
"""Numbers of a sliding contact; NaN where the theory does not hold, and of coefficients where the
load pulls."""

FIELD = Quantity("sliding_pressure", "Pa", "contact pressure while sliding", ("x", "y"))

CURVE = "speed_point"
COLUMNS = (
    Quantity("by_speed_speed", "m/s", "sliding speed", (CURVE,)),
    Quantity("by_speed_friction", "1", "coefficient of hysteretic friction", (CURVE,)),
    Quantity("by_speed_area_fraction", "1", "real contact area / nominal area while sliding", (CURVE,)),
    Quantity("by_speed_heat", "W/m^2", "heat of hysteretic friction per nominal area and time", (CURVE,)),
    Quantity("by_speed_persson_friction", "1", "coefficient of hysteretic friction by Persson's theory", (CURVE,)),
    Quantity("by_speed_persson_area_fraction", "1", "real contact area / nominal area by Persson's theory", (CURVE,)),
)
"""Columns of the curve against speed."""


class Hysteresis(Part):
    """Friction of a rough body that slides steadily over a viscoelastic one."""

    name = "hysteresis"
    title = "Hysteretic friction"
    purpose = "What friction a viscoelastic body causes by its own losses at a sliding speed."
    table = "hysteresis"
    settings = HysteresisSettings
    basic = ("speed",)
    quantities = (*SCALARS, FIELD, *COLUMNS)
    work = "physics.viscoelastic.work_hysteresis:HysteresisWork"

    def asked(self, document: Any, folder: Path) -> HysteresisSettings:
        """The table [hysteresis], beside no other motion."""
        table: HysteresisSettings = document.hysteresis
        for name in ("shear", "rolling"):
            if getattr(document, name) is not None:
                raise InputError(
                    f"{name} must be left out where hysteresis ({{hysteresis.speed}}) is given, but both are: "
                    "sliding over a viscoelastic body is solved without another motion of the surfaces."
                )
        return table
