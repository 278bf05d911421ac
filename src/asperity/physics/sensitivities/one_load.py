"""Derivatives of one number of a solved contact, by one linear solve on its set."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ...contact.controls import Approach, Control, Force, MeanPressure, mean_pressure
from ...contact.law import Hardness, HardWall
from ...contact.operators import Operator, prepare_operator
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import solve
from ...contact.solvers.active_set.solver import ActiveSet
from ...core import require
from ...core.arrays import RealArray
from ...core.engine import Engine
from ...core.errors import InputError
from ...solids.layers import relaxes
from .answer import Sensitivities, SensitivityCertificate
from .outputs import Output, Slopes, State
from .parameters import APPROACH, HARDNESS, HEIGHTS, LOAD, changed, chosen, parameters, responses
from .system import POLISHED, RESIDUAL, FixedSet, Held, Polished, Solved, polished

AGAIN = 1e-9
"""Tolerance of the solves of a Taylor test."""


def at_one_load(
    result: ContactResult,
    wanted: Output,
    to: str | Iterable[str] = "all",
    *,
    held: Held | None = None,
    tolerance: float = RESIDUAL,
    engine: Engine | None = None,
) -> Sensitivities:
    """Derivatives of the output ``wanted``, as of ``sensitivities``.

    Raises
    ------
    InputError
        If a parameter is none of the contact, or the contact has no derivatives.
    ConvergenceError
        If a linear solve does not converge.
    """
    require_differentiable(result)
    problem = result.problem
    require.positive(tolerance, "tolerance of sensitivities")
    held = _held(result, held)
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
    known = parameters(problem)
    capped = isinstance(problem.law, Hardness)
    last = LOAD if held == "load" else APPROACH
    names = chosen(to, [HEIGHTS, last, *([HARDNESS] if capped else []), *(each.name for each in known)])
    found = _Adjoint.of(result, operator, wanted, held, tolerance)
    values, given, units = dict[str, float | RealArray](), dict[str, float | RealArray](), dict[str, str]()
    bodies = [each for each in known if each.name in names]
    of_bodies = dict(responses(operator, bodies, found.weight, found.state.pressure)) if bodies else {}
    if found.slopes.direct is not None:
        for name, part in found.slopes.direct(bodies).items():
            of_bodies[name] += part
    by_name = {each.name: each for each in known}
    for name in names:
        if name in of_bodies:
            values[name], given[name], units[name] = of_bodies[name], by_name[name].value, by_name[name].unit
        elif name == HEIGHTS:
            values[name], given[name], units[name] = found.heights, float(found.state.profile.std()), "m"
        elif name == HARDNESS:
            cap = problem.law.pressure_cap()
            slope = found.hardness
            values[name] = slope if isinstance(cap, np.ndarray) else float(slope.sum())
            given[name], units[name] = cap, "Pa"
        else:
            values[name] = found.of_load if held == "load" else found.of_approach
            force = float(found.state.pressure.sum()) * problem.grid.pixel_area
            approach = float(found.state.profile.max()) - found.state.offset
            given[name], units[name] = (force, "N") if held == "load" else (approach, "m")
    again = _Again(problem, found, wanted, held, engine)
    return Sensitivities(problem, wanted, found.slopes.value, held, values, given, units, found.certificate, again)


def require_differentiable(result: ContactResult) -> None:
    """Refuse contacts that have no derivatives here, with an ``InputError``."""
    if not isinstance(result, ContactResult):
        raise InputError(
            f"result of sensitivities must be a ContactResult, but is a {type(result).__name__}. Take a step of a "
            "history."
        )
    require_pressure_alone(result.problem)
    if any(found is not None for found in result.couplings.values()):
        raise InputError(f"{MUST} {', '.join(result.couplings)}. Leave it out.")
    if result.total_plastic_work > result.plastic_work:
        raise InputError(
            "contact of sensitivities must be one load on the virgin surface, but was indented before: its answer "
            "depends on the path. Solve it in one step."
        )
    if not result.contact.any():
        raise InputError("contact of sensitivities must bear a load, but does not touch. Take another load ({load}).")


MUST = "contact of sensitivities must be one under pressure alone, but has"


def require_pressure_alone(problem: ContactProblem) -> None:
    """Refuse a ``problem`` whose contacts have no derivatives here, with an ``InputError``."""
    if problem.physics:
        names = ", ".join(each.keyword.replace("_", " ") or "another physics" for each in problem.physics)
        raise InputError(f"{MUST} {names}. Leave it out.")
    if relaxes(problem.body) or relaxes(problem.counter_body):
        raise InputError(
            "bodies of sensitivities must be elastic, but one is viscoelastic, whose answer depends on the past. Take "
            "elastic bodies of the moduli at the time that matters."
        )
    if not isinstance(problem.law, HardWall | Hardness):
        raise InputError(
            f"law of sensitivities must be HardWall() or Hardness(value), but is {type(problem.law).__name__}, whose "
            "limit changes with the indentation. Take {hardness}."
        )


def _held(result: ContactResult, held: Held | None) -> Held:
    if held is not None:
        require.one_of(held, ("load", "approach"), "held of sensitivities")
        return held
    if isinstance(result.control, MeanPressure | Force):
        return "load"
    if isinstance(result.control, Approach):
        return "approach"
    raise InputError(
        f"held of sensitivities must be load or approach where the control is a {result.control.name}, but is None."
    )


def posed(result: ContactResult, operator: Operator) -> State:
    """State of ``result``, as its solver left it."""
    profile, capped = result.problem.profile(), np.asarray(result.plastic)
    pressure = np.asarray(result.pressure, dtype=float)
    offset = result.offset
    if isinstance(result.control, Approach):
        offset = float(profile.max()) - result.control.value
    known = None if result.deflections is None else result.deflections.by(result.pressure, operator)
    deflection = operator.apply(pressure) if known is None else known
    return State(result.problem, operator, pressure, deflection, profile, offset, result.contact & ~capped, capped)


@dataclass(frozen=True, eq=False)
class _Adjoint:
    """Adjoint solution of one output of a contact."""

    held: Held
    polished: Polished
    slopes: Slopes
    solved: Solved

    @classmethod
    def of(cls, result: ContactResult, operator: Operator, wanted: Output, held: Held, tolerance: float) -> _Adjoint:
        begun = posed(result, operator)
        fixed, total = FixedSet(operator, begun.free, held), None
        if held == "load":
            total = float(begun.pressure.sum())
            if isinstance(result.control, MeanPressure | Force):
                total = mean_pressure(result.control, operator.grid) * begun.pressure.size
        now = polished(begun, fixed, total, max(POLISHED, 0.1 * tolerance))
        slopes = wanted.at(now.state)
        if held == "load" and slopes.given_load is not None:
            solved = Solved(np.zeros(begun.pressure.shape), slopes.given_load, 0.0, 0.0)
        else:
            solved = fixed.solve(slopes.pressure, slopes.offset if held == "load" else 0.0, tolerance)
        return cls(held, now, slopes, solved)

    @property
    def state(self) -> State:
        return self.polished.state

    @property
    def weight(self) -> RealArray:
        """What dK p is multiplied with: the output's own deflection less the adjoint solution."""
        weight = -self.solved.values
        return weight if self.slopes.deflected is None else weight + self.slopes.deflected

    @property
    def of_load(self) -> float:
        """dJ/dP, per N."""
        return self.solved.multiplier / self.state.operator.grid.pixel_area

    @property
    def of_approach(self) -> float:
        """dJ/d(approach) at held approach: the position falls by as much."""
        return float(self.solved.values.sum()) - self.slopes.offset

    @property
    def heights(self) -> RealArray:
        """dJ/dh, (nx, ny); the highest point carries the zero of the approach with it."""
        found = self.solved.values if self.slopes.heights is None else self.solved.values + self.slopes.heights
        if self.held == "approach":
            found = found.copy()
            found.flat[int(np.argmax(self.state.profile))] -= self.of_approach
        return found

    @property
    def hardness(self) -> RealArray:
        """dJ/dH of each point, (nx, ny), zero where the pressure is below it."""
        state = self.state
        if not state.capped.any():
            return np.zeros(state.capped.shape)
        slope = self.slopes.pressure - self.solved.multiplier
        if self.solved.values.any():
            slope = slope - state.operator.apply(self.solved.values)
        return np.where(state.capped, slope, 0.0)

    @property
    def certificate(self) -> SensitivityCertificate:
        now, solved = self.polished, self.solved
        residual = np.where(now.state.free, -now.before.gap, 0.0)
        lack = float(now.state.pressure.sum() - now.before.pressure.sum()) if self.held == "load" else 0.0
        error = float((solved.values * residual).sum()) + solved.multiplier * lack
        return SensitivityCertificate(
            adjoint_residual=solved.residual,
            state_error=now.error,
            output_error=error,
            changed=now.changed,
            fft_pairs=now.pairs + solved.pairs + now.state.operator.pairs_per_application,
        )


@dataclass(frozen=True, eq=False)
class _Again:
    """Solves the contact with one parameter changed."""

    problem: ContactProblem
    found: _Adjoint
    output: Output
    held: Held
    engine: Engine | None

    def __call__(self, name: str, step: float) -> tuple[float, int]:
        """Output with the parameter of that ``name`` changed by the relative ``step``, and the
        number of points that change their state."""
        state, problem = self.found.state, self.problem
        grid, factor = problem.grid, 1.0 + step
        if self.held == "load":
            held = float(state.pressure.mean()) * (factor if name == LOAD else 1.0)
            control: Control = MeanPressure(held)
        else:
            held = float(state.profile.max()) - state.offset
            control = Approach(held * (factor if name == APPROACH else 1.0))
        problem = stepped_problem(problem, name, step)
        operator = prepare_operator(problem.compliance, grid, problem.boundary, engine=self.engine)
        result = solve(problem, control, solver=ActiveSet(tolerance=AGAIN), operator=operator, on_failure="return")
        begun = posed(result, operator)
        fixed = FixedSet(operator, begun.free, self.held)
        total = float(result.control.value) * grid.n_points if self.held == "load" else None
        now = polished(begun, fixed, total).state
        turned = (now.free != state.free) | (now.capped != state.capped)
        return self.output.at(now).value, int(turned.sum())


def stepped_problem(problem: ContactProblem, name: str, step: float) -> ContactProblem:
    """``problem`` with the parameter of that ``name`` changed by a relative ``step``; the same for
    load and approach."""
    if name == HEIGHTS:
        return changed(problem, name, step * problem.profile())
    if name == HARDNESS:
        return changed(problem, name, np.asarray(problem.law.pressure_cap()) * (1.0 + step))
    if name in (LOAD, APPROACH):
        return problem
    value = next(each.value for each in parameters(problem) if each.name == name)
    return changed(problem, name, value * (1.0 + step))
