"""The page on Kalker's coefficients: a smaller run keeps its claim, and the page is the script's."""

import kalker_table
import pytest
from validation_pages import assert_claims_hold, assert_written_by_script


@pytest.mark.slow
def test_what_is_claimed_holds(monkeypatch):
    monkeypatch.setattr(kalker_table, "PUBLISHED", {(1.0, 0.25): kalker_table.PUBLISHED[1.0, 0.25]})
    assert_claims_hold(kalker_table.page((32, 64)))


def test_the_page_is_the_scripts(monkeypatch):
    """With the published numbers in the place of ours."""
    monkeypatch.setattr(
        kalker_table,
        "coefficients",
        lambda ratio, nu, pixels: kalker_table.PUBLISHED[ratio, nu] * kalker_table.np.ones(4),
    )
    page = kalker_table.page()
    assert_written_by_script(page, "kalker_table")
    assert len(page.published) == 16
