"""What holds for every page of validation: the claims of a smaller run hold, and the written page
is the script's."""

from __future__ import annotations

import re
from pathlib import Path

import summary
from page import Page

CLAIMS = "## Claims and checks\n"
NUMBER = re.compile(r"\d+(?:\.\d+)?")
SWEEPS = ("scan_size",)
"""Pages with claims for every size, of which a test takes a few."""


def written_page(name: str) -> str:
    """The page of the script ``name`` as it stands in validation/."""
    return (Path(summary.FOLDER) / f"{name}.md").read_text(encoding="utf-8")


def written_rows(name: str, after: str = "") -> list[list[str]]:
    """Cells of the tables of the written page below the line ``after``, rules between head and body
    left out."""
    text = written_page(name)
    lines = text[text.index(after) :].splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("| ")]


def assert_claims_hold(page: Page) -> None:
    assert page.claims
    assert [f"{one.text}: {one.found:g}, expected {one.expected}" for one in page.claims if not one.holds] == []


def assert_written_by_script(page: Page, name: str) -> None:
    """Title, words but for the numbers in them, claims in their order and published numbers; ours
    are those of a larger run."""
    written = written_page(name)
    assert written.startswith(f"# {page.title}\n")
    assert NUMBER.sub("#", page.about) in NUMBER.sub("#", written)
    rows = written[written.index(CLAIMS) :].splitlines()[4:]
    own = [row for row in rows if name not in SWEEPS or row.startswith(tuple(f"| {one.text} |" for one in page.claims))]
    for row, claim in zip(own, page.claims, strict=True):
        assert row.startswith(f"| {claim.text} |"), "run the script"
    assert [row for row in rows if not row.endswith("| yes |")] == []
    assert [one.what for one in page.published if f"| {' | '.join(one.cells[:3])} |" not in written] == []
