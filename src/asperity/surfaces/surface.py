"""A measured or generated surface as frozen data."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Concatenate, ParamSpec, Protocol, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.citations import Origin as Origin
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.late import Drawn
from ..core.units import show
from ..core.values import LEAST
from .profile import Profile, missing_points, no_area


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
        highest = max(float(values.max()), -float(values.min())) if values.size else math.nan
        if mask is None and math.isfinite(highest):  # as most are: surfaces that wear are made by the hundred
            missing = np.zeros(values.shape, dtype=bool)
        else:
            missing, highest = missing_points(values, mask, "surface")
        if highest > LEAST:  # a lower one is flat
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

    def row(self, j: int) -> Profile:
        """Line scan (nx,) along x of the row ``j`` of this map, 0 <= j < ny or from the end if
        negative.

        Raises InputError if there is no such row, or none of its points is valid.
        """
        return self._line(j, axis=0)

    def column(self, i: int) -> Profile:
        """Line scan (ny,) along y of the column ``i`` of this map, 0 <= i < nx or from the end if
        negative.

        Raises InputError if there is no such column, or none of its points is valid.
        """
        return self._line(i, axis=1)

    def _line(self, number: int, axis: int) -> Profile:
        count, what = self.shape[1 - axis], ("row", "column")[axis]
        index = require.integer(number, -count, f"number of a {what}")
        if index >= count:
            raise InputError(f"number of a {what} must be at most {count - 1} on this map, but is {index}.")
        index %= count
        place = (index + 0.5) * self.grid.spacing[1 - axis]
        step = f"taken: {what} {index}, at {'yx'[axis]} = {show(place, 'm')}"
        heights = self.heights.take(index, axis=1 - axis)
        return Profile(heights, self.grid.spacing[axis], periodic=self.periodic, origin=self.origin.continued(step))

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


# Line scans where maps are prepared and measured: as a strip of one row, and back.


P = ParamSpec("P")
R = TypeVar("R")
Heights = TypeVar("Heights", bound=Surface | Profile)
"""A map or a line scan."""


def strip(profile: Profile, length: float | None = None) -> Surface:
    """Strip (n, 1) of grooves without end whose section is ``profile``: nothing varies along y
    (plane strain).

    ``length`` along y in m that forces and areas belong to; by default that of the profile, which
    is good for all that does not depend on it. With a ``length``, a trace at a known angle to the
    lay is turned across it first. Raises InputError if the length is not positive.
    """
    wide = profile.length if length is None else require.positive(length, "length of a strip along y (m)")
    origin = profile.origin
    if length is not None:
        if not math.isnan(profile.lay_angle):
            profile = profile.across_lay()
        origin = profile.origin.continued(f"strip: grooves without end along y, forces and areas of {show(wide, 'm')}")
    return Surface(profile.heights[:, None], profile.spacing, wide, periodic=profile.periodic, origin=origin)


class Step(Protocol[P]):
    """A step of preparation, which gives a map for a map and a line scan for a line scan."""

    def __call__(self, surface: Heights, /, *args: P.args, **kwargs: P.kwargs) -> Heights:
        """``surface`` after the step."""


def lines_too(step: Callable[Concatenate[Surface, P], Surface]) -> Step[P]:
    """Let a ``step`` of preparation take line scans: it acts on the strip of one, and what is not
    of heights stays."""

    def taken(surface: Heights, /, *args: P.args, **kwargs: P.kwargs) -> Heights:
        if not isinstance(surface, Profile):
            return cast(Heights, step(cast(Surface, surface), *args, **kwargs))
        found = step(strip(surface), *args, **kwargs)
        cutoff = surface.short_cutoff
        removed = kwargs.get("short")  # of a filter
        made = Profile(
            found.heights[:, 0],
            found.dx,
            periodic=found.periodic,
            lay_angle=surface.lay_angle,
            instrument=surface.instrument,
            short_cutoff=max(cutoff, removed) if isinstance(removed, int | float) else cutoff,
            origin=found.origin,
        )
        return cast(Heights, made)

    functools.update_wrapper(cast(Any, taken), step)
    return taken


def of_lines(measure: Callable[Concatenate[Surface, P], R]) -> Callable[Concatenate[Surface | Profile, P], R]:
    """Let a ``measure`` along x of maps take line scans, as strips of one row."""

    @functools.wraps(measure)
    def taken(surface: Surface | Profile, /, *args: P.args, **kwargs: P.kwargs) -> R:
        return measure(strip(surface) if isinstance(surface, Profile) else surface, *args, **kwargs)

    return taken


def maps_only(measure: Callable[Concatenate[Surface, P], R]) -> Callable[Concatenate[Surface, P], R]:
    """Let a ``measure`` that needs an area refuse line scans with what to do instead."""

    @functools.wraps(measure)
    def taken(surface: Surface, /, *args: P.args, **kwargs: P.kwargs) -> R:
        if isinstance(surface, Profile):
            raise no_area()
        return measure(surface, *args, **kwargs)

    return taken
