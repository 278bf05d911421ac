"""Menisci asked for by a document, and the theory of summits beside them, in numbers, figures and words."""

from __future__ import annotations

import math
from typing import Any

from ...contact.controls import Control
from ...contact.result import ContactResult
from ...core.errors import InputError
from ...core.units import percent, show
from ...io.words import value_text
from ...parts.part import Found, Rows, Solved, Table, Words, Work
from ...plots.picture import Figure, figures_by
from .coupling import Menisci as SolvedMenisci
from .figures import PLOTS
from .part import Wetted
from .quantities import WET_SCALARS
from .summits import HAMAKER, wet_theory
from .summits import WetTheory as SolvedTheory


class MenisciWork(Work):
    """Menisci that press the surfaces together: what is done for it."""

    def compute(self, ask: Wetted, solved: Solved) -> Found:
        """Scalars of the menisci."""
        menisci = solved.result.require_menisci()
        values = {q.name: getattr(menisci, q.name) for q in WET_SCALARS}
        return Found(values, menisci, (), menisci.citation_keys)

    def made_from(self, result: ContactResult) -> Found | None:
        """The menisci."""
        menisci = result.menisci
        return None if menisci is None else Found({}, menisci, citation_keys=menisci.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Map of the menisci."""
        return figures_by(PLOTS, solved.result)

    def words(self, found: Found, solved: Solved) -> Words:
        """Liquid, menisci and friction."""
        return film_words(found.detail, solved.control)


class WetTheoryWork(Work):
    """The theory of summits beside the menisci of the map: what is done for it."""

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Meniscus force of the theory; NaN with the reason as detail where it has none."""
        try:
            theory = wet_theory(solved.result)
        except InputError as error:
            return Found({"statistical_meniscus_force": math.nan}, str(error))
        return Found({"statistical_meniscus_force": theory.meniscus_force}, theory, (), theory.citation_keys)

    def words(self, found: Found, solved: Solved) -> Words:
        """Summits, forces and growth, or why there is no theory."""
        return theory_words(found.detail, solved.found["film"].detail)


REGIMES = {
    "dry": "no liquid bridges the gap",
    "toe-dipping": "menisci stand around single summits",
    "pillbox": "a meniscus reaches across the surface",
    "flooded": "liquid and contact fill nearly the whole area",
}
"""What each regime means."""


REMARK = (
    "The film lies as it was before contact and is not redistributed; the suction acts on the area of the menisci without "
    "the solid contact, and presses the surfaces together as an additional load."
)
"""What the model assumes."""


THEORY_REMARK = (
    "Statistical theory of the summits of this surface: independent Hertz contacts, their heights by skewness and kurtosis (Kotwal "
    "and Bhushan), each summit in the film pulled by the full force of a touching sphere (Gao, Tian and Bhushan). The map above counts the "
    "area at the meniscus height instead, leaves out the contact, and lets the summits push each other: an estimate beside it."
)
"""What the theory of summits is, and why it differs."""


def film_words(result: SolvedMenisci, control: Control) -> Words:
    """Liquid, menisci and friction."""
    cells = tuple(wet_rows(result))
    return Words(
        wet_sentence(result),
        rows=film_rows(result, control),
        tables=(("", Table(("Quantity", "Value"), cells)),),
        remarks=(REMARK,),
    )


def theory_words(found: SolvedTheory | str, result: SolvedMenisci) -> Words:
    """Results of the theory of summits beside the ``result`` on the map, or why there are none."""
    return Words(rows=theory_rows(found, result), remarks=() if isinstance(found, str) else (THEORY_REMARK,))


def theory_rows(found: SolvedTheory | str, result: SolvedMenisci) -> Rows:
    """Statistical and kinetic menisci beside the ``result`` on the map."""
    if isinstance(found, str):
        return [("no statistical theory", found)] if found else []
    contact, load = found.statistical.contact, result.external_force
    rows = [
        ("summits", f"{found.summits} of radius {show(contact.radius, 'm', 3)}"),
        ("standard deviation of their heights", show(contact.height_deviation, "m", 3)),
        ("meniscus force", show(found.meniscus_force, "N")),
        ("meniscus force / external force", f"{found.meniscus_force / load:.4g}"),
        ("meniscus force / that of the map", _over(found.meniscus_force, result.meniscus_force)),
        ("growth of the force with the load, dF/dL", f"{found.feedback:.3g}"),
    ]
    if result.dry_friction > 0.0:
        friction = result.dry_friction * (1.0 + found.meniscus_force / load)
        rows.append(("static friction coefficient, without viscous part", f"{friction:.4g}"))
    if found.growth is None:
        why = (
            "not known without a viscosity"
            if math.isnan(result.film.viscosity)
            else "none: the film holds its liquid back"
        )
        return [*rows, ("growth of the menisci with time", why)]
    grown = show(found.growth.time_to(0.99), "s", 3)
    return [
        *rows,
        ("meniscus force just after contact", show(found.first_force, "N")),
        ("menisci grow to 99 % within", f"{grown} (Hamaker constant {HAMAKER:g} J, assumed)"),
    ]


def _over(force: float, other: float) -> str:
    return f"{force / other:.3g}" if other > 0.0 else "–"


def film_rows(result: SolvedMenisci, control: Control) -> Rows:
    """Liquid and film."""
    film = result.film
    angles = " and ".join(f"{math.degrees(angle):.4g}°" for angle in film.contact_angles)
    rows = [
        (f"prescribed {control.name}", show(control.value, control.unit)),
        ("surface tension", show(film.surface_tension, "N/m")),
        ("contact angles", angles),
    ]
    if result.viscous_force > 0.0:
        rows.append(("viscosity", show(film.viscosity, "Pa*s")))
    rows.append(("dry friction coefficient", f"{result.dry_friction:g}"))
    return rows


def wet_rows(result: SolvedMenisci) -> Rows:
    """Every scalar of the menisci, and the regime; without friction where none was given."""
    regime = result.wetting.regime
    rows = [("regime", f"{regime}: {REGIMES[regime]}")]
    silent = {"friction_force", "viscous_force", "static_friction"} if result.friction_force == 0.0 else set()
    for quantity in WET_SCALARS:
        if quantity.name not in silent:
            rows.append((quantity.label, value_text(quantity, getattr(result, quantity.name))))
    return rows


def wet_sentence(result: SolvedMenisci) -> str:
    """One sentence on the menisci."""
    if result.wetting.regime == "dry":
        return "No liquid bridges the gap: the contact is dry."
    share = percent(result.meniscus_area_fraction)
    pull = show(result.meniscus_force, "N")
    if math.isnan(result.relative_meniscus_force):
        return f"Menisci on {share} of the nominal area pull with {pull}, more than the contact force."
    return f"Menisci on {share} of the nominal area pull with {pull}, {result.relative_meniscus_force:.3g} times the external force."
