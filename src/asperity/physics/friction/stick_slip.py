"""Stick and slip as a coupling: shear tractions within the bound of a friction law, which lift the
surfaces and so change the pressure.

For the pressure of a round the tangential problem is a convex programme (``friction.solver``); its
traction lifts the surfaces of unlike bodies, which changes the pressure (Panagiotopoulos 1975).
Both are solved for together by Newton's method (``friction.solver.joint``), and the next round
checks the result: a normal solve under its lift, and a tangential one under that pressure. Where
they cannot be, as under a hardness or while a position is searched for, or do not come nearer, the
rounds alternate between them: each reduces the change by about friction times Dundurs' β, and
extrapolation does the rest. Where bodies do not couple, one tangential solve follows the contact.

A step is implicit: the traction at its end is along the slip of the whole step (Alart & Curnier
1991), so that paths must be sampled finely enough that slip does not turn or reverse within a step.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Self

import numpy as np

from ...contact.couplings.protocol import Contact, Coupling, Exchange, Memory, Posed
from ...contact.problem import ContactProblem
from ...contact.solvers.protocol import FixedMean
from ...contact.tangential import Shift, Tangential, TangentialForce, resultant, shift_field
from ...core.arrays import BoolArray, RealArray
from ...core.engine import CpuEngine
from ...core.errors import InputError, NoSolutionError
from ...core.status import Outcome, Status
from ...solids.layers import Layered
from .answer import GROSS, StickSlip, slides_freely
from .law import Coulomb, FrictionLaw, FullStick, TrescaFriction
from .operator import TangentialOperator
from .solver.joint import JointIterate, JointProblem
from .solver.newton import StickSlipNewton
from .solver.problem import Deviation, TangentialQP, TangentialSolution, TangentialSolver, size_of

TOLERANCE = 1e-5
"""Relative change of the displacement by shear that does not count. On a rough surface (512², ν =
0.3, rigid counter body, Q up to half the limit) tractions are then within 2e-6 and pressures within
1e-7 of those for 1e-8."""

_FINER = 0.1
"""Error of tangential solves over that tolerance, where bodies do not couple."""

_COUPLED = 0.3
"""The same where they do. Joint solves and tractions of a history at 256² for 0.1, 0.3, 1: 87, 82,
77 pairs a step, within 7e-7, 2e-6, 6e-6."""

_SHARE = 0.03
"""Error of a tangential solve over the residual of the coupling: replies are that much finer than
what still changes."""

_LOOSEST = 1e-2
"""Error of the first tangential solve of a step where rounds alternate: its pressure is a guess."""

_NORMAL = 0.03
"""Error of the normal contact over that of the shear at which they are no longer solved for
together."""

_GAIN = 0.5
"""Residual over that of the round before above which they are not solved for together again."""

_RESTLESS = 3
"""Openings and closings of a point in one step from which on it does so by turns."""


@dataclass(frozen=True, eq=False)
class Held:
    """What earlier tractions and pressures displace in viscoelastic bodies at the end of a step of
    time.

    ``displacement`` (2, nx, ny) along the surface and ``lift`` (nx, ny) by shear, m; ``start`` (2,
    nx, ny), the whole displacement along the surface before the step.
    """

    displacement: RealArray
    lift: RealArray
    start: RealArray


@dataclass(frozen=True, eq=False)
class _Before:
    """What a step starts from: traction, displacement along the surface, slip so far (2, nx, ny);
    shift (3,); work (J)."""

    traction: RealArray
    displacement: RealArray
    slip: RealArray
    shift: RealArray
    total: float
    control: Tangential


@dataclass(frozen=True, eq=False)
class _Note:
    """The step's beginning, and where its rounds are.

    ``traction`` (2, nx, ny) is the last one, of which ``slipping`` points are at their bound;
    ``solution`` that for the pressure ``solved_for``. ``joint``: pressure and traction may be
    solved for together. ``turns`` (nx, ny) is how often each point has opened or closed.
    """

    before: _Before
    traction: RealArray | None = None
    slipping: BoolArray | None = None
    solution: TangentialSolution | None = None
    solved_for: RealArray | None = None
    residual: float = 1.0
    joint: bool = True
    steps: int = 0
    pairs: float = 0.0
    touching: BoolArray | None = None
    turns: Any = None

    def with_solution(self, solution: TangentialSolution) -> _Note:
        """The same with a tangential ``solution``."""
        pairs = self.pairs + solution.pairs
        return replace(
            self,
            traction=solution.traction,
            slipping=solution.slipping,
            solution=solution,
            solved_for=None,
            steps=self.steps + solution.iterations,
            pairs=pairs,
        )

    def touched(self, touching: BoolArray) -> _Note:
        """The same after a round in which the points ``touching`` (nx, ny) touch."""
        if self.touching is None:
            return replace(self, touching=touching, turns=np.zeros(touching.shape, np.int64))
        return replace(self, touching=touching, turns=self.turns + (touching != self.touching))


SERVES = 20.0
"""Coefficient of friction that stands for full stick where that has no solution. Of 131 presses
of spheres on bodies of Poisson's ratio 0 to 0.2 in twelve steps full stick failed in 46; there 20
and 50 settled in all, 100 in 41."""

_JUMPING = (TrescaFriction, FullStick)
"""Laws by which a point bears shear as soon as it touches."""


@dataclass(frozen=True, eq=False)
class StickSlipCoupling(Coupling):
    """Shear tractions by a law of friction; the unknown is the normal displacement (nx, ny) in m by
    them.

    In a step of time of viscoelastic bodies the ``operator`` is that of the step, and ``held`` what
    the past leaves.
    """

    law: FrictionLaw
    operator: TangentialOperator = field(repr=False)
    solver: TangentialSolver
    feedback: bool = True
    tolerance: float = TOLERANCE
    held: Held | None = field(default=None, repr=False)
    name: ClassVar[str] = "stick_slip"
    settled_text: ClassVar[str] = "The displacement by shear is settled"

    @property
    def remedy(self) -> str:
        """What to do if it does not settle."""
        if isinstance(self.law, FullStick):
            return f"Take Coulomb({SERVES:g}), which slips next to the edge alone, or a finer grid."
        if isinstance(self.law, _JUMPING):
            return "Take Coulomb(mu, limit=strength) with a large mu, whose bound begins at zero, or a finer grid."
        return "Take smaller steps, tighten the solver's tolerance, or lower the friction coefficient."

    @classmethod
    def prepared(cls, problem: ContactProblem, tolerance: float, threads: int | None) -> Self:
        """Coupling of the bodies of ``problem``, passive where shear does not lift them or is not
        to.

        InputError if an interface inside a periodic body carries no shear.
        """
        law, bodies = problem.friction, (problem.body, problem.counter_body)
        assert law is not None
        # a mean traction would move it without end
        if any(isinstance(body, Layered) and body.reduced.slips for body in bodies):
            raise InputError(
                "layers of a body with stick and slip must be bonded, but one is Frictionless(): nothing "
                "would hold it. Use Bonded()."
            )
        operator = TangentialOperator(problem.grid, bodies, problem.boundary, engine=CpuEngine(threads))
        found = cls(law, operator, StickSlipNewton(_FINER * tolerance), tolerance=tolerance)
        return found.lifting(coupled=operator.coupled)

    def lifting(self, *, coupled: bool) -> Self:
        """The same for bodies that are ``coupled``: whether shear lifts their surfaces now or
        later."""
        lifts = coupled and not (isinstance(self.law, Coulomb) and not self.law.coupled)
        finer = _COUPLED if lifts else _FINER
        return replace(self, feedback=lifts, solver=replace_tolerance(self.solver, finer * self.tolerance))

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """What is remembered, with the displacement by the shear traction under the pressure to
        start from."""
        zero = np.zeros((2, *posed.profile.shape))
        shift, control, traction, slip, dissipated = np.zeros(3), posed.tangential or Shift(), zero, zero, 0.0
        if memory:
            traction = np.stack([memory["traction_x"], memory["traction_y"]])
            slip = np.stack([memory["slip_x"], memory["slip_y"]])
            shift, force = np.asarray(memory["shift"], dtype=float), np.asarray(memory["force"], dtype=float)
            kept = Shift(*shift) if np.isnan(force).any() else TangentialForce(*force)
            control, dissipated = posed.tangential or kept, float(memory["dissipated"])
        if isinstance(control, Shift) and np.isnan(shift).any():
            raise NoSolutionError(
                "shift must follow a step whose shift is known, but the tangential force of the step before "
                "was all that friction bears: how far the body slid is not determined. Prescribe a shift "
                "({shift}) in that step, or a smaller tangential force.",
                subject="shift",
            )
        if isinstance(control, Shift) and control.twist and any(posed.operator.boundary.wraps):
            raise InputError(
                f"twist must be zero where the contact repeats, but is {control.twist:g} rad. Use the boundary Free()."
            )
        displacement = zero if self.held is None else self.held.start
        if memory and self.held is None:
            displacement = self.operator.displacement(traction)
            if posed.start is not None:
                displacement = displacement + self.operator.drawn(posed.start)
        note = _Note(_Before(traction, displacement, slip, shift, dissipated, control))
        if not self.feedback:
            x = np.zeros(posed.profile.shape)
            return Exchange(x, x, 0.0, self.tolerance, note=note)
        lift = self._lift(note.before.traction)
        return Exchange(lift, lift, np.inf, self.tolerance, note=note)

    def _lift(self, traction: RealArray) -> RealArray:
        """Normal displacement (nx, ny) in m by ``traction`` (2, nx, ny) in Pa at the end of the
        step, and by earlier ones."""
        found = self.operator.lift(traction)
        return found if self.held is None else found + self.held.lift

    def _free(self, before: _Before) -> RealArray:
        """Displacement (2, nx, ny) in m before the step less what the past leaves at its end."""
        return before.displacement if self.held is None else before.displacement - self.held.displacement

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        """The displacement by the shear traction that ``contact`` bears."""
        if not self.feedback:
            return exchange
        note: _Note = exchange.note.touched(contact.touching)
        exchange = replace(exchange, pressure=None, note=note)
        posed = self._posed_together(exchange, contact)
        if posed is not None and note.traction is None:
            return self._together(exchange, posed, contact, note.before.traction)
        loose = replace_tolerance(self.solver, max(self.solver.tolerance, min(_LOOSEST, _SHARE * note.residual)))
        note = self._solved(note, _double(contact.pressure), loose)
        assert note.solution is not None
        target = self._lift(note.solution.traction)
        size = float(np.linalg.norm(target))
        change = float(np.linalg.norm(target - exchange.x))
        residual = change / size if size else change
        joint, traction = note.joint and residual < _GAIN * exchange.residual, note.solution.traction
        note = replace(note, residual=residual, solved_for=contact.pressure, joint=joint)
        exchange = replace(exchange, target=target, residual=residual, scale=size or 1.0, note=note)
        if posed is None or not joint or exchange.settled:
            return exchange
        return replace(self._together(exchange, posed, contact, traction), residual=residual)

    def _posed_together(self, exchange: Exchange, contact: Contact) -> JointProblem | None:
        """Both problems together, where they can be solved so."""
        note: _Note = exchange.note
        searched = contact.posed.external_force is None and isinstance(contact.qp.constraint, FixedMean)
        if not note.joint or searched or not contact.pressure.any():
            # where a position is searched for, each load on the way would be solved for to the end:
            # 415 pairs for 126
            return None
        before, grid = note.before, self.operator.grid
        lifted = exchange.x if self.held is None else exchange.x - self.held.lift
        normal = replace(contact.qp, profile=contact.qp.profile + lifted)
        if isinstance(before.control, Shift):
            target = self._free(before) + shift_field(grid, _vector(before.control) - before.shift)
            posed = JointProblem(normal, self.operator, self.law, target, None)
            return posed if posed.solvable else None
        force = np.array([before.control.x, before.control.y])
        most = float(self.law.bound(_double(contact.pressure)).sum()) * grid.pixel_area
        if slides_freely(before.control, most):
            return None
        posed = JointProblem(normal, self.operator, self.law, self._free(before), force / grid.area)
        return posed if posed.solvable else None

    def _together(self, exchange: Exchange, posed: JointProblem, contact: Contact, traction: RealArray) -> Exchange:
        """Pressure and traction solved for together from those of ``contact`` and ``traction``."""
        errors = {"shear_error": self.solver.tolerance, "normal_error": _NORMAL * self.solver.tolerance}
        found = JointIterate(posed, _double(contact.pressure), traction).solved(**errors)
        target = self._lift(found.traction)
        size = float(np.linalg.norm(target))
        change = float(np.linalg.norm(target - exchange.x))
        steps, pairs = exchange.note.steps + found.steps, exchange.note.pairs + found.pairs
        found_at = {"traction": found.traction, "slipping": found.slipping, "residual": 0.0}
        note = replace(exchange.note, **found_at, steps=steps, pairs=pairs)
        return replace(
            exchange,
            target=target,
            residual=change / size if size else change,
            scale=size or 1.0,
            pressure=found.pressure,
            note=note,
        )

    def _solved(self, note: _Note, pressure: RealArray, solver: TangentialSolver) -> _Note:
        """Note with the tangential problem solved under ``pressure`` (Pa), from the last traction
        of this step or the step before."""
        before, grid = note.before, self.operator.grid
        bound = self.law.bound(pressure)
        target = self._free(before) - self.operator.drawn(pressure)
        start = before.traction
        if note.traction is not None and note.slipping is not None:
            # what slipped goes to its bound of now
            start, slipping = note.traction.copy(), note.slipping
            turned = start[:, slipping]
            start[:, slipping] = turned * (bound[slipping] / size_of(turned))
        warm, mean = start if start.any() else None, None
        if isinstance(before.control, Shift):
            target += shift_field(grid, _vector(before.control) - before.shift)
        else:
            force = np.array([before.control.x, before.control.y])
            most = float(bound.sum()) * grid.pixel_area
            size = before.control.magnitude
            if slides_freely(before.control, most):
                # everything slides along the force, by the least shift that slides the last point
                direction = force / size if size else force
                traction = bound * direction[:, None, None]
                residual = target - self.operator.displacement(traction)
                contact = bound > 0.0
                along = np.tensordot(direction, residual, axes=1)
                least = float(np.max(-along[contact], initial=0.0))
                across = np.array([-direction[1], direction[0]])
                sideways = float(np.tensordot(across, residual, axes=1)[contact].mean()) if contact.any() else 0.0
                shift = least * direction - sideways * across
                slip = np.where(contact, (along + least) * direction[:, None, None], 0.0)
                solution = TangentialSolution(
                    traction, shift, slip, Deviation(0.0, 0.0), _SLIDES, 0, self.operator.pairs_per_application
                )
                return note.with_solution(solution)
            mean = force / grid.area
        return note.with_solution(solver.solve(TangentialQP(self.operator, bound, target, mean), warm))

    def unsettled(self, exchange: Exchange) -> str:
        """The change of the displacement, and which points open and close by turns where the bound
        jumps."""
        text = f"The normal displacement by the shear of stick and slip still changes by {exchange.residual:.1e}"
        turns = exchange.note.turns
        restless = 0 if turns is None else int(np.count_nonzero(turns >= _RESTLESS))
        if not isinstance(self.law, _JUMPING) or not restless:
            return text
        which = "1 point, which opens and closes" if restless == 1 else f"{restless} points, which open and close"
        why = (
            "it bears its whole shear strength as soon as it touches, and that shear opens it: between "
            "the two this law has no solution"
        )
        return f"{text} because of {which} by turns ({why})"

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, StickSlip]:
        """Memory of tractions, slip, shift and work; shear and slip of the step.

        NoSolutionError if the prescribed force is more than friction bears.
        """
        note: _Note = exchange.note
        before, grid = note.before, self.operator.grid
        bound = self.law.bound(_double(contact.pressure))
        limit = float(bound.sum()) * grid.pixel_area
        control = before.control
        if isinstance(control, TangentialForce) and not control.magnitude <= limit * (2.0 - GROSS):
            if limit == 0.0:
                why = "friction is zero" if contact.pressure.any() else "the surfaces do not touch"
                raise NoSolutionError(
                    f"tangential force must be zero where {why}, but is {control.magnitude:.6g} N: nothing "
                    f"bears it. Prescribe a shift ({{shift}}) instead.",
                    subject="tangential force",
                )
            raise NoSolutionError(
                f"tangential force must be at most {limit:.6g} N, which friction bears under this load, but is "
                f"{control.magnitude:.6g} N: the body slides without end. Prescribe a shift ({{shift}}) instead.",
                subject="tangential force",
            )
        known = note.solution is not None and note.solved_for is contact.pressure
        if not known or note.solution.deviation.error > self.solver.tolerance:  # type: ignore[union-attr]
            note = self._solved(note, _double(contact.pressure), self.solver)
        found = self._outcome(replace(exchange, note=note), contact, limit)
        return found.memory, found

    def _outcome(self, exchange: Exchange, contact: Contact, limit: float) -> StickSlip:
        note: _Note = exchange.note
        before, grid, pressure, solution = note.before, self.operator.grid, _double(contact.pressure), note.solution
        assert solution is not None
        control, traction, bound = before.control, solution.traction, self.law.bound(pressure)
        step = _vector(control) - before.shift if isinstance(control, Shift) else np.append(solution.shift, 0.0)
        moved = _vector(control) if isinstance(control, Shift) else before.shift + step
        if slides_freely(control, limit) and pressure.any():
            moved = np.array([np.nan, np.nan, moved[2]])
        slip, bare = solution.slip, (pressure > 0.0) & (bound == 0.0)
        if bare.any():  # points that touch and bear no shear slip too
            left = self._free(before) - self.operator.drawn(pressure) - self.operator.displacement(traction)
            slip = np.where(bare, left + shift_field(grid, step), slip)
        displacement = self.operator.displacement(traction) + self.operator.drawn(pressure)
        if self.held is not None:
            displacement = displacement + self.held.displacement
        density = np.einsum("kij,kij->ij", traction, slip)
        dissipated = float(density.sum()) * grid.pixel_area
        force_x, force_y, torque = resultant(grid, traction)
        # De Saxcé's residual of gap and slip together, see ``StickSlip``
        work = np.where(np.isfinite(bound), bound, 0.0) * np.hypot(*solution.slip)
        work_of_slip = np.einsum("kij,kij->", traction, solution.slip)
        residual = abs(float((pressure * contact.gap + work).sum() - work_of_slip))
        scale = max(float(pressure.sum()) * float(np.hypot(*step[:2])), float(work.sum()))
        return StickSlip(
            law=self.law,
            tangential=control,
            traction=traction,
            slip_increment=slip,
            slip=before.slip + slip,
            tangential_displacement=displacement,
            shear_displacement=exchange.x,
            shift_x=float(moved[0]),
            shift_y=float(moved[1]),
            twist=float(moved[2]),
            force_x=force_x,
            force_y=force_y,
            torque=torque,
            friction_limit=limit,
            dissipation_density=density,
            dissipated=dissipated,
            total_dissipated=before.total + dissipated,
            tangential_energy=0.5 * float(np.einsum("kij,kij->", traction, displacement)) * grid.pixel_area,
            duality_gap=solution.deviation.gap,
            complementarity=residual / scale if scale > 0.0 else 0.0,
            iterations=note.steps,
            fft_pairs=note.pairs,
            status=solution.status,
        )


_SLIDES = Status(Outcome.CONVERGED, "All points slide.")


def replace_tolerance(solver: TangentialSolver, tolerance: float) -> TangentialSolver:
    """The same method with another ``tolerance``."""
    return replace(solver, tolerance=tolerance)  # type: ignore[type-var]


def _double(pressure: RealArray) -> RealArray:
    return np.asarray(pressure, dtype=float)


def _vector(shift: Shift) -> RealArray:
    return np.array([shift.x, shift.y, shift.twist])
