"""Time that something takes, as benchmarks measure it on a machine with other work."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np


def timed(run: Callable[[], Any], repeats: int, *, before: int = 0) -> tuple[Any, float]:
    """What ``run`` gives, and its least processor time in s, after as many runs ``before`` that do
    not count."""
    for _ in range(before):
        run()
    best, found = np.inf, None
    for _ in range(repeats):
        start = time.process_time()
        found = run()
        best = min(best, time.process_time() - start)
    return found, best
