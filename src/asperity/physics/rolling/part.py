"""Rolling: the steady contact under creepage and spin, its creep-force curve, and rough wheels."""

from __future__ import annotations

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
from ...core.values import Choice, Length, NonEmpty, Number, Whole
from ...parts.part import Found, Part, Rows, Solved, Stored, Table, Words
from ..friction.part import friction_law
from ..friction.part_stick_slip import law_text

if TYPE_CHECKING:
    from ...contact.controls import Control
    from ...contact.problem import ContactProblem
    from ...plots.picture import Figure
    from ..friction.law import FrictionLaw
    from .creep_curve import CreepCurve
    from .figures import RollingPicture
    from .rolling import Creepage, RollingContact
    from .rough import RoughRolling

CreepageShare = Annotated[float, Number("number")]
Spin = Annotated[float, Number("rad/m")]
Way = Annotated[str, Choice({name: name for name in ("x", "-x", "y", "-y")})]

LARGE = 0.1
"""Creepage from which on the bodies do not roll in the sense of the theory."""

FEW = 16
"""Pixels along the contact below which the forces of the grid err by several per cent."""


class RollingSettings(Settings):
    """Steady rolling with the friction of the table [friction]: creepages, spin, and the direction.

    The surface is the wheel, which stands in the frame of the contact. A ``roughness_file`` is a map of the same pixel that moves through it with the
    material, over a ``distance``. With ``points`` the curve of forces is found up to the creepages.
    """

    longitudinal: CreepageShare = setting(
        0.0, option="--creepage", help="Slip of the counter body over rolling speed, along the rolling direction: 0.1%"
    )
    lateral: CreepageShare = setting(0.0, option="--lateral-creepage", help="The same across it: 0.05%")
    spin: Spin = setting(
        "0 rad/m", option="--spin", help="Relative rotation over rolling speed, for --boundary free: 0.5rad/m"
    )
    direction: Way = setting("x", option="--rolling-direction", help="Where the contact rolls to: x, -x, y or -y")
    points: Annotated[int, Whole(0)] = setting(
        0, option="--creep-points", help="Points of the creep-force curve up to the creepages"
    )
    roughness_file: NonEmpty | None = setting(
        None,
        option="--rolling-roughness",
        help="Map of roughness that moves with the material, of the pixel of the wheel",
    )
    distance: Length | None = setting(
        None, option="--rolling-distance", help="Rolled over a rough wheel; by default once around after the running-in"
    )

    @model_validator(mode="after")
    def _whole(self) -> RollingSettings:
        if not (self.longitudinal or self.lateral or self.spin):
            raise InputError(
                " must give a creepage or spin other than zero, such as longitudinal = 0.001 (--creepage 0.1%), but gives none."
            )
        if self.distance is not None and self.roughness_file is None:
            raise InputError(
                ".distance must be given together with roughness_file (--rolling-roughness), but is given alone: a smooth wheel rolls steadily."
            )
        return self


@dataclass(frozen=True)
class Rolls:
    """What is asked of rolling, the law of friction, and the file of the roughness."""

    settings: RollingSettings
    law: FrictionLaw
    roughness: Path | None

    @property
    def creepage(self) -> Creepage:
        """That of the whole."""
        from .rolling import Creepage

        table = self.settings
        return Creepage(float(table.longitudinal), float(table.lateral), float(table.spin))


SCALARS = (
    Quantity("rolling_longitudinal_force", "N", "force on the body along the rolling direction"),
    Quantity("rolling_lateral_force", "N", "force on the body across the rolling direction"),
    Quantity("rolling_torque", "N*m", "torque on the body about the centre, rolling"),
    Quantity("traction_coefficient", "1", "longitudinal force of rolling / normal force"),
    Quantity("rolling_friction_share", "1", "tangential force of rolling / largest that friction bears"),
    Quantity("rolling_slip_area_fraction", "1", "area that slips as it rolls / real contact area (pixels)"),
    Quantity("rolling_heat", "J/m", "heat per distance rolled"),
    Quantity("rolling_max_slip", "1", "largest slip velocity / rolling speed"),
    Quantity("fastsim_longitudinal_force", "N", "longitudinal force by FASTSIM"),
    Quantity("fastsim_lateral_force", "N", "lateral force by FASTSIM"),
    Quantity("carter_longitudinal_force", "N", "longitudinal force by Carter"),
    Quantity("rolling_force_deviation", "N", "standard deviation of the longitudinal force of the rough wheel"),
)
"""Numbers of a rolling contact; NaN where a theory does not hold or nothing is rough."""

_GRID = ("x", "y")
FIELDS = (
    *(
        Quantity(f"rolling_traction_{a}", "Pa", f"shear traction on the body along {a} as it rolls", _GRID)
        for a in "xy"
    ),
    *(Quantity(f"rolling_slip_{a}", "1", f"slip velocity / rolling speed along {a}", _GRID) for a in "xy"),
    Quantity("rolling_bound", "Pa", "bound of the friction as it rolls", _GRID),
)
"""Fields of a rolling contact."""

CURVE = "creep_point"
PATH = "rolling_move"


def _columns(prefix: str, quantities: tuple[Quantity, ...], axis: str) -> tuple[Quantity, ...]:
    return tuple(replace(item, name=f"{prefix}_{item.name}", dims=(axis,)) for item in quantities)


class Rolling(Part):
    """The steady contact of bodies that roll with creepage, or a rough wheel."""

    name = "rolling"
    title = "Rolling"
    table = "rolling"
    settings = RollingSettings

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars, fields, columns of the curve and of the path of a rough wheel."""
        from .creep_curve import CREEPAGES, FORCES
        from .rough import PATH as MOVES

        return (*SCALARS, *FIELDS, *_columns("creep", (*CREEPAGES, *FORCES), CURVE), *_columns("rolled", MOVES, PATH))

    def asked(self, document: Any, folder: Path) -> Rolls:
        """The table [rolling] with the law of friction."""
        table: RollingSettings = document.rolling
        friction = document.friction
        if friction.law == "coulomb" and not friction.coefficient:
            raise InputError(
                "friction must be given together with rolling, but its coefficient is 0. Give friction.coefficient (--friction 0.3), or "
                'friction.law = "full stick" (--friction-law "full stick").',
                subject="friction",
            )
        if document.shear is not None:
            raise InputError(
                "rolling must be given without shear, but both are given: shift, force or twist (--shift, --tangential-force, --twist) are those of a contact that does not roll."
            )
        rough = None if table.roughness_file is None else folder / table.roughness_file
        return Rolls(table, friction_law(friction, sheared=True), rough)

    def check(self, ask: Rolls, problem: ContactProblem) -> None:
        """Refuse what cannot roll."""
        from .rolling import require_rolling

        require_rolling(problem.with_physics(friction=ask.law), ask.creepage, ask.settings.direction)  # type: ignore[arg-type]

    def compute(self, ask: Rolls, solved: Solved) -> Found:
        """Forces, fields and curves."""
        import numpy as np

        from .creep_curve import CREEPAGES, FORCES
        from .rolling import roll
        from .rough import PATH as MOVES

        problem, way = solved.problem.with_physics(friction=ask.law), ask.settings.direction
        with solved.stage("rolling") as progress:
            rough = None if ask.roughness is None else _rolled(problem, solved.control, ask, progress)
            contact = roll(problem, solved.control, ask.creepage, direction=way) if rough is None else rough.last  # type: ignore[arg-type]
            curve = _curve(problem, solved.control, ask) if ask.settings.points and solved.lines else None
        values: dict[str, Any] = dict(_numbers(contact, rough))
        for name, both in (("traction", contact.traction), ("slip", contact.slip)):
            values |= {f"rolling_{name}_{axis}": part for axis, part in zip("xy", both, strict=True)}
        values["rolling_bound"] = contact.law.bound(contact.normal.pressure)
        beside = {}
        if curve is not None:
            values |= {f"creep_{item.name}": getattr(curve, item.name) for item in (*CREEPAGES, *FORCES)}
            for name in (name for name in curve.theories if name != "linear"):
                theory = curve.theory(name)
                beside[name] = [np.asarray(part).tolist() for part in (theory.force_x, theory.force_y)]
        if rough is not None:
            values |= {f"rolled_{item.name}": getattr(rough, item.name) for item in MOVES}
        motion, limit = contact.creepage, contact.friction_limit
        facts = {  # what words and figures need beside the values, as in JSON
            "direction": contact.direction,
            "creepages": [motion.x, motion.y, motion.spin],
            "law": law_text(ask.law),
            "steadiness": contact.status.message,
            "friction_limit": limit if math.isfinite(limit) else None,
            "running_in": None if rough is None else rough.running_in,
            "beside": beside,
        }
        keys = contact.citation_keys if curve is None else curve.citation_keys
        return Found(values, facts, _findings(contact, ask), keys)

    def citations(self, ask: Rolls, problem: ContactProblem) -> tuple[str, ...]:
        """Papers of law and method."""
        from .solver import SteadyNewton

        return SteadyNewton.citation_keys

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Map of stick and slip, section, creep-force curve, forces of a rough wheel."""
        from ...plots.picture import figures_by
        from .figures import CURVE_PLOT, PATH_PLOT, ROLLING_PLOTS

        shown = picture_of(found, solved)
        plots = (*ROLLING_PLOTS, *((CURVE_PLOT,) if shown.curve else ()), *((PATH_PLOT,) if shown.path else ()))
        return figures_by(plots, shown)

    def words(self, found: Found, solved: Solved) -> Words:
        """What it transmits, what slips, what becomes heat, and the theories beside it."""
        from ...io.words import value_text

        values, facts = found.values, found.detail
        x, y, spin = facts["creepages"]
        rows: Rows = [
            ("friction", facts["law"]),
            ("creepages, longitudinal and lateral", f"{percent(x)} and {percent(y)}"),
            ("spin", f"{spin:.4g} rad/m"),
            ("rolls towards", facts["direction"]),
        ]
        for item in SCALARS:
            value = float(values[item.name])
            if math.isfinite(value):
                rows.append((item.label, value_text(item, value)))
        rows.append(("solution", facts["steadiness"]))
        tables = (("Creep-force curve", _curve_table(values, facts)),) if "creep_longitudinal" in values else ()
        headline = [
            ("longitudinal force / normal force", f"{float(values['traction_coefficient']):.3g}"),
            ("heat per distance rolled", show(float(values["rolling_heat"]), "J/m", 3)),
        ]
        return Words(_sentence(values), headline, rows, tables, (REMARK,))

    def stored(self, found: Found) -> Stored:
        """Direction, law and creepages."""
        return Stored(facts=found.detail)

    def restored(self, stored: Stored, solved: Solved) -> Any:
        """The same again."""
        return dict(stored.facts)


def _rolled(problem: ContactProblem, control: Control, ask: Rolls, progress: Any) -> RoughRolling:
    """Rolling with the map of the file that is asked for: filled, levelled, cut to the width of the contact and made periodic."""
    from ...surfaces.prepare.extent import cropped, periodised
    from ...surfaces.prepare.level import filled, levelled
    from ...surfaces.read import read
    from .rough import roll_rough

    assert ask.roughness is not None
    table, roughness = ask.settings, levelled(filled(read(ask.roughness)))
    across = "x" if table.direction in ("y", "-y") else "y"
    width, room = (grid.size["xy".index(across)] for grid in (problem.grid, roughness.grid))
    if room > width:
        roughness = periodised(cropped(roughness, **{across: (0.0, width)}))
    options: dict[str, Any] = {"distance": table.distance, "direction": table.direction, "progress": progress}
    return roll_rough(problem, control, ask.creepage, roughness, **options)


def _curve(problem: ContactProblem, control: Control, ask: Rolls) -> CreepCurve:
    """Curve of the smooth wheel from a share of the creepages to all of them."""

    import numpy as np

    from .creep_curve import creep_curve

    table, share = ask.settings, np.arange(1, ask.settings.points + 1) / ask.settings.points
    options: Any = {
        "lateral": float(table.lateral) * share,
        "spin": float(table.spin) * share,
        "direction": table.direction,
    }
    return creep_curve(problem, control, float(table.longitudinal) * share, **options)


def _numbers(contact: RollingContact, rough: RoughRolling | None) -> dict[str, float]:
    """``SCALARS``: means over the distance of a rough wheel."""

    import numpy as np

    from .creep_curve import mean_forces, theories_of, theory_forces

    along, across, torque, slips, heat, deviation = mean_forces(contact, rough)
    load, limit = contact.normal.force, contact.friction_limit if rough is None else rough.mean("friction_limit")
    values = {
        "rolling_longitudinal_force": along,
        "rolling_lateral_force": across,
        "rolling_torque": torque,
        "traction_coefficient": along / load if load > 0.0 else math.nan,
        "rolling_friction_share": math.hypot(along, across) / limit if 0.0 < limit < math.inf else math.nan,
        "rolling_slip_area_fraction": slips,
        "rolling_heat": heat,
        "rolling_max_slip": float(np.hypot(*contact.slip).max()),
        "rolling_force_deviation": deviation if rough is not None else math.nan,
    }
    motion = contact.creepage
    at = (np.array(motion.x), np.array(motion.y), np.array(motion.spin))
    known = theories_of(contact, plain=not (motion.y or motion.spin)) if rough is None else ()
    for name, force in (("fastsim", "longitudinal"), ("fastsim", "lateral"), ("carter", "longitudinal")):
        found = theory_forces(name, contact, at) if name in known else None
        size = math.nan if found is None else float(found.force_x if force == "longitudinal" else found.force_y)
        values[f"{name}_{force}_force"] = size
    return values


def _findings(contact: RollingContact, ask: Rolls) -> tuple[Advice, ...]:
    """Gross sliding, large creepages, and few pixels."""

    import numpy as np

    made = []
    if contact.slip_area_fraction == 1.0:
        text = "All points slip: the creepages are beyond those of partial slip, and the tangential force is all that friction bears."
        made.append(Advice("note", "gross sliding", text))
    if max(abs(ask.creepage.x), abs(ask.creepage.y)) > LARGE:
        text = f"A creepage of more than {percent(LARGE)} is not small, as the theory of rolling assumes."
        made.append(Advice("warning", "large creepage", text))
    from .rolling import DIRECTIONS

    touched = np.flatnonzero(DIRECTIONS[contact.direction].oriented(contact.normal.pressure).any(axis=1))
    length = int(touched[-1] - touched[0]) + 1 if touched.size else 0
    if 0 < length < FEW:
        text = f"The contact is {length} pixels long. Errors of the forces fall with the pixel, and are several per cent below {FEW}. Take a finer grid."
        made.append(Advice("note", "pixels of the rolling contact", text))
    return tuple(made)


def picture_of(found: Found, solved: Solved) -> RollingPicture:
    """What figures are drawn from."""
    import numpy as np

    from .figures import RollingPicture

    values, facts = found.values, found.detail

    def field(name: str) -> Any:
        return np.stack([np.asarray(values[f"{name}_{axis}"]) for axis in "xy"])

    curve: dict[str, Any] = {}
    if "creep_longitudinal" in values:
        count = len(np.atleast_1d(values["creep_longitudinal"]))
        curve = {name: values[f"creep_{name}"] for name in ("longitudinal_force", "lateral_force")}
        curve |= {"share": np.arange(1, count + 1) / count, "friction_limit": facts["friction_limit"] or math.inf}
        for name, (x, y) in facts["beside"].items():
            curve |= {f"{name}_longitudinal_force": np.array(x), f"{name}_lateral_force": np.array(y)}
    path: dict[str, Any] = {}
    if "rolled_distance" in values:
        path = {name: values[f"rolled_{name}"] for name in ("distance", "force_x", "force_y")}
        path["running_in"] = facts["running_in"]
    bound = np.asarray(values["rolling_bound"])
    return RollingPicture(
        solved.problem, facts["direction"], field("rolling_traction"), field("rolling_slip"), bound, curve, path
    )


# In words and tables.

REMARK = (
    "The contact rolls steadily along the direction; the counter body slides over the body by the creepages times the rolling speed, and drags it along. Forces are those on the body; on the "
    "other one they are the opposite. Shear tractions that lift unlike surfaces are balanced with the pressure."
)
"""What the model is."""


def _sentence(values: Mapping[str, Any]) -> str:
    share, slips = float(values["rolling_friction_share"]), float(values["rolling_slip_area_fraction"])
    if math.isnan(slips):
        return "The surfaces do not touch: nothing rolls."
    force = show(
        math.hypot(float(values["rolling_longitudinal_force"]), float(values["rolling_lateral_force"])), "N", 3
    )
    limit = "" if math.isnan(share) else f", {percent(share)} of what friction bears"
    heat = show(float(values["rolling_heat"]), "J/m", 3)
    area = "all of the contact sticks" if slips == 0.0 else f"{percent(slips)} of the contact area slips"
    return (
        f"The rolling contact transmits {force} along the surface{limit}; {area}, and rolling turns {heat} into heat."
    )


def _curve_table(values: Mapping[str, Any], facts: Mapping[str, Any]) -> Table:
    """Creepages and forces of every point, FASTSIM or Carter beside them."""

    import numpy as np

    names = {"fastsim": "FASTSIM", "carter": "Carter"}
    beside = next(iter(facts["beside"].items()), None)
    cells = []
    columns = ("longitudinal", "lateral", "spin", "longitudinal_force", "lateral_force", "slip_area_fraction")
    for number, (x, y, spin, along, across, slips) in enumerate(
        zip(*(np.atleast_1d(values[f"creep_{name}"]) for name in columns), strict=True)
    ):
        row = [
            percent(float(x)),
            percent(float(y)),
            f"{float(spin):.3g} rad/m",
            show(float(along), "N"),
            show(float(across), "N"),
        ]
        row.append(percent(float(slips)))
        if beside is not None:
            row += [show(float(part[number]), "N") for part in beside[1]]
        cells.append(tuple(row))
    head = ("Longitudinal", "Lateral", "Spin", "Longitudinal force", "Lateral force", "Slips")
    extra = (
        () if beside is None else tuple(f"{name} force by {names[beside[0]]}" for name in ("Longitudinal", "Lateral"))
    )
    return Table((*head, *extra), tuple(cells))
