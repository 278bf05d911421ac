"""Pages of validation on the review of Bhushan (1998), on fewer surfaces, points, films and humidities: all their claims hold, and they are the scripts'."""

from __future__ import annotations

from functools import cache
from pathlib import Path

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

FOLDER = Path(bhushan_film.__file__).parent
RUNS = {
    "bhushan_sphere": lambda: bhushan_sphere.compare(points=97, count=1),
    "bhushan_statistics": lambda: bhushan_statistics.compare((10e3,)),
    "bhushan_dry": lambda: bhushan_dry.compare(count=6, stressed=2),
    "bhushan_summits": bhushan_summits.compare,
    "bhushan_film": lambda: bhushan_film.compare(2, (1e-9, 2e-9), (0.5e-9, 1e-9, 2e-9)),
    "bhushan_humidity": lambda: bhushan_humidity.compare(3, (0.5, 0.8, 0.9, 0.95)),
    "bhushan_heights": lambda: bhushan_heights.compare(6, loads=(bhushan_heights.LOAD,)),
}
LONG = {"bhushan_heights", "bhushan_sphere"}


@cache
def page_of(name):
    return RUNS[name]()


def names():
    return [pytest.param(name, marks=[pytest.mark.slow] if name in LONG else []) for name in RUNS]


@pytest.mark.parametrize("name", names())
def test_every_claim_holds(name):
    page = page_of(name)
    assert page.claims
    for claim in page.claims:
        assert claim.holds, f"{claim.text}: {claim.found:g}, expected {claim.expected}"


@pytest.mark.parametrize("name", names())
def test_page_belongs_to_the_script(name):
    """Title and claims; numbers are those of more surfaces."""
    page, written = page_of(name), (FOLDER / f"{name}.md").read_text(encoding="utf-8")
    assert written.startswith(f"# {page.title}\n")
    claims = written[written.index("## Claims and checks") :]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in claims.splitlines() if line[:2] == "| "]
    assert [row[0] for row in rows[1:]] == [claim.text for claim in page.claims]
    assert {row[-1] for row in rows[1:]} == {"yes"}


def test_forces_that_run_away_are_told_and_not_averaged():
    assert shown(np.array([1.0, np.inf, 2.0])) == "1 of 3 run away"
    assert shown(np.array([1.0, 2.0, 3.0])) == "2 ± 1"
