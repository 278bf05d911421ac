"""Two rough bodies as one composite surface."""

from __future__ import annotations

import numpy as np

from ..core import require
from ..core.errors import InputError
from .surface import Origin, Surface


def composite(surface: Surface, counter_surface: Surface, *, mirrored: str | None = None) -> Surface:
    """Sum h = h1 + h2 of two surfaces, each with heights positive out of its own body.

    Only this sum enters the undeformed gap g = g0 - h of frictionless half-spaces (Peng 2001, app. D). A map of the upper body is
    measured looking at that body: turning it over about the y axis replaces x by Lx - x (``mirrored="x"``), about
    the x axis y by Ly - y (``mirrored="y"``). Points missing in either surface are missing in the sum, which is
    periodic only if both are; a periodic surface is mirrored about its node 0, any other about its middle.
    Raises InputError if the grids differ, the mirror is unknown, or no point is valid in both surfaces.

    Parameters
    ----------
    surface, counter_surface
        Surfaces with equal numbers of points and equal pixel sizes (to 1e-6).
    mirrored
        None, ``x`` or ``y``: how the counter surface is turned over.
    """
    other = counter_surface if mirrored is None else turned_over(counter_surface, axis=mirrored)
    pair = (surface, other)
    if surface.shape != other.shape or not np.allclose(surface.grid.spacing, other.grid.spacing, rtol=1e-6, atol=0.0):
        first, second = (f"{s.shape[0]} x {s.shape[1]} points of {s.dx:.6g} x {s.dy:.6g} m" for s in pair)
        raise InputError(
            "the two surfaces of a pair must have equal numbers of points and pixel sizes, but have "
            f"{first} and {second}. Use cropped() and resampled() to bring them on one grid."
        )
    steps = (f"surface {number}: {step}" for number, s in enumerate(pair, start=1) for step in s.origin.history)
    source = " + ".join(s.origin.source or "unnamed surface" for s in pair)
    keys = tuple(dict.fromkeys((*surface.citation_keys, *other.citation_keys, "Peng2001")))
    origin = Origin(source, history=(*steps, "composite: sum of surfaces 1 and 2"), citation_keys=keys)
    periodic = surface.periodic and counter_surface.periodic
    return Surface(surface.heights + other.heights, surface.dx, surface.dy, periodic=periodic, origin=origin)


def turned_over(surface: Surface, *, axis: str = "x") -> Surface:
    """Map of the upper body, measured looking at it, in the lateral frame of the lower one.

    ``axis`` ``"x"`` replaces x by Lx - x (turned about the y axis), ``"y"`` y by Ly - y. A periodic surface is mirrored
    about its node 0, any other about its middle.
    Raises InputError if the axis is not ``x`` or ``y``.
    """
    along = "xy".index(require.one_of(axis, ("x", "y"), "mirror of the counter surface"))
    flipped = np.flip(surface.heights, along)
    heights = np.roll(flipped, 1, along) if surface.periodic else flipped
    return surface.with_heights(heights, f"turned over: mirrored along {axis}")
