"""What both bodies lose in a stretch of sliding, as a function of the pressure then."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from .law import Sides, WearLaw

_NONE = np.zeros(())
"""No dose."""

_KEPT = 3
"""Doses whose depths are kept: those at the begin of a step, at its end, and by an explicit one."""


@dataclass(frozen=True, eq=False)
class Linearised:
    """By how much (m) the gap becomes wider under pressures near one: ``start`` + ``bed`` p +
    ``track`` mean_x p, of which the first is (nx, ny), or zero, and the others as of
    ``WearOperator``."""

    start: RealArray | float
    bed: float | RealArray
    track: RealArray | None

    def depth(self, pressure: RealArray) -> RealArray:
        """Depth (nx, ny) in m under ``pressure`` (nx, ny) in Pa."""
        return self.start + self.beside(pressure)

    def beside(self, pressure: RealArray) -> RealArray:
        """The part of it in proportion to ``pressure``."""
        found = self.bed * pressure
        return found if self.track is None else found + self.track * pressure.mean(axis=0)


@dataclass(frozen=True, eq=False)
class Loss:
    """Wear of one body.

    Attributes
    ----------
    law
        Its law.
    share
        Of a track the share of it that the contact covers, over which doses are means along x; None
        where points slide all the time.
    """

    law: WearLaw
    share: float | None

    def virgin(self, grid: Grid) -> RealArray:
        """Dose (Pa m) of a body that has not worn: (nx, ny), of a track (ny,)."""
        return np.zeros(grid.shape if self.share is None else grid.shape[1])

    def summed(self, values: RealArray, grid: Grid) -> float:
        """Integral of ``values`` over the area, of a track over its whole length."""
        return float(values.mean()) * grid.area / (1.0 if self.share is None else self.share)

    def exposure(self, pressure: RealArray, slid: float | RealArray) -> RealArray:
        """Dose (Pa m) by ``pressure`` (nx, ny) in Pa while the bodies slide by ``slid`` (m)."""
        if self.share is not None:
            return np.asarray(slid * self.share * pressure.mean(axis=0))
        limit = self.law.threshold_pressure
        return np.asarray(slid * (np.maximum(pressure - limit, 0.0) if limit else pressure))

    def slope(self, dose: RealArray, pressure: RealArray, slid: float | RealArray) -> RealArray:
        """Depth per pressure (m/Pa) of a stretch that ends with ``dose`` and ``pressure``; of a
        track per mean of the pressure along x."""
        found = self.law.slope(dose) * slid
        if self.share is not None:
            return np.asarray(self.share * found)
        limit = self.law.threshold_pressure
        return np.where(pressure > limit, found, 0.0) if limit else np.asarray(found)


@dataclass(frozen=True, eq=False)
class Losses:
    """Wear of both bodies, prepared once: ``body`` and ``counter``, None for one that does not
    wear; ``left`` is the share of the depth that stays in the gap as debris."""

    body: Loss | None
    counter: Loss | None
    grid: Grid
    left: float = 0.0
    _known: list[tuple[Doses, Doses]] = field(default_factory=list, init=False, repr=False)

    @classmethod
    def of(cls, sides: Sides, grid: Grid) -> Losses:
        """Of ``sides`` on ``grid``; an InputError if the map of a factor has another shape, or a
        track is shorter than the area."""
        made = []
        for name in ("body", "counter"):
            law, length = getattr(sides, name), getattr(sides, f"{name}_track")
            if law is not None and isinstance(law.factor, np.ndarray):
                require.field(law.factor, f"factor on the wear coefficient of the {name}", grid.shape)
            if length is not None and length < grid.size[0] * (1.0 - 1e-9):
                raise InputError(
                    f"length of the track of the {name} (m) must be at least that of the area along x, "
                    f"{grid.size[0]:g}, but is {length:g}."
                )
            share = None if length is None else grid.size[0] / length
            made.append(None if law is None else Loss(law, share))
        return cls(made[0], made[1], grid, 0.0 if sides.debris is None else sides.debris.share)

    @cached_property
    def linear(self) -> bool:
        """Whether depths are multiples of the doses of all bodies."""
        return all(loss.law.linear for loss in (self.body, self.counter) if loss is not None)

    def wearing(self, *doses: Doses) -> Iterator[tuple[Loss, tuple[RealArray, ...]]]:
        """The losses of the bodies that wear, each with its part of all ``doses``."""
        for loss, *parts in zip((self.body, self.counter), *doses, strict=True):
            known = tuple(part for part in parts if part is not None)
            if loss is not None and len(known) == len(doses):
                yield loss, known

    def each(self, made: Callable[[Loss, RealArray], RealArray], doses: Doses) -> Doses:
        """``made`` of every loss and its dose."""
        pairs = ((self.body, doses.body), (self.counter, doses.counter))
        return Doses(*(None if loss is None or dose is None else made(loss, dose) for loss, dose in pairs))

    def virgin(self) -> Doses:
        """Doses of bodies that have not worn."""
        return Doses(*(None if loss is None else loss.virgin(self.grid) for loss in (self.body, self.counter)))

    def after(self, doses: Doses, pressure: RealArray, slid: float | RealArray) -> Doses:
        """Doses after ``slid`` (m; a map only without tracks) under ``pressure`` (nx, ny) in Pa."""
        return self.each(lambda loss, dose: dose + loss.exposure(pressure, slid), doses)

    def depths(self, doses: Doses) -> Doses:
        """Worn depth (m) of both bodies after ``doses``, each of (nx, ny); the latest are kept, as
        a step asks for them several times."""
        for known, depths in self._known:
            if known is doses:
                return depths
        found = self.each(lambda loss, dose: np.broadcast_to(loss.law.depth(dose), self.grid.shape), doses)
        self._known[:] = [(doses, found), *self._known[: _KEPT - 1]]
        return found

    def depth(self, doses: Doses) -> RealArray:
        """Their sum (nx, ny) in m."""
        return self.depths(doses).total(self.grid)

    def hollow(self, doses: Doses) -> RealArray:
        """By how much the gap is wider (nx, ny) in m: what is lost less the debris that stays."""
        return (1.0 - self.left) * self.depth(doses) if self.left else self.depth(doses)

    def debris(self, doses: Doses) -> RealArray | None:
        """Thickness (nx, ny) in m of the debris that stays; None where none does."""
        return self.left * self.depth(doses) if self.left else None

    def bare(self, doses: Doses) -> BoolArray:
        """(nx, ny), True where all layers of a body are worn through."""
        found = np.zeros(self.grid.shape, dtype=bool)
        for loss, (dose,) in self.wearing(doses):
            if len(loss.law.stages) > 1:
                found |= loss.law.stage(dose) == len(loss.law.stages) - 1
        return found

    def worn_through(self, before: Doses, after: Doses, along: tuple[float, float]) -> float:
        """Place at which the first point loses its last layer between two doses, ``along`` a
        stretch from (begin, length); infinite where none does."""
        earliest, (begin, length) = math.inf, along
        for loss, (start, end) in self.wearing(before, after):
            if len(loss.law.stages) == 1:
                continue
            last = len(loss.law.stages) - 1
            crossing = (loss.law.stage(end) == last) & (loss.law.stage(start) < last)
            if crossing.any():
                knot = np.broadcast_to(loss.law.dose_of_layers, start.shape)
                share = (knot - start)[crossing] / (end - start)[crossing]
                earliest = min(earliest, begin + length * float(share.min()))
        return earliest

    def volumes(self, depths: Doses) -> tuple[float, float]:
        """Worn volume (m³) of body and counter body at ``depths`` (m), of a track that of its whole
        length."""
        found = []
        for loss, depth in zip((self.body, self.counter), depths, strict=True):
            if loss is None or depth is None:
                found.append(0.0)
            else:
                found.append(loss.summed(depth, self.grid))
        return found[0], found[1]

    def apart(self, doses: Doses, others: Doses) -> float:
        """Volume (m³) by which the depths after two ``doses`` differ, of either sign."""
        return float(np.abs(self.depth(doses) - self.depth(others)).sum()) * self.grid.pixel_area

    def share(self, before: Doses, after: Doses, misplaced: float, part: float) -> float:
        """Volume (m³) that is ``misplaced`` in a step over what the step takes, or, where that is
        more, what it would at the mean rate so far, being this ``part`` of the course."""
        total = float(self.depth(after).sum()) * self.grid.pixel_area
        lost = max(total - float(self.depth(before).sum()) * self.grid.pixel_area, part * total)
        return misplaced / lost if lost > 0.0 else 0.0

    def imbalance(self, doses: Doses, carried: float) -> float:
        """Sum of the ``doses`` less ``carried`` (N m), force times distance, relative, the larger
        of both bodies; NaN where a part of the pressure does not wear."""
        worst = 0.0
        for loss, (dose,) in self.wearing(doses):
            if loss.law.threshold_pressure:
                return math.nan
            if carried:
                worst = max(worst, abs(loss.summed(dose, self.grid) / carried - 1.0))
        return worst

    def linearised(self, before: Doses, doses: Doses, pressure: RealArray, slid: float | RealArray) -> Linearised:
        """By how much the gap is wider than with ``before`` after a stretch of ``slid`` (m) that
        begins with ``doses``, near ``pressure`` (nx, ny) in Pa."""
        bed: float | RealArray = 0.0
        track: RealArray | None = None
        start: RealArray | float = 0.0
        for loss, (first, begin) in self.wearing(before, doses):
            if loss.law.linear:
                slope = loss.slope(_NONE, pressure, slid)  # the same after any dose
                start = start if begin is first else start + (loss.law.depth(begin) - loss.law.depth(first))
            else:
                end = begin + loss.exposure(pressure, slid)
                slope = loss.slope(end, pressure, slid)
                beside = slope * (pressure if loss.share is None else pressure.mean(axis=0))
                start = start + (loss.law.depth(end) - loss.law.depth(first) - beside)
            if loss.share is None:
                bed = bed + slope
            else:
                track = slope
        if isinstance(bed, np.ndarray) and bed.ndim and float(np.ptp(bed)) == 0.0:
            bed = float(bed.flat[0])
        passes = 1.0 - self.left
        return Linearised(
            passes * start if self.left else start,
            passes * float(bed) if np.ndim(bed) == 0 else passes * np.asarray(bed),
            None if track is None else passes * track,
        )


@dataclass(frozen=True, eq=False)
class Doses:
    """Dose (Pa m), or what else belongs to each, of ``body`` and ``counter``: (nx, ny), of a track
    (ny,); None for one that does not wear."""

    body: RealArray | None
    counter: RealArray | None

    def __iter__(self) -> Iterator[RealArray | None]:
        return iter((self.body, self.counter))

    def total(self, grid: Grid) -> RealArray:
        """Sum of both (nx, ny)."""
        there = [item for item in self if item is not None]
        return np.array(sum(there[1:], there[0]) if there else np.zeros(grid.shape))
