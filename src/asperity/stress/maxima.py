"""Largest stresses of each region and interface of a body, found plane by plane as a stream of planes goes by."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from importlib import import_module

import numpy as np
from numpy.typing import NDArray

from ..core.arrays import RealArray
from ..core.engine.blocks import Blocks
from ..core.spectral import thread_count
from ..core.tensor import StressTensor
from . import invariants
from .field import Peak, StressField, peak_at
from .regions import Region

DRAWN = ("von_mises", "principal_tensile", "shear_xz", "shear_yz")
"""Stresses of either sign whose largest magnitude in the whole body is sought, for sections through it."""


@dataclass(frozen=True, eq=False)
class RegionMaxima:
    """Largest stresses of one region on the planes that were computed: von Mises, tension (σ1), and shear (σ1 - σ3)/2."""

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


_BOUNDED = ("tension", "shear")
"""What the compiled pass bounds only; of everything else it finds the largest value of each block."""


class Maxima:
    """Maxima of the planes that have been taken in, searched with ``threads`` threads."""

    def __init__(self, threads: int | None = None) -> None:
        self.drawn: dict[str, Peak] = {}
        self.citation_keys: tuple[str, ...] = ()
        self._regions: dict[Region, dict[str, Peak]] = {}
        self._interfaces: list[tuple[Region, Peak, Peak]] = []
        self._blocks = Blocks(thread_count(threads))

    def watching(self, fields: Iterable[StressField]) -> Iterator[StressField]:
        """The same ``fields``, each of one whole plane, taken in as they pass."""
        for field in fields:
            self.take(field)
            yield field

    def take(self, field: StressField) -> None:
        """Take in one whole plane."""
        self.citation_keys = field.citation_keys
        plane, search = field.planes[0], _Search(field, self._blocks)
        von_mises = search.peak("von_mises", invariants.von_mises)
        largest = self._regions.setdefault(plane.region, {})
        _keep(largest, "von_mises", von_mises)
        _keep(largest, "tension", search.peak("tension", lambda s: invariants.principal_stresses(s)[0]))
        _keep(largest, "shear", search.peak("shear", invariants.max_shear))
        _keep(self.drawn, "von_mises", von_mises)
        _keep(self.drawn, "principal_tensile", search.peak("in_plane", invariants.principal_tensile))
        _keep(self.drawn, "shear_xz", search.peak("shear_xz", lambda s: np.abs(s.xz)))
        _keep(self.drawn, "shear_yz", search.peak("shear_yz", lambda s: np.abs(s.yz)))
        if plane.side == "above":
            shear = search.peak("traction", lambda s: np.hypot(s.xz, s.yz))
            self._interfaces.append((plane.region, shear, search.peak("zz", lambda s: s.zz)))

    def regions(self) -> tuple[RegionMaxima, ...]:
        """The largest stresses of each region."""
        return tuple(RegionMaxima(region, **peaks) for region, peaks in self._regions.items())

    def interfaces(self) -> tuple[InterfaceMaxima, ...]:
        """The largest tractions on each interface."""
        names = {region.index: region.name for region in self._regions}
        return tuple(
            InterfaceMaxima(region.name, names.get(region.index + 1, "rigid base"), shear, peel)
            for region, shear, peel in self._interfaces
        )


def _keep(peaks: dict[str, Peak], name: str, peak: Peak) -> None:
    if name not in peaks or peak.value > peaks[name].value:
        peaks[name] = peak


class _Search:
    """Search of one plane: exact values only at points whose upper bound says that they may be largest."""

    def __init__(self, field: StressField, blocks: Blocks) -> None:
        self._kernels = import_module("..core.plane_maxima", __package__)
        self._field, self._size = field, int(self._kernels.BLOCK)
        self._flat = field.tensor.map(np.ravel)
        self._components = tuple(vars(self._flat).values())
        count = -(-self._flat.xx.size // self._size)
        found = np.empty((count, len(self._kernels.BOUNDS)))
        blocks.share(self._kernels.block_bounds, count, self._components, found, alone=count < 64)
        self._bounds = dict(zip(self._kernels.BOUNDS, found.T, strict=True))
        self._margin = 16.0 * float(np.finfo(self._flat.xx.dtype).eps * np.abs(found).max())  # rounding of the bounds

    def peak(self, name: str, function: Callable[[StressTensor], RealArray]) -> Peak:
        """Largest ``function`` of the stress, whose bounds are those of ``name``."""
        bounds = self._bounds[name]
        first = int(np.argmax(bounds)) * self._size
        value, place = self._largest(np.arange(first, min(first + self._size, self._flat.xx.size)), function)
        if name in _BOUNDED:  # points of other blocks may be larger
            least = value - self._margin
            blocks = np.flatnonzero(bounds > least)
            points = self._kernels.points_beyond(blocks, self._components, name == "shear", least)
            value, place = self._largest(points, function) if points.size else (value, place)
        indices = np.unravel_index(place, self._field.tensor.xx.shape[1:])
        return peak_at(self._field, value, (0, *map(int, indices)))

    def _largest(self, points: NDArray[np.intp], function: Callable[[StressTensor], RealArray]) -> tuple[float, int]:
        """Largest value at ``points`` of the plane, and its place."""
        values = function(self._flat.map(lambda component: component[points]))
        best = int(np.argmax(values))
        return float(values[best]), int(points[best])
