"""Friction in motion: the law of the interface that the contact gives, and a mass, a block on a
belt or a sliding block that moves on it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, Count, Fraction, Length, NonNegative, Number, Positive, Size, Whole
from ...parts.part import Part
from ...parts.registry import parts

if TYPE_CHECKING:
    pass

MODELS = ("block", "mass", "belt")
"""What moves: a block that may tilt, a mass that vibrates normally, a block on a belt that only
slides."""

Model = Annotated[str, Choice({name: name for name in MODELS})]
Start = Annotated[str, Choice({name: name for name in ("rest", "sliding")})]
Begin = Annotated[str, Choice({name: name for name in ("first touch", "fitted")})]
Duration: TypeAlias = Annotated[float, Number("time", above=0.0)]
Frequency: TypeAlias = Annotated[float, Number("1/s", above=0.0)]


class DynamicsSettings(Settings):
    """Motion on the interface that the solved contact describes, under its mean pressure.

    The mass lies on a base of ``base`` with the mean pressure of the contact, which with the weight
    is the load of the motion. Speed and friction are those of the table [friction]; of a contact
    with a film the static friction with its menisci. ``block`` has three degrees of freedom,
    ``mass`` only the normal one, ``belt`` only that along the surface, with a static friction above
    the kinetic one or, with a ``slip_distance``, with rate-and-state friction.
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
        help="With the spring unstretched, or about to slide; the first by default, if loading the spring "
        "does not take too long",
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
    disturbance: NonNegative = setting(
        1e-3,
        option="--disturbance",
        help="Vibration over the penetration at rest that an impulse gives to a block when it slides, as "
        "roughness does",
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
        missing = [f"{{dynamics.{key}}}" for key in needed if getattr(self, key) is None]
        if missing:
            raise InputError(f" must give {', '.join(missing)} for the motion of a {self.model}, but does not.")
        if self.speeds is not None and self.model != "block":
            raise InputError(
                f" must give no speeds ({{dynamics.speeds}}) for the motion of a {self.model}, but does: the "
                "curve is that of a block."
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


class Dynamics(Part):
    """Motion on the interface of the contact."""

    name = "dynamics"
    title = "Friction in motion"
    purpose = "How a body on this contact moves: steadily, in stick and slip, or bouncing."
    table = "dynamics"
    essential = True
    settings = DynamicsSettings
    work = "physics.dynamics.work:DynamicsWork"
    takes_friction = True

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Law, stability, what the run comes to, the curve of the interface, and the run in
        time."""
        from .block_motion import BLOCK_SCALARS
        from .motion import QUANTITIES

        labels = {item.name: item for item in QUANTITIES}
        time = Quantity("motion_time", "s", "time of the motion", ("motion_time",))
        traces = tuple(
            Quantity(f"motion_{name}", labels[name].unit, f"{labels[name].label} of the motion", ("motion_time",))
            for name in TRACES
        )
        return (*SCALARS, *BLOCK_SCALARS, *CURVE, *SPEEDS, *STABILITY, time, *traces)

    def asked(self, document: Any, folder: Path) -> Moving:
        """The table [dynamics] with speed and friction."""
        settings: DynamicsSettings = document.dynamics
        friction = getattr(document, "friction", None)
        speed, coefficient = (friction.speed or 0.0, friction.coefficient) if friction is not None else (0.0, 0.0)
        if settings.model != "mass" and not speed:
            raise InputError(
                "speed must be given for the motion along the surface, but is missing. Give {friction.speed=1 mm/s}.",
                subject="friction.speed",
            )
        static = any(part.static_friction and getattr(document, part.table, None) is not None for part in parts())
        if settings.model != "mass" and not coefficient and not static:
            raise InputError(
                "friction must be given for the motion along the surface, but its coefficient is 0. Give "
                "{friction.coefficient=0.3}.",
                subject="friction.coefficient",
            )
        return Moving(settings, float(speed), float(coefficient))
