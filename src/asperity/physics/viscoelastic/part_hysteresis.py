"""Hysteresis: steady sliding of a rough body over a viscoelastic one, its friction, area and heat, and Persson's theory beside it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.status import Advice
from ...core.units import percent, show
from ...core.values import Angle, Length, Number, Whole
from ...parts.part import Found, Part, Rows, Solved, Stored, Table, Words

if TYPE_CHECKING:
    from ...contact.problem import ContactProblem
    from ...plots.picture import Figure
    from .figures import SpeedPicture
    from .steady_sliding import SteadySliding

SlidingSpeed = Annotated[float, Number("speed", above=0.0)]
Share = Annotated[float, Number(above=0.0, most=1.0)]

USUAL_POINTS = 9
"""Speeds of the curve, if not said otherwise."""

STEEP = 1.0
"""Friction coefficient above which slopes are too steep for small-slope theory."""

APART = 0.2
"""Relative difference of the two coefficients of friction above which the grid is too coarse."""


class HysteresisSettings(Settings):
    """Steady sliding of the rough body over the flat viscoelastic one at a ``speed``; with ``slowest`` and ``fastest`` a curve against speed.

    With a ``distance`` also the start of the motion at this speed, in steps of time from the load at once.
    """

    speed: SlidingSpeed | None = setting(
        None, option="--sliding-speed", help="Of the rough body over the viscoelastic one, steadily: 1cm/s"
    )
    direction: Angle = setting("0 deg", option="--sliding-direction", help="Of the rough body, from x towards y: 90deg")
    slowest: SlidingSpeed | None = setting(None, option="--slowest", help="First speed of a curve: 0.1mm/s")
    fastest: SlidingSpeed | None = setting(None, option="--fastest", help="Last speed of a curve: 10m/s")
    points: Annotated[int, Whole(2, 1000)] = setting(USUAL_POINTS, option="--speed-points", help="Speeds of the curve")
    reduction: Share | None = setting(
        None,
        option="--reduction",
        help="Of the deformation in partial contact, gamma of Persson's theory; 1, for none, by default",
    )

    distance: Length | None = setting(
        None, option="--sliding-distance", help="From the first load on, for the start of sliding in time: 2mm"
    )
    steps_per_pixel: Annotated[int, Whole(1, 100)] | None = setting(
        None, option="--steps-per-pixel", help="Steps of time in which the rough body moves by a pixel; 2 by default"
    )

    @model_validator(mode="after")
    def _whole(self) -> HysteresisSettings:
        if self.speed is None:
            raise InputError(' must give the speed (--sliding-speed), such as speed = "1 cm/s", but does not.')
        if (self.slowest is None) != (self.fastest is None):
            raise InputError(" must give both slowest (--slowest) and fastest (--fastest) or neither, but gives one.")
        if self.slowest is not None and self.fastest is not None and not float(self.slowest) < float(self.fastest):
            raise InputError(
                f".fastest (--fastest) must be greater than the slowest speed {float(self.slowest):g} m/s, but is {float(self.fastest):g} m/s."
            )
        if self.slowest is None and self.points != USUAL_POINTS:
            raise InputError(
                ".points (--speed-points) must be given together with slowest and fastest, but is given without."
            )
        if self.distance is None and self.steps_per_pixel is not None:
            raise InputError(
                ".steps_per_pixel (--steps-per-pixel) must be given together with the distance (--sliding-distance), but is given without."
            )
        return self


SCALARS = (
    Quantity(
        "hysteresis_friction",
        "1",
        "coefficient of hysteretic friction, by the loss in all waves, over the load from outside",
    ),
    Quantity("hysteresis_slope_friction", "1", "coefficient of hysteretic friction, by the slope of the surface"),
    Quantity("hysteresis_friction_force", "N", "force of hysteretic friction"),
    Quantity("hysteresis_heat", "W/m^2", "heat of hysteretic friction per nominal area and time"),
    Quantity("sliding_area_fraction", "1", "real contact area / nominal area while sliding"),
    Quantity("sliding_max_pressure", "Pa", "maximum pressure while sliding"),
    Quantity("sliding_mean_gap", "m", "mean gap while sliding"),
    Quantity("sliding_energy_error", "1", "bound on the error of the pressure while sliding, in energy"),
    Quantity("persson_friction", "1", "coefficient of hysteretic friction by Persson's theory"),
    Quantity(
        "persson_sliding_area_fraction", "1", "real contact area / nominal area while sliding by Persson's theory"
    ),
)
"""Numbers of a sliding contact; NaN where the theory does not hold, and of coefficients where the load pulls."""

FIELD = Quantity("sliding_pressure", "Pa", "contact pressure while sliding", ("x", "y"))

CURVE = "speed_point"
COLUMNS = (
    Quantity("by_speed_speed", "m/s", "sliding speed", (CURVE,)),
    Quantity("by_speed_friction", "1", "coefficient of hysteretic friction", (CURVE,)),
    Quantity("by_speed_area_fraction", "1", "real contact area / nominal area while sliding", (CURVE,)),
    Quantity("by_speed_heat", "W/m^2", "heat of hysteretic friction per nominal area and time", (CURVE,)),
    Quantity("by_speed_persson_friction", "1", "coefficient of hysteretic friction by Persson's theory", (CURVE,)),
    Quantity("by_speed_persson_area_fraction", "1", "real contact area / nominal area by Persson's theory", (CURVE,)),
)
"""Columns of the curve against speed."""


class Hysteresis(Part):
    """Friction of a rough body that slides steadily over a viscoelastic one."""

    name = "hysteresis"
    title = "Hysteretic friction"
    table = "hysteresis"
    settings = HysteresisSettings
    quantities = (*SCALARS, FIELD, *COLUMNS)

    def asked(self, document: Any, folder: Path) -> HysteresisSettings:
        """The table [hysteresis], beside no other motion."""
        table: HysteresisSettings = document.hysteresis
        for name in ("shear", "rolling"):
            if getattr(document, name) is not None:
                raise InputError(
                    f"{name} must be left out where hysteresis (--sliding-speed) is given, but both are: sliding over a viscoelastic body "
                    "is solved without another motion of the surfaces."
                )
        return table

    def check(self, ask: HysteresisSettings, problem: ContactProblem) -> None:
        """Refuse what cannot slide steadily."""
        from .steady_sliding import require_slidable

        require_slidable(bare(problem), float(ask.direction))

    def compute(self, ask: HysteresisSettings, solved: Solved) -> Found:
        """Friction, area and heat at the speed and along the curve."""
        import numpy as np

        from ...theories.rough.rubber_friction import ORIGINAL
        from .steady_sliding import slide

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
        return Found(values, facts, _findings(values), keys)

    def citations(self, ask: HysteresisSettings, problem: ContactProblem) -> tuple[str, ...]:
        """Papers of sliding over viscoelastic bodies."""
        return ("Hunter1961", "Carbone2013", "Persson2001")

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Pressure while sliding; friction and area against speed."""
        from ...plots.picture import figures_by
        from .figures import SLIDING_PLOT, SPEED_PLOTS

        shown = picture_of(found, solved)
        return figures_by((SLIDING_PLOT, *(SPEED_PLOTS if shown.curve else ())), shown)

    def words(self, found: Found, solved: Solved) -> Words:
        """Friction, area and heat, the theory beside them, and the curve."""
        import numpy as np

        from ...io.words import value_text

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
            f"{percent(float(values['sliding_area_fraction']))} of the nominal area, and {show(float(values['hysteresis_heat']), 'W/m^2', 3)} of heat."
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

    def stored(self, found: Found) -> Stored:
        """Speed, direction and reduction."""
        return Stored(facts=found.detail)

    def restored(self, stored: Stored, solved: Solved) -> Any:
        """The same again."""
        return dict(stored.facts)


def bare(problem: ContactProblem) -> ContactProblem:
    """``problem`` without friction that does not change its pressure."""
    from ..friction.law import Coulomb

    plain = isinstance(problem.friction, Coulomb) and not problem.friction.coupled
    return problem.with_physics(friction=None) if plain else problem


def _persson(found: SteadySliding, reduction: float) -> tuple[float, float]:
    """Friction and area by Persson's theory; NaN where it does not hold: with adhesion or menisci, on layers, on a line, on a free grid, on a smooth surface, at rest."""
    try:
        theory = found.persson(reduction)
    except InputError:
        return math.nan, math.nan
    return theory.friction, theory.area_fraction


def _findings(values: Mapping[str, Any]) -> tuple[Advice, ...]:
    """Edges that the grid does not resolve, and slopes that are too steep."""
    made = []
    friction, slope = float(values["hysteresis_friction"]), float(values["hysteresis_slope_friction"])
    if abs(slope - friction) > APART * max(abs(friction), 1e-12) and friction > 1e-6:
        text = f"Friction by the loss in all waves is {friction:.3g} and by the slope of the surface {slope:.3g}: the grid does not resolve the edges of the contact. Take a finer one."
        made.append(Advice("warning", "two ways to the friction", text))
    if friction > STEEP:
        text = f"A coefficient of friction of {friction:.3g} by hysteresis alone says that slopes are too steep for a theory of small slopes."
        made.append(Advice("warning", "steep slopes", text))
    return tuple(made)


def picture_of(found: Found, solved: Solved) -> SpeedPicture:
    """What figures are drawn from."""
    import numpy as np

    from .figures import SpeedPicture

    curve = {
        item.name.removeprefix("by_speed_"): np.atleast_1d(np.asarray(found.values[item.name]))
        for item in COLUMNS
        if item.name in found.values
    }
    pressure = np.asarray(found.values[FIELD.name])
    return SpeedPicture(solved.problem, pressure, float(found.detail["direction"]), curve)


# In words and tables.

REMARK = "The rough body slides steadily without interfacial shear: the friction is by hysteresis alone, and that of a flash temperature is not included."
"""What the model is."""

OF_PRESSED = "Persson's theory sums all waves of the mean spectrum of the map, the shortest of which matter most."
OF_PULLING = (
    "What attracts the surfaces adds to the load that deforms the viscoelastic body, and the coefficient is over the load from outside. Persson's theory of friction knows no attraction "
    "and is left out."
)
