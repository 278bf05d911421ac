"""The page on the punch that sticks: displacements alone give the closed form, and the page is the
script's."""

from pathlib import Path

import pytest
import sticking_punch
import summary

PAGE = Path(sticking_punch.__file__).with_suffix(".md")


def test_gain_is_found_from_displacements_and_the_page_is_the_scripts():
    page, written = sticking_punch.compare(points=32), PAGE.read_text(encoding="utf-8")
    assert written.startswith(f"# {page.title}\n")
    assert "| NO |" not in written
    for claim in page.claims:
        assert claim.holds, f"{claim.text}: {claim.found:g}, expected {claim.expected}"
        assert f"| {claim.text} |" in written


@pytest.mark.parametrize(("number", "exact"), [(0, 1.0986122886681096), (1, 1.0286266635787082)])
def test_numbers_of_the_page(number, exact):
    """ln 3 on a body of ν = 0; both from 40 digits."""
    found = summary.numbers("sticking_punch", PAGE.read_text(encoding="utf-8"))[number]
    assert float(found.theirs) == pytest.approx(exact, abs=5.1e-5)
    assert found.agrees
