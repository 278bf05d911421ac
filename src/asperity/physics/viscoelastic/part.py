"""Viscoelasticity: temperature, loads in time, heat, and small oscillations of a contact of solids that relax."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.status import Advice
from ...core.units import percent, show
from ...core.values import Count, Fraction, Length, Number, Whole
from ...parts.part import Found, Part, Rows, Solved, Stored, Table, Words

if TYPE_CHECKING:
    from ...contact.controls import Control, Step
    from ...contact.problem import ContactProblem
    from ...plots.picture import Figure
    from ...solids.layers import Body
    from .figures import TimePicture

Duration = Annotated[float, Number("time", least=0.0)]
Temperature = Annotated[float, Number("temperature", above=0.0)]
Frequency = Annotated[float, Number("Hz", above=0.0)]

MUCH = 0.05
"""Sum of the errors of the steps of time from which on a finding says so."""


class ViscoelasticSettings(Settings):
    """Loads in time on viscoelastic bodies: how long the way to each load takes (``ramp``) and how long it is held (``hold``).

    One time stands for all loads of a path; else there is one for each. Without them loads come at once, to solids as they are at the
    first instant. All relaxation times are those at ``temperature``. A small oscillation about the last load has a ``frequency``.
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
                ".amplitude must be given together with the frequency (--frequency) of an oscillation, but is given alone."
            )
        if self.repeat > 1 and not self.in_time:
            raise InputError(
                ".repeat must be given together with ramp (--ramp) or hold (--hold), but is given without: loads that come at once leave "
                "the same contact again."
            )
        return self

    @property
    def in_time(self) -> bool:
        """Whether any load takes time."""
        return any(float(time) > 0.0 for time in (*(self.ramp or ()), *(self.hold or ())))


@dataclass(frozen=True)
class InTime:
    """The table, and which of the steps of a load path end at a turning point: every so many (``every``), the first too with ``first``.

    ``slides``: whether what matters is steady sliding, and not the first instant.
    """

    settings: ViscoelasticSettings
    every: int = 1
    first: bool = False
    slides: bool = False

    def turning(self, controls: tuple[Step | Control, ...]) -> tuple[Step | Control, ...]:
        """The steps of ``controls`` that end at a turning point of the load, and all that move the surfaces along each other."""
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
    table = "viscoelastic"
    settings = ViscoelasticSettings
    whole_path = True

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars, energies of the steps of the load, and columns of all moments."""
        from .moments import COLUMNS

        moments = (replace(item, name=f"moment_{item.name}", dims=(MOMENT,)) for item in COLUMNS)
        return (*SCALARS, *OSCILLATION, *STEPS, *moments)

    def settings_in(self, document: Any) -> ViscoelasticSettings | None:
        """The table [viscoelastic], or its defaults where a body relaxes."""
        found: ViscoelasticSettings | None = document.viscoelastic
        if found is not None:
            return found
        for body in (document.body, document.counter_body):
            parts = (body, *body.layers, *((body.base,) if body.base is not None else ()))
            if any(getattr(part, "relaxation", None) is not None for part in parts):
                return ViscoelasticSettings()
        return None

    def asked(self, document: Any, folder: Path) -> InTime:
        """The settings with the turning points of the load path."""
        settings = self.settings_in(document) or ViscoelasticSettings()
        path, slides = document.control.path, document.hysteresis is not None
        every, first = (1, False) if path is None else (path.steps, path.mean_gap is not None)
        return InTime(settings, every, first, slides)

    def check(self, ask: InTime, problem: ContactProblem) -> None:
        """Refuse times where nothing relaxes, and a temperature without a shift."""
        from .figures import relaxing_solids

        if not relaxing_solids(problem):
            raise InputError(
                "body or counter_body must relax where viscoelastic (--ramp, --hold, --temperature, ...) is given, but neither does. Give one "
                'such as "E=3MPa+10MPa@10ms,nu=0.5".'
            )

    def altered(self, ask: InTime, problem: ContactProblem) -> ContactProblem:
        """The bodies at the temperature."""
        if ask.settings.temperature is None:
            return problem
        from ...solids.layers import Layered
        from ...solids.viscoelastic import Viscoelastic

        temperature = float(ask.settings.temperature)

        def moved(solid: Any) -> Any:
            return solid.at_temperature(temperature) if isinstance(solid, Viscoelastic) and solid.spectrum else solid

        bodies: list[Body] = []
        for body in (problem.body, problem.counter_body):
            if isinstance(body, Layered):
                layers = [replace(layer, material=moved(layer.material)) for layer in body.layers]
                bodies.append(Layered(layers, moved(body.base), body.name))
            else:
                bodies.append(moved(body))
        return replace(problem, body=bodies[0], counter_body=bodies[1])

    def course(self, ask: InTime, controls: tuple[Step | Control, ...]) -> tuple[Step | Control, ...]:
        """Ramps to the turning points of the load, and holds there."""
        from ...contact.controls import as_step

        table = ask.settings
        if not table.in_time:
            return controls
        turning = ask.turning(controls)
        count, times = len(turning), []
        for name in ("ramp", "hold"):  # one time (s) for each load
            given = [float(time) for time in getattr(table, name) or (0.0,)]
            if len(given) not in (1, count):
                raise InputError(
                    f"viscoelastic.{name} (--{name}) must give one time for all {count} loads or one for each, but gives {len(given)}."
                )
            times.append(given * count if len(given) == 1 else given)
        made: list[Step | Control] = []
        for _ in range(table.repeat):
            for control, ramp, hold in zip(turning, *times, strict=True):
                made.append(replace(as_step(control), duration=ramp))
                made += [replace(as_step(control), duration=hold)] if hold > 0.0 else []
        return tuple(made)

    def options(self, ask: InTime) -> Mapping[str, Any]:
        """How durations are divided."""
        from ...contact.time_division import TimeSteps

        return {"time_steps": TimeSteps(float(ask.settings.tolerance), ask.settings.steps)}

    def compute(self, ask: InTime, solved: Solved) -> Found:
        """Energies, columns of all moments, response to an oscillation."""
        import numpy as np

        from .harmonic import harmonic
        from .moments import COLUMNS

        result, table = solved.result, ask.settings
        steps = (result,) if solved.path is None else solved.path.steps
        found = [step.creep for step in steps if step.creep is not None]
        if not found:
            return Found()
        last, largest = found[-1], float(np.abs(result.displacement).max())
        retarded = float(np.abs(last.retarded_displacement).max())
        values: dict[str, Any] = {
            "viscoelastic_time": float(last.time[-1]),
            "viscoelastic_heat": float(last.column("dissipated")[-1]),
            "viscoelastic_stored": last.stored_energy,
            "viscoelastic_work": sum(each.work for each in found),
            "retarded_share": retarded / largest if largest > 0.0 else 0.0,
            "time_error": max(each.time_error for each in found),
            "time_solves": float(sum(each.tries for each in found)),
            "step_end": np.array([each.time[-1] for each in found]),
            "step_moment": np.cumsum([len(each.records) - (number > 0) for number, each in enumerate(found)]) - 1,
            "step_heat": np.array([each.dissipated for each in found]),
            "step_stored": np.array([each.stored_energy for each in found]),
            "step_work": np.array([each.work for each in found]),
        }
        for item in COLUMNS:  # the first moment of a step is the last one of the step before
            parts = [each.column(item.name)[number > 0 :] for number, each in enumerate(found)]
            values[f"moment_{item.name}"] = np.concatenate(parts)
        oscillation = [math.nan] * len(OSCILLATION)
        if table.frequency is not None and result.contact.any():
            response = harmonic(result, float(table.frequency))
            heat = math.nan if table.amplitude is None else response.heat(float(table.amplitude))
            oscillation = [response.stiffness.real, response.stiffness.imag, response.loss_tangent, heat]
        values |= {item.name: number for item, number in zip(OSCILLATION, oscillation, strict=True)}
        keys = ("Ferry1980", "Lee1960", "Park1999", "Ting1966")
        detail = {"temperature": table.temperature and float(table.temperature)}
        return Found(values, detail, _findings(values, ask), keys)

    def citations(self, ask: InTime, problem: ContactProblem) -> tuple[str, ...]:
        """Papers of viscoelastic contact."""
        return ("Ferry1980", "Lee1960", "Park1999", "Ting1966")

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Area, approach, load and energies against time, and the moduli of the solids."""
        from ...plots.picture import figures_by
        from .figures import SOLID_PLOTS, TIME_PLOTS

        if not found.values:
            return ()
        shown = picture_of(found, solved)
        lasts = float(shown.moments["time"][-1]) > float(shown.moments["time"][0])
        return (*(figures_by(TIME_PLOTS, shown) if lasts else ()), *figures_by(SOLID_PLOTS, shown))

    def words(self, found: Found, solved: Solved) -> Words:
        """What changed in time, energies, and the response to an oscillation."""
        import numpy as np

        from ...io.words import value_text

        values = found.values
        if not values:
            return Words()
        rows: Rows = []
        temperature = (found.detail or {}).get("temperature")
        if temperature:
            rows.append(("temperature", show(float(temperature), "K")))
        for item in (*SCALARS, *OSCILLATION):
            value = float(values.get(item.name, math.nan))
            if math.isfinite(value):
                text = f"{value:.0f}" if item.name == "time_solves" else value_text(item, value)
                rows.append((item.label, text))
        lasts = float(values["viscoelastic_time"]) > 0.0
        headline = [("heat of viscoelastic solids", show(float(values["viscoelastic_heat"]), "J", 3))] if lasts else []
        if math.isfinite(float(values["loss_tangent"])):
            headline.append(("loss tangent of the oscillation", f"{float(values['loss_tangent']):.3g}"))
        tables: tuple[tuple[str, Table], ...] = ()
        if lasts:
            steps = (np.atleast_1d(values[f"step_{name}"]) for name in ("end", "moment", "heat", "stored"))
            loads, approaches, areas = (
                np.atleast_1d(values[f"moment_{name}"]) for name in ("mean_pressure", "approach", "area_fraction")
            )
            cells = []
            for number, (end, moment, heat, stored) in enumerate(zip(*steps, strict=True), start=1):
                at = int(moment)
                state = (show(float(loads[at]), "Pa"), show(float(approaches[at]), "m"), percent(float(areas[at])))
                energies = (show(float(heat), "J", 3), show(float(stored), "J", 3))
                cells.append((f"{number}", show(float(end), "s"), *state, *energies))
            heads = ("Step", "Until", "Mean pressure", "Approach", "Real area", "Heat of the step", "Stored energy")
            tables = (("The contact in time", Table(heads, tuple(cells))),)
        return Words(_sentence(values), headline, rows, tables, (REMARK,))

    def stored(self, found: Found) -> Stored:
        """The temperature."""
        return Stored(facts=found.detail or {})

    def restored(self, stored: Stored, solved: Solved) -> Any:
        """The same again."""
        return dict(stored.facts)


def _findings(values: Mapping[str, Any], ask: InTime) -> tuple[Advice, ...]:
    """That nothing took time, or that steps of time are long."""
    made = []
    if float(values["viscoelastic_time"]) == 0.0 and not ask.slides:
        text = "All loads come at once: the viscoelastic solids are as stiff as at the first instant. Give ramp or hold (--ramp, --hold) for what time does to the contact."
        made.append(Advice("note", "first instant", text))
    if ask.settings.frequency is not None and math.isnan(float(values["storage_stiffness"])):
        text = "The surfaces do not touch under the last load: there is no contact that would oscillate."
        made.append(Advice("warning", "oscillation", text))
    error = float(values["time_error"])
    if error > MUCH:
        text = f"The steps of time may add {percent(error)} to the error of the displacement. Take a smaller tolerance (--time-tolerance) or more steps (--time-steps)."
        made.append(Advice("warning", "steps of time", text))
    return tuple(made)


def picture_of(found: Found, solved: Solved) -> TimePicture:
    """What figures are drawn from."""
    import numpy as np

    from .figures import TimePicture, relaxing_solids

    return TimePicture(
        found.columns("moment_"), np.atleast_1d(np.asarray(found.values["step_end"])), relaxing_solids(solved.problem)
    )


# In words and tables.

REMARK = (
    "Displacements follow the pressures of all earlier times by the creep of the solids. Heat is what their dashpots take; together with the stored energy it is the work of "
    "the load, but for the error of the steps of time. On a periodic surface creep of the mean displacement is not included."
)
"""What the numbers mean."""


def _sentence(values: Mapping[str, Any]) -> str:
    import numpy as np

    time, area = (np.atleast_1d(values[f"moment_{name}"]) for name in ("time", "area_fraction"))
    if time[-1] == 0.0:
        return "The load came at once: the viscoelastic solids are as stiff as at the first instant."
    approach = np.atleast_1d(values["moment_approach"])
    touched = int(np.flatnonzero(area > 0.0)[0]) if (area > 0.0).any() else 0
    heat = show(float(values["viscoelastic_heat"]), "J", 3)
    return (
        f"From {show(float(time[touched]), 's', 3)} to {show(float(time[-1]), 's', 3)} the contact area went from "
        f"{percent(float(area[touched]))} to {percent(float(area[-1]))} of the nominal area and the approach from "
        f"{show(float(approach[touched]), 'm', 3)} to {show(float(approach[-1]), 'm', 3)}; {heat} became heat."
    )
