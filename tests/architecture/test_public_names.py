"""What ``import asperity`` promises: the names, their documentation, and a quick start."""

from __future__ import annotations

import inspect
import json
import subprocess
import sys
from pathlib import Path

import pytest
from heavy_imports import HEAVY

import asperity

NAMES_FILE = Path(__file__).with_name("public_names.txt")
PUBLIC = list(getattr(asperity, "__all__", ()))
DEFINITIONS = [n for n in PUBLIC if inspect.isfunction(getattr(asperity, n)) or inspect.isclass(getattr(asperity, n))]


def test_public_names_are_those_of_the_list() -> None:
    listed = NAMES_FILE.read_text(encoding="utf-8").split()
    assert sorted(PUBLIC) == listed, (
        f"the public names changed; if that is meant, edit {NAMES_FILE.name} to say the same"
    )


def test_public_names_are_distinct_and_not_private() -> None:
    assert len(set(PUBLIC)) == len(PUBLIC)
    assert [name for name in PUBLIC if name.startswith("_") and name != "__version__"] == []


@pytest.mark.parametrize("name", DEFINITIONS)
def test_public_definition_is_documented(name: str) -> None:
    item = getattr(asperity, name)
    text = inspect.cleandoc(item.__doc__ or "")
    assert len(text) >= 20, f"{name} needs a docstring"
    assert not text.startswith(f"{name}("), f"{name} has only the docstring that dataclass writes"
    assert text.splitlines()[0].rstrip()[-1] in ".:;?!)`", f"the first line of {name}'s docstring is not a sentence"


@pytest.mark.parametrize("name", [n for n in DEFINITIONS if inspect.isclass(getattr(asperity, n))])
def test_public_methods_are_documented(name: str) -> None:
    members = vars(getattr(asperity, name)).items()
    public = {key: item for key, item in members if not key.startswith("_")}
    described = {key: item for key, item in public.items() if inspect.isfunction(item) or isinstance(item, property)}
    assert [key for key, item in described.items() if not (item.__doc__ or "").strip()] == []


def test_import_is_light() -> None:
    code = f"import sys, json, asperity; print(json.dumps([m for m in {HEAVY!r} if m in sys.modules]))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    assert json.loads(run.stdout) == [], "import these inside the functions that need them"
