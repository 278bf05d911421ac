"""One finding of the checks of resolution and regime."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Advice:
    """One finding.

    ``level`` is ``"note"`` (good to know) or ``"warning"`` (the answer may be wrong); ``criterion`` a short name;
    ``message`` one or two sentences with the numbers and the remedy.
    """

    level: Literal["note", "warning"]
    criterion: str
    message: str
