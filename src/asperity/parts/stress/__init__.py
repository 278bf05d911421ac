"""Stresses inside a body: the largest of each layer and interface, sections, profiles and planes; onset of yield."""

from __future__ import annotations

import math
from collections.abc import Mapping
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...core.quantity import Quantity
from ..part import Found, Part, Solved, Words

if TYPE_CHECKING:
    from ...contact.problem import ContactProblem
    from ...plots.picture import Figure
    from ...stress.survey import StressRequest, StressSurvey


class Stress(Part):
    """Largest stresses of layers and interfaces."""

    name = "stress"
    title = "Stresses inside the body"
    table = "stress"
    quantities = (
        Quantity("max_von_mises", "Pa", "largest von Mises stress"),
        Quantity("max_tension", "Pa", "largest tension (σ₁)"),
        Quantity("max_shear", "Pa", "largest shear stress"),
        Quantity("max_interface_shear", "Pa", "largest shear on an interface"),
        Quantity("max_interface_peel", "Pa", "largest peel of an interface"),
    )

    def asked(self, document: Any, folder: Path) -> StressRequest | None:
        """What the table [stress] asks for."""
        if document.stress is None:
            return None
        from ...io.build_stress import build_stress

        return build_stress(document.stress)

    def check(self, ask: StressRequest, problem: ContactProblem) -> None:
        """Refuse stresses that the problem does not have."""
        from ...io.build_stress import check_stress

        check_stress(ask, problem)

    def coupling(self, ask: StressRequest) -> Mapping[str, Any]:
        """Shear traction that changes the pressure, if that is asked for."""
        return {"sliding": ask} if ask.coupled and ask.friction else {}

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
        planes = enumerate(survey.planes(survey.request.depths), start=1) if survey.request.depths else ()
        return (*line_figures(survey), *(map_figure(plane, number) for number, plane in planes))

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
