"""Repeated passes: a cylinder or sphere that rolls or slides over the body, or is pressed in place again and again, by finite elements; whether flow ceases."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.units import percent, show
from ...core.values import Choice, Force, Length, NonNegative, Number, Pressure, Whole
from ...parts.part import Found, Part, Rows, Solved, Stored, Table, Words
from ..plastic_flow.part_quantities import Detail, number_rows, quantities_of, tension_table, zones_table

if TYPE_CHECKING:
    from ...contact.problem import ContactProblem
    from ...plots.picture import Figure
    from .work_passes import Course

Shape = Annotated[str, Choice({name: name for name in ("cylinder", "sphere")})]
Motion = Annotated[str, Choice({name: name for name in ("one way", "to and fro", "in place")})]
Given = Annotated[str, Choice({name: name for name in ("solved", "hertz")})]
LineLoad = Annotated[float, Number("N/m", above=0.0)]
Inside = Annotated[str, Choice({name: name for name in ("body", "counter_body")})]

PREFIX = "passes"

CEASED = 0.01
"""Growth of the plastic strain in the last pass over that in the first below which flow has ceased."""

STEADY = 0.85
"""Growth in the last pass over that in the one before from which on flow goes on steadily; the same of the change of the plastic strain."""

ONWARD = 0.1
"""Change of the plastic strain by a pass over its growth from which on strain adds up from pass to pass; below it cycles are closed."""


class PassesSettings(Settings):
    """Passes of a rigid cylinder (in plane strain) or sphere over the body, beside the contact of the surfaces.

    The load is one of ``force`` (sphere), ``line_load`` (cylinder) or ``peak_pressure``, that of Hertz's elastic contact with the base. With pressure
    "hertz" this pressure itself moves over the body, otherwise the contact is solved with the flow. All that touches slides with the ``friction``, by
    default the coefficient of [friction]. Layers and base flow at their yield stress with their hardening, and strains are small.
    """

    count: Annotated[int, Whole(1, 200)] | None = setting(
        None, option="--passes", help="Number of passes of a cylinder or sphere, by finite elements"
    )
    indenter: Shape = setting("cylinder", option="--pass-indenter", help="Cylinder or sphere")
    radius: Length | None = setting(
        None, option="--pass-radius", help="Of cylinder or sphere: 10um; by default the mean radius of the summits"
    )
    force: Force | None = setting(None, option="--pass-force", help="Load of a sphere: 1mN")
    line_load: LineLoad | None = setting(None, option="--pass-line-load", help="Load of a cylinder: 500N/m")
    peak_pressure: Pressure | None = setting(
        None, option="--pass-peak", help="Instead of a load: largest pressure of Hertz's contact with the base, 1GPa"
    )
    pressure: Given = setting(
        "solved", option="--pass-pressure", help="solved: of a rigid indenter; hertz: Hertz's pressure, given"
    )
    friction: NonNegative | None = setting(
        None, option="--pass-friction", help="Coefficient of the passes; by default that of the contact"
    )
    motion: Motion = setting("one way", option="--pass-motion", help="one way, to and fro, or in place")
    track: Length | None = setting(
        None,
        option="--pass-track",
        help="Length of a pass; by default 4 half-widths of a cylinder, 2 radii of a sphere",
    )
    steps: Annotated[int, Whole(4, 400)] = setting(16, option="--pass-steps", help="Steps of a pass along the track")
    elements: Annotated[int, Whole(4, 60)] | None = setting(
        None, option="--pass-elements", help="Elements across the contact radius; by default 8, under a sphere 4"
    )
    inside: Inside = setting("body", option="--pass-in", help="body or counter_body")
    unknown_is_elastic: bool = setting(
        False,
        option="--pass-unknown-elastic",
        help="Materials of unknown yield stress stay elastic, instead of being refused",
    )

    @model_validator(mode="after")
    def _whole(self) -> PassesSettings:
        if self.count is None:
            raise InputError(" must give the number of passes, such as count = 3 (--passes 3), but does not.")
        loads = [name for name in ("force", "line_load", "peak_pressure") if getattr(self, name) is not None]
        own = {"sphere": "force", "cylinder": "line_load"}[self.indenter]
        if len(loads) != 1 or loads[0] not in (own, "peak_pressure"):
            raise InputError(
                f" must give either {own} or peak_pressure for a {self.indenter}, but gives {' and '.join(loads) or 'neither'}."
            )
        if self.motion == "in place" and (self.track is not None or self.friction):
            raise InputError(" must give neither track nor friction where motion is in place, but does.")
        if self.indenter == "sphere" and (self.elements or 0) > MOST_UNDER_A_SPHERE:
            raise InputError(
                f".elements must be at most {MOST_UNDER_A_SPHERE} under a sphere, but is {self.elements}: the number of bricks grows with its cube."
            )
        return self


MOST_UNDER_A_SPHERE = 10

SCALARS = (
    Quantity("pass_line_load", "N/m", "load of the cylinder that passes"),
    Quantity("pass_force", "N", "load of the sphere that passes"),
    Quantity("pass_radius", "m", "radius of the cylinder or sphere that passes"),
    Quantity("pass_friction", "1", "friction coefficient of the passes"),
    Quantity("pass_hertz_pressure", "Pa", "largest pressure of Hertz's contact with the base, passes"),
    Quantity("pass_peak_pressure", "Pa", "largest pressure in the middle of the last pass"),
    Quantity("pass_contact_radius", "m", "half-width or radius of the contact in the last pass"),
    Quantity("pass_shakedown_share", "1", "Hertz's pressure / elastic shakedown limit at first yield"),
    Quantity("pass_line_dissipation", "J/m", "plastic work of the last pass per length of the cylinder"),
    Quantity("pass_dissipation", "J", "plastic work of the last pass of the sphere"),
    Quantity("pass_resistance", "1", "plastic work of the last pass / load and distance"),
    Quantity("pass_plastic_strain", "1", "largest accumulated plastic strain, passes"),
    Quantity("pass_layer_strain", "1", "largest accumulated plastic strain of a layer, passes"),
    Quantity("pass_base_strain", "1", "largest accumulated plastic strain of the base, passes"),
    Quantity("pass_strain_growth", "1", "growth of the accumulated plastic strain in the last pass"),
    Quantity("pass_growth_ratio", "1", "that growth / growth in the first pass"),
    Quantity("pass_onward_share", "1", "change of the plastic strain by the last pass / its growth"),
    Quantity("pass_forward", "m", "motion of the surface along the track in the last pass"),
    Quantity("pass_groove_depth", "m", "depth of the groove after the passes"),
    Quantity("pass_plastic_depth", "m", "depth of the plastic zone of the passes"),
    Quantity("pass_residual_compression", "Pa", "largest residual compression along the track"),
    Quantity("pass_residual_compression_depth", "m", "depth of that compression"),
    Quantity("pass_surface_tension", "Pa", "largest tension along the surface in a pass"),
    Quantity("pass_layer_tension", "Pa", "largest tension at the bottom of a layer in a pass"),
    Quantity("pass_interface_shear", "Pa", "largest shear of an interface in a pass"),
    Quantity("pass_interface_peel", "Pa", "largest peel stress of an interface in a pass"),
    Quantity("pass_residual_surface_tension", "Pa", "largest residual tension along the surface after the passes"),
    Quantity("pass_residual_layer_tension", "Pa", "largest residual tension at the bottom of a layer after the passes"),
    Quantity("pass_residual_interface_shear", "Pa", "largest residual shear of an interface after the passes"),
    Quantity("pass_residual_interface_peel", "Pa", "largest residual peel stress of an interface after the passes"),
)
"""Numbers of repeated passes, in the middle of the track; NaN where there is no such thing."""

EACH = (
    Quantity("passes_growth", "1", "growth of the accumulated plastic strain in each pass"),
    Quantity("passes_onward", "1", "change of the plastic strain by each pass"),
    Quantity("passes_dissipation", "1", "plastic work of each pass / that of the first"),
    Quantity("passes_forward", "m", "motion of the surface along the track in each pass"),
    Quantity("passes_groove", "m", "depth of the groove after each pass"),
)
"""Columns with one number for each pass."""

PROFILE = (
    Quantity("passes_profile_depth", "m", "depths of the residual stresses in the middle of the track"),
    Quantity("passes_residual_along", "Pa", "residual stress along the track against depth"),
    Quantity("passes_residual_across", "Pa", "residual stress across the track against depth"),
)
"""Columns of the residual stress below the middle of the track."""


@dataclass(frozen=True)
class Passing:
    """What is asked of the passes, and the friction coefficient of the contact."""

    settings: PassesSettings
    friction: float

    @property
    def coefficient(self) -> float:
        """That of the passes."""
        table = self.settings
        if table.motion == "in place":
            return 0.0
        return self.friction if table.friction is None else float(table.friction)


class Passes(Part):
    """A cylinder or sphere that passes over the body again and again, by finite elements."""

    name = "passes"
    title = "Repeated passes"
    table = "passes"
    settings = PassesSettings

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars, cut, groove, and columns of the passes and of the residual stress."""
        each = tuple(replace(item, dims=("passes_pass",)) for item in EACH)
        profile = tuple(replace(item, dims=("passes_row",)) for item in PROFILE)
        return (*SCALARS, *quantities_of(PREFIX), *each, *profile)

    def asked(self, document: Any, folder: Path) -> Passing:
        """The table [passes] with the friction of the contact."""
        table: PassesSettings = document.passes
        friction = getattr(document, "friction", None)
        slides = friction is not None and friction.law == "coulomb"
        coefficient: Any = getattr(friction, "coefficient", None) if slides else None
        return Passing(table, float(coefficient or 0.0))

    def check(self, ask: Passing, problem: ContactProblem) -> None:
        """Refuse a body that is rigid or whose yield stresses are not known, and loads under which strains are not small, before the contact is solved."""
        from ..plastic_flow.part_values import require_flow
        from .work_passes import require_course

        body = _body(ask, problem)
        require_flow(body, unknown_is_elastic=ask.settings.unknown_is_elastic)
        require_course(_course(ask, problem), body)

    def compute(self, ask: Passing, solved: Solved) -> Found:
        """All passes, and what they leave."""
        from .work_passes import found_of, passed

        body, course = _body(ask, solved.problem), _course(ask, solved.problem)
        with solved.stage("passes") as progress:
            run = passed(body, course, unknown_is_elastic=ask.settings.unknown_is_elastic, progress=progress)
        return found_of(run, body, course)

    def citations(self, ask: Passing, problem: ContactProblem) -> tuple[str, ...]:
        """Papers of the method."""
        return KEYS

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Zones, residual stress, stress under load, groove; residual stress against depth; what each pass adds."""
        from ...plots.picture import figures_by
        from ..plastic_flow.figures import plots_of
        from ..plastic_flow.part_values import picture_of
        from .figures import pass_plots
        from .work_passes import pass_picture

        shown = picture_of(PREFIX, found.values, found.detail.facts)
        passes = pass_picture(found)
        return (*figures_by(plots_of(shown, "passes"), shown), *figures_by(pass_plots(passes), passes))

    def words(self, found: Found, solved: Solved) -> Words:
        """Whether flow ceases, zones by layer, tensions, and what each pass adds."""
        return passes_words(found)

    def stored(self, found: Found) -> Stored:
        """Names of layers, the motion and the table of zones."""
        return Stored(facts=found.detail.facts)

    def restored(self, stored: Stored, solved: Solved) -> Detail:
        """The same again, without the run."""
        return Detail(dict(stored.facts))


KEYS = ("SimoTaylor1985", "Johnson1962", "Hearle1985")


def _body(ask: Passing, problem: ContactProblem) -> Any:
    """The body that is passed over; InputError if it is rigid."""
    from ..plastic_flow.part_values import meshed_body

    return meshed_body(problem, ask.settings.inside, "passes", "--pass-in")


def _course(ask: Passing, problem: ContactProblem) -> Course:
    """What passes, with the radius of the summits where none is given; InputError if there are none."""
    from ..plastic_flow.part_values import summit_radius
    from .work_passes import course_of

    table = ask.settings
    radius = table.radius
    if radius is None:
        radius = summit_radius(problem, "Give passes.radius (--pass-radius 10um).")
    return course_of(table, _body(ask, problem), float(radius), ask.coefficient)


# In words and tables.

REMARK = (
    "The indenter is rigid, the strains are small, layers are bonded, and all that touches slides. A cylinder is in plane strain. Growth, residual stress and groove are "
    "those in the middle of the track. Flow that goes on in closed cycles wears by fatigue, strain that adds up from pass to pass by ratchetting."
)
"""What the model is."""


def passes_words(found: Found) -> Words:
    """Sentence, headline, rows and tables."""
    values, facts = found.values, found.detail.facts
    rows: Rows = [
        ("indenter", str(facts["indenter"])),
        ("motion", str(facts["motion"])),
        ("pressure", str(facts["pressure"])),
        *number_rows(SCALARS, values),
    ]
    tables = (
        ("What each pass adds", _pass_table(values)),
        ("Plastic zones of the passes", zones_table(facts)),
        ("Tension and shear that may crack layers in a pass", tension_table(values, "pass")),
    )
    return Words(_sentence(values, facts), [("repeated passes", verdict(values))], rows, tables, (REMARK,))


def verdict(values: Mapping[str, Any]) -> str:
    """What becomes of the flow, from the growth of the plastic strain in the first and last passes."""
    import numpy as np

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


def _sentence(values: Mapping[str, Any], facts: Mapping[str, Any]) -> str:
    import numpy as np

    growth = np.atleast_1d(values["passes_growth"])
    count, found = growth.size, verdict(values)
    passes = f"{count} pass{'es' * (count > 1)}"
    pressure = show(float(values["pass_hertz_pressure"]), "Pa", 3)
    start = f"After {passes} of a {facts['shape']} at Hertz's pressure of {pressure}"
    if found == "elastic":
        return f"{start} the middle of the track stays elastic."
    strain, last = float(values["pass_plastic_strain"]), float(values["pass_strain_growth"])
    reached = f"the plastic strain reaches {percent(strain)}"
    if found == "one pass":
        return f"{start} {reached}."
    return f"{start} {reached}; the last pass adds {percent(last)} in the middle of the track, {percent(float(values['pass_growth_ratio']))} of the first: {found}."


def _pass_table(values: Mapping[str, Any]) -> Table:
    """One row for each pass, at most the first and the last ten."""
    import numpy as np

    columns = [np.atleast_1d(values[item.name]) for item in EACH]
    count = columns[0].size
    rows = [number for number in range(count) if number < 10 or number >= count - 10]
    cells = []
    for number in rows:
        growth, onward, work, forward, groove = (float(column[number]) for column in columns)
        texts = (percent(growth), percent(onward), percent(work), show(forward, "m", 3), show(groove, "m", 3))
        cells.append((str(number + 1), *texts))
    heads = (
        "Pass",
        "Growth of the strain",
        "Change of the strain",
        "Plastic work / that of the first",
        "Forward",
        "Groove",
    )
    return Table(heads, tuple(cells))
