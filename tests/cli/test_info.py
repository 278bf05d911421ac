"""The commands ``info`` and ``materials``."""

from __future__ import annotations

import io
import json
import zipfile
from pathlib import Path

import numpy as np
import pytest
from cli.conftest import SCALE, Runner
from refusals import subject_of
from rich.console import Console

from asperity.cli.info import HEADINGS, one_line_each
from asperity.cli.show import table


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


def test_info_says_how_a_text_was_understood_and_what_is_doubtful(run: Runner, tmp_path: Path) -> None:
    values = np.random.default_rng(1).normal(size=(12, 12))
    values[3, 4:9] = -9999.0
    text = "Disk A\n" + "".join(";".join(f"{v:.3f}".replace(".", ",") for v in row) + "\n" for row in values)
    (tmp_path / "a.csv").write_text(text)
    command = ("info", tmp_path / "a.csv", "--size", "12um", "--height-unit", "nm")
    shown = run(*command)
    for word in ("semicolon", "comma", "-9999", "--missing"):
        assert word in shown.stdout
    found = json.loads(run(*command, "--missing", "-9999", "--json").stdout)
    assert found["missing"] == 5
    assert found["findings"] == []
    stated = ("--delimiter", "semicolon", "--decimal", "comma", "--header-lines", "1", "--axes", "none")
    assert json.loads(run(*command, *stated, "--encoding", "utf-8", "--json").stdout)["missing"] == 0
    assert subject_of(run(*command, "--encoding", "klingon")) == "encoding of a text"


def test_a_scale_that_cannot_be_is_a_finding_of_info_and_refused_by_contact(run: Runner, tmp_path: Path) -> None:
    head = b"Gwyddion Simple Field 1.0\nXRes = 16\nYRes = 16\nXReal = 160\nYReal = 160\nXYUnits = m\nZUnits = m\n"
    heights = np.random.default_rng(1).normal(size=256) * 1e-8
    (tmp_path / "a.gsf").write_bytes(head + b"\0" * (4 - len(head) % 4) + heights.astype("<f4").tobytes())
    shown = run("info", tmp_path / "a.gsf")
    assert shown.exit_code == 0
    assert "160 m, but" in shown.stdout
    pressed = ("contact", tmp_path / "a.gsf", "--body", "DLC", "--pressure", "50kPa")
    assert subject_of(run(*pressed)) == f"scale of file {tmp_path / 'a.gsf'}"
    assert run(*pressed, "--size", "160um").exit_code == 0


def test_the_scans_of_an_archive_are_rows(run: Runner, matrix: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "scans.zip", "w") as archive:
        archive.write(matrix, "day 1/a.txt")
        archive.write(matrix, "day 2/b.txt")
    shown = run("info", tmp_path / "scans.zip", *SCALE)
    assert [line.split()[0] for line in shown.stdout.splitlines() if "32 × 24" in line] == ["a.txt", "b.txt"]
    one = json.loads(run("info", tmp_path / "scans.zip", *SCALE, "--channel", "1", "--json").stdout)
    assert one["shape"] == [32, 24]


@pytest.mark.parametrize("width", [60, 80, 120])
def test_each_file_has_one_line(width: int) -> None:
    sizes = ("1024 × 1024", "87.6 µm × 130 µm", "0.0378 %", "6.71 nm", "5.2 nm", "112 nm", "0.0181", "plane")
    rows = [
        (
            "afm_grainy_film_1um_256.007",
            "256 × 256",
            "1 µm × 1 µm",
            "0 %",
            "2.42 nm",
            "1.95 nm",
            "18.2 nm",
            "0.378",
            "mean",
        ),
        ("a_very_long_name_of_a_scan_of_the_second_disk_after_running_in.nid", *sizes),
    ]
    headings, shown, left = one_line_each(HEADINGS, rows, width)
    assert headings[:2] == HEADINGS[:2]
    assert {*headings, *left} == {*HEADINGS}
    made = table("2 files", shown, headings)
    made.columns[0].no_wrap = True
    text = io.StringIO()
    Console(file=text, width=width).print(made)
    assert next(line.split()[0] for line in text.getvalue().splitlines() if " × " in line).startswith("afm")
    assert sum(" × " in line for line in text.getvalue().splitlines()) == 2
    assert ("Sq" in headings) == (width >= 60)


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
    assert subject_of(refused) == "--full and --plot"
    page = tmp_path / "page.html"
    assert run("info", *files, *asked, "--report", page).exit_code == 0
    text = page.read_text(encoding="utf-8")
    assert [word for word in ("large.nc", "small.nc", "Share of each octave", "Hurst") if word not in text] == []
    assert text.count("data:image/png") == 5
    assert run("info", *files, "--one-surface", "--report", page).exit_code == 2
