"""Persson's theory of the mean gap and of the stiffness of a rough contact, from the power spectrum."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError, NoSolutionError
from .isotropic_spectrum import IsotropicSpectrum

if TYPE_CHECKING:
    from scipy.interpolate import CubicHermiteSpline

CALIBRATED = 0.45
"""γ for which the gap agrees with boundary-element solutions within 7 % for 0.01 <= p/(E* h'_rms) <= 0.2."""

_NODES = 12  # Gauss points of a panel
_WIDEST = 0.25  # of a panel in ln q
_FINEST = 40  # quarterings of the first panel: w has a square-root pole at q_L, its logarithm at low load
_GONE = 6.0  # exp(-x²) beyond it is below the rounding of one


@dataclass(frozen=True, eq=False)
class PerssonGap:
    """Mean gap and stiffness of an elastic half-space on a randomly rough rigid surface.

    The elastic energy U = (E* A_n/16π) ∫ q² S C dq of full contact is reduced by S = a [γ + (1 - γ) a²], a the area
    fraction at the wavenumber q, and dū = -dU/(A_n p) (Persson 2007; Yang & Persson 2008). At low load
    p = β E* exp(-ū/u0).

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    spectrum
        Spectrum of the composite surface.
    gamma
        0 < γ <= 1: 1 in the original form, whose gap is half too large at low load; 0.45 calibrated.

    Raises
    ------
    InputError
        If a number is out of its range.
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
        """u0 = γ sqrt(π) ∫ q² C w dq in m (C of <h²> = 2π ∫ q C dq), by which the gap grows when p falls e-fold."""
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

        Raises
        ------
        NoSolutionError
            If the gap is so large or so small that the pressure cannot be represented.
        """
        from scipy.optimize import brentq

        wanted = math.log(require.positive(gap, "mean gap (m)"))
        low, high = -300.0, math.log(20.0 * self.spectrum.rms_slope)

        def difference(log_pressure: float) -> float:
            found = float(self.mean_gap(self.E_star * math.exp(log_pressure)))
            return (math.log(found) if found > 0.0 else -800.0) - wanted

        if not difference(low) > 0.0 > difference(high):
            raise NoSolutionError(
                f"mean gap (m) must be between about zero and 300 decay lengths of {self.decay_length:.3g} m, but is {gap:g}."
            )
        return self.E_star * math.exp(brentq(difference, low, high, xtol=1e-12, rtol=1e-12))

    def _relative(self, pressure: ArrayLike) -> RealArray:
        values = np.asarray(pressure, dtype=float)
        if not (np.isfinite(values).all() and (values > 0.0).all()):
            raise InputError("mean pressure (Pa) must be greater than zero: without load the gap has no bound.")
        return np.asarray(values / self.E_star)

    @cached_property
    def _nodes(self) -> tuple[RealArray, RealArray]:
        return _gauss_panels(self.spectrum.span)

    @cached_property
    def _sharpness(self) -> RealArray:
        """w(q) at the nodes: A/A_n = erf(w p/E*) with the waves from q_L to q; w² ∫ q³ C dq = 4π here."""
        values: RealArray = np.sqrt(4.0 * math.pi / self.spectrum.partial_moment(3, self._nodes[0]))
        return values

    @cached_property
    def _weights(self) -> RealArray:
        """sqrt(π) q² C w dq in m, in the convention <h²> = 2π ∫ q C dq of the theory, at the nodes."""
        spans, steps = self._nodes
        q = np.asarray(self.spectrum.wavenumber)[0] * np.exp(spans)
        level = self.spectrum.at(spans) / (2.0 * math.pi) ** 2
        values: RealArray = math.sqrt(math.pi) * q**3 * level * self._sharpness * steps
        return values


def _gauss_panels(table: RealArray) -> tuple[RealArray, RealArray]:
    """Gauss points and weights between the points of ``table``, ever finer panels towards the first."""
    panels = [np.linspace(a, b, max(1, math.ceil((b - a) / _WIDEST)) + 1)[1:] for a, b in pairwise(table)]
    edges = np.concatenate(panels)
    edges = np.concatenate([[0.0], edges[0] * 0.25 ** np.arange(_FINEST, 0, -1), edges])
    x, weight = np.polynomial.legendre.leggauss(_NODES)
    middle, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges)
    return (middle[:, None] + half[:, None] * x).ravel(), (half[:, None] * weight).ravel()


def _squared_erf_integral() -> CubicHermiteSpline:
    """∫_x^∞ erf²(t) exp(-t²)/t dt for 0 <= x <= 6 within 1e-13: a Hermite spline through Gauss sums; 0.407125 at zero."""
    from scipy.interpolate import CubicHermiteSpline
    from scipy.special import erf

    edges = np.linspace(0.0, _GONE, 2001)
    t, weight = np.polynomial.legendre.leggauss(4)
    half = 0.5 * (edges[1] - edges[0])
    nodes = (edges[:-1] + half)[:, None] + half * t
    parts = half * (erf(nodes) ** 2 * np.exp(-(nodes**2)) / nodes) @ weight
    beyond = np.concatenate([np.cumsum(parts[::-1])[::-1], [0.0]])
    slope = np.zeros_like(edges)
    slope[1:] = -(erf(edges[1:]) ** 2) * np.exp(-(edges[1:] ** 2)) / edges[1:]
    return CubicHermiteSpline(edges, beyond, slope)
