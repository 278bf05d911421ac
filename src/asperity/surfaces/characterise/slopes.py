"""Slopes, curvatures and surface area by finite differences between neighbouring points."""

from __future__ import annotations

import math

import numpy as np

from ...core.arrays import RealArray
from ..surface import Surface
from .differences import axis_index, increments, mean_of, mean_square, second_differences
from .stencils import stencil_sums


def forward_slopes(surface: Surface) -> tuple[RealArray, RealArray]:
    """[h(i+1,j) - h(i,j)]/dx and [h(i,j+1) - h(i,j)]/dy at the nodes where both can exist; NaN where a point is missing.

    Both have the shape (nx, ny) of a periodic surface, (nx - 1, ny - 1) otherwise.
    """
    along_x, along_y = increments(surface, (1, 0)) / surface.dx, increments(surface, (0, 1)) / surface.dy
    return along_x[:, : along_y.shape[1]], along_y[: along_x.shape[0]]


def rms_slope(surface: Surface) -> float:
    """Sdq, the rms gradient sqrt(<(∂h/∂x)²> + <(∂h/∂y)²>), dimensionless.

    Scheme: forward differences [h(i+1,j) - h(i,j)]/dx and [h(i,j+1) - h(i,j)]/dy, averaged over all valid pairs of each
    direction; a periodic surface wraps. Waves shorter than about eight pixels are underestimated (McCool 1987; Jacobs,
    Junge & Pastewka 2017).

    Raises
    ------
    InputError
        If no two neighbours along x or along y are valid.
    """
    return math.hypot(rms_profile_slope(surface, axis="x"), rms_profile_slope(surface, axis="y"))


def rms_profile_slope(surface: Surface, *, axis: str = "x") -> float:
    """Rms slope of the profiles along ``axis`` (square root of m2): forward differences over all valid pairs.

    A periodic surface wraps. Dimensionless; ``axis`` is ``x`` or ``y``.

    Raises
    ------
    InputError
        If the axis is unknown or no two neighbours are valid.
    """
    return math.sqrt(stencil_sums(surface, axis, 1, 1).square) / surface.grid.spacing[axis_index(axis)]


def rms_profile_curvature(surface: Surface, *, axis: str = "x") -> float:
    """Rms second derivative of the profiles along ``axis`` (square root of m4) in 1/m.

    Scheme: [h(i+1) - 2 h(i) + h(i-1)]/d² over all valid triples (McCool 1987); a periodic surface wraps. Waves
    shorter than about eight pixels are underestimated.

    Raises
    ------
    InputError
        If the axis is unknown or no three neighbours are valid.
    """
    return math.sqrt(stencil_sums(surface, axis, 2, 1).square) / surface.grid.spacing[axis_index(axis)] ** 2


def rms_laplacian(surface: Surface) -> float:
    """Rms of ∂²h/∂x² + ∂²h/∂y² in 1/m: central second differences at the nodes where both exist.

    It is twice the rms mean curvature.

    Raises
    ------
    InputError
        If no node has both differences.
    """
    along_x, along_y = (
        second_differences(surface, "x") / surface.dx**2,
        second_differences(surface, "y") / surface.dy**2,
    )
    if not surface.periodic:
        along_x, along_y = along_x[:, 1:-1], along_y[1:-1]
    return float(np.sqrt(mean_square(along_x + along_y, "curvature")))


def developed_area_ratio(surface: Surface) -> float:
    """Sdr, the surface area over its projection less 1 (a fraction, not %), dimensionless (ISO 25178-2, 4.4.2).

    The area of a cell of four valid points is the mean over its two triangulations; a periodic surface wraps.

    Raises
    ------
    InputError
        If no cell has four valid corners.
    """
    h = surface.heights.astype(np.float64, copy=False)
    if surface.periodic:
        h = np.pad(h, ((0, 1), (0, 1)), mode="wrap")
    slope_x, slope_y = np.square(np.diff(h, axis=0) / surface.dx), np.square(np.diff(h, axis=1) / surface.dy)
    total = np.zeros((h.shape[0] - 1, h.shape[1] - 1))
    for low_or_high_x in (slope_x[:, :-1], slope_x[:, 1:]):
        for low_or_high_y in (slope_y[:-1], slope_y[1:]):
            squared = low_or_high_x + low_or_high_y
            total += squared / (1.0 + np.sqrt(1.0 + squared))  # sqrt(1 + s) - 1 without cancellation
    return mean_of(total, "surface area") / 4.0
