"""Adhesion as a coupling: the surfaces attract each other where they do not touch, and the
attraction bends them together.

Its unknown is the attraction (nx, ny). The normal problem takes it as a fixed pull: a lift -Kσ and
the load Σσ. Its own solver (``adhesion.solver``) finds both together, nearest downhill from the
attraction of the step before, so that a history follows its branch until that ends; the normal
solve of the next round confirms the contact, and other couplings see it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import ClassVar, Self

import numpy as np

from ...contact import measure
from ...contact.controls import FixedGrips, MeanGap
from ...contact.couplings.protocol import Contact, Coupling, Ended, Exchange, Memory, Posed, Share
from ...contact.law import HardWall
from ...contact.operators import Operator
from ...contact.operators.creep import SummedOperator
from ...contact.problem import ContactProblem
from ...contact.solvers.protocol import FixedMean, FixedOffset
from ...core.arrays import BoolArray, RealArray
from ...core.errors import NoSolutionError
from .answer import AdhesiveContact, pixels_in_length
from .jkr import JKRAdhesion
from .law import Adhesion, SoftAdhesion, cohesive_length
from .solver.front import MovingFront, step_compliance
from .solver.problem import Adhered, AdhesiveProblem
from .solver.soft_core import SoftCoreNewton
from .solver.solver import AdhesiveSolution, AdhesiveSolver, MajoriseMinimise

TOLERANCE = 1e-5
"""Change of the attraction over its largest value that does not count."""

_FINAL = 1e-13
"""Error of the last normal solve: the attraction changes with the gap, whose error goes with its
root."""

_JUMP = 0.25
"""Share of |ΔF Δδ| above which energy that is lost in a step is that of a jump: a smooth branch
loses none to second order."""

_FAR = 2.0
"""Change of the gap over that of the approach above which it is no smooth response."""

_JUMPED_SHARE = 0.2
"""Share of the contact that has to open or close in a step to count as a jump where the attraction
has no range."""

_TRIES = 8
"""Solutions in a row that do not converge after which no further one is sought."""

_POSITIONS = 40
_POSITION_ERROR = 1e-9


@dataclass(frozen=True, eq=False)
class _Before:
    """Energy (J), external force (N), approach (m), gap (nx, ny) in m, jumps and energy lost (J) so
    far; NaN before a first step."""

    energy: float = math.nan
    force: float = math.nan
    approach: float = math.nan
    gap: RealArray | float = math.nan
    jumps: int = 0
    total: float = 0.0


@dataclass(frozen=True, eq=False)
class _Note:
    """The step's beginning, the profile (nx, ny) in m and problem of the last solution, and that;
    how often in a row it did not converge."""

    posed: Posed
    before: _Before
    base: RealArray
    solution: AdhesiveSolution
    mean: float | None
    failed: int = 0


class MachineOperator(SummedOperator):
    """Operator of the ``bodies``, whatever it is made of, with a testing machine of ``stiffness``
    (N/m) in series: each pixel moves all of it."""

    def __init__(self, bodies: Operator, stiffness: float) -> None:
        kernel = np.array(bodies.kernel)
        kernel[0, 0] += bodies.grid.pixel_area * math.prod(bodies.padded) / stiffness
        super().__init__(bodies, bodies.compliance, kernel)
        self.stiffness, self.zero_mean_mode = stiffness, False

    @cached_property
    def coarsened(self) -> Operator:
        """The same machine on half as many points per side."""
        return MachineOperator(self.whole.coarsened, self.stiffness)

    def matrix(self) -> RealArray:
        """Dense matrix in m/Pa."""
        return np.asarray(self.whole.matrix() + self.grid.pixel_area / self.stiffness)


@dataclass(frozen=True, eq=False)
class AdhesionCoupling(Coupling):
    """Attraction of the surfaces; the unknown is the attraction (nx, ny) in Pa that the contact is
    posed with.

    ``conserves``: nothing but jumps takes energy, neither yielding nor shear nor points of an edge
    without range.
    """

    law: Adhesion
    operator: Operator = field(repr=False)
    E_star: float
    conserves: bool
    solver: AdhesiveSolver = MajoriseMinimise()
    tolerance: float = TOLERANCE
    name: ClassVar[str] = "adhesion"
    settled_text: ClassVar[str] = "The attraction is settled"
    feedback: ClassVar[bool] = True
    positions: ClassVar[bool] = True
    remedy: ClassVar[str] = "Take smaller steps of load or position, or a grid that resolves the adhesion."

    @classmethod
    def prepared(cls, problem: ContactProblem, operator: Operator, tolerance: float) -> Self:
        """Coupling of the bodies of ``problem``."""
        assert problem.adhesion is not None
        solver: AdhesiveSolver = MajoriseMinimise(tolerance=0.1 * tolerance)
        if isinstance(problem.adhesion, JKRAdhesion):
            solver = MovingFront(step_compliance(operator))
        elif problem.adhesion.spacing > 0.0:
            solver = SoftCoreNewton(tolerance=0.1 * tolerance)
        conserves = (
            isinstance(problem.law, HardWall)
            and all(item.conserves() for item in problem.physics)
            and not isinstance(problem.adhesion, JKRAdhesion)
        )
        return cls(problem.adhesion, operator, problem.contact_modulus, conserves, solver, tolerance)

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The attraction that is remembered, followed to this load or position."""
        before = _Before()
        pull: RealArray = np.zeros(posed.profile.shape)
        if memory:
            pull = np.array(memory["attraction"], dtype=float)
            energy, force, approach, total = (
                float(memory[key]) for key in ("energy", "force", "approach", "dissipated")
            )
            jumps = int(memory["jumps"])
            before = _Before(energy, force, approach, np.asarray(memory["gap"], dtype=float), jumps, total)
        elif posed.external_force is not None and posed.external_force <= 0.0:
            # the contact without load that surfaces find which were brought to touch
            pull = self.law.attraction(self.law.spacing + posed.dented.max() - posed.dented)
            problem = AdhesiveProblem(self.operator, posed.dented, self.law, FixedMean(0.0))
            pull = self.solver.solve(problem, pull).state.attraction
        mean = None if posed.external_force is None else posed.external_force / self.operator.grid.area
        solution = self._solved(posed, posed.dented, np.inf, mean, pull, posed.start)
        note = _Note(posed, before, posed.dented, solution, mean)
        x = solution.state.pull
        return Exchange(
            x, x, np.inf, self.tolerance, smooth=False, final=_FINAL, scale=min(self.law.strength, 1e300), note=note
        )

    def _solved(
        self,
        posed: Posed,
        profile: RealArray,
        cap: float | RealArray,
        mean: float | None,
        pull: RealArray,
        pressure: RealArray | None,
    ) -> AdhesiveSolution:
        """Equilibrium under the ``mean`` external pressure, or at the position prescribed where
        that is None."""
        if mean is not None:
            return self.solver.solve(
                AdhesiveProblem(self.operator, profile, self.law, FixedMean(mean), cap), pull, pressure
            )
        control = posed.control
        if isinstance(control, MeanGap):
            # by the rule of false position for the offset at which the mean gap is this
            offset = control.value + float(profile.mean())
            places: list[tuple[float, float]] = []
            for _ in range(_POSITIONS):
                problem = AdhesiveProblem(self.operator, profile, self.law, FixedOffset(offset), cap)
                found = self.solver.solve(problem, pull, pressure)
                miss = float((found.state.gap - self._core(found.state)).mean()) - control.value
                if abs(miss) <= _POSITION_ERROR * control.value + 1e-12 * float(np.ptp(profile)):
                    return found
                pull, pressure = found.state.attraction, found.state.pressure
                slope = 1.0
                if places and places[-1][0] != offset:
                    slope = (miss - places[-1][1]) / (offset - places[-1][0])
                places.append((offset, miss))
                offset -= miss / max(slope, 0.1)
            raise NoSolutionError(
                f"mean gap must be one that the contact reaches without a jump, but {control.value:.6g} m is "
                f"not. Prescribe {{grips}}.",
                subject="mean gap",
            )
        stiffness = control.stiffness if isinstance(control, FixedGrips) else math.inf
        operator = self.operator if math.isinf(stiffness) else MachineOperator(self.operator, stiffness)
        offset = posed.top - control.value
        if operator.zero_mean_mode and offset <= float(profile.mean()):
            most = float(profile.max() - profile.mean())
            raise NoSolutionError(
                f"approach must be less than {most:.6g} m, where a periodic elastic contact is full and its "
                f"mean gap zero, but is {float(profile.max()) - offset:.6g} m. Prescribe {{mean_pressure}} to "
                "go beyond full contact.",
                subject="approach",
            )
        solution = self.solver.solve(
            AdhesiveProblem(operator, profile, self.law, FixedOffset(offset), cap), pull, pressure
        )
        if math.isinf(stiffness):
            return solution
        # the deflection of the machine counts as position
        state = solution.state
        yielded = float(state.traction.sum()) * operator.grid.pixel_area / stiffness
        bodies = replace(state, offset=state.offset + yielded, deflection=state.deflection - yielded)
        return replace(solution, state=bodies)

    def share(self, exchange: Exchange) -> Share:
        """The attraction as a lift and a load; the load between the solids that the position came
        to."""
        grid, note = self.operator.grid, exchange.note
        constraint: FixedMean | FixedOffset | None = None
        if note.posed.external_force is None:
            mean = float(note.solution.state.pressure.mean())
            constraint = FixedMean(mean) if mean > 0.0 else FixedOffset(note.solution.state.offset)
        load = float(exchange.x.sum()) * grid.pixel_area
        lift = -self.operator.apply(exchange.x) + (self.law.spacing - self._core(note.solution.state))
        return Share(load=load, lift=lift, constraint=constraint, attraction=exchange.x)

    def _core(self, state: Adhered) -> RealArray | float:
        """Gap (nx, ny) in m of the ``state`` up to that of the largest attraction, from which on
        points touch; none at a wall."""
        return np.minimum(state.gap, self.law.peak) if isinstance(self.law, SoftAdhesion) and self.law.spacing else 0.0

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        """The attraction of the gap of ``contact``; solved anew where other couplings have moved
        it."""
        note: _Note = exchange.note
        pressure = np.asarray(contact.pressure, dtype=float)
        core = self._core(note.solution.state)
        residual = self.solver.miss(self.law, exchange.x, pressure, contact.gap + core)
        base = contact.qp.profile - self.operator.apply(exchange.x) + (self.law.spacing - core)
        force = note.posed.external_force
        mean = None if force is None else force / self.operator.grid.area
        if mean is not None and isinstance(contact.qp.constraint, FixedMean):
            mean = contact.qp.constraint.mean_pressure - float(exchange.x.mean())
        # where the last solution is of this profile and load already only the normal solve is to be
        # more accurate
        moved = float(np.abs(base - note.base).max())
        same_profile = contact.qp.elastic and moved <= 1e-12 * max(float(np.ptp(base)), self.law.range)
        same_load = mean is note.mean
        if mean is not None and note.mean is not None:  # but for rounding; other couplings, such as menisci, add to it
            same_load = abs(mean - note.mean) <= 1e-9 * max(abs(mean), abs(note.mean))
        known = same_profile and same_load and note.solution.status.converged
        if residual <= self.tolerance or known:
            return replace(exchange, target=exchange.x, residual=residual)
        if note.failed >= _TRIES:
            return replace(exchange, target=exchange.x, residual=residual, stuck=True)
        solution = self._solved(note.posed, base, contact.qp.cap, mean, exchange.x, contact.pressure)
        x, failed = solution.state.pull, 0 if solution.status.converged else note.failed + 1
        note = replace(note, base=base, solution=solution, mean=mean, failed=failed)
        return replace(exchange, target=x, residual=residual, note=note)

    def unsettled(self, exchange: Exchange) -> str:
        """The change of the attraction, and the pixel that it needs where the grid does not resolve
        it."""
        length, pixel = cohesive_length(self.law, self.E_star), max(self.operator.grid.pixels)
        text = f"The attraction still changes by {exchange.residual:.1e} of its largest value"
        if length == 0.0 or pixel <= (least := length / pixels_in_length(self.law)):
            return text
        return f"{text}, whose zone takes a pixel of at most {least:.3g} m where it is {pixel:.3g} m,"

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, AdhesiveContact]:
        """Memory of attraction and energies; what adhesion did."""
        note: _Note = exchange.note
        grid, solution = self.operator.grid, note.solution
        pressure = np.asarray(contact.pressure, dtype=float)
        touching = pressure > 0.0
        # the gap that the law sees; a touch without pressure gains nothing
        gap = np.where(touching, 0.0, np.maximum(contact.gap, np.finfo(float).tiny)) + self._core(solution.state)
        zone = (pressure <= 0.0) & (gap < self.law.spacing + self.law.range)
        traction = pressure - exchange.x
        elastic = 0.5 * float((traction * self.operator.apply(traction)).sum()) * grid.pixel_area
        interface = float(self.law.energy(gap).sum()) * grid.pixel_area
        force = float(traction.sum()) * grid.pixel_area
        approach = note.posed.top + contact.level
        lost, error, jumped = _lost(note.before, force, approach, elastic + interface, gap)
        if self.conserves and not jumped:
            lost, error = 0.0, abs(lost)
        if jumped and math.isinf(self.law.strength):
            # points at the edge alone, each of which loses a little energy, are no jump
            earlier, later = note.before.gap == 0.0, gap == 0.0
            most = max(np.count_nonzero(earlier), np.count_nonzero(later))
            jumped = bool(np.count_nonzero(earlier != later) > _JUMPED_SHARE * most)
        # the problem whose Hessian tells whether the contact is stable under what is prescribed
        control, operator, posed_force = note.posed.control, self.operator, note.posed.external_force
        held: FixedMean | FixedOffset = FixedOffset(-contact.level)
        if posed_force is not None:
            held = FixedMean(posed_force / grid.area)
        elif isinstance(control, FixedGrips) and math.isfinite(control.stiffness):
            operator = MachineOperator(operator, control.stiffness)
        problem = AdhesiveProblem(operator, note.base, self.law, held, contact.qp.cap)
        state = Adhered(pressure, exchange.x, contact.solution.state.deflection, gap, exchange.x, -contact.level)
        found = AdhesiveContact(
            law=self.law,
            attraction=exchange.x,
            attractive_force=float(exchange.x.sum()) * grid.pixel_area,
            external_force=force,
            grips=control.value if isinstance(control, FixedGrips) else approach,
            adhesive_area_fraction=float(np.mean(zone)),
            interface_energy=interface,
            elastic_energy=elastic,
            margin=self.solver.margin(problem, state),
            cohesive_length=cohesive_length(self.law, self.E_star),
            pixel=max(grid.pixels),
            dissipated=lost,
            dissipated_error=error,
            jumped=jumped,
            jumps=note.before.jumps + int(jumped),
            total_dissipated=note.before.total + lost,
            residual=exchange.residual,
            energies=solution.energies,
            steps=solution.steps,
            newton_steps=solution.newton_steps,
            fft_pairs=solution.fft_pairs,
            status=solution.status,
            spot_radius=self._radius(touching),
            zone_radius=self._radius(touching | zone, weighted=True),
        )
        return found.memory(gap, approach), found

    def _radius(self, inside: BoolArray, *, weighted: bool = False) -> float:
        """Radius in m of the mean spot of the points ``inside``, of the mean ``weighted`` by area
        if asked for."""
        grid = self.operator.grid
        spots = measure.contact_spots(inside, wraps=self.operator.boundary.wraps)
        if not spots.size:
            return 0.0
        mean = float((spots.astype(float) ** 2).sum() / spots.sum()) if weighted else float(spots.mean())
        area = mean * grid.pixel_area
        if 1 in grid.shape:
            return 0.5 * area / grid.size[grid.shape.index(1)]
        return math.sqrt(area / math.pi)

    def end_in_time(self, exchange: Exchange, contact: Contact, ended: Ended, stored: float, heat: float) -> Ended:
        """Memory and outcome of a step of time. What is lost is neither stored nor heat of the
        bodies: a jump, or the error of the trapezium."""
        found, before = ended[1], exchange.note.before
        assert isinstance(found, AdhesiveContact)
        approach = exchange.note.posed.top + contact.level
        energy = stored + heat + found.interface_energy
        lost, error, jumped = _lost(before, found.external_force, approach, energy, contact.gap)
        found = replace(
            found,
            elastic_energy=stored,
            dissipated=lost,
            dissipated_error=error,
            jumped=jumped,
            jumps=before.jumps + int(jumped),
            total_dissipated=before.total + lost,
        )
        return found.memory(contact.gap, approach), found


def _lost(before: _Before, force: float, approach: float, energy: float, gap: RealArray) -> tuple[float, float, bool]:
    """Energy (J) lost since the step before by the trapezoidal rule, its error, and whether in a
    jump: more than the rule misses on a smooth branch.

    A smooth branch loses nothing to second order, and its gap changes about as much as the
    approach. Where the rule finds energy made, which no step does, that is its error.
    """
    if math.isnan(before.energy):
        return 0.0, 0.0, False
    step = approach - before.approach
    lost = 0.5 * (force + before.force) * step - (energy - before.energy)
    farthest = float(np.abs(gap - before.gap).max())
    spread = abs((force - before.force) * step)
    return lost, max(0.5 * spread, -lost), lost > _JUMP * spread and farthest > _FAR * abs(step)
