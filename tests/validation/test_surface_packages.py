"""The page that sets surfaces beside other packages: what it claims holds with the recorded
numbers, and its causes are the whole causes."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import package_files
import package_numbers
import package_rules
import pytest
import surface_packages
from validation_pages import assert_claims_hold, assert_written_by_script, written_page

from asperity import roughness


@pytest.mark.slow
def test_what_is_claimed_holds() -> None:
    page = surface_packages.page()
    assert_claims_hold(page)
    assert_written_by_script(page, "surface_packages")
    written = written_page("surface_packages")
    assert [part for part in page.parts if isinstance(part, str) and part not in written] == []


def test_every_recorded_number_belongs_to_a_parameter_of_ours() -> None:
    record = surface_packages.recorded()
    for package, name, numbers in surface_packages.inputs():
        assert set(record["numbers"][package][name]) == set(numbers)
    assert set(record["files"]) == set(surface_packages.PACKAGES)
    assert len(record["scans"]) == 6


def test_surfalize_and_ours_are_one_where_the_mean_is_zero() -> None:
    """The cause of the deviations of Ra, Rq, Rsk, Rku, Rp and Rv is the mean that is subtracted
    again."""
    record = surface_packages.recorded()["numbers"]["surfalize"]
    rough = package_numbers.traces()["ground"].roughness
    theirs = record["ground R"]
    assert roughness.profile_parameters(rough).sk != pytest.approx(theirs["Rsk"], rel=0.1)
    centred = rough.with_heights(rough.heights - rough.heights.mean(), "about a new mean")
    found = roughness.profile_parameters(centred)
    for name in ("a", "q", "sk", "ku", "p", "v", "z", "t"):
        assert getattr(found, name) == pytest.approx(theirs[f"R{name}"], rel=1e-12)
        own = roughness.profile_parameters(package_numbers.traces()["ground"].waviness, "W", sections=1)
        assert getattr(own, name) == pytest.approx(record["ground W"][f"W{name}"], rel=1e-12)


def test_a_curve_of_classes_tends_to_ours() -> None:
    """A hundred thousand points of a cubic, flattest in the middle."""
    z = np.linspace(-1.0, 1.0, 100_001) ** 3
    ours = roughness.functional_parameters(roughness.MaterialRatioCurve(np.sort(z)[::-1]))
    theirs = package_rules.CurveOfClasses(z)
    for found, own in zip(theirs.core().values(), (ours.Sk, ours.Spk, ours.Svk), strict=False):
        assert found == pytest.approx(own, rel=2.0 / package_rules.CLASSES * 10.0)


def test_outcomes_in_words(tmp_path: Path) -> None:
    right, pixel = package_files.HEIGHTS, package_files.PIXEL
    for h, of, words in (
        (right, pixel, "equal"),
        (right[:, ::-1], pixel, "turned over in y"),
        (1e3 * right, 2.0 * pixel, "pixel × 2, heights × 1000"),
        (right + 1e-6, pixel, "heights + 1 µm"),
        (np.roll(right, 2, axis=0), pixel, "other heights"),
        (right[1:], pixel, "other heights"),
    ):
        assert package_files.in_words(package_files.judged(h, of, "")) == words
    unknown = package_files.outcome(package_files.by_surface_topography, tmp_path / "absent.gsf", {})
    assert unknown["state"].startswith(("no reader", "refused"))


def test_without_packages_and_scans_the_recorded_numbers_stay(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(surface_packages, "_installed", lambda package: "")
    monkeypatch.setattr(package_numbers, "SCANS", tmp_path / "absent")
    record = surface_packages.recorded()
    before = json.dumps(record)
    assert json.dumps(surface_packages.refreshed(record)) == before
    told = capsys.readouterr().out
    assert [name for name in (*surface_packages.PACKAGES, "absent") if name not in told] == []


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")  # it leaves files open that it refuses
def test_the_reader_library_still_gives_what_is_recorded(tmp_path: Path) -> None:
    """A later version of SurfaceTopography may be mended: then the page and our own mending are due
    for a look."""
    record = surface_packages.recorded()
    if surface_packages._installed("SurfaceTopography") != record["versions"]["SurfaceTopography"]:
        pytest.skip("another version than the recorded one is installed")
    found = package_files.outcomes("SurfaceTopography", tmp_path)
    for name, one in found.items():
        assert package_files.in_words(one) == package_files.in_words(record["files"]["SurfaceTopography"][name])
    theirs = surface_packages.theirs("SurfaceTopography")["map"]
    for name, value in theirs.items():
        assert value == pytest.approx(record["numbers"]["SurfaceTopography"]["map"][name], rel=1e-9)
