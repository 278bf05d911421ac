"""Temperature of a rectangle of uniform flux on a half-space that moves along its surface, in
steady state and in time, at its surface and below; and that of a pixel at all offsets of a grid.

The field of an instantaneous source is Gaussian, so a rectangle of sources makes at each time a
product of a function of x and one of y (Carslaw & Jaeger 1959). With w = sqrt(κ τ) of the age τ,

    G = 1/(2 sqrt(π) k) ∫ X(w) Y(w) exp(-z²/4w²) dw,   0 < w < sqrt(κ t),
    X = erf((x' + h)/2w) - erf((x' - h)/2w),  x' = x - v w²/κ,  and Y alike,

so that the coefficients of a grid are one product of two matrices.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quadrature import gauss, rule
from ...core.scipy_parts import special

_NODES = 14
_PANEL = 0.8
"""Length of a panel in ln w where nothing moves by; with fourteen nodes errors are below 1e-13."""
_BEGIN = 1e-13
"""Of the smaller half side: what the rectangle makes before is its surface flux into depth."""
_SEEN = 1.0 / 13.0
"""The same where the nearest edge is one half side away: erfc(6.5) < 1e-19."""
_LAST = 1e7
"""Of the largest distance: beyond, the tail at rest is known to the square of its inverse."""
_STILL = 1e-18
"""v/κ times the largest distance below which the motion changes no digit."""
_GONE = 6.2
"""Argument x'/2w of the error functions from which on the source has passed by: their difference is
below 1e-17."""


def rectangle(
    x: ArrayLike,
    y: ArrayLike,
    half: tuple[float, float],
    conductivity: float,
    diffusivity: float,
    speed: float | tuple[float, float] = 0.0,
    *,
    depth: float = 0.0,
    time: float = math.inf,
) -> RealArray:
    """Temperature per unit flux density at points (``x``, ``y``) (m, broadcast) of a uniform
    rectangle about the origin, in K m²/W.

    Parameters
    ----------
    half
        Half sides along x and y in m, > 0.
    conductivity, diffusivity
        k in W/(m K) and κ in m²/s of the half-space, > 0.
    speed
        Of the material along x in m/s, or along x and y; the wake lies at +x of a positive one.
    depth
        z in m, >= 0.
    time
        Since the flux began, in s, > 0; infinite for the steady state.
    """
    x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    of = _Moving(conductivity, diffusivity, speed, depth, time)
    reach = (float(np.abs(x).max()) + half[0], float(np.abs(y).max()) + half[1])
    w, weight = of.nodes(_BEGIN * min(half), reach)
    along = _passing(x[..., None], half[0], of.drift[0] * w, w)
    across = _passing(y[..., None], half[1], of.drift[1] * w, w)
    return np.asarray(along * across @ weight + of.tail(half, reach))


def pixel_kernel(
    shape: tuple[int, int],
    spacing: tuple[float, float],
    conductivity: float,
    diffusivity: float,
    speed: float | tuple[float, float] = 0.0,
    *,
    depth: float = 0.0,
    time: float = math.inf,
) -> RealArray:
    """Temperature per unit flux density at all offsets from a pixel of uniform flux, in K m²/W:
    (2 nx - 1, 2 ny - 1), offset (i, j) of the field from the source at [nx - 1 + i, ny - 1 + j].

    Parameters
    ----------
    shape
        (nx, ny) of the grid.
    spacing
        (dx, dy) in m: the sides of a pixel.
    conductivity, diffusivity, speed, depth, time
        As of ``rectangle``.

    Examples
    --------
    A pixel at rest is hottest at itself.

    >>> kernel = pixel_kernel((2, 1), (1e-6, 1e-6), 50.0, 1e-5)
    >>> kernel.shape
    (3, 1)
    >>> round(float(50.0 / 0.5e-6 * kernel[1, 0]), 6)  # 4/π asinh 1
    1.1222
    """
    half = (0.5 * require.positive(spacing[0], "spacing (m)"), 0.5 * require.positive(spacing[1], "spacing (m)"))
    of = _Moving(conductivity, diffusivity, speed, depth, time)
    places = [(np.arange(2 * n - 1) - (n - 1)) * 2.0 * h for n, h in zip(shape, half, strict=True)]
    reach = (float(places[0][-1]) + half[0], float(places[1][-1]) + half[1])
    begin = min(_SEEN * min(half), 0.3 * math.sqrt(min(half) / max(*np.abs(of.drift), 1e-300)))
    w, weight = of.nodes(begin, reach)
    along = _passing(places[0][:, None], half[0], of.drift[0] * w, w)
    across = _passing(places[1][:, None], half[1], of.drift[1] * w, w)
    return np.asarray((along * weight) @ across.T + of.tail(half, reach))


def rectangle_mean(
    half: tuple[float, float], conductivity: float, diffusivity: float, speed: float | tuple[float, float] = 0.0
) -> float:
    """Mean of the steady ``rectangle`` over itself, in K m²/W; closed at rest, where it is the
    potential of a plate on itself."""
    of = _Moving(conductivity, diffusivity, speed, 0.0, math.inf)
    if not np.any(of.drift):
        a, b = 2.0 * half[0], 2.0 * half[1]
        corners = (a**2 + b**2) ** 1.5 - a**3 - b**3
        over_r = 2.0 * a * b * (a * math.asinh(b / a) + b * math.asinh(a / b)) - corners / 1.5
        return float(over_r / (a * b * 2.0 * math.pi * of.k))
    reach = (2.0 * half[0], 2.0 * half[1])
    w, weight = of.nodes(_BEGIN * min(half), reach)
    along, across = (_passing_mean(h, drift * w, w) for h, drift in zip(half, of.drift, strict=True))
    return float(weight @ (along * across)) + of.tail(half, reach)


class _Moving:
    """The half-space, and the rule for the integral over w."""

    def __init__(
        self,
        conductivity: float,
        diffusivity: float,
        speed: float | tuple[float, float],
        depth: float,
        time: float,
    ) -> None:
        self.k = require.positive(conductivity, "thermal conductivity (W/m/K)")
        kappa = require.positive(diffusivity, "thermal diffusivity (m²/s)")
        vx, vy = speed if isinstance(speed, tuple) else (speed, 0.0)
        self.drift = np.array([require.finite(vx, "speed (m/s)"), require.finite(vy, "speed (m/s)")]) / kappa
        self.z = require.not_negative(depth, "depth (m)")
        if not time > 0.0:
            raise InputError(f"time since the flux began (s) must be greater than zero, but is {time!r}.")
        self.end = math.sqrt(kappa * time)

    def nodes(self, begin: float, reach: tuple[float, float]) -> tuple[RealArray, RealArray]:
        """Nodes w and weights of ∫ X Y … dw, with what lies before ``begin``."""
        end = min(self.end, self._last(reach))
        begin = min(begin, end)
        speed = float(np.hypot(*self.drift))
        u, last, breaks = math.log(begin), math.log(end), [math.log(begin)]
        while u < last:
            u = min(u + _PANEL / (1.0 + 0.5 * speed * math.exp(u)), last)
            breaks.append(u)
        logs, weight = gauss(np.array(breaks), _NODES)
        w = np.append(begin, np.exp(logs))
        weight = np.append(1.0, weight) * w
        with np.errstate(under="ignore"):
            weight *= np.exp(-(self.z**2) / (4.0 * w**2)) / (2.0 * math.sqrt(math.pi) * self.k)
        return w, weight

    def _last(self, reach: tuple[float, float]) -> float:
        """w from which on the source has passed by, or the tail is known."""
        passed = [
            (_GONE + math.sqrt(_GONE**2 + speed * far)) / speed
            for speed, far in zip(np.abs(self.drift), reach, strict=True)
            if speed * far > _STILL
        ]
        return float(min(passed)) if passed else _LAST * max(*reach, self.z)

    def tail(self, half: tuple[float, float], reach: tuple[float, float]) -> float:
        """What comes after the last node in steady state at rest."""
        last = self._last(reach)
        moves = any(speed * far > _STILL for speed, far in zip(np.abs(self.drift), reach, strict=True))
        if moves or self.end <= last:
            return 0.0
        after = 0.0 if math.isinf(self.end) else 1.0 / self.end
        return float(2.0 * half[0] * half[1] / (math.pi**1.5 * self.k) * (1.0 / last - after))


def _passing(x: RealArray, half: float, shift: RealArray, w: RealArray) -> RealArray:
    """erf((x' + h)/2w) - erf((x' - h)/2w), x' = x - w times the ``shift`` v w/κ, without
    cancellation."""
    place = np.abs(x / (2.0 * w) - 0.5 * shift)
    wide = half / (2.0 * w)
    near, far = place - wide, place + wide
    with np.errstate(under="ignore"):
        outside = special.erfc(np.maximum(near, 0.0)) - special.erfc(far)
        return np.asarray(np.where(near > 0.0, outside, special.erf(far) - special.erf(near)))


def _passing_mean(half: float, shift: RealArray, w: RealArray) -> RealArray:
    """Mean of ``_passing`` over |x| < h: a second difference of the integral of erf, of wide
    Gaussians by a rule of Gauss."""
    x, weight = rule(20)
    wide = _passing(half * x[:, None], half, shift, w)
    ratio, moved = half / w, 0.5 * shift

    def integral(u: RealArray) -> RealArray:
        with np.errstate(under="ignore"):
            return np.asarray(u * special.erf(u) + np.exp(-(u**2)) / math.sqrt(math.pi))

    difference = integral(moved + ratio) - 2.0 * integral(moved) + integral(moved - ratio)
    return np.asarray(np.where(ratio < 1.0, 0.5 * weight @ wide, difference / ratio))
