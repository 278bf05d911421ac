"""What ``import asperity`` gives: the names, their documentation, and a quick start."""

from __future__ import annotations

import ast
import inspect
import json
import subprocess
import sys
from pathlib import Path
from types import ModuleType

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


def test_public_definitions_are_documented() -> None:
    assert [breach for name in DEFINITIONS for breach in documentation_breaches(name)] == []


def documentation_breaches(name: str) -> list[str]:
    """What is wrong with the docstring of the public ``name`` and of its public methods."""
    item = getattr(asperity, name)
    text = inspect.cleandoc(item.__doc__ or "")
    found = []
    if len(text) < 20:
        found.append(f"{name} needs a docstring")
    elif text.startswith(f"{name}("):
        found.append(f"{name} has only the docstring that dataclass writes")
    elif text.splitlines()[0].rstrip()[-1] not in ".:;?!)`":
        found.append(f"the first line of the docstring of {name} is not a sentence")
    members = vars(item).items() if inspect.isclass(item) else ()
    public = {key: it for key, it in members if not key.startswith("_")}
    described = {key: it for key, it in public.items() if inspect.isfunction(it) or isinstance(it, property)}
    return found + [
        f"{name}.{key} needs a docstring" for key, it in described.items() if not (it.__doc__ or "").strip()
    ]


def test_import_is_light() -> None:
    code = f"import sys, json, asperity; print(json.dumps([m for m in {HEAVY!r} if m in sys.modules]))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    assert json.loads(run.stdout) == [], "import these inside the functions that need them"


def printed(code: str) -> object:
    """What a fresh Python prints as JSON."""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    return json.loads(run.stdout)


def test_import_takes_nothing_of_the_library_but_the_table_of_names() -> None:
    modules = printed("import sys, json, asperity; print(json.dumps([m for m in sys.modules if 'asperity.' in m]))")
    assert modules == ["asperity.core", "asperity.core.late"]


def test_a_name_brings_its_module_and_what_that_needs() -> None:
    code = "import sys, json, asperity; asperity.{}; print(json.dumps([m for m in {!r} if m in sys.modules]))"
    watched = ("asperity.contact.controls", "asperity.contact.problem", "asperity.report", "scipy")
    assert printed(code.format("Force", watched)) == ["asperity.contact.controls"]


@pytest.mark.parametrize(
    "first",
    ["asperity.physics.stress.survey", "asperity.physics.stress", "asperity.contact.solve", "asperity.report.write"],
)
def test_stress_is_the_function_whatever_is_imported_first(first: str) -> None:
    code = (
        f"import json, {first}; from asperity import stress; print(json.dumps([stress.__module__, callable(stress)]))"
    )
    assert printed(code) == ["asperity.physics.stress.compute", True]
    again = f"import json, asperity; asperity.stress; import {first}; print(json.dumps(callable(asperity.stress)))"
    assert printed(again) is True


def test_all_names_are_listed_and_found_and_others_are_not() -> None:
    assert set(PUBLIC) <= set(dir(asperity))
    found: dict[str, object] = {}
    exec("from asperity import *", found)  # noqa: S102 - the statement itself is under test
    assert set(PUBLIC) <= set(found)
    assert all(found[name] is getattr(asperity, name) for name in PUBLIC)
    with pytest.raises(AttributeError, match="phlogiston"):
        asperity.phlogiston  # type: ignore[attr-defined]  # noqa: B018 - reading the attribute is the test


@pytest.mark.parametrize("package", [asperity, asperity.theories], ids=lambda package: package.__name__)
def test_the_stub_names_the_same_in_the_same_modules(package: ModuleType) -> None:
    tree = ast.parse(Path(str(package.__file__)).with_suffix(".pyi").read_text(encoding="utf-8"))
    statements = [node for node in tree.body if isinstance(node, ast.ImportFrom)]
    stub = {alias.name: node.module or "" for node in statements for alias in node.names}
    (names,) = (ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign))
    assert stub == dict(package._HOME)
    assert sorted(names) == package.__all__
