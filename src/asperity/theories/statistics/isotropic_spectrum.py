"""Isotropic power spectrum as a table with power-law interpolation and closed-form integrals."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError


@dataclass(frozen=True, eq=False)
class IsotropicSpectrum:
    """C(q) of an isotropic surface from the first to the last wavenumber of a table, zero outside.

    Between neighbours of the table C is a power law, so that self-affine spectra need no more points than they have
    bends. Convention of Jacobs, Junge & Pastewka (2017), as everywhere here: <h²> = (1/2π) ∫ q C dq; papers with
    <h²> = 2π ∫ q C dq have C smaller by (2π)².

    InputError if the tables differ in length, are too short, not positive, or the wavenumbers do not ascend.

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

        In the logarithm of q the integral keeps its digits next to q_L, where the upper limit differs little from it.
        """
        q, level = np.asarray(self.wavenumber), np.asarray(self.psd)
        starts = level[:-1] * q[:-1] ** (order + 1.0)
        powers = self.exponents + order + 1.0
        whole = starts * _exponential_integral(powers, np.diff(self.span))
        below = np.concatenate([[0.0], np.cumsum(whole)])
        piece = np.clip(np.searchsorted(self.span, span, side="right") - 1, 0, self.exponents.size - 1)
        inside = np.minimum(span, self.span[-1]) - self.span[piece]
        return np.asarray(below[piece] + starts[piece] * _exponential_integral(powers[piece], inside))

    def moment(self, order: int) -> float:
        """∫ q^order C dq over the whole table."""
        return float(self.partial_moment(order, self.span[-1:])[0])

    @property
    def rms_height(self) -> float:
        """Root mean square height in m: <h²> = (1/2π) ∫ q C dq."""
        return math.sqrt(self.moment(1) / (2.0 * math.pi))

    @property
    def rms_slope(self) -> float:
        """Root mean square gradient h'_rms of the surface: <|∇h|²> = (1/2π) ∫ q³ C dq, twice m2 of a profile."""
        return math.sqrt(self.moment(3) / (2.0 * math.pi))

    @property
    def profile_moments(self) -> tuple[float, float, float]:
        """m0 (m²), m2 and m4 (1/m²) of a profile."""
        m0, m2 = self.moment(1) / (2.0 * math.pi), self.moment(3) / (4.0 * math.pi)
        return m0, m2, 3.0 * self.moment(5) / (16.0 * math.pi)


def _exponential_integral(power: RealArray, length: RealArray) -> RealArray:
    """∫₀^length exp(power t) dt, also for power zero."""
    from scipy.special import exprel

    return length * exprel(power * length)
