"""What ``import asperity`` gives: the names and the public modules, their documentation, and a
quick start."""

from __future__ import annotations

import ast
import inspect
import json
import pydoc
import re
import subprocess
import sys
from collections import Counter
from itertools import chain
from pathlib import Path
from types import ModuleType

import pytest
from heavy_imports import HEAVY

import asperity
from asperity.core.late import LateModule
from asperity.core.words import first_paragraph

NAMES_FILE = Path(__file__).with_name("public_names.txt")
MODULES: dict[str, ModuleType] = {name: getattr(asperity, name) for name in asperity.__all__}
NAMES = {name: list(module.__all__) for name, module in MODULES.items()}
"""Names by public module."""

TOP = [name for name in dir(asperity) if name in asperity._HOME]
PAIRS = [(module, name) for module, names in NAMES.items() for name in names]
MOST = 61
"""Names at the top beside the public modules, the version included. A new physics brings a public
module, whose names stand there and not at the top."""

SCREEN = 45
"""Lines of one screen, of 100 columns."""


def test_public_names_are_those_of_the_list() -> None:
    sections = {"asperity": [*TOP, "__version__"]} | {f"asperity.{module}": names for module, names in NAMES.items()}
    made = "\n\n".join("\n".join([f"[{section}]", *sorted(names)]) for section, names in sections.items()) + "\n"
    assert made == NAMES_FILE.read_text(encoding="utf-8"), (
        f"the public names changed; if that is meant, edit {NAMES_FILE.name} to say the same"
    )


def test_few_names_stand_at_the_top_and_each_in_a_module_too() -> None:
    assert len({*TOP} - {*MODULES}) + 1 <= MOST
    lonely = [
        name
        for name in sorted({*TOP} - {*MODULES})
        if not any(
            name in names and vars_of(module, name) is getattr(asperity, name) for module, names in NAMES.items()
        )
    ]
    assert lonely == ["cite"]


def vars_of(module: str, name: str) -> object:
    return getattr(MODULES[module], name)


def test_each_thing_has_one_public_module() -> None:
    defined = Counter(id(vars_of(*pair)) for pair in PAIRS if callable(vars_of(*pair)))
    assert [pair for pair in PAIRS if defined[id(vars_of(*pair))] > 1] == []


def test_public_names_are_distinct_and_not_private() -> None:
    for names in (TOP, *NAMES.values()):
        assert len(set(names)) == len(names)
        assert [name for name in names if name.startswith("_")] == []


@pytest.mark.parametrize("module", MODULES)
def test_public_definitions_are_documented(module: str) -> None:
    items = {f"{module}.{name}": vars_of(module, name) for name in NAMES[module]}
    made = {name: item for name, item in items.items() if inspect.isfunction(item) or inspect.isclass(item)}
    assert list(chain.from_iterable(documentation_breaches(name, item) for name, item in made.items())) == []


def documentation_breaches(name: str, item: object) -> list[str]:
    """What is wrong with the docstring of the public ``item`` and of its public methods."""
    text = inspect.cleandoc(item.__doc__ or "")
    found = []
    if len(text) < 20:
        found.append(f"{name} needs a docstring")
    elif text.startswith(f"{name.rpartition('.')[2]}("):
        found.append(f"{name} has only the docstring that dataclass writes")
    elif first_paragraph(item)[-1] not in ".:;?!)`":
        found.append(f"what the docstring of {name} says first is not a sentence")
    members = vars(item).items() if inspect.isclass(item) else ()
    public = {key: it for key, it in members if not key.startswith("_")}
    described = {key: it for key, it in public.items() if inspect.isfunction(it) or isinstance(it, property)}
    return found + [
        f"{name}.{key} needs a docstring" for key, it in described.items() if not (it.__doc__ or "").strip()
    ]


def printed(code: str) -> object:
    """What a fresh Python prints as JSON."""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    return json.loads(run.stdout)


@pytest.mark.parametrize("module", ["asperity", *(f"asperity.{module}" for module in MODULES)])
def test_import_is_light(module: str) -> None:
    found = printed(f"import sys, json, {module}; print(json.dumps([m for m in {HEAVY!r} if m in sys.modules]))")
    assert found == [], "import these inside the functions that need them"


def test_import_takes_nothing_of_the_library_but_the_table_of_names() -> None:
    modules = printed("import sys, json, asperity; print(json.dumps([m for m in sys.modules if 'asperity.' in m]))")
    assert modules == ["asperity.core", "asperity.core.late"]


def test_a_name_brings_its_module_and_what_that_needs() -> None:
    code = "import sys, json, asperity; asperity.{}; print(json.dumps([m for m in {!r} if m in sys.modules]))"
    watched = ("asperity.contact.controls", "asperity.contact.problem", "asperity.report", "scipy")
    assert printed(code.format("Force", watched)) == ["asperity.contact.controls"]


@pytest.mark.parametrize(
    ("first", "name"),
    [
        ("asperity.physics.stress.survey", "stress"),
        ("asperity.contact.solve", "contact.solve"),
        ("asperity.surfaces.read", "surfaces.read"),
        ("asperity.studies.compare", "studies.compare"),
        ("asperity.run.document", "run"),
        ("asperity.report.write", "run"),
    ],
)
def test_a_function_is_the_function_whatever_is_imported_first(first: str, name: str) -> None:
    assert printed(f"import json, {first}; import asperity; print(json.dumps(callable(asperity.{name})))") is True
    again = f"import json, asperity; asperity.{name}; import {first}; print(json.dumps(callable(asperity.{name})))"
    assert printed(again) is True


@pytest.mark.parametrize("module", MODULES)
def test_modules_give_all_their_names_and_no_others(module: str) -> None:
    found: dict[str, object] = {}
    exec(f"from asperity.{module} import *", found)  # noqa: S102 - the statement itself is under test
    assert set(NAMES[module]) <= set(found) & set(dir(MODULES[module]))
    assert all(found[name] is vars_of(module, name) for name in NAMES[module])
    assert not hasattr(MODULES[module], "phlogiston")


def test_a_star_gives_the_modules() -> None:
    found: dict[str, object] = {}
    exec("from asperity import *", found)  # noqa: S102 - the statement itself is under test
    assert set(found) - {"__builtins__"} == set(MODULES)
    assert not hasattr(asperity, "phlogiston")
    with pytest.raises(ImportError):
        exec("from asperity import phlogiston")  # noqa: S102 - the statement itself is under test


def test_a_name_that_moved_raises_with_its_new_place() -> None:
    for module, name in PAIRS:
        if name in TOP or inspect.ismodule(getattr(asperity, name, None)):  # a quantity called like a folder
            continue
        with pytest.raises(AttributeError) as missing:
            getattr(asperity, name)
        with pytest.raises(ImportError) as lost:
            exec(f"from asperity import {name}")  # noqa: S102 - the statement itself is under test
        assert str(missing.value) == str(lost.value)
        assert f"asperity.{module}.{name} " in str(lost.value)
    assert not hasattr(asperity, "Swift")


def test_help_is_a_table_of_contents_of_one_screen() -> None:
    lines = pydoc.render_doc(asperity, renderer=pydoc.plaintext).splitlines()
    files = lines.index("PACKAGE CONTENTS")
    assert files <= SCREEN
    assert max(map(len, lines[:files])) <= 100
    # pydoc lists the files of every package, the list of names, version and place, and is not to be
    # told otherwise
    rest = [line for line in lines[files:] if line and not line.startswith(" ")]
    assert rest == ["PACKAGE CONTENTS", "DATA", "VERSION", "FILE"]
    assert sum(" = " in line for line in lines) == 1


def test_the_table_of_contents_says_of_each_module_what_the_module_says() -> None:
    rows = re.findall(r"^    (\w+) +(.+)$", asperity.__doc__ or "", re.MULTILINE)
    first = {name: first_paragraph(module) for name, module in MODULES.items()}
    assert dict(rows) == {name: line.partition(": ")[2].rstrip(".") for name, line in first.items()}
    assert [name for name, _ in rows] == sorted(MODULES)


@pytest.mark.parametrize("module", [asperity, *MODULES.values()], ids=lambda module: module.__name__)
def test_the_stub_names_the_same_in_the_same_modules(module: LateModule) -> None:
    tree = ast.parse(Path(str(module.__file__)).with_suffix(".pyi").read_text(encoding="utf-8"))
    statements = [node for node in tree.body if isinstance(node, ast.ImportFrom)]
    stub = {alias.name: "." * (node.level - 1) + (node.module or "") for node in statements for alias in node.names}
    (names,) = (ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign))
    assert stub == dict(module._names.home)
    assert sorted(names) == module.__all__
