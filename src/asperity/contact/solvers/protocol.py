"""The discrete problem every solver solves, the state it iterates on, and the loop around it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, NamedTuple, Protocol, TypeAlias, runtime_checkable

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.engine import Engine, Survey, Totals, Violation
from ...core.status import NoProgress, Outcome, Progress, Status
from ...solids.compliance.halfspace import HalfSpace
from ..operators import Operator


@dataclass(frozen=True)
class FixedMean:
    """The mean pressure (Pa) is prescribed; the offset of the bodies is its multiplier."""

    mean_pressure: float


@dataclass(frozen=True)
class FixedOffset:
    """The offset d (m) in gap = d + K p - h is prescribed."""

    offset: float


Constraint: TypeAlias = FixedMean | FixedOffset
"""What fixes the rigid-body position."""


@dataclass(frozen=True, eq=False)
class ContactQP:
    """Minimise p·Kp/2 - p·(h - d) over 0 <= p <= cap, with the mean of p or the offset d fixed
    (Kalker 1977).

    Parameters
    ----------
    operator
        K, from pressure (Pa) to displacement (m).
    profile
        h, composite heights (nx, ny) in m, float64.
    cap
        Largest pressure in Pa: a number, an (nx, ny) array, or infinity.
    constraint
        ``FixedMean`` or ``FixedOffset``.
    height_scale
        Rms height of the profile in m; errors are relative to it (see ``scaled_error``).
    """

    operator: Operator
    profile: RealArray
    cap: float | RealArray
    constraint: Constraint
    height_scale: float

    @property
    def elastic(self) -> bool:
        """Whether there is no cap at all."""
        return not isinstance(self.cap, np.ndarray) and self.cap == np.inf

    @cached_property
    def resident_profile(self) -> Any:
        """The profile where the machine computes."""
        return self.operator.engine.resident(self.profile)

    @property
    def resident(self) -> ContactQP:
        """The same with the profile where the machine computes, for methods that stay there."""
        profile = self.resident_profile
        return self if profile is self.profile else replace(self, profile=profile)

    def survey(self, state: SolverState) -> Survey:
        """Sums over ``state`` and the profile, in double precision."""
        return self.operator.engine.survey(*self._arrays(state))

    def violation(self, state: SolverState, level: float) -> Violation:
        """How far ``state`` is from the contact conditions at the plane ``level`` (m)."""
        return self.operator.engine.violation(*self._arrays(state), level)

    def _arrays(self, state: SolverState) -> tuple[Any, Any, Any, Any]:
        """Pressure, deflection, profile and cap on the machine of the operator; no cap is None."""
        array = self.operator.engine.array
        cap = None if self.elastic else array(np.asarray(self.cap, dtype=float).reshape(-1), "float64")
        return (*(array(field, "float64") for field in self.as_computed(state)), cap)

    def as_computed(self, state: SolverState) -> tuple[Any, Any, Any]:
        """Pressure and deflection of ``state``, and the profile, where the machine computes."""
        if state.resident is None:
            return state.pressure, state.deflection, self.profile
        return (*state.resident, self.resident_profile)


@dataclass(frozen=True, eq=False)
class SolverState:
    """One iterate, everything needed to continue from it.

    Its arrays may be borrowed: ``ActiveSet`` goes on in them, so that a state is good for one step,
    and after that step must not be used any more. ``copy`` gives a state of its own arrays, from
    which the same steps follow, to the bit.

    Attributes
    ----------
    pressure
        Feasible pressure (Pa), except for methods that leave the bounds on the way.
    deflection
        K·pressure (m).
    error
        Relative optimality error, see ``relative_error``.
    iterations, applications
        Steps, and applications of the operator, so far.
    extra_pairs
        FFT pairs of the size of the grid that went into other work (preconditioner, coarser grids).
    exhausted
        Whether the method cannot improve the iterate.
    energy
        p·Kp/2 - p·(h - d) summed over the points (Pa·m), where no step can raise it; else None.
    memory
        What the method carries from step to step; frozen, or ``Borrowing``.
    engine
        Whose arrays pressure and deflection are; None for NumPy arrays.
    resident
        Pressure and deflection where the machine computes as well, if that is elsewhere.
    """

    pressure: RealArray
    deflection: RealArray
    error: float
    iterations: int = 0
    applications: int = 0
    extra_pairs: float = 0.0
    exhausted: bool = False
    energy: float | None = None
    memory: object = None
    engine: Engine | None = None
    resident: tuple[Any, Any] | None = None

    def copy(self) -> SolverState:
        """State of its own arrays, which steps from this one leave alone, for restarts."""
        if isinstance(self.memory, Borrowing):
            return self.memory.copied(self)
        return replace(self, pressure=self.pressure.copy(), deflection=self.deflection.copy())


@runtime_checkable
class Borrowing(Protocol):
    """Memory of a method whose steps change the arrays of the state they are given."""

    def copied(self, state: SolverState) -> SolverState:
        """``state``, whose memory this is, with arrays of its own."""


class Solver(Protocol):
    """A method; a frozen value holding only its settings."""

    @property
    def name(self) -> str:
        """Name in reports and documents."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of the method."""

    @property
    def tolerance(self) -> float:
        """Relative error at which to stop."""

    @property
    def max_iterations(self) -> int:
        """Number of steps after which to give up."""

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at the pressure ``start`` (Pa), made feasible, or at a guess of the method."""

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """Next state (a direct method solves the whole problem in one step).

        A method may go on in the arrays of ``state``, which is then used up (``SolverState.copy``).
        """


@dataclass(frozen=True)
class Iterative:
    """Base of methods, for any problem, with a tolerance in (0, 1) and an iteration limit, whole
    and >= 1; InputError names the wrong one."""

    tolerance: float
    max_iterations: int
    name: ClassVar[str] = ""

    def __post_init__(self) -> None:
        require.between(self.tolerance, 0.0, 1.0, f"tolerance of the solver {self.name}")
        require.integer(self.max_iterations, 1, f"iteration limit of the solver {self.name}")


@dataclass(frozen=True, eq=False)
class Solution:
    """Last state of a solver and how it ended; ``errors`` are relative, of every iteration."""

    state: SolverState
    status: Status
    errors: tuple[float, ...]


PATIENCE = 500
LEAST_PATIENCE = 20
"""A method stagnates after a quarter of its limit without a smaller error, within these numbers."""

_SMALLER = 0.99
"""Share of the smallest error below which one is smaller: near rounding digits still fall."""

_DESCENT_PATIENCE = 75
_LOWER = 1e-12
"""Iterations without a smaller error or a lower energy of a method whose energy cannot rise, and
the share by which it must fall to count as lower. The error of such a method may rise for long:
films of E 1000, 2 pixels thick, white noise of 64² points of 1 : 4, go from 0.8 (uniform pressure)
to 2000 in three steps, take some 80 to come back below 0.8, and converge in 100 to 500."""


def run(
    solver: Solver,
    qp: ContactQP,
    start: RealArray | None = None,
    progress: Progress | None = None,
    begun: SolverState | None = None,
) -> Solution:
    """Iterate ``solver`` from the pressure ``start`` (Pa) or the state ``begun`` to its end."""
    ended = iterated(solver, qp, start, progress, begun)
    state, engine = ended.state, ended.state.engine
    finished = replace(state, memory=None)
    if engine is None:
        total = state.pressure.sum()
    else:  # as NumPy arrays
        total, own = engine.total(state.pressure), (state.pressure, state.deflection)
        pressure, deflection = (engine.numpy(values) for values in own)
        kept = own if engine.separate_memory else None
        finished = replace(finished, pressure=pressure, deflection=deflection, engine=None, resident=kept)
    reached = f"relative error {state.error:.2e} after {state.iterations} iterations of {solver.name}"
    if not np.isfinite(total):
        text, remedy = "The pressure is not a finite number.", "Check heights, moduli and load for extreme values."
        status = Status(Outcome.STAGNATED, text, remedy)
    elif state.error <= solver.tolerance:
        text = f"Converged: relative error {state.error:.2e} by {solver.name}, tolerance {solver.tolerance:.0e}."
        status = Status(Outcome.CONVERGED, text)
    elif ended.stagnated:
        text = f"Stagnated above the tolerance {solver.tolerance:.0e}: {reached}."
        remedy = (
            "Try another solver ({solver}; conjugate_gradient is the most robust) or a tolerance the "
            "arithmetic can reach ({tolerance})."
        )
        status = Status(Outcome.STAGNATED, text, remedy)
    else:
        text = f"Iteration limit before the tolerance {solver.tolerance:.0e}: {reached}."
        remedy = (
            f"Raise the number of iterations above {solver.max_iterations} ({{iterations}}) or loosen the "
            f"tolerance ({{tolerance}})."
        )
        status = Status(Outcome.ITERATION_LIMIT, text, remedy)
    return Solution(finished, status, ended.errors)


class Ended(NamedTuple):
    """Last ``state`` of a solver, with the arrays and the memory of the method, the ``errors`` of
    all, and whether it has ``stagnated``."""

    state: SolverState
    errors: tuple[float, ...]
    stagnated: bool


def iterated(
    solver: Solver,
    qp: ContactQP,
    start: RealArray | None = None,
    progress: Progress | None = None,
    begun: SolverState | None = None,
) -> Ended:
    """As ``run``, but the last state as the method leaves it."""
    report = progress or NoProgress()
    state = solver.init(qp, start) if begun is None else begun
    errors = [state.error]
    least_error, least_energy, since = state.error, np.inf, 0  # iterations since either fell
    patience = min(PATIENCE, max(LEAST_PATIENCE, solver.max_iterations // 4))
    while True:
        report.update(state.iterations, state.error, solver.tolerance)
        stagnated = state.exhausted or since >= patience
        if state.error <= solver.tolerance or stagnated or state.iterations >= solver.max_iterations:
            return Ended(state, tuple(errors), stagnated)
        state = solver.step(qp, state)
        errors.append(state.error)
        since += 1
        if state.error < _SMALLER * least_error:
            least_error, since = state.error, 0
        if state.energy is not None:
            patience = min(patience, _DESCENT_PATIENCE)
            if not state.energy >= least_energy - _LOWER * abs(least_energy):
                least_energy, since = state.energy, 0


# How far a feasible pressure is from the solution: multiplier, duality gap and relative error.
#
# All functions take r = K p - h (m) and the plane level lambda (m), the multiplier of the load; the
# gap of the bodies is r - lambda.


def level(qp: ContactQP, pressure: RealArray, r: RealArray) -> float:
    """Plane level lambda = -offset (m): the multiplier of the prescribed load.

    Prescribed for ``FixedOffset``; else the pressure-weighted mean of r over the points strictly
    between the bounds. Where there is none (every pressure at a bound), the middle of the interval
    the conditions leave open.
    """
    if isinstance(qp.constraint, FixedOffset):
        return -qp.constraint.offset
    working = (pressure > 0.0) & (pressure < qp.cap)
    weight = pressure[working].sum()
    if weight > 0.0:
        return float((pressure[working] * r[working]).sum() / weight)
    capped = pressure > 0.0
    low = r[capped].max() if capped.any() else r.min()
    high = r[~capped].min() if not capped.all() else low
    return float(0.5 * (low + high))


def level_of(qp: ContactQP, totals: Totals) -> float:
    """``level`` from the sums over a state."""
    return -qp.constraint.offset if isinstance(qp.constraint, FixedOffset) else multiplier(totals)


def multiplier(totals: Totals) -> float:
    """Level (m) in the heights of the ``totals`` where the load is prescribed, as ``level``."""
    if totals.weight > 0.0:
        return totals.weighted / totals.weight
    low = totals.highest_capped if np.isfinite(totals.highest_capped) else totals.lowest
    high = totals.lowest_open if np.isfinite(totals.lowest_open) else low
    return 0.5 * (low + high)


def energy(qp: ContactQP, pressure: RealArray, deflection: RealArray) -> float:
    """Total complementary energy per pixel area (Pa·m), p·Kp/2 - p·(h - d); d = 0 under a load."""
    height = qp.profile - qp.constraint.offset if isinstance(qp.constraint, FixedOffset) else qp.profile
    return float((pressure * (0.5 * deflection - height)).sum())


def duality_gap(pressure: RealArray, r: RealArray, cap: float | RealArray, at: float) -> float:
    """Sum of (r - lambda)+ p + (lambda - r)+ (cap - p) in Pa·m; times the pixel area it bounds
    V(p) - V(p*).

    Infinite if r < lambda anywhere without a cap (weak duality of the quadratic programme, Kalker
    1977).
    """
    gap = r - at  # sums of products rather than np.vdot, after which idle threads of BLAS keep the processors busy
    if not isinstance(cap, np.ndarray) and cap == np.inf:
        return np.inf if gap.min() < 0.0 else float((gap * pressure).sum())
    above = float((np.maximum(gap, 0.0) * pressure).sum())
    return above + float((np.maximum(-gap, 0.0) * (cap - pressure)).sum())


def best_level(pressure: RealArray, r: RealArray, cap: float | RealArray) -> float:
    """Level (m) with the smallest duality gap, so the sharpest bound: min r without cap, else a
    weighted median."""
    if not isinstance(cap, np.ndarray) and cap == np.inf:
        return float(r.min())
    # slope of the gap in lambda: sum of (cap - p) where r < lambda, minus sum of p where r > lambda
    return _last_needed(r, cap, float(pressure.sum(dtype=np.float64)))


def _last_needed(heights: RealArray, cap: float | RealArray, total: float) -> float:
    """Height of the last point that is needed for a sum ``total`` of pressures at the ``cap``, the
    lowest points first."""
    values, least = heights.ravel(), float(np.min(cap))
    enough = max(1, math.ceil(total / least)) if total < least * values.size else values.size
    if not isinstance(cap, np.ndarray):
        return float(np.partition(values, enough - 1)[enough - 1])
    lowest = np.argpartition(values, enough - 1)[:enough]
    order = lowest[np.argsort(values[lowest])]
    index = int(np.searchsorted(cap.ravel()[order].cumsum(), total))
    return float(values[order[min(index, enough - 1)]])


_LIGHT = 1e-3
"""Deflection of the mean pressure in the longest wave over the rms height below which a load counts
as light."""

_OFF_CENTRE, _FAR_FROM_ZERO = 10.0, 0.1
"""Mean height over rms height beyond which heights are centred: their rounding is then ten times as
large; and over the deflection of the mean pressure in the longest wave: flat bodies at a height of
1000 such deflections ended at errors of 1e-7, of one at 1e-10."""

MOST_DEFLECTIONS = 30.0
_FEWEST_DEFLECTIONS = 1e-4
_UNRESOLVED = 1e-5


def lightly_loaded(qp: ContactQP) -> bool:
    """Whether a load is prescribed under which the bodies deform by far less than the rms height.

    On a periodic half-space only what differs from the mean pressure deflects: by no more than rms
    [p (H - p)]^1/2 under a cap H.
    """
    if isinstance(qp.constraint, FixedOffset):
        return False
    uneven = mean = qp.constraint.mean_pressure
    if qp.operator.zero_mean_mode and not qp.elastic:
        uneven = min(mean, np.sqrt(mean * max(float(np.max(qp.cap)) - mean, 0.0)))
    return qp.operator.largest * uneven < _LIGHT * qp.height_scale


def heights_near_contact(qp: ContactQP) -> RealArray:
    """Heights (nx, ny) in m from a level near the contact, a copy only where that matters:
    roundings would hide the error.

    At prescribed load any level serves: the height down to which rigid bodies would be in contact
    under a light load, whose deflection is far smaller than the heights, the mean where the profile
    is far from zero. At prescribed position the profile is as it is.
    """
    if isinstance(qp.constraint, FixedOffset):
        return qp.profile
    if lightly_loaded(qp):
        if qp.elastic:
            return qp.profile - float(qp.profile.max())
        profile = qp.operator.engine.numpy(qp.profile) if isinstance(qp.cap, np.ndarray) else qp.profile
        total = qp.constraint.mean_pressure * profile.size * (1.0 - 1e-12)
        return qp.profile + _last_needed(-profile, qp.cap, total)
    mean = float(qp.profile.mean())
    longest = qp.operator.largest * qp.constraint.mean_pressure
    near = min(_OFF_CENTRE * qp.height_scale, _FAR_FROM_ZERO * longest)
    return qp.profile - mean if abs(mean) > near else qp.profile


def scaled_error(qp: ContactQP, error: float, total: float, energy: float) -> float:
    """``error`` (m) over the rms height, or over a length that the bodies' deformation sets where
    that is much different.

    ``total`` is the sum of the pressure, ``energy`` the elastic energy per pixel area (Pa·m), so
    that their ratio is half the mean deflection under load. On self-affine surfaces at loads of
    0.01 to 0.2 E* it is 0.3 to 0.5 of the rms height (in full contact 0.1, where most points yield
    0.05, on small free grids up to 4.5), and the rms height serves.

    * Where bodies deform by much less, as plateaus under tiny loads do, the length is 30 energies
      per load (with the error of the energy). An error of 1e-7 then bounds the duality gap by 3e-6
      of the elastic energy of this contact. Of 10⁴ random small problems with loads over twelve
      decades none that is called converged has a pressure off by more than 1e-3; with the rms
      height for all, or with the work of yielding in the energy, 10 to 20 in 300 had.
    * It is at least ``least_length``, beyond which rounding hides errors.
    """
    deflection = energy / total if total > 0.0 else 0.0
    length = min(qp.height_scale, MOST_DEFLECTIONS * (deflection + error))
    length = max(length, least_length(qp, total, energy))
    return error / length if length > 0.0 else 0.0 if error == 0.0 else np.inf


def least_length(qp: ContactQP, total: float, energy: float) -> float:
    """Length (m) of which errors of 1e-7 to 1e-10 can be resolved.

    1e-4 of the deflection under load, of which roundings of 1e-15 cannot be removed (flat punches,
    heights that are nearly zero), and 1e-5 of the deflection that the mean pressure would cause in
    the longest wave (flat bodies in periodic contact, which hardly deflect at all). An error of
    1e-7 still bounds the pressure to some 1e-5 of its mean.
    """
    deflection = energy / total if total > 0.0 else 0.0
    longest = qp.operator.largest * total / qp.profile.size
    return max(_FEWEST_DEFLECTIONS * deflection, _UNRESOLVED * longest)


ROUNDING = 4.0 * np.finfo(float).eps
"""Rounding of the sums in the error, relative to their terms: the least error reported."""


def relative_error(qp: ContactQP, pressure: RealArray, deflection: RealArray) -> float:
    """``scaled_error`` of the duality gap over total pressure, the customary error of the field; at
    prescribed offset see below.

    With a prescribed offset and no cap the gap is infinite at any penetration; there the error is
    the mean of the pressure-weighted gap plus the largest penetration.
    """
    r = deflection - heights_near_contact(qp)
    total = float(pressure.sum())
    at = level(qp, pressure, r)
    energy = 0.5 * float((pressure * deflection).sum())
    if isinstance(qp.constraint, FixedOffset):
        gap = r + qp.constraint.offset
        penetration = np.maximum(-gap, 0.0)
        if not qp.elastic:
            penetration = np.where(pressure < qp.cap, penetration, 0.0)
        weighted = float((pressure * np.maximum(gap, 0.0)).sum()) / total if total > 0.0 else 0.0
        return scaled_error(qp, weighted + float(penetration.max()), total, energy)
    lowest = duality_gap(pressure, r, qp.cap, float(r.min()))
    found = lowest if qp.elastic else min(lowest, duality_gap(pressure, r, qp.cap, at))
    return scaled_error(qp, found / total, total, energy)


# How far a pressure may be from the solution, by the duality gap and the stiffest wave.


def pressure_error(qp: ContactQP, pressure: RealArray, gap: float) -> float:
    """Bound on the relative L2 error of ``pressure`` (nx, ny) in Pa, from its ``gap`` (Pa·m).

    Infinite where there is none. An error e raises the energy by e·Ke/2 at least and by the gap at
    most, and e·Ke is at least c e·e, c being the compliance of the wave that gives way least:
    |e| <= (2 gap/c)^1/2. At a prescribed position it is the error from the solution under the load
    reached.
    """
    squares = float((pressure * pressure).sum(dtype=np.float64))
    if gap <= 0.0:
        return 0.0
    softest = qp.operator.smallest * squares
    return math.sqrt(2.0 * gap / softest) if softest > 0.0 else math.inf


_PRESSURE_BOUND = 0.05
"""Bound on the error of the pressure that suffices: it is 1e-3 in usual contacts, and the true
error is far below it, 1.4e-4 for 0.05 on a stiff plate on a soft layer whose compliances are 6e6
apart."""

_USUAL = 1e-7
"""Relative error, the default of solvers, at which pressures are bound so; bounds go as a root."""

_FINEST = 1e-13
"""Relative error below which none is asked for: rounding."""


def error_for_pressure(qp: ContactQP, state: SolverState, totals: Totals, asked: float) -> float:
    """Relative error at which the pressure of ``state``, of these ``totals``, is bound well enough;
    infinite where it is.

    Waves that give way little, as those of a stiff plate on a soft layer, change the pressure much
    and the energy little. On a half-space they give way in proportion to their length, and the
    error of the energy serves. Who has ``asked`` for a larger relative error gets one.
    """
    total, energy = totals.pressure, 0.5 * totals.deflected
    if total <= 0.0 or state.error <= _FINEST or isinstance(qp.operator.compliance, HalfSpace):
        return math.inf
    length = max(min(qp.height_scale, MOST_DEFLECTIONS * energy / total), least_length(qp, total, energy))
    bound = pressure_error(qp, state.pressure, state.error * length * total)
    wanted = _PRESSURE_BOUND * max(math.sqrt(asked / _USUAL), 1.0)
    return max(0.5 * state.error * (wanted / bound) ** 2, _FINEST) if bound > wanted else math.inf


# Pressures that respect the bounds and the prescribed load.


LOAD_SWEEPS = 100
"""Rescalings at most; each puts more points at their cap, and a handful suffices."""

LOAD_ROUNDING = 1e-14
"""Relative error of the load that counts as none: the rounding of a sum of 10⁴ terms and more."""


def feasible_start(qp: ContactQP, start: RealArray | None) -> RealArray:
    """Feasible pressure (Pa, float64) near ``start``; without one, uniform or from the overlap."""
    given = start is not None and bool(start.any())
    start = None if start is None else np.asarray(start, dtype=np.float64)
    if isinstance(qp.constraint, FixedMean):
        mean = qp.constraint.mean_pressure
        guess = np.maximum(start, 0.0) if start is not None and given else np.full(qp.profile.shape, mean)
        return scaled_to_load(guess, qp.cap, mean)
    if start is not None and given:
        return np.asarray(np.clip(start, 0.0, qp.cap))
    overlap = np.maximum(qp.operator.engine.numpy(qp.profile) - qp.constraint.offset, 0.0)
    response = float((overlap * qp.operator.apply(overlap)).sum())
    factor = float((overlap**2).sum()) / response if response > 0.0 else 0.0
    return np.asarray(np.clip(factor * overlap, 0.0, qp.cap))


def scaled_to_load(pressure: RealArray, cap: float | RealArray, mean: float) -> RealArray:
    """Pressure (Pa) of the given ``mean``, by scaling the points below ``cap`` and clipping them to
    it, repeatedly.

    ``pressure`` must be >= 0 and ``mean`` at most the mean of ``cap``. Where every loaded point is
    at its cap, the rest of the load is spread over the unloaded ones. At a load that is all the cap
    bears but for rounding, all points are at it: which of them would bear less, and so the level of
    the plane, is rounding.
    """
    if mean >= (1.0 - LOAD_ROUNDING) * np.mean(cap):
        return np.array(np.broadcast_to(cap, pressure.shape), dtype=np.float64)
    if not isinstance(cap, np.ndarray) and cap == np.inf and (total := float(pressure.sum())) > 0.0:
        return np.asarray(pressure * (mean * pressure.size / total), dtype=np.float64)
    p = np.minimum(pressure, cap)
    target = mean * p.size
    for _ in range(LOAD_SWEEPS):
        missing = target - p.sum()
        if abs(missing) <= LOAD_ROUNDING * target:
            break
        below = (p > 0.0) & (p < cap)
        movable = float(p[below].sum())
        if movable + missing > 0.0 and movable > 0.0:
            p[below] *= (movable + missing) / movable
        elif missing < 0.0:
            p *= target / p.sum()
        else:
            p[p < cap] += missing / np.count_nonzero(p < cap)
        np.minimum(p, cap, out=p)
    return p
