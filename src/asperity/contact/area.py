"""Real area of a contact, its error, spots and perimeter, freed of the size of the pixels by the place of the edge between them (``edges``)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import BoolArray, RealArray
from . import measure
from .edge_tables import PATCHES, WAVES
from .edges import Edges, Kind, Setting, edges_of
from .problem import ContactProblem

SAME_LIMIT = 1e-6
"""Relative difference of two pressures at the same limit."""

LEAST_SPOT = 1.0 / 16.0
"""Least area in pixels of a spot: what single pixels, barely in contact, hold is not told apart from nothing."""


@dataclass(frozen=True, eq=False)
class RealArea:
    """Real contact area by the place of the edges.

    Attributes
    ----------
    spots
        Area in m² of every contact spot (pixels joined by their sides), largest first.
    error
        Error in m² of the sum: what all edges share in the worst case, and two standard deviations of what is random.
    perimeter
        Length of all edges in m.
    """

    spots: RealArray
    error: float
    perimeter: float

    @property
    def total(self) -> float:
        """Area of all spots in m²."""
        return float(self.spots.sum())


def edges_in(problem: ContactProblem, pressure: RealArray, gap: RealArray, plastic: BoolArray) -> Edges:
    """Edges of a contact of ``problem`` with these fields, (nx, ny) each."""
    table = WAVES if problem.boundary.name == "periodic" else PATCHES
    kinds = (physics.edges(problem) for physics in problem.physics)
    kind = next((found for found in kinds if found is not None), Kind.elastic)
    setting = Setting(problem.grid, problem.boundary.wraps, problem.contact_modulus, table, kind)
    return edges_of(pressure, gap, plastic, setting)


def real_area(problem: ContactProblem, pressure: RealArray, plastic: BoolArray, edges: Edges) -> RealArea:
    """Real area of a contact of ``problem`` with these fields, (nx, ny) each, and its ``edges``.

    A spot with pixels at the limit H of the pressure is at least as large as its force over H, which is exact for any contact.
    """
    grid, contact = problem.grid, pressure > 0.0
    labels, count = measure.labelled(contact, wraps=problem.boundary.wraps)
    if count == 0:
        return RealArea(np.zeros(0), 0.0, 0.0)
    flat = labels.ravel()
    found = np.bincount(flat, minlength=count + 1).astype(float)
    found += np.bincount(flat[edges.inner], edges.excess, minlength=count + 1)
    least = np.full(count + 1, LEAST_SPOT)
    if plastic.any():
        force = np.bincount(flat, pressure.ravel().astype(np.float64), minlength=count + 1)
        # pressure (count + 1,) that no point of a spot exceeds; infinite where the limit varies and none of its pixels is at it
        p, capped = pressure.ravel(), plastic.ravel()
        at_limit = p[capped].astype(np.float64)
        limits = np.full(count + 1, float(at_limit.max()))
        if float(at_limit.min()) < float(at_limit.max()) * (1.0 - SAME_LIMIT):
            highest, reached = np.zeros(count + 1), np.zeros(count + 1, dtype=bool)
            np.maximum.at(highest, flat, p)
            reached[flat[capped]] = True
            limits = np.where(reached, highest, np.inf)
        np.maximum(least, force / limits, out=least)
    spots = np.sort(np.maximum(found, least)[1:])[::-1]
    spots *= min(1.0, grid.n_points / spots.sum())
    return RealArea(spots * grid.pixel_area, edges.area_error() * grid.pixel_area, edges.perimeter())
