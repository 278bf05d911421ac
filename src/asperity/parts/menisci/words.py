"""A liquid film and its menisci in words and tables."""

from __future__ import annotations

import math

from ...contact.control import Control
from ...contact.couplings.menisci import Menisci
from ...contact.result import WET_SCALARS
from ...contact.wet_theory import HAMAKER, WetTheory
from ...core.units import percent, show
from ...io.words import value_text
from ..part import Rows, Table, Words

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
"""What the model takes for granted."""


THEORY_REMARK = (
    "Statistical theory of the summits of this surface: independent Hertz contacts, their heights by skewness and kurtosis (Kotwal "
    "and Bhushan), each summit in the film pulled by the full force of a touching sphere (Gao, Tian and Bhushan). The map above counts the "
    "area at the meniscus height instead, leaves out the contact, and lets the summits push each other: an estimate beside it."
)
"""What the theory of summits is, and why it differs."""


def words(result: Menisci, control: Control) -> Words:
    """Liquid, menisci and friction."""
    cells = tuple(wet_rows(result))
    return Words(
        wet_sentence(result),
        rows=film_rows(result, control),
        tables=(("", Table(("Quantity", "Value"), cells)),),
        remarks=(REMARK,),
    )


def theory_words(found: WetTheory | str, result: Menisci) -> Words:
    """What the theory of summits says beside the ``result`` on the map, or why it says nothing."""
    return Words(rows=theory_rows(found, result), remarks=() if isinstance(found, str) else (THEORY_REMARK,))


def theory_rows(found: WetTheory | str, result: Menisci) -> Rows:
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


def film_rows(result: Menisci, control: Control) -> Rows:
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


def wet_rows(result: Menisci) -> Rows:
    """Every scalar of the menisci, and the regime; without friction where none was given."""
    regime = result.wetting.regime
    rows = [("regime", f"{regime}: {REGIMES[regime]}")]
    silent = {"friction_force", "viscous_force", "static_friction"} if result.friction_force == 0.0 else set()
    for quantity in WET_SCALARS:
        if quantity.name not in silent:
            rows.append((quantity.label, value_text(quantity, getattr(result, quantity.name))))
    return rows


def wet_sentence(result: Menisci) -> str:
    """One sentence on the menisci."""
    if result.wetting.regime == "dry":
        return "No liquid bridges the gap: the contact is dry."
    share = percent(result.meniscus_area_fraction)
    pull = show(result.meniscus_force, "N")
    if math.isnan(result.relative_meniscus_force):
        return f"Menisci on {share} of the nominal area pull with {pull}, more than the contact force."
    return f"Menisci on {share} of the nominal area pull with {pull}, {result.relative_meniscus_force:.3g} times the external force."
