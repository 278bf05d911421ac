"""The ready study files run, and say what they should."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from study_cases import InProcess

import asperity as asp
from asperity.studies.campaign import prepare_study
from asperity.studies.run import carry_out

FOLDER = Path(__file__).parents[2] / "examples" / "campaigns"


def finished(name: str, tmp_path: Path):
    campaign = prepare_study(FOLDER / f"{name}.toml", tmp_path / name)
    assert carry_out(campaign.plan, campaign.records, InProcess()).failed == 0
    assert campaign.state().complete
    return campaign


GOLD = {"gold_film_area": (1000, 12), "gold_film_grid": (4, 11)}
"""Ready studies with long runs and the shape of their cases; tests/validation runs them on fewer
and smaller ones."""


def test_every_ready_study_is_tested_here():
    assert {path.stem for path in FOLDER.glob("*.toml")} == {
        "coating_thickness",
        "plastic_coating",
        "area_against_load",
        "head_disk_interface",
        "carbon_on_silicon",
        "load_dependence",
        "layer_thickness",
        "normalised_laws",
        "film_and_roughness",
        "humidity",
        "pull_off_and_roughness",
        "skewness_and_kurtosis",
        "rubber_friction",
        "plated_connector",
        "coating_life",
        *GOLD,
    }


@pytest.mark.parametrize("name", GOLD)
def test_studies_of_the_gold_film_have_the_cases_of_the_chapter(name, tmp_path):
    plan = prepare_study(FOLDER / f"{name}.toml", tmp_path / name).plan
    assert plan.shape == GOLD[name]
    paths = iter(plan.paths())
    first, second = next(paths), next(paths)
    assert len(first) == {"gold_film_area": 12, "gold_film_grid": 4}[name], "loads of one surface are one path"
    assert first[0].key != second[0].key


@pytest.mark.slow
def test_a_hard_film_protects_the_steel(tmp_path):
    """The thicker film leaves less plastic strain in the steel; the harder it is the less it flows
    itself, and it bears tension at its bottom."""
    data = finished("plastic_coating", tmp_path).dataset()
    base, film = (np.asarray(data[f"flow_{part}_strain"]) for part in ("base", "layer"))
    assert base.shape == (3, 3)
    assert (base[-1] < base[0]).all()
    assert (film > 0.0).all()
    assert (np.diff(film, axis=1) < 0.0).all()
    assert (np.asarray(data["flow_layer_tension"])[:, -1] > 0.0).all()


def test_gold_and_load_lower_the_resistance_of_a_connector(tmp_path):
    """As does a shorter wavelength: many small spots for few large ones. The area is the load over
    the hardness."""
    data = finished("plated_connector", tmp_path).dataset()
    resistance = np.asarray(data["electrical_resistance"])
    assert resistance.shape == (3, 3, 2)
    assert (np.diff(resistance, axis=0) < 0.0).all()
    assert (np.diff(resistance, axis=1) < 0.0).all()
    assert (np.diff(resistance, axis=2) > 0.0).all()
    freed = np.asarray(data["electrical_extrapolated_conductance"]) * resistance
    assert (np.abs(freed - 1.0) < 0.15).all()
    shares = np.array([5e6, 20e6, 80e6]) / 1.8e9
    np.testing.assert_allclose(np.asarray(data["area_fraction"]), shares[:, None, None] * np.ones((1, 3, 2)), rtol=0.2)


def test_the_life_of_a_coating_is_inverse_to_its_wear_coefficient(tmp_path):
    """It falls with the load, but not more than in proportion, and grows faster than the thickness,
    as pressures fall while the surface runs in. With steps of 5 % lives are known to a few per
    cent."""
    life = np.asarray(finished("coating_life", tmp_path).dataset()["wear_breakthrough"])
    assert life.shape == (3, 4, 2)
    np.testing.assert_allclose(life[..., 0], 10.0 * life[..., 1], rtol=0.1)
    thickness = np.array([20e-9, 50e-9, 100e-9, 200e-9])
    assert (np.diff(np.log(life), axis=1) > np.diff(np.log(thickness))[:, None]).all()
    falls = np.diff(np.log(life), axis=0)
    assert (falls < 0.0).all()
    assert (falls > -1.1 * np.log(4.0)).all()


def test_a_coating_is_felt_from_its_floor_to_its_ceiling(tmp_path):
    """Waves of length λ reach about λ/2π deep: thicknesses beyond a few λ = 1 µm are endless, below
    λ/1000 they are none."""
    found = finished("coating_thickness", tmp_path).analysis()
    for quantity in ("max_pressure", "max_displacement", "mean_gap"):
        floor, ceiling = found[f"{quantity}_floor"], found[f"{quantity}_ceiling"]
        assert np.all(floor < 0.2 * ceiling)
        assert np.all((floor > 0.5e-9) & (ceiling < 20e-6))
    softer, stiffer = np.asarray(found["max_pressure_at_infinity"] / found["max_pressure_at_zero"])
    assert softer < 1.0 < stiffer
    # max pressure is that of small spots and reaches less deep than the mean gap does
    assert np.all(found["max_pressure_ceiling"] < found["mean_gap_ceiling"])


@pytest.mark.slow
def test_warm_rubber_has_the_friction_of_cold_rubber_at_higher_speed(tmp_path):
    """All curves are one against speed times the shift of the times; Persson's theory follows, and
    area falls with speed."""
    found = finished("rubber_friction", tmp_path).dataset()
    friction, area = (np.asarray(found[name]) for name in ("hysteresis_friction", "sliding_area_fraction"))
    speed, temperature = np.asarray(found["speed"]), np.asarray(found["temperature"])
    shift = asp.viscoelasticity.WilliamsLandelFerry(298.0, 8.86, 101.6)
    for column, T in enumerate(temperature):
        seen = speed * shift.factor(T)
        inside = (seen >= speed[0]) & (seen <= speed[-1])
        assert inside.sum() >= 5
        expected = CubicSpline(np.log(speed), friction[:, 1])(np.log(seen[inside]))
        np.testing.assert_allclose(friction[inside, column], expected, atol=0.02 * friction.max())
    assert (np.diff(area, axis=0) <= 1e-3).all()
    assert (np.diff(area, axis=1) >= -1e-3).all()
    peak = friction.max(axis=0)
    assert peak == pytest.approx(peak[1], rel=0.05)
    theory = np.asarray(found["persson_friction"])
    assert theory.max(axis=0) == pytest.approx(peak, rel=0.2)


@pytest.mark.slow
def test_area_rises_in_proportion_to_load(tmp_path):
    campaign = finished("area_against_load", tmp_path)
    found = campaign.analysis()
    area, load = np.asarray(found["area_fraction_corrected_mean"]), np.asarray(found["load"])
    half = np.asarray(found["area_fraction_corrected_half_width"])
    assert np.all(half <= 0.04 * area)
    assert campaign.state().samples < 200
    modulus = 100e9 / (1.0 - 0.3**2)
    # κ = A E* h' / p is √(2π) = 2.51 at small loads (Bush, Gibson & Thomas), and falls with area.
    # At the smallest load grids of 64² and 256² points give 2.56 and 2.53 on twelve surfaces; the
    # mean of the campaign is known to 4 %
    kappa = area * modulus * 0.02 / load
    assert kappa[0] == pytest.approx(math.sqrt(2.0 * math.pi), rel=0.06)
    assert kappa[-1] > 1.6
    assert np.all(np.diff(kappa) < 0.0)


@pytest.mark.slow
def test_roughness_lowers_the_pull_off_and_adhesion_raises_it(tmp_path):
    """Four times the rms height leaves less than a quarter of the pull-off; the criteria say the
    same."""
    found = finished("pull_off_and_roughness", tmp_path).analysis()
    force = np.asarray(found["pull_off_force_mean"])
    assert force.shape == (3, 2)
    assert np.all(np.diff(force, axis=0) < 0.0)
    assert np.all(np.diff(force, axis=1) > 0.0)
    assert np.all(force[-1] < 0.25 * force[0])
    assert np.all(np.diff(found["pastewka_robbins_mean"], axis=0) > 0.0)
    assert np.all(np.diff(found["persson_tosatti_work_mean"], axis=0) < 0.0)
    # twice the work at the same range halves the number and Fuller and Tabor's parameter
    for name in ("pastewka_robbins_mean", "fuller_tabor_mean"):
        values = np.asarray(found[name])
        assert values[:, 1] == pytest.approx(0.5 * values[:, 0], rel=1e-9)
