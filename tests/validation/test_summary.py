"""The page of all pages: numbers are found in tables and claims, judged as stated, and the page is
that of the pages as they are."""

import pytest
import summary
from page import Claim, Page, Published

TABLE = """
| case | area: ours | theirs | z | pressure: theirs | ours | number: ours | independent |
|---|---|---|---|---|---|---|---|
| a | 1.02 ± 0.02 | 1.00 | 0 | 2.0 | 2.3 | 4 | 4 |
| b | 1.30 | – | 0 | −0.5 | -0.49 | 4 | 4 |
"""


def test_numbers_of_tables():
    found = [(one.case, one.theirs, one.ours, one.verdict) for one in summary.numbers("page", TABLE)]
    assert found == [
        ("case = a, area", "1.00", "1.02 ± 0.02", "within the scatter of one surface"),
        ("case = a, pressure", "2.0", "2.3", "near"),
        ("case = b, pressure", "−0.5", "-0.49", "agrees"),
    ]


def test_numbers_of_claims():
    text = Page(
        "t", "a", (), (Claim("points, within two standard deviations of ours", 1570.0, 1550.0, 1670.0),)
    ).markdown()
    (number,) = summary.numbers("page", text)
    assert (number.case, number.theirs, number.ours) == ("points", "1570", "1.61e+03 ± 30")
    assert number.agrees


@pytest.mark.parametrize(
    ("theirs", "ours", "verdict"),
    [
        ("0.30", "0.304", "agrees"),
        ("2.0", "2.3", "near"),
        ("1", "1.9", "differs"),
        ("1", "1.4 ± 0.25", "within the scatter of one surface"),
    ],
)
def test_verdicts(theirs, ours, verdict):
    assert summary.Number("page", "case", theirs, ours).verdict == verdict


def test_published_numbers_of_a_page_are_found():
    one = Published("a book", "largest stress", "0.55", 0.5297, within=0.05)
    assert one.agrees
    (number,) = summary.numbers("page", Page("t", "a", (), (), (one,)).markdown())
    assert (number.theirs, number.ours, number.verdict) == ("0.55", "0.53", "agrees")


def test_the_written_page_is_that_of_the_pages():
    written = (summary.FOLDER / "README.md").read_text(encoding="utf-8")
    assert written == summary.readme(), "run python validation/summary.py"
    names = {path.stem for path in summary.FOLDER.glob("*.md")} - {"README"}
    assert all(f"| [{name}]({name}.md) |" in written for name in names)
