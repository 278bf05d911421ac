"""A uniform band of heat across the motion (Jaeger 1942), |x| < 1 in units of its half width l.

θ = k T/(q l), Pe = v l/2κ > 0. A band at rest has no steady state: temperatures rise as the
logarithm of time.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.quadrature import gauss
from ...core.scipy_parts import special

_CLOSED = 1e-3
"""Péclet number from which on the closed form keeps twelve digits."""
_NODES = 12


def at_surface(x: ArrayLike, peclet: float) -> RealArray:
    """θ at the surface: (P(X + Pe) - P(X - Pe))/(π Pe), X = Pe x."""
    x = np.asarray(x, dtype=float)
    if peclet < _CLOSED:
        return below(x, peclet, 0.0)
    return np.asarray((_primitive(peclet * (x + 1.0)) - _primitive(peclet * (x - 1.0))) / (math.pi * peclet))


def _primitive(u: RealArray) -> RealArray:
    """P(U) = ∫ exp(u) K0|u| du from 0 to U: U e^U (K0 + K1) - 1, of a negative U with K0 - K1 at
    |U|."""
    size = np.maximum(np.abs(u), 1e-300)
    k0, k1 = special.k0e(size), special.k1e(size)
    upstream = -size * np.exp(-2.0 * size) * (k0 - k1)
    found = np.where(u > 0.0, size * (k0 + k1), upstream) - 1.0
    return np.asarray(np.where(u == 0.0, 0.0, found))


def below(x: ArrayLike, peclet: float, depth: float) -> RealArray:
    """θ at the ``depth`` z/l >= 0: ∫ exp(Pe u) K0(Pe sqrt(u² + z²)) du/π over x - 1 < u < x + 1."""
    x = np.asarray(x, dtype=float)
    found = np.empty(x.size)
    for at, place in enumerate(x.ravel()):
        near = _panels(peclet, depth)
        marks = np.concatenate([-near[::-1], near, [place - 1.0, place + 1.0]])
        u, weight = gauss(np.unique(marks[(marks >= place - 1.0) & (marks <= place + 1.0)]), _NODES)
        r = np.maximum(np.hypot(u, depth), 1e-300)
        felt = np.exp(-peclet * np.where(u > 0.0, depth**2 / (r + np.abs(u)), r - u)) * special.k0e(peclet * r)
        found[at] = weight @ felt / math.pi
    return found.reshape(x.shape)


def mean(peclet: float) -> float:
    """Mean of θ over the band: ∫ (1 - u/2) 2 cosh(Pe u) K0(Pe u) du/π over 0 < u < 2."""
    panels = _panels(peclet, 0.0)
    u, weight = gauss(np.append(panels[panels < 2.0], 2.0), _NODES)
    both = (1.0 + np.exp(-2.0 * peclet * u)) * special.k0e(peclet * u)
    return float(weight @ ((1.0 - 0.5 * u) * both)) / math.pi


def _panels(peclet: float, depth: float) -> RealArray:
    """Distances that double from where the logarithm begins."""
    first = 2.0**-40 if depth == 0.0 else min(depth, 1.0) / 4.0
    first = min(first, 1.0 / (16.0 * max(peclet, 1.0)))
    return np.append(0.0, first * 2.0 ** np.arange(0.0, 3.0 - math.log2(first) + 30.0))
