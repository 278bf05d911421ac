"""Largest stresses of regions and interfaces, and where a body yields, found while planes are read
a few rows at a time."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import RealArray
from ...core.grid import Grid
from ...core.tensor import StressTensor
from .boundaries import Reader, Rows
from .criteria import Criterion
from .largest import EXACT
from .peaks import Peak, SurfaceMaxima
from .regions import Plane, Region
from .yielding import Gathered, YieldReport, equivalent_at


@dataclass(frozen=True, eq=False)
class RegionMaxima:
    """Largest stresses of one region on the planes that were computed: von Mises, tension (σ1), and
    shear (σ1 - σ3)/2."""

    region: Region
    von_mises: Peak
    tension: Peak
    shear: Peak


@dataclass(frozen=True, eq=False)
class InterfaceMaxima:
    """Largest tractions on an interface: ``shear`` magnitude and ``peel``, positive in tension."""

    above: str
    below: str
    shear: Peak
    peel: Peak


_EXACT = {
    **EXACT,
    "shear_xz": lambda s: np.abs(s.xz),
    "shear_yz": lambda s: np.abs(s.yz),
    "traction": lambda s: np.asarray(np.hypot(s.xz, s.yz)),
    "zz": lambda s: s.zz,
}
"""The quantities of the compiled passes, which only find candidates."""

_OF_REGIONS, _OF_ALL, _OF_INTERFACES = (
    ("von_mises", "tension", "shear"),
    ("in_plane", "shear_xz", "shear_yz"),
    ("traction", "zz"),
)

_Key: TypeAlias = tuple[str, int]
"""A quantity, and the number of the region of which the largest is sought, -1 for the whole
body."""

_ALL = -1


def _key(quantity: str, region: Region) -> _Key:
    return quantity, _ALL if quantity in _OF_ALL else region.index


class _Candidate(NamedTuple):
    """A ``value`` that may be the largest, what it may be wrong by, and the ``stress`` (6,) and
    place that it belongs to."""

    value: float
    margin: float
    stress: RealArray
    plane: Plane
    i: int
    j: int


@dataclass(eq=False)
class _Top:
    """Candidates for the largest of one quantity, and the largest ``value`` of theirs."""

    value: float = -math.inf
    candidates: list[_Candidate] = field(default_factory=list)

    def add(self, candidates: list[_Candidate]) -> None:
        """Take in ``candidates``, and drop those that are no longer any."""
        self.value = max([self.value, *(one.value for one in candidates)])
        self.candidates = [one for one in self.candidates + candidates if one.value + one.margin >= self.value]

    def largest(self, function: Callable[[StressTensor], RealArray], grid: Grid) -> Peak:
        """The largest, by the ``function`` of the stress."""
        found = function(StressTensor(*np.transpose([one.stress for one in self.candidates])))
        best = int(np.argmax(found))
        _, _, _, plane, i, j = self.candidates[best]
        x, y = i * grid.spacing[0], j * grid.spacing[1]
        return Peak(float(found[best]), x, y, plane.depth, plane.region, plane.side)


class Extremes:
    """Extremes of the planes on ``grid`` that have been read, and what is beyond the limit of
    ``criterion``.

    ``surface``, set when the plane at the surface has been read, are its largest stresses with the
    edges of the contact; None where these are not known.
    """

    def __init__(self, grid: Grid, criterion: Criterion) -> None:
        self.surface: SurfaceMaxima | None = None
        self.criterion = criterion
        self._grid = grid
        self._tops: dict[_Key, _Top] = {}
        self._peaks: dict[_Key, tuple[list[_Candidate], Peak]] = {}
        self._yielding: dict[Region, Gathered] = {}
        self._interfaces: list[Region] = []

    def take(
        self,
        plane: Plane,
        read: Callable[[Plane, Reader], None],
        tractions: Callable[[Plane, Reader], None] | None = None,
    ) -> None:
        """Take in a whole ``plane`` that ``read`` reads; what passes an interface is read by
        ``tractions`` if given."""
        region = plane.region
        gathered = self._yielding.setdefault(region, Gathered(self.criterion.limit(region.material)))
        if plane.side == "above":
            self._interfaces.append(region)
        if plane.side != "above" or tractions is None:
            beyond = self._read(plane, read, gathered.limit.value, ())
        else:
            beyond = self._read(plane, read, gathered.limit.value, _OF_INTERFACES)
            self._read(plane, tractions, math.inf, (*_OF_REGIONS, *_OF_ALL, _OWN))
        gathered.note(plane.depth, beyond * self._grid.pixel_area)

    def _read(self, plane: Plane, read: Callable[[Plane, Reader], None], limit: float, without: tuple[str, ...]) -> int:
        """Candidates on ``plane`` for all quantities but those ``without``; the number of points
        beyond the ``limit``."""
        known = {key: top.value for key, top in self._tops.items()}
        known |= {_key(quantity, plane.region): math.inf for quantity in without}
        parts: list[_Reading] = []

        def reader(rows: Rows) -> None:
            part = _Reading(plane, self.criterion, limit, known)
            parts.append(part)
            part.read(rows)

        read(plane, reader)
        for part in sorted(parts, key=lambda part: part.first):
            for key, top in part.tops.items():
                self._tops.setdefault(key, _Top()).add(top.candidates)
        return sum(part.beyond for part in parts)

    def _peak(self, quantity: str, region: int) -> Peak:
        candidates = self._tops[quantity, region].candidates
        of, peak = self._peaks.get((quantity, region), (None, None))
        if peak is None or of is not candidates:  # else none has been added since
            peak = self._tops[quantity, region].largest(_EXACT[quantity], self._grid)
            self._peaks[quantity, region] = candidates, peak
        return peak

    @property
    def drawn(self) -> dict[str, Peak]:
        """The largest stresses through which sections are laid, by name."""
        found = {name: self._peak(quantity, _ALL) for name, quantity in _DRAWN.items()}
        highest = max((self._peak("von_mises", r.index) for r in self._yielding), key=lambda peak: peak.value)
        return found | {"von_mises": highest}

    def whole(self) -> dict[str, Peak]:
        """The largest σ_t in planes parallel to the surface, |σxz| and |σyz| of the whole body, by
        the name of the stress; σ_t with the edges of the contact."""
        found = {name: self._peak(quantity, _ALL) for name, quantity in _DRAWN.items()}
        if self.surface is not None:
            found["principal_tensile"] = self.surface.joined("in_plane", found["principal_tensile"])
        return found

    def regions(self) -> tuple[RegionMaxima, ...]:
        """The largest stresses of each region, those at the surface with the edges of the
        contact."""
        found = []
        for region in self._yielding:
            peaks = {name: self._peak(name, region.index) for name in _OF_REGIONS}
            if self.surface is not None and region.index == 0:
                peaks = {name: self.surface.joined(name, peak) for name, peak in peaks.items()}
            found.append(RegionMaxima(region, **peaks))
        return tuple(found)

    def interfaces(self) -> tuple[InterfaceMaxima, ...]:
        """The largest tractions on each interface."""
        names = {region.index: region.name for region in self._yielding}
        found = []
        for region in self._interfaces:
            peaks = (self._peak(quantity, region.index) for quantity in _OF_INTERFACES)
            found.append(InterfaceMaxima(region.name, names.get(region.index + 1, "rigid base"), *peaks))
        return tuple(found)

    def yielding(self) -> YieldReport:
        """Onset of yield, region by region."""
        measure = getattr(self.criterion, "measure", _OWN)
        reports = []
        for region, gathered in self._yielding.items():
            peak = self._tops[measure, region.index].largest(self.criterion.equivalent, self._grid)
            if self.surface is not None and region.index == 0:
                peak = equivalent_at(self.surface, self.criterion, peak)
            reports.append(gathered.report(region, peak))
        return YieldReport(self.criterion, tuple(reports))


_DRAWN = {"principal_tensile": "in_plane", "shear_xz": "shear_xz", "shear_yz": "shear_yz"}
_OWN = "equivalent"  # quantity of a criterion that is none of the known ones


class _Reading:
    """One thread's reading of a ``plane``: candidates larger than what is ``known``, and the number
    of points ``beyond`` a limit."""

    def __init__(self, plane: Plane, criterion: Criterion, limit: float, known: dict[_Key, float]) -> None:
        self.tops: dict[_Key, _Top] = {}
        self.beyond = 0
        self.first = 0
        self._plane, self._criterion, self._limit = plane, criterion, limit
        self._kernels: Any = import_module(".kernels.extremes", __package__)
        self._measure: str = getattr(criterion, "measure", _OWN)
        names = (*self._kernels.QUANTITIES, _OWN)
        self._keys = [_key(quantity, plane.region) for quantity in names]
        self._least = np.array([known.get(key, -math.inf) for key in self._keys])

    def read(self, blocks: Rows) -> None:
        """Take in some rows after the others."""
        interface = self._plane.side == "above"
        for count, (first, rows) in enumerate(blocks):
            self.first = self.first if count else first
            beyond, root, mean = self._kernels.overview(rows, self._least, interface)
            for number in [number for number, larger in enumerate(beyond.tolist()) if larger]:
                found = self._kernels.candidates(number, rows, self._least[number])
                if len(found[0]):
                    self._add(number, first, rows, *found)
            bounds = {
                "von_mises": math.sqrt(3.0) * root,
                "tension": mean + 2.0 / math.sqrt(3.0) * root,
                "shear": 2.0 * root,
            }
            if bounds.get(self._measure, math.inf) > self._limit or self._measure == _OWN:
                # count what is beyond the limit, and seek the largest where that is none of the
                # quantities
                values = self._criterion.equivalent(StressTensor(*rows))
                self.beyond += int(np.count_nonzero(values > self._limit))
                if self._measure == _OWN and values.max() > self._least[-1]:
                    place = np.array([np.unravel_index(int(np.argmax(values)), values.shape)])
                    self._add(-1, first, rows, place, values.max(keepdims=True).ravel(), np.zeros(1))

    def _add(
        self, number: int, first: int, rows: RealArray, places: NDArray[np.intp], values: RealArray, margins: RealArray
    ) -> None:
        """Take in candidates for a quantity, by its number, at ``places`` in ``rows``."""
        stresses = rows[:, places[:, 0], places[:, 1]].T
        each = zip(places.tolist(), values.tolist(), margins.tolist(), stresses, strict=True)
        top = self.tops.setdefault(self._keys[number], _Top())
        top.add([_Candidate(value, margin, s, self._plane, first + i, j) for (i, j), value, margin, s in each])
        self._least[number] = max(self._least[number], top.value)
