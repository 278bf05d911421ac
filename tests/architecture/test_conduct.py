"""The library prints nothing, executes no text and keeps no mutable state in modules."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from architecture.exemptions import CACHES
from architecture.source import Module, library

MUTABLE_CALLS = {"list", "dict", "set", "defaultdict", "OrderedDict", "Counter", "deque", "bytearray"}
MUTABLE_NODES = (ast.List, ast.Dict, ast.Set, ast.ListComp, ast.DictComp, ast.SetComp)
FORBIDDEN_CALLS = {"print", "exec", "eval"}
CACHE_DECORATORS = {"cache", "lru_cache"}
MODULES = library()


def violations(module: Module) -> list[str]:
    """One sentence for each breach in ``module``."""
    walk = [*_forbidden_calls(module.nodes), *_global_statements(module.nodes), *_module_state(module)]
    return [f"{module.name}:{line} {what}" for line, what in walk]


def caches(module: Module) -> list[str]:
    """Dotted names of the functions of ``module`` that remember their results for the life of the
    process."""
    functions = [n for n in module.nodes if isinstance(n, ast.FunctionDef | ast.AsyncFunctionDef)]
    return [f"{module.name}.{f.name}" for f in functions if any(_name(d) in CACHE_DECORATORS for d in f.decorator_list)]


def _forbidden_calls(nodes: list[ast.AST]) -> Iterator[tuple[int, str]]:
    for node in nodes:
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FORBIDDEN_CALLS:
            yield node.lineno, f"calls {node.func.id}"


def _global_statements(nodes: list[ast.AST]) -> Iterator[tuple[int, str]]:
    for node in nodes:
        if isinstance(node, ast.Global):
            yield node.lineno, f"has a global statement for {', '.join(node.names)}"


def _module_state(module: Module) -> Iterator[tuple[int, str]]:
    """Mutable containers bound at the top of the module, or in a class body, to names that do not
    claim to be constant."""
    bodies = [module.tree.body, *(node.body for node in module.nodes if isinstance(node, ast.ClassDef))]
    for statement in (statement for body in bodies for statement in body):
        targets: list[ast.expr] = []
        if isinstance(statement, ast.Assign):
            targets = statement.targets
        elif isinstance(statement, ast.AnnAssign):
            targets = [statement.target]
        if targets and _is_mutable(statement.value):  # type: ignore[attr-defined]
            for target in targets:
                name = getattr(target, "id", "")
                if name != "__all__" and name != name.upper():
                    yield statement.lineno, f"keeps a mutable container in {name}"


def _is_mutable(value: ast.expr | None) -> bool:
    return isinstance(value, MUTABLE_NODES) or (isinstance(value, ast.Call) and _name(value) in MUTABLE_CALLS)


def _name(node: ast.expr) -> str:
    if isinstance(node, ast.Call):
        node = node.func
    return node.attr if isinstance(node, ast.Attribute) else getattr(node, "id", "")


def test_no_print_no_exec_no_mutable_module_state() -> None:
    assert [violation for module in MODULES for violation in violations(module)] == []


def test_caches_have_a_written_reason() -> None:
    found = {name for module in MODULES for name in caches(module)}
    assert found == set(CACHES), "a cache needs an entry in exemptions.CACHES, and every entry must be in use"
    assert [name for name, reason in CACHES.items() if len(reason) < 20] == []


def test_breaches_are_found() -> None:
    samples = [
        "print(1)",
        "def f():\n    eval('1')",
        "exec('a = 1')",
        "def f():\n    global n\n    n = 1",
        "registry = {}",
        "known: list[int] = []",
        "seen = set()",
        "_cache = collections.defaultdict(list)",
        "squares = [n**2 for n in range(9)]",
        "class Material:\n    constants = {}",
    ]
    assert [text for text in samples if len(violations(Module("asperity.core.x", text))) != 1] == []


def test_ordinary_code_is_allowed() -> None:
    samples = ["__all__ = ['a']", "TABLE = {'a': 1}", "pair = (1, 2)", "def f():\n    a = []", "c.print(1)"]
    assert [text for text in samples if violations(Module("asperity.core.x", text))] == []


def test_caches_are_found() -> None:
    decorators = ["cache", "functools.cache", "lru_cache(maxsize=8)", "functools.lru_cache"]
    samples = {decorator: f"@{decorator}\ndef f():\n    pass" for decorator in decorators}
    assert [d for d, text in samples.items() if caches(Module("asperity.core.x", text)) != ["asperity.core.x.f"]] == []
