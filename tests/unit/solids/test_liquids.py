"""The library of liquids: what is in it, how it is found, and what a user's own file may say."""

from __future__ import annotations

import math

import pytest
from refusals import refused

import asperity as asp


def test_every_value_has_a_source():
    for record in asp.menisci.liquids():
        assert record.note, record.name
        for key, item in record.values.items():
            assert len(item.source) > 10, (record.name, key)
            assert item.value > 0.0
        assert len(record.liquid.sources) == len(record.values)


def test_water():
    water = asp.liquid("Water")
    # IAPWS R1-76(2014): γ = 235.8 mN/m (1 - T/Tc)^1.256 [1 - 0.625 (1 - T/Tc)], Tc = 647.096 K
    reduced = 1.0 - water.temperature / 647.096
    assert water.surface_tension == pytest.approx(0.2358 * reduced**1.256 * (1.0 - 0.625 * reduced), rel=1e-4)
    assert water.molar_volume == pytest.approx(18.015e-3 / 998.2, rel=1e-4)
    assert not any("assumed" in source for source in water.sources)


def test_lubricants_are_found_by_their_names_and_say_what_is_typical_only():
    assert asp.liquid("fomblin z-dol") == asp.liquid("ZDol")
    assert asp.liquid("PFPE").surface_tension == 0.025
    assert math.isnan(asp.liquid("PFPE").molar_volume)
    assert any("assumed: typical" in source for source in asp.liquid("Z-Dol").sources)


def test_unknown_liquids_are_refused_with_the_nearest_names():
    with refused(asp.InputError, "liquid"):
        asp.liquid("Z-Doll")


def test_own_liquids(tmp_path):
    file = tmp_path / "my.toml"
    file.write_text(
        '[liquid."ours"]\nsurface_tension = "30 mN/m"\ntemperature = "300 K"\naliases = ["PFPE"]\n', "utf-8"
    )
    assert asp.liquid("PFPE", library=file) == asp.menisci.Liquid(
        0.030, 300.0, name="ours", sources=("surface_tension: user", "temperature: user")
    )
    assert len(asp.menisci.liquids(file)) == len(asp.menisci.liquids()) + 1
    file.write_text('[liquid."ours"]\nsurface_tension = "30 mPa"\ntemperature = "300 K"\n', "utf-8")
    with refused(asp.InputError, f"surface_tension of liquid 'ours' in {file}", "'mPa'"):
        asp.menisci.liquids(file)
    file.write_text('[liquid."ours"]\nsurface_tension = "30 mN/m"\n', "utf-8")
    with refused(asp.InputError, f"temperature of liquid 'ours' in {file}"):
        asp.menisci.liquids(file)
    with refused(asp.InputError, "liquid file"):
        asp.menisci.liquids(tmp_path / "absent.toml")
