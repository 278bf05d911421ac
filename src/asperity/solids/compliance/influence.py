"""Influence coefficients: the deflection under loads on a point, a line and a pixel."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.interpolation import STEP, LogTable, log_grid, log_hankel, log_table
from ...core.quadrature import rule


def wavenumbers(given: ArrayLike) -> RealArray:
    """Wavenumbers > 0 (rad/m) as an array of any shape; one on a GPU as it is.

    InputError if one is not positive.
    """
    if getattr(given, "shape", ()) and not isinstance(given, np.ndarray):
        on_device: Any = given
        return cast(RealArray, on_device)
    q = np.asarray(given, dtype=float)
    if not np.all(q > 0.0):
        raise InputError(
            f"wavenumber of a compliance (rad/m) must be greater than zero, but is {q[~(q > 0.0)].flat[0]:g}. "
            "The displacement under a mean pressure is that of mean_mode()."
        )
    return q


# Displacement of a half-space under uniform pressure on a rectangle (Love 1929; Johnson 1985, eq.
# 3.25).


_FAR = 300.0  # sides; beyond it corner differences lose more digits than the multipole expansion


def patch_displacement(x: RealArray, y: RealArray, side_x: float, side_y: float) -> RealArray:
    """Surface displacement at (x, y) of a half-space with E' = 1 under unit pressure on a rectangle
    at the origin.

    ``x``, ``y``: coordinates of the field points in m, broadcast against each other; ``side_x``,
    ``side_y``: full sides of the rectangle in m, > 0.

    Returns
    -------
    RealArray
        u E' / p in m, shape of ``x + y``. The corner sum is Love's closed form in the
        cancellation-free asinh form; beyond 300 sides, where corner differences lose digits, the
        point load with second moments is used (relative error below 1e-9 everywhere).
    """
    a, b = 0.5 * side_x, 0.5 * side_y
    x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    corners = _corner(x + a, y + b) - _corner(x + a, y - b) - _corner(x - a, y + b) + _corner(x - a, y - b)
    r = np.hypot(x, y)
    distant = r > _FAR * max(side_x, side_y)
    far = np.where(distant, r, 1.0)
    xx, yy = (x / far) ** 2, (y / far) ** 2
    moments = 1.0 + (a**2 * (3.0 * xx - 1.0) + b**2 * (3.0 * yy - 1.0)) / (6.0 * far**2)
    near_field: RealArray = corners / np.pi
    return np.where(distant, 4.0 * a * b / (np.pi * far) * moments, near_field)


def _corner(x: RealArray, y: RealArray) -> RealArray:
    """X asinh(Y/|X|) + Y asinh(X/|Y|), with its limit 0 on the axes."""
    tiny = 1e-290
    ax, ay = np.maximum(np.abs(x), tiny), np.maximum(np.abs(y), tiny)
    return x * np.arcsinh(y / ax) + y * np.arcsinh(x / ay)


# Surface response to a point force from its spectrum, for laterally isotropic bodies of any
# structure.
#
# A compliance C(alpha) that multiplies cos(m phi) (phi: direction of the wavevector) belongs to the
# point response k(r) cos(m theta) with, up to the factor i^m,
#
# k(r) = 1/(2 pi) ∫ C(alpha) J_m(alpha r) alpha d alpha = E(r) / (2 pi r),
#
# where E, the local value of alpha C, runs smoothly from its limit at short wavelengths (near
# field, top layer) to that at long ones (far field, base). Both limits are removed in closed form:
# C = high/alpha + (low - high) exp(-alpha d)/alpha
# + remainder. A homogeneous half-space has E = alpha C = constant.


COUNT = 8192
"""Nodes of the grids of wavenumber and distance, 85 e-folds: the alias of a tail 1/r is exp(-42) =
4e-19."""


def wavenumber_grid(length: float) -> RealArray:
    """Logarithmic grid (COUNT,) of wavenumbers around 1/``length`` (m)."""
    return log_grid(np.exp(-COUNT // 2 * STEP) / length, COUNT)


@dataclass(frozen=True, eq=False)
class PointKernel:
    """Response k(r) = E(r)/(2 pi r) of angular ``order`` m.

    ``strength`` E(r) in m²/N·m; ``moment`` the integral of E from 0 to r, both tables over r in m.
    """

    order: int
    strength: LogTable
    moment: LogTable

    def response(self, r: RealArray) -> RealArray:
        """k(r) in m/N at distances ``r`` > 0 in m."""
        return self.strength(r) / (2.0 * np.pi * r)


@dataclass(frozen=True)
class Limits:
    """Limits of alpha C (1/Pa) at short (``high``) and long (``low``) wavelengths, and a ``depth``
    d (m) between them."""

    high: float
    low: float
    depth: float


def point_kernel(values: RealArray, limits: Limits, order: int = 0) -> PointKernel:
    """Kernel of the compliance with ``values`` of alpha C (1/Pa) on
    ``wavenumber_grid(limits.depth)``.

    The error of E is about 1e-13 of the larger limit: rounding, and the interpolation of the
    tables.
    """
    d, jump = limits.depth, limits.low - limits.high
    alpha = wavenumber_grid(d)
    remainder = log_hankel(values - limits.high - jump * np.exp(-alpha * d), order)
    r = 1.0 / alpha[::-1]
    root = np.hypot(r, d)
    strength = limits.high + jump * r / root * (r / (root + d)) ** order + remainder
    start = float(r[0])
    moment = log_table(start, strength * r)
    moment = moment.integral(float(strength[0]) * moment.start)
    return PointKernel(order, log_table(start, strength), moment)


# Displacement under uniform traction on rectangular pixels from the response to a point force.
#
# Three zones, by distance from the pixel in units of its longer side: the nearest pixels are
# integrated in polar coordinates about the field point, which removes the singularity for any layer
# thickness; then 6 x 6 Gauss points; far away five-point averages of the point response along each
# side.


NEAR = 3.0
"""Distance in pixel sides from which 6 x 6 Gauss points serve: their error there is below 1e-11 of
the coefficient."""

FAR = 25.0
"""Distance in pixel sides from which five-point averages serve: their error there is about
0.7/FAR^6 = 3e-9."""

GAUSS = 6
_PANEL = 1.5  # length in asinh(tan theta) on which 16 Gauss points of a function analytic in a strip of 1 give 1e-15
_PANEL_GAUSS = 16
AVERAGE = np.array([-17.0, 308.0, 5178.0, 308.0, -17.0]) / 5760.0  # mean over a cell: 1 + d²/24 - 17 d⁴/5760


@dataclass(frozen=True)
class Angular:
    """Factor cos(m theta) or sin(m theta) as a function of (cos theta, sin theta), and whether it
    is even in x and y."""

    factor: Callable[[RealArray, RealArray], RealArray]
    even_x: bool
    even_y: bool


ISOTROPIC = Angular(lambda c, s: np.ones_like(c), even_x=True, even_y=True)
COS_1 = Angular(lambda c, s: c, even_x=False, even_y=True)
SIN_1 = Angular(lambda c, s: s, even_x=True, even_y=False)
COS_2 = Angular(lambda c, s: c * c - s * s, even_x=True, even_y=True)
SIN_2 = Angular(lambda c, s: 2.0 * s * c, even_x=False, even_y=False)


def patch_coefficients(kernel: PointKernel, grid: Grid, angular: Angular = ISOTROPIC) -> RealArray:
    """Displacement (m/Pa) at pixel offsets (0…nx-1, 0…ny-1) from a pixel under unit traction, for
    one component.

    The error is below 1e-8 of the coefficient, and where the response changes sign or dies out
    below 1e-8 of that of a half-space of the top layer's material.
    """
    (nx, ny), (dx, dy) = grid.shape, grid.spacing
    side = max(dx, dy)
    out: RealArray = np.zeros((nx, ny))
    if np.hypot((nx - 1) * dx, (ny - 1) * dy) > FAR * side:  # means over the five nearest nodes along x and along y
        x, y = np.arange(-2, nx + 2)[:, None] * dx, np.arange(-2, ny + 2)[None, :] * dy
        values = _values(kernel, x, y, angular)
        along_x = sum(w * values[k : k + nx] for k, w in enumerate(AVERAGE))
        mean: RealArray = sum(w * along_x[:, k : k + ny] for k, w in enumerate(AVERAGE))
        out = mean * grid.pixel_area

    x, y = grid.coordinates()
    distance = np.hypot(x[: reached(FAR, side, dx, nx)], y[:, : reached(FAR, side, dy, ny)])
    i, j = np.nonzero((distance >= NEAR * side) & (distance < FAR * side))
    node, weight = rule(GAUSS)
    across_x, across_y = 0.5 * dx * node[:, None], 0.5 * dy * node
    points = _values(kernel, (i * dx)[:, None, None] + across_x, (j * dy)[:, None, None] + across_y, angular)
    out[i, j] = np.einsum("kij,i,j->k", points, weight, weight) * 0.25 * grid.pixel_area

    i, j = np.nonzero(distance < NEAR * side)
    near_x, near_y = reached(NEAR, side, dx, nx), reached(NEAR, side, dy, ny)
    X, Y = np.broadcast_arrays((np.arange(near_x) + 0.5)[:, None] * dx, (np.arange(near_y) + 0.5)[None, :] * dy)
    below = _triangle(kernel, X, Y, angular.factor)
    above = _triangle(kernel, Y, X, lambda along, across: angular.factor(across, along))
    quarter = (below + above) / (2.0 * np.pi)  # between the origin and the far corners of the pixels
    # the pixels at the origin reach half a side beyond it: mirror, with the sign of an integral
    # from 0 to -X
    over_x = np.vstack([(-quarter[:1] if angular.even_x else quarter[:1]), quarter])
    whole = np.hstack([(-over_x[:, :1] if angular.even_y else over_x[:, :1]), over_x])
    out[i, j] = np.diff(np.diff(whole, axis=0), axis=1)[i, j]
    return out


def reached(limit: float, side: float, step: float, count: int) -> int:
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


def _triangle(
    kernel: PointKernel, length: RealArray, width: RealArray, factor: Callable[[RealArray, RealArray], RealArray]
) -> RealArray:
    """2 pi times the integral of the response over 0 < x < ``length`` below the diagonal to
    ``width``, the radial one in closed form.

    r ends at X/cos theta; with tan theta = sinh v, X/cos theta = X cosh v and d theta = dv/cosh v.
    """
    along, across, weight = triangle_rule(length, width)
    values = kernel.moment(length[..., None] / along) * along * factor(along, across)
    return np.asarray((values * weight).sum(axis=-1))


class TriangleRule(NamedTuple):
    """Quadrature over the angle of triangles: cosine ``along`` the axis, sine ``across`` it, and
    ``weight``, each (*shape of the lengths, points)."""

    along: RealArray
    across: RealArray
    weight: RealArray


def triangle_rule(length: RealArray, width: RealArray) -> TriangleRule:
    """Rule for the triangles 0 < x < ``length`` below the diagonal to ``width``."""
    last = np.arcsinh(width / length)
    panels = int(np.ceil(last.max() / _PANEL))
    node, weight = rule(_PANEL_GAUSS)
    share = (np.arange(panels)[:, None] + 0.5 * (node + 1.0)).ravel() / panels
    v = last[..., None] * share
    return TriangleRule(1.0 / np.cosh(v), np.tanh(v), last[..., None] * np.tile(0.5 * weight / panels, panels))


# Plane strain: surface displacement of strips along y, from the spectrum of the body.
#
# A line force gives u(x) with x du/dx = -L(x)/pi, L(x) = ∫ alpha C sin(alpha x) x d(alpha), which
# runs from alpha C at short wavelengths to alpha C at long ones. On a half-space base u grows like
# -ln x for ever (Flamant 1892): the plane problem fixes it up to a constant only, and the
# displacement at a stated distance, the datum, is called zero.


@dataclass(frozen=True, eq=False)
class LineKernel:
    """``descent``, the integral of L/x, and ``moment``, the integral of L, both from 0 (1/Pa,
    m/Pa), over x in m.

    ``infinity`` is the distance (m) that serves as datum on a rigid base; infinite on a half-space,
    where none serves.
    """

    descent: LogTable
    moment: LogTable
    infinity: float


_DIED_OUT = 1e4
"""Distance over thickness of the layers at which displacements on a rigid base are zero: they fall
exponentially, over 30 thicknesses where a film is a million times stiffer than what it lies on."""


def line_kernel(values: RealArray, limits: Limits) -> LineKernel:
    """Kernel of the compliance with ``values`` of alpha C (1/Pa) on
    ``wavenumber_grid(limits.depth)``.

    sin z = sqrt(pi z/2) J_1/2(z) makes L a Hankel transform.
    """
    d, jump = limits.depth, limits.low - limits.high
    alpha = wavenumber_grid(d)
    x = 1.0 / alpha[::-1]
    remainder = values - limits.high - jump * np.exp(-alpha * d)
    wave = np.sqrt(0.5 * np.pi * x) * log_hankel(remainder * np.sqrt(alpha), 0.5)
    slope = limits.high + jump * x**2 / (x**2 + d**2) + wave
    start = float(x[0])
    moment = log_table(start, slope * x)
    moment = moment.integral(float(slope[0]) * moment.start)
    return LineKernel(log_table(start, slope).integral(), moment, infinity=np.inf if limits.low else _DIED_OUT * d)


def strip_coefficients(kernel: LineKernel, grid: Grid, datum: float) -> RealArray:
    """Displacement (m/Pa), shape (nx, 1), at offsets (0…nx-1) dx from a strip of width dx under
    unit pressure.

    It is relative to that at the distance ``datum`` (m) from a line load; on a rigid base relative
    to the base. With the descent D and the moment M, the integral of u from 0 to X is [X
    (D(datum) - D(X)) + M(X)]/pi.
    """
    zero = kernel.descent(np.array([datum if kernel.infinity == np.inf else kernel.infinity]))
    edge = (np.arange(grid.shape[0]) + 0.5) * grid.spacing[0]
    integral: RealArray = (edge * (zero - kernel.descent(edge)) + kernel.moment(edge)) / np.pi
    differences: RealArray = np.diff(integral, prepend=-integral[0])  # odd: the first strip reaches from -edge to edge
    return differences[:, None]


# Plane strain: integrals of the response to a line load, for any even or odd amplitude of the
# wavenumber.
#
# The amplitude is split into (b/α + a) exp(-αd) in closed form, which carries the slow decay, and a
# remainder by logarithmic Hankel transform.


_SMALL = 1e-5  # of the wavenumber 1/d, where the constant term of an amplitude can be read off


@dataclass(frozen=True, eq=False)
class LineIntegral:
    """∫ of the line response K from 0 to x: (b/α + a) exp(-αd) in closed form, and a table of the
    remainder."""

    b: float
    a: float
    d: float
    cosine: bool
    kernel: LogTable
    moment: LogTable

    def __call__(self, x: RealArray) -> RealArray:
        """Integral at x > 0 in m."""
        angle, log = np.arctan(x / self.d), np.log(x**2 + self.d**2)
        if self.cosine:
            closed = self.b * (x - 0.5 * x * log - self.d * angle) + self.a * angle
        else:
            rise = 0.5 * (log - 2.0 * np.log(self.d))
            closed = self.b * (x * angle - self.d * rise) + self.a * rise
        return np.asarray(closed / np.pi + self.moment(x))

    def slope(self, x: float) -> float:
        """K at x > 0 of a cosine response."""
        square = x**2 + self.d**2
        closed = -0.5 * self.b * np.log(square) + self.a * self.d / square
        return float(closed / np.pi + self.kernel(np.array([x]))[0])


def line_integral(alpha: RealArray, amplitude: RealArray, d: float, *, cosine: bool) -> LineIntegral:
    """Integral of 1/π ∫ F cos αx dα, or of the sine, for the ``amplitude`` F on
    ``wavenumber_grid(d)``.

    cos z = sqrt(πz/2) J_-1/2(z) and sin z with J_1/2 make it a Hankel transform.
    """
    b = float((alpha * amplitude)[0])
    small = int(np.searchsorted(alpha, _SMALL / d))
    a = float(amplitude[small] - b / alpha[small] * np.exp(-alpha[small] * d))
    rest = amplitude - (b / alpha + a) * np.exp(-alpha * d)
    x = 1.0 / alpha[::-1]
    kernel = log_hankel(rest * np.sqrt(alpha), -0.5 if cosine else 0.5) * np.sqrt(0.5 / (np.pi * x))
    start = float(x[0])
    moment = log_table(start, kernel * x)
    moment = moment.integral(float(kernel[0]) * moment.start)
    return LineIntegral(b, a, d, cosine, log_table(start, kernel), moment)
