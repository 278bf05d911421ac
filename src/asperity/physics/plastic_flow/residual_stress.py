"""Stress by plastic strain and tractions at any depth: residual stress, and what layers and
interfaces bear."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ...contact.boundary import Free
from ...contact.problem import ContactProblem
from ...core.arrays import ComplexArray, RealArray
from ...solids.eigenstrain.cells import DepthCells, interfaces
from ...solids.eigenstrain.flow import Flowed
from ...solids.eigenstrain.operator import EigenstrainOperator
from ...solids.eigenstrain.slices import slice_at
from ...solids.plasticity import J2
from .law import plastic_body

_TRACTIONS = [2, 4, 5]

_SAME = 1e-9
"""Relative difference of depths that are one and the same."""


def cells_of(problem: ContactProblem, edges: RealArray) -> DepthCells:
    """Depth cells of the plastic body of ``problem`` between ``edges``."""
    return DepthCells(plastic_body(problem.body, problem.counter_body)[0], edges)


def operator_of(problem: ContactProblem, edges: RealArray, threads: int | None = None) -> EigenstrainOperator:
    """Operator of the plastic body of ``problem`` with depth cells between ``edges``."""
    free = isinstance(problem.boundary, Free)
    return EigenstrainOperator.prepared(problem.grid, cells_of(problem, edges), free=free, threads=threads)


class _Flows(Protocol):
    """What the stress is found from: what a ``PlasticBody`` knows of its plastic strain."""

    @property
    def problem(self) -> ContactProblem: ...
    @property
    def flowed(self) -> Flowed: ...
    @property
    def laws(self) -> tuple[J2 | None, ...]: ...
    @property
    def plastic_strain(self) -> RealArray: ...
    @property
    def citation_keys(self) -> tuple[str, ...]: ...
    def stress(
        self, pressure: RealArray | None = None, shear: RealArray | None = None, *, threads: int | None = None
    ) -> RealArray: ...


class ResidualStress:
    """Stress of a plastic ``body`` by its plastic strain alone, at single depths.

    Exact for the plastic strain of the cells, which is constant in depth within each of them, to
    1e-4 of its change within a cell.
    """

    def __init__(self, body: _Flows, threads: int | None = None) -> None:
        self._body, self._threads = body, threads
        self.citation_keys = body.citation_keys

    @cached_property
    def _edges(self) -> RealArray:
        """Edges (m) of the depth cells; of one as thick as the first layer or a pixel where nothing
        has flowed."""
        problem, edges = self._body.problem, self._body.flowed.edges
        if edges.size:
            return edges
        places = interfaces(plastic_body(problem.body, problem.counter_body)[0])
        return np.array([0.0, float(places[0]) if places.size else problem.grid.spacing[0]])

    @cached_property
    def _cells(self) -> DepthCells:
        return cells_of(self._body.problem, self._edges)

    @cached_property
    def _spectra(self) -> ComplexArray:
        """Transforms (cells, 6, …) of the plastic strain."""
        operator = operator_of(self._body.problem, self._edges, self._threads)
        fields = operator.spectra()
        if not self._body.flowed.edges.size:
            return fields
        strain = np.ascontiguousarray(self._body.plastic_strain)
        busy = np.flatnonzero(strain.any(axis=(1, 2, 3)))
        operator.forward(strain, fields, [(int(cell), part) for cell in busy for part in range(6)])
        return fields

    def at(self, depth: float, *, above: bool, below: bool) -> RealArray:
        """(6, nx, ny) in Pa at ``depth`` (m), components xx, yy, zz, xy, xz, yz.

        Just ``above`` it, just ``below`` it, or the mean of both, which differ at interfaces and
        between cells; of the surface below it.
        """
        found = self.loaded(depth, above=above, below=below)
        if depth == 0.0:
            found[_TRACTIONS] = 0.0
        return found

    @cached_property
    def _yielding(self) -> NDArray[np.int64]:
        """Numbers (n,) of the cells whose material may flow."""
        if not self._body.flowed.edges.size:
            return np.zeros(0, dtype=np.int64)
        laws = self._body.laws
        return np.flatnonzero([laws[region] is not None for region in self._cells.regions])

    def yielding_depths(self) -> RealArray:
        """Depths (n,) in m of the middle of the cells whose material may flow, on the mean over
        each of which yield is required."""
        return self._cells.middle[self._yielding]

    def cell_at(self, depth: float, *, below: bool) -> int | None:
        """Number of the cell that holds ``depth`` (m), on its lower or upper side, where its
        material may flow; None elsewhere."""
        near = _SAME * depth
        at = depth + near if below else depth - near
        number = int(np.searchsorted(self._edges, at, side="right" if below else "left")) - 1
        return number if number in self._yielding else None

    def means(self, pressure: RealArray | None = None, shear: RealArray | None = None) -> RealArray:
        """Mean stress (cells, 6, nx, ny) in Pa in the depth cells, with that by these tractions on
        the body."""
        return self._body.stress(pressure, shear, threads=self._threads)

    def loaded(
        self,
        depth: float,
        pressure: RealArray | None = None,
        shear: RealArray | None = None,
        *,
        above: bool,
        below: bool,
    ) -> RealArray:
        """As ``at``, with the stress by the tractions ``pressure`` (nx, ny) and ``shear`` (2, nx,
        ny) in Pa on the body."""
        cut = slice_at(self._cells, depth, above=above, below=below)
        operator = operator_of(self._body.problem, cut.edges, self._threads)
        fields = operator.spectra()
        held = cut.owner >= 0
        fields[held] = self._spectra[cut.owner[held]]
        none = np.zeros(operator.grid.shape)
        operator.respond(operator.loads(none if pressure is None else pressure, shear), fields)
        rows = np.array(cut.rows)
        found = np.empty((rows.size, 6, *operator.grid.shape))
        pairs = [(number, part) for number in range(rows.size) for part in range(6)]
        operator.backward(np.ascontiguousarray(fields[rows]), found, pairs)
        return np.asarray(found.mean(axis=0))


@dataclass(eq=False)
class YieldingStress:
    """Stress under given tractions as the flow rule has it.

    Yield is required of the mean over a depth cell, so that this is the stress at all depths within
    a cell whose material may flow; at a single depth the stress by a plastic strain that is
    constant in the cell may pass the yield stress. Elsewhere it is that at the depth itself.

    Parameters
    ----------
    stress
        That by the plastic strain.
    pressure, shear
        (nx, ny) and (2, nx, ny) in Pa on the body; None for none.
    """

    stress: ResidualStress
    pressure: RealArray | None
    shear: RealArray | None

    @cached_property
    def _means(self) -> RealArray:
        return self.stress.means(self.pressure, self.shear)

    def at(self, depth: float, *, below: bool) -> RealArray:
        """(6, nx, ny) in Pa just below ``depth`` (m), or just above it."""
        cell = self.stress.cell_at(depth, below=below)
        return self.exact(depth, below=below) if cell is None else self._means[cell]

    def exact(self, depth: float, *, below: bool) -> RealArray:
        """The same at the depth itself, whose tractions pass interfaces."""
        return self.stress.loaded(depth, self.pressure, self.shear, above=not below, below=below)


@dataclass(frozen=True, eq=False)
class LayerStress:
    """What may crack or peel one layer.

    Attributes
    ----------
    name
        ``"layer 1"`` and so on from the surface down.
    top, bottom
        Depths in m of its faces.
    top_tension, bottom_tension
        Largest principal stress in Pa along the upper and the lower face, within the layer: bending
        and stretch; negative where all of the face is compressed. Of a layer that may flow the mean
        over the depth cell at the face, see ``YieldingStress``.
    normal
        Stress σ_zz (nx, ny) in Pa across the interface below, positive in tension.
    shear
        Stresses σ_xz and σ_yz (2, nx, ny) in Pa there.
    """

    name: str
    top: float
    bottom: float
    top_tension: float
    bottom_tension: float
    normal: RealArray
    shear: RealArray

    @property
    def peel(self) -> float:
        """Largest tension in Pa across the interface below; zero where it is pressed together
        everywhere."""
        return max(float(self.normal.max()), 0.0)

    @property
    def largest_shear(self) -> float:
        """Largest shear traction in Pa of the interface below."""
        return float(np.hypot(*self.shear).max())


def layer_stresses(stress: YieldingStress, places: RealArray) -> tuple[LayerStress, ...]:
    """Faces of the layers between the surface and the interfaces at ``places`` (m)."""
    tops, found = [0.0, *(float(z) for z in places)], []
    for number, (top, bottom) in enumerate(pairwise(tops), start=1):
        tensions = tension_along(stress.at(top, below=True)), tension_along(stress.at(bottom, below=False))
        tractions = stress.exact(bottom, below=False)
        found.append(LayerStress(f"layer {number}", top, bottom, *tensions, tractions[2], tractions[4:6]))
    return tuple(found)


def tension_along(stress: RealArray) -> float:
    """Largest principal stress in Pa in the plane z = const of ``stress`` (6, nx, ny)."""
    return float((0.5 * (stress[0] + stress[1]) + np.hypot(0.5 * (stress[0] - stress[1]), stress[3])).max())
