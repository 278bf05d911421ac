"""Conductance asked for by a document, in numbers, figures and words."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from ...contact.history import HistoryResult
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...core.engine import CpuEngine
from ...core.errors import InputError
from ...core.status import Advice
from ...core.units import percent, show
from ...io.words import value_text
from ...parts.part import Found, Rows, Solved, Table, WithFacts, Words
from ...plots.picture import Figure, figures_by
from ...solids.elastic import Rigid
from ...theories.conductance.spots import hottest
from .conductance import FLOWS, ContactConductance, conductance, require_conducting
from .figures import PLOTS, Flowing
from .law import ConductingInterface, radiation, softens
from .part import QUANTITIES, UNITS, ConductanceSettings
from .stiffness import from_stiffness, why_not

LARGE_ERROR = 0.1
"""Error by the pixels from which on the conductance is in doubt."""

LABELS = {item.name: item for item in QUANTITIES}


class ConductanceWork(WithFacts):
    """Current and heat through the contact: what is done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = ("Holm1967", "Barber2003")

    def check(self, ask: ConductanceSettings, problem: ContactProblem) -> None:
        """Refuse what cannot conduct, and materials of unknown conductivity."""
        flows_of(ask, problem)

    def compute(self, ask: ConductanceSettings, solved: Solved) -> Found:
        """Resistances with their bounds, fields, and the conductance along a load path."""
        reached = solved.at("peak")
        flows, values, findings = flows_of(ask, solved.problem), dict[str, Any](), list[Advice]()
        engine = None if solved.threads is None else CpuEngine(solved.threads)
        with solved.stage("conductance"):
            for flow in flows:
                between = interface_of(ask, flow)
                found = conductance(reached.result, flow, between, engine=engine)  # type: ignore[arg-type]
                values |= _values(found, reached.result, between)
                if flow == "electrical":
                    values |= _of_current(ask, found)
                elif between.bridges:
                    values["thermal_gap_share"] = found.through_gap
                findings += _findings(found)
                name = f"path_{flow}_conductance_per_area"
                if solved.path is not None and (solved.wanted is None or name in solved.wanted):
                    others = (
                        found if number == reached.number else conductance(step, flow, between, engine=engine)  # type: ignore[arg-type]
                        for number, step in enumerate(solved.path.steps, start=1)
                    )
                    values[name] = np.array([step.per_area for step in others])
        if isinstance(solved.problem.body, Rigid) or isinstance(solved.problem.counter_body, Rigid):
            fact = "The rigid body is taken for a perfect conductor: all of the resistance is that of the other one."
            findings.append(Advice("note", "rigid conductor", fact))
        if softens(values.get("hottest_spot", 0.0)):
            fact = "The hottest spot is so hot that metals soften there; the contact then grows under its load."
            findings.append(Advice("warning", "softening of spots", fact, numbers={"hottest": values["hottest_spot"]}))
        pressure = [] if solved.path is None else [step.mean_pressure for step in solved.path.steps]
        facts = {
            "flows": list(flows),
            "where": reached.where,
            "periodic": any(solved.problem.boundary.wraps),
            "turns": [] if solved.path is None else _turns(solved.path),
            "pressure": pressure,
            "yielded": bool(reached.result.plastic.any()),
            "voltage": None if ask.voltage is None else float(ask.voltage),
        }
        keys = (*self.citation_keys, *(("Sharvin1965", "Wexler1966", "Nikolic1999") if ask.mean_free_path else ()))
        keys = (*keys, *(("Kohlrausch1900",) if ask.voltage else ()), *(("Kennard1938",) if ask.jump else ()))
        return Found(values, facts, tuple(findings), keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Maps of flux density and potential, and the curve over the load of a path."""
        values, flows = found.values, found.detail["flows"]
        there = [flow for flow in flows if np.any(np.isfinite(values[f"{flow}_density"]))]
        path = {flow: values.get(f"path_{flow}_conductance_per_area", np.zeros(0)) for flow in flows}
        shown = Flowing(
            solved.problem,
            {flow: values[f"{flow}_density"] for flow in there},
            {flow: values[f"{flow}_drop"] for flow in there},
            path,
            np.asarray(found.detail["pressure"], dtype=float),
        )
        drawn = list[Figure]()
        for flow in there:
            *maps, curve = PLOTS[flow]
            many = path[flow].size > 1 and bool(np.all(np.isfinite(path[flow])))
            drawn += figures_by((*maps, *((curve,) if many else ())), shown)
        return tuple(drawn)

    def words(self, found: Found, solved: Solved) -> Words:
        """What it resists, by which spots, and how sure that is."""
        values, facts = found.values, found.detail
        said, headline, rows = list[str](), list[tuple[str, str]](), Rows()
        for flow in facts["flows"]:
            sentence, first, more = _said(flow, values, periodic=facts["periodic"])
            said.append(sentence)
            headline.append(first)
            rows += more
        said += [sentence for flow in facts["flows"] if (sentence := _set_in(flow, values, facts))]
        for name in ("ballistic_resistance", "hottest_spot", "thermal_gap_share"):
            if name in values and math.isfinite(float(values[name])):
                rows.append((LABELS[name].label, value_text(LABELS[name], float(values[name]))))
        if facts["where"]:
            rows.insert(0, ("at", facts["where"]))
        tables = tuple(
            (f"{flow.capitalize()} conductance where the load turns", _path_table(flow, values, facts))
            for flow in facts["flows"]
            if f"path_{flow}_conductance_per_area" in values
        )
        hot = "hottest_spot" in values and softens(float(values["hottest_spot"]))
        if "hottest_spot" in values and facts["voltage"]:
            said.append(
                f"At {show(facts['voltage'], 'V', 3)} the hottest spot reaches {float(values['hottest_spot']):.0f} K, "
                f"{'at which metals soften' if hot else 'below the softening of metals'}."
            )
        return Words(" ".join(said), headline, rows, tables, _REMARKS[facts["periodic"]], alarming=hot)


_REMARKS = {
    True: (
        "The resistance is that of the constriction: between mean planes, without what a uniform flow meets in the "
        "bodies and their layers.",
    ),
    False: ("The resistance is that between points of both bodies far away.",),
}
"""What a resistance is, of periodic contacts and of free ones."""


def flows_of(ask: ConductanceSettings, problem: ContactProblem) -> tuple[str, ...]:
    """What flows: as asked for, or all that the conductivities of the materials are known for.

    Raises
    ------
    InputError
        If a conductivity is not known that is needed.
    """
    if ask.flow != "known":
        flows = tuple(FLOWS) if ask.flow == "both" else (ask.flow,)
        for flow in flows:
            require_conducting(problem, FLOWS[flow])
        return flows
    refusals = dict[str, InputError]()
    for flow, of in FLOWS.items():
        try:
            require_conducting(problem, of)
        except InputError as error:
            refusals[flow] = error
    known = tuple(flow for flow in FLOWS if flow not in refusals)
    if not known:
        electrical, thermal = (refusals[flow] for flow in ("electrical", "thermal"))
        if electrical.subject == thermal.subject:  # the boundary, or both bodies rigid
            raise electrical
        raise InputError(
            f"{electrical.subject} or {thermal.subject} must be known for a flow, but neither is. Give "
            "{electrical_resistivity}, or {thermal_conductivity}.",
            subject=f"{electrical.subject} or {thermal.subject}",
        )
    return known


def interface_of(ask: ConductanceSettings, flow: str) -> ConductingInterface:
    """Film and gap for one ``flow``."""
    if flow == "electrical":
        return ConductingInterface(float(ask.film_resistance))
    walls = 0.0 if ask.emissivity is None else radiation(float(ask.temperature), (ask.emissivity, ask.emissivity))
    return ConductingInterface(
        float(ask.thermal_film_resistance), float(ask.gap_conductivity or 0.0), float(ask.jump or 0.0), walls
    )


def _values(found: ContactConductance, result: ContactResult, between: ConductingInterface) -> dict[str, Any]:
    """Values of one flow by name."""
    flow = found.flow
    plain = not (between.film_resistance or between.bridges) and not why_not(result) and math.isfinite(found.per_area)
    return {
        f"{flow}_resistance": found.resistance,
        f"{flow}_conductance": found.total,
        f"{flow}_conductance_per_area": found.per_area,
        f"{flow}_lower_bound": found.lower,
        f"{flow}_upper_bound": found.upper,
        f"{flow}_pixel_error": found.pixel_error,
        f"{flow}_extrapolated_conductance": found.extrapolated,
        f"{flow}_extrapolated_error": found.extrapolated_error,
        f"{flow}_layer_resistance": found.layers,
        f"{flow}_stiffness_conductance": from_stiffness(result, FLOWS[flow]) if plain else math.nan,
        f"{flow}_half_spots": found.spots.needed(0.5),
        f"{flow}_density": found.density,
        f"{flow}_drop": found.drop,
    }


def _of_current(ask: ConductanceSettings, found: ContactConductance) -> dict[str, float]:
    """Ballistic spots and the hottest one, where they are asked for."""
    values = dict[str, float]()
    if ask.mean_free_path is not None:
        total = found.with_ballistic_spots(float(ask.mean_free_path))
        values["ballistic_resistance"] = 1.0 / total if total else math.inf
    if ask.voltage is not None:
        values["hottest_spot"] = hottest(float(ask.voltage), float(ask.temperature))
    return values


def _findings(found: ContactConductance) -> list[Advice]:
    """What should be known before the conductance of one flow is used."""
    if found.pixel_error <= LARGE_ERROR:
        return []
    fact = (
        f"The {found.flow} conductance may err by {percent(found.pixel_error, 2)}: the spots that carry the flow are "
        "few pixels wide."
    )
    numbers = {"error": found.pixel_error, "largest": LARGE_ERROR}
    concerns = ("electrical_",) if found.flow == "electrical" else ("thermal_",)
    return [Advice("warning", "pixels of conducting spots", fact, "Take a finer grid ({resample}).", numbers, concerns)]


def _turns(path: HistoryResult) -> list[int]:
    """Numbers from 0 of the steps at which the load turns."""
    return [int(step) for step in path.turns]


_SHOWN = (
    "resistance",
    "conductance_per_area",
    "pixel_error",
    "extrapolated_conductance",
    "extrapolated_error",
    "layer_resistance",
    "stiffness_conductance",
    "half_spots",
)
"""Quantities of a flow in the order of tables."""


def _said(flow: str, values: Any, *, periodic: bool) -> tuple[str, tuple[str, str], Rows]:
    """Sentence, headline and rows of one ``flow``."""
    resistance, _, per_area, _ = UNITS[flow]
    total, mean = float(values[f"{flow}_resistance"]), float(values[f"{flow}_conductance_per_area"])
    if not math.isfinite(total):
        sentence = f"The surfaces do not touch: no {flow} flow."
    elif not total:
        sentence = f"All of the surface touches: there is no {flow} constriction."
    else:
        half = int(values[f"{flow}_half_spots"])
        spots = f"{half} spot{'s' if half > 1 else ''}"
        error = percent(float(values[f"{flow}_pixel_error"]), 2)
        kind = "constriction" if periodic else "contact"
        sentence = (
            f"The {flow} {kind} resistance is {show(total, resistance, 3)} ± {error} "
            f"({show(mean, per_area, 3)}); {spots} carr{'y' if half > 1 else 'ies'} half of the flow."
        )
    rows: Rows = []
    for name in _SHOWN:
        item, value = LABELS[f"{flow}_{name}"], values[f"{flow}_{name}"]
        if name == "layer_resistance" and not value:
            continue
        if name.startswith("extrapolated") and not 0.0 < total < math.inf:
            continue
        if isinstance(value, int | np.integer):
            rows.append((item.label, str(value)))
        elif not math.isnan(float(value)):
            rows.append((item.label, value_text(item, float(value))))
    lower, upper = (float(values[f"{flow}_{end}_bound"]) for end in ("lower", "upper"))
    if 0.0 < lower < math.inf:
        rows.append((f"width of the bounds of the {flow} conductance on this grid", f"{upper / lower - 1.0:.1e}"))
    return sentence, (LABELS[f"{flow}_resistance"].label, show(total, resistance, 3)), rows


def _set_in(flow: str, values: Any, facts: Any) -> str:
    """How much better a joint conducts on the way back than at the same load before: where it was
    at half of the largest pressure; empty without a way back to there, or if it is the same."""
    along = np.asarray(values.get(f"path_{flow}_conductance_per_area", ()), dtype=float)
    pressure = np.asarray(facts["pressure"], dtype=float)
    top = int(np.argmax(pressure)) if pressure.size else 0
    half = 0.5 * float(pressure[top]) if pressure.size else 0.0
    up, down = slice(None, top + 1), slice(None, top - 1 if top else None, -1)
    if not facts.get("yielded") or top in (0, pressure.size - 1):
        return ""
    if along.size != pressure.size or not np.all(np.isfinite(along)):
        return ""
    if pressure[0] > half or pressure[-1] > half or np.any(np.diff(pressure[up]) < 0.0):
        return ""
    before, after = (float(np.interp(half, pressure[part], along[part])) for part in (up, down))
    if not before or np.any(np.diff(pressure[down]) < 0.0) or after < 1.02 * before:
        return ""
    return f"Unloaded to {show(half, 'Pa', 3)} it conducts {after / before:.2g} times as much {_NAMES[flow]} as before."


_NAMES = {"electrical": "current", "thermal": "heat"}


def _path_table(flow: str, values: Any, facts: Any) -> Table:
    """Conductance per area where the load turns."""
    along = values[f"path_{flow}_conductance_per_area"]
    cells = [
        (f"{step + 1}", show(float(facts["pressure"][step]), "Pa"), show(float(along[step]), UNITS[flow][2], 4))
        for step in facts["turns"]
    ]
    return Table(("Step", "Mean pressure", "Conductance per area"), tuple(cells))
