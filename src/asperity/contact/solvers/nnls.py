"""Contact as non-negative least squares on a Cholesky factor (Bemporad & Paggi 2015; Lawson & Hanson 1974)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from .dense_form import ROUNDING, DenseQP, OnSet, answered, dense_form, gaps, solve_on, started, violation
from .protocol import ContactQP, SolverState, require_settings

LARGEST_CAPPED = 1600
"""Largest number of points with a cap that is reached: BVLS took 4 s for 256 points and six minutes for 6144."""


@dataclass(frozen=True)
class NonNegativeLeastSquares:
    """Least squares with bounds, min |Rx - c|² with RᵀR the compliance; by library routines, for small grids.

    Lawson and Hanson's NNLS serves while the pressure cap is not reached, their extension to two bounds (BVLS) beyond. A prescribed
    load is met exactly: the level of the plane is a Newton iteration on the piecewise linear, monotone load curve, two
    to four least-squares problems. The library cannot start from a guess, so the start only sets the first level.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) that the answer must meet; rounding is about 1e-15, or with a cap
        1e-16 times cap over mean pressure.
    max_iterations
        Largest number of least-squares problems.
    """

    tolerance: float = 1e-10
    max_iterations: int = 100
    name: ClassVar[str] = "nnls"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bemporad2015", "Lawson1974")

    def __post_init__(self) -> None:
        require_settings(self)

    def init(self, qp: ContactQP, start: RealArray | None) -> SolverState:
        """State at ``start``."""
        return started(qp, start)

    def step(self, qp: ContactQP, state: SolverState) -> SolverState:
        """The whole solve.

        Raises
        ------
        InputError
            If the grid is too large for a dense matrix.
        """
        dense = dense_form(qp)
        start = state.pressure.ravel() / dense.unit
        x, used = _solve(dense, start, self.max_iterations - state.iterations)
        return answered(qp, state, x, dense.unit, iterations=used, tolerance=self.tolerance)


def _solve(qp: DenseQP, start: RealArray, limit: int) -> tuple[RealArray | None, int]:
    """Solution, or None if ``limit`` least-squares problems did not suffice; number of them.

    Least squares needs a definite matrix: A + s·1·1ᵀ. Its level is the wanted one plus s·sum(x), which is the root of
    an increasing function; each trial contact set gives the root of its own linear piece, bracketed by what is known.
    """
    from scipy.linalg import cholesky

    factor = cholesky(qp.matrix + qp.shift)
    low, high = -np.inf, np.inf
    level = _first_level(qp, start)
    for count in range(limit):
        trial = _bounded(qp, factor, qp.heights + level)
        total = float(trial.x.sum())
        exact = solve_on(qp, trial.free, trial.capped)
        if violation(qp, exact, gaps(qp, exact)) <= ROUNDING:
            return exact.x, count + 1
        excess = level - qp.shift * total if qp.total is None else total - qp.total
        low, high = (low, level) if excess > 0.0 else (level, high)
        newton = exact.level + qp.shift * float(exact.x.sum())
        if qp.total is not None and not trial.free.any():  # the load curve is flat here: take its next piece
            newton = _beyond_next_kink(qp, trial, rising=excess < 0.0)
        level = newton if low < newton < high else 0.5 * (low + high)
        if not np.isfinite(level) or level in (low, high):  # least squares has lost the set to rounding
            return exact.x, count + 1
    return None, limit


def _beyond_next_kink(qp: DenseQP, trial: OnSet, *, rising: bool) -> float:
    """Level with the prescribed load if the point nearest to leaving its bound left it."""
    r = qp.matrix @ trial.x - qp.heights
    if rising:
        nearest = int(np.argmin(np.where(trial.capped, np.inf, r)))
    else:
        nearest = int(np.argmax(np.where(trial.capped, r, -np.inf)))
    free, capped = trial.free.copy(), trial.capped.copy()
    free[nearest], capped[nearest] = True, False
    following = solve_on(qp, free, capped)
    return following.level + qp.shift * float(following.x.sum())


def _first_level(qp: DenseQP, start: RealArray) -> float:
    if qp.total is None:
        return qp.shift * float(start.sum())
    r = qp.matrix @ start - qp.heights
    return float((start * r).sum() / start.sum()) + qp.shift * qp.total


def _bounded(qp: DenseQP, factor: RealArray, heights: RealArray) -> OnSet:
    """Minimise |Rx - c|² within the bounds, with R the upper Cholesky factor and Rᵀc = heights."""
    from scipy.linalg import solve_triangular
    from scipy.optimize import lsq_linear, nnls

    right = solve_triangular(factor, heights, trans="T")
    x = nnls(factor, right, maxiter=30 * right.size)[0]
    if (x > qp.cap).any():  # BVLS is far slower, and needless where the cap is not reached
        if x.size > LARGEST_CAPPED:
            raise InputError(
                f"grid of nnls with a pressure cap must have at most {LARGEST_CAPPED} points, but has {x.size}: the "
                "library's bounded least squares would take minutes. Use ConjugateGradient() or DenseActiveSet()."
            )
        fit = lsq_linear(factor, right, bounds=(0.0, qp.cap), method="bvls", tol=1e-14, max_iter=30 * right.size)
        x = np.where(fit.active_mask > 0, qp.cap, np.where(fit.active_mask < 0, 0.0, fit.x))
    return OnSet(x, 0.0, (x > 0.0) & (x < qp.cap), x >= qp.cap)
