"""Random surfaces given by their autocorrelation function."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.spectral import RealTransform
from .spectra import mode_sum

_CLIP_LIMIT = 1e-4  # largest negative part of a circulant spectrum, relative to its trace, that may be clipped


@dataclass(frozen=True)
class ExponentialAutocorrelation:
    """Autocovariance σ² exp[-ln(1/drop) sqrt((x/βx)² + (y/βy)²)], met exactly at every lag of a periodic grid.

    Synthesis is by circulant embedding: the autocovariance at the shortest periodic lags is transformed. Cutting the
    continuous spectrum at the Nyquist wavenumber instead would lose variance, and even more slope. The mean of every
    realisation is removed, so the expected mean square is σ² less the variance of the mean, as for any finite window.
    Source: Peng & Bhushan (2001) for the 10 % length; Dietrich & Newsam (1997) for the embedding.

    Parameters
    ----------
    rms_height
        σ of the infinite surface in m.
    correlation_length
        Distance β in m at which the autocorrelation has dropped to ``drop`` (along x if ``correlation_length_y`` is given).
    drop
        0.1 by default (β*, the 10 % length); exp(-1) for the 1/e length.
    correlation_length_y
        The same along y in m; isotropic if omitted.

    Raises
    ------
    InputError
        If a value is out of range.
    """

    rms_height: float
    correlation_length: float
    drop: float = 0.1
    correlation_length_y: float | None = None
    citation_keys: ClassVar[tuple[str, ...]] = ("Dietrich1997", "PengBhushan2001")

    def __post_init__(self) -> None:
        require.positive(self.rms_height, "rms height (m)")
        require.positive(self.correlation_length, "correlation length (m)")
        require.between(self.drop, 0.0, 1.0, "drop that defines the correlation length")
        if self.correlation_length_y is not None:
            require.positive(self.correlation_length_y, "correlation length along y (m)")

    @property
    def decay_lengths(self) -> tuple[float, float]:
        """Lengths (m) along x and y at which the autocorrelation is 1/e."""
        along_y = self.correlation_length if self.correlation_length_y is None else self.correlation_length_y
        decay = math.log(1.0 / self.drop)
        return self.correlation_length / decay, along_y / decay

    def psd(self, qx: RealArray | float, qy: RealArray | float = 0.0) -> RealArray:
        """C in m⁴ of the continuous surface, 2π σ² βx βy [1 + (qx βx)² + (qy βy)²]^(-3/2) with 1/e lengths β."""
        beta_x, beta_y = self.decay_lengths
        squared = (np.asarray(qx, dtype=float) * beta_x) ** 2 + (np.asarray(qy, dtype=float) * beta_y) ** 2
        values: RealArray = 2.0 * np.pi * self.rms_height**2 * beta_x * beta_y * (1.0 + squared) ** -1.5
        return values

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0.

        Raises
        ------
        InputError
            If the grid is so small that the wrapped autocovariance has a negative part above 1e-4.
        """
        eigenvalues = self._eigenvalues(grid)
        negative = _negative_part(grid, eigenvalues)
        if negative > _CLIP_LIMIT:
            beta_x, beta_y = self.decay_lengths
            raise InputError(
                f"grid size must be about 12 decay lengths ({12.0 * beta_x:.3g} x {12.0 * beta_y:.3g} m) or more for a "
                f"periodic exponential autocorrelation, but is {grid.size[0]:.3g} x {grid.size[1]:.3g} m. "
                "Enlarge the grid and crop the result."
            )
        psd: RealArray = grid.pixel_area * np.maximum(eigenvalues, 0.0)
        psd[0, 0] = 0.0
        return psd

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        negative = _negative_part(grid, self._eigenvalues(grid))
        beta_x, beta_y = self.decay_lengths
        text = f"exponential autocorrelation, rms height {self.rms_height:.4g} m, decay lengths {beta_x:.4g} m x {beta_y:.4g} m"
        return text + (f", negative part {negative:.1e} of the spectrum clipped" if negative > 1e-15 else "")

    def _eigenvalues(self, grid: Grid) -> RealArray:
        lag_x, lag_y = (
            np.minimum(np.arange(n), n - np.arange(n)) * d / beta
            for n, d, beta in zip(grid.shape, grid.spacing, self.decay_lengths, strict=True)
        )
        autocovariance = self.rms_height**2 * np.exp(-np.hypot(lag_x[:, None], lag_y[None, :]))
        return RealTransform(grid.shape).forward(autocovariance).real


def _negative_part(grid: Grid, eigenvalues: RealArray) -> float:
    return mode_sum(grid, np.maximum(-eigenvalues, 0.0)) / mode_sum(grid, np.maximum(eigenvalues, 0.0))
