"""Names of menisci in problems and energies, with their types: for type checkers and
editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

if TYPE_CHECKING:
    from ...core.arrays import RealArray
    from .film import LiquidFilm


class FilmKeyword(TypedDict, total=False):
    """What a problem takes by keyword."""

    film: LiquidFilm | None


class FilmGiven:
    """What was given for the keyword."""

    if TYPE_CHECKING:
        film: LiquidFilm | None


class FilmEnergies:
    """Shares of the energies of a history."""

    if TYPE_CHECKING:
        meniscus_work: RealArray
