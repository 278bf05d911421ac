"""Hurst exponents and fractal dimensions whose standard errors hold the truth, over many maps of
known spectrum."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.stats import binom

import asperity as asp
from asperity import roughness as r
from asperity.core.errors import InputError
from asperity.surfaces.characterise.spectral_fit import MEASURED_MODEL_ERROR, fit_spectrum

SHARE = 0.85  # of maps whose 1.96 standard errors hold the truth, at least


def spectrum(hurst: float, rolloff: float) -> asp.generate.SelfAffine:
    return asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1.0), hurst=hurst, rolloff_wavelength=rolloff, shortest_wavelength=0.0
    )


def measured(kind: object, seed: int) -> asp.Surface:
    """Levelled part of 256 x 256 points of a larger periodic map."""
    large = asp.generate.gaussian(asp.Grid((512, 512), (1.0, 1.0)), kind, seed=seed)
    return asp.levelled(asp.surfaces.cropped(large, x=(0.0, 256.0), y=(0.0, 256.0)))


def held_by_differences(hurst: float, seeds: range) -> list[bool]:
    """Whether 1.96 standard errors of the dimension hold it, along x and y of maps without
    roll-off."""
    grid, held = asp.Grid((256, 256), (1.0, 1.0)), []
    for seed in seeds:
        surface = asp.generate.gaussian(grid, spectrum(hurst, 256.0), seed=seed)
        for axis in "xy":
            found = r.fractal_parameters(surface, axis=axis)
            held.append(abs(found.dimension - (2.0 - hurst)) < 1.96 * found.dimension_error)
    return held


# a roll-off with a corner and waves down to the grid; a rounded one (H = 1/2) of point values,
# whose unresolved waves fold back
CORNER, ROUNDED = "corner", "rounded"


def held_by_spectrum(form: str, seeds: range) -> tuple[list[bool], list[float]]:
    """Whether 1.96 standard errors of the Hurst exponent hold it, and its deviations over the
    standard error, with eight roll-off lengths in a measured map."""
    drop = math.exp(-1.0)
    kind = (
        spectrum(0.8, 32.0)
        if form == CORNER
        else asp.generate.ExponentialAutocorrelation(1.0, 32.0 / (2.0 * math.pi), drop=drop)
    )
    truth, apart = 0.8 if form == CORNER else 0.5, []
    for seed in seeds:
        fit = fit_spectrum(r.power_spectrum(measured(kind, seed)), model_error=MEASURED_MODEL_ERROR)
        apart.append((fit.model.hurst[0] - truth) / fit.hurst_error)
    return [abs(value) < 1.96 for value in apart], apart


def test_dimensions_of_a_few_maps():
    held = held_by_differences(0.8, range(12))
    assert sum(held) >= binom.ppf(0.002, len(held), SHARE)


@pytest.mark.parametrize("form", [CORNER, ROUNDED])
def test_exponents_of_a_few_maps(form):
    held, _ = held_by_spectrum(form, range(4))
    assert sum(held) >= binom.ppf(0.002, len(held), SHARE)


@pytest.mark.slow
@pytest.mark.parametrize("hurst", [0.8, 0.5])
def test_dimensions_of_two_hundred_maps(hurst):
    held = held_by_differences(hurst, range(200))
    assert np.mean(held[::2]) >= SHARE
    assert np.mean(held[1::2]) >= SHARE


@pytest.mark.slow
@pytest.mark.parametrize("form", [CORNER, ROUNDED])
def test_exponents_of_two_hundred_maps(form):
    held, apart = held_by_spectrum(form, range(200))
    assert np.mean(held) >= SHARE
    assert abs(np.mean(apart)) < 0.5  # bias well inside the standard error of one map


def test_both_estimates_of_one_surface_are_told():
    found = r.characterise(asp.generate.gaussian(asp.Grid((256, 256), (1.0, 1.0)), spectrum(0.7, 256.0), seed=2))
    assert found.self_affine
    assert not any("self-affine" in remark for remark in found.remarks)
    assert found.spectrum.longest_wave / found.spectrum.shortest_wave > 100.0
    for along in (found.fractal_x, found.fractal_y):
        assert abs(along.hurst - found.spectrum.hurst) < 4.0 * math.hypot(
            along.dimension_error, found.spectrum.hurst_error
        )


def test_a_rolled_off_surface_has_the_exponent_of_its_spectrum_alone():
    surface = asp.generate.gaussian(asp.Grid((256, 256), (1.0, 1.0)), spectrum(0.8, 32.0), seed=2)
    found = r.characterise(surface)
    assert math.isnan(found.fractal_x.dimension)
    assert sum("fractal dimension along" in remark for remark in found.remarks) == 2
    assert found.self_affine
    assert abs(found.spectrum.hurst - 0.8) < 4.0 * found.spectrum.hurst_error
    theory = asp.roughness_of(surface).fractal
    assert theory is not None
    assert theory.dimension == pytest.approx(2.0 - found.spectrum.hurst, rel=1e-12)
    assert (theory.longest, theory.shortest) == (found.spectrum.longest_wave, found.spectrum.shortest_wave)


def test_the_fractal_roughness_of_both_estimates_agrees():
    """The structure function of the fitted spectrum is that of the second differences, within the
    errors of H over the decade between the pixel and the lags."""
    surface = asp.generate.gaussian(asp.Grid((512, 512), (1.0, 1.0)), spectrum(0.5, 512.0), seed=4)
    fit, along = fit_spectrum(r.power_spectrum(surface)), r.fractal_parameters(surface)
    error = 2.0 * math.log(8.0) * math.hypot(fit.hurst_error, along.dimension_error) + 0.02
    logarithm = math.log(fit.structure_amplitude(1.0) / along.amplitude)
    assert abs(logarithm) < 4.0 * error


def test_no_decade_is_told():
    found = r.characterise(asp.generate.gaussian(asp.Grid((128, 128), (1.0, 1.0)), spectrum(0.8, 12.0), seed=1))
    assert not found.self_affine
    assert any("decade" in remark for remark in found.remarks)


@pytest.mark.parametrize("exponents", [(3.8, 2.4), (2.4, 3.8)])
def test_two_power_laws_of_a_measured_map(exponents):
    """A bifractal surface through a window: both exponents and the crossover within four standard
    errors, and one law is worse."""
    kind = asp.generate.TwoSlopes(
        amplitude=asp.generate.RmsHeight(1.0), exponents=exponents, rolloff_wavelength=1024.0, crossover_wavelength=20.0
    )
    large = asp.generate.gaussian(asp.Grid((1024, 1024), (1.0, 1.0)), kind, seed=3)
    surface = asp.levelled(asp.surfaces.cropped(large, x=(0.0, 512.0), y=(0.0, 512.0)))
    fit = fit_spectrum(r.power_spectrum(surface), model_error=0.02)
    assert len(fit.model.exponents) == 2
    for number, exponent in enumerate(exponents):
        assert abs(fit.model.exponents[number] - exponent) < 4.0 * fit.errors[f"exponent_{number + 1}"]
    assert abs(math.log(fit.model.crossover_wavelength / 20.0)) < 4.0 * fit.errors["crossover_wavelength"]
    assert min(value for name, value in fit.candidates.items() if "two" not in name) > 6.0  # strong evidence


def test_too_few_modes_have_no_fractal():
    with pytest.raises(InputError):
        r.fractal_parameters(asp.Surface(np.random.default_rng(0).standard_normal((16, 16)), 1.0))
