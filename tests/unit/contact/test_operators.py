"""Operators: symmetric, positive, translation invariant, equal to their dense matrices and to
independent sums."""

import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused

import asperity as asp
from asperity.contact.operators.convolution import Octaves
from asperity.solids.compliance.halfspace import HalfSpace
from asperity.solids.compliance.influence import patch_displacement

SHAPES = st.tuples(st.integers(1, 9), st.integers(1, 9))
BOUNDARIES = st.sampled_from([asp.Periodic(), asp.Free()])
few = settings(max_examples=40)


def prepared(shape, boundary, spacing=(1.0, 1.4)):
    return asp.solvers.prepare_operator(HalfSpace(2.0), asp.Grid(shape, spacing), boundary)


@few
@given(SHAPES, BOUNDARIES, st.integers(0, 999))
def test_matrix_is_the_operator_and_is_symmetric_and_positive(shape, boundary, seed):
    operator = prepared(shape, boundary)
    p = np.random.default_rng(seed).standard_normal(shape)
    dense = operator.matrix()
    scale = np.abs(dense).max() or 1.0
    np.testing.assert_allclose(dense @ p.ravel(), operator.apply(p).ravel(), rtol=0, atol=1e-12 * scale * p.size)
    np.testing.assert_allclose(dense, dense.T, rtol=0, atol=1e-13 * scale)
    assert np.linalg.eigvalsh(dense).min() > -1e-12 * scale * p.size


@few
@given(SHAPES, st.integers(0, 999))
def test_free_is_the_direct_double_sum_of_patches(shape, seed):
    operator = prepared(shape, asp.Free())
    p = np.random.default_rng(seed).random(shape)
    x, y = operator.grid.coordinates()
    direct = sum(
        p[i, j] * patch_displacement(x - x[i, 0], y - y[0, j], 1.0, 1.4) / 2.0
        for i in range(shape[0])
        for j in range(shape[1])
    )
    np.testing.assert_allclose(operator.apply(p), direct, rtol=1e-12)


@few
@given(st.integers(2, 12), st.integers(1, 12), st.integers(0, 5))
def test_periodic_wave_gives_its_displacement(nx, ny, k):
    """u = 2 / (E' q) p for a cosine (Johnson 1985, ch. 13); nothing for a uniform pressure."""
    operator = prepared((nx, ny), asp.Periodic())
    x, y = operator.grid.coordinates()
    k = k % (nx // 2 + 1)
    q = 2 * np.pi * k / operator.grid.size[0]
    p = np.cos(q * x) + 0.0 * y
    expected = p * (2.0 / (2.0 * q)) if k else 0.0 * p
    np.testing.assert_allclose(operator.apply(p), expected, rtol=0, atol=1e-12)


@few
@given(st.tuples(st.integers(1, 40), st.integers(1, 40)))
def test_coarse_kernel_is_part_of_the_fine_one(shape):
    """Every wave of the coarse grid is one of the fine grid, for even and odd numbers of points."""
    coarse = prepared(shape, asp.Periodic()).coarsened
    expected = asp.solvers.prepare_operator(coarse.compliance, coarse.grid, asp.Periodic())
    np.testing.assert_allclose(coarse.kernel, expected.kernel, rtol=1e-13)


def test_pressure_is_left_alone():
    for boundary in (asp.Periodic(), asp.Free()):
        p = np.random.default_rng(0).random((6, 6))
        kept = p.copy()
        operator = prepared((6, 6), boundary)
        first = operator.apply(p)
        second = operator.apply(2.0 * p)
        np.testing.assert_array_equal(p, kept)
        np.testing.assert_allclose(second, 2.0 * first, rtol=1e-13)


def test_dense_form_of_a_large_grid_is_refused():
    for boundary in (asp.Periodic(), asp.Free()):
        with refused(asp.InputError, "grid of a dense method", "4096"):
            prepared((100, 100), boundary).matrix()


def test_octaves_are_computed_once_for_all_grids_and_boundaries():
    asked = []

    class Counted(HalfSpace):
        def spectral(self, wavenumber):
            asked.append(len(wavenumber))
            return super().spectral(wavenumber)

    body = Counted(2.0)
    for boundary, computed in ((asp.Periodic(), 1), (asp.Free(), 0)):
        operator = asp.solvers.prepare_operator(body, asp.Grid((64, 48), (0.3, 0.3)), boundary)
        coarser = operator.coarsened
        assert coarser.octaves is operator.octaves
        asked.clear()
        for side in (0.6, 0.3):  # the coarser grid comes first
            q = np.pi / (side * 2.0 ** np.arange(5))
            np.testing.assert_allclose(operator.octaves.spectral(q), body.spectral(q), rtol=1e-8)
        assert asked.count(5) == 2  # the two of this test
        assert len(asked) == 2 + computed


def test_octaves_that_several_threads_ask_for_are_computed_once():
    """As by the chains of a history; the one that comes second waits for the values of the
    first."""
    asked = []

    class Slow(HalfSpace):
        def spectral(self, wavenumber):
            asked.append(len(wavenumber))
            time.sleep(0.05)
            return super().spectral(wavenumber)

    octaves, q = Octaves(Slow(2.0)), np.pi / 2.0 ** np.arange(5)
    with ThreadPoolExecutor(3) as pool:
        found = list(pool.map(octaves.spectral, [q] * 3))
    assert len(asked) == 1
    for values in found:
        np.testing.assert_allclose(values, HalfSpace(2.0).spectral(q), rtol=1e-8)
