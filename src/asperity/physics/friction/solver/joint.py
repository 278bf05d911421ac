"""Newton's method on pressure and shear traction together, for bodies whose shear lifts the
surfaces.

The sets are those of both problems: the free points of the normal contact and, of these, sticking
and slipping ones. Where a point slips its traction follows the pressure, q = B(p) n, so that with P
the projection on what of q is free of its own and N = B'(p) n on slipping points the step dp, dq =
P d + N dp solves

    K dp + C_zt dq                   = level - gap      on free points,
    P (C_tz dp + C_tt dq) + |s|/B d  = P s              on those that bear shear,

the second term of which is the curvature of the circle as in ``linear_system`` (Alart & Curnier
1991). It is not symmetric: the generalised minimal residual method (Saad & Schultz 1986),
preconditioned by the nested cells of each direction. On a rough surface (512², ν = 0.3, rigid
counter body) a product with all three components reduces the residual by 0.48; along the normal
alone it would be 0.22, along the surface alone 0.45, where slip is in all directions at once: the
coupling costs next to nothing.
"""

from __future__ import annotations

from dataclasses import dataclass, is_dataclass, replace
from functools import cached_property
from typing import NamedTuple, TypeAlias

import numpy as np

from ....contact.solvers.active_set.bounds import free_set
from ....contact.solvers.active_set.spline_model import spline_compliance
from ....contact.solvers.protocol import ContactQP, FixedMean, FixedOffset, multiplier
from ....core.arrays import BoolArray, RealArray
from ....core.engine import CpuEngine, FreeSet
from ..law import FrictionLaw, at_points
from ..operator import TangentialOperator
from .linear_system import NewtonSystem, Workspace, gmres
from .problem import Deviation, Points, Sets, best_shift, size_of

_REDUCTION = 0.3
"""Reduction of the residual in one linear system at least."""

_FORCING = 0.5
"""Reduction over that of the error by the step before (Eisenstat & Walker 1996): as sets settle,
systems are solved more finely."""

_FINEST = 1e-4
"""Reduction at most in one system, which is in single precision."""

_PRODUCTS = 14
"""Products with the compliance in one system at most."""

_MARGIN = 0.3
"""Share of the reduction to the tolerance aimed at."""

_STEPS = 40
_PATIENCE = 3
"""Newton steps at most, and in a row that may fail to lower the error."""

_DIFFERENCE = 1e-6
"""Relative change of the pressure by which the slope of the bound is found; laws are linear in
pieces."""


Index: TypeAlias = np.ndarray[tuple[int], np.dtype[np.int64]]
"""Flat indices of points."""


@dataclass(frozen=True, eq=False)
class JointProblem:
    """Both problems of one step.

    Attributes
    ----------
    normal
        The normal contact, elastic, with the lift by shear traction left out of its profile.
    shear
        Shear traction to tangential displacement, with the coupling.
    law
        Bound of the shear traction.
    target
        Slip (2, nx, ny) or (2, 1, 1) in m that there would be without pressure and traction, less
        the shift that is sought.
    mean_traction
        Prescribed mean of the shear traction (2,) in Pa; None where the shift is prescribed.
    """

    normal: ContactQP
    shear: TangentialOperator
    law: FrictionLaw
    target: RealArray
    mean_traction: RealArray | None

    @property
    def solvable(self) -> bool:
        """Whether the compliances are of one form on a CPU, no cap holds, and the law can be taken
        point by point."""
        operator = self.normal.operator
        same = operator.padded == self.shear.padded and isinstance(operator.engine, CpuEngine)
        return same and self.normal.elastic and is_dataclass(self.law)


@dataclass(frozen=True, eq=False)
class JointSolution:
    """Pressure (nx, ny) and traction (2, nx, ny) in Pa, ``slipping`` points, and the FFT pairs and
    steps that it took."""

    pressure: RealArray
    traction: RealArray
    slipping: BoolArray
    pairs: float
    steps: int


class Place(NamedTuple):
    """Iterate on its free points: traction (2, n) and pressure (n,), slip, residual of the gap (m),
    and errors over those wanted."""

    free: FreeSet
    points: Points
    q: RealArray
    p: RealArray
    s: RealArray
    gap: RealArray
    sets: Sets
    error: float


class JointIterate:
    """Iterate of one joint solve of ``problem``, from a ``pressure`` (nx, ny) and ``traction`` (2,
    nx, ny) in Pa."""

    def __init__(self, problem: JointProblem, pressure: RealArray, traction: RealArray) -> None:
        self.problem, self.engine = problem, problem.shear.engine
        normal, shear = problem.normal, problem.shear
        self.shape, size = normal.profile.shape, normal.profile.size
        self.p, self.q = np.array(pressure, dtype=float), np.array(traction, dtype=float)
        self.target = np.broadcast_to(problem.target, (2, *self.shape)).reshape(2, -1)
        self.force = None if problem.mean_traction is None else np.asarray(problem.mean_traction) * size
        constraint = normal.constraint
        self.load = constraint.mean_pressure * size if isinstance(constraint, FixedMean) else None
        self.steps, self.pairs, self.cost = 0, 0.0, 1.5 * shear.pairs_per_application
        # the start, put within its bounds and scaled to load and force
        index = np.flatnonzero(self.p > 0.0)
        if self.load is not None:
            self.p *= self.load / float(self.p.sum())
        points = Points(index, self._bound(index, self.p.reshape(-1)[index]), self.target[:, index], 1.0)
        q = points.projected(points.gathered(self.q))
        self.q = points.scattered(q if self.force is None else points.with_sum(q, self.force), self.shape)
        self._compute()
        self.fields = [[self.engine.field(self.shape, "float32") for _ in range(3)] for _ in range(2)]
        nothing = Points(np.empty(0, np.int64), np.empty(0), np.empty((2, 0)), shear.largest)
        self.work = Workspace.of(shear, nothing, "float32")
        model = spline_compliance(normal.operator, self.work.pixel).model
        self.splines = self.engine.splines(self.shape, model, "float32")

    def _bound(self, index: Index, p: RealArray) -> RealArray:
        bound: RealArray = at_points(self.problem.law, index).bound(p[None])[0]
        return bound

    def _compute(self) -> None:
        """Displacements (3, nx, ny) of the iterate from scratch, in double precision."""
        self.u = np.empty((3, *self.shape))
        convolution = self.problem.shear.coupled_convolution("float64", self.problem.normal.operator)
        convolution.apply((self.q[0], self.q[1], self.p), (self.u[0], self.u[1], self.u[2]))
        self.pairs += self.cost
        self.exact = True

    def solved(self, *, shear_error: float, normal_error: float) -> JointSolution:
        """Steps until the errors are reached by displacements computed from scratch.

        Until ``Deviation.error`` is at most ``shear_error`` and the mean gap under load over the
        rms height at most ``normal_error``. Where that is not reached the best iterate is returned:
        no energy falls from step to step, so that there is no promise.
        """
        before, lowest, idle = np.inf, np.inf, 0
        while True:
            place = self._place(shear_error, normal_error)
            if place.error <= 1.0 and not self.exact:
                self._compute()
                place, lowest = self._place(shear_error, normal_error), np.inf
            if place.error < lowest:
                best, lowest, idle = place, place.error, 0
            else:
                idle += 1
            if place.error <= 1.0 or idle >= _PATIENCE or self.steps == _STEPS or not place.free.size:
                break
            wanted = max(_FINEST, _MARGIN / place.error)
            fallen = place.error / before if before < np.inf else 1.0
            reduction, before = min(_REDUCTION, max(wanted, _FORCING * fallen)), place.error
            self._step(place, reduction)
        pressure, slipping = np.zeros(self.p.size), np.zeros(self.p.size, bool)
        index = best.points.index
        pressure[index], slipping[index] = best.p, best.sets.slip
        traction, shape = best.points.scattered(best.q, self.shape), self.shape
        return JointSolution(pressure.reshape(shape), traction, slipping.reshape(shape), self.pairs, self.steps)

    def _place(self, shear_error: float, normal_error: float) -> Place:
        normal = self.problem.normal
        survey = self.engine.survey(self.p, self.u[2], normal.profile, None)
        constraint = normal.constraint
        level = -constraint.offset if isinstance(constraint, FixedOffset) else multiplier(survey.totals)
        free = free_set(survey, level, 1.0, "float64")
        gap, index = free.residual(centred=False), free.index  # type: ignore[attr-defined]
        p = self.p.reshape(-1)[index]
        points = Points(index, self._bound(index, p), self.target[:, index], self.problem.shear.largest)
        q, u = points.gathered(self.q), points.gathered(self.u[:2])
        residual = points.target - u
        s = residual if self.force is None else residual + best_shift(points, q, residual)[:, None]
        shear = Deviation.of(points, q, u, s).error
        pressed = float(p @ np.abs(gap)) / (float(p.sum()) * normal.height_scale or 1.0)
        error = max(shear / shear_error, pressed / normal_error)
        single = self.engine.points(self.shape, index, "float32")
        return Place(single, points, q, p, s, gap, Sets.of(points, q, s), error)

    def _step(self, place: Place, reduction: float) -> None:
        """One step of Newton's method."""
        self.steps += 1
        system = JointSystem.of(self, place)
        sought = np.concatenate([place.gap[None], place.sets.free_part(place.s) * system.bears])
        unit = float(np.abs(sought).max()) or 1.0
        z, products = gmres(system, system.centred((sought / unit).astype("float32")), reduction, _PRODUCTS)
        self.pairs += products * self.cost
        p, q = self._moved(place, system, z.astype(float) * (unit / self.work.pixel))
        change = np.concatenate([q - place.q, (p - place.p)[None]])
        scale = float(np.abs(change).max()) or 1.0
        fields, responses = self.fields
        system.respond((change / scale).astype("float32"))
        for u, response in zip(self.u, responses, strict=True):
            self.engine.add(response, scale, u)
        nothing = np.zeros(len(p), "float32")
        for field in fields:
            place.free.scatter(nothing, field)
        self.pairs += self.cost
        self.exact = False
        index = place.points.index
        self.p.reshape(-1)[index] = p
        self.q.reshape(2, -1)[:, index] = q

    def _moved(self, place: Place, system: JointSystem, z: RealArray) -> tuple[RealArray, RealArray]:
        """Pressure (n,) and traction (2, n) after the step ``z`` (3, n): pressed or open, turned on
        their circles or within their bounds.

        What that takes from a prescribed load or force is given back first as a uniform
        displacement would do it.
        """
        points = place.points
        p = np.maximum(place.p + z[0], 0.0)
        if system.uniform is not None:
            q = self._turned(place, z, system.full(z)[1:], self._bound(points.index, p))
            z = z + np.tensordot(system.missing(p, q), system.uniform.solved.astype(float), axes=1)
            p = np.maximum(place.p + z[0], 0.0)
        if self.load is not None:
            p *= self.load / float(p.sum())
        bound = self._bound(points.index, p)
        q = self._turned(place, z, system.full(z)[1:], bound)
        then = Points(points.index, bound, points.target, points.largest)
        # where a point was open all of it slips at first: at the edge of a contact there is hardly
        # any bound to stick by
        enters = (points.bound <= 0.0) & np.isfinite(bound)
        q[:, enters] = then.projected(place.s / self.work.pixel)[:, enters]
        return p, q if self.force is None else then.with_sum(q, self.force)

    def _turned(self, place: Place, z: RealArray, change: RealArray, bound: RealArray) -> RealArray:
        sets, points = place.sets, place.points
        towards = sets.normal + sets.tangent * (
            np.einsum("ij,ij->j", z[1:], sets.tangent) / np.where(sets.slip, points.bound, 1.0)
        )
        turned = towards * (np.where(sets.slip, bound, 1.0) / np.where(sets.slip, size_of(towards), 1.0))
        return np.where(sets.slip, turned, replace(points, bound=bound).projected(place.q + change))


class _Uniform(NamedTuple):
    """Uniform residuals (m, 3, n) of load and force, what the preconditioner makes of them, and the
    inverse of its sums."""

    residuals: RealArray
    gram: RealArray
    solved: RealArray
    inverse: RealArray


@dataclass(frozen=True, eq=False)
class JointSystem:
    """Both linearised problems at one place, divided by the deflection of a point; vectors (3, n)
    of dp and the part of dq free of its own.

    ``follows`` (2, n) is N, ``bears`` (n,) one where there is a bound.
    """

    joint: JointIterate
    shear: NewtonSystem
    free: FreeSet
    follows: RealArray
    bears: RealArray

    @classmethod
    def of(cls, joint: JointIterate, place: Place) -> JointSystem:
        """System at ``place``."""
        work = replace(joint.work, points=place.points, free=place.free)
        shear = NewtonSystem.of(work, place.sets, zero_sum=False)
        joint.splines.factorise(place.free)
        slip, p = place.sets.slip, place.p
        slope = np.zeros(len(p))
        more = joint._bound(place.points.index, p * (1.0 + _DIFFERENCE))
        slope[slip] = (more[slip] - place.points.bound[slip]) / (_DIFFERENCE * p[slip])
        bears = (place.points.bound > 0.0).astype("float32")
        return cls(joint, shear, place.free, (slope * place.sets.normal).astype("float32"), bears)

    @cached_property
    def uniform(self) -> _Uniform | None:
        """Residuals that count for nothing, because load or force are prescribed."""
        joint, found = self.joint, []
        for row in ([0] if joint.load is not None else []) + ([1, 2] if joint.force is not None else []):
            one = np.zeros((3, len(self.bears)), "float32")
            one[row] = 1.0
            one[1:] = self.shear.free_part(one[1:]) * self.bears
            found.append(one)
        if not found:
            return None
        flat = np.stack(found).reshape(len(found), -1)
        solved = np.stack([self._preconditioned(one) for one in found])
        sums = np.stack([self._sums(each) for each in solved], axis=1)
        return _Uniform(flat, np.linalg.pinv((flat @ flat.T).astype(float)), solved, np.linalg.pinv(sums))

    def _sums(self, z: RealArray) -> RealArray:
        """Sums of the pressure and of the traction, those that are prescribed."""
        return self._prescribed(self.full(z).sum(axis=1, dtype=np.float64))

    def _prescribed(self, sums: RealArray) -> RealArray:
        joint = self.joint
        return np.concatenate([sums[: int(joint.load is not None)], sums[1:] if joint.force is not None else []])

    def missing(self, p: RealArray, q: RealArray) -> RealArray:
        """Weights of the uniform residuals whose solutions bring ``p`` and ``q`` to the prescribed
        sums."""
        assert self.uniform is not None
        load, force = self.joint.load or 0.0, self.joint.force
        wanted = np.array([load, *((0.0, 0.0) if force is None else force)])
        return np.asarray(self.uniform.inverse @ self._prescribed(wanted - [p.sum(), *q.sum(axis=1)]))

    def full(self, z: RealArray) -> RealArray:
        """dp and all of dq (3, n) of ``z``."""
        out = z.copy()
        out[1:] += self.follows * z[0]
        return out

    def respond(self, change: RealArray) -> None:
        """Displacements, in the second fields of the iteration, by the ``change`` of traction and
        pressure, (3, n) in this order."""
        joint = self.joint
        fields, responses = joint.fields
        for component, field in zip(change, fields, strict=True):
            self.free.scatter(component, field)
        problem = joint.problem
        problem.shear.coupled_convolution("float32", problem.normal.operator).apply(tuple(fields), tuple(responses))

    def product(self, z: RealArray) -> RealArray:
        """The matrix times ``z``, less uniform residuals."""
        full, out = self.full(z), np.empty_like(z)
        self.respond(full[[1, 2, 0]])
        for row, response in zip((1, 2, 0), self.joint.fields[1], strict=True):
            self.free.gather_products(response, out[row], out[row], out[row])
        out *= z.dtype.type(1.0 / self.joint.work.pixel)
        out[1:] = self.shear.free_part(out[1:]) * self.bears + self.shear.curvature * z[1:]
        return self.centred(out)

    def centred(self, r: RealArray) -> RealArray:
        """``r`` (3, n) less the uniform residuals in it."""
        if self.uniform is None:
            return r
        flat, gram, *_ = self.uniform
        weights = (gram @ (flat @ r.reshape(-1)).astype(float)).astype(r.dtype)
        return np.asarray(r - (weights @ flat).reshape(r.shape))

    def preconditioned(self, r: RealArray) -> RealArray:
        """Approximate inverse times ``r`` (3, n), which changes no prescribed sum."""
        z = self._preconditioned(r)
        if self.uniform is not None:
            weights = self.uniform.inverse @ self._sums(z)
            z -= np.tensordot(weights.astype(z.dtype), self.uniform.solved, axes=1)
        return z

    def _preconditioned(self, r: RealArray) -> RealArray:
        z, normal = np.empty_like(r), np.ascontiguousarray(r[0])
        z[0] = self.joint.splines.solve(self.free, normal, normal, np.empty_like(normal)).vector
        z[1:] = self.shear.preconditioned(r[1:]) * self.bears
        return z
