"""The material library: what is in it, how it is found, and what a user's own file may say."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import FileFormatError, InputError, UnitError
from asperity.solids.library import MaterialRecord, Sourced, material, materials

RECORDS = materials()
TABLE_NAMES = {
    "DLC overcoat": ("DLC", "DLC-hard"),
    "Co-Cr alloy magnetic coating": ("Co-Cr",),
    "Ni-P on Al-Mg alloy": ("Ni-P",),
    "Al-Mg alloy": ("Al-Mg",),
    "Glass ceramics": ("glass ceramics",),
    "Al2O3-TiC slider": ("Al2O3-TiC",),
    "Si": ("silicon",),
}
EXPECTED_NAMES = [
    "bearing steel",
    "AISI 52100",
    "mild steel",
    "stainless steel 304",
    "cast iron",
    "aluminium",
    "copper",
    "gold",
    "silver",
    "titanium",
    "tungsten",
    "chromium",
    "nickel",
    "silicon",
    "fused silica",
    "soda-lime glass",
    "alumina",
    "sapphire",
    "silicon nitride",
    "silicon carbide",
    "zirconia",
    "titanium nitride",
    "diamond",
    "DLC",
    "PTFE",
    "PMMA",
    "PDMS",
    "natural rubber",
    "PEEK",
    "polyethylene",
    "Al2O3-TiC",
    "Ni-P",
    "Co-Cr",
    "Al-Mg",
    "glass ceramics",
]


def record(name: str) -> MaterialRecord:
    return next(record for record in RECORDS if record.name == name)


def own_file(folder: Path, text: str) -> Path:
    path = folder / "own.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("record", RECORDS, ids=lambda record: record.name)
def test_built_in_record_is_plausible_and_sourced(record: MaterialRecord) -> None:
    modulus = record.youngs_modulus.value
    assert 1e5 <= modulus <= 1.3e12
    assert 0.0 < record.poisson_ratio.value < 0.5
    for value in record.values.values():
        assert len(value.source) > 8
        assert value.source != "user"
    if record.hardness is not None:
        assert 1e-3 * modulus < record.hardness.value < 0.13 * modulus
    if record.yield_stress is not None:
        assert 1e-4 * modulus < record.yield_stress.value < 0.05 * modulus
    if record.hardness is not None and record.yield_stress is not None:
        assert 2.5 < record.hardness.value / record.yield_stress.value < 7.0


@pytest.mark.parametrize("record", RECORDS, ids=lambda record: record.name)
def test_body_carries_values_name_and_sources(record: MaterialRecord) -> None:
    body = material(record.name)
    assert body.name == record.name
    assert (body.youngs_modulus, body.poisson_ratio) == (record.youngs_modulus.value, record.poisson_ratio.value)
    assert len(body.sources) == len(record.values)
    assert body.sources[0] == f"youngs_modulus: {record.youngs_modulus.source}"
    assert math.isnan(body.strength.hardness) == (record.hardness is None)
    assert math.isnan(body.strength.yield_stress) == (record.yield_stress is None)


@pytest.mark.parametrize("name", EXPECTED_NAMES)
def test_common_materials_are_there(name: str) -> None:
    assert material(name).youngs_modulus > 0.0


@every_row(reference("table_4_1") + reference("table_4_2"), label=lambda row: row["material"])
def test_published_tables_are_reproduced(row: dict[str, float | str]) -> None:
    columns = {"E_GPa": ("youngs_modulus", 1e9), "nu": ("poisson_ratio", 1.0), "H_GPa": ("hardness", 1e9)}
    names = TABLE_NAMES[str(row["material"])]
    for column, (key, unit) in columns.items():
        published = [float(part) for part in str(row[column]).split(";") if part]
        source = row["cite_" + column.removesuffix("_GPa")]
        for name, number in zip(names, published * (len(names) // max(len(published), 1)), strict=False):
            value = getattr(record(name), key)
            assert value.value == pytest.approx(number * unit, rel=1e-12)
            assert value.source.startswith(str(source))
        if not published and key == "poisson_ratio":
            assert all(record(name).poisson_ratio.assumed for name in names)
        if not published and key == "hardness":
            assert all(record(name).hardness is None for name in names)


def test_assumed_values_are_exactly_these() -> None:
    assumed = {(r.name, key) for r in RECORDS for key, value in r.values.items() if value.assumed}
    names = {"Co-Cr", "Al-Mg", "sapphire", "titanium nitride", "PEEK", "PDMS"}
    ceramics = {"soda-lime glass", "silicon nitride", "silicon carbide", "zirconia"}
    conducting = {(name, "thermal_conductivity") for name in (*ceramics, "Ti-6Al-4V")}
    conducting |= {(name, "electrical_resistivity") for name in ("stainless steel", "cast iron")}
    warming = {("bearing steel", "volumetric_heat_capacity")}
    assert assumed == {(name, "poisson_ratio") for name in names} | conducting | warming


@pytest.mark.parametrize("name", ["DLC", "dlc", " DLC ", "Diamond-Like  Carbon"])
def test_lookup_ignores_case_and_spacing_and_knows_aliases(name: str) -> None:
    assert material(name).name == "DLC"


@pytest.mark.parametrize(
    ("name", "hint"),
    [("alumnium", "aluminium"), ("steels", "steel"), ("DCL", "DLC")],
)
def test_unknown_name_proposes_the_nearest(name: str, hint: str) -> None:
    with refused(InputError, "material", name, hint):
        material(name)


@pytest.mark.parametrize("name", ["unobtainium-xyz", "", "???"])
def test_unknown_name_without_neighbours_says_how_to_list(name: str) -> None:
    with refused(InputError, "material"):
        material(name)


def test_own_file_extends_the_library(tmp_path: Path) -> None:
    path = own_file(
        tmp_path,
        """
        [material."my coating"]
        aliases = ["MC"]
        note = "batch 7"
        youngs_modulus = "210 GPa"
        poisson_ratio = "0.25"
        hardness = { value = "20 GPa", source = "nanoindentation, 2026-01-12" }
        """,
    )
    body = material("mc", library=path)
    assert (body.name, body.youngs_modulus, body.poisson_ratio) == ("my coating", 210e9, 0.25)
    assert body.sources == ("youngs_modulus: user", "poisson_ratio: user", "hardness: nanoindentation, 2026-01-12")
    own = materials(path)[-1]
    assert (own.hardness, own.note) == (Sourced(20e9, "nanoindentation, 2026-01-12"), "batch 7")
    assert material("tungsten", library=str(path)) == material("tungsten")
    assert len(materials(path)) == len(RECORDS) + 1


def test_own_name_replaces_the_whole_built_in_record(tmp_path: Path) -> None:
    path = own_file(tmp_path, '[material."dlc"]\nyoungs_modulus = "200 GPa"\npoisson_ratio = 0.2\n')
    body = material("DLC", library=path)
    assert body.youngs_modulus == 200e9
    assert math.isnan(body.strength.hardness)
    assert len(materials(path)) == len(RECORDS)
    assert material("DLC").youngs_modulus == 140e9


def test_own_name_wins_over_a_built_in_alias(tmp_path: Path) -> None:
    path = own_file(tmp_path, '[material."rubber"]\nyoungs_modulus = "5 MPa"\npoisson_ratio = 0.49\n')
    assert material("rubber", library=path).youngs_modulus == 5e6
    assert material("natural rubber", library=path).youngs_modulus == 2e6
    names = [name.casefold() for r in materials(path) for name in (r.name, *r.aliases)]
    assert len(names) == len(set(names))


GOOD = 'youngs_modulus = "1 GPa"\npoisson_ratio = 0.3\n'


@pytest.mark.parametrize(
    ("text", "error", "subject", "shown"),
    [
        ("[material", FileFormatError, "material file", "TOML"),
        ("", InputError, "material file {}", "no such table"),
        ("material = 3", InputError, "material file {}", "no such table"),
        ('[steel]\nE = "1 GPa"', InputError, "material file {}", "'steel'"),
        ("[material]\nX = 3", InputError, "entry of material 'X' in {}", "3"),
        ("[material.X]\npoisson_ratio = 0.3", InputError, "youngs_modulus of material 'X' in {}", "missing"),
        ('[material.X]\nyoungs_modulus = "1 GPa"', InputError, "poisson_ratio of material 'X' in {}", "missing"),
        ("[material.X]\ndensity = 1\n" + GOOD, InputError, "key of material 'X' in {}", "'density'"),
        (
            '[material.X]\nyoungs_modulus = "1"\npoisson_ratio = 0.3',
            UnitError,
            "youngs_modulus of material 'X' in {}",
            "'1'",
        ),
        (
            "[material.X]\nyoungs_modulus = 1e9\npoisson_ratio = 0.3",
            UnitError,
            "youngs_modulus of material 'X' in {}",
            "'1000000000.0'",
        ),
        (
            '[material.X]\nyoungs_modulus = "1 nm"\npoisson_ratio = 0.3',
            UnitError,
            "youngs_modulus of material 'X' in {}",
            "'nm'",
        ),
        (
            '[material.X]\nyoungs_modulus = "-1 Pa"\npoisson_ratio = 0.3',
            InputError,
            "youngs_modulus of material 'X' in {} (Pa)",
            "-1.0",
        ),
        ('[material.X]\nhardness = "0 Pa"\n' + GOOD, InputError, "hardness of material 'X' in {} (Pa)", "0.0"),
        (
            '[material.X]\nyoungs_modulus = "1 Pa"\npoisson_ratio = 0.51',
            InputError,
            "poisson_ratio of material 'X' in {}",
            "0.51",
        ),
        (
            '[material.X]\nyoungs_modulus = "1 Pa"\npoisson_ratio = "a"',
            UnitError,
            "poisson_ratio of material 'X' in {}",
            "'a'",
        ),
        ('[material.X]\naliases = "Y"\n' + GOOD, InputError, "aliases of material 'X' in {}", "'Y'"),
        ("[material.X]\nnote = 1\n" + GOOD, InputError, "note of material 'X' in {}", "1"),
        (
            '[material.X]\nhardness = { source = "a" }\n' + GOOD,
            InputError,
            "hardness of material 'X' in {}",
            "keys source",
        ),
        (
            '[material.X]\nhardness = { value = "1 Pa", by = "a" }\n' + GOOD,
            InputError,
            "hardness of material 'X' in {}",
            "keys value, by",
        ),
        (
            '[material.X]\nhardness = { value = "1 Pa", source = 1 }\n' + GOOD,
            InputError,
            "source of hardness of material 'X' in {}",
            "1",
        ),
        (
            f'[material.X]\naliases = ["y"]\n{GOOD}[material.Y]\n{GOOD}',
            InputError,
            "names and aliases in material file {}",
            "'y' belongs to both 'X' and 'Y'",
        ),
    ],
)
def test_faulty_own_file_is_refused_in_one_sentence(
    tmp_path: Path, text: str, error: type[InputError], subject: str, shown: str
) -> None:
    file = own_file(tmp_path, text)
    with refused(error, subject.format(file), shown):
        materials(file)


def test_missing_unreadable_and_binary_files_are_refused(tmp_path: Path) -> None:
    with refused(FileFormatError, "material file", "absent.toml"):
        material("DLC", library=tmp_path / "absent.toml")
    with refused(FileFormatError, "material file"):
        materials(tmp_path)
    binary = tmp_path / "binary.toml"
    binary.write_bytes(b"\xff\xfe\x00")
    with refused(FileFormatError, "material file", "8"):
        materials(binary)
