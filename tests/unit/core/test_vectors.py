"""Convolutions with tensors and nested cells for vectors."""

import numpy as np
import pytest
from contact_cases import rough

import asperity as asp
from asperity.core.engine.vectors import VectorCells
from asperity.physics.friction.operator import TangentialOperator
from asperity.physics.friction.solver.nested_cells import PIXEL_SHARE, hierarchies


def model(shape, hierarchy):
    """1 + sum over cells of w 1 1^T, from the places of the points alone."""
    x, y = ((axis.ravel() + roll) % n for axis, roll, n in zip(np.indices(shape), hierarchy.roll, shape, strict=True))
    matrix = np.eye(x.size)
    for merge in hierarchy.merges:
        x = (x + merge.offset_x) // 2 if merge.x else x
        y = (y + merge.offset_y) // 2 if merge.y else y
        matrix += merge.weight * ((x[:, None] == x) & (y[:, None] == y))
    return matrix


@pytest.mark.parametrize("shape", [(2, 2), (4, 4), (8, 8), (16, 16), (8, 2), (32, 8)], ids=str)
def test_the_model_has_an_inverse_in_full_contact(shape):
    """Also where a uniform load deflects by nothing, and half the grid is hardly larger than a
    point."""
    operator = TangentialOperator(asp.Grid(shape, (1.0, 1.0)), (asp.Elastic(1.0, 0.3), asp.Rigid()))
    for hierarchy in hierarchies(operator.octaves, operator.grid, periodic=True, share=PIXEL_SHARE, mean=0.0):
        assert np.linalg.eigvalsh(model(shape, hierarchy))[0] > 0.1


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("shape", [(1, 1), (9, 1), (5, 8), (12, 7), (16, 16)], ids=str)
def test_cells_of_vectors_are_inverted_exactly(shape, periodic):
    """Points that yield both ways, along a direction of their own, or not at all: (A
    A^T)-constrained inverse of the dense model."""
    rng = np.random.default_rng(shape)
    operator = TangentialOperator(asp.Grid(shape, (1.0, 1.0)), (asp.Elastic(1.0, 0.3), asp.Rigid()))
    nested = hierarchies(operator.octaves, operator.grid, periodic=periodic, share=0.6)
    cells = VectorCells(operator.engine, shape, nested, "float64")
    for share in (0.3, 1.0):
        index = np.flatnonzero(rng.uniform(size=shape[0] * shape[1]) < share)
        n = len(index)
        free = operator.engine.points(shape, index, "float64")
        angle, factor = rng.uniform(0.0, 2.0 * np.pi, n), rng.uniform(0.1, 1.0, n)
        t, kind = np.stack([np.cos(angle), np.sin(angle)]), rng.integers(0, 3, n)
        whole = kind == 0
        entry = [np.where(whole, 1.0 if i == j else 0.0, factor * t[i] * t[j]) for i, j in ((0, 0), (0, 1), (1, 1))]
        conductance = np.stack(entry) * (kind < 2)
        cells.factorise(free, conductance)
        r = rng.standard_normal((2, n))
        found = cells.solve(free, r, conductance)
        wanted = np.zeros((2, n))
        for hierarchy in nested:
            own = model(shape, hierarchy)[np.ix_(index, index)] - np.eye(n)
            tensor = np.zeros((2 * n, 2 * n))
            for number, (i, j) in enumerate(((0, 0), (0, 1), (1, 0), (1, 1))):
                tensor[i * n : (i + 1) * n, j * n : (j + 1) * n] = np.diag(conductance[(0, 1, 1, 2)[number]])
            # z = G (r - W z): each point yields by its conductance to what the cells leave
            both = np.kron(np.eye(2), own)
            wanted += 0.5 * np.linalg.solve(np.eye(2 * n) + tensor @ both, tensor @ r.ravel()).reshape(2, n)
        np.testing.assert_allclose(found, wanted, atol=1e-12 * (1.0 + np.abs(r).sum()))


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()])
@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_all_three_components_at_once(boundary, dtype):
    body = asp.Layered([asp.Layer(asp.Elastic(4.0, 0.25), 1.5)], base=asp.Elastic(1.0, 0.3))
    problem = asp.ContactProblem(rough((18, 20), 1), body, boundary=boundary)
    normal = asp.solvers.prepare_operator(problem.compliance, problem.grid, boundary)
    shear = TangentialOperator(problem.grid, (body, asp.Rigid()), boundary)
    rng = np.random.default_rng(0)
    q, p = rng.standard_normal((2, 18, 20)), rng.standard_normal((18, 20))
    u = np.empty((3, 18, 20), dtype)
    shear.coupled_convolution(dtype, normal).apply((q[0].astype(dtype), q[1].astype(dtype), p.astype(dtype)), tuple(u))
    wanted = np.concatenate([shear.displacement(q) + shear.drawn(p), (normal.apply(p) + shear.lift(q))[None]])
    assert np.abs(u - wanted).max() <= 50.0 * np.finfo(dtype).eps * np.abs(wanted).max()
