"""The characterisation as a whole: groups, units, remarks, what is not defined, and known surfaces
recovered."""

from __future__ import annotations

import math
from dataclasses import FrozenInstanceError
from operator import attrgetter

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity import roughness as r
from asperity.core.citations import cite
from asperity.core.errors import InputError
from asperity.core.units import show

GRID = asp.Grid((256, 192), (2e-9, 3e-9))
SPECTRUM = asp.generate.SelfAffine(
    amplitude=asp.generate.RmsHeight(1e-9), hurst=0.7, rolloff_wavelength=80e-9, shortest_wavelength=0.0
)


GRID_OF_ONE_LAW = asp.Grid((192, 192), (2e-9, 2e-9))
SPECTRUM_OF_ONE_LAW = asp.generate.SelfAffine(
    amplitude=asp.generate.RmsHeight(1e-9), hurst=0.7, rolloff_wavelength=384e-9, shortest_wavelength=0.0
)


@pytest.fixture(scope="module")
def periodic() -> asp.roughness.Characterisation:
    return asp.characterise(asp.generate.gaussian(GRID, SPECTRUM, seed=3))


@pytest.fixture(scope="module")
def with_holes() -> asp.Surface:
    surface = asp.generate.gaussian(GRID, SPECTRUM, seed=4)
    heights = np.array(surface.heights)
    heights[20:24, 50:60] = np.nan
    return asp.levelled(asp.Surface(heights, surface.dx, surface.dy))


@pytest.fixture(scope="module")
def found_with_holes(with_holes) -> asp.roughness.Characterisation:
    return asp.characterise(with_holes)


def test_every_quantity_is_there_with_unit_and_source(periodic):
    values = periodic.values()
    assert [quantity for quantity, _ in values] == list(r.QUANTITIES)
    assert len({quantity.name for quantity in r.QUANTITIES}) == len(r.QUANTITIES)
    assert len({quantity.label for quantity in r.QUANTITIES}) == len(r.QUANTITIES)
    for quantity, value in values:
        assert isinstance(value, float)
        assert quantity.source
        assert quantity.label
        assert show(1.0, quantity.unit)
        assert value == pytest.approx(attrgetter(quantity.name)(periodic), rel=0.0, abs=0.0, nan_ok=True)


def test_groups_agree_with_the_functions(periodic):
    surface = periodic.surface
    assert periodic.heights.Sq == asp.roughness.rms_height(surface)
    assert periodic.heights.Sz == pytest.approx(asp.roughness.peak_to_valley(surface), rel=1e-14)
    assert periodic.hybrid.Sdq == asp.roughness.rms_slope(surface)
    assert periodic.hybrid.Sdr == r.developed_area_ratio(surface)
    assert periodic.hybrid.Ssc == periodic.summits.eight.mean_curvature
    assert periodic.summits.four.density == r.summit_statistics(r.summits(surface, 4)).density
    assert periodic.moments.spectral.m0 == pytest.approx(periodic.heights.Sq**2, rel=1e-10)
    assert math.isnan(periodic.fractal_x.dimension)  # a tenth of the roll-off is 4 pixels
    wide = GRID_OF_ONE_LAW, SPECTRUM_OF_ONE_LAW
    one_law = asp.characterise(asp.generate.gaussian(*wide, seed=3))
    lags = one_law.spectra.fit.lag_range
    assert one_law.fractal_x == r.fractal_parameters(one_law.surface, axis="x", lag_range=lags)
    assert periodic.functional == r.functional_parameters(r.material_ratio_curve(surface))
    direct = r.difference_moments(surface)
    assert periodic.moments.difference == direct


def test_the_parameters_of_the_generated_surface_are_found(periodic):
    found = periodic.spectrum
    assert found.hurst == pytest.approx(0.7, abs=5.0 * found.hurst_error)
    assert found.rolloff_wavelength == pytest.approx(80e-9, rel=5.0 * found.rolloff_error)
    assert math.isnan(found.exponent_2)
    assert math.isnan(found.floor)
    assert periodic.heights.Sq == pytest.approx(1e-9, rel=5.0 * periodic.sampling.Sq_error)
    assert periodic.heights.Ssk == pytest.approx(0.0, abs=0.3)
    assert periodic.heights.Sku == pytest.approx(3.0, abs=0.5)
    assert periodic.spatial.Str > 0.6
    assert [remark.split(":")[0] for remark in periodic.remarks] == [
        "No fractal dimension along x",
        "No fractal dimension along y",
    ]
    assert periodic.self_affine


def test_two_slopes_are_found():
    spectrum = asp.generate.TwoSlopes(
        amplitude=asp.generate.RmsHeight(2.7e-9),
        exponents=(6.5, 4.6),
        rolloff_wavelength=90e-9,
        crossover_wavelength=50e-9,
    )
    grid = asp.Grid((512, 512), (1500e-9 / 512, 1500e-9 / 512))
    found = asp.characterise(asp.generate.gaussian(grid, spectrum, seed=6)).spectrum
    assert found.exponent_1 == pytest.approx(6.5, abs=5.0 * found.exponent_1_error)
    assert found.exponent_2 == pytest.approx(4.6, abs=5.0 * found.exponent_2_error)
    assert found.rolloff_wavelength == pytest.approx(90e-9, rel=5.0 * found.rolloff_error)
    assert found.crossover_wavelength == pytest.approx(50e-9, rel=5.0 * found.crossover_error)


def test_holes_are_left_out_and_filled_for_spectra_alone(with_holes, found_with_holes):
    found = found_with_holes
    assert any("Only for the spectra" in remark and "40 points" in remark for remark in found.remarks)
    assert found.heights.Sq == asp.roughness.rms_height(with_holes)
    filled = asp.characterise(asp.filled(with_holes))
    assert found.moments.spectral == filled.moments.spectral
    assert found.moments.difference != filled.moments.difference
    without = asp.characterise(with_holes, fill=None)
    assert math.isnan(without.moments.spectral.m2)
    assert math.isnan(without.spectrum.hurst)
    assert math.isnan(without.spatial.Std)
    assert any("No power spectrum" in remark and "Fill them first" in remark for remark in without.remarks)
    assert without.heights == found.heights
    assert without.spatial.Sal == found.spatial.Sal


def test_a_surface_that_was_not_levelled_is_told(with_holes, found_with_holes):
    x, y = with_holes.grid.coordinates()
    tilted = asp.Surface(with_holes.heights + 0.01 * x - 0.02 * y, with_holes.dx, with_holes.dy)
    assert any("level the surface first" in remark for remark in asp.characterise(tilted).remarks)
    assert not any("level the surface first" in remark for remark in found_with_holes.remarks)


@pytest.mark.parametrize("shape", [(2000, 1), (1, 2000)])
def test_profiles(shape):
    profile = np.cumsum(np.random.default_rng(2).standard_normal(2000)).reshape(shape)
    found = asp.characterise(asp.Surface(profile - profile.mean(), 1e-6))
    axis = "x" if shape[0] > 1 else "y"
    other = "y" if axis == "x" else "x"
    assert getattr(found.moments.difference, "m0", 0.0) != 0.0
    assert math.isfinite(getattr(found, f"peaks_{axis}").density)
    assert math.isnan(getattr(found, f"peaks_{other}").density)
    assert math.isfinite(getattr(found, f"fractal_{axis}").dimension)
    assert math.isnan(getattr(found, f"fractal_{other}").dimension)
    assert math.isfinite(getattr(found.spatial, f"beta_e_{axis}"))
    assert math.isnan(found.hybrid.Sdq)
    assert found.summits.eight.count == 0
    assert found.remarks


@pytest.mark.parametrize("shape", [(1, 1), (2, 2), (3, 5), (16, 16)])
@pytest.mark.parametrize("periodic_", [True, False])
def test_flat_and_tiny_surfaces_give_no_numbers_but_no_failure(shape, periodic_):
    flat = asp.characterise(asp.Surface(np.full(shape, 3.0), 1.0, periodic=periodic_))
    assert flat.heights.Sq == 0.0
    assert math.isnan(flat.heights.Ssk)
    assert math.isnan(flat.functional.Sk)
    assert math.isnan(flat.spatial.Sal)
    assert math.isnan(flat.spatial.lay)
    assert flat.summits.eight.count == 0
    heights = np.random.default_rng(1).standard_normal(shape)
    asp.characterise(asp.Surface(heights, 1.0, periodic=periodic_))


def test_rows_without_a_valid_point():
    heights = np.random.default_rng(1).standard_normal((30, 30))
    heights[7] = np.nan
    heights[:, 12:15] = np.nan
    found = asp.characterise(asp.Surface(heights, 1.0))
    assert found.heights.Sq == pytest.approx(np.nanstd(heights))
    assert math.isfinite(found.moments.spectral.m2)


def test_single_precision_heights(periodic):
    surface = periodic.surface
    single = asp.Surface(surface.heights.astype(np.float32), surface.dx, surface.dy, periodic=True)
    double = {quantity.name: value for quantity, value in periodic.values()}
    for quantity, value in asp.characterise(single).values():
        if quantity.name.startswith(("heights", "functional", "hybrid", "spatial.S")):
            assert value == pytest.approx(double[quantity.name], rel=1e-4, abs=1e-6), quantity.name


def test_the_lay_of_a_grooved_surface():
    """Grooves along y: waves run along x, the lay along y."""
    x = np.arange(128)[:, None] + 0.0 * np.arange(96)[None, :]
    noise = 1e-3 * np.random.default_rng(0).standard_normal((128, 96))
    found = asp.characterise(asp.Surface(np.sin(2.0 * np.pi * x / 16.0) + noise, 1.0, periodic=True))
    assert found.spatial.Std == pytest.approx(0.0, abs=1e-6) or found.spatial.Std == pytest.approx(math.pi, abs=0.1)
    assert found.spatial.lay == pytest.approx(0.5 * math.pi, abs=0.01)
    assert math.isnan(found.spatial.Str)  # never decays along y


@pytest.mark.parametrize("angle", [20.0, 75.0, 130.0])
def test_direction_of_oblique_waves(angle):
    i, j = np.arange(200)[:, None], np.arange(160)[None, :]
    turn = math.radians(angle)
    heights = np.sin(2.0 * np.pi * (math.cos(turn) * i + math.sin(turn) * 1.5 * j) / 12.0)
    found = asp.characterise(asp.Surface(heights, 1.0, 1.5))
    assert math.degrees(found.spatial.Std) == pytest.approx(angle, abs=2.0)
    assert math.degrees(found.spatial.lay) == pytest.approx((angle + 90.0) % 180.0, abs=1.0)


def test_a_tip_limits_the_fitted_spectrum(periodic):
    surface, free = periodic.surface, periodic
    blunt = asp.characterise(surface, tip_radius=20e-9)
    assert math.isnan(free.sampling.tip_cutoff)
    assert blunt.sampling.tip_cutoff > 2.0 * surface.dx
    assert blunt.spectra.fit.last <= 2.0 * math.pi / blunt.sampling.tip_cutoff * (1.0 + 1e-9)
    assert asp.characterise(surface, tip_radius=1e-15).sampling.tip_cutoff == 0.0


def test_windows_are_named_in_the_spectra():
    surface = asp.levelled(asp.Surface(np.random.default_rng(0).standard_normal((64, 64)), 1.0))
    assert asp.characterise(surface).spectra.power.window == "hann"
    assert asp.characterise(surface, window="none").spectra.power.window == "none"
    radial = asp.characterise(surface, window="radial hann")
    assert (radial.spectra.power.window, radial.spectra.profiles[0].window) == ("radial hann", "hann")


def test_frozen_and_cited(periodic):
    with pytest.raises(FrozenInstanceError):
        periodic.heights = None
    text = cite(periodic)
    for word in ("ISO 25178-2", "Nayak", "Whittle", "Jacobs"):
        assert word in text


def test_refusals():
    surface = asp.Surface(np.random.default_rng(0).standard_normal((16, 16)), 1.0)
    with refused(InputError, "window of a spectrum"):
        asp.characterise(surface, window="kaiser")
    with refused(InputError, "radius of the tip (m)"):
        asp.characterise(surface, tip_radius=-1.0)
    heights = np.array(surface.heights)
    heights[2, 2] = np.nan
    with refused(InputError, "method of filled()"):
        asp.characterise(asp.Surface(heights, 1.0), fill="magic")
    with refused(InputError, "surface"):
        r.power_spectrum(asp.Surface(heights, 1.0))
    with refused(InputError, "surface"):
        r.profile_spectrum(asp.Surface(heights, 1.0))
    with refused(InputError, "window of a profile"):
        r.profile_spectrum(surface, window="radial hann")
    with refused(InputError, "neighbours of a summit", "4", "8"):
        r.summits(surface, 6)
    with refused(InputError, "number of bins"):
        r.height_distribution(surface, 0)
    with refused(InputError, "drop that defines a correlation length"):
        r.autocovariance(surface).correlation_length(1.5)
    with refused(InputError, "core line"):
        r.core(r.material_ratio_curve(surface), "parabola")
    with refused(InputError, "lag of a difference"):
        r.mean_square_increment(surface, (16, 0))
    with refused(InputError, "lag of a difference (pixels)"):
        r.structure_function(surface, lags=[0])
    with refused(InputError, "radius of the tip (m)"):
        r.tip_cutoff(r.scale_dependence(surface), 0.0)


def test_distribution_of_heights():
    surface = asp.Surface(np.random.default_rng(0).standard_normal((300, 300)), 1.0)
    found = r.height_distribution(surface)
    widths = np.diff(found.edges)
    assert found.density @ widths == pytest.approx(1.0, rel=1e-12)
    middle = 0.5 * (found.edges[1:] + found.edges[:-1])
    expected = found.normal(middle)
    counts = found.density * widths * 90_000
    # Poisson scatter of the bars
    assert np.all(np.abs(counts - expected * widths * 90_000) < 6.0 * np.sqrt(expected * widths * 90_000) + 6.0)
    assert r.height_distribution(surface, 7).density.size == 7
    assert np.all(r.height_distribution(asp.Surface(np.zeros((3, 3)), 1.0)).normal(np.zeros(2)) == 0.0)


def test_logarithmic_interpolation_of_an_exponential_is_exact():
    spectrum = asp.generate.ExponentialAutocorrelation(1.0, 2.5, drop=math.exp(-1.0))
    grid = asp.Grid((64, 64), (1.0, 1.0))
    # the autocovariance itself, without the scatter of a realisation
    lags = np.minimum(np.arange(64), 64 - np.arange(64))
    values = np.exp(-np.hypot(lags[:, None], lags[None, :])[:33] / 2.5)
    centred = np.concatenate([values[:, 32:], values[:, :33]], axis=1)
    covariance = r.Autocovariance(centred, np.ones_like(centred), (1.0, 1.0), grid.size)
    assert covariance.correlation_length(r.DROP_1E, logarithmic=True) == pytest.approx(2.5, rel=1e-12)
    assert covariance.correlation_length(r.DROP_TENTH, logarithmic=True) == pytest.approx(
        2.5 * math.log(10.0), rel=1e-12
    )
    linear = covariance.correlation_length(r.DROP_1E)
    assert 2.5 < linear < 2.5 * 1.065  # the error that the handbook of such estimates states
    assert spectrum.decay_lengths[0] == pytest.approx(2.5)
