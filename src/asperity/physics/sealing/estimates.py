"""Estimates of the flow through a gap beside its solution: bounds and effective medium from the
distribution of the gap, closed forms, and the critical junction.

All are transmissivities K = 12 η Q L / (W ΔP) in m³, the cube of the even gap that lets as much
through, unless said otherwise.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq
from scipy.special import gamma

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from .flow import Bounds, GapFlow
from .network import checked_gap, clusters


def layer_bounds(gap: RealArray) -> Bounds:
    """K of the ``gap`` (any shape, m) in layers across and along the flow: 1/<g⁻³> and <g³>; no
    statistically even arrangement is beyond them."""
    cubes = np.asarray(gap, np.float64) ** 3
    least = 0.0 if (cubes <= 0.0).any() else 1.0 / float(np.mean(1.0 / cubes))
    return Bounds(least, float(cubes.mean()))


def bruggeman(gap: RealArray, weights: RealArray | None = None) -> float:
    """K of an isotropic medium of these gaps by Bruggeman: <(g³ - K)/(g³ + K)> = 0.

    Exact where the field and its exchange of high for low are alike (Keller 1964, Dykhne 1971):
    a lognormal gap has exp <ln g³>, a chessboard √(K1 K2). Zero from a contact fraction of one half
    on; contacts of rough surfaces close at 0.42 to 0.5.

    Parameters
    ----------
    gap
        Gaps in m, zero in contact.
    weights
        Their shares; equal by default.
    """
    cubes = np.asarray(gap, np.float64).ravel() ** 3
    share = np.full(cubes.size, 1.0 / cubes.size) if weights is None else np.asarray(weights, float).ravel()
    share = share / share.sum()
    if share[cubes <= 0.0].sum() >= 0.5:
        return 0.0
    open_cubes, scale = cubes[cubes > 0.0], float(np.max(cubes))

    def excess(logarithm: float) -> float:
        conductance = np.exp(logarithm) * scale
        return float((share * (cubes - conductance) / (cubes + conductance)).sum())

    low = np.log(open_cubes.min() / scale) - 60.0
    return float(np.exp(brentq(excess, low, 1e-9, xtol=1e-14, rtol=1e-14)) * scale)


def sinusoidal_gap(amplitude: float, *, along: bool) -> float:
    """K over the cube of the mean gap of a sinusoidal gap, its ``amplitude`` over the mean gap
    below 1, with the flow along or across the grooves."""
    e = require.finite(amplitude, "amplitude over mean gap")
    if not 0.0 <= e <= 1.0:
        raise InputError(f"amplitude over mean gap must be from 0 to 1, but is {e:g}.")
    return float(1.0 + 1.5 * e**2 if along else (1.0 - e**2) ** 2.5 / (1.0 + 0.5 * e**2))


def tapered_gap(inlet: float, outlet: float) -> float:
    """K in m³ of a gap that changes linearly from ``inlet`` to ``outlet`` (m, > 0)."""
    first, last = require.positive(inlet, "gap at the inlet (m)"), require.positive(outlet, "gap at the outlet (m)")
    return float(2.0 * (first * last) ** 2 / (first + last))


def parabolic_throat(gap: float, radius: float) -> float:
    """12 η Q/(W ΔP) in m² of a throat g + x²/(2 R) across the flow, without ends."""
    g, curved = require.positive(gap, "gap of a throat (m)"), require.positive(radius, "radius of a throat (m)")
    return float(8.0 * g**2.5 / (3.0 * np.pi * np.sqrt(2.0 * curved)))


def parabolic_channel(height: float) -> float:
    """K in m³ of a channel along the flow whose section is a parabola, closed at both sides."""
    return 16.0 / 35.0 * require.positive(height, "height of a channel (m)") ** 3


def annular_gap(gap: float, ratio: float) -> float:
    """12 η Q/ΔP in m³ of an even ``gap`` (m) between circles whose radii have the ``ratio`` > 1."""
    if not require.finite(ratio, "ratio of radii") > 1.0:
        raise InputError(f"ratio of radii must be greater than 1, but is {ratio:g}.")
    return float(2.0 * np.pi * require.positive(gap, "gap of an annulus (m)") ** 3 / np.log(ratio))


def saddle_throat(gap: float, along: float, across: float) -> Bounds:
    """12 η Q/ΔP in m³ of a throat g + x²/(2 R_x) - y²/(2 R_y) with the flow along x: from below
    without flow across, from above with a pressure that varies along x only; 5/6 and 6/7 of
    g³ √(R_y/R_x)."""
    g = require.positive(gap, "gap of a saddle (m)")
    radii = require.positive(along, "radius along the flow (m)"), require.positive(across, "radius across (m)")
    size = g**3 * np.sqrt(radii[1] / radii[0])
    return Bounds(5.0 / 6.0 * size, 6.0 / 7.0 * size)


def obstacle_array(fraction: float, orders: int = 20) -> float:
    """K over that of the open gap of a square array of impermeable circles that cover a
    ``fraction`` of the area, by Rayleigh's multipoles (Perrins, McKenzie & McPhedran 1979).

    With the period 1 and the radius a the potential about a circle is
    Σ (A_n r^m + B_n r^-m) cos mθ, m = 2n - 1; no flow into the circles has A_n = B_n a^-2m. The
    field of all other circles and the mean gradient E make A_n,
    Σ_m binom(2n + 2m - 3, 2n - 1) S_(2n+2m-2) B_m = E δ_n1 - A_n, with the sums S_k over the
    lattice of (x + iy)^-k, and K = 1 - 2π B_1/E.

    Raises
    ------
    InputError
        If the circles meet, from a fraction of π/4 on, or the fraction is negative.
    """
    f = require.not_negative(fraction, "area fraction of obstacles")
    if f >= np.pi / 4.0:
        raise InputError(f"area fraction of obstacles must be below π/4 = 0.7854, but is {f:g}.")
    radius = np.sqrt(f / np.pi)
    sums = lattice_sums(4 * orders)
    system, right = np.zeros((orders, orders)), np.zeros(orders)
    right[0] = radius
    # unknowns B_n a^-(2n-1), which keeps the system even
    for n in range(1, orders + 1):
        for m in range(1, orders + 1):
            k = 2 * n + 2 * m - 2
            size = _binomial(k - 1, 2 * n - 1) * radius**k
            system[n - 1, m - 1] = size * sums[k]
        system[n - 1, n - 1] += 1.0
    scaled = np.linalg.solve(system, right)
    return float(1.0 - 2.0 * np.pi * scaled[0] * radius)


def _binomial(n: int, k: int) -> float:
    found = 1.0
    for j in range(1, k + 1):
        found *= (n - k + j) / j
    return found


def lattice_sums(largest: int) -> RealArray:
    """(largest + 1,) sums of (x + iy)^-k over the points of the square lattice but the origin, zero
    unless 4 divides k; k = 2, which depends on the shape of the whole, is π, that of a strip across
    the gradient.

    From the invariants of Weierstrass' function: with c_n = (2n - 1) S_2n the recurrence
    c_n = 3/((2n + 1)(n - 3)) Σ_m c_m c_(n-m).
    """
    sums = np.zeros(max(largest, 4) + 1)
    sums[2] = np.pi
    sums[4] = gamma(0.25) ** 8 / (960.0 * np.pi**2)
    coefficients = {2: 3.0 * sums[4], 3: 0.0}
    for n in range(4, largest // 2 + 1):
        total = sum(coefficients[m] * coefficients[n - m] for m in range(2, n - 1))
        coefficients[n] = 3.0 * total / ((2 * n + 1) * (n - 3))
        sums[2 * n] = coefficients[n] / (2 * n - 1)
    return sums


PERCOLATION = 0.42
"""Contact fraction at which contacts of rough surfaces close the gap in calculations (Dapp et al.
2012)."""


def patir_cheng(separation: RealArray) -> tuple[RealArray, RealArray]:
    """Pressure and shear flow factor φ and φ_s of isotropic Gaussian roughness at H/σ (Patir &
    Cheng 1978, 1979): good to 7 % from 2 on and too low below."""
    ratio = np.asarray(separation, np.float64)
    pressure = 1.0 - 0.9 * np.exp(-0.56 * ratio)
    near = 1.899 * ratio**0.98 * np.exp(-0.92 * ratio + 0.05 * ratio**2)
    return pressure, np.where(ratio <= 5.0, near, 1.126 * np.exp(-0.25 * ratio))


@dataclass(frozen=True)
class Estimates:
    """Estimates of K in m³ from the distribution of a gap.

    Attributes
    ----------
    lower, upper
        Layers across and along the flow.
    effective_medium
        Bruggeman's.
    critical_junction
        Cube of the gap of the constriction that decides, which is that of the last path to close.
    """

    lower: float
    upper: float
    effective_medium: float
    critical_junction: float


def estimates_of(flow: GapFlow) -> Estimates:
    """Estimates beside a ``flow``."""
    gap = checked_gap(flow.gap)
    bounds = layer_bounds(gap)
    return Estimates(bounds.lower, bounds.upper, bruggeman(gap), critical_gap(flow) ** 3)


def critical_gap(flow: GapFlow) -> float:
    """Largest gap in m of a body that passes from end to end along the direction of the flow: that
    of the critical constriction; zero where the gap is sealed.

    The rate (u_c³/12 η) (W/L) ΔP with it is that of Persson & Yang (2008) for a square of the size
    of the system, who take u_c from the theory of contact at the magnification where the contact
    closes.
    """
    values = np.unique(flow.gap[flow.net.carrying]) if not flow.sealed else np.zeros(1)
    low, high = 0, values.size  # passes at values[low], not at values[high]
    while high - low > 1:
        middle = (low + high) // 2
        found = clusters(flow.gap >= values[middle], flow.wraps)
        through = found.winds if flow.repeats else found.spans
        low, high = (middle, high) if through[flow.axis].any() else (low, middle)
    return float(values[low])
