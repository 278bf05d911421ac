"""What the application says of wrong input names its fields, no options and no calls of Python."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w
from architecture.test_words_of_doors import FIELDS

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.core.words import ACTIONS, in_words
from asperity.io.schemas.surfaces import STEPS
from asperity.run.document import document_model
from asperity.web.forms import asked_of
from asperity.web.layout import STEPS as PAGES
from asperity.web.tasks import contact, surface

LAST: dict[str, Any] = {"version": 2, "body": {"material": "steel"}, "control": {"mean_pressure": "1 MPa"}}
SIZED = {"size": "8 um x 6 um"}
SCALED = {**SIZED, "height_unit": "nm"}


def heights(folder: Path, *, missing: bool = False) -> None:
    """A rough map of 32 x 24 points as a matrix of numbers."""
    values = np.random.default_rng(1).normal(size=(24, 32))
    values[3, 4] = np.nan if missing else values[3, 4]
    np.savetxt(folder / "rough.txt", values)


@pytest.mark.parametrize(
    ("given", "fields"),
    [
        ({}, ("give_size", "give_height_unit")),
        (SIZED, ("give_height_unit",)),
        ({**SCALED, "z_scale": "1 um"}, ("z_scale",)),
        ({**SCALED, "lateral_unit": "um"}, ("lateral_unit",)),
    ],
)
def test_what_a_file_lacks_is_named_by_its_fields(
    tmp_path: Path, given: dict[str, str], fields: tuple[str, ...]
) -> None:
    heights(tmp_path)
    answer = surface(
        {"table": {"kind": "file", "path": "rough.txt", **given}, "folder": str(tmp_path), "out": str(tmp_path / "a")}
    )
    assert_of_the_form(answer["error"])
    assert all(in_words(f"{{{name}}}", "form") in answer["error"] for name in fields)


@pytest.mark.parametrize(
    ("tables", "words"),
    [
        ({}, "{fill}"),
        ({"boundary": {"kind": "free"}, "rolling": {"longitudinal": 0.001}}, "{friction.coefficient=0.3}"),
        ({"adhesion": {"work": "50 mJ/m**2"}}, "{adhesion.range}"),
        ({"law": {"kind": "hardness", "hardness": "from body"}, "body": "E=1GPa,nu=0.3"}, "{law.hardness=5 GPa}"),
        ({"hysteresis": {"slowest": "1 m/s", "speed": "1 m/s"}}, "{hysteresis.fastest}"),
        ({"adhesion": {"work": "50 mJ/m**2", "range": "1 nm", "retract": "1 nm", "steps": 1}}, "{adhesion.steps}"),
    ],
)
def test_what_a_problem_lacks_is_named_by_its_fields(tmp_path: Path, tables: dict[str, Any], words: str) -> None:
    heights(tmp_path, missing=True)
    prepared = [{"step": "fill"}] if tables else []
    table = {**LAST, "surface": {"kind": "file", "path": "rough.txt", **SCALED, "prepare": prepared}, **tables}
    (tmp_path / "problem.toml").write_text(tomli_w.dumps(table), encoding="utf-8")
    places = {"out": "run", "progress": "progress", "views": "views", "document": "problem.toml"}
    answer = contact({"folder": str(tmp_path), **{key: str(tmp_path / name) for key, name in places.items()}})
    assert_of_the_form(answer["error"])
    assert in_words(words, "form") in answer["error"]


def assert_of_the_form(text: str) -> None:
    """Neither options nor calls and arguments of Python stand in ``text``."""
    assert not re.search(r"(?<![\w-])--[a-z]|\w\(\w*\)|\w=", text), text


@pytest.mark.parametrize("name", ACTIONS)
def test_fields_of_actions_exist(name: str) -> None:
    title, colon, label = ACTIONS[name].form.partition(": ")
    if colon:
        pages = {text for text, _ in PAGES.values()}
        kinds = {word for item in asked_of(document_model()) for word in item.tables or ()}
        assert title in pages | set(FIELDS.values())
        assert label.partition(" = ")[0] in {*FIELDS.values(), *STEPS, *kinds}
