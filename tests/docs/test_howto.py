"""A how-to is done with after two screens; what else there is to know stands under "Details"."""

from __future__ import annotations

import math
import re

import pytest
from doc_pages import BLOCK, DOCS

HOW_TO = DOCS / "how-to"
PAGES = sorted(path for path in HOW_TO.glob("*.md") if path.stem != "index")
SCREENS, WIDTH = 80, 100
"""Lines of two screens, and characters of a line."""
DETAILS = "## Details"


def lines(text: str) -> int:
    """Lines of ``text`` as they are shown, long ones broken at the width of a page."""
    return sum(max(1, math.ceil(len(line) / WIDTH)) for line in text.splitlines())


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_task_is_done_on_two_screens(page):
    text = page.read_text(encoding="utf-8")
    task, _, details = text.partition(f"\n{DETAILS}\n")
    assert lines(task) <= SCREENS, f"move what the task of {page.name} does not need below {DETAILS!r}"
    assert re.search(r"^[ ]*(```|\|)", task, re.MULTILINE), "nothing to copy, and no table, before the details"
    assert not re.search(r"^## ", BLOCK.sub("", details), re.MULTILINE), (
        "headings below the details are of the third level"
    )


def test_every_page_is_in_the_contents():
    listed = re.findall(r"\]\(([\w-]+)\.md\)", (HOW_TO / "index.md").read_text(encoding="utf-8"))
    assert sorted(listed) == [page.stem for page in PAGES]
