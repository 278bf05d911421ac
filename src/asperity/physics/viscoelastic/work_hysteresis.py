"""Steady sliding asked for by a document: friction, area and heat, and Persson's theory beside it,
in numbers, figures and words."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from ...contact.problem import ContactProblem
from ...core.errors import InputError
from ...core.status import Advice
from ...core.units import percent, show
from ...io.words import value_text
from ...parts.part import Found, Rows, Solved, Table, WithFacts, Words
from ...plots.picture import Figure, figures_by
from ...theories.rough.rubber_friction import ORIGINAL
from ..friction.law import Coulomb
from .figures import SLIDING_PLOT, SPEED_PLOTS, SpeedPicture
from .part_hysteresis import COLUMNS, FIELD, SCALARS, HysteresisSettings
from .steady_sliding import SteadySliding, require_slidable, slide

STEEP = 1.0
"""Friction coefficient above which slopes are too steep for small-slope theory."""


APART = 0.2
"""Relative difference of the two coefficients of friction above which the grid is too coarse."""


class HysteresisWork(WithFacts):
    """Friction of a rough body that slides steadily over a viscoelastic one: what is done for
    it."""

    citation_keys: ClassVar[tuple[str, ...]] = ("Hunter1961", "Carbone2013", "Persson2001")

    def check(self, ask: HysteresisSettings, problem: ContactProblem) -> None:
        """Refuse what cannot slide steadily."""
        require_slidable(bare(problem), float(ask.direction))

    def compute(self, ask: HysteresisSettings, solved: Solved) -> Found:
        """Friction, area and heat at the speed and along the curve."""
        problem, reduction = bare(solved.problem), ORIGINAL if ask.reduction is None else float(ask.reduction)
        direction: Any = {"direction": float(ask.direction)}
        speeds: Any = ()
        if ask.slowest is not None and ask.fastest is not None and solved.lines:
            speeds = np.geomspace(float(ask.slowest), float(ask.fastest), ask.points)
        with solved.stage("sliding") as progress:
            found = slide(problem, solved.control, float(ask.speed or 0.0), **direction)
            rows = []
            for number, speed in enumerate(speeds, start=1):
                each = slide(problem, solved.control, float(speed), **direction)
                rows.append(
                    (speed, each.friction, each.normal.area_fraction_corrected, each.heat, *_persson(each, reduction))
                )
                progress.update(number, 1.0 - number / len(speeds), 0.0)
        normal = found.normal
        numbers = (
            found.friction,
            found.slope_friction,
            found.friction_force,
            found.heat,
            normal.area_fraction_corrected,
            normal.max_pressure,
            normal.mean_gap,
            found.energy_error,
            *_persson(found, reduction),
        )
        values: dict[str, Any] = {item.name: float(number) for item, number in zip(SCALARS, numbers, strict=True)}
        values[FIELD.name] = np.asarray(found.normal.pressure)
        if rows:
            values |= {item.name: column for item, column in zip(COLUMNS, np.array(rows).T, strict=True)}
        facts = {"speed": found.speed, "direction": found.direction, "reduction": reduction}
        keys = (*found.citation_keys, "Persson2001")
        made = []
        friction, slope = float(values["hysteresis_friction"]), float(values["hysteresis_slope_friction"])
        if abs(slope - friction) > APART * max(abs(friction), 1e-12) and friction > 1e-6:
            fact = (
                f"Friction by the loss in all waves is {friction:.3g} and by the slope of the surface "
                f"{slope:.3g}: the grid does not resolve the edges of the contact."
            )
            compared = {"by_loss": friction, "by_slope": slope, "largest_difference": APART}
            concerns = ("hysteresis_", "sliding_", "by_speed_")
            made.append(
                Advice(
                    "warning", "two ways to the friction", fact, "Take a finer one ({resample}).", compared, concerns
                )
            )
        if friction > STEEP:
            fact = (
                f"A coefficient of friction of {friction:.3g} by hysteresis alone says that slopes are too "
                "steep for a theory of small slopes."
            )
            compared = {"friction": friction, "largest": STEEP}
            made.append(Advice("warning", "steep slopes", fact, numbers=compared, concerns=("hysteresis_", "sliding_")))
        return Found(values, facts, tuple(made), keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Pressure while sliding; friction and area against speed."""
        shown = picture_of(found, solved)
        return figures_by((SLIDING_PLOT, *(SPEED_PLOTS if shown.curve else ())), shown)

    def words(self, found: Found, solved: Solved) -> Words:
        """Friction, area and heat, the theory beside them, and the curve."""
        values, facts = found.values, found.detail
        rows: Rows = [
            ("sliding speed", show(float(facts["speed"]), "m/s")),
            ("direction", f"{math.degrees(float(facts['direction'])):.4g}° from x"),
        ]
        for item in SCALARS:
            value = float(values[item.name])
            if math.isfinite(value):
                rows.append((item.label, value_text(item, value)))
        if math.isfinite(float(values["persson_friction"])):
            rows.append(("gamma of Persson's theory", f"{float(facts['reduction']):g}"))
        friction, force = float(values["hysteresis_friction"]), show(float(values["hysteresis_friction_force"]), "N", 3)
        if math.isnan(friction):  # the load pulls
            said, shown = f"a force of hysteretic friction of {force}", ("force of hysteretic friction", force)
        else:
            said = f"a coefficient of hysteretic friction of {friction:.3g}"
            shown = ("coefficient of hysteretic friction", f"{friction:.3g}")
        sentence = (
            f"Sliding at {show(float(facts['speed']), 'm/s', 3)} gives {said} on "
            f"{percent(float(values['sliding_area_fraction']))} of the nominal area, and "
            f"{show(float(values['hysteresis_heat']), 'W/m^2', 3)} of heat."
        )
        tables: tuple[tuple[str, Table], ...] = ()
        if COLUMNS[0].name in values:
            columns = [np.atleast_1d(values[item.name]) for item in COLUMNS]
            known = bool(np.isfinite(columns[4]).any())
            cells = []
            for speed, by_loss, area, heat, theory, share in zip(*columns, strict=True):
                row = (show(float(speed), "m/s"), f"{by_loss:.3g}", percent(float(area)), show(float(heat), "W/m^2", 3))
                cells.append((*row, *((f"{theory:.3g}", percent(float(share))) if known else ())))
            beside = ("Friction by Persson", "Area by Persson") if known else ()
            head = ("Speed", "Friction", "Real area", "Heat", *beside)
            tables = (("Friction against speed", Table(head, tuple(cells))),)
        remarks = (REMARK, OF_PULLING if solved.problem.attracts else OF_PRESSED)
        return Words(sentence, [shown], rows, tables, remarks)


def bare(problem: ContactProblem) -> ContactProblem:
    """``problem`` without friction that does not change its pressure."""
    plain = isinstance(problem.friction, Coulomb) and not problem.friction.coupled
    return problem.with_physics(friction=None) if plain else problem


def _persson(found: SteadySliding, reduction: float) -> tuple[float, float]:
    """Friction and area by Persson's theory; NaN where it does not hold: with adhesion or menisci,
    on layers, on a line, on a free grid, on a smooth surface, at rest."""
    try:
        theory = found.persson(reduction)
    except InputError:
        return math.nan, math.nan
    return theory.friction, theory.area_fraction


def picture_of(found: Found, solved: Solved) -> SpeedPicture:
    """What figures are drawn from."""
    curve = {
        item.name.removeprefix("by_speed_"): np.atleast_1d(np.asarray(found.values[item.name]))
        for item in COLUMNS
        if item.name in found.values
    }
    pressure = np.asarray(found.values[FIELD.name])
    return SpeedPicture(solved.problem, pressure, float(found.detail["direction"]), curve)


# In words and tables.

REMARK = (
    "The rough body slides steadily without interfacial shear: the friction is by hysteresis alone, and "
    "that of a flash temperature is not included."
)
"""What the model is."""


OF_PRESSED = "Persson's theory sums all waves of the mean spectrum of the map, the shortest of which matter most."


OF_PULLING = (
    "What attracts the surfaces adds to the load that deforms the viscoelastic body, and the coefficient is "
    "over the load from outside. Persson's theory of friction knows no attraction and is left out."
)
