"""Threads for compiled passes: fixed blocks of work, shared out evenly."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cached_property
from importlib import import_module
from itertools import pairwise
from typing import Any

import numpy as np

from ..arrays import RealArray

FEW = 1 << 17
"""Points below which handing work to another thread costs more than it saves. Two threads on grids of 256² points took
half as long again as one, on 512² they make no difference, above they gain (two-core virtual machine)."""


class Blocks:
    """Runs compiled passes with a given number of threads. Numba takes long to import, so only when something runs."""

    def __init__(self, threads: int) -> None:
        self.threads = threads
        self._pool = ThreadPoolExecutor(threads - 1) if threads > 1 else None

    @cached_property
    def kernels(self) -> Any:
        """Passes over whole arrays."""
        return import_module(".kernels", __package__)

    @cached_property
    def face_kernels(self) -> Any:
        """Passes over working sets."""
        return import_module(".face_kernels", __package__)

    @cached_property
    def cell_kernels(self) -> Any:
        """Sweeps over nested cells."""
        return import_module(".cell_kernels", __package__)

    @cached_property
    def wave_kernels(self) -> Any:
        """Sweeps over nested cells that end at a convolution."""
        return import_module(".wave_kernels", __package__)

    def run(self, kernel: Callable[..., None], size: int, *arguments: Any) -> None:
        """Call ``kernel`` over all blocks of ``size`` elements."""
        blocks = -(-size // self.kernels.BLOCK)
        self.share(kernel, blocks, *arguments, alone=size < FEW)

    def share(self, kernel: Callable[..., None], parts: int, *arguments: Any, alone: bool) -> None:
        """Call ``kernel`` over ``parts`` parts of equal work, shared by the threads unless it is to run ``alone``."""
        if self._pool is None or alone:
            kernel((0, parts), *arguments)
            return
        shares = min(self.threads, parts)
        cuts = [parts * i // shares for i in range(shares + 1)]
        own, *others = pairwise(cuts)
        jobs = [self._pool.submit(kernel, span, *arguments) for span in others]
        kernel(own, *arguments)
        for job in jobs:
            job.result()

    def sums(self, kernel: Callable[..., None], size: int, columns: int, *arguments: Any) -> RealArray:
        """Per-block sums (blocks, columns) that ``kernel`` leaves in its last argument."""
        partial = np.zeros((-(-size // self.kernels.BLOCK), columns))
        self.run(kernel, size, *arguments, partial)
        return partial
