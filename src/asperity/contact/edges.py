"""Where the edge of a contact runs between pixels, and the real area, perimeter and spots that
follow, freed of the size of the pixels; the largest pressure between them.

Near its edge the pressure of a contact without adhesion is k √δ and the gap 4k/(3E*) δ^(3/2) at a
distance δ inside and outside. What pixels hold there depends on the place of the edge between their
centres alone (``edge_tables``). It follows from the ratio of the last two pressures, which looks
inwards, and from that of the first gap to a pressure, which looks across the edge; errors by the
curvature of the profile are opposite in the two and nearly cancel in their mean. Half of their
difference is the error.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import BoolArray, RealArray
from ..core.grid import Grid
from .edge_tables import EdgePixels
from .measure import labelled

Indices = NDArray[np.intp]

REACH = 2
"""Pixels to each side of an edge pixel from which the normal of the edge is taken."""

LEAST_COSINE = 0.3
"""Least cosine of edge normal and grid axis with which a gap is scaled: along an edge it tells
nothing of its place."""

FACTOR = 0.04
"""Error in pixels of the tables for edges that are oblique and curved, of one sign along a whole
edge."""

SINGLE, SINGLE_FACTOR = 0.25, 0.2
"""Errors in pixels of the place, random and of one sign, where a contact is one pixel across."""

CAPPED, CAPPED_FACTOR = 0.06, 0.01
"""Errors in pixels of the place, random and of one sign, at a pixel whose pressure is at its limit:
the edge may lie anywhere in it."""

LEAST_RIGID = -0.3
"""Least place in pixels of an edge that the pressure reaches at its limit."""

RANDOM = 0.05
"""Random error in pixels of each place beside the spread of its estimates."""

PINNED, PINNED_ERROR = -0.17, 0.33
"""Pixels per edge between counted and true area of a contact whose attraction has no range, and
their error: the grid holds its edge, and what it does depends on the history (spheres of 4 to 24
pixels against the exact JKR)."""


SAME_LIMIT = 1e-6
"""Relative difference of two pressures at the same limit."""

LEAST_SPOT = 1.0 / 16.0
"""Least area in pixels of a spot: what single pixels, barely in contact, hold is not told apart
from nothing."""


LARGEST_SHIFT = 0.7
"""Pixels that the vertex may lie from the largest pixel along an axis."""

LEAST_ERROR, CURVED = 0.005, 0.25
"""Error over the pressure at the pixel: the least one, and by the relative fall of its square to
the four neighbours."""


@dataclass(frozen=True, eq=False)
class Edges:
    """Pairs of neighbours of which one is in contact and the other not, (n,) each.

    Attributes
    ----------
    grid
        The grid.
    inner, outer
        Number of the pixel in contact and of the one that is not, in the flat order of the grid;
        ``outer`` is that of ``inner`` where beyond the border of a free boundary there is none.
    axis
        0 for neighbours along x, 1 along y.
    sign
        Whether ``outer`` comes after ``inner`` (1) or before (-1).
    normal
        (n, 2): outward normal of the edge.
    distance
        Distance along the axis of the edge beyond the centre of the pixel in contact, in pixels.
    spread
        Random error of that in pixels; half the difference of two estimates with its sign where
        there are two.
    factor
        Error in pixels that the pairs along an edge share.
    two
        Whether both estimates were there: the next pixel inwards is in contact too, and this one is
        not at the limit of the pressure.
    deep
        Whether the next pixel inwards is in contact too.
    beyond
        Whether there is no pixel outside.
    weight
        Share of the area between edge and pixel border that a pair counts: pairs along both axes
        measure the same edge.
    """

    grid: Grid
    inner: Indices
    outer: Indices
    axis: NDArray[np.int8]
    sign: NDArray[np.int8]
    normal: RealArray
    distance: RealArray
    spread: RealArray
    factor: RealArray
    two: BoolArray
    deep: BoolArray
    beyond: BoolArray
    weight: RealArray
    contact: BoolArray
    wraps: tuple[bool, bool]

    @cached_property
    def spot_pixels(self) -> NDArray[np.int64]:
        """Number of pixels in the spot to which each pair belongs, (n,)."""
        labels, _ = labelled(self.contact, wraps=self.wraps)
        flat = labels.ravel()
        return np.bincount(flat)[flat[self.inner]]

    @property
    def cosine(self) -> RealArray:
        """Cosine of normal and axis, (n,); one beyond the border of the grid."""
        along = np.where(self.axis == 0, self.normal[:, 0], self.normal[:, 1])
        return np.where(self.beyond, 1.0, np.abs(along))

    @property
    def excess(self) -> RealArray:
        """Area in pixels beyond the pixels in contact, (n,)."""
        return self.weight * (self.distance - 0.5)

    def perimeter(self) -> float:
        """Length of all edges in m."""
        dx, dy = self.grid.spacing
        return float((self.cosine * np.where(self.axis == 0, dy, dx)).sum())

    def area_error(self) -> float:
        """Error in pixels of the area: what all pairs share, and what is random, two standard
        deviations."""
        weight, spread = self.weight, np.where(self.two, self.spread, 0.0)
        shared = abs(float((weight * spread).sum())) + float((weight * self.factor).sum())
        scatter = np.where(self.beyond, 0.0, weight**2 * (self.spread**2 + RANDOM**2))
        return float(np.hypot(shared, 2.0 * np.sqrt(scatter.sum())))


class Outside(NamedTuple):
    """Pairs as in ``Edges``, before anything is known of the edge."""

    inner: Indices
    outer: Indices
    axis: NDArray[np.int8]
    sign: NDArray[np.int8]
    beyond: BoolArray


def _pairs(contact: BoolArray, wraps: tuple[bool, bool]) -> Outside:
    """Neighbours of which one is in ``contact`` (nx, ny)."""
    numbers = np.arange(contact.size).reshape(contact.shape)
    found: list[tuple[Any, ...]] = []
    for axis in (0, 1):
        touching, number = (np.moveaxis(a, axis, 0) for a in (contact, numbers))
        for sign in (1, -1):
            low, high = (slice(None, -1), slice(1, None))[::sign]
            changes = touching[low] & ~touching[high]
            pairs = [(number[low][changes], number[high][changes], False)]
            last, first = (-1, 0)[::sign]
            if wraps[axis]:
                ends = touching[last] & ~touching[first]
                pairs.append((number[last][ends], number[first][ends], False))
            else:
                pairs.append((number[last][touching[last]],) * 2 + (True,))
            found += [(inner, outer, axis, sign, beyond) for inner, outer, beyond in pairs]
    sizes = [each[0].size for each in found]
    axes, signs, beyond = (np.repeat([each[k] for each in found], sizes) for k in (2, 3, 4))
    inner, outer = (np.concatenate([each[k] for each in found]) for k in (0, 1))
    return Outside(inner, outer, axes.astype(np.int8), signs.astype(np.int8), beyond)


def neighbours(
    at: Indices, steps: tuple[Any, Any], shape: tuple[int, int], wraps: tuple[bool, bool]
) -> tuple[Indices, BoolArray]:
    """Numbers (n,) of the pixels some ``steps`` (along x, along y) from those ``at`` (n,), and
    whether they are on the grid."""
    inside, places = np.ones(at.size, dtype=bool), []
    for place, step, size, wrap in zip(np.divmod(at, shape[1]), steps, shape, wraps, strict=True):
        moved = place + step
        if wrap:
            moved %= size
        else:
            inside &= (moved >= 0) & (moved < size)
            np.clip(moved, 0, size - 1, out=moved)
        places.append(moved)
    return places[0] * shape[1] + places[1], inside


def _normals(at: Indices, p: RealArray, grid: Grid, wraps: tuple[bool, bool]) -> RealArray:
    """Outward normals (n, 2) at pixels of contact: down the plane through p² of the pixels in
    contact around, (5, 5).

    Where p² is level, as at the limit of the pressure, away from the middle of the pixels in
    contact; zero where that tells nothing either.
    """
    n, (dx, dy) = at.size, grid.spacing
    reach = [REACH if size > 1 else 0 for size in grid.shape]
    unit = min(grid.pixels)
    flat_p = p.ravel()
    count, x, y, q, xx, yy, xy, xq, yq = np.zeros((9, n))
    most = np.zeros(n)
    for i in range(-reach[0], reach[0] + 1):
        for j in range(-reach[1], reach[1] + 1):
            number, inside = neighbours(at, (i, j), grid.shape, wraps)
            square = np.where(inside, flat_p[number].astype(np.float64), 0.0) ** 2
            counts = square > 0.0
            a, b = i * dx / unit, j * dy / unit
            count += counts
            x += a * counts
            y += b * counts
            xx += a * a * counts
            yy += b * b * counts
            xy += a * b * counts
            q += square
            xq += a * square
            yq += b * square
            np.maximum(most, square, out=most)
    mean_x, mean_y, mean_q = x / count, y / count, q / count
    xx, yy, xy = xx - x * mean_x, yy - y * mean_y, xy - x * mean_y
    xq, yq = xq - x * mean_q, yq - y * mean_q
    determinant, trace = xx * yy - xy * xy, xx + yy
    plane = determinant > 1e-9 * trace * trace
    safe, line = np.where(plane, determinant, 1.0), np.where(trace > 0.0, trace, 1.0)
    slope_x = np.where(plane, (yy * xq - xy * yq) / safe, xq / line)
    slope_y = np.where(plane, (xx * yq - xy * xq) / safe, yq / line)
    steep = np.hypot(slope_x, slope_y)
    level = steep <= 1e-6 * most
    along_x, along_y = np.where(level, mean_x, slope_x), np.where(level, mean_y, slope_y)
    length = np.hypot(along_x, along_y)
    length = np.where(length > 0.0, length, np.inf)
    return -np.stack([along_x / length, along_y / length], axis=1)


class Kind(Enum):
    """What an edge is like."""

    elastic = "pressure k √δ"
    pinned = "attraction without a range, or one that the grid does not resolve: the pressure is infinite at the edge"
    smooth = "attraction with a core instead of a wall: the pressure passes through zero"


class Setting(NamedTuple):
    """What the edges of a contact depend on beside its fields.

    ``wraps``: whether the opposite side lies beyond the border, along x and along y; else nothing.
    ``modulus``: E* in Pa of both bodies at the surface, of viscoelastic ones that of the first
    instant, for at an edge the stress changes fastest. ``table``: of the discretisation.
    """

    grid: Grid
    wraps: tuple[bool, bool]
    modulus: float
    table: EdgePixels
    kind: Kind = Kind.elastic


def edges_of(p: RealArray, gap: RealArray, plastic: BoolArray, setting: Setting) -> Edges:
    """Edges of a contact of the pressure ``p`` (nx, ny) in Pa and the ``gap`` (nx, ny) in m, whose
    pressure is at its limit where it is ``plastic``.

    The place of all but elastic edges is known by their mean alone.
    """
    grid, wraps = setting.grid, setting.wraps
    pairs = _pairs(p > 0.0, wraps)
    at, first = np.unique(pairs.inner, return_inverse=True)
    normal = _normals(at, p, grid, wraps)[first]
    normal = np.where(np.any(normal != 0.0, axis=1)[:, None], normal, np.sqrt(0.5))
    along = np.where(pairs.axis == 0, normal[:, 0], normal[:, 1])
    cosine = np.where(pairs.beyond, 1.0, np.abs(along))
    weight = cosine**2
    none = np.zeros(weight.size)
    if setting.kind is Kind.elastic:
        places = _pressed(pairs, cosine, setting, p, gap, plastic)
    elif setting.kind is Kind.pinned:
        weight = np.ones(weight.size)
        places = Places(none + 0.5 + PINNED, none, none + PINNED_ERROR, none > 0.0, none > 0.0)
    else:
        places = Places(none + 0.5, none + math.sqrt(1.0 / 12.0), none, none > 0.0, none > 0.0)
    beyond = pairs.beyond
    ends = (0.5, 0.0, 0.0, False, False)
    places = Places(*(np.where(beyond, end, found) for end, found in zip(ends, places, strict=True)))
    return Edges(
        grid, pairs.inner, pairs.outer, pairs.axis, pairs.sign, normal, *places, beyond, weight, p > 0.0, wraps
    )


class Places(NamedTuple):
    """Distance of the edge, its random error and that of one sign, whether there were two
    estimates, and a second pixel, (n,) each as in ``Edges``."""

    distance: RealArray
    spread: RealArray
    factor: RealArray
    two: BoolArray
    deep: BoolArray


def _pressed(
    pairs: Outside, cosine: RealArray, setting: Setting, p: RealArray, gap: RealArray, plastic: BoolArray
) -> Places:
    """Where the edges of a pressed contact are, from the ``cosine`` of their normals, in pixels
    beyond the centre of the last one in contact."""
    flat, (grid, wraps, modulus, table, _) = plastic.ravel(), setting
    steps = -pairs.sign * (pairs.axis == 0), -pairs.sign * (pairs.axis == 1)
    behind, inside = neighbours(pairs.inner, steps, grid.shape, wraps)
    last, second = (p.ravel()[number].astype(np.float64) for number in (pairs.inner, behind))
    deep = inside & (second > 0.0)
    pixel = np.asarray(grid.spacing)[pairs.axis]
    opening = 0.75 * modulus * gap.ravel()[pairs.outer] / (np.maximum(cosine, LEAST_COSINE) * pixel)
    # by ratios that do not contain k of the edge: of the last two pressures, of the gap of the
    # first pixel outside, as the square root of its cube in units of pressure, and the second
    # pressure, and of that and the last pressure
    beyond, one, two, free = table
    below = np.where(deep, second, last)
    inwards = np.interp(last / below, np.sqrt(one / two), beyond)
    across = np.interp(np.cbrt((opening / below) ** 2), (free / np.cbrt(two))[::-1], beyond[::-1])
    single = np.interp(last**2 / (last**2 + opening**2), one / (one + free**3), beyond)
    distance = np.where(deep, 0.5 * (inwards + across), single)
    spread = np.where(deep, 0.5 * (inwards - across), SINGLE)
    factor = np.where(deep, FACTOR, SINGLE_FACTOR)
    if not flat.any():
        return Places(distance, spread, factor, deep, deep)
    here = flat[pairs.inner]
    next_one = deep & flat[behind] & ~here
    rigid = np.maximum(last / below - 0.5, LEAST_RIGID)  # pressure at its limit up to an edge within the pixel
    distance = np.where(here, 0.5, np.where(next_one, single, distance))
    spread = np.where(here, CAPPED, np.where(next_one, 0.5 * (single - rigid), spread))
    factor = np.where(here, CAPPED_FACTOR, factor)
    return Places(distance, spread, factor, deep & ~here, deep)


@dataclass(frozen=True, eq=False)
class RealArea:
    """Real contact area by the place of the edges.

    Attributes
    ----------
    spots
        Area in m² of every contact spot (pixels joined by their sides), largest first.
    error
        Error in m² of the sum: what all edges share in the worst case, and two standard deviations
        of what is random.
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


def real_area(pressure: RealArray, plastic: BoolArray, edges: Edges, wraps: tuple[bool, bool]) -> RealArea:
    """Real area of a contact with these fields, (nx, ny) each, and its ``edges`` in a map that
    ``wraps`` along x and along y.

    A spot with pixels at the limit H of the pressure is at least as large as its force over H,
    which is exact for any contact.
    """
    grid, contact = edges.grid, pressure > 0.0
    labels, count = labelled(contact, wraps=wraps)
    if count == 0:
        return RealArea(np.zeros(0), 0.0, 0.0)
    flat, touching = labels.ravel(), np.flatnonzero(contact)
    spot = flat[touching]  # of each point in contact, few of all
    found = np.bincount(spot, minlength=count + 1).astype(float)
    found += np.bincount(flat[edges.inner], edges.excess, minlength=count + 1)
    least = np.full(count + 1, LEAST_SPOT)
    if plastic.any():
        p, capped = pressure.ravel(), plastic.ravel()
        force = np.bincount(spot, p[touching].astype(np.float64), minlength=count + 1)
        # pressure (count + 1,) that no point of a spot exceeds; infinite where the limit varies and
        # none of its pixels is at it
        at_limit = p[capped].astype(np.float64)
        limits = np.full(count + 1, float(at_limit.max()))
        if float(at_limit.min()) < float(at_limit.max()) * (1.0 - SAME_LIMIT):
            highest, reached = np.zeros(count + 1), np.zeros(count + 1, dtype=bool)
            np.maximum.at(highest, spot, p[touching])
            reached[flat[capped]] = True
            limits = np.where(reached, highest, np.inf)
        np.maximum(least, force / limits, out=least)
    spots = np.sort(np.maximum(found, least)[1:])[::-1]
    spots *= min(1.0, grid.n_points / spots.sum())
    return RealArea(spots * grid.pixel_area, edges.area_error() * grid.pixel_area, edges.perimeter())


# Between the pixels inside a contact.


class PeakPressure(NamedTuple):
    """Largest pressure ``value`` in Pa, its ``error`` (zero at a hardness, NaN in ``doubt``), and
    where it is, x and y in m as those of the grid's nodes.

    ``doubt`` is empty, or says why the value is but that of the largest pixel.
    """

    value: float
    error: float
    x: float
    y: float
    doubt: str = ""


def peak_pressure(p: RealArray, plastic: BoolArray, grid: Grid, wraps: tuple[bool, bool]) -> PeakPressure:
    """Largest of the pressure ``p`` (nx, ny) in Pa, which is at its limit where it is ``plastic``.

    Of p² at the largest pixel and its neighbours the vertex of the quadratic. The error held the
    truth in all of 546 spheres from 1.5 pixels in the radius on.
    """
    place = tuple(int(k) for k in np.unravel_index(int(np.argmax(p)), p.shape))
    highest, (dx, dy) = float(p[place]), grid.spacing
    x, y = place[0] * dx, place[1] * dy
    if plastic[place]:
        return PeakPressure(highest, 0.0, x, y)
    lines = []
    for at, size, wrap in zip(place, p.shape, wraps, strict=True):
        line = np.array([at - 1, at, at + 1]) if size > 1 else np.array([at])
        if not wrap and not (line[0] >= 0 and line[-1] < size):
            return PeakPressure(highest, math.nan, x, y, "it lies at the border of the grid")
        lines.append(line % size)
    around = p[np.ix_(*lines)].astype(np.float64)
    if not (around > 0.0).all() or plastic[np.ix_(*lines)].any():
        return PeakPressure(highest, math.nan, x, y, "a pixel beside it is out of contact or at the hardness")
    square = around**2
    middle = tuple(size // 2 for size in square.shape)
    top = vertex = float(square[middle])
    slope, curve, shift, neighbours = np.zeros(2), -np.ones(2), np.zeros(2), list[float]()
    for axis in (0, 1):
        if square.shape[axis] == 3:
            low, _, high = np.take(square, middle[1 - axis], 1 - axis).tolist()
            slope[axis], curve[axis] = 0.5 * (high - low), high - 2.0 * top + low
            neighbours += [low, high]
    mixed = 0.25 * (square[2, 2] - square[2, 0] - square[0, 2] + square[0, 0]) if square.shape == (3, 3) else 0.0
    hessian = np.array([[curve[0], mixed], [mixed, curve[1]]])
    if np.linalg.det(hessian) > 0.0 and curve[0] < 0.0:
        shift = np.clip(-np.linalg.solve(hessian, slope), -LARGEST_SHIFT, LARGEST_SHIFT)
        vertex = top + float(slope @ shift) + 0.5 * float(shift @ hessian @ shift)
    value = math.sqrt(max(vertex, 0.0))
    fall = 1.0 - float(np.mean(neighbours)) / highest**2 if neighbours else 0.0
    error = abs(value - highest) + (LEAST_ERROR + CURVED * fall) * highest
    return PeakPressure(value, error, x + float(shift[0]) * dx, y + float(shift[1]) * dy)
