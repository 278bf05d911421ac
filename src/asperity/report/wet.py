"""A liquid film and its menisci in words and tables."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..contact.wet_result import WET_SCALARS, WetContactResult
from ..core.units import percent, show
from ..plots.figure import Figure
from .inputs import Rows
from .outputs import value_text

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


@dataclass(frozen=True, eq=False)
class WetPart:
    """The part of a report on the liquid: the wet contact and its figures."""

    result: WetContactResult
    figures: tuple[Figure, ...] = ()


def film_rows(result: WetContactResult) -> Rows:
    """Liquid and film."""
    film = result.film
    angles = " and ".join(f"{math.degrees(angle):.4g}°" for angle in film.contact_angles)
    control = result.control
    rows = [
        (f"prescribed {control.name}", show(control.value, control.unit)),
        ("surface tension", show(film.surface_tension, "N/m")),
        ("contact angles", angles),
    ]
    if result.viscous_force > 0.0:
        rows.append(("viscosity", show(film.viscosity, "Pa*s")))
    rows.append(("dry friction coefficient", f"{result.dry_friction:g}"))
    return rows


def wet_rows(result: WetContactResult) -> Rows:
    """Every scalar of the menisci, and the regime; without friction where none was given."""
    regime = result.wetting.regime
    rows = [("regime", f"{regime}: {REGIMES[regime]}")]
    silent = {"friction_force", "viscous_force", "static_friction"} if result.friction_force == 0.0 else set()
    for quantity in WET_SCALARS:
        if quantity.attribute not in silent:
            rows.append((quantity.label, value_text(quantity, getattr(result, quantity.attribute))))
    return rows


def wet_sentence(result: WetContactResult) -> str:
    """One sentence on the menisci."""
    if result.wetting.regime == "dry":
        return "No liquid bridges the gap: the contact is dry."
    share = percent(result.meniscus_area_fraction)
    pull = show(result.meniscus_force, "N")
    if math.isnan(result.relative_meniscus_force):
        return f"Menisci on {share} of the nominal area pull with {pull}, more than the contact bears."
    return f"Menisci on {share} of the nominal area pull with {pull}, {result.relative_meniscus_force:.3g} times the external force."
