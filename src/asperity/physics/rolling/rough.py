"""Rolling of rough wheels: roughness that moves through the contact with the material, step by
step, and forces that fluctuate.

In the frame of the contact the shape of the wheel stands, and its roughness moves by a pixel at a
time from the leading edge backwards. Every move is a normal contact of its own and an implicit step
of stick and slip from the displacement one pixel ahead (Kalker 1990), as in steady rolling, but on
a pressure that changes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...contact.controls import Control
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.state import InterfaceState
from ...contact.tangential import resultant
from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import ConvergenceError, InputError
from ...core.quantity import Quantity
from ...core.status import NoProgress, Outcome, Progress, Status
from ...surfaces.surface import Surface
from ..friction.law import FrictionLaw
from ..friction.solver.newton import StickSlipNewton
from .rolling import DIRECTIONS, Creepage, Rolling, RollingBodies, RollingContact, require_rolling, slip_of

if TYPE_CHECKING:
    import xarray

RUNNING_IN = 3.0
"""Contact lengths rolled before means are taken; the force of a smooth roller is within 0.5 % of
the steady one after two."""

PATH = (
    Quantity("distance", "m", "distance rolled"),
    Quantity("force_x", "N", "force on the body along x"),
    Quantity("force_y", "N", "force on the body along y"),
    Quantity("torque", "N*m", "torque on the body about the centre"),
    Quantity("normal_force", "N", "normal force"),
    Quantity("friction_limit", "N", "largest tangential force that the contact bears"),
    Quantity("approach", "m", "approach"),
    Quantity("contact_area", "m^2", "area of the pixels in contact"),
    Quantity("slip_area_fraction", "1", "area that slips / area in contact (pixels)"),
    Quantity("dissipated", "J/m", "heat of slip per distance rolled"),
)
"""What a rough rolling contact keeps of every move."""


@dataclass(frozen=True, eq=False)
class RoughRolling:
    """Rolling of a rough wheel: arrays (n,) over the moves, SI.

    Attributes
    ----------
    distance, force_x, force_y, torque, normal_force, friction_limit, approach, contact_area,
    slip_area_fraction, dissipated
        After each move; forces are those on the body. The heat is that of traction and slip at the
        points.
    running_in
        Distance in m after which means are taken.
    last
        The contact after the last move; its slip, heat and status are those of that move.
    """

    distance: RealArray
    force_x: RealArray
    force_y: RealArray
    torque: RealArray
    normal_force: RealArray
    friction_limit: RealArray
    approach: RealArray
    contact_area: RealArray
    slip_area_fraction: RealArray
    dissipated: RealArray
    running_in: float
    last: RollingContact

    @property
    def settled(self) -> BoolArray:
        """(n,), True for moves after the running-in."""
        return np.asarray(self.distance > self.running_in)

    @property
    def traction_coefficient(self) -> RealArray:
        """(n,), force on the body along the rolling direction over the normal force."""
        axis = DIRECTIONS[self.last.direction]
        along = self.force_x if axis.axis == 0 else self.force_y
        return axis.sign * along / self.normal_force

    def mean(self, name: str) -> float:
        """Mean of the array ``name`` after the running-in; InputError if nothing was rolled after
        it."""
        return float(self._after(name).mean())

    def deviation(self, name: str) -> float:
        """Standard deviation of the array ``name`` over the distance after the running-in;
        InputError as of ``mean``."""
        return float(self._after(name).std())

    def _after(self, name: str) -> RealArray:
        require.one_of(name, [*(item.name for item in PATH), "traction_coefficient"], "name of a mean")
        if not self.settled.any():
            raise InputError(
                f"distance of rough rolling must be more than the running-in of {self.running_in:.3g} m for a "
                f"mean, but is {float(self.distance[-1]):.3g} m."
            )
        values: RealArray = np.asarray(getattr(self, name))[self.settled]
        return values

    @property
    def converged(self) -> bool:
        """Whether every move was solved: those that were not raise."""
        return self.last.converged

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of the method and of the contact."""
        return self.last.citation_keys

    def to_xarray(self) -> xarray.Dataset:
        """The arrays over ``distance``, with units and long names."""
        import xarray

        coordinate = {"distance": ("distance", self.distance, PATH[0].attributes)}
        values = {item.name: ("distance", getattr(self, item.name), item.attributes) for item in PATH[1:]}
        return xarray.Dataset(values, coordinate, {"running_in": self.running_in})


def roll_rough(
    problem: ContactProblem,
    control: Control,
    creepage: Creepage,
    roughness: Surface,
    *,
    distance: float | None = None,
    direction: Rolling = "x",
    tolerance: float = 1e-4,
    rounds: int = 20,
    start: RoughRolling | None = None,
    progress: Progress | None = None,
) -> RoughRolling:
    """Rolling of the wheel of ``problem`` with a ``roughness`` that moves through the contact, by
    moves of one pixel.

    Parameters
    ----------
    problem
        The smooth wheel, with a friction law, as for ``roll``; a long rough roller is ``Periodic``
        with open ends along the rolling direction.
    control
        ``Force``, ``MeanPressure``, ``Approach`` or ``MeanGap``, held all the way.
    creepage
        Creepages and spin.
    roughness
        Added to the shape of the wheel, heights towards the counter body: a surface of the same
        pixel, and of as many points across the rolling direction. It comes again after its length;
        take a periodic one, or ``periodised``, unless the distance is shorter.
    distance
        Distance rolled in m; by default the length of the roughness after the running-in of three
        contact lengths.
    direction, tolerance, rounds
        As for ``roll``; the error of every move is a hundredth of the tolerance.
    start
        Earlier rolling of the same to go on from; its distance is counted on.
    progress
        Receives the share of the distance that is left.

    Raises
    ------
    InputError
        If the problem cannot roll, or roughness or start do not fit its grid.
    ConvergenceError
        If a move is not solved.
    """
    friction = require_rolling(problem, creepage, direction)
    require.positive(tolerance, "tolerance of rolling")
    require.integer(rounds, 1, "number of rounds")
    grid, axis = problem.grid, DIRECTIONS[direction].axis
    heights = np.asarray(roughness.heights, dtype=float)
    if roughness.n_missing:
        raise InputError("roughness must have no missing points, but has some. Fill them first: filled(surface).")
    if not np.allclose(roughness.grid.spacing, grid.spacing, rtol=1e-6, atol=0.0):
        raise InputError(
            f"roughness must have the pixel {grid.spacing} m of the contact, but has {roughness.grid.spacing} "
            "m. Resample it first: resampled(surface, ...)."
        )
    if heights.shape[1 - axis] != grid.shape[1 - axis]:
        raise InputError(
            f"roughness must have {grid.shape[1 - axis]} points across the rolling direction as the contact, "
            f"but has {heights.shape[1 - axis]}."
        )
    bodies = RollingBodies.of(problem, creepage, direction)
    along = np.asarray(bodies.direction.oriented(heights))
    moves = _Moves(bodies, friction, control, along, (tolerance, rounds))
    if distance is not None:
        require.positive(distance, "distance of rough rolling (m)")
    return moves.rolled(distance, start, creepage, direction, progress or NoProgress())


class _Moves:
    """The contact after so many moves: pressure, traction, displacement by shear and pressure, and
    normal displacement by shear."""

    normal: ContactResult
    traction: RealArray
    displaced: RealArray
    lift: RealArray
    bound: RealArray
    error: float

    def __init__(
        self,
        bodies: RollingBodies,
        friction: FrictionLaw,
        control: Control,
        rough: RealArray,
        asked: tuple[float, int],
    ) -> None:
        """``rough``: heights (length, across) of the roughness, the first index along the rolling
        direction."""
        self.bodies, self.friction, self.control, self.rough, self.asked = bodies, friction, control, rough, asked
        self.pixel = float(bodies.problem.grid.spacing[bodies.direction.axis])

    def rolled(
        self,
        distance: float | None,
        start: RoughRolling | None,
        creepage: Creepage,
        direction: Rolling,
        progress: Progress,
    ) -> RoughRolling:
        """All moves."""
        first = 0 if start is None else round(float(start.distance[-1]) / self.pixel)
        running_in = self._begun(first, start)
        total = distance if distance is not None else running_in * (start is None) + len(self.rough) * self.pixel
        count = max(1, round(total / self.pixel))
        rows: list[tuple[float, ...]] = []  # columns are those of PATH
        grid = self.bodies.problem.grid
        for number in range(first + 1, first + count + 1):
            slip = self._move(number)
            touching = self.normal.pressure > 0.0
            contact = float(np.count_nonzero(touching))
            slips = float(np.count_nonzero(np.any(slip != 0.0, axis=0) & touching))
            row = (
                number * self.pixel,
                *resultant(grid, self.traction),
                float(self.normal.force),
                float(self.bound.sum()) * grid.pixel_area,
                float(self.normal.approach),
                contact * grid.pixel_area,
                slips / contact if contact else np.nan,
                float(np.einsum("kij,kij->", self.traction, slip)) * grid.pixel_area / self.pixel,
            )
            rows.append(row)
            progress.update(number - first, 1.0 - (number - first) / count, 0.0)
        values = {item.name: column for item, column in zip(PATH, np.array(rows).T, strict=True)}
        forces = ("force_x", "force_y", "torque", "friction_limit", "dissipated")
        last = RollingContact(
            normal=self.normal,
            creepage=creepage,
            traction=self.traction,
            slip=slip / self.pixel,
            power_density=np.einsum("kij,kij->ij", self.traction, slip / self.pixel),
            steadiness=self.error,
            steps=1,
            status=Status(Outcome.CONVERGED, f"Last move solved to {self.error:.1e}."),
            law=self.friction,
            direction=direction,
            **{name: float(values[name][-1]) for name in forces},
        )
        if start is not None:
            values = {name: np.concatenate([getattr(start, name), column]) for name, column in values.items()}
        return RoughRolling(**values, running_in=running_in, last=last)

    def _begun(self, first: int, start: RoughRolling | None) -> float:
        """Pressure and displacement before the first move, without shear or those of ``start``; the
        running-in (m)."""
        shape = self.bodies.profile.shape
        if start is not None:
            if start.last.traction.shape[1:] != shape:
                raise InputError(
                    f"start of rough rolling must have the shape {shape} of the grid, but has "
                    f"{start.last.traction.shape[1:]}."
                )
            self.normal, self.traction = start.last.normal, start.last.traction
        else:
            self.normal = self.bodies.pressed(self._heights(first), np.zeros(shape), self.control, None)
            self.traction = np.zeros((2, *shape))
        self.lift = self.bodies.shear.lift(self.traction)
        self.bound = self.friction.bound(self.normal.pressure)
        self.displaced = self.bodies.shear.displacement(self.traction) + self.bodies.shear.drawn(self.normal.pressure)
        if start is not None:
            return start.running_in
        touched = np.flatnonzero(self.bodies.direction.oriented(self.normal.pressure).any(axis=1))
        return RUNNING_IN * float(touched[-1] - touched[0] + 1) * self.pixel if touched.size else 0.0

    def _heights(self, moves: int) -> RealArray:
        """Shape of the wheel and roughness (nx, ny) in m after so many ``moves``."""
        heights = self.bodies.profile.copy()
        along = self.bodies.direction.oriented(heights)
        along += self.rough[(np.arange(len(along)) + moves) % len(self.rough)]
        return heights

    def _move(self, number: int) -> RealArray:
        """Move ``number``: its slip (2, nx, ny) in m."""
        tolerance, rounds = self.asked
        bodies, heights = self.bodies, self._heights(number)
        wraps = bodies.problem.boundary.wraps[bodies.direction.axis]
        guess: RealArray = bodies.direction.ahead(self.normal.pressure[None], wraps=wraps)[0]
        traction = bodies.direction.ahead(self.traction, wraps=wraps)
        normal, lift = self.normal, self.lift
        state: InterfaceState | None = InterfaceState(guess)
        solver = StickSlipNewton(tolerance=min(0.01 * tolerance, 0.1))
        for _ in range(rounds if bodies.shear.coupled else 1):
            normal = bodies.pressed(heights, lift, self.control, state)
            qp = bodies.posed(self.friction.bound(normal.pressure), normal.pressure)
            found = solver.solve(qp.moved(self.displaced), traction)
            traction, state = found.traction, normal.state
            before, lift = lift, bodies.shear.lift(traction)
            size = float(np.linalg.norm(lift))
            change = float(np.linalg.norm(lift - before)) / size if size else 0.0
            if change <= tolerance:
                break
        if not found.status.converged or (bodies.shear.coupled and change > tolerance):
            raise ConvergenceError(
                f"Move {number} of rough rolling is not solved: error {found.deviation.error:.1e}, "
                f"displacement by shear changes by {change:.1e}. Use a larger tolerance or more rounds.",
                normal,
            )
        self.normal, self.traction, self.lift, self.bound = normal, traction, lift, qp.bound
        slip = slip_of(qp, traction, found.slip, normal.pressure, self.displaced)
        self.displaced, self.error = qp.displacement(traction), found.deviation.error
        return slip
