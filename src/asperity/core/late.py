"""Names and methods that are looked up, and values that are computed, at their first use, so that what is not used costs no time."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes


class LateNames:
    """Names of ``package`` by the module below it that defines them, or that they are modules of.

    Module and names read like ``from .module import names``, so that ``.module`` is one beside the package; an empty module stands for the
    package itself, whose names are then modules. To be used as ``__getattr__`` of the package, with a stub beside for type checkers.
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
        where = f".{self.home[name]}"
        if where != ".":
            module = import_module(where, self._package)
            if hasattr(module, name):
                return getattr(module, name)
        return import_module(f"{where}{name}" if where == "." else f"{where}.{name}", self._package)


def names_of_stub(stub: Path) -> dict[str, tuple[str, ...]]:
    """Public names of a package by module, from the lines ``from .module import names`` of its ``stub``."""
    lines = re.findall(r"^from \.(\S*) import (?:\(([^)]*)\)|(.*))$", stub.read_text(encoding="utf-8"), re.MULTILINE)
    return {module: tuple(re.findall(r"\w+", several or one)) for module, several, one in lines}


def late_package(package: str, file: str) -> tuple[Callable[[str], Any], Callable[[], list[str]], Mapping[str, str]]:
    """``__getattr__``, ``__dir__`` and modules by name of a ``package`` whose names stand in the stub beside its ``file``; a name found is kept."""
    find = LateNames(package, names_of_stub(Path(file).with_suffix(".pyi")))
    known = vars(sys.modules[package])

    def found(name: str) -> Any:
        value = known[name] = find(name)
        return value

    return found, lambda: [*known, *find.home], find.home


class Shown:
    """Base of surfaces, bodies, problems and all results: how they show themselves on a screen and in a notebook.

    Words and pictures are made by the layers ``io`` and ``plots``, which the classes of lower layers may not import. The package
    itself stands above all layers, and when it is imported it gives with ``supply`` where these functions are found.
    """

    _find: ClassVar[Any]

    @classmethod
    def supply(cls, find: Callable[[str], Any]) -> None:
        """Take ``find``, which gives the functions ``text``, ``card``, ``plot`` and ``to_xarray``."""
        cls._find = staticmethod(find)

    def __repr__(self) -> str:
        return str(self._find("text")(self))


class Drawn(Shown):
    """What notebooks show with a picture: surfaces and their roughness, results, stress fields and comparisons."""

    def _repr_html_(self) -> str:
        return str(self._find("card")(self))

    def plot(self, kind: str = "", ax: Axes | None = None, **options: Any) -> Axes:
        """Draw on ``ax``, or on a new figure of pyplot, and return the axes.

        Parameters
        ----------
        kind
            What to draw, the most telling figure by default. Surfaces: ``heights`` or ``view``. Results: the names of their
            figures, such as ``pressure``, ``contact``, ``gap``, ``section`` or ``menisci``. Stress fields: a stress, such as ``von_mises``.
            Roughness: ``distribution``, ``spectrum`` and the other figures of its report. Comparisons: ``area``, ``kappa``,
            ``local_slope``, ``gap`` or ``deviation``.
        ax
            Axes of matplotlib.
        options
            Further options of the figure, such as ``log=True`` or ``plane=2``.

        Raises
        ------
        InputError
            If there is no such ``kind``.
        """
        axes: Axes = self._find("plot")(self, kind, ax, **options)
        return axes


class Stored(Drawn):
    """What result files hold: results and stress fields."""

    def to_xarray(self) -> xarray.DataTree:
        """All values as a labelled tree: one group for each part, units and long names on every variable."""
        tree: xarray.DataTree = self._find("to_xarray")(self)
        return tree
