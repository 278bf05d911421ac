"""The problem document: exact round trip, and all errors at once in plain words."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from refusals import refused

from asperity import InputError
from asperity.errors import FileFormatError, OutputError
from asperity.io.schemas.bodies import body_from_text
from asperity.run.document import (
    ProblemDocument,
    built_in,
    checked,
    dumps,
    json_schema,
    load_document,
    loads,
    relocated,
    save_document,
)

SMALL: Mapping[str, Any] = {
    "version": 1,
    "surface": {"kind": "sphere", "points": [16, 12], "size": "8 um x 6 um", "radius": "20 um"},
    "body": {"youngs_modulus": "100 GPa", "poisson_ratio": 0.3},
    "control": {"mean_pressure": "1 MPa"},
}


COATING = {"material": "DLC", "thickness": "5 nm"}
GRADED = {"kind": "linear", "top": {"material": "TiN"}, "bottom": {"material": "steel"}, "thickness": "1 um"}


def with_(**tables: Any) -> dict[str, Any]:
    """The small document with other tables; None removes one."""
    return {key: value for key, value in (dict(SMALL) | tables).items() if value is not None}


def message(table: Mapping[str, Any]) -> str:
    with pytest.raises(InputError) as caught:
        checked(table)
    return str(caught.value)


def quantities(*units: str) -> st.SearchStrategy[str]:
    numbers = st.floats(1e-3, 1e6).map(repr) | st.integers(1, 999).map(str)
    return st.builds("{}{}{}".format, numbers, st.sampled_from(["", " "]), st.sampled_from(units))


LENGTHS = quantities("nm", "um", "µm", "m")
PRESSURES = quantities("Pa", "kPa", "GPa", "N/mm**2")
TEXTS = st.text(st.characters(codec="utf-8"), min_size=1, max_size=12).filter(lambda text: bool(text.strip()))
POSITIVE = st.floats(1e-300, 1e300)
COUNTS = st.integers(1, 10**6)
POINTS = st.lists(COUNTS, min_size=2, max_size=2)


def pairs(values: st.SearchStrategy[Any]) -> st.SearchStrategy[list[Any]]:
    return st.lists(values, min_size=2, max_size=2)


def threes(values: st.SearchStrategy[Any]) -> st.SearchStrategy[list[Any]]:
    return st.lists(values, min_size=3, max_size=3)


STEPS = st.one_of(
    st.fixed_dictionaries(
        {"step": st.just("level")}, optional={"form": st.sampled_from(["mean", "plane", "quadratic"])}
    ),
    st.fixed_dictionaries({"step": st.just("crop"), "x": st.just(["0 nm", "1.5 um"])}),
    st.fixed_dictionaries(
        {
            "step": st.just("mask"),
            "regions": st.lists(
                st.one_of(
                    st.fixed_dictionaries({"kind": st.just("rectangle"), "y": st.just(["0 nm", "1.5 um"])}),
                    st.fixed_dictionaries(
                        {"kind": st.just("ellipse"), "centre": pairs(LENGTHS), "radii": pairs(LENGTHS)},
                        optional={"angle": st.builds("{} deg".format, st.floats(-180.0, 180.0))},
                    ),
                    st.fixed_dictionaries(
                        {"kind": st.just("polygon"), "x": threes(LENGTHS), "y": threes(LENGTHS)},
                    ),
                ),
                min_size=1,
                max_size=3,
            ),
        },
        optional={"invert": st.booleans()},
    ),
    st.fixed_dictionaries({"step": st.just("resample"), "points": POINTS}),
    st.fixed_dictionaries(
        {"step": st.just("fill")}, optional={"method": st.sampled_from(["harmonic", "mean", "nearest"])}
    ),
    st.fixed_dictionaries({"step": st.just("taper")}, optional={"width": st.floats(1e-6, 0.5)}),
    st.fixed_dictionaries({"step": st.just("periodise")}),
    st.fixed_dictionaries({"step": st.just("level"), "degree": st.integers(0, 20)}, optional={"robust": st.booleans()}),
    st.fixed_dictionaries(
        {"step": st.just("despike")}, optional={"threshold": st.floats(0.1, 99.0), "window": st.sampled_from([3, 7])}
    ),
    st.fixed_dictionaries({"step": st.just("line_correct")}, optional={"axis": st.sampled_from("xy")}),
    st.fixed_dictionaries(
        {"step": st.just("filter"), "short": LENGTHS, "kind": st.sampled_from(["gaussian", "robust", "sharp"])},
        optional={"long": LENGTHS, "short_y": LENGTHS, "order": st.integers(0, 2)},
    ),
    st.fixed_dictionaries({"step": st.just("tip_limit"), "radius": LENGTHS}),
    st.fixed_dictionaries(
        {"step": st.just("tip"), "radius": LENGTHS},
        optional={"opening": st.builds("{} deg".format, st.floats(1.0, 179.0)), "mask_uncertain": st.booleans()},
    ),
    st.fixed_dictionaries({"step": st.just("slice"), "y": st.just("middle")}, optional={"length": LENGTHS}),
    st.fixed_dictionaries({"step": st.just("slice"), "x": LENGTHS}),
)


def generated(kind: str, **keys: st.SearchStrategy[Any]) -> st.SearchStrategy[dict[str, Any]]:
    return st.fixed_dictionaries(
        {
            "kind": st.just(kind),
            "points": POINTS,
            "size": st.builds("{} x {}".format, LENGTHS, LENGTHS) | LENGTHS,
            **keys,
        },
        optional={"prepare": st.lists(STEPS, max_size=3)},
    )


SPECTRA = (
    st.fixed_dictionaries(
        {"kind": st.just("exponential"), "rms_height": LENGTHS, "correlation_length": LENGTHS},
        optional={"drop": st.floats(0.01, 0.99), "correlation_length_y": LENGTHS},
    )
    | st.fixed_dictionaries(
        {
            "kind": st.just("self_affine"),
            "rms_slope": POSITIVE,
            "hurst": st.floats(0.01, 1.0),
            "rolloff_wavelength": LENGTHS,
            "shortest_wavelength": LENGTHS,
        },
        optional={"longest_wavelength": LENGTHS},
    )
    | st.fixed_dictionaries(
        {
            "kind": st.just("two_slopes"),
            "plateau": quantities("nm**4", "m**4"),
            "exponents": st.lists(POSITIVE, min_size=2, max_size=2),
            "rolloff_wavelength": LENGTHS,
            "crossover_wavelength": LENGTHS,
        },
        optional={"shortest_wavelength": LENGTHS | st.just("0 m")},
    )
    | st.fixed_dictionaries(
        {
            "kind": st.just("measured"),
            "surface": st.fixed_dictionaries({"kind": st.just("file"), "path": TEXTS}),
        },
        optional={"isotropic": st.booleans(), "floor": quantities("nm**4")},
    )
    | st.fixed_dictionaries(
        {
            "kind": st.just("scans"),
            "scans": st.lists(
                st.fixed_dictionaries(
                    {"path": TEXTS},
                    optional={
                        "channel": TEXTS | st.integers(0, 9),
                        "instrument": st.sampled_from(["stylus", "optical", "afm"]),
                        "tip_radius": LENGTHS,
                        "axis": st.sampled_from("xy"),
                        "prepare": st.lists(STEPS, max_size=2),
                    },
                ),
                min_size=1,
                max_size=3,
            ),
        },
        optional={"corner": st.sampled_from(["auto", "rounded", "sharp"]), "shortest_wavelength": LENGTHS},
    )
)
HEIGHTS = st.one_of(
    st.fixed_dictionaries({"kind": st.just("moments")}, optional={"skewness": st.floats(-9, 9), "kurtosis": POSITIVE}),
    st.fixed_dictionaries({"kind": st.just("two_levels"), "share": st.floats(0.01, 0.99), "separation": POSITIVE}),
)
SEEDS = st.integers(0, 2**63 - 1)
FILES = st.fixed_dictionaries(
    {"kind": st.just("file"), "path": TEXTS},
    optional={
        "channel": TEXTS | st.integers(0, 9),
        "size": LENGTHS,
        "height_unit": st.sampled_from(["nm", "m"]),
        "z_scale": LENGTHS,
        "prepare": st.lists(STEPS, max_size=4),
    },
)
SURFACES = st.one_of(
    FILES,
    generated("sphere", radius=LENGTHS, exact=st.booleans()),
    generated("elliptic_paraboloid", radius_x=LENGTHS, radius_y=LENGTHS),
    generated("cylinder", radius=LENGTHS, axis=st.sampled_from("xy")),
    generated("cone", slope=POSITIVE),
    generated("flat_punch", radius=LENGTHS, depth=LENGTHS),
    generated("sinusoid", amplitude=LENGTHS, wavelength=LENGTHS),
    generated("bisinusoid", amplitude=LENGTHS, wavelength=LENGTHS),
    generated("flat"),
    generated("rough", seed=SEEDS, spectrum=SPECTRA, exact_rms=st.booleans(), periodic=st.booleans()),
    generated(
        "laser_bumps",
        pitch=st.lists(LENGTHS, min_size=2, max_size=2),
        rim_height=LENGTHS,
        rim_radius=LENGTHS,
        rim_width=LENGTHS,
    ),
    generated("grooves", pitch=LENGTHS, width=LENGTHS, depth=LENGTHS, section=st.sampled_from(["vee", "cosine"])),
    generated("digital_filter", seed=SEEDS, spectrum=SPECTRA, skewness=st.floats(-3, 3), kurtosis=POSITIVE),
    generated("from_line_scan", seed=SEEDS, profile=FILES, heights=st.booleans()),
    generated("rank_ordered", seed=SEEDS, spectrum=SPECTRA, heights=HEIGHTS),
    generated(
        "two_process", seed=SEEDS, plateau=SPECTRA, valleys=SPECTRA, offset=st.sampled_from(["-3 nm", "0 m", "1um"])
    ),
    generated("particles", seed=SEEDS, matrix=SPECTRA, density=quantities("um**-2", "m**-2"), radius=LENGTHS),
)
CONSTANTS = {"youngs_modulus": PRESSURES, "poisson_ratio": st.floats(-0.99, 0.49)}
HARDENING = st.one_of(
    st.sampled_from(["linear(2GPa)", "swift(0.2,0.01)", "voce(100MPa,20)"]),
    st.fixed_dictionaries({"kind": st.just("linear"), "modulus": PRESSURES}),
    st.fixed_dictionaries(
        {"kind": st.just("swift"), "exponent": st.floats(0.0, 1.0)}, optional={"reference_strain": POSITIVE}
    ),
    st.fixed_dictionaries({"kind": st.just("voce"), "gain": PRESSURES, "rate": POSITIVE}),
)
FLOW = {"yield_stress": PRESSURES, "hardening": HARDENING, "kinematic": PRESSURES}
STRENGTHS = {"hardness": PRESSURES, **FLOW, "name": TEXTS}
INTERFACES = st.sampled_from(["bonded", "frictionless"])
MATERIALS = st.fixed_dictionaries({"material": TEXTS}, optional=FLOW) | st.fixed_dictionaries(
    CONSTANTS, optional=STRENGTHS
)
LAYERS = st.one_of(
    st.fixed_dictionaries({"material": TEXTS, "thickness": LENGTHS}, optional={"interface": INTERFACES}),
    st.fixed_dictionaries(
        {**CONSTANTS, "thickness": LENGTHS | st.just("0 nm")}, optional={**STRENGTHS, "kind": st.just("layer")}
    ),
    st.fixed_dictionaries(
        {
            "kind": st.sampled_from(["linear", "exponential"]),
            "top": MATERIALS | st.just("steel"),
            "bottom": MATERIALS,
            "thickness": LENGTHS,
        },
        optional={"sublayers": COUNTS, "interface": INTERFACES},
    ),
    st.fixed_dictionaries(
        {
            "kind": st.just("power"),
            "exponent": POSITIVE,
            "top": MATERIALS,
            "bottom": MATERIALS,
            "thickness": LENGTHS,
        },
    ),
)
LINES_OF_TEXT = st.sampled_from(
    [
        "DLC",
        "DLC{Y=5GPa}:5nm/steel{Y=1GPa,hardening=voce(1GPa,9)}",
        "E=1GPa,nu=0.3,name=x",
        "DLC:5nm/Cr:2nm~/steel",
        "E=1GPa,nu=0.3:1um/rigid",
    ]
)
BODIES = st.one_of(
    st.fixed_dictionaries({"material": TEXTS}, optional={"materials_file": TEXTS}),
    st.fixed_dictionaries(CONSTANTS, optional=STRENGTHS),
    st.fixed_dictionaries(
        {
            "layers": st.lists(LAYERS, min_size=1, max_size=4),
            "base": MATERIALS | st.just({"rigid": True}) | st.just("rigid"),
        },
        optional={"materials_file": TEXTS, "name": TEXTS},
    ),
    LINES_OF_TEXT,
)
CONTROLS = st.one_of(
    st.fixed_dictionaries({"mean_pressure": PRESSURES}),
    st.fixed_dictionaries({"force": quantities("N", "mN")}),
    st.fixed_dictionaries({"approach": LENGTHS}),
    st.fixed_dictionaries({"mean_gap": LENGTHS}),
    st.fixed_dictionaries(
        {
            "path": st.one_of(
                st.fixed_dictionaries({key: st.lists(values, min_size=1, max_size=4)}, optional={"steps": COUNTS})
                for key, values in (
                    ("mean_pressure", PRESSURES | st.just("0")),
                    ("force", st.just("0 N")),
                    ("approach", LENGTHS),
                )
            )
        }
    ),
)
LAWS = st.just({"kind": "hard_wall"}) | st.fixed_dictionaries(
    {"kind": st.just("hardness"), "hardness": PRESSURES | st.sampled_from(["from body", "surface", "effective"])}
)
SOLVERS = st.fixed_dictionaries(
    {},
    optional={
        "method": st.sampled_from(["conjugate_gradient", "nnls"]),
        "tolerance": st.floats(1e-15, 0.99),
        "max_iterations": COUNTS,
        "precision": st.sampled_from(["mixed", "double", "single"]),
        "threads": COUNTS,
        "machine": st.sampled_from(["cpu", "gpu"]),
    },
)
PLACES = LENGTHS | st.sampled_from(["max", "pressure", "0 nm"])
SECTIONS = st.one_of(
    st.fixed_dictionaries({"y": PLACES}), st.fixed_dictionaries({"x": PLACES}), st.sampled_from(["y=max", "x = 3 nm"])
)
PROFILES = st.fixed_dictionaries({}, optional={"x": PLACES, "y": PLACES}) | st.just("x=max, y=pressure")
STRESSES = st.fixed_dictionaries(
    {},
    optional={
        "friction": st.floats(0.0, 2.0),
        "direction": quantities("deg", "rad"),
        "coupled": st.booleans(),
        "inside": st.sampled_from(["body", "counter_body"]),
        "depths": st.lists(LENGTHS | st.just("0 nm"), max_size=3),
        "sections": st.lists(SECTIONS, max_size=3) | SECTIONS,
        "profiles": st.lists(PROFILES, max_size=3) | PROFILES,
        "deepest": LENGTHS,
        "criterion": st.sampled_from(["von_mises", "tresca"]),
        "tensile_strength": PRESSURES,
        "interface_shear_strength": PRESSURES,
        "interface_peel_strength": PRESSURES,
        "precision": st.sampled_from(["double", "single"]),
    },
)
DOCUMENTS = st.fixed_dictionaries(
    {"version": st.just(1), "surface": SURFACES, "body": BODIES, "control": CONTROLS},
    optional={
        "title": st.text(st.characters(codec="utf-8"), max_size=20),
        "counter_surface": SURFACES.map(lambda table: {**table, "mirror": "x"}),
        "counter_body": BODIES | st.just({"rigid": True}),
        "boundary": st.sampled_from([{"kind": "periodic"}, {"kind": "free"}])
        | st.fixed_dictionaries({"kind": st.just("line")}, optional={"datum": LENGTHS}),
        "law": LAWS,
        "stress": STRESSES,
        "solver": SOLVERS,
    },
)


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(DOCUMENTS)
def test_round_trip_is_exact(table: dict[str, Any]) -> None:
    document = checked(table)
    assert loads(dumps(document)) == document
    assert loads(dumps(document, form="json"), form="json") == document


def test_one_section_or_profile_stands_for_a_list_of_one() -> None:
    one = checked(with_(stress={"sections": "y=max", "profiles": {"x": "3 nm"}}))
    assert one == checked(with_(stress={"sections": [{"y": "max"}], "profiles": [{"x": "3 nm"}]}))
    assert checked(with_(stress={})).stress is not None
    assert checked(with_()).stress is None


def test_written_document_states_its_kind_first_and_nothing_empty() -> None:
    text = dumps(checked(SMALL))
    assert '[surface]\nkind = "sphere"' in text
    assert "prepare" not in text
    assert "[solver]" not in text


@pytest.mark.parametrize("name", ["case.toml", "case.json"])
def test_file_round_trip(tmp_path: Path, name: str) -> None:
    document = checked(SMALL)
    save_document(document, tmp_path / name)
    assert load_document(tmp_path / name) == document
    assert [path.name for path in tmp_path.iterdir()] == [name]
    with pytest.raises(OutputError):
        save_document(document, tmp_path / name)
    save_document(document, tmp_path / name, overwrite=True)


def test_demo_document_is_valid() -> None:
    assert loads(built_in("coated-disk")).control.mean_pressure == 4e6


def test_documents_do_not_change() -> None:
    document = checked(SMALL)
    with pytest.raises(ValueError, match="frozen"):
        document.title = "other"  # type: ignore[misc]


def test_all_errors_come_at_once() -> None:
    text = message(with_(version=7, control={"force": "1 nm"}, boundry={}, solver={"threads": 0}))
    assert text.splitlines()[0] == "problem document has 4 problems:"
    assert [line.split()[0] for line in text.splitlines()[1:]] == [
        "version",
        "control.force",
        "solver.threads",
        "boundry",
    ]


def test_names_of_the_caller_replace_keys() -> None:
    with refused(InputError, "problem document: --load"):
        checked(with_(control={"force": "1"}), names={"control.force": "--load"})


@pytest.mark.parametrize(
    ("content", "kind", "subject", "shown"),
    [
        ("version = ", FileFormatError, "problem document {path}", "TOML"),
        (b"\xff\xfe\x00", FileFormatError, "problem document", "UTF-8"),
        ("", InputError, "problem document {path}", "4"),
    ],
)
def test_damaged_files(tmp_path: Path, content: str | bytes, kind: type[InputError], subject: str, shown: str) -> None:
    path = tmp_path / "case.toml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with refused(kind, subject.format(path=path), shown):
        load_document(path)


def test_missing_file_and_wrong_json(tmp_path: Path) -> None:
    with refused(FileFormatError, "problem document"):
        load_document(tmp_path / "none.toml")
    (tmp_path / "list.json").write_text("[1]")
    with refused(FileFormatError, f"problem document {tmp_path / 'list.json'}", "list"):
        load_document(tmp_path / "list.json")
    (tmp_path / "broken.json").write_text("{")
    with refused(FileFormatError, f"problem document {tmp_path / 'broken.json'}", "JSON"):
        load_document(tmp_path / "broken.json")


def test_relocated_paths_lead_to_the_same_files(tmp_path: Path) -> None:
    table = with_(
        surface={"kind": "file", "path": "scans/a.txt"},
        counter_surface={"kind": "file", "path": str(tmp_path / "b.txt"), "mirror": "x"},
        body={"material": "X", "materials_file": "own.toml"},
        counter_body={"layers": [COATING], "base": "steel", "materials_file": "own.toml"},
    )
    moved = relocated(checked(table), tmp_path, tmp_path / "out" / "run").model_dump()
    assert moved["surface"]["path"] == "../../scans/a.txt"
    assert moved["counter_surface"]["path"] == str(tmp_path / "b.txt")
    assert moved["body"]["materials_file"] == moved["counter_body"]["materials_file"] == "../../own.toml"


def test_deep_keys_are_named() -> None:
    deep: object = 1
    for _ in range(400):
        deep = {"a": deep}
    with pytest.raises(InputError) as caught:
        checked(with_(control={"force": deep}), names={"control.force": "--load"})
    assert "--load" in str(caught.value)


def test_schema_is_json_and_names_every_table() -> None:
    schema = json.loads(json.dumps(json_schema()))
    assert set(schema["properties"]) == {
        *ProblemDocument.model_fields,
        "friction",
        "shear",
        "adhesion",
        "dynamics",
        "rolling",
        "viscoelastic",
        "hysteresis",
        "film",
        "meniscus_growth",
        "stress",
        "plastic_load",
        "deciding_waves",
        "plastic_flow",
        "indentation",
        "passes",
        "conductance",
        "sealing",
        "heating",
        "wear",
        "sensitivities",
        "uncertainty",
        "flow_factors",
        "prediction",
    }
    assert schema["additionalProperties"] is False
    body = schema["$defs"]["BodyTable"]
    assert {"type": "string"} in body["anyOf"], "a body may be one line of text"


@pytest.mark.parametrize(
    ("text", "table"),
    [
        ("rigid", {"rigid": True}),
        (" Si3N4 ", {"material": "Si3N4"}),
        (
            "E=140 GPa, nu=0.25,H=15GPa,Y=5GPa,name=mine",
            {
                "youngs_modulus": "140 GPa",
                "poisson_ratio": 0.25,
                "hardness": "15GPa",
                "yield_stress": "5GPa",
                "name": "mine",
            },
        ),
        ("E=140000N/mm**2,nu=0.25", {"youngs_modulus": "140000N/mm**2", "poisson_ratio": 0.25}),
        (
            "DLC : 5 nm ~ / E=1GPa,nu=0.3:2nm / rigid",
            {
                "layers": [
                    {"material": "DLC", "thickness": "5 nm", "interface": "frictionless"},
                    {"youngs_modulus": "1GPa", "poisson_ratio": 0.3, "thickness": "2nm"},
                ],
                "base": {"rigid": True},
            },
        ),
    ],
)
def test_body_in_one_line_of_text(text: str, table: dict[str, Any]) -> None:
    assert body_from_text(text) == table
    other = {"counter_body": "steel"} if table == {"rigid": True} else {}
    assert checked(with_(body=text, **other)) == checked(with_(body=table, **other))
