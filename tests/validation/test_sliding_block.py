"""The page on a sliding block: the statements of Martins, Oden and Simoes hold, and the page is the
script's."""

import pytest
import sliding_block
from validation_pages import assert_claims_hold, assert_written_by_script


@pytest.mark.slow
def test_what_is_claimed_holds():
    page = sliding_block.page()
    assert_claims_hold(page)
    assert_written_by_script(page, "sliding_block")
