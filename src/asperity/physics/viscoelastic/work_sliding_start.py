"""The start of sliding asked for by a document: friction and area along the way in numbers, figures
and words."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from ...contact.problem import ContactProblem
from ...core.errors import InputError
from ...core.status import Advice
from ...core.units import percent, show
from ...io.words import value_text
from ...parts.part import Found, Rows, Solved, Stored, Table, Words, Work
from ...plots.picture import Figure, figures_by
from .figures import START_PLOTS, StartPicture
from .part_hysteresis import HysteresisSettings
from .part_sliding_start import FIELD, FRICTION, SCALARS
from .transient_sliding import COLUMNS, STEPS_PER_PIXEL, slide_in_time, step_length
from .work_hysteresis import bare

LAST = 0.25
"""Share of the distance, at its end, over which friction is averaged."""


UNSTEADY = 0.1
"""Relative difference of the friction by slope and by heat from which on the motion is not
steady."""


OTHER_BRANCH = 0.2
"""Relative difference of the area of a motion that is steady from that of the steady state from
which on they are two contacts."""


LEAST, MOST = 4, 100_000
"""Smallest and largest number of steps of time."""


class SlidingStartWork(Work):
    """What happens from the load at once over the first distance of sliding: what is done for
    it."""

    citation_keys: ClassVar[tuple[str, ...]] = ("Carbone2013",)

    def check(self, ask: HysteresisSettings, problem: ContactProblem) -> None:
        """Refuse fewer steps of time than friction is averaged over, and more than are
        reasonable."""
        length, distance = step_length(problem.grid, ask.steps_per_pixel or STEPS_PER_PIXEL), float(ask.distance or 0.0)
        if not LEAST * length <= distance <= MOST * length:
            raise InputError(
                f"{{hysteresis.distance}} must be between {LEAST} and {MOST} steps of {show(length, 'm', 3)}, that is "
                f"{show(LEAST * length, 'm', 3)} and {show(MOST * length, 'm', 3)}, but is {show(distance, 'm', 3)}."
            )

    def compute(self, ask: HysteresisSettings, solved: Solved) -> Found:
        """Friction and area along the distance."""
        steps = ask.steps_per_pixel or STEPS_PER_PIXEL
        options: Any = {"direction": float(ask.direction), "steps_per_pixel": steps}
        with solved.stage("start of sliding") as progress:
            found = slide_in_time(
                bare(solved.problem),
                solved.control,
                float(ask.speed or 0.0),
                float(ask.distance or 0.0),
                progress=progress,
                **options,
            )
        last, area, heat = LAST * float(found.distance[-1]), found.column("area_fraction"), found.column("dissipated")
        numbers = (
            found.mean_friction(last),
            found.mean_loss(last),
            found.friction.max(),
            area[0],
            area[-1],
            heat[-1] - heat[0],
        )
        values: dict[str, Any] = {item.name: float(number) for item, number in zip(SCALARS, numbers, strict=True)}
        values[FIELD.name] = np.asarray(found.last.pressure)
        values |= {f"way_{item.name}": found.column(item.name) for item in COLUMNS}
        values[FRICTION.name] = found.friction
        facts: dict[str, Any] = {"speed": found.speed, "direction": found.direction, "step": found.step}
        steady = solved.found["hysteresis"].values if "hysteresis" in solved.found else {}
        for name in ("hysteresis_friction", "sliding_area_fraction"):
            facts[name] = float(steady.get(name, math.nan))
        made = []
        slope, by_heat, last_area = (
            float(values[f"start_last_{name}"]) for name in ("friction", "heat_friction", "area_fraction")
        )
        unsteady = abs(slope - by_heat) > UNSTEADY * max(abs(slope), abs(by_heat))
        if unsteady:
            fact = (
                f"Over the last quarter of the distance friction is {slope:.3g} by the slope and "
                f"{by_heat:.3g} by the heat: the motion is not steady."
            )
            remedy = (
                "Take a longer distance ({hysteresis.distance}), or a finer grid ({resample}) if that changes nothing."
            )
            compared = {"by_slope": slope, "by_heat": by_heat, "largest_difference": UNSTEADY}
            made.append(Advice("note", "start of sliding", fact, remedy, compared, ("start_last_",)))
        touching, wraps = found.last.contact, found.last.problem.boundary.wraps
        ends = (touching[[0, -1]], touching[:, [0, -1]])
        sizes = touching.shape
        if any(end.any() and not wrap and n > 1 for end, wrap, n in zip(ends, wraps, sizes, strict=True)):
            fact = "After the distance the contact has come to an edge of its grid, beyond which nothing is known."
            remedy = "Take a shorter distance ({hysteresis.distance}), or a larger surface."
            made.append(Advice("warning", "edge of the grid", fact, remedy, concerns=("start_last_", "start_heat")))
        known = float(facts["sliding_area_fraction"])
        if not (math.isnan(known) or unsteady or abs(last_area - known) <= OTHER_BRANCH * max(last_area, known)):
            fact = (
                f"The motion has come to {percent(last_area)} of the nominal area with a friction of "
                f"{slope:.3g}, the steady state found at once to {percent(known)} with "
                f"{float(facts['hysteresis_friction']):.3g}: adhesive contacts may have several steady states, "
                "and the motion after the first load comes to the former."
            )
            compared = {"moved": last_area, "at_once": known, "largest_difference": OTHER_BRANCH}
            concerns = ("hysteresis_", "sliding_", "start_last_")
            made.append(Advice("warning", "two steady states", fact, numbers=compared, concerns=concerns))
        return Found(values, facts, tuple(made), found.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Friction and area against distance, heat against time, pressure after it."""
        return figures_by(START_PLOTS, picture_of(found, solved))

    def words(self, found: Found, solved: Solved) -> Words:
        """How friction and area came to where they are."""
        values, facts = found.values, found.detail
        rows: Rows = [
            ("sliding speed", show(float(facts["speed"]), "m/s")),
            ("step of time", show(float(facts["step"]), "m")),
        ]
        rows += [(item.label, value_text(item, float(values[item.name]))) for item in SCALARS]
        way = show(float(values["way_distance"][-1]), "m", 3)
        friction, steady = float(values["start_last_friction"]), float(facts["hysteresis_friction"])
        beside = "" if math.isnan(steady) else f" (steady: {steady:.3g})"
        came = f"coefficient of friction came to {friction:.3g}{beside}"
        if math.isnan(friction):  # no load from outside presses
            came = f"force of friction came to {show(float(values['way_friction_force'][-1]), 'N', 3)}"
        sentence = (
            f"Over the first {way} of sliding at {show(float(facts['speed']), 'm/s', 3)} the contact area went "
            f"from {percent(float(values['start_first_area_fraction']))} to "
            f"{percent(float(values['start_last_area_fraction']))} of the nominal area and the {came}."
        )
        names = ("distance", "time", "friction", "area_fraction", "approach", "dissipated")
        columns = [np.atleast_1d(values[f"way_{name}"]) for name in names]
        cells = []
        for at in np.unique(np.linspace(0, len(columns[0]) - 1, ROWS).round().astype(int)):
            gone, time, friction, area, approach, heat = (float(column[at]) for column in columns)
            state = (f"{friction:.3g}", percent(area), show(approach, "m"), show(heat, "J", 3))
            cells.append((show(gone, "m"), show(time, "s"), *state))
        table = Table(("Distance", "Time", "Friction", "Real area", "Approach", "Heat"), tuple(cells))
        return Words(sentence, [], rows, (("Start of sliding", table),), (REMARK,))

    def stored(self, found: Found) -> Stored:
        """Speed, direction, step, and the steady state."""
        return Stored(facts={name: value for name, value in found.detail.items() if not math.isnan(value)})

    def restored(self, stored: Stored, solved: Solved) -> Any:
        """The same again."""
        steady = {"hysteresis_friction": math.nan, "sliding_area_fraction": math.nan}
        return {**steady, **stored.facts}


def picture_of(found: Found, solved: Solved) -> StartPicture:
    """What figures are drawn from."""
    facts, pressure = found.detail, np.asarray(found.values[FIELD.name])
    steady = float(facts["hysteresis_friction"]), float(facts["sliding_area_fraction"])
    return StartPicture(solved.problem, pressure, float(facts["direction"]), found.columns("way_"), *steady)


# In words and tables.

REMARK = (
    "The load comes at once and the rough body moves at its speed from the first instant on. Friction by the "
    "slope and by the heat are equal in the steady state; on the way they differ by what is stored."
)
"""What the model is."""


ROWS = 9
"""Rows of the table of the way."""
