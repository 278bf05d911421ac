"""Relaxation and creep of linear viscoelastic solids as Prony series, and the exact conversion
between the two.

E(t) = E_inf + sum E_k exp(-t/tau_k),   J(t) = J_0 + sum J_k (1 - exp(-t/lambda_k)) + phi t,
∫ E(t - s) J(s) ds = t.

In the operational form s E(s), a rational function, E has the poles -1/tau_k and, between them, one
simple zero each, -1/lambda_k: the poles of J. Zeros are found by bracketing (Park & Schapery 1999),
so that the conversion is exact to rounding.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import ComplexArray, RealArray
from ..core.errors import InputError

Terms: TypeAlias = tuple[tuple[float, float], ...]
"""Strength and time (s) of each term of a series, by rising times."""

_SAME_TIME = 1e-9
"""Relative difference of two times below which their terms are one."""


def merged(terms: Iterable[tuple[float, float]]) -> Terms:
    """``terms`` by rising times, those of equal time as one, those without strength left out."""
    found: list[tuple[float, float]] = []
    for strength, time in sorted(terms, key=lambda term: term[1]):
        if strength == 0.0:
            continue
        if found and time <= found[-1][1] * (1.0 + _SAME_TIME):
            found[-1] = (found[-1][0] + strength, found[-1][1])
        else:
            found.append((float(strength), float(time)))
    return tuple(found)


def _checked(terms: Iterable[tuple[float, float]], what: str) -> Terms:
    pairs = []
    for term in terms:
        strength, time = require.two(term, f"term of {what}", "Give pairs of strength and time in s.")
        require.not_negative(strength, f"strength of a term of {what}")
        pairs.append((float(strength), require.positive(time, f"time of a term of {what} (s)")))
    return merged(pairs)


@dataclass(frozen=True)
class Relaxation:
    """Modulus E(t) after a step of strain.

    Parameters
    ----------
    relaxed
        E_inf in Pa, >= 0; zero for a fluid.
    terms
        Pairs (E_k in Pa, >= 0; tau_k in s, > 0); equal times are merged.

    Raises
    ------
    InputError
        If a value is outside its range, or all moduli are zero.
    """

    relaxed: float
    terms: Terms = ()

    def __post_init__(self) -> None:
        require.not_negative(self.relaxed, "relaxed modulus (Pa)")
        object.__setattr__(self, "terms", _checked(self.terms, "a relaxation"))
        if not self.instantaneous > 0.0:
            raise InputError("modulus of a relaxation must be greater than zero at time zero, but is 0.")

    @property
    def instantaneous(self) -> float:
        """E(0) in Pa, the glassy modulus."""
        return self.relaxed + sum(strength for strength, _ in self.terms)

    def at(self, time: ArrayLike) -> RealArray:
        """E(t) in Pa at ``time`` >= 0 (s)."""
        t = np.asarray(time, dtype=float)
        found = np.full(t.shape, self.relaxed)
        for strength, tau in self.terms:
            found = found + strength * np.exp(-t / tau)
        return found

    def operational(self, s: ArrayLike) -> ComplexArray:
        """s E(s) in Pa at complex ``s`` (1/s); at s = i omega the complex modulus."""
        x = np.asarray(s, dtype=complex)
        found = np.full(x.shape, complex(self.relaxed))
        for strength, tau in self.terms:
            found = found + strength * (x * tau / (1.0 + x * tau))
        return found

    def complex_modulus(self, omega: ArrayLike) -> ComplexArray:
        """E(omega) in Pa at the angular frequency ``omega`` (rad/s) for the time dependence exp(+i
        omega t): loss is positive for omega > 0."""
        return self.operational(1j * np.asarray(omega, dtype=float))

    def times(self, factor: float) -> Relaxation:
        """The same with all moduli times ``factor``."""
        return Relaxation(self.relaxed * factor, tuple((strength * factor, tau) for strength, tau in self.terms))

    def shifted(self, factor: float) -> Relaxation:
        """The same with all times times ``factor``."""
        return Relaxation(self.relaxed, tuple((strength, tau * factor) for strength, tau in self.terms))

    @property
    def creep(self) -> Creep:
        """Its creep, exact. The zeros of E_inf - sum E_k tau_k/(lambda - tau_k) are the retardation
        times lambda_k."""
        strengths, taus = (
            (np.array(column) for column in zip(*self.terms, strict=True)) if self.terms else (_NONE, _NONE)
        )
        weights = strengths * taus

        def rising(distances: RealArray) -> float:  # from minus to plus infinity between two of the times
            return self.relaxed - float((weights / distances).sum())

        zeros = [
            _zero_between(taus, i, float(a), float(b), rising) for i, (a, b) in enumerate(itertools.pairwise(taus))
        ]
        if self.relaxed > 0.0 and taus.size:  # one above all times
            width = float(taus[-1])
            while rising(taus[-1] + width - taus) < 0.0:
                width *= 4.0
            zeros.append(_zero_from(taus, taus.size - 1, 1.0, width, rising))
        terms = [(1.0 / (lam * float((weights / distances**2).sum())), lam) for lam, distances in zeros]
        fluidity = 0.0 if self.relaxed > 0.0 else 1.0 / float(weights.sum())
        return Creep(1.0 / self.instantaneous, tuple(terms), fluidity)


@dataclass(frozen=True)
class Creep:
    """Compliance J(t) after a step of stress.

    Parameters
    ----------
    instantaneous
        J_0 in 1/Pa, > 0.
    terms
        Pairs (J_k in 1/Pa, >= 0; retardation time lambda_k in s, > 0); equal times are merged.
    fluidity
        phi in 1/(Pa s), >= 0; zero for a solid.

    Raises
    ------
    InputError
        If a value is outside its range.
    """

    instantaneous: float
    terms: Terms = ()
    fluidity: float = 0.0

    def __post_init__(self) -> None:
        require.positive(self.instantaneous, "instantaneous compliance (1/Pa)")
        require.not_negative(self.fluidity, "fluidity (1/(Pa s))")
        object.__setattr__(self, "terms", _checked(self.terms, "a creep"))

    @property
    def relaxed(self) -> float:
        """J after all retardation, 1/Pa; infinite for a fluid."""
        return math.inf if self.fluidity else self.instantaneous + sum(strength for strength, _ in self.terms)

    def at(self, time: ArrayLike) -> RealArray:
        """J(t) in 1/Pa at ``time`` >= 0 (s)."""
        t = np.asarray(time, dtype=float)
        found = self.instantaneous + self.fluidity * t
        for strength, lam in self.terms:
            found = found - strength * np.expm1(-t / lam)
        return np.asarray(found)

    def operational(self, s: ArrayLike) -> ComplexArray:
        """s J(s) in 1/Pa at complex ``s`` (1/s); at s = i omega the complex compliance. A fluid has
        none at s = 0."""
        x = np.asarray(s, dtype=complex)
        found = np.full(x.shape, complex(self.instantaneous))
        for strength, lam in self.terms:
            found = found + strength / (1.0 + x * lam)
        return np.asarray(found + self.fluidity / x) if self.fluidity else found

    def complex_compliance(self, omega: ArrayLike) -> ComplexArray:
        """J(omega) in 1/Pa at the angular frequency ``omega`` (rad/s) for the time dependence
        exp(+i omega t)."""
        return self.operational(1j * np.asarray(omega, dtype=float))

    def times(self, factor: float) -> Creep:
        """The same with all compliances times ``factor``."""
        terms = tuple((strength * factor, lam) for strength, lam in self.terms)
        return Creep(self.instantaneous * factor, terms, self.fluidity * factor)

    def __add__(self, other: Creep) -> Self:
        """Compliance of two solids under the same stress; terms of equal times are merged."""
        return type(self)(
            self.instantaneous + other.instantaneous, (*self.terms, *other.terms), self.fluidity + other.fluidity
        )

    @property
    def relaxation(self) -> Relaxation:
        """Its relaxation, exact. The zeros of J_0 + sum J_k tau/(tau - lambda_k) - phi tau are the
        relaxation times tau_k."""
        strengths, lams = (
            (np.array(column) for column in zip(*self.terms, strict=True)) if self.terms else (_NONE, _NONE)
        )
        weights, rising = strengths * lams, self.instantaneous + float(strengths.sum())
        zeros = _zeros_below(
            lams,
            lambda distances, tau: self.fluidity * tau - rising - float((weights / distances).sum()),
            last=rising / self.fluidity if self.fluidity else None,
        )
        terms = [(1.0 / (tau * (float((weights / d**2).sum()) + self.fluidity)), tau) for tau, d in zeros]
        return Relaxation(0.0 if self.fluidity else 1.0 / rising, tuple(terms))


_NONE = np.empty(0)


def _zero_between(
    poles: RealArray, number: int, low: float, high: float, function: Callable[[RealArray], float]
) -> tuple[float, RealArray]:
    """Zero between ``low`` and ``high``, measured from the nearer pole, whose distance is then
    exact."""
    half = 0.5 * (high - low)
    if function(low + half - poles) >= 0.0:
        return _zero_from(poles, number, 1.0, half, function)
    return _zero_from(poles, number + 1, -1.0, half, function)


def _zero_from(
    poles: RealArray, number: int, sign: float, farthest: float, function: Callable[[RealArray], float]
) -> tuple[float, RealArray]:
    """Zero at most ``farthest`` from the pole of this ``number``, above it or with ``sign`` -1
    below it, in the logarithm of its distance."""
    from scipy.optimize import brentq

    def distances(log: float) -> RealArray:
        by = poles[number] - poles
        by = by + sign * math.exp(log)
        by[number] = sign * math.exp(log)
        return np.asarray(by)

    high = math.log(farthest)
    low = high - 1.0
    while sign * function(distances(low)) > 0.0:
        low -= 2.0 * (high - low)
    # at the middle between two poles the sign may be that of rounding
    log = (
        high
        if sign * function(distances(high)) <= 0.0
        else brentq(lambda x: function(distances(x)), low, high, xtol=1e-15)
    )
    return float(poles[number] + sign * math.exp(log)), distances(log)


def _zeros_below(
    poles: RealArray, function: Callable[[RealArray, float], float], *, last: float | None
) -> list[tuple[float, RealArray]]:
    """Zeros of a ``function`` of the distances to the poles and the place, one below each pole and,
    with ``last``, one above that place."""
    placed = poles.copy()

    def at(distances: RealArray) -> float:
        return function(distances, float(placed[0] + distances[0]))

    if not poles.size:
        return [] if last is None else [(last, _NONE)]
    found = []
    first = 0.5 * float(poles[0])
    while at(first - poles) > 0.0:
        first *= 0.25
    found.append(_zero_from(poles, 0, -1.0, float(poles[0]) - first, at))
    for number, (low, high) in enumerate(itertools.pairwise(poles)):
        found.append(_zero_between(poles, number, float(low), float(high), at))
    if last is not None:
        width = max(last, float(poles[-1]))
        while at(poles[-1] + width - poles) < 0.0:
            width *= 4.0
        found.append(_zero_from(poles, poles.size - 1, 1.0, width, at))
    return found


# Series through values measured at some times: a fixed grid of times, strengths by non-negative
# least squares (Lawson & Hanson 1974).

_MOST_TERMS = 400
"""Terms of a series that is fitted."""

NEGLIGIBLE = 1e-12
"""Strength of a term over the largest below which it is left out of a fit: rounding."""


def require_terms(decades: float, per_decade: int) -> None:
    """Refuse a series of more than 400 terms. InputError if ``per_decade`` terms over ``decades``
    are more."""
    if not decades * per_decade <= _MOST_TERMS:
        raise InputError(
            f"number of terms of a fitted series must be at most {_MOST_TERMS}, but is "
            f"{decades * per_decade:.3g}: {per_decade} a decade over {decades:.3g} decades. Take fewer a "
            "decade, or a narrower band."
        )


def relaxation_through(time: ArrayLike, modulus: ArrayLike, *, per_decade: int = 4, fluid: bool = False) -> Relaxation:
    """Relaxation through the moduli (n,), Pa, > 0, measured at ``time`` (n,), s, > 0.

    Relaxation times stand ``per_decade`` to a decade from the shortest measured time to ten times
    the longest, since what relaxes later shows as a slope; strengths >= 0 make the sum of the
    squares of the relative differences least. A ``fluid`` has no constant. InputError if the
    columns do not fit together, hold values out of range, or the modulus rises from the first to
    the last time.
    """
    t, values = _measured(time, modulus, "relaxation modulus", "Pa")
    if not values[-1] <= values[0]:
        raise InputError(
            f"relaxation modulus must fall with time, but rises from {values[0]:.6g} Pa at {t[0]:.6g} s to "
            f"{values[-1]:.6g} Pa at {t[-1]:.6g} s. Check which column is which; a compliance rises."
        )
    taus = _times(t, per_decade)
    columns = np.hstack([np.exp(-t[:, None] / taus), np.full((t.size, 1), 0.0 if fluid else 1.0)])
    *strengths, relaxed = _strengths(columns, values)
    return Relaxation(relaxed, tuple(zip(strengths, map(float, taus), strict=True)))


def creep_through(time: ArrayLike, compliance: ArrayLike, *, per_decade: int = 4, fluid: bool = False) -> Creep:
    """Creep through the compliances (n,), 1/Pa, > 0, measured at ``time`` (n,), s, > 0.

    As :func:`relaxation_through`; a ``fluid`` has a fluidity beside its terms. InputError if the
    columns do not fit together, hold values out of range, the compliance falls from the first to
    the last time, or nothing of it is there at the first instant.
    """
    t, values = _measured(time, compliance, "creep compliance", "1/Pa")
    if not values[-1] >= values[0]:
        raise InputError(
            f"creep compliance must rise with time, but falls from {values[0]:.6g} 1/Pa at {t[0]:.6g} s to "
            f"{values[-1]:.6g} 1/Pa at {t[-1]:.6g} s. Check which column is which; a modulus falls."
        )
    lams = _times(t, per_decade)
    flow = t[:, None] / t[-1] if fluid else np.zeros((t.size, 1))
    columns = np.hstack([-np.expm1(-t[:, None] / lams), np.ones((t.size, 1)), flow])
    *strengths, instantaneous, flowed = _strengths(columns, values)
    if not instantaneous > 0.0:
        raise InputError(
            f"creep compliance must have a part at the first instant, but the {values[0]:.6g} 1/Pa at {t[0]:.6g} s "
            "have grown from zero. Measure from a shorter time on."
        )
    return Creep(instantaneous, tuple(zip(strengths, map(float, lams), strict=True)), flowed / float(t[-1]))


def _measured(time: ArrayLike, values: ArrayLike, what: str, unit: str) -> tuple[RealArray, RealArray]:
    """Both columns by rising times."""
    t, found = (np.atleast_1d(np.asarray(column, dtype=float)) for column in (time, values))
    if not (t.ndim == 1 and t.shape == found.shape and t.size >= 2):
        raise InputError(
            f"time and {what} must be columns of the same length of at least 2, but have the shapes {t.shape} and "
            f"{found.shape}."
        )
    if not (np.isfinite(t).all() and t.min() > 0.0 and np.unique(t).size == t.size):
        raise InputError(f"times (s) of a {what} must be finite, positive and different from each other.")
    if not (np.isfinite(found).all() and found.min() > 0.0):
        raise InputError(f"{what} ({unit}) must be positive and finite at all times.")
    order = np.argsort(t)
    return t[order], found[order]


def _times(t: RealArray, per_decade: int) -> RealArray:
    """Times of the terms for measurements at the rising times ``t``."""
    count = require.integer(per_decade, 1, "number of terms a decade")
    decades = math.log10(t[-1] / t[0]) + 1.0
    require_terms(decades, count)
    return np.asarray(t[0] * 10.0 ** (np.arange(math.ceil(decades * count - 1e-9) + 1) / count))


def not_negative(columns: RealArray, values: RealArray) -> RealArray:
    """Numbers >= 0 (n,) by which the ``columns`` (m, n) add up closest to the ``values`` (m,)."""
    from scipy.optimize import nnls

    found, _ = nnls(columns, values, maxiter=100 * columns.shape[1])
    return np.asarray(found)


def _strengths(columns: RealArray, values: RealArray) -> list[float]:
    """Strengths >= 0 of the ``columns`` whose sum is closest to the ``values``, relative to
    these."""
    found = not_negative(columns / values[:, None], np.ones(values.size))
    return [float(strength) for strength in np.where(found > NEGLIGIBLE * found.max(), found, 0.0)]
