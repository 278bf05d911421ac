"""Load at which a layer begins to yield, and its derivatives."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from ...contact.controls import MeanPressure
from ...contact.operators import prepare_operator
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import solve
from ...contact.solvers.active_set.solver import ActiveSet
from ...core import require
from ...core.arrays import RealArray
from ...core.engine import Engine
from ...core.errors import InputError, NoSolutionError
from ...core.late import Shown
from ...core.units import show
from ..stress.criteria import VonMises
from .answer import Sensitivities
from .one_load import AGAIN, at_one_load, posed, require_differentiable, stepped_problem
from .outputs import Slopes, State
from .parameters import LOAD
from .subsurface import StressNorm

ENOUGH, MOST = 1e-4, 20
"""Relative distance of the largest stress from the strength at which the search ends; loads at
most."""

STRENGTH = "strength"
"""Name of the strength among the parameters."""


@dataclass(frozen=True, eq=False, repr=False)
class YieldLoad(Shown):
    """Load P at which the largest √(3 J2) on planes in a layer reaches its strength Y.

    Attributes
    ----------
    load
        P in N.
    strength
        Y in Pa.
    result
        The contact under it.
    norm
        Sensitivities of the norm of the stress there.
    values
        dP/dθ by the name of each parameter, -(∂J/∂θ)/(∂J/∂P) with the norm J in place of the
        largest stress, and of ``"strength"``.
    solves
        Contacts that were solved.
    """

    load: float
    strength: float
    result: ContactResult
    norm: Sensitivities
    values: Mapping[str, float | RealArray]
    solves: int

    @property
    def relative(self) -> Mapping[str, float]:
        """d ln P/d ln θ by name."""
        shares = self.norm.relative
        found = {name: -shares[name] / shares[LOAD] for name in shares if name != LOAD}
        return found | {STRENGTH: 1.0 / shares[LOAD]}

    def line(self) -> str:
        """What it is in one line."""
        first = sorted(self.relative.items(), key=lambda item: -abs(item[1]))[:4]
        listed = ", ".join(f"{name} {value:+.3g}" for name, value in first)
        return f"YieldLoad {show(self.load, 'N')} of {self.norm.output.name}, d ln P/d ln θ: {listed}"


def yield_load(
    result: ContactResult,
    stress: StressNorm,
    to: str | Iterable[str] = "all",
    *,
    strength: float | None = None,
    engine: Engine | None = None,
) -> YieldLoad:
    """Load at which a layer begins to yield, and its derivatives, from solves at a few loads.

    The largest stress on the planes of ``stress`` reaches the strength; its derivatives are those
    of the norm, which has them where the largest value has a kink.

    Parameters
    ----------
    result
        A contact to begin with, as for ``sensitivities``.
    stress
        Planes and layer; they must hold the place of first yield. Its exponent m should be 100 and
        more: the derivatives err by about 3/m.
    to
        Parameters, as for ``sensitivities``; the load is among them in any case.
    strength
        Y in Pa; by default that of the material of the layer (``VonMises``).
    engine
        Machine to compute on.

    Raises
    ------
    InputError
        If the strength is not known, or as of ``sensitivities``.
    NoSolutionError
        If no load is found.
    """
    require_differentiable(result)
    if strength is None:
        strength = _known_strength(result.problem, stress)
    require.positive(strength, "strength for a load at yield (Pa)")
    found, count = at_yield(result.problem, result.mean_pressure, stress, strength, engine)
    asked = (to,) if isinstance(to, str) else tuple(to)
    names = to if to == "all" else tuple(dict.fromkeys((*asked, LOAD)))
    norm = at_one_load(found, stress, names, held="load", engine=engine)
    slope = float(norm.values[LOAD]) * strength / norm.value
    return YieldLoad(found.force, strength, found, norm, {**norm.of_load, STRENGTH: 1.0 / slope}, count)


def _known_strength(problem: ContactProblem, stress: StressNorm) -> float:
    """Strength in Pa of the material of the layer, or an InputError where it is not known."""
    strength = VonMises().limit(stress.within(getattr(problem, stress.of))[0].region.material).value
    if math.isnan(strength):
        raise InputError(
            f"strength of layer {stress.layer} must be known for its load at yield, but is not. Give "
            "strength=..., or {yield_stress}."
        )
    return strength


def at_yield(
    problem: ContactProblem, pressure: float, stress: StressNorm, strength: float, engine: Engine | None = None
) -> tuple[ContactResult, int]:
    """Contact in which the largest stress on the planes is the ``strength``, from a mean
    ``pressure`` on, and the number of loads that it took.

    Raises
    ------
    NoSolutionError
        If no load is found.
    """
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
    power, before = 3.0, (math.nan, math.nan)
    for count in range(1, MOST + 1):
        found = solve(
            problem, MeanPressure(pressure), solver=ActiveSet(tolerance=AGAIN), operator=operator, on_failure="return"
        )
        miss = math.log(strength / stress.largest(posed(found, operator)))
        if abs(miss) <= ENOUGH:
            return found, count
        at = math.log(pressure)
        if count > 1 and at != before[0] and miss != before[1]:
            # the largest stress grows with the load, by some power between 1/20 and 2
            power = min(20.0, max(0.5, -(at - before[0]) / (miss - before[1])))
        before = at, miss
        pressure = math.exp(at + max(-3.0, min(3.0, power * miss)))
    raise NoSolutionError(
        f"no load at yield was found in {MOST} loads; the largest stress is {math.exp(-miss):.4g} of the strength.",
        subject="load at yield",
    )


@dataclass(frozen=True)
class FirstYield:
    """Load at which a layer begins to yield over the load of the contact: its load factor, for
    ``sensitivities`` and ``uncertainty``, whose parameters are then also ``"strength"``.

    Parameters
    ----------
    stress
        Planes and layer, as for ``yield_load``.
    strength
        Y in Pa; by default that of the material of the layer.
    """

    stress: StressNorm
    strength: float | None = None
    name: str = "load factor of first yield"
    unit: str = "1"
    degree: float | None = 0.0

    def at(self, state: State) -> Slopes:
        """Refused: it takes several loads."""
        raise InputError(
            f"output must be one of a single load, but is the {self.name}. Take sensitivities(result, ...)."
        )

    def factor(self, problem: ContactProblem, force: float, strength: float, guess: float) -> float:
        """Load factor of ``problem`` under a ``force`` in N with a ``strength`` in Pa, sought from
        the factor ``guess`` on."""
        found, _ = at_yield(problem, guess * force / problem.grid.area, self.stress, strength)
        return found.force / force


def yield_factor(
    result: ContactResult, wanted: FirstYield, to: str | Iterable[str] = "all", *, engine: Engine | None = None
) -> Sensitivities:
    """Derivatives of the load factor of first yield, the load being held; errors as of
    ``yield_load``."""
    asked = (to,) if isinstance(to, str) else tuple(to)
    others = "all" if "all" in asked else tuple(name for name in asked if name != STRENGTH)
    found, force = yield_load(result, wanted.stress, others, strength=wanted.strength, engine=engine), result.force
    factor = found.load / force
    values = {name: value / force for name, value in found.values.items()} | {LOAD: -factor / force}
    given = {**found.norm.parameters, STRENGTH: found.strength, LOAD: force}
    units = {**found.norm.units, STRENGTH: "Pa"}
    if "all" not in asked:
        values = {name: values[name] for name in asked}

    def again(name: str, step: float) -> tuple[float, int]:
        problem = result.problem if name == STRENGTH else stepped_problem(result.problem, name, step)
        strength = found.strength * (1.0 + step if name == STRENGTH else 1.0)
        load = force * (1.0 + step if name == LOAD else 1.0)
        return wanted.factor(problem, load, strength, factor), 0

    certificate = found.norm.certificate
    return Sensitivities(result.problem, wanted, factor, "load", values, given, units, certificate, again)
