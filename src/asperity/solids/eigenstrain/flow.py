"""Plastic flow of a layered body: return mapping at the points of the depth cells that flow, and
the eigenstrain that they leave.

With the deviator s of the stress by tractions and plastic strain, the trial of a point is s + 2GΔ,
Δ being the plastic strain of the step so far; the return mapping gives the next Δ. Of the operators
0 <= -ε:S:ε <= ε:C:ε, so that this map brings two strains never farther apart (in the norm of the
elastic energy), with any tractions that follow from the contact as well; extrapolation (Anderson
1965) makes it fast.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import ComplexArray, RealArray
from ...core.quantity import measured
from ..plasticity import J2, WEIGHTS, PlasticState
from .operator import EigenstrainOperator, shared

Points = NDArray[np.int64]
"""Points of the volume by their number: depth cell times points in the plane, plus the place in the
plane in C order; ascending."""

PARTS = (0, 1, 3, 4, 5)
"""Components of a deviator that are transformed: zz follows from xx and yy."""

REMEMBERED = 6
"""Earlier iterates that an extrapolation uses."""

_REGULAR = 1e-10


@dataclass(frozen=True, eq=False)
class Flowed:
    """Plastic state of a body.

    Attributes
    ----------
    edges
        (cells + 1,) in m: depth cells; empty where nothing has flowed yet.
    points
        (n,) those that have flowed, see ``Points``.
    state
        Plastic strain, back stress and accumulated strain of each.
    """

    edges: RealArray = measured("m", "depths between the depth cells", "edge")
    points: Points = measured("1", "points that have flowed, by number", "point")
    state: PlasticState = measured("", "plastic state of each")

    @classmethod
    def virgin(cls) -> Flowed:
        """A body in which nothing has flowed."""
        return cls(np.zeros(0), np.zeros(0, dtype=np.int64), PlasticState.virgin((0,)))

    @classmethod
    def of(cls, memory: Mapping[str, RealArray]) -> Flowed:
        """From named arrays, see ``memory``; virgin if there are none."""
        if "points" not in memory:
            return cls.virgin()
        points = np.asarray(memory["points"], dtype=np.int64)
        state = PlasticState(memory["plastic_strain"], memory["back_stress"], memory["accumulated"])
        return cls(np.asarray(memory["edges"], dtype=float), points, state)

    @property
    def memory(self) -> dict[str, RealArray]:
        """Named real arrays."""
        state = self.state
        return {
            "edges": self.edges,
            "points": self.points.astype(float),
            "plastic_strain": state.plastic_strain,
            "back_stress": state.back_stress,
            "accumulated": state.accumulated,
        }


def joined(old: Points, new: Points, values: RealArray) -> RealArray:
    """``values`` (n, …) of the points ``old`` for those of ``new``, which hold them all; zero for
    others."""
    if old.size == new.size:
        return values
    found = np.zeros((new.size, *values.shape[1:]))
    found[np.searchsorted(new, old)] = values
    return found


@dataclass
class Extrapolation:
    """The last iterates of Δ and their steps, each with the points it is for; a ``share`` of each
    step is taken."""

    share: float = 1.0
    places: list[tuple[Points, RealArray, RealArray]] = field(default_factory=list)

    def ahead(self, points: Points, x: RealArray, step: RealArray, weights: RealArray) -> RealArray:
        """Where the iteration that goes by ``step`` (n, 6) from ``x`` would end if it were linear;
        ``weights`` (n,) of the squares."""
        self.places = [*self.places[-REMEMBERED:], (points, x, step)]
        earlier = self.places[:-1]
        if not earlier:
            return x + self.share * step
        root = np.sqrt(weights[:, None] * WEIGHTS)
        moves = [(x - joined(p, points, a), step - joined(p, points, b)) for p, a, b in earlier]
        changes = np.stack([(change * root).ravel() for _, change in moves], axis=1)
        gram = changes.T @ changes
        gram[np.diag_indices(len(moves))] += _REGULAR * np.trace(gram)
        weights_of = np.linalg.solve(gram, changes.T @ (step * root).ravel())
        found = x + self.share * step
        for by, (moved, changed) in zip(weights_of, moves, strict=True):
            found -= by * (moved + self.share * changed)
        return found


class VolumeFlow:
    """One step of a body from ``before``: iterates on the plastic strain of the step.

    ``laws`` are those of the depth cells of ``operator``; None for cells that stay elastic.
    """

    def __init__(self, operator: EigenstrainOperator, laws: Sequence[J2 | None], before: Flowed) -> None:
        self.operator, self.laws = operator, tuple(laws)
        self.before = before.state
        self.points = before.points
        self.delta: RealArray = np.zeros((before.points.size, 6))
        self.after = before.state
        self.fields = operator.spectra()
        self.stress: RealArray = np.zeros((before.points.size, 6))
        self.shape = operator.grid.shape
        self._plane = operator.grid.n_points
        start = np.zeros(1)
        self._limits = [np.inf if law is None else float(law.hardening.yield_stress(start)[0]) for law in self.laws]

    @property
    def cell(self) -> NDArray[np.int64]:
        """Depth cell (n,) of each point."""
        return np.asarray(self.points // self._plane)

    @property
    def weights(self) -> RealArray:
        """(n,) shear modulus (Pa) times volume (m³) of each point."""
        solids = self.operator.table.solids[self.cell]
        return np.asarray(solids[:, 0] * solids[:, 2] * self.operator.grid.pixel_area)

    @property
    def strain(self) -> RealArray:
        """Plastic strain (n, 6) of the points."""
        return np.asarray(self.before.plastic_strain + self.delta)

    def spread(self) -> ComplexArray:
        """Displacement (3, …) of the surface by the plastic strain as transforms; the stress by it
        waits for the tractions."""
        operator, fields, strain = self.operator, self.fields, self.strain
        fields[:] = 0.0
        ends = np.searchsorted(self.points, np.arange(operator.cells.count + 1) * self._plane)
        busy = np.flatnonzero(np.diff(ends))

        def forward(cell: int) -> None:
            part = slice(ends[cell], ends[cell + 1])
            place, transform = self.points[part] - cell * self._plane, operator.transform
            for component in PARTS:
                values = np.zeros(self._plane)
                values[place] = strain[part, component]
                transform.forward(values.reshape(self.shape), fields[cell, component])
            np.add(fields[cell, 0], fields[cell, 1], out=fields[cell, 2])
            np.negative(fields[cell, 2], out=fields[cell, 2])

        shared(forward, [int(cell) for cell in busy], operator.threads)
        none = np.zeros((3, *operator.spectrum_shape), dtype=complex)
        if busy.size:
            return operator.respond(none, fields)
        return none

    def displacement(self, moved: ComplexArray, component: int = 2) -> RealArray:
        """Displacement (nx, ny) in m from its transforms ``moved``; of z, positive into the body,
        by default."""
        found = np.empty(self.shape)
        self.operator.transform.backward(moved[component].copy(), found)
        return found

    def returned(self, loads: ComplexArray) -> tuple[RealArray, float]:
        """Step (n, 6) from Δ to what the return mapping gives under the transforms ``loads`` of the
        tractions, and its size over that of the larger strain.

        Call ``spread`` before. Points that flow for the first time join those there are, with
        Δ = 0.
        """
        deviators = self._deviators(loads)
        self.stress = deviators
        before, n = self.before, self.points.size
        strain, back, total = np.empty((n, 6)), np.empty((n, 6)), np.empty(n)
        groups: dict[int, tuple[J2, list[int]]] = {}  # depth cells of each law
        for number, law in enumerate(self.laws):
            if law is not None:
                groups.setdefault(id(law), (law, []))[1].append(number)
        cell = self.cell
        for law, cells in groups.values():
            rows = np.flatnonzero(np.isin(cell, cells))
            part = PlasticState(before.plastic_strain[rows], before.back_stress[rows], before.accumulated[rows])
            trial = deviators[rows] / (2.0 * law.shear) + part.plastic_strain + self.delta[rows]
            after = law.step(trial, part).state
            strain[rows], back[rows], total[rows] = after.plastic_strain, after.back_stress, after.accumulated
        self.after = PlasticState(strain, back, total)
        step = strain - before.plastic_strain - self.delta
        weights = self.weights[:, None] * WEIGHTS
        size = max(float((each**2 * weights).sum()) for each in (strain, strain - step))
        return step, float((step**2 * weights).sum() / size) ** 0.5 if size > 0.0 else 0.0

    def _deviators(self, loads: ComplexArray) -> RealArray:
        """Deviator (n, 6) in Pa at the points, to which those beyond the yield stress are added."""
        from .kernels import exceeding

        operator, plane = self.operator, self._plane
        operator.press(loads, self.fields)
        ends = np.searchsorted(self.points, np.arange(operator.cells.count + 1) * plane)
        cells = [number for number, law in enumerate(self.laws) if law is not None]
        new: dict[int, Points] = {}
        values: dict[int, RealArray] = {}

        def backward(cell: int) -> None:
            transform, stress = operator.transform, np.empty((5, *self.shape))
            for number, component in enumerate(PARTS):
                transform.backward(self.fields[cell, component], stress[number])
            flat: RealArray = stress.reshape(5, plane)
            known, room = np.zeros(plane, dtype=np.uint8), np.empty(plane, dtype=np.int64)
            own = self.points[ends[cell] : ends[cell + 1]] - cell * plane
            known[own] = 1
            count = exceeding(flat, known, self._limits[cell], room)
            known[room[:count]] = 1
            places = np.flatnonzero(known)
            new[cell], five = places + cell * plane, flat[:, places]
            xx, yy, xy, xz, yz = five
            values[cell] = np.stack([xx, yy, -xx - yy, xy, xz, yz], axis=1)

        shared(backward, cells, operator.threads)
        points = np.concatenate([new[cell] for cell in cells]) if cells else self.points
        if points.size > self.points.size:  # those that are new are virgin
            old, before = self.points, self.before
            self.before = PlasticState(
                joined(old, points, before.plastic_strain),
                joined(old, points, before.back_stress),
                joined(old, points, before.accumulated),
            )
            self.delta, self.points = joined(old, points, self.delta), points
        return np.concatenate([values[cell] for cell in cells]) if cells else np.zeros((0, 6))

    def flowed(self) -> Flowed:
        """State after the last ``returned``, without points that have never flowed."""
        kept = self.after.accumulated > 0.0
        state = self.after
        state = PlasticState(state.plastic_strain[kept], state.back_stress[kept], state.accumulated[kept])
        return Flowed(self.operator.cells.edges, self.points[kept], state)
