"""Gauss rules on many panels at once."""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Callable

import numpy as np
from numpy.polynomial import chebyshev

from .arrays import RealArray


@functools.cache
def rule(nodes: int) -> tuple[RealArray, RealArray]:
    """Gauss-Legendre nodes and weights, (nodes,) each, on [-1, 1]. Shared: not to be written to."""
    return np.polynomial.legendre.leggauss(nodes)


def gauss(breaks: RealArray, nodes: int) -> tuple[RealArray, RealArray]:
    """Gauss-Legendre nodes and weights, (…, n · nodes) each, on the panels between ``breaks``,
    ``nodes`` in each panel.

    ``breaks`` (…, n + 1) do not fall along the last axis; a panel of no width contributes nothing.
    """
    x, w = rule(nodes)
    low, high = breaks[..., :-1, None], breaks[..., 1:, None]
    half = 0.5 * (high - low)
    shape = (*breaks.shape[:-1], (breaks.shape[-1] - 1) * nodes)
    return (low + half * (x + 1.0)).reshape(shape), (half * w).reshape(shape)


def running(nodes: int) -> tuple[RealArray, RealArray]:
    """Chebyshev nodes (nodes,) on [-1, 1], both ends among them, and the matrix that makes
    integrals from -1 to each node of values there.

    Exact for polynomials of degree below ``nodes`` >= 2 (Clenshaw & Curtis 1960).
    """
    x = -np.cos(np.pi * np.arange(nodes) / (nodes - 1))
    series = np.linalg.inv(chebyshev.chebvander(x, nodes - 1))
    sums = chebyshev.chebvander(x, nodes) @ chebyshev.chebint(series, lbnd=-1.0)
    sums[0] = 0.0  # but for rounding
    return x, sums


_PANELS, _PANEL_NODES, _START = 12, 24, 1e-9


def geometric(low: RealArray, high: RealArray) -> tuple[RealArray, RealArray]:
    """Nodes and weights (…, n) between ``low`` and ``high``, 0 <= low < high, for powers and
    logarithms at zero.

    Gauss-Legendre rules on twelve panels that grow with the distance from zero; from 1e-9 of
    ``high`` if ``low`` is less.
    """
    start = np.maximum(low, _START * high)[..., None]
    breaks = start * (np.asarray(high)[..., None] / start) ** (np.arange(_PANELS + 1) / _PANELS)
    breaks[..., 0] = low
    return gauss(breaks, _PANEL_NODES)


# Moments of the part of a distribution above a level: ∫ (s - D)^m f(s) ds over s > D.
# scipy.integrate.tanhsinh (1.17) over the same pieces stops early at some levels of some curves
# (errors up to 8e-10 at rtol = 1e-13, against 1e-12 here); made as exact by minlevel = 5 it takes
# two to six times as long.

_STEP = 0.02  # of the trapezoidal rule over τ; half of it changes no moment by more than 1e-11 of itself
_REACH = 6.5  # |τ| beyond which a node lies within 1e-400 of its end
_EDGES = (-4.0, 0.0)
_FARTHEST = 1e100  # beyond, a density with four moments adds nothing
_CHUNK = 64  # levels whose temporaries fit into the cache

LogDensity = Callable[[RealArray, RealArray, RealArray], RealArray]
"""ln f at x, of which the distances to the lower and the upper end are given, too: close to an end
they keep their digits."""


def partial_moment(log_density: LogDensity, ends: tuple[float, float], order: float, level: RealArray) -> RealArray:
    """∫ (s - level)^order f(s) ds over s > ``level`` (any shape), by double exponential quadrature
    (Takahasi & Mori 1974).

    The interval is divided at the mean and four standard deviations below, for a density of zero
    mean and unit variance. Either of the ``ends`` between which it is positive may be infinite;
    order > -1.
    """
    flat, moments = level.ravel(), np.zeros(level.size)
    edges = [ends[0], *(edge for edge in _EDGES if ends[0] < edge < ends[1]), ends[1]]
    for begin in range(0, flat.size, _CHUNK):
        part = slice(begin, begin + _CHUNK)
        for low, high in itertools.pairwise(edges):
            reached = np.flatnonzero(flat[part] < high) + begin
            # over the part of this piece above each level, which is below its end
            above = flat[reached]
            start, end = np.maximum(above, low)[:, None], high
            tau = np.arange(-_REACH, _REACH + 0.5 * _STEP, _STEP)
            if math.isinf(end):  # distance from the start exp(π/2 sinh τ)
                log_y = 0.5 * math.pi * np.sinh(tau)[None, :]
                log_rest = np.full(log_y.shape, np.inf)
                log_slope = log_y + np.log(0.5 * math.pi * np.cosh(tau))
            else:  # distances (end - start)/(1 + exp(∓π sinh τ)) from both sides
                width, u = np.log(end - start), math.pi * np.sinh(tau)
                log_y, log_rest = width - np.logaddexp(0.0, -u), width - np.logaddexp(0.0, u)
                log_slope = log_y + log_rest - width + np.log(math.pi * np.cosh(tau))
            with np.errstate(over="ignore"):
                y, rest = np.exp(log_y), np.exp(log_rest)
            from_low, from_high = (start - ends[0]) + y, (ends[1] - end if math.isfinite(end) else 0.0) + rest
            used = (y > 0.0) & (y < _FARTHEST) & (from_high > 0.0)
            y, from_low, from_high = (np.where(used, values, 1.0) for values in (y, from_low, from_high))
            logs = (
                order * np.log((start - above[:, None]) + y) + log_density(start + y, from_low, from_high) + log_slope
            )
            moments[reached] += np.asarray(_STEP * np.sum(np.exp(np.where(used, logs, -np.inf)), axis=1))
    return moments.reshape(level.shape)
