"""Pages on the contact of the gold film, on fewer surfaces and points: all claims hold, and they
belong to their scripts."""

from __future__ import annotations

from functools import cache

import gold_film_area
import gold_film_grid
import numpy as np
import pytest
from study_cases import InProcess
from validation_pages import assert_claims_hold, assert_written_by_script

import asperity as asp
from asperity.studies.campaign import prepare_study
from asperity.studies.run import carry_out

RUNS = {
    "gold_film_area": lambda: gold_film_area.page(surfaces=3, films=2, points=128),
    "gold_film_grid": lambda: gold_film_grid.page(finest=256),
}


def run_here(study, folder):
    """``run_study`` without the start of worker processes."""
    campaign = prepare_study(study, folder)
    assert carry_out(campaign.plan, campaign.records, InProcess()).failed == 0
    return campaign


@cache
def page_of(name):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(asp.studies, "run_study", run_here)
        return RUNS[name]()


@pytest.mark.parametrize("name", RUNS)
def test_every_claim_holds(name):
    assert len(page_of(name).claims) >= 8
    assert_claims_hold(page_of(name))


@pytest.mark.parametrize("name", RUNS)
def test_page_belongs_to_the_script(name):
    assert_written_by_script(page_of(name), name)


def test_the_area_of_the_page_is_that_of_a_contact_of_its_own(tmp_path):
    """The study at one of its loads against one solve of the surface with its seed, to the default
    tolerance."""
    campaign = run_here(gold_film_area.study(1, 64), tmp_path / "study")
    data = campaign.dataset().isel(sample=0, load=5)
    shape = gold_film_area.spectrum(asp.generate.RmsHeight(gold_film_area.RMS))
    grid = asp.Grid((64, 64), (gold_film_area.SIDE / 64,) * 2)
    surface = asp.generate.gaussian(grid, shape, seed=int(data["seed"]))
    alone = asp.solve(
        asp.ContactProblem(surface, asp.Elastic(gold_film_area.E_STAR, 0.0)), asp.MeanPressure(float(data["load"]))
    )
    # a pixel may go either way at the looser tolerance of the study, and 64² points are 4096
    assert float(data["area_fraction"]) == pytest.approx(alone.area_fraction, abs=1.5 / 4096)
    assert float(data["mean_gap"]) == pytest.approx(alone.mean_gap, rel=3.0 * 1e-5**0.5)


def test_gradient_of_the_surfaces_is_that_of_the_spectrum():
    """512² points show the waves down to two pixels and, in the corners, some beyond: between the
    integrals to both."""
    ratio = gold_film_area.RMS**2 / gold_film_area.MODEL.moments(1e-10, gold_film_area.SIDE)[0]
    below, above = (
        np.sqrt(2.0 * ratio * gold_film_area.MODEL.moments(2.0 * pixel, gold_film_area.SIDE)[1])
        for pixel in (gold_film_area.SIDE / 512, gold_film_area.SIDE / 512 / np.sqrt(2.0))
    )
    assert 0.999 * below < gold_film_area.gradient(512) < 1.001 * above
