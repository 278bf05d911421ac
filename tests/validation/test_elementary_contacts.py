"""The page on printed constants of elementary contacts: theirs and ours are near the closed forms, and it is the script's."""

from pathlib import Path

import elementary_contacts
import pytest
import summary

PAGE = Path(elementary_contacts.__file__).with_suffix(".md")
NUMBERS = summary.numbers("elementary_contacts", PAGE.read_text(encoding="utf-8"))


@pytest.mark.parametrize(("number", "exact"), list(zip(NUMBERS, elementary_contacts.EXACT, strict=True)))
def test_number_of_the_page_is_its_closed_form(number, exact):
    """Theirs but for the last digit, which some texts cut instead of rounding it; ours within the pixels and three digits."""
    digits = len(number.theirs.partition(".")[2])
    assert abs(float(number.theirs) - exact) < 10.0**-digits
    assert float(number.ours) == pytest.approx(exact, rel=0.0025 + 0.005)
    assert number.agrees


@pytest.mark.slow
def test_every_constant_is_found_on_coarser_grids_and_the_page_is_the_scripts():
    page, written = elementary_contacts.compare(points=97, strips=1025, waves=32), PAGE.read_text(encoding="utf-8")
    for claim in page.claims:
        assert claim.holds, f"{claim.text}: {claim.found:g}, expected {claim.expected}"
        assert f"| {claim.text} |" in written
    assert written.startswith(f"# {page.title}\n")
    assert "| NO |" not in written
    for one in page.published:
        source, what, theirs = one.cells[:3]
        assert f"| {source} | {what} | {theirs} |" in written
