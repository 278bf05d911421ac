"""Fractal dimension and amplitude: Weierstrass-Mandelbrot profiles, conversions, and surfaces of
known exponent."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused
from scipy.integrate import quad

import asperity as asp
from asperity.core.errors import InputError
from asperity.surfaces.characterise import correlation as fractal
from asperity.surfaces.characterise.correlation import structure_function


def weierstrass_mandelbrot(row) -> asp.Surface:
    x = np.arange(int(row["N"])) * row["dx_m"]
    terms = np.arange(int(row["n_first"]), int(row["n_last"]) + 1)
    gamma, dimension = row["gamma"], row["D"]
    waves = [np.cos(2.0 * np.pi * gamma**n * x) / gamma ** ((2.0 - dimension) * n) for n in terms]
    return asp.Surface(row["G_m"] ** (dimension - 1.0) * sum(waves)[:, None], row["dx_m"])


PROFILES = reference("fractal_wm_profile_estimates")
GAMMA = fractal.GAMMA
LAGS = [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]


def self_affine(hurst: float, points: int, seed: int) -> asp.Surface:
    """Surface of ``points`` x ``points`` pixels of 1 m without a roll-off shorter than it."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1.0), hurst=hurst, rolloff_wavelength=float(points), shortest_wavelength=0.0
    )
    return asp.generate.gaussian(asp.Grid((points, points), (1.0, 1.0)), spectrum, seed=seed)


@pytest.mark.parametrize("dimension", [1.2, 1.4, 1.6, 1.8])
def test_dimension_of_weierstrass_mandelbrot_profiles(dimension):
    """Profiles of random phases, γ = 1.5, 4096 points, lags over whole periods of ln γ: the scatter
    of one is 0.016 (handbook), and four of them are the tolerance."""
    x, terms, found = np.arange(4096.0), np.arange(-22, 1), []
    lags = [2, 3, 4, 5, 7, 10, 15, 23, 34, 51, 77, 115, 173]
    for seed in range(10):
        phase = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, terms.size)
        waves = [
            np.cos(2.0 * np.pi * GAMMA**n * x + shift) / GAMMA ** ((2.0 - dimension) * n)
            for n, shift in zip(terms, phase, strict=True)
        ]
        found.append(fractal.fractal_parameters(asp.Surface(sum(waves)[:, None], 1.0), lags=lags).dimension)
    assert np.mean(found) == pytest.approx(dimension, abs=4.0 * 0.016 / math.sqrt(10.0) + 0.005)


@every_row(reference("fractal_wm_profile_structure"), label=lambda row: f"{row['set']:g}-{row['lag']:g}")
def test_structure_function_of_reference_profiles(row):
    found = structure_function(weierstrass_mandelbrot(row), lags=[int(row["lag"])])
    assert found.lag[0] == pytest.approx(row["tau_m"])
    assert found.value[0] == pytest.approx(row["S_sample_m2"], rel=1e-10)


@every_row(reference("fractal_constants"), label=lambda row: f"D={row['D']}")
def test_constants(row):
    dimension = row["D"]
    assert fractal.spectrum_coefficient(dimension) == pytest.approx(row["c1_over_C"], rel=1e-13)
    assert fractal.structure_coefficient(dimension) == pytest.approx(row["wm_structure_coeff"], rel=1e-13)
    without = fractal.structure_coefficient(dimension) / (2.0 * math.pi) ** (4.0 - 2.0 * dimension)
    assert without == pytest.approx(row["wm_structure_coeff_no_2pi"], rel=1e-13)


@pytest.mark.parametrize("dimension", [1.3, 1.5, 1.8])
def test_spectrum_and_structure_function_belong_together(dimension):
    """S(τ) = 2 ∫ P (1 - cos ωτ) dω over both signs of ω, with P = c1/C ω^-(5-2D) for C η^(2D-3) =
    1, at τ = 1."""
    power = 5.0 - 2.0 * dimension
    near = quad(lambda w: (1.0 - math.cos(w)) * w**-power, 0.0, 1.0)[0]
    # the cosine of the far part by the quadrature for oscillating integrands, the rest in closed
    # form
    far = 1.0 / (power - 1.0) - quad(lambda w: w**-power, 1.0, math.inf, weight="cos", wvar=1.0)[0]
    assert 4.0 * fractal.spectrum_coefficient(dimension) * (near + far) == pytest.approx(1.0, rel=1e-7)


@every_row(reference("fractal_wm_structure"), label=lambda row: f"{row['D']}-{row['tau_m']:g}")
def test_continuous_structure_function(row):
    """G turned into C and back: the smooth law is the reference's, and the sum over waves lies
    within its ripple."""
    dimension, gamma, tau = row["D"], row["gamma"], row["tau_m"]
    smooth = fractal.structure_coefficient(dimension) * row["G_m"] ** (2.0 * dimension - 2.0) / math.log(gamma)
    smooth *= tau ** (4.0 - 2.0 * dimension)
    assert smooth == pytest.approx(row["S_continuous_m2"], rel=1e-12)
    # S = C η (τ/η)^(4-2D) at any resolution gives G back
    resolution = 0.3 * tau
    amplitude = smooth / resolution * (resolution / tau) ** (4.0 - 2.0 * dimension)
    assert fractal.fractal_roughness(dimension, amplitude, resolution, gamma) == pytest.approx(row["G_m"], rel=1e-9)


@pytest.mark.parametrize("hurst", [0.3, 0.5, 0.8])
def test_self_affine_surfaces(hurst):
    surface = self_affine(hurst, 1024, seed=5)
    for axis in "xy":
        found = fractal.fractal_parameters(surface, axis=axis)
        assert found.self_affine
        assert abs(found.hurst - hurst) < 4.0 * found.dimension_error
        assert 0.0 < found.dimension_error < 0.04
        assert (found.first_lag, found.last_lag) == (2.0, 49.0 if hurst > 0.3 else found.last_lag)
        assert found.residual < 0.05
        # V(τ) = 4 S(τ) - S(2τ), with the law S of the fit and with the measured one
        power = 2.0 * found.hurst
        law = found.amplitude * found.resolution ** (2.0 * found.dimension - 3.0) * 8.0**power * (4.0 - 2.0**power)
        near, far = structure_function(surface, axis=axis, lags=[8, 16]).value
        assert law + found.constant == pytest.approx(4.0 * near - far, rel=4.0 * found.residual)


def test_a_tilt_does_not_matter():
    surface = self_affine(0.6, 256, seed=1)
    x, y = surface.grid.coordinates()
    heights = surface.heights[:, :]
    level = fractal.fractal_parameters(asp.Surface(heights, 1.0), lags=LAGS)
    tilted = fractal.fractal_parameters(asp.Surface(heights + 0.3 * x - 0.2 * y, 1.0), lags=LAGS)
    assert tilted.dimension == pytest.approx(level.dimension, abs=1e-9)
    assert tilted.amplitude == pytest.approx(level.amplitude, rel=1e-8)


def test_noise_and_missing_points_leave_the_dimension():
    """White noise goes into the constant; both leave the estimate within its error (handbook:
    0.805 ± 0.035 of 0.8 with noise of half the rms step and 15 % missing)."""
    surface, rng = self_affine(0.8, 256, seed=3), np.random.default_rng(3)
    step = math.sqrt(structure_function(surface, lags=[1]).value[0])
    heights = surface.heights + 0.5 * step * rng.standard_normal(surface.shape)
    heights = np.where(rng.uniform(size=surface.shape) < 0.15, np.nan, heights)
    found = fractal.fractal_parameters(asp.Surface(heights, 1.0), lags=LAGS)
    assert found.constant > 0.0
    assert abs(found.hurst - 0.8) < 4.0 * found.dimension_error


def test_smooth_surfaces_are_no_fractals():
    ramp = np.arange(400.0)[:, None] * np.ones((1, 4))
    for heights in (ramp, np.sin(np.pi * ramp / 200.0)):
        with refused(InputError, "second differences along x"):
            fractal.fractal_parameters(asp.Surface(heights, 1.0))


@given(scale=st.floats(1e-10, 1e6), stretch=st.floats(1e-10, 1e6))
def test_scaling(scale, stretch):
    row = PROFILES[2]
    base = weierstrass_mandelbrot({**row, "N": 512})
    first = fractal.fractal_parameters(base, lags=LAGS)
    other = fractal.fractal_parameters(asp.Surface(scale * base.heights, stretch * base.dx), lags=LAGS)
    # the best power of a flat minimum, to the root of rounding
    assert other.dimension == pytest.approx(first.dimension, abs=1e-6)
    # S = C η (τ/η)^(4-2D): C scales like the square of heights over lengths
    assert other.amplitude == pytest.approx(scale**2 / stretch * first.amplitude, rel=1e-5)


def test_lags_leave_out_the_roll_off():
    surface = self_affine(0.8, 256, seed=1)
    found = fractal.fractal_parameters(surface, lag_range=(2.0, 9.0))
    assert (found.first_lag, found.last_lag) == (2.0, 9.0)
    with refused(InputError, "lags of a fractal dimension along x", "2", "8", "5"):
        fractal.fractal_parameters(surface, lag_range=(0.0, 5.0))
    with refused(InputError, "lags of a fractal dimension along x", "4", "16", "12.8"):
        fractal.fractal_parameters(surface, lag_range=(4.0, math.inf))


def test_refusals():
    noise = np.random.default_rng(1).standard_normal((32, 32))
    with refused(InputError, "lags of a fractal dimension along x", "2", "8", "1.6", "32"):
        fractal.fractal_parameters(asp.Surface(noise, 1.0))
    with refused(InputError, "second differences along x"):
        fractal.fractal_parameters(asp.Surface(np.zeros((200, 2)), 1.0))
    with refused(InputError, "lags of a fractal dimension", "4", "3"):
        fractal.fractal_parameters(asp.Surface(noise, 1.0), lags=[2, 4, 8])
    with refused(InputError, "lags of a fractal dimension", "32", "16"):
        fractal.fractal_parameters(asp.Surface(noise, 1.0), lags=[2, 4, 8, 16])
    with refused(InputError, "fractal dimension of a profile"):
        fractal.structure_coefficient(2.0)
    with refused(InputError, "fractal dimension of a profile"):
        fractal.spectrum_coefficient(1.0)
