"""Steady rolling with friction: creepage, spin, and the forces that they cause (Kalker 1990).

The contact rolls over the bodies, which slide slowly against each other. In the frame of the
contact everything is steady, and the material moves through it from the leading edge backwards: a
move by one pixel is an implicit step of stick and slip from what was displaced one pixel ahead. The
direct method solves for the traction that such a move leaves as it is; the transient one moves
until the tractions rest, first by several pixels, and checks it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np

from ...contact.controls import Approach, Control
from ...contact.law import HardWall
from ...contact.operators import Operator, prepare_operator
from ...contact.problem import ContactProblem, Flat
from ...contact.result import ContactResult
from ...contact.solve import Keep, solve
from ...contact.solvers.active_set.solver import ActiveSet
from ...contact.state import InterfaceState
from ...contact.tangential import about_centre, resultant
from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import ConvergenceError, InputError, NoSolutionError
from ...core.quantity import given, measured
from ...core.status import Outcome, Status
from ..friction.law import FrictionLaw
from ..friction.operator import TangentialOperator
from ..friction.solver.newton import StickSlipNewton
from .solver import Direction, RollingQP, SteadyNewton

Method: TypeAlias = Literal["direct", "transient"]
"""How the steady state is found."""

Rolling: TypeAlias = Literal["x", "-x", "y", "-y"]
"""Direction along the grid in which the contact rolls."""

METHODS = ("direct", "transient")
DIRECTIONS = {"x": Direction(0, 1), "-x": Direction(0, -1), "y": Direction(1, 1), "-y": Direction(1, -1)}

_STRIDES = (8, 4, 2, 1)
"""Pixels by which the material moves in a step, one after the other; the last makes the result. A
contact of n pixels comes to rest in about n/8 + 3 · 4 steps instead of n."""

_FEWEST = 8
"""Strides along the contact at least: coarser ones are no start for the finer."""

_MOST_LENGTHS = 20
"""Contact lengths rolled over with one stride at most; three suffice without spin."""

NORMAL_TOLERANCE = 1e-10
"""Tolerance of the normal solves."""


@dataclass(frozen=True)
class Creepage:
    """Relative motion of rolling bodies, small against one: slip velocity of the counter body over
    the body, over the rolling speed.

    At the distance s along the rolling direction and t across it (to the left of it, from x
    towards y) from the centre of the grid it is (x - spin t, y + spin s) along and across, without
    elastic displacements.

    Parameters
    ----------
    x, y
        Creepage along the rolling direction, which is x unless ``roll`` is told otherwise, and
        across it.
    spin
        Relative rotation about the normal over the rolling speed, rad/m.

    Raises
    ------
    InputError
        If a number is not finite.
    """

    x: float = measured("1", "creepage along the rolling direction", default=0.0)
    y: float = measured("1", "creepage across the rolling direction", default=0.0)
    spin: float = measured("rad/m", "spin", default=0.0)

    def __post_init__(self) -> None:
        require.finite(self.x, "creepage along the rolling direction")
        require.finite(self.y, "creepage across the rolling direction")
        require.finite(self.spin, "spin (rad/m)")

    def along_axes(self, direction: Direction) -> tuple[float, float]:
        """Components along the axes x and y of the grid, where the contact rolls in this
        ``direction``."""
        if direction.axis == 0:
            return direction.sign * self.x, direction.sign * self.y
        return -direction.sign * self.y, direction.sign * self.x


@dataclass(frozen=True, eq=False)
class RollingContact:
    """Steady rolling contact. Fields are (nx, ny) arrays or (2, nx, ny) arrays of x and y
    components, all values SI.

    Attributes
    ----------
    normal
        The contact under load; its displacement and approach hold what the shear of unlike bodies
        lifts.
    creepage
        What was prescribed.
    traction
        Shear traction on the body, Pa.
    slip
        Slip velocity of the counter body over the body, over the rolling speed; zero where it
        sticks.
    force_x, force_y, torque
        Force along x and y (N) and torque about the centre of the grid (N·m) on the body. Kalker's
        forces on the other body have the opposite sign.
    friction_limit
        Largest tangential force that the contact bears, N.
    power_density
        Energy turned into heat per distance rolled, (nx, ny) in J/m³; its integral is below
        ``dissipated`` by an error of first order in the pixel.
    dissipated
        Heat per distance rolled, J/m: the power of the forces along creepage and spin, since the
        elastic energy does not change.
    steadiness
        Error of the friction law between traction and slip, or of the transient method the relative
        change of the traction by the last move of one pixel.
    steps
        Steps taken: Newton steps of the direct method, moves of the transient one.
    status
        How it ended.
    law
        Friction law.
    direction
        That in which the contact rolls: ``"x"``, ``"-x"``, ``"y"`` or ``"-y"``.
    """

    normal: ContactResult = given()
    creepage: Creepage = measured("", "what was prescribed")
    traction: RealArray = measured("Pa", "shear traction on the body", "component", "x", "y")
    slip: RealArray = measured(
        "1", "slip velocity of the counter body over the body / rolling speed", "component", "x", "y"
    )
    force_x: float = measured("N", "force on the body along x")
    force_y: float = measured("N", "force on the body along y")
    torque: float = measured("N*m", "torque on the body about the centre")
    friction_limit: float = measured("N", "largest tangential force that the contact bears")
    power_density: RealArray = measured("J/m**3", "energy turned into heat per area and distance rolled", "x", "y")
    dissipated: float = measured("J/m", "heat per distance rolled")
    steadiness: float = measured("1", "error of the friction law, or change by the last move")
    steps: int = measured("1", "Newton steps or moves")
    status: Status = measured("", "how it ended")
    law: FrictionLaw = measured("", "friction law, as JSON")
    direction: Rolling = measured("", "direction of rolling", default="x")

    def require_sound(self) -> None:
        """Refuse what is no rolling contact on the grid of the contact beside, with a
        ValueError."""
        shape = self.normal.problem.grid.shape
        fields = (*self.traction, *self.slip, self.power_density)
        if len(self.traction) != 2 or any(item.shape != shape or item.dtype.kind != "f" for item in fields):
            raise ValueError("fields of the rolling contact are not those of its grid")
        if self.direction not in DIRECTIONS:
            raise ValueError(f"direction: {self.direction!r}")

    @property
    def slipping(self) -> BoolArray:
        """(nx, ny), True where the surfaces slip."""
        return np.asarray(np.any(self.slip != 0.0, axis=0))

    @property
    def slip_area_fraction(self) -> float:
        """Area that slips over area in contact (pixels); NaN without contact."""
        touching = self.normal.contact
        return (
            float(np.count_nonzero(self.slipping & touching)) / np.count_nonzero(touching) if touching.any() else np.nan
        )

    @property
    def longitudinal_force(self) -> float:
        """Force on the body along the rolling direction, N."""
        axis = DIRECTIONS[self.direction]
        return axis.sign * (self.force_x if axis.axis == 0 else self.force_y)

    @property
    def lateral_force(self) -> float:
        """Force on the body across the rolling direction, to the left of it, N."""
        axis = DIRECTIONS[self.direction]
        return axis.sign * (self.force_y if axis.axis == 0 else -self.force_x)

    @property
    def converged(self) -> bool:
        """Whether traction and pressure came to rest."""
        return self.status.converged

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of the method and of the contact."""
        return tuple(sorted({*SteadyNewton.citation_keys, *self.normal.citation_keys}))


def roll(
    problem: ContactProblem,
    control: Control,
    creepage: Creepage,
    *,
    direction: Rolling = "x",
    method: Method = "direct",
    tolerance: float = 1e-4,
    rounds: int = 20,
    start: RollingContact | None = None,
) -> RollingContact:
    """Steady rolling of the bodies of ``problem`` under ``control``, with its friction and a
    ``creepage``.

    The surface is that of the contact, which stands while the material moves: smooth wheels,
    rollers and balls, on bodies of any layers. See ``roll_rough`` for roughness that moves with the
    material.

    Parameters
    ----------
    problem
        A contact with a friction law, without film, adhesion and hardness. Where it repeats along
        the rolling direction, its surfaces must part somewhere in each row.
    control
        ``Force``, ``MeanPressure``, ``Approach`` or ``MeanGap``.
    creepage
        Creepages and spin.
    direction
        ``"x"``, ``"-x"``, ``"y"`` or ``"-y"``: where the contact rolls to.
    method
        ``"direct"``, or ``"transient"``: moves of the material until the tractions rest, at ten
        times the work or more.
    tolerance
        Of the transient method the largest relative change of the traction from move to move, which
        leaves it off the steady state by some hundred times that; of the direct one a hundred times
        the largest error of the friction law. Of unlike bodies also the largest relative change of
        the displacement by shear from round to round.
    rounds
        Rounds between normal contact and shear at most, for unlike bodies.
    start
        Rolling of the same grid and bodies under a creepage near by, as first guess.

    Raises
    ------
    InputError
        If the problem has no friction, a film, adhesion, a hardness or a layer that slips, or
        touches all along a row.
    NoSolutionError
        If shear parts unlike bodies at a prescribed approach.
    ConvergenceError
        If traction or pressure do not come to rest.
    """
    friction = require_rolling(problem, creepage, direction)
    require.one_of(method, METHODS, "method of rolling")
    require.positive(tolerance, "tolerance of rolling")
    require.integer(rounds, 1, "number of rounds")
    bodies = RollingBodies.of(problem, creepage, direction)
    if start is not None and start.traction.shape[1:] != problem.grid.shape:
        raise InputError(
            f"start of rolling must have the shape {problem.grid.shape} of the grid, but has "
            f"{start.traction.shape[1:]}."
        )
    found = _balanced(bodies, friction, control, (method, tolerance, rounds), start)
    shear, qp, grid = found.found, found.qp, found.qp.operator.grid
    moves = "moves" if method == "transient" else "Newton steps"
    status = Status(Outcome.CONVERGED, f"Steady to {shear.steadiness:.1e} after {found.steps} {moves}.")
    if not found.settled:
        message = (
            f"Rolling did not come to rest: traction is off by {shear.steadiness:.1e}, displacement by "
            f"shear by {found.change:.1e}."
        )
        status = Status(Outcome.STAGNATED, message, "Use a finer grid or a larger tolerance.")
    moved = slip_of(qp, shear.traction, shear.slip, found.normal.pressure, qp.displacement(shear.traction))
    slip = moved / grid.spacing[qp.direction.axis]
    force_x, force_y, torque = resultant(grid, shear.traction)
    along_x, along_y = creepage.along_axes(qp.direction)
    result = RollingContact(
        normal=found.normal,
        creepage=creepage,
        traction=shear.traction,
        slip=slip,
        force_x=force_x,
        force_y=force_y,
        torque=torque,
        friction_limit=float(qp.bound.sum()) * grid.pixel_area,
        power_density=np.einsum("kij,kij->ij", shear.traction, slip),
        dissipated=force_x * along_x + force_y * along_y + torque * creepage.spin,
        steadiness=shear.steadiness,
        steps=found.steps,
        status=status,
        law=friction,
        direction=direction,
    )
    if not result.converged:
        raise ConvergenceError(f"{result.status.message} {result.status.remedy}", result)
    return result


@dataclass(frozen=True, eq=False)
class _Balance:
    """Contact and shear after the last round: what was posed and found, Newton steps or moves in
    all, last change of the displacement by shear."""

    normal: ContactResult
    qp: RollingQP
    found: _Found
    steps: int
    change: float
    settled: bool


def _balanced(
    bodies: RollingBodies,
    friction: FrictionLaw,
    control: Control,
    asked: tuple[Method, float, int],
    start: RollingContact | None,
) -> _Balance:
    """Normal contact and shear in turns, as long as the displacement by shear changes; ``asked``
    are method, tolerance and rounds."""
    method, tolerance, rounds = asked
    coupled, profile = bodies.shear.coupled, bodies.profile
    lift: RealArray = np.zeros_like(profile)
    normal, traction = (None, None) if start is None else (start.normal, start.traction)
    if traction is not None:
        lift = bodies.shear.lift(traction)
    total, change = 0, np.inf
    for _ in range(rounds if coupled else 1):
        normal = bodies.pressed(profile, lift, control, None if normal is None else normal.state)
        qp = bodies.posed(friction.bound(normal.pressure), normal.pressure)
        if method == "direct":
            steady = SteadyNewton(tolerance=min(0.01 * tolerance, 0.1)).solve(qp, traction)
            error, settled = steady.deviation.error, steady.status.converged
            found = _Found(steady.traction, steady.slip, error, steady.iterations, settled)
        else:
            found = _transient(qp, traction, tolerance)
        traction, total = found.traction, total + found.steps
        before, lift = lift, bodies.shear.lift(traction)
        size = float(np.linalg.norm(lift))
        change = float(np.linalg.norm(lift - before)) / size if size else 0.0
        if change <= tolerance:
            break
    assert normal is not None
    return _Balance(normal, qp, found, total, change, found.settled and (change <= tolerance or not coupled))


def require_rolling(problem: ContactProblem, creepage: Creepage, direction: Rolling) -> FrictionLaw:
    """Friction law of a ``problem`` that can roll in this ``direction``; InputError for one that
    cannot."""
    require.one_of(direction, DIRECTIONS, "direction of rolling")
    if problem.friction is None:
        raise InputError("friction of a rolling contact must be given, but is None. Write friction=Coulomb(0.3).")
    for physics in problem.physics:
        if physics.moving:
            name = physics.keyword or "physics"
            raise InputError(f"{name} of a rolling contact must be None, but is {physics.given!r}: {physics.moving}.")
    if not isinstance(problem.law, HardWall):
        raise InputError(
            f"law of a rolling contact must be HardWall(), but is {problem.law!r}: what is dented does not "
            "stay in the contact."
        )
    if problem.grid.shape[DIRECTIONS[direction].axis] < 2:
        raise InputError(f"direction of rolling must lead across the line contact, but is {direction}. Choose x or -x.")
    if creepage.spin and any(problem.boundary.wraps):
        raise InputError(
            f"spin must be zero for the boundary {problem.boundary.name}, where the contact repeats, but is "
            f"{creepage.spin:g}. Choose Free()."
        )
    return problem.friction


@dataclass(frozen=True, eq=False)
class RollingBodies:
    """Bodies of a ``problem`` that rolls in a direction under a creepage: prepared operators, the
    ``rigid`` slip (2, nx, ny) in m of a move by one pixel, and the ``profile`` (nx, ny) in m."""

    problem: ContactProblem
    operator: Operator
    shear: TangentialOperator
    rigid: RealArray
    direction: Direction
    profile: RealArray

    @classmethod
    def of(cls, problem: ContactProblem, creepage: Creepage, direction: Rolling) -> RollingBodies:
        """Prepared for ``problem``."""
        grid, axis = problem.grid, DIRECTIONS[direction]
        x, y = about_centre(grid)
        along_x, along_y = creepage.along_axes(axis)
        rigid = np.empty((2, *grid.shape))
        rigid[0], rigid[1] = along_x - creepage.spin * y, along_y + creepage.spin * x
        return cls(
            replace(problem.with_physics(friction=None), counter_surface=Flat()),
            prepare_operator(problem.compliance, grid, problem.boundary),
            TangentialOperator(grid, (problem.body, problem.counter_body), problem.boundary),
            rigid * grid.spacing[axis.axis],
            axis,
            problem.profile(),
        )

    def pressed(
        self, heights: RealArray, lift: RealArray, control: Control, before: InterfaceState | None
    ) -> ContactResult:
        """The contact of a surface of these ``heights`` (nx, ny) in m that shear displaces by
        ``lift`` (nx, ny) in m, started from the state ``before``.

        Approach and displacement are those of the surface without shear: gap = offset +
        displacement - heights; an approach is counted from first touch without shear.

        NoSolutionError if shear parts the surfaces at a prescribed approach.
        """
        solver, keep = ActiveSet(tolerance=NORMAL_TOLERANCE), Keep(stiffness=False)
        lowered, counted = float((heights - lift).max()) - float(heights.max()), control
        if isinstance(control, Approach):
            left = control.value + lowered
            if left <= 0.0:
                raise NoSolutionError(
                    f"approach of a rolling contact must be more than {-lowered:.3g} m, by which shear lowers "
                    f"the surface, but is {control.value:.3g} m: the surfaces part. Prescribe a Force, a "
                    "larger approach, or less friction.",
                    subject="approach",
                )
            counted = Approach(left)
        lifted = self._of(heights - lift)
        found = solve(lifted, counted, keep=keep, solver=solver, operator=self.operator, state=before)
        if not lift.any():
            return found
        work = 0.5 * float(np.multiply(found.pressure, lift, dtype=np.float64).sum()) * self.problem.grid.pixel_area
        return replace(
            found,
            problem=self._of(heights),
            control=control,
            displacement=found.displacement + lift,
            approach=found.approach - lowered,
            elastic_energy=found.elastic_energy + work,
        )

    def _of(self, heights: RealArray) -> ContactProblem:
        """The normal contact of a surface of these ``heights`` (nx, ny) in m."""
        return replace(self.problem, surface=self.problem.surface.with_heights(heights, "composite"))

    def posed(self, bound: RealArray, pressure: RealArray) -> RollingQP:
        """Steady rolling with the ``bound`` under ``pressure``, both (nx, ny) in Pa."""
        if self.problem.boundary.wraps[self.direction.axis] and (bound > 0.0).all(axis=self.direction.axis).any():
            raise InputError(
                "surfaces of a rolling contact that repeats must part somewhere in each row along the rolling "
                "direction, but touch all along one. Reduce the load or choose a longer period."
            )
        return RollingQP(self.shear, bound, self.rigid, self.shear.drawn(pressure), self.direction)


@dataclass(frozen=True, eq=False)
class _Found:
    """Steady traction (Pa) and slip during a move by one pixel (m), both (2, nx, ny), and how
    steady."""

    traction: RealArray
    slip: RealArray
    steadiness: float
    steps: int
    settled: bool


def _transient(qp: RollingQP, start: RealArray | None, tolerance: float) -> _Found:
    """Steady traction by moves from ``start`` or from none, first of several pixels."""
    touched = np.flatnonzero(qp.direction.oriented(qp.bound).any(axis=1))
    length = int(touched[-1] - touched[0]) + 1 if touched.size else 0
    solver, steps = StickSlipNewton(tolerance=min(0.01 * tolerance, 0.1)), 0
    traction: RealArray = np.zeros_like(qp.rigid) if start is None else start
    for stride in _STRIDES:
        if stride > 1 and (start is not None or length < _FEWEST * stride):
            continue
        allowed, least = (1.0 if stride == 1 else 10.0 * stride) * tolerance, -(-length // stride)
        for count in range(1, _MOST_LENGTHS * max(least, 1) + 1):
            found = solver.solve(qp.moved(qp.displacement(traction), stride), traction if traction.any() else None)
            size = float(np.linalg.norm(found.traction))
            change = float(np.linalg.norm(found.traction - traction))
            steadiness = change / size if size else 0.0
            traction, slip = found.traction, found.slip / stride
            # material that has not rolled through yet may look at rest
            if steadiness <= allowed and (count >= least or change == 0.0):
                break
        steps += count
    return _Found(traction, slip, steadiness, steps, steadiness <= allowed)


def slip_of(qp: RollingQP, traction: RealArray, slip: RealArray, pressure: RealArray, before: RealArray) -> RealArray:
    """``slip`` (2, nx, ny) in m of a move by one pixel, also of the points that touch under
    ``pressure`` (Pa) and bear no shear.

    ``before`` (2, nx, ny) in m is the displacement along the surface before the move.
    """
    bare = (pressure > 0.0) & (qp.bound == 0.0)
    if not bare.any():
        return slip
    return np.where(bare, qp.moved(before).target - qp.operator.displacement(traction), slip)
