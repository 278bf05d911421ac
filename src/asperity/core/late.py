"""Public names of a package that are imported when they are asked for, so that importing the package costs nothing."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from types import MappingProxyType
from typing import Any


class LateNames:
    """Names of ``package`` by the module below it that defines them, or that they are modules of.

    Module and names read like ``from .module import names``; an empty module stands for the package itself, whose names
    are then modules. To be used as ``__getattr__`` of the package, with a stub beside that says the same to type checkers.
    """

    def __init__(self, package: str, by_module: Mapping[str, tuple[str, ...]]) -> None:
        self._package = package
        self.home = MappingProxyType({name: module for module, names in by_module.items() for name in names})

    def __call__(self, name: str) -> Any:
        """What ``name`` stands for.

        Raises
        ------
        AttributeError
            If the package has no such name.
        """
        if name not in self.home:
            raise AttributeError(f"module {self._package!r} has no attribute {name!r}")
        where = ".".join(filter(None, (self._package, self.home[name])))
        if where != self._package:
            module = import_module(where)
            if hasattr(module, name):
                return getattr(module, name)
        return import_module(f"{where}.{name}")
