"""Windows by which heights are multiplied before a Fourier transform, normalised to a mean square of one."""

from __future__ import annotations

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.grid import Grid
from ..surface import Surface

WINDOWS = ("none", "hann", "radial hann")
"""Kinds of window."""

LOST_MODES = {"none": 1.0, "hann": 35.0 / 18.0, "radial hann": 2.0}
"""Factor per axis by which a window lowers the number of independent modes: <w⁴>/<w²>², in one dimension."""


def chosen_window(window: str, surface: Surface) -> str:
    """Kind of window for ``surface``: as named, or by ``auto`` none for a periodic surface and hann otherwise.

    Raises
    ------
    InputError
        If the name is unknown.
    """
    require.one_of(window, ("auto", *WINDOWS), "window of a spectrum")
    if window == "auto":
        return "none" if surface.periodic else "hann"
    return window


def line_window(kind: str, n: int) -> RealArray:
    """Weights at ``n`` points of a line; a line too short for a Hann window (one or two points) gets none."""
    if kind == "none" or n < 3:
        return np.ones(n)
    return _normalised(0.5 * (1.0 - np.cos(2.0 * np.pi * np.arange(n) / n)))


def map_window(kind: str, grid: Grid) -> RealArray:
    """Weights at the nodes of ``grid``, shape (nx, ny) or one that broadcasts to it.

    ``radial hann`` is 1 + cos(2π r/L) within r < L/2 of the centre, L the shorter side, and zero outside.
    """
    if kind == "radial hann":
        x, y = grid.centred_coordinates()
        shorter = min(grid.size)
        radius = np.hypot(x, y)
        return _normalised(np.where(radius < 0.5 * shorter, 1.0 + np.cos(2.0 * np.pi * radius / shorter), 0.0))
    return line_window(kind, grid.shape[0])[:, None] * line_window(kind, grid.shape[1])[None, :]


def _normalised(weights: RealArray) -> RealArray:
    normalised: RealArray = weights / np.sqrt(np.mean(np.square(weights)))
    return normalised
