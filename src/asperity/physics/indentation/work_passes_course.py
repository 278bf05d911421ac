"""Repeated passes of a cylinder or sphere over a body that flows, by finite elements: the course
and the runs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...contact.problem import ContactProblem
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.status import NoProgress, Progress
from ...core.units import percent, show
from ...fem.bricks import track_lines
from ...fem.elements import GAUSS
from ...fem.mesh import Resolution
from ...fem.pass_fields import interface_tractions
from ...fem.pass_histories import hertz_steps, sliding_steps
from ...fem.passes import PassState, Track, cylinder_track, sphere_track
from ...solids.elastic import Elastic
from ...solids.layers import Layered, materials_of
from ...solids.plasticity import J2, WEIGHTS, von_mises
from ...theories.single.hertz import HertzLine, HertzPoint
from ..plastic_flow.work_values import (
    PlasticValues,
    interfaces_of,
    meshed_laws,
    summit_radius,
)
from .part_passes import EACH, PREFIX, PassesSettings

if TYPE_CHECKING:
    from ...contact.problem import ContactProblem

REACH = 2.0
"""How far the cut reaches beyond the track, and half as far as it reaches into the body, in contact
radii."""

FRAMES = 60
"""Pictures of a history at most."""

MOST_ELEMENTS = {True: 25_000, False: 60_000}
"""Bricks under a sphere and rectangles under a cylinder: some gigabytes, and a minute for each
step."""

LONGEST = 400.0
"""Length of a track in contact radii at most."""


@dataclass(frozen=True)
class Course:
    """What passes over the body; lengths in m.

    Attributes
    ----------
    sphere
        Whether it is a sphere, else a cylinder.
    radius, load
        Of the indenter, and in N or N/m.
    half_width, peak
        Half-width or radius in m and largest pressure in Pa of Hertz's contact with the base.
    friction, length
        Coefficient, and length of the track; 0 in place.
    count, steps, elements
        Passes, steps of each, elements across the contact radius.
    to_and_fro, given
        Whether every second pass goes back, and whether the pressure of Hertz is given.
    """

    sphere: bool
    radius: float
    load: float
    half_width: float
    peak: float
    friction: float
    length: float
    count: int
    steps: int
    elements: int
    to_and_fro: bool
    given: bool

    @property
    def ramp(self) -> int:
        """Steps in which the load is put on or taken off."""
        return max(4, self.steps // 2) if not self.length else 4

    @property
    def resolution(self) -> Resolution:
        """Of the mesh."""
        n = self.elements
        if self.sphere:
            return Resolution(across=n, per_layer=max(3, n // 2), growth=1.6, depth=1.0, distance=12.0)
        return Resolution(across=n, per_layer=max(4, n // 2), growth=1.3, depth=1.2, distance=100.0)

    def ends(self, number: int = 0) -> tuple[float, float]:
        """Of the pass of this ``number``."""
        ends = (-0.5 * self.length, 0.5 * self.length)
        return ends[::-1] if self.to_and_fro and number % 2 else ends

    def heights(self, places: RealArray) -> RealArray:
        """Of the paraboloid in m at positions (points, 1 or 2) from its lowest point."""
        found: RealArray = (places**2).sum(axis=1) / (2.0 * self.radius)
        return found

    def mesh(self, body: Elastic | Layered, laws: list[J2 | None], width: float, *, short: bool = False) -> Track:
        """Track for contacts of at most this ``width`` (half of it, or the radius) in m; a
        ``short`` one for pressing in the middle alone."""
        ends = (0.0, 0.0) if short else self.ends()
        made = sphere_track if self.sphere else cylinder_track
        _require_size(self, body, width, ends)
        return made(body, width, ends, plasticity=laws, resolution=self.resolution)

    def states(self, track: Track, start: PassState, number: int) -> Iterator[PassState]:
        """Those at the ends of the steps of the pass of this ``number``."""
        ends = self.ends(number)
        options: Any = {"steps": self.steps, "ramp": self.ramp}
        options["friction"] = math.copysign(self.friction, ends[1] - ends[0])
        if self.given:
            return hertz_steps(track, start, self.peak, self.half_width, ends, **options)
        force = 0.5 * self.load if self.sphere else self.load
        return sliding_steps(track, start, self.heights, force, ends, **options)


def course_of(table: PassesSettings, body: Elastic | Layered, problem: ContactProblem, friction: float) -> Course:
    """What ``table`` asks for, with the coefficient of ``friction``, and the radius of the summits
    of the ``problem`` where none is given.

    Raises
    ------
    InputError
        If there are no summits.
    """
    sphere = table.indenter == "sphere"
    radius = table.radius
    if radius is None:
        radius = summit_radius(problem, "Give {passes.radius=10 um}.")
    radius = float(radius)
    base = body if isinstance(body, Elastic) else body.reduced.base
    if not isinstance(base, Elastic):  # the outermost layer on a rigid base
        base = materials_of(body)[0]
    theory = (HertzPoint if sphere else HertzLine)(base.plane_strain_modulus, radius)
    load = table.force if sphere else table.line_load
    answer = theory.at_load(float(load)) if load is not None else theory.at_peak(float(table.peak_pressure or 0.0))
    width = float(answer.radius)
    length = 0.0
    if table.motion != "in place":
        length = float(table.track) if table.track is not None else (2.0 if sphere else 4.0) * width
    return Course(
        sphere,
        radius,
        float(answer.load),
        width,
        float(answer.max_pressure),
        friction,
        length,
        int(table.count or 1),
        table.steps,
        table.elements or (4 if sphere else 8),
        table.motion == "to and fro",
        table.pressure == "hertz",
    )


def require_course(course: Course, body: Elastic | Layered) -> Course:
    """``course`` over ``body`` if strains are small, a contact of at most 0.4 of the radius, and
    track and mesh are not too large.

    Raises
    ------
    InputError
        If they are, or an interface slips.
    """
    share = course.half_width / course.radius
    if share > 0.4:
        raise InputError(
            "load of the passes must give a contact of at most 0.4 of the radius of the indenter by Hertz's "
            f"theory, but gives {share:.2g}. Take a smaller load or a larger radius.",
            subject="load of the passes",
        )
    if course.length > LONGEST * course.half_width:
        raise InputError(
            f"track of the passes must be at most {LONGEST:g} contact radii long, but is "
            f"{course.length / course.half_width:.3g}. Take a shorter one ({{passes.track}}).",
            subject="track of the passes",
        )
    _require_size(course, body, course.half_width, course.ends())
    return course


def _require_size(course: Course, body: Elastic | Layered, width: float, ends: tuple[float, float]) -> None:
    layered = body if isinstance(body, Layered) else Layered([], body)
    x, y, z, _ = track_lines(layered, width, course.resolution, ends)
    count = (len(x) - 1) * (len(z) - 1) * ((len(y) - 1) if course.sphere else 1)
    most = MOST_ELEMENTS[course.sphere]
    if count > most:
        raise InputError(
            f"mesh of the passes must have at most {most} elements, but has {count}. Take fewer elements "
            f"({{passes.elements}}), a shorter track ({{passes.track}}) or no films far thinner than the "
            "contact.",
            subject="mesh of the passes",
        )


# The passes.


@dataclass(frozen=True, eq=False)
class Passed:
    """What came out.

    Attributes
    ----------
    shown
        Cut at the end with the residual stress, stress under the load in the middle of the last
        pass, groove.
    each
        (passes,) columns of ``EACH`` by name.
    profile
        Depths (m) and residual stresses along and across the track (Pa) below its middle.
    tensions
        Largest tension along the surface and at the bottoms of layers, largest shear and peel of
        interfaces in Pa, under load and after it.
    strains, labels
        (frames, columns, rows) accumulated plastic strain on the cut, and what each frame shows.
    numbers
        Peak pressure, contact radius, plastic work of the last pass, largest strains by region.
    touching
        Elements across the contact in the middle of the last pass.
    at_edge
        Whether the contact reached points beyond which nothing may touch.
    """

    shown: PlasticValues
    each: dict[str, RealArray]
    profile: tuple[RealArray, RealArray, RealArray]
    tensions: dict[str, float]
    strains: RealArray
    labels: tuple[str, ...]
    numbers: dict[str, Any]
    touching: int
    at_edge: bool


def passed(
    body: Elastic | Layered, course: Course, *, unknown_is_elastic: bool = False, progress: Progress = NoProgress()
) -> Passed:
    """All passes of ``course`` over ``body``, one after the other.

    Raises
    ------
    InputError
        If an interface slips, a yield stress is not known, or the mesh is too large.
    ConvergenceError
        If a step is not found.
    """
    laws = meshed_laws(body, unknown_is_elastic=unknown_is_elastic)
    width = course.half_width
    if not course.given:
        # the mesh is made for the half-width or radius of the contact when it is pressed in the
        # middle for the first time
        width, force = 1.15 * course.half_width, (0.5 if course.sphere else 1.0) * course.load
        for _ in range(5):
            track = course.mesh(body, laws, width, short=True)
            state = track.virgin()
            for share in (0.25, 0.5, 0.75, 1.0):
                state = track.press(state, course.heights, place=0.0, force=share * force)
            reached = _contact_radius(track, state)
            if reached > 1.1 * width:
                width *= 1.6
            elif reached < 0.65 * width:
                width = 1.15 * max(reached, 0.1 * width)
            else:
                break
    track = course.mesh(body, laws, width)
    cut, record = _Cut.of(track, course, body), _Record(track, course)
    for number in range(course.count):
        record.follow(number, cut)
        progress.update(number + 1, 0.1 ** ((number + 1) / course.count), 0.1)
    return record.found(cut)


def _contact_radius(track: Track, state: PassState) -> float:
    """Half-width in m of what touches, or radius of the circle of its area."""
    area = float(track.areas[state.normal > 0.0].sum())
    return math.sqrt(2.0 * area / math.pi) if track.dimension == 3 else 0.5 * area


_FACES = (slice(0, None, 2), slice(1, None, 2))
"""Gauss points of a brick near its upper and its lower face."""


@dataclass(frozen=True, eq=False)
class _Cut:
    """Elements beside y = 0 between lines x and z, as far as the cut reaches."""

    x: RealArray
    z: RealArray
    inside: tuple[slice, slice]
    shape: tuple[int, ...]
    interfaces: RealArray
    course: Course

    @classmethod
    def of(cls, track: Track, course: Course, body: Elastic | Layered) -> _Cut:
        lines = [np.unique(track.mesh.points[:, axis]) for axis in range(track.dimension)]
        x, z = lines[0], lines[-1]
        reach = 0.5 * course.length + REACH * course.half_width
        left, right = np.searchsorted(x, [-reach, reach])
        deep = max(int(np.searchsorted(z, 2.0 * REACH * course.half_width)), 3)
        shape = tuple(len(line) - 1 for line in lines)
        inside = (slice(int(left), int(right)), slice(0, deep))
        return cls(x[left : right + 1], z[: deep + 1], inside, shape, interfaces_of(body), course)

    def cells(self, values: RealArray) -> RealArray:
        """Means over elements (columns, rows) of ``values`` (elements, points)."""
        means = values.mean(axis=1).reshape(self.shape)
        found: RealArray = (means if means.ndim == 2 else means[:, 0])[self.inside]
        return found

    def tensions(self, track: Track, state: PassState, prefix: str) -> dict[str, float]:
        """Largest tension along the surface and at the bottoms of layers, shear and peel of
        interfaces in Pa; after the passes those near the middle of the track."""
        stress = track.response(state).stress[..., 0]
        upper, lower = (
            self.cells(stress[:, points]) for points in (([0, 1], [2, 3]) if track.dimension == 2 else _FACES)
        )
        beyond = (1.0 - GAUSS) / (2.0 * GAUSS)  # from the Gauss points to the faces
        top, bottom = (near + beyond * (near - far) for near, far in ((upper, lower), (lower, upper)))
        middle = 0.5 * (self.x[1:] + self.x[:-1])
        reach = self.course.length * (0.25 if prefix else 0.5) + self.course.half_width
        near = np.abs(middle) <= reach
        found = {f"{prefix}surface_tension": float(top[near, 0].max())}
        inside = [depth for depth in self.interfaces if depth <= self.z[-1] * (1.0 + 1e-9)]
        rows = [int(np.argmin(np.abs(self.z - depth))) for depth in inside]
        if rows:
            found[f"{prefix}layer_tension"] = float(max(bottom[near, row - 1].max() for row in rows))
            shear, peel = 0.0, 0.0
            for number in range(len(rows)):
                passing = interface_tractions(track, state, number)
                close = np.abs(passing.places[:, 0]) <= reach
                shear = max(shear, float(np.hypot(*passing.shear[close].T).max()))
                peel = max(peel, float(passing.peel[close].max()))
            found |= {f"{prefix}interface_shear": shear, f"{prefix}interface_peel": peel}
        return {name: max(value, 0.0) for name, value in found.items()}


class _Record:
    """State after the passes so far, and what was read off each."""

    def __init__(self, track: Track, course: Course) -> None:
        self.track, self.course, self.state = track, course, track.virgin()
        self.rows: dict[str, list[float]] = {item.name.removeprefix(f"{PREFIX}_"): [] for item in EACH}
        self.columns = [self._column(self.state)]
        self.work: list[float] = []
        self.strains: list[RealArray] = []
        self.labels: list[str] = []
        self.stride = -(-course.count * (course.steps * bool(course.length) + 2 * course.ramp) // FRAMES)
        self.loaded, self.at_edge, self.seen = self.state, False, 0
        places = track.places
        middle = np.hypot(*places.T) if track.dimension == 3 else np.abs(places[:, 0])
        self.middle = int(track.surface[int(np.argmin(middle))])
        # points beyond which no point may touch
        self.edge = (places == places.max(axis=0)).any(axis=1) | (places[:, 0] == places[:, 0].min())

    def follow(self, number: int, cut: _Cut) -> None:
        """One more pass."""
        course, start = self.course, self.state
        full = 0.999 * (0.5 if course.sphere else 1.0) * course.load
        nearest = math.inf
        for state in course.states(self.track, start, number):
            if float(state.normal.sum()) > full and abs(state.place) < nearest:
                nearest, self.loaded = abs(state.place), state
            self.at_edge |= not course.given and bool((state.normal[self.edge] > 0.0).any())
            self.seen += 1
            if (self.seen - 1) % self.stride == 0 or (number + 1 == course.count and not state.normal.any()):
                self.strains.append(cut.cells(state.plastic.accumulated))
                at = f", place {show(state.place, 'm', 3)}" if course.length else ""
                self.labels.append(f"pass {number + 1}{at}, load {percent(float(state.normal.sum()) * 0.999 / full)}")
            self.state = state
        before, lag = self.columns[-1], 2 if course.to_and_fro else 1
        self.columns.append(self._column(self.state))
        earlier = self.columns[max(len(self.columns) - 1 - lag, 0)]
        change = (self.columns[-1][1] - earlier[1]) / min(lag, len(self.columns) - 1)
        now, then = (at.displacement.reshape(-1, self.track.dimension)[self.middle] for at in (self.state, start))
        self.work.append(self.state.dissipated - start.dissipated)
        row = {
            "growth": float((self.columns[-1][0] - before[0]).max()),
            "onward": float(np.sqrt(2.0 / 3.0 * (change**2 @ WEIGHTS)).max()),
            "dissipation": self.work[-1] / self.work[0] if self.work[0] > 0.0 else 0.0,
            "forward": float(now[0] - then[0]),
            "groove": float(now[-1]),
        }
        for name, value in row.items():
            self.rows[name].append(value)

    def _column(self, state: PassState) -> tuple[RealArray, RealArray]:
        """Accumulated plastic strain (n,) and plastic strain (n, 6) below the middle of the
        track."""
        return self.track.column(state.plastic.accumulated)[1], self.track.column(state.plastic.plastic_strain)[1]

    def found(self, cut: _Cut) -> Passed:
        """Everything."""
        track, state, loaded = self.track, self.state, self.loaded
        stress = track.response(state).stress
        depth, column = track.column(stress)
        inside = depth < cut.z[-1]
        points = track.mesh.points
        line = np.flatnonzero((points[:, -1] == 0.0) & (points[:, 1:-1] == 0.0).all(axis=1))
        line = line[np.argsort(points[line, 0])]
        line = line[(points[line, 0] >= cut.x[0]) & (points[line, 0] <= cut.x[-1])]
        shown = PlasticValues(
            cut.x,
            cut.z,
            cut.cells(state.plastic.accumulated),
            cut.interfaces,
            cut.cells(stress[..., 0]),
            cut.cells(von_mises(track.response(loaded).stress)),
            place=points[line, 0],
            imprint=-state.displacement.reshape(-1, track.dimension)[line, -1],
        )
        share = 2.0 if self.course.sphere else 1.0
        numbers = {
            "peak": float((loaded.normal / track.areas).max()),
            "contact": _contact_radius(track, loaded),
            "work": share * self.work[-1],
            "strains": track.history([state]).flow[0],
            "resistance": self.work[-1] / (float(loaded.normal.sum()) * self.course.length)
            if self.course.length
            else math.nan,
        }
        row = track.places[:, 1] == 0.0 if track.dimension == 3 else np.ones(len(track.places), dtype=bool)
        return Passed(
            shown,
            {name: np.array(values) for name, values in self.rows.items()},
            (depth[inside], column[inside, 0], column[inside, 1]),
            cut.tensions(track, loaded, "") | cut.tensions(track, state, "residual_"),
            np.stack(self.strains),
            tuple(self.labels),
            numbers,
            int((loaded.normal[row] > 0.0).sum()),
            self.at_edge,
        )
