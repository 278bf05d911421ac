"""Viscoelasticity asked for by a document: loads in time, heat and small oscillations in numbers,
figures and words."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from ...contact.controls import Control, Step, as_step
from ...contact.problem import ContactProblem
from ...core.errors import InputError
from ...core.status import Advice
from ...core.units import percent, show
from ...io.words import value_text
from ...parts.part import Found, Rows, Solved, Table, WithFacts, Words
from ...plots.picture import Figure, figures_by
from ...solids.layers import Body, Layered
from ...solids.viscoelastic import Viscoelastic
from .figures import SOLID_PLOTS, TIME_PLOTS, TimePicture, relaxing_solids
from .harmonic import harmonic
from .moments import COLUMNS
from .part import OSCILLATION, SCALARS, InTime

MUCH = 0.05
"""Sum of the errors of the steps of time from which on a finding says so."""


class ViscoelasticityWork(WithFacts):
    """What time does to a contact of viscoelastic bodies: what is done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = ("Ferry1980", "Lee1960", "Park1999", "Ting1966")

    def check(self, ask: InTime, problem: ContactProblem) -> None:
        """Refuse times where nothing relaxes, and a temperature without a shift."""
        if not relaxing_solids(problem):
            raise InputError(
                "body or counter_body must relax where viscoelastic ({viscoelastic.ramp}, {viscoelastic.hold}, "
                "{viscoelastic.temperature}, ...) is given, but neither does. Give one "
                'such as "E=3MPa+10MPa@10ms,nu=0.5".'
            )

    def altered(self, ask: InTime, problem: ContactProblem) -> ContactProblem:
        """The bodies at the temperature."""
        if ask.settings.temperature is None:
            return problem
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
        table = ask.settings
        if not table.in_time:
            return controls
        turning = ask.turning(controls)
        count, times = len(turning), []
        for name in ("ramp", "hold"):  # one time (s) for each load
            given = [float(time) for time in getattr(table, name) or (0.0,)]
            if len(given) not in (1, count):
                raise InputError(
                    f"{{viscoelastic.{name}}} must give one time for all {count} loads or one for each, but "
                    f"gives {len(given)}."
                )
            times.append(given * count if len(given) == 1 else given)
        made: list[Step | Control] = []
        for _ in range(table.repeat):
            for control, ramp, hold in zip(turning, *times, strict=True):
                made.append(replace(as_step(control), duration=ramp))
                made += [replace(as_step(control), duration=hold)] if hold > 0.0 else []
        return tuple(made)

    def compute(self, ask: InTime, solved: Solved) -> Found:
        """Energies, columns of all moments, response to an oscillation."""
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
        made = []
        if float(values["viscoelastic_time"]) == 0.0 and not ask.slides:
            fact = "All loads come at once: the viscoelastic solids are as stiff as at the first instant."
            remedy = (
                "Give the times of the loads ({viscoelastic.ramp}, {viscoelastic.hold}) for what time "
                "does to the contact."
            )
            made.append(Advice("note", "first instant", fact, remedy))
        if ask.settings.frequency is not None and math.isnan(float(values["storage_stiffness"])):
            fact = "The surfaces do not touch under the last load: there is no contact that would oscillate."
            made.append(Advice("warning", "oscillation", fact))
        error = float(values["time_error"])
        if error > MUCH:
            fact = f"The steps of time may add {percent(error)} to the error of the displacement."
            remedy = "Take a smaller tolerance ({viscoelastic.tolerance}) or more steps ({viscoelastic.steps})."
            numbers, concerns = (
                {"error": error, "largest": MUCH},
                ("approach", "force", "mean_pressure", "viscoelastic_"),
            )
            made.append(Advice("warning", "steps of time", fact, remedy, numbers, concerns))
        return Found(values, detail, tuple(made), keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Area, approach, load and energies against time, and the moduli of the solids."""
        if not found.values:
            return ()
        shown = picture_of(found, solved)
        lasts = float(shown.moments["time"][-1]) > float(shown.moments["time"][0])
        return (*(figures_by(TIME_PLOTS, shown) if lasts else ()), *figures_by(SOLID_PLOTS, shown))

    def words(self, found: Found, solved: Solved) -> Words:
        """What changed in time, energies, and the response to an oscillation."""
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
        time, area = (np.atleast_1d(values[f"moment_{name}"]) for name in ("time", "area_fraction"))
        sentence = "The load came at once: the viscoelastic solids are as stiff as at the first instant."
        if time[-1] != 0.0:
            approach = np.atleast_1d(values["moment_approach"])
            touched = int(np.flatnonzero(area > 0.0)[0]) if (area > 0.0).any() else 0
            heat = show(float(values["viscoelastic_heat"]), "J", 3)
            sentence = (
                f"From {show(float(time[touched]), 's', 3)} to {show(float(time[-1]), 's', 3)} the contact "
                f"area went from {percent(float(area[touched]))} to {percent(float(area[-1]))} of the nominal "
                f"area and the approach from {show(float(approach[touched]), 'm', 3)} to "
                f"{show(float(approach[-1]), 'm', 3)}; {heat} became heat."
            )
        return Words(sentence, headline, rows, tables, (REMARK,))


def picture_of(found: Found, solved: Solved) -> TimePicture:
    """What figures are drawn from."""
    return TimePicture(
        found.columns("moment_"), np.atleast_1d(np.asarray(found.values["step_end"])), relaxing_solids(solved.problem)
    )


# In words and tables.

REMARK = (
    "Displacements follow the pressures of all earlier times by the creep of the solids. Heat is what their "
    "dashpots take; together with the stored energy it is the work of the load, but for the error of the "
    "steps of time. On a periodic surface creep of the mean displacement is not included."
)
"""What the numbers mean."""
