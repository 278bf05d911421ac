"""The tangential problem of one step: a convex programme with a disc at every point, its multiplier
and its duality gap.

    min  1/2 q·C q - q·b    over |q| <= B at every point,

with q the shear traction on the body, B the bound of the friction law, C the tangential compliance
and b what the surfaces would slip without traction (Kalker 1990; Panagiotopoulos 1975). Minus the
gradient, s = b - C q, is the slip of the step: zero where the traction is below its bound, along
the traction where it is at it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ....core.arrays import BoolArray, RealArray
from ....core.status import Outcome, Status
from ..operator import TangentialOperator

AT_BOUND = 1.0 - 1e-12
"""Share of the bound from which on a traction counts as at it: a traction put on the circle is
there to a few roundings."""


def size_of(vectors: RealArray) -> RealArray:
    """Magnitudes of ``vectors`` (2, ...); a tenth of the time of NumPy's hypot, whose range is not
    needed."""
    x, y = vectors
    return np.asarray(np.sqrt(x * x + y * y))


@dataclass(frozen=True, eq=False)
class TangentialQP:
    """One step with given bounds.

    Attributes
    ----------
    operator
        Shear traction to tangential displacement.
    bound
        Largest shear traction (nx, ny) in Pa, >= 0: zero outside the contact, infinite where
        nothing slips.
    target
        b without the part that is sought, (2, nx, ny) in m.
    mean_traction
        Prescribed mean of the traction (2,) in Pa, for which a uniform shift is sought; None where
        the shift is part of ``target``.
    """

    operator: TangentialOperator
    bound: RealArray
    target: RealArray
    mean_traction: RealArray | None = None


_INACTIVE = 10.0


@dataclass(frozen=True)
class Deviation:
    """How far an iterate is from the friction law, over the sum of its elastic energy and the work
    of its slip.

    ``gap`` is the duality gap Σ (B |s| - q·s), a bound on the error of the energy; ``error`` is Σ
    |B s - |s| q|, which is never smaller and of first order in the angle between slip and traction
    as well, where the gap is of second.
    """

    gap: float
    error: float

    @classmethod
    def of(cls, points: Points, traction: RealArray, displacement: RealArray, s: RealArray) -> Deviation:
        """Deviation of ``traction`` (2, n) with its ``displacement`` and slip ``s``.

        Bounds count up to ten times the largest traction, beyond which none is active, and what the
        mean residual would still take.
        """
        size = size_of(s)
        limit = np.minimum(points.bound, _INACTIVE * size_of(traction).max() + size.mean() / points.largest)
        gap = float(np.sum(limit * size - np.einsum("ij,ij->j", traction, s)))
        error = float(np.sum(size_of(limit * s - size * traction)))
        scale = 0.5 * abs(float(np.einsum("ij,ij->", traction, displacement))) + float((limit * size).sum())
        return cls(*(value / scale if scale > 0.0 else 0.0 if value == 0.0 else np.inf for value in (gap, error)))


@dataclass(frozen=True, eq=False)
class TangentialSolution:
    """Solution of a ``TangentialQP``.

    Attributes
    ----------
    traction
        (2, nx, ny), Pa.
    shift
        Uniform shift (2,) in m that was sought; zero where the shift was prescribed.
    slip
        Slip (2, nx, ny) in m of the counter body over the body in this step; zero outside the
        contact.
    deviation
        How far it is from the friction law.
    status
        How the solver ended.
    iterations, pairs
        Work of the solver; FFT pairs of the grid.
    """

    traction: RealArray
    shift: RealArray
    slip: RealArray
    deviation: Deviation
    status: Status
    iterations: int
    pairs: float

    @property
    def slipping(self) -> BoolArray:
        """(nx, ny), True where the surfaces slip in this step."""
        return np.asarray(np.any(self.slip != 0.0, axis=0))


class TangentialSolver(Protocol):
    """Method for a ``TangentialQP``."""

    @property
    def tolerance(self) -> float:
        """Error to reach."""

    def solve(self, qp: TangentialQP, start: RealArray | None = None) -> TangentialSolution:
        """Solution of ``qp`` from the traction ``start`` (2, nx, ny) in Pa, which need not be
        feasible; by default from none."""


@dataclass(frozen=True, eq=False)
class Points:
    """A ``TangentialQP`` on the points of its contact: vectors (2, n) and (n,) in the order of the
    flat ``index``.

    ``largest`` is the largest compliance of a wave, m/Pa.
    """

    index: np.ndarray[tuple[int], np.dtype[np.int64]]
    bound: RealArray
    target: RealArray
    largest: float

    @classmethod
    def of(cls, qp: TangentialQP) -> Points:
        """Points of ``qp`` with a positive bound."""
        index = np.flatnonzero(qp.bound.ravel() > 0.0)
        return cls(index, qp.bound.ravel()[index], qp.target.reshape(2, -1)[:, index], qp.operator.largest)

    def gathered(self, field: RealArray) -> RealArray:
        """Values (2, n) of a field (2, nx, ny)."""
        values: RealArray = field.reshape(2, -1)[:, self.index]
        return values

    def scattered(self, values: RealArray, shape: tuple[int, int]) -> RealArray:
        """Field (2, nx, ny), zero elsewhere, of ``values`` (2, n)."""
        field = np.zeros((2, shape[0] * shape[1]))
        field[:, self.index] = values
        return field.reshape(2, *shape)

    def projected(self, traction: RealArray) -> RealArray:
        """Nearest tractions (2, n) within their bounds."""
        size = size_of(traction)
        over = size > self.bound
        factor = np.where(over, self.bound / np.where(over, size, 1.0), 1.0)
        return traction * factor

    def with_sum(self, traction: RealArray, total: RealArray) -> RealArray:
        """Feasible ``traction`` (2, n) with the sum ``total`` (2,).

        What is missing goes where the bound leaves room, so that slipping points stay at their
        bound; where there is not enough, the nearest tractions with that sum are taken.
        """
        missing = total - traction.sum(axis=1)
        size = float(np.hypot(*missing))
        if size <= _ROUNDING * float(np.hypot(*total) + np.abs(traction).sum()):
            return traction
        inside = size_of(traction) < self.bound * AT_BOUND
        # by how much each may grow along what is missing; what is unbounded takes all there is
        unbounded = np.isinf(self.bound)
        if unbounded.any():
            room = np.where(unbounded, 1e200, 0.0)
        else:
            along = (missing / size) @ traction
            room = np.sqrt(np.maximum(self.bound**2 - size_of(traction) ** 2 + along**2, 0.0)) - along
        room = np.where(inside, room, 0.0)
        if float(room.sum()) < size:
            return self.nearest(traction, total)
        return self.projected(traction + (missing / float(room.sum()))[:, None] * room)

    def nearest(self, traction: RealArray, total: RealArray) -> RealArray:
        """Nearest feasible tractions (2, n) with the sum ``total`` (2,).

        They are those after the same vector has been added to all and each put within its bound.
        That vector is the minimum of the convex sum of |x|²/2, beyond the bound B|x| - B²/2, less
        its product with ``total``: Newton's method with halved steps.
        """
        limit = np.where(np.isfinite(self.bound), self.bound, 0.0)
        added, step, value = np.zeros(2), np.zeros(2), np.inf
        for _ in range(_SWEEPS):
            moved = traction + (added + step)[:, None]
            size = size_of(moved)
            over = size > self.bound
            each = np.where(over, limit * (size - 0.5 * limit), 0.5 * size**2)
            reached = float(each.sum()) - float(total @ (added + step))
            if reached > value + 1e-14 * abs(value):
                step = 0.5 * step
                continue
            added, value = added + step, reached
            found = self.projected(moved)
            missing = total - found.sum(axis=1)
            if np.hypot(*missing) <= _ROUNDING * float(np.hypot(*total) + np.abs(found).sum()):
                return found
            normal = np.where(over, moved / np.where(over, size, 1.0), 0.0)
            share = np.where(over, self.bound / np.where(over, size, 1.0), 1.0)
            slope = share.sum() * np.eye(2) - (share * normal) @ normal.T
            step = np.linalg.lstsq(slope, missing, rcond=1e-14)[0]
        return self.in_proportion(total)  # so near the limit of friction that the vector grows without end

    def in_proportion(self, total: RealArray) -> RealArray:
        """Tractions (2, n) of the sum ``total`` (2,), each in proportion to its bound; where any is
        unbounded those alone, all the same."""
        unbounded = np.isinf(self.bound)
        weight = unbounded.astype(float) if unbounded.any() else self.bound
        return np.asarray(total[:, None] * (weight / weight.sum()))


_SWEEPS = 100
_ROUNDING = 1e-13


@dataclass(frozen=True, eq=False)
class Sets:
    """Where an iterate sticks and slips, with the unit ``normal`` (2, n) of the traction and the
    ``outward`` slip (n,) along it."""

    slip: BoolArray
    normal: RealArray
    outward: RealArray

    @classmethod
    def of(cls, points: Points, traction: RealArray, s: RealArray) -> Sets:
        """Sets of a ``traction`` (2, n) with the slip ``s`` (2, n): slipping is what is at its
        bound and pushed outwards."""
        size = size_of(traction)
        at = (size >= points.bound * AT_BOUND) & (size > 0.0)
        normal = np.where(at, traction / np.where(at, size, 1.0), 0.0)
        outward = np.einsum("ij,ij->j", s, normal)
        slip = at & (outward > 0.0)
        return cls(slip, normal, np.where(slip, outward, 0.0))

    @property
    def tangent(self) -> RealArray:
        """Unit tangent (2, n) of the circle at slipping points, zero elsewhere."""
        return np.where(self.slip, np.stack([-self.normal[1], self.normal[0]]), 0.0)

    def free_part(self, values: RealArray) -> RealArray:
        """Part of ``values`` (2, n) along which the traction may change: all where it sticks, along
        the tangent where it slips."""
        return free_part(self.slip, self.tangent, values)


def free_part(slip: BoolArray, tangent: RealArray, values: RealArray) -> RealArray:
    """``values`` (2, n), where points ``slip`` (n,) their part along the ``tangent`` (2, n)
    alone."""
    return np.where(slip, tangent * np.einsum("ij,ij->j", values, tangent), values)


def best_shift(points: Points, traction: RealArray, residual: RealArray, *, by_few: bool = False) -> RealArray:
    """Shift (2,) in m that fits a ``residual`` b - C q (2, n) best: minus its mean where there is
    room below the bound.

    Where hardly any point has room, the one that makes the duality gap smallest; unless it is to
    follow ``by_few``, if there are any.
    """
    inside = size_of(traction) < points.bound * AT_BOUND
    if np.count_nonzero(inside) <= (0.0 if by_few else _FEW) * inside.size:
        # Minimum over the shift d of Σ B |r + d| - d·Σ q, which is the duality gap but for a
        # constant, by Newton's method on magnitudes smoothed by less and less of the largest
        # residual: the minimum may lie where one of them vanishes.
        total, bound = traction.sum(axis=1), points.bound
        scale = float(np.abs(residual).max()) or 1.0
        direction = total / (float(np.hypot(*total)) or 1.0)
        shift = np.asarray(scale * direction - residual.mean(axis=1))

        def smoothed(at: RealArray, least: float) -> tuple[float, RealArray, RealArray]:
            x, y = residual + at[:, None]
            size = np.sqrt(x * x + y * y + least * least)
            value = float(bound @ size - total @ at)
            slope = np.array([bound @ (x / size), bound @ (y / size)]) - total
            over = bound / size
            xx, yy, xy = over @ (1.0 - (x / size) ** 2), over @ (1.0 - (y / size) ** 2), -(over @ (x * y / size**2))
            return value, slope, np.array([[xx, xy], [xy, yy]])

        least = scale
        while least > _SMOOTHEST * scale:
            for _ in range(_SWEEPS):
                value, slope, curvature = smoothed(shift, least)
                step = -np.asarray(np.linalg.lstsq(curvature, slope, rcond=1e-14)[0])
                part = 1.0
                while part > 1e-8 and smoothed(shift + part * step, least)[0] > value:
                    part *= 0.5
                shift = shift + part * step
                if float(np.hypot(*(part * step))) <= 1e-3 * least or part <= 1e-8:
                    break
            least *= _SMOOTHER
        return np.asarray(shift)
    room = np.where(np.isfinite(points.bound), points.bound - size_of(traction), 1.0)
    weight = np.where(inside, room, 0.0)
    return np.asarray(-(residual * weight).sum(axis=1) / weight.sum())


_FEW = 0.03
"""Share of sticking points up to which their mean residual may be far from the shift: they are
those that slip last."""

_SMOOTHER = 0.1
_SMOOTHEST = 1e-12


def ended(
    qp: TangentialQP,
    points: Points,
    iterate: tuple[RealArray, RealArray, RealArray],
    deviation: Deviation,
    *,
    tolerance: float,
    work: tuple[int, float],
) -> TangentialSolution:
    """Solution at the ``iterate``: traction (2, n), slip (2, n), shift (2,); ``work`` are its
    iterations and FFT pairs."""
    (traction, s, shift), (iterations, pairs) = iterate, work
    shape = qp.bound.shape
    sets = Sets.of(points, traction, s)
    error = deviation.error
    if error <= tolerance:
        status = Status(Outcome.CONVERGED, f"Stick and slip settled to {error:.1e} in {iterations} iterations.")
    else:
        message = f"Stick and slip are not settled: error {error:.1e} after {iterations} iterations."
        status = Status(
            Outcome.ITERATION_LIMIT, message, "Take smaller steps of shift or force, or a larger tolerance."
        )
    slip = sets.normal * sets.outward
    return TangentialSolution(
        traction=points.scattered(traction, shape),
        shift=shift,
        slip=points.scattered(slip, shape),
        deviation=deviation,
        status=status,
        iterations=iterations,
        pairs=pairs,
    )
