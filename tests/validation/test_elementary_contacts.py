"""The page on printed constants of elementary contacts: theirs and ours are near the closed forms,
and it is the script's."""

import elementary_contacts
import pytest
import summary
from validation_pages import assert_claims_hold, assert_written_by_script, written_page

NUMBERS = summary.numbers("elementary_contacts", written_page("elementary_contacts"))


@pytest.mark.parametrize(("number", "exact"), list(zip(NUMBERS, elementary_contacts.EXACT, strict=True)))
def test_number_of_the_page_is_its_closed_form(number, exact):
    """Theirs but for the last digit, which some texts cut instead of rounding it; ours within the
    pixels and three digits."""
    digits = len(number.theirs.partition(".")[2])
    assert abs(float(number.theirs) - exact) < 10.0**-digits
    assert float(number.ours) == pytest.approx(exact, rel=0.0025 + 0.005)
    assert number.agrees


@pytest.mark.slow
def test_every_constant_is_found_on_coarser_grids_and_the_page_is_the_scripts():
    page = elementary_contacts.compare(points=97, strips=1025, waves=32)
    assert_claims_hold(page)
    assert_written_by_script(page, "elementary_contacts")
