"""What tests ask of an error: its type, the input that it is about, and values that it shows; not
its words."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from typer.testing import Result

from asperity.core.errors import AsperityError


@contextmanager
def refused(kind: type[AsperityError], subject: str, *shown: str) -> Iterator[pytest.ExceptionInfo[AsperityError]]:
    """The block raises a ``kind`` of error about the input ``subject`` whose message holds the
    values ``shown``."""
    with pytest.raises(kind) as caught:
        yield caught
    assert caught.value.subject == subject, str(caught.value)
    assert [value for value in shown if value not in str(caught.value)] == [], str(caught.value)


def subject_of(result: Result) -> str:
    """The input that a refused command is about: exit code 2, and its only message names it as an
    error of the library does."""
    assert result.exit_code == 2, result.output
    assert result.stderr.startswith("asperity: "), result.stderr
    return AsperityError(" ".join(result.stderr.removeprefix("asperity: ").split())).subject
