"""Names of adhesion in problems and energies, with their types: for type checkers and
editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

if TYPE_CHECKING:
    from ...core.arrays import RealArray
    from .law import Adhesion


class AttractionKeyword(TypedDict, total=False):
    """What a problem takes by keyword."""

    adhesion: Adhesion | None


class AttractionGiven:
    """What was given for the keyword."""

    if TYPE_CHECKING:
        adhesion: Adhesion | None


class AttractionEnergies:
    """Shares of the energies of a history."""

    if TYPE_CHECKING:
        jump_work: RealArray
