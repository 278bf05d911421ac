"""The page of all pages: numbers are found in tables and claims, judged as stated, and the page is
that of the pages as they are."""

import pytest
import summary
from page import Page, Published, verdict_of
from validation_pages import written_page

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


@pytest.mark.parametrize(
    ("theirs", "ours", "verdict"),
    [
        ("−6.5", "-6.3 ± 0.11", "within the scatter of one surface"),
        ("0.30", "0.304", "agrees"),
        ("2.0", "2.3", "near"),
        ("1", "1.9", "differs"),
        ("1", "1.4 ± 0.25", "within the scatter of one surface"),
    ],
)
def test_verdicts(theirs, ours, verdict):
    assert summary.Number("page", "source", "case", theirs, ours).verdict == verdict


@pytest.mark.parametrize(
    ("theirs", "ours", "spread", "verdict"),
    [
        ("100", 105.0, 0.0, "agrees"),
        ("100", 105.1, 0.0, "near"),
        ("100", 120.1, 0.0, "differs"),
        ("100", 140.0, 20.0, "within the scatter of one surface"),
        ("2", 2.4, 0.0, "agrees"),  # rounds to 2
        ("3.0e-5", 3.2e-5, 0.0, "near"),
    ],
)
def test_one_rule_judges(theirs, ours, spread, verdict):
    assert verdict_of(theirs, ours, spread) == verdict
    one = Published("a book", "a number", theirs, ours, spread=spread)
    (number,) = summary.numbers("page", Page("t", "a", (), (), (one,)).markdown())
    assert one.verdict == number.verdict == verdict
    assert one.agrees is number.agrees is (verdict not in ("near", "differs"))


def test_a_bound_of_a_page_is_kept_or_not():
    assert Published("a book", "largest stress", "0.55", 0.5297, within=0.05).kept
    assert not Published("a book", "largest stress", "0.55", 0.5297).kept


def test_published_numbers_of_a_page_are_found():
    one = Published("a book, fig. 3, after a paper 1999", "stress", "0.55", 0.53, rests_on="load", shared="film")
    other = Published("One, Two & Three 1999, fig. 4", "stress", "0.57", 0.53)
    found = summary.numbers("page", Page("t", "a", (), (), (one, other)).markdown())
    assert [(one.work, one.theirs, one.ours, one.rests_on, one.shared) for one in found] == [
        ("a paper 1999", "0.55", "0.53", "load", "film"),
        ("One, Two & Three 1999", "0.57", "0.53", "", ""),
    ]


def number(verdict, rests_on="", shared=""):
    return summary.Number("page", "a book", "a number", "1", "1", verdict, "0 %", rests_on, shared)


def test_what_is_shared_counts_once_with_the_worst_verdict():
    several = [number("agrees", shared="film"), number("near", shared="film"), number("agrees", shared="film")]
    assert summary.Tally.of([*several, number("agrees")]) == summary.Tally(2, 1, 1, 0, 0)


def test_what_rests_on_a_choice_is_no_test():
    chosen = [number("differs", "load"), number("agrees", "load", "film"), number("agrees", shared="film")]
    assert summary.Tally.of(chosen) == summary.Tally(2, 1, 0, 0, 1)
    assert summary.Tally.of(chosen).whole
    assert not summary.Tally.of(chosen[:1]).whole


def test_a_surface_of_34_cases_is_one_number():
    rows = summary.numbers("peng_table_3_1", written_page("peng_table_3_1"))
    assert len(rows) == 68
    assert summary.Tally.of(rows) == summary.Tally(1, 1, 0, 0, 0)
    again = summary.numbers("peng_load", written_page("peng_load"))
    assert summary.Tally.of([*rows, *again]) == summary.Tally(1, 1, 0, 0, 0)


def test_the_written_page_is_that_of_the_pages():
    written = (summary.FOLDER / "README.md").read_text(encoding="utf-8")
    assert written == summary.readme(), "run python validation/summary.py"
    names = {path.stem for path in summary.FOLDER.glob("*.md")} - {"README"}
    assert all(f"| [{name}]({name}.md) |" in written for name in names)
