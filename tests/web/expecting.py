"""What a page is expected to show: waited for, since the pages follow what is pressed by messages
from and to the application."""

from __future__ import annotations

from typing import Any

LONGEST = 30_000
"""Milliseconds until a page that does not show what is expected has failed."""


def expect(locator: Any) -> Any:
    """Playwright's expectations of a ``locator``, each waited for."""
    from playwright.sync_api import expect as expectation

    expectation.set_options(timeout=LONGEST)
    return expectation(locator)
