"""The examples of the application: complete documents that are solved soon, each with a picture of
its own result."""

from __future__ import annotations

import io

import example_pictures
import pytest
from PIL import Image

import asperity as asp
from asperity.run.document import EXAMPLES, PRESETS, built_in, load_document, picture


def test_there_are_nine_and_no_preset_is_called_so() -> None:
    assert len(EXAMPLES) == 9
    assert not EXAMPLES.keys() & set(PRESETS)
    assert len({load_document(name).title for name in EXAMPLES}) == 9
    assert all(question.endswith("?") for question in EXAMPLES.values())


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_picture_is_of_the_document_as_it_stands(name: str) -> None:
    """Else ``python docs/site/example_pictures.py NAME`` draws it anew."""
    png = picture(name)
    assert example_pictures.drawn_from(png) == example_pictures.digest(name)
    assert len(png) < example_pictures.LARGEST
    with Image.open(io.BytesIO(png)) as image:
        assert image.size == example_pictures.SIZE


def test_what_they_cover() -> None:
    """The physics of the first things that people come for."""
    given = {name: load_document(name) for name in EXAMPLES}
    assert given["coated-disk"].body.layers
    assert given["ball-on-coating"].surface.kind == "sphere"
    assert all(getattr(given[name], "stress") for name in ("coated-disk", "ball-on-coating", "running-in"))  # noqa: B009
    assert given["rubber-on-ground"].control.path is not None
    assert given["flattened-metal"].law.kind == "hardness"
    for name, part in (("humid-air", "film"), ("fretting", "shear"), ("connector", "conductance")):
        assert getattr(given[name], part) is not None, name
    assert given["metal-seal"].sealing is not None
    assert given["running-in"].wear is not None


@pytest.mark.slow
@pytest.mark.parametrize("name", EXAMPLES)
def test_they_are_solved_without_a_doubt(name: str) -> None:
    outcome = asp.run(name)
    assert outcome.converged
    assert [found for found in outcome.findings if found.level != "note"] == []


@pytest.mark.slow
def test_a_picture_is_drawn_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """From the document as it stands, whatever picture there was."""
    name = "metal-seal"
    changed = built_in(name).replace("seed = 6", "seed = 7")
    monkeypatch.setattr(example_pictures, "built_in", lambda name: changed)
    png = example_pictures.draw(name)
    assert example_pictures.drawn_from(png) == example_pictures.digest(name)
    monkeypatch.undo()
    assert example_pictures.drawn_from(png) != example_pictures.digest(name)
