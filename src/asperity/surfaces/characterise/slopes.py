"""Slopes by forward differences."""

from __future__ import annotations

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ..surface import Surface


def rms_slope(surface: Surface) -> float:
    """Sdq, the rms gradient sqrt(<(∂h/∂x)² + (∂h/∂y)²>), dimensionless.

    Scheme: forward differences [h(i+1,j) - h(i,j)]/dx and [h(i,j+1) - h(i,j)]/dy at the nodes where both exist with
    valid points only; a periodic surface wraps. Waves shorter than about eight pixels are underestimated
    (McCool 1987; Jacobs, Junge & Pastewka 2017).

    Raises
    ------
    InputError
        If no node has both differences.
    """
    along_x, along_y = _differences(surface)
    both = along_x[:, : along_y.shape[1]] ** 2 + along_y[: along_x.shape[0]] ** 2
    return _root_mean(both)


def rms_profile_slope(surface: Surface, *, axis: str = "x") -> float:
    """Rms slope of the profiles along ``axis`` (square root of m2): forward differences over all valid pairs.

    A periodic surface wraps. Dimensionless; ``axis`` is ``x`` or ``y``.

    Raises
    ------
    InputError
        If the axis is unknown or no two neighbours are valid.
    """
    require.one_of(axis, ("x", "y"), "axis of the profiles")
    return _root_mean(_differences(surface)["xy".index(axis)] ** 2)


def _differences(surface: Surface) -> tuple[RealArray, RealArray]:
    """Forward slopes along x and y, NaN where a point is missing; one shorter along their axis unless periodic."""
    h = surface.heights.astype(np.float64, copy=False)
    if surface.periodic:
        return (np.roll(h, -1, axis=0) - h) / surface.dx, (np.roll(h, -1, axis=1) - h) / surface.dy
    return np.diff(h, axis=0) / surface.dx, np.diff(h, axis=1) / surface.dy


def _root_mean(squares: RealArray) -> float:
    valid = squares[~np.isnan(squares)]
    if valid.size == 0:
        raise InputError(
            "surface must have neighbouring valid points for a slope, but has none. Fill the missing points first."
        )
    return float(np.sqrt(valid.mean()))
