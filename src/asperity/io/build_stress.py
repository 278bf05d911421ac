"""From the table [stress] of a document to the stresses that are computed."""

from __future__ import annotations

from ..core import units
from ..stress.criteria import Tresca, VonMises
from .quantities import si_values
from .schemas.stress import StressTable
from .schemas.values import PLACES
from .stress_request import Place, Strengths, StressRequest, WantedProfile, WantedSection


def build_stress(table: StressTable) -> StressRequest:
    """Stresses that ``table`` asks for; the section through the maximum where it asks for none."""
    given = si_values(table, leave=("sections", "profiles"))
    sections = tuple(
        WantedSection("y", _place(wanted.y)) if wanted.x is None else WantedSection("x", _place(wanted.x))
        for wanted in table.sections
    )
    profiles = tuple(WantedProfile(_place(wanted.x), _place(wanted.y)) for wanted in table.profiles)
    strengths = {name: given[f"{name}_strength"] for name in vars(Strengths()) if f"{name}_strength" in given}
    anything = sections or profiles or table.depths
    return StressRequest(
        friction=table.friction,
        direction=given["direction"],
        coupled=table.coupled,
        of=table.inside,
        depths=given["depths"],
        sections=sections if anything else StressRequest().sections,
        profiles=profiles,
        deepest=given.get("deepest"),
        criterion=Tresca() if table.criterion == "tresca" else VonMises(),
        strengths=Strengths(**strengths),
        dtype="float32" if table.precision == "single" else "float64",
    )


def _place(text: str | None) -> Place:
    if text is None or text == PLACES[0]:
        return "max"
    return "pressure" if text == PLACES[1] else units.parse(text, "length", "position")
