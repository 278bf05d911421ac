"""Fractal elastic-plastic contact of a Weierstrass-Mandelbrot surface (Majumdar & Bhushan 1991)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError, NoSolutionError
from ...core.parameters import Help
from ...core.values import HardnessValue, Length, Number
from ..protocol import FEW_CONTACTS, ISOTROPY, MEASURED_SLOPES, Bound, Modulus, Prediction, Theory, curve, prediction
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


@dataclass(frozen=True)
class MajumdarBhushan(Theory):
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

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Area and mean real pressure at ``pressure`` (n,) in Pa, > 0; the number of spots has no
        limit.

        NoSolutionError if even full contact carries less.
        """
        p = curve(pressure, "pressures (Pa)", positive=True)
        spots = np.array([self.largest_spot_under(load) for load in p * self.nominal_area])
        return prediction(p, area_fraction=self.sizes.area(spots) / self.nominal_area)

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
        from scipy.special import exprel

        d, excess, a = self.dimension, self._excess(largest), spot_areas(largest)
        # (a_l^e - a_c^e)/2e with e = (3 - 2D)/2, which at D = 3/2 is half the logarithm
        e = 1.5 - d
        bracket = a**e * 0.5 * excess * exprel(-e * excess)
        front = 4.0 * math.sqrt(math.pi) / 3.0 * self.E_star * self.roughness ** (d - 1.0) * d
        return np.asarray(front * a ** (0.5 * d) * bracket)

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
        from scipy.optimize import brentq

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
        found = brentq(lambda log_a: math.log(float(self.load(math.exp(log_a))) / wanted), low, log_full, xtol=1e-13)
        return math.exp(found)

    @property
    def _log_critical(self) -> float:
        """ln a_c: for D near 1 a_c itself is beyond every float."""
        ratio = self.hardness / (2.0 * self.E_star)
        return 2.0 * math.log(self.roughness) - 2.0 / (self.dimension - 1.0) * math.log(ratio)

    def _excess(self, largest: ArrayLike) -> RealArray:
        """ln(a_l/a_c), zero if all is plastic."""
        return np.asarray(np.maximum(0.0, np.log(spot_areas(largest)) - self._log_critical))
