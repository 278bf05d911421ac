"""Files of format 2 are read to the bit, as the version that wrote them read them;
tests/reference/files-v2/README.md says how they were made."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from stored_cases import told

import asperity as asp
from asperity.contact.result import OF_EDGES

FOLDER = Path(__file__).parents[2] / "reference" / "files-v2"
FACTS = json.loads((FOLDER / "facts.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", FACTS)
def test_every_type_of_result(name: str) -> None:
    """All but what follows from the edges of contacts, which counts them otherwise than that
    version."""
    found = told(asp.load(FOLDER / f"{name}.nc"))
    facts = {
        key: value for key, value in FACTS[name].items() if key.rpartition(".")[2] not in (*OF_EDGES, "spot_areas")
    }
    assert {key: found.get(key) for key in facts} == facts


def test_labels_and_document() -> None:
    tree = asp.files.open_tree(FOLDER / "wet.nc")
    assert tree.attrs["document"] == "# a document"
    assert tree["path/pressure"].dims == ("step", "x", "y")
