"""Depth cells with thin slices beside one depth, whose mean stress is that at the depth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import RealArray
from .cells import DepthCells, interfaces

THIN = 1e-4
"""Thickness of a slice over that of the cell that it is cut from: by as much at most the stress
differs from its mean over the slice."""


@dataclass(frozen=True, eq=False)
class Slice:
    """Cells cut at a depth.

    Attributes
    ----------
    edges
        Edges (m) of the cells with the slices.
    owner
        (cells,): the cell that each was cut from; -1 below the last one.
    rows
        Cells that are the slices.
    """

    edges: RealArray
    owner: NDArray[np.int64]
    rows: tuple[int, ...]


def slice_at(cells: DepthCells, depth: float, *, above: bool, below: bool) -> Slice:
    """``cells`` with slices ``above`` and ``below`` the ``depth`` (m), which may lie deeper than
    the last of them."""
    edges = cells.edges
    number = min(int(np.searchsorted(edges, depth, side="right")) - 1, cells.count - 1)
    near = cells.thickness[max(number - 1, 0) : number + 2]
    thin = THIN * float(near.min())
    at = float(edges[np.abs(edges - depth).argmin()])
    at = at if abs(at - depth) < thin else depth
    places = interfaces(cells.body)
    between = places[(places > edges[-1]) & (places < at)]
    added = [at, *([at - thin] if above else []), *([at + thin] if below else [])]
    cut = np.unique(np.concatenate([edges, between, added]))
    middle = 0.5 * (cut[1:] + cut[:-1])
    owner = np.where(middle < edges[-1], np.searchsorted(edges, middle) - 1, -1)
    row = int(np.searchsorted(cut, at))
    rows = (*((row - 1,) if above else ()), *((row,) if below else ()))
    return Slice(cut, owner.astype(np.int64), rows)
