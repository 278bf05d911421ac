"""Flow of a thin film through a gap by Reynolds' equation: transmissivity, pressure, flux and their
certificate.

The flow per width is q = -g³/(12 η) ∇P, nothing passes where the surfaces touch, and the gap does
not change by the pressure of the fluid. Everything here is for 12 η = 1 and one unit of pressure
between the sides; fluids come with ``fluids``.

The cells of the gap are finite volumes. The conductance of a face is exact for a gap that changes
linearly between the centres of its cells.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal, TypeAlias

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph
from scipy.sparse.linalg import splu

from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...theories.sealing.gaps import Bounds
from .network import Labels, Network, checked_gap, clusters, network, open_cells
from .solver import Method, System

Way: TypeAlias = Literal["x", "y"]
"""Direction along the grid in which fluid is driven."""

WAYS: tuple[Way, Way] = ("x", "y")

Driven: TypeAlias = Literal["auto", "sides", "gradient"]
"""How the flow is driven: by pressures at two sides of the grid, or by a mean gradient on a grid
that repeats; ``"auto"`` takes the latter wherever the grid repeats along the flow."""

DRIVEN = ("auto", "sides", "gradient")


UNEVEN = 1e-6
"""Relative difference between the flows through cross-sections from which the flow is not
solved."""


@dataclass(frozen=True, eq=False)
class GapFlow:
    """Flow through a gap along one direction, for 12 η = 1 and one unit of pressure between the
    sides.

    Attributes
    ----------
    gap
        (nx, ny) in m, zero in contact.
    grid
        Its grid.
    way
        Direction in which the pressure falls.
    repeats
        Whether a mean gradient drives the flow on a grid that repeats, rather than pressures at two
        sides.
    wraps
        Whether the grid repeats along x and y.
    net
        Conductances of the faces.
    pressure
        (nx, ny) from 1 at the side where fluid enters to 0 where it leaves, NaN where it does not
        flow; of a mean gradient, without the part that falls steadily.
    """

    gap: RealArray
    grid: Grid
    way: Way
    repeats: bool
    wraps: tuple[bool, bool]
    net: Network
    pressure: RealArray
    method: str = ""

    @property
    def axis(self) -> int:
        """0 for x, 1 for y."""
        return WAYS.index(self.way)

    @property
    def labels(self) -> Labels | None:
        """Labels (nx, ny) of the clusters, whose pressures are each free by a constant under a mean
        gradient; None between two sides."""
        return clusters(open_cells(self.gap), self.wraps).labels if self.repeats else None

    @property
    def sealed(self) -> bool:
        """Whether no open cluster leads through the gap."""
        return not self.net.carrying.any()

    @cached_property
    def flux(self) -> RealArray:
        """(2, nx, ny) flow through the faces to the next cells along x and y, m³."""
        return self.net.flux(self._filled)

    @cached_property
    def inflow(self) -> RealArray:
        """(2, nx, ny) flow from the two sides into the cells, m³; the second is negative."""
        return self.net.inflow(self._filled)

    @property
    def _filled(self) -> RealArray:
        return np.where(self.net.carrying, self.pressure, 0.0)

    @property
    def rates(self) -> RealArray:
        """(n,) flow through each cross-section of the grid across the direction, m³."""
        sums = self.flux[self.axis].sum(axis=1 - self.axis)
        if self.repeats:
            return np.asarray(sums)
        return np.concatenate([[self.inflow[0].sum()], sums[:-1], [-self.inflow[1].sum()]])

    @cached_property
    def rate(self) -> float:
        """Flow for 12 η = 1 and one unit of pressure, m³: the energy of the pressure, which errs by
        the square of the errors of that."""
        return 0.0 if self.sealed else self._energy(self.net)

    @property
    def transmissivity(self) -> float:
        """K = 12 η Q L / (W ΔP) in m³, the cube of the even gap that lets as much through."""
        return self.rate * self._length_over_width

    @property
    def _length_over_width(self) -> float:
        return self.grid.size[self.axis] / self.grid.size[1 - self.axis]

    @property
    def equivalent_gap(self) -> float:
        """Even gap in m that lets as much through."""
        return float(np.cbrt(self.transmissivity))

    @property
    def crosswise(self) -> float:
        """Off-diagonal transmissivity of a mean gradient in m³: flow across per width and mean
        gradient."""
        if self.sealed or not self.repeats:
            return 0.0
        other = 1 - self.axis
        per_width = self.flux[other].mean() / self.grid.spacing[self.axis]
        return float(per_width * self.grid.size[self.axis])

    @cached_property
    def dissipation(self) -> RealArray:
        """(2, nx, ny) and sides: power spent on each face, m³; it adds up to the flow."""
        return np.divide(self.flux**2, self.net.across, out=np.zeros_like(self.flux), where=self.net.across > 0.0)

    @cached_property
    def dissipated(self) -> RealArray:
        """(nx, ny) power spent in each cell, half of that of each face and all of the halves at the
        sides, m³."""
        total = sum(0.5 * (part + np.roll(part, 1, axis)) for axis, part in enumerate(self.dissipation))
        ends = np.divide(self.inflow**2, self.net.ends, out=np.zeros_like(self.inflow), where=self.net.ends > 0.0)
        return np.asarray(total + ends.sum(axis=0))

    # Certificate.

    @property
    def section_error(self) -> float:
        """Largest difference of the flow through a cross-section from the mean, over it."""
        rates = self.rates
        return 0.0 if self.sealed else float(np.abs(rates - rates.mean()).max() / abs(rates.mean()))

    @property
    def residual(self) -> float:
        """What enters the cells and does not leave, added up without signs, over the flow."""
        if self.sealed:
            return 0.0
        return float(np.abs(self.net.imbalance(self._filled)).sum() / abs(self.rates.mean()))

    @cached_property
    def balanced(self) -> tuple[RealArray, RealArray]:
        """Flux (2, nx, ny) and inflow (2, nx, ny) without divergence to rounding: what is left over
        leaves along the tree of the faces with the largest conductances."""
        return _balanced(self)

    @cached_property
    def bounds(self) -> Bounds:
        """Bounds of the flow of these conductances (m³), whatever the errors of the solution.

        From above the energy of any pressure, Σ T (ΔP)²; from below any flux q without divergence,
        (Σ q ΔP₀)² / Σ q²/T with the pressure ΔP₀ that is applied (Thomson).
        """
        if self.sealed:
            return Bounds(0.0, 0.0)
        return self._bracket(self.net, self.net)

    @cached_property
    def face_bounds(self) -> Bounds:
        """Bounds of the flow (m³) with conductances of the faces between those of a harmonic and
        an arithmetic mean of g³: how much depends on how the gap goes on between the centres."""
        if self.sealed:
            return Bounds(0.0, 0.0)
        axis = None if self.repeats else self.axis
        low, high = (
            network(self.gap, self.grid.spacing, self.wraps, axis=axis, faces=faces)
            for faces in ("harmonic", "arithmetic")
        )
        return self._bracket(low, high)

    def _energy(self, net: Network) -> float:
        """Energy of the pressure with the conductances of ``net``."""
        pressure = self._filled
        drop, ends = self.net.drop + Network.differences(pressure), np.stack([1.0 - pressure, -pressure])
        return float((net.across * drop**2).sum() + (net.ends * ends**2).sum())

    def _bracket(self, low: Network, high: Network) -> Bounds:
        """Flow of the conductances ``low`` from below and ``high`` from above."""
        upper = self._energy(high)
        flux, inflow = self.balanced
        spent = _ratio(flux**2, low.across) + _ratio(inflow**2, low.ends)
        given = float((flux * self.net.drop).sum() + inflow[0].sum())
        return Bounds(given**2 / spent if 0.0 < spent < np.inf else 0.0, upper)


def _ratio(squares: RealArray, conductance: RealArray) -> float:
    """Sum of squares over conductances, infinite where something flows without one."""
    there = conductance > 0.0
    if np.any(squares[~there] > 0.0):
        return float("inf")
    return float((squares[there] / conductance[there]).sum())


def _balanced(flow: GapFlow) -> tuple[RealArray, RealArray]:
    net = flow.net
    flux, inflow = flow.flux.copy(), flow.inflow.copy()
    cells = np.flatnonzero(net.carrying)
    count = cells.size
    number = np.full(net.carrying.size + 1, -1)
    number[cells] = np.arange(count)
    number[-1] = count  # the side of lower pressure, one more cell
    index: Labels = np.arange(net.carrying.size).reshape(net.carrying.shape)
    faces: list[tuple[Labels, Labels, int]] = []
    for axis, part in enumerate(net.across):
        if part.shape[axis] > 1:
            rows, columns = np.nonzero(part > 0.0)
            faces.append((rows, columns, axis))
    first: list[Labels] = [number[index[i, j]] for i, j, _ in faces]
    second: list[Labels] = [number[np.roll(index, -1, axis)[i, j]] for i, j, axis in faces]
    size = [net.across[axis][i, j] for i, j, axis in faces]
    out = np.nonzero(net.ends[1] > 0.0)
    first.append(number[index[out]])
    second.append(np.full(out[0].size, count))
    size = [*size, net.ends[1][out]]
    left = np.append(net.gathered(flux, inflow)[net.carrying], 0.0)
    moved = _along_tree(np.concatenate(first), np.concatenate(second), np.concatenate(size), left)
    begin = 0
    for i, j, axis in faces:
        flux[axis][i, j] += moved[begin : begin + i.size]
        begin += i.size
    inflow[1][out] -= moved[begin:]
    return flux, inflow


def _along_tree(first: Labels, second: Labels, size: RealArray, left: RealArray) -> RealArray:
    """(m,) flow along the edges of a graph from ``first`` to ``second`` that takes ``left`` from
    its nodes to the last node of their tree, on the tree of the edges of largest ``size``."""
    count = left.size
    weight = 1.0 + np.log(size.max() / size)
    low, high = np.minimum(first, second), np.maximum(first, second)
    order = np.lexsort((weight, high, low))
    keep = order[np.append(True, (np.diff(low[order]) != 0) | (np.diff(high[order]) != 0))]
    graph = sparse.coo_array((weight[keep], (low[keep], high[keep])), shape=(count, count)).tocsr()
    tree = csgraph.minimum_spanning_tree(graph).tocoo()
    # potentials of unit conductances on the tree, zero at the last node of each tree
    _, part = csgraph.connected_components(tree, directed=False)
    roots = np.zeros(int(part.max()) + 1, int)
    roots[part] = np.arange(count)
    ones = np.ones(tree.nnz)
    laplacian: Any = csgraph.laplacian(
        sparse.coo_array((ones, (tree.row, tree.col)), shape=(count, count)).tocsr(), symmetrized=True
    )
    free = np.ones(count, bool)
    free[roots] = False
    potential = np.zeros(count)
    if free.any():
        inner = laplacian.tocsr()[free][:, free].tocsc()
        factors = splu(inner, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        potential[free] = factors.solve(left[free])
    key = low.astype(np.int64) * count + high
    row, column = np.minimum(tree.row, tree.col), np.maximum(tree.row, tree.col)
    at = np.searchsorted(key[keep], row.astype(np.int64) * count + column)
    moved = np.zeros(first.size)
    used = keep[at]
    moved[used] = potential[first[used]] - potential[second[used]]
    return moved


def flow_through(
    gap: RealArray,
    grid: Grid,
    way: Way = "x",
    *,
    wraps: tuple[bool, bool] = (False, False),
    repeats: bool = False,
    method: Method = "auto",
) -> GapFlow:
    """Flow through a ``gap`` from side to side along ``way``, or by a mean gradient.

    Parameters
    ----------
    gap
        (nx, ny) in m, zero in contact.
    grid
        Grid of the gap, with at least two cells along the flow.
    way
        ``"x"`` or ``"y"``: where the pressure falls to.
    wraps
        Whether the grid repeats along x and y; between two sides only that across the flow counts.
    repeats
        Drive the flow by a mean gradient on a grid that wraps along ``way``.
    method
        ``"direct"`` factorises, ``"multigrid"`` needs pyamg, ``"auto"`` chooses.

    Raises
    ------
    InputError
        If the gap is no map of numbers >= 0 of this grid, or does not fit the way of driving.
    """
    require.one_of(way, WAYS, "direction of flow")
    gap, axis = _fitting(gap, grid, way, wraps, repeats)
    net = network(gap, grid.spacing, wraps, axis=None if repeats else axis)
    posed = _posed(gap, grid, way, wraps, net.along(axis) if repeats else net)
    through = clusters(open_cells(gap), wraps).winds[axis].any() if repeats else net.carrying.any()
    if not through:
        return _nothing(posed)
    return _solved(posed, System(net, posed.labels, method))


def drives(driven: Driven, way: Way, wraps: tuple[bool, bool]) -> bool:
    """Whether a mean gradient drives the flow along ``way`` on a grid that ``wraps``.

    Raises
    ------
    InputError
        If it is asked for where the grid does not repeat.
    """
    repeats = wraps[WAYS.index(way)] and driven != "sides"
    if driven == "gradient" and not repeats:
        raise InputError(
            f'way of driving the flow must be "sides" where the contact does not repeat along {way}, but is "gradient".'
        )
    return repeats


def gap_flow(
    gap: RealArray, touching: BoolArray, grid: Grid, wraps: tuple[bool, bool], way: Way, driven: Driven
) -> GapFlow:
    """Flow through the ``gap`` (nx, ny) in m of a contact, closed where surfaces are ``touching``
    (nx, ny)."""
    opened = np.maximum(np.where(touching, 0.0, gap), 0.0)
    return flow_through(opened, grid, way, wraps=wraps, repeats=drives(driven, way, wraps))


def _fitting(gap: RealArray, grid: Grid, way: Way, wraps: tuple[bool, bool], repeats: bool) -> tuple[RealArray, int]:
    """The gap, checked, and the axis of the flow."""
    gap, axis = checked_gap(gap), WAYS.index(way)
    if gap.shape != grid.shape:
        raise InputError(f"gap must have the shape {grid.shape} of the grid, but has {gap.shape}.")
    if gap.shape[axis] < 2:
        raise InputError(
            f"grid of a flow along {way} must have at least two points along {way}, but has {gap.shape[axis]}."
        )
    if repeats and not wraps[axis]:
        raise InputError(f"grid of a flow by a mean gradient must repeat along {way}, but does not.")
    return gap, axis


def _posed(gap: RealArray, grid: Grid, way: Way, wraps: tuple[bool, bool], net: Network) -> GapFlow:
    """The flow before it is solved; one without sides is driven by a mean gradient."""
    return GapFlow(gap, grid, way, bool(net.drop.any()), wraps, net, np.full(gap.shape, np.nan))


def _nothing(posed: GapFlow) -> GapFlow:
    """A flow where none passes."""
    net = posed.net
    closed = np.zeros(posed.gap.shape, bool)
    return replace(posed, net=Network(closed, 0.0 * net.across, 0.0 * net.ends, net.drop))


def _solved(posed: GapFlow, system: System) -> GapFlow:
    """The flow with its pressure."""
    pressure = system.pressure(posed.net.imbalance(np.zeros(posed.gap.shape)))
    return replace(posed, pressure=np.where(posed.net.carrying, pressure, np.nan), method=system.method)


@dataclass(frozen=True, eq=False)
class FlowTensor:
    """Transmissivity of a gap that repeats, for mean gradients along x and y.

    Attributes
    ----------
    x, y
        Flow under a mean gradient along each.
    system
        The balance of both, for other causes of flow; None where nothing flows.
    """

    x: GapFlow
    y: GapFlow
    system: System | None = None

    @property
    def matrix(self) -> RealArray:
        """(2, 2) K in m³: flow per width along i for 12 η = 1 and a unit of mean gradient along
        j."""
        return np.array([[self.x.transmissivity, self.y.crosswise], [self.x.crosswise, self.y.transmissivity]])

    @property
    def principal(self) -> RealArray:
        """(2,) smallest and largest transmissivity of all directions, m³."""
        return np.asarray(np.linalg.eigvalsh(0.5 * (self.matrix + self.matrix.T)))

    @property
    def carrying(self) -> BoolArray:
        """(nx, ny) True where fluid can flow along x or y."""
        return self.x.net.carrying | self.y.net.carrying


def flow_tensor(gap: RealArray, grid: Grid, *, method: Method = "auto") -> FlowTensor:
    """Effective tensor of a ``gap`` (nx, ny) in m on a ``grid`` that repeats along x and y: two
    flows with one factorisation.

    Raises
    ------
    InputError
        As of ``flow_through``.
    """
    wraps = (True, True)
    gap, _ = _fitting(gap, grid, "x", wraps, True)
    net = network(gap, grid.spacing, wraps)
    posed = [_posed(gap, grid, way, wraps, net.along(axis)) for axis, way in enumerate(WAYS)]
    if not net.carrying.any():
        return FlowTensor(_nothing(posed[0]), _nothing(posed[1]))
    found = clusters(open_cells(gap), wraps)
    system = System(net, found.labels, method)
    flows = [
        _solved(one, system) if winds.any() else _nothing(one) for one, winds in zip(posed, found.winds, strict=True)
    ]
    return FlowTensor(flows[0], flows[1], system)
