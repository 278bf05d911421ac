"""Error bars of contacts: lognormal answers of spheres, noise of heights, and samples with the
sensitivities as control variate."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from reference_data import Row, reference
from refusals import refused
from sensitivity_cases import MPA, NM, problem_of, solved

import asperity as asp
from asperity.contact.boundary import Free, Periodic
from asperity.contact.result import ContactResult
from asperity.core.errors import InputError
from asperity.sensitivities import HeightNoise, PressureNorm, Uncertainty, sensitivities, uncertainty
from asperity.solvers import ActiveSet


@cache
def sphere() -> ContactResult:
    """Hertz contact of an incompressible half-space, E* = 1, R = 1."""
    a = 0.05
    x = (np.arange(63) - 31.0) * (2.5 * a / 63.0)
    surface = asp.Surface(-0.5 * np.add.outer(x**2, x**2), x[1] - x[0])
    problem = asp.ContactProblem(surface, asp.Elastic(1.0, 0.0), boundary=asp.Free())
    return asp.solve(problem, asp.Force(4.0 / 3.0 * a**3), solver=ActiveSet(tolerance=1e-9))


@pytest.mark.parametrize("row", reference("sensitivities/uncertainty_hertz"), ids=lambda row: f"{row['case']:g}")
def test_error_bars_of_spheres_are_lognormal(row: Row) -> None:
    scatter = {
        "body.youngs_modulus": float(row["logsd_Estar"]),
        "heights": float(row["logsd_R"]),  # of 1/R
        "force": float(row["logsd_P"]),
    }
    # the exponents come out of the contact with errors of the grid of some per mille, so that
    # widths have as much
    for of, symbol, error in (("approach", "delta", 0.01), (PressureNorm(400.0), "p0", 0.03)):
        found = uncertainty(sphere(), of, scatter)
        assert found.relative == pytest.approx(float(row[f"{symbol}_linear_rel_sd"]), rel=error)
        assert found.mean / found.value - 1.0 == pytest.approx(
            float(row[f"{symbol}_mean_over_median"]) - 1.0, rel=3.0 * error
        )
        assert found.deviation / found.value == pytest.approx(float(row[f"{symbol}_sd_over_median"]), rel=2.0 * error)
        assert found.quantile(0.95) / found.value == pytest.approx(float(row[f"{symbol}_q95_over_median"]), rel=error)
        assert sum(found.shares.values()) == pytest.approx(1.0)
        low, high = found.interval
        assert low < found.value < high
        assert low * high == pytest.approx(found.value**2)


def test_samples_of_a_power_law_follow_the_prediction() -> None:
    scatter = {"body.youngs_modulus": 0.05, "force": 0.1}
    found = uncertainty(sphere(), "approach", scatter, samples=12, seed=4)
    sampled = found.sampled
    assert sampled is not None
    assert sampled.values == pytest.approx(sampled.predicted, rel=2e-3)
    assert sampled.gain > 100.0
    assert sampled.mean == pytest.approx(found.mean, rel=1e-3)
    assert found.bias == pytest.approx(math.expm1(0.5 * found.relative**2), abs=1e-3)
    again = uncertainty(sphere(), "approach", scatter, samples=12, seed=4)
    assert again.sampled is not None
    assert np.array_equal(again.sampled.values, sampled.values)


@pytest.mark.parametrize("length", [0.0, 120 * NM])
def test_variance_by_noise_is_that_of_the_covariance(length: float) -> None:
    result = solved(Periodic())
    noise, grid = HeightNoise(0.05 * NM, length), result.problem.grid
    slope = np.asarray(sensitivities(result, PressureNorm(8.0), "heights")["heights"])
    maps = [noise.drawn(grid, np.random.default_rng(seed)) for seed in range(2000)]
    rms = math.sqrt(float(np.mean([one**2 for one in maps])))
    assert rms == pytest.approx(noise.rms, rel=0.02)
    drawn = [float((slope * one).sum()) for one in maps]
    # the variance of 2000 numbers has an error of 1/√1000
    assert noise.variance(slope, grid) == pytest.approx(float(np.var(drawn)), rel=4.0 / math.sqrt(1000.0))
    if not length:
        assert noise.variance(slope, grid) == pytest.approx(noise.rms**2 * float((slope**2).sum()), rel=1e-12)
    found = uncertainty(result, PressureNorm(8.0), noise=noise)
    assert found.parts.keys() == {"noise"}
    assert found.relative == pytest.approx(math.sqrt(noise.variance(slope, grid)) / found.value, rel=1e-6)


@pytest.mark.parametrize("boundary", [Periodic(), Free()], ids=["periodic", "free"])
def test_samples_with_small_noise_agree_with_the_linear_error_bar(boundary: object) -> None:
    noise, scatter = HeightNoise(0.05 * NM, 100 * NM), {"force": 0.01}
    found = uncertainty(solved(boundary), "mean_gap", scatter, noise=noise, samples=40, seed=1)
    sampled = found.sampled
    assert sampled is not None
    assert sampled.gain > 10.0
    assert sampled.deviation == pytest.approx(found.relative * found.value, rel=0.35)
    # what is not a power law is of the order of the variance of the parameters
    assert sampled.mean == pytest.approx(found.mean, abs=3.0 * sampled.mean_error + 0.01**2 * found.value)


def test_white_noise_raises_the_peak() -> None:
    found = uncertainty(solved(Periodic()), PressureNorm(16.0), noise=HeightNoise(4.0 * NM), samples=64)
    assert found.sampled is not None
    assert found.bias > 3.0 * found.sampled.mean_error / found.value


def test_numbers_from_several_loads_have_error_bars_too() -> None:
    problem = problem_of(Periodic(), body=asp.Elastic(110e9, 0.3))
    result = asp.solve(problem, asp.MeanPressure(200 * MPA))
    found = uncertainty(result, "stiffness", {"force": 0.05, "heights": 0.03}, samples=4)
    assert isinstance(found, Uncertainty)
    assert found.sampled is not None
    assert found.sampled.values == pytest.approx(found.sampled.predicted, rel=0.1)
    assert "stiffness" in repr(found)


def test_what_is_refused() -> None:
    result = solved(Periodic())
    with refused(InputError, "scatter"):
        uncertainty(result)
    with refused(InputError, "scatter of force", "-0.1"):
        uncertainty(result, "approach", {"force": -0.1})
    with refused(InputError, "parameter of a sensitivity", "'volume'"):
        uncertainty(result, "approach", {"volume": 0.1})
    with refused(InputError, "number of samples of an uncertainty", "2"):
        uncertainty(result, "approach", {"force": 0.1}, samples=2)
    with refused(InputError, "rms of the noise of heights (m)"):
        HeightNoise(-1.0)
