"""Shapes of axisymmetric indenters: the gap under one whose lowest point touches an undeformed
surface, as a function of r.

Any function of an array of r (m) that gives heights (m), zero at r = 0 and growing, is an indenter;
``inf`` stands beyond its edge.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.status import Advice

LARGEST_SLOPE, SMALL_SLOPE = 0.4, 0.15
"""Slope of an indenter at the edge of the contact, of a ball contact over indenter radius, beyond
which strains are not small, and up to which small strains err by a few per cent."""

LARGE_STRAIN = 0.1
"""Accumulated plastic strain from which on small strains err by more than a few per cent."""

Indenter: TypeAlias = Callable[[RealArray], RealArray]
"""Height in m at the distances r (m) from the axis."""


@dataclass(frozen=True)
class _OfRadius:
    """Base of the indenters with a ``radius`` in m, > 0."""

    radius: float

    def __post_init__(self) -> None:
        require.magnitude(self.radius, "radius of the indenter (m)")


@dataclass(frozen=True)
class Paraboloid(_OfRadius):
    """r²/2R: what Hertz takes for a sphere. ``radius``: R in m, > 0."""

    def __call__(self, r: RealArray) -> RealArray:
        """Height in m at ``r`` in m."""
        found: RealArray = r**2 / (2.0 * self.radius)
        return found


@dataclass(frozen=True)
class Sphere(_OfRadius):
    """Ball with its true shape, up to its equator. ``radius``: R in m, > 0."""

    def __call__(self, r: RealArray) -> RealArray:
        """Height in m at ``r`` in m."""
        inside = np.minimum(r / self.radius, 1.0)
        height = self.radius * inside**2 / (1.0 + np.sqrt(1.0 - inside**2))
        return np.where(r <= self.radius, height, math.inf)


@dataclass(frozen=True)
class Cone:
    """Cone. ``slope``: height over radius, > 0: the cotangent of half the angle at the apex; 0.3579
    displaces as much as Berkovich's pyramid (70.3°)."""

    slope: float

    def __post_init__(self) -> None:
        require.positive(self.slope, "slope of the cone")

    def __call__(self, r: RealArray) -> RealArray:
        """Height in m at ``r`` in m."""
        found: RealArray = self.slope * r
        return found


@dataclass(frozen=True)
class FlatPunch(_OfRadius):
    """Flat end of a cylinder. ``radius``: in m, > 0."""

    def __call__(self, r: RealArray) -> RealArray:
        """Height in m at ``r`` in m; the edge belongs to the punch."""
        return np.where(r <= self.radius * (1.0 + 1e-9), 0.0, math.inf)


def ball_radius(indenter: Indenter) -> float:
    """Radius in m of a ball or paraboloid; infinite for other shapes, whose slope does not tell how
    far they are pressed."""
    return indenter.radius if isinstance(indenter, Paraboloid | Sphere) else math.inf


def beyond_small_strain(contact_radius: float, ball: float) -> Iterator[Advice]:
    """Warning where the contact of a ``ball`` (its radius in m) is so large that small strains
    err."""
    if contact_radius > SMALL_SLOPE * ball:
        fact = (
            f"The contact radius is {contact_radius / ball:.2g} of that of the indenter. Beyond "
            f"{SMALL_SLOPE:g} small strains err by more than a few per cent."
        )
        numbers = {"share": contact_radius / ball, "largest": SMALL_SLOPE}
        yield Advice(
            "warning", "small strain", fact, "Take a smaller depth ({indentation.depth}).", numbers, ("indent_",)
        )


def require_gentle(indenter: Indenter, places: RealArray) -> None:
    """Refuse an ``indenter`` over a track that is steeper than 0.4 where it touches: at the
    ``places`` (points, 1 or 2) in m from its lowest point.

    Raises
    ------
    InputError
        If it is.
    """
    if len(places) == 0:
        return
    half = 1e-4 * max(float(np.abs(places).max()), 1e-300)
    slopes = []
    for axis in range(places.shape[1]):
        move = np.zeros(places.shape[1])
        move[axis] = half
        slopes.append((indenter(places + move) - indenter(places - move)) / (2.0 * half))
    steepest = np.sqrt(np.sum(np.square(slopes), axis=0))
    largest = float(np.max(steepest, where=np.isfinite(steepest), initial=0.0))
    if largest > LARGEST_SLOPE:
        raise InputError(
            f"slope of the indenter must be at most {LARGEST_SLOPE:g} where it touches, but is {largest:.2g}. "
            "Beyond that strains are not small: take a smaller load, or a larger radius.",
            subject="slope of the indenter",
        )


def radius_at(indenter: Indenter, height: float) -> float:
    """Distance from the axis in m up to which ``indenter`` is lower than ``height`` (m).

    Raises
    ------
    InputError
        If the indenter does not start at height zero, is no function of r, or stays lower than the
        height up to 10¹² times it.
    """
    if not callable(indenter):
        raise InputError(
            f"indenter must be a function of the distance from the axis, but is {indenter!r}. Write "
            "Paraboloid(R), Sphere(R), Cone(slope) or FlatPunch(a)."
        )
    if not float(indenter(np.zeros(1))[0]) == 0.0:
        raise InputError(
            f"indenter must have height zero at r = 0, but is {float(indenter(np.zeros(1))[0]):g} m there."
        )
    trial = height * np.geomspace(1e-12, 1e12, 4801)
    above = np.flatnonzero(indenter(trial) >= height)
    if not len(above) or above[0] == 0:
        raise InputError(f"indenter must rise to the approach of {height:g} m within 1e12 times it, but does not.")
    low, high = trial[above[0] - 1], trial[above[0]]
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if indenter(np.array([middle]))[0] < height else (low, middle)
    return float(low)
