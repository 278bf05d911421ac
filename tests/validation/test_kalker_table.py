"""The page on Kalker's coefficients: a smaller run keeps its claim, and the page is the
script's."""

import kalker_table
import numpy as np
import pytest
from validation_pages import assert_claims_hold, assert_written_by_script

from asperity.theories import kalker_coefficients
from asperity.theories.friction.kalker import COMPUTED, RATIOS


@pytest.mark.slow
def test_what_is_claimed_holds(monkeypatch):
    monkeypatch.setattr(kalker_table, "PUBLISHED", {(1.0, 0.25): kalker_table.PUBLISHED[1.0, 0.25]})
    assert_claims_hold(kalker_table.page((40, 56, 80, 112)))


@pytest.mark.slow
@pytest.mark.parametrize(("nu", "place"), [(0.0, 6), (0.25, 13), (0.5, 9)])
def test_rows_that_are_ours(nu, place):
    """By smaller grids, within what other fits differ by."""
    assert place in COMPUTED[nu]
    found = kalker_table.extrapolated(RATIOS[place], nu, (40, 56, 80, 112))[0]
    table = kalker_coefficients(RATIOS[place], nu)
    assert found[:3] == pytest.approx([table.C11, table.C22, table.C23], rel=0.005)
    assert found[3] == pytest.approx(table.C33, rel=0.01)


def test_the_page_is_the_scripts(monkeypatch):
    """With the published numbers in the place of ours."""
    monkeypatch.setattr(
        kalker_table,
        "coefficients",
        lambda ratio, nu, pixels: kalker_table.PUBLISHED[ratio, nu] * np.ones(4),
    )
    page = kalker_table.page()
    assert_written_by_script(page, "kalker_table")
    assert len(page.published) == 68
