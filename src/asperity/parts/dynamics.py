"""Friction in motion: the law of the interface that the contact gives, and a mass, a block on a belt or a sliding block that moves on it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from pydantic import model_validator

from ..core.errors import ConvergenceError, InputError
from ..core.quantity import Quantity
from ..core.settings import Settings, setting
from ..core.status import Advice
from ..core.units import percent, show
from ..core.values import Choice, Count, Fraction, Length, NonNegative, Number, Positive, Size, Whole
from .part import Found, Part, Rows, Solved, Words

if TYPE_CHECKING:
    from ..contact.problem import ContactProblem
    from ..dynamics.belt import BeltOscillator
    from ..dynamics.block import SlidingBlock
    from ..dynamics.block_motion import BlockRun
    from ..dynamics.interface import ComplianceFit, NormalCompliance
    from ..dynamics.motion import Motion
    from ..dynamics.normal_motion import NormalOscillator
    from ..plots.picture import Figure

MODELS = ("block", "mass", "belt")
"""What moves: a block that may tilt, a mass that vibrates normally, a block on a belt that only slides."""

Model = Annotated[str, Choice({name: name for name in MODELS})]
Start = Annotated[str, Choice({name: name for name in ("rest", "sliding")})]
Begin = Annotated[str, Choice({name: name for name in ("first touch", "fitted")})]
Duration: TypeAlias = Annotated[float, Number("time", above=0.0)]
Frequency: TypeAlias = Annotated[float, Number("1/s", above=0.0)]

MOST_PERIODS = 20_000
"""Periods of the normal vibration that loading the spring may take in a run that starts from rest: some ten seconds of work."""

USUAL_PERIODS = 300
"""Periods of the normal vibration after the spring is loaded: flutter has grown by then where it grows faster than 1 % a period."""

SLID = 0.9
"""Largest spring force over the friction at rest above which the block has begun to slide."""

MOST_SAMPLES = 20_000
"""Samples of a run that files and figures hold."""

WIDEST = 2.5
"""Largest pressure of the curve over that of the load: vibrating blocks reach about this much."""

POOR_FIT = 0.1
"""Largest relative error of the fitted law above which that is a finding."""


class DynamicsSettings(Settings):
    """Motion on the interface that the solved contact describes, under its mean pressure.

    The mass lies on a base of ``base`` with the mean pressure of the contact, which with the weight is the load of the motion. Speed and friction are
    those of the table [friction]; of a contact with a film the static friction with its menisci. ``block`` has three degrees of freedom, ``mass``
    only the normal one, ``belt`` only that along the surface, with a static friction above the kinetic one or, with a ``slip_distance``, with
    rate-and-state friction.
    """

    model: Model = setting("block", option="--motion", help="What moves")
    mass: Annotated[float, Number("kg", above=0.0)] | None = setting(None, option="--mass", help="Mass: 1kg")
    base: Size | None = setting(
        None, option="--base", help="Nominal contact, length along the sliding by width: 10cm x 2cm"
    )
    height: Length | None = setting(None, option="--block-height", help="Of the block, for its tilt: 5cm")
    stiffness: Annotated[float, Number("N/m", above=0.0)] | None = setting(
        None, option="--spring", help="Stiffness of the spring that holds the block: 200N/mm"
    )
    dashpot: Annotated[float, Number("N*s/m", least=0.0)] = setting(
        "0 N*s/m", option="--dashpot", help="Damping beside the spring: 40N*s/m"
    )
    spring_height: Annotated[float, Number("length")] = setting(
        "0 mm", option="--spring-height", help="Of the spring above the centroid: 1cm"
    )
    damping_ratio: NonNegative = setting(
        0.03, option="--damping-ratio", help="Of the normal vibration, by the interface; metal joints have 0.02 to 0.07"
    )
    duration: Duration | None = setting(
        None, option="--duration", help="Of the motion; follows from the model by default"
    )
    start: Start | None = setting(
        None,
        option="--start",
        help="With the spring unstretched, or about to slide; the first by default, if loading the spring does not take too long",
    )
    amplitude: Positive = setting(
        1.5, option="--amplitude", help="Of a mass: penetration at the start over that at rest"
    )
    forcing: Annotated[float, Number("force", least=0.0)] = setting(
        "0 N", option="--forcing", help="Amplitude of a harmonic normal force on a mass: 10N"
    )
    forcing_frequency: Frequency | None = setting(
        None, option="--forcing-frequency", help="Of that force; the natural one by default: 5kHz"
    )
    static_friction: NonNegative | None = setting(
        None,
        option="--static-friction",
        help="Static coefficient of a belt; of a film that with its menisci by default",
    )
    slip_distance: Length | None = setting(
        None,
        option="--slip-distance",
        help="Slip that renews the contacts, for rate-and-state friction of a belt: 10um",
    )
    direct_effect: Positive = setting(
        0.01, option="--direct-effect", help="Growth of the friction at once with the logarithm of the speed"
    )
    evolution_effect: NonNegative = setting(
        0.015, option="--evolution-effect", help="Growth of the friction with the logarithm of the age of the contacts"
    )
    ageing: bool = setting(
        True, option="--ageing", help="Contacts also age at rest (Dieterich); else with slip only (Ruina)"
    )
    smoothing: Fraction | None = setting(
        None,
        option="--smoothing",
        help="Sliding speed about which friction turns over that of the belt; 0.05 by default",
    )
    points: Annotated[int, Whole(4, 64)] = setting(8, option="--law-points", help="Loads to which the law is fitted")
    law_begins: Begin = setting(
        "first touch", option="--law-begins", help="Approach from which the power of the law counts"
    )
    speeds: Count | None = setting(
        None, option="--speeds", help="Number of speeds of a curve of friction, from a tenth to ten times the speed"
    )

    @model_validator(mode="after")
    def _whole(self) -> DynamicsSettings:
        needed = ["mass", "base", *{"block": ("height", "stiffness"), "belt": ("stiffness",), "mass": ()}[self.model]]
        options = {"mass": "--mass", "base": "--base", "height": "--block-height", "stiffness": "--spring"}
        missing = [f"{key} ({options[key]})" for key in needed if getattr(self, key) is None]
        if missing:
            raise InputError(f" must give {', '.join(missing)} for the motion of a {self.model}, but does not.")
        if self.speeds is not None and self.model != "block":
            raise InputError(
                f" must give no speeds (--speeds) for the motion of a {self.model}, but does: the curve is that of a block."
            )
        return self


@dataclass(frozen=True)
class Moving:
    """What moves: settings, speed (m/s) and friction coefficient of the table [friction]."""

    settings: DynamicsSettings
    speed: float
    friction: float


SCALARS = (
    Quantity("interface_exponent", "1", "exponent of the law of normal compliance"),
    Quantity("interface_exponent_error", "1", "standard error of that exponent"),
    Quantity("interface_penetration", "m", "penetration of that law under the load"),
    Quantity("interface_stiffness", "Pa/m", "stiffness of that law under the load"),
    Quantity("interface_fit_error", "1", "largest relative error of that law"),
    Quantity("normal_frequency", "Hz", "natural frequency of the normal vibration"),
    Quantity("growth_rate", "1/s", "largest growth rate about steady sliding"),
    Quantity("critical_friction", "1", "friction coefficient above which steady sliding is unstable"),
    Quantity("motion_energy_error", "1", "energy residual of the motion / its largest energy"),
)
"""Numbers of the law and of the stability."""

CURVE = (
    Quantity("curve_approach", "m", "approach of the curve of the interface", ("load_point",)),
    Quantity("curve_pressure", "Pa", "mean pressure of the curve of the interface", ("load_point",)),
)
"""The contact curve behind the law."""

TRACES = ("displacement", "penetration", "velocity", "normal_force", "spring_force")
"""What is kept of a run in time, as far as the model has it."""

SPEEDS = (
    Quantity("sweep_speed", "m/s", "speed of the curve of friction", ("sweep_point",)),
    Quantity("sweep_mean_friction", "1", "mean spring force / load at that speed", ("sweep_point",)),
    Quantity("sweep_largest_friction", "1", "largest spring force / load at that speed", ("sweep_point",)),
)
"""The curve of friction against speed."""


STABILITY = (
    Quantity("map_friction", "1", "friction coefficient of the map of stability", ("map_friction",)),
    Quantity("map_damping", "1", "damping ratio of the map of stability", ("map_damping",)),
    Quantity("map_growth_rate", "1/s", "largest growth rate about steady sliding", ("map_friction", "map_damping")),
)
"""The map of stability of a block over friction and damping, about those asked for."""

MAP_POINTS = 25
"""Points of that map along each axis."""


class Dynamics(Part):
    """Motion on the interface of the contact."""

    name = "dynamics"
    title = "Friction in motion"
    table = "dynamics"
    settings = DynamicsSettings

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Law, stability, what the run comes to, the curve of the interface, and the run in time."""
        from ..dynamics.block_motion import BLOCK_SCALARS
        from ..dynamics.motion import QUANTITIES

        labels = {item.name: item for item in QUANTITIES}
        time = Quantity("motion_time", "s", "time of the motion", ("motion_time",))
        traces = tuple(
            Quantity(f"motion_{name}", labels[name].unit, f"{labels[name].label} of the motion", ("motion_time",))
            for name in TRACES
        )
        return (*SCALARS, *BLOCK_SCALARS, *CURVE, *SPEEDS, *STABILITY, time, *traces)

    def asked(self, document: Any, folder: Path) -> Moving | None:
        """The table [dynamics] with speed and friction."""
        settings: DynamicsSettings | None = document.dynamics
        if settings is None:
            return None
        friction = document.friction
        if settings.model != "mass" and not friction.speed:
            raise InputError(
                "speed must be given for the motion along the surface, but is missing. Give friction.speed (--speed 1mm/s).",
                subject="friction.speed",
            )
        if settings.model != "mass" and not friction.coefficient and document.film is None:
            raise InputError(
                "friction must be given for the motion along the surface, but its coefficient is 0. Give friction.coefficient (--friction 0.3).",
                subject="friction.coefficient",
            )
        return Moving(settings, float(friction.speed or 0.0), float(friction.coefficient))

    def compute(self, ask: Moving, solved: Solved) -> Found:
        """Law of the interface, stability, and the motion."""
        with solved.stage("law of the interface"):
            fit = _fitted(ask, solved)
        with solved.stage("motion"):
            made = _Made(ask, solved, fit)
            values, findings = made.values(), made.findings()
        return Found(values, fit, findings, made.citation_keys)

    def citations(self, ask: Moving, problem: ContactProblem) -> tuple[str, ...]:
        """Papers of law and models."""
        from ..dynamics.block import SlidingBlock

        return SlidingBlock.citation_keys

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Law, forces and penetration in time, phase portraits, curve of friction."""
        from ..plots.dynamics import figures_of

        return figures_of(found.values)

    def words(self, found: Found, solved: Solved) -> Words:
        """What the motion comes to."""
        return dynamics_words(found.values)


# From the contact to the motion.


def _fitted(ask: Moving, solved: Solved) -> ComplianceFit:
    """Law of normal compliance of the contact about its mean pressure: from the load path where that spans it, else from a path of its own."""
    import numpy as np

    from ..contact.problem import MeanPressure
    from ..contact.solve import steps
    from ..dynamics.interface import fit_compliance

    pressure = solved.result.mean_pressure
    if pressure <= 0.0:
        raise InputError("The contact must bear a load for motion on it, but its mean pressure is zero.")
    path = [] if solved.path is None else list(_loading(solved.path.steps))
    if len(path) < ask.settings.points:
        loads = np.geomspace(pressure / WIDEST, pressure * WIDEST, ask.settings.points)
        path = list(steps(solved.problem, [MeanPressure(float(p)) for p in loads], on_failure="return"))
    if not all(step.converged for step in path):
        raise ConvergenceError("The contact curve that the law is fitted to did not converge at every load.")
    offset = 0.0 if ask.settings.law_begins == "first touch" else None
    return fit_compliance([step.approach for step in path], [step.mean_pressure for step in path], offset=offset)


def _loading(found: Any) -> Any:
    """The steps of a path as long as pressure and approach grow."""
    last = (0.0, -math.inf)
    for step in found:
        if step.mean_pressure <= last[0] or step.approach <= last[1]:
            return
        last = (step.mean_pressure, step.approach)
        yield step


@dataclass(frozen=True, eq=False)
class _Made:
    """The model that is asked for, on the law of the contact, and its motion."""

    ask: Moving
    solved: Solved
    fit: ComplianceFit

    @cached_property
    def friction(self) -> float:
        """Coefficient of friction under the load: that of the table, or the static one with the menisci of a film."""
        menisci = self.solved.result.menisci
        if menisci is not None and menisci.friction_force > 0.0:
            return float(menisci.static_friction)
        return self.ask.friction

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
        from ..dynamics.normal_motion import NormalOscillator

        settings = self.ask.settings
        free = NormalOscillator(self.law, self.mass, self.area, self.load)
        rate = (
            free.natural_frequency if settings.forcing_frequency is None else 2.0 * math.pi * settings.forcing_frequency
        )
        return NormalOscillator(self.law, self.mass, self.area, self.load, settings.forcing, rate)

    @cached_property
    def block(self) -> SlidingBlock:
        """The sliding block."""
        from ..dynamics.block import SlidingBlock

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
        from ..dynamics.belt import BeltOscillator, RateState, StaticKinetic

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
        from ..dynamics.block_motion import move_block
        from ..dynamics.sweeps import SLIDES_FROM

        settings, block = self.ask.settings, self.block
        start = None
        if self.begins_sliding:
            start = (SLIDES_FROM * block.steady.displacement, block.rest, 0.0, 0.0, 0.0, 0.0)
        smoothing = None if settings.smoothing is None else settings.smoothing * self.ask.speed
        return move_block(block, self.duration, start=start, smoothing_speed=smoothing)

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
        import numpy as np

        model = self.ask.settings.model
        if model == "belt":
            spring = self.motion["spring_force"] / self.load
            return {
                "growth_rate": self.belt.growth_rate,
                "peak_friction": float(spring.max()),
                "apparent_friction": float(np.trapezoid(spring, self.motion.time) / np.ptp(self.motion.time)),
                **_cycles(self.motion),
            }
        if model == "mass":
            late = self.motion.after(0.5 * self.duration)
            return {
                "smallest_normal_force": float(late["normal_force"].min()) / self.load,
                "largest_normal_force": float(late["normal_force"].max()) / self.load,
                "vibration_frequency": late.dominant_frequency("penetration"),
            }
        window = max(0.0, self.duration - 0.5 * USUAL_PERIODS * 2.0 * math.pi / self.normal.natural_frequency)
        block = self.block
        found = {
            "growth_rate": block.stability.margin,
            "critical_friction": block.critical_friction(),
            **self._map(),
        }
        if self.slides:
            found |= self.run.numbers(min(window, 0.75 * self.duration))
        return found | self._sweep()

    def _map(self) -> dict[str, Any]:
        """Growth rates over friction and damping, both from nothing to twice what is asked, or what flutters at all."""
        import numpy as np

        from ..dynamics.sweeps import stability_map

        damping = max(2.0 * self.ask.settings.damping_ratio, 0.05)
        axes = {
            "friction": list(np.linspace(0.0, 2.0 * self.friction, MAP_POINTS)[1:]),
            "damping_ratio": list(np.linspace(0.0, damping, MAP_POINTS)),
        }
        made = stability_map(self.block, axes)
        return {
            "map_friction": made.axis_values[0],
            "map_damping": made.axis_values[1],
            "map_growth_rate": made.growth_rate,
        }

    def _sweep(self) -> dict[str, Any]:
        import numpy as np

        from ..dynamics.sweeps import sweep_block

        if self.ask.settings.speeds is None:
            return {}
        speeds = np.geomspace(0.1, 10.0, self.ask.settings.speeds) * self.ask.speed
        period = 2.0 * math.pi / self.normal.natural_frequency
        made = sweep_block(self.block, "speed", list(speeds), duration=USUAL_PERIODS * period)
        return {
            "sweep_speed": made.axis_values,
            "sweep_mean_friction": made.numbers["apparent_friction"],
            "sweep_largest_friction": made.numbers["peak_friction"],
        }

    def findings(self) -> tuple[Advice, ...]:
        """A poor law, vibration beyond its range, instability that the run is too short to show."""
        fit, made = self.fit, []
        if fit.largest_error > POOR_FIT:
            text = (
                f"The power law of the interface differs from the contact by up to {percent(fit.largest_error)}. A rough contact follows a power of the approach "
                "only over part of the range: the law holds near the load."
            )
            made.append(Advice("note", "law of the interface", text))
        low, high = fit.span
        if "normal_force" in self.motion.values:
            largest = float(self.motion["normal_force"].max()) / self.area
            if largest > 1.05 * high:
                text = (
                    f"The motion reaches a mean pressure of {show(largest, 'Pa', 3)}, but the law was fitted from {show(low, 'Pa', 3)} to {show(high, 'Pa', 3)} "
                    "and is extrapolated. Take a smaller disturbance, or more damping."
                )
                made.append(Advice("note", "range of the law", text))
        if self.ask.settings.model == "block" and not self.slides:
            text = (
                f"The block has not begun to slide within {show(self.duration, 's', 3)}: there is no apparent friction. Take a longer duration "
                "(dynamics.duration, --duration), or start about to slide (dynamics.start, --start sliding)."
            )
            made.append(Advice("warning", "duration of the motion", text))
        elif self.ask.settings.model == "block":
            growth = self.block.stability.margin
            if growth > 0.0 and growth * self.duration < 10.0:
                text = (
                    f"Steady sliding is unstable, but at {growth:.3g} 1/s the vibration has not grown within {show(self.duration, 's', 3)}. Take a longer duration "
                    "(dynamics.duration, --duration)."
                )
                made.append(Advice("note", "duration of the motion", text))
        return tuple(made)


def _cycles(motion: Motion) -> dict[str, float]:
    """Mean period of stick-slip, from the times at which slip begins; NaN without at least two."""
    import numpy as np

    starts = [event.time for event in motion.events if event.kind == "slip"]
    return {"stick_slip_period": float(np.diff(starts).mean()) if len(starts) > 1 else math.nan}


# In figures and words, from stored values alone.


def dynamics_words(values: Mapping[str, Any]) -> Words:
    """Sentence, headline and rows, from the ``values`` of the quantities."""
    return Words(_sentence(values), _headline(values), _rows(values), remarks=(REMARK,))


REMARK = (
    "The whole base follows the law of normal compliance of the solved contact; friction follows the approach without delay. Vibration of the "
    "bodies themselves is left out."
)
"""What the model is."""


def _sentence(values: Mapping[str, Any]) -> str:
    growth = values.get("growth_rate", math.nan)
    mean, largest = values.get("apparent_friction", math.nan), values.get("peak_friction", math.nan)
    if math.isnan(mean) and "critical_friction" in values:
        return "The block has not begun to slide: there is no apparent friction."
    if math.isnan(mean):
        frequency = show(values["normal_frequency"], "Hz", 3)
        return f"The interface vibrates at {frequency}; the normal force is between {values['smallest_normal_force']:.3g} and {values['largest_normal_force']:.3g} of the load."
    steady = "Steady sliding is unstable" if growth > 0.0 else "Steady sliding is stable"
    period = values.get("stick_slip_period", math.nan)
    slips = "" if math.isnan(period) else f"; stick-slip with a period of {show(period, 's', 3)}"
    return f"{steady}{slips}; the apparent friction is {mean:.3g}, at most {largest:.3g}."


def _headline(values: Mapping[str, Any]) -> Rows:
    rows = [("natural frequency", show(values["normal_frequency"], "Hz", 3))]
    if "apparent_friction" in values:
        rows.append(("mean / largest friction", f"{values['apparent_friction']:.3g} / {values['peak_friction']:.3g}"))
    return rows


def _rows(values: Mapping[str, Any]) -> Rows:
    from ..io.words import value_text

    return [
        (item.label, value_text(item, values[item.name]))
        for item in Dynamics().quantities
        if not item.dims and item.name in values and not math.isnan(values[item.name])
    ]
