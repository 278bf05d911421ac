"""The table of what the sources describe is true of the code: every door opens, every test and page
is there, and the page is that of the table."""

from __future__ import annotations

import ast
import importlib.util
from collections import Counter
from functools import cache
from typing import Any

import pytest
import typer
from doc_pages import DOCS, ROOT

import asperity as asp
from asperity.cli.main import app
from asperity.run.document import json_schema
from asperity.theories.catalogue import ALIASES, THEORIES

SPEC = importlib.util.spec_from_file_location("sources", DOCS / "start" / "sources.py")
assert SPEC is not None
assert SPEC.loader is not None
sources = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(sources)

ROWS = sources.rows()
SCHEMA = json_schema()


def test_every_row_has_what_its_status_asks_for():
    """What is there has doors, tests and pages; what is missing says so, and has none."""
    faults = []
    for row in ROWS:
        shown = (bool(row.doors), bool(row.tests), bool(row.pages))
        known = row.source in sources.SOURCES and row.status in sources.STATUSES and row.place
        whole = shown == (row.status in ("there", "partly"),) * 3 and (row.note or row.status == "there")
        if not (known and whole):
            faults.append(row)
    assert faults == []


def test_every_thing_of_every_source_has_its_row():
    """As many as were found when the sources were read."""
    assert Counter(row.source for row in ROWS) == {
        "Peng (2001)": 118,
        "Yastrebov (2016)": 27,
        "Bhushan (1998)": 127,
        "Gold-film chapter": 49,
    }
    twice = Counter((row.source, row.place, row.item) for row in ROWS)
    assert [row for row, number in twice.items() if number > 1] == []


@pytest.mark.parametrize(
    ("door", "opens"),
    [
        ("asp.solve", True),
        ("asp.contact.ContactResult.pressure", True),
        ("asp.contact.solves", False),
        ("asperity contact --friction --out", True),
        ("asperity contact --no-such-option", False),
        ("asperity press", False),
        ("theory hertz", True),
        ("theory hurts", False),
        ("document body.layers.thickness", True),
        ("document surface.spectrum.hurst", True),
        ("document film.feetback", False),
        ("document boundary.thickness", False),
        ("examples/README.md", True),
        ("examples/none.py", False),
        ("another door", False),
    ],
)
def test_doors_are_told_from_walls(door, opens):
    assert (wrong(door) == "") == opens


def test_every_door_opens():
    assert [found for row in ROWS for door in row.doors if (found := wrong(door))] == []


def test_every_test_is_there():
    lost = []
    for row in ROWS:
        for test in row.tests:
            file, _, name = test.partition("::")
            if name not in functions(file):
                lost.append(test)
    assert lost == []


def test_every_page_is_there():
    assert [aim for row in ROWS for aim in row.pages if not (aim.endswith(".md") and (ROOT / aim).exists())] == []


def test_the_pages_are_those_of_the_table():
    """`python docs/start/sources.py` writes them."""
    assert sources.PAGE.read_text(encoding="utf-8") == sources.page(ROWS)
    text = sources.FEATURES.read_text(encoding="utf-8")
    assert sources.sentence(ROWS) in text.split("\n")
    assert text == sources.features(text, ROWS)


@cache
def functions(file: str) -> frozenset[str]:
    """Names of the tests of a file of the repository; none if there is no such file."""
    if not (ROOT / file).exists():
        return frozenset()
    tree = ast.parse((ROOT / file).read_text(encoding="utf-8"))
    return frozenset(node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef))


def wrong(door: str) -> str:
    """What is wrong with a door; empty if it opens."""
    kind, _, rest = door.partition(" ")
    if door.startswith("asp."):
        found = public(door.split(".")[1:])
    elif door.startswith("examples/"):
        found = (ROOT / door).exists()
    elif kind == "asperity":
        found = command(rest.split())
    elif kind == "theory":
        found = rest in THEORIES or rest in ALIASES
    else:
        found = kind == "document" and key(SCHEMA, rest.split("."))
    return "" if found else f"{door} leads nowhere"


def public(names: list[str]) -> bool:
    """Whether a dotted name leads to what the package shows, a field of a class at the end."""
    at: Any = asp
    for place, name in enumerate(names):
        fields = getattr(at, "__dataclass_fields__", {})
        if name in fields and place == len(names) - 1:
            return True
        if name.startswith("_") or not hasattr(at, name):
            return False
        at = getattr(at, name)
    return True


@cache
def commands() -> dict[str, frozenset[str]]:
    """Options of every command."""
    program: Any = typer.main.get_command(app)
    context = typer.Context(program)
    found = {}
    for name in program.list_commands(context):
        made = program.get_command(context, name)
        known = getattr(made, "params", ())  # those of a theory or a kind of surface are made when asked for
        found[name] = frozenset(one for param in known for one in (*param.opts, *param.secondary_opts))
    return found


def command(words: list[str]) -> bool:
    """Whether there is a command with these options."""
    return words[0] in commands() and set(words[1:]) <= commands()[words[0]]


def key(node: dict[str, Any], names: list[str]) -> bool:
    """Whether the schema below ``node`` has the key that ``names`` lead to, in any of its kinds."""
    if "$ref" in node:
        return key(SCHEMA["$defs"][node["$ref"].rpartition("/")[2]], names)
    if not names:
        return True
    kinds = [one for several in ("anyOf", "oneOf", "allOf") for one in node.get(several, ())]
    kinds += [node["items"]] if "items" in node else []
    known = node.get("properties", {})
    return (names[0] in known and key(known[names[0]], names[1:])) or any(key(one, names) for one in kinds)
