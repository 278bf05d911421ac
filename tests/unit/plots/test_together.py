"""Figures drawn by several processes are those that one draws, and none is lost whatever becomes of
another process."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

import asperity as asp
from asperity.core.engine import blocks, cpu
from asperity.core.engine.cpu import CpuEngine
from asperity.plots import together
from asperity.plots.contact import contact_figures
from asperity.plots.picture import Drawing, Figure
from asperity.plots.together import draw_all, drawing

HERE = os.getpid()
COPIES = pytest.mark.skipif(sys.platform != "linux", reason="only Linux copies processes safely")


def pipes() -> set[str]:
    """The pipes that are open, as Linux tells them."""
    links = Path("/proc/self/fd").glob("*") if sys.platform == "linux" else ()
    found = set()
    for link in links:
        with suppress(FileNotFoundError):  # that of the listing itself
            found.add(str(link.readlink()))
    return {target for target in found if target.startswith(("pipe:", "socket:"))}


@pytest.fixture(autouse=True)
def nothing_left() -> Iterator[None]:
    """No other process is left, and no end of a pipe is open."""
    before = pipes()
    yield
    with pytest.raises(ChildProcessError):
        os.waitpid(-1, os.WNOHANG)
    assert pipes() == before


def figures(draw: Callable[[], bytes], count: int = 8) -> list[Figure]:
    return [Figure(f"figure_{number}", "Figure", "Text.", lambda: Drawing(draw())) for number in range(count)]


def own_number() -> bytes:
    time.sleep(0.02)
    return str(os.getpid()).encode()


def test_pictures_and_curves_are_those_of_one_process() -> None:
    surface = asp.generate.sphere(asp.Grid((32, 24), (1e-7, 1e-7)), radius=2e-5)
    result = asp.solve(asp.ContactProblem(surface, asp.Elastic(1e9, 0.3), boundary=asp.Free()), asp.Force(1e-7))
    alone, beside = contact_figures(result), contact_figures(result)
    draw_all(alone, 1)
    draw_all(beside, 3)
    for one, other in zip(alone, beside, strict=True):
        assert one.picture == other.picture
        assert one.caption == other.caption
        for first, second in zip(one.drawing.curves, other.drawing.curves, strict=True):
            assert (first.box, first.x, first.y) == (second.box, second.x, second.y)
            for (name, *points), (other_name, *others) in zip(first.curves, second.curves, strict=True):
                assert name == other_name
                np.testing.assert_array_equal(points, others)


@COPIES
def test_others_draw_while_the_body_runs_and_each_figure_is_drawn_once() -> None:
    shown = figures(own_number)
    with drawing(shown, 3):
        time.sleep(1.0)
    drawn_by = [figure.picture for figure in shown]
    assert str(HERE).encode() not in drawn_by  # the others had the time to draw all
    assert 1 <= len(set(drawn_by)) <= 2
    draw_all(shown, 3)
    assert [figure.picture for figure in shown] == drawn_by


@pytest.mark.parametrize("processes", [1, 2])
def test_few_figures_one_process_or_another_system(processes: int, monkeypatch: pytest.MonkeyPatch) -> None:
    some, all_figures = figures(own_number, 2), figures(own_number)
    draw_all(some, 4)
    if processes > 1:
        monkeypatch.setattr(sys, "platform", "darwin")
    draw_all(all_figures, processes)
    assert {figure.picture for figure in (*some, *all_figures)} == {str(HERE).encode()}


@COPIES
def test_figures_of_a_process_that_dies_are_drawn_here() -> None:
    def draw() -> bytes:
        if os.getpid() != HERE:
            os.kill(os.getpid(), signal.SIGKILL)
        return own_number()

    shown = figures(draw)
    draw_all(shown, 3)
    assert {figure.picture for figure in shown} == {str(HERE).encode()}


@COPIES
def test_figures_of_a_process_that_never_ends_are_drawn_here(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(together, "PATIENCE", 0.2)

    def draw() -> bytes:
        if os.getpid() != HERE:
            time.sleep(600.0)
        return own_number()

    shown = figures(draw)
    draw_all(shown, 3)
    assert {figure.picture for figure in shown} == {str(HERE).encode()}


def test_an_error_in_a_figure_is_raised_here() -> None:
    def draw() -> bytes:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        draw_all(figures(draw), 2)


def test_the_others_end_with_an_interrupted_body() -> None:
    shown = figures(own_number)
    with pytest.raises(KeyboardInterrupt), drawing(shown, 3):
        raise KeyboardInterrupt
    assert not any(figure.is_drawn for figure in shown)


@COPIES
def test_a_system_that_makes_no_process(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse() -> int:
        raise BlockingIOError

    monkeypatch.setattr(os, "fork", refuse)
    shown = figures(own_number)
    draw_all(shown, 3)
    assert {figure.picture for figure in shown} == {str(HERE).encode()}


def test_passes_of_a_copy_need_no_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    """The threads of an engine are not in the copy of a process; its passes are shared out there no
    more."""
    for module in (blocks, cpu):
        monkeypatch.setattr(module, "SERIAL_BELOW", 0)
    engine = CpuEngine(threads=3)
    coarse = np.random.default_rng(1).standard_normal((16, 16))

    def draw() -> bytes:
        return engine.interpolated(coarse, (32, 32), (True, True)).tobytes()

    expected = draw()
    assert threading.active_count() > 1
    shown = figures(draw)
    with drawing(shown, 2):
        time.sleep(0.5)
    assert {figure.picture for figure in shown} == {expected}
