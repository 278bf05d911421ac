"""What a complete document would be refused for is known before its surface is made, and by the
table that it is about."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from small_problem import PLAIN

import asperity as asp
from asperity.core.errors import InputError
from asperity.core.words import speaking
from asperity.run.refusals import refusals

REFUSED: dict[str, dict[str, Any]] = {
    "plastic_flow": {"plastic_flow": {}},
    "law": {"law": {"kind": "hardness", "hardness": "from body"}},
    "rolling": {"rolling": {"longitudinal": 0.001}},
    "shear": {"shear": {"shift": "1 nm"}},
    "stress": {"stress": {"step": 3}},
    "hysteresis": {"hysteresis": {"speed": "1 m/s"}},
    "body": {"body": {"material": "unobtainium"}},
}


@pytest.mark.parametrize("place", REFUSED)
def test_the_refusal_is_that_of_the_run_and_names_its_table(place: str) -> None:
    with pytest.raises(InputError) as error:
        asp.run(PLAIN | REFUSED[place])
    (found,) = refusals(PLAIN | REFUSED[place], Path())
    assert found.place == error.value.place == place
    assert found.text == str(error.value)


def test_they_are_said_in_words_of_the_form() -> None:
    with speaking("form"):
        (found,) = refusals(PLAIN | REFUSED["plastic_flow"], Path())
    assert "Bodies: Yield stress" in found.text


def test_what_is_not_refused_and_no_file_is_read() -> None:
    assert refusals(PLAIN, Path()) == ()
    counter = {"kind": "file", "path": "nowhere.txt", "prepare": [{"step": "slice", "y": "middle"}]}
    measured = PLAIN | {"surface": {"kind": "file", "path": "nowhere.txt"}, "stress": {"sections": ["x=5um"]}}
    assert refusals(measured, Path()) == ()
    assert refusals(PLAIN | {"surface": counter, "boundary": {"kind": "line"}}, Path()) == ()


def test_positions_are_compared_with_the_size_that_is_stated() -> None:
    assert refusals(PLAIN | {"stress": {"sections": ["x=1um"]}}, Path()) == ()
    assert [item.place for item in refusals(PLAIN | {"stress": {"sections": ["x=5um"]}}, Path())] == ["stress"]


def test_an_incomplete_document_is_no_refusal_of_a_part() -> None:
    with pytest.raises(InputError):
        refusals({"version": 2}, Path())
