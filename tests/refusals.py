"""What tests ask of an error: its type, the input that it is about, and values that it shows; not its words."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from asperity.core.errors import AsperityError


@contextmanager
def refused(kind: type[AsperityError], subject: str, *shown: str) -> Iterator[pytest.ExceptionInfo[AsperityError]]:
    """The block raises a ``kind`` of error about the input ``subject`` whose message holds the values ``shown``."""
    with pytest.raises(kind) as caught:
        yield caught
    assert caught.value.subject == subject, str(caught.value)
    assert [value for value in shown if value not in str(caught.value)] == [], str(caught.value)
