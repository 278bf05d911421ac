"""Adhesive equilibria along a branch through its folds, stable or not, by pseudo-arclength
continuation (Keller 1977, Feng 2000).

The unknowns are the net traction t and the offset d. With the gap g = d + K t - h (of a soft core
g = d + z0 + K t - h) an equilibrium has

    t + σ(g) = 0 where the surfaces are apart,
    g = 0 where t + σ > g/K0 (contact, K0 the compliance of one point).

Where a point leaves the wall, or the slope of the law jumps, the branch may turn back at once in
all points but that one: no plane across the old direction meets it. The gap of such points is
prescribed instead, and the branch goes on in the direction in which they do.

The length along the branch is that of the displacements K t near the contact, as a mean, and of d,
both over the range of the attraction.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ....core import require
from ....core.arrays import BoolArray, RealArray
from ....core.errors import NoSolutionError
from .problem import Adhered, AdhesiveProblem

_MISS = 1e-8
"""Largest difference of the traction and the law, over the strength, of a point of the branch."""

_CORRECTIONS = 10
_QUICK, _SLOW = 4, 7
"""Corrections up to which the next step is longer, and from which it is shorter."""

_SHORTEST = 1e-4
"""Step over the first at which the continuation gives up."""

_NEAR = 0.05
"""Attraction over the strength above which a point counts as near the contact."""

_FOLLOWS = 0.57
"""Compliance of a single point times the steepest fall of the attraction up to which branches were
followed: Dugdale's law smoothed over 0.2 and 1 of its range, exponential law, Maugis' λ from 1
to 2. From 0.7 on one in three was lost, from 1 on nearly all."""

_AWAY = 2.0
"""Distance of a point from where it was expected, over the step, from which on it counts as one of
another branch."""

_KINK = 0.3
"""Change of the slope of the law over its steepest that counts as a kink."""

_KRYLOV = 80
"""Vectors of the linear solver before it begins anew."""


@dataclass(frozen=True, eq=False)
class BranchPoint:
    """An equilibrium, and how the branch goes on from it.

    Attributes
    ----------
    traction
        Net traction t (nx, ny) in Pa.
    deflection
        K t (nx, ny) in m.
    gap
        g (nx, ny) in m.
    contact
        Points (nx, ny) held at the wall.
    offset
        d in m.
    turn
        Change of the offset per length along the branch: zero at a fold.
    corrections
        Steps of Newton's method from the point before.
    length
        Length in m along the branch.
    """

    traction: RealArray
    deflection: RealArray
    gap: RealArray
    contact: BoolArray
    offset: float
    turn: float = 0.0
    corrections: int = 0
    length: float = 0.0

    def adhered(self, problem: AdhesiveProblem) -> Adhered:
        """The same as an iterate of the adhesive solvers, with wall pressure and pull."""
        law = problem.law
        attraction = law.attraction(np.maximum(self.gap, 0.0) if law.spacing == 0.0 else self.gap)
        pressure = np.where(self.contact, np.maximum(self.traction + attraction, 0.0), 0.0)
        pull = pressure - self.traction
        return Adhered(pressure, pull, self.deflection, self.gap, pull, self.offset)


@dataclass(frozen=True, eq=False)
class _Tangent:
    """Change of traction and deflection (nx, ny) and of the offset per length, and the weight (nx,
    ny) of the mean in that length."""

    traction: RealArray
    deflection: RealArray
    offset: float
    weight: RealArray

    def along(self, deflection: RealArray, offset: float) -> float:
        """Share in m of the change of ``deflection`` (nx, ny) and ``offset`` (m) in this
        direction."""
        return float((self.weight * self.deflection * deflection).mean()) + self.offset * offset


class Continuation:
    """Branch of ``problem``, whose constraint does not matter, in steps of about ``step`` ranges of
    its attraction."""

    def __init__(self, problem: AdhesiveProblem, step: float = 0.25) -> None:
        self.problem, self.operator = problem, problem.operator
        self.first = require.positive(step, "step along the branch, over the range of the attraction")
        one = np.zeros(problem.profile.shape)
        one[0, 0] = 1.0
        self.single = float(self.operator.apply(one).max())
        self.pairs = 0.0

    def points(self, traction: RealArray, offset: float, *, direction: float) -> Iterator[BranchPoint]:
        """Points of the branch from the equilibrium near ``traction`` (nx, ny) in Pa at the
        ``offset`` (m) on.

        It starts towards larger offsets (parting) where ``direction`` is positive, and goes on
        through folds without end.

        Raises
        ------
        NoSolutionError
            If there is no equilibrium near the start, or the steps become too short.
        """
        along = _Tangent(np.zeros_like(traction), np.zeros_like(traction), 1.0, np.ones_like(traction))
        start = self._corrected(self._point(traction, self._applied(traction), offset), along)
        if start is None:
            raise NoSolutionError(
                "start of a branch must be an equilibrium, but is none. Solve the contact there first."
            )
        along = self._tangent(start, replace(along, offset=float(np.sign(direction))))
        yield replace(start, turn=along.offset)
        point, step = start, self.first * self.problem.law.range
        while True:
            ahead = self._point(
                point.traction + step * along.traction,
                point.deflection + step * along.deflection,
                point.offset + step * along.offset,
            )
            # the equilibrium near the point ahead, and what was prescribed to find it
            for row in (along, self._of_crossing(point, ahead)):
                found = None if row is None else self._corrected(ahead, row)
                if row is None or found is None:
                    continue
                moved, by = found.deflection - ahead.deflection, found.offset - ahead.offset
                if float((along.weight * moved * moved).mean()) + by * by <= (_AWAY * step) ** 2:
                    break
            else:
                step *= 0.5
                if step < _SHORTEST * self.first * self.problem.law.range:
                    break
                continue
            along = self._tangent(found, row, self._of_crossing(point, found))
            point = replace(found, turn=along.offset, length=point.length + step)
            yield point
            if found.corrections <= _QUICK:
                step = min(1.4 * step, self.first * self.problem.law.range)
            elif found.corrections >= _SLOW:
                step *= 0.6
        pixel = max(self.operator.grid.pixels)
        text = (
            f"step along the branch must not be less than {_SHORTEST:g} of the first, but is at the offset "
            f"{point.offset:.6g} m. "
        )
        if pixel <= self.needed_pixel:
            raise NoSolutionError(text + "Take smaller steps, or a finer grid.")
        raise NoSolutionError(
            text + f"Single points snap there: the pixel is {pixel:.3g} m. Take one of at most "
            f"{self.needed_pixel:.3g} m, or an attraction "
            "that falls more gently, such as {gentle_law}."
        )

    @property
    def needed_pixel(self) -> float:
        """Largest pixel in m with which the branch can be followed; the compliance of a point goes
        about as its pixel."""
        return max(self.operator.grid.pixels) * _FOLLOWS / (self.single * self.problem.law.steepest)

    def _point(self, traction: RealArray, deflection: RealArray, offset: float) -> BranchPoint:
        law = self.problem.law
        gap = offset + law.spacing + deflection - self.problem.profile
        if law.spacing > 0.0:
            return BranchPoint(traction, deflection, gap, np.zeros(gap.shape, dtype=bool), offset)
        pressure = traction + law.attraction(np.maximum(gap, 0.0))
        return BranchPoint(traction, deflection, gap, pressure > gap / self.single, offset)

    def _rows(self, point: BranchPoint) -> tuple[RealArray, RealArray, RealArray]:
        """Residual in Pa, and its derivatives by the traction and by the gap; fields (nx, ny)."""
        law, contact = self.problem.law, point.contact
        gap = point.gap if law.spacing > 0.0 else np.maximum(point.gap, 0.0)
        residual = np.where(contact, point.gap / self.single, point.traction + law.attraction(gap))
        slope = np.where(point.gap < 0.0, 0.0, law.slope(gap)) if law.spacing == 0.0 else law.slope(gap)
        return residual, np.where(contact, 0.0, 1.0), np.where(contact, 1.0 / self.single, slope)

    def _corrected(self, point: BranchPoint, along: _Tangent) -> BranchPoint | None:
        """The equilibrium in the plane across ``along`` through ``point``; None where Newton's
        method does not find it."""
        law = self.problem.law
        before = np.inf
        for count in range(_CORRECTIONS):
            residual, _, _ = self._rows(point)
            miss = float(np.abs(residual).max()) / max(law.strength, float(np.abs(point.traction).max()))
            if miss <= _MISS:
                return replace(point, corrections=count)
            if not np.isfinite(miss) or (miss > 10.0 * before and count > 2):
                return None
            before = miss
            x, u, by = self._solved(point, along, -residual, 0.0, 1e-3)
            change = u + by
            if law.spacing > 0.0:
                nearer = np.where(change < 0.0, -change / (0.5 * point.gap), 0.0).max()
                cut = min(1.0, 1.0 / float(nearer)) if nearer > 0.0 else 1.0
                x, u, by = cut * x, cut * u, cut * by
            point = self._point(point.traction + x, point.deflection + u, point.offset + by)
        return None

    def _tangent(self, point: BranchPoint, along: _Tangent, crossing: _Tangent | None = None) -> _Tangent:
        """Direction of the branch at ``point``, on from ``along``, of length one; that in which the
        points of a ``crossing`` go on."""
        law = self.problem.law
        near = point.contact | (np.abs(law.attraction(np.maximum(point.gap, 0.3 * law.spacing))) > _NEAR * law.strength)
        share = float(near.mean())
        weight = np.where(near, 1.0 / share, 0.0) if share > 0.0 else np.ones_like(point.traction)
        x, u, by = self._solved(point, along, np.zeros_like(point.traction), 1.0, 1e-6)
        size = float(np.sqrt((weight * u * u).mean() + by * by))
        if crossing is not None and crossing.along(u, by) < 0.0:
            size = -size
        return _Tangent(x / size, u / size, by / size, weight)

    def _of_crossing(self, point: BranchPoint, ahead: BranchPoint) -> _Tangent | None:
        """The mean change of the gaps, in the direction of their change, that cross a kink of the
        law or leave the wall from ``point`` to ``ahead``."""
        law = self.problem.law
        if law.spacing > 0.0:
            return None
        slopes = [np.where(at.contact, 0.0, law.slope(np.maximum(at.gap, 0.0))) for at in (point, ahead)]
        crossing = (np.abs(slopes[1] - slopes[0]) > _KINK * law.steepest) & ~ahead.contact
        if not crossing.any():
            return None
        sign = np.where(crossing, np.sign(ahead.gap - point.gap), 0.0)
        weight = crossing / float(crossing.mean())
        return _Tangent(np.zeros_like(sign), sign, float((weight * sign).mean()), weight)

    def _solved(
        self, point: BranchPoint, along: _Tangent, right: RealArray, length: float, tolerance: float
    ) -> tuple[RealArray, RealArray, float]:
        """Changes of traction, deflection and offset that change the residual by ``right`` and the
        length along by ``length``."""
        from scipy.sparse.linalg import LinearOperator, gmres

        law, shape, n = self.problem.law, right.shape, right.size
        stress, far = law.strength, law.range
        _, by_traction, by_gap = self._rows(point)

        def product(z: RealArray) -> RealArray:
            x, d = stress * z[:n].reshape(shape), far * float(z[n])
            u = self._applied(x)
            rows = by_traction * x + by_gap * (u + d)
            return np.concatenate([rows.ravel() / stress, [along.along(u, d) / far]])

        system = LinearOperator((n + 1, n + 1), matvec=product, dtype=float)
        b = np.concatenate([right.ravel() / stress, [length / far]])
        z, _ = gmres(system, b, rtol=tolerance, atol=0.0, restart=_KRYLOV, maxiter=4)
        x = stress * z[:n].reshape(shape)
        return x, self._applied(x), far * float(z[n])

    def _applied(self, traction: RealArray) -> RealArray:
        self.pairs += self.operator.pairs_per_application
        return self.operator.apply(traction)
