"""Quasi-Newton with bounds, L-BFGS-B (Byrd et al. 1995; for rough contact Peng & Bhushan 2001)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar, NamedTuple

import numpy as np

from ....core.arrays import RealArray
from ..protocol import (
    ContactQP,
    FixedMean,
    FixedOffset,
    Iterative,
    SolverState,
    feasible_start,
    level,
    relative_error,
    scaled_to_load,
)
from .steepest_descent import levelling_step

_STALLS = 8
"""Runs of the library without a smaller error or load error after which the method gives up: more
than the two or three that the bracketing of the level may take without."""

_PAIRS = 20
"""Pairs of steps and gradients from which the library builds its Hessian; its default of 10 is for
smooth problems."""


class _Minimum(NamedTuple):
    """``pressure`` (Pa) of least energy at a level, the ``iterations`` of the library,
    ``applications`` of the operator."""

    pressure: RealArray
    iterations: int
    applications: int


@dataclass(frozen=True)
class _Memory:
    """Scales, and the search for the level at which the unconstrained load is the prescribed one.

    ``length`` (m) and ``unit`` (Pa) make pressures and gaps of order one; ``load_stiffness`` (m/Pa)
    multiplies the load error; ``plane`` (m) is the current level, known to lie between ``low`` and
    ``high``; ``last`` holds the previous level and its load error (Pa, sum over the points);
    ``runs`` counts the library's runs; ``best`` is the smallest error so far and ``nearest`` the
    smallest load error, ``stalls`` the steps since either.
    """

    length: float
    unit: float
    load_stiffness: float
    plane: float
    low: float = -math.inf
    high: float = math.inf
    last: tuple[float, float] | None = None
    runs: int = 0
    best: float = math.inf
    nearest: float = math.inf
    stalls: int = 0


@dataclass(frozen=True)
class QuasiNewton(Iterative):
    """Library L-BFGS-B in variables of order one, measured from the last iterate so that no digits
    cancel.

    One step of this solver is one run of the library. A prescribed load is held by an augmented
    Lagrangian: the level follows its multiplier rule, then secants of the load curve within
    brackets, and the last small load error is removed by scaling, so that the load is exact and the
    reported error that of the pressure returned.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) at which to stop.
    max_iterations
        Largest number of quasi-Newton iterations, all runs together.
    """

    tolerance: float = 1e-7
    max_iterations: int = 20000
    name: ClassVar[str] = "quasi_newton"
    citation_keys: ClassVar[tuple[str, ...]] = ("Byrd1995", "PengBhushan2001")

    def __post_init__(self) -> None:
        super().__post_init__()

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``."""
        begin = feasible_start(qp, start)
        deflection = qp.operator.apply(begin)
        pixel = 1.0 / (levelling_step(qp) or 1.0)
        stiffness, plane = 0.0, -qp.constraint.offset if isinstance(qp.constraint, FixedOffset) else 0.0
        if isinstance(qp.constraint, FixedMean):
            stiffness = pixel / math.sqrt(begin.size)  # as stiff as the longest wave
            plane = level(qp, begin, deflection - qp.profile) + stiffness * float(begin.sum())
        memory = _Memory(qp.height_scale, qp.height_scale / pixel, stiffness, plane)
        error = relative_error(qp, begin, deflection)
        return SolverState(begin, deflection, error, applications=2, memory=replace(memory, best=error))

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """One run of L-BFGS-B, and the next level."""
        memory = state.memory
        assert isinstance(memory, _Memory)
        minimum = self._minimised(qp, state, memory)
        p, applications = minimum.pressure, minimum.applications
        nearer = False
        if isinstance(qp.constraint, FixedMean):
            load_error = float(p.sum()) - qp.constraint.mean_pressure * p.size
            # level (m) up (or down) to which the load stays as it is when every pressure is at a
            # bound
            kink, rising, capped = math.inf, load_error < 0.0, (p > 0.0) & (p >= qp.cap)
            candidates = (p <= 0.0) if rising else capped
            if not ((p > 0.0) & ~capped).any() and candidates.any():
                r = qp.operator.apply(p) - qp.profile + memory.load_stiffness * float(p.sum())
                kink = float(r[candidates].min() if rising else r[candidates].max())
            applications += int(math.isfinite(kink))
            p = scaled_to_load(p, qp.cap, qp.constraint.mean_pressure)
            nearer = abs(load_error) < memory.nearest
            # Secant of the load curve, between safe bounds. The load grows with the level by at
            # most 1/load_stiffness, so that the multiplier rule, counted from the kink up to which
            # the curve is flat, never goes too far: a secant is at least as long. Every third run
            # halves the bracket, for a secant may keep one end of it.
            plane = memory.plane
            low, high = (memory.low, plane) if load_error > 0.0 else (plane, memory.high)
            base = kink if math.isfinite(kink) else plane
            safe = following = base - memory.load_stiffness * load_error
            if memory.last is not None:
                before, error_before = memory.last
                slope = (load_error - error_before) / (plane - before) if plane != before else 0.0
                if slope > 0.0:
                    following = plane - load_error / slope
                following = min(following, safe) if load_error > 0.0 else max(following, safe)
            if not low < following < high or (memory.runs % 3 == 2 and math.isfinite(low + high)):
                following = 0.5 * (low + high) if math.isfinite(low + high) else safe
            memory = replace(
                memory,
                plane=following,
                low=low,
                high=high,
                last=(plane, load_error),
                runs=memory.runs + 1,
                nearest=min(abs(load_error), memory.nearest),
            )
        deflection = qp.operator.apply(p)
        error = relative_error(qp, p, deflection)
        stalls = 0 if nearer or error < memory.best else memory.stalls + 1
        return SolverState(
            p,
            deflection,
            error,
            state.iterations + max(minimum.iterations, 1),
            state.applications + applications + 1,
            exhausted=stalls >= _STALLS,
            memory=replace(memory, best=min(error, memory.best), stalls=stalls),
        )

    def _minimised(self, qp: ContactQP, state: SolverState, memory: _Memory) -> _Minimum:
        """Pressure of least energy at the current level."""
        from scipy.optimize import Bounds, minimize

        reference, shape = state.pressure, state.pressure.shape
        excess = 0.0
        if isinstance(qp.constraint, FixedMean):
            excess = memory.load_stiffness * float(reference.sum())
        gap = (state.deflection - qp.profile - memory.plane + excess).ravel() / memory.length
        factor = memory.unit / memory.length

        def energy(x: np.ndarray[tuple[int], np.dtype[np.float64]]) -> tuple[float, RealArray]:
            response = factor * (qp.operator.apply(x.reshape(shape)).ravel() + memory.load_stiffness * x.sum())
            return float(x @ gap + 0.5 * (x @ response)), gap + response

        # mean over largest pressure: where a cap is far away, even small overlaps weigh in the
        # duality gap
        leverage = 1.0
        if isinstance(qp.constraint, FixedMean) and not qp.elastic:
            leverage = min(1.0, qp.constraint.mean_pressure / float(np.mean(qp.cap)))
        upper = np.broadcast_to((np.asarray(qp.cap) - reference) / memory.unit, shape).ravel()
        lower = -reference.ravel() / memory.unit
        fit = minimize(
            energy,
            np.zeros(reference.size),
            jac=True,
            method="L-BFGS-B",
            bounds=Bounds(lower, upper),
            options={
                "maxiter": max(self.max_iterations - state.iterations, 1),
                "maxfun": 10 * self.max_iterations,
                "maxcor": _PAIRS,
                "ftol": 0.0,
                "gtol": 0.1 * self.tolerance * leverage,
            },
        )
        moved = reference + memory.unit * fit.x.reshape(shape)
        moved = np.where(fit.x.reshape(shape) >= upper.reshape(shape), qp.cap, np.clip(moved, 0.0, qp.cap))
        moved = np.where(fit.x.reshape(shape) <= lower.reshape(shape), 0.0, moved)
        return _Minimum(moved, int(fit.nit), int(fit.nfev))
