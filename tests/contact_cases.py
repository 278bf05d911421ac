"""Small helpers to pose contact problems in tests."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import asperity as asp
from asperity.solvers import ActiveSet

TIGHT = ActiveSet(tolerance=1e-11)


def elastic(contact_modulus: float, poisson_ratio: float = 0.3) -> asp.Elastic:
    """Body that gives this contact modulus against a rigid one."""
    return asp.Elastic(contact_modulus * (1.0 - poisson_ratio**2), poisson_ratio)


def square_grid(n: int, size: float) -> asp.Grid:
    """n x n pixels on size x size."""
    return asp.Grid((n, n), (size / n, size / n))


def rough(
    shape: tuple[int, int], seed: int = 0, *, spacing: tuple[float, float] = (1.0, 1.0), power: float = 1.5
) -> asp.Surface:
    """Periodic random surface of unit rms height with amplitudes falling like q^-power."""
    grid = asp.Grid(shape, spacing)
    rng = np.random.default_rng(seed)
    spectrum = np.fft.rfft2(rng.standard_normal(shape))
    q = grid.wavenumber()
    q[0, 0] = np.inf
    heights = np.fft.irfft2(spectrum * q**-power, s=shape)
    return asp.Surface(heights / heights.std(), *spacing, periodic=True)


def slid(
    problem: asp.ContactProblem, control: object, friction: float, direction: float = 0.0, **options: object
) -> asp.ContactResult:
    """Result of ``problem`` under gross sliding with this coefficient and direction."""
    sliding = replace(problem, friction=asp.Coulomb(friction, direction))
    return asp.solve(sliding, control, **options)  # type: ignore[call-overload, no-any-return]


def wetted(
    problem: asp.ContactProblem,
    control: object,
    film: asp.LiquidFilm,
    friction: asp.Coulomb | None = None,
    **options: object,
) -> asp.ContactResult:
    """Result of ``problem`` with a ``film``."""
    return asp.solve(replace(problem, film=film, friction=friction), control, **options)  # type: ignore[call-overload, no-any-return]
