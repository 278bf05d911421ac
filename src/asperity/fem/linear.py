"""Linear systems of finite elements: some unknowns are prescribed, the others follow from a sparse
factorisation."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from ..core.arrays import BoolArray, RealArray
from ..core.errors import ConvergenceError


def without(matrix: sparse.csc_array, prescribed: BoolArray) -> sparse.csc_array:
    """``matrix`` with rows and columns of the ``prescribed`` unknowns replaced by those of a
    diagonal as large as the others."""
    columns = np.repeat(np.arange(matrix.shape[1]), np.diff(matrix.indptr))
    diagonal = matrix.indices == columns
    touched = prescribed[matrix.indices] | prescribed[columns]
    scale = float(np.abs(matrix.data[diagonal]).mean())
    data = np.where(touched, np.where(diagonal, scale, 0.0), matrix.data)
    return sparse.csc_array((data, matrix.indices, matrix.indptr), shape=matrix.shape)


def factorised(matrix: sparse.csc_array, *, symmetric: bool = True) -> Callable[[RealArray], RealArray]:
    """What solves ``matrix`` x = b for right-hand sides (unknowns,) or (unknowns, several).

    Raises
    ------
    ConvergenceError
        If the matrix is singular: a body that is not held, or a collapse of perfect plasticity.
    """
    options: dict[str, Any] = {"permc_spec": "COLAMD"}
    if symmetric:
        options = {"permc_spec": "MMD_AT_PLUS_A", "diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}
    try:
        solve: Callable[[RealArray], RealArray] = splu(matrix, **options).solve
    except RuntimeError as error:
        raise ConvergenceError(
            f"The stiffness is singular ({error}). Hold the body, take smaller steps, or give a little hardening."
        ) from error
    return solve


def held(matrix: sparse.csc_array, known: RealArray, prescribed: BoolArray) -> RealArray:
    """Displacement (unknowns,) in m of an elastic body with the stiffness ``matrix`` whose
    ``prescribed`` unknowns have the ``known`` values, and on which no other force acts.

    ConvergenceError if it is not held.
    """
    start = np.where(prescribed, known, 0.0)
    right = np.where(prescribed, 0.0, -(matrix @ start))
    return np.asarray(start + factorised(without(matrix, prescribed))(right))
