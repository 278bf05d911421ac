"""Small changes of a contact with stick and slip: its tangential stiffness, and how fast pressure
and shear settle in turn.

Both linearise the last step on its sets: sticking points move with the counter body, slipping ones
turn on their circles and follow the pressure, and the free points of the normal contact keep their
gap of zero (``friction.solver.joint``). Where shear changes the pressure the load or the position
is held, as it was prescribed; under a hardness the pressure is.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...contact.controls import Force, MeanPressure
from ...contact.operators import prepare_operator
from ...contact.result import ContactResult
from ...contact.solvers.protocol import ContactQP, FixedMean, FixedOffset
from ...contact.tangential import TangentialForce, resultant, shift_field
from ...core.arrays import RealArray
from ...core.engine import CpuEngine
from ...core.errors import InputError
from .law import Coulomb
from .operator import TangentialOperator
from .solver.joint import JointIterate, JointProblem, JointSystem, Place
from .solver.linear_system import GeneralSystem, gmres
from .solver.problem import Points, Sets, size_of

_REDUCTION = 1e-5
"""Reduction of the residual in the systems of the stiffness: single precision holds no more, and
the stiffness is off by no more than 3e-6 in the tests."""

_PRODUCTS = 80
"""Products in one of these systems at most; about 12 are the rule."""

_ROUNDS = 3
_COARSE = 0.02
"""Rounds of the linearised alternation, and the reduction in their systems. Rough contact, 64²: the
factor of the third is within 2 % of that of the tenth."""


@dataclass(frozen=True, eq=False)
class TangentialStiffness:
    """Change of tangential force by a small further shift, on the points that stick and slip now.

    Attributes
    ----------
    matrix
        (2, 2) in N/m: force along x and y (rows) by shift along x and y. On a free boundary (3, 3),
        with the torque about the centre of the grid in N·m and the twist in rad last.
    """

    matrix: RealArray

    def along(self, x: float, y: float) -> float:
        """Change of force along the direction (``x``, ``y``) by a shift along it, N/m."""
        direction = np.array([x, y]) / float(np.hypot(x, y))
        return float(direction @ self.matrix[:2, :2] @ direction)


def tangential_stiffness(result: ContactResult) -> TangentialStiffness:
    """Tangential stiffness of ``result``: derivative of the force of its last step by the shift at
    its end, by one linear solve for each.

    It is that of a shift which goes on as the step did, slipping points slipping further; a shift
    that turns back meets sticking points everywhere at first.

    Raises
    ------
    InputError
        If the result has no stick and slip, or does not touch.
    """
    linear = _Linearised.of(result, force=False)
    grid = result.problem.grid
    kinds = 2 if any(result.problem.boundary.wraps) else 3
    reach = 0.5 * max(grid.size)
    columns = []
    for kind in range(kinds):
        unit = np.zeros(3)
        unit[kind] = 1.0 / reach if kind == 2 else 1.0
        moved = np.broadcast_to(shift_field(grid, unit), (2, *grid.shape))
        found = resultant(grid, linear.traction_by(moved))
        columns.append(np.array(found[:kinds]) * (reach if kind == 2 else 1.0))
    return TangentialStiffness(np.stack(columns, axis=1))


def contraction_factor(result: ContactResult) -> float:
    """Factor by which a round between pressure and shear multiplies their error: of the alternation
    linearised at ``result``.

    Below one the plain alternation contracts there, to the one solution nearby; above one it does
    not, whatever method found the solution. Zero where shear does not change the pressure.

    Raises
    ------
    InputError
        If the result has no stick and slip, or does not touch.
    """
    linear = _Linearised.of(result, force=True)
    return linear.contraction() if linear.coupled else 0.0


class _Masked(NamedTuple):
    """Some rows of a system alone, the others held."""

    system: JointSystem
    rows: RealArray

    def product(self, z: RealArray) -> RealArray:
        """The rows of the matrix times ``z``."""
        return np.asarray(self.system.product(z) * self.rows)

    def preconditioned(self, r: RealArray) -> RealArray:
        """The rows of the preconditioner times ``r``."""
        return np.asarray(self.system.preconditioned(r) * self.rows)


_NORMAL, _SHEAR, _ALL = (np.array(rows, "float32")[:, None] for rows in ((1, 0, 0), (0, 1, 1), (1, 1, 1)))


@dataclass(frozen=True, eq=False)
class _Linearised:
    """System of the last step of a result on the points of its contact."""

    shear: TangentialOperator
    place: Place
    system: JointSystem
    coupled: bool

    @classmethod
    def of(cls, result: ContactResult, *, force: bool) -> _Linearised:
        """With the tangential ``force`` held if it was prescribed."""
        found, problem = result.require_stick_slip(), result.problem
        if not result.pressure.any():
            raise InputError("result of a tangential stiffness must be in contact, but its surfaces do not touch.")
        shear = TangentialOperator(problem.grid, (problem.body, problem.counter_body), problem.boundary)
        # only the wanted products of both are made, so that one engine serves
        operator = prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=CpuEngine())
        pressure = np.asarray(result.pressure, dtype=float)
        by_load = isinstance(result.control, MeanPressure | Force)
        constraint = FixedMean(float(pressure.mean())) if by_load else FixedOffset(0.0)
        qp = ContactQP(operator, np.zeros(problem.grid.shape), np.inf, constraint, 1.0)
        control = found.tangential
        mean = found.traction.mean(axis=(1, 2)) if force and isinstance(control, TangentialForce) else None
        iterate = JointIterate(JointProblem(qp, shear, found.law, np.zeros((2, 1, 1)), mean), pressure, found.traction)
        index = np.flatnonzero(pressure)
        nothing = np.zeros((2, len(index)))
        bound = found.law.bound(pressure).reshape(-1)[index]
        points = Points(index, bound, nothing, shear.largest)
        q, s, slip = (
            points.gathered(found.traction),
            points.gathered(found.slip_increment),
            found.slipping.reshape(-1)[index] & (bound > 0.0),
        )
        normal = np.where(slip, q / np.where(slip, size_of(q), 1.0), 0.0)
        sets = Sets(slip, normal, np.where(slip, size_of(s), 0.0))
        free = shear.engine.points(problem.grid.shape, index, "float32")
        place = Place(free, points, q, pressure.reshape(-1)[index], s, nothing[0], sets, 0.0)
        simple = isinstance(found.law, Coulomb) and not found.law.coupled
        coupled = shear.coupled and not simple and bool(np.all(np.isinf(problem.law.pressure_cap())))
        return cls(shear, place, JointSystem.of(iterate, place), coupled)

    def _solved(self, rows: RealArray, r: RealArray, reduction: float) -> RealArray:
        system: GeneralSystem = self.system if rows is _ALL else _Masked(self.system, rows)
        return gmres(system, self.system.centred(r * rows) * rows, reduction, _PRODUCTS)[0]

    def traction_by(self, moved: RealArray) -> RealArray:
        """Change of traction (2, nx, ny) in Pa by the displacement ``moved`` (2, nx, ny) in m of
        the counter body."""
        s = self.place.points.gathered(moved)
        r = np.concatenate([0.0 * s[:1], self.place.sets.free_part(s) * self.system.bears]).astype("float32")
        z = self._solved(_ALL if self.coupled else _SHEAR, r, _REDUCTION)
        change = self.system.full(z)[1:].astype(float) / self.system.shear.work.pixel
        return self.place.points.scattered(change, moved.shape[1:])

    def contraction(self) -> float:
        """Ratio of the normal displacements by shear of two rounds in a row of the linearised
        alternation."""
        lift = self._lift(self.place.q.astype("float32"))
        factor = 0.0
        for _ in range(_ROUNDS):
            size = float(np.linalg.norm(lift))
            if size == 0.0:
                return 0.0
            pressed = self._solved(_NORMAL, lift * np.float32(-1.0 / size), _COARSE)
            sheared = self._solved(_SHEAR, -self.system.product(pressed), _COARSE)
            lift = self._lift(self.system.full(pressed + sheared)[1:])
            factor = float(np.linalg.norm(lift))
        return factor

    def _lift(self, traction: RealArray) -> RealArray:
        """Normal displacement by ``traction`` (2, n), in the first row of (3, n), without what a
        prescribed load leaves free."""
        change = np.concatenate([traction, 0.0 * traction[:1]])
        self.system.respond(change)
        out = np.zeros_like(change)
        self.place.free.gather_products(self.system.joint.fields[1][2], out[0], out[0], out[0])
        out *= np.float32(1.0 / self.system.shear.work.pixel)
        return np.asarray(self.system.centred(out) * _NORMAL)
