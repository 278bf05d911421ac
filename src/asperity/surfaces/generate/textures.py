"""Regular textures: laser bumps, dimples, pillars and grooves, repeated on a lattice of centres."""

from __future__ import annotations

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.units import show
from ..surface import Origin, Surface

GROOVES = ("vee", "round", "cosine")
"""Cross sections of grooves."""


def laser_bumps(
    grid: Grid,
    *,
    pitch: tuple[float, float],
    rim_height: float,
    rim_radius: float,
    rim_width: float,
    depth: float = 0.0,
    crater_radius: float | None = None,
) -> Surface:
    """Periodic lattice of laser-textured bumps: a ring-shaped rim around a crater, or a dome for ``rim_radius`` 0.

    h = h_rim exp[-(r - r_rim)²/w²] - d exp(-r²/w0²), r from the nearest centre. A description to be fitted to measured
    bumps, not a law. Heights are measured from the surface between the bumps.

    Parameters
    ----------
    grid
        Nodes of the surface; each side a whole number of pitches.
    pitch
        Distances (m) of the centres along x and y; centres lie on node (nx // 2, ny // 2) and one pitch apart.
    rim_height, rim_radius, rim_width
        h_rim, r_rim >= 0 and w in m.
    depth, crater_radius
        d >= 0 and w0 in m; the crater radius is that of the rim if omitted.

    Raises
    ------
    InputError
        If a value is out of range, or a side of the grid is not a whole number of pitches.
    """
    height = require.positive(rim_height, "height of the rim (m)")
    width = require.positive(rim_width, "width of the rim (m)")
    rim, crater = _not_negative(rim_radius, "radius of the rim (m)"), _not_negative(depth, "depth of the crater (m)")
    radius = require.positive(crater_radius or rim or width, "radius of the crater (m)")
    r = np.hypot(*_from_centres(grid, pitch))
    heights = height * np.exp(-(((r - rim) / width) ** 2)) - crater * np.exp(-((r / radius) ** 2))
    text = f"laser bumps, rim {show(height, 'm')} high at {show(rim, 'm')}, {show(width, 'm')} wide, crater {show(crater, 'm')} deep"
    return _texture(grid, heights, text, pitch)


def dimples(
    grid: Grid, *, pitch: tuple[float, float], radius: float, depth: float, sharpness: float = 1.0, raised: bool = False
) -> Surface:
    """Periodic lattice of dimples h = -depth exp[-(r/a)^(2p)], or with ``raised`` of pillars of that height.

    ``sharpness`` p >= 1: 1 is a Gaussian, large values have steep walls and a flat bottom. ``radius`` a and ``depth`` in m;
    ``pitch`` as for :func:`laser_bumps`. The highest level is zero.

    Raises
    ------
    InputError
        If a value is out of range, or a side of the grid is not a whole number of pitches.
    """
    radius = require.positive(radius, "radius of the dimples (m)")
    depth = require.positive(depth, "depth of the dimples (m)")
    if not require.finite(sharpness, "sharpness of the dimples") >= 1.0:
        raise InputError(f"sharpness of the dimples must be at least 1, but is {sharpness:g}.")
    x, y = _from_centres(grid, pitch)
    with np.errstate(over="ignore"):  # far outside a sharp dimple
        shape = np.exp(-(((x**2 + y**2) / radius**2) ** sharpness))
    heights = depth * (shape - 1.0) if raised else -depth * shape
    name = "pillars" if raised else "dimples"
    return _texture(
        grid, heights, f"{name}, radius {show(radius, 'm')}, {show(depth, 'm')}, sharpness {sharpness:g}", pitch
    )


def grooves(grid: Grid, *, pitch: float, width: float, depth: float, section: str = "vee", axis: str = "y") -> Surface:
    """Periodic grooves along ``axis`` in a flat surface at height zero.

    Within half a ``width`` of its middle a groove is ``vee`` shaped, ``round`` (a parabola) or a ``cosine`` that meets the
    surface smoothly; depth at the middle. ``pitch`` >= ``width``, all in m. A groove lies at the middle of the grid.

    Raises
    ------
    InputError
        If a value is out of range, or the side across the grooves is not a whole number of pitches.
    """
    pitch, width = (
        require.positive(pitch, "pitch of the grooves (m)"),
        require.positive(width, "width of the grooves (m)"),
    )
    depth = require.positive(depth, "depth of the grooves (m)")
    require.one_of(section, GROOVES, "cross section of the grooves")
    require.one_of(axis, ("x", "y"), "axis of the grooves")
    if width > pitch * (1.0 + 1e-9):
        raise InputError(f"width of the grooves must not exceed their pitch ({pitch:g} m), but is {width:g} m.")
    across = 0 if axis == "y" else 1
    u = np.minimum(np.abs(_from_nearest(grid, pitch, across)) / (0.5 * width), 1.0)
    profile = {"vee": 1.0 - u, "round": 1.0 - u**2, "cosine": 0.5 * (1.0 + np.cos(np.pi * u))}[section]
    text = f"{section} grooves along {axis}, {show(width, 'm')} wide, {show(depth, 'm')} deep, pitch {show(pitch, 'm')}"
    return _made(grid, -depth * profile, text)


def _from_centres(grid: Grid, pitch: tuple[float, float]) -> tuple[RealArray, RealArray]:
    """Distances x (nx, 1) and y (1, ny) in m from the nearest centre of the lattice."""
    pair = require.two(pitch, "pitch of a texture (m)", "Write (along x, along y).")
    along = [require.positive(p, f"pitch of a texture along {a} (m)") for p, a in zip(pair, "xy", strict=True)]
    return _from_nearest(grid, along[0], 0), _from_nearest(grid, along[1], 1)


def _from_nearest(grid: Grid, pitch: float, axis: int) -> RealArray:
    size, name = grid.size[axis], "xy"[axis]
    count = round(size / pitch)
    if count < 1 or abs(size / pitch - count) > 1e-9 * count:
        raise InputError(
            f"grid size along {name} must be a whole number of pitches ({pitch:g} m) for a periodic texture, "
            f"but is {size:g} m = {size / pitch:g} pitches. Change the size or the pitch."
        )
    period = size / count
    u = grid.centred_coordinates()[axis]
    distance: RealArray = u - period * np.round(u / period)
    return distance


def _not_negative(value: float, what: str) -> float:
    if not require.finite(value, what) >= 0.0:
        raise InputError(f"{what} must be zero or greater, but is {value:g}.")
    return float(value)


def _texture(grid: Grid, heights: RealArray, text: str, pitch: tuple[float, float]) -> Surface:
    return _made(grid, heights, f"{text}, pitch {show(pitch[0], 'm')} x {show(pitch[1], 'm')}")


def _made(grid: Grid, heights: RealArray, text: str) -> Surface:
    dx, dy = grid.spacing
    origin = Origin(source=text.split(",")[0], history=(f"generated: {text}",))
    return Surface(np.broadcast_to(heights, grid.shape), dx, dy, periodic=True, origin=origin)
