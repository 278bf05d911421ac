"""Files of format 1, which had all variables in the root, still load; tests/reference/files-v1/README.md says how they were made."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

import asperity as asp

FOLDER = Path(__file__).parents[2] / "reference" / "files-v1"
FACTS = json.loads((FOLDER / "facts.json").read_text(encoding="utf-8"))


def test_a_contact():
    result = asp.load(FOLDER / "contact.nc")
    assert {name: getattr(result, name) for name in FACTS["contact"]} == FACTS["contact"]
    assert result.problem.surface.origin.history == ("three cosines",)
    assert float(result.pressure.mean()) == pytest.approx(result.mean_pressure, rel=1e-9)
    assert (asp.load(FOLDER / "contact.nc").plastic == (result.pressure >= 4e9)).all()
    tree = asp.open_tree(FOLDER / "contact.nc")
    assert tree.attrs["document"] == "# a document"
    assert tree["contact/pressure"].attrs["units"] == "Pa"


def test_a_wet_contact():
    wet = asp.load(FOLDER / "wet.nc")
    facts = dict(FACTS["wet"])
    assert wet.certificate.rounds == facts.pop("rounds")
    assert {name: getattr(wet.menisci, name) for name in facts} == facts
    assert wet.converged
    assert asp.open_tree(FOLDER / "wet.nc")["film/menisci"].dims == ("x", "y")


def test_a_load_path():
    tree = asp.open_tree(FOLDER / "path.nc")
    np.testing.assert_array_equal(tree["path/max_pressure"], FACTS["path"]["max_pressure"])
    assert tree["path/pressure"].dims == ("step", "x", "y")
    with refused(asp.FileFormatError, f"load path in {FOLDER / 'path.nc'}", "open_tree"):
        asp.load(FOLDER / "path.nc")


def test_a_stress_field():
    field = asp.load(FOLDER / "stress.nc")
    assert float(field.von_mises.max()) == FACTS["stress"]["von_mises"]
    assert field.depth.tolist() == FACTS["stress"]["depth"]
    assert [plane.side for plane in field.planes] == ["surface", "above", "below", "inside"]
    assert [region.name for region in field.regions] == ["film", "base"]
