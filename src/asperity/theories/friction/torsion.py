"""Torsion about the normal: full stick, a sphere with a slipping rim, and any pressure (Lubkin
1951; Johnson 1985, sec. 7.6).

Torsion couples to nothing else, so all of this is exact for every Poisson's ratio, if the pressure
was applied without radial friction. With F(x) = ∫ q/sqrt(r² - x²) dr over x < r < a the torque is
M = 8 ∫ x² F dx; where it sticks F is constant, 2Gθ with the rotation θ of the bodies against each
other.
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
from ...core.quadrature import geometric
from ...core.quantity import Quantity
from ...core.values import Length, Pressure
from ..ask import Way, asked
from ..protocol import CONTACT_RADIUS, Bound, ContactAnswer, Modulus, Radius, Theory, bisected, checked, small_slope
from ..single.hertz import HertzPoint, hertz_profile
from .partial_slip import Friction

Torsional: TypeAlias = Annotated[Pressure, Help("torsional modulus G of both bodies, 1/G = 1/G1 + 1/G2", of="bodies")]

TORQUE = asked("torque", "N*m", "torque")
_SERIES = 0.1  # k² below which K - E would lose more than a digit


@dataclass(frozen=True, eq=False, repr=False)
class TwistAnswer(Tabled):
    """A contact under a torque: arrays of one shape.

    Parameters
    ----------
    stick_radius
        Radius c of the stick zone in m.
    rotation
        Rotation θ of the bodies against each other in rad.
    stiffness
        Derivative of the torque by it in N m/rad.
    normal
        The contact under the load alone.
    """

    stick_radius: RealArray
    rotation: RealArray
    stiffness: RealArray
    normal: ContactAnswer


@dataclass(frozen=True)
class StickingTwist(Theory):
    """Disc of radius a that is twisted without slip.

    M = (16/3) G a³ θ,  q = 3 M r/(4 π a³ sqrt(a² - r²)).
    """

    G_torsion: Torsional
    radius: Annotated[Length, "radius a of the contact"]
    name: ClassVar[str] = "sticking-twist"
    title: ClassVar[str] = "Torsion without slip"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Lubkin1951")
    numbers: ClassVar[tuple[Quantity, ...]] = (Quantity("stiffness", "N*m", "torque per rotation"),)

    @property
    def stiffness(self) -> float:
        """M/θ in N m."""
        return 16.0 / 3.0 * self.G_torsion * self.radius**3

    def traction(self, r: ArrayLike, torque: float) -> RealArray:
        """Circumferential traction in Pa at the distance ``r`` in m (any shape) from the axis;
        infinite at the edge."""
        distance, a = np.abs(np.asarray(r, dtype=float)), self.radius
        scale = 3.0 * require.finite(torque, "torque (N m)") / (4.0 * np.pi * a**3)
        with np.errstate(divide="ignore"):
            inside = scale * distance / np.sqrt(np.maximum(a**2 - distance**2, 0.0))
        return np.where(distance <= a, inside, 0.0)


@dataclass(frozen=True)
class LubkinSphere(Theory):
    """Sphere pressed by P, then twisted by M; it sticks within the radius c.

        G θ = (μ p_0/2) [K(k) - E(k)],  k² = 1 - c²/a²,
        M = (8/3) μ p_0 ∫_c^a x² E(sqrt(1 - x²/a²)) dx ≤ (3 π/16) μ P a.

    K and E are the complete elliptic integrals.

    Examples
    --------
    >>> ball = LubkinSphere(E_star=1e9, radius=1e-2, G_torsion=4e8, friction=0.3)
    >>> answer = ball.at_load(1.0, 0.5 * ball.largest_torque(1.0))
    >>> print(f"{float(answer.stick_radius / answer.normal.radius):.4f}")
    0.8136
    """

    E_star: Modulus
    radius: Radius
    G_torsion: Torsional
    friction: Friction
    name: ClassVar[str] = "lubkin"
    title: ClassVar[str] = "Lubkin, torsion of spheres"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Lubkin1951")
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope(CONTACT_RADIUS.criterion, lambda theory, answer: answer.normal.radius / theory.radius),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            TORQUE,
            "at_load",
            (
                Quantity("normal.radius", "m", "radius of the contact"),
                Quantity("stick_radius", "m", "radius of the stick zone"),
                Quantity("rotation", "rad", "rotation of the bodies against each other"),
                Quantity("stiffness", "N*m", "derivative of the torque by it"),
            ),
            (asked("load", "N", "normal force"),),
        ),
    )

    @property
    def normal(self) -> HertzPoint:
        """The contact under the load alone."""
        return HertzPoint(self.E_star, self.radius)

    def largest_torque(self, load: float) -> float:
        """(3π/16) μPa in N m, at which all slips, under the ``load`` in N."""
        a = float(self.normal.at_load(require.positive(load, "load (N)")).radius)
        return 3.0 * np.pi / 16.0 * self.friction * load * a

    def at_load(self, load: float, torque: ArrayLike) -> TwistAnswer:
        """Under ``load`` P in N, > 0, and the ``torque`` M in N m, at least zero and less than the
        largest, of any shape."""
        largest, M = self.largest_torque(load), checked(torque, "torque (N m)")
        if np.any(largest * (1.0 + 1e-12) < M):
            raise InputError(
                f"torque must be at most {largest:.6g} N m, but is {float(M.max()):.6g}. Beyond it the contact slides."
            )
        share = np.minimum(M / largest, 1.0)
        rim = bisected(lambda s: self._torque(1.0 - s) - share, np.zeros_like(share), np.ones_like(share))
        return self._answer(load, 1.0 - rim)

    def at_stick_radius(self, load: float, share: ArrayLike) -> TwistAnswer:
        """Under ``load`` P in N with the stick radius a ``share`` of the contact radius, more than
        0 and at most 1."""
        k = checked(share, "stick radius over contact radius")
        if np.any((k > 1.0) | (k == 0.0)):
            raise InputError(f"stick radius over contact radius must be more than 0 and at most 1, but is {k!r}.")
        return self._answer(load, k)

    def torque(self, load: float, share: ArrayLike) -> RealArray:
        """Torque M in N m under ``load`` in N that leaves the ``share`` c/a, from 0 to 1, of any
        shape, sticking."""
        return self.largest_torque(load) * self._torque(checked(share, "stick radius over contact radius"))

    def traction(self, r: ArrayLike, load: float, torque: float) -> RealArray:
        """Circumferential traction in Pa at the distance ``r`` in m (any shape) from the axis.

        (2μp0 r/π) ∫ E(sqrt(1 - x²/a²))/(x sqrt(x² - r²)) dx over c < x < a where it sticks.
        """
        from scipy.special import ellipe

        answer = self.at_load(load, torque)
        a, c = float(answer.normal.radius), float(answer.stick_radius)
        distance = np.abs(np.asarray(r, dtype=float))
        slipping = self.friction * hertz_profile(distance, answer.normal)
        inside = np.minimum(distance, c)[..., None]
        x, weight = geometric(np.sqrt(c**2 - inside[..., 0] ** 2), np.sqrt(a**2 - inside[..., 0] ** 2))
        square = x**2 + inside**2
        integral = np.sum(weight * ellipe(1.0 - square / a**2) / np.maximum(square, np.finfo(float).tiny), axis=-1)
        sticking = 2.0 / np.pi * self.friction * answer.normal.max_pressure * inside[..., 0] * integral
        return np.where(distance < c, sticking, slipping)

    def _answer(self, load: float, share: RealArray) -> TwistAnswer:
        normal = self.normal.at_load(require.positive(load, "load (N)"))
        rotation = (
            0.5 * self.friction * normal.max_pressure / self.G_torsion * (1.0 - share**2) * elliptic_ratio(share**2)
        )
        # dM/dc and dθ/dc hold the same E(k)
        stiffness = 16.0 / 3.0 * self.G_torsion * (share * normal.radius) ** 3
        return TwistAnswer(share * normal.radius, rotation, stiffness, normal)

    def _torque(self, share: RealArray) -> RealArray:
        """M over the largest torque, (64/3π²) ∫ x² E dx over c < x < 1."""
        from scipy.special import ellipe

        x, weight = geometric(share, np.ones_like(share))
        return np.asarray(64.0 / (3.0 * np.pi**2) * np.sum(weight * x**2 * ellipe(1.0 - x**2), axis=-1))


def elliptic_ratio(n: RealArray) -> RealArray:
    """(K - E)/k² of the complementary parameter 0 < n <= 1, n = 1 - k²; a series where K and E
    cancel."""
    from scipy.special import ellipe, ellipkm1

    m = 1.0 - n
    small = m < _SERIES
    order = np.arange(1.0, 18.0)  # 0.1^17
    coefficients = np.cumprod((1.0 - 0.5 / order) ** 2) * 2.0 * order / (2.0 * order - 1.0)
    series = 0.5 * np.pi * np.polynomial.polynomial.polyval(np.where(small, m, 0.0), coefficients)
    return np.where(small, series, (ellipkm1(n) - ellipe(m)) / np.where(small, 1.0, m))


def slip_transform(pressure: Callable[[RealArray], RealArray], x: RealArray, a: float) -> RealArray:
    """x ∫ p/sqrt(r² - x²) dr over x < r < a from ``pressure`` ∫ rp/sqrt(r² - x²) dr = P(x), at
    ``x`` (n,) in (0, a].

    P(x) - (2x/π) ∫ P(t) (K - E)/(k²t²) dt over x < t < a, k² = 1 - x²/t²: the traction of a
    slipping annulus over μ, of torsion as well as of radial friction.
    """
    t, weight = geometric(x, np.full_like(x, a))
    kernel = elliptic_ratio((x[:, None] / t) ** 2) / t**2
    return np.asarray(pressure(x) - 2.0 * x / np.pi * np.sum(weight * kernel * pressure(t), axis=-1))
