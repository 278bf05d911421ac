"""What users read when their input is wrong: one file of messages, compared as a whole.

Tests elsewhere check kinds of exceptions and their fields; the words stand in messages.txt alone. After a change that is meant,
``ASPERITY_WRITE_MESSAGES=1 pytest tests/messages`` writes the file anew, and the difference is read like any other.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from cli.conftest import BODY, LOAD, SCALE
from messages.bad_documents import DOCUMENTS, GOOD
from messages.bad_input import CALLS, COMPARE, CONTACT, FILES, INFO
from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import app
from asperity.run.document import checked

WRITTEN = Path(__file__).with_name("messages.txt")
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
    except asp.AsperityError as error:
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


def test_messages_are_those_of_the_file(folder: Path) -> None:
    parts = [entry(" ".join(("asperity", *command)), printed(command)) for command in commands()]
    parts += [entry(name, raised(name)) for name in CALLS]
    parts += [entry(f"document with {json.dumps(tables)}", refused(tables)) for tables in DOCUMENTS]
    text = "\n".join(parts).replace(f"{folder}{os.sep}", "")
    text = re.sub(r"(?<=as a map of heights: )(the number|EOF).*", "(what numpy says)", text)
    if os.environ.get("ASPERITY_WRITE_MESSAGES"):
        WRITTEN.write_text(text, encoding="utf-8")
    assert text == WRITTEN.read_text(encoding="utf-8"), "read the difference; ASPERITY_WRITE_MESSAGES=1 accepts it"
