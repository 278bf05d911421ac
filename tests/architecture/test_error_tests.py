"""Tests ask for types, subjects, fields, values and files; what messages and answers say stands in
tests/messages alone."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
WORDS = re.compile(r"[A-Za-z]{2,}[,.:;]? +[a-z]{2,}")
"""Two English words after each other, as in a sentence; a name, an option, a value or one word are
allowed."""

STREAM = re.compile(r"\.(stdout|stderr|output|err|out)\b")
PRINTED = re.compile(rf"assert \w+ in .*{STREAM.pattern}")


def sentences(text: str, name: str) -> list[str]:
    """The patterns of ``match=`` in a test module that are sentences, or that are no text written
    in their place."""
    found = []
    for call in (node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Call)):
        for pattern in (keyword.value for keyword in call.keywords if keyword.arg == "match"):
            written = pattern.value if isinstance(pattern, ast.Constant) else None
            if not isinstance(written, str) or WORDS.search(written):
                found.append(f"{name}:{pattern.lineno} match={ast.unparse(pattern)}")
    return found


def sought(text: str, name: str) -> list[str]:
    """The sentences that a test module looks for in what the program prints:
    ``"… …" in result.stdout``, alone or in a loop."""
    found = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.For) and any(PRINTED.search(ast.unparse(line)) for line in node.body):
            texts = node.iter.elts if isinstance(node.iter, ast.Tuple | ast.List) else []
        elif isinstance(node, ast.Compare) and isinstance(node.ops[0], ast.In) and STREAM.search(ast.unparse(node)):
            texts = [node.left]
        else:
            continue
        written = [one for one in texts if isinstance(one, ast.Constant) and isinstance(one.value, str)]
        found += [f"{name}:{one.lineno} {one.value!r}" for one in written if WORDS.search(one.value)]
    return found


def test_no_sentence_is_sought_in_what_is_printed() -> None:
    found = [
        line for path in sorted((TESTS / "cli").glob("*.py")) for line in sought(path.read_text("utf-8"), path.name)
    ]
    assert found == [], "check the exit code, the subject, stored values or numbers; sentences stand in tests/messages"


@pytest.mark.parametrize(
    "text", ['assert "all is well" in result.stdout', 'for x in ("It is so", "2"):\n    assert x in r.stderr']
)
def test_sought_sentences_are_found(text: str) -> None:
    assert len(sought(text, "a")) == 1


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
