"""From a solved contact to a motion on it: the law of its interface, the model that is asked for,
its motion, and what that comes to."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ...contact.controls import MeanPressure
from ...contact.solve import steps
from ...core.errors import ConvergenceError, InputError
from ...core.status import Advice
from ...core.units import percent, show
from ...parts.part import Solved
from .belt import BeltOscillator, RateState, StaticKinetic
from .block import SlidingBlock
from .block_motion import BlockRun, move_block
from .interface import ComplianceFit, NormalCompliance, fit_compliance
from .motion import Motion
from .normal_motion import NormalOscillator
from .part import TRACES, Moving
from .sweeps import SLIDES_FROM, stability_map, sweep_block

MOST_PERIODS = 20_000
"""Periods of the normal vibration that loading the spring may take in a run that starts from rest:
some ten seconds of work."""

USUAL_PERIODS = 300
"""Periods of the normal vibration after the spring is loaded: flutter has grown by then where it
grows faster than 1 % a period."""

SLID = 0.9
"""Largest spring force over the friction at rest above which the block has begun to slide."""

VIBRATION = ("penetration_vibration", "tilt_vibration", "vibration_frequency")
"""What a vibration that has not grown leaves in doubt."""

SLIDING = ("apparent_friction", "friction_reduction")
"""What a block that does not slide steadily leaves in doubt."""

QUIET = 1e-4
"""Standard deviation of the penetration over that at rest below which a motion does not vibrate."""

MOST_SAMPLES = 20_000
"""Samples of a run that files and figures hold."""

WIDEST = 2.5
"""Largest pressure of the curve over that of the load: vibrating blocks reach about this much."""

FEWEST_PIXELS = 50
"""Touching pixels under the load below which the law is that of single pixels: one has an exponent
of exactly 1, whatever the surface."""

DRIFTS = 0.03
"""Change of the spring force over the end of a motion, over its mean, from which on that mean is
none of a steady state."""

POOR_FIT = 0.1
"""Largest relative error of the fitted law above which that is a finding."""

MAP_POINTS = 25
"""Points of that map along each axis."""


def fitted_law(ask: Moving, solved: Solved) -> ComplianceFit:
    """Law of normal compliance of the contact about its mean pressure: from the load path where
    that spans it, else from a path of its own."""
    pressure = solved.result.mean_pressure
    if pressure <= 0.0:
        raise InputError("The contact must bear a load for motion on it, but its mean pressure is zero.")
    pixels = int(np.count_nonzero(solved.result.contact))
    if pixels < FEWEST_PIXELS:
        raise InputError(
            f"contact must have at least {FEWEST_PIXELS} touching pixels under the load for a law of its "
            f"interface, but has {pixels}. "
            "Raise the load ({load}), or refine the grid ({resample}).",
            subject="control",
        )
    path: list[Any] = []
    last = (0.0, -math.inf)
    for step in () if solved.path is None else solved.path.steps:  # as long as pressure and approach grow
        if step.mean_pressure <= last[0] or step.approach <= last[1]:
            break
        last = (step.mean_pressure, step.approach)
        if (
            np.count_nonzero(step.contact) >= FEWEST_PIXELS / WIDEST
        ):  # as many as at the least load of a path of its own
            path.append(step)
    if len(path) < ask.settings.points:
        loads = np.geomspace(pressure / WIDEST, pressure * WIDEST, ask.settings.points)
        path = list(steps(solved.problem, [MeanPressure(float(p)) for p in loads], on_failure="return"))
    if not all(step.converged for step in path):
        raise ConvergenceError("The contact curve that the law is fitted to did not converge at every load.")
    offset = 0.0 if ask.settings.law_begins == "first touch" else None
    return fit_compliance([step.approach for step in path], [step.mean_pressure for step in path], offset=offset)


@dataclass(frozen=True, eq=False)
class Made:
    """The model that is asked for, on the law of the contact, and its motion."""

    ask: Moving
    solved: Solved
    fit: ComplianceFit

    @cached_property
    def friction(self) -> float:
        """Coefficient of friction under the load: that of the table, or the static one with the
        menisci of a film."""
        known = (answer.friction_under_load() for answer in self.solved.result.answers)
        return next((found for found in known if found is not None), self.ask.friction)

    @property
    def area(self) -> float:
        """Of the base in m²."""
        length, width = self.base
        return length * width

    @property
    def base(self) -> tuple[float, float]:
        """Length and width of the base in m."""
        assert self.ask.settings.base is not None
        return self.ask.settings.base

    @property
    def mass(self) -> float:
        """In kg."""
        assert self.ask.settings.mass is not None
        return self.ask.settings.mass

    @property
    def load(self) -> float:
        """In N: the mean pressure on the base."""
        return self.solved.result.mean_pressure * self.area

    @cached_property
    def law(self) -> NormalCompliance:
        """Law with friction, and with the damping that is asked for."""
        settings = self.ask.settings
        law = self.fit.law.with_friction(self.friction)
        return law.damped(settings.damping_ratio, self.mass / self.area, self.load / self.area)

    @cached_property
    def normal(self) -> NormalOscillator:
        """The mass on the interface."""
        settings = self.ask.settings
        free = NormalOscillator(self.law, self.mass, self.area, self.load)
        rate = (
            free.natural_frequency if settings.forcing_frequency is None else 2.0 * math.pi * settings.forcing_frequency
        )
        return NormalOscillator(self.law, self.mass, self.area, self.load, settings.forcing, rate)

    @cached_property
    def block(self) -> SlidingBlock:
        """The sliding block."""
        settings = self.ask.settings
        length, width = self.base
        assert settings.height is not None
        assert settings.stiffness is not None
        return SlidingBlock(
            self.law,
            self.mass,
            length,
            width,
            settings.height,
            self.load,
            settings.stiffness,
            self.ask.speed,
            settings.dashpot,
            settings.spring_height,
        )

    @cached_property
    def belt(self) -> BeltOscillator:
        """The block on a belt."""
        settings = self.ask.settings
        assert settings.stiffness is not None
        law: StaticKinetic | RateState
        if settings.slip_distance is not None:
            law = RateState(
                self.friction,
                settings.direct_effect,
                settings.evolution_effect,
                settings.slip_distance,
                self.ask.speed,
                "ageing" if settings.ageing else "slip",
            )
        else:
            static = self.friction if settings.static_friction is None else settings.static_friction
            law = StaticKinetic(static, min(self.ask.friction, static))
        return BeltOscillator(law, self.mass, settings.stiffness, self.load, self.ask.speed, settings.dashpot)

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of the model."""
        model = self.ask.settings.model
        chosen = self.block if model == "block" else self.belt if model == "belt" else self.normal
        return chosen.citation_keys

    @cached_property
    def duration(self) -> float:
        """Of the motion in s: as asked, or until the spring is loaded and flutter has grown."""
        settings, period = self.ask.settings, 2.0 * math.pi / self.normal.natural_frequency
        if settings.duration is not None:
            return float(settings.duration)
        if settings.model == "mass":
            return 30.0 * period
        loaded = self.friction * self.load / (settings.stiffness or 1.0) / self.ask.speed
        if settings.model == "belt":
            return 6.0 * loaded + 6.0 * 2.0 * math.pi / self.belt.natural_frequency
        return (0.0 if self.begins_sliding else 1.5 * loaded) + USUAL_PERIODS * period

    @cached_property
    def begins_sliding(self) -> bool:
        """Whether a block starts just below sliding."""
        settings = self.ask.settings
        if settings.start is not None:
            return settings.start == "sliding"
        loading = self.friction * self.load / (settings.stiffness or 1.0) / self.ask.speed
        return loading * self.normal.natural_frequency > 2.0 * math.pi * MOST_PERIODS

    @cached_property
    def slides(self) -> bool:
        """Whether the block has begun to slide."""
        return float(self.motion["spring_force"].max()) > SLID * self.friction * self.load

    @cached_property
    def motion(self) -> Motion:
        """The motion."""
        settings = self.ask.settings
        if settings.model == "mass":
            start = (settings.amplitude * self.normal.rest, 0.0)
            return self.normal.move(self.duration, start=start, samples=4000)
        if settings.model == "belt":
            return self.belt.move(self.duration, samples=4000)
        return self.run.motion

    @cached_property
    def run(self) -> BlockRun:
        """The motion of a block."""
        settings, block = self.ask.settings, self.block
        start = None
        if self.begins_sliding:
            start = (SLIDES_FROM * block.steady.displacement, block.rest, 0.0, 0.0, 0.0, 0.0)
        smoothing = None if settings.smoothing is None else settings.smoothing * self.ask.speed
        shock = settings.disturbance
        return move_block(block, self.duration, start=start, smoothing_speed=smoothing, disturbance=shock)

    def values(self) -> dict[str, Any]:
        """Values of the quantities."""
        fit, rest = self.fit, float(self.law.approach(self.load / self.area))
        found: dict[str, Any] = {
            "interface_exponent": fit.law.normal_exponent,
            "interface_exponent_error": fit.exponent_error,
            "interface_penetration": rest,
            "interface_stiffness": float(fit.law.stiffness(rest)),
            "interface_fit_error": fit.largest_error,
            "normal_frequency": self.normal.natural_frequency / (2.0 * math.pi),
            "curve_approach": fit.approach - fit.offset,
            "curve_pressure": fit.pressure,
            "motion_energy_error": self.motion.energy_error,
            **self._of_model(),
        }
        stride = -(-self.motion.time.size // MOST_SAMPLES)
        found["motion_time"] = self.motion.time[::stride]
        found |= {f"motion_{name}": self.motion[name][::stride] for name in TRACES if name in self.motion.values}
        return found

    def _of_model(self) -> dict[str, Any]:
        """What the model comes to; of a block also growth rates over friction and damping, both
        from nothing to twice what is asked, or what flutters at all, and its friction against
        speed."""
        settings, model = self.ask.settings, self.ask.settings.model
        if model == "belt":
            motion, spring = self.motion, self.motion["spring_force"] / self.load
            kinds = ["stick" if motion["sliding_speed"][0] == 0.0 else "slip", *(event.kind for event in motion.events)]
            begun = [
                event.time
                for event, before in zip(motion.events, kinds, strict=False)
                if (before, event.kind) == ("stick", "slip")
            ]
            return {
                "growth_rate": self.belt.growth_rate,
                "peak_friction": float(spring.max()),
                "apparent_friction": float(np.trapezoid(spring, motion.time) / np.ptp(motion.time)),
                "stick_slip_period": float(np.diff(begun).mean()) if len(begun) > 1 else math.nan,
            }
        if model == "mass":
            late = self.motion.after(0.5 * self.duration)
            return {
                "smallest_normal_force": float(late["normal_force"].min()) / self.load,
                "largest_normal_force": float(late["normal_force"].max()) / self.load,
                "vibration_frequency": late.dominant_frequency("penetration"),
            }
        block = self.block
        axes = {
            "friction": list(np.linspace(0.0, 2.0 * self.friction, MAP_POINTS)[1:]),
            "damping_ratio": list(np.linspace(0.0, max(2.0 * settings.damping_ratio, 0.05), MAP_POINTS)),
        }
        found: dict[str, Any] = {
            "growth_rate": block.stability.margin,
            "critical_friction": block.critical_friction(),
        }
        made = stability_map(block, axes)
        found |= {"map_friction": made.axis_values[0], "map_damping": made.axis_values[1]}
        found["map_growth_rate"] = made.growth_rate
        if self.slides:
            found |= self._late_numbers
        if settings.speeds is not None:
            speeds = np.geomspace(0.1, 10.0, settings.speeds) * self.ask.speed
            period = 2.0 * math.pi / self.normal.natural_frequency
            sweep = sweep_block(block, "speed", list(speeds), duration=USUAL_PERIODS * period)
            found |= {
                "sweep_speed": sweep.axis_values,
                "sweep_mean_friction": sweep.numbers["apparent_friction"],
                "sweep_largest_friction": sweep.numbers["peak_friction"],
            }
        return found

    @property
    def _window(self) -> float:
        """Time in s from which on the motion of a block is taken for its end."""
        window = max(0.0, self.duration - 0.5 * USUAL_PERIODS * 2.0 * math.pi / self.normal.natural_frequency)
        return min(window, 0.75 * self.duration)

    @cached_property
    def _late_numbers(self) -> dict[str, float]:
        """What the end of the motion of a block comes to."""
        return self.run.numbers(self._window)

    def findings(self) -> tuple[Advice, ...]:
        """A poor law, vibration beyond its range, instability that the run is too short to show."""
        made = [*self._of_the_law()]
        if self.ask.settings.model == "block" and not self.slides:
            fact = (
                f"The block has not begun to slide within {show(self.duration, 's', 3)}: there is no apparent friction."
            )
            remedy = "Take a longer duration ({dynamics.duration}), or start about to slide ({dynamics.start=sliding})."
            numbers = {"duration": self.duration}
            made.append(Advice("warning", "duration of the motion", fact, remedy, numbers, (*SLIDING, "stick_slip_")))
        elif self.ask.settings.model == "block":
            growth = self.block.stability.margin
            if growth > 0.0 and growth * self.duration < 10.0:
                fact = (
                    f"Steady sliding is unstable, but at {growth:.3g} 1/s the vibration has not grown "
                    f"within {show(self.duration, 's', 3)}."
                )
                numbers = {"growth_rate": growth, "duration": self.duration}
                remedy = "Take a longer duration ({dynamics.duration})."
                made.append(Advice("note", "duration of the motion", fact, remedy, numbers, VIBRATION))
            elif growth > 0.0 and self._late_numbers["penetration_vibration"] < QUIET:
                fact = (
                    f"Steady sliding is unstable, with a growth of {growth:.3g} 1/s, but the motion does not "
                    "vibrate: friction that turns over smoothly, or errors of the integration, damp it."
                )
                remedy = (
                    "Start about to slide ({dynamics.start=sliding}), or smooth friction less ({dynamics.smoothing})."
                )
                numbers = {"growth_rate": growth, "vibration": self._late_numbers["penetration_vibration"]}
                made.append(Advice("warning", "vibration of the motion", fact, remedy, numbers, VIBRATION))
            # whether the apparent friction is that of a steady state, and the phase of the
            # vibration one of the equations
            late, numbers = self.motion.after(self._window), self._late_numbers
            spring = late["spring_force"]
            slope = np.polyfit(late.time - late.time[0], spring, 1)[0]
            change = float(slope * np.ptp(late.time)) / max(abs(float(spring.mean())), 1e-12 * self.load)
            if math.isnan(numbers["stick_slip_period"]) and abs(change) > DRIFTS:
                how = "runs backwards" if change < 0.0 else "is still dragged along"
                fact = (
                    f"The block {how} in the time of the apparent friction: the spring force changes by "
                    f"{percent(change)} over the last {show(float(np.ptp(late.time)), 's', 3)}, so that its "
                    "mean is not that of a steady state."
                )
                remedy, found = "Take a longer duration ({dynamics.duration}).", {"change": change, "largest": DRIFTS}
                made.append(Advice("warning", "window of the motion", fact, remedy, found, SLIDING))
            grows = self.block.stability.margin > 0.0 and numbers["penetration_vibration"] >= QUIET
            if grows and (self.ask.settings.disturbance == 0.0 or numbers["smallest_normal_force"] <= 0.0):
                why = (
                    "The vibration grew from errors of rounding alone"
                    if self.ask.settings.disturbance == 0.0
                    else "The block loses contact in an unstable vibration"
                )
                fact = (
                    f"{why}: its phase hangs on rounding. Only means and extremes can be relied on, not "
                    "the time of an event."
                )
                made.append(Advice("note", "phase of the motion", fact, concerns=("motion_",)))
        return tuple(made)

    def _of_the_law(self) -> Iterator[Advice]:
        """A law that fits poorly, or is used beyond the loads to which it was fitted."""
        fit = self.fit
        if fit.largest_error > POOR_FIT:
            fact = (
                "The power law of the interface differs from the contact by up to "
                f"{percent(fit.largest_error)}. A rough contact follows a power of the approach only over part "
                "of the range: the law holds near the load."
            )
            numbers = {"error": fit.largest_error, "largest": POOR_FIT}
            yield Advice("note", "law of the interface", fact, numbers=numbers, concerns=("interface_",))
        low, high = fit.span
        if "normal_force" in self.motion.values:
            largest = float(self.motion["normal_force"].max()) / self.area
            if largest > 1.05 * high:
                fact = (
                    f"The motion reaches a mean pressure of {show(largest, 'Pa', 3)}, but the law was fitted "
                    f"from {show(low, 'Pa', 3)} to {show(high, 'Pa', 3)} and is extrapolated."
                )
                remedy = (
                    "Take a smaller disturbance ({dynamics.disturbance}), or more damping ({dynamics.damping_ratio})."
                )
                numbers = {"mean_pressure": largest, "lowest": low, "highest": high}
                concerns = ("largest_normal_force", "penetration_vibration")
                yield Advice("note", "range of the law", fact, remedy, numbers, concerns)
