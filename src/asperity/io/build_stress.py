"""From the table [stress] of a document to the stresses that are computed."""

from __future__ import annotations

from ..contact.problem import ContactProblem
from ..core.errors import InputError
from ..solids.elastic import Rigid
from ..stress.criteria import Tresca, VonMises
from ..stress.survey import Place, Strengths, StressRequest, WantedProfile, WantedSection
from .quantities import si_values
from .schemas.stress import StressTable
from .schemas.values import PLACES


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


def check_stress(request: StressRequest, problem: ContactProblem) -> None:
    """Refuse what ``problem`` has no stress for, before it is solved, in the words of documents and options.

    Raises
    ------
    InputError
        As of ``StressRequest.check``.
    """
    if isinstance(getattr(problem, request.of), Rigid):
        asked, other = ("counter body", "body") if request.of == "counter_body" else ("body", "counter_body")
        raise InputError(
            f"stresses are asked for inside the {asked}, which is rigid; ask for them in the other body "
            f'(inside = "{other}" in a document, or --stress-in {other.removesuffix("_body")}).'
        )
    request.check(problem)


def _place(value: float | str | None) -> Place:
    if value is None or value == PLACES[0]:
        return "max"
    return "pressure" if isinstance(value, str) else float(value)
