"""Contacts that are kept along a way whose end is not known."""

from __future__ import annotations

from dataclasses import dataclass, field

from ...contact.result import ContactResult

MOST = 15
"""Contacts that are kept at most."""


@dataclass(eq=False)
class Sections:
    """Contacts spread evenly over what has been covered so far.

    One is kept where it is further than ``apart`` (m) from the last; when there are more than
    ``MOST`` that is doubled and the list thinned, so that half to all of ``MOST`` remain wherever
    steps are short enough. The first stays.
    """

    kept: list[tuple[float, ContactResult]] = field(default_factory=list)
    apart: float = 0.0

    def add(self, way: float, contact: ContactResult) -> None:
        """Take in the ``contact`` after the ``way`` (m), which grows."""
        if self.kept and way - self.kept[-1][0] < self.apart:
            return
        self.kept.append((way, contact))
        while len(self.kept) > MOST:
            covered = way - self.kept[0][0]
            self.apart = max(2.0 * self.apart, covered / MOST)
            thinned = self.kept[:1]
            for item in self.kept[1:]:
                if item[0] - thinned[-1][0] >= self.apart:
                    thinned.append(item)
            self.kept = thinned

    def with_marks(self, marks: list[tuple[float, ContactResult]]) -> list[tuple[float, ContactResult]]:
        """Those that are kept with those at ``marks``, in order, each once."""
        both = dict(self.kept) | dict(marks)
        return sorted(both.items(), key=lambda item: item[0])
