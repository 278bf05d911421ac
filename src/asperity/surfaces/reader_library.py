"""Opening instrument files with SurfaceTopography, of which only the reader that recognises the
file is imported; and what the instruments of its readers can measure.

The whole library takes 1.0 s to import: 42 readers and all its analyses of surfaces, with
scipy.stats, scipy.optimize, pandas and spreadsheets. Its packages are therefore entered into Python
without their contents, which come with the first name that is asked of them: readers one by one,
anything else with everything.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from importlib import import_module
from importlib.abc import InspectLoader, Loader, MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from types import MappingProxyType, ModuleType
from typing import Any

import numpy as np

from ..core.arrays import RealArray
from ..core.status import Advice
from ..core.units import show

_POSTPONED = ("SurfaceTopography", "SurfaceTopography.IO", "NuMPI.Optimization")
"""Packages that import far more than a reader needs; the last is that of the parallel library below
the readers."""

_HEAD = 2**16
"""Bytes of a file from which we may tell that a reader is not meant."""

_START = 512
"""Bytes at the start of a file from which a reader may tell that it is not meant, as in
``open_topography``."""


def _matlab(start: bytes) -> bool:
    """Whether a file with this ``start`` may be one of MATLAB: of version 4 by a zero in its first
    number, later by the version after the text at its beginning."""
    return 0 in start[:4] or any(version in start[124:126] for version in (1, 2))


_MARKS: Mapping[str, Callable[[bytes], bool]] = MappingProxyType(
    {
        "MatReader": _matlab,
        "MitutoyoReader": lambda start: start.startswith(b"PK"),
        "NCReader": lambda start: start.startswith((b"CDF", b"\x89HDF")),
        "XYZReader": lambda start: b"\0" not in start or start.startswith((b"\xff\xfe", b"\xfe\xff")),
    }
)
"""Whether a reader may be meant by the head of a file, of those that take long to find out: they
import scipy.io with scipy.sparse, or openpyxl, or read a file of numbers as text in six hundred
ways."""


@contextmanager
def opened_by_first_reader(file: Path) -> Iterator[Any]:
    """Reader of ``file``, the first in the order of the library that can open it; no reader after
    it is imported.

    Raises
    ------
    LookupError
        If no reader can, or the library does not state its order as expected.
    """
    with file.open("rb") as stream:
        head = stream.read(_HEAD)
    start = head[:_START]
    finder, reader = _Finder(), None
    # while this finder lasts, packages that are not imported yet are imported without their code
    sys.meta_path.insert(0, finder)
    try:
        package = import_module("SurfaceTopography.IO")
        for name in _order(package):
            if name in _MARKS and not _MARKS[name](head):
                continue
            candidate = getattr(package, name)
            if candidate.can_read(start).name == "NO":
                continue
            with suppress(Exception):
                reader = candidate(str(file))
                break
    finally:
        sys.meta_path.remove(finder)
    if reader is None:
        raise LookupError(f"no reader opens {file}")
    with reader:
        yield reader


@contextmanager
def opened_by_library(file: Path) -> Iterator[Any]:
    """Reader of ``file`` from the whole library."""
    from SurfaceTopography.IO import open_topography

    with open_topography(str(file)) as reader:
        yield reader


def _order(package: ModuleType) -> Sequence[str]:
    """Names of the readers in the order in which the library tries them; none if its source does
    not state one list."""
    lists = re.findall(r"^readers = \[$(.*?)^\]$", _source(package), re.MULTILINE | re.DOTALL)
    return re.findall(r"^    (\w+),$", lists[0], re.MULTILINE) if len(lists) == 1 else ()


def _source(package: ModuleType) -> str:
    """Source text of ``package``; empty where there is none."""
    loader = package.__spec__.loader if package.__spec__ is not None else None
    return (loader.get_source(package.__name__) or "") if isinstance(loader, InspectLoader) else ""


class _PostponedPackage(ModuleType):
    """Package whose own code has not run yet: it gives a name of its submodules with that
    submodule while a reader is sought; any other, and any name to anybody else, with all.

    The library adds the analyses of its classes with its own code: a class by itself has none.

    ``_homes`` holds the submodule of each name that a line ``from .module import name`` of its code
    gives it.
    """

    _homes: Mapping[str, str]

    def __getattr__(self, name: str) -> Any:
        homes = self.__dict__.get("_homes")  # None as long as Python makes the module
        if homes is not None and name in homes and _finding():
            return getattr(import_module(homes[name], self.__name__), name)
        if homes is not None and self.__spec__ is not None and self.__spec__.loader is not None:
            del self._homes
            self.__class__ = ModuleType  # type: ignore[assignment]
            self.__spec__.loader.exec_module(self)
            return getattr(self, name)
        raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")


def _finding() -> bool:
    """Whether a reader is being sought, in which a package is left without its code."""
    return any(isinstance(finder, _Finder) for finder in sys.meta_path)


@dataclass(eq=False)
class _Postponing(Loader):
    """Loader of a package that leaves its code to the first use, for which it restores the usual
    ``loader``."""

    loader: InspectLoader

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """The package without its code."""
        return _PostponedPackage(spec.name)

    def exec_module(self, module: ModuleType) -> None:
        """Note where the package has its names from."""
        lines = re.findall(
            r"^from (\.\w+) import ([\w, ]+?) *(?:#.*)?$", self.loader.get_source(module.__name__) or "", re.MULTILINE
        )
        module.__dict__["_homes"] = {name: home for home, names in lines for name in names.split(", ")}
        module.__loader__ = self.loader
        if module.__spec__ is not None:
            module.__spec__.loader = self.loader


class _Finder(MetaPathFinder):
    """Finds the packages that are postponed."""

    def find_spec(self, name: str, path: Sequence[str] | None, target: ModuleType | None = None) -> ModuleSpec | None:
        """Specification of ``name`` if it is one of them."""
        spec = PathFinder.find_spec(name, path, target) if name in _POSTPONED else None
        if spec is None or not isinstance(spec.loader, InspectLoader):
            return None
        spec.loader = _Postponing(spec.loader)
        return spec


# What instruments can measure: scales of files that cannot be.


SCALE = "scale of the file"
"""Criterion of the finding that a size or the heights of a file cannot be."""


@dataclass(frozen=True)
class Family:
    """Instruments of one kind and what they can measure: sides, pixels and range of heights in m,
    from least to most."""

    name: str
    sides: tuple[float, float]
    pixels: tuple[float, float]
    heights: tuple[float, float]


PROBE = Family("a scanning probe microscope", (1e-10, 2e-3), (1e-13, 1e-4), (1e-14, 1e-3))
OPTICAL = Family("an optical profiler or microscope", (1e-7, 1.0), (1e-10, 1e-2), (1e-13, 0.1))
ANY = Family("any instrument", (1e-10, 10.0), (1e-13, 0.1), (1e-14, 1.0))

_FAMILIES = {
    **dict.fromkeys(("DI", "MDT", "IBW", "MI", "PS", "EZD", "WSXM", "JPK", "BCR", "NHF"), PROBE),
    **dict.fromkeys(
        ("OPD", "OPDx", "DATX", "MetroPro", "VK", "ZMG", "ZON", "OS3D", "AL3D", "PLU", "PLUX", "FRT"), OPTICAL
    ),
    **dict.fromkeys(("LEXT", "OIR", "POIR", "NMS", "TMD", "QEP", "Mitutoyo"), OPTICAL),
}
"""Families by the name of the reader, without "Reader"; files of all others may come from
anything."""

TERRAIN = "HGT"
"""Reader of terrain, which has no limits."""


def family_of(reader: str) -> Family:
    """Family of instruments whose files the ``reader`` reads."""
    return _FAMILIES.get(reader.removesuffix("Reader"), ANY)


def lateral_doubt(family: Family, size: tuple[float, ...], shape: tuple[int, ...]) -> str:
    """Why a stated ``size`` in m cannot be right, empty if it can."""
    for side, n in zip(size, shape, strict=True):
        least, most = family.sides
        if not least <= side <= most:
            return f"a side of {show(side, 'm')}, but {family.name} measures {show(least, 'm')} to {show(most, 'm')}"
        least, most = family.pixels
        if not least <= side / n <= most:
            return (
                f"pixels of {show(side / n, 'm')}, but those of {family.name} are {show(least, 'm')} to "
                f"{show(most, 'm')}"
            )
    return ""


def height_doubt(family: Family, heights: RealArray) -> str:
    """Why ``heights`` in m cannot be right, empty if they can."""
    valid = heights[np.isfinite(heights)]
    with np.errstate(all="ignore"):  # of numbers that are damaged
        extent = float(np.ptp(np.percentile(valid, (0.5, 99.5)))) if valid.size else 0.0
    least, most = family.heights
    if extent == 0.0 or least <= extent <= most:
        return ""
    return f"heights over {show(extent, 'm')}, but {family.name} measures {show(least, 'm')} to {show(most, 'm')}"


def scale_finding(lateral: str, vertical: str, *, line: bool = False) -> Advice:
    """The finding that a scale cannot be, from the reasons of :func:`lateral_doubt` and
    :func:`height_doubt`; of a ``line`` scan the unit along it is stated in place of a size."""
    along = "{give_lateral_unit}" if line else "{give_size}"
    remedies = [word for word, doubt in ((along, lateral), ("{give_height_unit}", vertical)) if doubt]
    return Advice(
        "warning",
        SCALE,
        f"The file states {' and '.join(doubt for doubt in (lateral, vertical) if doubt)}.",
        f"State the right one, or this one if it is right ({' and '.join(remedies)}).",
    )
