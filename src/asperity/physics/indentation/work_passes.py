"""Repeated passes asked for by a document: what is read off the runs, in numbers, figures and
words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ...contact.problem import ContactProblem
from ...core.status import Advice
from ...core.units import percent, show
from ...fem.indenters import LARGE_STRAIN, SMALL_SLOPE
from ...parts.part import Found, Rows, Solved, Table, Words
from ...plots.picture import Figure, figures_by
from ...solids.elastic import Elastic
from ...solids.layers import Layered, RigidBase
from ...solids.strength import flow_stress
from ...theories.subsurface.point_shakedown import sphere_shakedown
from ...theories.subsurface.shakedown import cylinder_shakedown
from ..plastic_flow.figures import plots_of
from ..plastic_flow.part_quantities import Detail, OfElements, number_rows, tension_table, zones_table
from ..plastic_flow.work_values import (
    inferred_strengths,
    layer_names,
    meshed_body,
    picture_of,
    require_flow,
    zone_table,
)
from .figures import pass_figures
from .part_passes import EACH, PREFIX, SCALARS, Passing

if TYPE_CHECKING:
    from ...contact.problem import ContactProblem
from .work_passes_course import Course, Passed, course_of, passed, require_course

FEW = 6
"""Elements across the contact below which plastic strains err by some ten per cent."""


def _numbers(run: Passed, body: Elastic | Layered, course: Course) -> dict[str, Any]:
    """``SCALARS``."""
    shown, each = run.shown, run.each
    rows = np.flatnonzero((shown.strain > 0.0).any(axis=0))
    depth, along, _ = run.profile
    lowest, strains = int(np.argmin(along)), run.numbers["strains"]
    on_rigid = isinstance(body, Layered) and isinstance(body.reduced.base, RigidBase)
    layers, base = (strains, math.nan) if on_rigid else (strains[:-1], strains[-1])
    growth = float(each["growth"][-1])
    own = {
        "pass_radius": course.radius,
        "pass_friction": course.friction,
        "pass_hertz_pressure": course.peak,
        "pass_peak_pressure": run.numbers["peak"],
        "pass_contact_radius": run.numbers["contact"],
        "pass_shakedown_share": course.peak / _limit(body, course),
        "pass_resistance": run.numbers["resistance"],
        "pass_plastic_strain": float(max(strains)),
        "pass_layer_strain": float(max(layers)) if len(layers) else math.nan,
        "pass_base_strain": float(base),
        "pass_strain_growth": growth,
        "pass_growth_ratio": growth / float(each["growth"].max()) if each["growth"].max() > 0.0 else math.nan,
        "pass_onward_share": float(each["onward"][-1]) / growth if growth > 0.0 else math.nan,
        "pass_forward": float(each["forward"][-1]),
        "pass_groove_depth": float(each["groove"][-1]),
        "pass_plastic_depth": float(shown.depth[rows[-1] + 1]) if rows.size else 0.0,
        "pass_residual_compression": max(-float(along[lowest]), 0.0),
        "pass_residual_compression_depth": float(depth[lowest]) if along[lowest] < 0.0 else math.nan,
        **{f"pass_{name}": value for name, value in run.tensions.items()},
    }
    load, work = ("pass_force", "pass_dissipation") if course.sphere else ("pass_line_load", "pass_line_dissipation")
    return {item.name: math.nan for item in SCALARS} | own | {load: course.load, work: run.numbers["work"]}


def _limit(body: Elastic | Layered, course: Course) -> float:
    """Elastic shakedown limit in Pa of Hertz's pressure on a homogeneous body at its initial yield
    stress; NaN on layers and in place."""
    if not isinstance(body, Elastic) or not course.length:
        return math.nan
    k = flow_stress(body.strength).value / math.sqrt(3.0)
    if course.sphere:
        return sphere_shakedown(course.friction, body.poisson_ratio).peak_over_k * k
    return cylinder_shakedown(course.friction).peak_over_k * k


def found_of(run: Passed, body: Elastic | Layered, course: Course) -> Found:
    """Values, facts and findings of a ``run``."""
    zones = zone_table(run.shown, body)
    shape = "sphere" if course.sphere else "cylinder"
    motion = "to and fro" if course.to_and_fro else "one way" if course.length else "in place"
    length = f", {show(course.length, 'm', 3)} long" if course.length else ""
    facts: dict[str, Any] = {
        "layers": layer_names(body),
        "axis": "x",
        "zones": [list(zones.headings), [list(row) for row in zones.cells]],
        "shape": shape,
        "indenter": f"{shape} of radius {show(course.radius, 'm', 3)}",
        "motion": f"{motion}{length}",
        "pressure": "that of Hertz, given" if course.given else "that of the contact with the body that flows",
    }
    values = _numbers(run, body, course) | run.shown.values(PREFIX)
    values |= {f"{PREFIX}_{name}": column for name, column in run.each.items()}
    names = ("profile_depth", "residual_along", "residual_across")
    values |= {f"{PREFIX}_{name}": column for name, column in zip(names, run.profile, strict=True)}
    made, strain = list(inferred_strengths(body)), float(values["pass_plastic_strain"])
    share = run.numbers["contact"] / course.radius
    if strain > LARGE_STRAIN or share > SMALL_SLOPE:
        fact = (
            f"The plastic strain reaches {percent(strain)}, and the contact {share:.2g} of the radius of "
            f"the indenter. Small strains err by more than a few per cent from {percent(LARGE_STRAIN)} or "
            f"{SMALL_SLOPE:g} on."
        )
        numbers = {
            "plastic_strain": strain,
            "largest_strain": LARGE_STRAIN,
            "share": share,
            "largest_share": SMALL_SLOPE,
        }
        made.append(Advice("warning", "small strain", fact, numbers=numbers, concerns=("pass_",)))
    if run.touching < FEW:
        fact = (
            f"Only {run.touching} points of the mesh touch along the track. Plastic strains err by ten per "
            f"cent and more below {FEW}."
        )
        numbers, remedy = (
            {"points": float(run.touching), "least": float(FEW)},
            "Take more elements ({passes.elements}).",
        )
        made.append(Advice("warning", "mesh of the passes", fact, remedy, numbers, ("pass_",)))
    if course.length / course.steps > 0.5 * run.numbers["contact"]:
        step = course.length / course.steps / run.numbers["contact"]
        fact = (
            f"A step along the track is {step:.2g} of the contact radius. Stresses between the steps are not followed."
        )
        remedy = "Take steps of a quarter ({passes.steps})."
        made.append(Advice("warning", "steps of the passes", fact, remedy, {"step": step, "largest": 0.5}, ("pass_",)))
    if run.at_edge:
        fact = "The contact reached the last points of the mesh that may touch, so that it is too small."
        remedy = "Take a shorter track ({passes.track}), less friction ({passes.friction}) or more hardening."
        made.append(Advice("warning", "contact of the passes", fact, remedy, concerns=("pass_",)))
    found = verdict(values)
    if not strain > 0.0:
        made.append(Advice("note", "passes", "Nothing flows under this load: the passes are elastic."))
    elif found in ("flow is not settled", "one pass"):
        fact = (
            f"The flow is not settled after {course.count} pass{'es' * (course.count > 1)}: whether it "
            "ceases, or goes on, takes more of them."
        )
        remedy, concerns = "Take more passes ({passes.count}).", ("pass_strain_growth", "pass_growth_ratio")
        made.append(Advice("note", "passes", fact, remedy, {"passes": float(course.count)}, concerns))
    elif "ceases" not in found and found != "elastic":
        cracks = "once the ductility is used up" if "adds up" in found else "by low-cycle fatigue"
        growth = float(values["pass_strain_growth"])
        fact = f"Every pass adds {percent(growth)} of plastic strain: {found}. Cracks form {cracks}."
        made.append(Advice("warning", "passes", fact, numbers={"growth": growth}))
    return Found(values, Detail(facts, run), tuple(made), PassesWork.citation_keys)


LARGE_SHARE = 0.15
"""Contact over radius of the indenter beyond which small strains err by more than a few per
cent."""

CEASED = 0.01
"""Growth of the plastic strain in the last pass over that in the first below which flow has
ceased."""


STEADY = 0.85
"""Growth in the last pass over that in the one before from which on flow goes on steadily; the same
of the change of the plastic strain."""


ONWARD = 0.1
"""Change of the plastic strain by a pass over its growth from which on strain adds up from pass to
pass; below it cycles are closed."""


class PassesWork(OfElements):
    """A cylinder or sphere that passes over the body again and again, by finite elements: what is
    done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = ("SimoTaylor1985", "Johnson1962", "Hearle1985")

    def check(self, ask: Passing, problem: ContactProblem) -> None:
        """Refuse a body that is rigid or whose yield stresses are not known, and loads under which
        strains are not small, before the contact is solved."""
        body = meshed_body(problem, ask.settings.inside, "passes")
        require_flow(body, unknown_is_elastic=ask.settings.unknown_is_elastic)
        require_course(course_of(ask.settings, body, problem, ask.coefficient), body)

    def compute(self, ask: Passing, solved: Solved) -> Found:
        """All passes, and what they leave."""
        body = meshed_body(solved.problem, ask.settings.inside, "passes")
        course = course_of(ask.settings, body, solved.problem, ask.coefficient)
        with solved.stage("passes") as progress:
            run = passed(body, course, unknown_is_elastic=ask.settings.unknown_is_elastic, progress=progress)
        return found_of(run, body, course)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Zones, residual stress, stress under load, groove; residual stress against depth; what
        each pass adds."""
        shown = picture_of(PREFIX, found.values, found.detail.facts)
        return (*figures_by(plots_of(shown, "passes"), shown), *pass_figures(found.values))

    def words(self, found: Found, solved: Solved) -> Words:
        """Whether flow ceases, zones by layer, tensions, and what each pass adds."""
        values, facts = found.values, found.detail.facts
        columns = [np.atleast_1d(values[item.name]) for item in EACH]
        count = columns[0].size
        passes = []
        for number in (n for n in range(count) if n < 10 or n >= count - 10):
            growth, onward, work, forward, groove = (float(column[number]) for column in columns)
            shares = (percent(growth), percent(onward), percent(work))
            passes.append((str(number + 1), *shares, show(forward, "m", 3), show(groove, "m", 3)))
        strains = ("Growth of the strain", "Change of the strain", "Plastic work / that of the first")
        tables = (
            ("What each pass adds", Table(("Pass", *strains, "Forward", "Groove"), tuple(passes))),
            ("Plastic zones of the passes", zones_table(facts)),
            ("Tension and shear that may crack layers in a pass", tension_table(values, "pass")),
        )
        rows: Rows = [
            ("indenter", str(facts["indenter"])),
            ("motion", str(facts["motion"])),
            ("pressure", str(facts["pressure"])),
            *number_rows(SCALARS, values),
        ]
        ends, pressure = verdict(values), show(float(values["pass_hertz_pressure"]), "Pa", 3)
        size = np.atleast_1d(values["passes_growth"]).size
        start = f"After {size} pass{'es' * (size > 1)} of a {facts['shape']} at Hertz's pressure of {pressure}"
        sentence = f"{start} the middle of the track stays elastic."
        if ends != "elastic":
            reached = f"the plastic strain reaches {percent(float(values['pass_plastic_strain']))}"
            sentence = f"{start} {reached}."
            if ends != "one pass":
                last, ratio = percent(float(values["pass_strain_growth"])), percent(float(values["pass_growth_ratio"]))
                sentence = (
                    f"{start} {reached}; the last pass adds {last} in the middle of the track, {ratio} of "
                    f"the first: {ends}."
                )
        return Words(sentence, [("repeated passes", ends)], rows, tables, (REMARK,))


# In words and tables.

REMARK = (
    "The indenter is rigid, the strains are small, layers are bonded, and all that touches slides. A cylinder "
    "is in plane strain. Growth, residual stress and groove are those in the middle of the track. Flow that "
    "goes on in closed cycles wears by fatigue, strain that adds up from pass to pass by ratchetting."
)
"""What the model is."""


def verdict(values: Mapping[str, Any]) -> str:
    """What becomes of the flow, from the growth of the plastic strain in the first and last
    passes."""
    growth = np.atleast_1d(values["passes_growth"])
    if not growth.max() > 0.0:
        return "elastic"
    if growth.size < 2:
        return "one pass"
    if growth[-1] <= CEASED * growth.max():
        return "flow ceases: shakedown"
    onward = np.atleast_1d(values["passes_onward"])
    if growth.size > 2 and growth[-1] >= STEADY * growth[-2]:
        if float(values["pass_onward_share"]) < ONWARD:
            return "flow goes on in closed cycles"
        if onward[-1] >= STEADY * onward[-2]:
            return "strain adds up: ratchetting"
    return "flow is not settled"
