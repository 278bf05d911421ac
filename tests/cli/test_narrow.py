"""What is printed reads well on a narrow terminal: names and numbers are not cut, missing options
are named at once."""

from __future__ import annotations

import io
from itertools import pairwise
from pathlib import Path

import pytest
from cli.conftest import BODY, LOAD, SCALE, Runner
from rich.console import Console

import asperity as asp
from asperity.cli.generate import options
from asperity.cli.show import table
from asperity.core.errors import UnitError
from asperity.core.units import parse, prefixed, times

NUMBERS = ("5.05 nm", "30.8 nm", "1024 × 1024", "10 µm × 10 µm", "0.0199")


def printed(width: int, rows: list[tuple[str, ...]], headings: tuple[str, ...]) -> str:
    out = io.StringIO()
    Console(file=out, width=width).print(table("Files", rows, headings))
    return out.getvalue()


@pytest.mark.parametrize("width", [120, 80, 60, 40, 30])
def test_numbers_of_a_table_stay_whole(width: int) -> None:
    headings = ("file", *(f"a quantity {number}" for number in range(len(NUMBERS))))
    rows = [
        (name, *NUMBERS[:-1], last) for name, last in (("a_scan_with_a_long_name_1um_256.007", "0.0199"), ("b", "0.5"))
    ]
    text = printed(width, rows, headings)
    assert all(number in text for number in (*NUMBERS, "0.5"))
    assert max(map(len, text.splitlines())) <= width


def test_what_all_rows_share_is_said_once_where_there_is_no_room() -> None:
    rows = [(name, "levelled by the mean", value) for name, value in (("a", "1 nm"), ("b", "2 nm"))]
    wide, narrow = (printed(width, rows, ("file", "levelled", "height")) for width in (80, 32))
    assert (wide.count("by the mean"), " ".join(narrow.split()).count("by the mean")) == (2, 1)


@pytest.mark.parametrize("kind", ["rough", "two_process"])
def test_names_of_options_are_whole_in_the_help(run: Runner, kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    text = run("generate", kind, "--help").stdout
    assert all(f"{option.name} " in text.replace("\n", " ").replace(",", " ") for option in options(kind))
    assert "…" not in "".join(line.partition("  ")[0] for line in text.splitlines() if line.startswith("  --"))
    assert max(map(len, text.splitlines())) <= 80
    assert "``" not in run("generate", "--help").stdout


def test_all_missing_options_are_named_at_once(run: Runner) -> None:
    found = run("generate", "rough", "--points", "16")
    assert found.exit_code == 2
    places = [found.stderr.find(name) for name in ("--size", "--seed", "--spectrum", "--out")]
    assert all(0 <= first < last for first, last in pairwise(places))
    assert "--points" not in found.stderr
    one = run("generate", "rough", "--points", "16", "--size", "1um", "--seed", "1", "--spectrum", "gaussian")
    assert (one.exit_code, "--out" in one.stderr) == (2, True)


def test_what_a_spectrum_lacks_is_named_at_once_too(run: Runner) -> None:
    """Its amplitude, one of three, with all else; alone if nothing else is missing."""
    base = (
        "generate",
        "rough",
        "--points",
        "16",
        "--size",
        "1um",
        "--seed",
        "1",
        "--spectrum",
        "self-affine",
        "--out",
        "a.nc",
    )
    waves = ("--rolloff-wavelength", "1um", "--shortest-wavelength", "0.2um")
    amplitudes = ("--rms-height", "--rms-slope", "--plateau")
    for more, wanted in ((waves, ("--hurst", *amplitudes)), ((*waves, "--hurst", "0.8"), amplitudes)):
        found = run(*base, *more)
        assert found.exit_code == 2
        assert all(name in found.stderr for name in wanted)
        assert len(found.stderr.strip().splitlines()) == (3 if "--hurst" in wanted else 1)
    assert "--plateau" not in run(*base, *waves, "--rms-height", "1nm").stderr


def test_a_comma_before_the_decimals_is_answered_with_the_point(run: Runner, matrix: Path) -> None:
    for text, meant in (("0,5MPa", "'0.5MPa'"), (" -1,25 kPa", "'-1.25 kPa'"), (",5Pa", "'.5Pa'")):
        with pytest.raises(UnitError) as caught:
            parse(text, "pressure", "pressure")
        assert meant in str(caught.value)
    found = run("contact", matrix, *SCALE, *BODY, "--pressure", "0,5MPa")
    assert (found.exit_code, "0.5MPa" in found.stderr) == (2, True)
    for body, meant in (("E=200GPa,nu=0,3", "'0.3'"), ("E=0,2GPa,nu=0.3", "'0.2GPa'"), ("DLC:0,5um/steel", "'0.5um'")):
        found = run("contact", matrix, *SCALE, "--body", body, *LOAD)
        assert (found.exit_code, meant in found.stderr) == (2, True), found.stderr


def test_generated_surfaces_state_the_slope_of_the_waves_beside_that_of_differences(
    run: Runner, tmp_path: Path
) -> None:
    """That of the spectrum is what --rms-slope prescribes, and larger than differences between
    points can show."""
    waves = (
        "--spectrum",
        "self_affine",
        "--hurst",
        "0.8",
        "--rolloff-wavelength",
        "4um",
        "--shortest-wavelength",
        "0.6um",
    )
    size = ("--points", "64", "--size", "10um", "--seed", "2", "--variant", "fixed", "--out", tmp_path / "a.nc")
    text = run("generate", "rough", *size, *waves, "--rms-slope", "0.1").stdout
    line = next(line for line in text.splitlines() if "Sdq" in line)
    between, whole = (float(word) for word in line.split() if word.replace(".", "").isdigit())
    assert between < 0.98 * whole
    assert whole == pytest.approx(0.1, rel=1e-3)


def test_both_sides_of_a_size_are_written_alike() -> None:
    assert prefixed("its size is 1e-05 x 1e-05 m.") == "its size is 10 µm x 10 µm."
    assert prefixed("its size is 2 x 1 m.") == "its size is 2 x 1 m."


@pytest.mark.parametrize(("ratio", "text"), [(412.3, "410"), (4.123, "4.1"), (0.0123, "0.012"), (2.4e7, "2.4e+07")])
def test_factors_in_sentences_are_plain_numbers(ratio: float, text: str) -> None:
    assert times(ratio) == text


def test_pressure_far_beyond_the_hardness_is_stated_in_plain_numbers() -> None:
    surface = asp.generate.sphere(asp.Grid((16, 16), (1e-7, 1e-7)), radius=1e-6)
    soft = asp.Elastic(1e11, 0.3, asp.Strength(hardness=1e7))
    solved = asp.solve(asp.ContactProblem(surface, soft, boundary=asp.Free()), asp.Force(1e-3))
    (found,) = (item for item in solved.advice if item.criterion == "hardness")
    assert times(solved.max_pressure / 1e7) in found.message
    assert "e+" not in found.message
