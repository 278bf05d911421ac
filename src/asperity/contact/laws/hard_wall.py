"""Unilateral contact: gap >= 0, pressure >= 0, one of them zero."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar


@dataclass(frozen=True)
class HardWall:
    """Frictionless, non-adhesive, elastic: the Hertz-Signorini-Moreau conditions (Johnson 1985, sec. 5.6)."""

    name: ClassVar[str] = "hard wall"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)

    def pressure_cap(self) -> float:
        """Infinity."""
        return math.inf
