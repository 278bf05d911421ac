"""What is measured on a map with the mouse: profiles along lines, readings between two cursors, and
regions that are drawn to be masked."""

from __future__ import annotations

import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import AsperityError
from ..core.units import show
from ..io.schemas.surfaces import REGION_TABLES
from ..surfaces.characterise.heights import mean_absolute_height, peak_to_valley, rms_height
from ..surfaces.prepare.level import levelled
from ..surfaces.prepare.regions import Ellipse, Polygon, Rectangle
from ..surfaces.profile import Profile

Point = tuple[float, float]
"""Place on a map in m from its corner."""

# Profiles along lines.


@dataclass(frozen=True, eq=False)
class Section:
    """Heights along a straight line on a map.

    Attributes
    ----------
    start, end
        Its ends in m from the corner of the map, which stand in the middle of pixels.
    distance
        (n,) distances of its points from the start in m.
    heights
        (n,) heights in m; NaN where one of the points of the map around is missing.
    """

    start: Point
    end: Point
    distance: RealArray
    heights: RealArray

    @property
    def length(self) -> float:
        """From end to end, in m."""
        return float(self.distance[-1])

    def csv(self) -> str:
        """Distance, place and height of every point, with a line of names and units before."""
        share = self.distance / (self.length or 1.0)
        x, y = (a + share * (b - a) for a, b in zip(self.start, self.end, strict=True))
        text = io.StringIO()
        np.savetxt(
            text,
            np.column_stack([self.distance, x, y, self.heights]),
            fmt="%.12g",
            delimiter=",",
            header="distance (m),x (m),y (m),height (m)",
            comments="",
        )
        return text.getvalue()


def section(heights: RealArray, spacing: Point, start: Point, end: Point) -> Section:
    """Profile of ``heights`` (nx, ny) in m, on pixels of that ``spacing`` in m, from ``start`` to
    ``end``, which are moved to the middle of the nearest pixels.

    There is a point for every pixel along the longer of its two components: along a row or column
    its heights are those of the map, elsewhere linear between four points of it.
    """
    ends = []
    for place in (start, end):
        index = (round(at / step - 0.5) for at, step in zip(place, spacing, strict=True))
        ends.append([min(max(i, 0), count - 1) for i, count in zip(index, heights.shape, strict=True)])
    (i0, j0), (i1, j1) = ends
    count = max(abs(i1 - i0), abs(j1 - j0), 1)
    along = np.arange(count + 1)
    found = np.zeros(count + 1)
    (low_i, part_i), (low_j, part_j) = (
        _between(first + along * (last - first) / count, size)
        for first, last, size in zip(*ends, heights.shape, strict=True)
    )
    for i, weight_i in ((low_i, 1.0 - part_i), (low_i + 1, part_i)):
        for j, weight_j in ((low_j, 1.0 - part_j), (low_j + 1, part_j)):
            weight = weight_i * weight_j
            values = heights[np.minimum(i, heights.shape[0] - 1), np.minimum(j, heights.shape[1] - 1)]
            found += np.where(weight > 0.0, weight * values, 0.0)
    share = along / count
    placed = [((k + 0.5) * spacing[0], (m + 0.5) * spacing[1]) for k, m in ends]
    length = math.dist(*placed)
    return Section(placed[0], placed[1], share * length, found)


def _between(place: RealArray, count: int) -> tuple[Any, RealArray]:
    """Number of the point below each ``place`` among so many, and the share of the next one."""
    low = np.clip(np.floor(place), 0, count - 1)
    return low.astype(int), place - low


def line_scan(heights: RealArray, spacing: float) -> Section:
    """The heights (n,) in m of a line scan as a section, its points ``spacing`` m from one
    another."""
    distance = (np.arange(heights.size) + 0.5) * spacing
    return Section((0.0, 0.0), (heights.size * spacing, 0.0), distance, np.asarray(heights, dtype=float))


# Readings between two cursors.


@dataclass(frozen=True)
class Reading:
    """What stands between the points ``first`` and ``last`` of a section.

    Attributes
    ----------
    at
        Distances of both from the start, in m.
    heights
        Heights of both in m; NaN where one is missing.
    Pa, Pq, Pt
        Mean absolute and rms deviation, and peak to valley, of the part between them from its
        straight line of least squares, in m; NaN where it has fewer than three heights.
    """

    first: int
    last: int
    at: Point
    heights: Point
    Pa: float
    Pq: float
    Pt: float

    @property
    def dx(self) -> float:
        """Distance along the line from the first to the second, in m."""
        return self.at[1] - self.at[0]

    @property
    def dz(self) -> float:
        """Height of the second above the first, in m."""
        return self.heights[1] - self.heights[0]

    @property
    def angle(self) -> float:
        """Slope between both in degrees, of heights and distances in the same unit."""
        return math.degrees(math.atan2(self.dz, self.dx)) if self.dx else math.nan

    def words(self) -> list[tuple[str, str]]:
        """Names and texts of all."""
        values = (
            ("Δx", self.dx),
            ("Δz", self.dz),
            ("height at A", self.heights[0]),
            ("height at B", self.heights[1]),
            ("Pa", self.Pa),
            ("Pq", self.Pq),
            ("Pt, peak to valley", self.Pt),
        )
        made = [(name, show(value, "m", 4) if math.isfinite(value) else "–") for name, value in values]
        angle = f"{self.angle:.4g}°" if math.isfinite(self.angle) else "–"
        return [*made[:2], ("angle", angle), *made[2:]]


def reading(of: Section, a: float, b: float) -> Reading:
    """What stands between the points of a section that are nearest to the distances ``a`` and ``b``
    in m, in that order."""
    places = [int(np.argmin(np.abs(of.distance - at))) for at in (a, b)]
    low, high = min(places), max(places)
    part, steps = of.heights[low : high + 1], np.diff(of.distance)
    found = [math.nan] * 3
    if np.count_nonzero(np.isfinite(part)) > 2:
        flat = levelled(Profile(part, float(steps[0])), "line")
        found = [mean_absolute_height(flat), rms_height(flat), peak_to_valley(flat)]
    at, heights = ((float(values[places[0]]), float(values[places[1]])) for values in (of.distance, of.heights))
    return Reading(places[0], places[1], at, heights, *found)


# Regions that are drawn.


def drawn_region(kind: str, points: Sequence[Sequence[float]], size: Point, pixel: float) -> dict[str, Any] | None:
    """Table of the region of that ``kind`` with corners ``points`` in m: opposite ones of a
    rectangle and of the rectangle around an ellipse, all of a polygon, whose corners that stand out
    by less than a ``pixel`` are left out.

    Corners outside the map, which has that ``size`` in m, are moved to its border. None where it
    has no area.
    """
    x, y = (np.clip([float(point[axis]) for point in points], 0.0, size[axis]) for axis in (0, 1))
    if len(x) < 2 or not np.ptp(x) > 0.0 or not np.ptp(y) > 0.0:
        return None
    if kind == "rectangle":
        sides = {axis: [length(values.min()), length(values.max())] for axis, values in (("x", x), ("y", y))}
        return {"kind": kind, **sides}
    if kind == "ellipse":
        middle = [length(0.5 * (values.min() + values.max())) for values in (x, y)]
        return {"kind": kind, "centre": middle, "radii": [length(0.5 * np.ptp(values)) for values in (x, y)]}
    corners = simplified(np.column_stack([x, y]), 0.5 * pixel)
    if len(corners) < 3:
        return None
    return {"kind": "polygon", "x": [length(value) for value in corners[:, 0]], "y": [length(v) for v in corners[:, 1]]}


def drawn_range(a: float, b: float, extent: float) -> dict[str, Any] | None:
    """Table of the region of a line scan between two places in m; None if these are the same."""
    low, high = sorted(min(max(float(value), 0.0), extent) for value in (a, b))
    return {"kind": "rectangle", "x": [length(low), length(high)]} if high > low else None


def length(value: float) -> str:
    """Text of a length in m for a document."""
    return f"{value * 1e6:.5g} um"


def simplified(points: RealArray, tolerance: float) -> RealArray:
    """The ``points`` (n, 2) of a line without those that stand out of it by at most ``tolerance``,
    by the method of Ramer, Douglas and Peucker; its ends stay."""
    keep = np.zeros(len(points), dtype=bool)
    keep[[0, -1]] = True
    parts = [(0, len(points) - 1)]
    while parts:
        first, last = parts.pop()
        inner = points[first + 1 : last] - points[first]
        if not len(inner):
            continue
        along = points[last] - points[first]
        whole = math.hypot(*along)
        out = np.abs(inner @ [-along[1], along[0]]) / whole if whole else np.hypot(inner[:, 0], inner[:, 1])
        farthest = int(out.argmax())
        if out[farthest] > tolerance:
            middle = first + 1 + farthest
            keep[middle] = True
            parts += [(first, middle), (middle, last)]
    return points[keep]


# Regions of a document.

MOVES = ("crop", "slice")
"""Steps after which lengths are measured from another corner."""


def place_of_mask(steps: Sequence[Mapping[str, Any]], shown: int) -> tuple[int, bool]:
    """Where among ``steps`` of preparation a region belongs that is drawn on the surface after the
    first ``shown`` of them, and whether a mask is there already.

    A new mask comes before all steps that leave points where they are, so that levelling and
    filters leave out what is masked, and filling fills it.
    """
    first = 1 + max((n for n, step in enumerate(steps[:shown]) if step.get("step") in MOVES), default=-1)
    there = [n for n in range(first, shown) if steps[n].get("step") == "mask"]
    return (there[-1], True) if there else (first, False)


def with_region(steps: Sequence[Mapping[str, Any]], region: Mapping[str, Any], shown: int) -> list[dict[str, Any]]:
    """``steps`` with a ``region`` more, drawn on the surface after the first ``shown`` of them."""
    place, there = place_of_mask(steps, shown)
    made = [dict(step) for step in steps]
    if there:
        before = made[place].get("regions") or []
        made[place]["regions"] = [*(before if isinstance(before, list) else [before]), dict(region)]
    else:
        made.insert(place, {"step": "mask", "regions": [dict(region)]})
    return made


def without_region(steps: Sequence[Mapping[str, Any]], place: int, number: int) -> list[dict[str, Any]]:
    """``steps`` without the region of that ``number`` of the mask at ``place``, and without the
    mask if it was the only one."""
    made = [dict(step) for step in steps]
    if 0 <= place < len(made) and made[place].get("step") == "mask":
        regions = [region for n, region in enumerate(made[place].get("regions") or []) if n != number]
        if regions:
            made[place]["regions"] = regions
        else:
            del made[place]
    return made


def outlines(steps: Sequence[Mapping[str, Any]], shown: int, size: Point) -> list[dict[str, Any]]:
    """Outline of every region of the masks among ``steps``, on the map of that ``size`` in m after
    the first ``shown`` of them; those of masks of another part of the surface are left out."""
    made = []
    for place, step in enumerate(steps):
        between = steps[min(place, shown) : max(place, shown)]
        if step.get("step") != "mask" or any(other.get("step") in MOVES for other in between):
            continue
        regions = step.get("regions") or []
        for number, table in enumerate(regions if isinstance(regions, list) else ()):
            points = _outline(table, size)
            if points:
                name = f"{table['kind']} {number + 1}"
                made.append({"step": place, "number": number, "name": name, "points": points})
    return made


def _outline(table: Any, size: Point) -> list[list[float]]:
    """Corners of the region of a ``table`` as a person typed it; nothing while it cannot be
    read."""
    try:
        kind = REGION_TABLES[table["kind"]]
        asked = kind.model_validate(table)
        region: Any = asked.makes(**asked.given("kind"))
    except (AsperityError, ValueError, KeyError, TypeError):
        return []
    if isinstance(region, Rectangle):
        (x0, x1), (y0, y1) = region.x or (0.0, size[0]), region.y or (0.0, size[1])
        return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
    if isinstance(region, Polygon):
        return [[float(x), float(y)] for x, y in zip(region.x, region.y, strict=True)]
    assert isinstance(region, Ellipse)
    turn = np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False)
    along, across = region.radii[0] * np.cos(turn), region.radii[1] * np.sin(turn)
    cosine, sine = math.cos(region.angle), math.sin(region.angle)
    x, y = region.centre[0] + cosine * along - sine * across, region.centre[1] + sine * along + cosine * across
    return [[float(a), float(b)] for a, b in zip(x, y, strict=True)]
