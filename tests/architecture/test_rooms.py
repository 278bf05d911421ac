"""A physics is named in its own folder: names, attributes, keywords, imports and keys of code
count, prose does not."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import PurePosixPath

import pytest
from architecture.source import Module, library

WORDS = {
    "adhesion": r"(?i)adhes",
    "menisci": r"(?i)menisc|LiquidFilm|^film$|^wetting$|^Wetting$|^wet_|^WET_|_wet_",
    "dynamics": r"(?i)dynamics|NormalCompliance|SlidingBlock",
}
"""What names of each physics look like."""

HOMES = {
    "adhesion": ("physics/adhesion/", "physics/pairs/", "theories/adhesion/"),
    "menisci": ("physics/menisci/", "physics/pairs/", "theories/wet/"),
    "dynamics": ("physics/dynamics/", "theories/dynamics/"),
}
"""Folders of each physics, and of its theories."""

TABLES = {
    "core/registry.py": "the list of all",
    "core/citations.py": "papers by their names",
    "theories/catalogue.py": "all theories",
    "contact/known.py": "names of the physics with their types",
    "contact/found.py": "names of what the physics found with their types",
}
"""Files that name several physics, each with its reason."""

MOST = {"adhesion": (0, 0), "menisci": (1, 1), "dynamics": (2, 6)}
"""Files and mentions outside its folder at most. Of menisci the list of energies in files names
one."""


def names(module: Module) -> Iterator[str]:
    """Everything in the code of ``module`` that may name a physics."""
    bodies = (getattr(node, "body", None) for node in module.nodes)
    statements = (first for body in bodies if isinstance(body, list) for first in body)
    documented = {id(one.value) for one in statements if isinstance(one, ast.Expr)}
    for node in module.nodes:
        match node:
            case ast.Name(id=name) | ast.Attribute(attr=name) | ast.arg(arg=name) | ast.FunctionDef(name=name):
                yield name
            case ast.ClassDef(name=name):
                yield name
            case ast.keyword(arg=str(name)):
                yield name
            case ast.ImportFrom(module=origin, names=imported):
                yield from re.split(r"\W+", origin or "")
                yield from (alias.name for alias in imported)
            case ast.Constant(value=str(text)) if id(node) not in documented and re.fullmatch(r"[\w.:\-]+", text):
                yield text


@pytest.mark.parametrize("physics", HOMES)
def test_a_physics_is_named_in_its_folder(physics: str) -> None:
    pattern, mentions = re.compile(WORDS[physics]), dict[str, int]()
    for module in library():
        place = str(PurePosixPath(*module.name.split(".")[1:])) + ("/" if module.is_package else ".py")
        if not place.startswith(HOMES[physics]) and place not in TABLES:
            count = sum(bool(pattern.search(name)) for name in names(module))
            mentions |= {place: count} if count else {}
    files, most = MOST[physics]
    assert len(mentions) <= files, mentions
    assert sum(mentions.values()) <= most, mentions


def test_names_in_code_are_seen_and_prose_is_not() -> None:
    text = (
        '"""Prose on adhesion."""\nfrom ..adhesion.law import '
        'Law\nresult.adhesion\nsolve(adhesion=1)\nprint("adhesion")\nprint("some adhesion")\n'
    )
    pattern = re.compile(WORDS["adhesion"])
    assert sum(bool(pattern.search(name)) for name in names(Module("asperity.x.y", text))) == 4
