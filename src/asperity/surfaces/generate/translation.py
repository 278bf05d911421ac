"""Surfaces whose heights are a function of a Gaussian field: any marginal distribution, at any resolution."""

from __future__ import annotations

import math

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.citations import citation_keys
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.spectral import RealTransform, thread_count
from ..surface import Origin, Surface
from .embedding import CLIP_LIMIT, Spectrum, lattice_eigenvalues, negative_part
from .gaussian import filtered_noise
from .height_law import HeightLaw, height_law
from .modes import mean_square

_TERMS, _REST = 400, 1e-13  # most Hermite coefficients of a translation, and the variance they may miss
_STEP, _REACH = 0.005, 12.0  # trapezoidal rule for them
_TABLE = 20001  # correlations between -1 and 1 at which the map is tabulated; linear interpolation is good to 1e-8


def translated(
    grid: Grid,
    spectrum: Spectrum,
    *,
    seed: int,
    skewness: float,
    kurtosis: float,
    system: str = "johnson",
    predistorted: bool = True,
) -> Surface:
    """Periodic surface z = T(G) of given skewness and kurtosis, G a Gaussian field and T of a system of distributions.

    Every height has the distribution of T exactly, at any resolution; the moments of a realisation scatter about it. T
    changes the correlation of two heights by a few per cent; ``predistorted`` gives G the autocovariance from which T
    makes that of ``spectrum``. The mean is not removed.

    Parameters
    ----------
    grid
        Nodes of the surface.
    spectrum
        Any spectrum or autocorrelation; its rms height is that of the surface.
    seed
        Whole number >= 0 (PCG64, in the order of the array).
    skewness, kurtosis
        Of the heights, kurtosis >= 1 + skewness².
    system
        ``johnson`` or ``pearson``: of the distribution of the heights.
    predistorted
        Whether ``spectrum`` is that of the heights; otherwise of G.

    Raises
    ------
    InputError
        If no distribution has these moments, or no Gaussian field has the autocovariance that the translation would need.
    """
    seed = require.integer(seed, 0, "seed of a random surface")
    law = height_law(skewness, kurtosis, system)
    eigenvalues = lattice_eigenvalues(spectrum, grid)
    square = mean_square(grid, eigenvalues * grid.pixel_area)
    eigenvalues = eigenvalues / square
    clipped = 0.0
    if predistorted:
        eigenvalues, clipped = _predistorted(eigenvalues, law, grid)
    heights = math.sqrt(square) * law.of_normal(filtered_noise(grid, eigenvalues, seed))
    how = (
        f"autocorrelation predistorted, negative part {clipped:.1e} clipped"
        if predistorted
        else "of the Gaussian field"
    )
    what = f"skewness {skewness:.4g}, kurtosis {kurtosis:.4g} ({law.label}), {how}"
    text = f"generated: translation, {spectrum.describe(grid)}, {what}, PCG64 seed {seed}"
    keys = tuple(dict.fromkeys((*citation_keys(spectrum), *law.citation_keys)))
    origin = Origin("translation", history=(text,), citation_keys=keys)
    return Surface(heights, *grid.spacing, periodic=True, origin=origin)


def translated_correlation(law: HeightLaw, correlation: RealArray) -> RealArray:
    """Correlation of T(G1) and T(G2) for that of the normal numbers G1, G2: ρ_z = Σ c_k² ρ_G^k, Hermite coefficients c_k."""
    squares = _hermite_squares(law)
    values: RealArray = np.polynomial.polynomial.polyval(correlation, np.concatenate([[0.0], squares]))
    return values


def _predistorted(eigenvalues: RealArray, law: HeightLaw, grid: Grid) -> tuple[RealArray, float]:
    """Eigenvalues of the Gaussian field, and the negative part of them that was clipped."""
    transform = RealTransform(grid.shape, thread_count())
    wanted = transform.backward(eigenvalues.astype(complex))
    table = np.linspace(-1.0, 1.0, _TABLE)
    reachable = translated_correlation(law, table)
    lowest = float(wanted.min())
    if lowest < reachable[0]:
        raise InputError(
            f"autocorrelation of these heights must not fall below {reachable[0]:.4g}, the least that a translation of this "
            f"skewness and kurtosis reaches, but falls to {lowest:.4g}. Use rank_ordered()."
        )
    needed = np.interp(wanted, reachable, table)
    needed[0, 0] = 1.0
    values = transform.forward(needed).real
    negative = negative_part(grid, values)
    if negative > CLIP_LIMIT:
        raise InputError(
            "no Gaussian field has the autocorrelation that a translation to this skewness and kurtosis needs: its spectrum "
            f"would be negative by {negative:.2g} of the whole. Use rank_ordered(), or predistorted=False."
        )
    return np.maximum(values, 0.0), negative


def _hermite_squares(law: HeightLaw) -> RealArray:
    """c_k², k = 1, 2, …, of T = Σ c_k He_k/sqrt(k!), normalised to the sum 1 (the variance)."""
    normal = np.arange(-_REACH, _REACH + 0.5 * _STEP, _STEP)
    weighted = law.of_normal(normal) * np.exp(-0.5 * normal**2) * (_STEP / math.sqrt(2.0 * math.pi))
    before, now = np.ones_like(normal), normal
    squares: list[float] = []
    for k in range(1, _TERMS + 1):
        squares.append(float(weighted @ now) ** 2)
        if sum(squares) > 1.0 - _REST:
            break
        before, now = now, (normal * now - math.sqrt(k) * before) / math.sqrt(k + 1.0)
    return np.array(squares) / sum(squares)
