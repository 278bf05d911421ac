"""Worker processes of the application: one task at a time each, with progress, cancel, limits of
memory and time.

A worker is that of studies (``studies.worker``), which is started without the page's own state and
ends with this process.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import math
import os
import signal
import sys
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..core.status import free_memory
from ..studies.local import worker_environment

TASKS = f"{__package__}.tasks"
"""Module with the functions that workers carry out."""

SHARE_OF_MEMORY = 0.8
"""Of the free memory, what all workers together may take."""

LOOK = 0.25
"""Seconds between looks at what the workers take."""

CANCELLED = "Cancelled: the worker was stopped and nothing is half-written."


class Together:
    """What all workers share: so many runs work ``at_once`` and others wait for their turn, and all
    of them may work for so many ``seconds``, added up."""

    def __init__(self, at_once: int = 4, seconds: float = math.inf) -> None:
        self.turns, self.seconds = asyncio.Semaphore(at_once), seconds
        self._since: dict[Worker, float] = {}
        self._spent = 0.0
        self._watch: asyncio.Task[None] | None = None

    def begins(self, worker: Worker) -> None:
        """``worker`` begins a task."""
        self._since[worker] = time.monotonic()
        if self._watch is None or self._watch.done():
            self._watch = asyncio.get_running_loop().create_task(self._look())

    def ends(self, worker: Worker) -> None:
        """``worker`` has ended its task."""
        self._spent += time.monotonic() - self._since.pop(worker)

    async def _look(self) -> None:
        """Stop the worker that began last while all of them take too much memory, and all of them
        when their time is over."""
        while self._since:
            await asyncio.sleep(LOOK)
            now = time.monotonic()
            if self._spent + sum(now - since for since in self._since.values()) > self.seconds:
                for worker in self._since:
                    worker.stop(
                        f"Stopped: all runs together may take {self.seconds:g} s (--total-time), which are over. "
                        "Start the application again."
                    )
                continue
            taken = {worker: memory_of(worker.process) for worker in self._since}
            if taken and sum(taken.values()) > (most := min(worker.limits.memory for worker in taken)):
                last = max(taken, key=lambda worker: self._since[worker])
                last.stop(
                    f"Stopped: all workers together may take {most / 2**30:.3g} GiB of memory (--memory), and this one "
                    f"began last; it had {taken[last] / 2**30:.3g} GiB. Run it when others are done, crop the surface "
                    "or resample it to fewer points."
                )


def memory_of(process: int | None) -> float:
    """Bytes of memory of a ``process`` and those that it has started, as far as the system tells;
    libraries in common are not counted."""
    if process is None:
        return 0.0
    folder, found = Path(f"/proc/{process}"), 0.0
    with contextlib.suppress(OSError, ValueError):
        for line in (folder / "status").read_text(encoding="ascii", errors="replace").splitlines():
            if line.startswith(("RssAnon:", "RssShmem:", "VmSwap:")):
                found += 1024.0 * float(line.split()[1])
        for thread in (folder / "task").iterdir():
            found += sum(memory_of(int(child)) for child in (thread / "children").read_text(encoding="ascii").split())
    return found


@dataclass(frozen=True)
class Limits:
    """Largest ``memory`` of all workers together in bytes, longest time of a task in ``seconds``,
    and what they share else."""

    memory: float
    seconds: float
    together: Together = field(default_factory=Together, compare=False)

    @classmethod
    def usual(cls, seconds: float = 12 * 3600.0) -> Limits:
        """Most of the memory that is free now, and half a day."""
        return cls(SHARE_OF_MEMORY * free_memory(), seconds)


class Worker:
    """One process that answers tasks one after the other; started when it is first needed, and
    again after it was stopped."""

    def __init__(self, limits: Limits, threads: int) -> None:
        self.limits, self._threads = limits, threads
        self._process: asyncio.subprocess.Process | None = None
        self._turn = asyncio.Lock()
        self._cancelled, self._reason = False, ""
        self._given_up = asyncio.Event()
        self.waiting = False

    @property
    def process(self) -> int | None:
        """Number of the process, if it is there."""
        return None if self._process is None else self._process.pid

    async def run(self, function: str, **task: Any) -> dict[str, Any]:
        """Like ``call``, but not before it is the turn of this run; until then it may be
        cancelled, too."""
        turn = asyncio.ensure_future(self.limits.together.turns.acquire())
        given_up = asyncio.ensure_future(self._given_up.wait())
        self.waiting = True
        await asyncio.wait((turn, given_up), return_when=asyncio.FIRST_COMPLETED)
        self.waiting = False
        given_up.cancel()
        try:
            if self._given_up.is_set():
                return {"error": CANCELLED, "cancelled": True}
            return await self.call(function, **task)
        finally:
            if turn.done():
                self.limits.together.turns.release()
            turn.cancel()

    async def call(self, function: str, **task: Any) -> dict[str, Any]:
        """Answer of the function of that name in ``TASKS``; one with the key ``error`` says why
        there is none."""
        async with self._turn:
            self._cancelled, self._reason = False, ""
            self.limits.together.begins(self)
            try:
                return await asyncio.wait_for(self._answer(function, task), self.limits.seconds)
            except asyncio.CancelledError:
                self._kill()  # what it would still answer would be taken for the answer to the next task
                raise
            except TimeoutError:
                self._kill()
                return {"error": f"Stopped after {self.limits.seconds:g} s, the longest time of a task (--time-limit)."}
            finally:
                self.limits.together.ends(self)

    def cancel(self) -> None:
        """Stop at once whatever the worker is doing, or is to do."""
        self._cancelled = True
        self._given_up.set()
        self._kill()

    def stop(self, reason: str) -> None:
        """Stop what the worker is doing for a ``reason`` that is said."""
        self._reason = reason
        self._kill()

    async def end(self) -> None:
        """Stop, and wait until the process is gone."""
        process = self._process
        self.cancel()
        if process is not None:
            await process.wait()
            await asyncio.sleep(0)  # its pipes are closed in the next round of the loop

    def _kill(self) -> None:
        process, self._process = self._process, None
        if process is not None and process.returncode is None:
            with contextlib.suppress(ProcessLookupError):
                if hasattr(os, "killpg"):
                    os.killpg(process.pid, signal.SIGKILL)
                else:
                    process.kill()

    async def _answer(self, function: str, task: Mapping[str, Any]) -> dict[str, Any]:
        if self._process is None or self._process.returncode is not None:
            self._process = await asyncio.create_subprocess_exec(
                sys.executable,
                "-m",
                "asperity.studies.worker",
                stdin=asyncio.subprocess.PIPE,
                stdout=asyncio.subprocess.PIPE,
                stderr=asyncio.subprocess.DEVNULL,
                env=worker_environment(self._threads),
                start_new_session=True,
                limit=256 * 2**20,
            )
        process = self._process
        assert process.stdin is not None
        assert process.stdout is not None
        memory = None if self.limits.memory == float("inf") else self.limits.memory
        order = {"function": f"{TASKS}:{function}", "task": {**task, "memory": memory}}
        with contextlib.suppress(ConnectionError):
            process.stdin.write(json.dumps(order).encode() + b"\n")
            await process.stdin.drain()
        line = await process.stdout.readline()
        if line.endswith(b"\n"):
            found: dict[str, Any] = json.loads(line)
            return found
        code = await process.wait()
        self._process = None
        if self._cancelled:
            return {"error": CANCELLED, "cancelled": True}
        if self._reason:
            return {"error": self._reason}
        ended = f"signal {-code}" if code < 0 else f"exit code {code}"
        return {
            "error": f"The worker ended with {ended}, perhaps for lack of memory. What was finished before is "
            "kept; crop the surface or resample it to fewer points."
        }
