"""Dotted names, cross-references and paths in docstrings and pages lead to something that
exists."""

from __future__ import annotations

import ast
import importlib
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from architecture.source import Module, library

BASE = Path(__file__).parents[2]
DOTTED = re.compile(r"`~?((?:asperity|asp)(?:\.[A-Za-z_]\w*)+)")
ROLE = re.compile(r":(?:func|class|meth|mod|attr):`~?([\w.]+)`")
PATH = re.compile(r"`((?:src|tests|docs|benchmarks|examples|validation|\.ci)/[\w./-]*\.\w+)`")


def pages() -> list[Path]:
    """Pages in Markdown that are written by hand; the changelog tells of names that are gone."""
    found = [*BASE.glob("*.md"), *(BASE / "docs").rglob("*.md"), *(BASE / "benchmarks").glob("*.md")]
    return [path for path in found if path.name != "CHANGELOG.md"]


def docstrings(module: Module) -> Iterator[str]:
    """All texts that stand for themselves: docstrings of modules, classes and functions, and of
    constants."""
    for node in module.nodes:
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
            yield node.value.value


@cache
def exists(name: str) -> bool:
    """Whether the dotted ``name`` is a module or an attribute, however deep."""
    names = name.replace("asp.", "asperity.", 1).split(".") if name.startswith("asp.") else name.split(".")
    for split in range(len(names), 0, -1):
        try:
            found: object = importlib.import_module(".".join(names[:split]))
        except ModuleNotFoundError:
            continue
        for attribute in names[split:]:
            fields = {key for kind in getattr(found, "__mro__", ()) for key in getattr(kind, "__annotations__", {})}
            if attribute in fields:
                return True
            if not hasattr(found, attribute):
                return False
            found = getattr(found, attribute)
        return True
    return False


def referred(module: Module, name: str) -> bool:
    """Whether a cross-reference in ``module`` names something there, in one of its classes, or by
    its full name."""
    own = {n.name for n in module.nodes if isinstance(n, ast.FunctionDef | ast.ClassDef)}
    return name in own or exists(name) or exists(f"{module.name}.{name}")


def test_dotted_names_exist() -> None:
    texts = [(module.name, text) for module in library() for text in docstrings(module)]
    texts += [(str(page.relative_to(BASE)), page.read_text(encoding="utf-8")) for page in pages()]
    assert [(place, name) for place, text in texts for name in DOTTED.findall(text) if not exists(name)] == []


def test_cross_references_lead_somewhere() -> None:
    found = [
        (module.name, name)
        for module in library()
        for text in docstrings(module)
        for name in ROLE.findall(text)
        if not referred(module, name)
    ]
    assert found == []


def test_paths_exist() -> None:
    found = [
        (str(page.relative_to(BASE)), path)
        for page in pages()
        for path in PATH.findall(page.read_text(encoding="utf-8"))
        if not (BASE / path).exists()
    ]
    assert found == []


def test_dead_names_are_found() -> None:
    assert [exists(name) for name in ("asperity.theories.HertzPoint", "asp.solve", "asp.ContactResult.pressure")] == [
        True
    ] * 3
    assert not any(exists(name) for name in ("asperity.theories.hertz.Hertz", "asp.solved", "asp.Surface.height"))
