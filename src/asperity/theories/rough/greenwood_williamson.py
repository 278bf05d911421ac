"""Spherical summits of random heights: Greenwood and Williamson, Kotwal and Bhushan, fits, plastic
share, two rough surfaces."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError, NoSolutionError
from ...core.parameters import Help
from ...core.values import Length, Number, SignedLength
from ..protocol import (
    BLUNT_SUMMITS,
    FEW_CONTACTS,
    ISOTROPY,
    Bound,
    HeightDeviation,
    HeightsLaw,
    MeanHeight,
    Modulus,
    Prediction,
    SeparationTheory,
    SummitDensity,
    SummitKurtosis,
    SummitRadius,
    SummitSkewness,
    Theory,
    curve,
    prediction,
)
from ..statistics.heights import GaussianHeights, HistogramHeights, PearsonHeights, SummitHeights
from ..statistics.nayak import NayakSummits
from ..statistics.roughness import Roughness

LOWEST, HIGHEST = -40.0, 37.0
"""Separations in standard deviations between which pressures are inverted; at 37 a Gaussian has
1e-300 left."""


@dataclass(frozen=True)
class _RandomHeights(SeparationTheory):
    """Base of theories of summits of one radius and of random heights."""

    E_star: Modulus
    density: SummitDensity
    radius: SummitRadius
    height_deviation: HeightDeviation
    mean_height: MeanHeight = 0.0

    @property
    def heights(self) -> SummitHeights:
        """Distribution of the standardised heights."""
        return GaussianHeights()

    @property
    def deviation(self) -> float:
        """Standard deviation in m by which separations are standardised."""
        return self.height_deviation

    @property
    def roughness_ratio(self) -> float:
        """That deviation over the radius."""
        return self.deviation / self.radius

    def standardised(self, separation: RealArray) -> RealArray:
        """D at ``separation`` in m, in the coordinate of the distribution of heights."""
        return np.asarray((separation - self.mean_height) / self.deviation + self.heights.mean)

    @property
    def _ends(self) -> tuple[float, float, float]:
        ends = (LOWEST, min(HIGHEST, self.heights.support[1]))
        low, high = (self.mean_height + self.deviation * (D - self.heights.mean) for D in ends)
        return low, high, self.deviation


@dataclass(frozen=True)
class SphericalSummits(_RandomHeights):
    """Base of theories of independent summits of one radius: equations of
    ``GreenwoodWilliamson``."""

    limits: ClassVar[tuple[Bound, ...]] = (FEW_CONTACTS, BLUNT_SUMMITS)

    @property
    def pressure_unit(self) -> float:
        """η R σ_s E* (σ_s/R)^(1/2) in Pa, the unit of the dimensionless pressure P_a."""
        return self.density * self.radius * self.height_deviation * self.E_star * math.sqrt(self.roughness_ratio)

    def borne(self, separation: RealArray) -> RealArray:
        """Pressure in Pa that the summits carry at ``separation`` in m, of any shape."""
        return np.asarray(4.0 / 3.0 * self.pressure_unit * self.heights.tail_moment(self.standardised(separation), 1.5))

    def _law(self, h: RealArray) -> tuple[RealArray, RealArray]:
        slope = 2.0 * self.pressure_unit / self.height_deviation
        return self.borne(h), slope * self.heights.tail_moment(self.standardised(h), 0.5)

    def _contacts(self, h: RealArray) -> tuple[RealArray, RealArray]:
        D, share = self.standardised(h), math.pi * self.density * self.radius * self.height_deviation
        return share * self.heights.tail_moment(D, 1.0), self.density * self.heights.tail_moment(D, 0.0)


@dataclass(frozen=True)
class GreenwoodWilliamson(SphericalSummits):
    """Independent spherical summits on a rough surface against a rigid plane, each a Hertz contact.

    With the density p(s) of the standardised summit heights (Greenwood & Williamson 1966; Bhushan
    1998, eq. 12-16)

        D = (h - z̄_s)/σ_s,  F_m(D) = ∫_D^∞ (s - D)^m p(s) ds,
        n = η F_0,  A_r/A_a = π η R σ_s F_1,  p = (4/3) η E* R^(1/2) σ_s^(3/2) F_(3/2).
    """

    heights: HeightsLaw = GaussianHeights()
    name: ClassVar[str] = "greenwood-williamson"
    title: ClassVar[str] = "Greenwood-Williamson"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood1966",)

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *, bins: int | None = None) -> Self:
        """Theory for the summits of a map: their density, 1/<κ>, and the mean and deviation of
        their heights.

        ``bins`` None: Gaussian heights; a number: their histogram with so many bins, which numbers
        of summits alone do not give. InputError without summits, or if their heights are all equal.
        """
        summits = roughness.of_summits(cls.name)
        heights: SummitHeights = GaussianHeights()
        if bins is not None:
            listed = roughness.known(roughness.summits, "the heights of its summits, for a histogram", cls.name)
            heights = HistogramHeights.from_samples(listed.height, bins)
        return cls(
            E_star,
            summits.density,
            summits.mean_radius,
            summits.height_deviation,
            summits.mean_height,
            heights,
        )


class OnSummits(Theory):
    """Base of theories that put another law on each of Greenwood and Williamson's summits, or fits
    in place of integrals."""

    E_star: float
    density: float
    radius: float
    height_deviation: float
    mean_height: float

    @property
    def summits(self) -> GreenwoodWilliamson:
        """The same summits in the theory of Greenwood & Williamson, with Gaussian heights."""
        return GreenwoodWilliamson(self.E_star, self.density, self.radius, self.height_deviation, self.mean_height)

    @property
    def roughness_ratio(self) -> float:
        """σ_s/R."""
        return self.summits.roughness_ratio


@dataclass(frozen=True)
class KotwalBhushan(SphericalSummits):
    """Greenwood and Williamson's summits with heights of Pearson's system (Kotwal & Bhushan 1996).

    With D, n, A_r and p as in ``GreenwoodWilliamson`` and Pearson's density p(s) of the
    standardised heights,

        dp/ds = -(s + b) p(s)/(c_0 + c_1 s + c_2 s²),  F_m(D) = ∫_D^∞ (s - D)^m p(s) ds.

    b and c_i follow from skewness and kurtosis. Types I and II end: there is no contact above the
    highest summit. InputError if kurtosis <= 1 + skewness².

    Examples
    --------
    Few high summits touch on a smaller area than those of Gaussian heights:

    >>> shapes = (0, 3), (0.5, 5)
    >>> loads = [
    ...     KotwalBhushan(1e11, 3e12, 2e-7, 5e-9, skewness=s, kurtosis=k).at_pressure(1e5)
    ...     for s, k in shapes
    ... ]
    >>> [f"{load.area_fraction[0]:.2e}" for load in loads]
    ['2.03e-05', '1.11e-05']
    """

    skewness: SummitSkewness = 0.0
    kurtosis: SummitKurtosis = 3.0
    name: ClassVar[str] = "kotwal-bhushan"
    title: ClassVar[str] = "Kotwal-Bhushan"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood1966", "Kotwal1996", "Pearson1895", "Pearson1916")

    def __post_init__(self) -> None:
        super().__post_init__()
        _ = self.heights  # a kurtosis that no heights have

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float) -> Self:
        """Theory for the summits of a map: density, 1/<κ>, and mean, deviation, skewness and
        kurtosis of their heights.

        InputError without summits, or if their heights are all equal.
        """
        s = roughness.of_summits(cls.name)
        require.positive(s.height_deviation, "standard deviation of summit heights (m)")
        numbers = (s.density, s.mean_radius, s.height_deviation, s.mean_height)
        return cls(E_star, *numbers, s.height_skewness, s.height_kurtosis)

    @cached_property
    def greenwood_williamson(self) -> GreenwoodWilliamson:
        """The same summits in the theory of Greenwood & Williamson."""
        numbers = (self.density, self.radius, self.height_deviation, self.mean_height)
        return GreenwoodWilliamson(self.E_star, *numbers, self.heights)

    @cached_property
    def heights(self) -> SummitHeights:
        """The distribution of Pearson's system."""
        return PearsonHeights(self.skewness, self.kurtosis)


# Power laws fitted to the Gaussian theory of Greenwood & Williamson (Bhushan 1998, table 1).


LARGEST = 0.57
"""P_a at D = 0, where the fit of the separation ends."""

FORMS = {"power": (1e-6, 0.1), "linear": (1e-4, 1e-2)}
"""Forms of the laws and the P_a between which they are within a fifth (power) or a half (linear) of
the integrals."""


@dataclass(frozen=True)
class FittedLaws:
    """Quantities of the Gaussian theory as fitted functions of P_a; logarithms are decimal.

    ``"power"``: D = 1.40 [log(0.57/P_a)]^0.65, p_r = 0.42 P_a^0.04, A_r = 2.40 P_a^0.96, n = 1.21
    P_a^0.88, A_r/n = 2.00 P_a^0.08; ``"linear"``: p_r = 0.32, A_r = 3.20 P_a, n = 2.64 P_a, A_r/n =
    1.21, no separation.
    """

    form: str = "power"

    def __post_init__(self) -> None:
        require.one_of(self.form, FORMS, "form of the fitted laws")

    def separation(self, P_a: RealArray) -> RealArray:
        """D, NaN for P_a >= 0.57 and for the linear form."""
        inside = (P_a < LARGEST) & (self.form == "power")
        return np.where(inside, 1.40 * np.log10(LARGEST / np.where(inside, P_a, LARGEST)) ** 0.65, np.nan)

    def real_pressure(self, P_a: RealArray) -> RealArray:
        """p_r/[E* (σ_s/R)^(1/2)]."""
        return self._law(P_a, (0.42, 0.04), (0.32, 0.0))

    def area(self, P_a: RealArray) -> RealArray:
        """A_r/(A_a η R σ_s)."""
        return self._law(P_a, (2.40, 0.96), (3.20, 1.0))

    def number(self, P_a: RealArray) -> RealArray:
        """n/(η A_a)."""
        return self._law(P_a, (1.21, 0.88), (2.64, 1.0))

    def mean_area(self, P_a: RealArray) -> RealArray:
        """(A_r/n)/(R σ_s)."""
        return self._law(P_a, (2.00, 0.08), (1.21, 0.0))

    def _law(self, P_a: RealArray, power: tuple[float, float], linear: tuple[float, float]) -> RealArray:
        factor, exponent = power if self.form == "power" else linear
        return np.asarray(factor * P_a**exponent)


def _range_of_fits(form: str, share: str) -> Bound:
    def value(theory: FittedGreenwoodWilliamson, answer: Prediction) -> RealArray | None:
        return answer.pressure / theory.summits.pressure_unit if theory.form == form else None

    message = f"The fits leave the integrals that they replace by more than a {share}."
    return Bound(f"P_a of the {form} form", value, *FORMS[form], "Bhushan1998", message)


@dataclass(frozen=True)
class FittedGreenwoodWilliamson(OnSummits):
    """Greenwood and Williamson with the fits of table 1 in place of the integrals; for comparison
    with the literature.

    The laws of the ``form`` ``"power"`` are

        P_a = p/(η R^(1/2) σ_s^(3/2) E*),
        h = z̄_s + 1.40 σ_s [log_(10)(0.57/P_a)]^(0.65),  n = 1.21 η P_a^(0.88),
        p_r = 0.42 E* (σ_s/R)^(1/2) P_a^(0.04),  A_r/A_a = 2.40 η R σ_s P_a^(0.96).

    Real area and real pressure are fits of their own: their product is the load within a few per
    cent only.
    """

    E_star: Modulus
    density: SummitDensity
    radius: SummitRadius
    height_deviation: HeightDeviation
    mean_height: MeanHeight = 0.0
    form: Annotated[Literal["power", "linear"], Help("fitted laws", of="choice")] = "power"
    name: ClassVar[str] = "greenwood-williamson-fits"
    title: ClassVar[str] = "Greenwood-Williamson, fitted power laws"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1998", "Greenwood1966")
    limits: ClassVar[tuple[Bound, ...]] = (
        _range_of_fits("power", "fifth"),
        _range_of_fits("linear", "half"),
        FEW_CONTACTS,
    )

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *, form: Literal["power", "linear"] = "power") -> Self:
        """Theory for the summits of a map, as ``GreenwoodWilliamson.from_roughness``."""
        exact = GreenwoodWilliamson.from_roughness(roughness, E_star)
        return cls(E_star, exact.density, exact.radius, exact.height_deviation, exact.mean_height, form)

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa."""
        p = curve(pressure, "pressures (Pa)", positive=True)
        exact, laws = self.summits, FittedLaws(self.form)
        P_a = p / exact.pressure_unit
        return prediction(
            p,
            area_fraction=self.density * self.radius * self.height_deviation * laws.area(P_a),
            contact_density=self.density * laws.number(P_a),
            mean_real_pressure=self.E_star * exact.roughness_ratio**0.5 * laws.real_pressure(P_a),
            separation=self.mean_height + self.height_deviation * laws.separation(P_a),
        )


# Onset of plastic flow in the theory of Greenwood & Williamson (1966): the plastic share of the
# contact.
#
# With the plasticity index ψ = (E*/H)(σ_s/R)^(1/2), summits pressed deeper than δ_p = R (H/E*)²
# flow; w = δ_p/σ_s = 1/ψ².


NOTICEABLE = 0.02
"""Plastic share of the area that counts as the onset (Greenwood & Williamson 1966)."""

_LOWEST, _HIGHEST = -35.0, 35.0  # D between which the onset is sought


def plastic_area_share(D: ArrayLike, psi: float, heights: SummitHeights = GaussianHeights()) -> RealArray:
    """Share of the elastic contact area on summits that flow: ∫_(D + w)^∞ (s - D) p ds/F_1(D).

    ``D`` standardised separations of any shape, ``psi`` plasticity index ψ > 0, ``heights``
    distribution of the summits.
    """
    D, w = np.asarray(D, dtype=float), _depth(psi)
    deep = heights.tail_moment(D + w, 1.0) + w * heights.tail_moment(D + w, 0.0)
    return np.asarray(deep / heights.tail_moment(D, 1.0))


def plastic_area_share_beyond(D: ArrayLike, psi: float, heights: SummitHeights = GaussianHeights()) -> RealArray:
    """F_1(D + w)/F_1(D), the share if only the depth beyond δ_p counts; a definition that is also
    in use."""
    D = np.asarray(D, dtype=float)
    return np.asarray(heights.tail_moment(D + _depth(psi), 1.0) / heights.tail_moment(D, 1.0))


def plastic_number_share(D: ArrayLike, psi: float, heights: SummitHeights = GaussianHeights()) -> RealArray:
    """F_0(D + w)/F_0(D), the share of the contacts that flow."""
    D = np.asarray(D, dtype=float)
    return np.asarray(heights.tail_moment(D + _depth(psi), 0.0) / heights.tail_moment(D, 0.0))


def _depth(psi: float) -> float:
    """w = 1/ψ²."""
    return 1.0 / require.positive(psi, "plasticity index psi") ** 2


def separation_at_plastic_onset(psi: float, share: float = NOTICEABLE, *, beyond: bool = False) -> float:
    """D below which the plastic share of the area exceeds ``share``, for Gaussian heights.

    ``psi`` plasticity index, ``share`` between 0 and 1, with ``beyond`` that of
    ``plastic_area_share_beyond``. NoSolutionError if the share is exceeded, or not reached, at
    every separation between -35 and 35 standard deviations.
    """
    from scipy.optimize import brentq

    require.between(share, 0.0, 1.0, "plastic share of the area")
    law = plastic_area_share_beyond if beyond else plastic_area_share

    def excess(D: float) -> float:
        found = float(law(D, psi))
        return math.log(found) - math.log(share) if found > 0.0 else -math.inf

    if excess(_LOWEST) < 0.0 or excess(_HIGHEST) > 0.0:
        raise NoSolutionError(
            f"plastic share {share:g} must be crossed between D = {_LOWEST:g} and {_HIGHEST:g}, but psi = {psi:g} has "
            f"{float(law(_LOWEST, psi)):.3g} and {float(law(_HIGHEST, psi)):.3g} there."
        )
    return float(brentq(excess, _LOWEST, _HIGHEST, xtol=1e-14, rtol=1e-14))


# Greenwood & Tripp (1970): two rough surfaces with misaligned summits.


@dataclass(frozen=True)
class GreenwoodTripp(_RandomHeights):
    """Two surfaces, each with paraboloidal summits of the same radius and density, at random
    relative positions.

    With the sum of two summit heights of standard deviation σ and D = (h - z̄_s)/σ, averaged over
    the misalignment of a pair,

        n = 4π η² β σ F_1,  A_r/A_a = π² (η β σ)² F_2,
        p = (16√2 π/15) (η β σ)² E* (σ/β)^(1/2) F_(5/2),
        σ² = σ_s² + 2 c.

    The second power of the density stands for pairs: doubling the summits of both surfaces
    quadruples the contacts. c is the ``covariance`` of the heights that face each other, both
    toward the other body: zero for surfaces that know nothing of each other, negative for run-in
    pairs, whose crests have found valleys.

    O'Callaghan and Cameron's (1976) statement that contact is mostly on the shoulders of summits,
    and that two rough surfaces act as one equivalent one, is that of this theory; it holds to a
    fifth of the area. The surface whose spectral moments are the sums of both
    (``bush-gibson-thomas`` on the sum of two maps) needs no such rule.

    InputError if the covariance leaves no heights, 2 c <= -σ_s².
    """

    E_star: Modulus
    density: Annotated[float, Number("1/m^2", above=0.0), "summits per area η of each surface"]
    radius: Annotated[Length, "radius β of the summits of each surface"]
    height_deviation: Annotated[Length, "standard deviation σ_s of the sum of a summit height of either surface"]
    mean_height: Annotated[SignedLength, "mean z̄_s of that sum above the sum of the mean planes"] = 0.0
    heights: HeightsLaw = GaussianHeights()
    covariance: Annotated[float, Number("area"), "covariance of the heights that face each other, of run-in pairs"] = (
        0.0
    )
    name: ClassVar[str] = "greenwood-tripp"
    title: ClassVar[str] = "Greenwood-Tripp, two rough surfaces"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood1966", "Greenwood1970", "McCool1986", "OCallaghan1976")
    limits: ClassVar[tuple[Bound, ...]] = (FEW_CONTACTS, BLUNT_SUMMITS, ISOTROPY)

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.height_deviation**2 + 2.0 * self.covariance > 0.0:
            raise InputError(
                "covariance of the heights that face each other (m^2) must be more than "
                f"{-0.5 * self.height_deviation**2:.4g}, half of the variance of their sum, but is {self.covariance:g}."
            )

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float) -> Self:
        """Theory for two independent surfaces, each with half of the moments m0, m2, m4 of
        ``roughness``.

        Such a pair has the same gap as one surface of ``roughness`` against a plane; summits are
        those of McCool.
        """
        half = NayakSummits(0.5 * roughness.m0, 0.5 * roughness.m2, 0.5 * roughness.m4)
        deviation = math.sqrt(2.0) * half.height_deviation
        return cls(E_star, half.density, half.radius, deviation, 2.0 * half.mean_height)

    @property
    def deviation(self) -> float:
        """σ in m, standard deviation of the sum of two heights that face each other."""
        return math.sqrt(self.height_deviation**2 + 2.0 * self.covariance)

    @property
    def _crowding(self) -> float:
        """η β σ."""
        return self.density * self.radius * self.deviation

    def _law(self, h: RealArray) -> tuple[RealArray, RealArray]:
        D = self.standardised(h)
        unit = 16.0 * math.sqrt(2.0) * math.pi / 15.0 * self._crowding**2 * self.E_star
        unit *= math.sqrt(self.roughness_ratio)
        slope = 2.5 * unit / self.deviation * self.heights.tail_moment(D, 1.5)
        return unit * self.heights.tail_moment(D, 2.5), slope

    def _contacts(self, h: RealArray) -> tuple[RealArray, RealArray]:
        D = self.standardised(h)
        pairs = 4.0 * math.pi * self.density * self._crowding
        return (math.pi * self._crowding) ** 2 * self.heights.tail_moment(D, 2.0), pairs * self.heights.tail_moment(
            D, 1.0
        )
