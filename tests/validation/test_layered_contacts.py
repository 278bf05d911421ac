"""Every page of validation on layered solids, on smaller grids: the stated agreement holds and the page is up to date."""

from dataclasses import replace
from pathlib import Path

import cylinder_on_layer
import influence_coefficient
import pytest
import sphere_on_layer

FOLDER = Path(sphere_on_layer.__file__).parent
RUNS = {
    "sphere_on_layer": lambda: sphere_on_layer.compare(pixels=97),
    "cylinder_on_layer": lambda: cylinder_on_layer.compare(pixels=513),
    "influence_coefficient": influence_coefficient.compare,
}


@pytest.mark.parametrize("name", RUNS)
def test_agreement(name):
    comparison = RUNS[name]()
    for quantity, bound in zip(comparison.quantities, comparison.agreement, strict=True):
        assert comparison.worst(quantity) <= bound, quantity
    assert comparison.agrees


@pytest.mark.parametrize("name", RUNS)
def test_page_belongs_to_the_script(name):
    """Title, text of the table's head and their numbers; ours are those of the finer grid."""
    comparison, page = RUNS[name](), (FOLDER / f"{name}.md").read_text(encoding="utf-8")
    lines = page.splitlines()
    assert lines[0] == f"# {comparison.title}"
    assert "DISAGREES" not in page
    table = [line for line in lines if line.startswith("| ")]
    for line, (cases, pairs) in zip(table[1 : 1 + len(comparison.rows)], comparison.rows, strict=True):
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        assert tuple(cells[: len(cases)]) == cases
        assert cells[len(cases) + 1 :: 2] == [f"{pair.theirs:.{comparison.digits}f}" for pair in pairs]


def test_a_disagreement_is_told():
    wrong = influence_coefficient.compare()
    cases, pairs = wrong.rows[0]
    spoiled = type(pairs[0])(pairs[0].ours * 1.001, pairs[0].theirs)
    assert not replace(wrong, rows=((cases, (spoiled, *pairs[1:])), *wrong.rows[1:])).agrees
