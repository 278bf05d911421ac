"""Menisci asked for by a document, and the theory of summits beside them, in numbers, figures and
words."""

from __future__ import annotations

import math
from typing import Any

from ...contact.result import ContactResult
from ...core.errors import InputError
from ...core.units import percent, show, times
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

    def step(self, found: Found, solved: Solved) -> int | None:
        """The end of the load path."""
        return solved.step_of(solved.result)

    def words(self, found: Found, solved: Solved) -> Words:
        """Liquid, menisci and friction."""
        result: SolvedMenisci = found.detail
        control, film, regime = solved.control, result.film, result.wetting.regime
        rows = [
            (f"prescribed {control.name}", show(control.value, control.unit)),
            ("surface tension", show(film.surface_tension, "N/m")),
            ("contact angles", " and ".join(f"{math.degrees(angle):.4g}°" for angle in film.contact_angles)),
        ]
        if result.viscous_force > 0.0:
            rows.append(("viscosity", show(film.viscosity, "Pa*s")))
        rows.append(("dry friction coefficient", f"{result.dry_friction:g}"))
        cells = [("regime", f"{regime}: {REGIMES[regime]}")]
        silent = {"friction_force", "viscous_force", "static_friction"} if result.friction_force == 0.0 else set()
        for quantity in WET_SCALARS:
            if quantity.name not in silent:
                cells.append((quantity.label, value_text(quantity, getattr(result, quantity.name))))
        share, pull = percent(result.meniscus_area_fraction), show(result.meniscus_force, "N")
        more = f"{times(result.relative_meniscus_force, 3)} times the external force"
        if math.isnan(result.relative_meniscus_force):
            more = "more than the contact force"
        unfed = "" if film.feedback else ", without feedback: in the gap of the load alone"
        sentence = f"Menisci on {share} of the nominal area pull with {pull}, {more}{unfed}."
        if regime == "dry":
            sentence = "No liquid bridges the gap: the contact is dry."
        tables = (("", Table(("Quantity", "Value"), tuple(cells))),)
        return Words(sentence, rows=rows, tables=tables, remarks=(REMARK if film.feedback else UNFED_REMARK,))


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
        rows = theory_rows(found.detail, solved.found["film"].detail)
        return Words(rows=rows, remarks=() if isinstance(found.detail, str) else (THEORY_REMARK,))


REGIMES = {
    "dry": "no liquid bridges the gap",
    "toe-dipping": "menisci stand around single summits",
    "pillbox": "a meniscus reaches across the surface",
    "flooded": "liquid and contact fill nearly the whole area",
}
"""What each regime means."""


REMARK = (
    "The film lies as it was before contact and is not redistributed; the suction acts on the area of the "
    "menisci without the solid contact, and presses the surfaces together as an additional load."
)
"""What the model assumes."""


UNFED_REMARK = (
    "The film lies as it was before contact and is not redistributed; the suction acts on the area of the "
    "menisci without the solid contact, in the gap of the load alone: it is no part of what the contact carries."
)
"""What it assumes where the menisci are not fed back."""


THEORY_REMARK = (
    "Statistical theory of the summits of this surface: independent Hertz contacts, their heights by skewness "
    "and kurtosis (Kotwal and Bhushan), each summit in the film pulled by the full force of a touching sphere "
    "(Gao, Tian and Bhushan). The map above counts the area at the meniscus height instead, leaves out the "
    "contact, and lets the summits push each other: an estimate beside it."
)
"""What the theory of summits is, and why it differs."""


def theory_rows(found: SolvedTheory | str, result: SolvedMenisci) -> Rows:
    """Statistical and kinetic menisci beside the ``result`` on the map."""
    if isinstance(found, str):
        return [("no statistical theory", found)] if found else []
    contact, load, mapped = found.statistical.contact, result.external_force, result.meniscus_force
    rows = [
        ("summits", f"{found.summits} of radius {show(contact.radius, 'm', 3)}"),
        ("standard deviation of their heights", show(contact.height_deviation, "m", 3)),
        ("meniscus force", show(found.meniscus_force, "N")),
        ("meniscus force / external force", f"{found.meniscus_force / load:.4g}"),
        ("meniscus force / that of the map", f"{found.meniscus_force / mapped:.3g}" if mapped > 0.0 else "–"),
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
