"""Surfaces of two roughnesses: patches, plateaus with valleys, particles on a matrix.

Peng & Bhushan (2000) brought surfaces of bimodal roughness, such as coatings with particles, into
contact mechanics; the three constructions here, all from independent Gaussian fields, cover that
class but follow no formula of their paper.
"""

from __future__ import annotations

import math
from typing import Annotated, Literal

import numpy as np

from ...core.citations import citation_keys
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.parameters import checked
from ...core.scipy_parts import special
from ...core.units import show
from ...core.values import Density, Fraction, Length, NonNegativeLength, Number, SignedLength
from ..surface import Surface, generated
from .gaussian import Spectrum, SurfaceSeed, random_field, sub_seeds

_KEYS = ("PengBhushan2000",)
_MOST_PARTICLES = 10_000_000


@checked
def bimodal(
    grid: Grid,
    first: Annotated[Spectrum, "spectrum of the first texture"],
    second: Annotated[Spectrum, "spectrum of the second texture"],
    *,
    share: Annotated[Fraction, "share of the area of the first texture, on average over realisations"],
    separation: Annotated[
        SignedLength, "height of the mean plane of the first texture above that of the second, of either sign"
    ],
    patches: Annotated[Spectrum, "spectrum of M, which shapes the patches; its rms height does not matter"],
    seed: SurfaceSeed,
) -> Surface:
    """Periodic surface of two textures side by side: patches of the first on ``share`` of the area,
    the second elsewhere.

    h = X where M < Φ⁻¹(share), else Y, with independent Gaussian fields X, Y and M; there are steps
    at the boundaries. With p the share, d the distance of a mean from the common one: <h²> = Σ p
    (σ² + d²), <h³> = Σ p (d³ + 3 d σ²), <h⁴> = Σ p (d⁴ + 6 d² σ² + 3 σ⁴) about the mean. Raises
    InputError if the grid does not suit a spectrum.
    """
    seeds = sub_seeds(seed, 3)
    texture, other, mask = (random_field(grid, s, n) for s, n in zip((first, second, patches), seeds, strict=True))
    mask /= np.sqrt(np.mean(np.square(mask)))
    heights = np.where(mask < float(special.ndtri(share)), texture + separation, other)
    text = (
        f"two textures, {share:.4g} of the area {first.describe(grid)}, {show(separation, 'm')} above "
        f"{second.describe(grid)}, in patches of {patches.describe(grid)}, seed {seed}"
    )
    keys = (*citation_keys(first, second, patches), *_KEYS)
    return generated(grid, heights, "bimodal", text, citation_keys=keys)


@checked
def two_process(
    grid: Grid,
    plateau: Annotated[Spectrum, "spectrum of the plateau X"],
    valleys: Annotated[Spectrum, "spectrum of the valleys Y"],
    *,
    offset: Annotated[SignedLength, "mean of the valleys above that of the plateau, of either sign"],
    seed: SurfaceSeed,
    keep: Annotated[Literal["lower", "upper"], "which of the two surfaces is kept at each point"] = "lower",
) -> Surface:
    """Periodic surface of a second process over a first one: h = min(X, Y), as by honing or wear;
    max for deposits.

    X is the fine texture of the plateau with mean 0, Y the coarse one with mean ``offset``,
    independent Gaussian fields. The material ratio on probability paper is two straight lines; the
    heights are usually strongly skewed. Raises InputError if the grid does not suit a spectrum.
    """
    first, second = (random_field(grid, s, n) for s, n in zip((plateau, valleys), sub_seeds(seed, 2), strict=True))
    heights = (np.minimum if keep == "lower" else np.maximum)(first, second + offset)
    text = (
        f"two processes, the {keep} of {plateau.describe(grid)} and, {show(offset, 'm')} above, "
        f"{valleys.describe(grid)}, seed {seed}"
    )
    keys = (*citation_keys(plateau, valleys), *_KEYS)
    return generated(grid, heights, "two processes", text, citation_keys=keys)


@checked
def particles(
    grid: Grid,
    matrix: Annotated[Spectrum, "spectrum of the matrix"],
    *,
    density: Annotated[Density, "particles per area, on average: 0.5um**-2"],
    radius: Annotated[Length, "mean radius of the particles"],
    radius_deviation: Annotated[NonNegativeLength, "standard deviation of the radii"] = 0.0,
    exposure: Annotated[
        float,
        Number(above=0.0, most=2.0),
        "height of a particle's top above the matrix in radii: 2 lies on it, 1 is half sunk",
    ] = 2.0,
    seed: SurfaceSeed,
) -> Surface:
    """Periodic surface of spheres in or on a rough matrix: h = max(h_m, z - R + sqrt(R² - r²)).

    Places are independent and uniform, so spheres overlap by chance; their number is Poisson
    distributed. Radii are normal, those not positive drawn again. The top of each stands
    ``exposure`` radii above the matrix at its centre. Raises InputError if a value is out of range,
    there are more than ten million particles, or one is wider than the grid.
    """
    if density * grid.area > _MOST_PARTICLES:
        raise InputError(
            f"particles must be at most {_MOST_PARTICLES}, but are {density * grid.area:.3g}. Reduce density or area."
        )
    field_seed, place_seed = sub_seeds(seed, 2)
    heights = random_field(grid, matrix, field_seed)
    ground = heights.copy()
    draw = np.random.Generator(np.random.PCG64(place_seed))
    count = int(draw.poisson(density * grid.area))
    places = draw.random((count, 2)) * grid.size
    radii = radius + radius_deviation * draw.standard_normal(count)
    while (wrong := radii <= 0.0).any():
        radii[wrong] = radius + radius_deviation * draw.standard_normal(int(np.count_nonzero(wrong)))
    for place, size in zip(places, (float(number) for number in radii), strict=True):
        if 2.0 * size > min(grid.size):
            raise InputError(
                f"particles must fit into the grid of {grid.size[0]:.3g} x {grid.size[1]:.3g} m, but one has "
                f"the radius {size:.3g} m. Enlarge the grid or reduce the radius."
            )
        nodes = [
            np.arange(math.ceil((c - size) / d), math.floor((c + size) / d) + 1)
            for c, d in zip(place, grid.spacing, strict=True)
        ]
        square = size**2 - (
            (nodes[0][:, None] * grid.spacing[0] - place[0]) ** 2
            + (nodes[1][None, :] * grid.spacing[1] - place[1]) ** 2
        )
        nearest = tuple(round(c / d) % n for c, d, n in zip(place, grid.spacing, grid.shape, strict=True))
        base = float(ground[nearest]) + (exposure - 1.0) * size
        cap = np.where(square >= 0.0, base + np.sqrt(np.maximum(square, 0.0)), -np.inf)
        at = np.ix_(nodes[0] % grid.shape[0], nodes[1] % grid.shape[1])
        heights[at] = np.maximum(heights[at], cap)
    text = (
        f"{count} particles of radius {show(radius, 'm')} ± {show(radius_deviation, 'm')}, exposed by "
        f"{exposure:.4g} radii, on {matrix.describe(grid)}, seed {seed}"
    )
    keys = (*citation_keys(matrix), *_KEYS)
    return generated(grid, heights, "particles", text, citation_keys=keys)
