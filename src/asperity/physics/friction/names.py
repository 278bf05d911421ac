"""Names of friction in problems and energies, with their types: for type checkers and
editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

if TYPE_CHECKING:
    from ...core.arrays import RealArray
    from .law import FrictionLaw


class FrictionKeyword(TypedDict, total=False):
    """What a problem takes by keyword."""

    friction: FrictionLaw | None


class FrictionGiven:
    """What was given for the keyword."""

    if TYPE_CHECKING:
        friction: FrictionLaw | None


class FrictionEnergies:
    """Shares of the energies of a history."""

    if TYPE_CHECKING:
        shear_work: RealArray
        tangential_work: RealArray
        slip_work: RealArray
