"""Rolling: the steady contact under creepage and spin, its creep-force curve, and rough wheels."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, Length, NonEmpty, Number, Whole
from ...parts.part import Part
from ..friction.part import friction_law

if TYPE_CHECKING:
    from ..friction.law import FrictionLaw
    from .rolling import Creepage

CreepageShare = Annotated[float, Number("number")]
Spin = Annotated[float, Number("rad/m")]
Way = Annotated[str, Choice({name: name for name in ("x", "-x", "y", "-y")})]


class RollingSettings(Settings):
    """Steady rolling with the friction of the table [friction]: creepages, spin, and the direction.

    The surface is the wheel, which stands in the frame of the contact. A ``roughness_file`` is a
    map of the same pixel that moves through it with the material, over a ``distance``. With
    ``points`` the curve of forces is found up to the creepages.
    """

    longitudinal: CreepageShare = setting(
        0.0, option="--creepage", help="Slip of the counter body over rolling speed, along the rolling direction: 0.1%"
    )
    lateral: CreepageShare = setting(0.0, option="--lateral-creepage", help="The same across it: 0.05%")
    spin: Spin = setting(
        "0 rad/m", option="--spin", help="Relative rotation over rolling speed, for the free boundary: 0.5rad/m"
    )
    direction: Way = setting("x", option="--rolling-direction", help="Where the contact rolls to: x, -x, y or -y")
    points: Annotated[int, Whole(0)] = setting(
        0, option="--creep-points", help="Points of the creep-force curve up to the creepages"
    )
    roughness_file: NonEmpty | None = setting(
        None,
        option="--rolling-roughness",
        help="Map of roughness that moves with the material, of the pixel of the wheel",
    )
    distance: Length | None = setting(
        None, option="--rolling-distance", help="Rolled over a rough wheel; by default once around after the running-in"
    )

    @model_validator(mode="after")
    def _whole(self) -> RollingSettings:
        if not (self.longitudinal or self.lateral or self.spin):
            raise InputError(
                " must give a creepage or spin other than zero, such as {rolling.longitudinal=0.1%}, but gives none."
            )
        if self.distance is not None and self.roughness_file is None:
            raise InputError(
                ".distance must be given together with the roughness ({rolling.roughness_file}), but is given "
                "alone: a smooth wheel rolls steadily."
            )
        return self


@dataclass(frozen=True)
class Rolls:
    """What is asked of rolling, the law of friction, and the file of the roughness."""

    settings: RollingSettings
    law: FrictionLaw
    roughness: Path | None

    @property
    def creepage(self) -> Creepage:
        """That of the whole."""
        from .rolling import Creepage

        table = self.settings
        return Creepage(float(table.longitudinal), float(table.lateral), float(table.spin))


SCALARS = (
    Quantity("rolling_longitudinal_force", "N", "force on the body along the rolling direction"),
    Quantity("rolling_lateral_force", "N", "force on the body across the rolling direction"),
    Quantity("rolling_torque", "N*m", "torque on the body about the centre, rolling"),
    Quantity("traction_coefficient", "1", "longitudinal force of rolling / normal force"),
    Quantity("rolling_friction_share", "1", "tangential force of rolling / largest that friction bears"),
    Quantity("rolling_slip_area_fraction", "1", "area that slips as it rolls / real contact area (pixels)"),
    Quantity("rolling_heat", "J/m", "heat per distance rolled"),
    Quantity("rolling_max_slip", "1", "largest slip velocity / rolling speed"),
    Quantity("fastsim_longitudinal_force", "N", "longitudinal force by FASTSIM"),
    Quantity("fastsim_lateral_force", "N", "lateral force by FASTSIM"),
    Quantity("carter_longitudinal_force", "N", "longitudinal force by Carter"),
    Quantity("rolling_force_deviation", "N", "standard deviation of the longitudinal force of the rough wheel"),
)
"""Numbers of a rolling contact; NaN where a theory does not hold or nothing is rough."""

_GRID = ("x", "y")
FIELDS = (
    *(
        Quantity(f"rolling_traction_{a}", "Pa", f"shear traction on the body along {a} as it rolls", _GRID)
        for a in "xy"
    ),
    *(Quantity(f"rolling_slip_{a}", "1", f"slip velocity / rolling speed along {a}", _GRID) for a in "xy"),
    Quantity("rolling_bound", "Pa", "bound of the friction as it rolls", _GRID),
)
"""Fields of a rolling contact."""

CURVE = "creep_point"
PATH = "rolling_move"


def _columns(prefix: str, quantities: tuple[Quantity, ...], axis: str) -> tuple[Quantity, ...]:
    return tuple(replace(item, name=f"{prefix}_{item.name}", dims=(axis,)) for item in quantities)


class Rolling(Part):
    """The steady contact of bodies that roll with creepage, or a rough wheel."""

    name = "rolling"
    title = "Rolling"
    purpose = "What traction a rolling contact carries at small creepages and spin."
    table = "rolling"
    settings = RollingSettings
    work = "physics.rolling.work:RollingWork"
    takes_friction = True

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars, fields, columns of the curve and of the path of a rough wheel."""
        from .creep_curve import CREEPAGES, FORCES
        from .rough import PATH as MOVES

        return (*SCALARS, *FIELDS, *_columns("creep", (*CREEPAGES, *FORCES), CURVE), *_columns("rolled", MOVES, PATH))

    def asked(self, document: Any, folder: Path) -> Rolls:
        """The table [rolling] with the law of friction."""
        table: RollingSettings = document.rolling
        friction = document.friction
        if friction.law == "coulomb" and not friction.coefficient:
            raise InputError(
                "friction must be given together with rolling, but its coefficient is 0. Give "
                "{friction.coefficient=0.3} or {friction.law=full stick}.",
                subject="friction",
            )
        if document.shear is not None:
            raise InputError(
                "rolling must be given without shear, but both are given: shift, force or twist "
                "({shear.shift}, {shear.force}, {shear.twist}) are those of a contact that does not roll."
            )
        rough = None if table.roughness_file is None else folder / table.roughness_file
        return Rolls(table, friction_law(friction, sheared=True), rough)
