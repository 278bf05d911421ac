"""Closed forms of motion on a rough interface: free vibration on a power law, and the stick-slip of
a block on a belt."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quadrature import rule
from ..protocol import bisected


@dataclass(frozen=True, eq=False)
class FreeVibration:
    """Undamped vibration of a mass on p = c δ^m under its load; arrays of one shape.

    Attributes
    ----------
    lowest
        Smallest penetration over that at rest; negative in free flight.
    period_ratio
        Period over that of small vibrations, 2π/sqrt(m) in units of sqrt(M y_0/W).
    flight_fraction
        Share of the period without contact.
    """

    lowest: RealArray
    period_ratio: RealArray
    flight_fraction: RealArray


NODES = 200
"""Points of the Gauss-Legendre rule for the period; from 100 to 200 its 14th digit changes."""


def free_vibration(exponent: ArrayLike, highest: ArrayLike) -> FreeVibration:
    """Vibration with the largest penetration ``highest`` > 1 over that at rest, on a law with
    ``exponent`` m >= 1; of any shape.

    Y'' = 1 - Y₊^m has the energy E = Y'²/2 - Y + Y₊^{m+1}/(m+1); the period is 2 ∫ dY/sqrt(2 (E +
    Y - Y₊^{m+1}/(m+1))) between the turning points, of which flight takes 2 sqrt(2E) if E > 0.
    Handbook formulas of Oden and Martins' law (1985).
    """
    m, top = np.broadcast_arrays(np.asarray(exponent, dtype=float), np.asarray(highest, dtype=float))
    if np.any(~(m >= 1.0)) or np.any(~(top > 1.0)) or not (np.isfinite(m).all() and np.isfinite(top).all()):
        raise InputError("exponent must be at least 1 and highest greater than 1, but some values are not.")
    energy = -top + top ** (m + 1.0) / (m + 1.0)
    flies = energy > 0.0
    # in contact the lower turning point is between 0 and 1
    low = bisected(lambda y: y - y ** (m + 1.0) / (m + 1.0) + energy, np.zeros_like(top), np.ones_like(top))
    lowest = np.where(flies, -energy, low)
    # Y = middle + half sin θ takes away the roots at turning points, and the kinetic energy is
    # taken from the nearer of them, without cancellation; without a turning point below, Y = top
    # sin θ from θ = 0
    low = np.where(flies, 0.0, low)
    nodes, weights = rule(NODES)
    start = np.where(flies, 0.0, -0.5 * math.pi)
    half = (0.25 * math.pi - 0.5 * start)[..., None]
    angle = start[..., None] + half * (nodes + 1.0)
    reach = np.where(flies, top, 0.5 * (top - low))[..., None]
    below_top = 2.0 * reach * np.sin(0.25 * math.pi - 0.5 * angle) ** 2
    above_low = 2.0 * reach * np.sin(0.25 * math.pi + 0.5 * angle) ** 2
    far = (angle < 0.0) & ~flies[..., None]
    base = np.where(far, np.maximum(low[..., None], np.finfo(float).tiny), top[..., None])
    step, power = np.where(far, above_low, -below_top), m[..., None] + 1.0
    gained = base**power * np.expm1(power * np.log1p(step / base)) / power
    slowness = reach * np.abs(np.cos(angle)) / np.sqrt(2.0 * (step - gained))
    contact: RealArray = 2.0 * half[..., 0] * (slowness @ weights)
    flight = np.where(flies, 2.0 * np.sqrt(2.0 * np.maximum(energy, 0.0)), 0.0)
    period = contact + flight
    return FreeVibration(lowest, period * np.sqrt(m) / (2.0 * math.pi), flight / period)


@dataclass(frozen=True)
class BeltStickSlip:
    """Stick-slip of a block on a belt with a static and a smaller kinetic friction coefficient.

    Attributes
    ----------
    slip_start, slip_end
        Displacement in m from the unstretched spring where slip begins and ends.
    slip_time, stick_time
        In s.
    largest_speed
        Amplitude of the velocity relative to the oscillation about the kinetic friction, in m/s.
    """

    slip_start: float
    slip_end: float
    slip_time: float
    stick_time: float
    largest_speed: float

    @property
    def period(self) -> float:
        """Of a cycle, in s."""
        return self.slip_time + self.stick_time


def belt_stick_slip(
    mass: float, stiffness: float, normal_force: float, speed: float, *, static: float, kinetic: float
) -> BeltStickSlip:
    """Undamped block of ``mass`` (kg) on a spring of ``stiffness`` (N/m), pressed by
    ``normal_force`` (N) on a belt of ``speed`` > 0 (m/s).

    With Δ = (μ_s - μ_k) N/k and ω = sqrt(k/M): slip from μ_s N/k to μ_k N/k - Δ takes (2/ω) [π -
    arctan(Δω/U)], stick 2Δ/U.

    Raises
    ------
    InputError
        If a value is not positive, or ``static`` is not above ``kinetic``: then there is no
        stick-slip.
    """
    M, k = require.positive(mass, "mass (kg)"), require.positive(stiffness, "stiffness (N/m)")
    N, U = require.positive(normal_force, "normal force (N)"), require.positive(speed, "speed (m/s)")
    low = require.not_negative(kinetic, "kinetic friction coefficient")
    if require.finite(static, "static friction coefficient") <= low:
        raise InputError(
            f"static friction coefficient must be above the kinetic one, {kinetic:g}, but is {static!r}: "
            "without a difference nothing sticks."
        )
    omega, reach = math.sqrt(k / M), (static - low) * N / k
    slip = 2.0 / omega * (math.pi - math.atan(reach * omega / U))
    return BeltStickSlip(static * N / k, low * N / k - reach, slip, 2.0 * reach / U, math.hypot(reach * omega, U))


def flutter_friction(exponent: ArrayLike, length: ArrayLike, height: ArrayLike) -> RealArray:
    """Friction coefficient above which steady sliding of a block flutters, without damping and for
    small tilt.

    μ = m_n H / (2 sqrt(3 (m_n - 1)) sqrt(b² + H²)) for a block of ``length`` b and ``height`` H (m)
    that slides on p = c δ^m (Martins, Oden and Simoes 1990); infinite for m_n = 1. Arrays that fit
    together.
    """
    m, b, H = (np.asarray(value, dtype=float) for value in (exponent, length, height))
    if np.any(~(m >= 1.0)) or np.any(~(b > 0.0)) or np.any(~(H > 0.0)):
        raise InputError("exponent must be at least 1, length and height greater than zero, but some values are not.")
    with np.errstate(divide="ignore"):
        found: RealArray = m * H / (2.0 * np.sqrt(3.0 * (m - 1.0)) * np.hypot(b, H))
    return found


def critical_stiffness(
    normal_force: ArrayLike,
    direct: ArrayLike,
    evolution: ArrayLike,
    distance: ArrayLike,
    *,
    mass: ArrayLike = 0.0,
    speed: ArrayLike = 0.0,
) -> RealArray:
    """Stiffness in N/m below which steady sliding with rate-and-state friction is unstable (Rice
    and Ruina 1983).

    k = N (b - a)/D [1 + M V²/(N a D)] with the ``direct`` effect a, the ``evolution`` effect b, the
    ``distance`` D in m, ``normal_force`` N in N, ``mass`` in kg and ``speed`` in m/s; arrays that
    fit together. Not above zero where the friction grows with the speed, b <= a: then sliding is
    stable at any stiffness.
    """
    N, a, b, D, M, V = (
        np.asarray(value, dtype=float) for value in (normal_force, direct, evolution, distance, mass, speed)
    )
    if np.any(~(a > 0.0)) or np.any(~(D > 0.0)) or np.any(~(N > 0.0)):
        raise InputError("normal force, direct effect and distance must be greater than zero, but some values are not.")
    found: RealArray = N * (b - a) / D * (1.0 + M * V**2 / (N * a * D))
    return found
