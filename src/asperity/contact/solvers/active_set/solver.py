"""Inexact active set with preconditioned conjugate gradients on nested grids: the fast solver.

Read it beside docs/theory/contact.md: numbers in parentheses, such as (4), are the steps of the
algorithm there.

A constant has one line of reason; what other values change is measured by
``benchmarks/constants.py`` and listed in docs/develop/constants.md.
"""

from __future__ import annotations

import math
from copy import copy
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np

from ....core import require
from ....core.arrays import RealArray
from ....core.engine import CpuEngine, FreeSet, Survey, Totals
from ....core.errors import InputError
from ..protocol import (
    ROUNDING,
    ContactQP,
    FixedMean,
    Iterative,
    SolverState,
    feasible_start,
    scaled_error,
)
from ..reference.steepest_descent import descend, levelling_step
from .bounds import add_clipped, clear_tension, clipped_update, free_set, narrowed, plane_level
from .first_guess import COARSE_ITERATIONS, COARSEST, Start, nested_start, settle
from .linear_system import LinearSystem, Stopping, Workspace, conjugate_gradients

# Error of an iterate.


def relative_error(work: Workspace, totals: Totals) -> float:
    """``protocol.relative_error`` from the sums over the iterate; infinite where a step has let go
    of every point of a load."""
    qp, total, energy = work.qp, totals.pressure, 0.5 * totals.deflected
    if work.load is not None and total <= 0.0:
        return math.inf
    if work.load is not None and work.cap is None:
        lifted = totals.lowest * total
        rounding = ROUNDING * (abs(totals.work) + abs(lifted))  # the difference below is not known any better
        return scaled_error(qp, max(totals.work - lifted, rounding) / total, total, energy)
    iterate, level = (work.pressure, work.deflection, work.heights, work.cap), plane_level(qp, totals)
    found = work.engine.violation(*iterate, level)
    if work.load is not None:
        lowest = work.engine.violation(*iterate, totals.lowest)
        gap = min(found.above + found.below, lowest.above + lowest.below)
        return scaled_error(qp, gap / total, total, energy)
    weighted = found.above / total if total > 0.0 else 0.0
    return scaled_error(qp, weighted + found.deepest, total, energy)


# (2) How accurately a linear system is solved.


_SETTLED = 0.003
"""Points entering or beyond their bounds, over the free set, below which the set counts as nearly
settled and its system is worth solving closely."""

_REDUCTION = 0.3
"""Reduction of the residual while the set changes: what one step of conjugate gradients gains, for
the set will be another one."""

_UNSETTLED_STEPS = 3
"""Most steps while the set changes, doubled with every fallback, and twice with every failure of
unclipped ones: one more than smooth surfaces need."""

_UNMEASURED, _LAST, _LAST_CLOSELY = Stopping(0.0, 0), Stopping(0.0, 0, ending=1.0), Stopping(0.0, 0, ending=1.0, more=1)
"""Effort on a correction that is clipped afterwards, and on the last one: a single direction of the
model of the compliance, whose deflection the product with what is left of it after clipping, or
that which ends the solve, shows."""

_SINGLE = 0.015
"""Reduction of the error that a single direction of the model is trusted to reach: more is missed
too often, which costs a product."""

_CLOSELY = 0.05
"""Reduction of the error below which such a direction takes a step more on the model, which costs a
tenth of the product that it may spare."""

_MOST_DOUBLINGS = 4
"""Doublings of the steps at most: 48 steps then, more than a system ever took to be solved (30)."""

_CLOSER, _CLOSER_DOUBLINGS = 0.1, 2
"""Factor to the reduction, and doublings of the steps, every time that unclipped steps have failed:
a set that goes in circles settles where its systems are solved closely."""

_NEARLY_SETTLED = Stopping(reduction=0.1, max_steps=8)
"""Effort on a nearly settled set: a decade, since some points will still change."""

_SETTLED_SET = Stopping(reduction=1e-4, max_steps=14)
"""Effort at most on a set that did not change; more than single precision holds is wasted."""

_LAST_STEP = 0.07
"""Reduction of the error expected of a last step whose length is not measured: the product that
computes the deflection from scratch, which ends every solve, then serves it too."""

_LAST_REDUCTION = 0.01
"""Reduction down to which a step on a set that is nearly settled is taken for the last one."""

_FURTHER = 0.75
"""Length, over that of the last step of conjugate gradients, of one more step of a correction that
is clipped afterwards: its deflection is shown by the product with what clipping leaves, so it costs
none."""

_MARGIN = 0.8
"""Share of the tolerance aimed at, since the error follows the residual only nearly."""


# The solver.


class Loaded(NamedTuple):
    """A solution: its ``pressure`` (nx, ny) in Pa and, where it is at hand, the ``deflection`` (nx,
    ny) in m by it."""

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
"""Error of a start above which one from coarser grids is better: that of another surface is about
1."""

_SLIGHT = 1e-3
"""Tension over the load of an extrapolated start below which its tensile points, many of which bear
next to nothing, do not count as a set that is not settled."""

_SAME = 1e-12
"""Relative difference of two mean pressures that counts as rounding."""

_MOST_UNSUCCESSFUL = 2
"""Unclipped steps in a row that may fail to lower the lowest error before systems are solved more
closely."""

_MOST_REFINEMENTS = 3
"""How often they may fail before steps are clipped, which take hundreds of pairs on very stiff
films."""

_REFRESH = 1e-5
"""Fall of the error since the deflection was computed from scratch after which it is again: updates
are rounded to single precision, 6e-8 of the largest."""


@dataclass(eq=False)
class _Memory:
    """What is carried from step to step, besides the iterate in the arrays of ``work`` and the
    ``survey`` of it.

    ``computed_at`` is the error when the deflection was last computed from scratch (as opposed to
    updated); ``clipped`` the number of points that the last step took beyond their bounds;
    ``fallbacks`` how many steps had to be replaced so far, one at least where a direction of the
    model alone had to be shortened. ``unsuccessful`` counts the unclipped steps in a row that have
    not made the ``lowest`` error smaller, None where steps are clipped; ``refinements`` how often
    there were too many, after which systems are solved more closely; ``tensile`` is the free set of
    the last unclipped step, as long as it may hold tensile points, and ``tension`` the sum of
    theirs (Pa). ``from_scratch``: the deflection has just been computed so; ``narrowed``: how often
    the set of a start is to be (``Start``). ``superseded``: a later step has changed the arrays.
    The work so far is that of ``SolverState``.
    """

    work: Workspace
    survey: Survey
    computed_at: float
    clipped: int
    fallbacks: int = 0
    unsuccessful: int | None = None
    refinements: int = 0
    lowest: float = np.inf
    tensile: FreeSet | None = None
    tension: float = 0.0
    from_scratch: bool = False
    narrowed: int = 0
    superseded: bool = False
    iterations: int = 0
    applications: int = 0
    pairs: float = 0.0
    exhausted: bool = False

    def settled(self, free: FreeSet) -> bool:
        """Whether few points enter the set or were taken beyond their bounds."""
        return free.entering + self.clipped <= _SETTLED * free.size

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
class ActiveSet(Iterative):
    """Newton's method on the contact set, each linear system solved loosely by preconditioned
    conjugate gradients.

    A step chooses the free set, solves K p = h + level on it to a modest accuracy (preconditioner:
    the inverse of a compliance of nested splines), and clips the pressure to its bounds. Points
    enter the set by the mean level of the loaded points near them, so that it does not follow
    errors of long wavelength. The first guess comes from coarser grids, and a step on the model of
    the compliance alone takes most points that will not touch out of its set before the first
    product. Corrections are computed in single precision, the gap they must close in double
    (``precision="mixed"``), so the answer has double precision at nearly the cost of single.

    Without a cap steps are *unclipped*: tensile points stay until the next step, whose first
    product with the compliance serves both, which saves a product a step. Three unclipped steps in
    a row that do not lower the error make the following ones more accurate; the fourth such failure
    ends them. From then on, as with a cap or if ``monotone``, every iterate keeps its bounds and
    the energy never rises: a direction found by the model is clipped and then multiplied, and a
    step that would raise the energy is shortened to the minimum on its way, or replaced by one
    along the projected gradient. The product that computes the final deflection from scratch serves
    the last step too, whose length is estimated unless ``monotone``.

    Iterates share their arrays: a step changes the arrays of the state it is given, which cannot be
    used afterwards. ``state.copy()`` is independent of it; the same steps follow from the copy, to
    the bit.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) at which to stop.
    max_iterations
        Largest number of steps.
    precision
        ``"mixed"``, ``"double"``, or ``"single"`` for everything in single precision: half the
        memory, for tolerances down to about 1e-5.
    monotone
        Whether every iterate has to keep its bounds and to be no higher in energy than the one
        before. The answer keeps its bounds in any case.
    """

    tolerance: float = 1e-7
    max_iterations: int = 2000
    precision: Literal["mixed", "double", "single"] = "mixed"
    monotone: bool = False
    _guess: ClassVar[bool] = False
    name: ClassVar[str] = "active_set"
    citation_keys: ClassVar[tuple[str, ...]] = ("Cole1992", "Polonsky1999")

    def __post_init__(self) -> None:
        super().__post_init__()
        require.one_of(self.precision, ("mixed", "double", "single"), "precision of the solver active_set")

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``, or at the solution on coarser grids where there is no start or a
        worse one."""
        qp = qp.resident
        if start is not None and start.any():
            state = self._started(qp, Start(feasible_start(qp, start)), 1)
            if state.error <= _POOR or min(qp.profile.shape) <= COARSEST:
                return state
            return self._started(qp, nested_start(qp, self), 2)
        return self._started(qp, nested_start(qp, self), 1)

    def _started(self, qp: ContactQP, begin: Start, applications: int) -> SolverState:
        """State at a feasible pressure, with the work it has cost."""
        work = Workspace.of(qp, self.precision, begin.pressure, begin.deflection)
        if begin.deflection is not None:
            settle(work, begin.narrowed)
            work.exact.apply(work.pressure, work.deflection)
        survey = work.survey()
        unsuccessful = None if self.monotone or work.cap is not None else 0
        error = relative_error(work, survey.totals)
        memory = _Memory(work, survey, error, clipped=1, unsuccessful=unsuccessful, narrowed=begin.narrowed)
        memory.applications, memory.pairs = applications, begin.pairs
        return self._state(memory)

    def extrapolated(self, qp: ContactQP, last: Loaded, earlier: Loaded, ratio: float) -> SolverState | None:
        """State beyond the ``last`` of two loads by ``ratio`` times the step between them, without
        a product where their deflections are known.

        Pressure and deflection are extrapolated alike, K p being linear; points that become tensile
        are left to the first step. None where steps are clipped, and for other machines than the
        CPU.
        """
        engine = qp.operator.engine
        if not (qp.elastic and isinstance(engine, CpuEngine)) or self.monotone or self.precision == "single":
            return None
        products = sum(load.deflection is None for load in (last, earlier))
        known = zip(*(load.known(qp) for load in (last, earlier)), strict=True)
        pressure, deflection = (engine.beyond(late, early, ratio) for late, early in known)
        work = Workspace.of(qp, self.precision, pressure, deflection)
        memory = _Memory(work, work.survey(), 0.0, clipped=1, unsuccessful=0)
        memory.computed_at = error = _seek_tension(memory, engine)
        if error <= self.tolerance:  # only the product from scratch shows that
            return self._started(qp, Start(feasible_start(qp, pressure)), products + 1)
        if error > _POOR and min(qp.profile.shape) > COARSEST:
            return self._started(qp, nested_start(qp, self), products + 1)
        memory.applications = products
        return self._state(memory)

    def moved(self, qp: ContactQP, state: SolverState, earlier: Loaded | None, ratio: float) -> SolverState | None:
        """State beyond ``state`` by ``ratio`` times its difference from an ``earlier`` contact, or
        from none, under the load of ``qp``, in the arrays of ``state``.

        None where steps are clipped, and for other machines than the CPU.
        """
        given, load = state.memory, qp.constraint
        assert isinstance(given, _Memory)
        assert isinstance(load, FixedMean)
        _require_latest(given)
        engine = given.work.engine
        if given.unsuccessful is None or not isinstance(engine, CpuEngine):
            return None
        given.superseded = True
        work = replace(given.work, qp=qp, load=load.mean_pressure * qp.profile.size)
        for number, field in enumerate((work.pressure, work.deflection)):
            if earlier is None:
                field *= 1.0 + ratio
            else:
                engine.move_on(field, earlier.known(qp)[number], ratio)
        memory = replace(given, work=work, survey=work.survey(), superseded=False)
        memory.lowest, memory.from_scratch = np.inf, False
        _seek_tension(memory, engine)
        return self._state(memory)

    def resumed(self, qp: ContactQP, last: Loaded) -> SolverState | None:
        """State at the ``last`` pressure, which solves a contact like this one, without a product
        where its deflection is known.

        None where it is not feasible here or too far off, and for other machines than the CPU.
        """
        (pressure, deflection), load = last, qp.constraint
        if deflection is None or not isinstance(qp.operator.engine, CpuEngine) or self.precision == "single":
            return None
        prescribed = load.mean_pressure if isinstance(load, FixedMean) else float(pressure.mean())
        same = abs(float(pressure.mean()) - prescribed) <= _SAME * prescribed
        if not same or not (qp.elastic or np.all(pressure <= qp.cap)):
            return None
        work = Workspace.of(qp, self.precision, pressure.copy(), deflection.copy())
        survey = work.survey()
        error = relative_error(work, survey.totals)
        if error > _POOR and min(qp.profile.shape) > COARSEST:
            return None
        unsuccessful = None if self.monotone or work.cap is not None else 0
        return self._state(_Memory(work, survey, error, clipped=1, unsuccessful=unsuccessful, from_scratch=True))

    def loosened(self, tolerance: float) -> ActiveSet:
        """Same solver for a first guess: to ``tolerance``, not for long, and without the deflection
        of what it finds."""
        most = min(COARSE_ITERATIONS, self.max_iterations)
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
        memory = copy(given)
        given.superseded, given.tensile = True, None  # its vectors are long: they must go as soon as they are used
        memory.iterations += 1
        level = plane_level(qp, memory.survey.totals)
        clips = memory.unsuccessful is None
        if clips:
            wide = False
        # prolonged starts only: the coarsest grid begins with the highest points, not with
        # pressures of 2 x 2 points
        elif memory.narrowed:
            wide = min(qp.profile.shape) > COARSEST
        else:  # a last step, if the one before made few points tensile
            few = memory.tensile is not None and memory.clipped <= _SETTLED * memory.tensile.size
            near = _MARGIN * self.tolerance >= _SINGLE * state.error
            wide = few and near and not (self.monotone or self._guess)
        free = free_set(memory.survey, level, qp.height_scale, memory.work.scaled.dtype, wide=wide)
        step = self._clipped_step if clips else self._unclipped_step
        following = step(memory, free, state.error)
        memory.work.engine.clear_field(free, memory.work.scaled.field)
        del free
        if following.work.load is None or following.survey.totals.pressure > 0.0:
            return self._state(following)
        # the step has let go of every point of a load: clipped steps from a uniform pressure on
        begin = Start(feasible_start(qp, None), following.pairs)
        anew = self._started(qp, begin, following.applications + 1)
        assert isinstance(anew.memory, _Memory)
        anew.memory.unsuccessful, anew.memory.iterations = None, following.iterations
        return replace(anew, iterations=following.iterations)

    def _unclipped_step(self, memory: _Memory, free: FreeSet, error: float) -> _Memory:
        """(3) Step after which points may be tensile.

        The deflection by clearing those of the step before is part of the first product of this
        one, and each product is added to the deflection as it is found: nothing else needs a
        transform. After a step that is to be the last one the deflection is computed from scratch
        instead.
        """
        work = memory.work
        stopping, r = self._stopping(memory, free, error), free.residual(centred=work.load is not None)
        pending = None
        if memory.tensile is not None and memory.clipped:
            pending = clear_tension(work, memory.tensile, memory.survey.totals.pressure)
            memory.tensile = None
        elif memory.narrowed and not memory.settled(free):
            free, r, pending = narrowed(work, free, r, rounds=memory.narrowed)
            stopping = Stopping(_REDUCTION, max_steps=1)
        system = LinearSystem(work.scaled, free, work.load is not None)
        memory.narrowed, last = 0, stopping.ending is not None

        def add(length: float) -> None:
            work.engine.add(work.scaled.response, length * work.qp.height_scale, work.deflection)

        found = conjugate_gradients(system, r, stopping, pending=pending, on_step=None if last else add)
        memory.pairs += found.pairs
        if found.d is None:
            return self._gradient_step(memory)
        memory.clipped, memory.tension, total = free.add_unclipped(work.pressure, found.d, work.unit)
        memory.tensile, memory.from_scratch = free, False
        if last:
            _compute_from_scratch(memory, total)
        else:
            memory.survey = work.survey()
        return memory

    def _clipped_step(self, memory: _Memory, free: FreeSet, error: float) -> _Memory:
        """(4) Step clipped to the bounds and shortened where the energy would rise."""
        work = memory.work
        stopping, r = self._stopping(memory, free, error), free.residual(centred=work.load is not None)
        system = LinearSystem(work.scaled, free, work.load is not None)
        found = conjugate_gradients(system, free.copy(r), stopping, further=_FURTHER)
        memory.pairs += found.pairs
        if found.d is None:
            return self._gradient_step(memory)
        if found.open and self._ended(memory, free, found.d):
            return memory
        memory.clipped, share, products = clipped_update(work, free, found.d, r, memory.survey.totals.pressure)
        memory.applications += products
        if share == 0.0:
            return self._gradient_step(memory)
        work.engine.add(work.scaled.response, share * work.scaled.scale, work.deflection)
        memory.fallbacks = max(memory.fallbacks, int(products > 1))  # the model alone goes too far
        memory.survey, memory.from_scratch = work.survey(), False
        return memory

    def _ended(self, memory: _Memory, free: FreeSet, d: Any) -> bool:
        """Whether the clipped step ``d``, whose deflection is computed from scratch, reaches the
        tolerance; if not, it is taken back."""
        work, total = memory.work, memory.survey.totals.pressure
        deflection, (old, load) = work.engine.copy(work.deflection), free.gather(work.pressure)
        memory.clipped = add_clipped(work, free, d, 1.0, total - load)
        _compute_from_scratch(memory)
        if memory.computed_at <= self.tolerance:
            return True
        free.put(old, work.pressure)
        work.deflection[...] = deflection
        memory.survey = work.survey()
        return False

    def _gradient_step(self, memory: _Memory) -> _Memory:
        """(4) Step along the projected gradient from the iterate in the arrays; exhausted if not
        even that goes down."""
        work = memory.work
        engine = work.engine
        qp = replace(work.qp, profile=engine.numpy(work.qp.profile))
        _compute_from_scratch(memory)
        pressure, deflection = engine.numpy(work.pressure).copy(), engine.numpy(work.deflection).copy()
        lower = descend(qp, SolverState(pressure, deflection, memory.computed_at), levelling_step(qp))
        work.pressure[...] = engine.array(lower.pressure, work.dtype)
        work.exact.apply(work.pressure, work.deflection)
        following = _Memory(work, work.survey(), memory.computed_at, clipped=1, fallbacks=memory.fallbacks + 1)
        following.iterations, following.pairs = memory.iterations, memory.pairs
        following.applications, following.exhausted = memory.applications + lower.applications + 2, lower.exhausted
        return following

    def _state(self, memory: _Memory) -> SolverState:
        """(5) State at the iterate of ``memory``.

        Its error is ``protocol.relative_error``, plus the tension over the load. Updates of the
        deflection leave the rounding of corrections in it. Once the error has fallen so far that
        this might show, at the end, and where steps are clipped from now on, tensile points are
        cleared and the deflection is computed from scratch.
        """
        work = memory.work
        error = relative_error(work, memory.survey.totals)
        if memory.tension:
            load = memory.survey.totals.pressure
            error = error + memory.tension / load if load > 0.0 else math.inf
        if memory.unsuccessful is None:
            pass
        elif error < memory.lowest:
            memory.lowest, memory.unsuccessful = error, 0
        elif memory.unsuccessful < _MOST_UNSUCCESSFUL:
            memory.unsuccessful += 1
        elif memory.refinements < _MOST_REFINEMENTS:  # systems are solved more closely from now on
            memory.refinements, memory.lowest, memory.unsuccessful = memory.refinements + 1, error, 0
        else:
            memory.unsuccessful = None
        ends = error <= self.tolerance or memory.iterations >= self.max_iterations
        due = ends or error < _REFRESH * memory.computed_at
        due = due or (memory.unsuccessful is None and memory.tensile is not None)
        if memory.iterations and ends and self._guess:
            if memory.tensile is not None:
                clear_tension(work, memory.tensile, memory.survey.totals.pressure)
            memory.tensile = None
        elif memory.iterations and due and not memory.from_scratch:
            _compute_from_scratch(memory)
            error = memory.computed_at
        totals = memory.survey.totals
        energy = None if memory.unsuccessful is not None else totals.work - 0.5 * totals.deflected
        return SolverState(
            work.pressure,
            work.deflection,
            error,
            memory.iterations,
            memory.applications,
            memory.pairs,
            memory.exhausted,
            energy,
            memory,
            work.engine,
        )

    def _stopping(self, memory: _Memory, free: FreeSet, error: float) -> Stopping:
        """(2) When to stop a correction.

        Accuracy is wasted on a set that will change: only once few points enter or leave is it
        worth having, and only once none does is the system solved to what the tolerance needs.
        """
        changed, settled, operator = free.entering + memory.clipped, memory.settled(free), memory.work.qp.operator
        wanted = (
            _MARGIN * self.tolerance / error if error > 0.0 else 1.0
        )  # reduction of the error that reaches the tolerance
        alone = memory.unsuccessful is None and not memory.fallbacks and operator.translation_invariant
        # the last step may be one whose length is not measured, where the model has the right size
        ends = not (self.monotone or self._guess) and operator.translation_invariant
        if ends and wanted >= _SINGLE and (settled or alone):
            return _LAST if wanted >= _CLOSELY else _LAST_CLOSELY
        if alone:
            return _UNMEASURED
        if not settled:
            doublings = memory.fallbacks + _CLOSER_DOUBLINGS * memory.refinements
            return Stopping(
                _REDUCTION * _CLOSER**memory.refinements, _UNSETTLED_STEPS << min(doublings, _MOST_DOUBLINGS)
            )
        most = _NEARLY_SETTLED if changed else _SETTLED_SET
        if ends and wanted >= (_LAST_REDUCTION if changed else _SETTLED_SET.reduction):
            return Stopping(0.0, most.max_steps, wanted / _LAST_STEP)
        return Stopping(min(_REDUCTION, max(wanted, most.reduction)), most.max_steps)


class _Guess(ActiveSet):
    """Solver of which only the pressure is wanted, as a first guess: its last deflection is not
    computed from scratch."""

    _guess: ClassVar[bool] = True


def _seek_tension(memory: _Memory, engine: CpuEngine) -> float:
    """Find the tensile points of an iterate beyond others; its error."""
    work, total = memory.work, memory.survey.totals.pressure
    loaded = np.flatnonzero(work.pressure != 0.0)
    values = work.pressure.ravel()[loaded]
    negative = values[values < 0.0]
    memory.tension, memory.tensile = -float(negative.sum()), None
    if negative.size:
        memory.tensile = engine.points(work.qp.profile.shape, loaded, work.scaled.dtype)
    memory.clipped = max(1, negative.size) if memory.tension > _SLIGHT * total else 1
    return relative_error(work, memory.survey.totals) + memory.tension / total


def _compute_from_scratch(memory: _Memory, total: float | None = None) -> None:
    """Compute the deflection anew instead of from its updates, tensile points cleared and the
    others, of the sum ``total`` (by default that of the survey), scaled to the load."""
    work = memory.work
    if memory.tensile is not None:
        clear_tension(work, memory.tensile, memory.survey.totals.pressure if total is None else total)
    memory.tensile = None
    work.exact.apply(work.pressure, work.deflection)
    memory.applications += 1
    memory.survey, memory.tension, memory.from_scratch = work.survey(), 0.0, True
    memory.computed_at = relative_error(work, memory.survey.totals)
