"""Figures drawn by several processes at once, and written as files."""

from __future__ import annotations

import gc
import os
import pickle
import selectors
import signal
import sys
import warnings
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from ..core.errors import OutputError
from ..core.spectral import thread_count
from ..io.atomic import atomic_file, require_new_files
from .picture import Drawing, Figure

LEAST = 4
"""Figures below which no other process draws: to make one takes some 20 ms, to draw a figure some
0.2 s."""

MOST = 4
"""Processes at most: each holds copies of the fields that it draws."""

PATIENCE = 60.0
"""Time in s for which other processes are waited for when nothing is left to draw; then their
figures are drawn here."""


@contextmanager
def drawing(figures: Iterable[Figure], processes: int | None = None) -> Iterator[None]:
    """Draw ``figures`` by other processes while the body runs; at its end this one draws beside
    them, until all are drawn.

    Matplotlib draws with one thread only. The other processes are copies of this one (``fork``), so
    that nothing is imported or handed over; only Linux makes them safely, and elsewhere this
    process draws alone. Whatever becomes of another process, its figures are drawn here if it has
    not delivered them.

    Parameters
    ----------
    figures
        What to draw; those that are drawn already are left as they are.
    processes
        Number of processes that draw, with this one; by default that of ``thread_count``.
    """
    waiting = [figure for figure in figures if not figure.is_drawn]
    numbers, others = _Numbers(len(waiting)), list[_Process]()
    try:
        # elsewhere than on Linux, or with the state of a GPU in it, a copy of this process may fail
        if sys.platform == "linux" and "cupy" not in sys.modules and len(waiting) >= LEAST:
            import matplotlib.backends.backend_agg  # noqa: F401  # once, before there are copies

            count = min(thread_count(processes), MOST, len(waiting) // 2) - 1
            others += filter(None, (_Process.started(waiting, numbers) for _ in range(count)))
        yield
        for number in numbers:
            _ = waiting[number].drawing
        for other in others:
            for number, made in other.delivered().items():
                waiting[number].keep(made)
    finally:
        numbers.close()
        for other in others:
            other.end()
    for figure in waiting:
        _ = figure.drawing


def draw_all(figures: Iterable[Figure], processes: int | None = None) -> None:
    """Draw ``figures``, with other processes as ``drawing`` does."""
    with drawing(figures, processes):
        pass


def save_pictures(
    figures: Iterable[Figure], folder: str | Path, *, processes: int | None = None, overwrite: bool = False
) -> tuple[Path, ...]:
    """Write ``figures`` under their names as PNG into ``folder`` (made if missing); drawn as by
    ``drawing``.

    Raises OutputError if a file exists and ``overwrite`` is false, or the folder cannot be made or
    written.
    """
    place, all_figures = Path(folder), tuple(figures)
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(
            f"folder of the plots {place} cannot be made: {error.strerror}; choose another.",
            subject="folder of the plots",
        ) from error
    paths = tuple(place / f"{figure.name}.png" for figure in all_figures)
    require_new_files(paths, overwrite=overwrite)
    draw_all(all_figures, processes)
    for figure, path in zip(all_figures, paths, strict=True):
        with atomic_file(path, overwrite=overwrite) as file:
            file.write_bytes(figure.picture)
    return paths


class _Numbers:
    """The numbers 0 to ``count`` − 1, each of which goes to one of the processes that iterate over
    them."""

    def __init__(self, count: int) -> None:
        self._read, write = os.pipe()
        os.write(write, b"".join(number.to_bytes(2) for number in range(count)))  # a pipe holds 2¹⁵ of them
        os.close(write)

    def __iter__(self) -> Iterator[int]:
        while found := os.read(self._read, 2):
            yield int.from_bytes(found)

    def close(self) -> None:
        os.close(self._read)


@dataclass(frozen=True)
class _Process:
    """Another process that draws."""

    number: int
    answer: BinaryIO

    @classmethod
    def started(cls, figures: Sequence[Figure], numbers: _Numbers) -> _Process | None:
        """A copy of this process that draws those of ``figures`` whose ``numbers`` it gets; None if
        the system makes none."""
        out, into = os.pipe()
        receiver, sender = os.fdopen(out, "rb"), os.fdopen(into, "wb")
        with warnings.catch_warnings(), sender:
            # it warns of copies of processes with threads: these draw with one only
            warnings.simplefilter("ignore", DeprecationWarning)
            try:
                number = os.fork()
            except (OSError, RuntimeError):  # no memory for it, or an interpreter within another
                receiver.close()
                return None
            if number == 0:
                # the copy draws and ends: it neither goes on with the work of this process nor
                # cleans up after it
                try:
                    gc.freeze()
                    pickle.dump({place: figures[place].drawing for place in numbers}, sender)
                    sender.flush()
                finally:
                    os._exit(0)
        return cls(number, receiver)

    def delivered(self) -> dict[int, Drawing]:
        """What it has drawn, by number; nothing if it has failed or takes too long."""
        with suppress(EOFError, OSError, pickle.UnpicklingError), selectors.DefaultSelector() as waiting:
            waiting.register(self.answer, selectors.EVENT_READ)
            if waiting.select(PATIENCE):
                made: dict[int, Drawing] = pickle.load(self.answer)
                return made
        return {}

    def end(self) -> None:
        """End it, whatever it does, and let the system forget it."""
        self.answer.close()
        with suppress(ChildProcessError):
            if os.waitpid(self.number, os.WNOHANG) == (0, 0):
                os.kill(self.number, signal.SIGKILL)
                os.waitpid(self.number, 0)
