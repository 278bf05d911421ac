"""Adhesion asked for by a document: approach and parting, pull-off, hysteresis and criteria of
stickiness computed, shown and in words."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...contact.controls import Control, Step, as_step
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.roughness import roughness_of
from ...core.errors import InputError
from ...core.status import Advice
from ...core.units import percent, show
from ...parts.part import Found, Rows, Solved, Table, Words, Work
from ...plots.picture import Figure, figures_by
from ...theories.adhesion.fuller_tabor import FullerTabor
from .answer import PINNED, RESOLVED_RADIUS, method_of
from .bound import energy_bound
from .branch import Jump, adhesive_jumps
from .figures import ADHESION_LOOP, ADHESION_PLOTS, BRANCH_PLOT
from .loop import LOOP_SCALARS, AdhesionLoop, adhesion_cycle, adhesion_loop
from .part import SOURCES, STICKINESS, Asked, Looped
from .stickiness import stickiness
from .work_branch import branch_values, jumps_table


class AdhesionWork(Work):
    """Attraction of the surfaces: what is done for it."""

    def course(self, ask: Asked, controls: tuple[Step | Control, ...]) -> tuple[Step | Control, ...]:
        """Approach and parting, where they are asked for."""
        table = ask.settings
        if table.retract is None:
            return controls
        deepest = float(as_step(controls[-1]).normal.value)
        stiffness = math.inf if table.stiffness is None else float(table.stiffness)
        return adhesion_cycle(
            -float(table.retract), deepest, steps=table.steps, cycles=table.cycles, stiffness=stiffness
        )

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Scalars of the contact, of the loop, and the criteria."""
        found = solved.result.require_adhesion()
        loop = None if solved.path is None else adhesion_loop(solved.path.steps)
        problem, law = solved.problem, found.law
        values: dict[str, Any] = {
            "adhesive_external_force": found.external_force,
            "attractive_force": found.attractive_force,
            "adhesive_area_fraction": found.adhesive_area_fraction,
            "interface_energy": found.interface_energy,
            "stability_margin": found.margin,
            "cohesive_length": found.cohesive_length,
            "pixels_per_cohesive_length": found.pixels_per_length,
            "needed_pixel": found.needed_pixel,
            "jumps": float(found.jumps),
        }
        try:
            sticky = stickiness(problem)
            criteria = [sticky.share_of_limit, sticky.effective_work]
        except InputError:
            criteria = [math.nan, law.work]  # flat
        try:
            roughness = roughness_of(problem.surface.with_heights(problem.profile(), "composite"))
            criteria.append(FullerTabor.from_roughness(roughness, problem.contact_modulus, work=law.work).theta)
        except InputError:
            criteria.append(math.nan)  # no summits of different heights
        values |= dict(zip((item.name for item in STICKINESS), criteria, strict=True))
        table = getattr(ask, "settings", None)
        jumps: tuple[Jump, ...] = ()
        if loop is not None and solved.path is not None and table is not None and table.jump_tolerance is not None:
            jumps = adhesive_jumps(solved.path, float(table.jump_tolerance))
            loop = loop.closed_in(jumps)
        values |= dict.fromkeys((item.name for item in LOOP_SCALARS), math.nan)
        if loop is not None:
            values["pull_off_force"], values["pull_off_approach"] = loop.pull_off_force, loop.pull_off_approach
            values["hysteresis"], values["hysteresis_error"] = loop.hysteresis, loop.hysteresis_error
            values["effective_work_of_adhesion"] = loop.effective_work
        values["adhesive_energy"] = found.elastic_energy + found.interface_energy
        try:
            values["adhesive_energy_bound"] = energy_bound(solved.result).lower
        except InputError:
            values["adhesive_energy_bound"] = math.nan  # a hardness, film, friction or core
        keys, findings = (*found.citation_keys, "PastewkaRobbins2014", "PerssonTosatti2001"), _findings(solved)
        if table is not None and table.pair is not None:
            values |= {SOURCES.name: np.array(table.of_pair().sources)}
        if loop is None or table is None:
            return Found(values, loop, findings, keys)
        if table.branch:
            of_branch, stopped = branch_values(solved, -float(table.retract))
            values, findings, keys = values | of_branch, (*findings, *stopped), (*keys, "Feng2000")
        return Found(values, Looped(loop, jumps), findings, keys)

    def citations(self, ask: Asked, problem: ContactProblem) -> tuple[str, ...]:
        """Papers of law and method."""
        return (*ask.law.citation_keys, *method_of(ask.law).citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Loop of force and approach; zone and tractions, of a loop those at the pull-off."""
        if solved.path is None:
            return figures_by(ADHESION_PLOTS, solved.result)
        branch = figures_by((BRANCH_PLOT,), found.values) if "branch_approach" in found.values else ()
        at = solved.path.steps[adhesion_loop(solved.path.steps).pull_off]
        return (*figures_by((ADHESION_LOOP,), solved.path), *branch, *figures_by(ADHESION_PLOTS, at))

    def words(self, found: Found, solved: Solved) -> Words:
        """Law, attraction, resolution, stability; pull-off and hysteresis of a path."""
        contact = solved.result.require_adhesion()
        values, rows = found.values, law_rows(solved.result)

        rows.append(("energy", show(float(values["adhesive_energy"]), "J")))
        bound = float(values["adhesive_energy_bound"])
        if math.isfinite(bound):
            rows.append(("no contact at this approach has less energy than", show(bound, "J")))
        if "folds" in values:
            rows.append(("folds of the branch", f"{float(values['folds']):.0f}"))
            at, force = float(values["fold_approach"]), show(float(values["fold_force"]), "N")
            if math.isfinite(at):
                rows.append(("first fold, where rigid grips jump", f"{show(at, 'm')} under {force}"))

        number, left, theta = (values[item.name] for item in STICKINESS)
        if math.isfinite(number):
            sticky = f"{number:.3g} ({'sticky' if number < 1.0 else 'not sticky'})"
            gains = "full contact gains energy" if left > 0.0 else "full contact costs energy"
            rows.append(("Pastewka and Robbins' number / limit", sticky))
            rows.append(("Persson and Tosatti's work of adhesion", f"{show(left, 'J/m**2', 3)} ({gains})"))
        if math.isfinite(theta):
            rows.append(("Fuller and Tabor's parameter", f"{theta:.3g}"))
        if SOURCES.name in values:
            rows.append(("work of adhesion from", "; ".join(map(str, values[SOURCES.name]))))

        if found.detail is None:
            branch = "at a minimum of the energy" if contact.stable else "NOT at a minimum of the energy"
            what = "edge of the contact" if contact.short_range else "attracting zone"
            resolved = "" if contact.resolved else f" The {what} is NOT resolved by the grid."
            sentence = (
                f"The surfaces attract each other with {show(contact.attractive_force, 'N')} against an "
                f"external force of {show(contact.external_force, 'N')}, {branch}.{resolved}"
            )
            return Words(sentence, rows=rows, remarks=(REMARK,))
        looped = found.detail if isinstance(found.detail, Looped) else Looped(found.detail)
        loop = looped.loop
        headline = [("pull-off force", show(loop.pull_off_force, "N"))]
        tables = (("Jumps", jump_table(loop)),) if loop.jumped.any() else ()
        if looped.jumps:
            tables = (*tables, ("Where jumps begin", jumps_table(looped.jumps)))
        jumps = int(loop.jumped.sum())
        error = f" (to {show(loop.hysteresis_error, 'J', 2)})" if loop.hysteresis_error > 0.0 else ""
        lost = f"{show(loop.hysteresis, 'J')}{error} were lost, with {jumps} jump{'' if jumps == 1 else 's'}"
        sentence = (
            f"The largest tensile force was {show(loop.pull_off_force, 'N')} at an approach of "
            f"{show(loop.pull_off_approach, 'm')}; {lost}."
        )
        return Words(sentence, headline, rows, tables, (REMARK,))


ZONE = ("attractive_force", "adhesive_area_fraction", "pull_off_", "hysteresis", "jumps")
"""What a zone that the grid does not resolve puts in doubt."""


def _findings(solved: Solved) -> tuple[Advice, ...]:
    """A zone that the grid does not resolve, an unstable end, steps that failed."""
    found, made = solved.result.require_adhesion(), []
    if not found.resolved and found.short_range:
        fact = (
            "The contact spots are not resolved for adhesion of infinitely short range: their mean radius is "
            f"{show(found.spot_radius, 'm', 3)}, {found.pixels_per_length:.2g} pixels, and should be at least "
            f"{RESOLVED_RADIUS:g}; pull-off is too large, by an error in proportion to the pixel."
        )
        remedy = f"Take a pixel of at most {show(found.needed_pixel, 'm', 3)} ({{resample}})."
        numbers = {"pixels": found.pixels_per_length, "least": RESOLVED_RADIUS, "needed_pixel": found.needed_pixel}
        made.append(Advice("warning", "adhesive zone", fact, remedy, numbers, ZONE))
    elif not found.resolved:
        pinned = found.pixels_per_length < PINNED
        effect = (
            "single pixels snap, and hysteresis and pull-off are those of the grid" if pinned else "pull-off may be off"
        )
        where = (
            f"the cohesive length E*w/σ0² is {show(found.cohesive_length, 'm', 3)}, "
            f"{found.pixels_per_length:.2g} pixels, and should be at least {found.pixels_needed:.3g}"
        )
        if found.pixels_per_length >= found.pixels_needed:
            where = (
                f"the mean radius of contact spots with their zone is {show(found.zone_radius, 'm', 3)}, "
                f"{found.pixels_per_radius:.2g} pixels, and should be at least {found.radius_needed:.3g}"
            )
        remedy = (
            f"Take a pixel of at most {show(found.needed_pixel, 'm', 3)} ({{resample}}), or a larger range at "
            "the same work of adhesion "
            "({adhesion.range})."
        )
        numbers = {
            "pixels": found.pixels_per_length,
            "least": found.pixels_needed,
            "pixels_per_radius": found.pixels_per_radius,
            "least_per_radius": found.radius_needed,
            "needed_pixel": found.needed_pixel,
        }
        fact = f"The attracting zone is not resolved: {where}; {effect}."
        made.append(Advice("warning", "adhesive zone", fact, remedy, numbers, ZONE))
    if not found.stable:
        fact = f"The contact is not at a minimum of the energy (margin {found.margin:.2g})."
        remedy = "Take smaller steps of load or position ({control.path.steps})."
        made.append(Advice("warning", "stability", fact, remedy, {"margin": found.margin}, ("stability_margin",)))
    return tuple(made)


REMARK = (
    "Pressures are those of the wall; the net traction is the pressure less the attraction. Each step goes "
    "downhill in energy from the attraction of the step before, so that a path follows its branch until that "
    "ends in a jump. On a periodic surface the images attract each other, and a fixed mean gap is stiffer "
    "than a real machine."
)
"""What the numbers mean."""


def law_rows(result: ContactResult) -> Rows:
    """Law, resolution and branch."""
    found = result.require_adhesion()
    if found.short_range:
        reach = [
            ("range", "infinitely short"),
            (
                "mean radius of the contact spots",
                f"{show(found.spot_radius, 'm', 3)}, {found.pixels_per_length:.3g} pixels",
            ),
        ]
    else:
        reach = [
            ("largest attraction", show(found.law.strength, "Pa")),
            ("range, work / largest attraction", show(found.law.work / found.law.strength, "m")),
            ("area that attracts without touching", percent(found.adhesive_area_fraction)),
            ("cohesive length", f"{show(found.cohesive_length, 'm', 3)}, {found.pixels_per_length:.3g} pixels"),
        ]
    needed = "" if math.isnan(found.needed_pixel) else f"{show(found.needed_pixel, 'm', 3)} at most"
    return [
        ("law", found.law.name),
        ("work of adhesion", show(found.law.work, "J/m**2")),
        *reach,
        ("attractive force", show(found.attractive_force, "N")),
        ("external force", show(found.external_force, "N")),
        ("margin of stability", f"{found.margin:.3g} ({'stable' if found.stable else 'not stable'})"),
        ("pixel that resolves it", needed or "none"),
        ("residual of the attraction", f"{found.residual:.1e}"),
    ]


def jump_table(loop: AdhesionLoop) -> Table:
    """Where every jump begins and ends, the forces there, and what it loses with its error."""
    cells = []
    for step, between in zip(np.flatnonzero(loop.jumped), loop.jump_intervals, strict=True):
        forces = [show(float(loop.force[k]), "N") for k in (step - 1, step)]
        interval = [show(end, "m") for end in between]
        lost = show(float(loop.lost[step]), "J"), show(float(loop.error[step]), "J", 2)
        cells.append((f"{step + 1}", *interval, *forces, *lost))
    heads = ("Step", "Begins after", "Ends before", "Force before", "Force after", "Energy lost", "To within")
    return Table(heads, tuple(cells))
