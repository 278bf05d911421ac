"""Theories of conducting joints and spots: reference values, correlations, limits."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.theories import ElasticJoint, HolmSpot, MeanGapJoint, PlasticJoint, Westergaard
from asperity.theories.conductance import spots

UNIT = PlasticJoint(1.0, 1.0, 1.0, 1.0)
"""k_s m/σ = 1 and H = 1."""


@every_row(reference("transport/joint_conductance_plastic"), label=lambda row: str(row["case"]))
def test_plastic_joints(row: dict[str, float]) -> None:
    found = UNIT.at_pressure(row["p_over_H"])
    assert found.separation[0] == pytest.approx(row["separation_over_sigma"], rel=1e-12)
    assert found.conductance[0] == pytest.approx(row["h_sigma_over_ks_m_integral"], rel=1e-12)
    assert float(UNIT.correlation(row["p_over_H"])) == pytest.approx(row["h_sigma_over_ks_m_correlation"], rel=1e-12)


def test_units_of_a_joint() -> None:
    joint = PlasticJoint(50.0, 2e-6, 0.2, 3e9)
    assert joint.at_pressure(3e6).conductance == pytest.approx(50.0 * 0.2 / 2e-6 * UNIT.at_pressure(1e-3).conductance)
    assert joint.at_pressure(3e6).separation == pytest.approx(2e-6 * UNIT.at_pressure(1e-3).separation)
    with refused(InputError, "pressures of a plastic joint"):
        joint.at_pressure([1e6, 1.5e9])


def test_elastic_joints_conduct_as_mikic_says() -> None:
    joint = ElasticJoint(50.0, 1e11, 2e-6, 0.2)
    found = joint.at_pressure([1e5, 1e6])
    assert found.conductance[1] / found.conductance[0] == pytest.approx(10.0**0.94)
    share = math.sqrt(2.0) * 1e6 / (1e11 * 0.2)
    assert found.conductance[1] == pytest.approx(1.55 * 50.0 * 0.2 / 2e-6 * share**0.94)


def test_the_slope_of_joints_is_the_mean_absolute_one_of_profiles() -> None:
    """The area of elastic joints is then that of Bush, Gibson and Thomas: √(2π) P over E* and the
    rms gradient, which is √2 the rms slope of profiles, √(π/2) of their mean absolute slope."""
    gradient, pressure = 0.3, 1e6
    slope = gradient / math.sqrt(2.0) * math.sqrt(2.0 / math.pi)
    found = ElasticJoint(50.0, 1e11, 1e-6, slope).at_pressure([pressure]).area_fraction[0]
    assert found == pytest.approx(math.sqrt(2.0 * math.pi) * pressure / (1e11 * gradient), rel=1e-12)


def test_a_wave_has_the_stiffness_of_strips() -> None:
    """Barber: h = (k_s/E*) dp/dδ of one wave is that of parallel strips of its contact fraction."""
    wave = Westergaard(1e11, 1e-8, 1e-5)
    pressures = np.array([1e6, 1e7, 5e7])
    expected = spots.strips(7.0, wave.area_fraction(pressures), 1e-5)
    np.testing.assert_allclose(7.0 / 1e11 * wave.stiffness(pressures), expected, rtol=1e-12)


def test_spots_of_holm() -> None:
    radii = np.array([1e-9, 1e-8, 1e-6])
    long = HolmSpot(5e7).at_radius(radii)
    np.testing.assert_allclose(long.conductance, spots.circle(5e7, radii), rtol=1e-14)
    short = HolmSpot(5e7, 4e-8).at_radius(radii)
    assert np.all(short.resistance > long.resistance * spots.wexler(4e-8 / radii))
    assert short.ballistic[0] / short.resistance[0] > 0.9
    assert HolmSpot(5e7).at_radius(0.0).conductance == 0.0


def test_a_solved_rough_contact_conducts_as_the_mean_gap_says() -> None:
    """Akarapu, Sharp and Robbins: u_0 is 0.4 to 0.5 of the rms height, and conductance goes as the
    load; a surface of few long waves scatters about that."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1e-7), hurst=0.8, rolloff_wavelength=1e-5, shortest_wavelength=1e-6
    )
    surface = asp.generate.gaussian(asp.Grid((128, 128), (1.6e-7, 1.6e-7)), spectrum, seed=4)
    body = asp.Elastic(0.91e11, 0.3)
    loads = np.array([2e8, 4e8, 8e8])
    path = asp.solve(
        asp.ContactProblem(surface, body), asp.History([asp.MeanPressure(p) for p in loads]), keep=asp.Keep()
    )
    solved = np.array([2.0 * 50.0 / 1e11 * step.normal_stiffness for step in path.steps])
    joint = MeanGapJoint(100.0, 1e11, 1e-7).at_pressure(loads).conductance
    assert np.all((solved / joint > 0.8) & (solved / joint < 1.3))
    assert math.log(solved[2] / solved[0]) / math.log(4.0) == pytest.approx(1.0, abs=0.15)
