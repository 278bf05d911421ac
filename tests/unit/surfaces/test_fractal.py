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


@every_row(PROFILES, label=lambda row: f"D={row['D']}")
def test_estimates_of_reference_profiles(row):
    profile = weierstrass_mandelbrot(row)
    lags = [lag for lag in (4, 8, 16, 32, 64, 128) if row["lag_min"] <= lag <= row["lag_max"]]
    found = fractal.fractal_parameters(profile, lags=lags)
    assert asp.roughness.rms_height(profile) == pytest.approx(row["std_m"], rel=1e-10)
    assert found.dimension == pytest.approx(row["D_estimated"], rel=1e-10)
    assert found.amplitude == pytest.approx(row["C_estimated_m"], rel=1e-9)
    assert found.resolution == row["dx_m"]
    assert 4.0 - 2.0 * found.dimension == pytest.approx(row["slope"], rel=1e-10)


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
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1.0), hurst=hurst, rolloff_wavelength=1024.0, shortest_wavelength=2.0
    )
    surface = asp.generate.gaussian(asp.Grid((1024, 1024), (1.0, 1.0)), spectrum, seed=5)
    for axis in "xy":
        found = fractal.fractal_parameters(surface, axis=axis)
        assert found.self_affine
        # the range is finite on both sides, which bends the line towards 1.5; handbook figure for
        # such estimates
        assert found.hurst == pytest.approx(hurst, abs=0.1)
        assert found.first_lag == 4.0
        assert found.residual < 0.1


def test_smooth_surfaces_are_no_fractals():
    ramp = np.arange(400.0)[:, None] * np.ones((1, 4))
    for heights, error in ((ramp, 1e-9), (np.sin(np.pi * ramp / 200.0), 0.04)):
        found = fractal.fractal_parameters(asp.Surface(heights, 1.0))
        assert not found.self_affine
        assert math.isnan(found.roughness)
        assert found.dimension == pytest.approx(1.0, abs=error)


@given(scale=st.floats(1e-10, 1e6), stretch=st.floats(1e-10, 1e6))
def test_scaling(scale, stretch):
    row = PROFILES[2]
    base = weierstrass_mandelbrot({**row, "N": 512})
    first = fractal.fractal_parameters(base, lags=[4, 8, 16, 32])
    other = fractal.fractal_parameters(asp.Surface(scale * base.heights, stretch * base.dx), lags=[4, 8, 16, 32])
    assert other.dimension == pytest.approx(first.dimension, rel=1e-10)
    # S = C η (τ/η)^(4-2D): C scales like the square of heights over lengths
    assert other.amplitude == pytest.approx(scale**2 / stretch * first.amplitude, rel=1e-9)


def test_refusals():
    noise = np.random.default_rng(1).standard_normal((32, 32))
    with refused(InputError, "structure function"):
        fractal.fractal_parameters(asp.Surface(noise, 1.0))
    with refused(InputError, "structure function"):
        fractal.fractal_parameters(asp.Surface(np.zeros((200, 2)), 1.0))
    with refused(InputError, "fractal dimension of a profile"):
        fractal.structure_coefficient(2.0)
    with refused(InputError, "fractal dimension of a profile"):
        fractal.spectrum_coefficient(1.0)
