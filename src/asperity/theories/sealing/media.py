"""Flow through media of many gaps: bounds and effective medium from the distribution of the gap, an
array of obstacles, and the constriction that decides in a rough contact."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from statistics import NormalDist
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Fraction, Number, Real, Several
from ..ask import PRESSURE, Way, asked
from ..protocol import Bound, Modulus, Theory, bisected, checked, curve
from ..rough.persson import CALIBRATED, IsotropicSpectrum, PerssonGap
from .gaps import Bounds

PERCOLATION = 0.42
"""Contact fraction at which contacts of rough surfaces close the gap in calculations (Dapp et al.
2012)."""


def layer_bounds(gap: RealArray, weights: RealArray | None = None) -> Bounds:
    """K of the ``gap`` (any shape, m) in layers across and along the flow: 1/<g⁻³> and <g³>; no
    statistically even arrangement is beyond them. ``weights`` are their shares; equal by default.
    """
    cubes = np.asarray(gap, np.float64) ** 3
    share = None if weights is None else np.asarray(weights, np.float64)
    counted = cubes if share is None else cubes[share > 0.0]
    least = 0.0 if (counted <= 0.0).any() else 1.0 / float(np.average(1.0 / cubes, weights=share))
    return Bounds(least, float(np.average(cubes, weights=share)))


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

    Examples
    --------
    >>> round(bruggeman([1.0, 4.0]), 12)
    8.0
    """
    cubes = np.asarray(gap, np.float64).ravel() ** 3
    share = np.full(cubes.size, 1.0 / cubes.size) if weights is None else np.asarray(weights, float).ravel()
    share = share / share.sum()
    if share[cubes <= 0.0].sum() >= 0.5:
        return 0.0
    scale = float(cubes.max())
    cubes = cubes / scale
    low, high = math.log(float(cubes[cubes > 0.0].min())) - 60.0, 0.0
    at = 0.5 * (low + high) if share[cubes <= 0.0].any() else float((share * np.log(cubes)).sum())
    for _ in range(ROUNDS):  # Newton steps in ln K within a bracket
        K = math.exp(at)
        excess = float((share * (cubes - K) / (cubes + K)).sum())
        low, high = (at, high) if excess > 0.0 else (low, at)
        slope = float((share * 2.0 * cubes * K / (cubes + K) ** 2).sum())
        step = at + excess / slope if slope > 0.0 else math.inf
        before, at = at, step if low <= step <= high else 0.5 * (low + high)
        if abs(at - before) <= TOLERANCE:
            break
    return math.exp(at) * scale


ROUNDS, TOLERANCE = 100, 1e-15
"""Newton steps of an effective medium at most, and the change of ln K at which they end."""


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

    Examples
    --------
    >>> round(obstacle_array(0.5), 6)
    0.324654
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
            system[n - 1, m - 1] = math.comb(k - 1, 2 * n - 1) * radius**k * sums[k]
        system[n - 1, n - 1] += 1.0
    scaled = np.linalg.solve(system, right)
    return float(1.0 - 2.0 * np.pi * scaled[0] * radius)


def lattice_sums(largest: int) -> RealArray:
    """(largest + 1,) sums of (x + iy)^-k over the points of the square lattice but the origin, zero
    unless 4 divides k; k = 2, which depends on the shape of the whole, is π, that of a strip across
    the gradient.

    From the invariants of Weierstrass' function: with c_n = (2n - 1) S_2n the recurrence
    c_n = 3/((2n + 1)(n - 3)) Σ_m c_m c_(n-m).
    """
    sums = np.zeros(max(largest, 4) + 1)
    sums[2] = np.pi
    sums[4] = math.gamma(0.25) ** 8 / (960.0 * np.pi**2)
    coefficients = {2: 3.0 * sums[4], 3: 0.0}
    for n in range(4, largest // 2 + 1):
        total = sum(coefficients[m] * coefficients[n - m] for m in range(2, n - 1))
        coefficients[n] = 3.0 * total / ((2 * n + 1) * (n - 3))
        sums[2 * n] = coefficients[n] / (2 * n - 1)
    return sums


# Theories of the catalogue.


@dataclass(frozen=True, eq=False)
class EffectiveMedium(Theory):
    """An even mixture of gaps g_i of any shape with shares f_i of the area, by Bruggeman, between
    layers across and along the flow:

        Σ f_i (g_i³ - K)/(g_i³ + K) = 0.

    InputError if a gap or share is negative, all are zero, or their numbers differ.
    """

    gap: Annotated[ArrayLike, Several(Number("length", least=0.0)), "gaps g, zero in contact"] = field(repr=False)
    share: Annotated[ArrayLike, Several(Number(least=0.0)), "shares of the area of each gap; equal if left out"] = (
        field(default=(), repr=False)
    )
    name: ClassVar[str] = "effective-medium"
    title: ClassVar[str] = "Bruggeman, effective medium of gaps"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bruggeman1935", "Keller1964", "Dykhne1971")
    limits: ClassVar[tuple[Bound, ...]] = ()
    ways: ClassVar[tuple[Way, ...]] = ()
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("transmissivity", "m**3", "transmissivity of the mixture"),
        Quantity("lower", "m**3", "transmissivity of layers across the flow"),
        Quantity("upper", "m**3", "transmissivity of layers along the flow"),
        Quantity("equivalent_gap", "m", "even gap that lets as much through"),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        gaps, shares = np.atleast_1d(np.asarray(self.gap, float)), np.asarray(self.share, float)
        if shares.size and shares.shape != gaps.shape:
            raise InputError(f"gaps and their shares must be as many, but are {gaps.size} and {shares.size}.")
        if not gaps.any() or (shares.size and not (shares * gaps).any()):
            raise InputError("gaps of an effective medium must hold one above zero, but hold none.")

    @property
    def _weights(self) -> RealArray | None:
        return np.asarray(self.share, float) if np.size(self.share) else None

    @property
    def transmissivity(self) -> float:
        """K in m³; zero from a contact fraction of one half on."""
        return bruggeman(np.asarray(self.gap, float), self._weights)

    @property
    def lower(self) -> float:
        """1/<g⁻³> in m³."""
        return layer_bounds(np.atleast_1d(np.asarray(self.gap, float)), self._weights).lower

    @property
    def upper(self) -> float:
        """<g³> in m³."""
        return layer_bounds(np.atleast_1d(np.asarray(self.gap, float)), self._weights).upper

    @property
    def equivalent_gap(self) -> float:
        """Cube root of K, m."""
        return float(np.cbrt(self.transmissivity))


@dataclass(frozen=True, eq=False, repr=False)
class ArrayAnswer(Tabled):
    """An array of obstacles: the fraction ``covered`` and transmissivities over that of the open
    gap, of impermeable circles (``closed``) and of ones without resistance (``free``), arrays of
    one shape."""

    covered: RealArray
    closed: RealArray
    free: RealArray


@dataclass(frozen=True)
class ObstacleArray(Theory):
    """Circular spots of contact that cover the fraction f in a square array in an even gap, by
    Rayleigh's multipoles; circles without resistance have the reciprocal (Keller 1964).

    For small f the transmissivity over that of the gap is that of Maxwell and Garnett:

        K ≈ (1 - f)/(1 + f).
    """

    name: ClassVar[str] = "obstacle-array"
    title: ClassVar[str] = "Rayleigh, square array of spots"
    citation_keys: ClassVar[tuple[str, ...]] = ("Perrins1979", "Keller1964")
    limits: ClassVar[tuple[Bound, ...]] = ()
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("covered", "1", "share of the area that the spots cover, below π/4"),
            "at_covered",
            (
                Quantity("closed", "1", "transmissivity over that of the open gap"),
                Quantity("free", "1", "the same of circles without resistance"),
            ),
        ),
    )

    def at_covered(self, covered: ArrayLike) -> ArrayAnswer:
        """The array that covers these shares (any shape) of the area; InputError from π/4 on."""
        shares = checked(covered, "area fraction of obstacles")
        found = np.reshape([obstacle_array(float(f), ORDERS) for f in shares.ravel()], shares.shape)
        return ArrayAnswer(shares, found, 1.0 / found)


ORDERS = 40
"""Multipoles of an array of obstacles: 1e-13 up to 0.74 of the area."""


@dataclass(frozen=True, eq=False, repr=False)
class JunctionAnswer(Tabled):
    """The critical junction at some pressures, (n,) each; zero gap and no wavelength where the
    contact seals.

    Parameters
    ----------
    pressure
        Nominal pressure in Pa.
    critical_gap
        Gap u_c of the constriction that decides, m.
    transmissivity
        u_c³, m³.
    wavelength
        Shortest waves seen at the magnification at which the contact closes, m.
    """

    pressure: RealArray
    critical_gap: RealArray
    transmissivity: RealArray
    wavelength: RealArray


@dataclass(frozen=True, eq=False)
class CriticalJunction(Theory):
    """Leakage through the one constriction that decides, at the magnification at which the contact
    of Persson's theory closes the gap (Persson & Yang 2008).

    With the waves up to q_c the contact covers the fraction at which it percolates. The gap of what
    comes out of contact there, and what a square lets through, are

        u_c = ū + ū' A/A',  Q = u_c³ ΔP/(12 η)

    with the mean gap ū of the shorter waves under the pressure p A_n/A and derivatives by q: an
    order of magnitude.
    """

    E_star: Modulus
    q: Annotated[ArrayLike, Several(Number("rad/m", above=0.0)), "wavenumbers of the power spectrum"] = field(
        repr=False
    )
    psd: Annotated[
        ArrayLike, Several(Number("power spectrum")), "power spectrum at those wavenumbers, m0 = (1/2π) ∫ q C dq"
    ] = field(repr=False)
    percolation: Annotated[Fraction, Help("contact fraction at which the contact closes the gap", of="choice")] = (
        PERCOLATION
    )
    gamma: Annotated[
        Real, Help("weight of the elastic energy in the mean gap, 1 in the original form", of="choice")
    ] = CALIBRATED
    name: ClassVar[str] = "critical-junction"
    title: ClassVar[str] = "Persson & Yang, critical junction"
    citation_keys: ClassVar[tuple[str, ...]] = ("PerssonYang2008", "Dapp2012", "Yang2008")
    limits: ClassVar[tuple[Bound, ...]] = (
        Bound(
            "share of the shortest wavelength in the critical one",
            lambda theory, answer: answer.wavelength * float(np.asarray(theory.q)[-1]) / (2.0 * math.pi),
            2.0,
            math.inf,
            "PerssonYang2008",
            "The critical gap is made by the shortest waves alone, and depends on where the spectrum is cut.",
        ),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            PRESSURE,
            "at_pressure",
            (
                Quantity("pressure", "Pa", "nominal pressure"),
                Quantity("critical_gap", "m", "gap of the constriction that decides"),
                Quantity("transmissivity", "m**3", "transmissivity, the cube of that gap"),
                Quantity("wavelength", "m", "shortest waves seen where the contact closes"),
            ),
        ),
    )

    @property
    def spectrum(self) -> IsotropicSpectrum:
        """Its spectrum; InputError if the table cannot be used."""
        return IsotropicSpectrum(self.q, self.psd)

    @property
    def sealing_pressure(self) -> float:
        """Nominal pressure in Pa at which the contact with all waves covers the percolating
        fraction."""
        return _erfinv(self.percolation) * self.E_star * self.spectrum.rms_slope / math.sqrt(2.0)

    def at_pressure(self, pressure: ArrayLike) -> JunctionAnswer:
        """The junction at nominal pressures (n,) in Pa, > 0."""
        p = curve(pressure, "pressures (Pa)", positive=True)
        found = [self._junction(float(value)) for value in p]
        gaps, waves = (np.array(part) for part in zip(*found, strict=True))
        return JunctionAnswer(p, gaps, gaps**3, waves)

    def _junction(self, pressure: float) -> tuple[float, float]:
        """Gap and shortest wavelength of the junction at one ``pressure``."""
        spectrum, x = self.spectrum, _erfinv(self.percolation)
        # A/A_n = erf x with x² = 4π (p/E*)²/∫ q³ C dq
        wanted = 4.0 * math.pi * (pressure / (self.E_star * x)) ** 2
        last = float(spectrum.span[-1])
        if wanted >= spectrum.moment(3):
            return 0.0, math.nan

        def beyond(logarithm: RealArray) -> RealArray:
            return spectrum.partial_moment(3, np.exp(logarithm)) - wanted

        # the first waves may do, within any distance from q_L
        at = math.exp(float(bisected(beyond, np.array([math.log(NEAREST)]), np.array([math.log(last)]))[0]))
        step = min(STEP, 0.5 * at, 0.5 * (last - at))
        gaps = [self._shorter(at + shift, pressure) for shift in (-step, 0.0, step)]
        first = float(np.asarray(self.q)[0])
        level = float(spectrum.at(np.array([at]))[0]) * (first * math.exp(at)) ** 4
        falling = -math.exp(-(x**2)) * x * level / (math.sqrt(math.pi) * wanted)
        gap = gaps[1] + (gaps[2] - gaps[0]) / (2.0 * step) * self.percolation / falling
        return float(gap), 2.0 * math.pi / (first * math.exp(at))

    def _shorter(self, span: float, pressure: float) -> float:
        """Mean gap in m of the waves from ``span`` = ln(q/q_L) on, pressed by the ``pressure`` over
        the contact of the longer ones."""
        spectrum = self.spectrum
        sharpness = math.sqrt(4.0 * math.pi / float(spectrum.partial_moment(3, np.array([span]))[0]))
        held = math.erf(sharpness * pressure / self.E_star)
        later = spectrum.span > span * (1.0 + 1e-12)
        first = np.asarray(spectrum.wavenumber)[0] * math.exp(span)
        q = np.concatenate([[first], np.asarray(spectrum.wavenumber)[later]])
        psd = np.concatenate([spectrum.at(np.array([span])), np.asarray(spectrum.psd)[later]])
        return float(PerssonGap(self.E_star, IsotropicSpectrum(q, psd), self.gamma).mean_gap(pressure / held))


def _erfinv(share: float) -> float:
    return NormalDist().inv_cdf(0.5 * (1.0 + share)) / math.sqrt(2.0)


NEAREST = 1e-24
"""Nearest to the first wavenumber, in ln q, that waves are cut."""

STEP = 1e-3
"""Of ln q in the derivative of the mean gap: it errs by the square, and by its rounding."""
