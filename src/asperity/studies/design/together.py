"""Searches that go on at once: designs that all of them wait for are computed together."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from contextvars import copy_context
from typing import Any, Generic, TypeVar

from .evaluation import Evaluation
from .problem import Site

Found = TypeVar("Found")


class _Ended(Exception):
    """The searches are given up."""


def at_once(evaluation: Evaluation, searches: Sequence[Callable[[Evaluation], Found]]) -> list[Found]:
    """What ``searches`` find, in their order.

    Each gets an evaluation to ask, in a thread of its own. As soon as all that go on wait for
    designs, these are computed in this thread, so that every search finds what it would find alone.
    """
    return _Rounds[Found](evaluation, len(searches)).run(searches)


class _Rounds(Generic[Found]):
    def __init__(self, evaluation: Evaluation, count: int) -> None:
        self.evaluation, self.running, self.ended = evaluation, count, False
        self.changed, self.wanted = threading.Condition(), dict[int, Sequence[Site]]()
        self.found, self.errors = dict[int, Found](), dict[int, BaseException]()

    def run(self, searches: Sequence[Callable[[Evaluation], Found]]) -> list[Found]:
        """What all of them find."""
        threads = [
            threading.Thread(target=copy_context().run, args=(self._search, number, each), daemon=True)
            for number, each in enumerate(searches)
        ]
        for thread in threads:
            thread.start()
        try:
            while self._round():
                pass
        finally:
            with self.changed:
                self.ended = True
                self.changed.notify_all()
            for thread in threads:
                thread.join()
        if self.errors:
            raise self.errors[min(self.errors)]
        return [self.found[number] for number in range(len(searches))]

    def _round(self) -> bool:
        """Compute what all searches wait for; whether one is left."""
        with self.changed:
            self.changed.wait_for(lambda: len(self.wanted) == self.running or self.errors)
            if self.errors or not self.running:
                return False
            sites = [site for number in sorted(self.wanted) for site in self.wanted[number]]
        self.evaluation(sites)
        with self.changed:
            self.wanted.clear()
            self.changed.notify_all()
        return True

    def _search(self, number: int, search: Callable[[Evaluation], Found]) -> None:
        def ask(sites: Sequence[Site]) -> None:
            with self.changed:
                self.wanted[number] = sites
                self.changed.notify_all()
                self.changed.wait_for(lambda: number not in self.wanted or self.ended)
                if self.ended:
                    raise _Ended

        found: Any = None
        try:
            found = search(self.evaluation.asking(ask))
        except _Ended:
            pass
        except BaseException as error:
            with self.changed:
                self.errors[number] = error
        with self.changed:
            self.found[number] = found
            self.running -= 1
            self.changed.notify_all()
