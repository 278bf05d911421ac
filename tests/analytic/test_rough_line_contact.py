"""Line contact of profiles in plane strain: one wave in closed form, rough profiles by an
independent solver."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from reference_data import Row, every_row, reference
from refusals import refused

import asperity as asp
from asperity.contact import line_problem
from asperity.core.errors import InputError
from asperity.surfaces import Profile
from asperity.theories import full_contact_pressure, persson_line_area, wave_line_area

E_STAR = 1e9
BODY = asp.Elastic(0.75e9, 0.5)  # E* = 1 GPa against a rigid body
ROWS = reference("profiles/line_contact")
POINTS, SPACING, REALISATIONS = 2048, 1e-8, 8


@every_row([row for row in ROWS if row["profile"] == "wave"], lambda row: f"load {row['load']}")
def test_one_wave(row: Row) -> None:
    load, amplitude, length = float(row["load"]), 1e-9, POINTS * SPACING
    full = math.pi * E_STAR * amplitude / length
    area = float(wave_line_area(load * full, E_STAR, amplitude, length))
    assert area == pytest.approx(float(row["area_fraction"]), rel=1e-9)
    x = np.arange(POINTS) / POINTS
    wave = Profile(amplitude * np.cos(2.0 * np.pi * x), SPACING, periodic=True)
    found = asp.solve(line_problem(wave, BODY), asp.MeanPressure(load * full))
    assert found.area_fraction == pytest.approx(area, abs=1.0 / POINTS)  # a node at each end of the contact


@cache
def rough(hurst: float, seed: int) -> Profile:
    """Plateau to mode 8, power law to mode 64, scaled to the rms slope 1e-3."""
    rng = np.random.default_rng(seed)
    modes = np.arange(POINTS // 2 + 1)
    psd = np.where((modes > 0) & (modes <= 64), np.maximum(modes / 8.0, 1.0) ** (-1.0 - 2.0 * hurst), 0.0)
    waves = (rng.standard_normal(modes.size) + 1j * rng.standard_normal(modes.size)) * np.sqrt(psd)
    q = 2.0 * np.pi * modes / (POINTS * SPACING)
    slope = np.sqrt(np.mean(np.square(np.fft.irfft(1j * q * waves, POINTS))))
    return Profile(np.fft.irfft(waves, POINTS) * 1e-3 / slope, SPACING, periodic=True)


@every_row([row for row in ROWS if row["profile"] != "wave"], lambda row: f"{row['profile']} load {row['load']}")
def test_rough_profiles(row: Row) -> None:
    hurst, load = float(str(row["profile"]).rpartition("=")[2]), float(row["load"])
    pressure = load * E_STAR * 1e-3
    problems = [line_problem(rough(hurst, seed), BODY) for seed in range(REALISATIONS)]
    areas = [asp.solve(problem, asp.MeanPressure(pressure)).area_fraction for problem in problems]
    error = math.hypot(float(row["standard_error"]), float(np.std(areas, ddof=1)) / math.sqrt(REALISATIONS))
    assert float(np.mean(areas)) == pytest.approx(float(row["area_fraction"]), abs=4.0 * error)


def test_persson_of_a_line_and_full_contact() -> None:
    loads = np.array([0.02, 0.05, 0.1, 0.3, 0.6, 1.0])
    printed = [0.032, 0.080, 0.159, 0.451, 0.770, 0.954]
    np.testing.assert_allclose(persson_line_area(loads * E_STAR * 1e-3, E_STAR, 1e-6), printed, atol=6e-4)
    profile = rough(0.8, 0)
    closed = asp.solve(line_problem(profile, BODY), asp.MeanPressure(10.0 * E_STAR * 1e-3))
    assert closed.area_fraction == 1.0
    expected = full_contact_pressure(E_STAR, 1e-6)
    assert float(np.std(closed.pressure)) == pytest.approx(expected, rel=1e-4)  # tolerance of the solver


def test_an_open_profile_lies_alone() -> None:
    x = SPACING * (np.arange(401) - 200)
    found = line_problem(Profile(-(x**2) / 2e-3, SPACING), BODY, length=2.0, datum=1e-3)
    assert isinstance(found.boundary, asp.FreeLine)
    assert found.surface.dy == 2.0
    assert "grooves without end" in found.surface.origin.history[-1]
    with refused(InputError, "surface"):
        line_problem(Profile([0.0, math.nan, 0.0], SPACING), BODY)
    with refused(InputError, "datum of a line contact"):
        line_problem(rough(0.8, 0), BODY, datum=1.0)
