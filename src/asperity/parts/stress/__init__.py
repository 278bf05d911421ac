"""Stresses inside a body: the largest of each layer and interface, sections, profiles and planes; onset of yield."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, Length, NonNegativeLength, Number, Pressure
from ..part import Found, Part, Solved, Stored, Words

if TYPE_CHECKING:
    from ...contact.problem import ContactProblem
    from ...plots.picture import Figure
    from ...stress.field import StressField
    from ...stress.survey import Place, StressRequest, StressSurvey, SurveyedSection
    from ..friction import FrictionSettings


PLACES = ("max", "pressure")
"""Words for positions: of the largest stress, and of the highest pressure."""

PlaceOfMaximum: TypeAlias = Annotated[float | str, Number("length", least=0.0, words=PLACES)]


def positions_from_text(text: str) -> dict[str, str]:
    """Positions in text such as ``"y=max"`` or ``"x=30nm, y=max"``, by axis.

    Raises
    ------
    InputError
        If a part is no position; the message lacks the name of the option or key at its beginning.
    """
    found: dict[str, str] = {}
    for part in text.split(","):
        axis, equals, position = (piece.strip() for piece in part.partition("="))
        if axis not in ("x", "y") or not equals or not position or axis in found:
            raise InputError(f' must be a position such as "y=max", "y=pressure" or "x=30nm", but is {text!r}.')
        found[axis] = position
    return found


class Placed(Settings):
    """Positions ``x`` and ``y``, each a length or a word; both together may be text such as ``"y=max"``.

    ``"max"`` is the position of the largest stress, ``"pressure"`` that of the highest pressure.
    """

    x: PlaceOfMaximum | None = None
    y: PlaceOfMaximum | None = None

    @model_validator(mode="before")
    @classmethod
    def _from_text(cls, value: Any) -> Any:
        return positions_from_text(value) if isinstance(value, str) else value


class SectionTable(Placed):
    """Vertical plane through the body: exactly one of ``x`` and ``y``.

    With ``"max"`` each kind of stress is shown on the plane through its own maximum (as by Peng 2001, figs. 3.15 - 3.22).
    """

    @model_validator(mode="after")
    def _one(self) -> SectionTable:
        if (self.x is None) == (self.y is None):
            given = "none" if self.x is None else "both"
            raise InputError(f' must give exactly one of x and y, such as "y=max", but gives {given}.')
        return self


class ProfileTable(Placed):
    """Line into the body; a position that is left out is that of the largest equivalent stress, ``"max"``."""


Body = Annotated[str, Choice({"body": "body", "counter_body": "counter_body", "counter": "counter_body"})]


class StressSettings(Settings):
    """Stresses that are computed after the contact; those on the section y = max if nothing else is asked for.

    The shear traction is that of the table [friction], unless ``shear`` is false. ``depths`` are planes, ``sections`` vertical
    planes and ``profiles`` lines down to the depth ``deepest``. The strengths are compared with the largest tension, and with
    shear and peel of the interfaces.
    """

    shear: bool = setting(True, option="--shear", help="Whether the friction loads the body, too")
    inside: Body = setting("body", option="--stress-in", help="The body whose stresses are computed")
    depths: tuple[NonNegativeLength, ...] = setting((), option="--depths", help="Whole planes: 1nm,5nm,20nm")
    sections: tuple[SectionTable, ...] = setting(
        (),
        option="--section",
        help="Vertical plane through each maximum: y=max; x=30nm, y=pressure. May be repeated",
    )
    profiles: tuple[ProfileTable, ...] = setting(
        (), option="--profile", help="Line into the body: x=max,y=max; x=30nm,y=pressure. May be repeated"
    )
    deepest: Length | None = setting(
        None, option="--deepest", help="End of sections and profiles; suits the contact by default"
    )
    criterion: Literal["von_mises", "tresca"] = setting("von_mises", option="--criterion", help="Of yield")
    tensile_strength: Pressure | None = setting(
        None, option="--tensile-strength", help="To compare the largest tension with"
    )
    interface_shear_strength: Pressure | None = setting(
        None, option="--interface-shear-strength", help="To compare the shear of interfaces with"
    )
    interface_peel_strength: Pressure | None = setting(
        None, option="--interface-peel-strength", help="To compare the peel of interfaces with"
    )
    precision: Literal["double", "single"] = setting(
        "double", option="--stress-precision", help="Arithmetic of the stresses"
    )


@dataclass(frozen=True, eq=False)
class StoredSurvey:
    """Stress fields of a file: what figures show of a ``StressSurvey``."""

    sections: tuple[SurveyedSection, ...]
    profiles: tuple[StressField, ...]
    planes: StressField | None

    def wanted_planes(self) -> Iterator[StressField]:
        """The whole planes one by one."""
        return iter(()) if self.planes is None else (self.planes.only(n) for n in range(len(self.planes.planes)))


class Stress(Part):
    """Largest stresses of layers and interfaces."""

    name = "stress"
    title = "Stresses inside the body"
    table = "stress"
    settings = StressSettings
    quantities = (
        Quantity("max_von_mises", "Pa", "largest von Mises stress"),
        Quantity("max_tension", "Pa", "largest tension (σ₁)"),
        Quantity("max_shear", "Pa", "largest shear stress"),
        Quantity("max_interface_shear", "Pa", "largest shear on an interface"),
        Quantity("max_interface_peel", "Pa", "largest peel of an interface"),
    )

    def asked(self, document: Any, folder: Path) -> StressRequest | None:
        """What the table [stress] asks for, with the friction of the table [friction]."""
        return None if document.stress is None else stress_request(document.stress, document.friction)

    def check(self, ask: StressRequest, problem: ContactProblem) -> None:
        """Refuse what the problem has no stress for, in the words of documents and options."""
        from ...solids.elastic import Rigid

        if isinstance(getattr(problem, ask.of), Rigid):
            asked, other = ("counter body", "body") if ask.of == "counter_body" else ("body", "counter_body")
            raise InputError(
                f"stresses are asked for inside the {asked}, which is rigid; ask for them in the other body "
                f'(inside = "{other}" in a document, or --stress-in {other}).'
            )
        ask.check(problem)

    def compute(self, ask: StressRequest, solved: Solved) -> Found:
        """Largest stresses; the survey with sections and profiles as detail."""
        from ...stress.survey import survey

        with solved.stage("stresses") as progress:
            found = survey(ask, solved.result, lines=solved.lines, threads=solved.threads, progress=progress)
        values = {
            "max_von_mises": _largest(found, "maxima", "von_mises"),
            "max_tension": _largest(found, "maxima", "tension"),
            "max_shear": _largest(found, "maxima", "shear"),
            "max_interface_shear": _largest(found, "interfaces", "shear"),
            "max_interface_peel": _largest(found, "interfaces", "peel"),
        }
        return Found(values, found, (), found.citation_keys)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Sections, profiles and whole planes."""
        from ...plots.stress import line_figures, map_figure

        survey = found.detail
        planes = enumerate(survey.wanted_planes(), start=1)
        return (*line_figures(survey), *(map_figure(plane, number) for number, plane in planes))

    def stored(self, found: Found) -> Stored:
        """Sections, profiles and whole planes."""
        survey = found.detail
        fields = {f"section_{number}": item.field for number, item in enumerate(survey.sections, start=1)}
        fields |= {f"profile_{number}": field for number, field in enumerate(survey.profiles, start=1)}
        planes = survey.wanted_planes()
        if (first := next(planes, None)) is not None:
            fields["planes"] = chain([first], planes)
        return Stored(fields, {"drawn": [list(item.quantities) for item in survey.sections]})

    def restored(self, stored: Stored, solved: Solved) -> StoredSurvey:
        """The same fields."""
        from ...stress.survey import SurveyedSection

        drawn = enumerate(stored.facts["drawn"], start=1)
        sections = (SurveyedSection(stored.fields[f"section_{number}"], tuple(names)) for number, names in drawn)
        profiles = (field for name, field in stored.fields.items() if name.startswith("profile_"))
        return StoredSurvey(tuple(sections), tuple(profiles), stored.fields.get("planes"))

    def words(self, found: Found, solved: Solved) -> Words:
        """Largest stresses of layers and interfaces."""
        from .words import words

        return words(found.detail)

    def citations(self, ask: StressRequest, problem: ContactProblem) -> tuple[str, ...]:
        """Keys of the papers that the stresses will rest on."""
        from ...stress.survey import Planned

        return Planned(ask, problem).citation_keys


class Yielding(Part):
    """Onset of yield under the stresses."""

    name = "yielding"
    title = "Onset of yield"
    table = "stress"
    quantities = (Quantity("yield_load_factor", "1", "factor on the stresses at yield"),)

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Load factor of the survey."""
        survey = solved.found["stress"].detail
        return Found({"yield_load_factor": survey.yielding.load_factor}, survey)

    def words(self, found: Found, solved: Solved) -> Words:
        """Which part of the body yields first, and when."""
        from .words import yield_words

        return yield_words(found.detail)


def _largest(survey: StressSurvey, parts: str, peak: str) -> float:
    """Largest value of the ``peak`` in all ``parts`` of the ``survey``; NaN where there are none."""
    return max((getattr(part, peak).value for part in attrgetter(parts)(survey)), default=math.nan)


def stress_request(table: StressSettings, friction: FrictionSettings) -> StressRequest:
    """Stresses that ``table`` asks for; the section through the maximum where it asks for none."""
    from ...stress.criteria import Tresca, VonMises
    from ...stress.survey import Strengths, StressRequest, WantedProfile, WantedSection

    given = table.given("sections", "profiles")
    sections = tuple(
        WantedSection("y", _place(wanted.y)) if wanted.x is None else WantedSection("x", _place(wanted.x))
        for wanted in table.sections
    )
    profiles = tuple(WantedProfile(_place(wanted.x), _place(wanted.y)) for wanted in table.profiles)
    strengths = {name: given[f"{name}_strength"] for name in vars(Strengths()) if f"{name}_strength" in given}
    return StressRequest(
        friction=friction.coefficient if table.shear else 0.0,
        direction=friction.direction,
        coupled=friction.coupled,
        of="counter_body" if table.inside == "counter_body" else "body",
        depths=table.depths,
        sections=sections if sections or profiles or table.depths else StressRequest().sections,
        profiles=profiles,
        deepest=table.deepest,
        criterion=Tresca() if table.criterion == "tresca" else VonMises(),
        strengths=Strengths(**strengths),
        dtype="float32" if table.precision == "single" else "float64",
    )


def _place(value: float | str | None) -> Place:
    if value is None or value == PLACES[0]:
        return "max"
    return "pressure" if isinstance(value, str) else float(value)
