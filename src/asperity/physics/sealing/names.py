"""Names of a fluid that presses on both bodies in problems and energies, with their types: for type
checkers and editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

if TYPE_CHECKING:
    from ...core.arrays import RealArray
    from .law import FluidPressure


class FluidKeyword(TypedDict, total=False):
    """What a problem takes by keyword."""

    fluid_pressure: FluidPressure | None


class FluidGiven:
    """What was given for the keyword."""

    if TYPE_CHECKING:
        fluid_pressure: FluidPressure | None


class FluidEnergies:
    """Shares of the energies of a history."""

    if TYPE_CHECKING:
        fluid_work: RealArray
