"""Files of format 2 are read to the bit, as the version that wrote them read them; tests/reference/files-v2/README.md says how they were made."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from stored_cases import CASES, told

import asperity as asp

FOLDER = Path(__file__).parents[2] / "reference" / "files-v2"
FACTS = json.loads((FOLDER / "facts.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", CASES)
def test_every_type_of_result(name: str) -> None:
    found = told(asp.load(FOLDER / f"{name}.nc"))
    assert {key: found.get(key) for key in FACTS[name]} == FACTS[name]


def test_labels_and_document() -> None:
    tree = asp.open_tree(FOLDER / "wet.nc")
    assert tree.attrs["document"] == "# a document"
    assert tree["path/pressure"].dims == ("step", "x", "y")
