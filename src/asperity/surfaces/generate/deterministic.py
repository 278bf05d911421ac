"""Indenters, waves, textures and Weierstrass-Mandelbrot functions."""

from __future__ import annotations

import math
from typing import Annotated, Literal, TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.parameters import checked
from ...core.units import show
from ...core.values import Axis, Count, Length, NonNegativeLength, Number, Positive, Seed
from ..surface import Surface, generated
from .gaussian import SurfaceSeed

WaveAmplitude: TypeAlias = Annotated[Length, "amplitude of the wave"]
Wavelength: TypeAlias = Annotated[Length, "length λ of the wave; the size holds a whole number of them"]
Along: TypeAlias = Annotated[Axis, "direction along which it runs"]

# Deterministic shapes: heights positive out of the body, highest point at zero, centred at node
# (nx//2, ny//2).
#
# Johnson, K. L. (1985), Contact Mechanics, chapters 4, 5 and 13, uses the same undeformed profiles.


@checked
def sphere(
    grid: Grid,
    *,
    radius: Annotated[Length, "radius R"],
    exact: Annotated[bool, "the exact sphere instead of its paraboloid"] = False,
) -> Surface:
    """Sphere of ``radius`` R (m), by default its paraboloid h = -r²/(2R), the profile of Hertz'
    theory.

    With ``exact`` the profile is h = -R + sqrt(R² - r²); paraboloid and sphere differ by about
    r²/(4R²) of the sag. Raises InputError if the radius is not positive, or with ``exact`` a node
    lies outside r <= R.
    """
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


@checked
def elliptic_paraboloid(
    grid: Grid,
    *,
    radius_x: Annotated[Length, "principal radius along x"],
    radius_y: Annotated[Length, "principal radius along y"],
) -> Surface:
    """Elliptic paraboloid h = -x²/(2 Rx) - y²/(2 Ry) with principal radii ``radius_x``,
    ``radius_y`` (m, positive)."""
    x, y = grid.centred_coordinates()
    heights = -(x**2) / (2.0 * radius_x) - y**2 / (2.0 * radius_y)
    return _shape(grid, heights, f"elliptic paraboloid, radii {show(radius_x, 'm')} and {show(radius_y, 'm')}")


@checked
def cylinder(grid: Grid, *, radius: Annotated[Length, "radius R"], axis: Along = "y") -> Surface:
    """Parabolic cylinder of ``radius`` R (m) along ``axis``: h = -x²/(2R) for a cylinder along
    y."""
    x, y = grid.centred_coordinates()
    across = x if axis == "y" else y
    return _shape(grid, -(across**2) / (2.0 * radius), f"parabolic cylinder along {axis}, radius {show(radius, 'm')}")


Slope: TypeAlias = Annotated[Positive, "tangent of the angle between flank and surface"]
"""Slope of an indenter."""


@checked
def cone(grid: Grid, *, slope: Slope) -> Surface:
    """Cone h = -slope · r; ``slope`` is the tangent of the angle between flank and surface
    (dimensionless, positive)."""
    return _shape(grid, -slope * np.sqrt(_radius_squared(grid)), f"cone, slope {slope:g}")


@checked
def wedge(grid: Grid, *, slope: Slope, axis: Along = "y") -> Surface:
    """Wedge whose edge runs along ``axis``: h = -slope · |x| for an edge along y; ``slope`` as for
    :func:`cone`."""
    x, y = grid.centred_coordinates()
    return _shape(grid, -slope * np.abs(x if axis == "y" else y), f"wedge along {axis}, slope {slope:g}")


@checked
def power_law(
    grid: Grid,
    *,
    exponent: Annotated[Positive, "power n of the distance with which the indenter falls"],
    radius: Annotated[Length, "distance from the axis"],
    height: Annotated[Length, "fall of the indenter at the radius"],
) -> Surface:
    """Indenter h = -height · (r/radius)^n of the ``exponent`` n: 1 a cone, 2 a paraboloid, large n
    nearly a flat punch.

    ``height`` is the sag at the ``radius``, both in m and positive.
    """
    heights = -height * (_radius_squared(grid) / radius**2) ** (0.5 * exponent)
    return _shape(grid, heights, f"power law, exponent {exponent:g}, height {show(height, 'm')} at {show(radius, 'm')}")


@checked
def flat_punch(
    grid: Grid,
    *,
    radius: Annotated[Length, "radius of the flat end"],
    depth: Annotated[Length, "depth of the surface around it"],
    edge_radius: Annotated[NonNegativeLength, "radius R_e of the rounded edge"] = 0.0,
) -> Surface:
    """Flat-ended circular punch: h = 0 for r <= ``radius`` and h = -``depth`` outside (both m,
    positive).

    The edge is resolved to half a pixel; choose ``depth`` larger than any displacement of the
    problem. With an ``edge_radius`` R_e (m) the edge is rounded within a - R_e < r <= a: h =
    -(R_e - sqrt[R_e² - (r - a + R_e)²]). Raises InputError if radius or depth is not positive, or
    the edge radius is not between 0 and both.
    """
    r_squared = _radius_squared(grid)
    text = f"flat punch, radius {show(radius, 'm')}, depth {show(depth, 'm')}"
    heights = np.where(r_squared <= radius**2, 0.0, -depth)
    if edge_radius != 0.0:
        edge = require.at_most(edge_radius, min(radius, depth), "edge radius of a punch (m)")
        into = np.clip(np.sqrt(r_squared) - (radius - edge), 0.0, edge)
        heights = np.where(r_squared <= radius**2, np.sqrt(edge**2 - into**2) - edge, -depth)
        text += f", edge radius {show(edge, 'm')}"
    return _shape(grid, heights, text)


@checked
def sinusoid(
    grid: Grid,
    *,
    amplitude: WaveAmplitude,
    wavelength: Wavelength,
    axis: Along = "x",
) -> Surface:
    """Wave h = amplitude · [cos(2πx/λ) - 1] along ``axis``, periodic; amplitude and wavelength λ in
    m, positive.

    Against a flat the gap is amplitude · [1 - cos(2πx/λ)] (Johnson 1985, section 13.2).
    Raises InputError if the grid is not a whole number of wavelengths sampled at least twice each.
    """
    wave = _wave(grid, wavelength, "xy".index(axis))
    text = f"sinusoid along {axis}, amplitude {show(amplitude, 'm')}, wavelength {show(wavelength, 'm')}"
    return _shape(grid, amplitude * (wave - 1.0), text, periodic=True)


@checked
def bisinusoid(
    grid: Grid,
    *,
    amplitude: WaveAmplitude,
    wavelength: Wavelength,
) -> Surface:
    """Egg-box h = amplitude · [cos(2πx/λ) + cos(2πy/λ) - 2], periodic; amplitude and wavelength λ
    in m, positive.

    Source: Johnson, Greenwood & Higginson (1985), with the highest points at zero.
    Raises InputError if a side of the grid is not a whole number of wavelengths.
    """
    heights = amplitude * (_wave(grid, wavelength, 0) + _wave(grid, wavelength, 1) - 2.0)
    text = f"bisinusoid, amplitude {show(amplitude, 'm')}, wavelength {show(wavelength, 'm')}"
    return _shape(grid, heights, text, periodic=True)


def flat(grid: Grid) -> Surface:
    """Flat surface, h = 0 everywhere (not flagged periodic)."""
    return _shape(grid, np.zeros((1, 1)), "flat")


def _radius_squared(grid: Grid) -> RealArray:
    x, y = grid.centred_coordinates()
    return x**2 + y**2


def _wave(grid: Grid, wavelength: float, axis: int) -> RealArray:
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
    return np.asarray(np.cos(2.0 * np.pi * waves * grid.centred_coordinates()[axis] / size))


def _shape(grid: Grid, heights: RealArray, text: str, *, periodic: bool = False) -> Surface:
    return generated(grid, np.broadcast_to(heights, grid.shape), text.split(",")[0], text, periodic=periodic)


Pitches: TypeAlias = Annotated[
    tuple[Length, Length], "distances of the centres along x and y; the size holds a whole number of them"
]
"""Pitches of a lattice."""


# Regular textures: laser bumps, dimples, pillars and grooves, repeated on a lattice of centres.


@checked
def laser_bumps(
    grid: Grid,
    *,
    pitch: Pitches,
    rim_height: Annotated[Length, "height h_rim of the rim"],
    rim_radius: Annotated[NonNegativeLength, "radius r_rim of the rim; 0 makes a dome"],
    rim_width: Annotated[Length, "width w of the rim"],
    depth: Annotated[NonNegativeLength, "depth d of the crater"] = 0.0,
    crater_radius: Annotated[Length | None, "radius w0 of the crater; that of the rim if left out"] = None,
) -> Surface:
    """Periodic lattice of laser-textured bumps: a ring-shaped rim around a crater, or a dome for
    ``rim_radius`` 0.

    h = h_rim exp[-(r - r_rim)²/w²] - d exp(-r²/w0²), r from the nearest centre. A description to be
    fitted to measured bumps, not a law. Heights are measured from the surface between the bumps.
    Raises InputError if a side of the grid is not a whole number of pitches.
    """
    height, width, rim, crater = rim_height, rim_width, rim_radius, depth
    radius = crater_radius or rim or width
    r = np.hypot(*(_from_nearest(grid, pitch[axis], axis) for axis in (0, 1)))
    heights = height * np.exp(-(((r - rim) / width) ** 2)) - crater * np.exp(-((r / radius) ** 2))
    text = (
        f"laser bumps, rim {show(height, 'm')} high at {show(rim, 'm')}, {show(width, 'm')} wide, crater "
        f"{show(crater, 'm')} deep"
    )
    text += f", pitch {show(pitch[0], 'm')} x {show(pitch[1], 'm')}"
    return _shape(grid, heights, text, periodic=True)


@checked
def dimples(
    grid: Grid,
    *,
    pitch: Pitches,
    radius: Annotated[Length, "radius a"],
    depth: Annotated[Length, "depth at the centre"],
    sharpness: Annotated[float, Number(least=1.0), "exponent p: 1 for Gaussian walls, more for steeper ones"] = 1.0,
    raised: Annotated[bool, "pillars instead of dimples"] = False,
) -> Surface:
    """Periodic lattice of dimples h = -depth exp[-(r/a)^(2p)], or with ``raised`` of pillars of
    that height.

    ``sharpness`` p >= 1: 1 is a Gaussian, large values have steep walls and a flat bottom.
    ``radius`` a and ``depth`` in m; ``pitch`` as for :func:`laser_bumps`. The highest level is
    zero. Raises InputError if a side of the grid is not a whole number of pitches.
    """
    x, y = (_from_nearest(grid, pitch[axis], axis) for axis in (0, 1))
    with np.errstate(over="ignore"):  # far outside a sharp dimple
        shape = np.exp(-(((x**2 + y**2) / radius**2) ** sharpness))
    heights = depth * (shape - 1.0) if raised else -depth * shape
    name = "pillars" if raised else "dimples"
    text = f"{name}, radius {show(radius, 'm')}, {show(depth, 'm')}, sharpness {sharpness:g}"
    return _shape(grid, heights, f"{text}, pitch {show(pitch[0], 'm')} x {show(pitch[1], 'm')}", periodic=True)


@checked
def grooves(
    grid: Grid,
    *,
    pitch: Annotated[Length, "distance of the grooves; the size holds a whole number of them"],
    width: Annotated[Length, "width of a groove"],
    depth: Annotated[Length, "depth at the middle of a groove"],
    section: Annotated[Literal["vee", "round", "cosine"], "cross section of a groove"] = "vee",
    axis: Along = "y",
) -> Surface:
    """Periodic grooves along ``axis`` in a flat surface at height zero.

    Within half a ``width`` of its middle a groove is ``vee`` shaped, ``round`` (a parabola) or a
    ``cosine`` that meets the surface smoothly; depth at the middle. ``pitch`` >= ``width``, all in
    m. A groove lies at the middle of the grid. Raises InputError if the side across the grooves is
    not a whole number of pitches.
    """
    if width > pitch * (1.0 + 1e-9):
        raise InputError(f"width of the grooves must not exceed their pitch ({pitch:g} m), but is {width:g} m.")
    across = 0 if axis == "y" else 1
    u = np.minimum(np.abs(_from_nearest(grid, pitch, across)) / (0.5 * width), 1.0)
    profile = {"vee": 1.0 - u, "round": 1.0 - u**2, "cosine": 0.5 * (1.0 + np.cos(np.pi * u))}[section]
    text = f"{section} grooves along {axis}, {show(width, 'm')} wide, {show(depth, 'm')} deep, pitch {show(pitch, 'm')}"
    return _shape(grid, -depth * profile, text, periodic=True)


def _from_nearest(grid: Grid, pitch: float, axis: int) -> RealArray:
    """Distances along ``axis`` in m, x (nx, 1) or y (1, ny), from the nearest centre of the
    lattice."""
    size, name = grid.size[axis], "xy"[axis]
    count = round(size / pitch)
    if count < 1 or abs(size / pitch - count) > 1e-9 * count:
        raise InputError(
            f"grid size along {name} must be a whole number of pitches ({pitch:g} m) for a periodic texture, "
            f"but is {size:g} m = {size / pitch:g} pitches. Change the size or the pitch."
        )
    period = size / count
    u = grid.centred_coordinates()[axis]
    return u - period * np.round(u / period)


# Weierstrass-Mandelbrot functions: deterministic fractal profiles and surfaces of a discrete
# spectrum.


FrequencyRatio: TypeAlias = Annotated[
    float, Number(above=1.0, fix="1.5 is usual."), "ratio γ of neighbouring frequencies"
]
FractalRoughness: TypeAlias = Annotated[Length, "fractal roughness G: a scale of the amplitudes, not a height"]
ShortestWave: TypeAlias = Annotated[Length | None, "shortest wave L_s; two pixels if left out"]
LongestWave: TypeAlias = Annotated[Length | None, "longest wave L; the size of the grid if left out"]

_MOST_WAVES = 100_000
_SOURCE = "Weierstrass-Mandelbrot"


@checked
def weierstrass_mandelbrot(
    grid: Grid,
    *,
    dimension: Annotated[float, Number(above=2.0, below=3.0), "fractal dimension D of the surface"],
    roughness: FractalRoughness,
    seed: SurfaceSeed,
    gamma: FrequencyRatio = 1.5,
    ridges: Annotated[Count, "number M of directions"] = 10,
    length: LongestWave = None,
    shortest_wavelength: ShortestWave = None,
) -> Surface:
    """Weierstrass-Mandelbrot surface (Ausloos & Berman 1985; Yan & Komvopoulos 1998) without its
    constant.

    z = -L (G/L)^(D-2) sqrt(ln γ/M) Σ_m Σ_n γ^((D-3)n) cos[2π γ^n (x cos(πm/M) + y sin(πm/M))/L +
    φ_mn], m = 1…M, n = 0…n_max, n_max = floor(ln(L/L_s)/ln γ), phases φ uniform. The spectrum is a
    set of lines, the map is not periodic, and isotropic only for many ridges; prefer
    ``asp.generate.gaussian`` unless a published case is to be repeated.
    """
    longest = max(grid.size) if length is None else length
    shortest = 2.0 * max(grid.spacing) if shortest_wavelength is None else shortest_wavelength
    if shortest > longest:
        raise InputError(
            f"shortest wave must not be longer than the longest ({longest:g} m), but is {shortest:g} m. Refine "
            "the grid."
        )
    count = math.floor(math.log(longest / shortest) / math.log(gamma) + 1e-9) + 1
    _require_count(count * ridges)
    powers = np.arange(count, dtype=float)
    phases = np.random.Generator(np.random.PCG64(seed)).uniform(0.0, 2.0 * np.pi, (ridges, powers.size))
    angle = np.pi * np.arange(1, ridges + 1)[:, None] / ridges
    q = 2.0 * np.pi * gamma**powers / longest
    level = longest * (roughness / longest) ** (dimension - 2.0) * math.sqrt(math.log(gamma) / ridges)
    amplitude = np.broadcast_to(-level * gamma ** ((dimension - 3.0) * powers), phases.shape).ravel()
    # the sum of waves is one matrix product: cos(α + β) is the real part of e^(iα) e^(iβ)
    x, y = grid.coordinates()
    along_x, along_y = (q * np.cos(angle)).ravel() * x + phases.ravel(), (q * np.sin(angle)).ravel() * y.T
    heights: RealArray = (np.cos(along_x) * amplitude) @ np.cos(along_y).T
    heights -= (np.sin(along_x) * amplitude) @ np.sin(along_y).T
    text = (
        f"Weierstrass-Mandelbrot surface, dimension {dimension:.4g}, roughness {show(roughness, 'm')}, γ {gamma:.4g}, "
        f"{ridges} ridges, {powers.size} waves each from {show(longest, 'm')} down, PCG64 seed {seed}"
    )
    return generated(grid, heights, _SOURCE, text, periodic=False, citation_keys=("Ausloos1985", "Yan1998"))


@checked
def weierstrass_mandelbrot_profile(
    grid: Grid,
    *,
    dimension: Annotated[float, Number(above=1.0, below=2.0), "fractal dimension D of the profile"],
    roughness: FractalRoughness,
    gamma: FrequencyRatio = 1.5,
    length: LongestWave = None,
    shortest_wavelength: ShortestWave = None,
    seed: Annotated[Seed | None, "seed of random phases; all are 0 if left out"] = None,
) -> Surface:
    """Weierstrass-Mandelbrot profile along x, equal for all y: z = G^(D-1) Σ cos(2π γ^n x +
    φ_n)/γ^((2-D)n), n = n1…n2.

    γ^n counts cycles per metre; n1 = floor(ln(1/L)/ln γ), n2 = ceil(ln(1/L_s)/ln γ) (Majumdar &
    Bhushan 1990).
    """
    longest = grid.size[0] if length is None else length
    shortest = 2.0 * grid.spacing[0] if shortest_wavelength is None else shortest_wavelength
    first = math.floor(math.log(1.0 / longest) / math.log(gamma))
    powers = np.arange(first, math.ceil(math.log(1.0 / shortest) / math.log(gamma)) + 1, dtype=float)
    _require_count(powers.size)
    phases = np.zeros(powers.size)
    if seed is not None:
        phases = np.random.Generator(np.random.PCG64(seed)).uniform(0.0, 2.0 * np.pi, powers.size)
    amplitude = roughness ** (dimension - 1.0) * gamma ** (-(2.0 - dimension) * powers)
    x = grid.coordinates()[0]
    profile = np.cos(2.0 * np.pi * gamma**powers * x + phases) @ amplitude
    how = "phases 0" if seed is None else f"phases of PCG64 seed {seed}"
    text = (
        f"Weierstrass-Mandelbrot profile, dimension {dimension:.4g}, roughness {show(roughness, 'm')}, γ {gamma:.4g}, "
        f"powers {first} to {int(powers[-1])}, {how}"
    )
    heights = np.broadcast_to(profile[:, None], grid.shape)
    return generated(grid, heights, _SOURCE, text, periodic=False, citation_keys=("Majumdar1990",))


def _require_count(count: int) -> None:
    if not 0 < count <= _MOST_WAVES:
        raise InputError(
            f"waves of a Weierstrass-Mandelbrot function must be between 1 and {_MOST_WAVES}, but are {count}. "
            "Change γ, the wavelengths or the number of ridges."
        )
