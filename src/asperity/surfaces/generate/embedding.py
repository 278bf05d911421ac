"""From an autocovariance function to the spectrum of a periodic lattice: circulant embedding.

The autocovariance is sampled at the shortest periodic lags and transformed, so that every lag of the lattice up to half
the domain is met exactly. Cutting the continuous spectrum at the Nyquist wavenumber instead would lose variance, and
even more slope. Source: Dietrich & Newsam (1997).
"""

from __future__ import annotations

from typing import Protocol, runtime_checkable

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.spectral import RealTransform, thread_count
from .modes import mode_sum

CLIP_LIMIT = 1e-4
"""Largest negative part of a circulant spectrum, relative to its positive part, that may be clipped."""

_AMPLE = 1.5  # embedding lengths from which on there is no negative part: computed for both autocorrelations
_NOISE = 1e-15  # negative part that rounding of the transform leaves


class Spectrum(Protocol):
    """Isotropic or anisotropic spectrum from which a periodic random surface can be generated.

    Optional attributes: ``correlation_range`` (m), the distance beyond which heights are uncorrelated, for surfaces
    that are not periodic; ``citation_keys``.
    """

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0."""

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""


@runtime_checkable
class Autocovariance(Protocol):
    """Autocovariance function of a surface."""

    @property
    def embedding_lengths(self) -> tuple[float, float]:
        """Sides in m of a periodic domain that is large enough for this autocovariance."""

    def autocovariance(self, x: RealArray, y: RealArray) -> RealArray:
        """R(x, y) in m² at the lags ``x`` and ``y`` in m, broadcast against each other."""


def lattice_eigenvalues(spectrum: Spectrum, grid: Grid) -> RealArray:
    """Mean square of the waves of a random field in m², C/(dx dy), shape (nx, ny // 2 + 1).

    The zero mode is that of the autocovariance where ``spectrum`` is given by one, so that the mean of a realisation
    fluctuates as in any window of an infinite surface; it is zero for a spectrum given by C.
    """
    if isinstance(spectrum, Autocovariance):
        return clipped_eigenvalues(spectrum, grid)
    return spectrum.lattice_psd(grid) / grid.pixel_area


def eigenvalues(model: Autocovariance, grid: Grid) -> RealArray:
    """FFT of the wrapped autocovariance in m², shape (nx, ny // 2 + 1); C = dx dy times it; may be negative."""
    lag_x, lag_y = wrapped_lags(grid)
    return RealTransform(grid.shape, thread_count()).forward(model.autocovariance(lag_x, lag_y)).real


def clipped_eigenvalues(model: Autocovariance, grid: Grid) -> RealArray:
    """Eigenvalues in m² without their negative part.

    Raises
    ------
    InputError
        If the grid is so small that the negative part exceeds 1e-4 of the positive one.
    """
    values = eigenvalues(model, grid)
    if negative_part(grid, values) > CLIP_LIMIT:
        length_x, length_y = model.embedding_lengths
        raise InputError(
            f"grid size must be about {length_x:.3g} x {length_y:.3g} m or more for a periodic surface of this "
            f"autocorrelation, but is {grid.size[0]:.3g} x {grid.size[1]:.3g} m. Enlarge the grid and crop the result."
        )
    return np.maximum(values, 0.0)


def embedded_psd(model: Autocovariance, grid: Grid) -> RealArray:
    """C in m⁴ on the modes of ``grid`` that gives its lags the autocovariance, zero at q = 0."""
    psd: RealArray = grid.pixel_area * clipped_eigenvalues(model, grid)
    psd[0, 0] = 0.0
    return psd


def clipping_text(model: Autocovariance, grid: Grid) -> str:
    """Words on the clipped part of the spectrum, empty if it is no more than rounding."""
    if all(size >= _AMPLE * length for size, length in zip(grid.size, model.embedding_lengths, strict=True)):
        return ""
    negative = negative_part(grid, eigenvalues(model, grid))
    return f", negative part {negative:.1e} of the spectrum clipped" if negative > _NOISE else ""


def negative_part(grid: Grid, values: RealArray) -> float:
    """Sum of the negative eigenvalues over that of the positive ones."""
    return mode_sum(grid, np.maximum(-values, 0.0)) / mode_sum(grid, np.maximum(values, 0.0))


def wrapped_lags(grid: Grid) -> tuple[RealArray, RealArray]:
    """Shortest periodic lags x (nx, 1) and y (1, ny) in m, not negative."""
    (nx, ny), (dx, dy) = grid.shape, grid.spacing
    x, y = np.arange(nx), np.arange(ny)
    return np.minimum(x, nx - x)[:, None] * dx, np.minimum(y, ny - y)[None, :] * dy
