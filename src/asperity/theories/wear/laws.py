"""Laws of wear on a constant area, and the steady state of a surface of two materials."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Number
from ..ask import PRESSURE, Way, asked
from ..protocol import Bound, Theory, checked

WearCoefficient: TypeAlias = Annotated[
    float, Number("m^2/N", above=0.0), Help("wear coefficient k, worn volume over load and distance", of="bodies")
]
"""The parameter that all theories of wear share, 1 mm³/(N m) = 1e-9 m²/N."""

AnyWearCoefficient: TypeAlias = Annotated[float, Number("m^2/N", least=0.0)]
Load: TypeAlias = Annotated[float, Number("force", above=0.0), "normal force P"]
DISTANCE = asked("distance", "m", "sliding distance s")


def wear_coefficient(dimensionless: float, hardness: float) -> float:
    """k = K/H in m²/N of Archard's ``dimensionless`` coefficient K, > 0, and the ``hardness`` H in
    Pa (Archard 1953).

    Examples
    --------
    >>> wear_coefficient(1e-4, 2e9)
    5e-14
    """
    K = require.positive(dimensionless, "dimensionless wear coefficient")
    return K / require.positive(hardness, "hardness (Pa)")


@dataclass(frozen=True, eq=False, repr=False)
class WornArea(Tabled):
    """An area at some sliding distances (m), arrays of one shape: worn ``volume`` in m³, worn
    ``depth`` in m."""

    distance: RealArray
    volume: RealArray
    depth: RealArray


@dataclass(frozen=True)
class ArchardWear(Theory):
    """A constant area A under the load P, with a coating of thickness t and coefficient k1 above
    the body, whose coefficient is k:

        V = k P s,  w = V/A = k p s,  p = P/A,
        w = k_1 p s if s < s_b,  w = t + k p (s - s_b) if s > s_b,  s_b = t/(k_1 p)

    with the worn depth w. Without a coating t = 0. The distance s_b to break-through is the life of
    the coating.

    Examples
    --------
    >>> pad = ArchardWear(1e-14, load=10.0, area=1e-6, thickness=2e-6, coating_coefficient=1e-16)
    >>> f"{pad.life:.0f} m; then {(pad.at_distance(3e3).depth.item() - 2e-6) * 1e6:.0f} µm in 1 km"
    '2000 m; then 100 µm in 1 km'
    """

    coefficient: WearCoefficient
    load: Load
    area: Annotated[float, Number("area", above=0.0), "area A that is always in contact"]
    thickness: Annotated[float, Number("length", least=0.0), "thickness t of a coating"] = 0.0
    coating_coefficient: Annotated[AnyWearCoefficient, Help("wear coefficient k1 of the coating", of="bodies")] = 0.0
    name: ClassVar[str] = "archard"
    title: ClassVar[str] = "Archard, wear of a constant area"
    citation_keys: ClassVar[tuple[str, ...]] = ("Archard1953",)
    limits: ClassVar[tuple[Bound, ...]] = ()
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("pressure", "Pa", "mean pressure"),
        Quantity("life", "m", "sliding distance to break-through; infinite of a coating that does not wear"),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            DISTANCE,
            "at_distance",
            (Quantity("volume", "m^3", "worn volume"), Quantity("depth", "m", "worn depth")),
        ),
    )

    @property
    def pressure(self) -> float:
        """P/A in Pa."""
        return self.load / self.area

    @property
    def life(self) -> float:
        """s_b in m."""
        if self.thickness == 0.0:
            return 0.0
        rate = self.coating_coefficient * self.pressure
        return self.thickness / rate if rate else math.inf

    def at_distance(self, distance: ArrayLike) -> WornArea:
        """The area after the sliding ``distance`` in m, >= 0, of any shape."""
        s = checked(distance, "sliding distance (m)")
        coating = self.coating_coefficient * self.pressure * np.minimum(s, self.life)
        depth = coating + self.coefficient * self.pressure * np.maximum(s - self.life, 0.0)
        return WornArea(s, depth * self.area, np.asarray(depth))


@dataclass(frozen=True, eq=False, repr=False)
class EnergyAnswer(Tabled):
    """Friction of some energies (J), arrays of one shape: worn ``volume`` in m³."""

    energy: RealArray
    volume: RealArray


@dataclass(frozen=True)
class DissipatedEnergyWear(Theory):
    """Wear by the dissipated energy E_d of friction, above a threshold E_th:

        V = α (E_d - E_th) if E_d > E_th,  E_d = μ P s = 4 μ P δ N

    of N cycles of gross slip with the amplitude δ, each of the sliding distance 4δ. At a constant
    coefficient of friction μ it is Archard's law with k = μ α once the threshold is reached.

    Examples
    --------
    >>> steel = DissipatedEnergyWear(4.4e-14, friction=0.7)
    >>> f"{steel.coefficient:.2e} m²/N"
    '3.08e-14 m²/N'
    """

    energy_coefficient: Annotated[
        float, Number("m^3/J", above=0.0), Help("worn volume over dissipated energy α", of="bodies")
    ]
    friction: Annotated[float, Number(above=0.0), Help("coefficient of friction μ", of="bodies")]
    threshold: Annotated[float, Number("energy", least=0.0), "energy E_th below which nothing wears"] = 0.0
    name: ClassVar[str] = "dissipated-energy"
    title: ClassVar[str] = "Fouvry, wear by dissipated energy"
    citation_keys: ClassVar[tuple[str, ...]] = ("Fouvry2003", "Baydoun2019", "Arnaud2021")
    limits: ClassVar[tuple[Bound, ...]] = ()
    numbers: ClassVar[tuple[Quantity, ...]] = (Quantity("coefficient", "m^2/N", "wear coefficient k = μ α"),)
    ways: ClassVar[tuple[Way, ...]] = (
        Way(asked("energy", "J", "dissipated energy E_d"), "at_energy", (Quantity("volume", "m^3", "worn volume"),)),
        Way(
            asked("cycles", "", "number N of cycles of gross slip"),
            "at_cycles",
            (Quantity("energy", "J", "dissipated energy"), Quantity("volume", "m^3", "worn volume")),
            (asked("load", "N", "normal force"), asked("amplitude", "m", "amplitude δ of the slip")),
        ),
    )

    @property
    def coefficient(self) -> float:
        """μ α in m²/N."""
        return self.friction * self.energy_coefficient

    def at_energy(self, energy: ArrayLike) -> EnergyAnswer:
        """Wear by the dissipated ``energy`` in J, >= 0, of any shape."""
        E = checked(energy, "dissipated energy (J)")
        return EnergyAnswer(E, np.asarray(self.energy_coefficient * np.maximum(E - self.threshold, 0.0)))

    def at_cycles(self, cycles: ArrayLike, load: float, amplitude: float) -> EnergyAnswer:
        """Wear by ``cycles`` (any shape, >= 0) of gross slip with the ``amplitude`` in m under the
        ``load`` in N, both > 0."""
        N = checked(cycles, "number of cycles")
        P = require.positive(load, "load (N)")
        return self.at_energy(4.0 * self.friction * P * require.positive(amplitude, "amplitude of the slip (m)") * N)


@dataclass(frozen=True, eq=False, repr=False)
class CompositeAnswer(Tabled):
    """A worn-in surface at nominal pressures (Pa), arrays of one shape: ``pressure_1`` and
    ``pressure_2`` on its materials in Pa, ``share_2`` of the load on the second, ``rate`` worn
    depth per sliding distance."""

    pressure: RealArray
    pressure_1: RealArray
    pressure_2: RealArray
    share_2: RealArray
    rate: RealArray


@dataclass(frozen=True)
class WornComposite(Theory):
    """A surface of two materials on the fractions f_1 and f_2 of its area, worn until both wear at
    one rate:

        p_1 k_1 = p_2 k_2,  k = 1/(f_1/k_1 + f_2/k_2),  p_i = p̄ k/k_i.

    Examples
    --------
    >>> fibres = WornComposite(1e-13, 1e-15, fraction_2=0.2)
    >>> answer = fibres.at_pressure(1e6)
    >>> f"{answer.pressure_2.item() / 1e6:.2f} MPa, {answer.share_2.item():.3f} of the load"
    '4.81 MPa, 0.962 of the load'
    """

    coefficient_1: Annotated[
        float, Number("m^2/N", above=0.0), Help("wear coefficient k1 of the first material", of="bodies")
    ]
    coefficient_2: Annotated[
        float, Number("m^2/N", above=0.0), Help("wear coefficient k2 of the second material", of="bodies")
    ]
    fraction_2: Annotated[float, Number(least=0.0, most=1.0), "fraction f2 of the area, f1 = 1 - f2"]
    name: ClassVar[str] = "worn-composite"
    title: ClassVar[str] = "Worn surface of two materials"
    citation_keys: ClassVar[tuple[str, ...]] = ("Goryacheva1998", "Archard1953")
    limits: ClassVar[tuple[Bound, ...]] = ()
    numbers: ClassVar[tuple[Quantity, ...]] = (Quantity("coefficient", "m^2/N", "wear coefficient of the surface"),)
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            PRESSURE,
            "at_pressure",
            (
                Quantity("pressure_1", "Pa", "pressure on the first material"),
                Quantity("pressure_2", "Pa", "pressure on the second material"),
                Quantity("share_2", "1", "share of the load on the second material"),
                Quantity("rate", "1", "worn depth per sliding distance"),
            ),
        ),
    )

    @property
    def coefficient(self) -> float:
        """k in m²/N."""
        return 1.0 / ((1.0 - self.fraction_2) / self.coefficient_1 + self.fraction_2 / self.coefficient_2)

    def at_pressure(self, pressure: ArrayLike) -> CompositeAnswer:
        """The worn-in surface under the nominal ``pressure`` in Pa, >= 0, of any shape."""
        p = checked(pressure, "nominal pressure (Pa)")
        rate = np.asarray(self.coefficient * p)
        second = rate / self.coefficient_2
        share = np.full_like(p, self.fraction_2 * self.coefficient / self.coefficient_2)
        return CompositeAnswer(p, rate / self.coefficient_1, second, share, rate)
