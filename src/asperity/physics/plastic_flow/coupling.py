"""Plastic flow in the volume as a coupling: its eigenstrain lifts the surface, and the pressure
makes it grow.

Plastic strain and pressure are found together: each iterate of the plastic strain has its own
elastic contact on the surface that it displaces, which costs a few transforms of the surface beside
those of the volume, and the return mapping under that pressure gives the next. The map of one
strain to the next brings two strains never farther apart, since the contact minimises an energy;
with the pressure of the round before instead it would not settle where the contact gives way more
by flow than elastically. The contact of the driver then confirms what was found.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

import numpy as np

from ...contact.boundary import Free
from ...contact.controls import Approach, MeanGap
from ...contact.couplings.position import closeness_wanted
from ...contact.couplings.protocol import Contact, Coupling, Exchange, Memory, Posed, Share
from ...contact.problem import ContactProblem
from ...contact.solvers.active_set.solver import ActiveSet
from ...contact.solvers.protocol import FixedOffset, Solver, run
from ...core.arrays import BoolArray, ComplexArray, RealArray
from ...core.grid import Grid
from ...core.spectral import thread_count
from ...solids.eigenstrain.cells import DepthCells, depth_edges, interfaces, stack_of
from ...solids.eigenstrain.flow import Extrapolation, Flowed, Points, VolumeFlow
from ...solids.eigenstrain.operator import EigenstrainOperator
from ...solids.elastic import Elastic
from ...solids.layers import Layered, RigidBase
from ...solids.plasticity import J2, WEIGHTS, LinearHardening
from .answer import NAME, REMEDY, PlasticBody, PlasticZone
from .law import PlasticFlow, plastic_body
from .residual_stress import operator_of

FIRST_CELL = 0.5
"""Thickness of the depth cells at the surface over the smaller spacing of the grid."""

_PROBED = 0.8
"""Share of the yield stress that the elastic stress in the coarse cells of the first look must
reach."""

_MARGIN = 1.4
"""Depth of the cells over that of the deepest place that yields; also by how much they go deeper
when that place reaches the end."""

_FARTHEST = 2.0
"""Depth of the cells over the length of the grid, or over that of the deepest interface if more,
from which on they go no deeper: a mean pressure that makes the body yield in itself would do so at
any depth."""

_GROWTH = 1.15
"""Thickness of an added cell over that of the one above."""

_INNER = 0.3
"""Share of the tolerance to which the iteration with contacts of its own goes."""

_MOST = 200
"""Iterates in one round; one that ends there is given up."""

_WORSE = 2.0
"""Residual over the smallest so far from which extrapolation begins anew."""

_SWINGS = 2
"""Iterates in a row after which extrapolation began anew from which on the share of a step of the
return mapping that is taken is halved: of a map that brings two strains never farther apart,
iterates that go the whole step may swing between two strains for ever, those that go a part of it
come to rest (Krasnoselskii 1955). Halving it at once takes up to half as many iterates again."""

_LEAST_SHARE = 0.1
"""The least such share."""

_NORMAL = 1e-8
"""Tolerance of the contacts of iterates."""


@dataclass
class Volume:
    """Operator of the plastic body, made for the depth cells that are in use."""

    problem: ContactProblem
    threads: int
    operator: EigenstrainOperator | None = None

    def at(self, edges: RealArray) -> EigenstrainOperator:
        """The operator for the cells between ``edges``."""
        if self.operator is None or not np.array_equal(self.operator.cells.edges, edges):
            self.operator = None  # the old one goes before the new one comes
            self.operator = operator_of(self.problem, edges, self.threads)
        return self.operator


@dataclass(eq=False)
class _Course:
    """What is known of a step on the way: what the contact was posed with last is ``settled``;
    ``posed`` where the share holds the position."""

    begin: Flowed
    memory: Memory
    posed: Posed | None = None
    flow: VolumeFlow | None = None
    mixing: Extrapolation = field(default_factory=Extrapolation)
    settled: Flowed | None = None
    work: float = 0.0
    energy: float = 0.0
    iterations: int = 0
    spread: ComplexArray | None = None
    stuck: bool = False


@dataclass(frozen=True, eq=False)
class PlasticFlowCoupling(Coupling):
    """Lift by the plastic strain of the body; the unknown is that displacement (nx, ny) in m."""

    problem: ContactProblem
    law: PlasticFlow
    laws: tuple[J2 | None, ...]
    volume: Volume = field(repr=False)
    solver: Solver = field(repr=False)
    sign: float = 1.0
    tolerance: float = 1e-4
    feedback: ClassVar[bool] = True
    name: ClassVar[str] = NAME
    settled_text: ClassVar[str] = "The plastic strain is settled"
    unsettled_text: ClassVar[str] = "The return mapping still changes the plastic strain by {change:.1e}"
    remedy: ClassVar[str] = REMEDY

    @classmethod
    def prepared(cls, problem: ContactProblem, tolerance: float | None, threads: int | None) -> Self:
        """Coupling of ``problem``, which has a plastic flow."""
        law = problem.plastic_flow
        assert law is not None
        body, sign = plastic_body(problem.body, problem.counter_body)
        volume = Volume(problem, thread_count(threads))
        return cls(problem, law, law.laws(body), volume, ActiveSet(tolerance=_NORMAL), sign, tolerance or law.tolerance)

    @property
    def body(self) -> Elastic | Layered:
        """The body that flows."""
        return plastic_body(self.problem.body, self.problem.counter_body)[0]

    @property
    def positions(self) -> bool:
        """Whether its share holds the bodies at the position prescribed: of contacts that repeat,
        whose mean gap and approach follow from the offset alone."""
        return not isinstance(self.problem.boundary, Free)

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The displacement by the plastic strain so far."""
        course = _Course(Flowed.of(memory), memory)
        if self.positions:
            course.posed = posed
            if posed.external_force is None:
                closeness_wanted(posed, elastic=True)  # refuses what has no solution
        lift = np.asarray(memory["lift"]) if "lift" in memory else np.zeros(posed.profile.shape)
        return Exchange(lift, lift, np.inf, self.tolerance, note=course)

    def share(self, exchange: Exchange) -> Share:
        """The displacement as a lift, and the position if that is prescribed."""
        course: _Course = exchange.note
        constraint: FixedOffset | None = None
        if course.posed is not None:
            control = course.posed.control
            if isinstance(control, Approach):
                constraint = FixedOffset(course.posed.top - control.value)
            elif isinstance(control, MeanGap):
                constraint = FixedOffset(control.value + float((course.posed.profile - exchange.x).mean()))
        return Share(lift=exchange.x if exchange.x.any() else 0.0, constraint=constraint)

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        """The displacement that agrees with its own contact, which is found from ``contact`` on."""
        course: _Course = exchange.note
        if course.flow is None:
            edges = course.begin.edges if course.begin.edges.size else self._edges(contact.pressure)
            if not edges.size:  # nothing flows, has flowed or may do so
                return replace(exchange, target=exchange.x, residual=0.0, scale=1.0)
            self._prepare(course, edges)
        flow = self._flow(course)
        if course.spread is None:
            course.spread = flow.spread()
        step, residual = self._mapped(course, contact.pressure)
        if residual <= self.tolerance:
            course.settled, course.spread = course.settled or flow.flowed(), None
            return replace(exchange, target=exchange.x, residual=residual, scale=1.0)
        # until plastic strain and contact agree
        pressure, wanted, least, worse = contact.pressure, _INNER * self.tolerance, np.inf, 0
        for number in range(_MOST):
            flow = self._flow(course)
            flow.delta = course.mixing.ahead(flow.points, flow.delta, step, flow.weights)
            course.spread = flow.spread()
            lift = flow.displacement(course.spread)
            pressure = self._pressed(contact, lift - exchange.x, pressure)
            step, left = self._mapped(course, pressure)
            if left <= wanted:
                break
            worse = worse + 1 if left > _WORSE * least else 0
            if worse:
                share = course.mixing.share * (0.5 if worse > _SWINGS else 1.0)
                course.mixing = Extrapolation(max(share, _LEAST_SHARE))
            least = min(least, left)
            course.stuck = number == _MOST - 1
        flow = self._flow(course)
        course.settled = flow.flowed()
        flow.delta = flow.delta + step
        course.spread = flow.spread()
        lift = flow.displacement(course.spread)
        size = float(np.linalg.norm(lift))
        return replace(
            exchange, target=lift, residual=residual, scale=size or 1.0, pressure=pressure, stuck=course.stuck
        )

    def _prepare(self, course: _Course, edges: RealArray) -> None:
        """Volume with depth cells between ``edges``, from what is known on fewer of them."""
        operator, old = self.volume.at(edges), course.flow
        regions = operator.cells.regions
        flow = VolumeFlow(operator, [self.laws[number] for number in regions], course.begin)
        if old is not None:
            flow.points, flow.before, flow.delta = old.points, old.before, old.delta
        course.flow, course.spread = flow, None

    def _flow(self, course: _Course) -> VolumeFlow:
        assert course.flow is not None
        return course.flow

    def _edges(self, pressure: RealArray) -> RealArray:
        """Edges of the depth cells for the first ``pressure`` that yields; none where nothing
        does."""
        grid, body = self.problem.grid, self.body
        first = min(grid.spacing) if grid.shape[1] > 1 else grid.spacing[0]
        if self.law.depth is not None:
            return depth_edges(body, self.law.depth, FIRST_CELL * first, self.law.cells)
        if not pressure.any():
            return np.zeros(0)
        coarse = depth_edges(body, max(_deepest(body), 0.5 * max(grid.size)), first, 20)
        operator = operator_of(self.problem, coarse, self.volume.threads)
        weaker: list[J2 | None] = []
        for law in (self.laws[number] for number in operator.cells.regions):
            # a constant yield stress that is less, for a first look
            least = None if law is None else _PROBED * float(law.hardening.yield_stress(np.zeros(1))[0])
            weaker.append(None if law is None or least is None else J2(law.elastic, LinearHardening(least)))
        flow = VolumeFlow(operator, weaker, Flowed.virgin())
        flow.spread()
        flow.returned(operator.loads(pressure, self._shear(pressure)))
        if not flow.points.size:
            return np.zeros(0)
        depth = _MARGIN * float(coarse[int(flow.cell.max()) + 1])
        return depth_edges(body, max(depth, 4.0 * FIRST_CELL * first), FIRST_CELL * first, self.law.cells)

    def _deeper(self, edges: RealArray) -> RealArray | None:
        """More cells below; None where the depth is prescribed or a rigid base ends it."""
        body = self.body
        if self.law.depth is not None:
            return None
        places, stack = interfaces(body), stack_of(body)
        ends, h = list(edges), float(edges[-1] - edges[-2])
        if edges[-1] >= max(_FARTHEST * max(self.problem.grid.size), _MARGIN * _deepest(body)):
            return None
        while ends[-1] < _MARGIN * edges[-1]:
            h *= _GROWTH
            below = places[places > ends[-1] * (1.0 + 1e-9)]
            if not below.size and isinstance(stack.base, RigidBase):
                break
            end = ends[-1] + h
            if below.size and end > below[0] - 0.5 * h:
                end = float(below[0])
            ends.append(end)
        return np.array(ends) if len(ends) > edges.size else None

    def _shear(self, pressure: RealArray) -> RealArray | None:
        """Shear traction (2, nx, ny) in Pa on the plastic body of a sliding contact."""
        shear = self.problem.shear(pressure)
        return None if shear is None else self.sign * shear

    def _mapped(self, course: _Course, pressure: RealArray) -> tuple[RealArray, float]:
        """Step of the plastic strain by the return mapping under ``pressure``; goes deeper where
        the deepest cell begins to flow."""
        while True:
            flow = self._flow(course)
            course.iterations += 1
            step, residual = flow.returned(flow.operator.loads(pressure, self._shear(pressure)))
            ends = flow.points.size and int(flow.cell[-1]) == flow.operator.cells.count - 1
            edges = self._deeper(flow.operator.cells.edges) if ends else None
            if edges is None:
                break
            self._prepare(course, edges)
            course.mixing = Extrapolation()
            course.spread = self._flow(course).spread()
        assert course.spread is not None
        strain, weights = flow.after.plastic_strain, flow.weights / flow.operator.table.solids[flow.cell, 0]
        lift = flow.displacement(course.spread)
        pixel = flow.operator.grid.pixel_area
        by_load = float((pressure * lift).sum()) * pixel
        shear = self._shear(pressure)
        for number, traction in enumerate(() if shear is None else shear):
            by_load += float((traction * flow.displacement(course.spread, number)).sum()) * pixel
        course.energy = -0.5 * (float(((flow.stress * flow.strain) @ WEIGHTS) @ weights) - by_load)
        course.work = float(((flow.stress * (strain - flow.before.plastic_strain)) @ WEIGHTS) @ weights)
        return step, residual

    def _pressed(self, contact: Contact, added: RealArray, start: RealArray) -> RealArray:
        """Pressure (nx, ny) in Pa of the contact whose surface is displaced by ``added`` (m)
        more."""
        qp = replace(contact.qp, profile=contact.qp.profile - added)
        if self.positions and isinstance(contact.posed.control, MeanGap) and isinstance(qp.constraint, FixedOffset):
            qp = replace(qp, constraint=FixedOffset(qp.constraint.offset - float(added.mean())))
        external = contact.posed.external_force
        fixed = isinstance(qp.constraint, FixedOffset)
        if fixed and (external == 0.0 or float(qp.profile.max()) <= qp.constraint.offset):  # type: ignore[union-attr]
            return np.zeros_like(start)
        return run(self.solver, qp, start if start.any() else None).state.pressure

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, PlasticBody]:
        """State of the body, and what it tells."""
        course: _Course = exchange.note
        flowed = course.begin if course.settled is None else course.settled
        earlier = float(course.memory.get("work", 0.0))
        mean = contact.force / self.problem.grid.area
        # (regions, 4): mean pressure of the step in which each region flowed first, x, y and depth
        # of its largest strain after it
        earliest = course.memory.get("first")
        first = np.full((len(self.laws), 4), np.nan) if earliest is None else earliest.copy()
        for number, (points, values) in enumerate(_by_region(self.problem, flowed)):
            if points.size and np.isnan(first[number, 0]):
                first[number] = mean, *_place(self.problem.grid, flowed.edges, int(points[values.argmax()]))
        place = [mean, contact.posed.top + contact.level, float(contact.gap.mean())]
        memory: dict[str, RealArray] = {"place": np.array(place)}
        if flowed.points.size:
            memory |= {**flowed.memory, "lift": exchange.x, "first": first}
            numbers = {"work": earlier + course.work, "step_work": course.work, "energy": course.energy}
            memory |= {name: np.asarray(value) for name, value in numbers.items()}
            memory["iterations"] = np.asarray(float(course.iterations))
        return memory, found_in(self.problem, memory)


def _deepest(body: Elastic | Layered) -> float:
    """Depth (m) of the last interface."""
    places = interfaces(body)
    return float(places[-1]) if places.size else 0.0


def _by_region(problem: ContactProblem, flowed: Flowed) -> list[tuple[Points, RealArray]]:
    """Points and accumulated strains of each layer and the base."""
    body = plastic_body(problem.body, problem.counter_body)[0]
    count = len(stack_of(body).layers) + 1
    if not flowed.points.size:
        return [(flowed.points, flowed.state.accumulated)] * count
    regions = np.array(DepthCells(body, flowed.edges).regions)[flowed.points // problem.grid.n_points]
    masks: list[BoolArray] = [regions == number for number in range(count)]
    return [(flowed.points[mask], flowed.state.accumulated[mask]) for mask in masks]


def _place(grid: Grid, edges: RealArray, point: int) -> tuple[float, float, float]:
    """x, y and depth in m of a point."""
    cell, plane = divmod(point, grid.n_points)
    i, j = divmod(plane, grid.shape[1])
    return i * grid.spacing[0], j * grid.spacing[1], float(0.5 * (edges[cell] + edges[cell + 1]))


def found_in(problem: ContactProblem, memory: Memory) -> PlasticBody:
    """What a ``memory`` of the coupling tells of the body of ``problem``."""
    flowed = Flowed.of(memory)
    parts = _by_region(problem, flowed)
    first: RealArray = memory.get("first", np.full((len(parts), 4), np.nan))
    zones = []
    for number, (points, values) in enumerate(parts):
        name = "base" if number == len(parts) - 1 else f"layer {number + 1}"
        begin, x, y, z = (float(value) for value in first[number])
        if not points.size:
            nowhere = (np.nan, np.nan, np.nan)
            zones.append(PlasticZone(name, 0.0, np.nan, np.nan, 0.0, nowhere, begin, (x, y, z)))
            continue
        cell = points // problem.grid.n_points
        volume = float(np.diff(flowed.edges)[cell].sum()) * problem.grid.pixel_area
        top, bottom = float(flowed.edges[cell.min()]), float(flowed.edges[cell.max() + 1])
        place = _place(problem.grid, flowed.edges, int(points[values.argmax()]))
        zones.append(PlasticZone(name, volume, top, bottom, float(values.max()), place, begin, (x, y, z)))
    lift = np.asarray(memory["lift"]) if "lift" in memory else np.zeros(problem.grid.shape)
    work, step, energy, iterations = (
        float(memory.get(name, 0.0)) for name in ("work", "step_work", "energy", "iterations")
    )
    end = bool(flowed.points.size) and int(flowed.points[-1]) // problem.grid.n_points == flowed.edges.size - 2
    return PlasticBody(problem, flowed, lift, work, step, energy, tuple(zones), end, int(iterations))
