"""The page on adhesion: a smaller run keeps its claims, and the page is the script's."""

import adhesion
import pytest
from validation_pages import assert_claims_hold, assert_written_by_script


@pytest.mark.slow
def test_what_is_claimed_holds():
    small = adhesion.page(((0.4, 96, 5.0), (1.0, 96, 5.0)), (0.4,), 512, adhesion.COATED[:1], 160)
    assert_claims_hold(small)


def test_the_page_is_the_scripts(monkeypatch):
    monkeypatch.setattr(adhesion, "sphere", lambda transition, points, least: (1.5, 1.5, 10.0))
    monkeypatch.setattr(adhesion, "wave", lambda alpha, points: (0.1, 0.1))
    monkeypatch.setattr(adhesion, "coating", lambda row, points: (0.1, 0.1))
    assert_written_by_script(adhesion.page(), "adhesion")
