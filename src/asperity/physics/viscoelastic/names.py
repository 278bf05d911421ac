"""Names of viscoelasticity in problems and energies, with their types: for type checkers
and editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ...core.arrays import RealArray


class CreepEnergies:
    """Shares of the energies of a history."""

    if TYPE_CHECKING:
        step_work: RealArray
