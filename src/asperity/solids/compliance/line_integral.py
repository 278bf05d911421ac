"""Plane strain: integrals of the response to a line load, for any even or odd amplitude of the wavenumber.

The amplitude is split into (b/α + a) exp(-αd) in closed form, which carries the slow decay, and a remainder by logarithmic
Hankel transform.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import RealArray
from ...core.hankel import log_hankel
from ...core.panels import LogTable, log_table

_SMALL = 1e-5  # of the wavenumber 1/d, where the constant term of an amplitude can be read off


@dataclass(frozen=True, eq=False)
class LineIntegral:
    """∫ of the line response K from 0 to x: (b/α + a) exp(-αd) in closed form, and a table of the remainder."""

    b: float
    a: float
    d: float
    cosine: bool
    kernel: LogTable
    moment: LogTable

    def __call__(self, x: RealArray) -> RealArray:
        """Integral at x > 0 in m."""
        angle, log = np.arctan(x / self.d), np.log(x**2 + self.d**2)
        if self.cosine:
            closed = self.b * (x - 0.5 * x * log - self.d * angle) + self.a * angle
        else:
            rise = 0.5 * (log - 2.0 * np.log(self.d))
            closed = self.b * (x * angle - self.d * rise) + self.a * rise
        total: RealArray = closed / np.pi + self.moment(x)
        return total

    def slope(self, x: float) -> float:
        """K at x > 0 of a cosine response."""
        square = x**2 + self.d**2
        closed = -0.5 * self.b * np.log(square) + self.a * self.d / square
        return float(closed / np.pi + self.kernel(np.array([x]))[0])


def line_integral(alpha: RealArray, amplitude: RealArray, d: float, *, cosine: bool) -> LineIntegral:
    """Integral of 1/π ∫ F cos αx dα, or of the sine, for the ``amplitude`` F on ``wavenumber_grid(d)``.

    cos z = sqrt(πz/2) J_-1/2(z) and sin z with J_1/2 make it a Hankel transform.
    """
    b = float((alpha * amplitude)[0])
    small = int(np.searchsorted(alpha, _SMALL / d))
    a = float(amplitude[small] - b / alpha[small] * np.exp(-alpha[small] * d))
    rest = amplitude - (b / alpha + a) * np.exp(-alpha * d)
    x = 1.0 / alpha[::-1]
    kernel = log_hankel(rest * np.sqrt(alpha), -0.5 if cosine else 0.5) * np.sqrt(0.5 / (np.pi * x))
    start = float(x[0])
    moment = log_table(start, kernel * x)
    moment = moment.integral(float(kernel[0]) * moment.start)
    return LineIntegral(b, a, d, cosine, log_table(start, kernel), moment)
