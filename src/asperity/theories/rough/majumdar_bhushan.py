"""Fractal elastic-plastic contact of surfaces of one fractal dimension (Majumdar & Bhushan 1991),
and of two (Bhushan & Majumdar 1992)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError, NoSolutionError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.scipy_parts import optimize, special
from ...core.values import HardnessValue, Length, Number
from ..ask import PRESSURE, Way, asked
from ..protocol import (
    FEW_CONTACTS,
    ISOTROPY,
    MEASURED_SLOPES,
    QUANTITIES,
    Bound,
    Modulus,
    Prediction,
    Theory,
    bisected,
    curve,
    prediction,
)
from ..statistics.roughness import Roughness

# Sizes of the contact spots of a fractal surface: Korcak's law of islands (Mandelbrot 1982;
# Majumdar & Bhushan 1991).


@dataclass(frozen=True)
class SpotSizes:
    """N(A > a) = (a_l/a)^(D/2) spots larger than a, none larger than a_l; without bound towards
    small ones.

    InputError if the dimension is out of its range.

    Parameters
    ----------
    dimension
        Fractal dimension D of the profile, 1 < D < 2.
    """

    dimension: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Majumdar1991",)

    def __post_init__(self) -> None:
        require.between(self.dimension, 1.0, 2.0, "fractal dimension of a profile")

    def larger_than(self, spot: ArrayLike, largest: ArrayLike) -> RealArray:
        """Number of spots with more than the area ``spot`` in m² (any shape), ``largest`` a_l in
        m²."""
        a, limit = spot_areas(spot), spot_areas(largest)
        return np.asarray(np.where(a <= limit, (limit / a) ** (0.5 * self.dimension), 0.0))

    def density(self, spot: ArrayLike, largest: ArrayLike) -> RealArray:
        """Number n(a) of spots per area in 1/m² of the area ``spot``: (D/2) a_l^(D/2)/a^(D/2+1)."""
        return np.asarray(0.5 * self.dimension * self.larger_than(spot, largest) / spot_areas(spot))

    def share_below(self, spot: ArrayLike, largest: ArrayLike) -> RealArray:
        """Share of the real area in spots smaller than ``spot`` in m²: (a/a_l)^(1-D/2)."""
        return np.asarray(np.minimum(1.0, spot_areas(spot) / spot_areas(largest)) ** (1.0 - 0.5 * self.dimension))

    def area(self, largest: ArrayLike) -> RealArray:
        """Area in m² of all spots when the largest has ``largest`` m²: D a_l/(2-D)."""
        return np.asarray(self.dimension / (2.0 - self.dimension) * spot_areas(largest))

    def largest(self, area: ArrayLike) -> RealArray:
        """Area a_l in m² of the largest spot when all together have ``area`` m²."""
        return np.asarray((2.0 - self.dimension) / self.dimension * spot_areas(area))


def spot_areas(value: ArrayLike) -> RealArray:
    """Return ``value`` in m² as an array, any shape, if all are positive and finite. InputError if
    they are not."""
    areas = np.asarray(value, dtype=float)
    if not (np.isfinite(areas).all() and (areas > 0.0).all()):
        raise InputError(
            f"area of a contact spot (m^2) must be positive and finite, but its least value is {areas.min():g}."
        )
    return areas


ATOM = 1e-19
"""Area of an atom in m²."""

_LARGEST = 700.0  # logarithm of the largest area that a float holds


def _self_affine_range(theory: MajumdarBhushan, roughness: Roughness) -> float | None:
    """Longest over shortest length of self-affine profiles; None where it is not known."""
    found = roughness.fractal
    return None if found is None or math.isnan(found.longest) else found.longest / found.shortest


class SizesOfSpots(Protocol):
    """Number and area of the spots when the largest has the area ``largest`` in m²."""

    def larger_than(self, spot: ArrayLike, largest: ArrayLike) -> RealArray:
        """Number of spots with more than the area ``spot`` in m²."""
        ...

    def share_below(self, spot: ArrayLike, largest: ArrayLike) -> RealArray:
        """Share of the real area in spots smaller than ``spot`` in m²."""
        ...

    def area(self, largest: ArrayLike) -> RealArray:
        """Area in m² of all spots."""
        ...

    def largest(self, area: ArrayLike) -> RealArray:
        """Area in m² of the largest spot when all together have ``area`` m²."""
        ...


@dataclass(frozen=True, eq=False, repr=False)
class FractalPrediction(Prediction):
    """A prediction with the area of the largest spot in m², and the shares of the real area and of
    the load on elastic spots, (n,)."""

    largest_spot: RealArray
    elastic_area_share: RealArray
    elastic_load_share: RealArray


@dataclass(frozen=True, eq=False, repr=False)
class SpotShares(Tabled):
    """Spots at areas (n,): the ``number`` of larger ones, the share of the real area in smaller
    ones, ``share_below``, and whether such a spot is elastic (1) or plastic (0)."""

    number: RealArray
    share_below: RealArray
    elastic: RealArray


class FractalSpots(Theory):
    """Base of theories of spots of all sizes up to the largest one: small ones plastic, large ones
    elastic."""

    hardness: float
    nominal_area: float
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            PRESSURE,
            "at_pressure",
            (
                *QUANTITIES,
                Quantity("largest_spot", "m^2", "area of the largest spot"),
                Quantity("elastic_area_share", "1", "share of the real area in elastic spots"),
                Quantity("elastic_load_share", "1", "share of the load on elastic spots"),
            ),
        ),
        Way(
            asked("spot", "m^2", "area of a spot"),
            "at_spot",
            (
                Quantity("number", "1", "number of larger spots on the nominal area"),
                Quantity("share_below", "1", "share of the real area in smaller spots"),
                Quantity("elastic", "1", "1 for an elastic spot, 0 for a plastic one"),
            ),
            (PRESSURE,),
            checked=False,
        ),
    )

    @property
    def sizes(self) -> SizesOfSpots:
        """Law of the sizes of the spots."""
        raise NotImplementedError

    @property
    def critical_area(self) -> float:
        """a_c in m²: smaller spots are plastic."""
        raise NotImplementedError

    def elastic_area(self, largest: ArrayLike) -> RealArray:
        """Real area in m² in elastic spots, zero up to a_l = a_c."""
        raise NotImplementedError

    def elastic_load(self, largest: ArrayLike) -> RealArray:
        """Load in N on elastic spots."""
        raise NotImplementedError

    def at_pressure(self, pressure: ArrayLike) -> FractalPrediction:
        """Area, mean real pressure and elastic shares at ``pressure`` (n,) in Pa, > 0; the number
        of spots has no limit.

        NoSolutionError if even full contact carries less.
        """
        p = curve(pressure, "pressures (Pa)", positive=True)
        spots = np.array([self.largest_spot_under(load) for load in p * self.nominal_area])
        area = self.sizes.area(spots)
        return FractalPrediction(
            **vars(prediction(p, area_fraction=area / self.nominal_area)),
            largest_spot=spots,
            elastic_area_share=self.elastic_area(spots) / area,
            elastic_load_share=self.elastic_load(spots) / self.load(spots),
        )

    def at_spot(self, spot: ArrayLike, pressure: float) -> SpotShares:
        """Cumulative distribution of the spots at areas ``spot`` (n,) in m², > 0, under the nominal
        ``pressure`` in Pa, > 0."""
        a = curve(spot, "areas of spots (m^2)", positive=True)
        largest = self.largest_spot_under(require.positive(pressure, "pressure (Pa)") * self.nominal_area)
        elastic = (a >= self.critical_area) & (a <= largest)
        return SpotShares(self.sizes.larger_than(a, largest), self.sizes.share_below(a, largest), elastic.astype(float))

    def plastic_load(self, largest: ArrayLike) -> RealArray:
        """Load in N on plastic spots: the hardness times their area."""
        return np.asarray(self.hardness * (self.sizes.area(largest) - self.elastic_area(largest)))

    def load(self, largest: ArrayLike) -> RealArray:
        """Load in N when the largest spot has ``largest`` m² (any shape)."""
        return np.asarray(self.elastic_load(largest) + self.plastic_load(largest))

    def largest_spot_under(self, load: float) -> float:
        """Area a_l in m² of the largest spot under ``load`` in N on the nominal area.

        NoSolutionError if even full contact carries less than the load.
        """
        wanted = require.positive(load, "load (N)")
        full = float(self.sizes.largest(self.nominal_area))
        most = float(self.load(full))
        if wanted > most:
            raise NoSolutionError(
                f"load (N) must be at most the {most:.4g} N that full contact of {self.nominal_area:g} m^2 "
                f"carries in this theory, but is {wanted:g}."
            )
        log_full = math.log(full)
        low = log_full - 1.0
        while float(self.load(math.exp(low))) > wanted:
            low -= 2.0 * (log_full - low)
        found = optimize.brentq(
            lambda log_a: math.log(float(self.load(math.exp(log_a))) / wanted), low, log_full, xtol=1e-13
        )
        return math.exp(found)


@dataclass(frozen=True)
class MajumdarBhushan(FractalSpots):
    """Contact of a surface of fractal profiles with a rigid plane, spots of all sizes up to the
    largest one, a_l.

    A spot of area a is carried by an asperity of the shape z = G^(D-1) a^((2-D)/2) cos(πx/√a);
    spots obey Korcak's law.

        N(A > a) = (a_l/a)^(D/2),  A_r = D a_l/(2 - D),  a_c = G²/(H/(2 E*))^(2/(D-1)),
        W_e = (4 sqrt(π)/3) E* G^(D-1) ∫_(a_c)^(a_l) a^((3-D)/2) n(a) da,
        W_p = H (D/(2 - D)) a_l^(D/2) a_c^(1-D/2),  W = W_e + W_p.

    n(a) = -dN/da. Spots smaller than the critical area are plastic and carry the hardness, larger
    ones are elastic: the reverse of a single asperity that is pressed harder and harder.

    Not a consistent Hertz contact: with this shape the Hertzian area would be a/π; consistent forms
    change factors by powers of π, no exponents. Spots do not influence each other. The critical
    area can be smaller than an atom (1e-19 m²); every real spot is then elastic.

    Notes
    -----
    On generated surfaces that are self-affine from 4 to 49 pixels (Hurst exponents 0.3 to 0.8), the
    area is 1.0 to 1.4 times that of the solved contact with the same hardness at 0.1 % of the
    nominal area, 1.1 to 2 times at 1.4 %, 1.3 to 2.4 times at 5 %. Measured maps are often
    self-affine over less than a decade: the fitted D and G are then those of a bend.
    """

    dimension: Annotated[
        float,
        Number(above=1.0, below=2.0),
        "fractal dimension D of the profile, 1 < D < 2; that of the surface is D + 1",
    ]
    roughness: Annotated[Length, "fractal roughness G"]
    E_star: Modulus
    hardness: Annotated[HardnessValue, Help("hardness H of the softer solid", of="bodies")]
    nominal_area: Annotated[float, Number("area", above=0.0), "nominal area of contact"]
    name: ClassVar[str] = "majumdar-bhushan"
    title: ClassVar[str] = "Majumdar-Bhushan (fractal)"
    citation_keys: ClassVar[tuple[str, ...]] = ("BhushanMajumdar1992", "Majumdar1991")
    limits: ClassVar[tuple[Bound, ...]] = (
        replace(
            FEW_CONTACTS,
            high=0.02,
            citation="Majumdar1991",
            message="Spots are cut from the undeformed surface and stand alone; the area is about twice too "
            "large or more.",
        ),
        Bound(
            "longest over shortest length of self-affine profiles",
            _self_affine_range,
            10.0,
            math.inf,
            "Majumdar1991",
            "Spots of all sizes follow one power law, which the surface obeys over less than a decade of lengths.",
            measured=True,
        ),
        Bound(
            "critical area (m^2)",
            lambda theory, answer: theory.critical_area,
            ATOM,
            math.inf,
            "Bhushan1998",
            "The critical spot is smaller than an atom: every real spot is elastic.",
        ),
        MEASURED_SLOPES,
        ISOTROPY,
    )

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *, hardness: float) -> Self:
        """Theory for ``roughness``, which must be self-affine, and the ``hardness`` in Pa of the
        softer solid."""
        found = roughness.known(roughness.fractal, "fractal dimension and roughness of self-affine profiles", cls.name)
        return cls(found.dimension, found.roughness, E_star, hardness, roughness.area)

    @property
    def sizes(self) -> SpotSizes:
        """Law of the sizes of the spots."""
        return SpotSizes(self.dimension)

    @property
    def critical_area(self) -> float:
        """a_c = G²/(H/2E*)^(2/(D-1)) in m²: smaller spots are plastic. Infinite or zero where
        floats end."""
        return math.inf if self._log_critical > _LARGEST else math.exp(self._log_critical)

    def radius(self, spot: ArrayLike) -> RealArray:
        """Radius of curvature in m of the asperity under a spot of area ``spot`` in m²: a^(D/2)/(π²
        G^(D-1))."""
        a = spot_areas(spot)
        return np.asarray(a ** (0.5 * self.dimension) / (math.pi**2 * self.roughness ** (self.dimension - 1.0)))

    def interference(self, spot: ArrayLike) -> RealArray:
        """Height in m by which that asperity is compressed: G^(D-1) a^((2-D)/2)."""
        return np.asarray(self.roughness ** (self.dimension - 1.0) * spot_areas(spot) ** (1.0 - 0.5 * self.dimension))

    def elastic_area(self, largest: ArrayLike) -> RealArray:
        """Real area in m² in elastic spots, zero up to a_l = a_c."""
        return np.asarray(self.sizes.area(largest) * -np.expm1(-(1.0 - 0.5 * self.dimension) * self._excess(largest)))

    def elastic_load(self, largest: ArrayLike) -> RealArray:
        """Load in N on elastic spots: ∫ (4√π/3) E* G^(D-1) a^((3-D)/2) n(a) da from a_c to a_l."""
        d, excess, a = self.dimension, self._excess(largest), spot_areas(largest)
        # (a_l^e - a_c^e)/2e with e = (3 - 2D)/2, which at D = 3/2 is half the logarithm
        e = 1.5 - d
        bracket = a**e * 0.5 * excess * special.exprel(-e * excess)
        front = 4.0 * math.sqrt(math.pi) / 3.0 * self.E_star * self.roughness ** (d - 1.0) * d
        return np.asarray(front * a ** (0.5 * d) * bracket)

    @property
    def _log_critical(self) -> float:
        """ln a_c: for D near 1 a_c itself is beyond every float."""
        ratio = self.hardness / (2.0 * self.E_star)
        return 2.0 * math.log(self.roughness) - 2.0 / (self.dimension - 1.0) * math.log(ratio)

    def _excess(self, largest: ArrayLike) -> RealArray:
        """ln(a_l/a_c), zero if all is plastic."""
        return np.asarray(np.maximum(0.0, np.log(spot_areas(largest)) - self._log_critical))


# Two fractal dimensions, which meet at a length (Bhushan & Majumdar 1992; how they join the
# branches was not at hand: heights and numbers of spots are taken to be continuous).


@dataclass(frozen=True)
class BifractalSizes:
    """Spots of a bifractal surface, their number continuous at the area a_12 of the crossover.

    InputError if a dimension is out of its range, or the area not positive.

    Parameters
    ----------
    coarse, fine
        Fractal dimensions D_1 of the profile above the crossover and D_2 below it, 1 < D < 2.
    crossover
        Area a_12 in m².
    """

    coarse: float
    fine: float
    crossover: float

    def __post_init__(self) -> None:
        for dimension in (self.coarse, self.fine):
            require.between(dimension, 1.0, 2.0, "fractal dimension of a profile")
        require.positive(self.crossover, "area of the crossover (m^2)")

    def larger_than(self, spot: ArrayLike, largest: ArrayLike) -> RealArray:
        """Number of spots with more than the area ``spot`` in m² (any shape)."""
        a, limit = np.broadcast_arrays(spot_areas(spot), spot_areas(largest))
        fine = (np.minimum(limit, self.crossover) / np.minimum(a, self.crossover)) ** (0.5 * self.fine)
        found = self._coarse(limit) / self._coarse(a) * fine
        return np.asarray(np.where(a <= limit, found, 0.0))

    def _coarse(self, area: RealArray) -> RealArray:
        """(a/a_12)^(D_1/2) of areas beyond the crossover, else 1."""
        return np.asarray(np.maximum(area / self.crossover, 1.0) ** (0.5 * self.coarse))

    def share_below(self, spot: ArrayLike, largest: ArrayLike) -> RealArray:
        """Share of the real area in spots smaller than ``spot`` in m²."""
        a, limit = np.broadcast_arrays(spot_areas(spot), spot_areas(largest))
        return np.asarray(self.area_below(np.minimum(a, limit), limit) / self.area(limit))

    def area(self, largest: ArrayLike) -> RealArray:
        """Area in m² of all spots when the largest has ``largest`` m²."""
        return self.area_below(largest, largest)

    def area_below(self, spot: ArrayLike, largest: ArrayLike) -> RealArray:
        """Area in m² of the spots smaller than ``spot`` in m², at most ``largest``."""
        a, limit = np.broadcast_arrays(spot_areas(spot), spot_areas(largest))
        found = np.zeros(a.shape)
        for branch in self.branches(limit):
            rest = 1.0 - 0.5 * branch.dimension
            ends = np.minimum(np.maximum(a, branch.low), branch.high), branch.low
            found += branch.factor / rest * (ends[0] ** rest - ends[1] ** rest)
        return found

    def largest(self, area: ArrayLike) -> RealArray:
        """Area a_l in m² of the largest spot when all together have ``area`` m²."""
        wanted = spot_areas(area)
        # smaller than all together; the least share is that of the larger dimension alone, and the
        # branches change it by less than the ratio of their factors
        low = np.log(wanted) + 2.0 * math.log(1.0 - 0.5 * max(self.coarse, self.fine)) - 3.0
        log = bisected(lambda log_a: np.log(self.area(np.exp(log_a)) / wanted), low, np.log(wanted))
        return np.exp(log)

    def branches(self, largest: RealArray) -> tuple[Branch, Branch]:
        """The coarse and the fine branch when the largest spot has ``largest`` m² (any shape)."""
        joint = np.minimum(largest, self.crossover)
        count = self._coarse(largest)  # of spots beyond the crossover
        return (
            Branch(self.coarse, joint, largest, 0.5 * self.coarse * largest ** (0.5 * self.coarse)),
            Branch(self.fine, np.zeros_like(joint), joint, 0.5 * self.fine * count * joint ** (0.5 * self.fine)),
        )


@dataclass(frozen=True, eq=False)
class Branch:
    """Spots of one ``dimension`` with areas from ``low`` to ``high`` in m², n(a) = ``factor``
    a^(-D/2-1)."""

    dimension: float
    low: RealArray
    high: RealArray
    factor: RealArray


@dataclass(frozen=True)
class BifractalMajumdarBhushan(FractalSpots):
    """Majumdar and Bhushan's contact of a surface of two fractal dimensions, whose spectra meet at
    the wavelength ℓ_12.

    Spots larger than a_12 = ℓ_12² have D_1 and G_1, smaller ones D_2 and G_2. Heights of spots are
    continuous there, and so are their numbers:

        G_2^(D_2-1) = G_1^(D_1-1) ℓ_(12)^(D_2-D_1),
        N(A > a) = (a_l/a)^(D_1/2)  (a ≥ a_12),
        N(A > a) = (a_l/a_12)^(D_1/2) (a_12/a)^(D_2/2)  (a < a_12).

    Areas and loads are those of ``majumdar-bhushan``, branch by branch; both critical areas lie on
    the same side of a_12. With a_l below a_12 it is that theory with D_2 and G_2. The density n =
    -dN/da jumps at a_12 by D_2/D_1: the source may have joined the densities.

    Examples
    --------
    >>> below = {"fine_dimension": 1.7, "crossover": 2e-6}
    >>> surface = BifractalMajumdarBhushan(1.5, 1e-12, 1e11, 5e9, 1e-6, **below)
    >>> f"{surface.fine_roughness:.3g} m, plastic below {surface.critical_area:.2g} m²"
    '6.31e-11 m, plastic below 1.5e-16 m²'
    """

    dimension: Annotated[
        float, Number(above=1.0, below=2.0), "fractal dimension D1 of the profile above the crossover, 1 < D1 < 2"
    ]
    roughness: Annotated[Length, "fractal roughness G1 above it"]
    E_star: Modulus
    hardness: Annotated[HardnessValue, Help("hardness H of the softer solid", of="bodies")]
    nominal_area: Annotated[float, Number("area", above=0.0), "nominal area of contact"]
    fine_dimension: Annotated[float, Number(above=1.0, below=2.0), "fractal dimension D2 below the crossover"]
    crossover: Annotated[Length, "wavelength l12 at which the two meet"]
    name: ClassVar[str] = "bifractal"
    title: ClassVar[str] = "Majumdar-Bhushan, two fractal dimensions"
    citation_keys: ClassVar[tuple[str, ...]] = ("BhushanMajumdar1992", "Majumdar1991")
    limits: ClassVar[tuple[Bound, ...]] = (MajumdarBhushan.limits[0], MajumdarBhushan.limits[2])

    @property
    def sizes(self) -> BifractalSizes:
        """Law of the sizes of the spots."""
        return BifractalSizes(self.dimension, self.fine_dimension, self.crossover**2)

    @property
    def fine_roughness(self) -> float:
        """G_2 in m."""
        power = (self.dimension - 1.0) * math.log(self.roughness)
        power += (self.fine_dimension - self.dimension) * math.log(self.crossover)
        return math.exp(power / (self.fine_dimension - 1.0))

    @property
    def coarse(self) -> MajumdarBhushan:
        """The theory of the dimension above the crossover."""
        return MajumdarBhushan(self.dimension, self.roughness, self.E_star, self.hardness, self.nominal_area)

    @property
    def fine(self) -> MajumdarBhushan:
        """The theory of the dimension below the crossover."""
        return MajumdarBhushan(self.fine_dimension, self.fine_roughness, self.E_star, self.hardness, self.nominal_area)

    @property
    def critical_area(self) -> float:
        """a_c in m² of the branch in which it lies: smaller spots are plastic."""
        found = self.fine.critical_area
        return found if found < self.crossover**2 else self.coarse.critical_area

    def elastic_area(self, largest: ArrayLike) -> RealArray:
        """Real area in m² in elastic spots."""
        a = spot_areas(largest)
        below = self.sizes.area_below(np.clip(self.critical_area, np.finfo(float).tiny, a), a)
        return np.asarray(self.sizes.area(a) - below)

    def elastic_load(self, largest: ArrayLike) -> RealArray:
        """Load in N on elastic spots: ∫ (4√π/3) E* G_i^(D_i-1) a^((3-D_i)/2) n(a) da of both
        branches."""
        a = spot_areas(largest)
        found = np.zeros(a.shape)
        for branch, theory in zip(self.sizes.branches(a), (self.coarse, self.fine), strict=True):
            start = np.minimum(np.maximum(self.critical_area, branch.low), branch.high)
            front = 4.0 * math.sqrt(math.pi) / 3.0 * self.E_star * theory.roughness ** (theory.dimension - 1.0)
            # ∫ a^(1/2 - D) da, at D = 3/2 a logarithm
            power, span = 1.5 - branch.dimension, np.log(branch.high / start)
            found += front * branch.factor * branch.high**power * span * special.exprel(-power * span)
        return found
