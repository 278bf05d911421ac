"""What carries out tasks, many at a time; the function is named, so that any machine can look it
up."""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

Task: TypeAlias = Mapping[str, Any]
"""What a function is given: plain values, fit for JSON."""


@dataclass(frozen=True)
class Lost:
    """A task that ended its worker at every attempt, and what is known of the reason."""

    reason: str


class Executor(Protocol):
    """Carries out tasks, many at a time."""

    def run(self, function: str, tasks: Iterator[Task]) -> Iterator[tuple[Task, Any | Lost]]:
        """Every task with its answer, as they are done; ``function`` is named ``"module:name"``.

        Tasks are taken one by one as workers are free. Closing the iterator stops the work.
        """


def call(function: str, task: Task) -> Any:
    """Answer of the ``function`` named ``"module:name"`` to ``task``."""
    module, _, name = function.partition(":")
    return getattr(importlib.import_module(module), name)(task)
