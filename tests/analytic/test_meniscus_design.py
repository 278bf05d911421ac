"""Roughness and caps that neither stick nor yield, against their reference rows and trends."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import NoSolutionError
from asperity.theories.wet.design import DesignedCaps, RoughnessWindow

E, H, GAMMA = 110e9, 10e9, 0.025


@every_row(reference("design_sigma_R"), label=lambda row: f"{row['case']:g}")
def test_windows_of_roughness(row):
    closed = {row["closure"]: row["N_or_eta_R_sigma"]}
    film, share = row["film_m"], row["max_Fm_over_W"]
    window = RoughnessWindow(E, H, GAMMA, film, 0.1, 1e-6, share, closure=row["closure"], **closed)
    found = window.at_radius([row["R_m"]])
    # both are roots to 1e-12, the reference has 12 digits
    assert found.smallest == pytest.approx(row["sigma_min_m"], rel=1e-11, abs=0.0)
    assert found.largest == pytest.approx(row["sigma_max_m"], rel=1e-11)
    assert found.feasible == row["feasible"]


@every_row(reference("designed_asperities"), label=lambda row: f"{row['case']:g}")
def test_designed_caps(row):
    film, angle = row["film_m"], row["theta_rad"]
    caps = DesignedCaps(
        row["Estar_Pa"], row["H_Pa"], row["W_N"], row["gamma_N_per_m"], film, row["safety"], contact_angle=angle
    )
    found = caps.of_count([row["R_m"]], [row["N_used"]])
    wanted = {
        "least_dry": "N_min_dry",
        "least": "N_min_with_menisci",
        "meniscus_force": "Fm_N",
        "force_ratio": "Fm_over_W",
        "contact_area": "contact_area_m2",
        "approach": "approach_m",
        "height": "min_asperity_height_m",
    }
    for name, column in wanted.items():
        assert getattr(found, name) == pytest.approx(row[column], rel=1e-11), name


def test_the_window_opens_at_the_critical_radius():
    window = RoughnessWindow(E, H, GAMMA, 1e-9, 0.1, 1e-6, 0.1)
    critical, deviation = window.critical_radius, window.critical_deviation
    # read off the curves: 1.5 µm and 4.5 nm
    assert (critical, deviation) == pytest.approx((1.5e-6, 4.5e-9), rel=0.02)
    found = window.at_radius(np.array([0.99, 1.0, 1.01]) * critical)
    assert found.smallest[1] == pytest.approx(deviation, rel=1e-9)
    assert list(found.feasible[[0, 2]]) == [0.0, 1.0]
    thicker = RoughnessWindow(E, H, GAMMA, 2e-9, 0.1, 1e-6, 0.1)
    assert thicker.critical_radius > critical
    assert thicker.at_radius([critical]).smallest[0] > deviation


def test_large_caps_stick_less_and_a_whole_number_is_safe():
    caps = DesignedCaps(E, H, 0.05, GAMMA, 2e-9, 2.0)
    found = caps.at_radius(np.geomspace(1e-6, 1e-4, 20))
    assert (found.count >= found.least).all()
    assert (found.count < found.least + 1.0).all()
    assert (found.safety >= 2.0 * (1.0 - 1e-12)).all()
    exact = caps.of_count(found.radius, found.least)
    assert exact.safety == pytest.approx(2.0, rel=1e-12)
    assert (np.diff(exact.force_ratio) < 0.0).all()
    # F_m/W goes as 1/R where a meniscus is small beside the load of a cap
    law = 32.0 * 2.0 * GAMMA * 2.0 * E**2 / (9.0 * math.pi**2 * exact.radius * (0.382 * H) ** 3)
    assert exact.force_ratio[-1] == pytest.approx(law[-1], rel=2.0 * law[-1])


def test_what_has_no_design_is_refused():
    with refused(NoSolutionError, "radius of the caps (m)"):
        DesignedCaps(E, H, 0.05, GAMMA, 2e-9, 2.0).at_radius([1e-9])
    with refused(NoSolutionError, "share of the load that menisci may pull with"):
        RoughnessWindow(E, H, GAMMA, 1e-9, 1e-9, 1e-6, 1e-12).at_radius([1e-6])
