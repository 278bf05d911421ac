"""The page on loops, torsion and rolling: memory and fields give the printed formulas, and the page
is the script's."""

import pytest
import tangential_loops
from validation_pages import assert_claims_hold, assert_written_by_script


def test_what_is_claimed_holds():
    page = tangential_loops.page()
    assert_claims_hold(page)
    assert_written_by_script(page, "tangential_loops")
    assert all(number.kept for number in page.published)


def test_the_printed_loop_at_gross_sliding_is_a_rectangle_less_its_corners():
    """At Q₀ = μP the formula is 4/5: the loop at the onset of sliding."""
    assert tangential_loops.loop(1.0) == pytest.approx(0.8)
