"""Depths of the planes of a survey: dense against the contact spots, both faces of every layer, and what is asked for."""

from __future__ import annotations

import math

import numpy as np

from ..core.arrays import RealArray
from .regions import regions
from .request import Contact, StressRequest
from .sampling import depths_through

RATIO = 1.25
"""Depths below a contact grow by this factor: the largest √J2 under a sphere is at most 0.7 % low on them."""

SHALLOWEST, DEEPEST = 0.1, 3.0
"""First depth over the mean radius of contact spots, and last over the largest; √J2 of a sphere is largest at 0.48."""

PIXELS = 0.5
"""First depth in pixels at least: shallower the trigonometric interpolation of pressures ripples as it does on the surface."""

INTERVALS = 64
"""Number of intervals of planes in all layers together, at most 4 and at least 1 in each."""

SAME, CLOSE = 1e-9, 0.1
"""Relative differences of depths that are one and the same, and so close that no plane is needed between."""

FAR_LAYERS = 6.0
"""Layers that end within this many radii of the largest spot are sampled to their end."""


def survey_depths(request: StressRequest, result: Contact) -> RealArray:
    """Increasing depths (m) of all planes: those asked for, and for sections and profiles those that show the contact.

    To the latter belong all interfaces, however deep.
    """
    if not wants_lines(request):
        return _distinct(np.array(request.depths), SAME)
    interfaces = [
        region.bottom for region in regions(getattr(result.problem, request.of)) if math.isfinite(region.bottom)
    ]
    return _distinct(np.array([*line_depths(request, result), *interfaces, *request.depths]), SAME)


def line_depths(request: StressRequest, result: Contact) -> RealArray:
    """Increasing depths (m) of sections and profiles: dense against the contact spots, and both faces of each layer."""
    body = getattr(result.problem, request.of)
    small, large = _spot_radii(result)
    bottom = request.deepest or _deepest(body, large)
    layered = depths_through(body, bottom, per_region=max(1, min(4, INTERVALS // len(regions(body)))))
    asked = [depth for depth in request.depths if depth <= layered[-1]]
    needed = _distinct(np.array([*layered, *asked]), SAME)
    shallow = max(SHALLOWEST * small, PIXELS * max(_pixels(result)))
    count = max(0, math.ceil(math.log(layered[-1] / shallow, RATIO) - 0.5))
    graded = shallow * RATIO ** np.arange(count)
    away = [depth for depth in graded if np.abs(needed - depth).min() > CLOSE * depth]
    return np.unique([*needed, *away])


def wants_lines(request: StressRequest) -> bool:
    """Whether sections or profiles are asked for."""
    return bool(request.sections or request.profiles)


def _deepest(body: object, radius: float) -> float:
    """Depth (m) at which stresses have mostly decayed, below the layers where these are not far below the contact."""
    layers = [region.bottom for region in regions(body) if math.isfinite(region.bottom)]
    near = max((bottom for bottom in layers if bottom <= FAR_LAYERS * radius), default=0.0)
    return max(DEEPEST * radius, 1.5 * near)


def _spot_radii(result: Contact) -> tuple[float, float]:
    """Mean and largest radius (m) of circles as large as the contact spots, at least half a pixel.

    On a grid of one row spots are strips, and half their widths take the place of radii.
    """
    grid = result.problem.grid
    least = 0.5 * min(
        (step for step, n in zip(grid.spacing, grid.shape, strict=True) if n > 1), default=grid.spacing[0]
    )
    if not result.spot_areas.size:
        return least, least
    if 1 in grid.shape:
        radii = 0.5 * result.spot_areas / grid.spacing[grid.shape.index(1)]
    else:
        radii = np.sqrt(result.spot_areas / math.pi)
    return max(float(radii.mean()), least), max(float(radii.max()), least)


def _pixels(result: Contact) -> list[float]:
    """Spacing (m) along the axes with more than one point, or along x."""
    grid = result.problem.grid
    return [step for step, n in zip(grid.spacing, grid.shape, strict=True) if n > 1] or [grid.spacing[0]]


def _distinct(depths: RealArray, tolerance: float) -> RealArray:
    """Sorted ``depths`` without those that differ from the one before by a relative ``tolerance`` at most."""
    ordered = np.unique(depths)
    return ordered[np.diff(ordered, prepend=-1.0) > tolerance * np.abs(ordered)]
