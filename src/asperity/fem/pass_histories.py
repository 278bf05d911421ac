"""Histories of passes: the pressure of Hertz that is given and moves, and rigid indenters that are
pressed, slide and are lifted."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from .passes import PassHistory, PassState, Track


def line_load(track: Track, place: float, half_width: float, peak: float) -> RealArray:
    """Forces (points,) in N/m of the pressure peak sqrt(1 - (x - place)²/a²) on |x - place| < a =
    ``half_width``, exactly those of its elements.

    Raises
    ------
    InputError
        If the track is not one of line contacts.
    """
    if track.dimension != 2:
        raise InputError("track of a line load must be that of a cylinder, but is that of a sphere.")
    x = (track.places[:, 0] - place) / half_width
    s = np.clip(x, -1.0, 1.0)
    whole, first = 0.5 * (s * np.sqrt(1.0 - s**2) + np.arcsin(s)), -((1.0 - s**2) ** 1.5) / 3.0
    length = np.diff(x)
    later = (np.diff(first) - x[:-1] * np.diff(whole)) / length
    found = np.append(np.diff(whole) - later, 0.0) + np.append(0.0, later)
    forces: RealArray = peak * half_width * found
    return forces


def point_load(track: Track, place: float, radius: float, peak: float) -> RealArray:
    """Forces (points,) in N of the pressure peak sqrt(1 - r²/a²) on r < a = ``radius`` (m) about
    (``place``, 0), on the half y >= 0 of the body.

    Bilinear shape functions, by midpoints of 12 x 12 parts of each element; all are scaled by one
    factor so that the sum is that of half the load, π a² peak/3.

    Raises
    ------
    InputError
        If the track is not one of point contacts.
    """
    if track.dimension != 3:
        raise InputError("track of a point load must be that of a sphere, but is that of a cylinder.")
    x, y = (np.unique(track.places[:, axis]) for axis in (0, 1))
    share = (np.arange(12) + 0.5) / 12.0
    along, across = (line[:-1, None] + np.diff(line)[:, None] * share for line in (x, y))
    squared = (along[:, None, :, None] - place) ** 2 + across[None, :, None, :] ** 2
    part = np.diff(x)[:, None, None, None] * np.diff(y)[None, :, None, None] / 144.0
    pushed = part * np.sqrt(np.maximum(1.0 - squared / radius**2, 0.0))
    found = np.zeros((len(x), len(y)))
    ends = ((slice(None, -1), 1.0 - share), (slice(1, None), share))
    for rows, near in ends:
        for columns, close in ends:
            found[rows, columns] += np.einsum("ijab,a,b->ij", pushed, near, close)
    forces: RealArray = found.ravel() * (peak * math.pi * radius**2 / 3.0 / found.sum())
    return forces


def hertz_pass(
    track: Track,
    start: PassState,
    peak: float,
    half_width: float,
    ends: tuple[float, float],
    *,
    friction: float = 0.0,
    steps: int = 36,
    ramp: int = 3,
) -> PassHistory:
    """One pass of the Hertz pressure with ``peak`` in Pa and the traction ``friction`` times it:
    put on at the first of the ``ends`` in ``ramp`` steps, moved to the other in ``steps``, taken
    off.

    ``half_width``: that of a line contact, or the radius of a point contact, in m.

    Raises
    ------
    InputError
        If the peak or the half-width is not positive, or a number of steps less than one.
    ConvergenceError
        If a step does not converge.
    """
    made = hertz_steps(track, start, peak, half_width, ends, friction=friction, steps=steps, ramp=ramp)
    return track.history(list(made))


def hertz_steps(
    track: Track,
    start: PassState,
    peak: float,
    half_width: float,
    ends: tuple[float, float],
    *,
    friction: float = 0.0,
    steps: int = 36,
    ramp: int = 3,
) -> Iterator[PassState]:
    """The states at the ends of the steps of ``hertz_pass``, one after the other; between equal
    ends nothing moves."""
    require.positive(peak, "peak pressure (Pa)")
    require.positive(half_width, "half-width of a line load (m)")
    rise = np.linspace(0.0, 1.0, require.integer(ramp, 1, "steps of a ramp") + 1)
    places = np.linspace(*ends, require.integer(steps, 1, "steps of a pass") + 1)
    course = [(ends[0], share) for share in rise[1:]]
    course += [(place, 1.0) for place in places[1:] if ends[0] != ends[1]]
    course += [(ends[1], share) for share in rise[-2::-1]]
    load, now = line_load if track.dimension == 2 else point_load, start
    for place, share in course:
        push = share * load(track, place, half_width, peak)
        now = track.carry(replace(now, place=place), push, friction * push, place)
        yield now


def sliding_pass(
    track: Track,
    start: PassState,
    indenter: Callable[[RealArray], RealArray],
    force: float,
    ends: tuple[float, float],
    *,
    friction: float = 0.0,
    steps: int = 12,
    ramp: int = 4,
) -> PassHistory:
    """One pass of a rigid ``indenter``: pressed at the first of the ``ends`` up to ``force`` in N
    (N/m) in ``ramp`` steps, slid to the other in ``steps``, lifted in ``ramp`` steps.

    ``indenter`` and ``friction`` as for ``Track.press``; pressing and lifting are without friction.
    The force on a sphere is that on the half body.

    Raises
    ------
    InputError
        If the force is not positive or a number of steps less than one.
    ConvergenceError
        If a step does not converge.
    """
    made = sliding_steps(track, start, indenter, force, ends, friction=friction, steps=steps, ramp=ramp)
    return track.history(list(made))


def sliding_steps(
    track: Track,
    start: PassState,
    indenter: Callable[[RealArray], RealArray],
    force: float,
    ends: tuple[float, float],
    *,
    friction: float = 0.0,
    steps: int = 12,
    ramp: int = 4,
) -> Iterator[PassState]:
    """The states at the ends of the steps of ``sliding_pass``, one after the other; between equal
    ends the indenter is pressed and lifted alone."""
    require.positive(force, "force of an indenter")
    loads = np.linspace(0.0, force, require.integer(ramp, 1, "steps of a ramp") + 1)
    places = np.linspace(*ends, require.integer(steps, 1, "steps of a pass") + 1)
    now = replace(start, place=ends[0], approach=math.nan)
    for load in loads[1:]:
        now = track.press(now, indenter, place=ends[0], force=float(load))
        yield now
    for place in places[1:] if ends[0] != ends[1] else ():
        now = track.press(now, indenter, place=float(place), force=force, friction=friction)
        yield now
    for load in loads[-2:0:-1]:
        now = track.press(now, indenter, place=ends[1], force=float(load))
        yield now
    nothing = np.zeros(len(track.surface))
    yield track.carry(now, nothing, nothing, ends[1])
