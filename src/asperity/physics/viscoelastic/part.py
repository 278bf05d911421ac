"""Viscoelasticity: temperature, loads in time, heat, and small oscillations of a contact of solids
that relax."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass, replace
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Count, Fraction, Length, Number, Temperature, Whole
from ...parts.part import Part

if TYPE_CHECKING:
    from ...contact.controls import Control, Step

Duration = Annotated[float, Number("time", least=0.0)]
Frequency = Annotated[float, Number("Hz", above=0.0)]


class ViscoelasticSettings(Settings):
    """Loads in time on viscoelastic bodies: how long the way to each load takes (``ramp``) and how
    long it is held (``hold``).

    One time stands for all loads of a path; else there is one for each. Without them loads come at
    once, to solids as they are at the first instant. All relaxation times are those at
    ``temperature``. A small oscillation about the last load has a ``frequency``.
    """

    ramp: tuple[Duration, ...] | None = setting(
        None, option="--ramp", help="Time from one load to the next, one for all or each: 1s; at once by default"
    )
    hold: tuple[Duration, ...] | None = setting(
        None, option="--hold", help="Time for which each load is held, one for all or each: 60s"
    )
    repeat: Annotated[int, Whole(1, 10000)] = setting(
        1, option="--repeat", help="Number of times the loads are run through"
    )
    temperature: Temperature | None = setting(
        None, option="--temperature", help="Of all viscoelastic solids, which must have a shift: 320K"
    )
    tolerance: Fraction = setting(
        1e-3, option="--time-tolerance", help="Relative error of the displacement that a step of time may add"
    )
    steps: Count | None = setting(
        None, option="--time-steps", help="Equal steps of time in each ramp and hold instead of steps by their error"
    )
    frequency: Frequency | None = setting(
        None, option="--frequency", help="Of a small oscillation about the last load: 10Hz"
    )
    amplitude: Length | None = setting(
        None, option="--oscillation-amplitude", help="Of the approach in this oscillation, for its heat: 1nm"
    )

    @model_validator(mode="after")
    def _whole(self) -> ViscoelasticSettings:
        if self.amplitude is not None and self.frequency is None:
            raise InputError(
                ".amplitude must be given together with the frequency ({viscoelastic.frequency}) of an "
                "oscillation, but is given alone."
            )
        if self.repeat > 1 and not self.in_time:
            raise InputError(
                ".repeat must be given together with {viscoelastic.ramp} or {viscoelastic.hold}, but is given "
                "without: loads that come at once leave the same contact again."
            )
        return self

    @property
    def in_time(self) -> bool:
        """Whether any load takes time."""
        return any(float(time) > 0.0 for time in (*(self.ramp or ()), *(self.hold or ())))


@dataclass(frozen=True)
class InTime:
    """The table, and which of the steps of a load path end at a turning point: every so many
    (``every``), the first too with ``first``.

    ``slides``: whether what matters is steady sliding, and not the first instant.
    """

    settings: ViscoelasticSettings
    every: int = 1
    first: bool = False
    slides: bool = False

    def turning(self, controls: tuple[Step | Control, ...]) -> tuple[Step | Control, ...]:
        """The steps of ``controls`` that end at a turning point of the load, and all that move the
        surfaces along each other."""
        from ...contact.controls import as_step
        from ...contact.tangential import Shift, TangentialForce

        still = (None, Shift(), TangentialForce())
        pressed = tuple(itertools.takewhile(lambda control: as_step(control).tangential in still, controls))
        return (*pressed[0 if self.first else self.every - 1 :: self.every], *controls[len(pressed) :])


STEP, MOMENT = "load_step", "moment"
"""Axes of quantities: steps of the load, and moments in time."""

SCALARS = (
    Quantity("viscoelastic_time", "s", "time since the virgin state"),
    Quantity("viscoelastic_heat", "J", "heat of viscoelastic solids since the virgin state"),
    Quantity("viscoelastic_stored", "J", "energy stored in viscoelastic contact"),
    Quantity("viscoelastic_work", "J", "work of the force between the solids since the virgin state"),
    Quantity("retarded_share", "1", "largest displacement that is not by the present pressure / largest displacement"),
    Quantity(
        "time_error", "1", "sum of what the steps of time add to the error of the displacement, largest of a step"
    ),
    Quantity("time_solves", "1", "solves of all steps of time, rejected ones included"),
)
OSCILLATION = (
    Quantity("storage_stiffness", "Pa/m", "storage stiffness of a small oscillation"),
    Quantity("loss_stiffness", "Pa/m", "loss stiffness of a small oscillation"),
    Quantity("loss_tangent", "1", "loss over storage stiffness"),
    Quantity("oscillation_heat", "J", "heat of one cycle of the oscillation"),
)
STEPS = (
    Quantity("step_end", "s", "time at the end of the step of the load", (STEP,)),
    Quantity("step_moment", "1", "number of the moment at the end of the step of the load, from 0", (STEP,)),
    Quantity("step_heat", "J", "heat of the step of the load", (STEP,)),
    Quantity("step_stored", "J", "energy stored after the step of the load", (STEP,)),
    Quantity("step_work", "J", "work of the force in the step of the load", (STEP,)),
)


class Viscoelasticity(Part):
    """What time does to a contact of viscoelastic bodies."""

    name = "viscoelastic"
    title = "Viscoelasticity"
    purpose = "How the contact grows or relaxes in time on bodies that creep."
    table = "viscoelastic"
    settings = ViscoelasticSettings
    basic = ("hold",)
    implied = staticmethod(attrgetter("relaxes"))
    whole_path = True
    work = "physics.viscoelastic.work:ViscoelasticityWork"

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars, energies of the steps of the load, and columns of all moments."""
        from .moments import COLUMNS

        moments = (replace(item, name=f"moment_{item.name}", dims=(MOMENT,)) for item in COLUMNS)
        return (*SCALARS, *OSCILLATION, *STEPS, *moments)

    def asked(self, document: Any, folder: Path) -> InTime:
        """The settings with the turning points of the load path."""
        settings = self.settings_in(document) or ViscoelasticSettings()
        path, slides = document.control.path, document.hysteresis is not None
        every, first = (1, False) if path is None else (path.steps, path.mean_gap is not None)
        return InTime(settings, every, first, slides)

    def options(self, ask: InTime) -> Mapping[str, Any]:
        """How durations are divided."""
        from ...contact.time_division import TimeSteps

        return {"time_steps": TimeSteps(float(ask.settings.tolerance), ask.settings.steps)}
