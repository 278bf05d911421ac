"""Plasticity indices of a surface, the plastic share of its contact, and roughness for the least
area without plasticity."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import HardnessValue, Length, Number, Positive
from ..ask import PRESSURE, Way, asked
from ..protocol import (
    HeightDeviation,
    Modulus,
    PoissonOfSolid,
    SummitRadius,
    Theory,
    curve,
    poissons_ratio,
    real_numbers,
)
from ..rough.greenwood_williamson import plastic_area_share, plastic_number_share
from ..statistics.roughness import Roughness
from ..subsurface.sliding_yield import sphere_yield_onset

# Interferences at which a summit yields, and the plasticity indices made of them (Greenwood &
# Williamson 1966; Bhushan 1998).
#
# Three different indices are in use for the same surface.


def hardness_coefficient(nu: float) -> float:
    """K = 0.454 + 0.41ν of p0 = K H at first yield of a sphere, the later form of Chang, Etsion &
    Bogy (1987); ``nu`` from 0 to 0.5.

    With H = 2.8Y within 2.2 % of the exact value (``sphere_yield_onset``), 0.2 % at ν = 0.3.
    """
    return 0.454 + 0.41 * poissons_ratio(nu)


def yield_coefficient(nu: float) -> float:
    """C = 1.295 exp(0.736ν) of p0 = C Y at first yield (Jackson & Green 2005): within 0.4 % of the
    exact value."""
    return 1.295 * math.exp(0.736 * poissons_ratio(nu))


def nominal_interference(E_star: float, radius: float, hardness: float) -> float:
    """δ_p = R (H/E*)² in m, the round number of Greenwood & Williamson; first yield at p_m = H/3
    has (π²/16) δ_p."""
    return (
        require.positive(radius, "radius (m)")
        * (require.positive(hardness, "hardness (Pa)") / require.positive(E_star, "contact modulus E_star (Pa)")) ** 2
    )


def critical_interference(E_star: float, radius: float, peak: float) -> float:
    """ω_c = (π p0/2E*)² R in m at which the Hertz pressure of a sphere reaches the ``peak`` p0 in
    Pa.

    p0 = K H for Chang, Etsion & Bogy and Kogut & Etsion, C Y for Jackson & Green.
    """
    return (
        require.positive(radius, "radius (m)")
        * (
            0.5
            * math.pi
            * require.positive(peak, "peak pressure (Pa)")
            / require.positive(E_star, "contact modulus E_star (Pa)")
        )
        ** 2
    )


def summit_plasticity_index(height_deviation: float, interference: float) -> float:
    """ψ = sqrt(σ_s/δ): deviation of the summit heights over the ``interference`` of yield, both in
    m, > 0.

    With δ_p (``nominal_interference``) ψ = (E*/H) sqrt(σ_s/R) of Greenwood & Williamson: below 0.6
    elastic at any realistic load, above 1 plastic at any. With ω_c it is ψ_c of Chang, Etsion &
    Bogy, 1.1 times larger at ν = 0.3.
    """
    return math.sqrt(
        require.positive(height_deviation, "deviation of summit heights (m)")
        / require.positive(interference, "interference (m)")
    )


def profile_plasticity_index(E_star: float, hardness: float, deviation: float, correlation_length: float) -> float:
    """ψ = (E*/H)(σ/β*) of Whitehouse & Archard, β* the ``correlation_length`` (1/e, in m) of an
    exponential autocorrelation.

    Onions & Archard (1973): plastic flow is most unlikely below 0.25 and happens at trivial loads
    above 0.45.
    """
    slope = require.positive(deviation, "deviation of heights (m)") / require.positive(
        correlation_length, "correlation length (m)"
    )
    return require.positive(E_star, "contact modulus E_star (Pa)") / require.positive(hardness, "hardness (Pa)") * slope


@dataclass(frozen=True, eq=False, repr=False)
class PlasticShares(Tabled):
    """Shares of the area and of the contacts that flow at standardised separations (n,)."""

    area: RealArray
    number: RealArray


@dataclass(frozen=True)
class PlasticityIndex(Theory):
    """Plasticity of Greenwood and Williamson's summits, the index of Chang, Etsion & Bogy, and what
    flows.

        ψ = (E*/H) sqrt(σ_s/R),  ψ_c = sqrt(σ_s/ω_c),  ω_c = (π K H/(2 E*))² R,  K = 0.454 + 0.41 ν,
        ψ_f = ψ p_0(0)/p_0(μ).

    Below ψ = 0.6 contacts are elastic at any realistic load, above 1 plastic at any. ``friction``
    brings first yield to a lower pressure p_0(μ) (``first-yield``): ψ_f then stands for ψ against
    the same limits. A coating has such a ratio of its own, the pressure of first yield of the
    coated contact over that of the half-space, both at the same friction: below 1 for a coating
    that makes the contact yield earlier. Give it as ``yield_ratio``, with the contact modulus of
    the coated body; ``asperity.first_yield`` of two solved contacts tells it.

    Examples
    --------
    >>> summits = {"radius": 10e-6, "height_deviation": 5e-9}
    >>> dragged = PlasticityIndex(115e9, **summits, hardness=6e9, friction=0.5)
    >>> f"{dragged.index:.2f} without friction, {dragged.reduced_index:.2f} with it"
    '0.43 without friction, 0.66 with it'
    """

    E_star: Modulus
    radius: SummitRadius
    height_deviation: HeightDeviation
    hardness: Annotated[HardnessValue, Help("hardness H of the softer body", of="bodies")]
    nu: Annotated[
        PoissonOfSolid,
        Help("Poisson's ratio of the body that yields, 0 to 0.5; for the index of Chang, Etsion & Bogy", of="bodies"),
    ] = 0.3
    friction: Annotated[float, Number(least=0.0), Help("friction coefficient", of="choice")] = 0.0
    yield_ratio: Annotated[
        Positive, Help("pressure at first yield with a coating over that without it", of="choice")
    ] = 1.0
    name: ClassVar[str] = "plasticity-index"
    title: ClassVar[str] = "Plasticity indices of summits"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1998", "Chang1987", "Greenwood1966", "Hamilton1983")
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("index", "1", "ψ of Greenwood & Williamson: below 0.6 elastic, above 1 plastic"),
        Quantity("reduced_index", "1", "ψ with friction and coating: below 0.6 elastic, above 1 plastic"),
        Quantity("critical_index", "1", "ψ_c of Chang, Etsion & Bogy: from first yield"),
        Quantity("nominal_interference", "m", "R (H/E*)²"),
        Quantity("critical_interference", "m", "displacement at first yield"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("D", "", "separation above the mean summit height in standard deviations"),
            "at_D",
            (
                Quantity("area", "1", "share of the elastic area on summits that flow"),
                Quantity("number", "1", "share of the contacts that flow"),
            ),
        ),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        _ = self.index, self.critical_index

    @classmethod
    def of_roughness(
        cls,
        roughness: Roughness,
        E_star: float,
        *,
        hardness: float,
        nu: float = 0.3,
        friction: float = 0.0,
        yield_ratio: float = 1.0,
    ) -> Self:
        """Indices of the summits of a map. InputError if the roughness holds no summits."""
        summits = roughness.of_summits(cls.name)
        return cls(E_star, summits.mean_radius, summits.height_deviation, hardness, nu, friction, yield_ratio)

    @property
    def nominal_interference(self) -> float:
        """δ_p = R (H/E*)² in m."""
        return nominal_interference(self.E_star, self.radius, self.hardness)

    @property
    def critical_interference(self) -> float:
        """ω_c in m at first yield, p0 = K H."""
        peak = hardness_coefficient(self.nu) * require.positive(self.hardness, "hardness (Pa)")
        return critical_interference(self.E_star, self.radius, peak)

    @property
    def index(self) -> float:
        """ψ = sqrt(σ_s/δ_p)."""
        return summit_plasticity_index(self.height_deviation, self.nominal_interference)

    @property
    def reduced_index(self) -> float:
        """ψ over the ratios by which friction and a coating change the pressure at first yield."""
        free, dragged = (sphere_yield_onset(self.nu, mu).peak_over_k for mu in (0.0, self.friction))
        return self.index * free / (dragged * self.yield_ratio)

    @property
    def critical_index(self) -> float:
        """ψ_c = sqrt(σ_s/ω_c)."""
        return summit_plasticity_index(self.height_deviation, self.critical_interference)

    def at_D(self, D: ArrayLike) -> PlasticShares:
        """What flows at the standardised separations ``D`` (n,), for Gaussian heights."""
        places = real_numbers(D, "separations over the standard deviation")
        return PlasticShares(plastic_area_share(places, self.index), plastic_number_share(places, self.index))


@dataclass(frozen=True)
class ProfilePlasticityIndex(Theory):
    """Index of Whitehouse & Archard: plastic flow is most unlikely below 0.25 and trivial above
    0.45.

    ψ = (E*/H) (σ/β*).
    """

    E_star: Modulus
    rms_height: Annotated[Length, "standard deviation σ of the heights"]
    correlation_length: Annotated[Length, "lag at which the autocorrelation has fallen to 1/e"]
    hardness: Annotated[HardnessValue, Help("hardness H of the softer body", of="bodies")]
    name: ClassVar[str] = "profile-plasticity-index"
    title: ClassVar[str] = "Plasticity index of a profile"
    citation_keys: ClassVar[tuple[str, ...]] = ("Onions1973", "Whitehouse1970")
    numbers: ClassVar[tuple[Quantity, ...]] = (Quantity("index", "1", "ψ: below 0.25 elastic, above 0.45 plastic"),)

    @classmethod
    def of_roughness(cls, roughness: Roughness, E_star: float, *, hardness: float) -> Self:
        """Index of a map with this rms height and correlation length."""
        return cls(E_star, roughness.rms_height, roughness.correlation_length, hardness)

    @property
    def index(self) -> float:
        """ψ."""
        return profile_plasticity_index(self.E_star, self.hardness, self.rms_height, self.correlation_length)


# Roughness and modulus for the least real area without plasticity (Bhushan 1984; 1998, sec. 3.2.3).


ELASTIC_INDEX = 0.6
"""Plasticity index ψ = (E*/H) sqrt(σ_s/R) below which a Gaussian rough contact is elastic at any
realistic load."""

ELASTIC_PROFILE_INDEX = 0.25
"""Plasticity index (E*/H)(σ/β*) below which plastic flow is most unlikely (Onions & Archard
1973)."""

AREA_FACTOR = 3.2
"""A_r/A_a = 3.2 p_a/(E* sqrt(σ_s/R)), within 10 % for 1e-4 <= p_a/(η R σ_s E* sqrt(σ_s/R)) <=
1e-2."""


@dataclass(frozen=True, eq=False, repr=False)
class RoughnessFor(Tabled):
    """Largest ratios for contact moduli (n,): ``summit_ratio`` σ_s/R and ``profile_ratio`` σ/β*."""

    summit_ratio: RealArray
    profile_ratio: RealArray


@dataclass(frozen=True, eq=False, repr=False)
class LeastAreas(Tabled):
    """Real over nominal area at pressures (n,): ``elastic`` of the designed surface, ``plastic`` if
    everything flowed."""

    elastic: RealArray
    plastic: RealArray


@dataclass(frozen=True)
class LeastArea(Theory):
    """Surface of the least real area that stays elastic: the area falls with E* sqrt(σ_s/R) until
    that reaches ψ H.

        A_r/A_a = 3.2 p/(E* sqrt(σ_s/R)),  E* sqrt(σ_s/R) = ψ H.

    A plastic contact has less area yet, p/H, but smooths itself and ends elastic with more. Both
    the real area and the real pressure should be low, so the elastic limit is the aim. Friction
    brings yield to the surface at a lower pressure: multiply ``plasticity_index`` by the ratio of
    the pressures at first yield with and without it, which ``plasticity-index`` takes into its
    reduced index. A stiffer overcoat lowers the admissible
    index, a more compliant one raises it, unless contacts are much larger than the overcoat is
    thick. Hardness and modulus are those at the strain rate of a passing asperity
    (``rate-hardness``).
    """

    hardness: Annotated[HardnessValue, Help("hardness H of the softer solid", of="bodies")]
    plasticity_index: Annotated[Positive, Help("plasticity index that is still elastic", of="choice")] = ELASTIC_INDEX
    name: ClassVar[str] = "least-area"
    title: ClassVar[str] = "Design for the least area without plasticity"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1984", "Bhushan1998", "Greenwood1966", "Onions1973")
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("mean_real_pressure", "Pa", "real pressure of the designed surface"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            PRESSURE,
            "at_pressure",
            (
                Quantity("elastic", "1", "real per nominal area of the designed surface"),
                Quantity("plastic", "1", "real per nominal area if everything flowed"),
            ),
        ),
        Way(
            asked("E_star", "Pa", "contact modulus"),
            "at_modulus",
            (
                Quantity("summit_ratio", "1", "largest height deviation over radius of the summits"),
                Quantity("profile_ratio", "1", "largest rms height over correlation length"),
            ),
        ),
    )

    def summit_ratio(self, E_star: float) -> float:
        """Largest σ_s/R, deviation of the summit heights over summit radius, for the contact
        modulus ``E_star`` in Pa."""
        modulus = require.positive(E_star, "contact modulus E* (Pa)")
        return (self.plasticity_index * self.hardness / modulus) ** 2

    def contact_modulus(self, summit_ratio: float) -> float:
        """Largest contact modulus E* in Pa for summits of σ_s/R = ``summit_ratio``."""
        ratio = require.positive(summit_ratio, "ratio of summit deviation and radius")
        return self.plasticity_index * self.hardness / math.sqrt(ratio)

    def profile_ratio(self, E_star: float, index: float = ELASTIC_PROFILE_INDEX) -> float:
        """Largest σ/β*, rms height over correlation length (1/e), for the modulus ``E_star`` in Pa.

        The same guidance for exponential autocorrelation: plasticity is avoided by less height or
        longer waves.
        """
        modulus = require.positive(E_star, "contact modulus E* (Pa)")
        return require.positive(index, "plasticity index of a profile") * self.hardness / modulus

    def at_modulus(self, E_star: ArrayLike) -> RoughnessFor:
        """Largest roughness for the contact moduli ``E_star`` (n,) in Pa."""
        moduli = curve(E_star, "contact moduli E* (Pa)", positive=True)
        summit = np.array([self.summit_ratio(float(modulus)) for modulus in moduli])
        return RoughnessFor(summit, np.array([self.profile_ratio(float(modulus)) for modulus in moduli]))

    def at_pressure(self, pressure: ArrayLike) -> LeastAreas:
        """Areas at nominal pressures (n,) in Pa, positive."""
        pressures = curve(pressure, "pressures (Pa)", positive=True)
        elastic = np.array([self.area_fraction(float(p)) for p in pressures])
        return LeastAreas(elastic, np.array([self.plastic_area_fraction(float(p)) for p in pressures]))

    @property
    def mean_real_pressure(self) -> float:
        """Real pressure in Pa of that surface: ψ H/3.2."""
        return self.plasticity_index * self.hardness / AREA_FACTOR

    def area_fraction(self, mean_pressure: float) -> float:
        """Real over nominal area of that surface at ``mean_pressure`` in Pa: 3.2 p/(ψ H), 5.3 p/H
        for ψ = 0.6."""
        return require.positive(mean_pressure, "mean pressure (Pa)") / self.mean_real_pressure

    def plastic_area_fraction(self, mean_pressure: float) -> float:
        """Real over nominal area if everything were plastic, the least possible: p/H."""
        return require.positive(mean_pressure, "mean pressure (Pa)") / self.hardness
