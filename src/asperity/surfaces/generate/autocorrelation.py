"""Random surfaces given by their autocorrelation function."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from ...core.arrays import RealArray
from ...core.grid import Grid
from ...core.parameters import Declared
from ...core.units import show
from ...core.values import Fraction, Length
from .gaussian import clipping_text, embedded_psd

_EXPONENTIAL_DOMAIN = 12.0  # decay lengths a period must hold; at 8 the negative part is 7e-6, at 4 it is 4e-3
_GAUSSIAN_DOMAIN = 8.0  # the same; negative part 1e-7
_RANGE = math.log(1e3)  # three 10 % lengths of the exponential: heights whose correlation is 1e-3 count as independent


@dataclass(frozen=True)
class ExponentialAutocorrelation(Declared):
    """Autocovariance σ² exp[-ln(1/drop) sqrt((x/βx)² + (y/βy)²)], met exactly at every lag of a periodic grid.

    Synthesis is by circulant embedding. ``gaussian`` removes the mean of every realisation, so the expected mean square
    is σ² less the variance of the mean, as for any finite window. Source: Peng & Bhushan (2001) for the 10 % length;
    Dietrich & Newsam (1997) for the embedding.
    """

    rms_height: Annotated[Length, "rms height"]
    correlation_length: Annotated[Length, "distance at which the autocorrelation has dropped (along x)"]
    drop: Annotated[Fraction, "what the autocorrelation has dropped to at the correlation length"] = 0.1
    correlation_length_y: Annotated[Length | None, "the same along y, if it differs"] = None
    citation_keys: ClassVar[tuple[str, ...]] = ("Dietrich1997", "PengBhushan2001")

    @property
    def decay_lengths(self) -> tuple[float, float]:
        """Lengths (m) along x and y at which the autocorrelation is 1/e."""
        decay = math.log(1.0 / self.drop)
        return self.correlation_length / decay, _along_y(self.correlation_length, self.correlation_length_y) / decay

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are uncorrelated (to 1e-3)."""
        return _RANGE * max(self.decay_lengths)

    @property
    def embedding_lengths(self) -> tuple[float, float]:
        """Sides in m of a periodic domain that is large enough: 12 decay lengths."""
        return _EXPONENTIAL_DOMAIN * self.decay_lengths[0], _EXPONENTIAL_DOMAIN * self.decay_lengths[1]

    def autocovariance(self, x: RealArray, y: RealArray) -> RealArray:
        """R(x, y) in m² at the lags ``x`` and ``y`` in m, broadcast against each other."""
        beta_x, beta_y = self.decay_lengths
        return np.asarray(self.rms_height**2 * np.exp(-np.hypot(x / beta_x, y / beta_y)))

    def psd(self, qx: RealArray | float, qy: RealArray | float = 0.0) -> RealArray:
        """C in m⁴ of the continuous surface, 2π σ² βx βy [1 + (qx βx)² + (qy βy)²]^(-3/2) with 1/e lengths β."""
        beta_x, beta_y = self.decay_lengths
        squared = (np.asarray(qx, dtype=float) * beta_x) ** 2 + (np.asarray(qy, dtype=float) * beta_y) ** 2
        return 2.0 * np.pi * self.rms_height**2 * beta_x * beta_y * (1.0 + squared) ** -1.5

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0.

        Raises InputError if the grid is so small that the wrapped autocovariance has a negative part above 1e-4.
        """
        return embedded_psd(self, grid)

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        beta_x, beta_y = self.decay_lengths
        lengths = f"decay lengths {show(beta_x, 'm')} x {show(beta_y, 'm')}"
        return f"exponential autocorrelation, rms height {show(self.rms_height, 'm')}, {lengths}" + clipping_text(
            self, grid
        )


@dataclass(frozen=True)
class GaussianAutocorrelation(Declared):
    """Autocovariance σ² exp[-ln(1/drop) ((x/βx)² + (y/βy)²)], met exactly at every lag of a periodic grid.

    The surface is smooth: m2 = 2σ²/b², m4 = 12σ²/b⁴, Nayak's parameter 3, with b the 1/e length. Parameters, mean and
    errors as for ``ExponentialAutocorrelation``.
    """

    rms_height: Annotated[Length, "rms height"]
    correlation_length: Annotated[Length, "distance at which the autocorrelation has dropped (along x)"]
    drop: Annotated[Fraction, "what the autocorrelation has dropped to at the correlation length"] = 0.1
    correlation_length_y: Annotated[Length | None, "the same along y, if it differs"] = None
    citation_keys: ClassVar[tuple[str, ...]] = ("Dietrich1997",)

    @property
    def decay_lengths(self) -> tuple[float, float]:
        """Lengths (m) along x and y at which the autocorrelation is 1/e."""
        decay = math.sqrt(math.log(1.0 / self.drop))
        return self.correlation_length / decay, _along_y(self.correlation_length, self.correlation_length_y) / decay

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are uncorrelated (to 1e-3)."""
        return math.sqrt(_RANGE) * max(self.decay_lengths)

    @property
    def embedding_lengths(self) -> tuple[float, float]:
        """Sides in m of a periodic domain that is large enough: 8 decay lengths."""
        return _GAUSSIAN_DOMAIN * self.decay_lengths[0], _GAUSSIAN_DOMAIN * self.decay_lengths[1]

    def autocovariance(self, x: RealArray, y: RealArray) -> RealArray:
        """R(x, y) in m² at the lags ``x`` and ``y`` in m, broadcast against each other."""
        b_x, b_y = self.decay_lengths
        return np.asarray(self.rms_height**2 * np.exp(-np.square(x / b_x) - np.square(y / b_y)))

    def psd(self, qx: RealArray | float, qy: RealArray | float = 0.0) -> RealArray:
        """C in m⁴ of the continuous surface, π σ² bx by exp{-[(qx bx)² + (qy by)²]/4} with 1/e lengths b."""
        b_x, b_y = self.decay_lengths
        squared = (np.asarray(qx, dtype=float) * b_x) ** 2 + (np.asarray(qy, dtype=float) * b_y) ** 2
        return np.pi * self.rms_height**2 * b_x * b_y * np.exp(-0.25 * squared)

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0.

        Raises InputError if the grid is so small that the wrapped autocovariance has a negative part above 1e-4.
        """
        return embedded_psd(self, grid)

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        b_x, b_y = self.decay_lengths
        lengths = f"decay lengths {show(b_x, 'm')} x {show(b_y, 'm')}"
        return f"Gaussian autocorrelation, rms height {show(self.rms_height, 'm')}, {lengths}" + clipping_text(
            self, grid
        )


def _along_y(along_x: float, along_y: float | None) -> float:
    return along_x if along_y is None else along_y
