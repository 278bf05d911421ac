"""``asperity info`` and ``asperity contact`` on files with line scans."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from refusals import subject_of
from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import app

UNITS = ("--lateral-unit", "um", "--height-unit", "nm")


@pytest.fixture
def trace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    x = 0.5 * np.arange(1200)
    np.savetxt("trace.txt", np.c_[x, 20.0 * np.sin(2.0 * np.pi * x / 20.0)])
    return "trace.txt"


def test_info_measures_a_line_scan(trace: str) -> None:
    result = CliRunner().invoke(app, ["info", trace, *UNITS, "--json", "--lambda-c", "0.08mm"])
    assert result.exit_code == 0, result.output
    found = json.loads(result.stdout)
    assert found["points"] == 1200
    assert found["lambda_c"] == pytest.approx(8e-5)
    assert found["sections"] == 5
    assert found["ISO 21920-2"]["RSm"] == pytest.approx(20e-6, rel=1e-6)
    assert found["ISO 4287"]["Ra"] == pytest.approx(found["ISO 21920-2"]["Ra"], rel=1e-12)
    assert "isotropic" in (found["assumption"] or "isotropic")


def test_info_prints_a_line_scan(trace: str) -> None:
    result = CliRunner().invoke(app, ["info", trace, *UNITS, "--full"])
    assert result.exit_code == 0, result.output
    assert "RSm" in result.output
    assert "ISO 4287" in result.output


def test_info_asks_for_both_units_and_refuses_cut_offs_of_maps(trace: str) -> None:
    assert CliRunner().invoke(app, ["info", trace, "--height-unit", "nm"]).exit_code == 2
    as_map = ["info", trace, "--size", "2um x 600um", "--height-unit", "nm", "--axes", "none"]
    assert CliRunner().invoke(app, as_map).exit_code == 0
    assert CliRunner().invoke(app, [*as_map, "--lambda-c", "1mm"]).exit_code == 2


def test_a_line_scan_is_pressed_as_grooves(trace: str) -> None:
    load = ("--body", "steel", "--boundary", "line", "--pressure", "1MPa")
    result = CliRunner().invoke(app, ["contact", trace, *UNITS, *load])
    assert result.exit_code == 0, result.output


def test_a_theory_of_a_line_scan_says_what_it_assumes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    rough = np.cumsum(np.random.default_rng(1).standard_normal(2000))
    np.savetxt("rough.txt", np.c_[0.5 * np.arange(2000), rough])
    asked = ["theory", "persson", "--surface", "rough.txt", *UNITS, "--E-star", "100GPa", "--pressure", "1MPa"]
    result = CliRunner().invoke(app, asked)
    assert result.exit_code == 0, result.output
    assert "isotropic" in result.stderr


def test_a_saved_line_scan_is_read_back_at_every_door(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    heights = 2e-8 * np.sin(2.0 * np.pi * np.arange(240) / 40.0)
    asp.save(asp.Profile(heights, 5e-7, periodic=True), "trace.nc")
    shown = CliRunner().invoke(app, ["info", "trace.nc", "--json"])
    assert shown.exit_code == 0, shown.output
    assert json.loads(shown.stdout)["length"] == pytest.approx(1.2e-4, rel=1e-12)
    load = ("--body", "steel", "--boundary", "line", "--pressure", "1MPa", "--out", "run")
    result = CliRunner().invoke(app, ["contact", "trace.nc", *load])
    assert result.exit_code == 0, result.output
    for name in ("again.nc", "again.txt"):
        written = CliRunner().invoke(app, ["export", "run/result.nc", "--surface", name])
        assert written.exit_code == 0, written.output
        again = asp.read(name)
        assert isinstance(again, asp.Profile)
        np.testing.assert_allclose(again.heights - again.heights.mean(), heights - heights.mean(), atol=1e-17)
    assert CliRunner().invoke(app, ["export", "run/result.nc", "--surface", "again.gsf"]).exit_code == 2


def test_theories_are_not_compared_on_one_line(trace: str) -> None:
    result = CliRunner().invoke(app, ["compare", trace, *UNITS, "--body", "steel", "--pressures", "1MPa"])
    assert subject_of(result) == "surface of a comparison"
