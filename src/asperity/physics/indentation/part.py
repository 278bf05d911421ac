"""Indentation: one indenter pressed into the body and taken off, by finite elements; hardness, zones, residual stress, Oliver and Pharr's numbers."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.units import percent, show
from ...core.values import Choice, Length, NonNegative, Number, Whole
from ...parts.part import Found, Part, Rows, Solved, Stored, Words
from ..plastic_flow.part_quantities import Detail, number_rows, quantities_of, tension_table, zones_table

if TYPE_CHECKING:
    from ...contact.problem import ContactProblem
    from ...plots.picture import Figure
    from .work import Indenter

Shape = Annotated[str, Choice({name: name for name in ("sphere", "cone")})]
HalfAngle = Annotated[float, Number("angle", above=0.0, below=0.5 * math.pi)]
Inside = Annotated[str, Choice({name: name for name in ("body", "counter_body")})]

SMALL_STRAIN = 0.15
"""Contact over indenter radius up to which small strains hold within a few per cent."""

FEW = 8
"""Points in contact below which load and area of a mesh err by several per cent."""

PREFIX = "indentation"


class IndentationSettings(Settings):
    """An indenter that goes into the body by ``depth`` and comes off again, beside the contact of the surfaces.

    ``radius`` is that of a sphere, taken as a paraboloid, by default the mean radius of the summits of the surface; ``half_angle`` that of a cone,
    by default the one of Berkovich's area, 70.3 degrees. It is rigid, or with ``elastic_indenter`` of the material of the other body, which stays elastic.
    Layers and base flow at their yield stress with their hardening. The body is axisymmetric, and strains are small.
    """

    depth: Length | None = setting(None, option="--indent", help="Depth of an indentation by finite elements: 100nm")
    indenter: Shape = setting("sphere", option="--indenter", help="Sphere or cone")
    radius: Length | None = setting(
        None, option="--indenter-radius", help="Of a sphere: 10um; by default the mean radius of the summits"
    )
    half_angle: HalfAngle | None = setting(None, option="--indenter-angle", help="Of a cone, from its axis: 70.3deg")
    steps: Annotated[int, Whole(4, 500)] = setting(20, option="--indent-steps", help="Steps of the way in")
    unloading_steps: Annotated[int, Whole(6, 500)] = setting(
        12, option="--indent-unloading-steps", help="Steps of the way out"
    )
    elements: Annotated[int, Whole(4, 100)] = setting(
        20, option="--indent-elements", help="Elements across the largest contact radius"
    )
    friction: NonNegative = setting(0.0, option="--indent-friction", help="Coefficient under the indenter")
    elastic_indenter: bool = setting(
        False, option="--elastic-indenter", help="The indenter is of the material of the other body, and elastic"
    )
    inside: Inside = setting("body", option="--indent-in", help="body or counter_body")
    unknown_is_elastic: bool = setting(
        False,
        option="--unknown-elastic",
        help="Materials of unknown yield stress stay elastic, instead of being refused",
    )

    @model_validator(mode="after")
    def _whole(self) -> IndentationSettings:
        if self.depth is None:
            raise InputError(
                ' must give the depth of the indentation, such as depth = "100 nm" (--indent), but does not.'
            )
        other = {"sphere": "half_angle", "cone": "radius"}[self.indenter]
        if getattr(self, other) is not None:
            raise InputError(f" must give no {other} for a {self.indenter}, but does.")
        return self


BERKOVICH_ANGLE = math.radians(70.3)
"""Half angle of the cone with the area of Berkovich's pyramid."""

SCALARS = (
    Quantity("indent_force", "N", "largest force of the indentation"),
    Quantity("indent_depth", "m", "largest approach of the indentation"),
    Quantity("indent_radius", "m", "radius of the indenter"),
    Quantity("indent_contact_radius", "m", "contact radius at the largest force"),
    Quantity("indent_hardness", "Pa", "force / true area, indentation"),
    Quantity("indent_hardness_ratio", "1", "that hardness / lowest yield stress of the body"),
    Quantity("indent_oliver_pharr_hardness", "Pa", "hardness by Oliver and Pharr"),
    Quantity("indent_oliver_pharr_modulus", "Pa", "reduced modulus by Oliver and Pharr"),
    Quantity("indent_unloading_stiffness", "N/m", "stiffness at the start of the unloading"),
    Quantity("indent_unloading_exponent", "1", "exponent of the fitted unloading"),
    Quantity("indent_pile_up", "1", "true area / area of Oliver and Pharr"),
    Quantity("indent_residual_depth", "m", "depth at which the unloading ends"),
    Quantity("indent_work", "J", "work of the loading"),
    Quantity("indent_dissipated_work", "J", "work that the indentation keeps"),
    Quantity("indent_plastic_strain", "1", "largest accumulated plastic strain"),
    Quantity("indent_plastic_depth", "m", "depth of the plastic zone"),
    Quantity("indent_surface_tension", "Pa", "largest radial tension at the surface under load"),
    Quantity("indent_layer_tension", "Pa", "largest radial tension at the bottom of a layer under load"),
    Quantity("indent_interface_shear", "Pa", "largest shear of an interface under load"),
    Quantity("indent_interface_peel", "Pa", "largest peel stress of an interface under load"),
    Quantity("indent_residual_surface_tension", "Pa", "largest residual radial tension at the surface"),
    Quantity("indent_residual_layer_tension", "Pa", "largest residual radial tension at the bottom of a layer"),
    Quantity("indent_residual_interface_shear", "Pa", "largest residual shear of an interface"),
    Quantity("indent_residual_interface_peel", "Pa", "largest residual peel stress of an interface"),
)
"""Numbers of an indentation; NaN where there is no layer, or an unloading cannot be fitted."""


class Indentation(Part):
    """An indenter in the body, by finite elements."""

    name = "indentation"
    title = "Indentation"
    table = "indentation"
    settings = IndentationSettings

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars, cut, curve and imprint."""
        return (*SCALARS, *quantities_of(PREFIX))

    def check(self, ask: IndentationSettings, problem: ContactProblem) -> None:
        """Refuse a body that is rigid or whose yield stresses are not known, before the contact is solved."""
        from ..plastic_flow.part_values import require_flow

        require_flow(_body(ask, problem), unknown_is_elastic=ask.unknown_is_elastic)
        _indenter(ask, problem)
        _of_indenter(ask, problem)

    def compute(self, ask: IndentationSettings, solved: Solved) -> Found:
        """Way in and out, hardness and zones."""
        from .work import Course, found_of, indented

        body, indenter = _body(ask, solved.problem), _indenter(ask, solved.problem)
        pair = (_of_indenter(ask, solved.problem), float(ask.friction))
        course = Course(float(ask.depth or 0.0), ask.steps, ask.unloading_steps, ask.elements, *pair)
        with solved.stage("indentation") as progress:
            run = indented(body, indenter, course, unknown_is_elastic=ask.unknown_is_elastic, progress=progress)
        return found_of(run, body, indenter, course)

    def citations(self, ask: IndentationSettings, problem: ContactProblem) -> tuple[str, ...]:
        """Papers of the method."""
        return KEYS

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Zones, residual stress, stress under load, curve, imprint, hardness."""
        from ...plots.picture import figures_by
        from ..plastic_flow.figures import plots_of
        from ..plastic_flow.part_values import picture_of

        shown = picture_of(PREFIX, found.values, found.detail.facts)
        return figures_by(plots_of(shown, "indentation"), shown)

    def words(self, found: Found, solved: Solved) -> Words:
        """Hardness by both ways, what stays, zones by layer, tensions."""
        values, facts = found.values, found.detail.facts
        paraboloid = f"paraboloid of radius {show(float(values['indent_radius']), 'm', 3)}"
        rows: Rows = [
            ("indenter", "cone" if facts["cone"] else paraboloid),
            ("material of the indenter", str(facts.get("of_indenter", "rigid"))),
            ("friction coefficient of the indentation", f"{float(facts.get('friction', 0.0)):g}"),
            *number_rows(SCALARS, values),
        ]
        tables = (
            ("Plastic zones", zones_table(facts)),
            ("Tension and shear that may crack layers", tension_table(values, "indent")),
        )
        hard = show(float(values["indent_hardness"]), "Pa", 3)
        return Words(_sentence(values), [("hardness by indentation", hard)], rows, tables, (REMARK,))

    def stored(self, found: Found) -> Stored:
        """Names of layers, the fitted unloading and the table of zones."""
        return Stored(facts=found.detail.facts)

    def restored(self, stored: Stored, solved: Solved) -> Detail:
        """The same again, without the run."""
        return Detail(dict(stored.facts))


KEYS = ("SimoTaylor1985", "Oliver1992")


def _body(ask: IndentationSettings, problem: ContactProblem) -> Any:
    """The body that is indented; InputError if it is rigid."""
    from ..plastic_flow.part_values import meshed_body

    return meshed_body(problem, ask.inside, "indentation", "--indent-in")


def _of_indenter(ask: IndentationSettings, problem: ContactProblem) -> Any:
    """What the indenter is made of: rigid, or as the other body.

    Raises
    ------
    InputError
        If it is to be elastic and the other body is rigid.
    """
    from ...solids.elastic import Rigid
    from ...solids.layers import materials_of

    if not ask.elastic_indenter:
        return Rigid()
    other = "counter_body" if ask.inside == "body" else "body"
    found = getattr(problem, other)
    if not materials_of(found):
        raise InputError(
            f"{other} must be elastic for an elastic indenter, but is rigid. Give its material, or leave indentation.elastic_indenter (--elastic-indenter) out.",
            subject=other,
        )
    return found


def _indenter(ask: IndentationSettings, problem: ContactProblem) -> Indenter:
    """Shape that is asked for; a sphere as round as the summits are on average where its radius is not given.

    Raises
    ------
    InputError
        If the surface has no summits, or the strains are not small: the contact radius is beyond 0.4 of that of a ball.
    """
    from ..plastic_flow.part_values import summit_radius
    from .work import Indenter

    if ask.indenter == "cone":
        return Indenter(half_angle=float(ask.half_angle or BERKOVICH_ANGLE))
    if ask.radius is not None:
        found = Indenter(float(ask.radius))
    else:
        found = Indenter(summit_radius(problem, "Give indentation.radius (--indenter-radius 10um)."))
    depth = float(ask.depth or 0.0)
    if found.reach(depth) > 0.4 * found.radius:
        raise InputError(
            f"depth of indentation (m) must be at most {0.08 * found.radius:.3g}, 0.08 of the radius of the indenter, but is {depth:.3g}. "
            "Beyond that strains are not small.",
            subject="depth of indentation (m)",
        )
    return found


# In words and tables.

REMARK = (
    "The indenter is of revolution and does not flow, the strains are small, and layers are bonded. Oliver and Pharr's hardness is what an instrument would "
    "read from the unloading; the other divides the force by the true area. Tensions are means over an element at the place of the maximum."
)
"""What the model is."""


def _sentence(values: Mapping[str, Any]) -> str:
    force, depth = show(float(values["indent_force"]), "N", 3), show(float(values["indent_depth"]), "m", 3)
    if not float(values["indent_plastic_strain"]) > 0.0:
        return f"The indenter takes {force} at a depth of {depth}, and the body stays elastic."
    read, true = float(values["indent_oliver_pharr_hardness"]), float(values["indent_hardness"])
    beside = "" if math.isnan(read) else f" (Oliver and Pharr's method reads {show(read, 'Pa', 3)})"
    return (
        f"The indenter takes {force} at a depth of {depth}: a hardness of {show(true, 'Pa', 3)}{beside}; the plastic strain reaches "
        f"{percent(float(values['indent_plastic_strain']))}, and {show(float(values['indent_residual_depth']), 'm', 3)} of the depth stay."
    )
