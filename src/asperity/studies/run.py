"""Carry out a plan: what is missing in the store is given to the workers, what they answer goes
into the store."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import prod
from pathlib import Path
from typing import Protocol

import numpy as np

from ..io.description import software
from .executors import Executor, Lost, Task
from .monte_carlo import Stop
from .places import plain
from .plan import Plan
from .store import Finished, Record, Store

FUNCTION = "asperity.studies.evaluate:evaluate_path"
"""What workers do with a path."""


class Watch(Protocol):
    """Receives the progress of a study."""

    def update(self, done: int, failed: int, found: int, total: int) -> None:
        """Cases ``done`` and ``failed`` in this run, ``found`` finished from earlier runs, of at
        most ``total``."""


class NoWatch:
    """Shows nothing."""

    def update(self, done: int, failed: int, found: int, total: int) -> None:
        """Do nothing."""


@dataclass(frozen=True)
class RunSummary:
    """What a run has done: cases ``done`` and ``failed``, and ``found`` finished from earlier
    runs."""

    done: int
    failed: int
    found: int


def stopping(plan: Plan) -> Stop | None:
    """The rule by which the samples of ``plan`` end, if it has one."""
    table = plan.document.monte_carlo
    return None if table is None or table.stop is None else Stop(table.stop, prod(plan.shape[1:]))


def stop_quantity(plan: Plan) -> str | None:
    """The quantity that the rule looks at."""
    table = plan.document.monte_carlo
    return None if table is None or table.stop is None else table.stop.quantity


def carry_out(
    plan: Plan,
    path: Path,
    executor: Executor,
    *,
    watch: Watch = NoWatch(),
    retry: bool = False,
    function: str = FUNCTION,
) -> RunSummary:
    """Compute the cases of ``plan`` that the store at ``path`` lacks.

    Interrupting it, in whatever way, loses the paths that are under way and nothing else.

    Parameters
    ----------
    plan, path
        What to do, and the file of its records.
    executor
        Where to do it.
    watch
        Updated after every path.
    retry
        Whether cases that failed in an earlier run are done again.
    function
        What workers do, as ``"module:name"``.

    Raises
    ------
    OutputError
        If the store cannot be written, or another process writes it.
    """
    with Store(path) as store:
        work = _Work(plan, Finished(path, retry=retry, quantity=stop_quantity(plan)))
        done = failed = 0
        stream = executor.run(function, work.tasks())
        try:
            for task, answer in stream:
                found: list[Record] = lost(task, answer) if isinstance(answer, Lost) else answer
                store.append(found)
                work.take(task, found)
                done += len(found)
                failed += sum(record["error"] is not None for record in found)
                watch.update(done, failed, work.known, plan.n_cases)
        finally:
            close = getattr(stream, "close", None)
            if close is not None:
                close()
    return RunSummary(done, failed, work.found)


def lost(task: Task, answer: Lost) -> list[Record]:
    """Records of the cases of a ``task`` that has ended its worker."""
    error = {"type": "WorkerLost", "message": answer.reason}
    failure = {"values": {}, "work": {}, "citations": [], "error": error}
    return [{"key": case["key"], **failure} for case in task["cases"]]


class _Work:
    """Tasks of a plan, made one by one, as long as samples are wanted."""

    def __init__(self, plan: Plan, finished: Finished) -> None:
        self._plan, self._finished, self._stop = plan, finished, stopping(plan)
        self._quantity = stop_quantity(plan)
        self.found = 0
        # a store may hold cases of an earlier version of the study too, which count for nothing
        self.known = sum(case.key in finished for path in plan.paths() for case in path) if len(finished) else 0

    def tasks(self) -> Iterator[Task]:
        """One task for each path with missing cases; of finished ones the samples are counted on
        the way."""
        for path in self._plan.paths():
            if self._stop is not None and self._stop.reached:
                return
            missing = [case for case in path if case.key not in self._finished]
            self.found += len(path) - len(missing)
            if self._stop is not None:
                for case in path:
                    if case.key in self._finished:
                        self._count(case.index, self._finished.value(case.key))
            if missing:
                yield {
                    "table": self._plan.table,
                    "folder": str(self._plan.base.folder.absolute()),
                    "quantities": list(self._plan.quantities),
                    "version": software()["asperity"],
                    "cases": [
                        {"key": case.key, "index": list(case.index), "edits": [plain(edit) for edit in case.edits]}
                        for case in missing
                    ],
                }

    def take(self, task: Task, found: Sequence[Record]) -> None:
        """Count the samples of an answered ``task``."""
        if self._stop is not None:
            for case, record in zip(task["cases"], found, strict=True):
                self._count(case["index"], record["values"].get(self._quantity, np.nan))

    def _count(self, index: Sequence[int], value: float) -> None:
        assert self._stop is not None
        rest = self._plan.shape[1:]
        self._stop.take(index[0], int(np.ravel_multi_index(tuple(index[1:]), rest)) if rest else 0, value)
