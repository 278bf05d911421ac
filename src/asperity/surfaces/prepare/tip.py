"""The tip of a scanning instrument: the scan it takes of a surface, the surface behind a scan,
where that is certain, and the tip itself from a scan.

A rigid tip of shape t(u) >= 0 above its apex that touches a surface s takes the scan
i(x) = max_u [s(x + u) - t(u)], a dilation. The highest surface that agrees with it is the erosion
r(x) = min_u [i(x - u) + t(u)] (Keller 1991; Villarrubia 1997): s <= r <= i, and r = s
wherever the tip touched.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from ...core.parameters import Declared, checked
from ...core.scipy_parts import ndimage
from ...core.units import show
from ...core.values import Length, NonNegativeLength, Number, Points
from ..surface import Surface
from .level import recorded

_KEYS = ("Keller1991", "Villarrubia1997")

# Shapes of tips.


class Tip(Protocol):
    """What a shape of a tip gives, at lateral distances from its apex."""

    @property
    def words(self) -> str:
        """What it is, for the history of a surface."""

    def above_apex(self, x: RealArray, y: RealArray) -> RealArray:
        """Height in m of its surface above the apex at ``x``, ``y`` (m); infinite beside it."""

    def reach(self, height: float) -> tuple[float, float]:
        """Distance in m from the axis along x and y within which it is at most ``height`` (m) above
        its apex."""


class _Round:
    """What tips of revolution have in common; ``_height`` over the radius is their own."""

    def _height(self, radius: RealArray) -> RealArray:
        raise NotImplementedError

    def _width(self, height: float) -> float:
        raise NotImplementedError

    def above_apex(self, x: RealArray, y: RealArray) -> RealArray:
        """Height in m of its surface above the apex at ``x``, ``y`` (m); infinite beside it."""
        return self._height(np.hypot(x, y))

    def reach(self, height: float) -> tuple[float, float]:
        """Radius in m, twice, within which it is at most ``height`` (m) above its apex."""
        return self._width(height), self._width(height)


@dataclass(frozen=True)
class SphericalTip(_Round, Declared):
    """Half a sphere at the end of a shaft of the same radius. InputError if the radius is not
    positive."""

    radius: Annotated[Length, "radius of the tip"]

    @property
    def words(self) -> str:
        """What it is."""
        return f"spherical tip of radius {show(self.radius, 'm', 3)}"

    def _height(self, radius: RealArray) -> RealArray:
        inside = radius <= self.radius
        share = np.square(np.where(inside, radius, 0.0) / self.radius)
        # R - √(R² - r²), which loses no digits near the apex
        return np.where(inside, self.radius * share / (1.0 + np.sqrt(1.0 - share)), np.inf)

    def _width(self, height: float) -> float:
        return math.sqrt(height * (2.0 * self.radius - height)) if height < self.radius else self.radius


@dataclass(frozen=True)
class ParabolicTip(_Round, Declared):
    """Paraboloid r²/2R of the ``radius`` R at its apex. InputError if that is not positive."""

    radius: Annotated[Length, "radius of the tip"]

    @property
    def words(self) -> str:
        """What it is."""
        return f"parabolic tip of radius {show(self.radius, 'm', 3)}"

    def _height(self, radius: RealArray) -> RealArray:
        return np.square(radius) / (2.0 * self.radius)

    def _width(self, height: float) -> float:
        return math.sqrt(2.0 * self.radius * height)


Opening = Annotated[
    float, Number("angle", above=0.0, below=math.pi, fix="Give the full angle between opposite sides of the cone.")
]


@dataclass(frozen=True)
class ConicalTip(_Round, Declared):
    """Cone of the full ``opening`` angle 2α with a sphere of ``radius`` R at its apex, tangent to
    it at the distance R cos α from the axis.

    Raises InputError if the angle is not between 0 and π (rad), or the radius negative; zero is a
    sharp cone.
    """

    radius: Annotated[NonNegativeLength, "radius of the apex"]
    opening: Annotated[Opening, "full opening angle"]

    @property
    def words(self) -> str:
        """What it is."""
        return f"tip of radius {show(self.radius, 'm', 3)} and opening angle {show(math.degrees(self.opening), '°', 3)}"

    def _height(self, radius: RealArray) -> RealArray:
        half = 0.5 * self.opening
        joint = self.radius * math.cos(half)
        share = np.square(np.minimum(radius, joint) / (self.radius or 1.0))
        sphere = self.radius * share / (1.0 + np.sqrt(1.0 - share))
        return np.asarray(sphere + np.maximum(radius - joint, 0.0) / math.tan(half))

    def _width(self, height: float) -> float:
        half = 0.5 * self.opening
        joint = self.radius * (1.0 - math.sin(half))
        if height < joint:
            return math.sqrt(height * (2.0 * self.radius - height))
        return self.radius * math.cos(half) + (height - joint) * math.tan(half)


@dataclass(frozen=True, eq=False)
class MeasuredTip:
    """Shape of a tip on pixels, such as one found by ``estimated_tip``.

    Raises InputError if the numbers of points are not odd, a height is negative, that of the apex
    is not zero, or a spacing is not positive.

    Parameters
    ----------
    heights
        (2 i + 1, 2 j + 1), m above the apex, which is in the middle; NaN or infinity where the tip
        does not reach.
    dx, dy
        Pixel size in m, that of the scans it is used for; ``dy`` defaults to ``dx``.
    source
        Where the shape is from, for the history of a surface.
    """

    heights: RealArray
    dx: float
    dy: float
    source: str

    def __init__(self, heights: ArrayLike, dx: float, dy: float | None = None, *, source: str = "") -> None:
        values = np.array(heights, dtype=np.float64)
        if values.ndim != 2 or not all(n % 2 for n in values.shape):
            raise InputError(
                "heights of a tip (m) must be an array of odd numbers of points, the apex in the middle, but have the "
                f"shape {values.shape}."
            )
        values[np.isnan(values)] = np.inf
        apex = float(values[values.shape[0] // 2, values.shape[1] // 2])
        if apex != 0.0 or values.min() < 0.0:
            raise InputError(
                "heights of a tip (m) must be 0 at the apex in the middle and nowhere lower, but are "
                f"{apex:g} there and {values.min():g} at least. Subtract the height of the apex."
            )
        values.flags.writeable = False
        object.__setattr__(self, "heights", values)
        object.__setattr__(self, "dx", require.positive(dx, "dx of a tip (m)"))
        object.__setattr__(self, "dy", self.dx if dy is None else require.positive(dy, "dy of a tip (m)"))
        object.__setattr__(self, "source", source)

    @property
    def words(self) -> str:
        """What it is."""
        nx, ny = self.heights.shape
        return f"tip on {nx} x {ny} pixels" + (f" {self.source}" if self.source else "")

    def above_apex(self, x: RealArray, y: RealArray) -> RealArray:
        """Height in m of its surface above the apex at the pixel nearest to ``x``, ``y`` (m);
        infinite beside it."""
        nx, ny = self.heights.shape
        i, j = np.rint(x / self.dx).astype(int) + nx // 2, np.rint(y / self.dy).astype(int) + ny // 2
        inside = (i >= 0) & (i < nx) & (j >= 0) & (j < ny)
        found: RealArray = self.heights[np.clip(i, 0, nx - 1), np.clip(j, 0, ny - 1)]
        return np.where(inside, found, np.inf)

    def reach(self, height: float) -> tuple[float, float]:
        """Distance in m along x and y within which it is at most ``height`` (m) above its apex."""
        i, j = np.nonzero(self.heights <= height)
        nx, ny = self.heights.shape
        return float(np.abs(i - nx // 2).max()) * self.dx, float(np.abs(j - ny // 2).max()) * self.dy


_SAME_PIXEL = 1e-3
"""Relative difference up to which the pixels of a tip and of a scan are the same."""


def _on_pixels(tip: Tip, surface: Surface) -> RealArray:
    """Heights (2 i + 1, 2 j + 1) in m of ``tip`` above its apex on the pixels of ``surface``, as
    far as they are within the range of its heights: nothing else of the tip can touch it."""
    if isinstance(tip, MeasuredTip) and not np.allclose(
        (tip.dx, tip.dy), surface.grid.spacing, rtol=_SAME_PIXEL, atol=0.0
    ):
        raise InputError(
            f"pixels of a tip must be those of the surface, {show(surface.dx, 'm')} x {show(surface.dy, 'm')}, but are "
            f"{show(tip.dx, 'm')} x {show(tip.dy, 'm')}. Resample the surface, or estimate the tip from it."
        )
    height = float(np.nanmax(surface.heights) - np.nanmin(surface.heights))
    halves = []
    for axis, reach in enumerate(tip.reach(height)):
        n, spacing = surface.shape[axis], surface.grid.spacing[axis]
        half = int(reach / spacing * (1.0 + 1e-12))
        if half >= n and n > 1 and not surface.periodic:
            raise InputError(
                f"tip must be narrower than the map, {show(n * spacing, 'm', 3)} along {'xy'[axis]}, but the "
                f"{tip.words} reaches {show(2.0 * reach, 'm', 3)} across the {show(height, 'm', 3)} from the lowest "
                "to the highest point. Check the radius and the units of the heights."
            )
        halves.append(min(half, n // 2 if surface.periodic else n - 1))
    x, y = (np.arange(-half, half + 1) * spacing for half, spacing in zip(halves, surface.grid.spacing, strict=True))
    heights = tip.above_apex(x[:, None], y[None, :])
    return np.where(heights <= height, heights, np.inf)


def _filters() -> Any:
    """The module of grey filters and morphology, which costs time to import."""
    return ndimage


def _shifted_extreme(surface: Surface, shape: RealArray, *, highest: bool) -> RealArray:
    """max_u [h(x + u) - t(u)] or min_u [h(x - u) + t(u)] in m for the heights t, ``shape``, of a
    tip; nothing beyond the border and at missing points counts."""
    filters = _filters()
    nothing, morphology = (-np.inf, filters.grey_dilation) if highest else (np.inf, filters.grey_erosion)
    heights = np.where(surface.mask, nothing, surface.heights.astype(np.float64))
    footprint = np.isfinite(shape)[::-1, ::-1]  # both take the maximum or minimum with the structure reflected
    structure = -np.where(footprint, shape[::-1, ::-1], 0.0)
    mode: Any = {"mode": "wrap"} if surface.periodic else {"mode": "constant", "cval": nothing}
    found = morphology(heights, footprint=footprint, structure=structure, **mode)
    return np.where(surface.mask, np.nan, found)


# The scan of a surface, and the surface behind a scan.


def scanned(surface: Surface, tip: Tip) -> Surface:
    """Scan that a rigid ``tip`` takes of ``surface``: the dilation of the surface by the tip.

    Missing points stay missing, and nothing beyond the border touches the tip. Raises InputError if
    the tip is as wide as the map, or has other pixels.
    """
    heights = _shifted_extreme(surface, _on_pixels(tip, surface), highest=True)
    return recorded(surface, heights, f"scanned: by a {tip.words}", periodic=surface.periodic, citation_keys=_KEYS)


def reconstructed(scan: Surface, tip: Tip, *, mask_uncertain: bool = False) -> Surface:
    """Surface behind a ``scan`` with a known ``tip``: the erosion of the scan by the tip.

    It is the highest surface that agrees with the scan, equal to the true one wherever the tip
    touched; ``mask_uncertain`` makes all other points missing (see :func:`certain_points`). It
    belongs before levelling, since the tip stands upright in the frame of the instrument. Noise is
    taken for surface: its peaks become narrower, its pits stay. Missing points stay missing. Time
    grows with the number of pixels of the tip within the range of heights: 512² points took 0.3 s
    with 31² pixels and 1.1 s with 61², the certain points 1.4 and 5.7 s.

    Raises InputError if the tip is as wide as the map or has other pixels, or if no point is
    certain and the others are to be masked.
    """
    heights = _shifted_extreme(scan, _on_pixels(tip, scan), highest=False)
    step = f"reconstructed: surface behind a {tip.words}"
    if mask_uncertain:
        certain = certain_points(scan, tip)
        if not certain.any():
            raise InputError(
                f"surface behind a {tip.words} must have a certain point for the others to be masked, but has none: "
                "the tip is too wide for the map. Leave the uncertain points in."
            )
        masked = int(np.count_nonzero(~certain & ~scan.mask))
        heights = np.where(certain, heights, np.nan)
        step += f", {masked} uncertain points ({masked / scan.grid.n_points:.2%}) masked"
    return recorded(scan, heights, step, periodic=scan.periodic, citation_keys=_KEYS)


def certain_points(scan: Surface, tip: Tip) -> BoolArray:
    """Where the reconstructed surface is the true one for certain, (nx, ny): where the tip, at some
    point of the ``scan``, touched the reconstruction at exactly one place.

    A place of the tip whose pixels reach beyond the border or over a missing point tells nothing,
    since it may have touched there. Source: Keller (1991); Villarrubia (1997). Raises
    InputError as :func:`reconstructed`.
    """
    shape = _on_pixels(tip, scan)
    found = _shifted_extreme(scan, shape, highest=False)
    (nx, ny), (half_x, half_y) = scan.shape, (n // 2 for n in shape.shape)
    heights, pad = scan.heights.astype(np.float64), ((half_x, half_x), (half_y, half_y))
    around = np.pad(found, pad, mode="wrap") if scan.periodic else np.pad(found, pad, constant_values=np.nan)
    near = _rounding(heights)
    touches = np.zeros((nx, ny), dtype=np.int32)
    touched = [(i, j) for i, j in np.argwhere(np.isfinite(shape))]
    known = ~scan.mask
    for i, j in touched:
        lifted = around[i : i + nx, j : j + ny] - (heights + shape[i, j])  # NaN where nothing is known
        touches += np.abs(lifted) <= near
        known &= ~np.isnan(lifted)
    single = known & (touches == 1)
    certain = np.zeros(around.shape, dtype=bool)
    for i, j in touched:
        lifted = around[i : i + nx, j : j + ny] - (heights + shape[i, j])
        certain[i : i + nx, j : j + ny] |= single & (np.abs(lifted) <= near)
    if not scan.periodic:
        return certain[half_x : half_x + nx, half_y : half_y + ny]
    rows, columns = (np.arange(n + 2 * half) - half for n, half in ((nx, half_x), (ny, half_y)))
    wrapped = np.zeros((nx, ny), dtype=bool)
    np.logical_or.at(wrapped, np.ix_(rows % nx, columns % ny), certain)
    return wrapped


def _rounding(heights: RealArray) -> float:
    """Difference in m of two sums of heights that is no more than rounding."""
    return (
        8.0 * float(np.finfo(np.float64).eps) * float(np.nanmax(np.abs(heights)) + np.ptp(heights[~np.isnan(heights)]))
    )


# The tip from a scan.


@checked
def estimated_tip(
    scan: Surface,
    points: Annotated[Points, "odd numbers of pixels of the tip along x and y"],
    *,
    noise: Annotated[NonNegativeLength, "height that noise may add to differences of the scan"] = 0.0,
) -> MeasuredTip:
    """Bluntest tip that can have taken a ``scan``: a bound of the true tip, which is at least as
    sharp, and comes close to it where the surface has spikes sharper than the tip.

    With i(x') at a peak of the scan and u any place of the tip that may have touched there (i(x') +
    t(u) <= i(x' + u)), the tip is at v at least min_u [i(x') + t(u) - i(x' + u - v)] above its
    apex. That is repeated for all peaks from t = 0 until nothing changes (Villarrubia 1997).

    Noise of the scan makes the tip too sharp: ``noise`` is added to i(x' + u) in the condition and
    subtracted from every bound, which holds if no difference of two heights is wrong by more (some
    five standard deviations of one point). Increase it until the estimate ceases to change much.
    Peaks less than the width of the tip from the border or a missing point are left out.

    Parameters
    ----------
    scan
        Map with sharp features, not levelled by more than a plane.
    points
        Odd numbers of pixels; wide enough for the estimate to reach the height of the features.
    noise
        Threshold in m, >= 0.

    Raises
    ------
    InputError
        If a number of points is even, or the scan has no peak with so many points around it.
    """
    if not all(n % 2 for n in points):
        raise InputError(
            f"numbers of pixels of a tip must be odd, with the apex in the middle, but are {points[0]} x {points[1]}."
        )
    from .tip_kernels import sharpen

    half_x, half_y = (n // 2 for n in points)
    heights: RealArray = scan.heights.astype(np.float64)
    peaks = _peaks(scan, points)
    if scan.periodic:
        heights = np.pad(heights, ((2 * half_x, 2 * half_x), (2 * half_y, 2 * half_y)), mode="wrap")
        peaks = peaks + np.array([2 * half_x, 2 * half_y])
    if not peaks.size:
        raise InputError(
            f"scan must have a peak with {2 * half_x} x {2 * half_y} pixels without a border or a missing point on "
            "each side for a tip to be estimated, but has none. Take fewer pixels of the tip."
        )
    shape = np.zeros(points)
    order = np.argsort(-heights[peaks[:, 0], peaks[:, 1]], kind="stable")
    sharpen(heights, np.ascontiguousarray(peaks[order]), shape, noise)
    return MeasuredTip(shape, scan.dx, scan.dy, source="estimated from the scan")


def _peaks(scan: Surface, points: tuple[int, int]) -> Any:
    """Pixels (n, 2) of the maxima of ``scan`` within a tenth of the tip, with twice its half width
    known around."""
    filters = _filters()
    mode: Literal["wrap", "constant"] = "wrap" if scan.periodic else "constant"
    heights = np.where(scan.mask, -np.inf, scan.heights)
    window = tuple(2 * max(1, n // 10) + 1 for n in points)
    highest, lowest = (
        found(heights, window, mode=mode, cval=-np.inf) for found in (filters.maximum_filter, filters.minimum_filter)
    )
    known = filters.minimum_filter(~scan.mask, tuple(4 * (n // 2) + 1 for n in points), mode=mode, cval=0)
    return np.argwhere((heights == highest) & (lowest < highest) & known)  # a plateau tells nothing
