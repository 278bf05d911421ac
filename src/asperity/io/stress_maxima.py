"""Largest stresses of each region and interface of a body, found plane by plane as a stream of planes goes by."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..core.arrays import RealArray
from ..stress.field import Peak, StressField
from ..stress.invariants import hydrostatic, principal_stresses, second_invariant
from ..stress.regions import Region

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


class Maxima:
    """Maxima of the planes that have been taken in."""

    def __init__(self) -> None:
        self.drawn: dict[str, Peak] = {}
        self.citation_keys: tuple[str, ...] = ()
        self._regions: dict[Region, dict[str, Peak]] = {}
        self._interfaces: list[tuple[Region, Peak, Peak]] = []

    def watching(self, fields: Iterable[StressField]) -> Iterator[StressField]:
        """The same ``fields``, each of one whole plane, taken in as they pass."""
        for field in fields:
            self.take(field)
            yield field

    def take(self, field: StressField) -> None:
        """Take in one whole plane."""
        self.citation_keys = field.citation_keys
        plane, tensor = field.planes[0], field.tensor
        mean, root = hydrostatic(tensor), np.sqrt(second_invariant(tensor))
        von_mises = field.peak(math.sqrt(3.0) * root)
        largest = self._regions.setdefault(plane.region, {})
        _keep(largest, "von_mises", von_mises)
        # σ1 <= mean + 2/√3 √J2 and (σ1 - σ3)/2 <= √J2: principal stresses only where they could be the largest
        _keep(largest, "tension", _peak_below(field, mean + 2.0 / math.sqrt(3.0) * root, lambda s: s[0]))
        _keep(largest, "shear", _peak_below(field, root, lambda s: 0.5 * (s[0] - s[2])))
        _keep(self.drawn, "von_mises", von_mises)
        _keep(self.drawn, "principal_tensile", field.peak(field.principal_tensile))
        for component in ("shear_xz", "shear_yz"):
            _keep(self.drawn, component, field.peak(np.abs(getattr(field, component))))
        if plane.side == "above":
            shear = np.hypot(tensor.xz, tensor.yz)
            self._interfaces.append((plane.region, field.peak(shear), field.peak(tensor.zz)))

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


def _peak_below(field: StressField, bound: RealArray, function: Callable[[RealArray], RealArray]) -> Peak:
    """Largest ``function`` of the principal stresses on a plane, of which ``bound`` is an upper bound point by point."""
    tensor, flat = field.tensor.map(np.ravel), bound.ravel()

    def at(points: Any) -> RealArray:
        return function(principal_stresses(tensor.map(lambda component: component[points])))

    least = float(at([int(np.argmax(flat))])[0])
    candidates = np.flatnonzero(flat >= least - 1e-6 * abs(least))  # beyond rounding of single precision
    values = np.full(flat.shape, -np.inf)
    values[candidates] = at(candidates)
    return field.peak(values.reshape(bound.shape))
