"""How large the package is, and through how many files one solve and one command pass:
``python tests/house_size.py``.

Lines of a module are code, docstrings (of modules, classes and functions), comments and blank
lines. The length of a function counts the lines after ``def`` without its docstring. A private
function has one caller if its name is defined once and occurs once besides, in the whole package.
Late imports are the import statements inside functions. What one call passes through is found with
the profiler, in the second of two equal calls, so that imports and compilation do not count.
"""

from __future__ import annotations

import argparse
import ast
import contextlib
import cProfile
import pstats
import sys
import tempfile
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

FUNCTION = (ast.FunctionDef, ast.AsyncFunctionDef)
IMPORT = (ast.Import, ast.ImportFrom)
ROOT = Path(__file__).parents[1] / "src" / "asperity"


@dataclass
class Size:
    """Counts over all modules below a folder."""

    modules: int = 0
    kinds: Counter[str] = field(default_factory=Counter)
    lengths: list[int] = field(default_factory=list)
    late_imports: int = 0
    private: Counter[str] = field(default_factory=Counter)
    uses: Counter[str] = field(default_factory=Counter)

    def add(self, text: str) -> None:
        """Count one module."""
        tree = ast.parse(text)
        self.modules += 1
        docs = {line for node in ast.walk(tree) for line in docstring_lines(node)}
        self.kinds.update(kind(line, number in docs) for number, line in enumerate(text.splitlines(), 1))
        late = set()
        for node in ast.walk(tree):
            if isinstance(node, FUNCTION):
                self.lengths.append((node.end_lineno or node.lineno) - node.lineno - len(docstring_lines(node)))
                late |= {inner for inner in ast.walk(node) if isinstance(inner, IMPORT)}
                if node.name.startswith("_") and not node.name.startswith("__"):
                    self.private[node.name] += 1
            elif isinstance(node, ast.Name):
                self.uses[node.id] += 1
            elif isinstance(node, ast.Attribute):
                self.uses[node.attr] += 1
        self.late_imports += len(late)

    @property
    def with_one_caller(self) -> int:
        """Number of private functions with one caller."""
        return sum(self.private[name] == 1 == self.uses[name] for name in self.private)

    def rows(self) -> list[tuple[str, int]]:
        """Figures by name."""
        lengths = sorted(self.lengths)
        return [
            ("modules", self.modules),
            ("lines", self.kinds.total()),
            *((name, self.kinds[name]) for name in ("code", "docstrings", "comments", "blank")),
            ("functions", len(lengths)),
            ("median function, lines", lengths[len(lengths) // 2]),
            ("90 % of functions up to, lines", lengths[int(0.9 * len(lengths))]),
            ("longest function, lines", lengths[-1]),
            ("private functions with one caller", self.with_one_caller),
            ("late imports", self.late_imports),
        ]


def docstring_lines(node: ast.AST) -> range:
    """Numbers of the lines of the docstring of ``node``, if it has one."""
    body = getattr(node, "body", None)
    first = body[0] if isinstance(body, list) and body else None
    if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and isinstance(first.value.value, str):
        return range(first.lineno, (first.end_lineno or first.lineno) + 1)
    return range(0)


def kind(line: str, in_docstring: bool) -> str:
    """What a ``line`` is."""
    text = line.strip()
    if in_docstring:
        return "docstrings"
    return "blank" if not text else "comments" if text.startswith("#") else "code"


def size(root: Path = ROOT) -> Size:
    """Counts over the package at ``root``."""
    found = Size()
    for path in sorted(root.rglob("*.py")):
        found.add(path.read_text(encoding="utf-8"))
    return found


def passed_through(call: Callable[[], object]) -> tuple[int, int]:
    """Functions and files of the package that the second of two calls passes through."""
    for _ in range(2):
        profile = cProfile.Profile()
        with contextlib.suppress(SystemExit):  # a command ends so
            profile.runcall(call)
    own = {(file, name) for file, _, name in pstats.Stats(profile).stats if file.startswith(str(ROOT))}  # type: ignore[attr-defined]
    named = {(file, name) for file, name in own if not name.startswith("<")}
    return len(named), len({file for file, _ in named})


def reach() -> list[tuple[str, int]]:
    """Figures by name: what ``asp.solve`` on a periodic elastic contact and ``asperity contact``
    pass through."""
    import numpy as np

    import asperity as asp
    from asperity.cli.main import run

    heights = 1e-9 * np.random.default_rng(1).standard_normal((64, 64))
    problem = asp.ContactProblem(asp.Surface(heights, 1e-8, periodic=True), asp.Elastic(1e11, 0.3))
    solve = passed_through(lambda: asp.solve(problem, asp.MeanPressure(1e7)))
    with tempfile.TemporaryDirectory() as folder:
        scan = Path(folder) / "scan.npy"
        np.save(scan, heights)
        text = f"asperity contact {scan} --size 1um --height-unit m --body DLC --pressure 50MPa"
        sys.argv = text.split()
        command = passed_through(run)
    names = [f"{what} of {call}" for call in ("asp.solve", "asperity contact") for what in ("functions", "files")]
    return list(zip(names, (*solve, *command), strict=True))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--reach", action="store_true", help="also what a solve and a command pass through (10 s)")
    rows = size().rows() + (reach() if parser.parse_args().reach else [])
    for name, figure in rows:
        sys.stderr.write(f"{name:40}{figure:>8}\n")


if __name__ == "__main__":
    main()
