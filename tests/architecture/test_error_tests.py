"""Tests of errors ask for types, subjects, fields and values; what the messages say stands in tests/messages alone."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
WORDS = re.compile(r"[A-Za-z]{2,}[,.:;]? +[a-z]{2,}")
"""Two English words after each other, as in a sentence; a name, an option, a value or one word are allowed."""


def sentences(text: str, name: str) -> list[str]:
    """The patterns of ``match=`` in a test module that are sentences, or that are no text written in their place."""
    found = []
    for call in (node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Call)):
        for pattern in (keyword.value for keyword in call.keywords if keyword.arg == "match"):
            written = pattern.value if isinstance(pattern, ast.Constant) else None
            if not isinstance(written, str) or WORDS.search(written):
                found.append(f"{name}:{pattern.lineno} match={ast.unparse(pattern)}")
    return found


def test_no_sentence_is_matched() -> None:
    paths = sorted(TESTS.rglob("*.py"))
    found = [line for path in paths for line in sentences(path.read_text("utf-8"), str(path.relative_to(TESTS)))]
    assert found == [], "use refused(kind, subject, *values) of tests/refusals.py; messages stand in tests/messages"


@pytest.mark.parametrize("pattern", ['"must be greater than zero"', "words", 'f"{name} must be"', 'r"has, but"'])
def test_sentences_are_found(pattern: str) -> None:
    assert sentences(f"raises(Error, match={pattern})", "a") == [
        f"a:1 match={ast.unparse(ast.parse(pattern, mode='eval'))}"
    ]


@pytest.mark.parametrize("pattern", ['"frozen"', '"--film"', '"5 nm"', r'r"--film .*clash.* other\.thickness"'])
def test_names_and_values_are_allowed(pattern: str) -> None:
    assert sentences(f"raises(Error, match={pattern})", "a") == []
