"""Linear systems of finite elements: some unknowns are prescribed, the others follow from a sparse factorisation or from multigrid."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from ..core.arrays import BoolArray, RealArray
from ..core.errors import ConvergenceError, InputError


def without(matrix: sparse.csc_array, prescribed: BoolArray) -> sparse.csc_array:
    """``matrix`` with rows and columns of the ``prescribed`` unknowns replaced by those of a diagonal as large as the others."""
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


def multigrid(
    matrix: sparse.csc_array, rigid: RealArray, *, tolerance: float = 1e-10
) -> Callable[[RealArray], RealArray]:
    """What solves a large symmetric ``matrix`` x = b by conjugate gradients with smoothed aggregation (Vaněk, Mandel and Brezina 1996).

    ``rigid``: (unknowns, modes) displacements of the rigid body, which the coarse grids must carry; ``tolerance``: relative residual.

    Raises
    ------
    InputError
        If pyamg is missing.
    ConvergenceError
        If the residual does not fall below the tolerance.
    """
    try:
        import pyamg
    except ImportError as error:
        raise InputError(
            'large meshes in space must be solved with pyamg, but is not installed. Install it with pip install "asperity[fem]".'
        ) from error
    rows = sparse.csr_matrix(matrix)
    levels = pyamg.smoothed_aggregation_solver(rows, B=rigid, max_coarse=500)

    def solve(right: RealArray) -> RealArray:
        if right.ndim == 2:
            return np.stack([solve(column) for column in right.T], axis=1)
        size = float(np.linalg.norm(right))
        if size == 0.0:
            return np.zeros_like(right)
        found = np.asarray(levels.solve(right, tol=tolerance, accel="cg", maxiter=300))
        left = float(np.linalg.norm(rows @ found - right))
        if left > 10.0 * tolerance * size:
            raise ConvergenceError(
                f"Multigrid leaves a residual of {left / size:.1e} after 300 steps. Use a finer mesh or the direct solver."
            )
        return found

    return solve
