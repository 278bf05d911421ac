"""What users read when their input is wrong, and what they read else: two files, compared as a
whole.

Tests elsewhere check kinds of exceptions and their fields, exit codes, files and numbers; the words
stand in messages.txt and printed.txt alone. After a change that is meant,
``ASPERITY_WRITE_MESSAGES=1 pytest tests/messages`` writes both anew, and the difference is read
like any other.
"""

from __future__ import annotations

import json
import os
import re
import textwrap
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from cli.conftest import BODY, LOAD, SCALE
from messages.bad_documents import DOCUMENTS, GOOD
from messages.bad_input import CALLS, COMPARE, CONTACT, FILES, FILM, GENERATE, INFO, THEORY
from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import app
from asperity.run.document import checked

WRITTEN = Path(__file__).with_name("messages.txt")
PRINTED = Path(__file__).with_name("printed.txt")
GRID = ("--points", "24x16", "--size", "12um x 8um")
COATED = ("--body", "DLC:5nm~/Cr:2nm/steel", "--counter-body", "E=1GPa,nu=0.4:1um/rigid", "--hardness", "body")
RELAXING = ("--body", "E=3MPa+297MPa@1ms,nu=0.5")
ANSWERS: tuple[tuple[str, ...], ...] = (
    ("info", "rough.txt", *SCALE),
    ("info", "rough.txt", *SCALE, "--full"),
    ("materials", "DLC"),
    ("liquids", "zdol"),
    ("theory", "hertz", "--E-star", "115GPa", "--radius", "5mm", "--load", "1N,2N"),
    ("contact", "rough.txt", *SCALE, *BODY, *LOAD, "--out", "run"),
    ("contact", "rough.txt", *SCALE, *COATED, *LOAD),
    ("contact", "rough.txt", *SCALE, *BODY, *LOAD, "--friction", "0.3", "--depths", "0nm"),
    ("contact", "rough.txt", *SCALE, *BODY, "--hardness", "body", "--path", "30MPa,0", "--path-steps", "2"),
    ("contact", "rough.txt", *SCALE, *BODY, *LOAD, "--liquid", "PFPE", "--film", "1nm", "--friction", "0.3"),
    ("contact", "rough.txt", *SCALE, *BODY, *LOAD, "--max-iterations", "1"),
    ("contact", "rough.txt", *SCALE, *RELAXING, "--approach", "1nm", "--hold", "60ms", "--time-steps", "4"),
    ("compare", "rough.txt", *SCALE, *BODY, "--theories", "persson,jackson-green", "--pressures", "1MPa,2MPa"),
    ("cite", "run/result.nc"),
)
"""Commands that answer, on the map of the messages."""

NUMBER = re.compile(r"[-−–]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
JARGON = (
    "Traceback",
    "Input should",
    "Value error",
    "pydantic",
    "type=",
    "Extra inputs",
    "Field required",
    "object at 0x",
)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder, with a rough map of 32 x 24 points as a text matrix in nm."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("NO_COLOR", "1")
    np.savetxt("rough.txt", np.random.default_rng(1).normal(size=(24, 32)))
    for name, content in FILES.items():
        if content is not None:
            Path(name).write_bytes(content)
    return tmp_path


def commands() -> Iterator[tuple[str, ...]]:
    """Every command line, with paths relative to the current folder."""
    yield from (("contact", "rough.txt", *SCALE, *options) for options in CONTACT)
    yield from (("info", "rough.txt", *options) for options in INFO)
    yield from (("compare", "rough.txt", *SCALE, *options) for options in COMPARE)
    yield from (("contact", "rough.txt", *SCALE, *BODY, *LOAD, *options) for options in FILM)
    yield from (("theory", *words) for words in THEORY)
    yield from (("generate", *words, *GRID, "--out", "a.nc") for words in GENERATE)
    for name in FILES:
        scale = () if name.startswith("noise") else SCALE
        yield "info", name, *scale
        yield "contact", name, *scale, *BODY, *LOAD


def printed(arguments: tuple[str, ...]) -> str:
    """What the program prints on stderr, which must be one sentence, with exit code 2."""
    result = CliRunner().invoke(app, list(arguments))
    text = result.stderr
    assert result.exit_code == 2, f"{arguments}: exit code {result.exit_code}, {result.output}"
    assert text.startswith("asperity: "), f"{arguments}: {text}"
    assert len(text.splitlines()) == 1, f"{arguments}: {text}"
    return text.strip()


def raised(name: str) -> str:
    """What the library raises, as the name of the exception and its message."""
    try:
        CALLS[name]()
    except asp.errors.AsperityError as error:
        return f"{type(error).__name__}: {error}"
    raise AssertionError(f"{name} raises nothing")


def refused(tables: dict[str, object]) -> str:
    """The message on the good document with these ``tables``."""
    document = {key: table for key, table in (GOOD | tables).items() if table is not None}
    with pytest.raises(asp.InputError) as caught:
        checked(document)
    return str(caught.value)


def entry(what: str, message: str) -> str:
    assert message.endswith((".", "?", ")")), f"{what}: {message}"
    assert not [word for word in JARGON if word in message], f"{what}: {message}"
    return f"{what}\n    {message}\n"


@pytest.mark.slow
def test_messages_are_those_of_the_file(folder: Path) -> None:
    parts = [entry(" ".join(("asperity", *command)), printed(command)) for command in commands()]
    parts += [entry(name, raised(name)) for name in CALLS]
    parts += [entry(f"document with {json.dumps(tables)}", refused(tables)) for tables in DOCUMENTS]
    text = "\n".join(parts).replace(f"{folder}{os.sep}", "")
    text = re.sub(r"(?<=as a map of heights: )(the number|EOF).*", "(what numpy says)", text)
    if os.environ.get("ASPERITY_WRITE_MESSAGES"):
        WRITTEN.write_text(text, encoding="utf-8")
    assert text == WRITTEN.read_text(encoding="utf-8"), "read the difference; ASPERITY_WRITE_MESSAGES=1 accepts it"


def words(arguments: tuple[str, ...]) -> str:
    """What the program prints, numbers as #, rules of tables left out, the rest in lines of one
    width."""
    result = CliRunner().invoke(app, list(arguments))
    assert result.exit_code in {0, 1}, result.output
    text = re.sub(r"# (?:[µm]s|min)\b", "# s", NUMBER.sub("#", re.sub(r"[─━│]", " ", result.stdout)))
    text = re.sub(
        r"# [yzafpnµmkMGTP](J|Pa|N)\b", r"# \1", text
    )  # rounding decides on the prefix of what is nearly zero
    return textwrap.fill(" ".join(text.split()), 120, initial_indent="    ", subsequent_indent="    ")


@pytest.mark.usefixtures("undrawn")
def test_answers_are_worded_as_in_the_file(folder: Path) -> None:
    text = "\n\n".join(f"asperity {' '.join(command)}\n{words(command)}" for command in ANSWERS) + "\n"
    if os.environ.get("ASPERITY_WRITE_MESSAGES"):
        PRINTED.write_text(text, encoding="utf-8")
    assert text == PRINTED.read_text(encoding="utf-8"), "read the difference; ASPERITY_WRITE_MESSAGES=1 accepts it"
