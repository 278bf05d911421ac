"""Measurements that not every surface allows."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from ...core.errors import InputError

T = TypeVar("T")


class Attempts:
    """Runs measurements; one that the surface does not allow gives None and leaves a sentence in ``remarks``."""

    def __init__(self) -> None:
        self.remarks: list[str] = []

    def __call__(self, what: str, measure: Callable[[], T]) -> T | None:
        """Value of ``measure()``, or None after an ``InputError``; ``what`` names it in the remark."""
        try:
            return measure()
        except InputError as error:
            self.remarks.append(f"No {what}: {error}")
            return None

    def along_axes(self, what: str, measure: Callable[[str], T]) -> tuple[T | None, T | None]:
        """Values of ``measure("x")`` and ``measure("y")``."""
        return self(f"{what} along x", lambda: measure("x")), self(f"{what} along y", lambda: measure("y"))
