"""Failed cases grouped by cause."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from .axes import Coordinate

_NUMBER = re.compile(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?", re.IGNORECASE)


@dataclass(frozen=True)
class Failure:
    """One failed case: where it lies, and its exception."""

    at: Mapping[str, Coordinate]
    kind: str
    message: str


@dataclass(frozen=True)
class Cause:
    """Failures with the same exception and, but for numbers, the same message: ``count``, and the ``first`` of them."""

    kind: str
    count: int
    first: Failure


def causes(failures: Iterable[Failure], *, by_kind: bool = False) -> tuple[Cause, ...]:
    """Causes of ``failures``, the most frequent first; ``by_kind`` whatever their messages say."""
    groups: dict[tuple[str, str], list[Failure]] = {}
    for failure in failures:
        text = "" if by_kind else _NUMBER.sub("#", failure.message)
        groups.setdefault((failure.kind, text), []).append(failure)
    found = [Cause(kind, len(group), group[0]) for (kind, _), group in groups.items()]
    return tuple(sorted(found, key=lambda cause: -cause.count))
