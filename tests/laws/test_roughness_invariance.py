"""Laws that hold for every surface: turning, shifting, scaling, tilting and levelling, Parseval,
holes."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import asperity as asp
from asperity import roughness as r
from asperity.theories import Persson

GENERAL = {"max_examples": 20}
SIGNED = ("heights.Ssk",)
X_AND_Y = ("_x", "_y")


@st.composite
def surfaces(draw, *, holes: bool = True) -> asp.Surface:
    """Rough maps of any side and pixel, periodic or not, smooth over some pixels, with or without
    holes."""
    shape = (draw(st.integers(12, 40)), draw(st.integers(12, 40)))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    heights = rng.standard_normal(shape)
    for _ in range(draw(st.integers(0, 2))):
        heights = sum(np.roll(heights, (i, j), (0, 1)) for i in range(3) for j in range(2))
    periodic = draw(st.booleans())
    if holes and not periodic and draw(st.booleans()):
        heights[rng.random(shape) < 0.03] = np.nan
    return asp.Surface(heights, draw(st.floats(0.3, 3.0)), draw(st.floats(0.3, 3.0)), periodic=periodic)


def exchanged(path: str) -> str:
    """Path of the same number after x and y have changed places."""
    for one, other in (("_x", "_y"), ("_y", "_x")):
        if path.endswith(one) or f"{one}." in path:
            return path.replace(one, other)
    return path


@pytest.fixture(scope="module", autouse=True)
def without_fit() -> Iterator[None]:
    """The fit takes nine tenths of the time and is equal only to the accuracy of an optimum; it has
    tests of its own."""

    def refused(*_: object, **__: object) -> None:
        raise asp.InputError("the spectrum is not fitted here")

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("asperity.surfaces.characterise.summary.fit_spectrum", refused)
        yield


def numbers(surface: asp.Surface) -> dict[str, float]:
    return {quantity.name: value for quantity, value in asp.characterise(surface).values()}


UNITS = {quantity.name: quantity.unit for quantity in r.QUANTITIES}


def comparable(path: str) -> bool:
    return UNITS[path] != "rad"  # angles may turn about


@settings(**GENERAL)
@given(surface=surfaces())
def test_exchanging_the_axes(surface):
    turned = asp.Surface(surface.heights.T, surface.dy, surface.dx, periodic=surface.periodic)
    before, after = numbers(surface), numbers(turned)
    for path, value in before.items():
        # Sal and Str sample rays at whole degrees, mirrored about the diagonal alike
        if comparable(path):
            assert after[exchanged(path)] == pytest.approx(value, rel=1e-8, abs=1e-10, nan_ok=True), path


@settings(**GENERAL)
@given(surface=surfaces())
def test_turning_by_a_right_angle(surface):
    turned = asp.Surface(np.rot90(surface.heights), surface.dy, surface.dx, periodic=surface.periodic)
    before, after = numbers(surface), numbers(turned)
    for path, value in before.items():
        # the Hann window is that of periodic sequences, largest at n/2 and zero at 0 but not at n -
        # 1
        windowed = path.startswith(("moments.spectral", "sampling")) and not surface.periodic
        if comparable(path) and not windowed:
            assert after[exchanged(path)] == pytest.approx(value, rel=1e-7, abs=1e-9, nan_ok=True), path


@settings(**GENERAL)
@given(
    surface=surfaces(holes=False),
    shift=st.tuples(st.integers(0, 30), st.integers(0, 30)),
    offset=st.floats(-50.0, 50.0),
)
def test_shifting(surface, shift, offset):
    moved = np.roll(surface.heights, shift, (0, 1)) if surface.periodic else surface.heights
    other = asp.Surface(moved + offset, surface.dx, surface.dy, periodic=surface.periodic)
    before, after = numbers(surface), numbers(other)
    for path, value in before.items():
        if comparable(path):
            # an offset of 50 rounds heights of 1 by 1e-14, which counts where summits or crossings
            # decide
            assert after[path] == pytest.approx(value, rel=1e-7, abs=1e-9, nan_ok=True), path


POWERS = {"1": (0, 0), "m**-1": (1, -2), "m**-2": (0, -2), "m**2": (2, 0), "m**4": (2, 2)}
HEIGHTS = ("heights.", "functional.", "summits.eight.mean_height", "summits.eight.height_deviation", "peaks")


def power(path: str) -> tuple[int, int]:
    """Powers of the scales of heights and of lengths with which a number goes."""
    name = path.rsplit(".", 1)[-1]
    unit = UNITS[path]
    if name in ("Sdq",):
        return 1, -1
    if name in ("m2_x", "m2_y", "m2"):
        return 2, -2
    if name in ("m4_x", "m4_y", "m4"):
        return 2, -4
    if name in ("density", "zero_crossings"):
        return 0, -2 if unit == "m**-2" else -1
    if name in ("radius", "mean_radius"):
        return -1, 2
    if name == "amplitude":
        return 2, -1
    if unit == "m":
        return (1, 0) if path.startswith(HEIGHTS) else (0, 1)
    return POWERS[unit]


@settings(**GENERAL)
@given(surface=surfaces(), scale=st.floats(0.1, 10.0), stretch=st.floats(0.1, 10.0))
def test_scaling(surface, scale, stretch):
    other = asp.Surface(scale * surface.heights, stretch * surface.dx, stretch * surface.dy, periodic=surface.periodic)
    before, after = numbers(surface), numbers(other)
    for path, value in before.items():
        # the developed area is no power law of the heights; G mixes both scales
        if not comparable(path) or path.endswith((".Sdr", ".roughness", ".tip_cutoff")):
            continue
        heights, lengths = power(path)
        expected = value * scale**heights * stretch**lengths
        assert after[path] == pytest.approx(
            expected, rel=1e-7, abs=1e-9 * scale**heights * stretch**lengths, nan_ok=True
        ), path


@settings(**GENERAL)
@given(surface=surfaces())
def test_turning_over(surface):
    """h → -h: Ssk changes sign, peaks and valleys change places."""
    before, after = (
        numbers(surface),
        numbers(asp.Surface(-surface.heights, surface.dx, surface.dy, periodic=surface.periodic)),
    )
    assert after["heights.Ssk"] == pytest.approx(-before["heights.Ssk"], abs=1e-12)
    assert after["heights.Sp"] == pytest.approx(before["heights.Sv"], rel=1e-9, abs=1e-12)
    for path in ("heights.Sq", "hybrid.Sdq", "spatial.Sal", "moments.difference.m4_x", "moments.spectral.m2"):
        assert after[path] == pytest.approx(before[path], rel=1e-9, nan_ok=True), path


@given(skew=st.floats(-0.6, 0.6))
def test_turning_over_exchanges_peaks_and_valleys(skew):
    normal = np.random.default_rng(5).standard_normal(20_000)
    curves = [
        r.material_ratio_curve(asp.Surface((sign * np.exp(skew * normal)).reshape(100, 200), 1.0)) for sign in (1, -1)
    ]
    if abs(skew) < 1e-3:
        return  # nearly equal heights
    one, other = (r.functional_parameters(curve) for curve in curves)
    # near its least value the slope of the secant hardly differs between windows some per cent
    # apart
    assert other.Spk == pytest.approx(one.Svk, rel=0.05)
    assert other.Svk == pytest.approx(one.Spk, rel=0.05)
    assert other.Smr1 == pytest.approx(1.0 - one.Smr2, abs=0.02)
    assert other.Sk == pytest.approx(one.Sk, rel=0.02)
    assert other.Vmp == pytest.approx(one.Vvv - curves[0].void_volume(0.8) + curves[0].void_volume(0.9), rel=1e-6)


@settings(**GENERAL)
@given(
    surface=surfaces(),
    tilt=st.tuples(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0)),
    form=st.sampled_from(["plane", "quadratic"]),
)
def test_tilt_is_levelled_away(surface, tilt, form):
    x, y = surface.grid.coordinates()
    tilted = asp.Surface(surface.heights + tilt[0] * x + tilt[1] * y, surface.dx, surface.dy)
    plain = asp.levelled(asp.Surface(surface.heights, surface.dx, surface.dy), form)
    before, after = numbers(plain), numbers(asp.levelled(tilted, form))
    for path, value in before.items():
        if comparable(path):
            assert after[path] == pytest.approx(value, rel=1e-6, abs=1e-8, nan_ok=True), path
    assert r.tilt_share(plain) < 1e-20 if not surface.n_missing else r.tilt_share(plain) < 1e-2


@given(surface=surfaces(holes=False), window=st.sampled_from(["none", "hann", "radial hann"]))
def test_parseval(surface, window):
    spectrum = r.power_spectrum(surface, window)
    if window == "none":
        assert spectrum.mean_square == pytest.approx(asp.roughness.rms_height(surface) ** 2, rel=1e-12)
        for axis in "xy":
            lines = r.profile_spectrum(surface, axis=axis, window="none")
            number = "xy".index(axis)
            z = surface.heights - surface.heights.mean(axis=number, keepdims=True)
            n, length = surface.shape[number], surface.size[number]
            twice = np.full(lines.psd.size, 2.0)
            if n % 2 == 0:
                twice[-1] = 1.0
            assert float(twice @ lines.psd) / length == pytest.approx(np.mean(z**2), rel=1e-10)
    rings = r.radial_spectrum(spectrum, np.array([0.0, 1e9]))
    assert rings.modes.tolist() == [surface.grid.n_points - 1]
    total = float(rings.psd[0] * rings.modes[0]) / surface.grid.area
    assert total == pytest.approx(spectrum.mean_square, rel=1e-12)


@given(surface=surfaces(holes=False))
def test_lines_and_map_have_one_spectrum(surface):
    """<C1D> over the lines is the sum of C over the waves across them, exactly."""
    plane = r.power_spectrum(surface, "none").psd
    lines = r.profile_spectrum(surface, axis="y", window="none").psd
    length = surface.size[0]
    assert lines == pytest.approx(plane[:, 1:].sum(axis=0) / length, rel=1e-9, abs=1e-12)


@given(surface=surfaces(holes=False))
def test_structure_function_and_autocovariance(surface):
    """S = 2 [R(0) - R] on a periodic surface."""
    periodic = asp.Surface(surface.heights, surface.dx, surface.dy, periodic=True)
    covariance = r.autocovariance(periodic)
    for lag in ((1, 0), (0, 3), (2, -2), (-3, 1), (5, 5)):
        direct = r.mean_square_increment(periodic, lag)
        assert direct == pytest.approx(2.0 * (covariance.mean_square - covariance.at(lag)), rel=1e-9, abs=1e-12)
        assert covariance.at(lag) == pytest.approx(covariance.at((-lag[0], -lag[1])), rel=1e-9, abs=1e-12)


@given(surface=surfaces())
def test_autocovariance_by_direct_sums(surface):
    z = surface.heights - np.nanmean(surface.heights)
    found = r.autocovariance(surface)
    for lag in ((0, 0), (1, 0), (0, 2), (3, -2), (4, 4)):
        if surface.periodic:
            product = z * np.roll(z, (-lag[0], -lag[1]), (0, 1))
        else:
            k, moved = lag
            there = z[k:, max(0, moved) : z.shape[1] + min(0, moved)]
            here = z[: z.shape[0] - k, max(0, -moved) : z.shape[1] - max(0, moved)]
            product = here * there
        assert found.at(lag) == pytest.approx(np.nanmean(product), rel=1e-9, abs=1e-12)
        assert found.pairs[lag[0], found.range[1] + lag[1]] == np.count_nonzero(~np.isnan(product))


@settings(**GENERAL)
@given(surface=surfaces(holes=False), hole=st.tuples(st.integers(0, 11), st.integers(0, 11)))
def test_a_missing_point_is_left_out_and_not_zero(surface, hole):
    heights = np.array(surface.heights)
    heights[hole] = np.nan
    masked = asp.Surface(heights, surface.dx, surface.dy, periodic=surface.periodic)
    wild = np.array(surface.heights)
    wild[hole] = 1e6
    same = asp.Surface(wild, surface.dx, surface.dy, periodic=surface.periodic, mask=np.isnan(heights))
    before, after = numbers(masked), numbers(same)
    for path, value in before.items():
        assert after[path] == pytest.approx(value, rel=1e-12, nan_ok=True), path
    assert before["heights.Sz"] <= r.peak_to_valley(surface) + 1e-12


@given(surface=surfaces(), steps=st.lists(st.integers(1, 5), min_size=1, max_size=3, unique=True))
def test_scale_dependence_by_direct_sums(surface, steps):
    found = r.scale_dependence(surface, axis="y", steps=steps)
    h = surface.heights
    for n, step in enumerate(steps):
        width = step * surface.dy
        if surface.periodic:
            first = np.roll(h, -step, 1) - h
            second = np.roll(h, -step, 1) - 2.0 * h + np.roll(h, step, 1)
        else:
            first = h[:, step:] - h[:, :-step]
            second = h[:, 2 * step :] - 2.0 * h[:, step:-step] + h[:, : -2 * step]
        assert found.slope[n] == pytest.approx(math.sqrt(np.nanmean(first**2)) / width, rel=1e-12)
        assert found.curvature[n] == pytest.approx(math.sqrt(np.nanmean(second**2)) / width**2, rel=1e-10)
        assert found.sharpest[n] == pytest.approx(np.nanmin(second) / width**2, rel=1e-10)
        assert found.curvature_length[n] == pytest.approx(2.0 * width)


@pytest.mark.parametrize("shape", [(32, 32), (128, 128), (64, 48)])
@pytest.mark.parametrize("factor", [1024.0, 1e-6, 0.3])
def test_rings_hold_the_same_modes_in_every_unit_of_length(shape, factor):
    """An edge that falls on a mode must not leave it to rounding which ring the mode is in: 128 =
    2·8², the middle edge."""
    heights = np.random.default_rng(5).standard_normal(shape)
    rings = [r.radial_spectrum(r.power_spectrum(asp.Surface(heights * k, k * 1e-6))) for k in (1.0, factor)]
    np.testing.assert_array_equal(rings[1].modes, rings[0].modes)
    np.testing.assert_allclose(rings[1].psd, rings[0].psd * factor**4, rtol=1e-12)


def test_sectors_and_the_mean_gap_do_not_depend_on_the_unit_of_length():
    """Modes on the border of two sectors (48 x 64: 1.5 % of the density, 50 x 50: 6 %) and on edges
    of rings."""
    for shape in ((48, 64), (50, 50)):
        heights = np.random.default_rng(5).standard_normal(shape)
        density, gap = [], []
        for k in (1.0, 1024.0, 1000.0):
            surface = asp.Surface(heights * k, k * 1e-1, periodic=True)
            density.append(r.angular_spectrum(r.power_spectrum(surface)).density)
            theory = Persson.from_roughness(asp.roughness_of(surface), 1.0)
            gap.append(theory.at_pressure([1e-2, 1.0]).mean_gap / k)
        for other in (1, 2):
            np.testing.assert_allclose(density[other], density[0], rtol=1e-12)
            np.testing.assert_allclose(gap[other], gap[0], rtol=1e-8)
