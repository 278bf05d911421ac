"""Leakage and flow factors on the command line and in documents: units at the door, files, studies,
the form, and what is said where the gap is closed or not resolved."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cli.conftest import Runner
from refusals import refused
from sealing_cases import seal
from study_cases import InProcess, plan

import asperity as asp
from asperity.core.errors import InputError
from asperity.physics.sealing.part_flow_factors import TABLE
from asperity.run.build import build
from asperity.run.document import checked, dumps, loads
from asperity.run.stored import load_outcome
from asperity.studies.collect import dataset
from asperity.studies.run import carry_out
from asperity.theories import GroovedGap

SEAL = seal(32)
FREE = {"boundary": {"kind": "free"}, "control": {"force": "1 mN"}}
WAVE = SEAL | {
    "surface": {
        "kind": "sinusoid",
        "points": [48, 4],
        "size": "1 um x 1 um",
        "amplitude": "10 nm",
        "wavelength": "1 um",
    }
}
OPTIONS = ("--level", "none", "--body", "E=100GPa,nu=0.3", "--counter-body", "rigid")


@pytest.fixture
def surface(tmp_path: Path) -> Path:
    path = tmp_path / "seal.nc"
    asp.files.save_surface(build(checked(SEAL)).problem.surface, path)
    return path


def said(done: Any) -> str:
    assert done.exit_code == 0, done.output
    return " ".join(done.output.split())


# Leakage.


def test_a_liquid_leaks_in_cubic_millimetres(run: Runner, surface: Path, tmp_path: Path) -> None:
    """Options give the numbers of Python; the rate stands on the terminal, in file and report."""
    out = tmp_path / "out"
    leak = ("--leak-fluid", "water", "--inlet-pressure", "3bar", "--outlet-pressure", "1bar")
    told = said(run("contact", surface, *OPTIONS, "--pressure", "300MPa", *leak, "--leak-direction", "y", "--out", out))
    assert "mm³/s" in told
    outcome = load_outcome(out / "result.nc")
    case = build(checked(SEAL))
    found = asp.sealing.leakage(
        asp.solve(case.problem, asp.MeanPressure(3e8)), asp.sealing.ViscousLiquid(1.002e-3), 3e5, 1e5, way="y"
    )
    assert outcome.values["leak_rate"] == pytest.approx(found.rate, rel=1e-6)
    with (out / "scalars.csv").open(encoding="utf-8") as file:
        rows = {row["name"]: row for row in csv.DictReader(file)}
    assert rows["leak_rate"]["unit"] == "m**3/s"
    assert float(rows["leak_rate"]["value"]) == outcome.values["leak_rate"]
    assert "mm³/s" in (out / "report.html").read_text(encoding="utf-8")
    assert {"leak_flow", "fluid_pressure"} <= {path.stem for path in (out / "plots").iterdir()}


def test_a_gas_leaks_in_pascal_cubic_metres_and_millibar_litres(run: Runner, surface: Path) -> None:
    """A leak rate that is allowed is given in any of the units: 0.1 Pa m³/s are 1 mbar l/s."""
    gas = ("--leak-fluid", "helium", "--inlet-pressure", "1bar", "--outlet-pressure", "0bar")
    told = said(run("contact", surface, *OPTIONS, "--pressure", "300MPa", *gas, "--allowed-throughput", "1e-6mbar*l/s"))
    assert "Pa·m³/s" in told
    assert "mbar·l/s" in told
    texts = ("1e-6 mbar*l/s", "1e-7 Pa*m^3/s", "1e-7 W")
    given = [checked(SEAL | {"sealing": {"fluid": "air", "allowed_throughput": text}}) for text in texts[:2]]
    assert [float(document.sealing.allowed_throughput) for document in given] == pytest.approx([1e-7, 1e-7])
    volume = checked(SEAL | {"sealing": {"allowed_rate": "2 mm^3/s"}})
    assert float(volume.sealing.allowed_rate) == pytest.approx(2e-9)


def test_a_sealed_contact_leaks_nothing_and_shows_the_path(run: Runner, surface: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    told = said(run("contact", surface, *OPTIONS, "--pressure", "20GPa", "--leak-fluid", "water", "--out", out))
    outcome = load_outcome(out / "result.nc")
    assert outcome.values["leak_rate"] == outcome.values["equivalent_gap"] == 0.0
    assert "0 mm³/s" in told
    assert "closed_path" in {path.stem for path in (out / "plots").iterdir()}
    page = (out / "report.html").read_text(encoding="utf-8")
    (words,) = (words for part, words in outcome.sections if part.name == "sealing")
    assert words.sentence in page
    cells = [np.asarray(outcome.found["sealing"].values[f"closed_path_{a}"]) for a in "xy"]
    step = outcome.result.problem.grid.spacing[0]
    assert outcome.result.contact[(cells[0] / step).astype(int), (cells[1] / step).astype(int)].all()


def test_a_throat_of_a_pixel_is_a_number_with_its_bracket(tmp_path: Path) -> None:
    """The number stays, the verdict doubts it, and the finding says how much finer."""
    outcome = asp.run(SEAL | {"control": {"mean_pressure": "3 GPa"}, "sealing": {}})
    values = outcome.values
    assert values["leak_rate"] > 0.0
    assert values["leak_throat_pixels"] < 2.0
    assert values["leak_lower_factor"] < 1.0 < values["leak_upper_factor"]
    (narrow,) = (item for item in outcome.findings if item.criterion == "pixels across the throats")
    assert "leak_rate" in narrow.concerns
    assert narrow.numbers["refinement"] == values["leak_refinement"] > 2.0
    (words,) = (words for part, words in outcome.sections if part.name == "sealing")
    assert narrow.level == "warning"
    assert outcome.verdict.trust != "good"
    assert words.sentence


def test_closing_load_is_found_and_bounds_what_is_sealed() -> None:
    """The gap is closed just above, and open just below."""
    outcome = asp.run(SEAL | {"sealing": {"closing": True}})
    closing = outcome.values["sealing_pressure"]
    problem, water = outcome.result.problem, asp.sealing.ViscousLiquid(1e-3)
    leaks = [
        asp.sealing.leakage(asp.solve(problem, asp.MeanPressure(f * closing)), water, 2e5).rate for f in (0.99, 1.01)
    ]
    assert leaks[0] > leaks[1] == 0.0
    sealed = asp.run(SEAL | {"control": {"mean_pressure": "20 GPa"}, "sealing": {"closing": True}})
    # both intervals are 1 % wide
    assert sealed.values["sealing_pressure"] == pytest.approx(closing, rel=0.02)
    with refused(InputError, "sealing.closing", "free"):
        build(
            checked(SEAL | {"boundary": {"kind": "free"}, "control": {"force": "1 mN"}, "sealing": {"closing": True}})
        )


def test_a_study_over_load_thickness_and_roughness(tmp_path: Path) -> None:
    """Columns of rate and closing load; cases are those of single runs, and a run that was stopped
    goes on."""
    problem = SEAL | {
        "body": "E=5GPa,nu=0.4:100nm/E=100GPa,nu=0.3",
        "sealing": {"closing": True},
        "surface": SEAL["surface"] | {"points": [24, 24]},
    }
    axes = [
        {"path": "control.mean_pressure", "values": ["100 MPa", "200 MPa"]},
        {"path": "body.layers.0.thickness", "values": ["100 nm", "500 nm"]},
        {"path": "surface.spectrum.rms_height", "values": ["50 nm", "100 nm"]},
    ]
    names = ["leak_rate", "transmissivity", "sealing_pressure"]
    made = plan(problem=problem, axes=axes, quantities=names)
    carry_out(made, tmp_path / "r.log", InProcess())
    data = dataset(made, tmp_path / "r.log")
    rate = np.asarray(data["leak_rate"])
    assert rate.shape == (2, 2, 2)
    assert (np.diff(rate, axis=0) < 0.0).all(), "a larger load leaks less"
    assert (np.diff(rate, axis=2) > 0.0).all(), "a rougher surface leaks more"
    closing = np.asarray(data["sealing_pressure"])
    assert np.isfinite(closing).all()
    # the closing load does not depend on the load, to the 1 % of its interval
    np.testing.assert_allclose(closing[0], closing[1], rtol=0.02)
    assert (np.diff(closing, axis=1) < 0.0).all(), "a thicker soft layer seals earlier"
    alone = asp.run(problem | {"control": {"mean_pressure": "200 MPa"}}).values
    assert rate[1, 0, 1] == pytest.approx(alone["leak_rate"], rel=1e-6)
    before = (tmp_path / "r.log").read_bytes()
    carry_out(made, tmp_path / "r.log", InProcess())
    assert (tmp_path / "r.log").read_bytes() == before, "nothing is computed twice"


# Flow factors.


def test_flow_factors_of_grooves_that_are_cut() -> None:
    """The closed form along and across, with the wave along x."""
    document = WAVE | {"flow_factors": {"least": 1.0, "largest": 4.0, "points": 4, "overlap": "cut"}}
    assert loads(dumps(checked(document))) == checked(document)
    outcome = asp.run(document)
    values = outcome.found["flow_factors"].values
    sigma = values["flow_roughness"]
    assert sigma == pytest.approx(1e-8 / math.sqrt(2.0), rel=1e-3)
    exact = GroovedGap(1e-8).at_mean_gap(sigma * values["factors_separation_ratio"])
    # of second order in the pixel where nothing touches, of first at the rim
    np.testing.assert_allclose(values["factors_pressure_along"], exact.pressure_across, atol=0.02)
    np.testing.assert_allclose(values["factors_pressure_across"], exact.pressure_along, rtol=0.02)
    np.testing.assert_allclose(values["factors_shear"], exact.shear, rtol=0.02)
    turned = (
        asp.run(WAVE | {"flow_factors": {"points": 1, "least": 4.0, "direction": "y"}}).found["flow_factors"].values
    )
    assert turned["factors_pressure_along"][0] == pytest.approx(values["factors_pressure_across"][-1])
    assert turned["factors_shear"][0] == pytest.approx(0.0, abs=1e-9)


def test_flow_factors_at_every_door(run: Runner, surface: Path, tmp_path: Path) -> None:
    """Table, figure, report and CSV by options; realisations give standard errors."""
    out = tmp_path / "out"
    options = ("--least-separation", "2", "--largest-separation", "5", "--separations", "3", "--flow-realisations", "3")
    told = said(run("contact", surface, *OPTIONS, "--pressure", "300MPa", *options, "--out", out))
    outcome = load_outcome(out / "result.nc")
    values = outcome.found["flow_factors"].values
    (words,) = (words for part, words in outcome.sections if part.name == "flow_factors")
    assert words.sentence in told
    with (out / "flow_factors.csv").open(encoding="utf-8") as file:
        heads, *rows = csv.reader(file)
    assert heads == [f"{item.name} ({item.unit})" for item in TABLE]
    table = np.array(rows, float).T
    for item, column in zip(TABLE, table, strict=True):
        np.testing.assert_allclose(column, values[item.name], rtol=1e-9)
    assert table[0].tolist() == [2.0, 3.5, 5.0]
    assert (np.diff(values["factors_pressure_along"]) > 0.0).all()
    assert (np.diff(values["factors_shear"]) < 0.0).all()
    assert np.isfinite(values["factors_pressure_along_error"]).all()
    assert (out / "plots" / "flow_factors.png").exists()
    assert words.sentence in (out / "report.html").read_text(encoding="utf-8")
    alone = asp.run(SEAL | {"flow_factors": {"points": 1}}).found["flow_factors"].values
    assert np.isnan(alone["factors_shear_error"]).all()
    assert alone["pressure_factor_along"] == pytest.approx(values["pressure_factor_along"], rel=1e-6)


def test_a_study_of_flow_factors_over_the_load(tmp_path: Path) -> None:
    names = ["pressure_factor_along", "shear_factor", "flow_separation_ratio"]
    axis = {"path": "control.mean_pressure", "values": ["100 MPa", "500 MPa"]}
    made = plan(problem=SEAL | {"flow_factors": {}}, axes=[axis], quantities=names)
    carry_out(made, tmp_path / "r.log", InProcess())
    data = dataset(made, tmp_path / "r.log")
    for name in (names[0], names[2]):
        assert float(data[name][1]) < float(data[name][0])
    assert float(data["shear_factor"][1]) > 0.0


@pytest.mark.parametrize(
    ("tables", "subject", "shown"),
    [
        ({"flow_factors": {"least": 4.0, "largest": 2.0}}, "problem document: flow_factors.largest", "2"),
        ({"flow_factors": {"least": 0.0}}, "problem document: flow_factors.least", "0"),
        ({"flow_factors": {"points": 0}}, "problem document: flow_factors.points", "0"),
        ({"flow_factors": {"overlap": "melted"}}, "problem document: flow_factors.overlap", "melted"),
    ],
)
def test_wrong_tables(tables: dict[str, Any], subject: str, shown: str) -> None:
    with refused(InputError, subject, shown):
        checked(SEAL | tables)


def test_what_has_no_flow_factors() -> None:
    with refused(InputError, "boundary of flow factors", "free"):
        build(checked(SEAL | FREE | {"flow_factors": {}}))
    flat = {"surface": {"kind": "flat", "points": [8, 8], "size": "1 um"}}
    with refused(InputError, "surface of flow factors"):
        build(checked(SEAL | flat | {"flow_factors": {}}))


# The form.


def test_the_form_shows_both_tables() -> None:
    pytest.importorskip("nicegui", reason="the extra web is not installed")
    from asperity.run.document import document_model
    from asperity.web.forms import asked_of

    names = {item.name for item in asked_of(document_model())}
    assert {"sealing", "flow_factors"} <= names
