"""Friction in motion asked for by a document: computed, shown and in words."""

from __future__ import annotations

import math
from typing import ClassVar

from ...core.units import show
from ...io.words import value_text
from ...parts.part import Found, Solved, Words, Work
from ...plots.picture import Figure
from .block import SlidingBlock
from .figures import figures_of
from .part import Dynamics, Moving
from .work_motion import Made, fitted_law


class DynamicsWork(Work):
    """Motion on the interface of the contact: what is done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = SlidingBlock.citation_keys

    def compute(self, ask: Moving, solved: Solved) -> Found:
        """Law of the interface, stability, and the motion."""
        with solved.stage("law of the interface"):
            fit = fitted_law(ask, solved)
        with solved.stage("motion"):
            made = Made(ask, solved, fit)
            values, findings = made.values(), made.findings()
        return Found(values, fit, findings, made.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Law, forces and penetration in time, phase portraits, curve of friction."""
        return figures_of(found.values)

    def words(self, found: Found, solved: Solved) -> Words:
        """What the motion comes to."""
        values = found.values
        headline = [("natural frequency", show(values["normal_frequency"], "Hz", 3))]
        if "apparent_friction" in values:
            friction = f"{values['apparent_friction']:.3g} / {values['peak_friction']:.3g}"
            headline.append(("mean / largest friction", friction))
        rows = [
            (item.label, value_text(item, values[item.name]))
            for item in Dynamics().quantities
            if not item.dims and item.name in values and not math.isnan(values[item.name])
        ]
        mean, largest = values.get("apparent_friction", math.nan), values.get("peak_friction", math.nan)
        if not math.isnan(mean):
            steady = (
                "Steady sliding is unstable"
                if values.get("growth_rate", math.nan) > 0.0
                else "Steady sliding is stable"
            )
            period = values.get("stick_slip_period", math.nan)
            slips = "" if math.isnan(period) else f"; stick-slip with a period of {show(period, 's', 3)}"
            sentence = f"{steady}{slips}; the apparent friction is {mean:.3g}, at most {largest:.3g}."
        elif "critical_friction" in values:
            sentence = "The block has not begun to slide: there is no apparent friction."
        else:
            frequency = show(values["normal_frequency"], "Hz", 3)
            sentence = (
                f"The interface vibrates at {frequency}; the normal force is between "
                f"{values['smallest_normal_force']:.3g} and {values['largest_normal_force']:.3g} of the "
                "load."
            )
        return Words(sentence, headline, rows, remarks=(REMARK,))


REMARK = (
    "The whole base follows the law of normal compliance of the solved contact; friction follows the approach "
    "without delay. Vibration of the bodies themselves is left out."
)
"""What the model is."""
