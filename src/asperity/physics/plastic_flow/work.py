"""Plastic flow in the volume of a solved contact: numbers, cut through the largest strain, tensions, curve of the history."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ...contact.controls import Approach, Control, Force, MeanPressure, Step
from ...contact.history import HistoryResult, ramps
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import Keep, solve
from ...core.arrays import RealArray
from ...core.errors import AsperityError
from ...core.status import Advice
from ...core.units import percent, show
from ...parts.part import Found, Solved, Stored, Words, Work
from ...plots.picture import Figure, figures_by
from ...solids.elastic import Elastic
from ...solids.layers import Body, Layered
from ...solids.plasticity import J2, von_mises
from ...solids.strength import plastic_parts
from ..friction.law import Coulomb
from .answer import PlasticBody
from .figures import IMPRINT_MAP, ImprintMap, plots_of
from .law import PlasticFlow as Law
from .law import plastic_body
from .part import IMPRINT, PREFIX, SCALARS, Flows, PlasticFlowSettings
from .part_quantities import number_rows, tension_table, zones_table
from .work_values import PlasticValues, inferred_strengths, interfaces_of, layer_names, picture_of, require_flow


def flow_found(solved: Solved) -> Found:
    """Values, facts and findings of the ``solved`` contact."""
    flow, body = solved.result.require_plastic_flow(), _body(solved.problem)
    with solved.stage("residual stress"):
        shown, tensions = _shown(flow, solved)
    values = {**_numbers(flow, solved), **tensions, IMPRINT.name: flow.displacement, **shown.values(PREFIX)}
    facts = {"layers": layer_names(body), "axis": "x", "zones": _zone_rows(flow, body), "row": _row(flow)}
    return Found(values, facts, _findings(flow, body), flow.citation_keys)


def flow_law(table: PlasticFlowSettings, problem: ContactProblem) -> Law:
    """Law of the deformable body of ``problem``: one entry for each of its layers and the base.

    Raises
    ------
    InputError
        If a yield stress is not known.
    """
    body, _ = plastic_body(problem.body, problem.counter_body)
    materials = [layer.material for layer in body.layers] if isinstance(body, Layered) else []
    base = body.base if isinstance(body, Layered) else body
    laws: list[J2 | None] = []
    for material in [*materials, base]:
        parts = (
            plastic_parts(material, unknown_is_elastic=table.unknown_is_elastic)
            if isinstance(material, Elastic)
            else ()
        )
        laws.append(parts[0] if parts and isinstance(parts[0], J2) else None)
    depth = None if table.depth is None else float(table.depth)
    whole: Any = laws if isinstance(body, Layered) else laws[0]
    return Law(whole, table.cells, depth, float(table.tolerance))


def _body(problem: ContactProblem) -> Body:
    return plastic_body(problem.body, problem.counter_body)[0]


# Numbers.


def _numbers(flow: PlasticBody, solved: Solved) -> dict[str, Any]:
    """``SCALARS`` but for the tensions."""
    layers, base = flow.zones[:-1], flow.zones[-1]
    first = [zone.first_yield for zone in flow.zones if math.isfinite(zone.first_yield)]
    tops = [zone.top for zone in flow.zones if math.isfinite(zone.top)]
    bottoms = [zone.bottom for zone in flow.zones if math.isfinite(zone.bottom)]
    result = _peak(solved)
    area = float(result.contact.sum()) * result.problem.grid.pixel_area
    return {
        **{item.name: math.nan for item in SCALARS},
        "flow_plastic_work": flow.work,
        "flow_residual_energy": flow.residual_energy,
        "flow_volume": sum(zone.volume for zone in flow.zones),
        "flow_layer_volume": sum(zone.volume for zone in layers) if layers else math.nan,
        "flow_largest_strain": max(zone.largest_strain for zone in flow.zones),
        "flow_layer_strain": max((zone.largest_strain for zone in layers), default=math.nan),
        "flow_base_strain": base.largest_strain,
        "flow_top": min(tops, default=math.nan),
        "flow_depth": max(bottoms, default=math.nan),
        "flow_first_yield": min(first, default=math.nan),
        "flow_imprint_depth": max(float(flow.displacement.max()), 0.0),
        "flow_pile_up": max(-float(flow.displacement.min()), 0.0),
        "flow_mean_contact_pressure": result.force / area if area > 0.0 else math.nan,
    }


def _row(flow: PlasticBody) -> int:
    """Row of the grid through the largest plastic strain; where nothing flows the one through the middle."""
    grid = flow.problem.grid
    zone = max(flow.zones, key=lambda item: item.largest_strain)
    place = zone.place[1]
    return grid.shape[1] // 2 if math.isnan(place) else min(int(place / grid.spacing[1]), grid.shape[1] - 1)


def _shown(flow: PlasticBody, solved: Solved) -> tuple[PlasticValues, dict[str, float]]:
    """Cut along x through the largest plastic strain with residual stress and stress under load, and the largest tensions."""
    grid, row = flow.problem.grid, _row(flow)
    across = np.arange(grid.shape[0] + 1) * grid.spacing[0]
    place = 0.5 * (across[1:] + across[:-1])
    imprint = -flow.displacement[:, row]
    curve = _curve(solved)
    interfaces = interfaces_of(_body(solved.problem))
    if not flow.depths.size:
        depth = np.array([0.0, float(max(grid.size)) / 8.0])
        empty = np.zeros((grid.shape[0], 1))
        shown = PlasticValues(across, depth, empty, interfaces, curve=curve, place=place, imprint=imprint)
        return shown, {}
    residual, peak = flow.stress(threads=solved.threads), _peak(solved)
    under = peak.require_plastic_flow()
    loaded = under.stress(*_tractions(peak), threads=solved.threads)
    tensions = _tensions(under, _tractions(peak), "", solved) | _tensions(flow, (None, None), "residual_", solved)
    shown = PlasticValues(
        across,
        flow.flowed.edges,
        flow.accumulated[:, :, row].T,
        interfaces,
        residual[:, 0, :, row].T,
        von_mises(np.moveaxis(loaded[..., row], 1, -1)).T if loaded.shape[0] == residual.shape[0] else np.zeros((0, 0)),
        curve,
        place,
        imprint,
    )
    return shown, tensions


def _peak(solved: Solved) -> ContactResult:
    """Step of the history with the largest force."""
    steps = [solved.result] if solved.path is None else solved.path.steps
    return max(steps, key=lambda step: step.force)


def _tractions(result: ContactResult) -> tuple[RealArray, RealArray | None]:
    """Pressure and shear on the body that flows."""
    friction = result.problem.friction
    if not isinstance(friction, Coulomb) or not np.any(friction.coefficient):
        return result.pressure, None
    sign = plastic_body(result.problem.body, result.problem.counter_body)[1]
    shear = friction.coefficient * result.pressure
    return result.pressure, sign * np.stack(
        [math.cos(friction.direction) * shear, math.sin(friction.direction) * shear]
    )


def _tensions(
    flow: PlasticBody, tractions: tuple[RealArray | None, RealArray | None], prefix: str, solved: Solved
) -> dict[str, float]:
    """Largest tension along the surface and at the bottoms of layers, shear and peel of interfaces under these tractions, in Pa."""
    layers = flow.layers(*tractions, threads=solved.threads)
    surface = layers[0].top_tension if layers else flow.surface_tension(*tractions, threads=solved.threads)
    found = {"surface_tension": surface}
    if layers:
        found |= {
            "layer_tension": max(layer.bottom_tension for layer in layers),
            "interface_shear": max(layer.largest_shear for layer in layers),
            "interface_peel": max(layer.peel for layer in layers),
        }
    return {f"flow_{prefix}{name}": max(value, 0.0) for name, value in found.items()}


def _curve(solved: Solved) -> dict[str, RealArray]:
    """Columns of the history from rest, with the elastic contact beside it where pictures are drawn."""
    path: HistoryResult | None = solved.path
    if path is None or len(path.steps) < 2:
        return {}
    pixel = solved.problem.grid.pixel_area
    columns = {
        "approach": [step.approach for step in path.steps],
        "force": [step.force for step in path.steps],
        "area": [float(step.contact.sum()) * pixel for step in path.steps],
        "work_lost": [step.require_plastic_flow().work for step in path.steps],
        "elastic_force": _elastic_forces(solved, path),
    }
    return {name: np.array([0.0, *values]) for name, values in columns.items() if values}


def _elastic_forces(solved: Solved, path: HistoryResult) -> list[float]:
    """Forces of the elastic contact at the approaches up to the peak; NaN beyond, and nothing where no pictures are drawn."""
    if not solved.lines:
        return []
    elastic, found = solved.problem.with_physics(plastic_flow=None), []
    peak = int(np.argmax([step.force for step in path.steps]))
    for step in path.steps[: peak + 1]:
        try:
            result = solve(elastic, Approach(step.approach), keep=Keep(stiffness=False), on_failure="return")
            found.append(result.force)
        except AsperityError:
            found.append(math.nan)
    return found + [math.nan] * (len(path.steps) - peak - 1)


def _zone_rows(flow: PlasticBody, body: Body) -> list[Any]:
    """Headings and cells of the table of zones."""
    headings = ("Layer", "Largest plastic strain", "at (x, y, depth)", "Depths", "Volume", "First yield at")
    cells = []
    for name, zone in zip(layer_names(body), flow.zones, strict=False):
        if not zone.largest_strain > 0.0:
            cells.append([name, "elastic", "–", "–", "–", "–"])
            continue
        place = ", ".join(show(value, "m", 3) for value in zone.place)
        first = show(zone.first_yield, "Pa", 3) if math.isfinite(zone.first_yield) else "–"
        span = f"{show(zone.top, 'm', 3)} to {show(zone.bottom, 'm', 3)}"
        size = f"{zone.volume * 1e18:.3g} µm³"
        cells.append([name, percent(zone.largest_strain), place, span, size, first])
    return [list(headings), cells]


def _findings(flow: PlasticBody, body: Body) -> tuple[Advice, ...]:
    """Yield stresses from the hardness, no flow at all; the rest is found in the review of the contact."""
    made = list(inferred_strengths(body))
    largest = max(zone.largest_strain for zone in flow.zones)
    if not largest > 0.0:
        made.append(Advice("note", "plastic flow", "Nothing flows under this load: the contact is elastic."))
    return tuple(made)


class PlasticFlowWork(Work):
    """Plastic flow of the body below the contact: what is done for it."""

    def check(self, ask: Flows, problem: ContactProblem) -> None:
        """Refuse bodies that cannot flow, before the contact is solved."""
        body, _ = plastic_body(problem.body, problem.counter_body)
        require_flow(body, unknown_is_elastic=ask.settings.unknown_is_elastic)

    def altered(self, ask: Flows, problem: ContactProblem) -> ContactProblem:
        """``problem`` with the laws of its bodies, by which the flow joins the solve."""
        return problem.with_physics(plastic_flow=flow_law(ask.settings, problem))

    def course(self, ask: Flows, controls: tuple[Step | Control, ...]) -> tuple[Step | Control, ...]:
        """A single load in steps, and the way back."""
        table = ask.settings
        (control,) = controls if len(controls) == 1 else (None,)
        kind = type(control)
        if not isinstance(control, Approach | Force | MeanPressure):
            return controls
        value = float(control.value)
        if table.steps == 1 and not table.unload:
            return controls
        points = [value, 0.0] if table.unload else [value]
        return tuple(ramps(kind, points, steps=table.steps))  # type: ignore[arg-type]

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Zones, residual stress, imprint and tensions."""
        return flow_found(solved)

    def citations(self, ask: Any, problem: ContactProblem) -> tuple[str, ...]:
        """Papers of the method."""
        return (*PlasticBody.citation_keys, "SimoTaylor1985")

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Map of the imprint; on the cut through the largest strain zones, residual stress, stress under load; curve."""
        shown = picture_of(PREFIX, found.values, found.detail)
        surface = ImprintMap(solved.problem, np.asarray(found.values[IMPRINT.name]))
        return (*figures_by(plots_of(shown, "flow"), shown), *figures_by((IMPRINT_MAP,), surface))

    def words(self, found: Found, solved: Solved) -> Words:
        """What flows, what stays, zones by layer, tensions."""
        return flow_words(found)

    def stored(self, found: Found) -> Stored:
        """Names of layers and table of zones."""
        return Stored(facts=found.detail)

    def restored(self, stored: Stored, solved: Solved) -> Any:
        """The same again."""
        return dict(stored.facts)


# In words and tables.

REMARK = (
    "Plastic strain is found in the volume with small strains, on the flat surface of the undeformed body. The residual stress is that of the plastic strain without load; flow in reverse during the "
    "unloading is in it only where the unloading was computed (--plastic-unload). Stresses of the table [stress] hold the plastic strain. Tensions are means over depth cells."
)
"""What the model is."""


def flow_words(found: Found) -> Words:
    """Sentence, headline, rows and tables."""
    values, facts = found.values, found.detail
    tables = (
        ("Plastic zones", zones_table(facts)),
        ("Tension and shear that may crack layers", tension_table(values, "flow")),
    )
    headline = [("largest plastic strain", percent(float(values["flow_largest_strain"])))]
    return Words(_sentence(values), headline, number_rows(SCALARS, values), tables, (REMARK,))


def _sentence(values: Mapping[str, Any]) -> str:
    largest = float(values["flow_largest_strain"])
    if not largest > 0.0:
        return "Nothing flows beneath the contact: it is elastic."
    depth, dent = (show(float(values[name]), "m", 3) for name in ("flow_depth", "flow_imprint_depth"))
    work = show(float(values["flow_plastic_work"]), "J", 3)
    return f"The body flows down to {depth} with plastic strains of up to {percent(largest)}; an imprint of {dent} stays, and plastic flow took {work}."
