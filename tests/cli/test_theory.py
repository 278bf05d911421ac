"""The command ``theory``: the list, every theory by its options, surfaces, tables and files, and
refusals."""

from __future__ import annotations

import csv
import inspect
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cli.conftest import Runner
from refusals import subject_of

import asperity as asp
from asperity.cli.theory import Theories, read_range
from asperity.core.citations import reference
from asperity.core.parameters import Parameter, parameters
from asperity.core.values import Number
from asperity.theories import THEORIES, HertzPoint, theory

PRESSURES = Parameter("pressures", float, Number("pressure"))

HERTZ = ("theory", "hertz", "--E-star", "115GPa", "--radius", "5mm")
SUMMITS = ("--E-star", "100GPa", "--density", "1um**-2", "--radius", "1um", "--height-deviation", "10nm")


@pytest.fixture(scope="module")
def rough(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, asp.Surface]:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(5e-9), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=1.6e-7
    )
    surface = asp.generate.gaussian(asp.Grid((64, 64), (4e-8, 4e-8)), spectrum, seed=1)
    path = tmp_path_factory.mktemp("rough") / "rough.nc"
    asp.files.save_surface(surface, path)
    return path, surface


def test_the_list_is_one_line_for_each_theory_and_its_page_has_the_sources(run: Runner) -> None:
    text = run("theory", "--list").stdout
    assert len(text.splitlines()) < len(THEORIES) + 8
    assert all(f" {name} " in text and kind.title in text for name, kind in THEORIES.items())
    page = Theories().get_command(None, "hertz").help
    assert all(reference(key) in page for key in theory("hertz").citation_keys)
    assert "Asked along load in N or" in page


def test_the_list_as_json(run: Runner) -> None:
    records = json.loads(run("theory", "--list", "--json").stdout)
    assert [record["name"] for record in records] == list(THEORIES)
    (hertz,) = (record for record in records if record["name"] == "hertz")
    assert hertz["inputs"][1] == {
        "name": "radius",
        "unit": "m",
        "meaning": "relative radius of curvature R, 1/R = 1/R1 + 1/R2",
        "of": "surface",
        "required": True,
        "choices": [],
        "many": False,
    }
    assert hertz["ways"][0] == {"along": "load", "unit": "N", "given": []}
    assert not hertz["from_surface"]


@pytest.mark.parametrize("name", THEORIES)
def test_every_theory_has_an_option_for_each_input(name: str) -> None:
    made: Any = Theories().get_command(None, name)
    options = {option: parameter.help for parameter in made.params for option in parameter.opts}
    for item in parameters(theory(name)):
        assert options["--" + item.name.replace("_", "-")].startswith(item.help[0].upper() + item.help[1:].rstrip("."))
    assert theory(name).title in made.help


def test_the_help_of_one_theory(run: Runner) -> None:
    text = run("theory", "greenwood-williamson", "--help").stdout
    assert [option for option in ("--density", "--surface", "--bins") if option not in text] == []
    assert "--bins" not in run("theory", "mccool", "--help").stdout


def test_a_number_a_list_and_a_range(run: Runner) -> None:
    record = json.loads(run(*HERTZ, "--load", "1N..100N", "--points", "3", "--json").stdout)
    answer = HertzPoint(115e9, 5e-3).at_load([1.0, 10.0, 100.0])
    assert record["inputs"]["radius"] == {"value": 5e-3, "unit": "m"}
    assert record["columns"]["load"]["values"] == pytest.approx([1.0, 10.0, 100.0])
    assert record["columns"]["approach"]["values"] == pytest.approx(answer.approach.tolist())
    assert record["columns"]["max_pressure"]["unit"] == "Pa"
    assert record["limits"][0]["holds"] == [True] * 3
    assert record["sources"][0].startswith("Hertz, H.")
    text = run(*HERTZ, "--load", "1N,2N").stdout
    assert "2 N" in text
    assert "[Sneddon1965]" in text


def test_a_straight_body_has_an_infinite_radius(run: Runner) -> None:
    """A drum on a plane, whose radii are infinite; the answer holds both semi-axes."""
    drum = ("--radius-1x", "10mm", "--radius-1y", "20mm", "--radius-2x", "inf", "--radius-2y", "inf")
    found = json.loads(run("theory", "hertz-bodies", "--E-star", "100GPa", *drum, "--load", "1N", "--json").stdout)
    ellipse = asp.theories.HertzEllipse(100e9, 0.02, 0.01).at_load(1.0)
    columns = {name: column["values"][0] for name, column in found["columns"].items()}
    assert (columns["semi_x"], columns["semi_y"]) == pytest.approx(
        (float(ellipse.semi_x), float(ellipse.semi_y)), rel=1e-12
    )


def test_rows_beyond_a_limit_are_marked(run: Runner) -> None:
    text = run("theory", "greenwood-williamson", *SUMMITS, "--pressure", "10MPa,10GPa").stdout
    (light,) = (line for line in text.splitlines() if " 10 MPa " in line)
    (heavy,) = (line for line in text.splitlines() if " 10 GPa " in line)
    assert not light.strip().startswith("!")
    assert heavy.strip().startswith("!")


def test_words_choose_and_nothing_infinite_is_in_json(run: Runner) -> None:
    made = run(
        "theory", "greenwood-williamson", *SUMMITS, "--heights", "exponential", "--separation", "0nm..30nm", "--json"
    )
    record = json.loads(made.stdout)
    assert record["inputs"]["heights"]["value"] == "exponential"
    # exponential heights have one real pressure
    real = record["columns"]["mean_real_pressure"]["values"]
    assert real == pytest.approx([real[0]] * 11, rel=1e-9)
    punch = json.loads(
        run("theory", "flat-punch", "--e-star", "1GPa", "--radius", "1mm", "--load", "1N", "--json").stdout
    )
    assert punch["columns"]["max_pressure"]["values"] == [None]


def test_csv(run: Runner, tmp_path: Path) -> None:
    path = tmp_path / "curve.csv"
    assert run(*HERTZ, "--load", "1N,1kN", "--csv", path).exit_code == 0
    rows = list(csv.reader(path.read_text(encoding="utf-8").splitlines()))
    assert rows[0][:2] == ["load (N)", "approach (m)"]
    assert rows[0][-1] == "valid"
    assert float(rows[2][1]) == HertzPoint(115e9, 5e-3).at_load(1000.0).approach
    again = run(*HERTZ, "--load", "1N", "--csv", path)
    assert again.exit_code == 2
    assert "--force" in again.stderr
    assert run(*HERTZ, "--load", "1N", "--csv", path, "--force").exit_code == 0
    numbers = tmp_path / "numbers.csv"
    run("theory", "sampled-peaks", "--rho-1", "0.8", "--rho-2", "0.6", "--csv", numbers)
    assert numbers.read_text(encoding="utf-8").startswith("name,value,unit,meaning\nfraction,")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("plasticity-index", *SUMMITS[:2], *SUMMITS[4:], "--hardness", "8GPa"), "elastic"),
        (("least-area", "--hardness", "6GPa", "--pressure", "1MPa"), "0.0008889"),
        (("least-area", "--hardness", "6GPa", "--E-star", "100GPa"), "summit"),
        (("nayak", "--m0", "100nm**2", "--m2", "0.01", "--m4", "4um**-2"), "summits"),
        (
            (
                *("effective-hardness", "--coating", "15GPa", "--substrate", "9GPa"),
                "--modulus-ratio",
                "0.7",
                "--depth-ratio",
                "0..1",
            ),
            "share",
        ),
        (("first-yield", "--friction", "0"), "1.613"),
        (("boussinesq", "--load", "1N", "--shear", "80GPa", "--depth", "1um"), "mises"),
        (
            (
                "mindlin",
                *SUMMITS[:2],
                "--radius",
                "1mm",
                "--G-star",
                "80GPa",
                "--friction",
                "0.3",
                "--load",
                "1N",
                "--tangential",
                "0.1N",
            ),
            "stick",
        ),
        (
            ("power-law-indenter", *SUMMITS[:2], "--coefficient", "500 1/m", "--exponent", "2", "--load", "1N"),
            "approach",
        ),
        (("power-law-indenter", *SUMMITS[:2], "--coefficient", "0.1", "--exponent", "1", "--load", "1N"), "approach"),
        (
            (
                "kinetic-meniscus",
                *SUMMITS,
                "--surface-tension",
                "25mN/m",
                "--film-thickness",
                "1nm",
                "--viscosity",
                "0.1Pa*s",
                "--hamaker-constant",
                "5e-20J",
                "--pressure",
                "1MPa",
                "--time",
                "0s..1ms",
            ),
            "meniscus",
        ),
        (("persson", *SUMMITS[:2], "--rms-gradient", "0.1", "--local", "1GPa", "--pressure", "10MPa"), "above"),
    ],
)
def test_what_has_no_load_is_asked_in_its_own_way(run: Runner, arguments: tuple[str, ...], words: str) -> None:
    result = run("theory", *arguments)
    assert result.exit_code == 0, result.output
    assert words in result.stdout
    assert "source:" in result.stdout


def test_a_surface_and_bodies_by_name(run: Runner, rough: tuple[Path, asp.Surface]) -> None:
    path, surface = rough
    ask = ("--surface", path, "--body", "E=91GPa,nu=0.3,H=8GPa", "--pressure", "10MPa", "--json")
    modulus = asp.solids.contact_modulus(asp.Elastic(91e9, 0.3), asp.Rigid())
    roughness = asp.roughness_of(asp.levelled(surface, "mean"))
    record = json.loads(run("theory", "bush-gibson-thomas", *ask).stdout)
    expected = theory("bush-gibson-thomas").from_roughness(roughness, modulus).at_pressure(1e7)
    assert record["columns"]["area_fraction"]["values"] == pytest.approx(expected.area_fraction.tolist())
    record = json.loads(run("theory", "chang-etsion-bogy", *ask).stdout)
    assert record["inputs"]["hardness"]["value"] == 8e9
    record = json.loads(run("theory", "greenwood-williamson", *ask, "--bins", "8").stdout)
    assert record["inputs"]["heights"]["value"] == "histogram"
    record = json.loads(run("theory", "nayak", "--surface", path, "--json").stdout)
    assert record["numbers"]["alpha"]["value"] == pytest.approx(roughness.alpha)


@pytest.mark.parametrize(
    ("arguments", "subject"),
    [
        ((), "NAME of a theory or --list"),
        (("gw",), "name of a theory"),
        (("herz",), "name of a theory"),
        (("hertz", "--radius", "5mm", "--load", "1N"), "hertz"),
        ((*HERTZ[1:4], "--radius", "5", "--load", "1N"), "--radius"),
        ((*HERTZ[1:4], "--radius", "5s", "--load", "1N"), "--radius"),
        ((*HERTZ[1:4], "--radius", "5 furlongz", "--load", "1N"), ""),
        ((*HERTZ[1:4], "--radius", "-5mm", "--load", "1N"), "--radius"),
        ((*HERTZ[1:], "--load", "-1N"), "load (N)"),
        ((*HERTZ[1:], "--load", "1N..2N..3N"), "--load"),
        ((*HERTZ[1:], "--load", "1N..2N", "--points", "1"), "--points"),
        (HERTZ[1:], "hertz"),
        ((*HERTZ[1:], "--load", "1N", "--approach", "1nm"), "hertz"),
        (("nayak", "--m0", "1nm**2", "--m2", "1", "--m4", "1um**-2"), "moments of an isotropic surface"),
        (("greenwood-williamson", *SUMMITS, "--heights", "odd", "--pressure", "1MPa"), "--heights"),
        (("greenwood-williamson", *SUMMITS, "--size", "1um", "--pressure", "1MPa"), "options for reading"),
        (("hertz", "--counter", "steel", "--radius", "1um", "--load", "1N"), "--counter"),
        (("hertz", "--body", "phlogiston", "--radius", "1um", "--load", "1N"), "material"),
        (("mccool", "--surface", "SCAN", "--pressure", "1MPa"), "mccool of a surface"),
        (("mccool", "--surface", "SCAN", "--body", "DLC", "--m0", "1nm**2"), "--m0"),
        (("jackson-green", "--surface", "SCAN", "--body", "E=1GPa,nu=0.3", "--pressure", "1MPa"), "--yield-stress"),
    ],
)
def test_refusals(run: Runner, rough: tuple[Path, asp.Surface], arguments: tuple[str, ...], subject: str) -> None:
    result = run("theory", *(rough[0] if word == "SCAN" else word for word in arguments))
    assert subject_of(result) == subject
    assert not result.stdout


def test_ranges() -> None:
    assert read_range(PRESSURES, "1GPa..100GPa", points=3, linear=False) == pytest.approx([1e9, 1e10, 1e11])
    assert read_range(PRESSURES, "1GPa..3GPa", points=3, linear=True) == pytest.approx([1e9, 2e9, 3e9])
    assert read_range(PRESSURES, "-1GPa..1GPa", points=3, linear=False) == pytest.approx([-1e9, 0.0, 1e9])
    assert read_range(PRESSURES, "-100GPa..-1GPa", points=3, linear=False) == pytest.approx([-1e11, -1e10, -1e9])
    assert np.all(read_range(PRESSURES, "1GPa, 2GPa", points=3, linear=False) == [1e9, 2e9])


def test_a_curve_is_drawn(run: Runner, tmp_path: Path) -> None:
    hertz = ("theory", "hertz", "--E-star", "115GPa", "--radius", "5mm")
    assert run(*hertz, "--load", "1N..100N", "--plot", tmp_path / "a.png").exit_code == 0
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    assert subject_of(run(*hertz, "--load", "1N", "--plot", tmp_path / "b.png")) == "plot of an answer"


@pytest.mark.parametrize(
    "name",
    ["greenwood-williamson-fits", "persson", "tresca-disc", "tresca-twist", "carter", "maugis-dugdale", "boussinesq"],
)
def test_square_brackets_of_formulas_stand_in_the_help(run: Runner, name: str) -> None:
    """A terminal that knows marks took them for marks."""
    text = re.split(r"\n\n[A-Z]\w+\n---", inspect.cleandoc(THEORIES[name].__doc__ or ""))[0]
    formulas = re.findall(r"\[[^\]]+\]", text)
    page = "".join(run("theory", name, "--help").stdout.split())
    assert formulas
    assert [formula for formula in formulas if "".join(formula.split()) not in page] == []


def test_spots_of_a_fractal_surface_by_size(run: Runner) -> None:
    """The cumulative distribution, and the shares of elastic spots beside area and pressure."""
    made = ("--dimension", "1.4", "--roughness", "0.01nm", "--E-star", "100GPa", "--hardness", "8GPa")
    model = theory("majumdar-bhushan")(1.4, 1e-11, 1e11, 8e9, 1e-6)
    fractal = ("theory", "majumdar-bhushan", *made, "--nominal-area", "1mm**2", "--json")
    spots = json.loads(run(*fractal, "--spot", "1e-16m**2..1e-10m**2", "--points", "4", "--pressure", "1MPa").stdout)
    found = {name: column["values"] for name, column in spots["columns"].items()}
    expected = model.at_spot(np.geomspace(1e-16, 1e-10, 4), 1e6)
    assert found["number"] == pytest.approx(expected.number)
    assert found["share_below"] == pytest.approx(expected.share_below)
    assert found["elastic"] == expected.elastic.tolist()
    along = json.loads(run(*fractal, "--pressure", "1MPa").stdout)
    assert along["columns"]["elastic_load_share"]["values"] == pytest.approx(model.at_pressure(1e6).elastic_load_share)


def test_heights_of_weibull_and_further_names(run: Runner) -> None:
    text = run("theory", "greenwood-williamson", *SUMMITS, "--heights", "weibull:2", "--pressure", "1MPa").stdout
    assert "weibull:2" in text
    assert subject_of(run("theory", "greenwood-williamson", *SUMMITS, "--heights", "weibull:x", "--pressure", "1MPa"))
    moments = ("--E-star", "100GPa", "--m0", "1e-16m**2", "--m2", "0.01", "--m4", "2e12m**-2", "--pressure", "1MPa")
    assert run("theory", "francis", *moments).stdout == run("theory", "bush-gibson-thomas", *moments).stdout
