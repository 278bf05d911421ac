"""The paper quotes benchmarks and validation as they stand, and its sources are those of the
package."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from asperity.core.citations import REFERENCES
from asperity.theories import THEORIES

ROOT = Path(__file__).parents[2]
PAPER = (ROOT / "paper/paper.md").read_text(encoding="utf-8")
BIBLIOGRAPHY = (ROOT / "paper/paper.bib").read_text(encoding="utf-8")
RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")


def numbers(text: str) -> list[float]:
    """Numbers of a text in the order they stand; powers of ten in TeX, in raised digits or after an
    e."""
    plain = re.sub(r"10\^\{?(-?\d+)\}?", r"1e\1", text.replace(r"\cdot10", "·10"))
    plain = re.sub(r"·1e", "e", plain)
    plain = re.sub(r"10([⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda m: f"1e{m[1].translate(RAISED)}", plain)
    return [float(found) for found in re.findall(r"\d+(?:\.\d+)?(?:e-?\d+)?", plain)]


def test_every_figure_stands_in_its_source():
    quoted = re.findall(r"(\S+(?: s)?)<!-- (\S+): (.+?) -->", PAPER, re.DOTALL)
    assert len(quoted) > 15
    for shown, source, words in quoted:
        assert words in (ROOT / source).read_text(encoding="utf-8"), f"{source} does not hold {words!r} any more"
        assert numbers(shown)[-1] in numbers(words), f"{shown} is not in {words!r}"


def test_numbers_of_benchmarks_and_validation_all_have_a_source():
    """Sentences of these sections hold no other decimal fractions than quoted ones and the
    loads."""
    part = PAPER.split("# Benchmarks\n")[1].split("# Acknowledgements")[0]
    left = re.sub(r"\S+(?: s)?<!-- .+? -->", "", part, flags=re.DOTALL)
    assert set(re.findall(r"\d+\.\d+", left)) == {"0.01", "0.05", "0.2"}


def test_the_catalogue_has_as_many_theories() -> None:
    (count,) = re.findall(r"a catalogue of (\d+)\s+theories", PAPER)
    assert int(count) == len(THEORIES)


@pytest.mark.parametrize("page", ["README.md", "docs/start/features.md"])
def test_speeds_are_compared_as_measured(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    of_packages = {"ASPHER": "packages", "Tamaas": "packages-one-thread", "ContactMechanics": "packages-one-thread"}
    for name, table in of_packages.items():
        stored = json.loads((ROOT / f"benchmarks/results/{table}.json").read_text(encoding="utf-8"))
        rows = [dict(zip(stored["columns"], row, strict=True)) for row in stored["rows"]]
        ratios = [float(row["× ours"]) for row in rows if (row["n"], row["solver"]) == ("1024", name)]
        (shown,) = re.findall(rf"([\d.]+) to ([\d.]+) times\s+faster\s+than\s+{name}", text)
        assert len(ratios) == 3
        assert [float(end) for end in shown] == pytest.approx([min(ratios), max(ratios)], rel=0.01)


def test_the_bibliography_is_complete_and_agrees_with_the_citations_of_the_package():
    cited = set(re.findall(r"@([A-Z]\w+)", PAPER))
    entries = dict(re.findall(r"^@\w+\{(\w+),\n(.*?)^\}", BIBLIOGRAPHY, re.MULTILINE | re.DOTALL))
    assert cited == set(entries)
    for key in cited & set(REFERENCES):
        title, year = (re.search(rf"{name} = \{{(.+)\}}", entries[key])[1] for name in ("title", "year"))
        assert title in REFERENCES[key]
        assert f"({year})" in REFERENCES[key]


def test_the_form_is_that_of_the_journal():
    head, body = re.fullmatch(r"---\n(.*?)\n---\n(.*)", PAPER, re.DOTALL).groups()
    for field in ("title", "tags", "authors", "affiliations", "date", "bibliography"):
        assert re.search(rf"^{field}:", head, re.MULTILINE)
    cff = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert re.findall(r"- name: \"?([^\"\n]+?)\"?\n\s+affiliation", head) == re.findall(
        r"^  - name: \"([^\"]+)\"", cff, re.MULTILINE
    )
    for heading in ("Summary", "Statement of need", "State of the field", "References"):
        assert f"\n# {heading}\n" in body
    words = len(re.sub(r"<!--.*?-->", "", body, flags=re.DOTALL).split())
    assert 750 <= words <= 1750
