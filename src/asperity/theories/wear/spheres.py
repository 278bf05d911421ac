"""Spheres and cylinders that are worn flat on a body that does not wear, and spheres with a
coating."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Length, Number
from ..ask import Way
from ..protocol import CONTACT_RADIUS, Bound, Modulus, Theory, bisected, checked, small_slope
from .laws import DISTANCE, Load, WearCoefficient

# A sphere with the even pressure p on r < a is worn so that w(r) = (a² - r²)/2R + u(a) - u(r), with
# the displacements u(0) = 2pa/E*, u(a) = 4pa/πE*, and 16pa/3πE* in the mean. With Hertz's radius A
# of the load, P = 4E*A³/3R, centre and volume are
#     w(0) = (a² - _DEPTH A³/a)/2R,  V = k P s = π (a⁴ - _VOLUME A³ a)/4R.

_DEPTH = 8.0 / (3.0 * math.pi) * (2.0 - 4.0 / math.pi)
_VOLUME = 64.0 / (9.0 * math.pi**2)

_HALVINGS = 60


def _late_radius(quartic: RealArray) -> RealArray:
    """Root z > 0 of z⁴ - _VOLUME z = ``quartic`` >= 0."""
    high = 1.0 + np.sqrt(np.sqrt(quartic))
    return bisected(lambda z: z**4 - _VOLUME * z - quartic, np.full_like(quartic, 0.5), high, _HALVINGS)


def worn_from_hertz(quartic: RealArray) -> tuple[RealArray, RealArray]:
    """Contact radius over Hertz's A, and depth at the centre over A²/2R, of a sphere worn to
    4 R k P s/(π A⁴) = ``quartic``, >= 0.

    Early the pressure is Hertz's, late uniform; the radius is the larger one of both, the depth the
    smaller one.
    """
    early = np.sqrt(np.sqrt(1.0 + quartic))
    late = _late_radius(quartic)
    return np.maximum(early, late), np.minimum(1.5 * (early**2 - 1.0), late**2 - _DEPTH / late)


def radius_of_depth(depth: RealArray) -> RealArray:
    """Contact radius over Hertz's A of a sphere that is worn to the ``depth`` over A²/2R, under
    uniform pressure: z² - _DEPTH/z."""
    high = 1.0 + np.sqrt(depth)
    return bisected(lambda z: z**2 - _DEPTH / z - depth, np.full_like(depth, 0.5), high, _HALVINGS)


@dataclass(frozen=True, eq=False, repr=False)
class WornSphereAnswer(Tabled):
    """A worn sphere at some sliding distances (m), arrays of one shape: contact ``radius`` and
    ``depth`` at the centre in m, worn ``volume`` in m³, ``mean_pressure`` in Pa."""

    distance: RealArray
    radius: RealArray
    depth: RealArray
    volume: RealArray
    mean_pressure: RealArray


_RADIUS = Quantity("radius", "m", "contact radius")
_CENTRE = Quantity("depth", "m", "worn depth at the centre")
_VOLUME_COLUMN = Quantity("volume", "m^3", "worn volume")
_MEAN = Quantity("mean_pressure", "Pa", "load over contact area")


@dataclass(frozen=True)
class WearingSphere(Theory):
    """A sphere, such as the end of a pin, that alone wears from Hertz's contact of radius a_H:

        a_1⁴ = a_H⁴ + 4 R k P s/π,  a_2⁴ - 64/(9π²) a_H³ a_2 = 4 R k P s/π,
        w_1 = 3 (a_1² - a_H²)/(4 R),  w_2 = (a_2² - 0.6169 a_H³/a_2)/(2 R).

    The first radius and depth at the centre are those of the start, when the largest pressure is
    that of Hertz, 1.5 times the mean one; the second are those of uniform pressure and the elastic
    displacements under it. The larger radius holds, and the smaller depth. Against a solution in
    rings the radius is within 2.5 %, the depth within 3.5 % at all distances, and both are within
    1 % from twice Hertz's radius on.

    Examples
    --------
    >>> ball = WearingSphere(110e9, radius=3e-3, load=10.0, coefficient=1e-15)
    >>> answer = ball.at_distance([0.0, 1.0, 100.0])
    >>> [f"{a * 1e6:.0f} µm" for a in answer.radius]
    ['59 µm', '84 µm', '249 µm']
    """

    E_star: Modulus
    radius: Annotated[Length, "radius of curvature R of the sphere"]
    load: Load
    coefficient: WearCoefficient
    name: ClassVar[str] = "wearing-sphere"
    title: ClassVar[str] = "Wearing sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Archard1953", "Kauzlarich2001", "Goryacheva1998", "Hertz1882")
    limits: ClassVar[tuple[Bound, ...]] = (CONTACT_RADIUS,)
    numbers: ClassVar[tuple[Quantity, ...]] = (Quantity("hertz_radius", "m", "contact radius before any wear"),)
    ways: ClassVar[tuple[Way, ...]] = (Way(DISTANCE, "at_distance", (_RADIUS, _CENTRE, _VOLUME_COLUMN, _MEAN)),)

    @property
    def hertz_radius(self) -> float:
        """a_H in m."""
        return math.cbrt(0.75 * self.load * self.radius / self.E_star)

    def at_distance(self, distance: ArrayLike) -> WornSphereAnswer:
        """The sphere after the sliding ``distance`` in m, >= 0, of any shape."""
        s = checked(distance, "sliding distance (m)")
        volume = self.coefficient * self.load * s
        hertz = self.hertz_radius
        radius, depth = worn_from_hertz(4.0 * self.radius * volume / (math.pi * hertz**4))
        a = hertz * radius
        return WornSphereAnswer(s, a, hertz**2 / (2.0 * self.radius) * depth, volume, self.load / (math.pi * a**2))


# A cylinder of the load P per length: u(0) - u(a) = 2 ln 2 P/πE*, and ∫ u - u(a) = 2Pa/πE* over the
# width; Hertz's half-width A has A² = 4PR/πE*.


@dataclass(frozen=True, eq=False, repr=False)
class WornCylinderAnswer(Tabled):
    """A worn cylinder at some sliding distances (m), arrays of one shape: ``half_width`` of the
    contact and ``depth`` in its middle in m, worn ``section`` in m², ``mean_pressure`` in Pa."""

    distance: RealArray
    half_width: RealArray
    depth: RealArray
    section: RealArray
    mean_pressure: RealArray


@dataclass(frozen=True)
class WearingCylinder(Theory):
    """A cylinder under the load P per length, such as that of a fretting test with a small stroke,
    from Hertz's contact of half-width a_H. If its flat wears too, k is the sum of both coefficients
    and the depth that of both.

        a_1³ = a_H³ + (3/2) R k P s,  a_2³ - (3/4) a_H² a_2 = (3/2) R k P s,
        w_1 = (2/π) (a_1² - a_H²)/R,  w_2 = (a_2² - a_H² ln 2)/(2 R).

    The first are those of the start, when the largest pressure is that of Hertz, 4/π times the mean
    one; the second are those of uniform pressure. The larger half-width and the smaller depth hold.
    Both are within 4 % of the numerical solution at all distances, and within 0.5 % from three
    times Hertz's half-width on.

    Examples
    --------
    >>> both = WearingCylinder(110e9, radius=6e-3, load=18.5e3, coefficient=4.8e-14)
    >>> worn = both.at_distance(18000 * 97e-6)
    >>> flat = worn.depth.item() * 2.9 / 4.8
    >>> f"{worn.half_width.item() * 1e3:.3f} mm, {flat * 1e6:.2f} µm of the flat"
    '0.242 mm, 2.91 µm of the flat'
    """

    E_star: Modulus
    radius: Annotated[Length, "radius of curvature R of the cylinder"]
    load: Annotated[float, Number("N/m", above=0.0), "normal force P per length"]
    coefficient: WearCoefficient
    name: ClassVar[str] = "wearing-cylinder"
    title: ClassVar[str] = "Wearing cylinder"
    citation_keys: ClassVar[tuple[str, ...]] = ("Archard1953", "Goryacheva1998", "Hertz1882")
    limits: ClassVar[tuple[Bound, ...]] = (
        small_slope("half-width over radius of curvature", lambda theory, answer: answer.half_width / theory.radius),
    )
    numbers: ClassVar[tuple[Quantity, ...]] = (Quantity("hertz_half_width", "m", "half-width before any wear"),)
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            DISTANCE,
            "at_distance",
            (
                Quantity("half_width", "m", "half-width of the contact"),
                Quantity("depth", "m", "worn depth in the middle"),
                Quantity("section", "m^2", "worn volume per length"),
                Quantity("mean_pressure", "Pa", "load over width"),
            ),
        ),
    )

    @property
    def hertz_half_width(self) -> float:
        """a_H in m."""
        return math.sqrt(4.0 * self.load * self.radius / (math.pi * self.E_star))

    def at_distance(self, distance: ArrayLike) -> WornCylinderAnswer:
        """The cylinder after the sliding ``distance`` in m, >= 0, of any shape."""
        s = checked(distance, "sliding distance (m)")
        section, hertz = self.coefficient * self.load * s, self.hertz_half_width
        cubic = 1.5 * self.radius * section / hertz**3
        early, high = np.cbrt(1.0 + cubic), 1.0 + np.cbrt(cubic)
        late = bisected(lambda z: z**3 - 0.75 * z - cubic, np.full_like(cubic, 0.5), high, _HALVINGS)
        a = hertz * np.maximum(early, late)
        depth = np.minimum(4.0 / math.pi * (early**2 - 1.0), late**2 - math.log(2.0))
        return WornCylinderAnswer(s, a, hertz**2 / (2.0 * self.radius) * depth, section, 0.5 * self.load / a)


@dataclass(frozen=True, eq=False, repr=False)
class CoatedSphereAnswer(Tabled):
    """A coated sphere at some sliding distances (m), arrays of one shape: contact ``radius``,
    ``core`` radius where the coating is gone and ``depth`` at the centre in m;
    ``coating_pressure`` on the coating and ``substrate_pressure`` on the core in Pa, NaN without
    one; ``hertz_ratio`` of the contact radius to that before any wear."""

    distance: RealArray
    radius: RealArray
    core: RealArray
    depth: RealArray
    coating_pressure: RealArray
    substrate_pressure: RealArray
    hertz_ratio: RealArray


WORN_FAR = Bound(
    "contact radius over that before any wear",
    lambda theory, answer: answer.hertz_ratio,
    3.0,
    math.inf,
    "Goryacheva1998",
    "The pressure is still that of the unworn sphere in part: after break-through the depth is up to a tenth low.",
    ("depth",),
)


@dataclass(frozen=True)
class WearingCoatedSphere(Theory):
    """A sphere with a coating of thickness t, worn through at the centre: a ring of coating (1)
    stays around a core of substrate (2), and all of the contact wears at one rate.

        p_1 k_1 = p_2 k_2,  a² - b² = 2 R t,  b² = 2 R y,
        2 π R t y/k_1 + π R y²/k_2 = P (s - s_b)

    with the core of radius b worn by y since the break-through at s_b. The area of the ring between
    two concentric spheres is π (2 R t - t²), whatever the depth. Until then, and for the elastic
    part of the radius a of the contact, the sphere wears as without a coating; both solids have one
    modulus.

    Against a solution in rings after break-through: radii of contact and core within 1 % and the
    depth within 2.5 % from three times Hertz's radius on, all within 0.1 % from eight times on.

    Examples
    --------
    >>> ball = WearingCoatedSphere(110e9, 3e-3, 10.0, 1e-15, 1e-14, thickness=1e-6)
    >>> f"life {ball.life:.2f} m, core {ball.at_distance(10.0).core.item() * 1e6:.0f} µm"
    'life 1.15 m, core 153 µm'
    """

    E_star: Modulus
    radius: Annotated[Length, "radius of curvature R of the sphere"]
    load: Load
    coating_coefficient: Annotated[WearCoefficient, Help("wear coefficient k1 of the coating", of="bodies")]
    substrate_coefficient: Annotated[WearCoefficient, Help("wear coefficient k2 of the substrate", of="bodies")]
    thickness: Annotated[Length, "thickness t of the coating"]
    name: ClassVar[str] = "wearing-coated-sphere"
    title: ClassVar[str] = "Wearing sphere with a coating"
    citation_keys: ClassVar[tuple[str, ...]] = ("Archard1953", "Goryacheva1998", "Hertz1882")
    limits: ClassVar[tuple[Bound, ...]] = (CONTACT_RADIUS, WORN_FAR)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("hertz_radius", "m", "contact radius before any wear"),
        Quantity("life", "m", "sliding distance to break-through at the centre"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            DISTANCE,
            "at_distance",
            (
                _RADIUS,
                Quantity("core", "m", "radius within which the coating is gone"),
                _CENTRE,
                Quantity("coating_pressure", "Pa", "mean pressure on the coating"),
                Quantity("substrate_pressure", "Pa", "mean pressure on the substrate"),
            ),
        ),
    )

    @property
    def hertz_radius(self) -> float:
        """a_H in m."""
        return math.cbrt(0.75 * self.load * self.radius / self.E_star)

    @property
    def life(self) -> float:
        """s_b in m."""
        depth = self.thickness / self._sagitta
        # by Hertz's pressure 1.5 (sqrt(1 + x) - 1), by uniform pressure from the radius
        early = (1.0 + depth / 1.5) ** 2 - 1.0
        radius = float(radius_of_depth(np.array(depth)))
        return max(early, radius**4 - _VOLUME * radius) / self._quartic

    def at_distance(self, distance: ArrayLike) -> CoatedSphereAnswer:
        """The sphere after the sliding ``distance`` in m, >= 0, of any shape."""
        s = checked(distance, "sliding distance (m)")
        ratio, before = worn_from_hertz(self._quartic * np.minimum(s, self.life))
        core, ring = self._core(np.maximum(s - self.life, 0.0))
        depth = np.where(s < self.life, self._sagitta * before, self.thickness + core**2 / (2.0 * self.radius))
        ratio = np.where(s < self.life, ratio, np.maximum(ratio, radius_of_depth(depth / self._sagitta)))
        a = self.hertz_radius * ratio
        alone = self.load / (math.pi * a**2)
        stiffer = self.load / (ring + math.pi * core**2 * self.coating_coefficient / self.substrate_coefficient)
        coating = np.where(core > 0.0, stiffer, alone)
        substrate = np.where(core > 0.0, stiffer * self.coating_coefficient / self.substrate_coefficient, np.nan)
        return CoatedSphereAnswer(s, a, core, np.asarray(depth), coating, substrate, ratio)

    def _core(self, since: RealArray) -> tuple[RealArray, float]:
        """Radius in m of the core at distances ``since`` break-through, and area in m² of the
        ring."""
        ring = 2.0 * math.pi * self.radius * self.thickness
        linear = ring / self.coating_coefficient
        square = math.pi * self.radius / self.substrate_coefficient
        work = self.load * since
        depth = 2.0 * work / (linear + np.sqrt(linear**2 + 4.0 * square * work))
        return np.sqrt(2.0 * self.radius * depth), ring

    @property
    def _sagitta(self) -> float:
        """a_H²/2R in m."""
        return self.hertz_radius**2 / (2.0 * self.radius)

    @property
    def _quartic(self) -> float:
        """4 R k1 P/(π a_H⁴) in 1/m."""
        return 4.0 * self.radius * self.coating_coefficient * self.load / (math.pi * self.hertz_radius**4)
