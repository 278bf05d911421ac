"""Findings and errors name what can be done in the words of each door, and every such word exists
there."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from typing import Any

import pytest
import typer
from architecture.source import Module, library

import asperity as asp
from asperity.cli.main import app
from asperity.cli.options import option_words
from asperity.core.words import ACTIONS, field_of, in_words, label_of, speaking
from asperity.parts.advice import AREAS, PRESSURES, STRESSES
from asperity.parts.registry import parts
from asperity.physics.adhesion.work import ZONE
from asperity.physics.dynamics.work_motion import SLIDING, VIBRATION
from asperity.run.document import document_model
from asperity.surfaces.text_files import TextOptions
from asperity.web.forms import Asked, asked_of

WITHOUT_FINDINGS = ("cli", "web", "report", "plots")
"""Folders of the doors, which show findings and make none."""

NAMES_OPTIONS = {
    "core.words": "the table",
    "web.security": "options of the application itself, for whom has started it",
    "web.workers": "an option of the application itself",
    "web.server": "options of the application itself",
    "web.draft": "the command that it offers to copy",
    "core.engine.gpu": "options of a compiler",
}
"""Modules beside the command line that may name options, each with its reason."""

PLACEHOLDER = re.compile(r"\{(\w+(?:\.\w+)*)(?:=[^{}]*)?\}")


def texts(module: Module) -> Iterator[tuple[int, str]]:
    """Every string of the code of ``module`` but its docstrings and what declares an option."""
    declared = {
        id(k.value) for node in module.nodes if isinstance(node, ast.keyword) for k in [node] if k.arg == "option"
    }
    bodies = (getattr(node, "body", None) for node in module.nodes)
    statements = (one for body in bodies if isinstance(body, list) for one in body)
    documented = {id(one.value) for one in statements if isinstance(one, ast.Expr)}
    for node in module.nodes:
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in declared | documented:
            yield node.lineno, node.value


def said() -> set[str]:
    """All names in braces in the texts of the library that are meant for ``in_words``."""
    modules = [module for module in library() if module.folder != "cli"]  # whose bars of progress have keys
    found = {name for module in modules for _, text in texts(module) for name in PLACEHOLDER.findall(text)}
    return {name for name in found if name in ACTIONS or "." in name}


def fields() -> dict[str, str]:
    """Words of the form for every dotted key of documents, and every label and choice by itself."""
    found: dict[str, str] = {}

    def walk(items: tuple[Asked, ...], path: tuple[str, ...]) -> None:
        for item in items:
            here = (*path, item.name)
            found[".".join(here)] = item.label
            for table in (item.tables or {}).values():
                if len(here) < 4:
                    walk(asked_of(table), here)

    walk(asked_of(document_model()), ())
    return found


FIELDS = fields()
OPTIONS = option_words()


def test_doors_make_no_findings() -> None:
    makers = [
        module.name
        for module in library()
        if module.folder in WITHOUT_FINDINGS
        for node in module.nodes
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "Advice"
    ]
    assert not makers


def test_texts_beside_the_command_line_name_no_options() -> None:
    found = [
        f"{module.name}:{line} {text}"
        for module in library()
        if module.folder != "cli" and module.name.partition(".")[2] not in NAMES_OPTIONS
        for line, text in texts(module)
        if re.search(r"(?<![\w-])--[a-z]", text)
    ]
    assert not found


def test_every_name_in_braces_is_an_action_or_a_key() -> None:
    """One that is none would be shown with its braces."""
    others = ("asperity.io.atomic",)  # patterns of names of files
    found = [
        f"{module.name}:{line} {name}"
        for module in library()
        if module.folder not in ("cli", "web", "core") and module.name not in others
        for line, text in texts(module)
        for name in PLACEHOLDER.findall(text)
        if name not in ACTIONS and "." not in name
    ]
    assert not found


def test_every_action_is_advised_somewhere() -> None:
    assert set(ACTIONS) - said() == set()


@pytest.mark.parametrize("key", sorted(name for name in said() if "." in name))
def test_keys_of_documents_have_a_field_and_an_option(key: str) -> None:
    assert key in FIELDS
    assert key in OPTIONS
    *tables, last = key.removesuffix(".kind").split(".")
    assert field_of(key).endswith(label_of(last))
    assert all(label_of(table) in FIELDS.values() for table in tables)


@pytest.fixture(scope="module")
def options() -> set[str]:
    """Names of the options of all commands."""
    program: Any = typer.main.get_command(app)
    context = typer.Context(program)
    commands = [program.get_command(context, name) for name in program.list_commands(context)]
    return {word for command in commands for item in getattr(command, "params", ()) for word in item.opts}


@pytest.mark.parametrize("name", ACTIONS)
def test_options_of_actions_exist(name: str, options: set[str]) -> None:
    named = re.findall(r"(?<![\w-])--[a-z][\w-]*", ACTIONS[name].command)
    assert named or not re.search("[(=]", ACTIONS[name].command)
    assert set(named) <= options


ARGUMENTS_OF = (
    *(asp.read, asp.ContactProblem, asp.solve, asp.Strength, asp.TimeSteps, asp.PlasticFlow, asp.Viscoelastic),
    *(asp.solids.Elastic, asp.solids.Conduction),
)
"""What takes the arguments that findings and errors name."""

FURTHER = {"solver", "time_steps", "overwrite", "load", "short", "y", "tolerance", "max_iterations"}
"""Arguments of methods, of options of ``solve``, and of theories."""


@pytest.mark.parametrize("name", ACTIONS)
def test_names_of_actions_exist_in_python(name: str) -> None:
    words = ACTIONS[name].python
    for call in re.findall(r"[A-Za-z][\w.]*(?=\()", words):
        found: Any = asp
        for part in call.removeprefix("numpy.geomspace").split("."):
            found = getattr(found, part) if part else found
    known = {parameter for one in ARGUMENTS_OF for parameter in inspect.signature(one).parameters} | FURTHER
    known |= {*TextOptions.__annotations__}
    assert set(re.findall(r"\b([a-z]\w*)=", words)) <= known


def concerns() -> Iterator[str]:
    """Names of quantities, or their beginnings, that findings concern."""
    yield from (*AREAS, *PRESSURES, *STRESSES)
    for module in library():
        for node in module.nodes:
            match node:
                case ast.Call(func=ast.Name(id="Advice"), args=args, keywords=keywords):
                    given = [*args[5:], *(word.value for word in keywords if word.arg == "concerns")]
                case ast.Assign(targets=[ast.Name(id="concerns")], value=value):
                    given = [value]
                case _:
                    given = []
            for tree in given:
                yield from (one.value for one in ast.walk(tree) if isinstance(one, ast.Constant))


@pytest.mark.parametrize("name", sorted({*concerns(), *ZONE, *VIBRATION, *SLIDING}))
def test_what_findings_concern_are_quantities(name: str) -> None:
    assert any(quantity.name.startswith(name) for part in parts() for quantity in part.quantities)


def test_words_are_those_of_the_door() -> None:
    text = "Give {friction.law=full stick} or {friction.coefficient=0.3}, {fill}, {unknown} and {Y=3}."
    assert (
        in_words(text)
        == 'Give friction.law = "full stick" or friction.coefficient = 0.3, filled(surface), {unknown} and {Y=3}.'
    )
    with speaking("command", option_words):
        assert (
            in_words(text)
            == 'Give --friction-law "full stick" or --friction 0.3, --fill harmonic, {unknown} and {Y=3}.'
        )
    with speaking("form"):
        assert (
            in_words(text)
            == "Give Friction: Law = full stick or Friction: Coefficient = 0.3, Prepare: fill, {unknown} and {Y=3}."
        )
        assert str(asp.InputError("It has {fill}.")) == "It has Prepare: fill."
    assert str(asp.InputError("It has {fill}.")) == "It has filled(surface)."
