"""Rolling asked for by a document: steady contact, creep-force curve and rough wheels in numbers,
figures and words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from ...contact.controls import Control
from ...contact.problem import ContactProblem
from ...core.status import Advice
from ...core.units import percent, show
from ...io.words import value_text
from ...parts.part import Found, Rows, Solved, Table, WithFacts, Words
from ...plots.picture import Figure, figures_by
from ...surfaces.prepare.extent import cropped, periodised
from ...surfaces.prepare.level import filled, levelled
from ...surfaces.read import read_map
from ..friction.work_stick_slip import law_text
from .creep_curve import CREEPAGES, FORCES, creep_curve, mean_forces, theories_of, theory_forces
from .figures import CURVE_PLOT, PATH_PLOT, ROLLING_PLOTS, RollingPicture
from .part import SCALARS, Rolls
from .rolling import DIRECTIONS, RollingContact, require_rolling, roll
from .rough import PATH as MOVES
from .rough import RoughRolling, roll_rough
from .solver import SteadyNewton

LARGE = 0.1
"""Creepage from which on the bodies do not roll in the sense of the theory."""


FEW = 16
"""Pixels along the contact below which the forces of the grid err by several per cent."""


class RollingWork(WithFacts):
    """The steady contact of bodies that roll with creepage, or a rough wheel: what is done for
    it."""

    citation_keys: ClassVar[tuple[str, ...]] = SteadyNewton.citation_keys

    def check(self, ask: Rolls, problem: ContactProblem) -> None:
        """Refuse what cannot roll."""
        require_rolling(problem.with_physics(friction=ask.law), ask.creepage, ask.settings.direction)  # type: ignore[arg-type]

    def compute(self, ask: Rolls, solved: Solved) -> Found:
        """Forces, fields and curves."""
        problem, way = solved.problem.with_physics(friction=ask.law), ask.settings.direction
        with solved.stage("rolling") as progress:
            rough = None if ask.roughness is None else _rolled(problem, solved.control, ask, progress)
            contact = roll(problem, solved.control, ask.creepage, direction=way) if rough is None else rough.last  # type: ignore[arg-type]
            curve, table = None, ask.settings
            if table.points and solved.lines:
                share = np.arange(1, table.points + 1) / table.points
                options: Any = {
                    "lateral": float(table.lateral) * share,
                    "spin": float(table.spin) * share,
                    "direction": table.direction,
                }
                curve = creep_curve(problem, solved.control, float(table.longitudinal) * share, **options)
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
        made = []
        if contact.slip_area_fraction == 1.0:
            fact = (
                "All points slip: the creepages are beyond those of partial slip, and the tangential "
                "force is all that friction bears."
            )
            made.append(Advice("note", "gross sliding", fact))
        if max(abs(ask.creepage.x), abs(ask.creepage.y)) > LARGE:
            fact = f"A creepage of more than {percent(LARGE)} is not small, as the theory of rolling assumes."
            numbers = {"longitudinal": ask.creepage.x, "lateral": ask.creepage.y, "largest": LARGE}
            made.append(Advice("warning", "large creepage", fact, numbers=numbers, concerns=("rolling_",)))
        touched = np.flatnonzero(DIRECTIONS[contact.direction].oriented(contact.normal.pressure).any(axis=1))
        length = int(touched[-1] - touched[0]) + 1 if touched.size else 0
        if 0 < length < FEW:
            fact = (
                f"The contact is {length} pixels long. Errors of the forces fall with the pixel, and are "
                f"several per cent below {FEW}."
            )
            numbers, concerns = (
                {"pixels": float(length), "least": float(FEW)},
                ("rolling_", "traction_coefficient", "creep_"),
            )
            made.append(
                Advice(
                    "note", "pixels of the rolling contact", fact, "Take a finer grid ({resample}).", numbers, concerns
                )
            )
        return Found(values, facts, tuple(made), keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Map of stick and slip, section, creep-force curve, forces of a rough wheel."""
        shown = picture_of(found, solved)
        plots = (*ROLLING_PLOTS, *((CURVE_PLOT,) if shown.curve else ()), *((PATH_PLOT,) if shown.path else ()))
        return figures_by(plots, shown)

    def words(self, found: Found, solved: Solved) -> Words:
        """What it transmits, what slips, what becomes heat, and the theories beside it."""
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
        share, slips = float(values["rolling_friction_share"]), float(values["rolling_slip_area_fraction"])
        sentence = "The surfaces do not touch: nothing rolls."
        if not math.isnan(slips):
            along, across = float(values["rolling_longitudinal_force"]), float(values["rolling_lateral_force"])
            limit = "" if math.isnan(share) else f", {percent(share)} of what friction bears"
            heat = show(float(values["rolling_heat"]), "J/m", 3)
            area = "all of the contact sticks" if slips == 0.0 else f"{percent(slips)} of the contact area slips"
            sentence = (
                f"The rolling contact transmits {show(math.hypot(along, across), 'N', 3)} along the "
                f"surface{limit}; {area}, and rolling turns {heat} into heat."
            )
        return Words(sentence, headline, rows, tables, (REMARK,))


def _rolled(problem: ContactProblem, control: Control, ask: Rolls, progress: Any) -> RoughRolling:
    """Rolling with the map of the file that is asked for: filled, levelled, cut to the width of the
    contact and made periodic."""
    assert ask.roughness is not None
    table, roughness = ask.settings, levelled(filled(read_map(ask.roughness)))
    across = "x" if table.direction in ("y", "-y") else "y"
    width, room = (grid.size["xy".index(across)] for grid in (problem.grid, roughness.grid))
    if room > width:
        roughness = periodised(cropped(roughness, **{across: (0.0, width)}))
    options: dict[str, Any] = {"distance": table.distance, "direction": table.direction, "progress": progress}
    return roll_rough(problem, control, ask.creepage, roughness, **options)


def _numbers(contact: RollingContact, rough: RoughRolling | None) -> dict[str, float]:
    """``SCALARS``: means over the distance of a rough wheel."""
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


def picture_of(found: Found, solved: Solved) -> RollingPicture:
    """What figures are drawn from."""
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
    "The contact rolls steadily along the direction; the counter body slides over the body by the creepages "
    "times the rolling speed, and drags it along. Forces are those on the body; on the other one they are the "
    "opposite. Shear tractions that lift unlike surfaces are balanced with the pressure."
)
"""What the model is."""


def _curve_table(values: Mapping[str, Any], facts: Mapping[str, Any]) -> Table:
    """Creepages and forces of every point, FASTSIM or Carter beside them."""
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
