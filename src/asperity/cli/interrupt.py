"""Ctrl-C that is not lost: raised again at the next iteration where a library's callback swallowed it."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ..core.progress import Progress
from ..core.system import compiling


@contextmanager
def interruptible(progress: Progress) -> Iterator[Progress]:
    """``progress`` that raises KeyboardInterrupt if Ctrl-C came since the start.

    An exception raised by a signal inside a compiler's or the interpreter's own callback is printed and dropped by
    Python, or crashes the compiler; the first solve of a new installation compiles for seconds, and would go on for good.
    """
    if threading.current_thread() is not threading.main_thread():
        yield progress
        return
    guarded = _Guarded(progress)
    before, report = signal.signal(signal.SIGINT, guarded.interrupt), sys.unraisablehook
    sys.unraisablehook = lambda lost: None if lost.exc_type is KeyboardInterrupt else report(lost)  # not lost: kept
    try:
        yield guarded
    finally:
        signal.signal(signal.SIGINT, before)
        sys.unraisablehook = report


class _Guarded:
    def __init__(self, progress: Progress) -> None:
        self._progress = progress
        self._wanted = False

    def interrupt(self, number: int, frame: Any) -> None:
        """Handle the signal: remember it, and raise as Python does, unless inside the compiler."""
        self._wanted = True
        if not compiling():
            raise KeyboardInterrupt

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        """Stop if asked to, else report."""
        if self._wanted:
            raise KeyboardInterrupt
        self._progress.update(iteration, error, tolerance)
