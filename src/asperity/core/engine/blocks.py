"""Threads for compiled passes: fixed blocks of work, shared out evenly."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache, cached_property
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from threading import Thread
from typing import Any

SERIAL_BELOW = 1 << 19
"""Points below which handing a pass of the solver, which takes some 0.1 ms, to another thread costs
more than it saves. With two threads from 2^17 points on a solve took 61 ms at 512² instead of 47,
and 198 ms at 1024² instead of 155 (one thread: 180; two-core virtual machine)."""

LONG_SERIAL_BELOW = 1 << 17
"""The same for work that takes ten times as long for each point: planes of stresses, displacements
retarded in time."""


class Blocks:
    """Runs compiled passes with a given number of threads. Numba takes long to import, so only when
    something runs."""

    def __init__(self, threads: int) -> None:
        self.threads = threads
        self._pool = ThreadPoolExecutor(threads - 1) if threads > 1 else None
        self._process = os.getpid()

    @cached_property
    def kernels(self) -> Any:
        """Passes over whole arrays and over free sets."""
        passes = import_module(".kernels", __package__)
        if self.threads > 1:
            _compile_beside(passes.survey)
        return passes

    def run(self, kernel: Callable[..., None], size: int, *arguments: Any) -> None:
        """Call ``kernel`` over all blocks of ``size`` elements."""
        blocks = -(-size // self.kernels.BLOCK)
        self.share(kernel, blocks, *arguments, serial=size < SERIAL_BELOW)

    def share(self, kernel: Callable[..., None], parts: int, *arguments: Any, serial: bool) -> None:
        """Call ``kernel`` over ``parts`` parts of equal work, shared by the threads unless
        ``serial``."""
        if self._pool is None or serial or self._process != os.getpid():  # a copy of the process has no other thread
            kernel((0, parts), *arguments)
            return
        shares = min(self.threads, parts)
        cuts = [parts * i // shares for i in range(shares + 1)]
        own, *others = pairwise(cuts)
        jobs = [self._pool.submit(kernel, span, *arguments) for span in others]
        kernel(own, *arguments)
        for job in jobs:
            job.result()


@cache
def _compile_beside(first: Any) -> None:
    """Let a second process compile part of what a solve needs (``first_use``), unless ``first``, an
    early pass, has been compiled here before."""
    interpreter = None if getattr(sys, "frozen", False) else sys.executable
    # an application of its own, or Numba is told not to compile
    if not interpreter or not hasattr(first, "stats"):
        return
    # whether the cache on disk holds the pass for this Python and as its source is now
    function, version = first.py_func, sys.version_info
    name = f"{function.__module__.rpartition('.')[2]}.{function.__name__}"
    indices = Path(first.stats.cache_path).glob(f"{name}-*.py{version.major}{version.minor}*.nbi")
    try:
        changed = Path(function.__code__.co_filename).stat().st_mtime
        if any(index.stat().st_mtime >= changed for index in indices):
            return
    except OSError:  # the source is in an archive
        return
    options: dict[str, Any] = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    options["creationflags"] = getattr(subprocess, "CREATE_NO_WINDOW", 0)  # of Windows
    # the thread waits for its end, so that the system can forget it; the interpreter does not wait
    # for the thread
    command = [interpreter, "-m", f"{__package__}.first_use"]
    Thread(target=subprocess.call, args=(command,), kwargs=options, daemon=True).start()
