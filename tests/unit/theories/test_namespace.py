"""The namespace of theories: late imports, and a stub that says the same."""

from __future__ import annotations

import ast
import json
import subprocess
import sys
from pathlib import Path

import pytest

from asperity import theories

STUB = Path(theories.__file__).with_suffix(".pyi")


def test_the_stub_names_the_same_in_the_same_modules():
    tree = ast.parse(STUB.read_text(encoding="utf-8"))
    stub = {alias.name: node.module for node in tree.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    (names,) = (ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign))
    assert stub == dict(theories._HOME)
    assert sorted(names) == theories.__all__


def test_every_name_leads_to_what_its_module_defines():
    for name in theories.__all__:
        assert getattr(theories, name) is not None
        assert name in dir(theories)
    with pytest.raises(AttributeError, match="no attribute 'phlogiston'"):
        theories.phlogiston  # noqa: B018 - reading the attribute is the test


def test_the_package_is_imported_without_its_theories():
    code = (
        "import sys, json, asperity; print(json.dumps([m for m in sys.modules if m.startswith('asperity.theories.')]))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    loaded = {name.removeprefix("asperity.theories.") for name in json.loads(done.stdout)}
    assert not loaded & {"catalogue", "hertz", "persson", "bush_gibson_thomas", "maugis"}
