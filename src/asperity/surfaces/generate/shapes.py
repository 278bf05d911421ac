"""Deterministic shapes: heights positive out of the body, highest point at zero, centred at node (nx//2, ny//2).

Johnson, K. L. (1985), Contact Mechanics, chapters 4, 5 and 13, uses the same undeformed profiles.
"""

from __future__ import annotations

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.units import show
from ..surface import Origin, Surface


def sphere(grid: Grid, *, radius: float, exact: bool = False) -> Surface:
    """Sphere of ``radius`` R (m), by default its paraboloid h = -r²/(2R), the profile of Hertz' theory.

    With ``exact`` the profile is h = -R + sqrt(R² - r²); paraboloid and sphere differ by about r²/(4R²) of the sag.

    Raises
    ------
    InputError
        If the radius is not positive, or with ``exact`` a node lies outside r <= R.
    """
    radius = require.positive(radius, "sphere radius (m)")
    r_squared = _radius_squared(grid)
    if not exact:
        return _shape(grid, -r_squared / (2.0 * radius), f"paraboloid of a sphere, radius {show(radius, 'm')}")
    farthest = float(np.sqrt(r_squared.max()))
    if farthest > radius:
        raise InputError(
            f"grid of an exact sphere must lie within the radius {radius:g} m of its centre, "
            f"but reaches {farthest:g} m. Use a smaller grid, a larger radius or exact=False."
        )
    sag = r_squared / (radius + np.sqrt(radius**2 - r_squared))  # = R - sqrt(R² - r²) without cancellation
    return _shape(grid, -sag, f"exact sphere, radius {show(radius, 'm')}")


def elliptic_paraboloid(grid: Grid, *, radius_x: float, radius_y: float) -> Surface:
    """Elliptic paraboloid h = -x²/(2 Rx) - y²/(2 Ry) with principal radii ``radius_x``, ``radius_y`` (m, positive).

    Raises
    ------
    InputError
        If a radius is not positive.
    """
    radius_x = require.positive(radius_x, "paraboloid radius along x (m)")
    radius_y = require.positive(radius_y, "paraboloid radius along y (m)")
    x, y = grid.centred_coordinates()
    heights = -(x**2) / (2.0 * radius_x) - y**2 / (2.0 * radius_y)
    return _shape(grid, heights, f"elliptic paraboloid, radii {show(radius_x, 'm')} and {show(radius_y, 'm')}")


def cylinder(grid: Grid, *, radius: float, axis: str = "y") -> Surface:
    """Parabolic cylinder of ``radius`` R (m) along ``axis``: h = -x²/(2R) for a cylinder along y.

    Raises
    ------
    InputError
        If the radius is not positive or the axis is not ``x`` or ``y``.
    """
    radius = require.positive(radius, "cylinder radius (m)")
    require.one_of(axis, ("x", "y"), "cylinder axis")
    x, y = grid.centred_coordinates()
    across = x if axis == "y" else y
    return _shape(grid, -(across**2) / (2.0 * radius), f"parabolic cylinder along {axis}, radius {show(radius, 'm')}")


def cone(grid: Grid, *, slope: float) -> Surface:
    """Cone h = -slope · r; ``slope`` is the tangent of the angle between flank and surface (dimensionless, positive).

    Raises
    ------
    InputError
        If the slope is not positive.
    """
    slope = require.positive(slope, "cone slope")
    return _shape(grid, -slope * np.sqrt(_radius_squared(grid)), f"cone, slope {slope:g}")


def wedge(grid: Grid, *, slope: float, axis: str = "y") -> Surface:
    """Wedge whose edge runs along ``axis``: h = -slope · |x| for an edge along y; ``slope`` as for :func:`cone`.

    Raises
    ------
    InputError
        If the slope is not positive or the axis is not ``x`` or ``y``.
    """
    slope = require.positive(slope, "wedge slope")
    require.one_of(axis, ("x", "y"), "wedge axis")
    x, y = grid.centred_coordinates()
    return _shape(grid, -slope * np.abs(x if axis == "y" else y), f"wedge along {axis}, slope {slope:g}")


def power_law(grid: Grid, *, exponent: float, radius: float, height: float) -> Surface:
    """Indenter h = -height · (r/radius)^n of the ``exponent`` n: 1 a cone, 2 a paraboloid, large n nearly a flat punch.

    ``height`` is the sag at the ``radius``, both in m and positive.

    Raises
    ------
    InputError
        If a value is not positive.
    """
    exponent = require.positive(exponent, "exponent of a power-law indenter")
    radius = require.positive(radius, "radius of a power-law indenter (m)")
    height = require.positive(height, "height of a power-law indenter (m)")
    heights = -height * (_radius_squared(grid) / radius**2) ** (0.5 * exponent)
    return _shape(grid, heights, f"power law, exponent {exponent:g}, height {show(height, 'm')} at {show(radius, 'm')}")


def flat_punch(grid: Grid, *, radius: float, depth: float, edge_radius: float = 0.0) -> Surface:
    """Flat-ended circular punch: h = 0 for r <= ``radius`` and h = -``depth`` outside (both m, positive).

    The edge is resolved to half a pixel; choose ``depth`` larger than any displacement of the problem. With an
    ``edge_radius`` R_e (m) the edge is rounded within a - R_e < r <= a: h = -(R_e - sqrt[R_e² - (r - a + R_e)²]).

    Raises
    ------
    InputError
        If radius or depth is not positive, or the edge radius is not between 0 and both.
    """
    radius = require.positive(radius, "punch radius (m)")
    depth = require.positive(depth, "punch depth (m)")
    r_squared = _radius_squared(grid)
    text = f"flat punch, radius {show(radius, 'm')}, depth {show(depth, 'm')}"
    heights = np.where(r_squared <= radius**2, 0.0, -depth)
    if edge_radius != 0.0:
        edge = require.at_most(edge_radius, min(radius, depth), "edge radius of a punch (m)")
        into = np.clip(np.sqrt(r_squared) - (radius - edge), 0.0, edge)
        heights = np.where(r_squared <= radius**2, np.sqrt(edge**2 - into**2) - edge, -depth)
        text += f", edge radius {show(edge, 'm')}"
    return _shape(grid, heights, text)


def sinusoid(grid: Grid, *, amplitude: float, wavelength: float, axis: str = "x") -> Surface:
    """Wave h = amplitude · [cos(2πx/λ) - 1] along ``axis``, periodic; amplitude and wavelength λ in m, positive.

    Against a flat the gap is amplitude · [1 - cos(2πx/λ)] (Johnson 1985, section 13.2).

    Raises
    ------
    InputError
        If a value is not positive, or the grid is not a whole number of wavelengths sampled at least twice each.
    """
    amplitude = require.positive(amplitude, "sinusoid amplitude (m)")
    require.one_of(axis, ("x", "y"), "sinusoid axis")
    wave = _wave(grid, wavelength, "xy".index(axis))
    text = f"sinusoid along {axis}, amplitude {show(amplitude, 'm')}, wavelength {show(wavelength, 'm')}"
    return _shape(grid, amplitude * (wave - 1.0), text, periodic=True)


def bisinusoid(grid: Grid, *, amplitude: float, wavelength: float) -> Surface:
    """Egg-box h = amplitude · [cos(2πx/λ) + cos(2πy/λ) - 2], periodic; amplitude and wavelength λ in m, positive.

    Source: Johnson, Greenwood & Higginson (1985), with the highest points at zero.

    Raises
    ------
    InputError
        If a value is not positive, or a side of the grid is not a whole number of wavelengths.
    """
    amplitude = require.positive(amplitude, "bisinusoid amplitude (m)")
    heights = amplitude * (_wave(grid, wavelength, 0) + _wave(grid, wavelength, 1) - 2.0)
    text = f"bisinusoid, amplitude {show(amplitude, 'm')}, wavelength {show(wavelength, 'm')}"
    return _shape(grid, heights, text, periodic=True)


def flat(grid: Grid) -> Surface:
    """Flat surface, h = 0 everywhere (not flagged periodic)."""
    return _shape(grid, np.zeros((1, 1)), "flat")


def _radius_squared(grid: Grid) -> RealArray:
    x, y = grid.centred_coordinates()
    r_squared: RealArray = x**2 + y**2
    return r_squared


def _wave(grid: Grid, wavelength: float, axis: int) -> RealArray:
    wavelength = require.positive(wavelength, "wavelength (m)")
    size, spacing, name = grid.size[axis], grid.spacing[axis], "xy"[axis]
    waves = round(size / wavelength)
    if waves < 1 or abs(size / wavelength - waves) > 1e-9 * waves:
        raise InputError(
            f"grid size along {name} must be a whole number of wavelengths ({wavelength:g} m) for a periodic wave, "
            f"but is {size:g} m = {size / wavelength:g} wavelengths. Change the size or the wavelength."
        )
    if wavelength < 2.0 * spacing * (1.0 - 1e-9):
        raise InputError(
            f"wavelength must be at least two pixels ({2.0 * spacing:g} m along {name}), but is {wavelength:g} m. "
            "Refine the grid."
        )
    wave: RealArray = np.cos(2.0 * np.pi * waves * grid.centred_coordinates()[axis] / size)
    return wave


def _shape(grid: Grid, heights: RealArray, text: str, *, periodic: bool = False) -> Surface:
    dx, dy = grid.spacing
    origin = Origin(source=text.split(",")[0], history=(f"generated: {text}",))
    return Surface(np.broadcast_to(heights, grid.shape), dx, dy, periodic=periodic, origin=origin)
