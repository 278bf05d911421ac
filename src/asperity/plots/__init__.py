"""Layer 3: figures of surfaces and contacts; functions (data, ax) -> ax, and the standard set as files. A module is imported on first use of one of its names.

The stub beside this file lists the names and their modules, for type checkers too.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..core.late import LateNames, names_of_stub

_find = LateNames(__name__, names_of_stub(Path(__file__).with_suffix(".pyi")))

__all__ = sorted(_find.home)


def __getattr__(name: str) -> Any:
    value = globals()[name] = _find(name)
    return value


def __dir__() -> list[str]:
    return [*globals(), *__all__]
