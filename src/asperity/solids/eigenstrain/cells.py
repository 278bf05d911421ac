"""Cells in depth, in each of which the eigenstrain is constant; no cell crosses an interface."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ..elastic import Elastic
from ..layers import Layered, RigidBase

LEAST_PER_LAYER = 4
"""Cells over the thickness of a layer that may flow."""

_SAME = 1e-9


def stack_of(body: Elastic | Layered) -> Layered:
    """``body`` as layers of finite thickness on a base.

    Raises
    ------
    InputError
        If a layer may slip on what is below it.
    """
    stack = body.reduced if isinstance(body, Layered) else Layered((), body)
    if stack.slips:
        raise InputError(
            "layers that hold an eigenstrain must be bonded, but one is Frictionless(). Write Bonded() for "
            "its interface."
        )
    return stack


def interfaces(body: Elastic | Layered) -> RealArray:
    """Depths (layers,) in m of the interfaces of ``body``, the last one the top of the base."""
    return np.cumsum([layer.thickness for layer in stack_of(body).layers], dtype=float)


@dataclass(frozen=True, eq=False)
class DepthCells:
    """Cells between the depths ``edges`` (cells + 1,) in m, from 0 down, of a ``body``.

    Interfaces of ``body`` above the last edge must be among the edges.

    Raises
    ------
    InputError
        If the edges do not begin at 0, do not grow, miss an interface or reach below a rigid base,
        or a layer may slip.
    """

    body: Elastic | Layered
    edges: RealArray

    def __post_init__(self) -> None:
        edges = np.ascontiguousarray(self.edges, dtype=float)
        object.__setattr__(self, "edges", edges)
        if edges.ndim != 1 or edges.size < 2 or edges[0] != 0.0 or not np.all(np.diff(edges) > 0.0):
            raise InputError(
                f"edges of depth cells (m) must begin at 0 and grow, but are {edges}. Write for example "
                "depth_edges(body, depth, first)."
            )
        between = interfaces(self.body)
        for depth in between[between < edges[-1] * (1.0 - _SAME)]:
            if np.abs(edges - depth).min() > _SAME * depth:
                raise InputError(
                    f"edges of depth cells (m) must hold the interface at {depth:g}, but do not. Write "
                    "depth_edges(body, depth, first)."
                )
        if isinstance(self.stack.base, RigidBase) and edges[-1] > between[-1] * (1.0 + _SAME):
            raise InputError(
                f"edges of depth cells (m) must end at the rigid base at {between[-1]:g}, but end at {edges[-1]:g}."
            )

    @property
    def count(self) -> int:
        """Number of cells."""
        return int(self.edges.size - 1)

    @property
    def thickness(self) -> RealArray:
        """(cells,) in m."""
        return np.diff(self.edges)

    @property
    def middle(self) -> RealArray:
        """Depth (cells,) in m of the middle of each."""
        return np.asarray(0.5 * (self.edges[1:] + self.edges[:-1]))

    @property
    def stack(self) -> Layered:
        """The body as layers of finite thickness on a base."""
        return stack_of(self.body)

    @property
    def regions(self) -> tuple[int, ...]:
        """Number of the layer that each cell is in, counted from 0 at the surface; the base has the
        last number."""
        found = np.searchsorted(interfaces(self.body) * (1.0 + _SAME), self.middle)
        return tuple(int(number) for number in found)

    @property
    def materials(self) -> tuple[Elastic, ...]:
        """Material of each cell."""
        stack = self.stack
        parts = [*(layer.material for layer in stack.layers), stack.base]
        found = tuple(parts[number] for number in self.regions)
        return tuple(part for part in found if isinstance(part, Elastic))


def depth_edges(body: Elastic | Layered, depth: float, first: float, cells: int = 40) -> RealArray:
    """Edges (m) of about ``cells`` cells from the surface to at least ``depth``: of the thickness
    ``first`` at the surface and beside interfaces, growing in proportion to the distance from
    there, at least four in every layer.

    The deepest edge is an interface, if one is near, or ``depth``; of a rigid base its top.

    Raises
    ------
    InputError
        If a number is out of range, or a layer may slip.
    """
    require.positive(depth, "depth of the cells (m)")
    require.positive(first, "thickness of the first cell (m)")
    require.integer(cells, 2, "number of depth cells")
    places = [0.0, *(float(z) for z in interfaces(body))]
    bottom = depth
    if isinstance(stack_of(body).base, RigidBase):
        bottom = min(depth, places[-1])
    stops = [z for z in places if z < bottom * (1.0 - _SAME)]
    if len(stops) < len(places) and (places[len(stops)] - bottom) < 0.25 * (bottom - stops[-1]):
        bottom = places[len(stops)]
    spans = list(zip(stops, [*stops[1:], bottom], strict=True))
    low, high = 0.0, 2.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        if sum(_span(z, end, first, middle, ends=end != bottom).size for z, end in spans) > cells:
            low = middle
        else:
            high = middle
    return np.concatenate([[0.0], *(_span(z, end, first, high, ends=end != bottom) for z, end in spans)])


def _span(low: float, high: float, first: float, growth: float, *, ends: bool) -> RealArray:
    """Edges after ``low`` up to ``high``; the thickness is ``first`` plus ``growth`` times the
    distance from the nearer end that counts."""
    length = high - low
    half = 0.5 * length if ends else length
    # cells to the distance x: ∫ dx/(first + growth x)
    to_half = half / first if growth * half < 1e-9 * first else math.log1p(growth * half / first) / growth
    number = max(math.ceil((2.0 if ends else 1.0) * to_half - 1e-9), LEAST_PER_LAYER)
    u = np.arange(1, number + 1) / number
    total = (2.0 if ends else 1.0) * to_half

    def at(count: ArrayLike) -> RealArray:
        n = np.asarray(count, dtype=float)
        return n * first if growth * half < 1e-9 * first else first * np.expm1(growth * n) / growth

    n = u * total
    distance = np.where(n <= to_half, at(np.minimum(n, to_half)), length - at(np.maximum(total - n, 0.0)))
    distance[-1] = length
    return low + distance
