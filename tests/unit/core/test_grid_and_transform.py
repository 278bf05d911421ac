"""Orientation, sizes, wavevectors and the transform pair, with both FFT libraries."""

import importlib.util
import os
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

import asperity as asp
from asperity.core import spectral
from asperity.core.spectral import RealTransform, SplitTransform, fast_length, thread_count

SHAPES = st.tuples(st.integers(1, 17), st.integers(1, 17))


def test_orientation():
    """Axis 0 is x, axis 1 is y: a wave along x has its power at (k, 0)."""
    grid = asp.Grid((8, 6), (0.5, 2.0))
    x, y = grid.coordinates()
    assert (x.shape, y.shape) == ((8, 1), (1, 6))
    wave = np.cos(2 * np.pi * 3 * x / grid.size[0]) + 0.0 * y
    power = np.abs(RealTransform(grid.shape).forward(wave))
    assert np.unravel_index(power.argmax(), power.shape)[1] == 0
    qx, qy = grid.wavevector()
    assert qx[3, 0] == pytest.approx(2 * np.pi * 3 / 4.0)
    assert qy[0, 1] == pytest.approx(2 * np.pi / 12.0)
    assert grid.wavenumber()[3, 1] == pytest.approx(np.hypot(qx[3, 0], qy[0, 1]))


def test_sizes():
    grid = asp.Grid((8, 6), (0.5, 2.0))
    assert grid.size == (4.0, 12.0)
    assert grid.area == 48.0
    assert grid.pixel_area == 1.0
    assert grid.n_points == 48
    x, y = grid.centred_coordinates()
    assert x[4, 0] == 0.0
    assert y[0, 3] == 0.0


def test_counts_and_spacings_come_back_in_their_type():
    grid = asp.Grid((4.0, np.int64(6)), (1, np.float32(0.5)))
    assert grid == asp.Grid((4, 6), (1.0, 0.5))
    assert [type(value) for value in (*grid.shape, *grid.spacing)] == [int, int, float, float]


@pytest.mark.parametrize(
    ("shape", "spacing", "subject", "shown"),
    [
        ((0, 4), (1, 1), "number of grid points along x", "0"),
        ((4, 4), (0, 1), "grid spacing along x (m)", "0"),
        ((4, 4), (1, -1), "grid spacing along y (m)", "-1"),
        ((4.5, 4), (1, 1), "number of grid points along x", "4.5"),
        ((4, 4), (np.nan, 1), "grid spacing along x (m)", "nan"),
        (5, (1, 1), "grid shape", "5"),
        ((4, 4), 1.0, "grid spacing", "1.0"),
    ],
)
def test_bad_grids(shape, spacing, subject, shown):
    with refused(asp.InputError, subject, shown):
        asp.Grid(shape, spacing)


@pytest.mark.parametrize("library", ["ducc0", "numpy"])
@given(shape=SHAPES, seed=st.integers(0, 999))
def test_transform_pair_is_numpys_with_either_library(library, shape, seed):
    if library == "ducc0" and not importlib.util.find_spec("ducc0"):
        assert os.environ.get("CI", "").lower() not in {"1", "true"}, "CI must install the extra 'fast'"
        pytest.skip("the extra 'fast' is not installed")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(spectral, "fft_library", lambda: library)
        transform = RealTransform(shape, threads=2)
        field = np.random.default_rng(seed).standard_normal(shape)
        spectrum = transform.forward(field)
        assert spectrum.shape == transform.spectrum_shape
        np.testing.assert_allclose(spectrum, np.fft.rfft2(field), rtol=0, atol=1e-12)
        np.testing.assert_allclose(transform.backward(spectrum.copy()), field, rtol=0, atol=1e-13)
        out, back = np.empty_like(spectrum), np.empty_like(field)
        transform.forward(field, out)
        transform.backward(out.copy(), back)
        np.testing.assert_allclose(back, field, rtol=0, atol=1e-13)


@pytest.mark.parametrize("library", ["ducc0", "numpy"])
@pytest.mark.parametrize(("dtype", "rounding"), [("float64", 1e-13), ("float32", 1e-4)])
@given(shape=SHAPES | st.just((130, 5)) | st.just((130, 1024)), seed=st.integers(0, 9))
def test_inverse_in_two_steps_and_parts(library, dtype, rounding, shape, seed):
    """Lines and rows in parts of seven and of seventy, the latter longer than the blocks of rows of
    4 kB."""
    if library == "ducc0" and not importlib.util.find_spec("ducc0"):
        pytest.skip("the extra 'fast' is not installed")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(spectral, "fft_library", lambda: library)
        transform = SplitTransform(shape)
        field = np.random.default_rng(seed).standard_normal(shape).astype(dtype)
        spectrum = transform.forward(field)
        np.testing.assert_allclose(spectrum, np.fft.rfft2(field.astype(float)).T, rtol=0, atol=10 * rounding)
        (between,), (made,) = transform.between(1, spectrum.dtype), transform.lines(1, 7, spectrum.dtype)
        for start in range(0, len(spectrum), 7):
            lines = spectrum[start : start + 7]
            made[: len(lines), : shape[0]] = lines
            transform.lines_back(made, (start, start + len(lines)), between)
        back = np.empty_like(field)
        for start in range(0, shape[0], 70):
            rows = slice(start, min(shape[0], start + 70))
            transform.rows_back(between, (rows.start, rows.stop), back[rows])
        assert back.dtype == dtype
        np.testing.assert_allclose(back, field, rtol=0, atol=rounding)


def test_numpy_serves_where_ducc_is_missing(monkeypatch):
    monkeypatch.setitem(sys.modules, "ducc0", None)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    assert spectral.fft_library() == "numpy"


@given(st.integers(1, 5000))
def test_fast_length_has_small_factors_and_is_close(minimum):
    length = fast_length(minimum)
    assert minimum <= length <= 1.15 * minimum + 1
    for prime in (2, 3, 5, 7, 11):
        while length % prime == 0:
            length //= prime
    assert length == 1


def test_thread_count(monkeypatch):
    assert thread_count(3) == 3
    monkeypatch.setenv("ASPERITY_THREADS", "5")
    assert thread_count() == 5
    assert thread_count(2) == 2
    monkeypatch.delenv("ASPERITY_THREADS")
    assert thread_count() >= 1
    for bad in ("zero", "0", "-1", ""):
        monkeypatch.setenv("ASPERITY_THREADS", bad)
        with refused(asp.InputError, "environment variable ASPERITY_THREADS"):
            thread_count()
    with refused(asp.InputError, "number of threads"):
        thread_count(0)


def test_pixels_are_those_of_the_axes_that_have_points() -> None:
    """The one row of a line is as wide as its strip, which is no pixel."""
    assert asp.Grid((8, 4), (2.0, 3.0)).pixels == (2.0, 3.0)
    assert asp.Grid((8, 1), (2.0, 1e3)).pixels == (2.0,)
    assert asp.Grid((1, 8), (1e3, 3.0)).pixels == (3.0,)
    assert asp.Grid((1, 1), (2.0, 3.0)).pixels == (2.0,)
