"""One map of two scales: the detail of a small scan on the form of a large one."""

from __future__ import annotations

import math
from typing import Annotated, Literal, TypeAlias

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.scipy_parts import ndimage
from ..core.spectral import RealTransform, thread_count
from ..core.units import show
from .generate.gaussian import SurfaceSeed, filtered_noise, sub_seeds
from .generate.spectra import spectrum_of
from .prepare.extent import resampled
from .prepare.level import require_complete
from .surface import Surface

Registration: TypeAlias = Annotated[
    Literal["same place", "other place"], "whether the small map shows a part of the large one or another place"
]

_FEWEST = 3.0  # modes of the small map in the crossover: longer ones are mixed with its tilt
_RELIABLE = 8.0  # pixels of the large map in the crossover, half its reliable limit of four


def with_fine_detail(
    large: Surface, small: Surface, *, crossover: float | None = None, pixel: float | None = None, seed: SurfaceSeed
) -> Surface:
    """``large`` with the short waves of ``small``, which was measured at other places.

    The large map is resampled to the ``pixel`` and loses its short waves to the Gaussian transfer
    G = 2^(-(λ_c/λ)²); random waves with the spectrum of the small map are added with the transfer
    sqrt(1 - G²), so that powers of independent fields add to one. The small map is not repeated:
    that would put lines into the spectrum.

    Parameters
    ----------
    large, small
        Complete maps in m, the small one levelled.
    crossover
        Wavelength λ_c in m, at least eight pixels of the large map and at most a third of the small
        one; by default the geometric mean of the two.
    pixel
        Pixel of the result in m; by default that of the small map.
    seed
        Seed of the random waves.

    Raises InputError if points are missing, the maps do not overlap in scale, or the crossover lies
    outside their overlap.
    """
    for surface in (large, small):
        require_complete(surface, "composed")
    wave = crossover_between(large, small, crossover)
    step = max(small.grid.spacing) if pixel is None else require.positive(pixel, "pixel of a map of two scales (m)")
    shape = tuple(max(2, round(side / step)) for side in large.size)
    base = resampled(large, (shape[0], shape[1]))
    fine = spectrum_of(small)
    grid = base.grid
    transform = RealTransform(grid.shape, thread_count())
    stream = sub_seeds(seed, 1)[0]  # other waves than those of a large map generated with this seed
    detail = transform.forward(filtered_noise(grid, fine.lattice_psd(grid) / grid.pixel_area, stream))
    passed = gaussian_transfer(grid, wave)
    heights = _smoothed(base, wave)
    heights = heights + transform.backward(detail * np.sqrt(1.0 - np.square(passed)))
    text = (
        f"waves below {show(wave, 'm')} replaced by random ones with the spectrum of "
        f"{small.origin.source or 'a small map'}, seed {seed}"
    )
    return base.with_heights(heights, text)


def with_registered_detail(large: Surface, small: Surface, *, at: tuple[float, float], crossover: float) -> Surface:
    """The part of ``large`` that ``small`` shows, with the long waves of the one and the short
    waves of the other: h = G h_large + (1 - G) h_small, G = 2^(-(λ_c/λ)²).

    ``at`` place (x, y) in m of the first point of the small map on the large one; ``crossover`` λ_c
    in m. Only the short waves of the small map enter, so that its tilt and offset do not matter.
    Raises InputError if points are missing, the small map lies outside the large one, or the
    crossover outside their overlap.
    """
    for surface in (large, small):
        require_complete(surface, "composed")
    wave = crossover_between(large, small, crossover)
    x, y = (start + step * np.arange(n) for start, step, n in zip(at, small.grid.spacing, small.shape, strict=True))
    for place, step, n, axis in ((x, large.dx, large.shape[0], "x"), (y, large.dy, large.shape[1], "y")):
        if place[0] < 0.0 or place[-1] > step * (n - 1):
            raise InputError(
                f"small map must lie on the large one, but reaches from {place[0]:g} to {place[-1]:g} m along {axis} "
                f"where that ends at {step * (n - 1):g} m. Correct at."
            )
    points = np.meshgrid(x / large.dx, y / large.dy, indexing="ij")
    smooth = _smoothed(large, wave)
    long: RealArray = ndimage.map_coordinates(smooth, points, order=3, mode="nearest")
    heights = long + small.heights - _smoothed(small, wave)
    return small.with_heights(
        heights, f"waves above {show(wave, 'm')} taken from {large.origin.source or 'a large map'}"
    )


def crossover_between(large: Surface, small: Surface, crossover: float | None = None) -> float:
    """Wavelength in m at which two maps change over: as asked, or the geometric mean of their
    overlap.

    Raises InputError if the maps do not overlap in scale or it lies outside the overlap.
    """
    least, most = _RELIABLE * max(large.grid.spacing), min(small.size) / _FEWEST
    if least > most:
        raise InputError(
            f"maps of two scales must overlap, but eight pixels of the large one are {least:g} m and a third of the "
            f"small one is {most:g} m. Take a scan of a size between them."
        )
    if crossover is None:
        return math.sqrt(least * most)
    wave = require.positive(crossover, "crossover of two maps (m)")
    if not least * (1.0 - 1e-9) <= wave <= most * (1.0 + 1e-9):
        raise InputError(
            f"crossover of two maps (m) must be between eight pixels of the large map, {least:g}, and a third of the "
            f"small one, {most:g}, but is {wave:g}."
        )
    return wave


def gaussian_transfer(grid: Grid, wavelength: float) -> RealArray:
    """G = 2^(-(λ_c/λ)²) on the modes of ``grid``, (nx, ny // 2 + 1), with λ_c the ``wavelength`` in
    m."""
    return np.asarray(np.exp2(-np.square(grid.wavenumber() * wavelength / (2.0 * math.pi))))


def _smoothed(surface: Surface, wavelength: float) -> RealArray:
    """Heights with the Gaussian transfer, by Fourier transform: periodic maps as they are, others
    mirrored at their borders after their mean plane has been taken off."""
    heights = surface.heights.astype(np.float64)
    if surface.periodic:
        transform = RealTransform(surface.shape, thread_count())
        return np.asarray(transform.backward(transform.forward(heights) * gaussian_transfer(surface.grid, wavelength)))
    x, y = np.meshgrid(*(np.arange(n) - 0.5 * (n - 1) for n in surface.shape), indexing="ij")
    plane = x * (heights * x).sum() / (x * x).sum() + y * (heights * y).sum() / (y * y).sum() + heights.mean()
    rough = heights - plane
    twice = np.concatenate([rough, rough[::-1]], axis=0)
    twice = np.concatenate([twice, twice[:, ::-1]], axis=1)
    grid = Grid((twice.shape[0], twice.shape[1]), surface.grid.spacing)
    transform = RealTransform(grid.shape, thread_count())
    smooth = transform.backward(transform.forward(twice) * gaussian_transfer(grid, wavelength))
    return np.asarray(plane + smooth[: surface.shape[0], : surface.shape[1]])
