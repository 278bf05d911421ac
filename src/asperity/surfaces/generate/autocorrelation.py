"""Random surfaces given by their autocorrelation function."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.parameters import Declared
from ...core.units import show
from ...core.values import Fraction, Length
from .gaussian import clipped_eigenvalues, eigenvalues, negative_part

LEAST_DROP = 1e-3
"""Correlation at and below which heights count as independent: three 10 % lengths of the
exponential."""

_INDEPENDENT = math.log(1.0 / LEAST_DROP)
_AMPLE = 1.5  # embedding lengths from which on there is no negative part: computed for both autocorrelations
_NOISE = 1e-15  # negative part that rounding of the transform leaves


@dataclass(frozen=True)
class _Autocorrelation(Declared):
    """Base of autocorrelations that fall as exp(-c) over c decay lengths in every direction,
    ``smooth`` ones over sqrt(c).

    ``form`` is their name in words, ``domain`` the number of decay lengths that a period must hold.
    """

    rms_height: Annotated[Length, "rms height"]
    correlation_length: Annotated[Length, "distance at which the autocorrelation has dropped (along x)"]
    drop: Annotated[Fraction, "what the autocorrelation has dropped to at the correlation length"] = 0.1
    correlation_length_y: Annotated[Length | None, "the same along y, if it differs"] = None
    form: ClassVar[str]
    domain: ClassVar[float]
    smooth: ClassVar[bool]

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.drop < LEAST_DROP:
            raise InputError(
                f"drop of an autocorrelation must be from {LEAST_DROP:g} to below 1, but is {self.drop:g}: it "
                "is what is left at the correlation length, such as 0.1 or 0.37. Give a second length as "
                "correlation_length_y."
            )

    @property
    def decay_lengths(self) -> tuple[float, float]:
        """Lengths (m) along x and y at which the autocorrelation is 1/e."""
        fall = math.log(1.0 / self.drop)
        decays = math.sqrt(fall) if self.smooth else fall
        along_y = self.correlation_length if self.correlation_length_y is None else self.correlation_length_y
        return self.correlation_length / decays, along_y / decays

    @property
    def correlation_range(self) -> float:
        """Distance in m beyond which heights are uncorrelated (to 1e-3)."""
        decays = math.sqrt(_INDEPENDENT) if self.smooth else _INDEPENDENT
        return decays * max(self.decay_lengths)

    @property
    def embedding_lengths(self) -> tuple[float, float]:
        """Sides in m of a periodic domain that is large enough: 12 decay lengths of an exponential,
        8 of a Gaussian."""
        return self.domain * self.decay_lengths[0], self.domain * self.decay_lengths[1]

    def autocovariance(self, x: RealArray, y: RealArray) -> RealArray:
        """R(x, y) in m² at the lags ``x`` and ``y`` in m, broadcast against each other."""
        raise NotImplementedError

    def lattice_psd(self, grid: Grid) -> RealArray:
        """C on the modes of ``grid`` in m⁴, shape (nx, ny // 2 + 1), zero at q = 0.

        Raises InputError if the grid is so small that the wrapped autocovariance has a negative
        part above 1e-4.
        """
        psd: RealArray = grid.pixel_area * clipped_eigenvalues(self, grid)
        psd[0, 0] = 0.0
        return psd

    def describe(self, grid: Grid) -> str:
        """Words and numbers for the history of a surface generated on ``grid``."""
        lengths = "decay lengths {} x {}".format(*(show(length, "m") for length in self.decay_lengths))
        words = f"{self.form} autocorrelation, rms height {show(self.rms_height, 'm')}, {lengths}"
        if all(size >= _AMPLE * length for size, length in zip(grid.size, self.embedding_lengths, strict=True)):
            return words
        negative = negative_part(grid, eigenvalues(self, grid))
        return f"{words}, negative part {negative:.1e} of the spectrum clipped" if negative > _NOISE else words


@dataclass(frozen=True)
class ExponentialAutocorrelation(_Autocorrelation):
    """Autocovariance σ² exp[-ln(1/drop) sqrt((x/βx)² + (y/βy)²)], met exactly at every lag of a
    periodic grid.

    Synthesis is by circulant embedding. ``gaussian`` removes the mean of every realisation, so the
    expected mean square is σ² less the variance of the mean, as for any finite window. Source: Peng
    & Bhushan (2001) for the 10 % length; Dietrich & Newsam (1997) for the embedding.
    """

    form: ClassVar[str] = "exponential"
    smooth: ClassVar[bool] = False
    domain: ClassVar[float] = 12.0  # at 8 the negative part is 7e-6, at 4 it is 4e-3
    citation_keys: ClassVar[tuple[str, ...]] = ("Dietrich1997", "PengBhushan2001")

    def autocovariance(self, x: RealArray, y: RealArray) -> RealArray:
        """R(x, y) in m² at the lags ``x`` and ``y`` in m, broadcast against each other."""
        beta_x, beta_y = self.decay_lengths
        return np.asarray(self.rms_height**2 * np.exp(-np.hypot(x / beta_x, y / beta_y)))

    def psd(self, qx: RealArray | float, qy: RealArray | float = 0.0) -> RealArray:
        """C in m⁴ of the continuous surface, 2π σ² βx βy [1 + (qx βx)² + (qy βy)²]^(-3/2) with 1/e
        lengths β."""
        beta_x, beta_y = self.decay_lengths
        squared = (np.asarray(qx, dtype=float) * beta_x) ** 2 + (np.asarray(qy, dtype=float) * beta_y) ** 2
        return 2.0 * np.pi * self.rms_height**2 * beta_x * beta_y * (1.0 + squared) ** -1.5


@dataclass(frozen=True)
class GaussianAutocorrelation(_Autocorrelation):
    """Autocovariance σ² exp[-ln(1/drop) ((x/βx)² + (y/βy)²)], met exactly at every lag of a
    periodic grid.

    The surface is smooth: m2 = 2σ²/b², m4 = 12σ²/b⁴, Nayak's parameter 3, with b the 1/e length.
    Parameters, mean and errors as for ``ExponentialAutocorrelation``.
    """

    form: ClassVar[str] = "Gaussian"
    smooth: ClassVar[bool] = True
    domain: ClassVar[float] = 8.0  # negative part 1e-7
    citation_keys: ClassVar[tuple[str, ...]] = ("Dietrich1997",)

    def autocovariance(self, x: RealArray, y: RealArray) -> RealArray:
        """R(x, y) in m² at the lags ``x`` and ``y`` in m, broadcast against each other."""
        b_x, b_y = self.decay_lengths
        return np.asarray(self.rms_height**2 * np.exp(-np.square(x / b_x) - np.square(y / b_y)))

    def psd(self, qx: RealArray | float, qy: RealArray | float = 0.0) -> RealArray:
        """C in m⁴ of the continuous surface, π σ² bx by exp{-[(qx bx)² + (qy by)²]/4} with 1/e
        lengths b."""
        b_x, b_y = self.decay_lengths
        squared = (np.asarray(qx, dtype=float) * b_x) ** 2 + (np.asarray(qy, dtype=float) * b_y) ** 2
        return np.pi * self.rms_height**2 * b_x * b_y * np.exp(-0.25 * squared)
