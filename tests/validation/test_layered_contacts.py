"""Every page of validation on layered solids, on smaller grids: the stated agreement holds and the
page is up to date."""

from dataclasses import replace

import cylinder_on_layer
import influence_coefficient
import layered_sphere_profiles
import layered_sphere_stress
import peng_patch_stress
import pytest
import sphere_on_layer
from validation_pages import assert_claims_hold, assert_written_by_script, written_page, written_rows

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
    comparison, page = RUNS[name](), written_page(name)
    assert page.startswith(f"# {comparison.title}\n")
    assert "DISAGREES" not in page
    table = written_rows(name)[1 : 1 + len(comparison.rows)]
    for cells, (cases, pairs) in zip(table, comparison.rows, strict=True):
        assert tuple(cells[: len(cases)]) == cases
        assert cells[len(cases) + 1 :: 2] == [f"{pair.independent:.{comparison.digits}f}" for pair in pairs]


def test_a_disagreement_is_told():
    wrong = influence_coefficient.compare()
    cases, pairs = wrong.rows[0]
    spoiled = type(pairs[0])(pairs[0].ours * 1.001, pairs[0].independent)
    assert not replace(wrong, rows=((cases, (spoiled, *pairs[1:])), *wrong.rows[1:])).agrees


STRESSES = {
    "layered_sphere_stress": lambda: layered_sphere_stress.compare(pixels=65),
    "peng_patch_stress": lambda: peng_patch_stress.compare(points=35),
}


@pytest.mark.slow  # about 10 s each
@pytest.mark.parametrize("name", STRESSES)
def test_stresses_agree_and_the_page_belongs_to_the_script(name):
    """On a coarser grid the cusp at the edge is rounded off more: the numbers of sliding contacts
    are not asked of it."""
    page = STRESSES[name]()
    assert_claims_hold(replace(page, claims=tuple(one for one in page.claims if not one.text.startswith("numbers of"))))
    assert [one.what for one in page.published if not one.kept and not one.what.endswith("0.5")] == []
    assert_written_by_script(page, name)


@pytest.mark.slow  # five contacts and their stresses, 40 s
def test_profiles_of_pressure_and_stress_agree_and_the_page_belongs_to_the_script():
    page = layered_sphere_profiles.compare(across=24)
    assert_claims_hold(page)
    assert_written_by_script(page, "layered_sphere_profiles")
