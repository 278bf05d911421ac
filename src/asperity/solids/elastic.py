"""Homogeneous bodies: elastic half-spaces and the rigid body."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.late import Shown

TABOR = 2.8
"""Hardness over tensile yield stress of metals (Tabor 1951), used where only the hardness is
known."""


@runtime_checkable
class Hardening(Protocol):
    """Yield stress in tension against the accumulated plastic strain q."""

    def yield_stress(self, plastic_strain: RealArray) -> RealArray:
        """Y(q) in Pa."""

    def slope(self, plastic_strain: RealArray) -> RealArray:
        """dY/dq in Pa."""


@dataclass(frozen=True)
class Strength:
    """What a material bears: hardness and tensile yield stress in Pa, ``nan`` where not known, how
    it hardens in plastic flow, and how fast it wears.

    InputError if a given value is not positive, or yield stress and hardening contradict each
    other.

    Parameters
    ----------
    hardness, yield_stress
        In Pa, > 0; the yield stress is that of the ``hardening`` where only this is given.
    hardening
        ``LinearHardening``, ``Swift`` or ``Voce``; None for perfect plasticity.
    kinematic, recall
        H_k in Pa and γ of a back stress (Prager, Armstrong and Frederick), >= 0.
    wear_coefficient
        k_w in m²/N, >= 0: worn depth over pressure times distance slid (Archard 1953); 1 mm³/(N m)
        is 1e-9 m²/N. It is that of the pair and its lubrication, not of the material alone.
    """

    hardness: float = math.nan
    yield_stress: float = math.nan
    hardening: Hardening | None = None
    kinematic: float = 0.0
    recall: float = 0.0
    wear_coefficient: float = math.nan

    def __post_init__(self) -> None:
        if self.hardening is not None:
            require.instance(self.hardening, Hardening, "hardening", "Give LinearHardening(Y, H), Swift(…) or Voce(…).")
            first = float(self.hardening.yield_stress(np.zeros(())))
            if math.isnan(self.yield_stress):
                object.__setattr__(self, "yield_stress", first)
            elif not math.isclose(first, self.yield_stress, rel_tol=1e-9):
                raise InputError(
                    f"yield stress (Pa) must be that of the hardening, {first:g}, but is "
                    f"{self.yield_stress:g}. Give it with the hardening only."
                )
        for value, what in ((self.hardness, "hardness (Pa)"), (self.yield_stress, "yield stress (Pa)")):
            if value == value:
                require.positive(value, what)
        require.not_negative(self.kinematic, "kinematic hardening (Pa)")
        require.not_negative(self.recall, "recall of the back stress")
        known = self.wear_coefficient == self.wear_coefficient
        # of what is not known one object, so that equal ones are equal
        wear = require.not_negative(self.wear_coefficient, "wear coefficient (m²/N)") if known else math.nan
        object.__setattr__(self, "wear_coefficient", wear)


@dataclass(frozen=True)
class Conduction:
    """How a material conducts heat and current, stores heat and expands; ``nan`` where not known.

    InputError if a given value is not positive.

    Parameters
    ----------
    thermal_conductivity
        k in W/(m K), > 0.
    electrical_resistivity
        ρ in Ω m, > 0; one over the conductivity in S/m.
    volumetric_heat_capacity
        ρc in J/(m³ K), > 0: density times specific heat capacity.
    thermal_expansion
        Linear coefficient α in 1/K, > 0.
    """

    thermal_conductivity: float = math.nan
    electrical_resistivity: float = math.nan
    volumetric_heat_capacity: float = math.nan
    thermal_expansion: float = math.nan

    def __post_init__(self) -> None:
        units = {
            "thermal_conductivity": "W/(m K)",
            "electrical_resistivity": "ohm m",
            "volumetric_heat_capacity": "J/(m³ K)",
            "thermal_expansion": "1/K",
        }
        for name, unit in units.items():
            value = getattr(self, name)
            known = value == value
            # of what is not known one object, so that equal ones are equal
            number = require.positive(value, f"{name.replace('_', ' ')} ({unit})") if known else math.nan
            object.__setattr__(self, name, number)

    @property
    def diffusivity(self) -> float:
        """κ = k/ρc in m²/s; ``nan`` where one of both is not known."""
        return self.thermal_conductivity / self.volumetric_heat_capacity


_GIVEN = MappingProxyType(
    {
        "thermal_conductivity": "Give {thermal_conductivity}.",
        "electrical_resistivity": "Give {electrical_resistivity}.",
        "volumetric_heat_capacity": "Give {volumetric_heat_capacity}.",
    }
)
"""What to do where one of these is not known."""


def known_conduction(material: Elastic, key: str, which: str, use: str = "") -> float:
    """Value of ``key`` of the ``conduction`` of a ``material``, SI; ``which`` body or layer it is,
    and for what ``use``, such as ``" for Joule heat"``, are said in the message.

    Raises
    ------
    InputError
        If it is not known.
    """
    value: float = getattr(material.conduction, key)
    if math.isnan(value):
        missing, name = key.replace("_", " "), f"{material.name} ({which})" if material.name else f"the {which}"
        raise InputError(
            f"{missing} of {name} must be known{use}, but is not. {_GIVEN[key]}",
            subject=f"{missing} of {material.name or which}",
        )
    return value


INCOMPRESSIBLE = "Use 0.5 for an incompressible solid."
"""What to do about a Poisson's ratio that is too large."""


@dataclass(frozen=True, repr=False)
class Elastic(Shown):
    """Isotropic linear-elastic half-space.

    InputError if a value is outside its range, or ``strength`` or ``conduction`` is none.

    Parameters
    ----------
    youngs_modulus
        E in Pa, > 0.
    poisson_ratio
        nu, -1 < nu <= 0.5; 0.5 is incompressible.
    strength
        Hardness, yield stress and hardening, where known.
    name, sources
        Name of the material and where its values come from.
    conduction
        Thermal conductivity, electrical resistivity, heat capacity and thermal expansion, where
        known; by keyword.
    """

    youngs_modulus: float
    poisson_ratio: float
    strength: Strength = Strength()
    name: str = ""
    sources: tuple[str, ...] = ()
    conduction: Conduction = field(default=Conduction(), kw_only=True)

    if not TYPE_CHECKING:

        def __new__(cls, *values: Any, **named: Any) -> Elastic:
            """Symbols of textbooks are refused with the name that is meant."""
            wrong = next((name for name in named if name in ("E", "nu", "G", "v")), None)
            if wrong is not None:
                raise InputError(
                    "keyword of Elastic must be youngs_modulus (E in Pa) or poisson_ratio (nu), but is "
                    f"{wrong}. Write Elastic(70e9, 0.3){' with E = 2 (1 + nu) G' if wrong == 'G' else ''}."
                )
            return super().__new__(cls)

    def __post_init__(self) -> None:
        require.positive(self.youngs_modulus, "Young's modulus (Pa)")
        require.within(self.poisson_ratio, -1.0, 0.5, "Poisson's ratio", INCOMPRESSIBLE)
        require.instance(self.strength, Strength, "strength of an elastic body", "Write Strength(hardness=...).")
        advice = "Write Conduction(thermal_conductivity=...)."
        require.instance(self.conduction, Conduction, "conduction of a solid", advice)

    @property
    def plane_strain_modulus(self) -> float:
        """E' = E / (1 - nu²) in Pa."""
        return self.youngs_modulus / (1.0 - self.poisson_ratio**2)

    @property
    def shear_modulus(self) -> float:
        """G = E / 2(1 + nu) in Pa."""
        return self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))


@dataclass(frozen=True)
class Rigid:
    """Body that does not deform."""

    name: str = "rigid"


@dataclass(frozen=True)
class YieldPressure:
    """Contact pressure (mean, over the projected area) at which a material yields plastically.

    Attributes
    ----------
    value
        In Pa; None where neither hardness nor yield stress is known.
    symbol
        ``"H"`` where it is the hardness, ``"2.8 Y"`` where it follows from the yield stress (Tabor
        1951), empty where it is not known.
    """

    value: float | None
    symbol: str


def yield_pressure(strength: Strength) -> YieldPressure:
    """Pressure at which a material of this ``strength`` yields: its hardness, else 2.8 Y.

    Examples
    --------
    >>> yield_pressure(Strength(yield_stress=200e6))
    YieldPressure(value=560000000.0, symbol='2.8 Y')
    """
    if not math.isnan(strength.hardness):
        return YieldPressure(strength.hardness, "H")
    if not math.isnan(strength.yield_stress):
        return YieldPressure(TABOR * strength.yield_stress, f"{TABOR:g} Y")
    return YieldPressure(None, "")


LEAST_OF_ELASTOMERS = 0.49
"""Poisson's ratio from which on a solid of unknown strength is taken for an elastomer, which tears
but does not yield; metals and glassy polymers have at most 0.46."""


def never_yields(material: Elastic) -> bool:
    """Whether ``material`` is an elastomer without a stated strength."""
    return yield_pressure(material.strength).value is None and material.poisson_ratio >= LEAST_OF_ELASTOMERS
