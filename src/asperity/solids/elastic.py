"""Homogeneous bodies: elastic half-spaces and the rigid body."""

from __future__ import annotations

from dataclasses import dataclass

from ..core import require
from ..core.late import Shown


@dataclass(frozen=True)
class Strength:
    """Hardness and tensile yield stress in Pa; ``nan`` where not known. InputError if a given value is not positive."""

    hardness: float = float("nan")
    yield_stress: float = float("nan")

    def __post_init__(self) -> None:
        for value, what in ((self.hardness, "hardness (Pa)"), (self.yield_stress, "yield stress (Pa)")):
            if value == value:
                require.positive(value, what)


INCOMPRESSIBLE = "Use 0.5 for an incompressible solid."
"""What to do about a Poisson's ratio that is too large."""


@dataclass(frozen=True, repr=False)
class Elastic(Shown):
    """Isotropic linear-elastic half-space.

    InputError if a value is outside its range, or ``strength`` is no ``Strength``.

    Parameters
    ----------
    youngs_modulus
        E in Pa, > 0.
    poisson_ratio
        nu, -1 < nu <= 0.5; 0.5 is incompressible.
    strength
        Hardness and yield stress, where known.
    name, sources
        Name of the material and where its values come from.
    """

    youngs_modulus: float
    poisson_ratio: float
    strength: Strength = Strength()
    name: str = ""
    sources: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        require.positive(self.youngs_modulus, "Young's modulus (Pa)")
        require.within(self.poisson_ratio, -1.0, 0.5, "Poisson's ratio", INCOMPRESSIBLE)
        require.instance(self.strength, Strength, "strength of an elastic body", "Write Strength(hardness=...).")

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
