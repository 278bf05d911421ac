"""Surfaces of two roughnesses: patches, plateaus with valleys, particles on a matrix.

Peng & Bhushan (2000) brought surfaces of bimodal roughness, such as coatings with particles, into contact mechanics; the
three constructions here, all from independent Gaussian fields, cover that class but follow no formula of their paper.
"""

from __future__ import annotations

import math

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.citations import citation_keys
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.units import show
from ..surface import Origin, Surface
from .gaussian import Spectrum, random_field, sub_seeds

_KEYS = ("PengBhushan2000",)
_MOST_PARTICLES = 10_000_000


def bimodal(
    grid: Grid,
    first: Spectrum,
    second: Spectrum,
    *,
    share: float,
    separation: float,
    patches: Spectrum,
    seed: int,
) -> Surface:
    """Periodic surface of two textures side by side: patches of the first on ``share`` of the area, the second elsewhere.

    h = X where M < Φ⁻¹(share), else Y, with independent Gaussian fields X, Y and M; there are steps at the boundaries.
    With p the share, d the distance of a mean from the common one: <h²> = Σ p (σ² + d²), <h³> = Σ p (d³ + 3 d σ²),
    <h⁴> = Σ p (d⁴ + 6 d² σ² + 3 σ⁴) about the mean.

    Parameters
    ----------
    grid
        Nodes of the surface.
    first, second
        Spectra or autocorrelations of the textures, with their rms heights.
    share
        Fraction of the area of the first texture, 0 < share < 1 (on average over realisations).
    separation
        Height in m of the mean plane of the first texture above that of the second, of either sign.
    patches
        Spectrum or autocorrelation of M, which sets size and shape of the patches; its rms height does not matter.
    seed
        Whole number >= 0, of three independent streams.

    Raises
    ------
    InputError
        If a value is out of range or the grid does not suit a spectrum.
    """
    from scipy.special import ndtri

    seed = require.integer(seed, 0, "seed of a random surface")
    share = require.between(share, 0.0, 1.0, "share of the first texture")
    separation = require.finite(separation, "separation of the textures (m)")
    seeds = sub_seeds(seed, 3)
    texture, other, mask = (random_field(grid, s, n) for s, n in zip((first, second, patches), seeds, strict=True))
    mask /= np.sqrt(np.mean(np.square(mask)))
    heights = np.where(mask < float(ndtri(share)), texture + separation, other)
    text = (
        f"generated: two textures, {share:.4g} of the area {first.describe(grid)}, {show(separation, 'm')} above "
        f"{second.describe(grid)}, in patches of {patches.describe(grid)}, seed {seed}"
    )
    return _surface(grid, heights, "bimodal", text, (first, second, patches))


def two_process(
    grid: Grid, plateau: Spectrum, valleys: Spectrum, *, offset: float, seed: int, keep: str = "lower"
) -> Surface:
    """Periodic surface of a second process over a first one: h = min(X, Y), as by honing or wear; max for deposits.

    X is the fine texture of the plateau with mean 0, Y the coarse one with mean ``offset``, independent Gaussian
    fields. The material ratio on probability paper is two straight lines; the heights are usually strongly skewed.

    Parameters
    ----------
    grid
        Nodes of the surface.
    plateau, valleys
        Spectra or autocorrelations of X and Y.
    offset
        Mean of Y less that of X in m, of either sign.
    seed
        Whole number >= 0, of two independent streams.
    keep
        ``lower`` (min) or ``upper`` (max).

    Raises
    ------
    InputError
        If a value is out of range or the grid does not suit a spectrum.
    """
    seed = require.integer(seed, 0, "seed of a random surface")
    offset = require.finite(offset, "offset of the second process (m)")
    require.one_of(keep, ("lower", "upper"), "height that is kept of two processes")
    first, second = (random_field(grid, s, n) for s, n in zip((plateau, valleys), sub_seeds(seed, 2), strict=True))
    heights = (np.minimum if keep == "lower" else np.maximum)(first, second + offset)
    text = (
        f"generated: two processes, the {keep} of {plateau.describe(grid)} and, {show(offset, 'm')} above, "
        f"{valleys.describe(grid)}, seed {seed}"
    )
    return _surface(grid, heights, "two processes", text, (plateau, valleys))


def particles(
    grid: Grid,
    matrix: Spectrum,
    *,
    density: float,
    radius: float,
    radius_deviation: float = 0.0,
    exposure: float = 2.0,
    seed: int,
) -> Surface:
    """Periodic surface of spheres in or on a rough matrix: h = max(h_m, z - R + sqrt(R² - r²)).

    Places are independent and uniform, so spheres overlap by chance; their number is Poisson distributed. Radii are normal,
    those not positive drawn again. The top of each stands ``exposure`` radii above the matrix at its centre.

    Parameters
    ----------
    grid
        Nodes of the surface.
    matrix
        Spectrum or autocorrelation of the matrix.
    density
        Mean number of particles per area in 1/m².
    radius, radius_deviation
        Mean and standard deviation of the radii in m.
    exposure
        Height of a top above the matrix in units of its radius, 0 < exposure <= 2; 2 lies on the matrix, 1 is half sunk.
    seed
        Whole number >= 0, of two independent streams.

    Raises
    ------
    InputError
        If a value is out of range, there are more than ten million particles, or one is wider than the grid.
    """
    seed = require.integer(seed, 0, "seed of a random surface")
    radius = require.positive(radius, "radius of the particles (m)")
    exposure = require.within(exposure, 0.0, 2.0, "exposure of the particles")
    _require_particles(grid, density, radius_deviation)
    field_seed, place_seed = sub_seeds(seed, 2)
    heights = random_field(grid, matrix, field_seed)
    ground = heights.copy()
    draw = np.random.Generator(np.random.PCG64(place_seed))
    count = int(draw.poisson(density * grid.area))
    places = draw.random((count, 2)) * grid.size
    for place, size in zip(places, _radii(draw, count, radius, radius_deviation), strict=True):
        _add_sphere(heights, ground, grid, place, float(size), exposure)
    text = (
        f"generated: {count} particles of radius {show(radius, 'm')} ± {show(radius_deviation, 'm')}, exposed by {exposure:.4g} radii, "
        f"on {matrix.describe(grid)}, seed {seed}"
    )
    return _surface(grid, heights, "particles", text, (matrix,))


def _require_particles(grid: Grid, density: float, deviation: float) -> None:
    count = require.positive(density, "density of the particles (1/m²)") * grid.area
    if count > _MOST_PARTICLES or not require.finite(deviation, "deviation of the radii (m)") >= 0.0:
        raise InputError(
            f"particles must be at most {_MOST_PARTICLES} with a deviation of the radii of 0 or more, but are {count:.3g} "
            f"with {deviation:g} m. Reduce density or area."
        )


def _radii(draw: np.random.Generator, count: int, mean: float, deviation: float) -> RealArray:
    """Positive normal numbers (count,) in m."""
    radii = mean + deviation * draw.standard_normal(count)
    while (wrong := radii <= 0.0).any():
        radii[wrong] = mean + deviation * draw.standard_normal(int(np.count_nonzero(wrong)))
    return radii


def _add_sphere(
    heights: RealArray, ground: RealArray, grid: Grid, place: RealArray, radius: float, exposure: float
) -> None:
    """Raise ``heights`` to the sphere at ``place`` (x, y) in m, across the borders."""
    if 2.0 * radius > min(grid.size):
        raise InputError(
            f"particles must fit into the grid of {grid.size[0]:.3g} x {grid.size[1]:.3g} m, but one has the radius "
            f"{radius:.3g} m. Enlarge the grid or reduce the radius."
        )
    nodes = [
        np.arange(math.ceil((c - radius) / d), math.floor((c + radius) / d) + 1)
        for c, d in zip(place, grid.spacing, strict=True)
    ]
    square = radius**2 - (
        (nodes[0][:, None] * grid.spacing[0] - place[0]) ** 2 + (nodes[1][None, :] * grid.spacing[1] - place[1]) ** 2
    )
    nearest = tuple(round(c / d) % n for c, d, n in zip(place, grid.spacing, grid.shape, strict=True))
    base = float(ground[nearest]) + (exposure - 1.0) * radius
    cap = np.where(square >= 0.0, base + np.sqrt(np.maximum(square, 0.0)), -np.inf)
    at = np.ix_(nodes[0] % grid.shape[0], nodes[1] % grid.shape[1])
    heights[at] = np.maximum(heights[at], cap)


def _surface(grid: Grid, heights: RealArray, source: str, text: str, parts: tuple[Spectrum, ...]) -> Surface:
    dx, dy = grid.spacing
    keys = tuple(dict.fromkeys((*citation_keys(*parts), *_KEYS)))
    return Surface(heights, dx, dy, periodic=True, origin=Origin(source, history=(text,), citation_keys=keys))
