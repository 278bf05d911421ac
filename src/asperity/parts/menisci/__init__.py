"""A liquid film between the surfaces: its menisci and friction, and what the theory of summits says beside them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...core.errors import InputError
from ...core.quantity import Quantity
from ..part import Found, Part, Solved, Words

if TYPE_CHECKING:
    from ...contact.wet import Friction
    from ...contact.wetting import LiquidFilm
    from ...plots.picture import Figure


@dataclass(frozen=True)
class Wetted:
    """The film that is asked for, and its friction."""

    film: LiquidFilm
    friction: Friction


class Menisci(Part):
    """Menisci that press the surfaces together."""

    name = "film"
    title = "Liquid film and menisci"
    table = "film"

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars of a wet contact."""
        from ...contact.wet_result import WET_SCALARS

        return WET_SCALARS

    def asked(self, document: Any, folder: Path) -> Wetted | None:
        """The film and friction that the table [film] describes."""
        if document.film is None:
            return None
        from ...io.build_film import build_film

        return Wetted(*build_film(document.film, folder))

    def coupling(self, ask: Wetted) -> Mapping[str, Any]:
        """The film joins the solve."""
        return {"film": ask}

    def compute(self, ask: Wetted, solved: Solved) -> Found:
        """Scalars of the menisci."""
        from ...contact.wet_advice import review_wet
        from ...contact.wet_result import WET_SCALARS

        wet = solved.coupled["film"]
        values = {q.name: getattr(wet, q.name) for q in WET_SCALARS}
        return Found(values, wet, review_wet(wet), wet.citation_keys, wet.status)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Map of the menisci."""
        from ...plots.contact import wet_figures

        return wet_figures(found.detail)

    def words(self, found: Found, solved: Solved) -> Words:
        """Liquid, menisci and friction."""
        from .words import words

        return words(found.detail)


class WetTheory(Part):
    """The theory of summits beside the menisci of the map."""

    name = "wet_theory"
    title = "Statistical theory beside it"
    table = "film"
    quantities = (Quantity("statistical_meniscus_force", "N", "meniscus force of the theory of summits", costly=True),)

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Meniscus force of the theory; NaN with the reason as detail where it has none."""
        from ...contact.wet_theory import wet_theory

        try:
            theory = wet_theory(solved.found["film"].detail)
        except InputError as error:
            return Found({"statistical_meniscus_force": math.nan}, str(error))
        return Found({"statistical_meniscus_force": theory.meniscus_force}, theory, (), theory.citation_keys)

    def words(self, found: Found, solved: Solved) -> Words:
        """Summits, forces and growth, or why there is no theory."""
        from .words import theory_words

        return theory_words(found.detail, solved.found["film"].detail)
