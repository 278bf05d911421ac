"""Functions of the wavenumber as polynomials on panels that grow geometrically, to be evaluated at every wavevector.

Responses of layered bodies are analytic on scales that themselves grow with the wavenumber (exponentials, quotients with
complex poles), so that few panels serve all thicknesses at once.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .arrays import RealArray
from .grid import Grid

TERMS = 10
"""Polynomial coefficients in a panel."""

_RATIO = 2.0**0.125  # ten terms: error 1e-13 of e^-x at x = 10, less than 1e-15 of its value at 0 everywhere


@dataclass(frozen=True, eq=False)
class Panels:
    """Panels between ``breaks`` (n + 1), rad/m, and the points in them at which functions must be known."""

    breaks: RealArray

    @property
    def points(self) -> RealArray:
        """Chebyshev points, (n · TERMS,)."""
        t = np.cos(np.pi * (np.arange(TERMS) + 0.5) / TERMS)
        low, high = self.breaks[:-1, None], self.breaks[1:, None]
        points: RealArray = (0.5 * (low + high) + 0.5 * (high - low) * t).ravel()
        return points

    def coefficients(self, values: RealArray) -> RealArray:
        """Coefficients (n, m, TERMS) of the powers of t in [-1, 1] of m functions with ``values`` (m, n · TERMS)."""
        by_panel = values.reshape(values.shape[0], -1, TERMS)
        return np.ascontiguousarray(np.moveaxis(by_panel @ self._powers, 1, 0))

    @cached_property
    def _powers(self) -> RealArray:
        """Matrix from values at the points of a panel, through Chebyshev coefficients, to coefficients of powers."""
        t = np.cos(np.pi * (np.arange(TERMS) + 0.5) / TERMS)
        weights = np.where(np.arange(TERMS) == 0, 1.0, 2.0) / TERMS
        powers = np.zeros((TERMS, TERMS))
        for k in range(TERMS):
            powers[k, : k + 1] = np.polynomial.chebyshev.cheb2poly(np.eye(TERMS)[k])[: k + 1]
        matrix: RealArray = np.polynomial.chebyshev.chebvander(t, TERMS - 1) * weights @ powers
        return matrix


def panels(grid: Grid) -> Panels:
    """Panels that hold every wavenumber of ``grid`` but zero."""
    lengths = [n * d for n, d in zip(grid.shape, grid.spacing, strict=True) if n > 1] or [max(grid.size)]
    lowest = 2.0 * np.pi / max(lengths) * (1.0 - 1e-12)
    highest = np.pi * math.hypot(*(1.0 / d for d in grid.spacing)) * (1.0 + 1e-12)
    count = max(1, math.ceil(math.log(highest / lowest) / math.log(_RATIO)))
    return Panels(np.geomspace(lowest, highest, count + 1))
