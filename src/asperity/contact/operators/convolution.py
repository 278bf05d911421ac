"""Dense forms of the two convolutions, for small grids and as reference for the fast ones."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import RealArray
from ...core.errors import InputError

LARGEST_DENSE = 4096
"""Largest number of points for a dense matrix (134 MB); its factorisations take seconds."""


def _offsets(n: int) -> NDArray[np.int_]:
    return np.arange(n)[:, None] - np.arange(n)[None, :]


def circulant_matrix(response: RealArray) -> RealArray:
    """Matrix (n, n) of the periodic convolution with ``response`` (nx, ny) to a unit load at node (0, 0).

    Raises
    ------
    InputError
        If the grid has more than ``LARGEST_DENSE`` points.
    """
    nx, ny = _small(response)
    i, j = _offsets(nx) % nx, _offsets(ny) % ny
    matrix: RealArray = response[i[:, None, :, None], j[None, :, None, :]].reshape(nx * ny, nx * ny)
    return matrix


def toeplitz_matrix(influence: RealArray) -> RealArray:
    """Matrix (n, n) of the free convolution with even ``influence`` (nx, ny) at non-negative offsets.

    Raises
    ------
    InputError
        If the grid has more than ``LARGEST_DENSE`` points.
    """
    nx, ny = _small(influence)
    i, j = np.abs(_offsets(nx)), np.abs(_offsets(ny))
    matrix: RealArray = influence[i[:, None, :, None], j[None, :, None, :]].reshape(nx * ny, nx * ny)
    return matrix


def _small(kernel: RealArray) -> tuple[int, int]:
    nx, ny = kernel.shape
    if nx * ny > LARGEST_DENSE:
        raise InputError(
            f"grid of a dense method must have at most {LARGEST_DENSE} points, but has {nx} x {ny} = {nx * ny}. "
            "Use ConjugateGradient() on larger grids."
        )
    return nx, ny
