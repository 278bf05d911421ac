"""The page on viscoelasticity: a smaller run keeps its claims, and the page is the script's."""

import pytest
import viscoelastic
from validation_pages import assert_claims_hold, assert_written_by_script


@pytest.mark.slow
def test_what_is_claimed_holds():
    assert_claims_hold(viscoelastic.page(48, 256))


def test_the_page_is_the_scripts(monkeypatch):
    monkeypatch.setattr(viscoelastic, "creeping", lambda *_: [(1.0, 1.0, 1.0)])
    monkeypatch.setattr(viscoelastic, "relaxed", lambda *_: [(1.0, 1.0, 1.0)])
    monkeypatch.setattr(viscoelastic, "triangle", lambda *_: (0.0, 1.4, 1.6, 1.5))
    monkeypatch.setattr(viscoelastic, "punch", lambda *_: [(1.0, 1.0, 1.0)])
    monkeypatch.setattr(viscoelastic, "wave", lambda row, points: row[2:])
    monkeypatch.setattr(viscoelastic, "friction", lambda row: row[1:3])
    assert_written_by_script(viscoelastic.page(), "viscoelastic")
