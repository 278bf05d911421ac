"""Area, stiffness and conductance of a contact: their derivatives from solves at several loads.

The derivative of the stiffness on a fixed set lacks a part by the edge that moves, and those of the
area and, at given conductors, of a conductance are all of this kind. They come out of the approach,
and of the area by the edge, at loads between which the edge moves by some pixels, which also takes
out how it lies between them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

import numpy as np

from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...core.arrays import RealArray
from ...core.engine import Engine
from ...core.errors import InputError
from ...solids.elastic import Elastic, Rigid
from ...solids.layers import Layered
from ..conductance.operator import ELECTRICAL, THERMAL, Flow, harmonic_mean
from .answer import Sensitivities
from .by_edges import conductance_at, of_area, of_conductance
from .conducting import conductor_parameters, is_layered, of_half_spaces, with_conductor
from .loads import ENDS, EVENLY, factors_about, require_moving_edge, solved_at, worst_of
from .one_load import at_one_load, stepped_problem
from .outputs import OUTPUTS, Slopes, State
from .parameters import HEIGHTS, LOAD, chosen, parameters
from .system import RESIDUAL, Held


@dataclass(frozen=True)
class Ranged:
    """An output from several loads: its ``name``, SI ``unit`` and ``degree`` in load and moduli,
    and of a conductance what flows."""

    name: Literal["area", "stiffness", "electrical_conductance", "thermal_conductance"]
    unit: str
    degree: float | None
    flow: Flow | None = None

    def at(self, state: State) -> Slopes:
        """Refused: it takes several loads."""
        raise InputError(f"output must be one of a single load, but is {self.name}. Take sensitivities(result, ...).")

    def by_edges(self, problem: ContactProblem) -> bool:
        """Whether it is found by the edge that moves, else from the approach at two loads."""
        layered = is_layered(problem.body) or is_layered(problem.counter_body)
        return self.name == "area" or (self.flow is not None and layered)

    def factors(self, result: ContactResult) -> RealArray:
        """Loads over that of the ``result``."""
        return factors_about(result, EVENLY if self.by_edges(result.problem) else ENDS)

    def of(self, contacts: Sequence[ContactResult], engine: Engine | None = None) -> float:
        """J, from ``contacts`` of one problem at several loads."""
        problem = contacts[0].problem
        if self.name == "area":
            return float(np.mean([each.contact_area for each in contacts]))
        if self.by_edges(problem) and self.flow is not None:
            return float(np.mean([each.extrapolated for each in conductance_at(contacts, self.flow, engine)]))
        low, high = contacts
        return self.over_stiffness(problem) * (high.force - low.force) / (high.approach - low.approach)

    def stepped(self, problem: ContactProblem, name: str, step: float) -> ContactProblem:
        """``problem`` with the parameter of that ``name`` changed by a relative ``step``."""
        known = () if self.flow is None else conductor_parameters(problem, self.flow)
        for each in known:
            if each.name == name and each.of_material:
                return with_conductor(problem, each, each.value * (1.0 + step))
        return stepped_problem(problem, name, step)

    def over_stiffness(self, problem: ContactProblem) -> float:
        """J over the stiffness: for conductances of homogeneous bodies k_s/E* (Barber 2003)."""
        if self.flow is None:
            return 1.0
        return harmonic_mean(problem.body, problem.counter_body, self.flow) / problem.contact_modulus


RANGED: Mapping[str, Ranged] = MappingProxyType(
    {
        each.name: each
        for each in (
            Ranged("area", "m**2", 0.0),
            Ranged("stiffness", "N/m", 1.0),
            Ranged("electrical_conductance", "S", 0.0, ELECTRICAL),
            Ranged("thermal_conductance", "W/K", 0.0, THERMAL),
        )
    }
)
"""Outputs from several loads, by name."""


def over_loads(
    result: ContactResult,
    wanted: Ranged,
    to: str | Iterable[str] = "all",
    *,
    held: Held | None = None,
    tolerance: float = RESIDUAL,
    engine: Engine | None = None,
) -> Sensitivities:
    """Derivatives of an output from several loads about that of ``result``, the load being held.

    Raises
    ------
    InputError
        If the approach is to be held, or a conductivity that is needed is not known, or as of
        ``sensitivities``.
    """
    require_moving_edge(result, wanted.name, held)
    problem = result.problem
    of_contact = [HEIGHTS, LOAD, *(each.name for each in parameters(problem))]
    flowing = {} if wanted.flow is None else {each.name: each for each in conductor_parameters(problem, wanted.flow)}
    asked = chosen(to, dict.fromkeys([*of_contact, *flowing]))
    names = tuple(name for name in asked if name in of_contact)
    conducting = {name: each for name, each in flowing.items() if name in asked}
    if wanted.by_edges(problem):
        if wanted.flow is None:
            found = of_area(result, names, tolerance, engine)
        else:
            found = of_conductance(result, wanted.flow, names, conducting.values(), tolerance, engine)
        value, values, certificate, first = found.value, dict(found.values), found.certificate, found.several[0]
    else:
        several = _ends(result, names, tolerance, engine)
        value, values = _by_approach(result, wanted, names, several)
        if wanted.flow is not None and conducting:
            # the share of each is that among all of them
            slopes = of_half_spaces(flowing, wanted.flow)
            values |= {name: value * slopes[name] for name in conducting}
        certificate, first = worst_of(each.certificate for each in several), several[0]
    given = {name: first.parameters[name] for name in names} | {name: each.value for name, each in conducting.items()}
    units = {name: first.units[name] for name in names} | {name: each.unit for name, each in conducting.items()}
    if LOAD in given:
        given[LOAD] = result.force
    values = {name: values[name] for name in asked}
    again = _again(result, wanted, engine)
    return Sensitivities(problem, wanted, value, "load", values, given, units, certificate, again)


def _ends(
    result: ContactResult, names: tuple[str, ...], tolerance: float, engine: Engine | None
) -> list[Sensitivities]:
    """Derivatives of the approach at both ends of the loads."""
    return [
        at_one_load(each, OUTPUTS["approach"], names or LOAD, held="load", tolerance=tolerance, engine=engine)
        for each in solved_at(result.problem, result.mean_pressure * factors_about(result, ENDS), engine)
    ]


def _by_approach(
    result: ContactResult, wanted: Ranged, names: tuple[str, ...], several: list[Sensitivities]
) -> tuple[float, dict[str, float | RealArray]]:
    """J = scale ΔP/Δδ and its derivatives."""
    problem, force, factors = result.problem, result.force, factors_about(result, ENDS)
    rise = several[1].value - several[0].value
    value = wanted.over_stiffness(problem) * force * float(np.ptp(factors)) / rise
    values = dict[str, float | RealArray]()
    for name in names:
        by = factors if name == LOAD else np.ones(len(several))
        parts = [factor * np.asarray(each.values[name]) for factor, each in zip(by, several, strict=True)]
        found = value * (np.asarray((1.0 / force) if name == LOAD else 0.0) - (parts[1] - parts[0]) / rise)
        found = found + value * _of_scale(wanted, problem, name)
        values[name] = found if found.ndim else float(found)
    return value, values


def _again(result: ContactResult, wanted: Ranged, engine: Engine | None) -> Callable[[str, float], tuple[float, int]]:
    """Solves with a parameter changed, as of ``Again``."""
    pressures = result.mean_pressure * wanted.factors(result)

    def again(name: str, step: float) -> tuple[float, int]:
        by = 1.0 + step if name == LOAD else 1.0
        found = solved_at(wanted.stepped(result.problem, name, step), by * pressures, engine)
        before = solved_at(result.problem, pressures, engine)
        turned = sum(int((one.contact != other.contact).sum()) for one, other in zip(found, before, strict=True))
        return wanted.of(found, engine), turned

    return again


def _of_scale(wanted: Ranged, problem: ContactProblem, name: str) -> float:
    """d ln (k_s/E*) to the parameter of that ``name``, 1/E* = Σ (1 - ν²)/E."""
    which, _, kind = name.rpartition(".")
    which = which.partition(".")[0]
    if wanted.flow is None or which not in ("body", "counter_body"):
        return 0.0
    body = getattr(problem, which)
    if isinstance(body, Rigid):
        return 0.0
    material = body.reduced.base if isinstance(body, Layered) else body
    assert isinstance(material, Elastic)
    E, nu = material.youngs_modulus, material.poisson_ratio
    inverse = -(1.0 - nu * nu) / E**2 if kind == "youngs_modulus" else -2.0 * nu / E
    return inverse * problem.contact_modulus
