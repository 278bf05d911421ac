"""Filling of missing points."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import RealArray
from ...core.parameters import checked
from ...core.units import show
from ..surface import Surface

_Indices: TypeAlias = NDArray[np.signedinteger[Any]]

FillMethod: TypeAlias = Literal["harmonic", "mean", "nearest"]
_METHODS = {"harmonic": "harmonic interpolation", "mean": "the mean height", "nearest": "the nearest valid height"}


@checked
def filled(surface: Surface, method: Annotated[FillMethod, "how missing points are filled"] = "harmonic") -> Surface:
    """Surface without missing points; valid points are unchanged and the history records how many were filled.

    ``harmonic`` solves ∇²h = 0 in every hole with the heights on its rim (zero normal slope at the border of the
    map), ``nearest`` takes the closest valid height and ``mean`` the mean of the valid heights. Fills are smooth:
    they reduce mean square slopes and curvatures near the holes.
    """
    if surface.n_missing == 0:
        return surface
    heights = surface.heights.astype(np.float64)
    if method == "mean":
        heights[surface.mask] = np.nanmean(surface.heights, dtype=np.float64)
    elif method == "nearest":
        heights[surface.mask] = _nearest(surface)
    else:
        heights[surface.mask] = _harmonic(surface)
    share = surface.n_missing / surface.grid.n_points
    hole = show(float(np.sqrt(surface.n_missing * surface.grid.pixel_area)), "m", 3)
    step = f"filled: {surface.n_missing} points ({share:.2%}, {hole} squared) by {_METHODS[method]}"
    return surface.with_heights(heights, step)


def _nearest(surface: Surface) -> RealArray:
    from scipy.ndimage import distance_transform_edt

    pad = [(n // 2, n // 2) for n in surface.shape] if surface.periodic else [(0, 0), (0, 0)]
    missing = np.pad(surface.mask, pad, mode="wrap") if surface.periodic else surface.mask
    indices = distance_transform_edt(
        missing, sampling=surface.grid.spacing, return_distances=False, return_indices=True
    )
    window = tuple(slice(before, before + n) for (before, _), n in zip(pad, surface.shape, strict=True))
    rows, columns = ((indices[axis][window][surface.mask] - pad[axis][0]) % surface.shape[axis] for axis in (0, 1))
    return np.asarray(surface.heights[rows, columns])


def _harmonic(surface: Surface) -> RealArray:
    """Heights of the missing points from the five-point Laplace equation, in the order of the mask."""
    from scipy.sparse import coo_array
    from scipy.sparse.linalg import spsolve

    missing = np.flatnonzero(surface.mask)
    number = np.full(surface.grid.n_points, -1)
    number[missing] = np.arange(missing.size)
    flat = surface.heights.ravel()
    rows, columns, values = [], [], []
    diagonal, right = np.zeros(missing.size), np.zeros(missing.size)
    for here, neighbour, weight in _links(surface, missing):
        diagonal += np.bincount(here, minlength=missing.size) * weight
        inner = number[neighbour] >= 0
        rows.append(here[inner])
        columns.append(number[neighbour[inner]])
        values.append(np.full(np.count_nonzero(inner), -weight))
        right += np.bincount(here[~inner], weights=weight * flat[neighbour[~inner]], minlength=missing.size)
    every = np.arange(missing.size)
    entries = (np.concatenate([*values, diagonal]), (np.concatenate([*rows, every]), np.concatenate([*columns, every])))
    matrix = coo_array(entries, shape=(missing.size, missing.size)).tocsc()
    return np.atleast_1d(np.asarray(spsolve(matrix, right), dtype=np.float64))


def _links(surface: Surface, missing: _Indices) -> list[tuple[_Indices, _Indices, float]]:
    """For each of the four directions: number of the missing point, flat index of its neighbour, weight."""
    shape = surface.shape
    links: list[tuple[_Indices, _Indices, float]] = []
    points = np.unravel_index(missing, shape)
    smallest = min(surface.grid.spacing)
    for axis in (0, 1):
        for shift in (-1, 1):
            moved = [points[0], points[1]]
            moved[axis] = moved[axis] + shift
            inside = np.ones(missing.size, dtype=bool)
            if surface.periodic:
                moved[axis] = moved[axis] % shape[axis]
            else:
                inside = (moved[axis] >= 0) & (moved[axis] < shape[axis])
            neighbour = moved[0][inside] * shape[1] + moved[1][inside]
            links.append((np.flatnonzero(inside), neighbour, (smallest / surface.grid.spacing[axis]) ** 2))
    return links
