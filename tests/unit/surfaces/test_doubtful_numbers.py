"""Numbers of files that cannot be heights: codes for missing points, clipping, spikes, and scales
that no instrument has."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from reference_data import FOLDER
from refusals import refused

import asperity as asp
from asperity.core.errors import FileFormatError
from asperity.parts.advice import findings
from asperity.surfaces.prepare.level import codes, spikes
from asperity.surfaces.read import read
from asperity.surfaces.reader_library import ANY, OPTICAL, PROBE, height_doubt, lateral_doubt

LABELS = list(csv.DictReader((FOLDER / "profiles" / "sentinel_labels.csv").read_text(encoding="utf-8").splitlines()))
SCALE = {"size": (16e-6, 16e-6), "height_unit": "nm"}


@pytest.mark.parametrize("row", LABELS, ids=lambda row: row["description"])
def test_verdicts_on_labelled_maps(row: dict[str, str]) -> None:
    heights = np.load(FOLDER / "profiles" / "sentinel_maps.npz")[row["map"]]
    found = codes(heights)
    if row["label"] in ("missing", "ask"):
        assert [(code.verdict, code.count) for code in found] == [(row["label"], int(row["count"]))]
        assert found[0].value == pytest.approx(float(row["code"]), rel=1e-6)
    elif row["label"] == "clipped":
        assert {code.verdict for code in found} == {"clipped"}
        assert sum(code.count for code in found) == int(row["count"])
    else:
        assert found == ()
        assert np.count_nonzero(spikes(heights)) == int(row["count"])


@pytest.mark.parametrize("hurst", [0.3, 0.8])
def test_rough_surfaces_have_neither_codes_nor_spikes(hurst: float) -> None:
    for seed in range(10):
        grid = asp.Grid((64, 64), (1e-7, 1e-7))
        spectrum = asp.generate.SelfAffine(
            hurst=hurst,
            amplitude=asp.generate.RmsHeight(1e-8),
            rolloff_wavelength=3.2e-6,
            shortest_wavelength=2e-7,
        )
        heights = asp.generate.gaussian(grid, spectrum, seed=seed).heights
        assert codes(heights) == ()
        assert not spikes(heights).any()


def test_a_code_beside_rounded_numbers_and_missing_points(tmp_path: Path) -> None:
    heights = np.random.default_rng(1).normal(size=(16, 16)) * 5
    heights[3:6, 4:6] = 32767
    heights[0, 0] = np.nan
    np.savetxt(tmp_path / "s.txt", heights, fmt="%.2f")
    (finding,) = read(tmp_path / "s.txt", **SCALE).origin.findings  # type: ignore[arg-type]
    assert (finding.level, finding.numbers) == ("warning", {"value": 32767.0, "points": 6.0})
    marked = read(tmp_path / "s.txt", missing=[32767], **SCALE)  # type: ignore[arg-type]
    assert (marked.n_missing, marked.origin.findings) == (7, ())


def test_one_point_far_off_is_a_spike_that_may_be_a_code(tmp_path: Path) -> None:
    heights = np.random.default_rng(0).normal(size=(16, 16)) * 5
    heights[3, 4] = -9999
    np.savetxt(tmp_path / "s.txt", heights, fmt="%.4f")
    surface = read(tmp_path / "s.txt", **SCALE)  # type: ignore[arg-type]
    (finding,) = surface.origin.findings
    assert (finding.level, finding.criterion) == ("warning", "spikes")
    assert finding.numbers["distance"] > 1000
    problem = asp.ContactProblem(asp.surfaces.levelled(surface), asp.material("DLC"))
    assert finding in findings(asp.solve(problem, asp.MeanPressure(1e5)))
    masked = asp.surfaces.filled(asp.surfaces.despiked(surface))
    found = findings(asp.solve(asp.ContactProblem(masked, asp.material("DLC")), asp.MeanPressure(1e5)))
    assert "spikes" not in [item.criterion for item in found]


def gsf(path: Path, side: float, heights: np.ndarray, unit: str = "m") -> None:
    """Write a Gwyddion simple field of square pixels."""
    nx, ny = heights.shape
    head = f"Gwyddion Simple Field 1.0\nXRes = {nx}\nYRes = {ny}\nXReal = {side}\nYReal = {side * ny / nx}\n"
    text = f"{head}XYUnits = m\nZUnits = {unit}\n".encode()
    path.write_bytes(text + b"\0" * (4 - len(text) % 4) + heights[:, ::-1].T.astype("<f4").tobytes())


def test_a_scale_that_cannot_be_is_refused_until_it_is_stated(tmp_path: Path) -> None:
    heights = np.random.default_rng(0).normal(size=(16, 8))
    path = tmp_path / "a.gsf"
    gsf(path, 160.0, heights * 1e-8)
    with refused(FileFormatError, f"scale of file {path}", "160 m", "size="):
        read(path)
    assert read(path, size=(160e-6, 80e-6)).size == (160e-6, 80e-6)
    assert read(path, size=(160.0, 80.0)).size == (160.0, 80.0), "which confirms it"
    gsf(path, 160e-6, heights * 3e3)
    with refused(FileFormatError, f"scale of file {path}", "km", "height_unit="):
        read(path)
    assert np.nanstd(read(path, height_unit="nm").heights) == pytest.approx(np.std(heights) * 3e-6, rel=1e-6)
    gsf(path, 160e-6, heights * 1e-8)
    for given, subject in (({"size": (1e-6, 1e-6)}, "size"), ({"height_unit": "nm"}, "height unit")):
        with refused(FileFormatError, f"{subject} of file {path}"):
            read(path, **given)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("family", "size", "shape", "right"),
    [
        (OPTICAL, (160.0, 120.0), (512, 384), False),
        (OPTICAL, (160e-6, 120e-6), (512, 384), True),
        (PROBE, (0.1, 0.1), (512, 512), False),
        (PROBE, (10e-6, 10e-6), (512, 512), True),
        (ANY, (20.0, 20.0), (64, 64), False),
        (ANY, (1e-13, 1e-13), (64, 64), False),
        (ANY, (5.0, 5.0), (4, 4), False),
    ],
)
def test_sides_and_pixels_of_instruments(family, size, shape, right) -> None:  # type: ignore[no-untyped-def]
    assert (lateral_doubt(family, size, shape) == "") is right


def test_heights_of_instruments() -> None:
    heights = np.random.default_rng(0).normal(size=(16, 16))
    assert height_doubt(PROBE, heights * 1e-8) == ""
    assert "mm" in height_doubt(PROBE, heights * 1e-3)
    assert height_doubt(OPTICAL, heights * 1e-3) == ""
    assert height_doubt(OPTICAL, np.zeros((4, 4))) == ""
    assert height_doubt(OPTICAL, heights) != ""
