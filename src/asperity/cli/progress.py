"""A bar on stderr for long work, only where somebody watches."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from ..core.progress import NoProgress, Progress
from .interrupt import interruptible

if TYPE_CHECKING:
    from rich.progress import Progress as Bar


@contextmanager
def shown(text: str) -> Iterator[Progress]:
    """Progress on a bar with ``text``, silent when stderr is not a terminal."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield NoProgress()
        return
    from rich.progress import BarColumn, TextColumn, TimeElapsedColumn
    from rich.progress import Progress as Bar

    from .show import error_console

    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[state]}"), TimeElapsedColumn())
    with Bar(*columns, console=error_console(), transient=True) as bar:
        yield OnBar(bar, text)


@contextmanager
def stage(text: str) -> Iterator[Progress]:
    """Progress of a stage of a run on a bar with ``text``, which Ctrl-C stops."""
    with shown(text) as bar, interruptible(bar) as progress:
        yield progress


class OnBar:
    """Progress of the error from its first value to the tolerance, on a logarithmic scale.

    Without a tolerance the error is the share of the work that is left.
    """

    def __init__(self, bar: Bar, text: str) -> None:
        self._bar = bar
        self._task = bar.add_task(text, total=1.0, state="")
        self._largest = 0.0

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        """Move the bar; it never moves back unless the error exceeds all earlier ones."""
        if tolerance == 0.0:
            self._bar.update(self._task, completed=1.0 - error, state=f"step {iteration}")
            return
        self._largest = max(self._largest, error)
        share = done(error, self._largest, tolerance)
        self._bar.update(self._task, completed=share, state=f"iteration {iteration}, error {error:.1e}")


def done(error: float, largest: float, tolerance: float) -> float:
    """Share of the way from the ``largest`` error to the ``tolerance``, between 0 and 1."""
    if error <= tolerance:
        return 1.0
    if not tolerance > 0.0 or not tolerance < largest < math.inf or not error < math.inf:
        return 0.0
    return min(1.0, max(0.0, math.log(largest / error) / math.log(largest / tolerance)))
