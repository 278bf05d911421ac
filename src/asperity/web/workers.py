"""Worker processes of the application: one task at a time each, with progress, cancel, limits of
memory and time.

A worker is that of studies (``studies.worker``), which is started without the page's own state and
ends with this process.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import signal
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..core.status import free_memory
from ..studies.local import worker_environment

TASKS = f"{__package__}.tasks"
"""Module with the functions that workers carry out."""

SHARE_OF_MEMORY = 0.8
"""Of the free memory, what one worker may take."""

CANCELLED = "Cancelled: the worker was stopped and nothing is half-written."


@dataclass(frozen=True)
class Limits:
    """Largest ``memory`` of a worker in bytes, and longest time of a task in ``seconds``."""

    memory: float
    seconds: float

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
        self._cancelled = False

    async def call(self, function: str, **task: Any) -> dict[str, Any]:
        """Answer of the function of that name in ``TASKS``; one with the key ``error`` says why
        there is none."""
        async with self._turn:
            self._cancelled = False
            try:
                return await asyncio.wait_for(self._answer(function, task), self.limits.seconds)
            except TimeoutError:
                self._kill()
                return {"error": f"Stopped after {self.limits.seconds:g} s, the longest time of a task (--time-limit)."}

    def cancel(self) -> None:
        """Stop at once whatever the worker is doing."""
        self._cancelled = True
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
        ended = f"signal {-code}" if code < 0 else f"exit code {code}"
        return {
            "error": f"The worker ended with {ended}, perhaps for lack of memory. What was finished before is "
            "kept; crop the surface or resample it to fewer points."
        }


@dataclass(frozen=True)
class Reported:
    """How far a task is: the ``stage``, the ``share`` of it that is done, and words on it."""

    stage: str = ""
    share: float = 0.0
    text: str = ""


def reported(file: Path) -> Reported:
    """What a worker has last written to ``file``."""
    try:
        return Reported(**json.loads(file.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return Reported()
