"""What a finding advises, as a change of the document that was run, or as a page to choose on."""

from __future__ import annotations

from typing import Any

import pytest
from small_problem import PLAIN

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.core.words import ACTIONS
from asperity.run.document import checked
from asperity.web.layout import STEPS
from asperity.web.remedies import CHANGES, remedies

GRID = ((48, 32), (2e-6 / 48, 2e-6 / 32))


def of(text: str, table: dict[str, Any] = PLAIN) -> list[Any]:
    return list(remedies(text, table, *GRID))


@pytest.mark.parametrize("name", sorted(CHANGES))
def test_every_change_gives_a_valid_document_that_differs(name: str) -> None:
    table = PLAIN | ({"boundary": {"kind": "free"}} if name == "periodic" else {})
    (found,) = of(f"Do it ({{{name}}}).", table)
    assert found.words.startswith(ACTIONS[name].form)
    assert found.table != table
    checked(found.table)


@pytest.mark.parametrize("name", sorted(set(ACTIONS) - set(CHANGES)))
def test_what_must_be_chosen_leads_to_a_page(name: str) -> None:
    (found,) = of(f"Do it ({{{name}}}).")
    assert found.table is None
    assert found.page in STEPS


def test_each_is_offered_once_and_values_of_keys_are_set() -> None:
    found = of("Use {friction.coefficient=0.3} or {friction.coefficient=0.3}, {free}; see {braces}.")
    assert [item.table is None for item in found] == [False, False]
    assert found[0].table["friction"] == {"coefficient": 0.3}
    assert found[1].table["boundary"] == {"kind": "free"}
    assert PLAIN.keys() == {"version", "surface", "body", "control"}


def test_a_grid_is_refined_in_one_step_and_not_without_end() -> None:
    (once,) = of("{resample}")
    assert once.table["surface"]["prepare"] == [{"step": "resample", "points": [96, 64]}]
    (twice,) = remedies("{resample}", once.table, (96, 64), GRID[1])
    assert twice.table["surface"]["prepare"] == [{"step": "resample", "points": [192, 128]}]
    (large,) = remedies("{resample}", PLAIN, (4096, 4096), GRID[1])
    assert (large.table, large.page) == (None, "prepare")


def test_what_is_so_already_is_not_offered_to_be_applied() -> None:
    (found,) = of("{free}", PLAIN | {"boundary": {"kind": "free"}})
    assert found.table is None
