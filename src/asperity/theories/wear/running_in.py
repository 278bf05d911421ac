"""Running-in: waves that wear off, and a flat punch whose pressure becomes uniform."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Length, Pressure
from ..ask import Way
from ..protocol import Bound, Modulus, PoissonOfSolid, Theory, checked
from ..single.coating import softening
from ..single.waves import Wavelength
from .laws import DISTANCE, WearCoefficient


@dataclass(frozen=True, eq=False, repr=False)
class DecayAnswer(Tabled):
    """A deviation from even pressure at some sliding distances (m), arrays of one shape:
    ``remaining`` of its first size."""

    distance: RealArray
    remaining: RealArray


_WAVE_NUMBERS = (
    Quantity("compliance", "m/Pa", "amplitude of the displacement over that of the pressure"),
    Quantity("decay_distance", "m", "sliding distance in which the wave falls to 1/e"),
    Quantity("explicit_limit", "m", "sliding distance beyond which explicit steps of this wave grow"),
)
_WAVE_WAYS = (Way(DISTANCE, "at_distance", (Quantity("remaining", "1", "amplitude over the one at the start"),)),)


class _Wave(Theory):
    """What both wearing waves answer."""

    coefficient: float

    @property
    def compliance(self) -> float:
        """C in m/Pa."""
        raise NotImplementedError

    @property
    def decay_distance(self) -> float:
        """C/k in m."""
        return self.compliance / self.coefficient

    @property
    def explicit_limit(self) -> float:
        """2 C/k in m."""
        return 2.0 * self.decay_distance

    def at_distance(self, distance: ArrayLike) -> DecayAnswer:
        """The wave after the sliding ``distance`` in m, >= 0, of any shape."""
        s = checked(distance, "sliding distance (m)")
        return DecayAnswer(s, np.exp(-s / self.decay_distance))


@dataclass(frozen=True)
class WearingWave(_Wave):
    """A wave of the profile and of the pressure in full contact with a homogeneous half-space,
    while its crests wear more than its valleys:

        p(s) = p(0) exp(-k s/C),  C = 2/(E* q) = λ/(π E*),  q = 2π/λ.

    One implicit (backward Euler) step Δs leaves 1/(1 + k Δs/C) of it, an explicit one 1 - k Δs/C,
    which grows from sign to sign for k Δs > 2 C.

    Examples
    --------
    >>> wave = WearingWave(1e11, wavelength=10e-6, coefficient=1e-15)
    >>> f"falls to 1/e in {wave.decay_distance * 1e3:.1f} mm"
    'falls to 1/e in 31.8 mm'
    """

    E_star: Modulus
    wavelength: Wavelength
    coefficient: WearCoefficient
    name: ClassVar[str] = "wearing-wave"
    title: ClassVar[str] = "Wearing wave in full contact"
    citation_keys: ClassVar[tuple[str, ...]] = ("Goryacheva1998", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = ()
    numbers: ClassVar[tuple[Quantity, ...]] = _WAVE_NUMBERS
    ways: ClassVar[tuple[Way, ...]] = _WAVE_WAYS

    @property
    def compliance(self) -> float:
        """λ/(π E*) in m/Pa."""
        return self.wavelength / (math.pi * self.E_star)


@dataclass(frozen=True)
class WearingCoatedWave(_Wave):
    """A wave in full contact with a coating (1) of thickness h bonded to a half-space (2), while
    much less than the coating is worn:

        p(s) = p(0) exp(-k s/C),  C = 2 [1 + M(q)]/(E1* q),  E1* = E1/(1 - ν1²).

    With ξ = q h, μ = G1/G2, κ = (μ - 1)/(μ + 3 - 4ν1) and λ = 1 - 4(1 - ν1)/[1 + μ(3 - 4ν2)]
    (O'Sullivan & King 1988)

        1 + M = [1 + 4κξ e^(-2ξ) - λκ e^(-4ξ)]/[1 - (λ + κ + 4κξ²) e^(-2ξ) + λκ e^(-4ξ)].

    Examples
    --------
    >>> hard = WearingCoatedWave(400e9, 200e9, thickness=1e-6, wavelength=10e-6, coefficient=1e-16)
    >>> f"falls to 1/e in {hard.decay_distance * 1e3:.0f} mm"
    'falls to 1/e in 121 mm'
    """

    coating: Annotated[Pressure, Help("Young's modulus E1 of the coating", of="bodies")]
    base: Annotated[Pressure, Help("Young's modulus E2 of the half-space", of="bodies")]
    thickness: Annotated[Length, Help("thickness h of the coating", of="bodies")]
    wavelength: Wavelength
    coefficient: WearCoefficient
    coating_nu: Annotated[PoissonOfSolid, Help("Poisson's ratio ν1 of the coating", of="bodies")] = 0.3
    base_nu: Annotated[PoissonOfSolid, Help("Poisson's ratio ν2 of the half-space", of="bodies")] = 0.3
    name: ClassVar[str] = "wearing-coated-wave"
    title: ClassVar[str] = "Wearing wave on a coating"
    citation_keys: ClassVar[tuple[str, ...]] = ("Goryacheva1998", "OSullivan1988")
    limits: ClassVar[tuple[Bound, ...]] = ()
    numbers: ClassVar[tuple[Quantity, ...]] = _WAVE_NUMBERS
    ways: ClassVar[tuple[Way, ...]] = _WAVE_WAYS

    @property
    def compliance(self) -> float:
        """2 [1 + M(q)]/(E1* q) in m/Pa."""
        q = np.array(2.0 * math.pi / self.wavelength)
        softer = softening(q, self.coating, self.base, self.thickness, self.coating_nu, self.base_nu)
        return 2.0 * (1.0 - self.coating_nu**2) * (1.0 + float(softer)) / (self.coating * float(q))


# A flat round punch. Pressures P_n(1 - 2r²/a²), n >= 1, have no load, and the Hankel transform
# a J_(2n+1)(q a)/q. With the compliance 2/(E* q) their work is a Weber-Schafheitlin integral:
# ∫ J_(2m+1) J_(2n+1)/t² dt = Γ(m + n + 1/2)/[4 Γ(m + n + 5/2) Γ(3/2 + m - n) Γ(3/2 - m + n)].

_BASIS = 200
"""Of them, which give the first hundred rates to 1e-11."""

_MOST = 100
"""Modes that are asked for."""

_EARLY = 0.1
"""k E* s/a before which what is left of the last modes counts."""


def _modes() -> tuple[RealArray, RealArray, RealArray]:
    """Rates s_n of the modes in k E*/a, rising; their pressures at the centre, and their shares in
    the pressure under a rigid flat punch, both times an arbitrary factor and its inverse."""
    n = np.arange(1, _BASIS + 1)
    total, apart = n[:, None] + n[None, :], n[:, None] - n[None, :]
    # Γ(m + n + 1/2)/Γ(m + n + 5/2), and by reflection 1/[Γ(3/2 + d) Γ(3/2 - d)]
    work = 1.0 / ((total + 0.5) * (total + 1.5)) * (-1.0) ** apart / (2.0 * math.pi * (0.25 - apart**2))
    size = np.sqrt(2.0 * (2.0 * n + 1.0))  # P_n over a² of the norm 1/size²
    values, vectors = np.linalg.eigh(size[:, None] * work * size[None, :])
    values, vectors = values[::-1], vectors[:, ::-1]
    centre = (size[:, None] * vectors).sum(axis=0)  # P_n(1) = 1
    boussinesq = (-1.0) ** n / size  # (-1)^n P_n over the mean pressure, times 1/size²
    return 1.0 / values, centre, boussinesq @ vectors


def punch_rates(count: int) -> RealArray:
    """The first ``count`` rates s_n of a wearing flat punch, at most 100: 2.0606, 3.6710, 5.2585,
    6.8386, 8.4154, ..., π/2 apart in the end.

    InputError for other numbers.

    Examples
    --------
    >>> punch_rates(4).round(5)
    array([2.06065, 3.67104, 5.25854, 6.83865])
    """
    if require.integer(count, 1, "number of modes") > _MOST:
        raise InputError(f"number of modes must be at most {_MOST}, but is {count}. Later ones are π/2 apart.")
    return _modes()[0][:count]


@dataclass(frozen=True, eq=False, repr=False)
class PunchAnswer(Tabled):
    """A wearing punch at some sliding distances (m), arrays of one shape: ``remaining`` of the
    slowest mode, and the pressure at the ``centre`` over the mean one, NaN of a start that is not
    resolved."""

    distance: RealArray
    remaining: RealArray
    centre: RealArray


@dataclass(frozen=True)
class WearingPunch(Theory):
    """A flat round punch of radius a whose end wears from flat until the pressure is uniform.

    What deviates from it falls in modes,

        p = p̄ + Σ p_n(r) exp(-s_n k E* s/a),  s_n = 2.0606, 3.6710, 5.2585, 6.8386, …

    with the displacements u_n by p_n, up to a constant, and no load in any mode:

        p_n(r) = s_n (E*/a) u_n(r) + c_n,  ∫ p_n(r) r dr = 0.

    In Legendre polynomials of 1 - 2r²/a² the matrix of their work is closed. The centre starts at
    half of the mean pressure, that of a rigid flat punch.

    Examples
    --------
    >>> punch = WearingPunch(1e11, radius=1e-3, coefficient=1e-15)
    >>> f"{punch.decay_distance:.2f} m"
    '4.85 m'
    """

    E_star: Modulus
    radius: Annotated[Length, "radius a of the punch"]
    coefficient: WearCoefficient
    name: ClassVar[str] = "wearing-punch"
    title: ClassVar[str] = "Galin, wearing flat punch"
    citation_keys: ClassVar[tuple[str, ...]] = ("Galin1976", "Goryacheva1998")
    limits: ClassVar[tuple[Bound, ...]] = ()
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("decay_distance", "m", "sliding distance in which the slowest mode falls to 1/e"),
        Quantity("second_distance", "m", "sliding distance in which the next mode falls to 1/e"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            DISTANCE,
            "at_distance",
            (
                Quantity("remaining", "1", "slowest mode over the one at the start"),
                Quantity("centre", "1", "pressure at the centre over the mean pressure"),
            ),
        ),
    )

    @property
    def decay_distance(self) -> float:
        """a/(s_1 k E*) in m."""
        return float(self._unit / punch_rates(1)[0])

    @property
    def second_distance(self) -> float:
        """a/(s_2 k E*) in m."""
        return float(self._unit / punch_rates(2)[1])

    def at_distance(self, distance: ArrayLike) -> PunchAnswer:
        """The punch after the sliding ``distance`` in m, >= 0, of any shape; the centre is not
        resolved at its first 0.1 a/(k E*), but for zero."""
        s = checked(distance, "sliding distance (m)")
        rates, at_centre, shares = _modes()
        left = np.exp(-np.multiply.outer(s / self._unit, rates))
        centre = np.where(s >= _EARLY * self._unit, 1.0 + left @ (at_centre * shares), np.nan)
        return PunchAnswer(s, left[..., 0], np.where(s == 0.0, 0.5, centre))

    @property
    def _unit(self) -> float:
        """a/(k E*) in m."""
        return self.radius / (self.coefficient * self.E_star)
