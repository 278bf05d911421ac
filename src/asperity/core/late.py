"""Names, methods and values that are looked up or computed at their first use, so that what is not
used costs no time."""

from __future__ import annotations

import difflib
import re
import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from types import MappingProxyType, ModuleType
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

    from .status import Advice, Verdict


class LateNames:
    """Names of ``package`` by the module below it that defines them; an empty module stands for the
    package itself, whose names are modules.

    Module and names read like ``from .module import names``, so that ``.module`` is one beside the
    package.
    """

    def __init__(self, package: str, by_module: Mapping[str, tuple[str, ...]]) -> None:
        self._package = package
        self.home = MappingProxyType({name: module for module, names in by_module.items() for name in names})

    def __call__(self, name: str) -> Any:
        """What ``name``, which is one of them, stands for."""
        where = self.home[name]
        return (
            getattr(import_module(f".{where}", self._package), name)
            if where
            else import_module(f".{name}", self._package)
        )


def names_of_stub(stub: Path) -> dict[str, tuple[str, ...]]:
    """Public names of a module by the module that defines them, from the lines
    ``from .module import names`` of its ``stub``."""
    lines = re.findall(r"^from \.(\S*) import (?:\(([^)]*)\)|(.*))$", stub.read_text(encoding="utf-8"), re.MULTILINE)
    found: dict[str, tuple[str, ...]] = {}
    for module, several, one in lines:
        found[module] = (*found.get(module, ()), *re.findall(r"(\w+)(?: as \w+)?", several or one))
    return found


class LateModule(ModuleType):
    """A module each of whose names is imported at its first use, and then kept."""

    _names: LateNames

    def __getattr__(self, name: str) -> Any:
        if name not in self._names.home:
            near = difflib.get_close_matches(name, self._names.home, n=1)
            hint = f"; did you mean {near[0]}?" if near else ""
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}{hint}", name=name, obj=self)
        value = vars(self)[name] = self._names(name)
        return value

    def __setattr__(self, name: str, value: object) -> None:
        """Set an attribute; a module that is imported does not take the place of the public name
        that it is called like."""
        if not (isinstance(value, ModuleType) and self._names.home.get(name)):
            super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        return sorted({*vars(self), *self._names.home})


def late_names(name: str, file: str) -> Mapping[str, str]:
    """Give the module ``name`` the names in the stub beside its ``file``, as its ``__all__`` too,
    and return where each is; they are imported at first use."""
    module = sys.modules[name]
    names = LateNames(str(module.__package__), names_of_stub(Path(file).with_suffix(".pyi")))
    vars(module).update(_names=names, __all__=sorted(names.home))
    module.__class__ = LateModule
    return names.home


class Shown:
    """Base of surfaces, bodies, problems and all results: how they show themselves on a screen and
    in a notebook.

    Words and pictures are made by the layers ``io`` and ``plots``, which the classes of lower
    layers may not import. The package itself stands above all layers, and when it is imported it
    gives with ``supply`` where these functions are found.
    """

    _find: ClassVar[Any]

    @classmethod
    def supply(cls, find: Callable[[str], Any]) -> None:
        """Take ``find``, which gives the functions ``text``, ``card``, ``plot`` and
        ``to_xarray``."""
        cls._find = staticmethod(find)

    def __repr__(self) -> str:
        return str(self._find("text")(self))


class Drawn(Shown):
    """What notebooks show with a picture: surfaces and their roughness, results, stress fields and
    comparisons."""

    def _repr_html_(self) -> str:
        return str(self._find("card")(self))

    def plot(self, kind: str = "", ax: Axes | None = None, **options: Any) -> Axes:
        """Draw on ``ax``, or on a new figure of pyplot, and return the axes.

        Parameters
        ----------
        kind
            What to draw, the most telling figure by default. Surfaces: ``heights`` or ``view``.
            Results: the names of their figures, such as ``pressure``, ``contact``, ``gap``,
            ``section`` or ``menisci``. Stress fields: a stress, such as ``von_mises``. Roughness:
            ``distribution``, ``spectrum`` and the other figures of its report. Comparisons:
            ``area``, ``kappa``, ``local_slope``, ``gap`` or ``deviation``.
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


class Judged(Shown):
    """Base of results, histories and outcomes: a verdict is given on them."""

    @property
    def verdict(self) -> Verdict:
        """What was found, whether the bodies hold, and whether it can be trusted."""
        given: Verdict = self._find("verdict")(self)
        return given


class Tabled(Shown):
    """Base of answers of theories, measured roughness and libraries of substances: rows of numbers,
    which notebooks show as a table."""

    def __repr__(self) -> str:
        return str(self._find("lines")(self))

    def _repr_html_(self) -> str:
        return str(self._find("table")(self))


class Advised(Judged):
    """Base of results and histories: they say what should be known before their numbers are
    used."""

    @property
    def advice(self) -> tuple[Advice, ...]:
        """Findings, warnings that the answer may be wrong and notes: each with its criterion, its
        numbers and a remedy in the message."""
        found: tuple[Advice, ...] = self._find("findings")(self)
        return found


class Stored(Drawn):
    """What result files hold: results and stress fields."""

    def to_xarray(self) -> xarray.DataTree:
        """All values as a labelled tree: one group for each part, units and long names on every
        variable."""
        tree: xarray.DataTree = self._find("to_xarray")(self)
        return tree
