"""Progress of a campaign: a bar on a terminal, otherwise a line at intervals; with rate and remaining time."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..studies.run import Watch

BETWEEN_LINES = 10.0
"""Seconds between two lines where nobody watches a bar."""


@contextmanager
def watched(title: str) -> Iterator[Watch]:
    """Watch that shows the progress of a study on stderr, on a bar or in lines that begin with its ``title``."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield Lines(lambda text: _write(f"{title}: {text}\n"))
        return
    from rich.progress import BarColumn, Progress, TextColumn

    from .show import error_console

    with Progress(BarColumn(24), TextColumn("{task.description}"), console=error_console()) as bar:
        task = bar.add_task("starting workers", total=None)

        def shown(text: str, share: float) -> None:
            bar.update(task, description=text, total=1.0, completed=share)

        yield OnBar(shown)


class Pace:
    """Cases per second since the first answer, and what that leaves to wait."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._started = clock()

    def text(self, done: int, failed: int, found: int, total: int) -> tuple[str, float]:
        """One line on the state of the study, and the share that is done."""
        seconds = max(self._clock() - self._started, 1e-9)
        rate = done / seconds
        left = max(total - found - done, 0) / rate if rate > 0.0 else float("inf")
        share = min(1.0, (found + done) / max(total, 1))
        failures = f", {failed} failed" if failed else ""
        return f"{found + done} of {total} cases{failures}, {_rate(rate)}, {duration(left)} left", share


class Lines:
    """Says how it goes every ten seconds, and at the end of the last case."""

    def __init__(self, write: Callable[[str], None], clock: Callable[[], float] = time.monotonic) -> None:
        self._write, self._clock, self._pace = write, clock, Pace(clock)
        self._last = clock()

    def update(self, done: int, failed: int, found: int, total: int) -> None:
        """Write a line if it is time for one."""
        if self._clock() - self._last >= BETWEEN_LINES or found + done >= total:
            self._last = self._clock()
            self._write(self._pace.text(done, failed, found, total)[0])


class OnBar:
    """Moves a bar."""

    def __init__(self, shown: Callable[[str, float], None]) -> None:
        self._shown, self._pace = shown, Pace()

    def update(self, done: int, failed: int, found: int, total: int) -> None:
        """Move it."""
        self._shown(*self._pace.text(done, failed, found, total))


def duration(seconds: float) -> str:
    """``seconds`` as 3 s, 2 min 05 s, 1 h 20 min."""
    if not seconds < 1e9:
        return "unknown time"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"


def _rate(rate: float) -> str:
    return f"{rate:.3g} cases/s" if rate >= 1.0 else f"{rate * 60.0:.3g} cases/min"


def _write(text: str) -> None:
    if sys.stderr is not None:
        sys.stderr.write(text)
        sys.stderr.flush()
