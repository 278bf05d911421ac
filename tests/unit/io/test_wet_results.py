"""Wet contacts are read back as they were written, and dry files say that they are dry."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from contact_cases import wetted
from refusals import refused

import asperity as asp
from asperity.physics.menisci.figures import KINDS, plot_menisci
from asperity.physics.menisci.quantities import WET_SCALARS


@pytest.fixture(scope="module")
def wet() -> asp.ContactResult:
    heights = np.random.default_rng(3).normal(size=(24, 20)) * 1e-9
    problem = asp.ContactProblem(asp.Surface(heights, 10e-9), asp.Elastic(100e9, 0.3))
    film = asp.LiquidFilm(surface_tension=0.025, thickness=0.4e-9, meniscus_height=0.8e-9, viscosity=0.1)
    return wetted(problem, asp.MeanPressure(1e8), film, asp.Coulomb(0.2, 0.5, speed=1e-3))


def test_a_wet_contact_is_read_back_whole(wet: asp.ContactResult, tmp_path: Path) -> None:
    asp.save(wet, tmp_path / "wet.nc")
    found = asp.load(tmp_path / "wet.nc")
    for item in WET_SCALARS:
        assert getattr(found.menisci, item.name) == getattr(wet.menisci, item.name), item.name
    np.testing.assert_array_equal(found.menisci.wetting.menisci, wet.menisci.wetting.menisci)
    np.testing.assert_array_equal(found.pressure, wet.pressure)
    np.testing.assert_array_equal(found.sliding.shear_displacement, wet.sliding.shear_displacement)
    assert (found.control, found.status, found.certificate) == (wet.control, wet.status, wet.certificate)
    assert found.state.memory["menisci"] == wet.state.memory["menisci"]
    assert found.citation_keys == wet.citation_keys
    data = asp.files.open_tree(tmp_path / "wet.nc")["contact/couplings/menisci"].to_dataset()
    for item in WET_SCALARS:
        assert data[item.name] == getattr(wet.menisci, item.name), item.name
    assert data["wetting_menisci"].dims == ("x", "y")
    assert data["meniscus_force"].attrs["units"] == "N"


def corners_wet_in_part() -> tuple[asp.ContactProblem, asp.MeanPressure]:
    """A plateau whose last pixels touch and hold liquid in part."""
    heights = np.zeros((8, 8))
    heights[:5, :5] = 1e-7
    film = asp.LiquidFilm(surface_tension=0.07, thickness=0.9e-7)
    return asp.ContactProblem(
        asp.Surface(heights, 1e-6, periodic=True), asp.Elastic(1e4, 0.3), film=film
    ), asp.MeanPressure(100.0)


def test_pixels_wet_in_part_are_read_back(tmp_path: Path) -> None:
    problem, load = corners_wet_in_part()
    results = {
        "one": asp.solve(problem, load),
        "path": asp.solve(problem, asp.History([load, asp.MeanPressure(120.0)])),
    }
    for name, result in results.items():
        asp.save(result, tmp_path / f"{name}.nc")
        found = asp.load(tmp_path / f"{name}.nc")
        steps = zip(getattr(found, "steps", [found]), getattr(result, "steps", [result]), strict=True)
        for back, was in steps:
            assert was.menisci.wetting.partly.any()
            np.testing.assert_array_equal(back.menisci.wetting.filled, was.menisci.wetting.filled)
            assert back.menisci.wetting.regime == was.menisci.wetting.regime
            assert back.menisci.meniscus_area_fraction == was.menisci.meniscus_area_fraction
            assert asp.contact.review(back) == asp.contact.review(was)


@pytest.mark.parametrize("share", [1.5, -0.1, float("nan")])
def test_shares_that_no_point_can_have_are_refused(share: float, tmp_path: Path) -> None:
    asp.save(asp.solve(*corners_wet_in_part()), tmp_path / "bad.nc")
    with h5py.File(tmp_path / "bad.nc", "r+") as file:
        file["contact/couplings/menisci/wetting_filled"][0, 0] = share
    with refused(asp.errors.FileFormatError, "result file"):
        asp.load(tmp_path / "bad.nc")


def test_a_dry_result_has_no_menisci(tmp_path: Path) -> None:
    heights = np.random.default_rng(3).normal(size=(8, 8)) * 1e-9
    dry = asp.solve(asp.ContactProblem(asp.Surface(heights, 10e-9), asp.Elastic(100e9, 0.3)), asp.MeanPressure(1e8))
    asp.save(dry, tmp_path / "dry.nc")
    assert asp.load(tmp_path / "dry.nc").menisci is None
    with refused(asp.InputError, "problem of the result"):
        dry.require_menisci()


def test_the_map_of_menisci_shows_every_kind(wet: asp.ContactResult) -> None:
    from matplotlib.figure import Figure

    ax = plot_menisci(wet, Figure().add_subplot())
    (image,) = ax.get_images()
    drawn = np.asarray(image.get_array()).T
    assert (drawn == 3).sum() == wet.contact.sum()
    assert (drawn == 2).sum() == wet.menisci.wetting.menisci.sum()
    assert (drawn >= 1).sum() == wet.menisci.wetting.cut.sum()
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert len(texts) == len(KINDS)
    assert f"{100.0 * wet.menisci.meniscus_area_fraction:.3g} %" in texts[2]
