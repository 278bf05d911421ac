"""Pages of validation on the review of Bhushan (1998), on fewer surfaces, points, films and
humidities: all their claims hold, and they are the scripts'."""

from __future__ import annotations

from functools import cache

import bhushan_dry
import bhushan_film
import bhushan_heights
import bhushan_humidity
import bhushan_sphere
import bhushan_statistics
import bhushan_summits
import numpy as np
import pytest
from bhushan import shown
from validation_pages import assert_claims_hold, assert_written_by_script, written_page

from asperity.theories.rough.greenwood_williamson import separation_at_plastic_onset

CLAIMED = ((0.0, 3.0), (0.2, 3.0), (0.5, 3.0), (0.0, 5.0), (0.0, 10.0))
"""Skewness and kurtosis of the surfaces that the claims are about."""

RUNS = {
    "bhushan_sphere": lambda: bhushan_sphere.compare(points=97, count=1),
    "bhushan_statistics": lambda: bhushan_statistics.compare((10e3,)),
    "bhushan_dry": lambda: bhushan_dry.compare(count=6, stressed=2),
    "bhushan_summits": bhushan_summits.compare,
    "bhushan_film": lambda: bhushan_film.compare(2, (1e-9, 2e-9), (0.5e-9, 1e-9, 2e-9)),
    "bhushan_humidity": lambda: bhushan_humidity.compare(3, (0.5, 0.8, 0.9, 0.95)),
    "bhushan_heights": lambda: bhushan_heights.compare(6, shapes=CLAIMED, loads=(bhushan_heights.LOAD,)),
}
LONG = {"bhushan_dry", "bhushan_heights", "bhushan_sphere", "bhushan_statistics"}


@cache
def page_of(name):
    return RUNS[name]()


def names():
    return [pytest.param(name, marks=[pytest.mark.slow] if name in LONG else []) for name in RUNS]


@pytest.mark.parametrize("name", names())
def test_every_claim_holds(name):
    assert_claims_hold(page_of(name))


@pytest.mark.parametrize("name", names())
def test_page_belongs_to_the_script(name):
    assert_written_by_script(page_of(name), name)


@pytest.mark.slow
def test_deterministic_numbers_are_those_of_the_page():
    """Integrals, indices and constants do not depend on the number of surfaces."""
    written = written_page("bhushan_statistics")
    published = page_of("bhushan_statistics").published
    assert len(published) == 21
    for one in published:
        assert f"| {' | '.join(one.cells)} |" in written


def test_constants_for_exponential_heights_do_not_depend_on_the_separation():
    near, far = ([one.ours for one in bhushan_statistics._exponential(D)] for D in (0.2, 4.0))
    assert near == pytest.approx(far, rel=1e-7)
    assert near == pytest.approx([1.0 / np.sqrt(np.pi), 1.0 / np.sqrt(np.pi), np.pi], rel=1e-7)


def test_index_of_elastic_contact_is_that_whose_onset_is_at_the_mean_summit():
    """The root that the theory finds in D for given ψ, beside the page's in ψ for given D."""
    index = next(one.ours for one in bhushan_statistics._plastic() if one.theirs == "0.6")
    assert separation_at_plastic_onset(index) == pytest.approx(0.0, abs=1e-4)


def test_sphere_beyond_first_yield_bears_the_load_that_is_asked():
    """Mean pressure and contact radius over those at first yield, as found on the page, make 300
    times its load."""
    onset = 1.0752
    mean, radius = (one.ours for one in list(bhushan_sphere._plastic(onset))[-2:])
    assert mean / onset * radius**2 == pytest.approx(bhushan_sphere.KRAL_LOAD, rel=2e-3)


def test_forces_that_run_away_are_told_and_not_averaged():
    assert shown(np.array([1.0, np.inf, 2.0])) == "1 of 3 run away"
    assert shown(np.array([1.0, 2.0, 3.0])) == "2 ± 1"
