"""A real browser for tests of pages: the system's chromium, driven by Playwright, cut off from
every network."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest

from .app_server import ENDED

IN_CI = os.environ.get("CI", "").lower() in {"1", "true"}

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
"""Programs that will do, in the order in which they are looked for."""

QUIET = ("--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run")
"""Switches of a browser that asks nothing of any server of its own accord."""

HERE = frozenset({"", "127.0.0.1", "localhost", "::1"})
"""Hosts of this machine; files and embedded data have none."""


def unavailable(what: str) -> None:
    """Skip the test for want of ``what``, but fail in continuous integration, where it must be
    there."""
    if IN_CI:
        pytest.fail(f"{what}; continuous integration must provide it: .ci/run installs Debian's chromium")
    pytest.skip(what)


@dataclass
class Watched:
    """A page with what it has said and asked for since it was opened.

    ``errors`` are those of the console and those that no script caught, ``outside`` the addresses
    of other machines that were asked for; both must stay empty.
    """

    page: Any
    errors: list[str] = field(default_factory=list)
    outside: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.page.on("console", self._said)
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("request", self._asked)

    def _said(self, said: Any) -> None:
        lost = any(host in said.text for host in ENDED)  # pages that are still open miss an application that has ended
        if said.type == "error" and not lost:
            self.errors.append(said.text)

    def _asked(self, request: Any) -> None:
        if (urlsplit(request.url).hostname or "") not in HERE:
            self.outside.append(request.url)

    def check(self) -> None:
        """The page reported no error and asked nothing of another machine."""
        assert self.errors == []
        assert self.outside == []


@pytest.fixture(scope="session")
def chromium() -> Path:
    """Program of the browser; the variable ASPERITY_CHROMIUM names another one."""
    given = os.environ.get("ASPERITY_CHROMIUM")
    found = given or next(filter(None, map(shutil.which, NAMES)), None)
    if found is None:
        unavailable("no browser: none of " + ", ".join(NAMES) + " is installed")
    return Path(str(found))


@pytest.fixture(scope="session")
def browser(chromium: Path) -> Iterator[Any]:
    """The running browser, of Playwright."""
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        unavailable("no Playwright: pip install playwright, without any browser of its own")
    root = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=str(chromium), args=[*QUIET, *root])
        yield running
        running.close()


@pytest.fixture
def open_page(browser: Any) -> Iterator[Callable[..., Watched]]:
    """Opens an address, or the file of a path, in a fresh window and watches it; options are those
    of Playwright's contexts.

    What every window said and asked for is checked at the end of the test.
    """
    opened: list[tuple[Any, Watched]] = []

    def opener(address: str | Path, **options: Any) -> Watched:
        context = browser.new_context(**options)
        watched = Watched(context.new_page())
        opened.append((context, watched))
        watched.page.goto(address.resolve().as_uri() if isinstance(address, Path) else address)
        return watched

    yield opener
    for context, _ in opened:
        context.close()
    for _, watched in opened:
        watched.check()
