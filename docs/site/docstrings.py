"""Docstrings as they stand in the code, plain text with numpydoc sections, made readable for
Sphinx."""

from __future__ import annotations

import re
from typing import Any

from formulas import is_formula, tex


def marked_up(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Escape what reStructuredText would read as markup, and set displayed formulas as such;
    changes ``lines``."""
    made: list[str] = []
    literal = False  # within an example or a block of code
    for number, line in enumerate(lines):
        if line.strip().startswith(">>>"):
            literal = True
        elif not line.strip():
            literal = literal and number + 1 < len(lines) and lines[number + 1].startswith("    ")
        if literal or _is_rule(line):
            made.append(line)
        elif is_formula(line) and _stands_alone(lines, number):
            made += ["", ".. math::", "", f"    {tex(line.strip().rstrip('.,'))}", ""]
        else:
            made.append(escaped(line))
        literal = literal or line.rstrip().endswith("::")
    lines[:] = made


def _is_rule(line: str) -> bool:
    return bool(re.fullmatch(r"\s*-{3,}\s*", line))


def _stands_alone(lines: list[str], number: int) -> bool:
    """Whether the paragraph with this line is not the first, and holds formulas only."""
    first = number
    while first and lines[first - 1].strip():
        first -= 1
    last = next((place for place in range(number, len(lines)) if not lines[place].strip()), len(lines))
    return first > 0 and all(map(is_formula, lines[first:last]))


def escaped(line: str) -> str:
    """One line whose asterisks, bars and trailing underscores are what they seem."""
    bullet, line = re.fullmatch(r"(\s*\* )?(.*)", line, re.DOTALL).groups("")
    parts = re.split(r"(``[^`]*``|:[\w:]+:`[^`]*`)", line)
    return bullet + "".join(
        part if place % 2 else re.sub(r"([*|])|(_)(?!\w)|(?<![\w`:])(`)", _escape, part)
        for place, part in enumerate(parts)
    )


def _escape(found: re.Match[str]) -> str:
    return "\\" + found[0]
