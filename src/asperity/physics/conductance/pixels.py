"""What the pixels do to a conductance, taken off by the place of the edges.

At the edge of a spot the flux density rises as K/√δ with the distance δ inwards. Two errors of
first order follow. A flux that is constant on each pixel conducts like a contact that is smaller
all along its edge by some tenth of a pixel; and the pixels in contact end elsewhere than the
contact does. In elastic contacts they mostly cancel: conductance is stiffness, and the load that
pixels bear errs by second order. Of a single spot the second one scatters with the place of the
spot on the grid, and where points have yielded both remain.

Both follow from the flux density j of the last pixels, of which the square is a measure of K²: the
bias is Σ c w j² Δ³/k and the conductance of a strip of the width s beyond the edge a Σ w j² Δ² s/k,
Δ being the pixel along the normal and w the square of the cosine of normal and axis. Both factors
were measured with parallel strips, straight and oblique, whose conductance is known.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...contact.edges import Edges
from ...contact.measure import labelled
from ...core.arrays import RealArray

BIAS, ALIGNED, ALIGNED_TANGENT = 0.205, 0.112, 0.12
"""c of an oblique edge, 0.197 to 0.227; what more an edge along the grid has, 0.317 in all; and the
tangent of the angle between them at which that has fallen to 1/e. Strips of 24 to 47 pixels in the
period, contact fractions from 0.3 to 0.5."""

WIDER = 1.74
"""a, 1.69 to 1.75 in all directions."""

OF_BIAS = 0.15
"""Error of the bias over itself: the scatter of c."""

SMALL = 20.0
"""Area in pixels of a spot of which the bias is not known at all; beyond, its error falls with the
area. Hertzian contacts of 3 to 40 pixels in the radius."""

LEAST_SPOT = 1.0 / 16.0
"""Least area in pixels of a spot, as of the real contact area."""


@dataclass(frozen=True)
class Freed:
    """Conductance that the pixels cost, to be added, and its error, S or W/K."""

    gain: float
    error: float


def freed_of_pixels(edges: Edges, density: RealArray, conductivity: float, film_resistance: float = 0.0) -> Freed:
    """What the pixels take from the conductance of a contact with these ``edges`` and flux
    ``density`` (nx, ny) per unit drop.

    With a film the flux crowds less, and a strip beyond the edge conducts through it: its
    resistance ρ acts beside a Δ/k.

    Parameters
    ----------
    conductivity
        k_s of both bodies at the scale of a pixel, S/m or W/(m K), > 0.
    film_resistance
        Specific resistance ρ of a film in contact, Ω m² or m² K/W, >= 0.
    """
    grid = edges.grid
    if not edges.inner.size:
        return Freed(0.0, 0.0)
    labels, count = labelled(edges.contact, wraps=edges.wraps)
    spot = labels.ravel()[edges.inner]
    square = edges.weight * density.ravel()[edges.inner] ** 2 * grid.pixel_area
    spread = np.asarray(grid.spacing)[edges.axis] / conductivity
    strip = WIDER * spread + film_resistance
    bias = _bias(edges) * spread * (WIDER * spread / strip)

    def of_spots(values: RealArray) -> RealArray:
        return np.asarray(np.bincount(spot, values, minlength=count + 1), dtype=float)

    size = np.bincount(labels.ravel(), minlength=count + 1).astype(float)
    length = np.maximum(of_spots(edges.cosine), 1.0)
    narrow = of_spots(bias * square)
    per_area = of_spots(strip * square) / length  # of a pixel of area along the edge
    excess = np.maximum(of_spots(edges.excess), LEAST_SPOT - size)
    known = np.minimum(1.0, OF_BIAS + SMALL / np.maximum(size, 1.0))
    shared = float((known * narrow).sum() + (of_spots(edges.weight * edges.factor) * per_area).sum())
    shared += abs(float((of_spots(edges.weight * np.where(edges.two, edges.spread, 0.0)) * per_area).sum()))
    return Freed(float((narrow + excess * per_area).sum()), shared)


def _bias(edges: Edges) -> RealArray:
    """c of each pair, (n,), by the direction of its edge."""
    cosine = np.clip(edges.cosine, 1e-3, 1.0)
    tangent = np.sqrt(1.0 / cosine**2 - 1.0)
    tangent = np.minimum(tangent, 1.0 / np.maximum(tangent, 1e-3))  # of the nearer axis
    return np.asarray(BIAS + ALIGNED * np.exp(-tangent / ALIGNED_TANGENT))
