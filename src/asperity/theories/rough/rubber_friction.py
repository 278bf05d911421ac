"""Hysteretic friction of rubber on a rough surface by Persson's theory (2001), from the power spectrum and the complex modulus."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import ComplexArray, RealArray
from ...core.errors import InputError
from ...core.parameters import Help
from ...core.quadrature import gauss
from ...core.quantity import Quantity
from ...core.values import Number, Several
from ..ask import PRESSURE, Way, asked
from ..protocol import ISOTROPY, MEASURED_SLOPES, Bound, Theory, curve, real_numbers
from ..statistics.roughness import Roughness
from .persson import IsotropicSpectrum

_POINTS, _PER_DECADE, _FEWEST = 801, 300, 17
"""Wavenumbers between two of the table: at most, in a decade between them, and at least; the first and last odd."""

_ANGLES, _DECAY = 24, 46.0
"""Panels of the angle from the direction across the motion, and the e-folds over which they shrink towards it."""


@dataclass(frozen=True, eq=False)
class RubberFriction:
    """Friction and contact area while sliding.

    Attributes
    ----------
    friction
        Coefficient of hysteretic friction.
    area_fraction
        Contact area over nominal area at the largest wavenumber of the spectrum.
    wavenumber
        (n,), rad/m.
    cumulative_friction
        (n,): friction by all waves up to each wavenumber.
    magnification_area
        (n,): contact area over nominal area at that magnification.
    """

    friction: float
    area_fraction: float
    wavenumber: RealArray
    cumulative_friction: RealArray
    magnification_area: RealArray


def rubber_friction(
    spectrum: IsotropicSpectrum,
    modulus: Callable[[RealArray], ComplexArray],
    *,
    speed: float,
    pressure: float,
    reduction: float = 1.0,
) -> RubberFriction:
    """Friction coefficient by Persson (2001), eqs. 58-60, of a hard rough surface that slides over a viscoelastic half-space.

    .. math::

        \\mu = \\tfrac12\\int dq\\,q^3 C(q) S(q) P(q) \\int_0^{2\\pi} d\\phi\\,\\cos\\phi\\,
        \\frac{\\mathrm{Im}\\,E(qv\\cos\\phi)}{\\sigma_0}

    with P = erf(1/2√G) and G = 1/8 ∫ dq q³ C ∫ dφ |E(qv cos φ)/σ0|², C here being that of <h²> = ∫ C d²q. All waves up to the largest
    of the spectrum count; the shortest dominate, so that where the spectrum ends must be stated with the result.

    Parameters
    ----------
    spectrum
        Of the rough surface.
    modulus
        Complex plane-strain modulus E/(1 - nu²) in Pa at angular frequencies (any shape) in rad/s, for the time dependence exp(+i omega t);
        ``Viscoelastic.contact_relaxation.complex_modulus``.
    speed
        v in m/s, > 0.
    pressure
        Nominal pressure in Pa, > 0.
    reduction
        gamma in S = gamma + (1 - gamma) P², 0 < gamma <= 1: how much less the rubber follows in partial contact; 1 leaves it out, about
        1/2 is usual.

    Raises
    ------
    InputError
        If a number is outside its range.
    """
    v, sigma = require.positive(speed, "sliding speed (m/s)"), require.positive(pressure, "nominal pressure (Pa)")
    gamma = require.at_most(reduction, 1.0, "reduction factor gamma of the deformation")
    from scipy.integrate import cumulative_simpson
    from scipy.special import erf

    cosine, weight = _quarter()
    ends, steepness, spread = np.asarray(spectrum.wavenumber), [], []
    waves = []
    for low, high in pairwise(ends):
        q = np.geomspace(low, high, _points(low, high))
        E = modulus(v * q[:, None] * cosine) / sigma
        density = q**4 * spectrum.at(np.log(q / ends[0])) / (2.0 * np.pi) ** 2  # q³ C dq = q⁴ C d ln q
        waves.append(q)
        spread.append(0.5 * density * (np.abs(E) ** 2 @ weight))
        steepness.append(2.0 * density * ((cosine * E.imag) @ weight))
    G, mu, shares, friction, areas = 0.0, 0.0, [], [], []
    for q, of_G, of_mu in zip(waves, spread, steepness, strict=True):
        x = np.log(q)
        spreads = G + cumulative_simpson(of_G, x=x, initial=0.0)
        with np.errstate(divide="ignore"):
            P = erf(0.5 / np.sqrt(spreads))
        follows = gamma + (1.0 - gamma) * P**2
        sums = mu + cumulative_simpson(of_mu * follows * P, x=x, initial=0.0)
        G, mu = float(spreads[-1]), float(sums[-1])
        shares.append(q)
        friction.append(sums)
        areas.append(P)
    return RubberFriction(mu, float(areas[-1][-1]), *map(np.concatenate, (shares, friction, areas)))


def _points(low: float, high: float) -> int:
    """Odd number of wavenumbers from ``low`` to ``high``."""
    return min(_POINTS, max(_FEWEST, 2 * math.ceil(0.5 * _PER_DECADE * math.log10(high / low)) + 1))


def _quarter() -> tuple[RealArray, RealArray]:
    """cos phi and weights over a quarter turn, dense where the motion is along the wave's crests and the frequency goes to zero."""
    w, share = gauss(np.linspace(0.0, _DECAY, _ANGLES + 1), 8)
    angle = 0.5 * np.pi * np.exp(-w)
    return np.sin(angle), share * angle


@dataclass(frozen=True, eq=False)
class FrictionAnswer:
    """Friction and contact area at pressures (Pa) and speeds (m/s), each (n,)."""

    pressure: RealArray
    speed: RealArray
    friction: RealArray
    area_fraction: RealArray

    @property
    def heat(self) -> RealArray:
        """Heat per nominal area and time, W/m²."""
        return self.friction * self.pressure * self.speed


_ANSWERS = (
    Quantity("friction", "1", "coefficient of hysteretic friction"),
    Quantity("area_fraction", "1", "real over nominal contact area"),
    Quantity("heat", "W/m^2", "heat per nominal area and time"),
)
_SPEED = asked("speed", "m/s", "sliding speed")


@dataclass(frozen=True, eq=False)
class PerssonFriction(Theory):
    """Hysteretic friction and contact area of a hard rough surface that slides over a viscoelastic half-space (Persson 2001).

    The same theory as ``rubber_friction``, for a plane-strain modulus ``relaxed`` + sum of ``moduli`` exp(-t/``times``).

        μ = ½ ∫ q³ C S P ∫ cos φ Im E(qv cos φ)/p̄ dφ dq,  P = erf(1/2√G),  G = ⅛ ∫ q³ C ∫ |E(qv cos φ)/p̄|² dφ dq.

    InputError if a parameter is outside its range, moduli and times differ in number, or the spectrum cannot be used.
    """

    relaxed: Annotated[float, Number("pressure", above=0.0), "plane-strain modulus E/(1 - nu²) after relaxation"]
    moduli: Annotated[ArrayLike, Several(Number("pressure", above=0.0)), "parts of that modulus that relax"]
    times: Annotated[ArrayLike, Several(Number("time", above=0.0)), "relaxation time of each"]
    q: Annotated[ArrayLike, Several(Number("rad/m", above=0.0)), "wavenumbers of the power spectrum"]
    psd: Annotated[
        ArrayLike, Several(Number("power spectrum")), "power spectrum at those wavenumbers, m0 = (1/2π) ∫ q C dq"
    ]
    reduction: Annotated[
        float,
        Number(above=0.0, most=1.0),
        Help(
            "gamma in S = gamma + (1 - gamma) P², by which partial contact reduces the deformation; 1 for none",
            of="choice",
        ),
    ] = 1.0
    name: ClassVar[str] = "persson-friction"
    title: ClassVar[str] = "Persson, rubber friction"
    citation_keys: ClassVar[tuple[str, ...]] = ("Persson2001",)
    limits: ClassVar[tuple[Bound, ...]] = (
        Bound(
            "coefficient of hysteretic friction",
            lambda theory, answer: answer.friction,
            0.0,
            1.0,
            "Persson2001",
            "The slopes are too steep for a theory of small slopes.",
        ),
        MEASURED_SLOPES,
        ISOTROPY,
    )
    ways: ClassVar[tuple[Way, ...]] = (Way(_SPEED, "at_speed", _ANSWERS, (PRESSURE,)),)

    def __post_init__(self) -> None:
        super().__post_init__()
        if np.size(self.moduli) != np.size(self.times):
            raise InputError(
                f"times of a relaxation must be as many as its moduli, but are {np.size(self.times)} for {np.size(self.moduli)}."
            )
        _ = self._spectrum

    @classmethod
    def of_roughness(
        cls, roughness: Roughness, *, relaxed: float, moduli: ArrayLike, times: ArrayLike, reduction: float = 1.0
    ) -> Self:
        """Theory for the spectrum of a map, less the bands without power."""
        found = roughness.known(roughness.spectrum, "its spectrum", cls.name)
        holds = found.psd > 0.0
        return cls(relaxed, moduli, times, found.q[holds], found.psd[holds], reduction)

    @property
    def _spectrum(self) -> IsotropicSpectrum:
        return IsotropicSpectrum(self.q, self.psd)

    def modulus(self, omega: RealArray) -> ComplexArray:
        """Complex modulus (Pa) at angular frequencies (rad/s)."""
        found = np.full(np.shape(omega), complex(self.relaxed))
        for strength, time in zip(np.ravel(self.moduli), np.ravel(self.times), strict=True):
            x = 1j * np.asarray(omega) * time
            found = found + strength * x / (1.0 + x)
        return found

    def at_speed(self, speed: ArrayLike, pressure: float) -> FrictionAnswer:
        """Friction and area at speeds (n,) in m/s, > 0, under the nominal ``pressure`` in Pa."""
        v = curve(speed, "sliding speeds (m/s)", positive=True)
        return self._answer(np.full(v.shape, float(real_numbers(pressure, "nominal pressure (Pa)"))), v)

    def at_pressure(self, pressure: ArrayLike, speed: float) -> FrictionAnswer:
        """Friction and area at nominal pressures (n,) in Pa, > 0, at the ``speed`` in m/s."""
        p = curve(pressure, "pressures (Pa)", positive=True)
        return self._answer(p, np.full(p.shape, float(real_numbers(speed, "sliding speed (m/s)"))))

    def _answer(self, pressure: RealArray, speed: RealArray) -> FrictionAnswer:
        found = [
            rubber_friction(self._spectrum, self.modulus, speed=float(v), pressure=float(p), reduction=self.reduction)
            for p, v in zip(pressure, speed, strict=True)
        ]
        friction, area = (np.array([getattr(each, name) for each in found]) for name in ("friction", "area_fraction"))
        return FrictionAnswer(pressure, speed, friction, area)
