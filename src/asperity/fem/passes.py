"""Repeated passes over an elastic-plastic body: cylinders in plane strain, spheres on a body halved
by its plane of symmetry.

A track runs along x. Over it moves a given traction, or a rigid indenter whose contact is solved,
with the traction μp along x on all that touches (gross sliding). Steps are implicit; the set of
touching points and the plastic flow are iterated together.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from ..core.arrays import BoolArray, RealArray
from ..core.errors import ConvergenceError, InputError
from ..core.quantity import measured
from ..core.status import Advice
from ..core.units import percent
from ..solids.elastic import Elastic
from ..solids.flow import OF_STRENGTH, Plasticity, flow_of
from ..solids.layers import Layered
from ..solids.plasticity import WEIGHTS, PlasticState
from .bricks import brick_mesh, bricks, track_lines, tributary
from .elements import plane_strain
from .indenters import LARGE_STRAIN, require_gentle
from .mesh import IntArray, Mesh, Resolution, tensor_mesh
from .prepared import Prepared
from .solid import Response, Solid

TOLERANCE = 1e-6
"""Largest unbalanced force over the load at which a step has converged."""

MOST_ITERATIONS = 20
"""Newton iterations before a step is cut; 4 to 8 are usual."""

LATE, FAR = 6, 0.02
"""After so many iterations an unbalanced force beyond this part of the load is that of a step too
long."""

MOST_CUTS = 6

RISE = 1e-2
"""Tolerance of the displacement by a unit rise of the indenter: what it misses is multiplied by how
far the indenter still moves."""


@dataclass(frozen=True, eq=False)
class PassState:
    """A body between two steps: what the next step or a restart needs.

    Attributes
    ----------
    displacement
        (unknowns,) in m.
    plastic
        Plastic strain, back stress and accumulated plastic strain at the Gauss points.
    normal, tangential
        (points,) forces in N (in plane strain N/m) on the points of the surface, into the body and
        along x.
    place, approach
        Of the indenter or load in m; the approach is NaN under a given traction.
    work, dissipated
        Work of the contact forces so far and plastic work ∫ σ : dε^p dV, in J (J/m).
    """

    displacement: RealArray = measured("m", "displacements, one for each unknown")
    plastic: PlasticState = measured("", "plastic state at the Gauss points")
    normal: RealArray = measured("", "forces into the body on the points of the surface (N, in plane strain N/m)")
    tangential: RealArray = measured("", "forces along x on the points of the surface (N, in plane strain N/m)")
    place: float = measured("m", "place of the indenter or load", default=0.0)
    approach: float = measured("m", "approach of the indenter", default=math.nan)
    work: float = measured("", "work of the contact forces (J, in plane strain J/m)", default=0.0)
    dissipated: float = measured("", "plastic work (J, in plane strain J/m)", default=0.0)

    def require_sound(self) -> None:
        """Refuse fields of a file that do not fit each other, with a ValueError."""
        self.plastic.require_sound()
        if self.normal.shape != self.tangential.shape or self.displacement.ndim != 1:
            raise ValueError("forces on the surface do not fit each other")


@dataclass(frozen=True, eq=False)
class PassHistory:
    """Steps of a history, (n,) each.

    ``place`` and ``approach`` in m, ``force`` and ``pull`` (the sums of the normal and tangential
    forces) in N or N/m, ``area`` of contact in m² (m), the largest accumulated plastic strain
    ``flow`` (n, regions), ``work`` and ``dissipated`` in J (J/m); ``state`` is the last one.
    """

    place: RealArray
    approach: RealArray
    force: RealArray
    pull: RealArray
    area: RealArray
    flow: RealArray
    work: RealArray
    dissipated: RealArray
    state: PassState

    @property
    def advice(self) -> tuple[Advice, ...]:
        """What should be known before its numbers are used: plastic strains that are not small."""
        strain = float(self.flow.max())
        if not strain > LARGE_STRAIN:
            return ()
        text = (
            f"The plastic strain reaches {percent(strain)}. Small strains err by more than a few per cent "
            f"from {percent(LARGE_STRAIN)} on."
        )
        return (Advice("warning", "small strain", text),)


@dataclass(frozen=True, eq=False)
class Track:
    """A meshed body with the surface on which something moves along x.

    Made by ``cylinder_track`` and ``sphere_track``. Half a body counts: forces and energies of a
    sphere are those of y >= 0.

    Attributes
    ----------
    solid, mesh
        The elements with their laws, and their points.
    surface
        Numbers of the surface points that may be loaded.
    areas
        (points,) area (in plane strain length) that each of them stands for.
    fixed
        (unknowns,) those that are zero.
    far_field_error
        By which part the fixed far boundary lowers the approach of a sphere, about: displacements
        fall as a/r.
    """

    solid: Solid
    mesh: Mesh
    surface: IntArray
    areas: RealArray
    fixed: BoolArray
    far_field_error: float
    prepared: Prepared = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "prepared", Prepared(self.solid, self.fixed, self.normal_unknowns))

    @property
    def dimension(self) -> int:
        """2 in plane strain, 3 in space."""
        return int(self.mesh.points.shape[1])

    @property
    def normal_unknowns(self) -> IntArray:
        """Unknowns of the displacement into the body at the surface points."""
        return self.dimension * self.surface + self.dimension - 1

    @property
    def places(self) -> RealArray:
        """(points, 1 or 2) positions x or (x, y) of the surface points in m."""
        return self.mesh.points[self.surface, :-1]

    def virgin(self) -> PassState:
        """The body before the first step."""
        nothing = np.zeros(len(self.surface))
        return PassState(np.zeros(self.solid.elements.size), self.solid.virgin(), nothing, nothing)

    # Steps.

    def carry(self, start: PassState, normal: RealArray, tangential: RealArray, place: float = 0.0) -> PassState:
        """Step to the forces ``normal`` and ``tangential`` (points,) on the surface points, in N or
        N/m.

        Raises
        ------
        ConvergenceError
            If 1/64 of the step does not converge.
        """

        def part(now: PassState, share: float) -> PassState:
            loads = (
                start.normal + share * (normal - start.normal),
                start.tangential + share * (tangential - start.tangential),
            )
            return replace(
                _Step(self, now).under(*loads), place=start.place + share * (place - start.place), approach=math.nan
            )

        return _in_parts(start, part)

    def press(
        self,
        start: PassState,
        indenter: Callable[[RealArray], RealArray],
        *,
        place: float,
        friction: float = 0.0,
        force: float | None = None,
        approach: float | None = None,
    ) -> PassState:
        """Step to a rigid ``indenter`` with its lowest point above x = ``place``, under a ``force``
        in N (N/m) or at an ``approach`` in m.

        ``indenter``: height in m over its lowest point at positions (points, 1 or 2) relative to
        that; ``friction``: coefficient, the indenter drags the surface towards +x.

        Raises
        ------
        InputError
            If not exactly one of force and approach is given, or the indenter is steeper than 0.4
            where it touches: strains are not small then.
        ConvergenceError
            If 1/64 of the step does not converge.
        """
        if (force is None) == (approach is None):
            raise InputError(
                f"load of an indenter must be either a force or an approach, but is {force!r} and {approach!r}."
            )
        before = float(start.normal.sum())
        last = 0.0 if math.isnan(start.approach) else start.approach
        dragged = float(start.tangential.sum()) / before if before > 0.0 else friction

        def part(now: PassState, share: float) -> PassState:
            x = start.place + share * (place - start.place)
            moved = self.places.copy()
            moved[:, 0] -= x
            step, mu = _Step(self, now), dragged + share * (friction - dragged)
            if force is not None:
                found = step.against(indenter(moved), mu, force=before + share * (force - before))
            else:
                assert approach is not None
                found = step.against(indenter(moved), mu, approach=last + share * (approach - last))
            return replace(found, place=x)

        found = _in_parts(start, part)
        touched = self.places[found.normal > 0.0]
        require_gentle(indenter, touched - np.array([place, 0.0])[: touched.shape[1]])
        return found

    # What is found.

    def response(self, state: PassState) -> Response:
        """Stress and forces of the body in a ``state``."""
        return self.solid.respond(state.displacement, state.plastic)

    def column(self, values: RealArray, x: float = 0.0, y: float = 0.0) -> tuple[RealArray, RealArray]:
        """Depths (n,) in m and means (n, …) over the Gauss points of the elements below (x, y) of
        ``values`` (elements, points, …)."""
        corners = self.mesh.points[self.mesh.cells]
        low, high = corners.min(axis=1), corners.max(axis=1)
        inside = (low[:, 0] <= x) & (x < high[:, 0])
        if self.dimension == 3:
            inside &= (low[:, 1] <= y) & (y < high[:, 1])
        cells = np.flatnonzero(inside)
        cells = cells[np.argsort(low[cells, -1])]
        depth = 0.5 * (low[cells, -1] + high[cells, -1])
        return depth, values[cells].mean(axis=1)

    def history(self, states: list[PassState]) -> PassHistory:
        """Columns of the ``states`` at the ends of steps."""
        regions = range(int(self.mesh.region.max()) + 1)
        rows = [
            (
                state.place,
                state.approach,
                float(state.normal.sum()),
                float(state.tangential.sum()),
                float(self.areas[state.normal > 0.0].sum()),
                [float(state.plastic.accumulated[self.mesh.region == number].max()) for number in regions],
                state.work,
                state.dissipated,
            )
            for state in states
        ]
        names = ("place", "approach", "force", "pull", "area", "flow", "work", "dissipated")
        columns = zip(names, zip(*rows, strict=True), strict=True)
        return PassHistory(**{name: np.array(column) for name, column in columns}, state=states[-1])


def _in_parts(start: PassState, part: Callable[[PassState, float], PassState]) -> PassState:
    """Follow a step from its share 0 to 1, at once or in halves where Newton's method fails."""
    now, done, size = start, 0.0, 1.0
    while done < 1.0:
        try:
            now, done = part(now, min(1.0, done + size)), min(1.0, done + size)
        except ConvergenceError as error:
            size *= 0.5
            if size < 0.5**MOST_CUTS:
                raise ConvergenceError(
                    f"A step of a pass is not found even in {2**MOST_CUTS} parts: {error}", now
                ) from error
    return now


class _Step:
    """One implicit step from a state."""

    def __init__(self, track: Track, start: PassState) -> None:
        self.track, self.start = track, start
        self.normal = track.normal_unknowns
        self.along = track.dimension * track.surface
        self.u = start.displacement.copy()
        self.free = ~track.fixed
        self.friction, self.error = 0.0, math.inf

    def under(self, normal: RealArray, tangential: RealArray) -> PassState:
        """Balance under given forces."""
        loads = np.zeros_like(self.u)
        loads[self.normal], loads[self.along] = normal, tangential
        scale = max(float(np.abs(normal).sum()), float(np.abs(self.start.normal).sum()), 1e-300)
        nobody, nothing = np.zeros(len(self.normal), dtype=bool), np.zeros(0)
        for _ in range(MOST_ITERATIONS):
            response = self.track.solid.respond(self.u, self.start.plastic, stiffness=True)
            left = np.where(self.free, loads - response.forces, 0.0)
            self.error = error = float(np.abs(left).max()) / scale
            if error <= TOLERANCE:
                return self._found(response, normal, tangential)
            self.u += self._solve(response, left, nobody, nothing)
        raise ConvergenceError(f"Newton's method leaves an unbalanced force of {error:.1e} of the load.")

    def against(
        self, heights: RealArray, friction: float, *, force: float | None = None, approach: float | None = None
    ) -> PassState:
        """Balance against an indenter with the ``heights`` (points,)."""
        self.friction, touching = friction, self.start.normal > 0.0
        level = approach if approach is not None else self.start.approach
        if not touching.any():
            touching, level = self._first_touch(heights + self.u[self.normal], force, level)
        scale = max(force or 0.0, float(self.start.normal.sum()), 1e-300)
        error = math.inf
        for count in range(MOST_ITERATIONS):
            response = self.track.solid.respond(self.u, self.start.plastic, stiffness=True)
            push = response.forces[self.normal]
            gap = self.u[self.normal] - (level - heights)
            changed = False
            if count:
                before = touching
                close = 1e-10 * float(np.abs(self.u).max())
                touching = np.where(touching, push > 0.0, gap < -close)
                changed = bool((touching != before).any())
            push = np.where(touching, push, 0.0)
            left = -response.forces
            left[self.along] += friction * np.maximum(push, 0.0)
            left = np.where(self.free, left, 0.0)
            scale = max(scale, float(push.sum()))
            balance = left.copy()
            balance[self.normal[touching]] = 0.0
            miss = 0.0 if force is None else force - float(push.sum())
            away = float(np.abs(gap[touching]).max(initial=0.0))
            self.error = error = max(float(np.abs(balance).max()), abs(miss)) / scale
            settled = away <= 1e-9 * max(float(np.abs(self.u).max()), 1e-300)
            if count > LATE and error > FAR:
                raise ConvergenceError(f"Newton's method leaves an unbalanced force of {error:.1e} of the load.")
            if count and error <= TOLERANCE and not changed and settled:
                return replace(self._found(response, push, friction * push), approach=level)
            if force == 0.0 and not touching.any():
                return replace(self.under(np.zeros(len(push)), np.zeros(len(push))), approach=level)
            level += self._move(
                response, left, touching, (level - heights) - self.u[self.normal], miss, force is not None
            )
        raise ConvergenceError(f"Newton's method leaves an unbalanced force of {error:.1e} of the load.")

    def _first_touch(self, gaps: RealArray, force: float | None, level: float) -> tuple[BoolArray, float]:
        """Touching points and level of an indenter on the elastic body: one point alone would yield
        far too much."""
        reach = self.track.prepared.reach[self.normal]
        if force is None:
            touching = gaps < level
        else:
            touching, level = gaps <= gaps.min(), float(gaps.min())
        for _ in range(MOST_ITERATIONS):
            if not touching.any():
                return touching, level
            pushed = np.linalg.solve(
                reach[np.ix_(touching, touching)], np.stack([np.ones(int(touching.sum())), gaps[touching]], axis=1)
            )
            if force is not None:
                level = (force + float(pushed[:, 1].sum())) / float(pushed[:, 0].sum())
            push = np.zeros(len(gaps))
            push[touching] = level * pushed[:, 0] - pushed[:, 1]
            now = np.where(touching, push > 0.0, gaps + reach @ push < level * (1.0 - 1e-12))
            if (now == touching).all():
                break
            touching = now
        return touching, level

    def _move(
        self,
        response: Response,
        left: RealArray,
        touching: BoolArray,
        wanted: RealArray,
        miss: float,
        free_level: bool,
    ) -> float:
        """One step of Newton's method; how far the level of the indenter moves."""
        found = self._solve(response, left, touching, wanted[touching])
        if not free_level:
            self.u += found
            return 0.0
        if not touching.any():
            raise ConvergenceError("No point of the surface bears the force.")
        stiffness = response.stiffness
        assert stiffness is not None
        rise = self._solve(response, np.zeros_like(left), touching, np.ones(int(touching.sum())), tolerance=RISE)
        places = self.normal[touching]
        stiff, gained = float((stiffness @ rise)[places].sum()), float((stiffness @ found)[places].sum())
        # forces of touching points change by K du; those that leave take theirs along
        further = (miss - gained) / stiff
        self.u += found + further * rise
        return further

    def _solve(
        self,
        response: Response,
        left: RealArray,
        held: BoolArray,
        known: RealArray,
        tolerance: float | None = None,
    ) -> RealArray:
        assert response.stiffness is not None
        places, along = self.normal[held], self.along[held]

        def rows(forces: RealArray) -> RealArray:
            found = forces.copy()
            found[along] -= self.friction * forces[places]
            return found

        symmetric = self.track.solid.symmetric and (self.friction == 0.0 or not held.any())
        tolerance = tolerance or min(1e-2, max(1e-8, 0.1 * self.error))
        prepared = self.track.prepared
        return prepared.solve(response.stiffness, left, held, known, tolerance, rows=None if symmetric else rows)

    def _found(self, response: Response, normal: RealArray, tangential: RealArray) -> PassState:
        start, elements = self.start, self.track.solid.elements
        moved = self.u - start.displacement
        work = 0.5 * float(
            (start.normal + normal) @ moved[self.normal] + (start.tangential + tangential) @ moved[self.along]
        )
        flowed = response.state.plastic_strain - start.plastic.plastic_strain
        lost = float((((response.stress * flowed) @ WEIGHTS) * elements.weights).sum())
        return PassState(
            self.u,
            response.state,
            normal,
            tangential,
            start.place,
            start.approach,
            start.work + work,
            start.dissipated + lost,
        )


# Bodies with a track.


def cylinder_track(
    body: Elastic | Layered,
    half_width: float,
    ends: tuple[float, float],
    *,
    plasticity: Plasticity = OF_STRENGTH,
    resolution: Resolution = Resolution(across=12, growth=1.25, depth=1.5, distance=200.0),
) -> Track:
    """Body in plane strain below line contacts of at most ``half_width`` (m) that move between the
    ``ends`` (m) of a track.

    ``plasticity``: law of each region, by default perfect plasticity at the strengths of the
    materials; ``resolution``: of the mesh, whose far boundary is fixed.

    Raises
    ------
    InputError
        If an interface slips, a law does not fit its region, or an argument is out of range.
    """
    layered = body if isinstance(body, Layered) else Layered([], body)
    x, _, z, region = track_lines(layered, half_width, resolution, ends)
    mesh = tensor_mesh(x, z, region)
    solid = Solid(plane_strain(mesh), flow_of(body, plasticity))
    far = (mesh.points[:, 0] == x[0]) | (mesh.points[:, 0] == x[-1]) | (mesh.points[:, 1] == z[-1])
    surface, lengths = mesh.surface, tributary((x,))
    near = (x >= ends[0] - 1.25 * half_width) & (x <= ends[1] + 1.25 * half_width)
    return Track(solid, mesh, surface[near], lengths[near], np.repeat(far, 2), 0.6 / resolution.distance)


def sphere_track(
    body: Elastic | Layered,
    radius: float,
    ends: tuple[float, float],
    *,
    plasticity: Plasticity = OF_STRENGTH,
    resolution: Resolution = Resolution(across=6, growth=1.5, depth=1.0, distance=12.0),
) -> Track:
    """Half y >= 0 of a body below point contacts of at most the contact ``radius`` (m) that move
    along y = 0 between the ``ends`` (m) of a track.

    Arguments and errors as for ``cylinder_track``.
    """
    layered = body if isinstance(body, Layered) else Layered([], body)
    x, y, z, region = track_lines(layered, radius, resolution, ends)
    mesh = brick_mesh(x, y, z, region)
    solid = Solid(bricks(mesh), flow_of(body, plasticity))
    p = mesh.points
    far = (p[:, 0] == x[0]) | (p[:, 0] == x[-1]) | (p[:, 1] == y[-1]) | (p[:, 2] == z[-1])
    fixed = np.repeat(far[:, None], 3, axis=1)
    fixed[p[:, 1] == 0.0, 1] = True
    surface, areas = np.flatnonzero(p[:, 2] == 0.0), tributary((x, y))
    here = p[surface]
    near = (
        (here[:, 0] >= ends[0] - 1.25 * radius)
        & (here[:, 0] <= ends[1] + 1.25 * radius)
        & (here[:, 1] <= 1.25 * radius)
    )
    return Track(solid, mesh, surface[near], areas[near], fixed.ravel(), 0.6 / resolution.distance)
