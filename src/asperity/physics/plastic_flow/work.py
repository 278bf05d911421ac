"""Plastic flow in the volume of a solved contact: numbers, cut through the largest strain,
tensions, curve of the history."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import Any, ClassVar

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
from ...parts.part import Found, Solved, WithFacts, Words
from ...plots.picture import Figure, figures_by
from ...solids.elastic import Elastic
from ...solids.layers import Layered
from ...solids.plasticity import J2, von_mises
from ...solids.strength import plastic_parts
from .answer import PlasticBody
from .figures import IMPRINT_MAP, ImprintMap, plots_of
from .law import PlasticFlow as Law
from .law import plastic_body
from .part import IMPRINT, PREFIX, SCALARS, Flows
from .part_quantities import number_rows, tension_table, zones_table
from .work_values import PlasticValues, inferred_strengths, interfaces_of, layer_names, picture_of, require_flow


def _row(flow: PlasticBody) -> int:
    """Row of the grid through the largest plastic strain; where nothing flows the one through the
    middle."""
    grid = flow.problem.grid
    zone = max(flow.zones, key=lambda item: item.largest_strain)
    place = zone.place[1]
    return grid.shape[1] // 2 if math.isnan(place) else min(int(place / grid.spacing[1]), grid.shape[1] - 1)


def _shown(flow: PlasticBody, solved: Solved) -> tuple[PlasticValues, dict[str, float]]:
    """Cut along x through the largest plastic strain with residual stress and stress under load,
    and the largest tensions."""
    grid, row = flow.problem.grid, _row(flow)
    across = np.arange(grid.shape[0] + 1) * grid.spacing[0]
    place = 0.5 * (across[1:] + across[:-1])
    imprint = -flow.displacement[:, row]
    curve = _curve(solved)
    interfaces = interfaces_of(flow.body)
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
    shear = result.problem.shear(result.pressure)
    sign = plastic_body(result.problem.body, result.problem.counter_body)[1]
    return result.pressure, None if shear is None else sign * shear


def _tensions(
    flow: PlasticBody, tractions: tuple[RealArray | None, RealArray | None], prefix: str, solved: Solved
) -> dict[str, float]:
    """Largest tension along the surface and at the bottoms of layers, shear and peel of interfaces
    under these tractions, in Pa."""
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
    """Columns of the history from rest, with the elastic contact beside it where pictures are
    drawn."""
    path: HistoryResult | None = solved.path
    if path is None or len(path.steps) < 2:
        return {}
    pixel = solved.problem.grid.pixel_area
    elastic_force: list[float] = []
    if solved.lines:  # of the elastic contact at the approaches up to the peak; NaN beyond
        elastic, peak = solved.problem.with_physics(plastic_flow=None), _peak(solved)
        elastic_force = [math.nan] * len(path.steps)
        for number, step in enumerate(path.steps):
            with suppress(AsperityError):
                result = solve(elastic, Approach(step.approach), keep=Keep(stiffness=False), on_failure="return")
                elastic_force[number] = result.force
            if step is peak:
                break
    columns = {
        "approach": [step.approach for step in path.steps],
        "force": [step.force for step in path.steps],
        "area": [float(step.contact.sum()) * pixel for step in path.steps],
        "work_lost": [step.require_plastic_flow().work for step in path.steps],
        "elastic_force": elastic_force,
    }
    return {name: np.array([0.0, *values]) for name, values in columns.items() if values}


class PlasticFlowWork(WithFacts):
    """Plastic flow of the body below the contact: what is done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = (*PlasticBody.citation_keys, "SimoTaylor1985")

    def check(self, ask: Flows, problem: ContactProblem) -> None:
        """Refuse bodies that cannot flow, before the contact is solved."""
        body, _ = plastic_body(problem.body, problem.counter_body)
        require_flow(body, unknown_is_elastic=ask.settings.unknown_is_elastic)

    def altered(self, ask: Flows, problem: ContactProblem) -> ContactProblem:
        """``problem`` with the laws of its bodies, by which the flow joins the solve: one entry for
        each layer and the base.

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
                plastic_parts(material, unknown_is_elastic=ask.settings.unknown_is_elastic)
                if isinstance(material, Elastic)
                else ()
            )
            laws.append(parts[0] if parts and isinstance(parts[0], J2) else None)
        depth = None if ask.settings.depth is None else float(ask.settings.depth)
        whole: Any = laws if isinstance(body, Layered) else laws[0]
        return problem.with_physics(plastic_flow=Law(whole, ask.settings.cells, depth, float(ask.settings.tolerance)))

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
        flow = solved.result.require_plastic_flow()
        body = plastic_body(solved.problem.body, solved.problem.counter_body)[0]
        with solved.stage("residual stress"):
            shown, tensions = _shown(flow, solved)
        layers, base = flow.zones[:-1], flow.zones[-1]
        first = [zone.first_yield for zone in flow.zones if math.isfinite(zone.first_yield)]
        tops = [zone.top for zone in flow.zones if math.isfinite(zone.top)]
        bottoms = [zone.bottom for zone in flow.zones if math.isfinite(zone.bottom)]
        peak = _peak(solved)
        area = float(peak.contact.sum()) * peak.problem.grid.pixel_area
        values: dict[str, Any] = {
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
            "flow_mean_contact_pressure": peak.force / area if area > 0.0 else math.nan,
            **tensions,
            IMPRINT.name: flow.displacement,
            **shown.values(PREFIX),
        }
        names = layer_names(body)
        headings = ["Layer", "Largest plastic strain", "at (x, y, depth)", "Depths", "Volume", "First yield at"]
        cells = []
        for name, zone in zip(names, flow.zones, strict=False):
            if not zone.largest_strain > 0.0:
                cells.append([name, "elastic", "–", "–", "–", "–"])
                continue
            place = ", ".join(show(value, "m", 3) for value in zone.place)
            begin = show(zone.first_yield, "Pa", 3) if math.isfinite(zone.first_yield) else "–"
            span = f"{show(zone.top, 'm', 3)} to {show(zone.bottom, 'm', 3)}"
            cells.append([name, percent(zone.largest_strain), place, span, f"{zone.volume * 1e18:.3g} µm³", begin])
        facts = {"layers": names, "axis": "x", "zones": [headings, cells], "row": _row(flow)}
        findings = inferred_strengths(body)
        if not values["flow_largest_strain"] > 0.0:
            elastic = Advice("note", "plastic flow", "Nothing flows under this load: the contact is elastic.")
            findings = (*findings, elastic)
        return Found(values, facts, findings, flow.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Map of the imprint; on the cut through the largest strain zones, residual stress, stress
        under load; curve."""
        shown = picture_of(PREFIX, found.values, found.detail)
        surface = ImprintMap(solved.problem, np.asarray(found.values[IMPRINT.name]))
        return (*figures_by(plots_of(shown, "flow"), shown), *figures_by((IMPRINT_MAP,), surface))

    def words(self, found: Found, solved: Solved) -> Words:
        """What flows, what stays, zones by layer, tensions."""
        values = found.values
        strain = percent(float(values["flow_largest_strain"]))
        depth, dent = (show(float(values[name]), "m", 3) for name in ("flow_depth", "flow_imprint_depth"))
        work = show(float(values["flow_plastic_work"]), "J", 3)
        flowed = float(values["flow_largest_strain"]) > 0.0
        sentence = (
            f"The body flows down to {depth} with plastic strains of up to {strain}; an imprint of {dent} "
            f"stays, and plastic flow took {work}."
        )
        if not flowed:
            sentence = "Nothing flows beneath the contact: it is elastic."
        zones = ("Plastic zones", zones_table(found.detail))
        tables = (zones, ("Tension and shear that may crack layers", tension_table(values, "flow")))
        return Words(
            sentence,
            [("largest plastic strain", strain)],
            number_rows(SCALARS, values),
            tables,
            (REMARK,),
            flowed,
            sentence,
        )


# In words and tables.

REMARK = (
    "Plastic strain is found in the volume with small strains, on the flat surface of the undeformed body. "
    "The residual stress is that of the plastic strain without load; flow in reverse during the unloading is "
    "in it only where the unloading was computed. Stresses of the table [stress] hold the plastic strain. "
    "Tensions are means over depth cells."
)
"""What the model is."""
