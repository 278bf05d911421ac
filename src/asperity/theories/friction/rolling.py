"""Steady rolling with creepage: Carter's cylinders, and ellipses after Kalker's linear theory, its
saturation, and FASTSIM.

The counter body rolls along +x, so that the leading edge is at x = +a; it slides over the body with
the creepages ξ_x, ξ_y and the spin φ (1/m) per distance rolled: the slip of rigid bodies is (ξ_x -
φy, ξ_y + φx). Forces are those on the body, which the creepage drags along.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.late import Tabled
from ...core.quantity import Quantity
from ...core.values import LARGEST, Length, Number, Pressure
from ..ask import Way, asked
from ..protocol import CONTACT_RADIUS, Bound, ContactAnswer, Modulus, Radius, Theory, checked, small_slope
from ..single.hertz import HertzLine, hertz_profile
from .kalker import LARGEST_RATIO, SMALLEST_RATIO, KalkerCoefficients, kalker_coefficients
from .partial_slip import Friction, sticking_share

# Rolling cylinders (Carter 1926; Johnson 1985, sec. 8.3).


@dataclass(frozen=True, eq=False, repr=False)
class CarterAnswer(Tabled):
    """Rolling cylinders under a tractive force: arrays of one shape.

    Parameters
    ----------
    stick_radius
        Half-width c of the stick zone, which reaches the leading edge, in m.
    creepage
        ξ, sliding per distance rolled.
    dissipation
        Work of friction per distance rolled and length in J/m² = N/m.
    normal
        The contact under the load alone.
    """

    stick_radius: RealArray
    creepage: RealArray
    dissipation: RealArray
    normal: ContactAnswer


@dataclass(frozen=True)
class CarterRolling(Theory):
    """Elastically similar cylinders that roll under the load P and the tractive force Q, both per
    length.

        c = a sqrt(1 - Q/(μ P)),  ξ = (μ a/R) [1 - sqrt(1 - Q/(μ P))],  W = ξ Q,
        q = μ p_0 [sqrt(1 - x²/a²) - (c/a) sqrt(1 - (x - a + c)²/c²)].

    Examples
    --------
    >>> roller = CarterRolling(E_star=1.1e11, radius=0.5, friction=0.3)
    >>> answer = roller.at_load(1e6, 1e5)
    >>> f"{float(answer.stick_radius / answer.normal.radius):.3f}, {float(answer.creepage):.2e}"
    '0.816, 2.65e-04'
    """

    E_star: Modulus
    radius: Radius
    friction: Friction
    name: ClassVar[str] = "carter"
    title: ClassVar[str] = "Carter, rolling cylinders"
    citation_keys: ClassVar[tuple[str, ...]] = ("Carter1926", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope(CONTACT_RADIUS.criterion, lambda theory, answer: answer.normal.radius / theory.radius),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("tangential", "N/m", "tractive force per length"),
            "at_load",
            (
                Quantity("normal.radius", "m", "half-width of the contact"),
                Quantity("stick_radius", "m", "half-width of the stick zone"),
                Quantity("creepage", "1", "sliding per distance rolled"),
                Quantity("dissipation", "N/m", "work of friction per distance and length"),
            ),
            (asked("load", "N/m", "normal force per length"),),
        ),
    )

    @property
    def normal(self) -> HertzLine:
        """The contact under the load alone."""
        return HertzLine(self.E_star, self.radius)

    def at_load(self, load: float, tangential: ArrayLike) -> CarterAnswer:
        """Under ``load`` P in N/m, > 0, and the ``tangential`` force Q in N/m, 0 <= Q <= μP, of any
        shape."""
        normal = self.normal.at_load(require.positive(load, "load per length (N/m)"))
        root = np.sqrt(sticking_share(tangential, self.friction * load))
        # 1 - sqrt(1 - s) = s/(1 + sqrt(1 - s))
        share = checked(tangential, "tangential force") / (self.friction * load)
        creepage = self.friction * normal.radius / self.radius * share / (1.0 + root)
        return CarterAnswer(normal.radius * root, creepage, creepage * share * self.friction * load, normal)

    def traction(self, x: ArrayLike, load: float, tangential: float) -> RealArray:
        """Shear traction on the body in Pa at ``x`` in m (any shape) from the middle."""
        answer, place = self.at_load(load, tangential), np.asarray(x, dtype=float)
        q, a, c = hertz_profile(place, answer.normal), answer.normal.radius, answer.stick_radius
        if float(c) > 0.0:
            q = q - answer.normal.max_pressure * c / a * np.sqrt(np.maximum(1.0 - ((place - a + c) / c) ** 2, 0.0))
        return np.asarray(self.friction * q)

    def slip_velocity(self, x: ArrayLike, load: float, tangential: float) -> RealArray:
        """Velocity of slip over that of rolling at ``x`` in m (any shape) from the middle; NaN
        outside of the contact.

        (μ/R) sqrt((x - a + c)² - c²) behind the stick zone.
        """
        answer, place = self.at_load(load, tangential), np.asarray(x, dtype=float)
        a, c = float(answer.normal.radius), float(answer.stick_radius)
        behind = np.maximum(a - c - place, c)
        slip = self.friction / self.radius * np.sqrt((behind - c) * (behind + c))
        return np.where(np.abs(place) <= a, slip, np.nan)


# Rolling ellipses.


@dataclass(frozen=True, eq=False, repr=False)
class CreepForces(Tabled):
    """Forces on the body: arrays of one shape.

    Parameters
    ----------
    force_x, force_y
        Along and across the direction of rolling in N.
    moment
        About the normal in N m.
    """

    force_x: RealArray
    force_y: RealArray
    moment: RealArray


SemiX: TypeAlias = Annotated[Length, "semi-axis a of the contact along the direction of rolling"]
SemiY: TypeAlias = Annotated[Length, "semi-axis b of the contact across it"]
Shear: TypeAlias = Annotated[Pressure, "shear modulus G of both bodies"]
Nu: TypeAlias = Annotated[float, Number(least=0.0, most=0.5), "Poisson's ratio of both bodies"]
Load: TypeAlias = Annotated[float, Number("N", above=0.0), "normal force P"]

FORCES = (
    Quantity("force_x", "N", "force on the body along the direction of rolling"),
    Quantity("force_y", "N", "force on the body across it"),
    Quantity("moment", "N*m", "moment on the body about the normal"),
)
"""What a rolling contact answers."""

BY_CREEPAGE = Way(
    asked("creepage", "1", "longitudinal creepage ξ_x"),
    "at_creepage",
    FORCES,
    (
        asked("lateral", "1", "lateral creepage ξ_y", 0.0),
        asked("spin", "1/m", "spin φ per distance rolled", 0.0),
    ),
    checked=False,
)

AXES = Bound(
    "ratio of the semi-axes",
    lambda theory, answer: theory.semi_x / theory.semi_y,
    SMALLEST_RATIO,
    LARGEST_RATIO,
    "Kalker1990",
    "The table of the coefficients ends there.",
)


@dataclass(frozen=True)
class KalkerLinear(Theory):
    """Identical bodies at vanishing creepage, which stick everywhere.

        F_x = a b G C_11 ξ_x,  F_y = a b G C_22 ξ_y + (a b)^(3/2) G C_23 φ,
        M_z = -(a b)^(3/2) G C_23 ξ_y + (a b)² G C_33 φ.

    The coefficients are those of Kalker's table, see ``kalker_coefficients``.

    Examples
    --------
    >>> wheel = KalkerLinear(semi_x=6e-3, semi_y=6e-3, shear=8e10, nu=0.25)
    >>> print(f"{float(wheel.at_creepage(1e-4).force_x):.0f} N")
    1187 N
    """

    semi_x: SemiX
    semi_y: SemiY
    shear: Shear
    nu: Nu
    name: ClassVar[str] = "kalker-linear"
    title: ClassVar[str] = "Kalker, linear theory of rolling"
    citation_keys: ClassVar[tuple[str, ...]] = ("Kalker1967", "Kalker1990")
    limits: ClassVar[tuple[Bound, ...]] = (AXES,)
    ways: ClassVar[tuple[Way, ...]] = (BY_CREEPAGE,)

    @property
    def coefficients(self) -> KalkerCoefficients:
        """C11, C22, C23 and C33."""
        return kalker_coefficients(self.semi_x / self.semi_y, self.nu)

    def at_creepage(self, creepage: ArrayLike, lateral: ArrayLike = 0.0, spin: ArrayLike = 0.0) -> CreepForces:
        """Forces at ``creepage`` ξ_x, ``lateral`` creepage ξ_y and ``spin`` φ in 1/m, which
        broadcast."""
        x, y, phi = _creepages(creepage, lateral, spin)
        C, size = self.coefficients, math.sqrt(self.semi_x * self.semi_y)
        scale = self.shear * size**2
        return CreepForces(
            force_x=scale * C.C11 * x,
            force_y=scale * (C.C22 * y + size * C.C23 * phi),
            moment=scale * size * (size * C.C33 * phi - C.C23 * y),
        )


@dataclass(frozen=True)
class ShenHedrickElkins(Theory):
    """Kalker's linear forces F, saturated at the limit of friction as by Vermeulen and Johnson.

        F' = μ P (ρ - ρ²/3 + ρ³/27),  ρ = F/(μ P) ≤ 3.

    For larger ρ F' is μ P. The direction is that of the linear force; the moment is left out. For
    small spin.
    """

    semi_x: SemiX
    semi_y: SemiY
    shear: Shear
    nu: Nu
    load: Load
    friction: Friction
    name: ClassVar[str] = "shen-hedrick-elkins"
    title: ClassVar[str] = "Shen-Hedrick-Elkins, creep force"
    citation_keys: ClassVar[tuple[str, ...]] = ("Shen1983", "Vermeulen1964")
    limits: ClassVar[tuple[Bound, ...]] = (AXES,)
    ways: ClassVar[tuple[Way, ...]] = (BY_CREEPAGE,)

    def at_creepage(self, creepage: ArrayLike, lateral: ArrayLike = 0.0, spin: ArrayLike = 0.0) -> CreepForces:
        """Forces as of ``KalkerLinear``; the moment is NaN."""
        linear = KalkerLinear(self.semi_x, self.semi_y, self.shear, self.nu).at_creepage(creepage, lateral, spin)
        rho = np.hypot(linear.force_x, linear.force_y) / (self.friction * self.load)
        factor = np.where(rho < 3.0, 1.0 - rho / 3.0 + rho**2 / 27.0, 1.0 / np.maximum(rho, 1.0))
        return CreepForces(factor * linear.force_x, factor * linear.force_y, np.full_like(rho, np.nan))


@dataclass(frozen=True)
class Fastsim(Theory):
    """Surface that yields to the traction at the same place only, u = L q, under the parabolic
    bound of a Hertz ellipse.

        L_1 = 8 a/(3 G C_11),  L_2 = 8 a/(3 G C_22),  L_3 = π a²/(4 G sqrt(a b) C_23),
        |q| ≤ (2 μ P/(π a b)) (1 - x²/a² - y²/b²).

    From the leading edge dq/dx = -(ξ_x/L_1 - φ y/L_3, ξ_y/L_2 + φ x/L_3), cut off at the bound.
    Forces err by some 5 to 10 % of those of the half-space, 20 % with large spin.
    """

    semi_x: SemiX
    semi_y: SemiY
    shear: Shear
    nu: Nu
    load: Load
    friction: Friction
    name: ClassVar[str] = "fastsim"
    title: ClassVar[str] = "Kalker, FASTSIM"
    citation_keys: ClassVar[tuple[str, ...]] = ("Kalker1982",)
    limits: ClassVar[tuple[Bound, ...]] = (AXES,)
    ways: ClassVar[tuple[Way, ...]] = (BY_CREEPAGE,)

    @property
    def flexibilities(self) -> tuple[float, float, float]:
        """L1, L2 and L3 in m/Pa, which give the forces of the linear theory where nothing slips."""
        a, G, size = self.semi_x, self.shear, math.sqrt(self.semi_x * self.semi_y)
        C = kalker_coefficients(a / self.semi_y, self.nu)
        return 8.0 * a / (3.0 * G * C.C11), 8.0 * a / (3.0 * G * C.C22), math.pi * a**2 / (4.0 * G * size * C.C23)

    def at_creepage(
        self, creepage: ArrayLike, lateral: ArrayLike = 0.0, spin: ArrayLike = 0.0, cells: int = 60
    ) -> CreepForces:
        """Forces as of ``KalkerLinear``, from ``cells`` strips of as many cells; the error falls as
        1/cells²."""
        a, b = self.semi_x, self.semi_y
        xi_x, xi_y, phi = (part[..., None] for part in _creepages(creepage, lateral, spin))
        L1, L2, L3 = self.flexibilities
        angle = math.pi * ((np.arange(cells) + 0.5) / cells - 0.5)  # strips of y = b sin: fine where they are short
        y, long = b * np.sin(angle), a * np.cos(angle)
        step = 2.0 * long / cells
        area = math.pi / cells * b * np.cos(angle) * step
        peak = 2.0 * self.friction * self.load / (math.pi * a * b)
        qx = qy = np.zeros(np.broadcast_shapes(xi_x.shape, y.shape))
        force_x, force_y, moment = (np.zeros(xi_x.shape[:-1]) for _ in range(3))
        for i in range(cells):
            way = step if i else 0.5 * step  # to the middle of the cell
            x = long - (i + 0.5) * step
            qx, qy = qx + way * (xi_x / L1 - phi * y / L3), qy + way * (xi_y / L2 + phi * (x + 0.5 * way) / L3)
            bound = peak * (long - x) * (long + x) / a**2
            cut = bound / np.maximum(np.hypot(qx, qy), bound)
            qx, qy = cut * qx, cut * qy
            force_x = force_x + np.sum(area * qx, axis=-1)
            force_y = force_y + np.sum(area * qy, axis=-1)
            moment = moment + np.sum(area * (x * qy - y * qx), axis=-1)
        return CreepForces(force_x, force_y, moment)


def _creepages(creepage: ArrayLike, lateral: ArrayLike, spin: ArrayLike) -> tuple[RealArray, RealArray, RealArray]:
    """Finite numbers of one shape."""
    what = ("creepage", "lateral creepage", "spin (1/m)")
    parts = (checked(value, name, lowest=-LARGEST) for value, name in zip((creepage, lateral, spin), what, strict=True))
    x, y, phi = np.broadcast_arrays(*parts)
    return x, y, phi
