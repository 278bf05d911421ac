"""The page of plastic indentation, on coarser meshes: what it claims holds, and the page is that of the script."""

import plastic_indentation
from validation_pages import assert_claims_hold, assert_written_by_script


def test_balls_on_plastic_solids():
    page = plastic_indentation.compare(across=10)
    assert_claims_hold(page)
    assert_written_by_script(page, "plastic_indentation")
