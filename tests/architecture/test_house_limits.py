"""Files, functions, parameter lists and classes stay small. Soft limits may be passed with a written reason."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

import pytest
from architecture.exemptions import LIMITS
from architecture.source import Module, library

SOFT_AND_HARD = {
    "file lines": (300, 500),
    "function lines": (30, 60),
    "parameters": (6, 10),
    "public methods": (10, 15),
}
FUNCTION = (ast.FunctionDef, ast.AsyncFunctionDef)
DEFINITION = (*FUNCTION, ast.ClassDef)
MODULES = library()


@dataclass(frozen=True)
class Measure:
    """Size of the thing ``name`` against one ``limit``."""

    limit: str
    name: str
    size: int

    def passes(self, which: int) -> bool:
        return self.size <= SOFT_AND_HARD[self.limit][which]


def measures(module: Module) -> Iterator[Measure]:
    """All sizes in ``module`` that have a limit."""
    yield Measure("file lines", module.name, len(module.text.splitlines()))
    yield from _of_definitions(module, module.tree, module.name)


def _of_definitions(module: Module, parent: ast.AST, prefix: str) -> Iterator[Measure]:
    for node in ast.iter_child_nodes(parent):
        name = f"{prefix}.{node.name}" if isinstance(node, DEFINITION) else prefix
        if isinstance(node, FUNCTION):
            yield Measure("function lines", name, own_lines(module, node))
            yield Measure("parameters", name, parameters(node, method=isinstance(parent, ast.ClassDef)))
        elif isinstance(node, ast.ClassDef):
            yield Measure("public methods", name, sum(_is_public_method(item) for item in node.body))
        yield from _of_definitions(module, node, name)


def own_lines(module: Module, function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Lines of code from ``def`` to the end, without docstring, nested definitions, blank lines and comments."""
    own = set(range(function.lineno, (function.end_lineno or function.lineno) + 1))
    nested = [node for node in ast.walk(function) if isinstance(node, DEFINITION) and node is not function]
    docstring = function.body[:1] if ast.get_docstring(function) is not None else []
    for node in (*nested, *docstring):
        own -= set(range(node.lineno, (node.end_lineno or node.lineno) + 1))
    lines = module.text.splitlines()
    return sum(1 for number in own if (code := lines[number - 1].strip()) and not code.startswith("#"))


def parameters(function: ast.FunctionDef | ast.AsyncFunctionDef, method: bool) -> int:
    """Number of parameters, without ``self`` or ``cls``."""
    arguments = function.args
    named = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
    bound = method and named[:1] and named[0].arg in {"self", "cls", "mcs"}
    return len(named) - bool(bound) + bool(arguments.vararg) + bool(arguments.kwarg)


def _is_public_method(node: ast.stmt) -> bool:
    if not isinstance(node, FUNCTION) or node.name.startswith("_"):
        return False
    decorators = [ast.unparse(decorator) for decorator in node.decorator_list]
    return not any("property" in text or text.endswith((".setter", "overload")) for text in decorators)


ALL = [measure for module in MODULES for measure in measures(module)]


@pytest.mark.parametrize("limit", SOFT_AND_HARD)
def test_hard_limits_hold_everywhere(limit: str) -> None:
    breaches = [f"{m.name}: {m.size}" for m in ALL if m.limit == limit and not m.passes(1)]
    assert breaches == [], f"at most {SOFT_AND_HARD[limit][1]} {limit}, without exception"


@pytest.mark.parametrize("limit", SOFT_AND_HARD)
def test_soft_limits_hold_or_have_a_reason(limit: str) -> None:
    breaches = {m.name: m.size for m in ALL if m.limit == limit and not m.passes(0)}
    exempt = set(LIMITS[limit])
    unexplained = {name: size for name, size in breaches.items() if name not in exempt}
    assert unexplained == {}, (
        f"at most {SOFT_AND_HARD[limit][0]} {limit}, or a reason in tests/architecture/exemptions.py"
    )
    assert exempt - set(breaches) == set(), "remove the exemptions that are no longer needed"


def test_exemptions_name_a_known_limit_and_a_reason() -> None:
    assert set(LIMITS) == set(SOFT_AND_HARD)
    assert all(len(reason) >= 20 for reasons in LIMITS.values() for reason in reasons.values())


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
    assert sizes["file lines", "asperity.x"] == len(SAMPLE.splitlines())
    assert sizes["function lines", "asperity.x.A.grow"] == 3
    assert sizes["function lines", "asperity.x.A.grow.inner"] == 2
    assert sizes["parameters", "asperity.x.A.grow"] == 4
    assert sizes["parameters", "asperity.x.A.make"] == 1
    assert sizes["public methods", "asperity.x.A"] == 2
