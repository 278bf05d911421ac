"""The commands ``info`` and ``materials``."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from cli.conftest import SCALE, Runner
from refusals import subject_of


def test_info_says_what_is_in_the_file(run: Runner, matrix: Path) -> None:
    result = run("info", matrix, *SCALE)
    assert result.exit_code == 0, result.stderr
    for text in ("rough.txt", "32 × 24", "8 µm × 6 µm", "250 nm × 250 nm"):
        assert text in result.stdout


def test_info_as_json_is_si(run: Runner, tmp_path: Path) -> None:
    x, y = np.arange(20), np.arange(10)
    heights = np.where((x[None, :] + y[:, None]) % 2, 1.0, -1.0) + 3.0 * x + 2.0 * y[:, None]
    heights[4, 7] = np.nan
    np.savetxt(tmp_path / "map.txt", heights)
    result = run("info", tmp_path / "map.txt", "--size", "20um x 10um", "--height-unit", "nm", "--json")
    found = json.loads(result.stdout)
    assert found["shape"] == [20, 10]
    assert found["size"] == pytest.approx([20e-6, 10e-6])
    assert found["missing"] == 1
    assert found["levelled"] == "plane"
    assert found["Sq"] == pytest.approx(1e-9, rel=0.02)
    assert found["Sz"] == pytest.approx(2e-9, rel=0.05)
    assert found["rms_slope"] == pytest.approx(2e-9 * np.sqrt(2.0) / 1e-6, rel=0.02)


def test_info_keeps_a_periodic_surface_periodic(run: Runner, tmp_path: Path) -> None:
    made = ("generate", "rough", "--points", "64", "--size", "2um", "--seed", "1", "--spectrum", "exponential")
    assert run(*made, "--rms", "1nm", "--correlation-length", "200nm", "--out", tmp_path / "rough.nc").exit_code == 0
    found = json.loads(run("info", tmp_path / "rough.nc", "--full", "--json").stdout)
    assert found["levelled"] == "mean"
    tilted = json.loads(run("info", tmp_path / "rough.nc", "--level", "plane", "--json").stdout)
    assert tilted["levelled"] == "plane"
    assert tilted["Sq"] < found["Sq"]


def test_info_levels_by_a_polynomial(run: Runner, matrix: Path) -> None:
    assert json.loads(run("info", matrix, *SCALE, "--level", "4", "--json").stdout)["levelled"] == "4"
    again, named = (run("info", matrix, *SCALE, "--level", form, "--json").stdout for form in ("2", "quadratic"))
    assert json.loads(again)["Sq"] == json.loads(named)["Sq"]
    assert subject_of(run("info", matrix, *SCALE, "--level", "sphere")) == "form to be removed"


def test_info_plot(run: Runner, matrix: Path, tmp_path: Path) -> None:
    command = ("info", matrix, *SCALE, "--plot", tmp_path / "map.png")
    assert run(*command).exit_code == 0
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")
    assert run(*command).exit_code == 2
    assert run(*command, "--force").exit_code == 0


def test_materials_are_listed_with_sources(run: Runner) -> None:
    result = run("materials")
    assert result.exit_code == 0
    for text in ("DLC", "140 GPa", "15 GPa", "Peng 2001", "*"):
        assert text in result.stdout


def test_one_material(run: Runner) -> None:
    result = run("materials", "dlc")
    assert result.exit_code == 0
    assert "Bhushan 1999c" in result.stdout
    assert "Ni-P" not in result.stdout
    assert run("materials", "unobtainium").exit_code == 2


def test_materials_as_json(run: Runner) -> None:
    (found,) = json.loads(run("materials", "DLC", "--json").stdout)
    assert found["youngs_modulus"]["value"] == pytest.approx(140e9)
    assert found["youngs_modulus"]["source"]
    assert len(json.loads(run("materials", "--json").stdout)) > 10


def test_liquids_are_listed_with_sources(run: Runner) -> None:
    listed = run("liquids").stdout
    assert "18.05 cm³/mol" in listed
    assert "24 mN/m *" in listed, "typical values are marked"
    one = run("liquids", "zdol").stdout
    assert "perfluoropolyethers" in one
    (found,) = json.loads(run("liquids", "water", "--json").stdout)
    assert found["surface_tension"]["value"] == 0.07274
    assert subject_of(run("liquids", "watr")) == "liquid"


def test_own_materials(run: Runner, tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text('[material."jelly"]\nyoungs_modulus = "1 MPa"\npoisson_ratio = 0.49\n')
    assert "jelly" in run("materials", "--file", own).stdout
    assert run("materials", "--file", tmp_path / "none.toml").exit_code == 2


def test_many_files_are_one_table(run: Runner, matrix: Path, tmp_path: Path) -> None:
    (tmp_path / "broken.txt").write_text("no heights", encoding="utf-8")
    files = (matrix, tmp_path / "broken.txt")
    found = run("info", *files, *SCALE, "--report", tmp_path / "page.html")
    assert found.exit_code == 1
    assert [line.split()[0] for line in found.stdout.splitlines() if " – " in line or "32 × 24" in line] == [
        "rough.txt",
        "broken.txt",
    ]
    assert "32 × 24" in (tmp_path / "page.html").read_text(encoding="utf-8")
    machine = run("info", *files, *SCALE, "--json")
    assert [record["shape"] for record in json.loads(machine.stdout)] == [[32, 24]]
    assert "broken.txt" in machine.stderr
    assert run("info", *files, *SCALE, "--full").exit_code == 2


def test_files_of_one_surface_give_one_spectrum(run: Runner, tmp_path: Path) -> None:
    made = ("generate", "rough", "--points", "64", "--spectrum", "exponential", "--rms", "1nm")
    files = [tmp_path / "large.nc", tmp_path / "small.nc"]
    for file, size in zip(files, ("8um", "2um"), strict=True):
        more = ("--size", size, "--seed", "1", "--correlation-length", "200nm", "--out", file)
        assert run(*made, *more).exit_code == 0
    shown = run("info", *files, "--one-surface", "--plots", tmp_path / "pictures")
    assert shown.exit_code == 0, shown.stderr
    assert [name for name in ("large.nc", "small.nc", "sampling") if name not in shown.stdout] == []
    assert (tmp_path / "pictures" / "spectrum.png").read_bytes().startswith(b"\x89PNG")
    found = json.loads(run("info", *files, "--one-surface", "--json").stdout)
    assert found["hurst"] == pytest.approx(0.5, abs=3.0 * found["hurst_error"])
    assert len(found["bands"]) == 2
    assert len(found["q"]) == len(found["profile_psd_error"])
    asked = ("--one-surface", "--E-star", "100GPa", "--pressure", "1MPa")
    waves = json.loads(run("info", *files, *asked, "--hardness", "5GPa", "--json").stdout)
    assert sum(waves["shares"]["mean_gap"]) == pytest.approx(1.0, rel=1e-9)
    assert waves["needs"]["area"]["interval"] > 0.0
    assert "compliance" in run("info", *files, *asked).stdout
    assert subject_of(run("info", *files, "--one-surface", "--pressure", "1MPa")) == "--E-star"
    assert subject_of(run("info", *files, "--pressure", "1MPa")) == "--E-star, --pressure and --hardness"
    refused = run("info", *files, "--one-surface", "--full")
    assert subject_of(refused) == "--full, --plot and --report"
