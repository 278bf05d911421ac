"""The search finds the how-to of a task first; ``make docs`` holds that of the whole site."""

from __future__ import annotations

import json
import subprocess

import assemble
import pytest
import search

pytestmark = pytest.mark.skipif(not search.can_run(), reason="Node.js is not installed, which runs the search")

SCORER = assemble.HERE / "scorer.js"


def order(query: str, *results: tuple[str, str, float, str]) -> list[str]:
    """Pages of ``results`` (page, title, Sphinx's score, kind) for ``query``, best first."""
    listed = [[page, title, "", None, score, page, kind] for page, title, score, kind in results]
    script = f"""
        const window = {{ location: {{ search: "?q=" + encodeURIComponent({json.dumps(query)}) }} }};
        {SCORER.read_text(encoding="utf-8")}
        const found = {json.dumps(listed)};
        console.log(JSON.stringify(found.map((one) => Scorer.score(one))));
    """
    answer = subprocess.run(["node", "-e", script], capture_output=True, text=True, check=True).stdout
    scores = json.loads(answer)
    return [page for _, page in sorted(zip(scores, (page for page, *_ in results), strict=True), reverse=True)]


def test_the_text_of_a_how_to_comes_before_headings_elsewhere():
    found = order(
        "humidity",
        ("reference/theories", "All theories", 15, "text"),
        ("theory/wet-contact", "Liquid films", 15, "text"),
        ("reference/api/menisci", "asperity.menisci.humidity", 16, "object"),
        ("validation/humidity", "Menisci and humidity", 15, "text"),
        ("how-to/wet-contact", "Contact with a liquid film", 5, "text"),
    )
    assert found[0] == "how-to/wet-contact"


def test_of_two_how_to_the_one_with_the_words_in_its_title_comes_first():
    found = order(
        "roughness",
        ("how-to/rolling", "Rolling", 15, "text"),
        ("how-to/roughness", "Measure the roughness of a surface", 15, "text"),
        ("how-to/wet-contact", "Contact with a liquid film", 15, "text"),
    )
    assert found[0] == "how-to/roughness"


def test_a_name_that_cannot_be_meant_otherwise_comes_before_text():
    found = order(
        "ContactProblem",
        ("how-to/adhesion", "Adhesive contact: approach, hold, part", 5, "text"),
        ("reference/api/contact", "asperity.contact.ContactProblem", 16, "object"),
    )
    assert found[0] == "reference/api/contact"
