"""Survey of an iterate of the array-API engine."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import RealArray
from .generic_face import ArrayFace
from .library import Library, bound
from .neighbourhood import SIDE, entering_levels
from .protocol import Totals


@dataclass(frozen=True, eq=False)
class ArraySurvey:
    """One iterate seen as a whole."""

    library: Library
    totals: Totals
    p: Any
    u: Any
    h: Any
    cap: Any

    @classmethod
    def of(cls, library: Library, p: Any, u: Any, h: Any, cap: Any) -> ArraySurvey:
        """Survey of an iterate."""
        return cls(library, _totals(library, p, u, h, cap), p, u, h, cap)

    def face(self, level: float, scale: float, dtype: str) -> ArrayFace:
        """Working set at ``level``."""
        library, p, cap = self.library, self.p, self.cap
        r, movable = self.u - self.h, p > 0.0
        capped = movable & (p >= bound(library, cap, p)) if cap is not None else movable & ~movable
        movable = movable & ~capped
        low, high = self._levels(movable, r, level)
        entering = ((p == 0.0) & (r < low)) | (capped & (r > high))
        inside = movable | entering
        start = (float(level) - r) * (1.0 / float(scale))
        start = library.select(inside, library.xp.astype(start, getattr(library.xp, dtype)))
        size, arrived = library.numbers([library.count(inside), library.count(entering)])
        return ArrayFace(library, inside, start, int(size), int(arrived))

    def _levels(self, mask: Any, r: Any, level: float) -> list[Any]:
        """The two levels by which points enter, from ``r`` on the ``mask`` near each point."""
        library, xp, (nx, ny) = self.library, self.library.xp, r.shape
        sums = [
            self._in_squares(xp.astype(mask, r.dtype)),
            self._in_squares(library.select(mask, r)),
            self._in_squares(library.select(mask, r * r)),
        ]
        levels = entering_levels(np.stack(sums, axis=-1), level)
        arrays = (library.array(levels[..., side], "float64") for side in (0, 1))
        return [xp.repeat(xp.repeat(values, SIDE, axis=0), SIDE, axis=1)[:nx, :ny] for values in arrays]

    def _in_squares(self, values: Any) -> RealArray:
        """Sums over squares of SIDE x SIDE points."""
        library, (nx, ny) = self.library, values.shape
        bands, squares = -(-nx // SIDE), -(-ny // SIDE)
        whole = library.zeros((bands * SIDE, squares * SIDE), "float64")
        whole[:nx, :ny] = values
        return library.numpy(library.xp.sum(library.xp.reshape(whole, (bands, SIDE, squares, SIDE)), axis=(1, 3)))


def _totals(library: Library, p: Any, u: Any, h: Any, cap: Any) -> Totals:
    xp, select, numbers = library.xp, library.select, library.numbers
    r = u - h
    p = select(p > 0.0, p)
    sums = [xp.sum(p), xp.sum(p * r), xp.min(r)]
    if cap is None:
        pressure, work, lowest = numbers(sums)
        return Totals(pressure, work, pressure, work, lowest, -math.inf, lowest)
    loaded = p > 0.0
    capped = loaded & (p >= bound(library, cap, p))
    inner = select(~capped, p)
    sums += [
        xp.min(select(~loaded, r, math.inf)),
        xp.sum(inner),
        xp.sum(inner * r),
        xp.max(select(capped, r, -math.inf)),
    ]
    pressure, work, lowest, lowest_open, weight, weighted, highest_capped = numbers(sums)
    return Totals(pressure, work, weight, weighted, lowest, highest_capped, lowest_open)
