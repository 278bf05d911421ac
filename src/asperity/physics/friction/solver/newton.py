"""Semi-smooth Newton's method on stick and slip, inexact and on nested grids: the fast tangential
solver.

A step sorts the points of the contact into sticking ones (traction below its bound, or at it and
pushed back inside) and slipping ones, solves the linear system of ``linear_system`` to a modest
accuracy, turns slipping tractions on their circles and puts sticking ones that went beyond their
bound back on it (Alart & Curnier 1991, with the active sets of the normal solver). The energy falls
in every step: one that would raise it is halved, and at last replaced by one along the projected
gradient. First guesses come from coarser grids.

Behind some constants stand FFT pairs for other values: means on self-affine surfaces of two seeds,
256², load 0.05 E*, tolerance 1e-6. *Force*: equal bodies of ν = 0.3 at 0.5 and 0.9 of the limit;
*shift*: a prescribed one; *coated*: both on a layer of E 4, h 4 pixels; *field*: slip in all
directions at once. The constants as they are take 48, 58, 61 and 85 pairs.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Literal, NamedTuple

import numpy as np

from ....contact.operators.convolution import restricted
from ....contact.solvers.protocol import Iterative
from ....core import require
from ....core.arrays import RealArray
from .linear_system import NewtonSystem, Workspace
from .problem import Deviation, Points, Sets, TangentialQP, TangentialSolution, best_shift, ended, size_of

_SETTLED = 0.003
"""Share of points that change between stick and slip below which the sets count as nearly
settled."""

_NEAR = 0.03
"""Error of a start from which on its sets count as settled: that of an earlier round of the same
step."""

_REDUCTION = 0.3
"""Reduction of the residual while sets change: conjugate gradients gain a factor of 3 to 4 a
step."""

_UNSETTLED_STEPS = 3
_SETTLED_STEPS = 12
"""Products with the compliance in one system, at most, while sets change, and on settled ones:
doubled whenever the error does not fall to a half. Pairs for 2, 4, 6 while sets change the same as
for 3; for 6 on settled ones force 46, shift 54, coated 57, field 79; for 24 as for 12."""

_MOST_DOUBLINGS = 5
"""Doublings of these products at most. Pairs for 0, 2, 8: the same; no case of the sweep needs
one."""

_MARGIN = 0.3
"""Share of the reduction to the tolerance aimed at on settled sets: the gap is a sum of first
powers of the residual, which is large where bounds are."""

_FINEST = 1e-4
"""Reduction at most in one system, which is in single precision."""

_REFRESH = 1e-4
"""Fall of the error since the displacement was computed from scratch after which it is again:
updates are in single precision."""

_ROUGH = 1e-4
"""Error above which updates in single precision need no check."""

_SLOW = 0.5
"""Error over the lowest so far above which rounding of the updates may be the reason."""

_HALVINGS = 5
"""Lengths of a step that are tried before one along the projected gradient takes its place. Pairs
for 1, 3, 8: the same; just below the limit of friction steps get there."""

_ROUNDING = 4.0 * np.finfo(float).eps
"""Rise of the energy, over the work of the slip, that is rounding of the sums."""

COARSEST = 32
"""Points per side at which there is no coarser grid."""

_LOOSEST = 0.02
"""Error at which a coarse grid is left: its contact is not that of the finer grid anyway."""


@dataclass(frozen=True)
class StickSlipNewton(Iterative):
    """Newton's method on stick and slip.

    Parameters
    ----------
    tolerance
        Largest ``Deviation.error``, in (0, 1).
    max_iterations
        Newton steps at most.
    precision
        ``"mixed"``: linear systems in single precision, iterates in double; or ``"double"``.

    Raises
    ------
    InputError
        If a number is out of range.
    """

    tolerance: float = 1e-6
    max_iterations: int = 100
    precision: Literal["mixed", "double"] = "mixed"
    name: ClassVar[str] = "newton"
    citation_keys: ClassVar[tuple[str, ...]] = ("Alart1991", "Kalker1990")

    def __post_init__(self) -> None:
        super().__post_init__()
        require.one_of(self.precision, ("mixed", "double"), "precision of the tangential solver")

    def solve(self, qp: TangentialQP, start: RealArray | None = None) -> TangentialSolution:
        """Solution of ``qp`` from the traction ``start`` (2, nx, ny) in Pa; by default from coarser
        grids."""
        points, pairs = Points.of(qp), 0.0
        if not len(points.index):
            nothing = np.zeros((2, 0)), np.zeros((2, 0)), np.zeros(2)
            return ended(qp, points, nothing, Deviation(0.0, 0.0), tolerance=1.0, work=(0, 0.0))
        shape = qp.bound.shape
        if start is None and min(shape) > COARSEST and np.isfinite(qp.bound).all():
            # in proportion to the bound as on the grid of half as many points per side
            bound = restricted(qp.bound)
            target = np.stack([restricted(component) for component in qp.target])
            coarse = replace(qp, operator=qp.operator.coarsened, bound=bound, target=target)
            found = replace(self, tolerance=max(self.tolerance, _LOOSEST)).solve(coarse)
            ratio = found.traction / np.where(bound > 0.0, bound, 1.0)
            start = ratio.repeat(2, axis=1).repeat(2, axis=2)[:, : shape[0], : shape[1]] * qp.bound
            pairs = found.pairs * (bound.size / qp.bound.size)
        iteration = _Iteration(qp, points, start, self)
        iteration.pairs += pairs
        return iteration.solved()


class _Slip(NamedTuple):
    """Uniform ``shift`` (2,) in m, slip ``s`` (2, n) in m, and their ``deviation`` from the law."""

    shift: RealArray
    s: RealArray
    deviation: Deviation


class _Iteration:
    """Iterate of one solve on the points of its contact: traction, displacement, shift."""

    def __init__(self, qp: TangentialQP, points: Points, start: RealArray | None, settings: StickSlipNewton) -> None:
        self.qp, self.points, self.settings = qp, points, settings
        self.total = None if qp.mean_traction is None else np.asarray(qp.mean_traction) * qp.bound.size
        self.work = Workspace.of(qp.operator, points, "float32" if settings.precision == "mixed" else "float64")
        self.pairs = 0.0
        if start is not None:
            q = points.projected(points.gathered(start))
            self.q = q if self.total is None else points.with_sum(q, self.total)
        elif self.total is not None:
            self.q = points.in_proportion(self.total)
        else:
            self.q = np.zeros((2, len(points.bound)))
        self._compute()
        self.doublings, self.settled_error, self.by_few = 0, np.inf, False

    def _compute(self) -> None:
        """Displacement of the traction from scratch, in double precision."""
        operator = self.qp.operator
        self.u = self.points.gathered(operator.displacement(self.points.scattered(self.q, self.qp.bound.shape)))
        self.pairs += operator.pairs_per_application
        self.exact = True

    def solved(self) -> TangentialSolution:
        """Steps until the error is reached by a displacement computed from scratch."""
        before: Sets | None = None
        error = computed_at = lowest = np.inf
        for count in range(self.settings.max_iterations + 1):
            shift, s, found = self._slip()
            error = found.error
            reached = error <= self.settings.tolerance
            doubtful = error < _REFRESH * computed_at or error > _SLOW * lowest
            if not self.exact and (doubtful or (reached and error < _ROUGH)):
                self._compute()
                shift, s, found = self._slip()
                error = computed_at = found.error
            lowest = min(lowest, error)
            if error <= self.settings.tolerance or count == self.settings.max_iterations:
                break
            sets = Sets.of(self.points, self.q, s)
            changed = len(sets.slip) if before is None else np.count_nonzero(sets.slip != before.slip)
            near = before is None and error < _NEAR
            before = sets
            settled = near or bool(changed <= _SETTLED * len(sets.slip))
            self._step(sets, s, settled=settled, error=error)
        return ended(
            self.qp,
            self.points,
            (self.q, s, shift),
            found,
            tolerance=self.settings.tolerance,
            work=(count, self.pairs),
        )

    def _slip(self) -> _Slip:
        """Shift that is sought, slip, and how far they are from the law."""
        residual = self.points.target - self.u
        shift = np.zeros(2) if self.total is None else best_shift(self.points, self.q, residual, by_few=self.by_few)
        s = residual + shift[:, None]
        return _Slip(shift, s, Deviation.of(self.points, self.q, self.u, s))

    def _step(self, sets: Sets, s: RealArray, *, settled: bool, error: float) -> None:
        """One step of Newton's method."""
        work = self.work
        system = NewtonSystem.of(work, sets, zero_sum=self.total is not None)
        sought = sets.free_part(s)  # in double: along the traction slip is large where points slip
        unit = float(np.abs(sought).max()) or 1.0
        r = (sought / unit).astype(work.dtype)
        reduction, most = _REDUCTION, _UNSETTLED_STEPS
        if settled:
            wanted = _MARGIN * self.settings.tolerance / error
            self.doublings += error > _SLOW * self.settled_error
            self.settled_error = error
            reduction = min(_REDUCTION, max(wanted, _FINEST))
            most = _SETTLED_STEPS << min(self.doublings, _MOST_DOUBLINGS)
        d, products = system.solved(r, reduction, most)
        self.pairs += products * self.qp.operator.pairs_per_application
        d = d.astype(float) * (unit / work.pixel)
        part = 1.0
        for _ in range(_HALVINGS):
            if self._taken(self._moved(system, sets, part * d), s):
                return
            part *= 0.5
        # just below the limit of friction either shift may lead nowhere: 3 of 16 forces of 0.999
        # and 0.99999 of it did not settle by one alone
        self.by_few = not self.by_few
        downhill = self.points.projected(self.q + s / self.qp.operator.largest)
        self._taken(downhill if self.total is None else self.points.with_sum(downhill, self.total), s, force=True)

    def _moved(self, system: NewtonSystem, sets: Sets, d: RealArray) -> RealArray:
        """Traction after the step ``d``: slipping ones turned on their circles, sticking ones put
        back within their bounds.

        What that takes from a prescribed sum is given back first as a uniform shift would do it,
        which costs the least energy.
        """
        found = self._turned(sets, self.q, d)
        if self.total is None or system.uniform is None:
            return found
        solved, inverse = system.uniform
        weights = inverse @ (self.total - found.sum(axis=1))
        return self.points.with_sum(self._turned(sets, found, np.tensordot(weights, solved, axes=1)), self.total)

    def _turned(self, sets: Sets, traction: RealArray, d: RealArray) -> RealArray:
        bound = np.where(sets.slip, self.points.bound, 1.0)
        # where the curvature of the circle decides, the step is the tangent of the angle between
        # traction and slip
        towards = traction / bound + sets.tangent * (np.einsum("ij,ij->j", d, sets.tangent) / bound)
        turned = towards * (bound / np.where(sets.slip, size_of(towards), 1.0))
        return np.where(sets.slip, turned, self.points.projected(traction + d))

    def _taken(self, traction: RealArray, s: RealArray, *, force: bool = False) -> bool:
        """Go to ``traction`` if the energy does not rise by that, or in any case if ``force``."""
        step = traction - self.q
        unit = float(np.abs(step).max())
        if unit == 0.0:
            return force
        response = self.work.product((step / unit).astype(self.work.dtype)).astype(float) * unit
        self.pairs += self.qp.operator.pairs_per_application
        rise = -float(np.einsum("ij,ij->", s, step)) + 0.5 * float(np.einsum("ij,ij->", step, response))
        work = float(np.sum(np.abs(s * traction) + np.abs(s * self.q) + np.abs(self.u * step)))
        if rise > _ROUNDING * work and not force:
            return False
        self.q, self.u, self.exact = traction, self.u + response, False
        return True
