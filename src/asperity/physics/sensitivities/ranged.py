"""Area, stiffness and conductance of a contact: their derivatives from solves at several loads.

The derivative of the stiffness on a fixed set lacks a part by the edge that moves, and that of the
area is all of this kind. Both come out of the approach and of the area by the edge at loads between
which the edge moves by some pixels, which also takes out how it lies between them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

import numpy as np

from ...contact.controls import MeanPressure
from ...contact.operators import prepare_operator
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import solve
from ...contact.solvers.active_set.solver import ActiveSet
from ...core.arrays import RealArray
from ...core.engine import Engine
from ...core.errors import InputError
from ...solids.elastic import Elastic, Rigid
from ...solids.layers import Layered
from ..conductance.operator import ELECTRICAL, THERMAL, harmonic_mean
from .answer import Sensitivities, SensitivityCertificate
from .one_load import AGAIN, at_one_load, require_differentiable, stepped_problem
from .outputs import OUTPUTS, EdgeArea, Output, Slopes, State
from .parameters import HEIGHTS, LOAD
from .system import RESIDUAL, Held

REACH = 0.15
"""Relative change of the load up to which others are solved. The secant of the compliance errs by
0.2 % of a sphere and by 0.8 % of a contact whose load grows exponentially."""

MANY = 8
"""Loads over which the area is averaged: its derivatives then err by at most 10 % of the largest
where the radius of a contact is 15 pixels, by 2 to 7 % where it is 35 pixels; of a wave of which 86
% touch, by 20 %."""

EDGE = 0.75
"""Pressure of the area by its edge over the mean real pressure."""


@dataclass(frozen=True)
class Ranged:
    """An output from several loads: its ``name``, SI ``unit``, ``degree`` in load and moduli, and
    the ``shares`` of the largest change at which the contact is solved."""

    name: Literal["area", "stiffness", "electrical_conductance", "thermal_conductance"]
    unit: str
    degree: float | None
    shares: tuple[float, ...]

    def at(self, state: State) -> Slopes:
        """Refused: it takes several loads."""
        raise InputError(f"output must be one of a single load, but is {self.name}. Take sensitivities(result, ...).")

    def of(self, result: ContactResult) -> Output:
        """What is found at each load of the contact ``result``."""
        if self.name != "area":
            return OUTPUTS["approach"]
        mean = result.force / (float(result.contact.sum()) * result.problem.grid.pixel_area)
        return EdgeArea(EDGE * _left(result) * mean)

    def factors(self, result: ContactResult) -> RealArray:
        """Loads over that of the ``result``."""
        return 1.0 + REACH * _left(result) * np.array(self.shares)

    def value(self, values: Sequence[float], rise: float, problem: ContactProblem) -> float:
        """J, from what is found at each load; ``rise``: largest load less the smallest, in N."""
        if self.name == "area":
            return float(np.mean(values))
        return self.scale(problem) * rise / (values[1] - values[0])

    def scale(self, problem: ContactProblem) -> float:
        """J over the stiffness: for conductances k_s/E* (Barber 2003)."""
        if self.name in ("area", "stiffness"):
            return 1.0
        for which in ("body", "counter_body"):
            body = getattr(problem, which)
            if isinstance(body, Layered) and body.reduced.layers:
                raise InputError(
                    f"{which.replace('_', ' ')} of the sensitivity of a conductance must be homogeneous, as it is that "
                    "of the stiffness, but is layered."
                )
        flow = ELECTRICAL if self.name.startswith("electrical") else THERMAL
        return harmonic_mean(problem.body, problem.counter_body, flow) / problem.contact_modulus


def _left(result: ContactResult) -> float:
    """Open over touching area of a periodic contact, at most one: near full contact the load and
    the pressure at edges change less."""
    if not all(result.problem.boundary.wraps):
        return 1.0
    touching = float(result.contact.mean())
    return min(1.0, (1.0 - touching) / touching)


_ENDS = (-1.0, 1.0)

RANGED: Mapping[str, Ranged] = MappingProxyType(
    {
        each.name: each
        for each in (
            Ranged("area", "m**2", 0.0, tuple(((np.arange(MANY) + 0.5) / MANY * 2.0 - 1.0).tolist())),
            Ranged("stiffness", "N/m", 1.0, _ENDS),
            Ranged("electrical_conductance", "S", 0.0, _ENDS),
            Ranged("thermal_conductance", "W/K", 0.0, _ENDS),
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
        If the approach is to be held, or as of ``sensitivities``.
    """
    require_differentiable(result)
    if held == "approach":
        raise InputError(f"held of sensitivities must be load for {wanted.name}, but is approach.")
    if result.plastic.any():
        raise InputError(
            f"contact must be elastic for sensitivities of {wanted.name}, but {int(result.plastic.sum())} points have "
            "yielded. Leave the {hardness} out."
        )
    if not _left(result):
        raise InputError(f"contact must be partial for sensitivities of {wanted.name}, but is full.")
    problem, of, force, factors = result.problem, wanted.of(result), result.force, wanted.factors(result)
    several = [
        at_one_load(each, of, to, held="load", tolerance=tolerance, engine=engine)
        for each in _solved(problem, factors, result, engine)
    ]
    value = wanted.value([each.value for each in several], force * float(np.ptp(factors)), problem)
    values = dict[str, float | RealArray]()
    for name in several[0].values:
        by = factors if name == LOAD else np.ones(len(several))
        parts = [factor * np.asarray(each.values[name]) for factor, each in zip(by, several, strict=True)]
        if wanted.name == "area":
            found = np.mean(parts, axis=0)
        else:  # J = scale ΔP/Δδ
            rise = several[1].value - several[0].value
            found = value * (np.asarray((1.0 / force) if name == LOAD else 0.0) - (parts[1] - parts[0]) / rise)
            found = found + value * _of_scale(wanted, problem, name)
        values[name] = found if found.ndim else float(found)
    first = several[0]
    given = dict(first.parameters)
    if LOAD in given:
        given[LOAD] = force
    certificates = [each.certificate for each in several]
    worst = SensitivityCertificate(
        adjoint_residual=max(each.adjoint_residual for each in certificates),
        state_error=max(each.state_error for each in certificates),
        output_error=float("nan"),
        changed=max(each.changed for each in certificates),
        fft_pairs=sum(each.fft_pairs for each in certificates),
    )
    again = _again(result, wanted, of, engine)
    return Sensitivities(problem, wanted, value, "load", values, given, first.units, worst, again)


def _solved(
    problem: ContactProblem, factors: RealArray, result: ContactResult, engine: Engine | None
) -> list[ContactResult]:
    """``problem`` under the load of ``result`` times each of the ``factors``."""
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
    loads = [MeanPressure(each * result.mean_pressure) for each in factors]
    method = ActiveSet(tolerance=AGAIN)
    return [solve(problem, load, solver=method, operator=operator, on_failure="return") for load in loads]


def _again(
    result: ContactResult, wanted: Ranged, of: Output, engine: Engine | None
) -> Callable[[str, float], tuple[float, int]]:
    """Solves with a parameter changed, as of ``Again``."""

    factors = wanted.factors(result)

    def again(name: str, step: float) -> tuple[float, int]:
        problem, by = stepped_problem(result.problem, name, step), 1.0 + step if name == LOAD else 1.0
        found = _solved(problem, by * factors, result, engine)
        values = [at_one_load(each, of, HEIGHTS, held="load", engine=engine).value for each in found]
        before = _solved(result.problem, factors, result, engine)
        turned = sum(int((one.contact != other.contact).sum()) for one, other in zip(found, before, strict=True))
        return wanted.value(values, by * result.force * float(np.ptp(factors)), problem), turned

    return again


def _of_scale(wanted: Ranged, problem: ContactProblem, name: str) -> float:
    """d ln (k_s/E*) to the parameter of that ``name``, 1/E* = Σ (1 - ν²)/E."""
    which, _, kind = name.rpartition(".")
    which = which.partition(".")[0]
    if wanted.name in ("area", "stiffness") or which not in ("body", "counter_body"):
        return 0.0
    body = getattr(problem, which)
    if isinstance(body, Rigid):
        return 0.0
    material = body.reduced.base if isinstance(body, Layered) else body
    assert isinstance(material, Elastic)
    E, nu = material.youngs_modulus, material.poisson_ratio
    inverse = -(1.0 - nu * nu) / E**2 if kind == "youngs_modulus" else -2.0 * nu / E
    return inverse * problem.contact_modulus
