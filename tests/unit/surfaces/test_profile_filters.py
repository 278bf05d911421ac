"""Filters of line scans: transmission, ends, noise (ISO 16610-21, -22, -31)."""

from __future__ import annotations

import numpy as np
import pytest
from refusals import refused

from asperity.core.errors import InputError
from asperity.surfaces import Profile, filtered
from asperity.surfaces.profile_settings import SETTINGS_CLASSES, components, settings_class
from asperity.surfaces.profile_spline import spline_smooth, spline_transmission

SPACING, CUTOFF = 1e-6, 100e-6


def passed(wavelength: float, **how: object) -> float:
    """Amplitude of a closed wave after the long-wave filter, relative to before."""
    wave = np.cos(2.0 * np.pi * np.arange(2000) * SPACING / wavelength)
    profile = Profile(1e-9 * wave, SPACING, periodic=True)
    rest = filtered(profile, short=CUTOFF, **how).heights * 1e9  # type: ignore[arg-type]
    return float(rest @ wave / (wave @ wave))


@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0, 5.0])
def test_transmission_of_the_gaussian(ratio: float) -> None:
    assert passed(ratio * CUTOFF) == pytest.approx(2.0 ** -(1.0 / ratio**2), abs=2e-7)  # window ends at λc


@pytest.mark.parametrize(("ratio", "percent"), [(0.5, 5.95), (1.0, 50.0), (2.0, 94.10), (5.0, 99.84)])
def test_transmission_of_the_spline(ratio: float, percent: float) -> None:
    expected = float(spline_transmission(SPACING, CUTOFF, ratio * CUTOFF))
    assert passed(ratio * CUTOFF, kind="spline") == pytest.approx(expected, abs=1e-10)  # condition β⁴ of the matrix
    assert 100.0 * expected == pytest.approx(percent, abs=0.06)  # printed for Δ → 0


def test_noise_that_the_gaussian_leaves() -> None:
    noise = np.random.default_rng(3).standard_normal(200_000)
    left = filtered(Profile(noise * 1e-9, SPACING, periodic=True), short=20e-6).heights
    expected = 1.50538 * SPACING / 20e-6
    scatter = np.sqrt(2.0 * 1.5 / (noise.size * SPACING / 20e-6))  # of a mean square with n Δ/λs/1.5 independent values
    assert float(np.mean(np.square(left))) * 1e18 == pytest.approx(expected, rel=4.0 * scatter)


def test_ends_of_a_line() -> None:
    """Renormalised weights are wrong by 0.1495 g λc at the end; regression of the first order and
    the spline are exact."""
    line = Profile(0.01 * SPACING * np.arange(1000), SPACING)
    ends = {
        kind: filtered(line, short=40e-6, **how).heights[0] for kind, how in (("zero", {}), ("first", {"order": 1}))
    }
    assert ends["zero"] == pytest.approx(0.1417 * 0.01 * 40e-6, rel=1e-3)  # sampled kernel, four printed digits
    assert ends["first"] == pytest.approx(0.0, abs=1e-8 * 0.01 * 40e-6)  # ridge of 1e-10 in its equations
    smooth = spline_smooth(line.heights, SPACING, 40e-6, periodic=False)
    np.testing.assert_allclose(smooth, line.heights, atol=1e-10 * line.heights.max())


def test_the_spline_bridges_missing_points_of_open_and_closed_profiles() -> None:
    for periodic in (False, True):
        heights = 1e-9 * np.cos(2.0 * np.pi * np.arange(600) / 300.0)
        holes = heights.copy()
        holes[100:110] = np.nan
        whole, bridged = (spline_smooth(z, 1.0, 60.0, periodic=periodic) for z in (heights, holes))
        np.testing.assert_allclose(bridged, whole, atol=2e-12)


def test_a_robust_filter_is_not_drawn_into_valleys() -> None:
    heights = 1e-9 * np.random.default_rng(1).standard_normal(2000)
    heights[950:960] = -1e-6
    mean_line = -filtered(Profile(heights, SPACING), long=CUTOFF, kind="gaussian").heights[955] - 1e-6
    robust = -filtered(Profile(heights, SPACING), long=CUTOFF, kind="robust").heights[955] - 1e-6
    assert abs(robust) < 0.1 * abs(mean_line)


def test_classes_of_settings() -> None:
    assert [row.name for row in SETTINGS_CLASSES] == ["Sc1", "Sc2", "Sc3", "Sc4", "Sc5"]
    assert settings_class(Ra=0.3e-6).evaluation_length == pytest.approx(4e-3)
    assert settings_class(Rz=0.6e-6).name == "Sc2"
    assert settings_class(Rz=0.6e-6, standard="ISO 4288").name == "Sc3"
    assert settings_class(RSm=0.5e-3, standard="ISO 4288").name == "Sc4"
    assert settings_class(Rz=5e-6).tip_radius == 5e-6
    with refused(InputError, "settings by RSm"):
        settings_class(RSm=1e-4)
    with refused(InputError, "settings of a profile"):
        settings_class()


def test_short_traces_have_fewer_sections_and_never_a_shorter_cutoff() -> None:
    rough = np.random.default_rng(1).standard_normal(450)
    found = components(Profile(1e-9 * rough, SPACING), long=CUTOFF, short=5e-6)
    assert (found.sections, found.long) == (3, CUTOFF)
    assert found.discarded == pytest.approx(0.5 * CUTOFF)
    assert len(found.remarks) == 1
    assert components(Profile(1e-9 * rough, SPACING, periodic=True), long=CUTOFF).sections == 4
    assert components(Profile(1e-9 * rough, SPACING), long=CUTOFF, kind="spline").sections == 4
    assert components(Profile(1e-9 * rough, SPACING), long=CUTOFF, short=3e-6).short == 0.0
    with refused(InputError, "trace", "200 µm"):
        components(Profile(1e-9 * rough[:150], SPACING), long=CUTOFF)
