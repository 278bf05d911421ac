"""Tangential loading below the limit of friction: a stick zone and a slipping rim (Cattaneo 1938;
Mindlin 1949).

The normal force comes first, then Q <= μP. The shear traction is q = μ [p(P) - p(P*)] with P* = P -
Q/μ, the contact of P* being the stick zone, and the slip is μκ times the gap under P* (Ciavarella
1998; Jäger 1998): exact for equal materials in plane strain, and for a point contact of ν = 0,
otherwise but for the small transverse traction. Other paths of loading are in ``histories``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Positive, Pressure
from ..ask import Way, asked
from ..protocol import CONTACT_RADIUS, Bound, ContactAnswer, Modulus, Radius, Theory, bisected, checked, small_slope
from ..single.hertz import HertzLine, HertzPoint
from ..single.waves import Amplitude, Wavelength, Westergaard


def tangential_modulus(shear_0: float, nu_0: float, shear_1: float, nu_1: float) -> float:
    """G* in Pa, 1/G* = (2 - ν0)/4G0 + (2 - ν1)/4G1, from shear moduli (Pa) and Poisson's ratios of
    both bodies."""
    parts = [(shear_0, nu_0), (shear_1, nu_1)]
    return 1.0 / sum((2.0 - nu) / (4.0 * require.positive(G, "shear modulus (Pa)")) for G, nu in parts)


Friction: TypeAlias = Annotated[Positive, "friction coefficient μ"]
Ratio: TypeAlias = Annotated[
    Positive,
    Help(
        "tangential over normal compliance κ: 1 in the plane, 1/(1 - ν) for antiplane shear of equal bodies",
        of="bodies",
    ),
]

SLIP = (
    Quantity("normal.radius", "m", "radius (half-width) of the contact"),
    Quantity("stick_radius", "m", "radius (half-width) of the stick zone"),
    Quantity("displacement", "m", "tangential displacement of distant points"),
    Quantity("stiffness", "N/m", "derivative of the tangential force by it"),
)
"""What a contact under a tangential force answers; the first two in plane strain."""


@dataclass(frozen=True, eq=False, repr=False)
class SlipAnswer(Tabled):
    """A contact under a tangential force: arrays of one shape.

    Parameters
    ----------
    stick_radius
        Radius (half-width) c of the stick zone in m.
    displacement
        Tangential displacement of distant points relative to each other in m; NaN in plane strain.
    stiffness
        Derivative of the tangential force by that displacement in N/m; NaN in plane strain.
    normal
        The contact under the load alone.
    """

    stick_radius: RealArray
    displacement: RealArray
    stiffness: RealArray
    normal: ContactAnswer


@dataclass(frozen=True)
class MindlinPoint(Theory):
    """Sphere pressed by P, then pulled by Q; it sticks within the radius c.

    c = a (1 - Q/(μ P))^(1/3),  δ_x = μ (E*/G*) (a² - c²)/R,  dQ/dδ_x = 2 G* c.
    """

    E_star: Modulus
    radius: Radius
    G_star: Annotated[Pressure, Help("tangential modulus G*", of="bodies")]
    friction: Friction
    name: ClassVar[str] = "mindlin"
    title: ClassVar[str] = "Cattaneo-Mindlin, point contact"
    citation_keys: ClassVar[tuple[str, ...]] = (
        "Cattaneo1938",
        "Ciavarella1998",
        "Jager1998",
        "Mindlin1949",
        "Mindlin1953",
    )
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope(CONTACT_RADIUS.criterion, lambda theory, answer: answer.normal.radius / theory.radius),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(asked("tangential", "N", "tangential force"), "at_load", SLIP, (asked("load", "N", "normal force"),)),
    )

    @property
    def normal(self) -> HertzPoint:
        """The contact under the load alone."""
        return HertzPoint(self.E_star, self.radius)

    def at_load(self, load: float, tangential: ArrayLike) -> SlipAnswer:
        """Under ``load`` P in N, > 0, and the ``tangential`` force Q in N, 0 <= Q <= μP, of any
        shape.

        InputError if Q exceeds the limit of friction.
        """
        normal = self.normal.at_load(require.positive(load, "load (N)"))
        a = float(normal.radius)
        c = a * np.cbrt(sticking_share(tangential, self.friction * load))
        ratio = self.E_star / self.G_star
        displacement = self.friction * ratio * (a - c) * (a + c) / self.radius
        return SlipAnswer(c, displacement, 2.0 * self.G_star * c, normal)

    def traction(self, r: ArrayLike, load: float, tangential: float) -> RealArray:
        """Shear traction q in Pa at the distance ``r`` in m (any shape) from the axis."""
        return _difference(self.normal.pressure, r, load, tangential, self.friction)

    def displacement(self, r: ArrayLike, load: float, tangential: float) -> RealArray:
        """Tangential displacement of one surface less that of the other in m at the distance ``r``
        in m (any shape).

        Each of two equal bodies moves by half of it. It is δ_x less the ``slip``, also outside of
        the contact.
        """
        relative = _difference(self.normal.displacement, r, load, tangential, self.friction)
        return self.E_star / self.G_star * relative

    def slip(self, r: ArrayLike, load: float, tangential: float) -> RealArray:
        """Motion of facing points past each other in m at the distance ``r`` in m (any shape) from
        the axis."""
        normal, left = self.normal, load * sticking_share(tangential, self.friction * load)
        return _slip(normal.gap, r, load, left, self.friction * self.E_star / self.G_star)

    def cycle_dissipation(self, load: float, amplitude: ArrayLike) -> RealArray:
        """Work of friction in J of one cycle of Q between ± ``amplitude`` in N, 0 <= Q <= μP, of
        any shape.

        4μPδ_m e³ (1 - e + e²/5), e = 1 - c/a and δ_m = μ (E*/G*) a²/R (Mindlin & Deresiewicz 1953).
        """
        normal = self.normal.at_load(require.positive(load, "load (N)"))
        slipping = 1.0 - sticking_share(amplitude, self.friction * load)
        with np.errstate(divide="ignore"):
            e = -np.expm1(np.log1p(-slipping) / 3.0)
        full = self.friction * self.E_star / self.G_star * float(normal.approach)
        return np.asarray(4.0 * self.friction * load * full * e**3 * (1.0 - e + e**2 / 5.0))


@dataclass(frozen=True)
class MindlinLine(Theory):
    """Cylinder in plane strain pressed by P, then pulled by Q (both per length); it sticks within
    |x| < c.

    c = a sqrt(1 - Q/(μ P)).
    """

    E_star: Modulus
    radius: Radius
    friction: Friction
    ratio: Ratio = 1.0
    name: ClassVar[str] = "mindlin-line"
    title: ClassVar[str] = "Cattaneo-Mindlin, line contact"
    citation_keys: ClassVar[tuple[str, ...]] = ("Cattaneo1938", "Ciavarella1998", "Jager1998", "Mindlin1949")
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope(CONTACT_RADIUS.criterion, lambda theory, answer: answer.normal.radius / theory.radius),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("tangential", "N/m", "tangential force per length"),
            "at_load",
            SLIP[:2],
            (asked("load", "N/m", "normal force per length"),),
        ),
    )

    @property
    def normal(self) -> HertzLine:
        """The contact under the load alone."""
        return HertzLine(self.E_star, self.radius)

    def at_load(self, load: float, tangential: ArrayLike) -> SlipAnswer:
        """Under ``load`` P in N/m, > 0, and the ``tangential`` force Q in N/m, 0 <= Q <= μP, of any
        shape."""
        normal = self.normal.at_load(require.positive(load, "load per length (N/m)"))
        a = float(normal.radius)
        c = a * np.sqrt(sticking_share(tangential, self.friction * load))
        unknown = np.full_like(c, np.nan)
        return SlipAnswer(c, unknown, unknown, normal)

    def traction(self, x: ArrayLike, load: float, tangential: float) -> RealArray:
        """Shear traction q in Pa at the distance ``x`` in m (any shape) from the middle."""
        return _difference(self.normal.pressure, x, load, tangential, self.friction)

    def slip(self, x: ArrayLike, load: float, tangential: float) -> RealArray:
        """Motion of facing points past each other in m at ``x`` in m (any shape) from the
        middle."""
        normal, left = self.normal, load * sticking_share(tangential, self.friction * load)
        return _slip(normal.gap, x, load, left, self.friction * self.ratio)

    def cycle_dissipation(self, load: float, amplitude: ArrayLike) -> RealArray:
        """Work of friction in J/m of one cycle of Q between ± ``amplitude`` in N/m, 0 <= Q <= μP,
        of any shape.

        Independent of the supports, which add a displacement proportional to Q.
        """
        Q = self.friction * load * (1.0 - sticking_share(amplitude, self.friction * load))
        return self.ratio / (np.pi * self.E_star) * _loop(np.asarray(load), Q, self.friction)

    def stick_shift(self, load: float, tangential: float, bulk_stress: float) -> float:
        """Shift e = aσ/(4μp0) in m of the stick zone by a tension σ = ``bulk_stress`` (Pa) in one
        of the bodies.

        InputError if the stick zone would reach the edge of the contact, e + c > a, where the
        solution is another one.
        """
        answer = self.normal.at_load(require.positive(load, "load per length (N/m)"))
        a, c = float(answer.radius), float(self.at_load(load, tangential).stick_radius)
        shift = a * require.finite(bulk_stress, "bulk stress (Pa)") / (4.0 * self.friction * float(answer.max_pressure))
        if abs(shift) + c > a * (1.0 + 1e-12):
            raise InputError(
                f"bulk stress must leave the stick zone inside of the contact, but {bulk_stress:g} Pa moves it by "
                f"{shift / a:.3g} half-widths with a half-width of {c / a:.3g}. Less bulk stress or more friction does."
            )
        return shift


def sticking_share(tangential: ArrayLike, limit: float) -> RealArray:
    """1 - Q/μP."""
    Q = checked(tangential, "tangential force")
    if np.any(limit * (1.0 + 1e-12) < Q):
        raise InputError(
            f"tangential force must be at most friction coefficient times load, {limit:.6g}, but is "
            f"{float(Q.max()):.6g}. Beyond it the contact slides."
        )
    return np.asarray(np.maximum(1.0 - Q / limit, 0.0))


def _difference(
    field: Callable[[ArrayLike, float], RealArray], r: ArrayLike, load: float, tangential: float, friction: float
) -> RealArray:
    """μ times a ``field`` of the normal contact under P less that under P*."""
    sticking = float(sticking_share(tangential, friction * load))
    values = field(r, load)
    if sticking > 0.0:
        values = values - field(r, load * sticking)
    return friction * values


def _slip(
    gap: Callable[[ArrayLike, float], RealArray], r: ArrayLike, load: float, stick_load: RealArray, scale: float
) -> RealArray:
    """``scale`` μκ times the ``gap`` under P* less that under P, which is zero in contact."""
    if float(stick_load) == 0.0:
        raise InputError("tangential force must be less than friction coefficient times load, where slip has no limit.")
    return scale * (gap(r, float(stick_load)) - gap(r, load))


def _loop(load: RealArray, amplitude: RealArray, friction: float) -> RealArray:
    """Area 8 [Q δ(Q)/2 - ∫ δ dQ] of the loop for a compliance dδ/dP = -ln P, that of lines and
    waves.

    16μ² P_m² ∫ u artanh u du up to Q/2μP_m, with P_m = P - Q/2μ.
    """
    middle = load - 0.5 * amplitude / friction
    x = 0.5 * amplitude / (friction * middle)
    with np.errstate(divide="ignore", invalid="ignore"):
        exact = np.where(x < 1.0, 0.5 * (x - (1.0 - x) * (1.0 + x) * np.arctanh(x)), 0.5)
    series = sum(x ** (2 * j + 3) / ((2 * j + 1) * (2 * j + 3)) for j in range(9))  # 1e-18 at 0.15
    return np.asarray(16.0 * (friction * middle) ** 2 * np.where(x < 0.15, series, exact))


# A wave in partial slip, in its plane or across it (Ciavarella 1998; Jäger 1998).


@dataclass(frozen=True, eq=False, repr=False)
class WaveSlipAnswer(Tabled):
    """A wave under mean pressure and mean shear: arrays of one shape.

    Parameters
    ----------
    half_width, stick_half_width
        Half-widths a and c of a contact and of its stick zone in m.
    displacement
        Tangential displacement of the mean planes relative to each other in m.
    stiffness
        Derivative of the mean shear by it in Pa/m.
    dissipation
        Work of friction in J/m² of a cycle between ± the mean shear.
    pressure
        The mean pressure in Pa.
    """

    half_width: RealArray
    stick_half_width: RealArray
    displacement: RealArray
    stiffness: RealArray
    dissipation: RealArray
    pressure: RealArray


@dataclass(frozen=True)
class WaveContact:
    """A ``wave`` as a contact: its load is the mean pressure in Pa, at most that of full contact,
    its radius a half-width."""

    wave: Westergaard

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under mean pressures in Pa, >= 0, of any shape."""
        p = checked(load, "mean pressure (Pa)")
        a = 0.5 * self.wave.wavelength * self.wave.area_fraction(p)
        return ContactAnswer(
            p, self.wave.approach(p), a, 2.0 * a, self.wave.max_pressure(p), np.asarray(self.wave.stiffness(p))
        )

    def at_approach(self, approach: ArrayLike) -> ContactAnswer:
        """The contact at approaches of the mean planes in m, from 0 to the amplitude of the wave,
        of any shape."""
        delta = checked(approach, "approach (m)")
        if np.any(delta > self.wave.amplitude):
            raise InputError(
                f"approach (m) must be at most the amplitude of the wave, {self.wave.amplitude:g}, but is "
                f"{float(delta.max()):g}."
            )
        full = np.full_like(delta, self.wave.full_contact_pressure)
        return self.at_load(bisected(lambda p: self.wave.approach(p) - delta, 0.0 * full, full))

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at ``x`` in m (any shape) from a crest under the mean pressure
        ``load``."""
        return self.wave.pressure(x, load)


@dataclass(frozen=True)
class MindlinWave(Theory):
    """Gap Δ(1 - cos 2πx/λ) pressed by the mean pressure p̄, then sheared by q̄; it sticks within
    |x| < c.

        ω = p̄/p*,  ω_s = ω - q̄/(μ p*),  sin²(π a/λ) = ω,  sin²(π c/λ) = ω_s,
        δ_x = μ κ Δ [ω (1 - ln ω) - ω_s (1 - ln ω_s)].

    p* is that of the normal contact; from it on nothing opens, and nothing slips until p̄ - q̄/μ is
    less than p*.

    Examples
    --------
    >>> wave = MindlinWave(E_star=1e9, amplitude=1e-6, wavelength=1e-3, friction=0.5)
    >>> answer = wave.at_pressure(1e6, [0.1e6, 0.4e6])
    >>> [round(float(part), 3) for part in answer.stick_half_width / answer.half_width]
    [0.882, 0.426]
    """

    E_star: Modulus
    amplitude: Amplitude
    wavelength: Wavelength
    friction: Friction
    ratio: Ratio = 1.0
    name: ClassVar[str] = "mindlin-wave"
    title: ClassVar[str] = "Partial slip of a sinusoid"
    citation_keys: ClassVar[tuple[str, ...]] = ("Ciavarella1998", "Jager1998", "Westergaard1939")
    limits: ClassVar[tuple[Bound, ...]] = Westergaard.limits
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("tangential", "Pa", "mean shear stress"),
            "at_pressure",
            (
                Quantity("half_width", "m", "half-width of a contact"),
                Quantity("stick_half_width", "m", "half-width of the stick zone"),
                Quantity("displacement", "m", "tangential displacement of the mean planes"),
                Quantity("stiffness", "Pa/m", "derivative of the mean shear stress by it"),
                Quantity(
                    "dissipation", "J/m^2", "work of friction of a cycle between plus and minus the mean shear stress"
                ),
            ),
            (asked("pressure", "Pa", "mean pressure"),),
        ),
    )

    @property
    def normal(self) -> Westergaard:
        """The contact under the pressure alone."""
        return Westergaard(self.E_star, self.amplitude, self.wavelength)

    @property
    def contact(self) -> WaveContact:
        """The normal contact for ``PartialSlip``, on any path of mean pressure and mean shear
        stress."""
        return WaveContact(self.normal)

    def at_pressure(self, pressure: float, tangential: ArrayLike) -> WaveSlipAnswer:
        """Under mean ``pressure`` p̄ in Pa, > 0, and mean shear stress ``tangential`` q̄, 0 <=
        q̄ <= μp̄, of any shape."""
        p = require.positive(pressure, "mean pressure (Pa)")
        left = p * sticking_share(tangential, self.friction * p)
        a, c = (0.5 * self.wavelength * self.normal.area_fraction(value) for value in (p, left))
        scale = self.friction * self.ratio
        shift = scale * (self.normal.approach(p) - self.normal.approach(left))
        full, amplitude = self.normal.full_contact_pressure, self.friction * (p - left)
        if p <= full:
            unit = self.ratio * self.wavelength / (np.pi * self.E_star)
            dissipation = unit * _loop(np.asarray(p), amplitude, self.friction)
        else:  # above p* nothing gives way: 8 [q δ/2 - ∫ δ dq], ∫ ω (1 - ln ω) dω = 3ω²/4 - (ω²/2) ln ω
            s = np.minimum((p - amplitude / self.friction) / full, 1.0)
            below = 0.25 - s + 0.75 * s**2 - 0.5 * s**2 * np.log(np.maximum(s, 1e-300))
            rest = self.friction**2 * self.ratio * full * self.amplitude * below
            dissipation = np.asarray(8.0 * (0.5 * amplitude * shift - rest))
        return WaveSlipAnswer(
            half_width=a + 0.0 * c,
            stick_half_width=c,
            displacement=shift,
            stiffness=self.normal.stiffness(left) / self.ratio,
            dissipation=dissipation,
            pressure=p + 0.0 * c,
        )

    def traction(self, x: ArrayLike, pressure: float, tangential: float) -> RealArray:
        """Shear traction q in Pa at ``x`` in m (any shape) from a crest."""
        return _difference(self.normal.pressure, x, pressure, tangential, self.friction)

    def slip(self, x: ArrayLike, pressure: float, tangential: float) -> RealArray:
        """Motion of facing points past each other in m at ``x`` in m (any shape) from a crest."""
        left = pressure * sticking_share(tangential, self.friction * pressure)
        return _slip(self.normal.gap, x, pressure, left, self.friction * self.ratio)
