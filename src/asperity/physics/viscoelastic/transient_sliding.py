"""Sliding and rolling over viscoelastic bodies in steps of time: from the first load to the steady
state, and rough bodies that roll.

The viscoelastic body and all it remembers stay where they are; the surface opposite moves over it,
and with it its contact. A body that slides carries its roughness along. In rolling what is rough on
either body passes through the contact with the material: it is at rest, and the shape alone moves.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field, replace

import numpy as np

from ...contact.boundary import Periodic
from ...contact.controls import Control, Unloaded
from ...contact.couplings.driver import Rounds
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import Keep, Prepared
from ...core import require
from ...core.arrays import ComplexArray, RealArray
from ...core.errors import ConvergenceError, InputError
from ...core.grid import Grid
from ...core.quantity import Quantity
from ...core.spectral import RealTransform
from ...core.status import NoProgress, Progress
from ...solids.layers import relaxes
from ...surfaces.surface import Surface
from .in_time import InTime
from .moments import Creeping, Moment

COLUMNS = (
    Quantity("time", "s", "time since the virgin state"),
    Quantity("distance", "m", "distance moved"),
    Quantity("mean_pressure", "Pa", "mean (nominal) pressure, from outside"),
    Quantity("force", "N", "force between the solids, less the attraction"),
    Quantity("approach", "m", "approach from first touch"),
    Quantity("area_fraction", "1", "real contact area / nominal area (edges between pixels)"),
    Quantity("max_pressure", "Pa", "maximum pressure"),
    Quantity("friction_force", "N", "force against the motion, by the slope of what moves"),
    Quantity("stored_energy", "J", "stored energy"),
    Quantity("dissipated", "J", "heat since the virgin state"),
)
"""What is recorded at the start and after every step of time."""

STEPS_PER_PIXEL = 2
"""Steps of time in which the surface moves by a pixel; 1 changes the friction of a sliding wave by
a part in a hundred more."""


@dataclass(frozen=True, eq=False)
class TransientSliding:
    """What happened while a surface moved over a viscoelastic body.

    Attributes
    ----------
    records
        (steps + 1, columns of ``COLUMNS``): at the start, and after each step of time.
    speed, direction
        Speed (m/s) and direction of what moves, angle in rad from +x towards +y.
    last
        The contact after the last step; its ``problem`` holds the surface where it then is.
    step
        Distance moved in a step of time, m.
    """

    records: RealArray
    speed: float
    direction: float
    last: ContactResult
    step: float
    moment: Moment = field(repr=False)

    def column(self, name: str) -> RealArray:
        """Values of the column ``name`` of ``COLUMNS``. InputError if there is none."""
        names = [item.name for item in COLUMNS]
        require.one_of(name, names, "column of a sliding contact in time")
        return np.asarray(self.records[:, names.index(name)])

    @property
    def distance(self) -> RealArray:
        """Distance (m) moved."""
        return self.column("distance")

    @property
    def friction(self) -> RealArray:
        """Coefficient of friction by the slope of what moves, over the force from outside; zero
        where none presses."""
        force = self._load
        return np.divide(self.column("friction_force"), force, out=np.zeros(force.shape), where=force > 0.0)

    @property
    def steps_done(self) -> int:
        """Steps of time since the motion began."""
        return round(float(self.distance[-1]) / self.step)

    def mean_friction(self, last: float) -> float:
        """Friction over the ``last`` distance (m) moved, mean force against the motion over the
        mean force from outside; NaN where that pulls."""
        part = self._part(last)
        return self._over(float(self.column("friction_force")[part].mean()), part)

    def mean_loss(self, last: float) -> float:
        """The same from the heat of the solids over the ``last`` distance (m): in a steady state
        the two are equal, but for what jumps of adhesive contacts and dents take."""
        part = self._part(last)
        heat, way = self.column("dissipated")[part], self.distance[part]
        return self._over(float((heat[-1] - heat[0]) / (way[-1] - way[0])), part)

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind the numbers."""
        return tuple(sorted({"Carbone2013", *self.last.citation_keys}))

    @property
    def _load(self) -> RealArray:
        """Force (N) from outside."""
        return self.column("mean_pressure") * self.last.problem.grid.area

    def _over(self, force: float, part: slice) -> float:
        """``force`` (N) over the mean load of a ``part`` of the way."""
        load = float(self._load[part].mean())
        return force / load if load > 0.0 else math.nan

    def _part(self, last: float) -> slice:
        require.positive(last, "distance (m) of a mean")
        number = min(max(round(last / self.step), 1), len(self.records) - 2)
        if number < 1:
            raise InputError("steps of a mean must be at least one, but the surface has not moved.")
        return slice(len(self.records) - 1 - number, None)


def slide_in_time(
    problem: ContactProblem,
    control: Control,
    speed: float,
    distance: float,
    *,
    direction: float = 0.0,
    steps_per_pixel: int = STEPS_PER_PIXEL,
    after: TransientSliding | None = None,
    rounds: Rounds = Rounds(),
    progress: Progress | None = None,
) -> TransientSliding:
    """Motion of a surface over a viscoelastic body in steps of time, from a first load at once to
    the steady state.

    Parameters
    ----------
    problem
        Contact without friction, one body of which relaxes; the surface of the other one moves.
        Adhesion of finite range, whose attraction pulls along the motion too, films, whose menisci
        act by their normal force, and a hardness, whose dents stay on the body that relaxes, stand
        beside it as under any load. A rough surface that slides:
        ``ContactProblem(rough, Rigid(), counter_body=rubber)``. A rough body that rolls: its shape
        alone as this surface, and the roughness of both bodies as that of the viscoelastic one.
    control
        ``MeanPressure``, ``Force``, ``Approach`` or ``MeanGap``, with adhesion also ``Pull`` and
        ``FixedGrips``, held throughout. At the start it is applied at once.
    speed
        Of the surface that moves, m/s, > 0.
    distance
        To move, m, > 0, rounded to whole steps of time. On a free grid the contact must stay on it,
        and what comes in at its edge is what was there.
    direction
        Of the motion, angle in rad from +x towards +y.
    steps_per_pixel
        Steps of time in which the surface moves by a pixel, the smaller of its sides.
    after
        An earlier part of the same motion, which goes on to the bit.
    rounds
        When to give up.
    progress
        Receives the share of the steps that are left.

    Raises
    ------
    InputError
        If nothing, or everything, relaxes, a number is out of range, or the problem holds friction
        or plastic flow.
    ConvergenceError
        If a step is not solved.
    """
    v = require.positive(speed, "sliding speed (m/s)")
    angle = require.finite(direction, "direction of sliding (rad)")
    step = step_length(problem.grid, steps_per_pixel)
    number = max(round(require.positive(distance, "distance to move (m)") / step), 1)
    motion = _Motion(problem, control, v, angle, step, rounds)
    if after is not None and (after.step != step or (after.speed, after.direction) != (v, angle)):
        raise InputError(
            f"earlier part of a motion must have the step {step:g} m, the speed {v:g} m/s and the direction "
            f"{angle:g} rad, but has {after.step:g} m, {after.speed:g} m/s and {after.direction:g} rad."
        )
    return motion.over(number, after, progress or NoProgress())


def step_length(grid: Grid, steps_per_pixel: int) -> float:
    """Distance (m) moved in a step of time."""
    require.integer(steps_per_pixel, 1, "steps of time per pixel")
    return min(grid.pixels) / steps_per_pixel


class _Motion:
    """A problem whose moving surface is put where it is at each step of time."""

    def __init__(
        self, problem: ContactProblem, control: Control, speed: float, direction: float, step: float, rounds: Rounds
    ) -> None:
        self.problem, self.control, self.speed, self.direction, self.step = problem, control, speed, direction, step
        if problem.friction is not None:
            raise InputError(
                "friction of sliding in time must be None: the friction found is that of hysteresis alone, "
                "and shear of the interface adds to it."
            )
        if problem.plastic_flow is not None:
            raise InputError(
                "plastic_flow of sliding in time must be None, since what flows would have to move with the surface."
            )
        if isinstance(control, Unloaded):
            raise InputError("control of sliding in time must be a load or position, but is Unloaded().")
        relaxing = [relaxes(body) for body in (problem.body, problem.counter_body)]
        if sum(relaxing) != 1:
            raise InputError(
                "bodies of sliding in time must be one that is viscoelastic and one that is not, but "
                f"{sum(relaxing)} of them relax. Write ContactProblem(rough, Rigid(), counter_body=rubber)."
            )
        name = "counter_surface" if relaxing[0] else "surface"
        if not isinstance(getattr(problem, name), Surface):
            raise InputError(
                f"{name} of sliding in time must be a Surface, for it moves over the viscoelastic body, but is Flat()."
            )
        self.name = name
        moving = getattr(problem, self.name)
        assert isinstance(moving, Surface)
        self.moving, self.heights = moving, np.asarray(moving.heights, dtype=float)
        self.prepared = Prepared(problem, rounds=rounds, keep=Keep(stiffness=False))
        assert isinstance(self.prepared.in_time, InTime)
        self.in_time = self.prepared.in_time
        self.at_rest = self.prepared.profile - self.heights

    def over(self, number: int, after: TransientSliding | None, progress: Progress) -> TransientSliding:
        """``number`` steps of time after the first load, or an earlier part."""
        started, records = time.perf_counter(), []
        if after is None:
            moment, done = self._advanced(self.in_time.begin(None), 0, 0.0), 0
            records.append(self._record(moment, 0))
        else:
            moment, done = after.moment, after.steps_done
            records.append(after.records[-1])
        before = moment
        for count in range(done + 1, done + number + 1):
            before, moment = moment, self._advanced(moment, count, self.step / self.speed)
            records.append(self._record(moment, count))
            progress.update(count - done, 1.0 - (count - done) / number, 0.0)
        seconds = time.perf_counter() - started
        # The contact of the last moment, with the surface where it is.
        settled = moment.settled
        assert settled is not None
        way = (done + number) * self.step
        moved = self.moving.with_heights(self.prepared.profile - self.at_rest, f"moved by {way:.6g} m")
        heat, force, approach = moment.past.dissipated - before.past.dissipated, moment.record[2], moment.record[3]
        work = 0.5 * (force + before.record[2]) * (approach - before.record[3])
        both = np.stack([before.record, moment.record])
        retarded = np.broadcast_to(moment.retarded, moment.past.pressure.shape)
        creeping = Creeping(both, retarded, moment.stored, heat, float(work), 1)
        ends = {**moment.ends, "creep": (moment.past.memory, creeping)}
        self.prepared.problem = replace(self.problem, **{self.name: moved})  # type: ignore[arg-type]
        last = self.prepared.result(settled, before.state, seconds, ends)
        self.prepared.problem = self.problem
        return TransientSliding(np.stack(records), self.speed, self.direction, last, self.step, moment)

    def _advanced(self, moment: Moment, count: int, length: float) -> Moment:
        """Contact a step of time later, with the surface ``count`` steps from where it was."""
        self.prepared.profile = self.at_rest + self._moved(count)
        found = self.in_time.advanced(moment, self.control, length)
        assert found.settled is not None
        status = found.settled.status
        if not status.converged:
            raise ConvergenceError(
                f"Step {count} of the motion: {status.message} {status.remedy}", subject=f"Step {count} of the motion"
            )
        return found

    def _moved(self, count: int) -> RealArray:
        """Heights (nx, ny) in m of what moves after ``count`` steps."""
        x, y = (
            part * count * self.step / d
            for part, d in zip(
                (math.cos(self.direction), math.sin(self.direction)), self.problem.grid.spacing, strict=True
            )
        )
        if isinstance(self.problem.boundary, Periodic):
            # in Fourier space; whole pixels are exact
            if x == round(x) and y == round(y):
                return np.roll(self.heights, (round(x), round(y)), (0, 1))
            nx, ny = self.heights.shape
            transform = RealTransform(self.heights.shape, 1)
            spectrum = transform.forward(self.heights, np.empty(transform.spectrum_shape, np.complex128))
            row = np.arange(nx)
            fx, fy = np.where(row <= nx // 2, row, row - nx) / nx, np.arange(ny // 2 + 1) / ny
            spectrum *= _phase(fx, x, nx)[:, None] * _phase(fy, y, ny)
            return transform.backward(spectrum, np.empty(self.heights.shape))
        from scipy.ndimage import shift

        return np.asarray(shift(self.heights, (x, 0.0 if self.heights.shape[1] == 1 else y), order=3, mode="nearest"))

    def _record(self, moment: Moment, count: int) -> RealArray:
        """``COLUMNS`` at a ``moment``; slopes along the motion are central differences, of fourth
        order where the heights are periodic."""
        heights, grid = self._moved(count), self.problem.grid
        slope = np.zeros(heights.shape)
        for axis, part in enumerate((math.cos(self.direction), math.sin(self.direction))):
            if heights.shape[axis] < 2 or part == 0.0:
                continue
            d = grid.spacing[axis]
            if isinstance(self.problem.boundary, Periodic):
                near = np.roll(heights, -1, axis) - np.roll(heights, 1, axis)
                far = np.roll(heights, -2, axis) - np.roll(heights, 2, axis)
                slope += part * ((8.0 * near - far) / (12.0 * d))
            else:
                slope += part * np.gradient(heights, d, axis=axis)
        force = -float((moment.past.pressure * slope).sum()) * grid.pixel_area
        at = moment.record
        numbers = (at[0], count * self.step, at[1], at[2], at[3], at[5], at[6], force, at[7], at[8])
        return np.array(numbers)


def _phase(frequency: RealArray, shift: float, number: int) -> ComplexArray:
    """Factors of waves of so many periods a pixel; the shortest one of an even grid stands for both
    directions."""
    found = np.exp(-2j * np.pi * frequency * shift)
    lone = np.abs(frequency) == 0.5
    return np.asarray(np.where(lone & (number % 2 == 0), found.real, found))
