"""Inexact active set with preconditioned conjugate gradients on nested grids: the fast solver."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.engine import Convolution, Engine, Face, Totals
from .feasible import feasible_start, scaled_to_load
from .nested import nested_start
from .protocol import ContactQP, FixedMean, FixedOffset, SolverState, require_settings
from .steepest_descent import descend, levelling_step

_COARSE_TOLERANCE = 1e-2
_COARSE_ITERATIONS = 30
_UNSTEADY_STEPS = 3
_STEADY_STEPS = 14
_REDUCTION = 0.25
_SMALLEST_REDUCTION = 1e-4
_STEADY = 1e-3
_ROUNDING = 1e-13


@dataclass(frozen=True, eq=False)
class _Workspace:
    """Prepared convolutions and buffers of one problem. Lengths are in m, the kernels over ``scale`` (m/Pa)."""

    engine: Engine
    heights: Any
    cap: Any
    double: Convolution
    fast: Convolution
    preconditioner: Convolution
    scale: float
    field: Any
    response: Any
    pressures: tuple[Any, Any]
    deflections: tuple[Any, Any]


@dataclass(frozen=True, eq=False)
class _Memory:
    """Where the iterate lies (``side`` of the buffers), its sums, and whether its working set has settled."""

    work: _Workspace
    side: int
    totals: Totals
    steady: bool


@dataclass(frozen=True)
class ActiveSet:
    """Newton's method on the contact set, each linear system solved loosely by preconditioned conjugate gradients.

    A step frees the points whose pressure may move, solves K p = h + level on them to a modest accuracy (FFT
    preconditioner: the inverse compliance restricted to the set), and clips the pressure to its bounds. The first guess
    comes from coarser grids. Corrections are computed in single precision, the gap they must close in double
    (``precision="mixed"``), so the answer has double precision at nearly the cost of single.

    The energy never rises: a step that would raise it is shortened to the minimum on its way, or replaced by one along
    the projected gradient. Buffers are reused: a state is valid until the step after next.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) at which to stop.
    max_iterations
        Largest number of steps.
    precision
        ``"mixed"`` or ``"double"``.
    """

    tolerance: float = 1e-7
    max_iterations: int = 300
    precision: Literal["mixed", "double"] = "mixed"
    name: ClassVar[str] = "active_set"
    citation_keys: ClassVar[tuple[str, ...]] = ("Cole1992", "Polonsky1999")

    def __post_init__(self) -> None:
        require_settings(self)
        require.one_of(self.precision, ("mixed", "double"), "precision of the solver active_set")

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``, or at the solution on coarser grids."""
        if start is None or not start.any():
            coarse = replace(self, tolerance=max(_COARSE_TOLERANCE, self.tolerance), max_iterations=_COARSE_ITERATIONS)
            begin, pairs = nested_start(qp, coarse)
        else:
            begin, pairs = feasible_start(qp, start), 0.0
        work = _workspace(qp, self.precision)
        work.engine.copy(work.engine.array(begin, "float64"), work.pressures[0])
        work.double.apply(work.pressures[0], work.deflections[0])
        totals = work.engine.totals(work.pressures[0], work.deflections[0], work.heights, work.cap)
        state = _state(qp, _Memory(work, 0, totals, steady=False))
        return replace(state, applications=1, extra_pairs=pairs)

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """One working set, its correction, and the clipped pressure."""
        memory = state.memory
        assert isinstance(memory, _Memory)
        work, here, there = memory.work, memory.side, 1 - memory.side
        engine, p, u = work.engine, work.pressures[here], work.deflections[here]
        level = _level(qp, memory.totals)
        face = engine.face(p, u, work.heights, work.cap, level, qp.height_scale, work.field)
        correction, steps = _correction(qp, work, face, *self._reduction(memory, state.error))
        q, v = work.pressures[there], work.deflections[there]
        change, clipped = face.pressure(p, correction, qp.height_scale / work.scale, work.cap, q)
        engine.release(face, work.field)
        _restore_load(qp, work, q, memory.totals.pressure + change)
        work.double.apply(q, v)
        totals = engine.totals(q, v, work.heights, work.cap)
        steady = clipped + face.entering <= _STEADY * face.size
        totals, descended = _monotone(memory, there, totals)
        spent = replace(
            state,
            iterations=state.iterations + 1,
            applications=state.applications + 1,
            extra_pairs=state.extra_pairs + steps * (1.0 + qp.operator.pairs_per_application),
        )
        if not descended:
            return _gradient_step(qp, memory, spent)
        new = _state(qp, _Memory(work, there, totals, steady))
        return replace(new, iterations=spent.iterations, applications=spent.applications, extra_pairs=spent.extra_pairs)

    def _reduction(self, memory: _Memory, error: float) -> tuple[float, int]:
        """Relative residual at which to stop a correction, and the largest number of its steps."""
        if not memory.steady:
            return _REDUCTION, _UNSTEADY_STEPS
        wanted = 0.2 * self.tolerance / error if error > 0.0 else 1.0
        return min(_REDUCTION, max(wanted, _SMALLEST_REDUCTION)), _STEADY_STEPS


def _workspace(qp: ContactQP, precision: str) -> _Workspace:
    operator, engine, shape = qp.operator, qp.operator.engine, qp.operator.grid.shape
    dtype = "float64" if precision == "double" else "float32"
    kernel = operator.kernel
    scale = float(np.abs(kernel).max()) or 1.0
    datum = -qp.constraint.offset if isinstance(qp.constraint, FixedOffset) else 0.0
    heights = qp.profile + datum if datum else qp.profile - qp.profile.mean()
    return _Workspace(
        engine=engine,
        heights=engine.array(heights, "float64"),
        cap=None if qp.elastic else engine.array(np.asarray(qp.cap, dtype=float).reshape(-1), "float64"),
        double=operator.convolution("float64"),
        fast=operator.convolution(dtype, scale),
        preconditioner=operator.preconditioner(dtype, scale),
        scale=scale,
        field=engine.zeros(shape, dtype),
        response=engine.zeros(shape, dtype),
        pressures=(engine.zeros(shape, "float64"), engine.zeros(shape, "float64")),
        deflections=(engine.zeros(shape, "float64"), engine.zeros(shape, "float64")),
    )


def _correction(qp: ContactQP, work: _Workspace, face: Face, reduction: float, limit: int) -> tuple[Any, int]:
    """Vector d with K d = residual on ``face``, d summing to zero under load; conjugate gradient steps taken."""
    centred = isinstance(qp.constraint, FixedMean)
    r, d, t = face.residual(centred=centred), face.zeros(), face.zeros()
    first = previous = 0.0
    for step in range(limit):
        work.preconditioner.solve(work.field, work.response)
        z, (total, product) = face.gather(work.response, r)
        mean = total / face.size if centred else 0.0
        if product <= 0.0 or (step and product < reduction**2 * first):
            return d, step
        t = face.direct(z, mean, product / previous if step else 0.0, t)
        first, previous = first or product, product
        work.fast.apply(work.field, work.response)
        kt, (total, curvature) = face.gather(work.response, t)
        if curvature <= 0.0:
            return d, step
        d, r = face.advance(product / curvature, t, kt, total / face.size if centred else 0.0, d, r)
    return d, limit


def _restore_load(qp: ContactQP, work: _Workspace, pressure: Any, total: float) -> None:
    """Scale the clipped ``pressure`` (in place) back to the prescribed load."""
    if not isinstance(qp.constraint, FixedMean):
        return
    if work.cap is None:
        if total > 0.0:
            work.engine.rescale(pressure, qp.constraint.mean_pressure * qp.profile.size / total)
        return
    scaled = scaled_to_load(work.engine.numpy(pressure), qp.cap, qp.constraint.mean_pressure)
    work.engine.copy(work.engine.array(scaled, "float64"), pressure)


def _level(qp: ContactQP, totals: Totals) -> float:
    """Level of the contacting plane in the heights of the workspace, as in ``optimality.level``."""
    if isinstance(qp.constraint, FixedOffset):
        return 0.0
    if totals.weight > 0.0:
        return totals.weighted / totals.weight
    low = totals.highest_capped if np.isfinite(totals.highest_capped) else totals.lowest
    high = totals.lowest_open if np.isfinite(totals.lowest_open) else low
    return 0.5 * (low + high)


def _energy(totals: Totals) -> float:
    """p·Kp/2 - p·h from p·(Kp - h) and p·h."""
    return 0.5 * (totals.work - totals.height)


def _monotone(memory: _Memory, there: int, totals: Totals) -> tuple[Totals, bool]:
    """Shorten the step just taken so that the energy does not rise; whether that was possible."""
    before = _energy(memory.totals)
    if _energy(totals) <= before + _ROUNDING * abs(before):
        return totals, True
    work = memory.work
    p, q = work.pressures[memory.side], work.pressures[there]
    u, v = work.deflections[memory.side], work.deflections[there]
    slope, curvature = work.engine.segment(p, q, u, v, work.heights)
    if slope >= 0.0 or curvature <= 0.0:
        return totals, False
    share = min(1.0, -slope / curvature)
    work.engine.blend(p, q, share)
    work.engine.blend(u, v, share)
    return work.engine.totals(q, v, work.heights, work.cap), True


def _gradient_step(qp: ContactQP, memory: _Memory, spent: SolverState) -> SolverState:
    """Step along the projected gradient from the last good iterate; exhausted if not even that lowers the energy."""
    work, there = memory.work, 1 - memory.side
    pressure = work.engine.numpy(work.pressures[memory.side]).copy()
    deflection = work.engine.numpy(work.deflections[memory.side]).copy()
    here = replace(spent, pressure=pressure, deflection=deflection)
    lower = descend(qp, here, levelling_step(qp))
    work.engine.copy(work.engine.array(lower.pressure, "float64"), work.pressures[there])
    work.engine.copy(work.engine.array(lower.deflection, "float64"), work.deflections[there])
    totals = work.engine.totals(work.pressures[there], work.deflections[there], work.heights, work.cap)
    new = _state(qp, _Memory(work, there, totals, steady=False))
    return replace(
        new,
        iterations=spent.iterations,
        applications=lower.applications + 1,
        extra_pairs=spent.extra_pairs,
        exhausted=lower.exhausted,
    )


def _state(qp: ContactQP, memory: _Memory) -> SolverState:
    """State with its error, which equals ``optimality.relative_error`` of its fields."""
    work = memory.work
    p, u = work.pressures[memory.side], work.deflections[memory.side]
    error = _relative_error(qp, work, p, u, memory.totals)
    return SolverState(work.engine.numpy(p), work.engine.numpy(u), error, memory=memory)


def _relative_error(qp: ContactQP, work: _Workspace, p: Any, u: Any, totals: Totals) -> float:
    if isinstance(qp.constraint, FixedMean) and work.cap is None:
        return (totals.work - totals.lowest * totals.pressure) / (totals.pressure * qp.height_scale)
    found = work.engine.violation(p, u, work.heights, work.cap, _level(qp, totals))
    if isinstance(qp.constraint, FixedMean):
        return (found.above + found.below) / (totals.pressure * qp.height_scale)
    weighted = found.above / totals.pressure if totals.pressure > 0.0 else 0.0
    return (weighted + found.deepest) / qp.height_scale
