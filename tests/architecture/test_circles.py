"""No module needs itself: imports make no circle, those in functions, by name and for type checkers
counted."""

from __future__ import annotations

from collections.abc import Iterable
from graphlib import CycleError, TopologicalSorter

from architecture.source import Module, imports, library


def circle(modules: Iterable[Module]) -> list[str]:
    """Modules of a circle of imports, the first one again at the end; empty if there is none."""
    names = {module.name: module for module in modules}
    graph: dict[str, set[str]] = {}
    for name, module in names.items():
        targets = {_home(item.target, names) for item in imports(module)}
        graph[name] = targets - {name, ""}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        found: list[str] = error.args[1]
        return found[::-1]
    return []


def _home(target: str, names: Iterable[str]) -> str:
    """Module in which the imported ``target`` is defined; empty for other libraries, and for the
    package itself."""
    while target and target not in names:
        target = target.rpartition(".")[0]
    return target if "." in target else ""


def test_imports_make_no_circle() -> None:
    assert circle(library()) == []


def test_circles_are_found() -> None:
    a, b = "asperity.core.a", "asperity.core.b"
    one, two = Module(a, "from .b import x"), Module(b, "import math")
    assert circle([one, two]) == []
    for back in ("from .a import y", "def f():\n    from .a import y", "if TYPE_CHECKING:\n    from .a import y"):
        assert circle([one, Module(b, back)])[0] in (a, b)
    assert circle([one, Module(b, "from importlib import import_module\nimport_module('asperity.core.a')")])
