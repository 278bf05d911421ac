"""A measured or generated surface as frozen data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.late import Drawn
from ..core.status import Advice
from ..core.values import LEAST


@dataclass(frozen=True)
class Origin:
    """Where a surface comes from.

    ``source`` file name or generator; ``channel`` data channel; ``instrument`` free key-value data
    from the file; ``history`` one sentence for every preparation step, oldest first;
    ``citation_keys`` the papers behind the reader, the generator and the steps, see
    ``core.citations``; ``findings`` what is doubtful in the file.
    """

    source: str = ""
    channel: str = ""
    instrument: Mapping[str, str] = field(default_factory=dict)
    history: tuple[str, ...] = ()
    citation_keys: tuple[str, ...] = ()
    findings: tuple[Advice, ...] = ()

    def continued(self, step: str, citation_keys: tuple[str, ...] = ()) -> Origin:
        """Origin after a further ``step``, which rests on the papers ``citation_keys``."""
        keys = tuple(dict.fromkeys((*self.citation_keys, *citation_keys)))
        return replace(self, history=(*self.history, step), citation_keys=keys)


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Surface(Drawn):
    """Heights on a regular grid, positive out of the solid (the material is below).

    Raises InputError if heights are not a real 2-D array, hold an infinity, are missing everywhere,
    or a spacing is not positive.

    Parameters
    ----------
    heights
        (nx, ny) heights in m; axis 0 is x, axis 1 is y. NaN marks a missing point.
    dx, dy
        Pixel size in m; ``dy`` defaults to ``dx``.
    periodic
        Whether node nx equals node 0 (a generated periodic map); a measured map is not periodic.
    mask
        (nx, ny), True where the point is missing. Points with NaN height are added to it.
    origin
        Source, channel, instrument and history.
    """

    heights: RealArray
    dx: float
    dy: float
    periodic: bool
    mask: BoolArray
    origin: Origin

    def __init__(
        self,
        heights: ArrayLike,
        dx: float,
        dy: float | None = None,
        *,
        periodic: bool = False,
        mask: ArrayLike | None = None,
        origin: Origin = Origin(),
    ) -> None:
        values = np.array(require.field(heights, "surface heights (m)"))
        missing = np.isnan(values)
        if mask is not None:
            given = np.asarray(mask, dtype=bool)
            if given.shape != values.shape:
                raise InputError(
                    f"surface mask must have the shape of the heights {values.shape}, but has {given.shape}."
                )
            missing |= given
        if np.isinf(values).any():
            raise InputError("surface heights must be finite or NaN (missing), but hold infinities. Mask those points.")
        if missing.all():
            raise InputError("surface heights must hold at least one valid point, but every point is missing.")
        values[missing] = np.nan
        if (highest := float(np.nanmax(np.abs(values)))) > LEAST:  # a lower one is flat
            require.magnitude(highest, "largest height of a surface (m)")  # squares of a higher one overflow
        values.flags.writeable = False
        missing.flags.writeable = False
        grid = Grid((values.shape[0], values.shape[1]), (dx, dx if dy is None else dy))
        for name, value in (
            ("heights", values),
            ("dx", grid.spacing[0]),
            ("dy", grid.spacing[1]),
            ("periodic", bool(periodic)),
            ("mask", missing),
            ("origin", origin),
        ):
            object.__setattr__(self, name, value)

    @property
    def shape(self) -> tuple[int, int]:
        """Number of points (nx, ny)."""
        return self.heights.shape[0], self.heights.shape[1]

    @cached_property
    def grid(self) -> Grid:
        """Grid of the surface."""
        return Grid(self.shape, (self.dx, self.dy))

    @property
    def size(self) -> tuple[float, float]:
        """Physical extent (Lx, Ly) in m."""
        return self.grid.size

    @property
    def n_missing(self) -> int:
        """Number of missing points."""
        return int(np.count_nonzero(self.mask))

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers behind the reader or generator and the preparation."""
        return self.origin.citation_keys

    def with_heights(self, heights: ArrayLike, step: str) -> Surface:
        """Surface on the same pixels with other ``heights`` (nx, ny) in m; ``step`` is added to the
        history.

        NaN marks a missing point; the periodic flag stays.
        """
        return Surface(heights, self.dx, self.dy, periodic=self.periodic, origin=self.origin.continued(step))


def generated(
    grid: Grid,
    heights: RealArray,
    source: str,
    how: str,
    *,
    periodic: bool = True,
    citation_keys: tuple[str, ...] = (),
) -> Surface:
    """Surface that the generator ``source`` made; ``how``, in words and numbers, begins its
    history."""
    keys = tuple(dict.fromkeys(citation_keys))
    origin = Origin(source, history=(f"generated: {how}",), citation_keys=keys)
    return Surface(heights, *grid.spacing, periodic=periodic, origin=origin)
