"""Conductivities of materials: from the library, at the doors, in files, of graded layers."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from refusals import refused

import asperity as asp
from asperity.core import units
from asperity.core.errors import InputError
from asperity.io.description import describe, rebuild
from asperity.io.schemas.bodies import BodyTable
from asperity.io.words import body_rows
from asperity.run.build import build_material
from asperity.solids.elastic import Conduction, Elastic
from asperity.solids.layers import LinearGrading, graded
from asperity.solids.library import materials

LORENZ = {"silver": 2.31e-8, "gold": 2.35e-8, "copper": 2.23e-8, "platinum": 2.51e-8, "tungsten": 3.04e-8}
"""Measured Lorenz numbers in V²/K² at 273 K (Kittel, Introduction to Solid State Physics, table
6.5)."""


@pytest.mark.parametrize("name", LORENZ)
def test_heat_and_current_of_pure_metals_agree(name: str) -> None:
    """k rho / T is the Lorenz number of the metal, within the 3 % by which sources differ."""
    known = asp.material(name).conduction
    ratio = known.thermal_conductivity * known.electrical_resistivity / 296.0
    assert ratio == pytest.approx(LORENZ[name], rel=0.03)


SOMMERFELD = 2.443e-8
"""π²/3 (k_B/e)² in V²/K², of free electrons."""

METALS = {record.name for record in materials() if "electrical_resistivity" in record.values}


@pytest.mark.parametrize("name", sorted(METALS - {"cast iron"}))
def test_metals_follow_wiedemann_and_franz_within_a_factor_of_two(name: str) -> None:
    """In alloys the lattice adds heat, up to as much as the electrons carry; the graphite of grey
    iron carries more, and hardly any current."""
    known = asp.material(name).conduction
    ratio = known.thermal_conductivity * known.electrical_resistivity / 293.0 / SOMMERFELD
    assert 0.5 < ratio < 2.0


def test_values_have_sources_and_lie_in_the_range_of_solids() -> None:
    assert len(METALS) >= 15
    for record in materials():
        values = record.values
        for key in ("thermal_conductivity", "electrical_resistivity", "volumetric_heat_capacity", "thermal_expansion"):
            assert key not in values or len(values[key].source) > 10
        if "thermal_conductivity" in values:
            assert 0.1 <= values["thermal_conductivity"].value <= 430.0
        if "electrical_resistivity" in values:
            assert 1.5e-8 <= values["electrical_resistivity"].value <= 2e-6
        if "volumetric_heat_capacity" in values:
            assert 1e6 <= values["volumetric_heat_capacity"].value <= 4.1e6
        if "thermal_expansion" in values:
            assert 3e-7 <= values["thermal_expansion"].value <= 2e-4


@pytest.mark.parametrize(
    ("name", "molar_mass", "density"),
    [
        ("gold", 0.19697, 19300.0),
        ("copper", 0.063546, 8960.0),
        ("nickel", 0.058693, 8900.0),
        ("tungsten", 0.18384, 19300.0),
    ],
)
def test_heat_capacities_of_metals_obey_dulong_and_petit(name: str, molar_mass: float, density: float) -> None:
    """Three times the gas constant an atom; metals at room temperature have 0.95 to 1.05 of it."""
    known = asp.material(name).conduction.volumetric_heat_capacity
    assert known * molar_mass / density / (3.0 * 8.314) == pytest.approx(1.0, abs=0.06)


def test_a_resistivity_may_be_given_by_the_conductivity() -> None:
    kind = "electrical resistivity"
    for text in ("50 MS/m", "50MS/m", "5e5 S/cm", "20 nohm*m", "2 uohm*cm"):
        assert units.parse(text, kind, "rho") == pytest.approx(2e-8, rel=1e-12)
    with refused(InputError, "rho", "m"):
        units.parse("3 m", kind, "rho")
    assert units.show(1.678e-8, "ohm*m") == "16.78 nΩ·m"
    assert units.show(401.0, "W/(m*K)") == "401 W/(m·K)"


def body(text: str) -> Any:
    return BodyTable.model_validate(text)


def test_text_of_a_body_gives_them() -> None:
    found = body("gold{rho=45 MS/m}:500nm/nickel:2um/E=120GPa,nu=.3{k=390W/m/K,rho=17nohm*m}")
    gold = build_material(found.layers[0], None, Path())
    assert gold.conduction.electrical_resistivity == pytest.approx(1.0 / 45e6)
    assert gold.conduction.thermal_conductivity == 317.0
    assert "electrical_resistivity: user" in gold.sources
    assert not any(source.startswith("electrical_resistivity: CRC") for source in gold.sources)
    base = build_material(found.base, None, Path())
    assert (base.conduction.thermal_conductivity, base.conduction.electrical_resistivity) == (390.0, 1.7e-8)


@pytest.mark.parametrize(
    ("key", "value", "subject"),
    [
        ("thermal_conductivity", 0.0, "thermal conductivity (W/(m K))"),
        ("electrical_resistivity", -1.0, "electrical resistivity (ohm m)"),
        ("volumetric_heat_capacity", 0.0, "volumetric heat capacity (J/(m³ K))"),
        ("thermal_expansion", -1e-6, "thermal expansion (1/K)"),
    ],
)
def test_values_must_be_positive(key: str, value: float, subject: str) -> None:
    with refused(InputError, subject, f"{value:g}"):
        Conduction(**{key: value})


def test_text_of_a_body_gives_heat_capacity_and_expansion() -> None:
    found = build_material(body("steel{k=46W/m/K,C=3.7MJ/m^3/K,alpha=12.5e-6/K}"), None, Path())
    assert found.conduction == Conduction(46.0, math.nan, 3.7e6, 12.5e-6)
    assert found.conduction.diffusivity == pytest.approx(46.0 / 3.7e6)
    assert units.show(3.7e6, "J/(m**3*K)") == "3.7 MJ/(m³·K)"
    assert units.show(12e-6, "1/K") == "12 µm/(m·K)"
    assert units.parse("12 um/m/K", "thermal expansion", "alpha") == pytest.approx(12e-6)


def test_files_and_tables_keep_them() -> None:
    copper = asp.material("copper")
    plain = Elastic(1e11, 0.3, asp.Strength(1e9, 4e8))
    assert rebuild(describe(copper)) == copper
    assert rebuild(describe(plain)) == plain
    rows = dict(body_rows(copper))
    assert rows["thermal conductivity k"] == "401 W/(m·K)"
    assert rows["electrical resistivity ρ"] == "16.78 nΩ·m"
    assert not any("conduct" in label for label, _ in body_rows(plain))


def test_graded_layers_mix_them() -> None:
    top, bottom = (Elastic(1e11, 0.3, conduction=Conduction(k)) for k in (10.0, 30.0))
    found = graded(top, bottom, 1e-6, grading=LinearGrading(), sublayers=4)
    assert [layer.material.conduction.thermal_conductivity for layer in found] == [12.5, 17.5, 22.5, 27.5]
    assert all(math.isnan(layer.material.conduction.electrical_resistivity) for layer in found)
