"""Steady rolling with friction: creepage, spin, and the forces that they cause (Kalker 1990).

The contact rolls along +x over the bodies, which slide slowly against each other. In the frame of the contact everything is steady, and
the material moves through it from the leading edge backwards. One implicit step of stick and slip is then a move of the material
by a pixel: what was displaced by u at x + dx is at x. Steps are repeated until the tractions rest, first with moves of several pixels.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.errors import ConvergenceError, InputError
from ..core.status import Outcome, Status
from ..surfaces.surface import Surface
from .boundary import Periodic
from .laws import FrictionLaw
from .operators.tangential import TangentialOperator
from .problem import ContactProblem, Control, Flat
from .result import ContactResult
from .solve import Keep, solve
from .solvers.active_set.solver import ActiveSet
from .solvers.stick_slip.newton import StickSlipNewton
from .solvers.stick_slip.problem import TangentialQP
from .tangential import about_centre, resultant

_STRIDES = (8, 4, 2, 1)
"""Pixels by which the material moves in a step, one after the other; the last makes the result. A contact of n pixels comes to rest in
about n/8 + 3 · 4 steps instead of n."""

_FEWEST = 8
"""Strides along the contact at least: coarser ones are no start for the finer."""

_MOST_LENGTHS = 20
"""Contact lengths rolled over with one stride at most; three suffice without spin."""


@dataclass(frozen=True)
class Creepage:
    """Relative motion of rolling bodies, small against one: slip velocity of the counter body over the body, over the rolling speed.

    At (x, y) from the centre of the grid it is (x - spin y, y + spin x) without elastic displacements.

    Parameters
    ----------
    x, y
        Creepage along the rolling direction x and across it.
    spin
        Relative rotation about the normal over the rolling speed, rad/m.

    Raises
    ------
    InputError
        If a number is not finite.
    """

    x: float = 0.0
    y: float = 0.0
    spin: float = 0.0

    def __post_init__(self) -> None:
        require.finite(self.x, "creepage along x")
        require.finite(self.y, "creepage along y")
        require.finite(self.spin, "spin (rad/m)")


@dataclass(frozen=True, eq=False)
class RollingContact:
    """Steady rolling contact. Fields are (nx, ny) arrays or (2, nx, ny) arrays of x and y components, all values SI.

    Attributes
    ----------
    normal
        The contact under load, with the shear of unlike bodies taken into account.
    creepage
        What was prescribed.
    traction
        Shear traction on the body, Pa.
    slip
        Slip velocity of the counter body over the body, over the rolling speed; zero where it sticks.
    force_x, force_y, torque
        Force (N) and torque about the centre of the grid (N·m) on the body. Kalker's forces on the other body have the opposite sign.
    friction_limit
        Largest tangential force that the contact bears, N.
    power_density
        Energy turned into heat per distance rolled, (nx, ny) in J/m³; its integral is below ``dissipated`` by an error of first order in the pixel.
    dissipated
        Heat per distance rolled, J/m: the power of the forces along creepage and spin, since the elastic energy does not change.
    steadiness
        Relative change of the traction by the last move of one pixel.
    steps
        Steps taken.
    status
        How it ended.
    """

    normal: ContactResult
    creepage: Creepage
    traction: RealArray
    slip: RealArray
    force_x: float
    force_y: float
    torque: float
    friction_limit: float
    power_density: RealArray
    dissipated: float
    steadiness: float
    steps: int
    status: Status

    @property
    def slipping(self) -> BoolArray:
        """(nx, ny), True where the surfaces slip."""
        return np.asarray(np.any(self.slip != 0.0, axis=0))

    @property
    def converged(self) -> bool:
        """Whether traction and pressure came to rest."""
        return self.status.converged

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of the method and of the contact."""
        return tuple(sorted({"Alart1991", "Kalker1990", *self.normal.citation_keys}))


def roll(
    problem: ContactProblem,
    control: Control,
    creepage: Creepage,
    *,
    tolerance: float = 1e-4,
    rounds: int = 20,
) -> RollingContact:
    """Steady rolling of the bodies of ``problem`` along +x under ``control``, with its friction and a ``creepage``.

    The surface is that of the contact at rest, which does not change along x as it rolls: smooth wheels, rollers and balls, or
    roughness along x only in the sense of a standing pattern.

    Parameters
    ----------
    problem
        A contact that does not repeat along x (``Free`` or ``FreeLine``), with a friction law; without film and hardness.
    control
        ``Force``, ``MeanPressure``, ``Approach`` or ``MeanGap``.
    creepage
        Creepages and spin.
    tolerance
        Largest relative change of the traction from move to move, and of the displacement by shear of unlike bodies from round to round.
    rounds
        Rounds between normal contact and shear at most, for unlike bodies.

    Raises
    ------
    InputError
        If the problem repeats, has no friction, or has a film or a layer that slips.
    ConvergenceError
        If traction or pressure do not come to rest.
    """
    friction = _checked(problem)
    require.positive(tolerance, "tolerance of rolling")
    require.integer(rounds, 1, "number of rounds")
    operator = TangentialOperator(problem.grid, (problem.body, problem.counter_body), problem.boundary)
    bare = replace(problem, friction=None)
    profile = problem.profile()
    lift: RealArray = np.zeros(problem.grid.shape)
    traction: RealArray | None = None
    total, change = 0, np.inf
    for _ in range(rounds if operator.coupled else 1):
        lifted = replace(bare, surface=_lowered(bare, profile, lift), counter_surface=Flat())
        normal = solve(lifted, control, keep=Keep(stiffness=False), solver=ActiveSet(tolerance=1e-10))
        found = _Rolling(operator, friction, normal.pressure, creepage, tolerance)
        traction = found.rolled(traction)
        total += found.steps
        before, lift = lift, operator.lift(traction)
        size = float(np.linalg.norm(lift))
        change = float(np.linalg.norm(lift - before)) / size if size else 0.0
        if change <= tolerance:
            break
    settled = found.steadiness <= tolerance and (change <= tolerance or not operator.coupled)
    message = f"Traction at rest to {found.steadiness:.1e} a move after {total} steps."
    status = Status(Outcome.CONVERGED, message)
    if not settled:
        message = f"Rolling did not come to rest: traction changes by {found.steadiness:.1e} a move, displacement by shear by {change:.1e}."
        status = Status(Outcome.STAGNATED, message, "Use a finer grid or a larger tolerance.")
    result = found.result(normal, creepage, total, status)
    if not settled:
        raise ConvergenceError(f"{status.message} {status.remedy}", result)
    return result


def _lowered(problem: ContactProblem, profile: RealArray, lift: RealArray) -> Surface:
    """Composite surface less the displacement by shear."""
    return problem.surface.with_heights(profile - lift, "composite, less the displacement by shear")


def _checked(problem: ContactProblem) -> FrictionLaw:
    """Friction law of a ``problem`` that can roll."""
    if isinstance(problem.boundary, Periodic):
        raise InputError("boundary of a rolling contact must be Free() or FreeLine(), but is Periodic().")
    if problem.friction is None:
        raise InputError("friction of a rolling contact must be given, but is None. Write friction=Coulomb(0.3).")
    if problem.film is not None:
        raise InputError("film of a rolling contact must be None: menisci of moving surfaces are not steady.")
    return problem.friction


class _Rolling:
    """Tractions of one pressure under a creepage, moved until they rest."""

    def __init__(
        self,
        operator: TangentialOperator,
        friction: FrictionLaw,
        pressure: RealArray,
        creepage: Creepage,
        tolerance: float,
    ) -> None:
        grid = operator.grid
        self.operator, self.tolerance, self.pressure = operator, tolerance, np.asarray(pressure, dtype=float)
        self.bound, self.drawn = friction.bound(self.pressure), operator.drawn(self.pressure)
        x, y = about_centre(grid)
        rigid = np.empty((2, *grid.shape))
        rigid[0], rigid[1] = creepage.x - creepage.spin * y, creepage.y + creepage.spin * x
        self.rigid = rigid * grid.spacing[0]
        along = np.flatnonzero(self.pressure.any(axis=1))
        self.length = int(along[-1] - along[0]) + 1 if along.size else 0
        self.steps, self.steadiness = 0, np.inf
        self.slip: RealArray = np.zeros_like(rigid)
        self.traction: RealArray = np.zeros_like(rigid)

    def rolled(self, start: RealArray | None) -> RealArray:
        """Steady traction (2, nx, ny) in Pa, from ``start`` or from none."""
        traction: RealArray = np.zeros((2, *self.operator.grid.shape)) if start is None else start
        for stride in _STRIDES:
            if stride > 1 and (start is not None or self.length < _FEWEST * stride):
                continue
            fine = stride == 1
            traction = self._at_rest(traction, stride, self.tolerance if fine else 10.0 * self.tolerance * stride)
        self.traction = traction
        return traction

    def _at_rest(self, traction: RealArray, stride: int, tolerance: float) -> RealArray:
        """Traction that moves by ``stride`` pixels change by less than ``tolerance``."""
        solver = StickSlipNewton(tolerance=0.01 * self.tolerance)
        least = -(-self.length // stride)
        for count in range(1, _MOST_LENGTHS * max(least, 1) + 1):
            u = self.operator.displacement(traction) + self.drawn
            moved = np.concatenate([u[:, stride:], np.repeat(u[:, -1:], stride, axis=1)], axis=1)
            target = stride * self.rigid + moved - self.drawn
            found = solver.solve(TangentialQP(self.operator, self.bound, target), traction if traction.any() else None)
            size = float(np.linalg.norm(found.traction))
            change = float(np.linalg.norm(found.traction - traction))
            self.steadiness = change / size if size else 0.0
            traction, self.steps = found.traction, self.steps + 1
            self.slip = found.slip / (stride * self.operator.grid.spacing[0])
            # material that has not rolled through yet may look at rest
            if self.steadiness <= tolerance and (count >= least or change == 0.0):
                break
        return traction

    def result(self, normal: ContactResult, creepage: Creepage, steps: int, status: Status) -> RollingContact:
        """What was found."""
        grid, slip, traction = self.operator.grid, self.slip, self.traction
        force_x, force_y, torque = resultant(grid, traction)
        return RollingContact(
            normal=normal,
            creepage=creepage,
            traction=traction,
            slip=slip,
            force_x=force_x,
            force_y=force_y,
            torque=torque,
            friction_limit=float(self.bound.sum()) * grid.pixel_area,
            power_density=np.einsum("kij,kij->ij", traction, slip),
            dissipated=force_x * creepage.x + force_y * creepage.y + torque * creepage.spin,
            steadiness=self.steadiness,
            steps=steps,
            status=status,
        )
