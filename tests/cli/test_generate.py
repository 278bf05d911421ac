"""The command ``generate``: every kind, text with units, files that come back, and errors that name
options."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cli.conftest import Runner
from refusals import subject_of

import asperity as asp
from asperity.cli.generate import options
from asperity.io.schemas.surfaces import SURFACES

GRID = ("--points", "24x16", "--size", "12um x 8um")
EXPONENTIAL = ("--spectrum", "exponential", "--rms-height", "5nm", "--correlation-length", "0.6um")
SELF_AFFINE = (
    "--spectrum",
    "self_affine",
    "--hurst",
    "0.8",
    "--rolloff-wavelength",
    "4um",
    "--shortest-wavelength",
    "2um",
)
SEED = ("--seed", "3")


def spectrum(table: str) -> tuple[str, ...]:
    return (f"--{table}", "exponential", f"--{table}-rms-height", "5nm", f"--{table}-correlation-length", "0.6um")


TRACE = "trace.txt"
"""Name of a file with a line scan, which tests of all kinds have in the current folder."""

EXAMPLES = {
    "rough": (*SEED, *EXPONENTIAL, "--variant", "fixed"),
    "digital_filter": (*SEED, *EXPONENTIAL, "--skewness", "-0.3", "--kurtosis", "4"),
    "translated": (*SEED, *EXPONENTIAL, "--skewness", "0.7", "--kurtosis", "5", "--no-predistorted"),
    "rank_ordered": (*SEED, *EXPONENTIAL, "--heights", "two_levels", "--share", "0.4", "--separation", "3"),
    "from_line_scan": (*SEED, "--file", TRACE, "--model", "rounded", "--heights"),
    "bimodal": (
        *SEED,
        *spectrum("first"),
        *spectrum("second"),
        *spectrum("patches"),
        "--share",
        "0.3",
        "--separation",
        "-2nm",
    ),
    "two_process": (*SEED, *spectrum("plateau"), *spectrum("valleys"), "--offset", "3nm", "--keep", "upper"),
    "particles": (*SEED, *spectrum("matrix"), "--density", "0.1um**-2", "--radius", "0.5um", "--exposure", "1"),
    "weierstrass_mandelbrot": (*SEED, "--dimension", "2.3", "--roughness", "1pm", "--ridges", "7"),
    "weierstrass_mandelbrot_profile": ("--dimension", "1.3", "--roughness", "1pm"),
    "sphere": ("--radius", "30um", "--exact"),
    "elliptic_paraboloid": ("--radius-x", "30um", "--radius-y", "10um"),
    "cylinder": ("--radius", "30um", "--axis", "x"),
    "cone": ("--slope", "0.1"),
    "wedge": ("--slope", "0.1", "--axis", "x"),
    "power_law": ("--exponent", "4", "--radius", "3um", "--height", "10nm"),
    "flat_punch": ("--radius", "3um", "--depth", "1um", "--edge-radius", "0.5um"),
    "sinusoid": ("--amplitude", "5nm", "--wavelength", "4um"),
    "bisinusoid": ("--amplitude", "5nm", "--wavelength", "4um"),
    "flat": (),
    "laser_bumps": ("--pitch", "4um,8um", "--rim-height", "20nm", "--rim-radius", "1um", "--rim-width", "0.4um"),
    "dimples": ("--pitch", "4um,8um", "--radius", "1um", "--depth", "20nm", "--raised"),
    "grooves": ("--pitch", "4um", "--width", "1um", "--depth", "20nm", "--section", "cosine"),
}


@pytest.fixture
def trace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A line scan of 60 µm in the file ``TRACE`` of the current folder."""
    monkeypatch.chdir(tmp_path)
    model = asp.roughness.RoundedSpectrum(3e-28, 3e6, 0.8)
    rough = asp.generate.gaussian(asp.Grid((600, 8), (1e-7, 1e-7)), model, seed=1)
    asp.files.save_surface(rough.row(0), TRACE)


def test_every_kind_has_an_example() -> None:
    assert set(EXAMPLES) == set(SURFACES)


@pytest.mark.usefixtures("trace")
@pytest.mark.parametrize("kind", EXAMPLES)
def test_every_kind_is_generated_and_comes_back(run: Runner, tmp_path: Path, kind: str) -> None:
    result = run("generate", kind, *GRID, *EXAMPLES[kind], "--out", tmp_path / "a.nc")
    assert result.exit_code == 0, result.stderr
    surface = asp.read(tmp_path / "a.nc")
    assert surface.shape == (24, 16)
    assert surface.size == pytest.approx((12e-6, 8e-6))
    assert surface.origin.history[0].startswith("generated: ")
    assert "24 × 16" in result.stdout
    assert "12 µm × 8 µm" in result.stdout


@pytest.mark.parametrize("kind", EXAMPLES)
def test_every_option_of_every_kind_is_explained(run: Runner, kind: str) -> None:
    result = run("generate", kind, "--help")
    assert result.exit_code == 0
    unexplained = [option.name for option in options(kind) if not option.parameter.help]
    assert unexplained == []
    assert len({option.word for option in options(kind)}) == len(options(kind))


def test_units_and_values_reach_the_generator(run: Runner, tmp_path: Path) -> None:
    run("generate", "rough", *GRID, *SEED, *SELF_AFFINE, "--rms", "5nm", "--out", tmp_path / "a.nc")
    expected = asp.generate.gaussian(
        asp.Grid((24, 16), (0.5e-6, 0.5e-6)),
        asp.generate.SelfAffine(
            amplitude=asp.generate.RmsHeight(5e-9), hurst=0.8, rolloff_wavelength=4e-6, shortest_wavelength=2e-6
        ),
        seed=3,
    )
    np.testing.assert_allclose(asp.read(tmp_path / "a.nc").heights, expected.heights, rtol=1e-9, atol=1e-20)


def test_dashes_serve_as_underscores(run: Runner, tmp_path: Path) -> None:
    assert run("generate", "flat-punch", *GRID, *EXAMPLES["flat_punch"], "--out", tmp_path / "a.nc").exit_code == 0


def test_two_slopes_from_numbers_with_commas(run: Runner, tmp_path: Path) -> None:
    options = ("--spectrum", "two_slopes", "--plateau", "1.5e8nm**4", "--exponents", "6.5,4.6")
    waves = ("--rolloff-wavelength", "5um", "--crossover-wavelength", "3um")
    result = run("generate", "rough", *GRID, *SEED, *options, *waves, "--out", tmp_path / "a.nc")
    assert result.exit_code == 0, result.stderr
    assert [text for text in ("q^-6.5", "5 µm", "q^-4.6", "3 µm") if text not in result.stdout] == []


def test_more_like_a_measured_file(run: Runner, tmp_path: Path) -> None:
    np.savetxt(tmp_path / "seen.txt", np.random.default_rng(1).normal(size=(32, 32)))
    scale = ("--spectrum-file-size", "8um", "--spectrum-file-height-unit", "nm")
    options = ("--spectrum", "measured", "--spectrum-file", tmp_path / "seen.txt", *scale, "--floor", "1nm**4")
    result = run("generate", "rough", *GRID, *SEED, *options, "--out", tmp_path / "a.nc")
    assert result.exit_code == 0, result.stderr
    assert "seen.txt" in result.stdout


@pytest.mark.usefixtures("trace")
def test_a_surface_with_the_spectrum_of_a_line_scan(run: Runner) -> None:
    result = run("generate", "from-line-scan", *GRID, *SEED, "--file", TRACE, "--out", "a.nc")
    assert result.exit_code == 0, result.stderr
    found = asp.read("a.nc")
    expected = asp.generate.surface_of_profile(asp.read(TRACE), found.grid, seed=3)
    np.testing.assert_array_equal(found.heights, expected.heights)
    assert "isotropic" in found.origin.history[0]
    assert "isotropic" in result.stdout


def test_a_map_is_no_line_scan(run: Runner, tmp_path: Path) -> None:
    asp.files.save_surface(asp.Surface(np.zeros((9, 7)), 1e-6), tmp_path / "map.nc")
    result = run("generate", "from-line-scan", *GRID, *SEED, "--file", tmp_path / "map.nc", "--out", tmp_path / "a.nc")
    assert result.exit_code == 2
    assert subject_of(result) == "file for the spectrum of a line scan"


def test_more_like_many_scans(run: Runner, tmp_path: Path) -> None:
    heights = np.random.default_rng(1).normal(size=(3, 64, 64)).cumsum(axis=2)
    for number, lines in enumerate(heights):
        np.savetxt(tmp_path / f"{number}.txt", lines.T)
    scans = [
        part
        for number, size in enumerate(("8um", "4um", "2um"))
        for part in ("--scans", f"{tmp_path / str(number)}.txt,size={size},height_unit=nm")
    ]
    made = ("generate", "rough", *GRID, *SEED, "--spectrum", "scans")
    result = run(*made, *scans, "--corner", "sharp", "--out", tmp_path / "a.nc")
    assert result.exit_code == 0, result.stderr
    history = asp.read(tmp_path / "a.nc").origin.history[0]
    assert [number for number in range(3) if f"{number}.txt" not in history] == []
    assert subject_of(run(*made, "--out", tmp_path / "b.nc")) == "--scans"
    lost = run(*made, "--scans", tmp_path / "none.txt", "--out", tmp_path / "b.nc")
    assert lost.exit_code == 2


@pytest.mark.parametrize("ending", ["txt", "asc", "npy"])
def test_other_files(run: Runner, tmp_path: Path, ending: str) -> None:
    command = (
        "generate",
        "rough",
        *GRID,
        *SEED,
        *EXPONENTIAL,
        "--out",
        tmp_path / f"a.{ending}",
        "--plot",
        tmp_path / "a.png",
    )
    assert run(*command).exit_code == 0
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    assert run(*command).exit_code == 2
    assert run(*command, "--force").exit_code == 0
    if ending != "npy":
        assert asp.read(tmp_path / f"a.{ending}").size == pytest.approx((12e-6, 8e-6), rel=1e-9)


def test_tiles_within_a_memory(run: Runner, tmp_path: Path) -> None:
    big = ("--points", "500x300", "--size", "10um x 6um", *SEED, "--spectrum", "exponential")
    rough = ("--rms-height", "5nm", "--correlation-length", "80nm")
    result = run("generate", "digital_filter", *big, *rough, "--memory", "2MB", "--out", tmp_path / "a.npy")
    assert result.exit_code == 0, result.stderr
    whole = run("generate", "digital_filter", *big, *rough, "--out", tmp_path / "b.npy")
    assert whole.exit_code == 0
    np.testing.assert_allclose(np.load(tmp_path / "a.npy"), np.load(tmp_path / "b.npy"), atol=1e-20)


def test_gaussian_surface_within_a_memory(run: Runner, tmp_path: Path) -> None:
    big = ("--points", "300x200", "--size", "10um x 6um", *SEED, *SELF_AFFINE, "--rms-height", "5nm")
    result = run("generate", "rough", *big, "--memory", "300kB", "--out", tmp_path / "a.npy")
    assert result.exit_code == 0, result.stderr
    assert run("generate", "rough", *big, "--out", tmp_path / "b.npy").exit_code == 0
    np.testing.assert_allclose(np.load(tmp_path / "a.npy"), np.load(tmp_path / "b.npy"), atol=1e-20)


@pytest.mark.parametrize(
    ("kind", "options", "subject"),
    [
        ("rough", (*SEED, *SELF_AFFINE), "spectrum"),
        ("rough", (*SEED, *EXPONENTIAL, "--variant", "other"), "--variant"),
        (
            "rough",
            (*SEED, "--spectrum", "exponential", "--correlation-length", "1um", "--rms-height", "5"),
            "--rms-height",
        ),
        ("rough", (*SEED, "--spectrum", "white"), "spectrum.kind"),
        ("sphere", ("--radius", "-3um"), "--radius"),
        ("sphere", ("--radius", "1um", "--exact"), "grid of an exact sphere"),
        ("digital_filter", (*SEED, *EXPONENTIAL, "--kurtosis", "1"), "kurtosis of the heights at skewness 0"),
        ("digital_filter", (*SEED, *EXPONENTIAL, "--periodic", "--memory", "1GB"), "--memory"),
        ("rough", (*SEED, *EXPONENTIAL, "--no-periodic", "--memory", "1GB"), "--memory"),
        ("rough", (*SEED, *EXPONENTIAL, "--memory", "1GB"), "spectrum of a surface beyond the memory"),
        ("dimples", ("--pitch", "4um", "--radius", "1um", "--depth", "1nm"), "part 2 of --pitch"),
    ],
)
def test_errors_name_the_option(run: Runner, tmp_path: Path, kind: str, options: tuple[str, ...], subject: str) -> None:
    out = tmp_path / ("a.npy" if "--memory" in options else "a.nc")
    result = run("generate", kind, *GRID, *options, "--out", out)
    assert subject_of(result) == subject
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("kind", "options", "named"),
    [
        ("rough", (*SEED, *EXPONENTIAL, "--hurst", "0.8"), "--hurst"),
        ("rough", EXPONENTIAL, "--seed"),
        ("laser_bumps", (), "--pitch"),
    ],
)
def test_options_that_are_missing_or_unknown_are_named(
    run: Runner, tmp_path: Path, kind: str, options: tuple[str, ...], named: str
) -> None:
    result = run("generate", kind, *GRID, *options, "--out", tmp_path / "a.nc")
    assert result.exit_code == 2
    assert named in result.stderr


def test_unknown_kind_and_wrong_files(run: Runner, tmp_path: Path) -> None:
    assert run("generate", "plane", "--out", "x").exit_code == 2
    assert subject_of(run("generate", "flat", *GRID, "--out", tmp_path / "a.csv")) == "file of a surface"
    files = ("--out", tmp_path / "a.nc")
    assert subject_of(run("generate", "flat", *GRID, *files, "--plot", tmp_path / "a.jpg")) == "--plot"
    assert subject_of(run("generate", "flat", "--points", "4,4", "--size", "1um", *files)) == "--points"
    assert all(kind in run("generate", "--help").stdout for kind in SURFACES)
