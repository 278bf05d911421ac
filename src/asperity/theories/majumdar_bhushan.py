"""Fractal elastic-plastic contact of a Weierstrass-Mandelbrot surface (Majumdar & Bhushan 1991)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError, NoSolutionError

_LARGEST = 700.0  # logarithm of the largest area that a float holds


@dataclass(frozen=True)
class MajumdarBhushan:
    """Contact of a surface of fractal profiles with a rigid plane, spots of all sizes up to the largest one, a_l.

    A spot of area a is carried by an asperity of the shape z = G^(D-1) a^((2-D)/2) cos(πx/√a). Spots obey Korcak's
    law, N(A > a) = (a_l/a)^(D/2). Spots smaller than the critical area are plastic and carry the hardness, larger ones
    are elastic: the reverse of a single asperity that is pressed harder and harder.

    Not a consistent Hertz contact: with this shape the Hertzian area would be a/π; consistent forms change factors by
    powers of π, no exponents. Spots do not influence each other. The critical area can be smaller than an atom
    (1e-19 m²), which says that every real spot is elastic.

    Parameters
    ----------
    dimension
        Fractal dimension D of the profile, 1 < D < 2; that of the surface is D + 1.
    roughness
        Fractal roughness G in m, > 0 (see ``asperity.roughness.fractal_parameters``).
    contact_modulus
        E* in Pa, > 0.
    hardness
        Hardness H of the softer solid in Pa, > 0.

    Raises
    ------
    InputError
        If a parameter is out of its range.
    """

    dimension: float
    roughness: float
    contact_modulus: float
    hardness: float
    citation_keys: ClassVar[tuple[str, ...]] = ("BhushanMajumdar1992", "Majumdar1991")

    def __post_init__(self) -> None:
        require.between(self.dimension, 1.0, 2.0, "fractal dimension of a profile")
        require.positive(self.roughness, "fractal roughness G (m)")
        require.positive(self.contact_modulus, "contact modulus E* (Pa)")
        require.positive(self.hardness, "hardness (Pa)")

    @property
    def critical_area(self) -> float:
        """a_c = G²/(H/2E*)^(2/(D-1)) in m²: smaller spots are plastic. Infinite or zero where floats end."""
        return math.inf if self._log_critical > _LARGEST else math.exp(self._log_critical)

    def radius(self, spot: ArrayLike) -> RealArray:
        """Radius of curvature in m of the asperity under a spot of area ``spot`` in m²: a^(D/2)/(π² G^(D-1))."""
        a = _areas(spot)
        return np.asarray(a ** (0.5 * self.dimension) / (math.pi**2 * self.roughness ** (self.dimension - 1.0)))

    def interference(self, spot: ArrayLike) -> RealArray:
        """Height in m by which that asperity is compressed: G^(D-1) a^((2-D)/2)."""
        return np.asarray(self.roughness ** (self.dimension - 1.0) * _areas(spot) ** (1.0 - 0.5 * self.dimension))

    def spots_larger_than(self, spot: ArrayLike, largest: float) -> RealArray:
        """Number of spots with more than the area ``spot`` in m² (any shape), ``largest`` a_l in m²."""
        a, limit = _areas(spot), _area(largest)
        return np.asarray(np.where(a <= limit, (limit / a) ** (0.5 * self.dimension), 0.0))

    def size_density(self, spot: ArrayLike, largest: float) -> RealArray:
        """Number n(a) of spots per area in 1/m² of the area ``spot``: (D/2) a_l^(D/2)/a^(D/2+1)."""
        return np.asarray(0.5 * self.dimension * self.spots_larger_than(spot, largest) / _areas(spot))

    def share_below(self, spot: ArrayLike, largest: float) -> RealArray:
        """Share of the real area in spots smaller than ``spot`` in m²: (a/a_l)^(1-D/2)."""
        return np.asarray(np.minimum(1.0, _areas(spot) / _area(largest)) ** (1.0 - 0.5 * self.dimension))

    def area(self, largest: ArrayLike) -> RealArray:
        """Real area of contact in m² when the largest spot has ``largest`` m²: D a_l/(2-D)."""
        return np.asarray(self._spots_per_largest * _areas(largest))

    def largest_spot(self, area: ArrayLike) -> RealArray:
        """Area a_l in m² of the largest spot when the real ``area`` is in contact."""
        return np.asarray(_areas(area) / self._spots_per_largest)

    def elastic_area(self, largest: ArrayLike) -> RealArray:
        """Real area in m² in elastic spots, zero up to a_l = a_c."""
        return np.asarray(self.area(largest) * -np.expm1(-(1.0 - 0.5 * self.dimension) * self._excess(largest)))

    def elastic_load(self, largest: ArrayLike) -> RealArray:
        """Load in N on elastic spots: ∫ (4√π/3) E* G^(D-1) a^((3-D)/2) n(a) da from a_c to a_l."""
        from scipy.special import exprel

        d, excess, a = self.dimension, self._excess(largest), _areas(largest)
        # (a_l^e - a_c^e)/2e with e = (3 - 2D)/2, which at D = 3/2 is half the logarithm
        e = 1.5 - d
        bracket = a**e * 0.5 * excess * exprel(-e * excess)
        front = 4.0 * math.sqrt(math.pi) / 3.0 * self.contact_modulus * self.roughness ** (d - 1.0) * d
        return np.asarray(front * a ** (0.5 * d) * bracket)

    def plastic_load(self, largest: ArrayLike) -> RealArray:
        """Load in N on plastic spots: the hardness times their area."""
        return np.asarray(self.hardness * (self.area(largest) - self.elastic_area(largest)))

    def load(self, largest: ArrayLike) -> RealArray:
        """Load in N when the largest spot has ``largest`` m² (any shape)."""
        return np.asarray(self.elastic_load(largest) + self.plastic_load(largest))

    def largest_spot_under(self, load: float, nominal_area: float) -> float:
        """Area a_l in m² of the largest spot under ``load`` in N on ``nominal_area`` in m².

        Raises
        ------
        NoSolutionError
            If even full contact carries less than the load.
        """
        from scipy.optimize import brentq

        wanted = require.positive(load, "load (N)")
        full = float(self.largest_spot(_area(nominal_area)))
        most = float(self.load(full))
        if wanted > most:
            raise NoSolutionError(
                f"load (N) must be at most the {most:.4g} N that full contact of {nominal_area:g} m^2 carries in this "
                f"theory, but is {wanted:g}."
            )
        # not even all spots plastic carry more than the hardness, nor all elastic a load that falls below this bracket
        log_full = math.log(full)
        low = log_full - 1.0
        while float(self.load(math.exp(low))) > wanted:
            low -= 2.0 * (log_full - low)
        found = brentq(lambda log_a: math.log(float(self.load(math.exp(log_a))) / wanted), low, log_full, xtol=1e-13)
        return math.exp(found)

    @property
    def _spots_per_largest(self) -> float:
        return self.dimension / (2.0 - self.dimension)

    @property
    def _log_critical(self) -> float:
        """ln a_c: for D near 1 a_c itself is beyond every float."""
        ratio = self.hardness / (2.0 * self.contact_modulus)
        return 2.0 * math.log(self.roughness) - 2.0 / (self.dimension - 1.0) * math.log(ratio)

    def _excess(self, largest: ArrayLike) -> RealArray:
        """ln(a_l/a_c), zero if all is plastic."""
        return np.asarray(np.maximum(0.0, np.log(_areas(largest)) - self._log_critical))


def _area(value: float) -> float:
    return require.positive(value, "area (m^2)")


def _areas(value: ArrayLike) -> RealArray:
    areas = np.asarray(value, dtype=float)
    if not (np.isfinite(areas).all() and (areas > 0.0).all()):
        raise InputError(
            f"area of a contact spot (m^2) must be positive and finite, but its least value is {areas.min():g}."
        )
    return areas
