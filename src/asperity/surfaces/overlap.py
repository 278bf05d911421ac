"""The largest rectangle along x and y in a convex polygon: where two maps overlap."""

from __future__ import annotations

import numpy as np

from ..core.arrays import RealArray

_CANDIDATES, _REFINEMENTS = 201, 6  # for each end of the rectangle, and how often the search is narrowed
_ROUNDING = 1e-9  # relative


def largest_rectangle(
    corners: RealArray, limits: tuple[float, float, float, float]
) -> tuple[float, float, float, float]:
    """Rectangle x0, x1, y0, y1 of the largest area within the convex polygon ``corners`` (n, 2) and the ``limits``.

    Between x0 and x1 the lower border of a convex polygon is highest and the upper one lowest at the ends, so two
    numbers are searched for: among all pairs of candidates, then more closely around the best pair.
    """
    low_x, high_x, low_y, high_y = limits
    own = corners[(corners[:, 0] > low_x) & (corners[:, 0] < high_x), 0]
    best, width = (low_x, high_x), high_x - low_x
    for _ in range(_REFINEMENTS):
        near = np.concatenate([np.linspace(end - width, end + width, _CANDIDATES) for end in best])
        x = np.unique(np.concatenate([np.clip(near, low_x, high_x), own, [low_x, high_x]]))
        lower, upper = _borders(corners, x)
        lower, upper = np.maximum(lower, low_y), np.minimum(upper, high_y)
        height = np.minimum(upper[:, None], upper[None, :]) - np.maximum(lower[:, None], lower[None, :])
        area = (x[None, :] - x[:, None]) * np.where(x[None, :] > x[:, None], np.maximum(height, 0.0), 0.0)
        i, j = np.unravel_index(int(area.argmax()), area.shape)
        best, width = (float(x[i]), float(x[j])), 4.0 * width / _CANDIDATES
    bottom, top = max(lower[i], lower[j]), min(upper[i], upper[j])
    return best[0], best[1], float(bottom), float(top)


def _borders(corners: RealArray, x: RealArray) -> tuple[RealArray, RealArray]:
    """Lower and upper border y of the convex polygon ``corners`` at ``x`` within it."""
    lower, upper = np.full(x.shape, np.inf), np.full(x.shape, -np.inf)
    slack = _ROUNDING * np.ptp(corners[:, 0])
    for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        left, right = (start, end) if start[0] <= end[0] else (end, start)
        if right[0] - left[0] <= slack:
            continue
        on = (x >= left[0] - slack) & (x <= right[0] + slack)
        y = left[1] + (x[on] - left[0]) / (right[0] - left[0]) * (right[1] - left[1])
        lower[on], upper[on] = np.minimum(lower[on], y), np.maximum(upper[on], y)
    return lower, upper
