"""Fuller and Tabor's adhesion of rough surfaces: reference rows, the limit of no adhesion,
pull-off, curves."""

from __future__ import annotations

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.theories.adhesion.fuller_tabor import FullerTabor

ROWS, PULL_OFF = reference("fuller_tabor"), reference("fuller_tabor_pulloff")


def of_reach(reach, parting=True):
    """Heights of deviation 1 and the work of adhesion that gives δ_c = ``reach``."""
    E_star, radius = 1.0, 1e4
    work = E_star / np.pi * np.sqrt((reach / 0.75) ** 3 / radius)
    return FullerTabor(E_star, 1e-6, radius, 1.0, work, parting=parting)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row['inv_Delta_c']:g}-D{row['D']:g}")
@pytest.mark.parametrize("way", ["unloading", "loading"])
def test_loads_areas_and_numbers(row, way):
    """Ten digits are good."""
    theory = of_reach(1.0 / row["inv_Delta_c"], way == "unloading")
    assert 1.0 / theory.reach == pytest.approx(row["inv_Delta_c"], rel=1e-12)
    assert theory.load_per_summit(row["D"]) == pytest.approx(row[f"load_{way}"], rel=1e-10)
    found = theory.at_separation(row["D"])
    unit = theory.density * np.pi * theory.sphere.critical_radius**2
    assert found.area_fraction[0] / unit == pytest.approx(row[f"a2_{way}"], rel=1e-10)
    assert found.contact_density[0] / theory.density == pytest.approx(row[f"n_{way}"], rel=1e-10)
    assert found.pressure[0] == pytest.approx(theory.density * theory.sphere.pull_off * row[f"load_{way}"], rel=1e-10)


@every_row(PULL_OFF, label=lambda row: f"{row['inv_Delta_c']:g}")
def test_pull_off(row):
    """Ten digits of the force, six of the place."""
    theory = of_reach(row["Delta_c"])
    separation, pressure = theory.pull_off()
    assert -pressure / (theory.density * theory.sphere.pull_off) == pytest.approx(row["relative_pulloff"], rel=2e-10)
    assert separation == pytest.approx(row["D_pulloff"], abs=2e-6)


@every_row(reference("adhesion_parameters"), label=lambda row: f"R{row['R_m']:g}")
def test_adhesion_parameters(row):
    theory = FullerTabor(row["Estar_Pa"], 1e10, row["R_m"], row["sigma_m"], row["w_J_per_m2"], spacing=row["z0_m"])
    assert 1.0 / theory.reach == pytest.approx(row["inv_Delta_c"], rel=1e-13)
    assert theory.theta == pytest.approx(row["theta"], rel=1e-13)
    assert 1.0 / theory.reach == pytest.approx(4.0 / 3.0 * (theory.theta / np.pi) ** (2.0 / 3.0), rel=1e-12)


@pytest.mark.parametrize("parting", [True, False])
def test_without_adhesion_it_is_greenwood_and_williamson(parting):
    """Adhesion lowers P by the order (w/E*δ^1.5)^½ of JKR: 1e-5 here."""
    theory = FullerTabor(1e11, 1e12, 1e-6, 1e-8, 1e-15, mean_height=2e-8, parting=parting)
    pressures = np.geomspace(1e5, 1e9, 9)
    found, elastic = theory.at_pressure(pressures), theory.summits.at_pressure(pressures)
    for quantity in ("pressure", "area_fraction", "contact_density", "separation", "stiffness"):
        assert getattr(found, quantity) == pytest.approx(getattr(elastic, quantity), rel=1e-4), quantity
    assert theory.pull_off()[1] > -1e-3


def test_smooth_surfaces_part_like_one_sphere():
    """JKR's least load is at δ/δ_c = -(4√x - x²)/3, x³ = 9, and flat there to the square of the
    heights over the reach."""
    theory = of_reach(1000.0)
    x = 9.0 ** (1.0 / 3.0)
    assert theory.load_per_summit(-1000.0 * (x**2 - 4.0 * np.sqrt(x)) / 3.0) == pytest.approx(-1.0, abs=1e-5)


def test_the_stiffness_is_their_slope():
    theory = FullerTabor(1e10, 1e12, 1e-6, 1e-8, 0.05)
    pressures = np.geomspace(1e4, 1e8, 200)
    found = theory.at_pressure(pressures)
    assert found.pressure == pytest.approx(pressures, rel=1e-10)
    assert np.all(np.diff(found.area_fraction) > 0.0)
    slope = -np.gradient(found.pressure, found.separation)[1:-1]
    # differences over a twentieth in ln p, where the load and its slope change slowly
    assert found.stiffness[100:-1] == pytest.approx(slope[99:], rel=5e-3)


def test_summits_hold_on_when_the_surfaces_part():
    away, toward = of_reach(2.0, True), of_reach(2.0, False)
    D = np.linspace(0.0, 4.0, 9)
    held, fresh = away.at_separation(D), toward.at_separation(D)
    assert np.all(held.contact_density > fresh.contact_density)
    assert np.all(held.area_fraction > fresh.area_fraction)


def test_validity_asks_for_jkr():
    theory = FullerTabor(1e11, 1e12, 1e-6, 1e-8, 0.05)
    tabor = theory.validity(theory.at_pressure([1e5, 1e6]))[-1]
    assert tabor.value.shape == (2,)
    assert bool(tabor.holds[0]) == (theory.sphere.tabor >= 5.0)


def test_pressures_beyond_forty_deviations_are_refused():
    with refused(InputError, "pressure", "40"):
        FullerTabor(1e9, 1e12, 1e-7, 1e-9, 0.05).at_pressure([1e5, 1e15])
