"""Indenters, waves and textures."""

from __future__ import annotations

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.units import show
from ..surface import Origin, Surface

# Deterministic shapes: heights positive out of the body, highest point at zero, centred at node (nx//2, ny//2).
#
# Johnson, K. L. (1985), Contact Mechanics, chapters 4, 5 and 13, uses the same undeformed profiles.


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


# Regular textures: laser bumps, dimples, pillars and grooves, repeated on a lattice of centres.


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
