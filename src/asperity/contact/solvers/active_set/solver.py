"""Inexact active set with preconditioned conjugate gradients on nested grids: the fast solver.

Read it beside docs/theory/contact.md: numbers in parentheses, such as (4), are the steps of the algorithm there.

The constants are not delicate. Behind each stand FFT pairs for other values, by ``benchmarks/constants.py``: means over
self-affine surfaces of two seeds, tolerance 1e-6. *Elastic*: half-space, 512², loads 0.01, 0.05, 0.2 E*; *film*: E 10, h 4 and
20 pixels, 512²; *free*: free boundary, 256²; *cap*: hardness 0.3 E*, 256²; *tight*: elastic, 256², tolerance 1e-10; *monotone*:
elastic, 256², every iterate within its bounds. The constants as they are take 12.9, 20.5, 41.1, 15.6, 23.7 and 20.1 pairs. All figures
but those of ``_REDUCTION`` (13.6, 21.3, 42.8, 15.6, 22.8, 20.6 then) and of coarse grids date from when they took 13.9, 22.8, 43.8, 16.0,
23.2 and 20.5: before loose corrections ended by the plain norm of the residual, and coarse solves without their last product.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, NamedTuple, Protocol

import numpy as np

from ....core import require
from ....core.arrays import RealArray
from ....core.engine import CpuEngine, FreeSet, Load, Survey, Totals
from ....core.errors import InputError
from ...operators.convolution import restricted
from ..protocol import (
    LOAD_ROUNDING,
    LOAD_SWEEPS,
    ContactQP,
    FixedMean,
    FixedOffset,
    Solver,
    SolverState,
    feasible_start,
    multiplier,
    require_settings,
    run,
    scaled_error,
)
from ..reference.steepest_descent import descend, levelling_step
from .entering import free_set
from .linear_system import LinearSystem, PressureChange, Stopping, Workspace, conjugate_gradients, pixel_compliance

# Plane level and error of an iterate.


_ROUNDING = 4.0 * np.finfo(float).eps
"""Rounding of the sums in the error, relative to their terms: an error below it is reported as this large."""


def plane_level(qp: ContactQP, totals: Totals) -> float:
    """Plane level (the multiplier) in the heights of the workspace, as ``protocol.level``."""
    return 0.0 if isinstance(qp.constraint, FixedOffset) else multiplier(totals)


def relative_error(work: Workspace, totals: Totals) -> float:
    """``protocol.relative_error`` from the sums over the iterate."""
    qp, total, energy = work.qp, totals.pressure, 0.5 * totals.deflected
    if work.load_prescribed and work.cap is None:
        lifted = totals.lowest * total
        rounding = _ROUNDING * (abs(totals.work) + abs(lifted))  # the difference below is not known any better
        return scaled_error(qp, max(totals.work - lifted, rounding) / total, total, energy)
    iterate, level = (work.pressure, work.deflection, work.heights, work.cap), plane_level(qp, totals)
    found = work.engine.violation(*iterate, level)
    if work.load_prescribed:
        lowest = work.engine.violation(*iterate, totals.lowest)
        gap = min(found.above + found.below, lowest.above + lowest.below)
        return scaled_error(qp, gap / total, total, energy)
    weighted = found.above / total if total > 0.0 else 0.0
    return scaled_error(qp, weighted + found.deepest, total, energy)


# (2) How accurately a linear system is solved.


_SETTLED = 0.003
"""Points entering or beyond their bounds, over the free set, below which the set counts as nearly settled. Pairs for 0, 0.001,
0.01, 0.03: elastic 14.1, 13.9, 13.9, 13.9; film 22.8, 22.0, 23.0, 22.5; monotone 20.5, 20.0, 20.8, 20.8."""

_REDUCTION = 0.3
"""Reduction of the residual while the set changes; conjugate gradients gain a factor of 4 a step, so mostly one step. Pairs for
0.2, 0.4, 0.5 (0.3: 13.6, 21.3, 42.8, 15.6): elastic 14.1, 14.2, 14.3; film 22.8, 20.9, 20.7; free 42.8, 43.6, 42.5; cap 15.6, 17.1, 17.1."""

_UNSETTLED_STEPS = 3
"""Most steps while the set changes, doubled with every fallback. Pairs for 2, 4, 6: film 21.7, 22.9, 22.9, all others the same;
two would do on these surfaces, the third is for harder ones."""

_MOST_DOUBLINGS = 4
"""Doublings of the steps at most: 48 steps then, more than a system ever took to be solved (30). No case here needs one."""

_NEARLY_SETTLED = Stopping(reduction=0.1, max_steps=8)
"""Effort on a nearly settled set. Pairs for a reduction of 0.03, 0.2, 0.3: elastic 14.7, 13.9, 14.1; film 23.0, 23.4, 22.8; for
3, 5, 12 steps the same but for films (22.7, 22.8, 22.8)."""

_SETTLED_SET = Stopping(reduction=1e-4, max_steps=14)
"""Effort at most on a set that did not change; more than single precision holds is wasted. Pairs for a reduction of 1e-6, 1e-3,
1e-2: tight 24.4, 22.4, 22.2, all others the same; for 8, 20, 40 steps the same."""

_MARGIN = 0.8
"""Share of the tolerance aimed at, since the error follows the residual only nearly. Pairs for 0.3, 0.5, 1: elastic 14.6, 14.6,
13.9; film 23.0, 23.0, 22.5; tight 23.4, 23.4, 23.2."""


# (3) How the pressure takes up a correction.


LEAST_SHARE = 0.1
"""Share of a clipped step below which it is replaced by one along the projected gradient: what little would be left of it shows
that the set was wrong. No case of the sweep gets there (0.01 to 0.3: the same pairs); random small problems with caps do."""

_PARTS = 4
"""Parts of a step at most that are clipped, one product each, before it is shortened. Bending films show what it is for: moduli of
100 and 1000, 2 pixels thick, white noise of 24² and 64² points under caps of 1.01, 2 and 10 mean pressures take 170 pairs on
average; with one part they took 1770, and 9 of 24 did not converge in 300 steps. Two to eight parts differ by 1 %. No case of
the sweep needs a second one."""


class _Clipping(NamedTuple):
    """Number of points ``clipped`` by a step, the ``share`` of the step that was taken, and the ``products`` it needed."""

    clipped: int
    share: float
    products: int


def clear_tension(work: Workspace, free: FreeSet, total: float) -> PressureChange:
    """Clear the tensile points of ``free`` and scale the others, of the sum ``total``, to the load; the change."""
    constraint, factor = work.qp.constraint, 1.0
    if isinstance(constraint, FixedMean) and total > 0.0:
        factor = constraint.mean_pressure * work.qp.profile.size / total
    return PressureChange(free, free.clear_tension(work.pressure, factor, work.unit))


def clipped_update(work: Workspace, free: FreeSet, d: Any, r: Any, total: float) -> _Clipping:
    """Add ``d``, clipped and scaled to the load, to the pressure of sum ``total``.

    The deflection by the whole step is left in the response of the scaled operator. The energy falls: it changes by
    -r·step + step·K step / 2, ``r`` being the residual on the set. Where it would rise, a part of d is clipped instead, so
    that points still reach their bounds; after some attempts the step is shortened to its minimum.
    """
    qp, scaled, p = work.qp, work.scaled, work.pressure
    old, load = free.gather(p)
    part, products = 1.0, 0
    while True:
        found, clipped = free.add_clipped(p, d, part * work.unit, work.cap)
        if isinstance(qp.constraint, FixedMean):
            missing = qp.constraint.mean_pressure * qp.profile.size - total
            _restore_load(free, p, work.cap, found, max(load + missing, 0.0))
        change, along = free.scatter_change(old, p, r, scaled.field)
        scaled.product.apply(scaled.field, scaled.response)
        products += 1
        reaction = free.gather_products(scaled.response, change, change, free.empty()).first
        slope, curvature = -along * qp.height_scale, reaction * scaled.scale
        if slope + 0.5 * curvature <= 0.0:
            return _Clipping(clipped, 1.0, products)
        share = -slope / curvature if slope < 0.0 else 0.0
        if products == _PARTS:
            share = share if share >= LEAST_SHARE else 0.0
            free.interpolate(old, share, p)
            return _Clipping(clipped, share, products)
        free.interpolate(old, 0.0, p)
        part *= max(share, LEAST_SHARE)


def _restore_load(free: FreeSet, pressure: Any, cap: Any, found: Load, target: float) -> None:
    """Scale the clipped ``pressure`` on ``free`` (in place), where its sums are ``found``, to the sum ``target``.

    Where every loaded point is at its cap, the rest of the load is spread over the points below it.
    """
    for _ in range(LOAD_SWEEPS):
        missing = target - found.pressure
        if abs(missing) <= LOAD_ROUNDING * target:
            break
        if found.movable > 0.0 and found.movable + missing > 0.0:
            found = free.rescale(pressure, (found.movable + missing) / found.movable, 0.0, cap)
        elif missing < 0.0:
            found = free.rescale(pressure, target / found.pressure, 0.0, None)
        elif found.below == 0:
            break  # all are at their cap: what is missing is rounding of the sum over all points
        else:
            found = free.rescale(pressure, 1.0, missing / found.below, cap)


# The solver.


class Loaded(NamedTuple):
    """A solution: its ``pressure`` (nx, ny) in Pa and, where it is at hand, the ``deflection`` (nx, ny) in m by it."""

    pressure: RealArray
    deflection: RealArray | None

    def known(self, qp: ContactQP) -> tuple[RealArray, RealArray]:
        """Pressure and deflection, computed as at the end of a solve where it is not at hand."""
        if self.deflection is not None:
            return self.pressure, self.deflection
        out = np.empty_like(self.pressure)
        qp.operator.convolution("float64").apply(self.pressure, out)
        return self.pressure, out


_POOR = 0.5
"""Error of a start above which one from coarser grids is better: 20 loads from 0.01 to 0.2, each started from the one before,
take 0.83 (512²) and 0.91 (1024²) of the pairs of cold solves (``benchmarks/paths.py``); a start from another surface, whose
error is about 1, takes more than a cold one."""

_MOST_UNSUCCESSFUL = 2
"""Unclipped steps in a row that may fail to lower the lowest error. Pairs for 0, 1, 4: elastic 13.9 for all; film 23.6, 22.8,
22.8; free 43.9, 43.8, 43.8."""

_REFRESH = 1e-5
"""Fall of the error since the deflection was computed from scratch after which it is again: updates are rounded to single
precision, 6e-8 of the largest. Pairs for 1e-3, 1e-4, 1e-7: elastic 14.9, 14.4, 13.9; tight 21.7, 21.7, 23.9."""


@dataclass(eq=False)
class _Memory:
    """What is carried from step to step, besides the iterate in the arrays of ``work`` and the ``survey`` of it.

    ``computed_at`` is the error when the deflection was last computed from scratch (as opposed to updated); ``clipped`` the
    number of points that the last step took beyond their bounds; ``fallbacks`` how many steps had to be replaced so far.
    ``unsuccessful`` counts the unclipped steps in a row that have not made the ``lowest`` error smaller, None where steps
    are clipped; ``tensile`` is the free set of the last unclipped step, as long as it may hold tensile points, and
    ``tension`` the sum of theirs (Pa). ``superseded``: a later step has changed the arrays.
    """

    work: Workspace
    survey: Survey
    computed_at: float
    clipped: int
    fallbacks: int = 0
    unsuccessful: int | None = None
    lowest: float = np.inf
    tensile: FreeSet | None = None
    tension: float = 0.0
    superseded: bool = False

    def copied(self, state: SolverState) -> SolverState:
        """``state``, whose memory this is, with arrays of its own."""
        _require_latest(self)
        work = self.work.copy()
        memory = replace(self, work=work, survey=work.survey())
        return replace(state, pressure=work.pressure, deflection=work.deflection, memory=memory)


def _require_latest(memory: _Memory) -> None:
    if memory.superseded:
        raise InputError(
            "state of the solver active_set must be the latest of its run, but a later step has changed its arrays. "
            "Take state.copy() before the step to come back to it."
        )


@dataclass(frozen=True)
class ActiveSet:
    """Newton's method on the contact set, each linear system solved loosely by preconditioned conjugate gradients.

    A step chooses the free set, solves K p = h + level on it to a modest accuracy (preconditioner: the inverse of a
    compliance of nested cells), and clips the pressure to its bounds. Points enter the set by the mean level of the loaded
    points near them, so that it does not follow errors of long wavelength. The first guess comes from coarser grids.
    Corrections are computed in single precision, the gap they must close in double (``precision="mixed"``), so the answer
    has double precision at nearly the cost of single.

    Without a cap steps are *unclipped*: tensile points stay until the next step, whose first product with the compliance
    serves both, which saves a product a step. Three unclipped steps in a row that do not lower the error end this. From
    then on, as with a cap or if ``monotone``, every iterate keeps its bounds and the energy never rises: a step that would
    raise it is shortened to the minimum on its way, or replaced by one along the projected gradient.

    Iterates share their arrays: a step changes the arrays of the state it is given, which cannot be used afterwards.
    ``state.copy()`` is independent of it; the same steps follow from the copy, to the bit.

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
    max_iterations: int = 2000
    precision: Literal["mixed", "double", "single"] = "mixed"
    monotone: bool = False
    _guess: ClassVar[bool] = False
    name: ClassVar[str] = "active_set"
    citation_keys: ClassVar[tuple[str, ...]] = ("Cole1992", "Polonsky1999")

    def __post_init__(self) -> None:
        require_settings(self)
        require.one_of(self.precision, ("mixed", "double", "single"), "precision of the solver active_set")

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``, or at the solution on coarser grids where there is no start or a worse one."""
        if start is not None and start.any():
            state = self._started(qp, feasible_start(qp, start), 1, 0.0)
            if state.error <= _POOR or min(qp.profile.shape) <= COARSEST:
                return state
            begin, pairs = nested_start(qp, self)
            return self._started(qp, begin, 2, pairs)
        begin, pairs = nested_start(qp, self)
        return self._started(qp, begin, 1, pairs)

    def _started(self, qp: ContactQP, begin: RealArray, applications: int, pairs: float) -> SolverState:
        """State at the feasible pressure ``begin``, with the work it has cost."""
        work = Workspace.of(qp, self.precision, begin)
        survey = work.survey()
        unsuccessful = None if self.monotone or work.cap is not None else 0
        error = relative_error(work, survey.totals)
        memory = _Memory(work, survey, error, clipped=1, unsuccessful=unsuccessful)
        return self._state(memory, SolverState(begin, begin, np.inf, applications=applications, extra_pairs=pairs))

    def extrapolated(self, qp: ContactQP, last: Loaded, earlier: Loaded, ratio: float) -> SolverState | None:
        """State beyond the ``last`` of two loads by ``ratio`` times the step between them, without a product where their deflections are known.

        Pressure and deflection are extrapolated alike, K p being linear; points that become tensile are left to the first step. None where steps
        are clipped, and for other machines than the CPU.
        """
        engine = qp.operator.engine
        if not (qp.elastic and isinstance(engine, CpuEngine)) or self.monotone or self.precision == "single":
            return None
        products = sum(load.deflection is None for load in (last, earlier))
        known = zip(*(load.known(qp) for load in (last, earlier)), strict=True)
        pressure, deflection = (_beyond(late, early, ratio) for late, early in known)
        work = Workspace.of(qp, self.precision, pressure, deflection)
        survey = work.survey()
        negative = pressure[pressure < 0.0]
        tension = -float(negative.sum())
        error = relative_error(work, survey.totals) + tension / survey.totals.pressure
        if error <= self.tolerance:  # only the product from scratch shows that
            return self._started(qp, feasible_start(qp, pressure), products + 1, 0.0)
        if error > _POOR and min(qp.profile.shape) > COARSEST:
            begin, pairs = nested_start(qp, self)
            return self._started(qp, begin, products + 1, pairs)
        tensile = None
        if negative.size:
            tensile = engine.points(qp.profile.shape, np.flatnonzero(pressure), work.scaled.dtype)
        clipped = max(1, negative.size)
        memory = _Memory(work, survey, error, clipped=clipped, unsuccessful=0, tensile=tensile, tension=tension)
        return self._state(memory, SolverState(pressure, deflection, np.inf, applications=products))

    def loosened(self, tolerance: float) -> ActiveSet:
        """Same solver for a first guess: to ``tolerance``, not for long, and without the deflection of what it finds."""
        most = min(_COARSE_ITERATIONS, self.max_iterations)
        return _Guess(tolerance, most, self.precision, self.monotone)

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """One free set and its correction, in the arrays of ``state``.

        Raises
        ------
        InputError
            If a step has been made from ``state`` before.
        """
        given = state.memory
        assert isinstance(given, _Memory)
        _require_latest(given)
        memory = replace(given)
        given.superseded, given.tensile = True, None  # its vectors are long: they must go as soon as they are used
        level = plane_level(qp, memory.survey.totals)
        free = free_set(memory.survey, level, qp.height_scale, memory.work.scaled.dtype)
        step = self._clipped_step if memory.unsuccessful is None else self._unclipped_step
        following, spent = step(memory, replace(state, iterations=state.iterations + 1), free)
        memory.work.engine.clear_field(free, memory.work.scaled.field)
        del free
        return self._state(following, spent)

    def _unclipped_step(self, memory: _Memory, spent: SolverState, free: FreeSet) -> tuple[_Memory, SolverState]:
        """(3) Step after which points may be tensile.

        The deflection by clearing those of the step before is part of the first product of this one, and each product is
        added to the deflection as it is found: nothing else needs a transform.
        """
        work = memory.work
        stopping, r = self._stopping(memory, free, spent.error), free.residual(centred=work.load_prescribed)
        pending = None
        if memory.tensile is not None and memory.clipped:
            pending = clear_tension(work, memory.tensile, memory.survey.totals.pressure)
            memory.tensile = None
        system = LinearSystem(work.scaled, free, work.load_prescribed)

        def add(length: float) -> None:
            work.engine.add(work.scaled.response, length * work.qp.height_scale, work.deflection)

        found = conjugate_gradients(system, r, stopping, pending=pending, on_step=add)
        spent = replace(spent, extra_pairs=spent.extra_pairs + found.pairs)
        if found.d is None:
            return self._gradient_step(memory, spent)
        tensile, tension = free.add_unclipped(work.pressure, found.d, work.unit)
        return replace(memory, survey=work.survey(), clipped=tensile, tensile=free, tension=tension), spent

    def _clipped_step(self, memory: _Memory, spent: SolverState, free: FreeSet) -> tuple[_Memory, SolverState]:
        """(4) Step clipped to the bounds and shortened where the energy would rise."""
        work = memory.work
        stopping, r = self._stopping(memory, free, spent.error), free.residual(centred=work.load_prescribed)
        system = LinearSystem(work.scaled, free, work.load_prescribed)
        found = conjugate_gradients(system, free.copy(r), stopping)
        spent = replace(spent, extra_pairs=spent.extra_pairs + found.pairs)
        if found.d is None:
            return self._gradient_step(memory, spent)
        clipped, share, products = clipped_update(work, free, found.d, r, memory.survey.totals.pressure)
        spent = replace(spent, applications=spent.applications + products)
        if share < LEAST_SHARE:
            return self._gradient_step(memory, spent)
        work.engine.add(work.scaled.response, share * work.scaled.scale, work.deflection)
        return replace(memory, survey=work.survey(), clipped=clipped), spent

    def _gradient_step(self, memory: _Memory, spent: SolverState) -> tuple[_Memory, SolverState]:
        """(4) Step along the projected gradient from the iterate in the arrays; exhausted if not even that goes down."""
        work = memory.work
        qp, engine = work.qp, work.engine
        _compute_from_scratch(memory)
        pressure, deflection = engine.numpy(work.pressure).copy(), engine.numpy(work.deflection).copy()
        lower = descend(qp, replace(spent, pressure=pressure, deflection=deflection), levelling_step(qp))
        work.pressure[...] = engine.array(lower.pressure, work.dtype)
        work.exact.apply(work.pressure, work.deflection)
        spent = replace(spent, applications=lower.applications + 3, exhausted=lower.exhausted)
        return _Memory(work, work.survey(), memory.computed_at, clipped=1, fallbacks=memory.fallbacks + 1), spent

    def _state(self, memory: _Memory, spent: SolverState) -> SolverState:
        """(5) State at the iterate of ``memory`` with the work ``spent``.

        Its error is ``protocol.relative_error``, plus the tension over the load. Updates of the deflection leave the
        rounding of corrections in it. Once the error has fallen so far that this might show, at the end, and where steps
        are clipped from now on, tensile points are cleared and the deflection is computed from scratch.
        """
        work = memory.work
        error = relative_error(work, memory.survey.totals)
        if memory.tension:
            error += memory.tension / memory.survey.totals.pressure
        failed = memory.unsuccessful
        if failed is not None and error < memory.lowest:
            memory.lowest, memory.unsuccessful = error, 0
        elif failed is not None:  # after some in a row steps are clipped
            memory.unsuccessful = failed + 1 if failed < _MOST_UNSUCCESSFUL else None
        applications, ends = spent.applications, error <= self.tolerance or spent.iterations >= self.max_iterations
        due = ends or error < _REFRESH * memory.computed_at
        due = due or (memory.unsuccessful is None and memory.tensile is not None)
        if spent.iterations and ends and self._guess:
            _clear_tensile(memory)
        elif spent.iterations and due:
            _compute_from_scratch(memory)
            memory.survey, memory.tension = work.survey(), 0.0
            error = memory.computed_at = relative_error(work, memory.survey.totals)
            applications += 1
        totals = memory.survey.totals
        energy = None if memory.unsuccessful is not None else totals.work - 0.5 * totals.deflected
        iterate = {"pressure": work.pressure, "deflection": work.deflection, "engine": work.engine}
        found: dict[str, Any] = {"error": error, "energy": energy, "applications": applications, "memory": memory}
        return replace(spent, **iterate, **found)

    def _stopping(self, memory: _Memory, free: FreeSet, error: float) -> Stopping:
        """(2) When to stop a correction.

        Accuracy is wasted on a set that will change: only once few points enter or leave is it worth having, and only
        once none does is the system solved to what the tolerance needs.
        """
        changed = free.entering + memory.clipped
        if changed > _SETTLED * free.size:
            return Stopping(_REDUCTION, _UNSETTLED_STEPS << min(memory.fallbacks, _MOST_DOUBLINGS))
        wanted = _MARGIN * self.tolerance / error if error > 0.0 else 1.0
        most = _NEARLY_SETTLED if changed else _SETTLED_SET
        return Stopping(min(_REDUCTION, max(wanted, most.reduction)), most.max_steps)


def _beyond(late: RealArray, early: RealArray, ratio: float) -> RealArray:
    """late + ratio (late - early), in one array."""
    out: RealArray = late - early
    out *= ratio
    out += late
    return out


class _Guess(ActiveSet):
    """Solver of which only the pressure is wanted, as a first guess: its last deflection is not computed from scratch."""

    _guess: ClassVar[bool] = True


def _compute_from_scratch(memory: _Memory) -> None:
    """Clear tensile points, and compute the deflection anew instead of from its updates."""
    _clear_tensile(memory)
    memory.work.exact.apply(memory.work.pressure, memory.work.deflection)


def _clear_tensile(memory: _Memory) -> None:
    """Clear tensile points and scale the others to the load."""
    if memory.tensile is not None:
        clear_tension(memory.work, memory.tensile, memory.survey.totals.pressure)
    memory.tensile = None


# (0) First guesses from coarser grids.


COARSEST = 64
"""Points per side at which there is no coarser grid. Pairs for 32, 128: elastic 13.8, 14.2; free 43.1, 47.6; cap 15.3, 18.8."""

_COARSE_ITERATIONS = 30
"""Most steps on a coarse grid; four to eight are the rule. Pairs for 3, 10, 100: the same from 10 on."""

_HIDDEN_SHARE, _HIDDEN_SHARE_CAPPED = 0.5, 0.1
"""Tolerance on a coarse grid over the roughness that it cannot show, both relative to the rms height, without and with a cap. Pairs for
0.05, 0.1, 0.2, 1: elastic 13.6, 13.6, 13.1, 13.1 (0.5: 12.9); film 21.7, 21.3, 20.8, 20.2 (20.5); free 42.8, 42.8, 41.3, 41.0 (41.1); tight
22.8, 22.8, 23.7, 23.3 (23.7); with 0.5 for capped ones 17.4 instead of 15.6. Fewer steps on coarse grids save more time than pairs: 5 % at 256²."""

_LOOSEST, _LOOSEST_CAPPED = 0.1, 0.03
"""Loosest tolerance on a coarse grid. Pairs for 0.01, 0.03, 0.3: elastic 13.3, 12.9, 12.9; film 21.3, 20.5, 20.5; free 42.8, 41.3, 41.1."""

_FINE_STIFFNESS = 0.15
"""Stiffness of what stands out of 2 x 2 points, over that of alternating pixels (the roughness of a resolved surface is longer).
Saves a tenth of the pairs at 1024² and a quarter at 2048². Pairs for 0, 0.1, 0.2, 0.3: elastic 15.2, 15.1, 13.9, 14.0; film
22.9, 22.1, 23.5, 24.0. Under a cap there is none: crests that it would load beyond the cap yield. With it, cap 19.6 instead of 16.0
pairs; at a hardness of 0.1 E* 36 instead of 17, of 1 E* 21 instead of 18; at 512² 19.3 instead of 15.1, where elastic contact takes 14.2."""


class Adjustable(Solver, Protocol):
    """Solver whose tolerance can be set."""

    def loosened(self, tolerance: float) -> Solver:
        """Same solver for a first guess: with ``tolerance``, of which only the pressure is used."""


def coarsened(qp: ContactQP) -> ContactQP:
    """Same problem on half as many points per side."""
    profile = restricted(qp.profile)
    cap = restricted(qp.cap) if isinstance(qp.cap, np.ndarray) else qp.cap
    scale = float(profile.std()) or qp.height_scale
    return replace(qp, operator=qp.operator.coarsened, profile=profile, cap=cap, height_scale=scale)


def coarse_tolerance(qp: ContactQP, coarse: ContactQP, solver: Adjustable) -> float:
    """Tolerance of the ``coarse`` problem: a fraction of the roughness of ``qp`` that its grid cannot show."""
    hidden = np.sqrt(max(0.0, 1.0 - (coarse.height_scale / qp.height_scale) ** 2))
    share, loosest = (_HIDDEN_SHARE, _LOOSEST) if qp.elastic else (_HIDDEN_SHARE_CAPPED, _LOOSEST_CAPPED)
    return max(min(share * float(hidden), loosest), solver.tolerance)


def nested_start(qp: ContactQP, solver: Adjustable) -> tuple[RealArray, float]:
    """Feasible pressure (Pa) prolonged from the solution of ``solver`` on the coarser grid, and its FFT pairs.

    The coarse problem is solved to a fraction of the roughness that its grid cannot show. Its pressures are constant on
    2 x 2 points; without a cap, pressure is added in proportion to what stands out of them. Pairs are counted in pairs of the grid of
    ``qp``: those of half as many points per side count a quarter.
    """
    if min(qp.profile.shape) <= COARSEST:
        return feasible_start(qp, None), 0.0
    coarse = coarsened(qp)
    state = run(solver.loosened(coarse_tolerance(qp, coarse, solver)), coarse).state
    pairs = state.applications * coarse.operator.pairs_per_application + state.extra_pairs
    share = coarse.profile.size / qp.profile.size
    stiffness = _FINE_STIFFNESS / pixel_compliance(qp.operator.octaves, qp.operator.grid) if qp.elastic else 0.0
    start = qp.operator.engine.prolonged(state.pressure, coarse.profile, qp.profile, stiffness)
    if not (qp.elastic and isinstance(qp.constraint, FixedMean) and start.any()):
        return feasible_start(qp, start), pairs * share
    start *= qp.constraint.mean_pressure / start.mean()
    return start, pairs * share
