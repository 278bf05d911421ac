"""Law of a rough interface for dynamics: pressure and friction as powers of the approach (normal
compliance), and its fit to a contact curve."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.parameters import Declared
from ...core.values import NonNegative, Number, Positive

Exponent = Annotated[float, Number(least=0.5, most=10.0, fix="Metal joints have 2 to 3.3.")]


@dataclass(frozen=True)
class NormalCompliance(Declared):
    """Normal compliance with damping and friction (Oden and Martins 1985), for an approach δ > 0;
    without contact all is zero.

        p = c_n δ^{m_n} + b_n δ^{l_n} dδ/dt >= 0,   |τ| <= c_t δ^{m_t},
        μ = c_t δ^{m_t} / (c_n δ^{m_n}) = C p^α,
        α = m_t/m_n - 1,   C = c_t c_n^{-m_t/m_n}.

    Parameters
    ----------
    normal_coefficient
        c_n in Pa/m^{m_n}, > 0.
    normal_exponent
        m_n, 0.5 to 10.
    damping_coefficient
        b_n in Pa s/m^{l_n + 1}, >= 0.
    damping_exponent
        l_n; that of the pressure if not given.
    friction_coefficient
        c_t in Pa/m^{m_t}, >= 0.
    friction_exponent
        m_t; that of the pressure if not given, which is Amontons friction.

    Raises
    ------
    InputError
        If a parameter is out of its range.

    Notes
    -----
    The sign of the damping term is that of Oden and Martins (1985); Bhushan (1998) eq. 51 prints
    the opposite one.

    Examples
    --------
    >>> law = NormalCompliance.amontons(2.8e18, 2.0, friction=0.3)
    >>> f"{float(law.approach(50e3)):.4g} m"
    '1.336e-07 m'
    """

    normal_coefficient: Annotated[Positive, "c_n, pressure over the power of the approach, in Pa/m^m."]
    normal_exponent: Annotated[Exponent, "m_n, power of the approach."]
    damping_coefficient: Annotated[NonNegative, "b_n, in Pa s/m^(l+1)."] = 0.0
    damping_exponent: Annotated[Exponent | None, "l_n; m_n if not given."] = None
    friction_coefficient: Annotated[NonNegative, "c_t, in Pa/m^m."] = 0.0
    friction_exponent: Annotated[Exponent | None, "m_t; m_n if not given."] = None
    name: ClassVar[str] = "law of normal compliance"
    citation_keys: ClassVar[tuple[str, ...]] = ("Oden1985", "Martins1990")

    @classmethod
    def amontons(
        cls, normal_coefficient: float, normal_exponent: float, *, friction: float = 0.0, relative_damping: float = 0.0
    ) -> NormalCompliance:
        """Law with the friction coefficient ``friction`` at any pressure and b_n =
        ``relative_damping`` c_n, l_n = m_n.

        ``relative_damping`` in s/m: the pressure is c_n δ^m (1 + relative_damping dδ/dt).
        """
        mu, beta = (
            require.not_negative(friction, "friction"),
            require.not_negative(relative_damping, "relative damping"),
        )
        return cls(normal_coefficient, normal_exponent, beta * normal_coefficient, None, mu * normal_coefficient, None)

    @property
    def exponents(self) -> tuple[float, float, float]:
        """m_n, l_n, m_t."""
        m = self.normal_exponent
        return m, m if self.damping_exponent is None else self.damping_exponent, self.friction_power

    @property
    def friction_power(self) -> float:
        """m_t."""
        return self.normal_exponent if self.friction_exponent is None else self.friction_exponent

    def pressure(self, approach: ArrayLike, rate: ArrayLike = 0.0) -> RealArray:
        """p in Pa at ``approach`` δ in m and its ``rate`` in m/s, arrays that fit together; never
        negative."""
        m, ell, _ = self.exponents
        depth = np.maximum(np.asarray(approach, dtype=float), 0.0)
        found = self.normal_coefficient * depth**m + self.damping_coefficient * depth**ell * np.asarray(rate)
        return np.where(depth > 0.0, np.maximum(found, 0.0), 0.0)

    def friction(self, approach: ArrayLike) -> RealArray:
        """Largest shear traction in Pa at ``approach`` in m."""
        found: RealArray = (
            self.friction_coefficient * np.maximum(np.asarray(approach, dtype=float), 0.0) ** self.friction_power
        )
        return found

    def stiffness(self, approach: ArrayLike) -> RealArray:
        """dp/dδ in Pa/m at ``approach`` in m, without damping."""
        m, depth = self.normal_exponent, np.maximum(np.asarray(approach, dtype=float), 0.0)
        return m * self.normal_coefficient * _power(depth, m - 1.0)

    def friction_slope(self, approach: ArrayLike) -> RealArray:
        """d/dδ of the largest shear traction, Pa/m, at ``approach`` in m."""
        power, depth = self.friction_power, np.maximum(np.asarray(approach, dtype=float), 0.0)
        return power * self.friction_coefficient * _power(depth, power - 1.0)

    def energy(self, approach: ArrayLike) -> RealArray:
        """Elastic energy of the interface in J/m² at ``approach`` in m."""
        m, depth = self.normal_exponent, np.maximum(np.asarray(approach, dtype=float), 0.0)
        found: RealArray = self.normal_coefficient * depth ** (m + 1.0) / (m + 1.0)
        return found

    def approach(self, pressure: ArrayLike) -> RealArray:
        """Approach in m at rest under ``pressure`` >= 0 in Pa."""
        p = np.asarray(pressure, dtype=float)
        if np.any(~np.isfinite(p)) or np.any(p < 0.0):
            raise InputError(f"pressure (Pa) must be finite and at least zero, but its smallest is {np.min(p):g}.")
        found: RealArray = (p / self.normal_coefficient) ** (1.0 / self.normal_exponent)
        return found

    def coefficient(self, pressure: ArrayLike) -> RealArray:
        """Coefficient of friction C p^α at rest under ``pressure`` > 0 in Pa."""
        power = self.friction_power / self.normal_exponent
        level = self.friction_coefficient * self.normal_coefficient**-power
        found: RealArray = level * np.asarray(pressure, dtype=float) ** (power - 1.0)
        return found

    def damped(self, ratio: float, inertia: float, pressure: float) -> NormalCompliance:
        """This law with the damping ``ratio`` >= 0 of the normal oscillation of a mass per area
        ``inertia`` (kg/m²) about ``pressure`` (Pa).

        l_n = m_n; the ratio is b_n δ^m / (2 sqrt(dp/dδ inertia)).
        """
        ratio = require.not_negative(ratio, "damping ratio")
        depth = self.approach(require.positive(pressure, "pressure (Pa)"))
        critical = 2.0 * math.sqrt(float(self.stiffness(depth)) * require.positive(inertia, "mass per area (kg/m^2)"))
        return replace(
            self, damping_coefficient=float(ratio * critical / depth**self.normal_exponent), damping_exponent=None
        )

    def with_friction(self, friction: float) -> NormalCompliance:
        """This law with the friction coefficient ``friction`` >= 0 at any pressure."""
        mu = require.not_negative(friction, "friction")
        return replace(self, friction_coefficient=mu * self.normal_coefficient, friction_exponent=None)


def _power(depth: RealArray, exponent: float) -> RealArray:
    """``depth`` >= 0 to the power of ``exponent``; where that is negative, zero without contact."""
    if exponent >= 0.0:
        return np.asarray(depth**exponent)
    return np.where(depth > 0.0, np.where(depth > 0.0, depth, 1.0) ** exponent, 0.0)


def metal_joint(compliance: float, exponent: float = 2.0, *, friction: float = 0.0) -> NormalCompliance:
    """Law of a ground or turned metal joint, δ = c p^{1/m} (Back, Burdekin and Cowley 1973).

    ``compliance`` is c in µm/MPa^{1/m}, as that paper prints it: 0.3 to 1 for steel and iron with
    m = 2.
    """
    c = 1e-6 * require.positive(compliance, "compliance (um/MPa^(1/m))")
    return NormalCompliance.amontons(1e6 / c**exponent, exponent, friction=friction)


# From a contact curve.

FEWEST = 4
"""Points of a curve to which a power of the approach is fitted: one more than there are
parameters."""


@dataclass(frozen=True, eq=False)
class ComplianceFit:
    """A power law of the approach, fitted to a curve of pressure against approach.

    Attributes
    ----------
    law
        The law, without damping; with the friction of the curve, if that was given.
    offset
        Approach g in m at which the law begins: p = c_n (u - g)^{m_n}.
    exponent_error
        Standard error of m_n from the scatter about the law.
    offset_error
        Standard error of g in m; 0 where it was given.
    largest_error
        Largest relative difference between the pressures of law and curve.
    stiffness_exponent
        ζ of the tangent stiffness dp/du ∝ p^ζ of the law, 1 - 1/m_n: 1 for an exponential curve.
    approach, pressure
        The points, (n,) in m and Pa, in ascending order of the pressure.
    """

    law: NormalCompliance
    offset: float
    exponent_error: float
    offset_error: float
    largest_error: float
    approach: RealArray
    pressure: RealArray

    @property
    def stiffness_exponent(self) -> float:
        """ζ of dp/du ∝ p^ζ."""
        return 1.0 - 1.0 / self.law.normal_exponent

    @property
    def span(self) -> tuple[float, float]:
        """Smallest and largest pressure of the fit in Pa, outside which the law is not known."""
        return float(self.pressure[0]), float(self.pressure[-1])

    def fitted(self, approach: ArrayLike) -> RealArray:
        """Pressure of the law in Pa at ``approach`` in m, counted as that of the curve."""
        return self.law.pressure(np.asarray(approach, dtype=float) - self.offset)


def fit_compliance(
    approach: ArrayLike,
    pressure: ArrayLike,
    *,
    offset: float | None = None,
    shear: ArrayLike | None = None,
) -> ComplianceFit:
    """Law of normal compliance that a contact curve follows, by least squares of ln p.

    Parameters
    ----------
    approach
        u, (n,) in m, n >= 4, in any order, all different: approach of the mean planes, from first
        touch or anywhere else.
    pressure
        Mean pressure (n,) in Pa, > 0, that grows with the approach.
    offset
        Approach in m at which the law begins: 0 for first touch, where contact is lost in motion;
        fitted if not given. The pressure on a rough surface grows nearly exponentially: a fitted
        offset follows it over a wider range, with an exponent that grows with that range and has no
        limit.
    shear
        Largest mean shear traction (n,) in Pa at the same points, >= 0, for a law of friction: for
        Amontons friction μ p, for a shear strength of the real contact that times the area
        fraction.

    Returns
    -------
    ComplianceFit

    Raises
    ------
    InputError
        If there are too few points, the shapes differ, the pressure does not grow with the
        approach, or no power law with an exponent of 0.5 to 10 fits.

    Notes
    -----
    With a given offset ln p is linear in ln(u - g). Otherwise g is found by a search in one
    variable on (-∞, min u), through s = ln(min u - g), and the errors are those of the linearised
    fit of all three parameters.
    """
    u, p = np.asarray(approach, dtype=float), np.asarray(pressure, dtype=float)
    order = np.argsort(p)
    if u.ndim != 1 or u.shape != p.shape or u.size < FEWEST:
        raise InputError(
            f"approach and pressure must be one-dimensional, of one length and have at least {FEWEST} points, "
            f"but have the shapes {u.shape} and {p.shape}."
        )
    if not (np.isfinite(u).all() and np.isfinite(p).all() and (p > 0.0).all()):
        raise InputError("approach must be finite and pressure greater than zero at every point, but some are not.")
    u, p = u[order], p[order]
    if np.any(np.diff(u) <= 0.0) or np.any(np.diff(p) <= 0.0):
        raise InputError("pressure must grow with the approach from point to point, but does not.")
    if offset is None:
        g = _best_offset(u, np.log(p))
    else:
        g = require.finite(offset, "offset (m)")
        if g >= u[0]:
            raise InputError(f"offset (m) must be below the smallest approach, {u[0]:g}, but is {offset!r}.")
    slope, level, scatter = _line(np.log(u - g), np.log(p))
    if not 0.5 <= slope <= 10.0:
        raise InputError(
            "power of the approach that the pressure follows must be 0.5 to 10 for a law of normal "
            f"compliance, but is {slope:.3g}. Fit a smaller range of pressures, or give the offset."
        )
    # standard errors from the linearised fit of ln p = ln c + m ln(u - g)
    columns, scale = [np.ones_like(u), np.log(u - g)], float(u[-1] - u[0])
    if offset is None:
        columns.append(-slope * scale / (u - g))
    linear = np.stack(columns, axis=1)
    covariance = np.linalg.pinv(linear.T @ linear) * scatter / (u.size - len(columns))
    exponent_error = math.sqrt(abs(covariance[1, 1]))
    offset_error = math.sqrt(abs(covariance[2, 2])) * scale if offset is None else 0.0
    law = NormalCompliance(math.exp(level), slope)
    if shear is not None:
        tau = np.asarray(shear, dtype=float)
        if tau.shape != u.shape or not np.isfinite(tau).all() or np.any(tau < 0.0):
            raise InputError("shear must hold one finite value >= 0 for each point of the curve, but does not.")
        if tau.any() and not tau.all():
            raise InputError("shear must be zero at all points of the curve or at none, but is zero at some.")
        if tau.any():
            power, level, _ = _line(np.log(u - g), np.log(tau[order]))
            law = replace(law, friction_coefficient=math.exp(level), friction_exponent=power)
    misfit = float(np.max(np.abs(law.pressure(u - g) / p - 1.0)))
    return ComplianceFit(law, g, exponent_error, offset_error, misfit, u, p)


def _line(x: RealArray, y: RealArray) -> tuple[float, float, float]:
    """Slope, value at zero and sum of the squared residuals of the line through (x, y)."""
    mean_x, mean_y = float(x.mean()), float(y.mean())
    centred = x - mean_x
    slope = float(centred @ (y - mean_y) / (centred @ centred))
    level = mean_y - slope * mean_x
    residual = y - level - slope * x
    return slope, level, float(residual @ residual)


def _best_offset(u: RealArray, log_p: RealArray) -> float:
    """g with the least scatter of ln p about a line in ln(u - g), for exponents up to 10."""
    from scipy.optimize import minimize_scalar

    span = float(u[-1] - u[0])

    def scatter(s: float) -> float:
        return _line(np.log(u - u[0] + span * math.exp(s)), log_p)[2]

    # the distance of g from the first point, from 1e-6 to 100 of the range of approaches; the best
    # of a scan is refined
    scan = np.linspace(math.log(1e-6), math.log(1e2), 60)
    values = [scatter(float(s)) for s in scan]
    best = int(np.argmin(values))
    low, high = scan[max(best - 1, 0)], scan[min(best + 1, scan.size - 1)]
    found = minimize_scalar(scatter, bounds=(low, high), method="bounded", options={"xatol": 1e-10})
    return float(u[0] - span * math.exp(float(found.x)))
