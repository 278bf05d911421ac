"""Adhesion: the law of the attraction, approach and parting, pull-off and hysteresis, and criteria of stickiness beside them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.status import Advice
from ...core.units import percent, show
from ...core.values import Choice, Count, Length, Number, Pressure, SurfaceTension
from ...parts.part import Found, Part, Rows, Solved, Table, Words
from .part_branch import (
    BRANCH,
    ENERGY,
    branch_values,
    jumps_table,
)

if TYPE_CHECKING:
    from ...contact.controls import Control, Step
    from ...contact.problem import ContactProblem
    from ...contact.result import ContactResult
    from ...plots.picture import Figure
    from .branch import Jump
    from .law import Adhesion as AdhesionLaw
    from .loop import AdhesionLoop
    from .surface_energy import PairAdhesion

LAWS = ("exponential", "dugdale", "linear", "van der waals", "lennard-jones", "jkr")
"""Laws of adhesion in documents."""

WITHOUT_RANGE, OWN_RANGE = "jkr", "van der waals"
"""The law that has no range, and the one that knows its own."""

Law = Annotated[str, Choice({name: name for name in LAWS})]

MachineStiffness = Annotated[float, Number("surface tension", above=0.0)]

USUAL_STEPS = 20
"""Steps of each way of approach and parting, if not said otherwise."""


class AdhesionSettings(Settings):
    """Attraction of the surfaces, by its work of adhesion and either its range or its strength, the largest stress: range = work/strength.

    The law "van der waals" needs neither; ``range`` is then half the distance of the atomic planes in contact, by default 0.165 nm.
    The law "jkr" has none: its range is infinitely short.
    With ``retract`` the bodies approach from that distance to the approach of the table [control] and part again.
    """

    work: SurfaceTension | None = setting(None, option="--adhesion", help="Work of adhesion: 50mJ/m**2")
    pair: str | None = setting(
        None,
        option="--adhesion-pair",
        help="Two solids whose work of adhesion it is, instead of --adhesion: polystyrene/paraffin wax",
    )
    law: Law = setting("exponential", option="--adhesion-law", help="Attraction as a function of the gap")
    range: Length | None = setting(None, option="--adhesion-range", help="Work over strength: 1nm")
    strength: Pressure | None = setting(None, option="--adhesion-strength", help="Largest attraction: 50MPa")
    retract: Length | None = setting(
        None, option="--retract", help="Approach from this distance apart, and part to it again, with --approach: 20nm"
    )
    steps: Count = setting(USUAL_STEPS, option="--retract-steps", help="Steps of each way")
    cycles: Count = setting(1, option="--retract-cycles", help="Number of approaches")
    stiffness: MachineStiffness | None = setting(
        None, option="--machine-stiffness", help="Of the machine that holds the bodies: 10N/m; rigid by default"
    )

    branch: bool = setting(
        False, option="--adhesion-branch", help="Follow the branch that jumps leave through its folds, with --retract"
    )
    jump_tolerance: Length | None = setting(
        None, option="--jump-tolerance", help="Close in on every jump to this approach, with --retract: 0.01nm"
    )

    @model_validator(mode="after")
    def _whole(self) -> AdhesionSettings:
        if (self.work is None) == (self.pair is None):
            gives = "neither" if self.work is None else "both"
            raise InputError(
                ' must give either the work of adhesion, such as work = "50 mJ/m**2" (--adhesion), or a pair of solids, such as pair = '
                f'"polystyrene/paraffin wax" (--adhesion-pair), but gives {gives}.'
            )
        if self.pair is not None and self.pair.count("/") != 1:
            raise InputError(
                f'.pair (--adhesion-pair) must be two solids, such as "polystyrene/paraffin wax", but is {self.pair!r}.'
            )
        if self.pair is not None:
            try:
                self.of_pair()
            except InputError as error:
                raise InputError(
                    f".pair (--adhesion-pair) must be two solids that were measured together or whose energies are known, but is {self.pair!r}: {error}"
                ) from None
        given = (self.range is not None) + (self.strength is not None)
        if given and self.law == WITHOUT_RANGE:
            raise InputError(
                f" must give neither a range (--adhesion-range) nor a strength (--adhesion-strength) for the law {WITHOUT_RANGE}, "
                "whose range is infinitely short, but does. Leave it out, or choose the law exponential."
            )
        if given > 1 or (given == 0 and self.law not in (WITHOUT_RANGE, OWN_RANGE)):
            raise InputError(
                f" must give either a range (--adhesion-range) or a strength (--adhesion-strength) for the law {self.law}, but gives "
                f'{"both" if given else "neither"}. Write for example range = "1 nm".'
            )
        further = self.stiffness is not None or self.branch or self.jump_tolerance is not None
        if self.retract is None and (further or self.cycles != 1 or self.steps != USUAL_STEPS):
            raise InputError(
                " must give the distance to which the bodies part, retract (--retract), with its steps, cycles, branch, jumps and the stiffness of "
                "the machine, but does not."
            )
        if self.retract is not None and self.steps < 2:
            raise InputError(f".steps (--retract-steps) must be at least 2, but is {self.steps}.")
        return self

    def of_pair(self) -> PairAdhesion:
        """Work of adhesion of the pair, with sources."""
        from .surface_energy import work_of_adhesion

        first, second = str(self.pair).split("/")
        return work_of_adhesion(first, second)

    def adhesion(self) -> AdhesionLaw:
        """The law."""
        from .jkr import JKRAdhesion
        from .law import DugdaleAdhesion, ExponentialAdhesion, LennardJonesAdhesion, LinearAdhesion, VanDerWaalsAdhesion

        work = float(self.work) if self.work is not None else self.of_pair().work
        if self.law == WITHOUT_RANGE:
            return JKRAdhesion(work)
        if self.law == OWN_RANGE and self.range is None and self.strength is None:
            return VanDerWaalsAdhesion(work)
        reach = float(self.range) if self.range is not None else work / float(self.strength or math.nan)
        if self.law == OWN_RANGE:
            return VanDerWaalsAdhesion(work, 2.0 * reach)
        if self.law == "lennard-jones":
            return LennardJonesAdhesion(work, 16.0 * reach / (9.0 * math.sqrt(3.0)))
        if self.law == "dugdale":
            return DugdaleAdhesion(work, reach)
        return LinearAdhesion(work, reach) if self.law == "linear" else ExponentialAdhesion(work, reach)


@dataclass(frozen=True)
class Asked:
    """The table and the law."""

    settings: AdhesionSettings
    law: AdhesionLaw


SOURCES = Quantity("work_of_adhesion_sources", "", "sources of the work of adhesion of the pair", dims=("source",))
"""What the work of adhesion of two named solids rests on."""


@dataclass(frozen=True, eq=False)
class Looped:
    """The loop of a path, and its jumps where they were closed in on."""

    loop: AdhesionLoop
    jumps: tuple[Jump, ...] = ()


STICKINESS = (
    Quantity("pastewka_robbins", "1", "Pastewka and Robbins' number / its limit, sticky below 1"),
    Quantity("persson_tosatti_work", "J/m**2", "work of adhesion less the energy of full contact (Persson, Tosatti)"),
    Quantity("fuller_tabor", "1", "Fuller and Tabor's adhesion parameter, roughness wins above about 10"),
)
"""Criteria beside the contact."""


class Adhesion(Part):
    """Attraction of the surfaces."""

    name = "adhesion"
    title = "Adhesion"
    table = "adhesion"
    settings = AdhesionSettings
    whole_path = True
    of_result = "adhesion"

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars of the contact, of approach and parting, and criteria."""
        from .loop import ADHESION_SCALARS, LOOP_SCALARS

        return (*ADHESION_SCALARS, *LOOP_SCALARS, *STICKINESS, *ENERGY, *BRANCH, SOURCES)

    def asked(self, document: Any, folder: Path) -> Asked:
        """The table [adhesion] with its law."""
        table: AdhesionSettings = document.adhesion
        if table.retract is not None and document.control.approach is None:
            raise InputError(
                "approach must be given as the deepest position of approach and parting (adhesion.retract, --retract), but is not. Give "
                'control.approach (--approach), such as "5 nm".',
                subject="approach",
            )
        return Asked(table, table.adhesion())

    def coupling(self, ask: Asked) -> Mapping[str, Any]:
        """The attraction joins the solve."""
        return {"adhesion": ask.law}

    def course(self, ask: Asked, controls: tuple[Step | Control, ...]) -> tuple[Step | Control, ...]:
        """Approach and parting, where they are asked for."""
        from ...contact.controls import as_step
        from .loop import adhesion_cycle

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
        import numpy as np

        from ...contact.roughness import roughness_of
        from ...theories.adhesion.fuller_tabor import FullerTabor
        from .bound import energy_bound
        from .branch import adhesive_jumps
        from .loop import LOOP_SCALARS, adhesion_loop, adhesion_numbers
        from .stickiness import stickiness

        found = solved.result.require_adhesion()
        loop = None if solved.path is None else adhesion_loop(solved.path.steps)
        problem, law = solved.problem, found.law
        values: dict[str, Any] = adhesion_numbers(solved.result)
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
        from .answer import method_of

        return (*ask.law.citation_keys, *method_of(ask.law).citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Loop of force and approach; zone and tractions, of a loop those at the pull-off."""
        from ...plots.picture import figures_by
        from .figures import ADHESION_LOOP, ADHESION_PLOTS, BRANCH_PLOT
        from .loop import adhesion_loop

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
                f"The surfaces attract each other with {show(contact.attractive_force, 'N')} against an external force of "
                f"{show(contact.external_force, 'N')}, {branch}.{resolved}"
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
            f"The largest tensile force was {show(loop.pull_off_force, 'N')} at an approach of {show(loop.pull_off_approach, 'm')}; "
            f"{lost}."
        )
        return Words(sentence, headline, rows, tables, (REMARK,))


def _findings(solved: Solved) -> tuple[Advice, ...]:
    """A zone that the grid does not resolve, an unstable end, steps that failed."""
    from .answer import PINNED, RESOLVED_RADIUS

    found, made = solved.result.require_adhesion(), []
    if not found.resolved and found.short_range:
        text = (
            f"The contact spots are not resolved for adhesion of infinitely short range: their mean radius is {show(found.spot_radius, 'm', 3)}, "
            f"{found.pixels_per_length:.2g} pixels, and should be at least {RESOLVED_RADIUS:g}; pull-off is too large, by an error in "
            f"proportion to the pixel. Take a pixel of at most {show(found.needed_pixel, 'm', 3)}."
        )
        made.append(Advice("warning", "adhesive zone", text))
    elif not found.resolved:
        pinned = found.pixels_per_length < PINNED
        effect = (
            "single pixels snap, and hysteresis and pull-off are those of the grid" if pinned else "pull-off may be off"
        )
        where = (
            f"the cohesive length E*w/σ0² is {show(found.cohesive_length, 'm', 3)}, {found.pixels_per_length:.2g} pixels, and should be at "
            f"least {found.pixels_needed:.3g}"
        )
        if found.pixels_per_length >= found.pixels_needed:
            where = (
                f"the mean radius of contact spots with their zone is {show(found.zone_radius, 'm', 3)}, {found.pixels_per_radius:.2g} pixels, "
                f"and should be at least {found.radius_needed:.3g}"
            )
        text = (
            f"The attracting zone is not resolved: {where}; {effect}. Take a pixel of at most "
            f"{show(found.needed_pixel, 'm', 3)}, or a larger range at the same work of adhesion."
        )
        made.append(Advice("warning", "adhesive zone", text))
    if not found.stable:
        text = f"The contact is not at a minimum of the energy (margin {found.margin:.2g}). Take smaller steps of load or position."
        made.append(Advice("warning", "stability", text))
    return tuple(made)


# In words and tables.


REMARK = (
    "Pressures are those of the wall; the net traction is the pressure less the attraction. Each step goes downhill in energy from the "
    "attraction of the step before, so that a path follows its branch until that ends in a jump. On a periodic surface the images "
    "attract each other, and a fixed mean gap is stiffer than a real machine."
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
    import numpy as np

    cells = []
    for step, between in zip(np.flatnonzero(loop.jumped), loop.jump_intervals, strict=True):
        forces = [show(float(loop.force[k]), "N") for k in (step - 1, step)]
        interval = [show(end, "m") for end in between]
        lost = show(float(loop.lost[step]), "J"), show(float(loop.error[step]), "J", 2)
        cells.append((f"{step + 1}", *interval, *forces, *lost))
    heads = ("Step", "Begins after", "Ends before", "Force before", "Force after", "Energy lost", "To within")
    return Table(heads, tuple(cells))
