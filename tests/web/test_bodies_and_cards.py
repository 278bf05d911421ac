"""What the pages of bodies and physics show, without a browser: constants as they are resolved,
drawings, and the cards of parts."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.core.registry import FORMS, PARTS
from asperity.io.schemas.bodies import BESIDE, CONSTANTS, MaterialTable
from asperity.parts.part import Part
from asperity.parts.registry import parts
from asperity.run.build import build_material
from asperity.run.document import checked, document_model, validated
from asperity.solids.library import materials
from asperity.web.cells import OWN, RELAXING, RIGID, said, way_of, with_way
from asperity.web.drawing import LEAST, THIN, drawn, heights, stack_of
from asperity.web.forms import asked_of
from asperity.web.pages_load import NEUTRAL, OTHERS, grouped, picture_of, purpose_of, summary
from asperity.web.resolved import SHOWN, Materials, as_tables, resolved

TWELVE = 1e-11
"""Error of numbers that are written with twelve digits."""


def built(table: dict[str, Any]) -> Any:
    return build_material(validated(MaterialTable, table, "material"), None, Path())


@pytest.mark.parametrize("record", materials(), ids=lambda record: record.name)
def test_a_material_of_the_library_is_resolved_with_its_sources_and_taken_as_own(record: Any) -> None:
    found = resolved({"material": record.name}, None, Path())
    for key in SHOWN:
        known, value = record.values.get(key), found.values[key]
        assert bool(value.text) is (known is not None)
        assert not value.own
        if known is not None:
            assert value.source == known.source
            assert known.source.removeprefix("assumed:").strip() in said(value)
            assert value.assumed is known.assumed
    kept = {"thickness": "5 nm", "interface": "frictionless"}
    own = with_way({**kept, "material": record.name}, OWN, None)
    assert own.items() >= kept.items()
    made = built({key: value for key, value in own.items() if key not in kept})
    for key in record.values.keys() & {*CONSTANTS, *BESIDE}:
        holder = next(one for one in (made, made.strength, made.conduction) if hasattr(one, key))
        assert getattr(holder, key) == pytest.approx(record.values[key].value, rel=TWELVE)
    assert way_of(own, None) == OWN
    assert way_of({"material": record.name}, record) == record.name
    assert with_way(own, record.name, None) == {**kept, "material": record.name}


def test_a_value_is_that_of_the_body_that_is_solved() -> None:
    table = {"material": "steel", "hardness": "60 HRC", "hardening": "linear(2 GPa)"}
    found, made = resolved(table, None, Path()).values, built(table)
    assert found["hardness"].own
    assert found["hardness"].text == "7.372 GPa"
    assert found["yield_stress"].text
    assert not found["yield_stress"].own
    assert found["yield_stress"].source
    assert float(found["yield_stress"].text.split()[0]) == pytest.approx(made.strength.yield_stress / 1e9, rel=1e-3)
    half = resolved({"youngs_modulus": "200 GPa", "hardness": "nonsense"}, None, Path())
    assert [half.values[key].text for key in SHOWN] == ["200 GPa", "", "", ""]
    assert not half.known


def test_own_constants_that_relax_and_rigid_bases() -> None:
    relaxing = with_way({"material": "PMMA"}, RELAXING, None)
    assert "youngs_modulus" not in relaxing
    assert relaxing["relaxation"] == {"kind": "prony"}
    assert "relaxation" not in with_way(relaxing, OWN, None)
    assert with_way(relaxing, RIGID, None) == {"rigid": True}
    table = {"relaxation": {"kind": "maxwell", "modulus": "1 GPa", "time": "1 s"}, "poisson_ratio": "0.4"}
    value = resolved(table, None, Path()).values["youngs_modulus"]
    assert (value.text, value.relaxes) == ("1 GPa", True)


@pytest.mark.parametrize(
    ("body", "default", "state", "name"),
    [
        (None, "", "open", "not chosen yet"),
        (None, "rigid (default)", "rigid", "rigid (default)"),
        ({"rigid": True}, "rigid (default)", "rigid", "rigid"),
        ({}, "", "open", "not chosen yet"),
        ("steel", "", "chosen", "steel"),
        ({"name": "own material"}, "", "open", "own material"),
        ({"layers": [{"material": "DLC", "thickness": "5 nm"}]}, "", "open", "not chosen yet"),
    ],
)
def test_only_what_does_not_deform_is_drawn_as_rigid(body: Any, default: str, state: str, name: str) -> None:
    base = stack_of(body, Materials(Path()), default=default).base
    assert (base.state, base.name) == (state, name)


def test_the_default_that_is_drawn_is_that_of_the_document() -> None:
    surface = {"kind": "flat", "points": "8x8", "size": "1 um x 1 um"}
    table = {"version": 2, "surface": surface, "body": "steel", "control": {"mean_pressure": "1 MPa"}}
    assert checked(table).counter_body.rigid


def test_heights_are_to_scale_but_for_what_would_not_be_seen() -> None:
    tall, thin = heights([5e-9, 2e-9, 1e-9], 160.0)
    assert tall == pytest.approx([100.0, 40.0, 20.0])
    assert thin == []
    tall, thin = heights([1e-6, 1e-9, 3e-6, math.nan, 1e-12], 160.0)
    assert thin == [1, 4]
    assert sum(tall) == pytest.approx(160.0)
    assert tall[2] == pytest.approx(3.0 * tall[0])
    assert [tall[number] for number in (1, 3, 4)] == [LEAST] * 3
    assert LEAST > THIN
    assert heights([], 160.0) == ([], [])


def test_graded_slipping_and_thin_layers_are_seen_in_the_drawing() -> None:
    graded = {"kind": "power", "exponent": 2, "top": "DLC", "bottom": "steel", "thickness": "1 um"}
    layers = [{"material": "chromium", "thickness": "1 nm", "interface": "frictionless"}, graded]
    text = drawn(stack_of({"layers": layers, "base": "steel"}, Materials(Path())), "body")
    ElementTree.fromstring(text)
    assert text.count("<linearGradient") == 1
    assert len(set(re.findall(r'stop-color="(#\w+)"', text))) == 9
    assert text.count('class="slips"') == 1
    assert text.count("broken") == 1
    assert "1.001 µm" in text


def test_bodies_in_text_become_tables() -> None:
    made = as_tables({"layers": [{"kind": "linear", "top": "DLC", "bottom": "E=1GPa,nu=0.3"}], "base": "rigid"})
    assert made["layers"][0]["top"] == {"material": "DLC"}
    assert made["layers"][0]["bottom"]["youngs_modulus"] == "1GPa"
    assert made["base"] == {"rigid": True}
    assert as_tables("E=1GPa,") == as_tables(as_tables("E=1GPa,"))


def shown_parts() -> tuple[Part, ...]:
    """Parts of this package that declare the settings of a table."""
    return tuple(
        part for part in parts() if part.settings is not None and type(part).__module__.startswith("asperity.")
    )


@pytest.mark.parametrize("part", shown_parts(), ids=lambda part: part.table)
def test_a_part_has_a_sentence_and_a_picture_in_its_folder(part: Part) -> None:
    assert re.fullmatch(r"[A-Z][^.]{20,100}\.", part.purpose)
    picture = picture_of(part)
    assert picture != NEUTRAL
    root = ElementTree.fromstring(picture)
    assert root.get("viewBox") == "0 0 64 40"
    for node in root.iter():
        assert node.tag.rpartition("}")[2] in {"svg", "path", "circle", "ellipse", "rect"}
        assert node.get("stroke", "currentColor") == "currentColor"
        assert node.get("fill", "none") in {"none", "currentColor"}
        assert not any(key.startswith("on") or "href" in key or key == "style" for key in node.attrib)


def test_a_part_without_a_picture_has_a_neutral_one() -> None:
    class Own(Part):
        """Something of my own."""

        name = table = "own"

    assert picture_of(Own()) == NEUTRAL
    assert purpose_of(Own(), {}) == "Something of my own."
    assert picture_of(None) == NEUTRAL


def test_every_table_stands_under_one_heading() -> None:
    tables = {part.table for part in shown_parts()}
    named = [name for names in FORMS.values() for name in names]
    assert sorted(named) == sorted(tables)
    assert len(PARTS) >= len(tables)
    entries = {item.name: item for item in asked_of(document_model()) if item.name in tables}
    found = list(grouped({"glue": entries["stress"], **entries}))
    assert [heading for heading, _ in found] == [*FORMS, OTHERS]
    assert found[-1][1] == [entries["stress"]]


def test_folded_settings_say_what_they_are() -> None:
    assert summary("boundary", None) == "periodic"
    assert summary("law", {"kind": "hardness", "hardness": "5 GPa"}) == "hardness 5 GPa"
    assert summary("law", {"kind": "hard_wall"}) == "hard wall"
    assert summary("solver", {"tolerance": "1e-6"}) == "tolerance 1e-6"
