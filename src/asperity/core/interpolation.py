"""Functions of a positive number as polynomials on panels that grow geometrically: the one
interpolator.

Responses of layered bodies are analytic on scales that themselves grow with the wavenumber or the
distance (exponentials, quotients with complex poles), so that equal panels in ln x serve all
thicknesses at once. Functions that can be computed anywhere are fitted at Chebyshev points of wide
panels; functions known on a logarithmic grid only, such as Hankel transforms, are interpolated
through ten of its nodes about every narrow one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.polynomial.polynomial import polyfromroots

from .arrays import RealArray
from .grid import Grid

TERMS = 10
"""Polynomial coefficients in a panel."""

WIDE = 0.125 * math.log(2.0)
"""Width in ln x of fitted panels: ten terms leave 1e-13 of e^-x at x = 10, less than 1e-15 of its
value at 0 everywhere."""

STEP = 1.0 / 96.0
"""Spacing of the nodes of a logarithmic grid. The error of the ten-point polynomial is 870
(STEP/w)^10 relative for a function of ln x without singularities nearer to the real axis than w:
1e-14 at w = 0.5, about the least of responses of layered bodies."""

_LOST = 0.125 * float(np.finfo(float).eps)
"""Sum of terms over the first one that is lost in rounding: narrow panels of responses need two to
eight terms."""

_BEFORE, _AFTER = 4, 5  # nodes below and above the node that starts a panel
_CHUNK = 16384  # points whose temporaries stay in the second-level cache


def _through_nodes() -> RealArray:
    """Matrix (power, node) from values at the ten nodes about a panel [1, e^STEP] to coefficients
    of t in [-1, 1]."""
    half, middle = 0.5 * math.expm1(STEP), 1.0 + 0.5 * math.expm1(STEP)
    nodes = (np.exp(np.arange(-_BEFORE, _AFTER + 1) * STEP) - middle) / half
    others = [np.delete(nodes, k) for k in range(TERMS)]
    return np.transpose([polyfromroots(o) / np.prod(node - o) for node, o in zip(nodes, others, strict=True)])


def _through_chebyshev() -> RealArray:
    """Matrix from values at Chebyshev points, through Chebyshev coefficients, to coefficients of
    powers."""
    weights = np.where(np.arange(TERMS) == 0, 1.0, 2.0) / TERMS
    powers = np.zeros((TERMS, TERMS))
    for k in range(TERMS):
        powers[k, : k + 1] = np.polynomial.chebyshev.cheb2poly(np.eye(TERMS)[k])[: k + 1]
    return np.polynomial.chebyshev.chebvander(_CHEBYSHEV, TERMS - 1) * weights @ powers


_CHEBYSHEV = np.cos(np.pi * (np.arange(TERMS) + 0.5) / TERMS)
_FROM_NODES, _FROM_POINTS = _through_nodes(), _through_chebyshev()


@dataclass(frozen=True)
class Panels:
    """``count`` panels from ``start`` upwards, each ``width`` wide in ln x; in each t runs from -1
    to 1, linear in x."""

    start: float
    width: float
    count: int

    @cached_property
    def breaks(self) -> RealArray:
        """Ends of the panels, (count + 1,)."""
        return np.asarray(self.start * np.exp(self.width * np.arange(self.count + 1)))

    @property
    def points(self) -> RealArray:
        """Points at which functions to be fitted must be known, (count · TERMS,)."""
        low, high = self.breaks[:-1, None], self.breaks[1:, None]
        return (0.5 * (low + high) + 0.5 * (high - low) * _CHEBYSHEV).ravel()

    def moments(self, x: RealArray, weights: RealArray, *, terms: int = TERMS) -> RealArray:
        """Sums (``terms``, count) of ``weights`` t^k over the ``x`` in each panel: times the
        coefficients of any table on these panels they give the sum of weights and values."""
        x, count = x.ravel(), self.count
        panel = np.log((x / self.start).astype(np.float32))  # near a break either panel will do
        panel /= np.float32(self.width)
        number = panel.astype(np.intp)
        np.clip(number, 0, count - 1, out=number)
        t = x * self.scales[number]
        t -= 1.0 + 2.0 / math.expm1(self.width)
        power, found = weights.ravel().copy(), np.empty((terms, count))
        for k in range(terms):
            found[k] = np.bincount(number, power, count)
            power *= t
        return found

    @cached_property
    def scales(self) -> RealArray:
        """dt/dx in each panel, (count,)."""
        return np.asarray(2.0 / (math.expm1(self.width) * self.breaks[:-1]))

    def fitted(self, values: RealArray) -> RealArray:
        """Coefficients (count, m, TERMS) of the powers of t of m functions with ``values`` (m,
        count · TERMS) at ``points``."""
        by_panel = values.reshape(values.shape[0], -1, TERMS)
        return np.ascontiguousarray(np.moveaxis(by_panel @ _FROM_POINTS, 1, 0))


def panels(grid: Grid, width: float = WIDE) -> Panels:
    """Panels that hold every wavenumber of ``grid`` but zero, about as wide as ``width`` in ln
    x."""
    lengths = [n * d for n, d in zip(grid.shape, grid.spacing, strict=True) if n > 1] or [max(grid.size)]
    lowest = 2.0 * np.pi / max(lengths) * (1.0 - 1e-12)
    highest = np.pi * math.hypot(*(1.0 / d for d in grid.spacing)) * (1.0 + 1e-12)
    return panels_between(lowest, highest, width)


def panels_between(low: float, high: float, width: float = WIDE) -> Panels:
    """Panels from ``low`` to ``high``, both > 0, about as wide as ``width`` in ln x."""
    whole = math.log(high / low)
    count = max(1, math.ceil(whole / width))
    return Panels(low, whole / count, count)


@dataclass(frozen=True, eq=False)
class LogTable:
    """One function on ``panels``; ``coefficients[k, i]`` belongs to t^k in panel i.

    Beyond its ends the table extrapolates with the outermost polynomials.
    """

    panels: Panels
    coefficients: RealArray

    @property
    def start(self) -> float:
        """Smallest x of the table."""
        return self.panels.start

    @property
    def end(self) -> float:
        """Largest x of the table."""
        return float(self.panels.breaks[-1])

    def __call__(self, x: RealArray) -> RealArray:
        """Values at ``x`` > 0, an array of any shape."""
        x = np.asarray(x, dtype=float)
        flat, out = x.ravel(), np.empty(x.size)
        for begin in range(0, x.size, _CHUNK):
            at, values = flat[begin : begin + _CHUNK], out[begin : begin + _CHUNK]
            logarithm = np.log((at / self.panels.start).astype(np.float32))  # near a break either panel will do
            logarithm /= np.float32(self.panels.width)
            panel = logarithm.astype(np.intp)
            t = self.panels.scales.take(panel, mode="clip")
            t *= at
            t -= 1.0 + 2.0 / math.expm1(self.panels.width)
            highest = int(self._needed.take(panel, mode="clip").max(initial=0))
            self.coefficients[highest].take(panel, out=values, mode="clip")
            gathered = np.empty_like(values)
            for coefficient in self.coefficients[:highest][::-1]:
                values *= t
                values += coefficient.take(panel, out=gathered, mode="clip")
        return out.reshape(x.shape)

    def moments(self, x: RealArray, weights: RealArray) -> RealArray:
        """Those of the ``panels``."""
        return self.panels.moments(x, weights)

    @cached_property
    def _needed(self) -> Any:
        """Highest power (count,) that rounding of the value does not lose in a panel."""
        sizes = np.abs(self.coefficients)
        rest = np.cumsum(sizes[::-1], axis=0)[::-1]  # of a power and all above it: it falls with the power
        return (rest[1:] > _LOST * sizes[0]).sum(axis=0)

    def integral(self, first: float = 0.0) -> LogTable:
        """Table of the integral over ln x, which is ``first`` at the start.

        d ln x = e dt / (1 + e t) with e = tanh(width/2); terms beyond e^10 are below rounding in
        narrow panels.
        """
        e = math.tanh(0.5 * self.panels.width)
        rises = e * self.coefficients  # times the series of 1/(1 + e t), power by power
        for power in range(1, TERMS):
            rises[power] -= e * rises[power - 1]
        rises /= np.arange(1, TERMS + 1)[:, None]
        after, before = rises.sum(axis=0), rises[1::2].sum(axis=0) - rises[::2].sum(axis=0)
        begin = first + np.concatenate([[0.0], np.cumsum(after - before)[:-1]]) - before
        return LogTable(self.panels, np.vstack([begin, rises]))


def log_grid(start: float, count: int) -> RealArray:
    """Nodes start·exp(i·STEP), i = 0…count-1."""
    return np.asarray(start * np.exp(STEP * np.arange(count)))


def covering_grid(low: float, high: float) -> RealArray:
    """Nodes of a table that reaches from ``low`` to ``high``, both > 0."""
    cells = int(np.ceil(np.log(high / low) / STEP)) + 1
    return log_grid(low * np.exp(-STEP * (_BEFORE + 0.5)), cells + _BEFORE + _AFTER)


def log_table(start: float, values: RealArray) -> LogTable:
    """Table through ``values`` at the nodes ``log_grid(start, len(values))``, at least ten."""
    values = np.asarray(values, dtype=float)
    # a product of matrices takes a hundred times as long where its threads wait for one another
    coefficients = np.array([np.correlate(values, row, "valid") for row in _FROM_NODES])
    return LogTable(table_panels(start, values.size), coefficients)


def table_panels(start: float, count: int) -> Panels:
    """Panels of a table through so many nodes of ``log_grid(start, count)``."""
    return Panels(float(start * np.exp(STEP * _BEFORE)), STEP, count - TERMS + 1)


def backwards_table(moments: RealArray) -> RealArray:
    """Weights (n,) of the values of a ``log_table`` in a sum whose first ``moments`` (TERMS or
    fewer, count) are given: its transpose."""
    rows = [np.convolve(moment, row) for moment, row in zip(moments, _FROM_NODES, strict=False)]
    return np.asarray(np.sum(rows, axis=0))


def backwards_integral(moments: RealArray, width: float) -> tuple[RealArray, float]:
    """Moments (TERMS, count) of a table of panels of this ``width``, and the weight of the first
    value, in a sum of its ``integral`` with the ``moments`` (TERMS + 1, count): its transpose."""
    e, begin = math.tanh(0.5 * width), moments[0]
    after = np.cumsum(begin[::-1])[::-1] - begin  # of all panels above
    signs = np.where(np.arange(TERMS) % 2 == 1, 1.0, -1.0)[:, None]
    found = (moments[1:] + after - signs * (after + begin)) / np.arange(1, TERMS + 1)[:, None]
    for power in range(TERMS - 1, 0, -1):
        found[power - 1] -= e * found[power]
    return e * found, float(begin.sum())


def log_hankel(values: RealArray, order: float) -> RealArray:
    """A(r) = ∫ a(k) J_order(kr) r dk for ``values`` (n,) of a at k_j = k_0 exp(j·STEP), n even, by
    SciPy's FFTLog (Hamilton 2000).

    The function must fall to zero towards both ends of the grid. Returns A (n,) at r_j = exp((j +
    1 - n)·STEP)/k_0, which begins at the reciprocal of the largest k. On a logarithmic scale the
    transform is a convolution whose spectrum has modulus one, so it neither loses nor amplifies;
    its error is the alias of A and a beyond the ends, and rounding of the largest value (1e-15 for
    k exp(-k)). ``order`` > -1.
    """
    from scipy.fft import fht

    return np.asarray(fht(values, STEP, order))
