"""Every solver in a process of its own, so that no library's threads or settings touch another's
timing."""

from __future__ import annotations

import multiprocessing
import os
import time
from dataclasses import dataclass
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess

import numpy as np
from method import Method, Solved
from numpy.typing import NDArray

_WARM_UP = 128


def _make(kind: str, threads: int) -> Method:
    """The solver called ``kind``; imports happen here, in the process that uses it."""
    from ours import SOLVERS, BarePair, Ours
    from peers import make

    if kind == "fft pair":
        return BarePair(threads)
    return Ours(kind, threads) if kind in SOLVERS else make(kind, threads)


def _serve(kind: str, threads: int, link: Connection) -> None:
    """Answer solves until the link closes; the first, small one compiles and plans."""
    from surfaces import self_affine

    try:
        method = _make(kind, threads)
        method.solve(np.array(self_affine(_WARM_UP).heights), 0.05, 1e-4)
    except Exception as error:
        link.send(error)
        return
    link.send((method.name, method.version, method.threads))
    while (task := link.recv()) is not None:
        heights, load, tolerance = task
        if not method.supports(heights.shape[0]):
            link.send(RuntimeError(f"{method.name} does not take grids of {heights.shape[0]} points per side."))
            continue
        try:
            began = time.process_time()
            solved = method.solve(heights, load, tolerance)
            solved.counts["cpu_seconds"] = time.process_time() - began
            link.send(solved)
        except Exception as error:
            link.send(RuntimeError(str(error)))


@dataclass
class Worker:
    """Process of one solver."""

    kind: str
    name: str
    version: str
    threads: int
    process: BaseProcess
    link: Connection

    def solve(self, heights: NDArray[np.float64], load: float, tolerance: float) -> Solved:
        """Solve there; what goes wrong there is raised here."""
        self.link.send((heights, load, tolerance))
        answer = self.link.recv()
        if isinstance(answer, Exception):
            raise answer
        return answer

    def close(self) -> None:
        self.link.send(None)
        self.process.join()


def start(kind: str, threads: int) -> Worker:
    """Start the process of ``kind`` with ``threads`` threads for every library that listens to
    OMP_NUM_THREADS."""
    for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "ASPERITY_THREADS"):
        os.environ[variable] = str(threads)
    context = multiprocessing.get_context("spawn")
    here, there = context.Pipe()
    process = context.Process(target=_serve, args=(kind, threads, there), daemon=True)
    process.start()
    there.close()
    answer = here.recv()
    if isinstance(answer, Exception):
        raise RuntimeError(f"{kind} does not start: {answer}")
    return Worker(kind, *answer, process, here)
