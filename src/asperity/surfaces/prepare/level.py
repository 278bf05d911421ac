"""Removal of mean, tilt, curvature or any polynomial by least squares."""

from __future__ import annotations

import numpy as np

from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from ..surface import Surface
from .steps import recorded

_DEGREES = {"mean": 0, "plane": 1, "quadratic": 2}
HIGHEST_DEGREE = 20
"""Of a polynomial form: 231 coefficients."""

_ROBUST_WIDTH = 3.0 * 1.482602218505602  # three standard deviations of a normal distribution in units of its MAD
_ROBUST_PASSES = 50
_BLOCK = 1 << 16  # points in one block of the orthogonal factorisation, to bound its memory


def levelled(surface: Surface, form: str | int = "plane", *, robust: bool = False) -> Surface:
    """Surface less its least-squares ``form`` over the valid points.

    The form is a polynomial Σ c_ab x^a y^b of total degree a + b <= 0 (``mean``), 1 (``plane``), 2 (``quadratic``) or of any
    whole number up to 20, found by QR factorisation in products of Legendre polynomials on [-1, 1]². Levelling is a
    high-pass filter: it lowers the rms height of a surface with waves as long as the map, the more the higher the degree.
    A periodic surface stays periodic only without its mean: a plane less, it no longer meets itself at its borders.

    Parameters
    ----------
    surface
        Surface; missing points take no part.
    form
        ``mean``, ``plane``, ``quadratic`` or the total degree.
    robust
        Repeat the fit without the points more than three standard deviations (3 x 1.4826 MAD) from it, until they no
        longer change: for surfaces whose peaks or pits would tilt the plane.

    Raises
    ------
    InputError
        If the form is unknown or the valid points do not determine it (all on one line, for example).
    """
    degree, name = _degree(form)
    used = ~surface.mask
    before: RealArray = surface.heights.astype(np.float64, copy=False)
    fit = _fitted(surface, used, degree, name)
    for _ in range(_ROBUST_PASSES if robust else 0):
        distance = np.abs(before - fit)
        width = _ROBUST_WIDTH * float(np.median(distance[~surface.mask]))
        kept = ~surface.mask & (distance <= width) if width > 0.0 else used
        if np.array_equal(kept, used):
            break
        used = kept
        fit = _fitted(surface, used, degree, name)
    how = f", robustly without {int(np.count_nonzero(~used & ~surface.mask))} points" if robust else ""
    return recorded(surface, before - fit, f"levelled: {name} removed{how}", periodic=surface.periodic and degree == 0)


def _degree(form: str | int) -> tuple[int, str]:
    """Total degree of the form and its name."""
    if isinstance(form, str):
        return _DEGREES[require.one_of(form, _DEGREES, "form to be removed")], form
    degree = require.integer(form, 0, "degree of the form to be removed")
    if degree > HIGHEST_DEGREE:
        raise InputError(
            f"degree of the form to be removed must be at most {HIGHEST_DEGREE}, but is {degree}; filter instead."
        )
    return degree, next((name for name, known in _DEGREES.items() if known == degree), f"polynomial of degree {degree}")


def _fitted(surface: Surface, used: BoolArray, degree: int, form: str) -> RealArray:
    """Polynomial at all nodes, shape (nx, ny), m, by least squares over those ``used``."""
    along_x, along_y = (_legendre(n, degree) for n in surface.shape)
    powers = [(a, b) for a in range(degree + 1) for b in range(degree + 1 - a)]
    offset = float(np.nanmean(surface.heights))
    triangle: RealArray = np.zeros((0, len(powers) + 1))
    rows = max(1, _BLOCK // surface.shape[1])
    for start in range(0, surface.shape[0], rows):
        part = slice(start, start + rows)
        valid = used[part]
        columns = [(along_x[part, None, a] * along_y[None, :, b])[valid] for a, b in powers]
        block = np.column_stack([*columns, surface.heights[part][valid].astype(np.float64) - offset])
        triangle = np.linalg.qr(np.vstack([triangle, block])).R
    coefficients = np.zeros((degree + 1, degree + 1))
    for (a, b), value in zip(powers, _solved(triangle, len(powers), form), strict=True):
        coefficients[a, b] = value
    fit: RealArray = along_x @ coefficients @ along_y.T + offset
    return fit


def _solved(triangle: RealArray, unknowns: int, form: str) -> RealArray:
    diagonal = np.abs(np.diag(triangle))[:unknowns]
    if diagonal.size < unknowns or diagonal.min() < 1e-10 * diagonal.max():
        raise InputError(
            f"surface must have enough valid points, not all on one line, to fit a {form} ({unknowns} coefficients), "
            "but has not. Use a lower form or fill the missing points."
        )
    solution: RealArray = np.linalg.solve(triangle[:unknowns, :unknowns], triangle[:unknowns, unknowns])
    return solution


def _legendre(count: int, degree: int) -> RealArray:
    """Legendre polynomials 0 … degree at ``count`` equally spaced points on [-1, 1], shape (count, degree + 1)."""
    points = np.linspace(-1.0, 1.0, count) if count > 1 else np.zeros(1)
    return np.polynomial.legendre.legvander(points, degree)
