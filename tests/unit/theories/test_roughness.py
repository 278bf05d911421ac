"""The numbers that theories are built from: what they hold, and what ``roughness_of`` measures."""

from __future__ import annotations

import math

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.theories.statistics.roughness import MomentTensor, Spectrum, SummitList

AMPLITUDE, WAVES, N, PIXEL = 2e-9, 4, 64, 10e-9


def egg_box(**options) -> asp.Surface:
    """A (cos qx + cos qy) on a periodic map: every number is known."""
    x = np.arange(N) * 2.0 * np.pi * WAVES / N
    return asp.Surface(AMPLITUDE * (np.cos(x)[:, None] + np.cos(x)[None, :]), PIXEL, periodic=True, **options)


def test_an_egg_box_is_measured_exactly():
    q = 2.0 * np.pi * WAVES / (N * PIXEL)
    found = asp.roughness_of(egg_box())
    # each wave has the mean square A²/2; trigonometric sums are exact to rounding
    assert found.m0 == pytest.approx(AMPLITUDE**2, rel=1e-12)
    assert found.m2 == pytest.approx(0.5 * AMPLITUDE**2 * q**2, rel=1e-12)
    # averaged over all directions: 3/8 of the mean square Laplacian A² q⁴
    assert found.m4 == pytest.approx(0.375 * AMPLITUDE**2 * q**4, rel=1e-12)
    assert found.alpha == pytest.approx(1.5, rel=1e-12)
    assert found.moments.m20 == pytest.approx(0.5 * AMPLITUDE**2 * q**2, rel=1e-12)
    assert found.moments.m22 == pytest.approx(0.0, abs=1e-12 * found.m4)
    assert found.area == pytest.approx((N * PIXEL) ** 2, rel=1e-12)
    assert found.rms_gradient == pytest.approx(AMPLITUDE * q, rel=1e-12)
    assert found.skewness == pytest.approx(0.0, abs=1e-12)
    assert np.std(found.heights) == pytest.approx(AMPLITUDE, rel=1e-12)


def test_summits_of_an_egg_box():
    found = asp.roughness_of(egg_box()).summits
    assert found.count == WAVES**2
    assert found.density == pytest.approx(WAVES**2 / (N * PIXEL) ** 2, rel=1e-12)
    assert found.mean_height == pytest.approx(2.0 * AMPLITUDE, rel=1e-12)
    assert found.height_deviation < 1e-12 * AMPLITUDE
    # central differences see q² [sin(q d/2)/(q d/2)]²
    half = np.pi * WAVES / N
    kappa = AMPLITUDE * (2.0 * np.sin(half) / PIXEL) ** 2
    assert found.radius == pytest.approx(1.0 / kappa, rel=1e-10)
    assert found.period == pytest.approx((N * PIXEL, N * PIXEL))


def test_where_the_moments_come_from():
    periodic = egg_box()
    cut = asp.Surface(periodic.heights, PIXEL)
    by_differences = asp.roughness_of(periodic, moments="differences")
    half = np.pi * WAVES / N
    sinc = np.sin(half) / half
    assert by_differences.m2 == pytest.approx(asp.roughness_of(periodic).m2 * sinc**2, rel=1e-10)
    # a measured map leaves out the wrapped differences
    assert asp.roughness_of(cut).m2 == pytest.approx(by_differences.m2, rel=0.02)
    found = asp.roughness_of(cut).moments
    assert abs(found.m22) + abs(found.m31) + abs(found.m13) < 3e-3 * found.m40  # waves along x and along y alone
    with refused(InputError, "source of the moments"):
        asp.roughness_of(periodic, moments="guess")


def test_the_radial_spectrum_gives_back_the_mean_square():
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1e-9), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=1e-7
    )
    found = asp.roughness_of(asp.generate.gaussian(asp.Grid((256, 256), (2e-8, 2e-8)), spectrum, seed=3))
    q, psd = found.spectrum.q, found.spectrum.psd
    # trapezoids over ln q between rings of a twentieth of a decade, the first of which hold few
    # modes
    integral = np.sum(0.5 * np.diff(np.log(q)) * ((q**2 * psd)[1:] + (q**2 * psd)[:-1])) / (2.0 * np.pi)
    assert integral == pytest.approx(found.m0, rel=0.05)


def test_missing_points_are_filled_for_the_spectrum_alone():
    mask = np.zeros((N, N), dtype=bool)
    mask[10:13, 20:22] = True
    holed, whole = asp.roughness_of(egg_box(mask=mask)), asp.roughness_of(egg_box())
    assert holed.heights.size == whole.heights.size - 6
    assert holed.m2 == pytest.approx(whole.m2, rel=0.01)


def test_flat_surfaces_are_refused():
    with refused(InputError, "moment m0 (m^2)"):
        asp.roughness_of(asp.Surface(np.ones((8, 8)), 1e-9, periodic=True))


def test_principal_slopes_do_not_depend_on_the_axes():
    angle = 0.4
    c, s = math.cos(angle), math.sin(angle)
    turned = MomentTensor(m20=4.0 * c * c + s * s, m11=3.0 * c * s, m02=4.0 * s * s + c * c)
    assert turned.principal_slopes == pytest.approx((4.0, 1.0), rel=1e-12)


def test_what_is_missing_is_named():
    bare = asp.roughness.Roughness(1e-18, 1e-3, 1e12)
    with refused(InputError, "roughness for the theory x"):
        bare.known(bare.summits, "its summits", "x")


@pytest.mark.parametrize("fields", [{"m0": 0.0}, {"m2": -1.0}, {"m4": math.nan}, {"area": 0.0}])
def test_impossible_numbers_are_refused(fields):
    with pytest.raises(InputError):
        asp.roughness.Roughness(**({"m0": 1e-18, "m2": 1e-3, "m4": 1e12} | fields))


def test_impossible_lists_are_refused():
    one = np.ones(1)
    with refused(InputError, "summits"):
        SummitList(one, one, np.ones(2), one, 1.0)
    with refused(InputError, "curvatures of summits"):
        SummitList(one, one, one, -one, 1.0)
    with refused(InputError, "wavenumbers of a spectrum (rad/m)"):
        Spectrum(np.array([2.0, 1.0]), np.ones(2))
    with refused(InputError, "spectrum"):
        Spectrum(np.array([1.0, 2.0]), np.ones(3))
