"""Invariants and principal stresses: definitions, rotation, repeated eigenvalues, precision."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from asperity.core.tensor import StressTensor, second_invariant
from asperity.physics.stress import criteria as invariants

EPS = np.finfo(float).eps


def tensor(matrix):
    m = np.asarray(matrix, dtype=float)
    return StressTensor(m[..., 0, 0], m[..., 1, 1], m[..., 2, 2], m[..., 0, 1], m[..., 0, 2], m[..., 1, 2])


def matrices(s):
    rows = [[s.xx, s.xy, s.xz], [s.xy, s.yy, s.yz], [s.xz, s.yz, s.zz]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def random_matrices(n, seed=0):
    m = np.random.default_rng(seed).standard_normal((n, 3, 3))
    return m + m.swapaxes(1, 2)


def turned(eigenvalues, n=500):
    """Symmetric matrices of given ``eigenvalues`` in random directions."""
    q = np.linalg.qr(np.random.default_rng(1).standard_normal((n, 3, 3)))[0]
    m = np.einsum("nij,j,nkj->nik", q, np.asarray(eigenvalues, float), q)
    return 0.5 * (m + m.swapaxes(1, 2))


def assert_principal(m):
    """Eigenvalues within roundings of the largest, directions orthonormal and true."""
    s = tensor(m)
    size = np.maximum(np.linalg.norm(m, axis=(-2, -1)), 1e-300)
    values, directions = invariants.principal_stresses(s), invariants.principal_directions(s)
    wanted = np.linalg.eigvalsh(m)[..., ::-1]
    np.testing.assert_array_less(np.abs(np.moveaxis(values, 0, -1) - wanted) / size[..., None], 20 * EPS)
    for value, direction in zip(values, directions, strict=True):
        n = np.moveaxis(direction, 0, -1)
        residual = np.linalg.norm(np.einsum("...ij,...j->...i", m, n) - value[..., None] * n, axis=-1)
        np.testing.assert_array_less(residual / size, 20 * EPS)
    gram = np.einsum("ai...,bi...->...ab", directions, directions)
    np.testing.assert_allclose(gram, np.broadcast_to(np.eye(3), gram.shape), atol=20 * EPS)


@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e10])
def test_principal_stresses_are_the_eigenvalues(scale):
    assert_principal(scale * random_matrices(3000))


@pytest.mark.parametrize(
    "eigenvalues",
    [(1, 1, -2), (3, -1, -1), (2, 2, 2), (1, 1 + 1e-13, 1), (1, 1 - 1e-9, -2), (1, 1 - 1e-5, -2), (0, 0, 0), (5, 0, 0)],
    ids=str,
)
def test_repeated_and_nearly_repeated_principal_stresses_keep_all_digits(eigenvalues):
    assert_principal(turned(eigenvalues))


@given(arrays(float, (3, 3), elements=st.floats(-1e9, 1e9)))
def test_principal_stresses_of_any_matrix(m):
    m[np.abs(m) < 1e-100] = 0.0  # squares of anything smaller may underflow
    assert_principal((m + m.T)[None])


def test_definitions_on_simple_states():
    tension = tensor(np.diag([7.0, 0.0, 0.0]))
    assert invariants.von_mises(tension) == pytest.approx(7.0)
    assert invariants.sqrt_J2(tension) == pytest.approx(7.0 / np.sqrt(3.0))
    assert invariants.tresca(tension) == pytest.approx(7.0)
    assert invariants.max_shear(tension) == pytest.approx(3.5)
    assert invariants.hydrostatic(tension) == pytest.approx(7.0 / 3.0)
    shear = tensor([[0.0, 2.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    assert invariants.sqrt_J2(shear) == pytest.approx(2.0)
    assert invariants.principal_tensile(shear) == pytest.approx(2.0)
    assert invariants.tresca(shear) == pytest.approx(4.0)


def test_invariants_do_not_change_under_rotation():
    m = random_matrices(100)
    q = np.linalg.qr(np.random.default_rng(3).standard_normal((3, 3)))[0]
    for function in (second_invariant, invariants.hydrostatic, invariants.tresca):
        np.testing.assert_allclose(function(tensor(q @ m @ q.T)), function(tensor(m)), atol=1e-13)


def test_bounds_between_the_invariants():
    """√J2 lies between the largest shear stress and 2/√3 of it; von Mises never exceeds Tresca; σt
    never exceeds σ1."""
    s = tensor(random_matrices(2000))
    root, shear = invariants.sqrt_J2(s), invariants.max_shear(s)
    assert (root >= shear * (1.0 - 10 * EPS)).all()
    assert (root <= 2.0 / np.sqrt(3.0) * shear * (1.0 + 10 * EPS)).all()
    assert (invariants.von_mises(s) <= invariants.tresca(s) * (1.0 + 10 * EPS)).all()
    largest = invariants.principal_stresses(s)[0]
    assert (invariants.principal_tensile(s) <= largest + 20 * EPS * np.abs(largest).max()).all()


def test_principal_tensile_is_the_largest_on_a_free_surface_in_tension():
    m = random_matrices(500)
    m[:, 2, :] = m[:, :, 2] = 0.0
    s = tensor(m)
    tensile = invariants.principal_tensile(s)
    np.testing.assert_allclose(
        np.maximum(tensile, 0.0), np.maximum(invariants.principal_stresses(s)[0], 0.0), atol=1e-14
    )


def test_plane_of_the_largest_shear_stress():
    """The traction on it, less its normal part, is the largest shear stress."""
    s = tensor(random_matrices(200))
    n = np.moveaxis(invariants.max_shear_normal(s), 0, -1)
    traction = np.einsum("...ij,...j->...i", matrices(s), n)
    along = traction - np.sum(traction * n, axis=-1, keepdims=True) * n
    np.testing.assert_allclose(np.linalg.norm(along, axis=-1), invariants.max_shear(s), atol=1e-13)


def test_single_precision_stays_single():
    s = tensor(random_matrices(50)).map(lambda v: v.astype(np.float32))
    for function in (
        invariants.von_mises,
        invariants.sqrt_J2,
        invariants.hydrostatic,
        invariants.principal_tensile,
        invariants.principal_stresses,
        invariants.max_shear,
        invariants.max_shear_normal,
    ):
        assert function(s).dtype == np.float32
    wanted = invariants.principal_stresses(s.map(lambda v: v.astype(float)))
    np.testing.assert_allclose(invariants.principal_stresses(s), wanted, atol=2e-5)


def test_any_shape_and_size():
    for shape in ((), (1,), (3, 4, 5), (0, 2)):
        s = StressTensor(*np.random.default_rng(2).standard_normal((6, *shape)))
        assert invariants.principal_stresses(s).shape == (3, *shape)
        assert invariants.max_shear_normal(s).shape == (3, *shape)
