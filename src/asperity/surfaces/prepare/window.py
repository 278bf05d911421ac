"""Making a measured surface periodic: by a taper at the borders or by removal of its smooth component."""

from __future__ import annotations

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.grid import Grid
from ...core.spectral import RealTransform
from ...core.units import show
from ..surface import Surface
from .steps import recorded, require_complete


def tapered(surface: Surface, width: float = 0.1) -> Surface:
    """Periodic surface whose heights fall to their mean along the borders by a cosine (Tukey) taper.

    Parameters
    ----------
    surface
        Surface without missing points, levelled beforehand.
    width
        Width of the tapered strip at each border as a fraction of the side, 0 < width <= 0.5.

    Raises
    ------
    InputError
        If the width is out of range or points are missing.
    """
    require.at_most(width, 0.5, "width of the taper (fraction of the side)")
    require_complete(surface, "tapered")
    heights = surface.heights.astype(np.float64, copy=False)
    mean = float(heights.mean())
    weight_x, weight_y = (_tukey(n, width) for n in surface.shape)
    result = mean + weight_x[:, None] * weight_y[None, :] * (heights - mean)
    step = f"tapered: cosine over {width:g} of the side at each border"
    return recorded(surface, result, step, periodic=True)


def periodised(surface: Surface) -> Surface:
    """Periodic surface: the surface less the smooth component that carries the jumps between opposite borders.

    The smooth component s solves the discrete periodic equation ∇²s = v, where v is zero inside the map and holds
    the jumps at its borders, so the discrete Laplacian (curvature) of all interior points and the mean height are
    kept. A periodic surface is returned as it is. Source: Moisan (2011), eqs. 11-14, here with the weights 1/dx²
    and 1/dy².

    Raises
    ------
    InputError
        If points are missing.
    """
    if surface.periodic:
        return surface
    require_complete(surface, "periodised")
    heights = surface.heights.astype(np.float64, copy=False)
    smooth = _smooth_component(heights, surface.grid.spacing)
    text = f"periodised: smooth component (rms {show(float(smooth.std()), 'm', 3)}) removed"
    return recorded(surface, heights - smooth, text, periodic=True, citation_keys=("Moisan2011",))


def _smooth_component(heights: RealArray, spacing: tuple[float, float]) -> RealArray:
    (nx, ny), smallest = heights.shape, min(spacing)
    weight_x, weight_y = ((smallest / step) ** 2 for step in spacing)
    jumps = np.zeros_like(heights)
    jump_x, jump_y = weight_x * (heights[-1] - heights[0]), weight_y * (heights[:, -1] - heights[:, 0])
    jumps[0] += jump_x
    jumps[-1] -= jump_x
    jumps[:, 0] += jump_y
    jumps[:, -1] -= jump_y
    angle_x, angle_y = Grid((nx, ny), (1.0, 1.0)).wavevector()
    laplacian = -4.0 * (weight_x * np.sin(angle_x / 2.0) ** 2 + weight_y * np.sin(angle_y / 2.0) ** 2)
    laplacian[0, 0] = 1.0
    transform = RealTransform((nx, ny))
    spectrum = transform.forward(jumps) / laplacian
    spectrum[0, 0] = 0.0
    return transform.backward(spectrum)


def _tukey(count: int, width: float) -> RealArray:
    distance = (np.arange(count) + 0.5) / count
    distance = np.minimum(distance, 1.0 - distance)
    weights: RealArray = np.sin(0.5 * np.pi * np.minimum(distance / width, 1.0)) ** 2
    return weights
