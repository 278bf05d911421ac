"""Limits of all runs and all uploads together."""

from __future__ import annotations

import asyncio
import http.client
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.web.workers import LOOK, Limits, Together, Worker, memory_of

from .app_server import AppServer
from .expecting import expect
from .test_app import LONG, base_of, finished, go
from .test_app_uploads import drop

SURFACE = {"kind": "flat", "points": "16x16", "size": "1 um x 1 um"}
MIB = 2**20


def in_loop(work: Callable[[], Any]) -> Any:
    """What the coroutine that ``work`` makes gives; the loop of Playwright may be running in this
    thread."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(lambda: asyncio.run(work())).result()


@dataclass(eq=False)
class Holding:
    """Stands for a worker whose process holds so many ``bytes``, half of them in a process of its
    own."""

    limits: Limits
    bytes: int
    stopped: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        half = f"held = bytearray({self.bytes // 2})\nfor at in range(0, len(held), 4096): held[at] = 1\n"
        child = f"{half}print('held', flush=True); input()"
        code = (
            f"import subprocess, sys, threading\n{half}"
            f"start = lambda: subprocess.Popen([sys.executable, '-c', {child!r}], stdin=subprocess.PIPE)\n"
            "made = []\nthread = threading.Thread(target=lambda: made.append(start()) or input())\nthread.start()"
        )
        self.running = subprocess.Popen(
            [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        assert self.running.stdout is not None
        assert self.running.stdout.readline() == "held\n"

    @property
    def process(self) -> int:
        return self.running.pid

    def stop(self, reason: str) -> None:
        self.stopped.append(reason)
        self.end()

    def end(self) -> None:
        self.running.kill()
        self.running.communicate()


@pytest.mark.skipif(sys.platform != "linux", reason="/proc tells what processes take")
def test_the_run_that_began_last_ends_when_all_take_too_much() -> None:
    limits = Limits(250 * MIB, 60.0)
    first, second = Holding(limits, 120 * MIB), Holding(limits, 180 * MIB)
    try:
        assert 120 * MIB < memory_of(first.process) < 180 * MIB, "what its own processes take counts"
        assert memory_of(None) == memory_of(2**30) == 0.0

        async def work() -> None:
            together = Together()
            together.begins(first)  # type: ignore[arg-type]
            await asyncio.sleep(3 * LOOK)
            assert first.stopped == []
            together.begins(second)  # type: ignore[arg-type]
            await asyncio.sleep(3 * LOOK)
            together.ends(second)  # type: ignore[arg-type]
            await asyncio.sleep(2 * LOOK)
            together.ends(first)  # type: ignore[arg-type]

        in_loop(work)
        assert first.stopped == []
        assert "--memory" in second.stopped[0]
    finally:
        first.end()
        second.end()


def test_all_runs_together_have_an_end() -> None:
    """Two tasks of little time each are over, a third finds none left."""

    async def work() -> list[dict[str, Any]]:
        limits = Limits(float("inf"), 60.0, Together(seconds=0.6))
        workers = [Worker(limits, 1) for _ in range(2)]
        task = {"table": SURFACE | {"points": "16x16"}, "steps": None, "folder": ".", "out": "/dev/null"}
        try:  # a worker takes longer than this to start
            found = await asyncio.gather(*(worker.call("surface", **task) for worker in workers))
            return [*found, await workers[0].call("surface", **task)]
        finally:
            for worker in workers:
                await worker.end()
            await asyncio.sleep(0.2)

    assert all("--total-time" in answer["error"] for answer in in_loop(work))


def test_runs_wait_for_their_turn_and_are_cancelled_while_they_wait() -> None:
    async def work() -> tuple[list[Any], float]:
        together = Together(at_once=1)
        limits = Limits(float("inf"), 60.0, together)
        await together.turns.acquire()
        one, two = Worker(limits, 1), Worker(limits, 1)
        task = {"table": SURFACE, "steps": None, "folder": ".", "out": "/dev/null"}
        calls = [asyncio.create_task(worker.run("surface", **task)) for worker in (one, two)]
        await asyncio.sleep(0.1)
        waiting = [one.waiting, two.waiting, one.process, two.process]
        began = time.monotonic()
        one.cancel()
        lost = await calls[0]
        took = time.monotonic() - began
        together.turns.release()
        done = await calls[1]
        await two.end()
        await asyncio.sleep(0.2)
        assert not together.turns.locked(), "every turn was given back"
        return [*waiting, lost.get("cancelled"), done.get("full")], took

    found, took = in_loop(work)
    assert found == [True, True, None, None, True, [16, 16]]
    assert took < 1.0


@pytest.fixture(scope="module")
def app() -> Iterator[AppServer]:
    with AppServer(
        ("--demo", "--threads", "1", "--at-once", "1", "--most-upload", "2", "--all-uploads", "3")
    ) as running:
        yield running


@pytest.mark.slow
def test_a_second_run_waits_and_says_so(app: AppServer, open_page: Callable[..., Any]) -> None:
    page = open_page(app.address, viewport={"width": 1400, "height": 900}).page
    base_of(page)
    go(page, "run")
    for count in (1, 2):
        page.click("[data-run]")
        page.wait_for_function(f"document.querySelectorAll('[data-run-key]').length === {count}")
    page.wait_for_selector("[data-run-key^='002'] .state:has-text('waiting until another run is done')")
    page.click("[data-run-key^='002'] >> text=Cancel")
    page.wait_for_selector("[data-run-key^='002'][data-state=cancelled]")
    finished(page)
    page.click("[data-run]")
    page.wait_for_selector("[data-run-key^='003'] .state:not(:has-text('waiting'))")
    page.click("[data-run-key^='003'] >> text=Cancel")
    page.wait_for_selector("[data-run-key^='003'][data-state=cancelled]")


def uploads(app: AppServer, cookie: str, session: str, sizes: list[int]) -> list[int]:
    return [app.upload(cookie, session, "a.txt", bytes(size))[0] for size in sizes]


@pytest.mark.slow
def test_uploads_have_a_limit_in_total(app: AppServer, open_page: Callable[..., Any], tmp_path: Path) -> None:
    watched = open_page(app.address)
    page = watched.page
    base_of(page)
    page.wait_for_selector(".drop")
    files = [tmp_path / f"map {number}.npy" for number in (1, 2, 3)]
    for file in files:
        file.write_bytes(bytes(int(1.2 * MIB)))
    drop(page, files)
    page.wait_for_selector(".drop-state:has-text('2 of 3 files are here'):has-text('--all-uploads')", timeout=LONG)
    expect(page.locator(".file")).to_have_count(2)
    assert all("413" in text for text in watched.errors)  # the browser's own line about the refused request
    watched.errors.clear()

    cookie = app.cookie()
    session = app.session(cookie)
    assert uploads(app, cookie, session, [int(0.5 * MIB), int(0.5 * MIB)]) == [200, 413]
    page.click("[data-file='map 2.npy'] [data-remove]")
    page.wait_for_selector("[data-file='map 2.npy']", state="detached")
    assert uploads(app, cookie, session, [int(0.5 * MIB), int(0.9 * MIB)]) == [200, 413]


def test_a_body_that_hides_its_length_counts_in_total(app: AppServer) -> None:
    cookie = app.cookie()
    session = app.session(cookie)
    answers = []
    for _ in range(3):
        connection = http.client.HTTPConnection(app.host, timeout=30)
        connection.request(
            "POST",
            f"{app.roots[cookie]}/upload/{session}?name=b.npy",
            body=iter([bytes(2**16)] * 24),
            headers={"Cookie": cookie, "Origin": f"http://{app.host}"},
            encode_chunked=True,
        )
        answers.append(connection.getresponse().status)
        connection.close()
    assert answers[-1] == 413
