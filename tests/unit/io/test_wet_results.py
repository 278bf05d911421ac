"""Wet contacts are read back as they were written, and dry files say that they are dry."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import asperity as asp
from asperity.contact.wet_result import WET_SCALARS
from asperity.plots.contact import KINDS, plot_menisci


@pytest.fixture(scope="module")
def wet() -> asp.WetContactResult:
    heights = np.random.default_rng(3).normal(size=(24, 20)) * 1e-9
    problem = asp.ContactProblem(asp.Surface(heights, 10e-9), asp.Elastic(100e9, 0.3))
    film = asp.LiquidFilm(surface_tension=0.025, thickness=0.4e-9, meniscus_height=0.8e-9, viscosity=0.1)
    return asp.solve_wet(problem, asp.MeanPressure(1e8), film, friction=asp.Friction(0.2, 1e-3))


def test_a_wet_contact_is_read_back_whole(wet: asp.WetContactResult, tmp_path: Path) -> None:
    asp.save(wet, tmp_path / "wet.nc")
    found = asp.load(tmp_path / "wet.nc")
    for item in WET_SCALARS:
        assert getattr(found, item.name) == getattr(wet, item.name), item.name
    np.testing.assert_array_equal(found.wetting.menisci, wet.wetting.menisci)
    np.testing.assert_array_equal(found.contact.pressure, wet.contact.pressure)
    assert (found.film, found.control, found.status, found.rounds) == (wet.film, wet.control, wet.status, wet.rounds)
    assert found.citation_keys == wet.citation_keys
    data = asp.open_tree(tmp_path / "wet.nc")["film"].to_dataset()
    assert data["menisci"].dims == ("x", "y")
    assert data["meniscus_force"].attrs["units"] == "N"


def test_the_map_of_menisci_shows_every_kind(wet: asp.WetContactResult) -> None:
    from matplotlib.figure import Figure

    ax = plot_menisci(wet, Figure().add_subplot())
    (image,) = ax.get_images()
    drawn = np.asarray(image.get_array()).T
    assert (drawn == 3).sum() == wet.contact.contact.sum()
    assert (drawn == 2).sum() == wet.wetting.menisci.sum()
    assert (drawn >= 1).sum() == wet.wetting.cut.sum()
    texts = [text.get_text() for text in ax.get_legend().get_texts()]
    assert len(texts) == len(KINDS)
    assert f"{100.0 * wet.meniscus_area_fraction:.3g} %" in texts[2]
