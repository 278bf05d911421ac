"""The library's own source as syntax trees, and the modules that each file imports."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

PACKAGE = "asperity"
ROOT = Path(__file__).parents[2] / "src" / PACKAGE


@dataclass(frozen=True)
class Module:
    """One source file: dotted ``name`` and ``text``; ``is_package`` for an ``__init__`` file."""

    name: str
    text: str
    is_package: bool = False

    @cached_property
    def tree(self) -> ast.Module:
        return ast.parse(self.text)

    @cached_property
    def nodes(self) -> list[ast.AST]:
        return list(ast.walk(self.tree))

    @cached_property
    def lines(self) -> list[str]:
        return self.text.splitlines()

    @property
    def folder(self) -> str:
        """Subpackage (or module) directly below the package; empty for the package's own
        ``__init__``."""
        parts = self.name.split(".")
        return parts[1] if len(parts) > 1 else ""


@dataclass(frozen=True)
class Import:
    """Absolute ``target`` that is imported on ``line``: a module, or a name in a module.

    ``late`` if it is imported when a function runs, and ``typing`` if only type checkers read it.
    """

    target: str
    line: int
    late: bool = False
    typing: bool = False


@cache
def library() -> list[Module]:
    """All modules of the library."""
    return [_module(path) for path in sorted(ROOT.rglob("*.py"))]


def _module(path: Path) -> Module:
    parts = [PACKAGE, *path.relative_to(ROOT).with_suffix("").parts]
    is_package = parts[-1] == "__init__"
    return Module(".".join(parts[:-1] if is_package else parts), path.read_text(encoding="utf-8"), is_package)


@cache
def imports(module: Module) -> list[Import]:
    """Everything that ``module`` imports, anywhere in it: at the top, in functions, for type
    checking, by name."""
    return list(_imports(module, module.tree, late=False, typing=False))


def _imports(module: Module, parent: ast.AST, late: bool, typing: bool) -> Iterator[Import]:
    late = late or isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
    typing = typing or (isinstance(parent, ast.If) and ast.unparse(parent.test).endswith("TYPE_CHECKING"))
    for node in ast.iter_child_nodes(parent):
        for target in _targets(module, node):
            yield Import(target, node.lineno, late, typing)  # type: ignore[attr-defined]
        yield from _imports(module, node, late, typing)


def _targets(module: Module, node: ast.AST) -> Iterator[str]:
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    elif isinstance(node, ast.ImportFrom):
        origin = _absolute(module, "." * node.level + (node.module or ""))
        yield from (f"{origin}.{alias.name}" for alias in node.names)
    elif isinstance(node, ast.Call) and _called(node) in {"import_module", "__import__"} and node.args:
        name = node.args[0]
        if isinstance(name, ast.Constant) and isinstance(name.value, str):
            yield _absolute(module, name.value)


def _absolute(module: Module, name: str) -> str:
    level = len(name) - len(name.lstrip("."))
    if level == 0:
        return name
    parts = module.name.split(".")
    base = parts[: len(parts) - level + (1 if module.is_package else 0)]
    return ".".join([*base, *filter(None, [name.lstrip(".")])])


def _called(node: ast.Call) -> str:
    function = node.func
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")
