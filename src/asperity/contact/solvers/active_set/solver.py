"""Inexact active set with preconditioned conjugate gradients on nested grids: the fast solver."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, Self

import numpy as np

from ....core import require
from ....core.arrays import RealArray
from ....core.engine import Face, Load, Survey, Totals
from ..protocol import ContactQP, FixedMean, FixedOffset, SolverState, feasible_start, require_settings
from ..reference.steepest_descent import descend, levelling_step
from .cells import COARSEST, nested_start
from .linear_system import Beside, Change, Effort, System, Workspace, correction, workspace

# How the pressure follows a correction: freely for the time being, or clipped to its bounds at once.


LEAST_SHARE = 0.1
"""Share of a clipped step that is worth taking."""

_LOAD_SWEEPS = 100
_LOAD_ROUNDING = 1e-14


def free_move(work: Workspace, face: Face, d: Any) -> tuple[int, float]:
    """Add ``d`` to the pressure as it is; the number of points that pull then, and the sum (Pa) of how much.

    They leave the working set with the next step, for which ``brought_back`` must clear them.
    """
    return face.shift(work.pressure, d, work.unit)


def brought_back(work: Workspace, face: Face, total: float) -> Change:
    """Clear the points of the ``face`` that pull and scale the others, of the sum ``total``, to the load; the change."""
    constraint, factor = work.qp.constraint, 1.0
    if isinstance(constraint, FixedMean) and total > 0.0:
        factor = constraint.mean_pressure * work.qp.profile.size / total
    return Change(face, face.press(work.pressure, factor, work.unit))


def bounded_move(work: Workspace, face: Face, d: Any, r: Any, total: float) -> tuple[int, float]:
    """Add ``d``, clipped and scaled to the load, to the pressure of sum ``total``: points clipped, share of the step taken.

    The deflection by the whole step is left in the response of the bench. The energy falls: it changes by
    -r·step + step·K step / 2, ``r`` being the residual on the ``face``, and the step is shortened to its minimum.
    """
    qp, tools, p = work.qp, work.bench, work.pressure
    old, load = face.pick(p)
    found, clipped = face.move(p, d, work.unit, work.cap)
    if isinstance(qp.constraint, FixedMean):
        missing = qp.constraint.mean_pressure * qp.profile.size - total
        _restore_load(face, p, work.cap, found, max(load + missing, 0.0))
    change, along = face.lay_change(old, p, r, tools.field)
    tools.fast.apply(tools.field, tools.response)
    reaction = face.gather(tools.response, change, change, d).first
    share = _share(-along * qp.height_scale, reaction * tools.scale)
    if share < 1.0:
        share = share if share >= LEAST_SHARE else 0.0
        face.blend(old, share, p)
    return clipped, share


def _share(slope: float, curvature: float) -> float:
    """How far to go along a step of this ``slope`` and ``curvature`` of the energy: all the way, or to its minimum."""
    if slope + 0.5 * curvature <= 0.0:
        return 1.0
    return -slope / curvature if slope < 0.0 else 0.0


def _restore_load(face: Face, pressure: Any, cap: Any, found: Load, target: float) -> None:
    """Scale the clipped ``pressure`` on the ``face`` (in place), where its sums are ``found``, to the sum ``target``.

    Where every loaded point is at its cap, the rest of the load is spread over the points below it.
    """
    for _ in range(_LOAD_SWEEPS):
        missing = target - found.pressure
        if abs(missing) <= _LOAD_ROUNDING * target:
            break
        if found.movable > 0.0 and found.movable + missing > 0.0:
            found = face.scale(pressure, (found.movable + missing) / found.movable, 0.0, cap)
        elif missing < 0.0:
            found = face.scale(pressure, target / found.pressure, 0.0, None)
        else:
            found = face.scale(pressure, 1.0, missing / found.below, cap)


_COARSE_ITERATIONS = 30
_POOR = 0.5
_UNSETTLED_STEPS = 3
_SETTLED_STEPS = 14
_SETTLING_STEPS = 8
_REDUCTION = 0.3
_SETTLING_REDUCTION = 0.1
_SMALLEST_REDUCTION = 1e-4
_MARGIN = 0.8
_FEW = 0.003
_IDLE = 2
_MOST_SETBACKS = 4
_REFRESH = 1e-5
_ROUNDING = 4.0 * np.finfo(float).eps


@dataclass(eq=False)
class _Memory:
    """What is carried from step to step. A step takes the face out of it, whose vectors are long.

    Buffers; the iterate in them seen as a whole; the error when its deflection was last computed from scratch (as opposed
    to updated); how many points the last step took beyond their bounds; how many steps had to be replaced so far, each of
    which doubles the effort put into the next.

    Of free steps: how many in a row have not made the ``lowest`` error smaller, None where no step may be free any more;
    the ``face`` of the last, on which points may pull, and the sum of their pressures, as long as they do.
    """

    work: Workspace
    survey: Survey
    computed_at: float
    clipped: int
    setbacks: int = 0
    idle: int | None = None
    lowest: float = np.inf
    face: Face | None = None
    pull: float = 0.0


@dataclass(frozen=True)
class ActiveSet:
    """Newton's method on the contact set, each linear system solved loosely by preconditioned conjugate gradients.

    A step frees the points whose pressure may move, solves K p = h + level on them to a modest accuracy (preconditioner:
    the inverse of a compliance of nested cells), and clips the pressure to its bounds. Points enter the set by the mean
    level of the loaded points near them, so that it does not follow errors of long wavelength. The first guess comes
    from coarser grids. Corrections are computed in single precision, the gap they must close in double
    (``precision="mixed"``), so the answer has double precision at nearly the cost of single.

    Without a cap, points that pull after a step are cleared with the next, whose first product with the compliance serves
    both: a product less for every step. Three such free steps in a row that do not bring the error down end this. From
    then on, as with a cap or if ``monotone``, every iterate keeps its bounds and the energy never rises: a step that would
    raise it is shortened to the minimum on its way, or replaced by one along the projected gradient.

    Iterates share their arrays: a state is valid until the next step.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) at which to stop.
    max_iterations
        Largest number of steps.
    precision
        ``"mixed"``, ``"double"``, or ``"single"`` for everything in single precision: half the memory, for tolerances
        down to about 1e-5.
    monotone
        Whether every iterate has to keep its bounds and to be no higher in energy than the one before. The answer keeps
        its bounds in any case.
    """

    tolerance: float = 1e-7
    max_iterations: int = 300
    precision: Literal["mixed", "double", "single"] = "mixed"
    monotone: bool = False
    name: ClassVar[str] = "active_set"
    citation_keys: ClassVar[tuple[str, ...]] = ("Cole1992", "Polonsky1999")

    def __post_init__(self) -> None:
        require_settings(self)
        require.one_of(self.precision, ("mixed", "double", "single"), "precision of the solver active_set")

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``, or at the solution on coarser grids where there is no start or a worse one."""
        if start is not None and start.any():
            state = self._begun(qp, feasible_start(qp, start), 1, 0.0)
            if state.error <= _POOR or min(qp.profile.shape) <= COARSEST:
                return state
            begin, pairs = nested_start(qp, self)
            return self._begun(qp, begin, 2, pairs)
        begin, pairs = nested_start(qp, self)
        return self._begun(qp, begin, 1, pairs)

    def _begun(self, qp: ContactQP, begin: RealArray, applications: int, pairs: float) -> SolverState:
        """State at the feasible pressure ``begin``, with the work it has cost."""
        work = workspace(qp, self.precision, begin)
        survey = _survey(work)
        idle = None if self.monotone or work.cap is not None else 0
        memory = _Memory(work, survey, _relative_error(work, survey.totals), clipped=1, idle=idle)
        return self._state(memory, SolverState(begin, begin, np.inf, applications=applications, extra_pairs=pairs))

    def loosened(self, tolerance: float) -> Self:
        """Same solver for a first guess: to ``tolerance``, and not for long."""
        return replace(self, tolerance=tolerance, max_iterations=min(_COARSE_ITERATIONS, self.max_iterations))

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """One working set and its correction, in the arrays of ``state``."""
        memory = state.memory
        assert isinstance(memory, _Memory)
        face = memory.survey.face(_level(qp, memory.survey.totals), qp.height_scale, memory.work.bench.dtype)
        step = self._careful_step if memory.idle is None else self._free_step
        following, spent = step(_taken(memory), replace(state, iterations=state.iterations + 1), face)
        memory.work.engine.release(face, memory.work.bench.field)
        del face
        return self._state(following, spent)

    def _free_step(self, memory: _Memory, spent: SolverState, face: Face) -> tuple[_Memory, SolverState]:
        """Step after which points may pull.

        What clearing those of the step before deflects comes with the first product of this one, and each product is
        added to the deflection as it is found: nothing else needs a transform.
        """
        work, centred = memory.work, isinstance(memory.work.qp.constraint, FixedMean)
        effort, r = self._effort(memory, face, spent.error), face.residual(centred=centred)
        pending = None
        if memory.face is not None and memory.clipped:
            pending = brought_back(work, memory.face, memory.survey.totals.pressure)
            memory.face = None
        beside = Beside(pending, _following(work))
        found = correction(System(work.bench, face, centred), r, effort, beside)
        spent = replace(spent, extra_pairs=spent.extra_pairs + found.pairs)
        if found.d is None:
            return self._gradient_step(memory, spent)
        clipped, pull = free_move(work, face, found.d)
        return replace(memory, survey=_survey(work), clipped=clipped, face=face, pull=pull), spent

    def _careful_step(self, memory: _Memory, spent: SolverState, face: Face) -> tuple[_Memory, SolverState]:
        """Step clipped to the bounds and shortened where the energy would rise."""
        work, qp = memory.work, memory.work.qp
        tools, centred = work.bench, isinstance(qp.constraint, FixedMean)
        effort, r = self._effort(memory, face, spent.error), face.residual(centred=centred)
        d, pairs, _ = correction(System(tools, face, centred), face.copied(r), effort)
        spent = replace(spent, extra_pairs=spent.extra_pairs + pairs)
        if d is None:
            return self._gradient_step(memory, spent)
        clipped, share = bounded_move(work, face, d, r, memory.survey.totals.pressure)
        spent = replace(spent, applications=spent.applications + 1)
        if share < LEAST_SHARE:
            return self._gradient_step(memory, spent)
        work.engine.add(tools.response, share * tools.scale, work.deflection)
        return replace(memory, survey=_survey(work), clipped=clipped), spent

    def _gradient_step(self, memory: _Memory, spent: SolverState) -> tuple[_Memory, SolverState]:
        """Step along the projected gradient from the iterate in the buffers; exhausted if not even that goes down."""
        work = memory.work
        qp, engine = work.qp, work.engine
        _from_scratch(memory)
        pressure, deflection = engine.numpy(work.pressure).copy(), engine.numpy(work.deflection).copy()
        lower = descend(qp, replace(spent, pressure=pressure, deflection=deflection), levelling_step(qp))
        work.pressure[...] = engine.array(lower.pressure, work.dtype)
        work.exact.apply(work.pressure, work.deflection)
        spent = replace(spent, applications=lower.applications + 3, exhausted=lower.exhausted)
        return _Memory(work, _survey(work), memory.computed_at, clipped=1, setbacks=memory.setbacks + 1), spent

    def _state(self, memory: _Memory, spent: SolverState) -> SolverState:
        """State at the iterate of ``memory`` with the work ``spent``.

        Its error is ``optimality.relative_error``, with the share of the load that pulls added. Updates of the deflection
        leave the rounding of corrections in it. Once the error has fallen so far that this might show, at the end, and
        where no more steps are free, points that pull are cleared and the deflection is computed from scratch.
        """
        work = memory.work
        error = _relative_error(work, memory.survey.totals)
        if memory.pull:
            error += memory.pull / memory.survey.totals.pressure
        memory = _watched(memory, error)
        due = error <= self.tolerance or spent.iterations >= self.max_iterations
        due = due or error < _REFRESH * memory.computed_at or (memory.idle is None and memory.face is not None)
        if spent.iterations and due:
            _from_scratch(memory)
            memory = replace(memory, survey=_survey(work), pull=0.0)
            spent = replace(spent, applications=spent.applications + 1)
            error = _relative_error(work, memory.survey.totals)
            memory = replace(memory, computed_at=error)
        p, u = work.pressure, work.deflection
        return replace(spent, pressure=p, deflection=u, error=error, memory=memory, engine=work.engine)

    def _effort(self, memory: _Memory, face: Face, error: float) -> Effort:
        """When to stop a correction.

        Accuracy is wasted on a set that will change: only once few points enter or leave is it worth having, and only
        once none does is the system solved to what the tolerance asks for.
        """
        changed = face.entering + memory.clipped
        if changed > _FEW * face.size:
            return Effort(_REDUCTION, _UNSETTLED_STEPS << min(memory.setbacks, _MOST_SETBACKS))
        wanted = _MARGIN * self.tolerance / error if error > 0.0 else 1.0
        if changed:
            return Effort(min(_REDUCTION, max(wanted, _SETTLING_REDUCTION)), _SETTLING_STEPS)
        return Effort(min(_REDUCTION, max(wanted, _SMALLEST_REDUCTION)), _SETTLED_STEPS)


def _taken(memory: _Memory) -> _Memory:
    """``memory`` with its face, which it loses."""
    taken = replace(memory)
    memory.face = None
    return taken


def _from_scratch(memory: _Memory) -> None:
    """Clear points that pull, and compute the deflection anew instead of from its updates."""
    work = memory.work
    if memory.face is not None:
        brought_back(work, memory.face, memory.survey.totals.pressure)
    memory.face = None
    work.exact.apply(work.pressure, work.deflection)


def _following(work: Workspace) -> Callable[[float], None]:
    """Adds what every step of a correction deflects to the deflection of the iterate."""
    tools, factor = work.bench, work.qp.height_scale
    return lambda length: work.engine.add(tools.response, length * factor, work.deflection)


def _watched(memory: _Memory, error: float) -> _Memory:
    """``memory`` that knows the lowest error; no more steps are free once some in a row have not made it smaller."""
    if memory.idle is None:
        return memory
    if error < memory.lowest:
        return replace(memory, lowest=error, idle=0)
    return replace(memory, idle=memory.idle + 1 if memory.idle < _IDLE else None)


def _survey(work: Workspace) -> Survey:
    return work.engine.survey(work.pressure, work.deflection, work.heights, work.cap)


def _level(qp: ContactQP, totals: Totals) -> float:
    """Level of the contacting plane in the heights of the workspace, as in ``optimality.level``."""
    if isinstance(qp.constraint, FixedOffset):
        return 0.0
    if totals.weight > 0.0:
        return totals.weighted / totals.weight
    low = totals.highest_capped if np.isfinite(totals.highest_capped) else totals.lowest
    high = totals.lowest_open if np.isfinite(totals.lowest_open) else low
    return 0.5 * (low + high)


def _relative_error(work: Workspace, totals: Totals) -> float:
    qp = work.qp
    load = totals.pressure * qp.height_scale
    if isinstance(qp.constraint, FixedMean) and work.cap is None:
        lifted = totals.lowest * totals.pressure
        rounding = _ROUNDING * (abs(totals.work) + abs(lifted))  # the difference below is not known any better
        return max(totals.work - lifted, rounding) / load
    iterate = work.pressure, work.deflection, work.heights, work.cap
    found = work.engine.violation(*iterate, _level(qp, totals))
    if isinstance(qp.constraint, FixedMean):
        lowest = work.engine.violation(*iterate, totals.lowest)
        return min(found.above + found.below, lowest.above + lowest.below) / load
    weighted = found.above / totals.pressure if totals.pressure > 0.0 else 0.0
    return (weighted + found.deepest) / qp.height_scale
