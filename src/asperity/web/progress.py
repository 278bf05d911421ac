"""How far a run is: written by its worker, read by the pages that show it."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path

from ..core.status import Progress, share_done
from ..io.atomic import atomic_file
from ..parts.part import Solved

OFTEN = 0.1
"""Seconds between two reports."""

LOOKED = 1.0
"""Seconds between two steps that are made visible while others are solved, at least."""

SHARE = 0.15
"""Share of the time of a run that making steps visible may take."""

RECENT = 5
"""Steps whose time tells how long the next ones take."""


@dataclass(frozen=True)
class Reported:
    """How far a task is.

    Attributes
    ----------
    stage, share, text
        What is done, the share of it that is done, and words on it.
    left
        Seconds until the stage ends; None where nobody can know.
    curve
        Mean pressure (Pa) and share of the points that touch, of each step so far.
    """

    stage: str = ""
    share: float = 0.0
    text: str = ""
    left: float | None = None
    curve: list[list[float]] = field(default_factory=list)

    def write(self, file: Path) -> None:
        """Write it to ``file``."""
        with atomic_file(file, overwrite=True) as partial:
            partial.write_text(json.dumps(asdict(self)), encoding="utf-8")

    @property
    def in_words(self) -> str:
        """Stage, how far it is, and the time left."""
        return ", ".join(filter(None, (self.stage, self.text, "" if self.left is None else time_left(self.left))))


def reported(file: Path) -> Reported:
    """What a worker has last written to ``file``."""
    try:
        return Reported(**json.loads(file.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return Reported()


def time_left(seconds: float) -> str:
    """Words on the time until something ends."""
    if seconds < 5.0:
        return "a few seconds left"
    if seconds < 100.0:
        return f"about {5 * round(seconds / 5.0)} s left"
    if seconds < 90.0 * 60.0:
        return f"about {round(seconds / 60.0)} min left"
    return f"about {seconds / 3600.0:.1f} h left"


class Watch:
    """Reports to ``file`` what a run of so many ``steps`` does, and makes them visible by ``show``
    as they are solved."""

    def __init__(self, file: Path, show: Callable[[Solved], object], steps: int = 0) -> None:
        self._file, self._show, self.steps = file, show, steps
        self._stage, self._began, self._last = "", time.monotonic(), 0.0
        self._largest, self._done = 0.0, 0
        self._curve: list[list[float]] = []
        self._ends = [self._began]
        self._shown, self._showing = -LOOKED, 0.0

    @contextmanager
    def stage(self, name: str) -> Iterator[Progress]:
        """A stage of the run, as ``execute`` wants it."""
        self._stage, self._began, self._largest = name, time.monotonic(), 0.0
        self._ends = [self._began]
        self._report(0.0, "")
        yield self

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        """Report how far the stage is, ten times a second at most."""
        if time.monotonic() - self._last < OFTEN:
            return
        self._largest = max(self._largest, error)
        text = f"iteration {iteration}, error {error:.1e}"
        if tolerance == 0.0:  # shares of a count
            self._report(1.0 - error, f"step {iteration}", self._after(1.0 - error))
        elif self.steps > 1 and self._done < self.steps:
            self._report(self._done / self.steps, f"step {self._done + 1} of {self.steps}, {text}", self._path_left())
        else:
            share = share_done(error, self._largest, tolerance)
            self._report(share, text, self._after(share))

    def reached(self, solved: Solved) -> None:
        """A step is solved: report it, and show it unless that would take too much of the time."""
        self._done, self._largest = self._done + 1, 0.0
        self._ends = [*self._ends[-RECENT:], time.monotonic()]
        result = solved.result
        self._curve.append([float(result.mean_pressure), float(result.area_fraction)])
        now = time.monotonic()
        rested = now - self._shown > max(LOOKED, self._showing / SHARE)
        if rested or self._done == self.steps:
            self._show(solved)
            self._shown, self._showing = time.monotonic(), time.monotonic() - now
            self._ends[-1] = self._shown
        if self.steps > 1:
            self._report(self._done / self.steps, f"step {self._done} of {self.steps}", self._path_left())

    def _path_left(self) -> float | None:
        """Seconds until all steps are solved, from the last ones."""
        if len(self._ends) < 2:
            return None
        each = (self._ends[-1] - self._ends[0]) / (len(self._ends) - 1)
        return max(0.0, each * (self.steps - self._done) - (time.monotonic() - self._ends[-1]))

    def _after(self, share: float) -> float | None:
        """Seconds until the stage ends, from the ``share`` of it that is done."""
        spent = time.monotonic() - self._began
        return spent * (1.0 / share - 1.0) if share > 0.1 and spent > 1.0 else None

    def _report(self, share: float, text: str, left: float | None = None) -> None:
        self._last = time.monotonic()
        Reported(self._stage, float(share), text, left, self._curve).write(self._file)
