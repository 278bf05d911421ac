"""Worker processes on this machine."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import islice
from queue import SimpleQueue
from typing import IO, Any

from ..core import require
from .executors import Lost, Task

ATTEMPTS = 2
"""How often a task is tried that ends its worker, before it is given up."""


THREAD_VARIABLES = (
    "ASPERITY_THREADS",
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "NUMBA_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
)
"""Environment variables that set the number of threads of the libraries a worker uses."""


def available_cores() -> int:
    """Cores that this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity is not None else os.cpu_count() or 1


@dataclass(frozen=True)
class LocalProcesses:
    """Worker processes on this machine, by default one for each core, each with so many
    ``threads``.

    A worker that dies is replaced and its task tried once more. All workers end with this process,
    however it ends.
    """

    workers: int = field(default_factory=available_cores)
    threads: int = 1

    def __post_init__(self) -> None:
        require.integer(self.workers, 1, "number of workers", "Give 1 or more.")
        require.integer(self.threads, 1, "number of threads of a worker", "Give 1 or more.")

    def run(self, function: str, tasks: Iterator[Task]) -> Iterator[tuple[Task, Any | Lost]]:
        """Every task with its answer, as they are done."""
        with self.kept() as workers:
            yield from workers.run(function, tasks)

    @contextmanager
    def kept(self) -> Iterator[KeptProcesses]:
        """Processes that stay from one run to the next, and end with the context."""
        workers = KeptProcesses(self.workers, self.threads)
        try:
            yield workers
        finally:
            workers.end()


class KeptProcesses:
    """Worker processes that are started as tasks need them, and stay."""

    def __init__(self, workers: int, threads: int) -> None:
        self._most, self._threads = workers, threads
        self._lanes: list[_Lane] = []
        self._done: SimpleQueue[tuple[_Lane, Task, Any]] = SimpleQueue()

    def run(self, function: str, tasks: Iterator[Task]) -> Iterator[tuple[Task, Any | Lost]]:
        """Every task with its answer, as they are done."""
        busy = 0
        for number, task in enumerate(islice(tasks, self._most)):
            if number == len(self._lanes):
                self._lanes.append(_Lane(self._done, self._threads))
            self._lanes[number].orders.put((function, task))
            busy += 1
        while busy:
            lane, task, answer = self._done.get()
            following = next(tasks, None)
            if following is None:
                busy -= 1
            else:
                lane.orders.put((function, following))
            if isinstance(answer, BaseException):
                raise answer
            yield task, answer

    def end(self) -> None:
        """Stop all at once, whatever they are doing."""
        for lane in self._lanes:
            lane.end()
        for lane in self._lanes:
            lane.join()


class _Lane:
    """One worker process and the thread that serves it."""

    def __init__(self, done: SimpleQueue[Any], threads: int) -> None:
        self.orders: SimpleQueue[tuple[str, Task] | None] = SimpleQueue()
        self._done, self._ended = done, False
        self._lock, self._environment = threading.Lock(), worker_environment(threads)
        self._process: subprocess.Popen[str] | None = None
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def end(self) -> None:
        """Stop at once, whatever the worker is doing."""
        with self._lock:
            self._ended = True
            if self._process is not None:
                self._process.kill()
        self.orders.put(None)

    def join(self) -> None:
        """Wait until the process that was stopped is gone."""
        self._thread.join(timeout=10.0)

    def _serve(self) -> None:
        with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as output:
            try:
                while (given := self.orders.get()) is not None and not self._ended:
                    self._done.put((self, given[1], self._answer(*given, output)))
            except BaseException as error:  # raised again in the thread that waits for answers
                self._done.put((self, {}, error))
            finally:
                if self._process is not None:
                    self._process.communicate()

    def _answer(self, function: str, task: Task, output: IO[str]) -> Any | Lost:
        order = json.dumps({"function": function, "task": task}) + "\n"
        reason = ""
        for _ in range(ATTEMPTS):
            process = self._started(output)
            if process is None:
                break
            try:
                assert process.stdin is not None
                assert process.stdout is not None
                process.stdin.write(order)
                process.stdin.flush()
                line = process.stdout.readline()
            except OSError:
                line = ""
            if line.endswith("\n"):
                return json.loads(line)
            process.communicate()
            output.seek(0)
            last = " ".join(output.read().split())[-200:]
            code = process.returncode
            ended = f"signal {-code}" if code < 0 else f"exit code {code}"
            reason = f"the worker ended with {ended}{': ' + last if last else ', perhaps for lack of memory'}"
        return Lost(reason)

    def _started(self, output: IO[str]) -> subprocess.Popen[str] | None:
        """The worker, a new one if there is none or it has died; None when all is to end."""
        with self._lock:
            if self._ended:
                return None
            if self._process is None or self._process.poll() is not None:
                output.seek(0)
                output.truncate()
                self._process = subprocess.Popen(
                    [sys.executable, "-m", f"{__package__}.worker"],
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=output,
                    text=True,
                    encoding="utf-8",
                    env=self._environment,
                    start_new_session=True,  # Ctrl-C at the terminal is for this process, which ends the workers
                )
            return self._process


def worker_environment(threads: int) -> dict[str, str]:
    """Variables of a worker: so many threads in every library, and the modules that this process
    finds."""
    paths = os.pathsep.join(path for path in sys.path if path)
    return {**os.environ, **dict.fromkeys(THREAD_VARIABLES, str(threads)), "PYTHONPATH": paths}
