"""One indenter on a body that flows, by axisymmetric finite elements: curve of load, cuts, imprint
and tensions of layers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ...contact.problem import ContactProblem
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.status import Advice, NoProgress, Progress
from ...core.units import percent, show
from ...fem.history import IndentationStep, SolidFields
from ...fem.indent import Indentation, Load
from ...fem.indenters import Cone, Paraboloid, beyond_small_strain
from ...fem.mesh import Resolution
from ...parts.part import Found, Rows, Solved, Words
from ...plots.picture import Figure, figures_by
from ...solids.elastic import Elastic, Rigid
from ...solids.layers import Layered, materials_of
from ...solids.strength import flow_stress
from ...theories.hardness.unloading import analyse_indentation
from ..plastic_flow.figures import plots_of, step_label
from ..plastic_flow.part_quantities import Detail, OfElements, number_rows, tension_table, zones_table
from ..plastic_flow.work_values import (
    PlasticValues,
    inferred_strengths,
    interfaces_of,
    layer_names,
    meshed_body,
    meshed_laws,
    picture_of,
    require_flow,
    summit_radius,
    zone_table,
)
from .part import PREFIX, SCALARS, IndentationSettings

LEFT = 4.0
"""How far the cut reaches across and into the body, in radii of the indenter at the surface."""


@dataclass(frozen=True)
class Indenter:
    """Rigid body of revolution: a paraboloid of ``radius`` in m, or a cone of ``half_angle`` in
    rad.

    Attributes
    ----------
    radius, half_angle
        One of them; the other NaN.
    """

    radius: float = math.nan
    half_angle: float = math.nan

    @property
    def is_cone(self) -> bool:
        """Whether it is a cone."""
        return math.isnan(self.radius)

    @property
    def meshed(self) -> Cone | Paraboloid:
        """As finite elements take it."""
        return Cone(1.0 / math.tan(self.half_angle)) if self.is_cone else Paraboloid(self.radius)

    def reach(self, depth: float) -> float:
        """Radius (m) where it is ``depth`` above its tip: contacts are smaller, unless the material
        piles up."""
        return depth * math.tan(self.half_angle) if self.is_cone else math.sqrt(2.0 * self.radius * depth)

    def area(self, depth: float) -> float:
        """Area function π reach² in m² of a contact depth in m."""
        return math.pi * self.reach(depth) ** 2

    @property
    def shape(self) -> float:
        """ε of Oliver and Pharr."""
        return 0.72 if self.is_cone else 0.75


@dataclass(frozen=True)
class Course:
    """What the indenter does: ``depth`` in m of the largest approach, numbers of steps in and out,
    elements across the contact radius; what it is made ``of``, and its ``friction``."""

    depth: float
    loading: int = 20
    unloading: int = 12
    across: int = 20
    of: Elastic | Layered | Rigid = Rigid()
    friction: float = 0.0


@dataclass(frozen=True, eq=False)
class Indented:
    """What came out.

    Attributes
    ----------
    shown
        Cut at the peak, residual stress, curve and imprint.
    peak
        Number of the step with the largest approach.
    tensions
        Largest radial stress at the surface and at the bottoms of layers, largest shear and peel of
        interfaces in Pa, under the peak load and after it.
    strains
        (steps, columns, rows) accumulated plastic strain on the cut, for frames.
    touching
        Points in contact at the peak.
    """

    shown: PlasticValues
    peak: int
    tensions: dict[str, float]
    strains: RealArray
    touching: int

    @property
    def labels(self) -> tuple[str, ...]:
        """What each of the ``strains`` shows."""
        curve = self.shown.curve
        steps = zip(curve["approach"], curve["force"], strict=True)
        return tuple(step_label(number, *step) for number, step in enumerate(steps))


def indented(
    body: Elastic | Layered,
    indenter: Indenter,
    course: Course,
    *,
    unknown_is_elastic: bool = False,
    progress: Progress = NoProgress(),
) -> Indented:
    """Press ``indenter`` into ``body`` by ``course.depth``, and take it off.

    Raises
    ------
    InputError
        If an interface slips, or a yield stress is not known.
    ConvergenceError
        If a step is not found.
    """
    # Approaches of a ball grow with the depth, so that first yield is seen; a cone yields at once.
    even = np.linspace(0.0, 1.0, course.loading + 1)[1:]
    depths = [float(depth) for depth in course.depth * (even if indenter.is_cone else even**1.5)]
    resolution = Resolution(across=course.across, per_layer=max(6, course.across // 3))
    laws = meshed_laws(body, unknown_is_elastic=unknown_is_elastic)
    pair: Any = {"counter_body": course.of, "friction": course.friction, "resolution": resolution}
    prepared = Indentation.of(body, indenter.meshed, depths, plasticity=laws, **pair)
    way_in = prepared.run(depths, keep=range(len(depths)))
    progress.update(1, 0.5, 0.1)
    top = way_in.steps[-1].load
    loads = [Load(top * (1.0 - number / course.unloading)) for number in range(1, course.unloading + 1)]
    way_out = prepared.run(loads, start=way_in.state, keep=range(len(loads)))
    progress.update(2, 0.2, 0.1)
    elastic = Indentation.of(body, indenter.meshed, depths, plasticity=None, **pair).run(depths, keep=())
    progress.update(3, 0.05, 0.1)
    fields = [*(way_in.fields[n] for n in range(len(depths))), *(way_out.fields[n] for n in range(len(loads)))]
    steps = [*way_in.steps, *way_out.steps]
    r, z = (np.unique(fields[0].mesh.points[:, axis]) for axis in (0, 1))
    wide, deep = (max(int(np.searchsorted(line, LEFT * indenter.reach(course.depth))), 3) for line in (r, z))
    cut = _Cut(r[:wide], z[:deep], len(r) - 1, interfaces_of(body))
    return cut.found(steps, fields, len(depths), elastic.load, prepared.r)


@dataclass(frozen=True, eq=False)
class _Cut:
    """Lines of the mesh down to where the cut ends."""

    r: RealArray
    z: RealArray
    columns: int
    interfaces: RealArray

    def cells(self, values: RealArray) -> RealArray:
        """Means over elements (columns, rows) of ``values`` (elements, points)."""
        found: RealArray = values.mean(axis=1).reshape(self.columns, -1)[: len(self.r) - 1, : len(self.z) - 1]
        return found

    def found(
        self, steps: list[IndentationStep], fields: list[SolidFields], peak: int, elastic: RealArray, nodes: RealArray
    ) -> Indented:
        """Everything, from the ``steps`` and their fields; ``peak`` steps lead to the largest
        load."""
        known = np.full(len(steps) + 1, math.nan)
        known[: peak + 1] = [0.0, *elastic]
        curve = {
            "approach": np.array([0.0, *(step.approach for step in steps)]),
            "force": np.array([0.0, *(step.load for step in steps)]),
            "elastic_force": known,
            "area": np.array([0.0, *(math.pi * step.contact_radius**2 for step in steps)]),
            "work_lost": np.array([0.0, *(step.plastic_work for step in steps)]),
        }
        strains = [self.cells(field.accumulated) for field in fields]
        loaded, last = fields[peak - 1], fields[-1]
        shown = PlasticValues(
            self.r,
            self.z,
            strains[peak - 1],
            self.interfaces,
            self.cells(last.stress[..., 0]),
            self.cells(loaded.von_mises),
            curve,
            nodes,
            -steps[-1].surface,
        )
        tensions = self._tensions(loaded, "") | self._tensions(last, "residual_")
        whole = np.stack([np.zeros_like(strains[0]), *strains])
        return Indented(shown, peak, tensions, whole, int(steps[peak - 1].touching.sum()))

    def _tensions(self, field: SolidFields, prefix: str) -> dict[str, float]:
        """Largest tension at the surface and at the bottom of layers, shear and peel beside
        interfaces, in Pa."""
        radial, shear, normal = (self.cells(field.stress[..., k]) for k in (0, 4, 2))
        inside = [depth for depth in self.interfaces if depth <= self.z[-1] * (1.0 + 1e-9)]
        rows = [int(np.argmin(np.abs(self.z - depth))) for depth in inside]
        found = {f"{prefix}surface_tension": float(radial[:, 0].max())}
        if rows:
            found |= {
                f"{prefix}layer_tension": float(max(radial[:, row - 1].max() for row in rows)),
                f"{prefix}interface_shear": float(max(np.abs(shear[:, row - 1 : row + 1]).max() for row in rows)),
                f"{prefix}interface_peel": float(max(normal[:, row - 1 : row + 1].max() for row in rows)),
            }
        return {name: max(value, 0.0) for name, value in found.items()}


# Values, facts and findings.


def found_of(run: Indented, body: Any, indenter: Indenter, course: Course) -> Found:
    """Values, facts and findings of a ``run``."""
    curve, peak, shown = run.shown.curve, run.peak, run.shown
    area, force = float(curve["area"][peak]), float(curve["force"][peak])
    known = [flow_stress(material.strength).value for material in materials_of(body)]
    lowest = min((value for value in known if not math.isnan(value)), default=math.nan)
    rows = np.flatnonzero((shown.strain > 0.0).any(axis=0))
    values: dict[str, Any] = {item.name: math.nan for item in SCALARS} | {
        "indent_force": force,
        "indent_depth": float(curve["approach"][peak]),
        "indent_radius": indenter.radius,
        "indent_contact_radius": math.sqrt(area / math.pi),
        "indent_hardness": force / area,
        "indent_hardness_ratio": force / area / lowest,
        "indent_residual_depth": float(curve["approach"][-1]),
        "indent_plastic_strain": float(shown.strain.max()),
        "indent_plastic_depth": float(shown.depth[rows[-1] + 1]) if rows.size else 0.0,
        **{f"indent_{name}": value for name, value in run.tensions.items()},
    }
    facts: dict[str, Any] = {"layers": layer_names(body), "axis": "r", "oliver_pharr": None, "cone": indenter.is_cone}
    facts |= {"of_indenter": " on ".join(layer_names(course.of)), "friction": course.friction}
    zones = zone_table(shown, body)
    facts["zones"] = [list(zones.headings), [list(row) for row in zones.cells]]
    findings = list(inferred_strengths(body))
    radius = math.sqrt(float(run.shown.curve["area"][run.peak]) / math.pi)
    findings += beyond_small_strain(radius, math.inf if indenter.is_cone else indenter.radius)
    if run.touching < FEW:
        fact = f"Only {run.touching} points of the mesh touch. Load and area err by several per cent below {FEW}."
        remedy = "Take more elements ({indentation.elements})."
        numbers, concerns = {"points": float(run.touching), "least": float(FEW)}, ("indent_",)
        findings.append(Advice("warning", "mesh of the indentation", fact, remedy, numbers, concerns))
    if not run.shown.strain.max() > 0.0:
        findings.append(Advice("note", "indentation", "Nothing flows at this depth: the indentation is elastic."))
    try:
        read = analyse_indentation(
            curve["approach"], curve["force"], indenter.area, shape=indenter.shape, true_area=area
        )
    except InputError as error:
        findings.append(Advice("note", "unloading", f"The unloading cannot be analysed: {error}"))
    else:
        fit = read.unloading
        values |= {
            "indent_oliver_pharr_hardness": read.hardness,
            "indent_oliver_pharr_modulus": read.contact_modulus,
            "indent_unloading_stiffness": fit.stiffness,
            "indent_unloading_exponent": fit.exponent,
            "indent_pile_up": read.pile_up,
            "indent_work": read.loading_work,
            "indent_dissipated_work": read.dissipated_work,
        }
        drawn = np.linspace(max(fit.final_depth, 0.0), fit.peak_depth, 25)
        facts |= {"oliver_pharr": read.hardness, "unloading": [drawn.tolist(), fit.force(drawn).tolist()]}
    return Found({**values, **shown.values(PREFIX)}, Detail(facts, run), tuple(findings), IndentationWork.citation_keys)


FEW = 8
"""Points in contact below which load and area of a mesh err by several per cent."""


BERKOVICH_ANGLE = math.radians(70.3)
"""Half angle of the cone with the area of Berkovich's pyramid."""


class IndentationWork(OfElements):
    """An indenter in the body, by finite elements: what is done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = ("SimoTaylor1985", "Oliver1992")

    def check(self, ask: IndentationSettings, problem: ContactProblem) -> None:
        """Refuse a body that is rigid or whose yield stresses are not known, before the contact is
        solved."""
        body = meshed_body(problem, ask.inside, "indentation")
        require_flow(body, unknown_is_elastic=ask.unknown_is_elastic)
        _indenter(ask, problem)
        _of_indenter(ask, problem)

    def compute(self, ask: IndentationSettings, solved: Solved) -> Found:
        """Way in and out, hardness and zones."""
        body = meshed_body(solved.problem, ask.inside, "indentation")
        indenter = _indenter(ask, solved.problem)
        pair = (_of_indenter(ask, solved.problem), float(ask.friction))
        course = Course(float(ask.depth or 0.0), ask.steps, ask.unloading_steps, ask.elements, *pair)
        with solved.stage("indentation") as progress:
            run = indented(body, indenter, course, unknown_is_elastic=ask.unknown_is_elastic, progress=progress)
        return found_of(run, body, indenter, course)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Zones, residual stress, stress under load, curve, imprint, hardness."""
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
        force, depth = show(float(values["indent_force"]), "N", 3), show(float(values["indent_depth"]), "m", 3)
        sentence = f"The indenter takes {force} at a depth of {depth}, and the body stays elastic."
        if float(values["indent_plastic_strain"]) > 0.0:
            read = float(values["indent_oliver_pharr_hardness"])
            beside = "" if math.isnan(read) else f" (Oliver and Pharr's method reads {show(read, 'Pa', 3)})"
            sentence = (
                f"The indenter takes {force} at a depth of {depth}: a hardness of {hard}{beside}; the plastic "
                f"strain reaches {percent(float(values['indent_plastic_strain']))}, and "
                f"{show(float(values['indent_residual_depth']), 'm', 3)} of the depth stay."
            )
        return Words(sentence, [("hardness by indentation", hard)], rows, tables, (REMARK,))


def _of_indenter(ask: IndentationSettings, problem: ContactProblem) -> Any:
    """What the indenter is made of: rigid, or as the other body.

    Raises
    ------
    InputError
        If it is to be elastic and the other body is rigid.
    """
    if not ask.elastic_indenter:
        return Rigid()
    other = "counter_body" if ask.inside == "body" else "body"
    found = getattr(problem, other)
    if not materials_of(found):
        raise InputError(
            f"{other} must be elastic for an elastic indenter, but is rigid. Give its material, or leave "
            f"{{indentation.elastic_indenter}} out.",
            subject=other,
        )
    return found


def _indenter(ask: IndentationSettings, problem: ContactProblem) -> Indenter:
    """Shape that is asked for; a sphere as round as the summits are on average where its radius is
    not given.

    Raises
    ------
    InputError
        If the surface has no summits, or the strains are not small: the contact radius is beyond
        0.4 of that of a ball.
    """
    if ask.indenter == "cone":
        return Indenter(half_angle=float(ask.half_angle or BERKOVICH_ANGLE))
    if ask.radius is not None:
        found = Indenter(float(ask.radius))
    else:
        found = Indenter(summit_radius(problem, "Give {indentation.radius=10 um}."))
    depth = float(ask.depth or 0.0)
    if found.reach(depth) > 0.4 * found.radius:
        raise InputError(
            f"depth of indentation (m) must be at most {0.08 * found.radius:.3g}, 0.08 of the radius of the "
            f"indenter, but is {depth:.3g}. Beyond that strains are not small.",
            subject="depth of indentation (m)",
        )
    return found


# In words and tables.

REMARK = (
    "The indenter is of revolution and does not flow, the strains are small, and layers are bonded. Oliver "
    "and Pharr's hardness is what an instrument would read from the unloading; the other divides the force by "
    "the true area. Tensions are means over an element at the place of the maximum."
)
"""What the model is."""
