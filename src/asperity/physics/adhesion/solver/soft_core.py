"""Contacts without a wall: laws of adhesion with a core that repels, such as Lennard-Jones'.

All of the traction is that of the law, t = -σ(g) with g = d + z0 + K t - h, z0 the gap at which the
law neither attracts nor repels. Equilibria are the stationary points of

    Π = ½ t·K t + Σ φ(g)   (+ P d where the load P is prescribed),

whose Hessian in the displacement u = K t is K⁻¹ + σ'. Newton's method solves (1 + σ'K) δt = -(t +
σ) in the product a·K b, in which 1 + σ'K is symmetric, by conjugate gradients with one application
of K each.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ....contact.solvers.protocol import FixedMean, FixedOffset
from ....core.arrays import RealArray
from ....core.errors import NoSolutionError
from ....core.status import Outcome, Status
from ..law import Adhesion, SoftAdhesion
from .problem import Adhered, AdhesiveProblem
from .solver import AdhesiveSolution, Stepwise, Work, minimised

_NEAREST = 0.65
"""Smallest gap over z0 from which Newton's method starts, and share of its gap that a point may
keep in one step."""

_FEWEST_PARTS = 20
"""Parts of a change of the position into which it is divided at most; beyond, a contact with a hard
wall is the start."""

_PART = 0.25
"""Change of the position in such a part over z0."""

_INNER_STEPS = 400
_HALVINGS = 40


@dataclass(frozen=True, eq=False)
class _Point:
    """Traction t (Pa), K t (m), gap (m), fields (nx, ny); offset (m); energy over the area of a
    pixel (Pa·m)."""

    t: RealArray
    u: RealArray
    gap: RealArray
    offset: float
    energy: float


@dataclass(frozen=True)
class SoftCoreNewton(Stepwise):
    """Newton's method for the traction, each step cut so that the energy falls and no gap changes
    by more than a part of itself.

    Where the curvature is negative a step goes along that direction (Steihaug 1983), so that a
    branch that ends is left downhill.

    Parameters
    ----------
    tolerance
        Largest difference of traction and law over the larger of the strength and that traction at
        which it ends.
    max_steps
        Steps after which it gives up.
    """

    tolerance: float = 1e-6
    max_steps: int = 200
    name: ClassVar[str] = "Newton's method on a soft core"
    citation_keys: ClassVar[tuple[str, ...]] = ("Steihaug1983", "Greenwood1997")

    def solve(self, problem: AdhesiveProblem, pull: RealArray, pressure: RealArray | None = None) -> AdhesiveSolution:
        """Equilibrium that is reached downhill from the traction ``pressure`` - ``pull`` (nx, ny)
        in Pa.

        Raises
        ------
        NoSolutionError
            If the load prescribed pulls the surfaces apart.
        """
        work = Work()
        starts = self._starts(problem, pull, pressure, work)
        energies: list[float] = []
        point, count, miss = starts[0], 0, np.inf
        for start in starts:
            offset = start.offset
            point = start if count == 0 else _at(problem, point.t, point.u, offset)
            point, steps, miss, energies = self._newton(problem, point, work)
            count += steps
        status = Status(Outcome.CONVERGED, f"Traction and gap agree to {miss:.1e} after {count} steps.")
        if not miss <= self.tolerance:
            text = f"Traction and gap still differ by {miss:.1e} after {count} steps."
            status = Status(Outcome.STAGNATED, text, "Take smaller steps of the load or position, or a finer grid.")
        law, pixel = problem.law, problem.operator.grid.pixel_area
        assert isinstance(law, SoftAdhesion)
        # nearer than the gap of the largest attraction points touch
        pressure = np.where(point.gap < law.peak, np.maximum(law.strength + point.t, 0.0), 0.0)
        pull = pressure - point.t
        scaled = tuple(value * pixel for value in energies)
        state = Adhered(pressure, pull, point.u, point.gap, pull, point.offset)
        return AdhesiveSolution(state, point.energy * pixel, scaled, count, count, work.pairs, status)

    def miss(self, law: Adhesion, pull: RealArray, pressure: RealArray, gap: RealArray) -> float:
        """Largest difference of the traction and the law at the ``gap`` over the larger of strength
        and traction; fields (nx, ny)."""
        return _miss(law, pressure - pull, gap)

    def _starts(
        self, problem: AdhesiveProblem, pull: RealArray, pressure: RealArray | None, work: Work
    ) -> list[_Point]:
        """Where Newton's method starts, and the offsets that it passes on the way to the one
        prescribed."""
        law, constraint = problem.law, problem.constraint
        t = -pull if pressure is None else pressure - pull
        if isinstance(constraint, FixedOffset):
            u = problem.operator.apply(t)
            work.pairs += problem.operator.pairs_per_application
            lowest = float((constraint.offset + law.spacing + u - problem.profile).min())
            missing = _NEAREST * law.spacing - lowest
            parts = 1 if missing <= 0.0 else 1 + int(np.ceil(missing / (_PART * law.spacing)))
            if parts <= _FEWEST_PARTS:
                back = np.linspace(max(missing, 0.0), 0.0, parts)
                return [_at(problem, t, u, constraint.offset + float(by)) for by in back]
        walled = minimised(problem, pull, pressure, work, 1e-6)
        u = problem.operator.apply(walled.traction)
        work.pairs += problem.operator.pairs_per_application
        return [_at(problem, walled.traction, u, walled.offset)]

    def _newton(self, problem: AdhesiveProblem, point: _Point, work: Work) -> tuple[_Point, int, float, list[float]]:
        """The equilibrium near ``point``, steps, miss and energies on the way."""
        energies = [point.energy]
        miss = self._unbalance(problem, point)
        for count in range(1, self.max_steps + 1):
            if miss <= self.tolerance:
                return point, count - 1, miss, energies
            x, image, by, down = self._change(problem, point, min(0.1, max(1e-5, miss)), work)
            # along the change until the energy is lower; no gap changes by more than a part of
            # itself
            change = image + by
            with np.errstate(divide="ignore", invalid="ignore"):
                opens = problem.law.range + 0.5 * point.gap
                room = np.where(change < 0.0, (1.0 - _NEAREST) * point.gap, opens) / np.abs(change)
            most = float(np.nanmin(np.where(change == 0.0, np.inf, room)))
            step = most if down else min(1.0, most)
            for _ in range(_HALVINGS):
                further = _at(problem, point.t + step * x, point.u + step * image, point.offset + step * by)
                if further.energy <= point.energy + 1e-13 * abs(point.energy):
                    break
                step *= 0.5
            else:
                return point, count, miss, energies
            point = further
            energies.append(point.energy)
            miss = self._unbalance(problem, point)
        return point, self.max_steps, miss, energies

    def _unbalance(self, problem: AdhesiveProblem, point: _Point) -> float:
        miss = _miss(problem.law, point.t, point.gap)
        if isinstance(problem.constraint, FixedMean):
            scale = max(problem.law.strength, abs(problem.constraint.mean_pressure))
            miss = max(miss, abs(float(point.t.mean()) - problem.constraint.mean_pressure) / scale)
        return miss

    def _change(
        self, problem: AdhesiveProblem, point: _Point, tolerance: float, work: Work
    ) -> tuple[RealArray, RealArray, float, bool]:
        """Changes of traction and K t (nx, ny), of the offset, and whether the energy curves down
        along them."""

        def applied(traction: RealArray) -> RealArray:
            work.pairs += problem.operator.pairs_per_application
            return problem.operator.apply(traction)

        slope = problem.law.slope(point.gap)
        right = -(point.t + problem.law.attraction(point.gap))
        x, u, down = conjugate(applied, slope, right, tolerance)
        if problem.operator.zero_mean_mode and not down:
            x = x + float(
                (right - slope * u - x).mean()
            )  # a uniform traction moves nothing, and that product does not see it
        if down or not isinstance(problem.constraint, FixedMean):
            return x, u, 0.0, down
        tangent, moved, unstable = conjugate(applied, slope, -slope, tolerance)
        stiffness, wanted = -float(tangent.sum()), problem.constraint.mean_pressure * point.t.size
        soft = unstable or not stiffness > 0.0
        if soft and wanted > 0.0:  # what presses has an equilibrium, downhill
            rate = float((moved * -right).sum()) + float(problem.law.attraction(point.gap).sum()) + wanted
            towards = -1.0 if rate > 0.0 else 1.0
            return towards * tangent, towards * moved, towards, True
        if soft:
            force = problem.constraint.mean_pressure * problem.operator.grid.area
            raise NoSolutionError(
                f"force must be one that the adhesion bears, but {force:.6g} N is not: the surfaces part. "
                "Prescribe the position, with {grips}, to follow them.",
                subject="force",
            )
        by = (float((point.t + x).sum()) - wanted) / stiffness
        return x + by * tangent, u + by * moved, by, False


def conjugate(
    applied: Callable[[RealArray], RealArray], slope: RealArray, b: RealArray, tolerance: float
) -> tuple[RealArray, RealArray, bool]:
    """x with (1 + slope·K) x = b and K x, by conjugate gradients in the product a·K b; and whether
    the curvature was negative on the way.

    In that case x is the sum up to there, or the first direction; all fields (nx, ny).
    """
    x, image = np.zeros_like(b), np.zeros_like(b)
    r, Kr = b, applied(b)
    p, Kp = r, Kr
    size = float((r * Kr).sum())
    first = size
    for count in range(_INNER_STEPS):
        if size <= tolerance**2 * first:
            break
        Ap = p + slope * Kp
        curvature = float((Kp * Ap).sum())
        if not curvature > 0.0:
            return (p, Kp, True) if count == 0 else (x, image, True)
        step = size / curvature
        x, image, r = x + step * p, image + step * Kp, r - step * Ap
        Kr = applied(r)
        now = float((r * Kr).sum())
        p, Kp, size = r + (now / size) * p, Kr + (now / size) * Kp, now
    return x, image, False


def _at(problem: AdhesiveProblem, t: RealArray, u: RealArray, offset: float) -> _Point:
    gap = offset + problem.law.spacing + u - problem.profile
    least = 0.3 * problem.law.spacing
    gap = np.maximum(gap, least)  # never met but by the rounding of a start from a hard wall
    energy = 0.5 * float((t * u).sum()) + float(problem.law.energy(gap).sum())
    if isinstance(problem.constraint, FixedMean):
        energy += problem.constraint.mean_pressure * t.size * offset
    return _Point(t, u, gap, offset, energy)


def _miss(law: Adhesion, t: RealArray, gap: RealArray) -> float:
    scale = np.maximum(law.strength, np.abs(t))
    return float((np.abs(t + law.attraction(gap)) / scale).max())
