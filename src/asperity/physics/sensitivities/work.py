"""Sensitivities asked for by a document, in numbers, figures and words."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from ...contact.operators import prepare_operator
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...core.arrays import RealArray
from ...core.engine import CpuEngine, Engine
from ...core.errors import InputError
from ...core.status import Advice
from ...core.units import percent, show
from ...parts.part import Found, Rows, Solved, Table, WithFacts, Words
from ...plots.picture import Figure, figures_by
from ...solids.elastic import Elastic, Rigid
from ...solids.layers import Layered
from ..conductance.conductance import FLOWS, require_conducting
from ..stress.criteria import VonMises
from ..stress.regions import regions, stack
from .answer import Sensitivities
from .figures import Decisive, plots
from .one_load import posed, require_pressure_alone
from .outputs import Output, PressureNorm
from .parameters import APPROACH, HARDNESS, HEIGHTS, LOAD, kept_layers
from .part import OUTPUTS, SensitivitySettings
from .sensitivities import sensitivities
from .subsurface import StressNorm
from .yielding import YieldLoad, yield_load

SHARES_OF_LAYER = (0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0)
"""Planes of a layer on which its yield is looked for, shares of its thickness."""

DEPTHS = (0.0, 0.15, 0.25, 0.35, 0.45, 0.55, 0.7, 1.0)
"""Planes of a half-space on which its yield is looked for, over the radius of a circle of the mean
area of a spot."""

EXPONENT = 256.0
"""Of the norm in place of the largest stress: its sensitivities err by about 3/256."""

TOLERANCE = 1e-6
"""Relative residual of the linear systems: grids leave errors of a per cent."""

DOUBTED = 0.05
"""Share of the points in contact whose state contradicts the set, from which sensitivities are in
doubt."""

CONDUCTANCES = ("electrical_conductance", "thermal_conductance")


class SensitivitiesWork(WithFacts):
    """Sensitivities of numbers of the contact to all parameters: what is done for them."""

    citation_keys: ClassVar[tuple[str, ...]] = ("Giles2000", "Squire1998")

    def check(self, ask: SensitivitySettings, problem: ContactProblem) -> None:
        """Refuse contacts that have no derivatives, and what is not known of the materials."""
        require_pressure_alone(problem)
        for name in ask.of:
            if name in CONDUCTANCES:
                require_conducting(problem, FLOWS[name.removesuffix("_conductance")])
            if name == "yield":
                require_strength(problem)

    def compute(self, ask: SensitivitySettings, solved: Solved) -> Found:
        """Relative sensitivities of each number, and the map of the first."""
        reached = solved.at(ask.step)
        engine = None if solved.threads is None else CpuEngine(solved.threads)
        values, findings = dict[str, Any](), list[Advice]()
        given, units = dict[str, float](), dict[str, str]()
        names, relative, derivatives = tuple[str, ...](), dict[str, dict[str, float]](), dict[str, dict[str, float]]()
        for name in ask.of:
            with solved.stage(f"sensitivities of the {OUTPUTS[name][1]}"):
                found = _one(name, ask, reached.result, engine)
            one = found.norm if isinstance(found, YieldLoad) else found
            relative[name] = dict(found.relative)
            derivatives[name] = {key: float(np.sum(part)) for key, part in found.values.items() if key != HEIGHTS}
            names = tuple(dict.fromkeys((*names, *relative[name])))
            values[f"sensitive_{name}"] = found.load if isinstance(found, YieldLoad) else found.value
            for key in one.parameters:
                given.setdefault(key, float(np.mean(np.asarray(one.parameters[key]))))
                units[key] = one.units[key]
            if isinstance(found, YieldLoad):
                given["strength"], units["strength"] = found.strength, "Pa"
            if "sensitivity_map" not in values and HEIGHTS in found.values:
                slope = np.array(found.values[HEIGHTS])
                if name == "approach":  # from a fixed height, or the highest point alone would show
                    slope.flat[int(np.argmax(solved.problem.profile()))] -= 1.0
                values["sensitivity_map"] = slope / values[f"sensitive_{name}"]
            findings += _findings(name, one)
        values["sensitivity_parameter"] = np.array(names, object)
        values["sensitivity_value"] = np.array([given.get(key, math.nan) for key in names])
        for name, found_of in relative.items():
            values[f"sensitivity_{name}"] = np.array([found_of.get(key, math.nan) for key in names])
            for key, parameter in _shares(solved.problem).items():
                if parameter in found_of:
                    values[f"sensitivity_{name}_{key}"] = found_of[parameter]
        facts = {
            "of": list(ask.of),
            "given": given,
            "units": units,
            "words": {key: in_words(key, solved.problem) for key in names},
            "derivatives": derivatives,
            "where": reached.where,
        }
        return Found(values, facts, tuple(findings), self.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Bars of each number, and the map of the first."""
        facts, values = found.detail, found.values
        names = [str(name) for name in values["sensitivity_parameter"]]
        shown = Decisive(
            solved.problem,
            tuple(facts["words"][name] for name in names),
            {OUTPUTS[name][1]: np.nan_to_num(_column(values, name)) for name in facts["of"]},
            np.asarray(values.get("sensitivity_map", np.zeros(0))),
        )
        return figures_by(plots(shown), shown)

    def words(self, found: Found, solved: Solved) -> Words:
        """What decides each number, with a table of all parameters."""
        facts, values = found.detail, found.values
        names = [str(name) for name in values["sensitivity_parameter"]]
        said, headline, tables = list[str](), list[tuple[str, str]](), list[tuple[str, Table]]()
        for name in facts["of"]:
            unit, label = OUTPUTS[name]
            column = _column(values, name)
            order = [k for k in np.argsort(-np.abs(np.nan_to_num(column))) if math.isfinite(column[k])]
            parts = [f"by {column[k]:+.2g} % with 1 % more {facts['words'][names[k]]}" for k in order[:3]]
            amount = show(float(values[f"sensitive_{name}"]), unit, 4)
            said.append(f"The {label}, {amount}, changes {_listed(parts)}.")
            if order:
                headline.append(
                    (f"what decides the {label}", f"{facts['words'][names[order[0]]]}, {column[order[0]]:+.2g}")
                )
            cells = tuple(_cells(names[k], column[k], name, facts) for k in order)
            tables.append(
                (f"Sensitivities of the {label}", Table(("Parameter", "Value", "% by 1 %", "Derivative in SI"), cells))
            )
        rows: Rows = [
            (f"{OUTPUTS[name][1]}", show(float(values[f"sensitive_{name}"]), OUTPUTS[name][0], 4))
            for name in facts["of"]
        ]
        if facts["where"]:
            rows.insert(0, ("at", facts["where"]))
        remarks = (
            "Sensitivities are those of small changes; for 10 % and more solve again. The load is held while other "
            "parameters change.",
        )
        return Words(" ".join(said), headline, rows, tuple(tables), remarks)


def _one(
    name: str, ask: SensitivitySettings, result: ContactResult, engine: Engine | None
) -> Sensitivities | YieldLoad:
    """Sensitivities of one number at held load."""
    to: str | tuple[str, ...] = "all" if "all" in ask.to else ask.to
    if name == "yield":
        return yield_load(result, first_to_yield(result), to, engine=engine)
    of: str | Output = PressureNorm(ask.exponent) if name == "peak_pressure" else name
    return sensitivities(result, of, to, held="load", tolerance=TOLERANCE, engine=engine)


def first_to_yield(result: ContactResult) -> StressNorm:
    """Norm of the stress in the layer of the body, or of the counter body, that is nearest to its
    strength under the load of ``result``."""
    return max(yielding_norms(result), key=lambda item: item[0])[1]


def yielding_norms(result: ContactResult) -> list[tuple[float, StressNorm]]:
    """Largest stress over strength under the load of ``result``, and the norm of the stress, in
    each layer and half-space of known strength."""
    areas = result.spot_areas
    radius = math.sqrt(float(areas.max()) / math.pi)
    problem = result.problem
    state = posed(result, prepare_operator(problem.compliance, problem.grid, problem.boundary))
    found = list[tuple[float, StressNorm]]()
    for which, layer, strength, infinite in _strong(problem):
        planes = tuple(radius * share for share in DEPTHS) if infinite else SHARES_OF_LAYER
        norm = StressNorm(layer, planes, m=EXPONENT, of=which)  # type: ignore[arg-type]
        found.append((norm.largest(state) / strength, norm))
    return found


def require_strength(problem: ContactProblem) -> None:
    """Refuse a ``problem`` without a layer or base of known strength, with an ``InputError``."""
    if not _strong(problem):
        raise InputError(
            "strength of a layer or base must be known for the sensitivity of its load at yield, but is not. "
            "Give {yield_stress}."
        )


def _strong(problem: ContactProblem) -> list[tuple[str, int, float, bool]]:
    """Body, number, strength (Pa) and whether it has no end, of each layer and half-space of known
    strength."""
    found = []
    for which in ("body", "counter_body"):
        body = getattr(problem, which)
        if isinstance(body, Rigid):
            continue
        numbers = kept_layers(body) if isinstance(body, Layered) else [0]
        for region, number in zip(regions(body), numbers, strict=False):
            strength = VonMises().limit(region.material).value
            if math.isfinite(strength):
                found.append((which, number, strength, math.isinf(region.bottom)))
    return found


def _shares(problem: ContactProblem) -> dict[str, str]:
    """Names of the parameters that every body has, by those of studies."""
    found = {"load": LOAD, "heights": HEIGHTS, "counter_modulus": "counter_body.youngs_modulus"}
    body = problem.body
    if isinstance(body, Layered) and stack(body).layers:
        first = kept_layers(body)[0]
        place = f"body.layers[{first}]"
        return found | {
            "thickness": f"{place}.thickness",
            "modulus": f"{place}.youngs_modulus",
            "base_modulus": "body.base.youngs_modulus",
        }
    return found | {"modulus": "body.youngs_modulus", "base_modulus": "body.youngs_modulus"}


_KINDS = {
    "youngs_modulus": "Young's modulus",
    "poisson_ratio": "Poisson's ratio",
    "thickness": "thickness",
    "electrical_resistivity": "electrical resistivity",
    "thermal_conductivity": "thermal conductivity",
}
_PLAIN = {LOAD: "load", APPROACH: "approach", HEIGHTS: "rms height", HARDNESS: "hardness", "strength": "strength"}


def in_words(name: str, problem: ContactProblem) -> str:
    """Words for the parameter of that ``name``, such as "thickness of layer 1 (DLC)"."""
    if name in _PLAIN:
        return _PLAIN[name]
    place, _, kind = name.rpartition(".")
    which, _, part = place.partition(".")
    return f"{_KINDS[kind]} of {_part_in_words(which, part, problem)}"


def layer_in_words(norm: StressNorm, problem: ContactProblem) -> str:
    """Words for the layer of a ``norm`` of the stress, such as "layer 1 (DLC)"."""
    body = getattr(problem, norm.of)
    if not isinstance(body, Layered):
        return _part_in_words(norm.of, "", problem)
    part = f"layers[{norm.layer}]" if norm.layer < len(body.layers) else "base"
    return _part_in_words(norm.of, part, problem)


def _part_in_words(which: str, part: str, problem: ContactProblem) -> str:
    """Words for a ``part`` of one of the bodies, none for a homogeneous one."""
    body = getattr(problem, which)
    owner = "" if which == "body" else " of the counter body"
    if not part:
        return f"the {which.replace('_', ' ')}"
    if part == "base":
        material = body.base.name if isinstance(body.base, Elastic) else ""
        return f"the base{owner}{f' ({material})' if material else ''}"
    number = int(part.removeprefix("layers[").removesuffix("]"))
    material = body.layers[number].material.name
    return f"layer {number + 1}{owner}{f' ({material})' if material else ''}"


def _findings(name: str, found: Sensitivities) -> list[Advice]:
    """What should be known before the sensitivities of one number are used."""
    share = found.certificate.changed / max(1, int(np.count_nonzero(found.problem.profile())))
    if share <= DOUBTED:
        return []
    fact = (
        f"Of {percent(share)} of all points the state contradicts the set on which the sensitivities of the "
        f"{OUTPUTS[name][1]} were found."
    )
    numbers = {"share": share, "largest": DOUBTED}
    return [Advice("warning", "set of the sensitivities", fact, "Solve more closely ({tolerance}).", numbers)]


def _column(values: Any, name: str) -> RealArray:
    return np.asarray(values[f"sensitivity_{name}"], dtype=float)


def _cells(key: str, relative: float, name: str, facts: Any) -> tuple[str, ...]:
    """Row of one parameter."""
    given, unit = facts["given"].get(key, math.nan), facts["units"].get(key, "1")
    slope = facts["derivatives"][name].get(key, math.nan)
    by = OUTPUTS[name][0]
    derivative = "" if math.isnan(slope) else f"{slope:.4g} {by}" + ("" if unit == "1" else f" per {unit}")
    derivative = derivative.replace("**2", "²").replace("ohm*m", "Ω·m").replace("m*K", "m·K")
    value = "" if math.isnan(given) else (f"{given:.4g}" if unit == "1" else show(given, unit, 4))
    return facts["words"][key], value, f"{relative:+.3g}", derivative


def _listed(items: list[str]) -> str:
    """Items with commas and "and"."""
    return items[0] if len(items) == 1 else f"{', '.join(items[:-1])} and {items[-1]}"
