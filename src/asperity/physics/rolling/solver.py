"""Steady rolling with given bounds, directly: Newton's method on stick and slip in material that
moves through the contact.

While the material moves by one pixel against the rolling direction, points slip by

    s = b - A q,   A = C - T C,   b = w Δ + (T - 1) u_p,

with T the value one pixel ahead, C the tangential compliance, w the rigid slip over the rolling
speed, Δ the pixel, and u_p the displacement by pressure (Kalker 1990). Between s and q the friction
law holds as in a step in time. A is not symmetric and there is no energy; its symmetric part is
positive definite, so that there is one solution.

Linear systems are solved by GMRES. Where points stick, sums of the residual from the leading end of
the stretch backwards undo the difference 1 - T but for a constant in each row, and nested cells
undo C; slipping points take their own diagonal.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ...contact.operators.convolution import restricted
from ...contact.solvers.protocol import Iterative
from ...core.arrays import BoolArray, RealArray
from ..friction.operator import TangentialOperator
from ..friction.solver.linear_system import Workspace
from ..friction.solver.newton import COARSEST, StickSlipNewton
from ..friction.solver.problem import Deviation, Points, Sets, TangentialQP, TangentialSolution, ended, size_of

_REDUCTION = 0.01
"""Reduction of the residual in a linear system while points change between stick and slip."""

_SETTLED = 0.02
"""Share of points that change between stick and slip below which the sets count as nearly
settled."""

_MARGIN = 0.1
"""Share of the reduction to the tolerance aimed at on settled sets."""

_FINEST = 1e-8
"""Reduction at most in one system."""

_MOST_PRODUCTS = 150
"""Products with the compliance in one system at most; twenty to forty reduce the residual to
1e-6."""

_FALL = 0.9
"""Error over the lowest so far that counts as progress."""

_PATIENCE = 6
"""Newton steps without progress after which the material is moved by a pixel instead, which always
leads towards the solution."""

_LOOSEST = 0.01
"""Error at which a coarse grid is left."""


@dataclass(frozen=True)
class Direction:
    """Rolling direction along an ``axis`` of the grid, forwards or backwards by its ``sign``."""

    axis: int = 0
    sign: int = 1

    def ahead(self, field: RealArray, pixels: int = 1, *, wraps: bool) -> RealArray:
        """Values of ``field`` (2, nx, ny) so many ``pixels`` ahead; beyond the end of a grid that
        does not wrap its last ones."""
        axis = self.axis + 1
        moved = np.roll(field, -self.sign * pixels, axis=axis)
        if not wraps:
            along, last = np.moveaxis(moved, axis, 0), np.moveaxis(field, axis, 0)
            if self.sign > 0:
                along[-pixels:] = last[-1]
            else:
                along[:pixels] = last[0]
        return moved

    def oriented(self, field: NDArray[Any]) -> NDArray[Any]:
        """View of ``field`` (nx, ny) whose first index grows along the direction."""
        along = field if self.axis == 0 else field.T
        return along if self.sign > 0 else along[::-1]


@dataclass(frozen=True, eq=False)
class RollingQP:
    """Steady rolling with given bounds.

    Attributes
    ----------
    operator
        Shear traction to tangential displacement.
    bound
        Largest shear traction (nx, ny) in Pa: zero outside the contact.
    rigid
        Slip (2, nx, ny) in m of rigid bodies during a move by one pixel.
    drawn
        Displacement (2, nx, ny) in m by the pressure.
    direction
        That of rolling.
    """

    operator: TangentialOperator
    bound: RealArray
    rigid: RealArray
    drawn: RealArray
    direction: Direction = Direction()

    def ahead(self, field: RealArray, pixels: int = 1) -> RealArray:
        """Values of ``field`` (2, nx, ny) so many ``pixels`` ahead."""
        wraps = self.operator.boundary.wraps[self.direction.axis]
        return self.direction.ahead(field, pixels, wraps=wraps)

    def displacement(self, traction: RealArray) -> RealArray:
        """Displacement (2, nx, ny) in m of the body over the counter body under ``traction`` (2,
        nx, ny) in Pa and the pressure."""
        return self.operator.displacement(traction) + self.drawn

    def moved(self, before: RealArray, pixels: int = 1) -> TangentialQP:
        """The step in which the material with the displacement ``before`` (2, nx, ny) moves by so
        many ``pixels``."""
        target = pixels * self.rigid + self.ahead(before, pixels) - self.drawn
        return TangentialQP(self.operator, self.bound, target)

    @property
    def coarsened(self) -> RollingQP:
        """On the grid of half as many points per side, where a pixel is twice as long."""
        rigid, drawn = (np.stack([restricted(part) for part in field]) for field in (self.rigid, self.drawn))
        return replace(
            self, operator=self.operator.coarsened, bound=restricted(self.bound), rigid=2.0 * rigid, drawn=drawn
        )


@dataclass(frozen=True)
class SteadyNewton(Iterative):
    """Newton's method on steady rolling.

    Parameters
    ----------
    tolerance
        Largest ``Deviation.error``, in (0, 1).
    max_iterations
        Newton steps at most.

    Raises
    ------
    InputError
        If a number is out of range.
    """

    tolerance: float = 1e-6
    max_iterations: int = 100
    name: ClassVar[str] = "steady newton"
    citation_keys: ClassVar[tuple[str, ...]] = ("Alart1991", "Kalker1990")

    def solve(self, qp: RollingQP, start: RealArray | None = None) -> TangentialSolution:
        """Traction, and slip during a move by one pixel, from the traction ``start`` (2, nx, ny) in
        Pa; by default from coarser grids."""
        step = qp.moved(qp.drawn)
        points, pairs = Points.of(step), 0.0
        if not len(points.index):
            nothing = np.zeros((2, 0)), np.zeros((2, 0)), np.zeros(2)
            return ended(step, points, nothing, Deviation(0.0, 0.0), tolerance=1.0, work=(0, 0.0))
        if start is None:
            # in proportion to the bound as on the grid of half as many points per side
            shape = qp.bound.shape
            start = np.zeros((2, *shape))
            if max(shape) > COARSEST and np.isfinite(qp.bound).all():
                coarse = qp.coarsened
                rough = replace(self, tolerance=max(self.tolerance, _LOOSEST)).solve(coarse)
                ratio = rough.traction / np.where(coarse.bound > 0.0, coarse.bound, 1.0)
                fine = ratio.repeat(2, axis=1).repeat(2, axis=2)[:, : shape[0], : shape[1]]
                start, pairs = fine * qp.bound, rough.pairs * coarse.bound.size / qp.bound.size
        iteration = _Iteration(qp, points, start, self)
        iteration.pairs += pairs
        found, iterate, count = iteration.solved()
        return ended(step, points, iterate, found, tolerance=self.tolerance, work=(count, iteration.pairs))


class _Iteration:
    """Traction ``q`` (2, n) of one solve on the points of its contact."""

    def __init__(self, qp: RollingQP, points: Points, start: RealArray, settings: SteadyNewton) -> None:
        self.qp, self.points, self.settings = qp, points, settings
        self.work = Workspace.of(qp.operator, points, "float64")
        self.q = points.projected(points.gathered(start))
        self.pairs = 0.0

    def product(self, values: RealArray) -> RealArray:
        """A times ``values`` (2, n), at the points."""
        u = self.qp.operator.displacement(self.points.scattered(values, self.qp.bound.shape))
        self.pairs += self.qp.operator.pairs_per_application
        return self.points.gathered(u - self.qp.ahead(u))

    def solved(self) -> tuple[Deviation, tuple[RealArray, RealArray, RealArray], int]:
        """Steps until the error is reached: deviation, traction, slip and no shift, and the number
        of steps."""
        settings, before = self.settings, np.zeros(len(self.points.index), dtype=bool)
        lowest, idle = np.inf, 0
        for count in range(settings.max_iterations + 1):
            s = self.points.target - self.product(self.q)
            found = Deviation.of(self.points, self.q, self.points.target - s, s)
            error = found.error
            if error <= settings.tolerance or count == settings.max_iterations:
                break
            idle = 0 if error < _FALL * lowest else idle + 1
            lowest = min(lowest, error)
            sets = Sets.of(self.points, self.q, s)
            settled = np.count_nonzero(sets.slip != before) <= _SETTLED * len(before)
            before = sets.slip
            if idle > _PATIENCE:  # the tractions after the material has moved by a pixel
                idle, field = 0, self.points.scattered(self.q, self.qp.bound.shape)
                moved = self.qp.moved(self.qp.displacement(field))
                rolled = StickSlipNewton(max(settings.tolerance, 1e-8)).solve(moved, field)
                self.pairs += rolled.pairs
                self.q = self.points.gathered(rolled.traction)
                continue
            wanted = max(_MARGIN * settings.tolerance / error, _FINEST) if settled else _REDUCTION
            self._step(sets, s, min(wanted, _REDUCTION))
        return found, (self.q, s, np.zeros(2)), count

    def _step(self, sets: Sets, s: RealArray, reduction: float) -> None:
        """One step of Newton's method: slipping tractions turn on their circles, sticking ones stay
        within their bounds."""
        from scipy.sparse.linalg import LinearOperator, gmres

        unit, slip, tangent = self.work.pixel, sets.slip, sets.tangent
        bound = np.where(slip, self.points.bound, 1.0)
        curvature = np.where(slip, sets.outward / bound / unit, 0.0)

        def product(values: RealArray) -> RealArray:
            d = values.reshape(2, -1)
            return (sets.free_part(self.product(d)) / unit + curvature * d).ravel()

        shape = (s.size, s.size)
        solution, _ = gmres(
            LinearOperator(shape, product),
            (sets.free_part(s) / unit).ravel(),
            M=LinearOperator(shape, self._preconditioner(sets, curvature)),
            rtol=reduction,
            atol=0.0,
            restart=_MOST_PRODUCTS,
            maxiter=1,
        )
        d = solution.reshape(2, -1)
        towards = self.q / bound + tangent * (np.einsum("ij,ij->j", d, tangent) / bound)
        turned = towards * (bound / np.where(slip, size_of(towards), 1.0))
        self.q = np.where(slip, turned, self.points.projected(self.q + d))

    def _preconditioner(self, sets: Sets, curvature: RealArray) -> Callable[[RealArray], RealArray]:
        """Approximate inverse of the system at ``sets``.

        Residuals of sticking points are summed over themselves and those ahead, as far as their
        stretch of a row goes; where the grid wraps rows are taken twice.
        """
        sticks, tangent, share = ~sets.slip, sets.tangent, 1.0 / (1.0 + curvature)
        index, ones = self.points.index[sticks], np.ones(int(np.count_nonzero(sticks)))
        shape, direction = self.qp.bound.shape, self.qp.direction
        free = self.qp.operator.engine.points(shape, index, self.work.dtype)
        cells, whole = self.work.cells, np.stack([ones, 0.0 * ones, ones])
        cells.factorise(free, whole)
        mask: BoolArray = np.zeros(shape[0] * shape[1], dtype=bool)
        mask[index] = True
        copies = 2 if self.qp.operator.boundary.wraps[direction.axis] else 1
        along = np.concatenate([direction.oriented(mask.reshape(shape))] * copies)
        place = np.where(along, len(along), np.arange(len(along))[:, None])
        # first place ahead that does not belong to them, by rows along the direction
        stop = np.minimum.accumulate(place[::-1], axis=0)[::-1][: len(along) // copies]

        def summed(r: RealArray) -> RealArray:
            field = np.zeros(shape[0] * shape[1])
            field[index] = r
            rows = np.concatenate([direction.oriented(field.reshape(shape))] * copies)
            total = np.zeros((len(rows) + 1, rows.shape[1]))
            total[:-1] = np.cumsum(rows[::-1], axis=0)[::-1]
            out = np.empty(shape)
            direction.oriented(out)[...] = total[: len(stop)] - np.take_along_axis(total, stop, axis=0)
            return np.asarray(out.ravel()[index])

        def apply(values: RealArray) -> RealArray:
            r = values.reshape(2, -1)
            out = tangent * (np.einsum("ij,ij->j", r, tangent) * share)
            if len(index):
                ahead = np.stack([summed(component[sticks]) for component in r])
                out[:, sticks] = cells.solve(free, ahead, whole)
            return np.asarray(out.ravel())

        return apply
