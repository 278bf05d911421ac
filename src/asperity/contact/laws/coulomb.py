"""Friction: shear traction in proportion to the pressure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ...core import require


@dataclass(frozen=True)
class Coulomb:
    """All points slide: shear traction = μ p in one direction.

    Parameters
    ----------
    coefficient
        μ >= 0, shear traction over pressure of the solid contact.
    direction
        Angle in rad of the shear traction on ``body`` of the problem, from +x towards +y.
    speed
        Sliding speed in m/s, >= 0, for the viscous force of a film of liquid.
    coupled
        Whether the shear changes the pressure, as it does between unlike bodies (Dundurs 1969); if not, it only adds forces.

    Raises
    ------
    InputError
        If coefficient or speed are negative, or a number is not finite.
    """

    coefficient: float
    direction: float = 0.0
    speed: float = 0.0
    coupled: bool = True
    name: ClassVar[str] = "Coulomb friction"

    def __post_init__(self) -> None:
        require.not_negative(self.coefficient, "friction coefficient")
        require.finite(self.direction, "direction of friction (rad)")
        require.not_negative(self.speed, "sliding speed (m/s)")

    @property
    def couples(self) -> bool:
        """Whether there is shear that is to change the pressure."""
        return self.coupled and self.coefficient > 0.0

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of the displacement by shear, where there is any."""
        return ("Dundurs1969", "Johnson1985") if self.couples else ()
