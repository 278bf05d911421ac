"""Hysteretic friction of rubber on a rough surface by Persson's theory (2001), from the power
spectrum and the complex modulus."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import ComplexArray, RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quadrature import gauss, running
from ...core.quantity import Quantity
from ...core.values import Number, Several
from ..ask import PRESSURE, Way, asked
from ..protocol import ISOTROPY, MEASURED_SLOPES, Bound, Theory, curve, real_numbers
from ..statistics.roughness import Roughness
from .persson import IsotropicSpectrum

ORIGINAL = 1.0
"""gamma of the theory as it was published: the rubber follows in partial contact as in full
contact. About 1/2 is usual for less."""

_NODES, _SMALL = 13, 5e-3
"""Wavenumbers in a panel, and G below which P is one within rounding: erf(7)."""

_ANGLES, _DECAY = 24, 46.0
"""Panels of the angle from the direction across the motion, and the e-folds over which they shrink
towards it."""


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
    reduction: float = ORIGINAL,
) -> RubberFriction:
    """Friction coefficient by Persson (2001), eqs. 58-60, of a hard rough surface that slides over
    a viscoelastic half-space.

    .. math::

        \\mu = \\tfrac12\\int dq\\,q^3 C(q) S(q) P(q) \\int_0^{2\\pi} d\\phi\\,\\cos\\phi\\,
        \\frac{\\mathrm{Im}\\,E(qv\\cos\\phi)}{\\sigma_0}

    with P = erf(1/2√G) and G = 1/8 ∫ dq q³ C ∫ dφ |E(qv cos φ)/σ0|², C here being that of <h²> = ∫
    C d²q. All waves up to the largest of the spectrum count; the shortest dominate, so that where
    the spectrum ends must be stated with the result.

    Parameters
    ----------
    spectrum
        Of the rough surface.
    modulus
        Complex plane-strain modulus E/(1 - nu²) in Pa at angular frequencies (any shape) in rad/s,
        for the time dependence exp(+i omega t);
        ``Viscoelastic.contact_relaxation.complex_modulus``.
    speed
        v in m/s, > 0.
    pressure
        Nominal pressure in Pa, > 0.
    reduction
        gamma in S = gamma + (1 - gamma) P², 0 < gamma <= 1: how much less the rubber follows in
        partial contact; 1 leaves it out, about 1/2 is usual.

    Raises
    ------
    InputError
        If a number is outside its range.
    """
    v, sigma = require.positive(speed, "sliding speed (m/s)"), require.positive(pressure, "nominal pressure (Pa)")
    gamma = require.at_most(reduction, 1.0, "reduction factor gamma of the deformation")
    from scipy.special import erf

    # a quarter turn of φ, dense where the motion is along the wave's crests and the frequency goes
    # to zero
    w, share = gauss(np.linspace(0.0, _DECAY, _ANGLES + 1), 8)
    angle = 0.5 * np.pi * np.exp(-w)
    cosine, weight = np.sin(angle), share * angle

    def losses(span: RealArray) -> tuple[RealArray, RealArray]:
        """dG/d ln q, and dmu/d ln q where S P = 1, at ln(q/q_L) (any shape)."""
        q = np.asarray(spectrum.wavenumber)[0] * np.exp(span)
        E = modulus(v * q[..., None] * cosine) / sigma
        density = q**4 * spectrum.at(span) / (2.0 * np.pi) ** 2  # q³ C dq = q⁴ C d ln q
        return 0.5 * density * (np.abs(E) ** 2 @ weight), 2.0 * density * ((cosine * E.imag) @ weight)

    # P falls from one within d ln q = 1/G' of the first wavenumber, which is 1e-20 for stiff solids
    # under small pressures
    steepest = float(losses(np.zeros(1))[0][0])
    ends = spectrum.graded(_SMALL / max(steepest, _SMALL))
    x, sums = running(_NODES)
    half = 0.5 * np.diff(ends)[:, None]
    span = ends[:-1, None] + half * (x + 1.0)
    spread, steepness = losses(span)
    G = _gathered(half * (spread @ sums.T))
    with np.errstate(divide="ignore"):
        P = erf(0.5 / np.sqrt(G))
    mu = _gathered(half * ((steepness * (gamma + (1.0 - gamma) * P**2) * P) @ sums.T))
    q = np.asarray(spectrum.wavenumber)[0] * np.exp(span)
    return RubberFriction(float(mu[-1, -1]), float(P[-1, -1]), q.ravel(), mu.ravel(), P.ravel())


def _gathered(parts: RealArray) -> RealArray:
    """Integrals from the first panel on, of those within each panel (panels, nodes)."""
    return np.asarray(parts + np.concatenate([[0.0], np.cumsum(parts[:-1, -1])])[:, None])


@dataclass(frozen=True, eq=False, repr=False)
class FrictionAnswer(Tabled):
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
    """Hysteretic friction and contact area of a hard rough surface that slides over a viscoelastic
    half-space (Persson 2001).

    The same theory as ``rubber_friction``, for a plane-strain modulus ``relaxed`` + sum of
    ``moduli`` exp(-t/``times``).

        μ = ½ ∫ q³ C S P ∫ cos φ Im E(qv cos φ)/p̄ dφ dq,  P = erf(1/2√G),
        G = ⅛ ∫ q³ C ∫ |E(qv cos φ)/p̄|² dφ dq.

    InputError if a parameter is outside its range, moduli and times differ in number, or the
    spectrum cannot be used.
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
    ] = ORIGINAL
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
                f"times of a relaxation must be as many as its moduli, but are {np.size(self.times)} for "
                f"{np.size(self.moduli)}."
            )
        IsotropicSpectrum(self.q, self.psd)  # checks them

    @classmethod
    def of_roughness(
        cls, roughness: Roughness, *, relaxed: float, moduli: ArrayLike, times: ArrayLike, reduction: float = ORIGINAL
    ) -> Self:
        """Theory for the spectrum of a map, less the bands without power."""
        found = roughness.known(roughness.spectrum, "its spectrum", cls.name)
        holds = found.psd > 0.0
        return cls(relaxed, moduli, times, found.q[holds], found.psd[holds], reduction)

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
        spectrum = IsotropicSpectrum(self.q, self.psd)
        found = [
            rubber_friction(spectrum, self.modulus, speed=float(v), pressure=float(p), reduction=self.reduction)
            for p, v in zip(pressure, speed, strict=True)
        ]
        friction, area = (np.array([getattr(each, name) for each in found]) for name in ("friction", "area_fraction"))
        return FrictionAnswer(pressure, speed, friction, area)
