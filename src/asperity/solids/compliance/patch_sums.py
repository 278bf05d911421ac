"""Sums of weights and influence coefficients for the spectra of many bodies at once.

From samples of a spectrum on wavenumbers to a sum of coefficients everything is linear: Hankel
transform, tables over the distance, quadratures. So it is done backwards, once for the weights
(reverse accumulation; Griewank & Walther 2008): what remains is one weight for each wavenumber, and
a further spectrum costs no more than its values there.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import RealArray
from ...core.grid import Grid
from ...core.interpolation import (
    TERMS,
    backwards_integral,
    backwards_table,
    log_hankel,
    panels_between,
    table_panels,
)
from ...core.quadrature import rule
from .influence import AVERAGE, FAR, GAUSS, NEAR, Limits, reached, triangle_rule, wavenumber_grid

_LONGEST, _SHORTEST = 1e-5, 20.0
"""Wavenumbers times the largest length of the grid and layers, and times the thickness of the
thinnest layer, beyond which a spectrum is at its limits: to 1e-10 of the sums, and exp(-40)."""


_NARROW = 6
"""Terms of tables on panels as narrow as the nodes of the Hankel transform: the next one is 1e-12
of the value where the nearest singularity in ln r is 0.5 away."""


@dataclass(frozen=True, eq=False)
class PatchSums:
    """Sums of weights and influence coefficients, for bodies whose layers are ``depth`` m thick
    together.

    ``of_waves`` are the weights (COUNT,) of alpha C less its limits on ``wavenumber_grid(depth)``,
    ``of_distances`` those of the strength at the reciprocal distances.
    """

    depth: float
    longest: float
    of_waves: RealArray
    of_distances: RealArray

    @classmethod
    def of(cls, grid: Grid, weights: RealArray, depth: float) -> PatchSums:
        """For the ``weights`` (nx, ny) of pixel offsets (0…nx-1, 0…ny-1) on ``grid``."""
        alpha = wavenumber_grid(depth)
        r = 1.0 / alpha[::-1]
        within = table_panels(float(r[0]), r.size)
        distances, shares = (
            np.concatenate(both) for both in zip(_far(grid, weights), _middle(grid, weights), strict=True)
        )
        moments = within.moments(distances, shares, terms=_NARROW)
        strength, first = backwards_integral(within.moments(*_near(grid, weights), terms=TERMS + 1), within.width)
        of_distances = backwards_table(moments) + r * backwards_table(strength)
        of_distances[0] += first * within.start
        length = max(depth, *(n * d for n, d in zip(grid.shape, grid.spacing, strict=True)))
        # A_j = Σ a_k F(k_k r_j) depends on the sum of both numbers alone: its own transpose
        return cls(depth, length, log_hankel(of_distances, 0), of_distances)

    def sums(
        self, values: Callable[[RealArray], RealArray], limits: Sequence[Limits], thinnest: float, width: float
    ) -> RealArray:
        """Sums (m,) for m spectra whose alpha C at wavenumbers (n,) are ``values`` (m, n), with
        their ``limits`` at both ends.

        Layers are as thin as ``thinnest`` (m); the spectra are fitted on panels of this ``width``
        in ln alpha.
        """
        alpha = wavenumber_grid(self.depth)
        low, high = np.searchsorted(alpha, [_LONGEST / self.longest, _SHORTEST / thinnest])
        used = slice(int(low), int(high))
        within = panels_between(float(alpha[low]), float(alpha[high - 1]), width)
        fitted, moments = within.fitted(values(within.points)), within.moments(alpha[used], self.of_waves[used])
        found = np.einsum("ki,imk->m", moments, fitted)
        short, jump = np.array([each.high for each in limits]), np.array([each.low - each.high for each in limits])
        # less the limits at these wavenumbers, and the limits themselves in closed form
        decay, r = np.exp(-alpha[used] * self.depth), 1.0 / alpha[::-1]
        found -= short * self.of_waves[used].sum() + jump * (decay * self.of_waves[used]).sum()
        found += short * self.of_distances.sum()
        found += jump * (self.of_distances * r / np.hypot(r, self.depth)).sum()
        return np.asarray(found)


def _far(grid: Grid, weights: RealArray) -> tuple[RealArray, RealArray]:
    """Distances and weights of the strength there, of pixels beyond ``FAR`` sides: averages over
    five nodes along each side, from pixels back to nodes."""
    (nx, ny), (dx, dy) = grid.shape, grid.spacing
    x, y = grid.coordinates()
    across = np.where(np.hypot(x, y) >= FAR * max(dx, dy), weights, 0.0)
    along_x, nodes = np.zeros((nx + 4, ny)), np.zeros((nx + 4, ny + 4))
    for j, w in enumerate(AVERAGE):
        along_x[j : j + nx] += w * across
    for k, w in enumerate(AVERAGE):
        nodes[:, k : k + ny] += w * along_x
    r = np.hypot(np.arange(-2, nx + 2)[:, None] * dx, np.arange(-2, ny + 2)[None, :] * dy)
    used = nodes != 0.0
    if nx == ny and dx == dy:  # both sides of the diagonal are equally far
        nodes = nodes + nodes.T
        nodes[np.diag_indices_from(nodes)] *= 0.5
        used = np.tri(nx + 4, dtype=bool) & (nodes != 0.0)
    r, shares = r[used], nodes[used]
    shares *= grid.pixel_area / (2.0 * np.pi)
    shares /= r
    return r, shares


def _distances(grid: Grid) -> RealArray:
    """Distances of the pixel offsets that are not far, up to ``FAR`` sides along each axis."""
    (nx, ny), (dx, dy) = grid.shape, grid.spacing
    x, y = grid.coordinates()
    side = max(dx, dy)
    return np.hypot(x[: reached(FAR, side, dx, nx)], y[:, : reached(FAR, side, dy, ny)])


def _middle(grid: Grid, weights: RealArray) -> tuple[RealArray, RealArray]:
    """The same of pixels from ``NEAR`` to ``FAR`` sides, by Gauss points."""
    (dx, dy), distance = grid.spacing, _distances(grid)
    side = max(dx, dy)
    i, j = np.nonzero((distance >= NEAR * side) & (distance < FAR * side))
    node, weight = rule(GAUSS)
    x = (i * dx)[:, None, None] + 0.5 * dx * node[:, None]
    r = np.hypot(x, (j * dy)[:, None, None] + 0.5 * dy * node)
    shares = weights[i, j][:, None, None] * weight[:, None] * weight * 0.25 * grid.pixel_area
    return r.ravel(), (shares / (2.0 * np.pi * r)).ravel()


def _near(grid: Grid, weights: RealArray) -> tuple[RealArray, RealArray]:
    """Distances and weights of the integral of the strength, of pixels within ``NEAR`` sides."""
    (nx, ny), (dx, dy), distance = grid.shape, grid.spacing, _distances(grid)
    side = max(dx, dy)
    near_x, near_y = reached(NEAR, side, dx, nx), reached(NEAR, side, dy, ny)
    part = np.where(distance[:near_x, :near_y] < NEAR * side, weights[:near_x, :near_y], 0.0)
    # differences of integrals from the origin to corners, and their mirror images
    whole = np.zeros((near_x + 1, near_y + 1))
    whole[1:, 1:] += part
    whole[:-1, 1:] -= part
    whole[1:, :-1] -= part
    whole[:-1, :-1] += part
    over_x = whole[:, 1:].copy()
    over_x[:, 0] -= whole[:, 0]
    quarter = over_x[1:].copy()
    quarter[0] -= over_x[0]
    quarter /= 2.0 * np.pi
    X, Y = np.broadcast_arrays((np.arange(near_x) + 0.5)[:, None] * dx, (np.arange(near_y) + 0.5)[None, :] * dy)
    distances, shares = [], []
    for length, width in ((X, Y), (Y, X)):
        triangle = triangle_rule(length, width)
        distances.append((length[..., None] / triangle.along).ravel())
        shares.append((quarter[..., None] * triangle.along * triangle.weight).ravel())
    return np.concatenate(distances), np.concatenate(shares)
