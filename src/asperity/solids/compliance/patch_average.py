"""Displacement under uniform traction on rectangular pixels from the response to a point force.

Three zones, by distance from the pixel in units of its longer side: the nearest pixels are integrated in polar
coordinates about the field point, which removes the singularity for any layer thickness; then 6 x 6 Gauss points; far away
five-point averages of the point response along each side.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...core.arrays import RealArray
from ...core.grid import Grid
from .point_kernel import PointKernel

NEAR = 3.0
"""Distance in pixel sides from which 6 x 6 Gauss points serve: their error there is below 1e-11 of the coefficient."""

FAR = 25.0
"""Distance in pixel sides from which five-point averages serve: their error there is about 0.7/FAR^6 = 3e-9."""

_GAUSS = 6
_PANEL = 1.5  # length in asinh(tan theta) on which 16 Gauss points of a function analytic in a strip of 1 give 1e-15
_PANEL_GAUSS = 16
_AVERAGE = np.array([-17.0, 308.0, 5178.0, 308.0, -17.0]) / 5760.0  # mean over a cell: 1 + d²/24 - 17 d⁴/5760


@dataclass(frozen=True)
class Angular:
    """Factor cos(m theta) or sin(m theta) as a function of (cos theta, sin theta), and whether it is even in x and y."""

    factor: Callable[[RealArray, RealArray], RealArray]
    even_x: bool
    even_y: bool


ISOTROPIC = Angular(lambda c, s: np.ones_like(c), even_x=True, even_y=True)
COS_1 = Angular(lambda c, s: c, even_x=False, even_y=True)
SIN_1 = Angular(lambda c, s: s, even_x=True, even_y=False)
COS_2 = Angular(lambda c, s: c * c - s * s, even_x=True, even_y=True)
SIN_2 = Angular(lambda c, s: 2.0 * s * c, even_x=False, even_y=False)


def patch_coefficients(kernel: PointKernel, grid: Grid, angular: Angular = ISOTROPIC) -> RealArray:
    """Displacement (m/Pa) at pixel offsets (0…nx-1, 0…ny-1) from a pixel under unit traction, for one component.

    The error is below 1e-8 of the coefficient, and where the response changes sign or dies out below 1e-8 of that of a
    half-space of the top layer's material.
    """
    (nx, ny), (dx, dy) = grid.shape, grid.spacing
    x, y = grid.coordinates()
    side = max(dx, dy)
    out = (
        _averages(kernel, grid, angular) if np.hypot((nx - 1) * dx, (ny - 1) * dy) > FAR * side else np.zeros((nx, ny))
    )
    distance = np.hypot(x[: _reach(FAR, side, dx, nx)], y[:, : _reach(FAR, side, dy, ny)])
    i, j = np.nonzero((distance >= NEAR * side) & (distance < FAR * side))
    out[i, j] = _gauss(kernel, i * dx, j * dy, grid, angular)
    i, j = np.nonzero(distance < NEAR * side)
    out[i, j] = _corner_sums(kernel, grid, angular)[i, j]
    return out


def _reach(limit: float, side: float, step: float, count: int) -> int:
    """Number of pixels of size ``step`` within ``limit`` sides, at most ``count``."""
    return min(count, int(limit * side / step) + 1)


def _values(kernel: PointKernel, x: RealArray, y: RealArray, angular: Angular) -> RealArray:
    """Point response at (x, y); its singularity at the origin is left out."""
    r = np.hypot(x, y)
    r[r == 0.0] = kernel.strength.start
    result = kernel.response(r)
    if angular is not ISOTROPIC:
        result *= angular.factor(x / r, y / r)
    return result


def _averages(kernel: PointKernel, grid: Grid, angular: Angular) -> RealArray:
    """Pixel means of the point response from its values at the five nearest nodes along x and along y."""
    (nx, ny), (dx, dy) = grid.shape, grid.spacing
    x, y = np.arange(-2, nx + 2)[:, None] * dx, np.arange(-2, ny + 2)[None, :] * dy
    values = _values(kernel, x, y, angular)
    along_x = sum(w * values[k : k + nx] for k, w in enumerate(_AVERAGE))
    mean: RealArray = sum(w * along_x[:, k : k + ny] for k, w in enumerate(_AVERAGE))
    return mean * grid.pixel_area


def _gauss(kernel: PointKernel, x: RealArray, y: RealArray, grid: Grid, angular: Angular) -> RealArray:
    """Integral over the pixels around (x, y), 1-D arrays, by Gauss points."""
    node, weight = np.polynomial.legendre.leggauss(_GAUSS)
    dx, dy = grid.spacing
    points = _values(kernel, x[:, None, None] + 0.5 * dx * node[:, None], y[:, None, None] + 0.5 * dy * node, angular)
    result: RealArray = np.einsum("kij,i,j->k", points, weight, weight) * 0.25 * grid.pixel_area
    return result


def _corner_sums(kernel: PointKernel, grid: Grid, angular: Angular) -> RealArray:
    """Integral over the nearest pixels, from integrals over the rectangles between the origin and their corners."""
    (nx, ny), (dx, dy) = grid.shape, grid.spacing
    side = max(dx, dy)
    nx, ny = _reach(NEAR, side, dx, nx), _reach(NEAR, side, dy, ny)
    X, Y = (np.arange(nx) + 0.5)[:, None] * dx, (np.arange(ny) + 0.5)[None, :] * dy
    quarter = _rectangle(kernel, X, Y, angular)
    # the pixels at the origin reach half a side beyond it: mirror, with the sign of an integral from 0 to -X
    over_x = np.vstack([(-quarter[:1] if angular.even_x else quarter[:1]), quarter])
    whole = np.hstack([(-over_x[:, :1] if angular.even_y else over_x[:, :1]), over_x])
    sums: RealArray = np.diff(np.diff(whole, axis=0), axis=1)
    return sums


def _rectangle(kernel: PointKernel, X: RealArray, Y: RealArray, angular: Angular) -> RealArray:
    """Integral of the response over 0 < x < X, 0 < y < Y in polar coordinates, the radial one in closed form.

    Below the diagonal r ends at X/cos theta; with tan theta = sinh v, X/cos theta = X cosh v and d theta = dv/cosh v.
    """

    def triangle(length: RealArray, width: RealArray, *, exchanged: bool) -> RealArray:
        last = np.arcsinh(width / length)
        panels = int(np.ceil(last.max() / _PANEL))
        node, weight = np.polynomial.legendre.leggauss(_PANEL_GAUSS)
        share = (np.arange(panels)[:, None] + 0.5 * (node + 1.0)).ravel() / panels
        v = last[..., None] * share
        along, across = 1.0 / np.cosh(v), np.tanh(v)
        factor = angular.factor(across, along) if exchanged else angular.factor(along, across)
        values = kernel.moment(length[..., None] / along) * along * factor
        integral: RealArray = values @ np.tile(0.5 * weight / panels, panels) * last
        return integral

    X, Y = np.broadcast_arrays(X, Y)
    return (triangle(X, Y, exchanged=False) + triangle(Y, X, exchanged=True)) / (2.0 * np.pi)
