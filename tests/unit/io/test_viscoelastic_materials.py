"""Viscoelastic materials in documents, in the text of a body, in files of materials and of moduli:
each is the solid that Python makes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity import InputError
from asperity.errors import FileFormatError, UnitError
from asperity.io.description import describe, rebuild
from asperity.io.schemas.bodies import BodyTable, body_from_text
from asperity.run.build import body_of_text, build_body
from asperity.run.document import checked, dumps, loads, relocated
from asperity.solids.library import MaterialRecord, material, materials
from asperity.solids.moduli_file import read_measured

TERMS = ((10e6, 1e-2), (3e6, 0.1))
DOCUMENT: dict[str, Any] = {
    "version": 2,
    "surface": {"kind": "sphere", "points": [16, 12], "size": "8 um x 6 um", "radius": "20 um"},
    "control": {"mean_pressure": "1 kPa"},
}
OWN = {"sources": ("user",)}
WAYS: tuple[tuple[str, dict[str, Any], asp.Viscoelastic], ...] = (
    (
        "E=3MPa+10MPa@10ms+3MPa@0.1s,nu=0.5,name=rubber",
        {"kind": "prony", "relaxed": "3 MPa", "moduli": ["10 MPa", "3 MPa"], "times": ["10 ms", "0.1 s"]},
        asp.Viscoelastic.prony(3e6, TERMS, 0.5, name="rubber", **OWN),
    ),
    (
        "E=1MPa@1e+1s,nu=0.5",
        {"kind": "maxwell", "modulus": "1 MPa", "time": "10 s"},
        asp.Viscoelastic.maxwell(1e6, 10.0, 0.5, **OWN),
    ),
    (
        "E=3MPa+297MPa@1ms,nu=0.4,bulk=elastic",
        {
            "kind": "standard_linear",
            "relaxed": "3 MPa",
            "instantaneous": "300 MPa",
            "time": "1 ms",
            "elastic_bulk": True,
        },
        asp.Viscoelastic.standard_linear(3e6, 300e6, 1e-3, 0.4, elastic_bulk=True, **OWN),
    ),
    (
        "E=3MPa,retardation=1s,nu=0.5",
        {"kind": "kelvin_voigt", "relaxed": "3 MPa", "time": "1 s"},
        asp.Viscoelastic.kelvin_voigt(3e6, 1.0, 0.5, **OWN),
    ),
    (
        "E=2GPa,power=0.1,shortest=1ms,longest=10s,nu=0.4",
        {"kind": "power_law", "coefficient": "2 GPa", "exponent": 0.1, "shortest": "1 ms", "longest": "10 s"},
        asp.Viscoelastic.power_law(2e9, 0.1, 0.4, shortest=1e-3, longest=10.0, **OWN),
    ),
    (
        "E=3MPa+10MPa@10ms,nu=0.5,WLF=298K;8.86;101.6K",
        {
            "kind": "prony",
            "relaxed": "3 MPa",
            "moduli": ["10 MPa"],
            "times": ["10 ms"],
            "shift": {"kind": "wlf", "reference": "298 K", "c1": 8.86, "c2": "101.6 K"},
        },
        asp.Viscoelastic.prony(
            3e6, ((10e6, 1e-2),), 0.5, shift=asp.viscoelasticity.WilliamsLandelFerry(298.0, 8.86, 101.6), **OWN
        ),
    ),
    (
        "E=3MPa+10MPa@10ms,nu=0.5,Arrhenius=298K;80kJ/mol",
        {
            "kind": "prony",
            "relaxed": "3 MPa",
            "moduli": ["10 MPa"],
            "times": ["10 ms"],
            "shift": {"kind": "arrhenius", "reference": "298 K", "activation_energy": "80 kJ/mol"},
        },
        asp.Viscoelastic.prony(3e6, ((10e6, 1e-2),), 0.5, shift=asp.viscoelasticity.Arrhenius(298.0, 80e3), **OWN),
    ),
)


def same(found: object, wanted: asp.Viscoelastic) -> None:
    """Equal in all fields, the spectrum to rounding."""
    assert isinstance(found, asp.Viscoelastic)
    assert found.poisson_ratio == wanted.poisson_ratio
    assert (found.elastic_bulk, found.shift, found.name, found.sources) == (
        wanted.elastic_bulk,
        wanted.shift,
        wanted.name,
        wanted.sources,
    )
    assert found.youngs_modulus == pytest.approx(wanted.youngs_modulus, rel=1e-14)
    assert np.array(found.spectrum) == pytest.approx(np.array(wanted.spectrum), rel=1e-14)


@pytest.mark.parametrize(("text", "table", "solid"), WAYS, ids=[way[1]["kind"] for way in WAYS])
def test_text_table_and_python_are_the_same_solid(text: str, table: dict[str, Any], solid: asp.Viscoelastic) -> None:
    same(body_of_text(text, "body"), solid)
    described = {"relaxation": table, "poisson_ratio": solid.poisson_ratio} | (
        {"name": solid.name} if solid.name else {}
    )
    same(build_body(BodyTable.model_validate(described), Path()), solid)
    document = checked({**DOCUMENT, "body": text})
    for form in ("toml", "json"):
        assert loads(dumps(document, form=form), form=form) == document
    same(rebuild(json.loads(json.dumps(describe(solid)))), solid)


def test_stack_of_viscoelastic_layers_on_a_viscoelastic_base() -> None:
    body = body_of_text("E=1GPa+1GPa@5s,nu=0.38,bulk=elastic:2um/E=3MPa+10MPa@10ms,nu=0.5", "body")
    assert isinstance(body, asp.Layered)
    layer, base = body.layers[0].material, body.base
    assert isinstance(layer, asp.Viscoelastic)
    assert layer.elastic_bulk
    assert layer.relaxed_share == pytest.approx(0.5)
    assert isinstance(base, asp.Viscoelastic)
    assert base.relaxed_share == pytest.approx(3 / 13)
    assert body.layers[0].thickness == 2e-6


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("E=3MPa,power=0.1,retardation=1s,nu=0.4", "power and retardation"),
        ("retardation=1s,nu=0.4", "without E"),
        ("E=3MPa@1s,moduli=x.csv,nu=0.4", "@ and moduli"),
        ("E=3MPa@1s,nu=0.5,shortest=1s", "shortest"),
        ("E=3MPa@1s,nu=0.4,bulk=stiff", "bulk=stiff"),
        ("E=3MPa@1s,nu=0.4,WLF=298K;8.86", "WLF=298K;8.86"),
        ("E=3MPa@1s,nu=0.4,WLF=298K;1;2K,Arrhenius=298K;1J/mol", "Arrhenius"),
    ],
)
def test_text_that_does_not_go_together_is_refused(text: str, shown: str) -> None:
    with refused(InputError, "--body", shown):
        body_of_text(text, "--body")


def test_bad_series_times_and_units_are_refused() -> None:
    with pytest.raises(InputError, match="1MPa@@3s"):
        body_from_text("E=1MPa@@3s,nu=0.3")
    for relaxation, key in (
        ({"kind": "prony", "moduli": ["1 MPa"], "times": ["1 m"]}, "body.relaxation.times[1]"),
        ({"kind": "prony", "moduli": ["1 MPa"], "times": []}, "body.relaxation.times"),
        ({"kind": "maxwell", "modulus": "0 Pa", "time": "1 s"}, "body.relaxation.modulus"),
        (
            {"kind": "power_law", "coefficient": "1 GPa", "exponent": 1.5, "shortest": "1 s", "longest": "2 s"},
            "body.relaxation.exponent",
        ),
        ({"kind": "rubber"}, "body.relaxation.kind"),
    ):
        with pytest.raises(InputError) as caught:
            checked({**DOCUMENT, "body": {"relaxation": relaxation, "poisson_ratio": 0.4}})
        assert key in str(caught.value)
    for body in (
        {"relaxation": WAYS[0][1]},
        {"relaxation": WAYS[0][1], "youngs_modulus": "1 Pa", "poisson_ratio": 0.3},
    ):
        with pytest.raises(InputError, match="relaxation"):
            checked({**DOCUMENT, "body": body})


def moduli(folder: Path, head: str, scale: float = 1.0, unit: float = 1.0) -> Path:
    """File of the moduli of a solid, frequencies times ``scale``, moduli in ``unit`` Pa."""
    solid = asp.Viscoelastic.prony(3e6, TERMS, 0.5)
    f = np.geomspace(1e-2, 1e4, 25)
    E = solid.complex_modulus(2.0 * np.pi * f) / unit
    file = folder / "moduli.csv"
    rows = [f"{scale * x:.17g},{y.real:.17g},{y.imag:.17g}" for x, y in zip(f, E, strict=True)]
    file.write_text("# measured by nobody\n" + "\n".join([head, *rows]) + "\n", encoding="utf-8")
    return file


@pytest.mark.parametrize(
    ("head", "scale", "unit"),
    [
        ("frequency (Hz), storage modulus (Pa), loss modulus (Pa)", 1.0, 1.0),
        ("angular frequency [rad/s],storage (MPa),loss (MPa)", 2.0 * np.pi, 1e6),
    ],
)
def test_measured_moduli_are_fitted_from_their_file(tmp_path: Path, head: str, scale: float, unit: float) -> None:
    file = moduli(tmp_path, head, scale, unit)
    f, storage, loss = read_measured(file).columns
    wanted = asp.Viscoelastic.prony(3e6, TERMS, 0.5).complex_modulus(2.0 * np.pi * f)
    assert f == pytest.approx(np.geomspace(1e-2, 1e4, 25), rel=1e-12)
    assert storage + 1j * loss == pytest.approx(wanted, rel=1e-12)
    table = BodyTable.model_validate(body_from_text("moduli=moduli.csv,nu=0.5"))
    solid = build_body(table, tmp_path)
    assert isinstance(solid, asp.Viscoelastic)
    assert solid.spectrum == asp.viscoelasticity.fitted_solid(f, storage, loss, poisson_ratio=0.5).solid.spectrum
    assert solid.complex_modulus(2.0 * np.pi * f) == pytest.approx(wanted, rel=0.02)
    assert any("moduli.csv" in source for source in solid.sources)


def test_file_of_moduli_moves_with_the_document(tmp_path: Path) -> None:
    body = {
        "layers": [
            {"relaxation": {"kind": "measured", "moduli_file": "m.csv"}, "poisson_ratio": 0.4, "thickness": "1 um"}
        ],
        "base": "steel",
    }
    document = checked({**DOCUMENT, "body": body})
    moved: Any = relocated(document, tmp_path, tmp_path / "run")
    assert moved.body.layers[0].relaxation.moduli_file == "../m.csv"


@pytest.mark.parametrize(
    "text",
    [
        "",
        "frequency (Hz), storage (Pa)\n1,2\n",
        "frequency (Hz), storage (m), loss (Pa)\n1,2,3\n",
        "frequency (Hz), angular frequency (rad/s), storage (Pa), loss (Pa)\n1,2,3,4\n",
        "frequency (Hz), storage (Pa), loss (Pa)\n1,2\n",
        "frequency (Hz), storage (Pa), loss (Pa)\n1,2,x\n",
        "1,2,3\n",
    ],
)
def test_what_is_no_file_of_moduli_is_refused(tmp_path: Path, text: str) -> None:
    file = tmp_path / "moduli.csv"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(FileFormatError):
        read_measured(file)
    with pytest.raises(FileFormatError):
        read_measured(tmp_path / "missing.csv")


OWN_FILE = """
[material."my rubber"]
youngs_modulus = { value = "3 MPa + 10 MPa @ 10 ms + 3 MPa @ 0.1 s", source = "own test" }
poisson_ratio = 0.45
elastic_bulk = true
shift = { value = "WLF 298 K; 8.86; 101.6 K", source = "handbook" }
"""


def test_own_library_has_viscoelastic_materials(tmp_path: Path) -> None:
    file = tmp_path / "own.toml"
    file.write_text(OWN_FILE, encoding="utf-8")
    found = material("my rubber", library=file)
    shift = asp.viscoelasticity.WilliamsLandelFerry(298.0, 8.86, 101.6)
    sources = ("youngs_modulus: own test", "poisson_ratio: user", "shift: handbook")
    same(
        found,
        asp.Viscoelastic.prony(3e6, TERMS, 0.45, name="my rubber", sources=sources, elastic_bulk=True, shift=shift),
    )
    table = BodyTable.model_validate({**body_from_text("my rubber"), "materials_file": "own.toml"})
    assert repr(build_body(table, tmp_path)) == repr(found)
    assert MaterialRecord.find("my rubber", file).youngs_modulus.value == 16e6


def test_no_built_in_material_relaxes_without_a_source() -> None:
    assert [record.name for record in materials() if record.relaxation is not None] == []


@pytest.mark.parametrize(
    ("line", "kind", "subject"),
    [
        ('youngs_modulus = "3MPa+@1s"', UnitError, "youngs_modulus of material 'x' in {}"),
        ('youngs_modulus = "3MPa+1MPa@1m"', UnitError, "time of youngs_modulus of material 'x' in {}"),
        ('youngs_modulus = "3MPa"\nelastic_bulk = true', InputError, "elastic_bulk of material 'x' in {}"),
        ('youngs_modulus = "3MPa+1MPa@1s"\nelastic_bulk = 1', InputError, "elastic_bulk of material 'x' in {}"),
        ('youngs_modulus = "3MPa+1MPa@1s"\nshift = "VFT 3 K"', InputError, "shift of material 'x' in {}"),
    ],
)
def test_bad_entries_of_a_library_are_refused(tmp_path: Path, line: str, kind: type[InputError], subject: str) -> None:
    file = tmp_path / "own.toml"
    file.write_text(f"[material.x]\npoisson_ratio = 0.3\n{line}\n", encoding="utf-8")
    with refused(kind, subject.format(file)):
        materials(file)


def test_graded_layers_of_what_relaxes_are_refused() -> None:
    rubber, steel = asp.Viscoelastic.maxwell(1e6, 1.0, 0.4), asp.Elastic(200e9, 0.3)
    with refused(InputError, "materials of a graded layer"):
        asp.solids.graded(rubber, steel, 1e-6)


def test_series_of_too_many_terms_are_refused() -> None:
    """A band of six hundred decades, or a thousand terms in one, would take for ever."""
    with refused(InputError, "number of terms of a fitted series", "3 a decade"):
        asp.Viscoelastic.power_law(1e9, 0.1, 0.3, shortest=1e-300, longest=1e300)
    wide = np.geomspace(1e-150, 1e150, 5)
    with refused(InputError, "number of terms of a fitted series"):
        asp.viscoelasticity.fitted_solid(wide, np.ones(5), np.ones(5), poisson_ratio=0.3)
    with refused(InputError, "number of terms of a fitted series", "100000 a decade"):
        asp.viscoelasticity.fitted_solid([1.0, 10.0], [1.0, 2.0], [0.1, 0.1], poisson_ratio=0.3, per_decade=100000)
