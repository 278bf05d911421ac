"""Displacement of a half-space under uniform pressure on a rectangle (Love 1929; Johnson 1985, eq. 3.25)."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray

_FAR = 300.0  # sides; beyond it corner differences lose more digits than the multipole expansion


def patch_displacement(x: RealArray, y: RealArray, side_x: float, side_y: float) -> RealArray:
    """Surface displacement at (x, y) of a half-space with E' = 1 under unit pressure on a rectangle at the origin.

    Parameters
    ----------
    x, y
        Coordinates of the field points in m, broadcast against each other.
    side_x, side_y
        Full sides of the rectangle in m, > 0.

    Returns
    -------
    RealArray
        u E' / p in m, shape of ``x + y``. The corner sum is Love's closed form in the cancellation-free asinh form;
        beyond 300 sides, where corner differences lose digits, the point load with second moments is used
        (relative error below 1e-9 everywhere).
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
    result: RealArray = x * np.arcsinh(y / ax) + y * np.arcsinh(x / ay)
    return result
