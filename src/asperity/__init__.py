"""Contact mechanics of layered rough surfaces.

A module is imported on first use of one of its names. The stub beside this file lists the names and their modules, for type
checkers too; ``stress`` is a function, and besides a package that the function is in.
"""

import sys
from pathlib import Path
from types import MappingProxyType, ModuleType
from typing import Any

from .core.late import LateNames, Shown, names_of_stub

__version__ = "0.1.0"

_VIEWS = MappingProxyType({"io.results": ("to_xarray",), "io.words": ("text",), "plots.notebook": ("card", "plot")})
"""Functions behind ``repr`` and notebooks, by module."""

_find = LateNames(__name__, names_of_stub(Path(__file__).with_suffix(".pyi")))
Shown.supply(LateNames(__name__, _VIEWS))
_HOME = _find.home

__all__ = sorted([*_HOME, "__version__"])


class _Package(ModuleType):
    """This package, whose names stay what they are when a package of the same name is imported."""

    def __setattr__(self, name: str, value: object) -> None:
        if not (isinstance(value, ModuleType) and _HOME.get(name, "").startswith(f"{name}.")):
            super().__setattr__(name, value)


def __getattr__(name: str) -> Any:
    value = globals()[name] = _find(name)
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


sys.modules[__name__].__class__ = _Package
