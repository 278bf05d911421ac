"""Contact as non-negative least squares on a Cholesky factor (Bemporad & Paggi 2015; Lawson &
Hanson 1974)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ....core.arrays import BoolArray, RealArray
from ....core.errors import InputError
from ..protocol import ContactQP, Iterative, SolverState
from .dense import ROUNDING, DenseQP, OnSet, answered, dense_form, gaps, solve_on, started, violation

LARGEST_CAPPED = 1600
"""Largest number of points with a cap that is reached: BVLS took 4 s for 256 points and six minutes
for 6144."""


@dataclass(frozen=True)
class NonNegativeLeastSquares(Iterative):
    """Least squares with bounds, min |Rx - c|² with RᵀR the compliance; by library routines, for
    small grids.

    Lawson and Hanson's NNLS serves while the pressure cap is not reached, their extension to two
    bounds (BVLS) beyond. A prescribed load is met exactly: the level of the plane is a Newton
    iteration on the piecewise linear, monotone load curve, two to four least-squares problems. The
    library cannot start from a guess. So each problem is solved for the points near which the
    contact on a grid of half as many points along each axis lies; points that would overlap
    elsewhere join, until none does.

    Parameters
    ----------
    tolerance
        Relative error (see ``relative_error``) that the answer must meet; rounding is about 1e-15,
        or with a cap 1e-16 times cap over mean pressure.
    max_iterations
        Largest number of least-squares problems.
    """

    tolerance: float = 1e-10
    max_iterations: int = 100
    name: ClassVar[str] = "nnls"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bemporad2015", "Lawson1974")

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
        x, used = _solve(dense, start, self.max_iterations - state.iterations, qp.profile.shape)
        return answered(qp, state, x, dense.unit, iterations=used, tolerance=self.tolerance)


def _solve(qp: DenseQP, start: RealArray, limit: int, shape: tuple[int, ...]) -> tuple[RealArray | None, int]:
    """Solution, or None if ``limit`` least-squares problems did not suffice; number of them.

    Least squares needs a definite matrix: A + s·1·1ᵀ. Its level is the wanted one plus s·sum(x),
    which is the root of an increasing function; each trial contact set gives the root of its own
    linear piece, bracketed by what is known.
    """
    start, near = _from_coarser(qp, start, limit, shape)
    low, high = -np.inf, np.inf
    if qp.total is None:
        level = qp.shift * float(start.sum())
    else:
        r = qp.matrix @ start - qp.heights
        level = float((start * r).sum() / start.sum()) + qp.shift * qp.total
    for count in range(limit):
        trial = _bounded(qp, qp.heights + level, near)
        near = near | (trial.x > 0.0)
        total = float(trial.x.sum())
        exact = solve_on(qp, trial.free, trial.capped)
        if violation(qp, exact, gaps(qp, exact)) <= ROUNDING:
            return exact.x, count + 1
        excess = level - qp.shift * total if qp.total is None else total - qp.total
        low, high = (low, level) if excess > 0.0 else (level, high)
        newton = exact.level + qp.shift * float(exact.x.sum())
        if qp.total is not None and not trial.free.any():  # the load curve is flat here: take its next piece
            # the level with the prescribed load if the point nearest to leaving its bound left it
            r = qp.matrix @ trial.x - qp.heights
            if excess < 0.0:
                nearest = int(np.argmin(np.where(trial.capped, np.inf, r)))
            else:
                nearest = int(np.argmax(np.where(trial.capped, r, -np.inf)))
            free, capped = trial.free.copy(), trial.capped.copy()
            free[nearest], capped[nearest] = True, False
            following = solve_on(qp, free, capped)
            newton = following.level + qp.shift * float(following.x.sum())
        level = newton if low < newton < high else 0.5 * (low + high)
        if not np.isfinite(level) or level in (low, high):  # least squares has lost the set to rounding
            return exact.x, count + 1
    return None, limit


SMALL = 256
"""Points of a grid from which on a coarser one saves time."""


def _from_coarser(qp: DenseQP, start: RealArray, limit: int, shape: tuple[int, ...]) -> tuple[RealArray, BoolArray]:
    """First guess from a grid of half as many points along each axis: x, and the points in contact
    there and beside it.

    Small or odd grids have none: ``start``, and all points.
    """
    nx, ny = shape
    if qp.heights.size <= SMALL or nx % 2 or ny % 2:
        return start, np.ones(qp.heights.size, dtype=bool)
    cells = (nx // 2, 2, ny // 2, 2)
    coarse = DenseQP(
        matrix=qp.matrix.reshape(cells + cells).mean(axis=(1, 3, 5, 7)).reshape(2 * [nx * ny // 4]),
        heights=qp.heights.reshape(cells).max(axis=(1, 3)).ravel(),  # the point of a cell that touches first
        cap=qp.cap.reshape(cells).sum(axis=(1, 3)).ravel(),
        total=qp.total,
        singular=qp.singular,
        unit=qp.unit,
        light=qp.light,
    )
    begin = start.reshape(cells).sum(axis=(1, 3)).ravel()
    found, _ = _solve(coarse, begin, limit, (nx // 2, ny // 2))
    x = (begin if found is None else found).reshape(nx // 2, ny // 2)
    touching = x > 0.0
    for axis in (0, 1):
        touching = touching | np.roll(touching, 1, axis) | np.roll(touching, -1, axis)
    fine = np.repeat(np.repeat(np.stack([x / 4.0, touching]), 2, axis=1), 2, axis=2)
    return fine[0].ravel(), fine[1].ravel() > 0.0


def _bounded(qp: DenseQP, heights: RealArray, near: BoolArray) -> OnSet:
    """Minimise x·(A + s)x/2 - x·heights within the bounds; ``near``: points to begin with."""
    taken, lowest = near.copy(), -ROUNDING * (1.0 + float(np.abs(heights).max()))
    while True:
        x = np.zeros(heights.size)
        x[taken] = _least_squares(qp, heights, taken)
        overlapping = ~taken & (qp.matrix @ x + qp.shift * float(x.sum()) - heights < lowest)
        if not overlapping.any():
            return OnSet(x, 0.0, (x > 0.0) & (x < qp.cap), x >= qp.cap)
        taken |= overlapping


def _least_squares(qp: DenseQP, heights: RealArray, taken: BoolArray) -> RealArray:
    """Minimise |Rx - c|² on the points ``taken``, with R the upper Cholesky factor and Rᵀc =
    heights."""
    from scipy.linalg import cholesky, solve_triangular
    from scipy.optimize import lsq_linear, nnls

    factor, cap = cholesky(qp.matrix[np.ix_(taken, taken)] + qp.shift), qp.cap[taken]
    right = solve_triangular(factor, heights[taken], trans="T")
    x: RealArray = nnls(factor, right, maxiter=30 * right.size)[0]
    if (x > cap).any():  # BVLS is far slower, and needless where the cap is not reached
        if x.size > LARGEST_CAPPED:
            raise InputError(
                f"grid of nnls with a pressure cap must have at most {LARGEST_CAPPED} points near the contact, "
                f"but has {x.size}: the library's bounded least squares would take minutes. Use "
                "ConjugateGradient() or DenseActiveSet()."
            )
        fit = lsq_linear(factor, right, bounds=(0.0, cap), method="bvls", tol=1e-14, max_iter=30 * right.size)
        x = np.where(fit.active_mask > 0, cap, np.where(fit.active_mask < 0, 0.0, fit.x))
    return x
