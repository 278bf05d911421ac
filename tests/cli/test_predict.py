"""``predict``: the numbers of Python as a table, as JSON and as a file."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest
from cli.conftest import Runner
from refusals import subject_of

import asperity as asp
from asperity.core.units import show
from asperity.generate import ExponentialAutocorrelation, gaussian

NUMBERS = ("--rms-height", "1nm", "--correlation-length", "0.5um", "--pixel", "50nm", "--size", "10um")
ASKED = ("--body", "E=100GPa,nu=0.3,Y=1GPa", "--pressure", "20MPa")
GRID = asp.Grid((200, 200), (50e-9, 50e-9))
ROUGH = ExponentialAutocorrelation(1e-9, 0.5e-6)
SOLID = asp.Elastic(100e9, 0.3, asp.Strength(yield_stress=1e9))


def test_json_holds_what_python_finds(run: Runner) -> None:
    result = run("predict", *NUMBERS, *ASKED, "--json")
    assert result.exit_code == 0, result.stderr
    found = json.loads(result.stdout)
    expected = asp.predict(ROUGH, SOLID, asp.MeanPressure(20e6), grid=GRID)
    assert set(found["values"]) == {quantity.name for quantity, _ in expected.values()}
    for quantity, value in expected.values():
        row = found["values"][quantity.name]
        assert (row["value"], row["error"], row["scatter"]) == pytest.approx((value.value, value.error, value.scatter))
        assert (row["low"], row["high"]) == pytest.approx(value.band)
    assert found["groups"]["y"] == pytest.approx(expected.groups.y)
    assert found["groups"]["thickness"] is None
    assert "yield_factor" in found["values"]


def test_a_hardness(run: Runner) -> None:
    result = run("predict", *NUMBERS, *ASKED, "--hardness", "2GPa", "--json")
    assert result.exit_code == 0, result.stderr
    found = json.loads(result.stdout)["values"]
    expected = asp.predict(ROUGH, SOLID, asp.MeanPressure(20e6), grid=GRID, hardness=2e9)
    assert found["area_fraction_pixels"]["value"] == pytest.approx(expected.area_fraction_pixels.value)
    assert found["peak_pressure"]["value"] == 2e9
    assert "yield_factor" not in found


def test_the_table_and_the_file(run: Runner, tmp_path: Path) -> None:
    file = tmp_path / "found.csv"
    result = run("predict", *NUMBERS, *ASKED, "--csv", file)
    assert result.exit_code == 0, result.stderr
    with file.open(newline="", encoding="utf-8") as text:
        rows = {row["name"]: row for row in csv.DictReader(text)}
    expected = asp.predict(ROUGH, SOLID, asp.MeanPressure(20e6), grid=GRID)
    assert float(rows["peak_pressure"]["value"]) == pytest.approx(expected.peak_pressure.value)
    assert show(expected.peak_pressure.value, "Pa", 3) in result.stdout
    assert run("predict", *NUMBERS, *ASKED, "--csv", file).exit_code == 2
    assert run("predict", *NUMBERS, *ASKED, "--csv", file, "--force").exit_code == 0


def test_a_file_of_heights(run: Runner, tmp_path: Path) -> None:
    surface = gaussian(GRID, ROUGH, seed=1)
    asp.files.save_surface(surface, tmp_path / "rough.nc")
    result = run("predict", tmp_path / "rough.nc", *ASKED, "--json")
    assert result.exit_code == 0, result.stderr
    expected = asp.predict(asp.levelled(surface, "mean"), SOLID, asp.MeanPressure(20e6))
    assert json.loads(result.stdout)["values"]["area_fraction"]["value"] == pytest.approx(expected.area_fraction.value)


def test_a_layer_and_a_pull(run: Runner) -> None:
    asked = ("--body", "E=200GPa,nu=0.3:0.2um/E=100GPa,nu=0.3", "--load", "2mN")
    result = run("predict", *NUMBERS, *asked, "--pull", "144MPa", "--reach", "1nm", "--json")
    assert result.exit_code == 0, result.stderr
    found = json.loads(result.stdout)
    assert found["groups"]["ratio"] == pytest.approx(2.0)
    assert found["groups"]["thickness"] == pytest.approx(0.4)
    assert found["values"]["pull_pressure"]["value"] > 0.0


def test_what_is_missing_or_too_much(run: Runner, tmp_path: Path) -> None:
    assert subject_of(run("predict", *NUMBERS, "--pressure", "1MPa")) == "--body"
    assert subject_of(run("predict", *NUMBERS, "--body", "steel")) == "load"
    assert subject_of(run("predict", *ASKED)).startswith("FILE")
    assert subject_of(run("predict", tmp_path / "rough.nc", *NUMBERS, *ASKED)).startswith("--rms-height")
    assert subject_of(run("predict", *NUMBERS, *ASKED, "--reach", "1nm")).startswith("--pull")
    assert subject_of(run("predict", *NUMBERS, "--body", "steel", "--pressure", "1kPa")) != ""
