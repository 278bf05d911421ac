"""Persson's theory of rough contact: area and distribution of pressure; mean gap and stiffness from
``persson_gap``."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError, NoSolutionError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quadrature import gauss
from ...core.quantity import Quantity
from ...core.values import Number, Positive, Real, Several
from ..ask import PRESSURE, Way, asked
from ..protocol import (
    ISOTROPY,
    MEASURED_SLOPES,
    QUANTITIES,
    Bound,
    Modulus,
    Prediction,
    Theory,
    checked,
    curve,
    prediction,
    real_numbers,
)
from ..statistics.roughness import Roughness

if TYPE_CHECKING:
    from scipy.interpolate import CubicHermiteSpline


# Isotropic power spectrum as a table with power-law interpolation and closed-form integrals.


@dataclass(frozen=True, eq=False)
class IsotropicSpectrum:
    """C(q) of an isotropic surface from the first to the last wavenumber of a table, zero outside.

    Between neighbours of the table C is a power law, so that self-affine spectra need no more
    points than they have bends. Convention of Jacobs, Junge & Pastewka (2017), as everywhere here:
    <h²> = (1/2π) ∫ q C dq; papers with <h²> = 2π ∫ q C dq have C smaller by (2π)².

    InputError if the tables differ in length, are too short, not positive, or the wavenumbers do
    not ascend.

    Parameters
    ----------
    wavenumber
        q in rad/m, (n,), n >= 2, ascending, > 0.
    psd
        C in m⁴ at those wavenumbers, (n,), > 0.
    """

    wavenumber: ArrayLike
    psd: ArrayLike

    def __post_init__(self) -> None:
        q, level = np.array(self.wavenumber, dtype=float), np.array(self.psd, dtype=float)
        if q.ndim != 1 or q.shape != level.shape or q.size < 2:
            raise InputError(
                "spectrum must have two wavenumbers or more and as many values, but has arrays of shape "
                f"{q.shape} and {level.shape}."
            )
        for values, what in ((q, "wavenumbers (rad/m)"), (level, "values (m^4)")):
            if not (np.isfinite(values).all() and values.min() > 0.0):
                raise InputError(f"{what} of a spectrum must be positive and finite; leave out empty bands.")
        if not (np.diff(q) > 0.0).all():
            raise InputError("wavenumbers of a spectrum must ascend, but do not; sort the table.")
        for name, values in (("wavenumber", q), ("psd", level)):
            values.flags.writeable = False
            object.__setattr__(self, name, values)

    @cached_property
    def span(self) -> RealArray:
        """ln(q/q_L) of the table, (n,), from zero at its first wavenumber q_L."""
        return np.asarray(np.log(np.asarray(self.wavenumber) / np.asarray(self.wavenumber)[0]))

    @cached_property
    def exponents(self) -> RealArray:
        """d ln C/d ln q between neighbours, (n - 1,); -2(1 + H) of a self-affine surface."""
        return np.asarray(np.diff(np.log(np.asarray(self.psd))) / np.diff(self.span))

    def at(self, span: RealArray) -> RealArray:
        """C in m⁴ at ``span`` = ln(q/q_L) (any shape, inside the table)."""
        return np.asarray(np.exp(np.interp(span, self.span, np.log(np.asarray(self.psd)))))

    def partial_moment(self, order: int, span: RealArray) -> RealArray:
        """∫ q^order C dq from q_L to q_L exp(``span``), any shape, exact for the table.

        In the logarithm of q the integral keeps its digits next to q_L, where the upper limit
        differs little from it.
        """
        from scipy.special import exprel

        q, level = np.asarray(self.wavenumber), np.asarray(self.psd)
        starts = level[:-1] * q[:-1] ** (order + 1.0)
        powers = self.exponents + order + 1.0
        # the integral of exp(power t) up to a length is length * exprel(power * length), also for
        # power zero
        lengths = np.diff(self.span)
        whole = starts * (lengths * exprel(powers * lengths))
        below = np.concatenate([[0.0], np.cumsum(whole)])
        piece = np.clip(np.searchsorted(self.span, span, side="right") - 1, 0, self.exponents.size - 1)
        inside = np.minimum(span, self.span[-1]) - self.span[piece]
        return np.asarray(below[piece] + starts[piece] * (inside * exprel(powers[piece] * inside)))

    def graded(self, first: float, *, growth: float = 1.0) -> RealArray:
        """Ends of panels in ln(q/q_L) from zero to the end of the table, its points among them, for
        functions of ∫ q^n C dq from q_L.

        Such a function may change within any distance from q_L, and with it at all later ones in
        proportion to the distance: past the ``first`` panel (width > 0) none is wider than
        ``growth`` times its distance from q_L, an eighth of a decade, or half of the span in which
        C changes e-fold.
        """
        ends, t = [0.0], 0.0
        for last, power in zip(self.span[1:].tolist(), self.exponents.tolist(), strict=True):
            widest = min(_WIDEST, 0.5 / abs(power) if power else _WIDEST)
            while t < last:
                step = min(widest, max(growth * t, first))
                t = t + step if t + 1.01 * step < last else last  # no panel of rounding alone
                ends.append(t)
        return np.array(ends)

    def moment(self, order: int) -> float:
        """∫ q^order C dq over the whole table."""
        return float(self.partial_moment(order, self.span[-1:])[0])

    @property
    def rms_height(self) -> float:
        """Root mean square height in m: <h²> = (1/2π) ∫ q C dq."""
        return math.sqrt(self.moment(1) / (2.0 * math.pi))

    @property
    def rms_slope(self) -> float:
        """Root mean square gradient h'_rms of the surface: <|∇h|²> = (1/2π) ∫ q³ C dq, twice m2 of
        a profile."""
        return math.sqrt(self.moment(3) / (2.0 * math.pi))

    @property
    def profile_moments(self) -> tuple[float, float, float]:
        """m0 (m²), m2 and m4 (1/m²) of a profile."""
        m0, m2 = self.moment(1) / (2.0 * math.pi), self.moment(3) / (4.0 * math.pi)
        return m0, m2, 3.0 * self.moment(5) / (16.0 * math.pi)


# Persson's theory of the mean gap and of the stiffness of a rough contact, from the power spectrum.


CALIBRATED = 0.45
"""γ for which the gap agrees with boundary-element solutions within 7 % for 0.01 <= p/(E*
h'_rms) <= 0.2."""

_NODES = 12  # Gauss points of a panel
_WIDEST = 0.25  # of a panel in ln q
_FIRST = 1e-24  # of a panel in ln q: w has a square-root pole at q_L, its logarithm at low load
_GONE = 6.0  # exp(-x²) beyond it is below the rounding of one


@dataclass(frozen=True, eq=False)
class PerssonGap:
    """Mean gap and stiffness of an elastic half-space on a randomly rough rigid surface.

    The elastic energy U = (E* A_n/8π) ∫ q² S C dq of full contact is reduced by S = a [γ + (1 - γ)
    a²], a the area fraction at the wavenumber q, and dū = -dU/(A_n p) (Persson 2007; Yang & Persson
    2008). At low load p = β E* exp(-ū/u0).

    InputError if a number is out of its range.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    spectrum
        Spectrum of the composite surface.
    gamma
        0 < γ <= 1: 1 in the original form, whose gap is half too large at low load; 0.45
        calibrated.
    """

    E_star: float
    spectrum: IsotropicSpectrum
    gamma: float = CALIBRATED
    citation_keys: ClassVar[tuple[str, ...]] = ("Persson2007", "Yang2008")

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E* (Pa)")
        require.instance(self.spectrum, IsotropicSpectrum, "spectrum of a surface")
        require.within(self.gamma, 0.0, 1.0, "weight gamma of the elastic energy")

    @property
    def decay_length(self) -> float:
        """u0 = γ sqrt(π) ∫ q² C w dq in m (C of <h²> = 2π ∫ q C dq), by which the gap grows when p
        falls e-fold."""
        return self.gamma * float(self._weights.sum())

    @property
    def prefactor(self) -> float:
        """β of p = β E* exp(-ū/u0) at low load."""
        moment = float(self._weights @ np.log(self._sharpness)) / float(self._weights.sum())
        more = 3.0 * (1.0 - self.gamma) / self.gamma * float(_squared_erf_integral()(0.0))
        return math.exp(-0.5 * np.euler_gamma - moment + more)

    def mean_gap(self, pressure: ArrayLike) -> RealArray:
        """Mean gap ū in m at the mean ``pressure`` in Pa (> 0, any shape)."""
        from scipy.special import exp1

        loads, squares = self._relative(pressure), _squared_erf_integral()
        gap = np.empty(loads.size)
        for number, load in enumerate(loads.ravel()):
            x = np.minimum(self._sharpness * load, 26.0)  # exp(-26²) is zero
            inner = 0.5 * self.gamma * exp1(x**2) + 3.0 * (1.0 - self.gamma) * squares(np.minimum(x, _GONE))
            gap[number] = self._weights @ inner
        return gap.reshape(loads.shape)

    def stiffness(self, pressure: ArrayLike) -> RealArray:
        """-dp/dū in Pa/m at the mean ``pressure`` in Pa (> 0, any shape); p/u0 at low load."""
        from scipy.special import erf

        loads = self._relative(pressure)
        values = np.empty(loads.size)
        for number, load in enumerate(loads.ravel()):
            x = self._sharpness * load
            slope = self._weights @ ((self.gamma + 3.0 * (1.0 - self.gamma) * erf(x) ** 2) * np.exp(-(x**2)))
            values[number] = self.E_star * load / slope if slope > 0.0 else math.inf
        return values.reshape(loads.shape)

    def pressure_at(self, gap: float) -> float:
        """Mean pressure in Pa at the mean ``gap`` in m, > 0.

        NoSolutionError if the gap is so large or so small that the pressure cannot be represented.
        """
        from scipy.optimize import brentq

        wanted = math.log(require.positive(gap, "mean gap (m)"))
        low, high = -300.0, math.log(20.0 * self.spectrum.rms_slope)

        def difference(log_pressure: float) -> float:
            found = float(self.mean_gap(self.E_star * math.exp(log_pressure)))
            return (math.log(found) if found > 0.0 else -800.0) - wanted

        if not difference(low) > 0.0 > difference(high):
            raise NoSolutionError(
                f"mean gap (m) must be between about zero and 300 decay lengths of {self.decay_length:.3g} m, "
                f"but is {gap:g}."
            )
        return self.E_star * math.exp(brentq(difference, low, high, xtol=1e-12, rtol=1e-12))

    def _relative(self, pressure: ArrayLike) -> RealArray:
        values = real_numbers(pressure, "mean pressures (Pa)")
        if not (np.isfinite(values).all() and (values > 0.0).all()):
            raise InputError("mean pressure (Pa) must be greater than zero: without load the gap has no bound.")
        return np.asarray(values / self.E_star)

    @cached_property
    def _nodes(self) -> tuple[RealArray, RealArray]:
        """Gauss points in ln q/q_L and weights between the points of the table, ever finer panels
        towards the first."""
        return gauss(self.spectrum.graded(_FIRST, growth=3.0), _NODES)

    @cached_property
    def _sharpness(self) -> RealArray:
        """w(q) at the nodes: A/A_n = erf(w p/E*) with the waves from q_L to q; w² ∫ q³ C dq = 4π
        here."""
        return np.asarray(np.sqrt(4.0 * math.pi / self.spectrum.partial_moment(3, self._nodes[0])))

    @cached_property
    def _weights(self) -> RealArray:
        """sqrt(π) q² C w dq in m, in the convention <h²> = 2π ∫ q C dq of the theory, at the
        nodes."""
        spans, steps = self._nodes
        q = np.asarray(self.spectrum.wavenumber)[0] * np.exp(spans)
        level = self.spectrum.at(spans) / (2.0 * math.pi) ** 2
        return np.asarray(math.sqrt(math.pi) * q**3 * level * self._sharpness * steps)


def _squared_erf_integral() -> CubicHermiteSpline:
    """∫_x^∞ erf²(t) exp(-t²)/t dt for 0 <= x <= 6 within 1e-13: a Hermite spline through Gauss
    sums; 0.407125 at zero."""
    from scipy.interpolate import CubicHermiteSpline
    from scipy.special import erf

    edges = np.linspace(0.0, _GONE, 2001)
    t, weight = gauss(edges, 4)
    parts = (weight * erf(t) ** 2 * np.exp(-(t**2)) / t).reshape(-1, 4).sum(axis=1)
    beyond = np.concatenate([np.cumsum(parts[::-1])[::-1], [0.0]])
    slope = np.zeros_like(edges)
    slope[1:] = -(erf(edges[1:]) ** 2) * np.exp(-(edges[1:] ** 2)) / edges[1:]
    return CubicHermiteSpline(edges, beyond, slope)


APART = 2.0
"""Factor between the rms gradient of a surface and that of its spectrum beyond which the two are
not of one surface.

Differences of neighbouring points leave out up to 2/π of the shortest waves, and a radial spectrum
the waves in the corners of the grid: of random maps and of waves with noise the spectrum has 0.56
to 1.04 times the gradient that is measured.
"""

LOW_LOAD_SLOPE = math.sqrt(8.0 / math.pi)
"""κ = (A/A_n) E* h'_rms/p at vanishing load."""


@dataclass(frozen=True, eq=False, repr=False)
class LocalPressures(Tabled):
    """Distribution at local pressures (n,): probability ``density`` in 1/Pa, ``area_above`` the
    share with more."""

    density: RealArray
    area_above: RealArray


@dataclass(frozen=True, eq=False)
class Persson(Theory):
    """Area and pressure of an elastic half-space on a randomly rough rigid surface.

    Roughness of ever shorter waves is taken in turn; with each the density P of the pressure
    spreads as by diffusion, ∂P/∂ζ = f(ζ) ∂²P/∂p², and what reaches zero pressure is out of contact
    (Persson 2001; Persson et al. 2002). With the standard deviation s = E* h'_rms/2 of the pressure
    in full contact the solution is a Gaussian about the mean pressure p̄ less its image,

        P(p) = (1/(s sqrt(2 π))) [exp(-(p - p̄)²/(2 s²)) - exp(-(p + p̄)²/(2 s²))],
        A/A_a = erf[sqrt(2) p̄/(E* h'_rms)].

    Exact at full contact; below it the area is about 30 % too small at 2 % contact and 20 %
    at 20 %, against elasticity, and the same for every width of the spectrum.

    InputError if a parameter is not positive, or the spectrum cannot be used.
    """

    E_star: Modulus
    rms_gradient: Annotated[Positive, "rms gradient of the surface, sqrt(2 m2)"]
    q: Annotated[
        ArrayLike, Several(Number("rad/m", above=0.0)), "wavenumbers of the power spectrum, for the mean gap"
    ] = ()
    psd: Annotated[
        ArrayLike, Several(Number("power spectrum")), "power spectrum at those wavenumbers, m0 = (1/2π) ∫ q C dq"
    ] = ()
    gamma: Annotated[
        Real, Help("weight of the elastic energy in the mean gap, 1 in the original form", of="choice")
    ] = CALIBRATED
    name: ClassVar[str] = "persson"
    title: ClassVar[str] = "Persson"
    citation_keys: ClassVar[tuple[str, ...]] = ("Persson2001", "Persson2002", "Persson2007", "Yang2008")
    limits: ClassVar[tuple[Bound, ...]] = (
        Bound(
            "p/(E* h'_rms)",
            lambda theory, answer: (
                answer.pressure / (theory.E_star * theory.rms_gradient) if theory._has_spectrum else None
            ),
            0.01,
            0.2,
            "Yang2008",
            "The calibrated mean gap is within 7 % of elasticity inside these loads only.",
            of=("mean_gap", "stiffness"),
        ),
        MEASURED_SLOPES,
        ISOTROPY,
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(PRESSURE, "at_pressure", QUANTITIES),
        Way(
            asked("local", "Pa", "pressure at a point"),
            "at_local",
            (
                Quantity("density", "1/Pa", "probability density of the pressure at a point"),
                Quantity("area_above", "1", "share of the nominal area with more pressure"),
            ),
            (PRESSURE,),
            checked=False,
        ),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self._has_spectrum:
            held = self.gap.spectrum.rms_slope
            if not self.rms_gradient / APART <= held <= self.rms_gradient * APART:
                raise InputError(
                    f"rms gradient and spectrum must be those of one surface, but are {self.rms_gradient:.4g} "
                    f"and, by the spectrum, {held:.4g}: the area would follow the one and the gap the other. "
                    "Give IsotropicSpectrum(q, psd).rms_slope, q as 2π over the wavelength up to the shortest "
                    "wave, and psd in the convention m0 = (1/2π) ∫ q C dq."
                )

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *, gamma: float = CALIBRATED) -> Self:
        """Theory for ``roughness``: its m2, and its spectrum, less the bands without power, where
        it has one that holds these slopes."""
        found, slope = roughness.spectrum, roughness.rms_gradient
        if found is not None and np.count_nonzero(found.psd > 0.0) > 1:
            q, psd = found.q[found.psd > 0.0], found.psd[found.psd > 0.0]
            if slope / APART <= IsotropicSpectrum(q, psd).rms_slope <= slope * APART:
                return cls(E_star, slope, q, psd, gamma=gamma)
        return cls(E_star, slope, gamma=gamma)

    @cached_property
    def gap(self) -> PerssonGap:
        """Theory of the mean gap and the stiffness. InputError if there is no spectrum."""
        if not self._has_spectrum:
            raise InputError(
                "power spectrum must be given for the mean gap in Persson's theory, but is not: give q and psd."
            )
        return PerssonGap(self.E_star, IsotropicSpectrum(self.q, self.psd), self.gamma)

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Area, mean real pressure and, with a spectrum, mean gap and stiffness at ``pressure``
        (n,) in Pa, > 0."""
        p = curve(pressure, "pressures (Pa)", positive=True)
        known = {"area_fraction": self.area_fraction(p)}
        if self._has_spectrum:
            known |= {"mean_gap": self.gap.mean_gap(p), "stiffness": self.gap.stiffness(p)}
        return prediction(p, **known)

    @property
    def _has_spectrum(self) -> bool:
        return np.size(self.q) > 0 or np.size(self.psd) > 0

    @property
    def spread(self) -> float:
        """s = E* h'_rms/2 in Pa, standard deviation of the pressure in full contact."""
        return 0.5 * self.E_star * self.rms_gradient

    def area_fraction(self, pressure: ArrayLike) -> RealArray:
        """A/A_n at the mean ``pressure`` in Pa (>= 0, any shape): erf[sqrt(2) p/(E* h'_rms)]."""
        from scipy.special import erf

        return np.asarray(erf(checked(pressure, "pressure (Pa)") / (math.sqrt(2.0) * self.spread)))

    def pressure_for(self, area_fraction: float) -> float:
        """Mean pressure in Pa at which ``area_fraction`` (0 < … < 1) is in contact."""
        from scipy.special import erfinv

        area = require.between(area_fraction, 0.0, 1.0, "area fraction", "Full contact needs an infinite pressure.")
        return math.sqrt(2.0) * self.spread * float(erfinv(area))

    def pressure_density(self, local: ArrayLike, pressure: float) -> RealArray:
        """Density P in 1/Pa of the pressure ``local`` in Pa (>= 0, any shape) at the mean
        ``pressure`` in Pa.

        The integral over all pressures is the area fraction, that of p P the mean pressure; P ∝ p
        near zero.
        """
        nominal = require.not_negative(pressure, "mean pressure (Pa)")
        p, s = checked(local, "pressure (Pa)"), self.spread
        # a difference of Gaussians as one Gaussian times 1 - exp, which keeps its digits near zero
        # pressure
        front = np.exp(-((p - nominal) ** 2) / (2.0 * s**2)) / (math.sqrt(2.0 * math.pi) * s)
        return np.asarray(front * -np.expm1(-2.0 * p * nominal / s**2))

    def at_local(self, local: ArrayLike, pressure: float) -> LocalPressures:
        """Distribution of the pressure at ``local`` pressures in Pa (>= 0, any shape) under the
        mean ``pressure`` in Pa."""
        return LocalPressures(self.pressure_density(local, pressure), self.area_fraction_above(local, pressure))

    def area_fraction_above(self, local: ArrayLike, pressure: float) -> RealArray:
        """Share of the nominal area on which the pressure exceeds ``local`` in Pa (>= 0, any
        shape)."""
        from scipy.special import erfc

        nominal = require.not_negative(pressure, "mean pressure (Pa)")
        p, width = checked(local, "pressure (Pa)"), math.sqrt(2.0) * self.spread
        return np.asarray(0.5 * (erfc((p - nominal) / width) - erfc((p + nominal) / width)))


# Persson's diffusion of the pressure, solved by finite differences from one magnification to the
# next.


_REACH = 8.0  # standard deviations of the pressure beyond the mean at which the density is zero: exp(-32)
_DAMPED = 2  # first steps that are halved and implicit (Rannacher 1984), or the delta they start from rings


@dataclass(frozen=True, eq=False)
class PressureHistory:
    """Density of the pressure while shorter and shorter waves are taken into account.

    Attributes
    ----------
    wavenumber
        Shortest wave so far, q in rad/m, (m,), ascending.
    pressure
        Local pressure in Pa, (n,), from zero.
    density
        P in 1/Pa, (m, n), zero at zero pressure.
    """

    wavenumber: RealArray
    pressure: RealArray
    density: RealArray
    citation_keys: ClassVar[tuple[str, ...]] = ("Persson2001", "Persson2002", "Rannacher1984")

    @property
    def area_fraction(self) -> RealArray:
        """∫ P dp at each wavenumber, (m,)."""
        return np.asarray(self.density.sum(axis=1) * self.pressure[1])

    @property
    def mean_pressure(self) -> RealArray:
        """∫ p P dp in Pa at each wavenumber, (m,): the nominal pressure, whatever the roughness."""
        return np.asarray(self.density @ self.pressure * self.pressure[1])


def diffused_pressure(
    spectrum: IsotropicSpectrum,
    E_star: float,
    pressure: float,
    *,
    points: int = 1000,
    steps: int = 200,
) -> PressureHistory:
    """Solve ∂P/∂ζ = f(ζ) ∂²P/∂p², P = 0 at p = 0, from P = δ(p - p_a) without roughness, along the
    spectrum.

    f dζ = (E*²/16π) q³ C dq is half the growth of the variance of the pressure in full contact, so
    equal steps of the integral of q³ C are equal steps of time. Crank-Nicolson on ``points``
    pressures after a damped start; the error falls with the square of both numbers. It needs no
    image source, and so checks the closed form of ``Persson``.

    ``spectrum``: spectrum of the composite surface; ``E_star``: contact modulus E* in Pa, > 0;
    ``pressure``: nominal pressure p_a in Pa, > 0; ``points``: number of intervals of pressure, at
    least 20, between zero and beyond the last pressure that occurs; ``steps``: number of steps of
    equal variance, at least 4.

    InputError if a number is out of its range.
    """
    from scipy.linalg import solve_banded
    from scipy.optimize import brentq

    modulus = require.positive(E_star, "contact modulus E* (Pa)")
    nominal = require.positive(pressure, "nominal pressure (Pa)")
    count = require.integer(points, 20, "number of pressures")
    rounds = require.integer(steps, 4, "number of steps")
    variance = (0.5 * modulus * spectrum.rms_slope) ** 2
    # equal pressures from zero on, one of them the nominal pressure if it is not tiny
    highest = nominal + _REACH * math.sqrt(variance)
    interval = highest / count
    if nominal >= interval:
        interval = nominal / math.floor(nominal / interval)
    grid = interval * np.arange(math.ceil(highest / interval) + 1)
    # δ(p - p_a) shared between its neighbours on the grid so that its mean is right
    place = nominal / grid[1]
    below = min(round(place) if abs(place - round(place)) < 1e-6 else int(place), grid.size - 2)
    density = np.zeros_like(grid)
    density[below + 1] = max(0.0, place - below) / grid[1]
    density[below] = 1.0 / grid[1] - density[below + 1] if below > 0 else 0.0
    kept = [density]
    diffusion = 0.5 * variance / rounds / grid[1] ** 2  # of one step, in intervals²
    for number in range(rounds):
        implicit = number < _DAMPED
        for _ in range(2 if implicit else 1):
            share, step = (1.0, 0.5 * diffusion) if implicit else (0.5, diffusion)
            right = density[1:-1] + (1.0 - share) * step * np.diff(density, 2)
            bands = np.empty((3, right.size))  # of 1 - share × step × second difference
            bands[0], bands[1], bands[2] = -share * step, 1.0 + 2.0 * share * step, -share * step
            density = np.zeros_like(density)
            density[1:-1] = solve_banded((1, 1), bands, right)
        kept.append(density)
    # wavenumbers at which the integral of q³ C has grown by equal parts
    whole, last = spectrum.moment(3), float(spectrum.span[-1])
    inner = []
    for number in range(1, rounds):
        part = number / rounds * whole
        inner.append(
            brentq(
                lambda span, part=part: float(spectrum.partial_moment(3, np.array([span]))[0]) - part,
                0.0,
                last,
                xtol=1e-14,
            )
        )
    spans = np.array([0.0, *inner, last])
    wavenumbers = np.asarray(spectrum.wavenumber)[0] * np.exp(spans)
    return PressureHistory(wavenumbers, grid, np.stack(kept))
