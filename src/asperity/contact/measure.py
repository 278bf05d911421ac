"""Measures of a contact: true area, perimeter, spots, distributions."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from .islands import island_sizes

PERIMETER_FACTOR = (math.pi - 1.0 + math.log(2.0)) / 24.0
"""Yastrebov, Anciaux & Molinari (2017), eq. 7: pixel area beyond the true area per perimeter and pixel size."""


def contact_edges(contact: BoolArray, *, wraps: tuple[bool, bool]) -> tuple[int, int]:
    """Number of pixel edges between contact and non-contact, normal to x and normal to y.

    Across the border of the grid lies, along x and along y, the opposite side (``wraps``) or no contact.
    """
    return _edges(contact, 0, wraps=wraps[0]), _edges(contact, 1, wraps=wraps[1])


def _edges(contact: BoolArray, axis: int, *, wraps: bool) -> int:
    if wraps:
        return int(np.count_nonzero(contact != np.roll(contact, 1, axis)))
    beyond = np.zeros_like(contact.take([0], axis))
    return int(np.count_nonzero(np.diff(np.concatenate([beyond, contact, beyond], axis), axis=axis)))


def contact_perimeter(contact: BoolArray, grid: Grid, *, wraps: tuple[bool, bool]) -> float:
    """Total length in m of the pixel edges between contact and non-contact."""
    edges_x, edges_y = contact_edges(contact, wraps=wraps)
    return edges_x * grid.spacing[1] + edges_y * grid.spacing[0]


def corrected_area(contact: BoolArray, grid: Grid, *, wraps: tuple[bool, bool]) -> float:
    """True contact area in m², freed of the pixel bias (Yastrebov, Anciaux & Molinari 2017, eq. 7).

    For rectangular pixels each edge counts with the pixel size across it. Contacts of a few pixels may be
    over-corrected; the result is never below zero.
    """
    edges = sum(contact_edges(contact, wraps=wraps))
    pixels = int(np.count_nonzero(contact))
    return max(0.0, pixels - PERIMETER_FACTOR * edges) * grid.pixel_area


def contact_spots(contact: BoolArray, *, wraps: tuple[bool, bool]) -> RealArray:
    """Number of pixels of every contact spot (pixels joined by edges), largest first."""
    return np.sort(island_sizes(contact, wraps=wraps))[::-1].astype(float)


@dataclass(frozen=True, eq=False)
class Distribution:
    """Histogram: bin ``edges`` (n + 1) and probability ``density`` (n) per unit of the quantity; integrates to one."""

    edges: RealArray
    density: RealArray


def distribution(values: RealArray, bins: int = 50) -> Distribution:
    """Probability density of ``values`` (any shape, at least one) from 0 to their maximum in equal ``bins``.

    Serves the gap (``distribution(result.gap[~result.contact])``) and the contact pressure alike.

    Raises
    ------
    InputError
        If there is no value or ``bins`` is not a whole number >= 1.
    """
    bins = require.integer(bins, 1, "number of bins")
    if values.size == 0:
        raise InputError("values of a distribution must hold at least one number, but are empty.")
    density, edges = np.histogram(values, bins, range=(0.0, float(values.max()) or 1.0), density=True)
    return Distribution(edges, density)
