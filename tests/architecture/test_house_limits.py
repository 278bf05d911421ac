"""Files, functions, and parameter lists stay small. Soft limits may be passed with a written
reason."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

from architecture.exemptions import LIMITS
from architecture.source import Module, library
from house_size import Size

SOFT_AND_HARD = {
    "file lines": (600, 600),
    "function lines": (60, 100),
    "parameters": (6, 10),
}
FUNCTION = (ast.FunctionDef, ast.AsyncFunctionDef)
DEFINITION = (*FUNCTION, ast.ClassDef)


@dataclass(frozen=True)
class Measure:
    """Size of the thing ``name``, at ``place`` in its module, against one ``limit``."""

    limit: str
    name: str
    place: str
    size: int

    def passes(self, which: int) -> bool:
        return self.size <= SOFT_AND_HARD[self.limit][which]


def measures(module: Module) -> Iterator[Measure]:
    """All sizes in ``module`` that have a limit."""
    yield Measure("file lines", module.name, module.name, len(module.lines))
    yield from _of_definitions(module, module.tree, "")


def _of_definitions(module: Module, parent: ast.AST, prefix: str) -> Iterator[Measure]:
    for node in ast.iter_child_nodes(parent):
        place = f"{prefix}.{node.name}".lstrip(".") if isinstance(node, DEFINITION) else prefix
        name = f"{module.name}.{place}"
        if isinstance(node, FUNCTION):
            yield Measure("function lines", name, place, own_lines(module, node))
            yield Measure("parameters", name, place, parameters(node, method=isinstance(parent, ast.ClassDef)))
        yield from _of_definitions(module, node, place)


def own_lines(module: Module, function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Lines of code from ``def`` to the end, without docstring, nested definitions, blank lines and
    comments."""
    own = set(range(function.lineno, (function.end_lineno or function.lineno) + 1))
    nested = [node for node in ast.walk(function) if isinstance(node, DEFINITION) and node is not function]
    docstring = function.body[:1] if ast.get_docstring(function) is not None else []
    for node in (*nested, *docstring):
        own -= set(range(node.lineno, (node.end_lineno or node.lineno) + 1))
    return sum(1 for number in own if (code := module.lines[number - 1].strip()) and not code.startswith("#"))


def parameters(function: ast.FunctionDef | ast.AsyncFunctionDef, method: bool) -> int:
    """Number of parameters, without ``self`` or ``cls``."""
    arguments = function.args
    named = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
    bound = method and named[:1] and named[0].arg in {"self", "cls", "mcs"}
    return len(named) - bool(bound) + bool(arguments.vararg) + bool(arguments.kwarg)


@cache
def of_library() -> list[Measure]:
    return [measure for module in library() for measure in measures(module)]


def test_hard_limits_hold_everywhere() -> None:
    breaches = [f"{m.name}: {m.size} {m.limit}" for m in of_library() if not m.passes(1)]
    assert breaches == [], f"without exception at most, soft and hard: {SOFT_AND_HARD}"


def test_soft_limits_hold_or_have_a_reason() -> None:
    breaches = {(m.limit, m.place): f"{m.size} {m.limit} in {m.name}" for m in of_library() if not m.passes(0)}
    exempt = {(limit, place) for limit, places in LIMITS.items() for place in places}
    unexplained = [text for key, text in breaches.items() if key not in exempt]
    assert unexplained == [], f"past a soft limit without a reason in exemptions.py; soft and hard: {SOFT_AND_HARD}"
    assert sorted(exempt - set(breaches)) == [], "remove the exemptions that are no longer needed"


def test_exemptions_name_a_known_limit_and_a_reason() -> None:
    assert set(LIMITS) <= set(SOFT_AND_HARD)
    assert [place for places in LIMITS.values() for place, reason in places.items() if len(reason) < 20] == []


SAMPLE = '''
class A:
    @property
    def size(self): return 1

    def grow(self, by, *rest, unit="m", **more):
        """Two
        lines."""
        # a comment

        def inner():
            return by
        total = by
        return total

    @staticmethod
    def make(x): pass

    def _hidden(self): pass
'''


def test_sizes_are_counted_as_stated() -> None:
    sizes = {(m.limit, m.name): m.size for m in measures(Module("asperity.x", SAMPLE))}
    assert {m.place for m in measures(Module("asperity.x", SAMPLE))} >= {"asperity.x", "A.grow.inner", "A.make"}
    assert sizes["file lines", "asperity.x"] == len(SAMPLE.splitlines())
    assert sizes["function lines", "asperity.x.A.grow"] == 3
    assert sizes["function lines", "asperity.x.A.grow.inner"] == 2
    assert sizes["parameters", "asperity.x.A.grow"] == 4
    assert sizes["parameters", "asperity.x.A.make"] == 1


def test_the_size_of_the_package_is_counted_as_stated() -> None:
    size = Size()
    size.add(SAMPLE + "\n\ndef _late():\n    import json\n\n    return json\n\n\n_late()\n")
    figures = dict(size.rows())
    assert figures["lines"] == len(SAMPLE.splitlines()) + 9
    assert (figures["docstrings"], figures["comments"], figures["blank"]) == (2, 1, 5 + 5)
    assert (figures["functions"], figures["late imports"], figures["private functions with one caller"]) == (6, 1, 1)
    assert figures["longest function, lines"] == 6
