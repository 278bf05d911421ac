"""The progress bar: only on a terminal, on a logarithmic scale."""

from __future__ import annotations

import contextlib
import importlib
import io
import math
import signal

import pytest
from rich.console import Console
from rich.progress import Progress as Bar

from asperity.cli.show import OnBar, interruptible, shown
from asperity.core.status import NoProgress, share_done


def test_silent_without_a_terminal() -> None:
    with shown("solving") as progress:
        assert isinstance(progress, NoProgress)


def test_bar_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    with shown("solving") as progress:
        assert isinstance(progress, OnBar)
        progress.update(1, 1.0, 1e-6)


def test_share_is_logarithmic() -> None:
    assert share_done(1.0, 1.0, 1e-6) == 0.0
    assert share_done(1e-3, 1.0, 1e-6) == pytest.approx(0.5)
    assert share_done(1e-7, 1.0, 1e-6) == 1.0
    assert share_done(math.inf, math.inf, 1e-6) == 0.0
    assert share_done(math.nan, 1.0, 1e-6) == 0.0


def test_bar_follows_the_error() -> None:
    with Bar(console=Console(file=io.StringIO())) as bar:
        progress = OnBar(bar, "solving")
        for iteration, error in enumerate((1.0, 1e-2, 1e-4)):
            progress.update(iteration, error, 1e-4)
        assert bar.tasks[0].completed == 1.0
        assert "iteration 2" in bar.tasks[0].fields["state"]


def test_a_swallowed_interrupt_comes_back_at_the_next_iteration():
    handler = signal.getsignal(signal.SIGINT)
    with interruptible(NoProgress()) as progress:
        progress.update(1, 1.0, 1e-6)
        with contextlib.suppress(KeyboardInterrupt):  # as a callback of a compiler does
            signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            progress.update(2, 0.5, 1e-6)
    assert signal.getsignal(signal.SIGINT) is handler


def test_an_interrupt_inside_the_compiler_waits_for_the_next_iteration():
    lock = importlib.import_module("numba.core.compiler_lock").global_compiler_lock
    with interruptible(NoProgress()) as progress:
        with lock:
            signal.raise_signal(signal.SIGINT)  # raises nothing
        with pytest.raises(KeyboardInterrupt):
            progress.update(1, 1.0, 1e-6)
    with interruptible(NoProgress()), pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
