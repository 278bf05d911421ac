"""The ready studies of coated rough surfaces, on fewer pixels and thicknesses: they run, and say
what they should."""

from __future__ import annotations

import numpy as np
import pytest
from ready_studies import axis, ready, results


def small(name, points=48, count=5):
    """The study ``name`` on one small surface, with fewer thicknesses."""
    table = ready(name, points=points, seeds=1)
    if "critical_thickness" in table:
        table["critical_thickness"]["count"] = count
    return table


def solved(table):
    data = results(table).isel(surface=0)
    assert np.all(data["outcome"] == 0)
    return data


@pytest.mark.parametrize(
    ("name", "moduli", "base"),
    [("head_disk_interface", ["150 GPa", "350 GPa"], 200e9), ("carbon_on_silicon", ["140 GPa", "280 GPa"], 170e9)],
)
def test_stiff_carbon_lowers_area_and_menisci_and_raises_the_pressure(name, moduli, base):
    table = small(name)
    axis(table, "modulus")["values"] = moduli
    data = solved(table)
    for number, modulus in enumerate(np.asarray(data["modulus"])):
        bare, endless = (data.isel(modulus=number, thickness=at) for at in (0, -1))
        change = np.sign(modulus - base)
        assert change * (bare["area_fraction"] - endless["area_fraction"]) > 0.0
        assert change * (bare["relative_meniscus_force"] - endless["relative_meniscus_force"]) > 0.0
        assert change * (endless["max_pressure"] - bare["max_pressure"]) > 0.0


def test_menisci_of_the_thick_compliant_layer_pull_hardest():
    data = solved(small("layer_thickness"))
    soft, stiff = np.asarray(data["relative_meniscus_force"])
    assert soft[0] == pytest.approx(stiff[0], rel=1e-3)  # no layer in both
    assert np.all(np.diff(soft) > -0.01 * soft[0])
    assert np.all(np.diff(stiff) < 0.01 * stiff[0])
    assert soft[-1] > 1.3 * soft[0]
    assert stiff[-1] < 0.7 * stiff[0]


def test_area_rises_with_load_and_the_pressure_ends_at_the_hardness():
    table = small("load_dependence")
    data = solved(table)
    area, pressure = np.asarray(data["area_fraction"]), np.asarray(data["max_pressure"])
    hardness = 0.05 * np.asarray(data["modulus"])
    assert np.all(np.diff(area, axis=1) >= 0.0)
    assert np.all(np.diff(area[:, -1]) < 0.0)
    np.testing.assert_allclose(pressure[:, -1], hardness, rtol=1e-9)
    assert np.all(pressure <= hardness[:, None] * (1.0 + 1e-9))
    force = np.asarray(data["relative_meniscus_force"])
    assert np.all(force[:, -1] < 0.1 * force.max(axis=1))


def test_rows_of_equal_normalised_load_have_the_same_area():
    """σ = 0.5 nm under 200 kPa, 1 nm under 400 kPa: X = 2e-3; below the hardness heights and loads
    scale exactly."""
    data = solved(small("normalised_laws", points=64)).sel(modulus=100e9)
    low, high = (data.sel(roughness=rms, load=load, method="nearest") for rms, load in ((0.5e-9, 2e5), (1e-9, 4e5)))
    assert float(low["area_fraction"]) == float(high["area_fraction"]) > 0.0
    assert float(high["max_pressure"] / low["max_pressure"]) == pytest.approx(2.0, rel=1e-3)
    assert float(high["plastic_area_fraction"]) == 0.0
