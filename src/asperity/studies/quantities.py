"""The scalar quantities that a study can collect from a case. A new one is one line in ``MEASURES``."""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from operator import attrgetter

from ..contact.result import SCALARS, ContactResult
from ..contact.wet_result import WET_SCALARS, WetContactResult
from ..contact.wet_theory import wet_theory
from ..core.errors import InputError
from ..core.quantity import Quantity
from ..io.build import Case
from ..io.documents import ProblemDocument
from ..stress.survey import StressSurvey


@dataclass(frozen=True, eq=False)
class Solved:
    """A case with its answers; ``stress`` and ``wet`` if the document asks for them."""

    case: Case
    result: ContactResult
    stress: StressSurvey | None = None
    wet: WetContactResult | None = None


@dataclass(frozen=True)
class Measure:
    """A scalar of a solved case: what it is, and how it is taken.

    ``table`` is the table of the document without which there is none; a costly one is taken only if asked for.
    """

    quantity: Quantity
    of: Callable[[Solved], float]
    table: str = ""

    @property
    def name(self) -> str:
        """Name of the quantity."""
        return self.quantity.name


def _of_result(name: str) -> Callable[[Solved], float]:
    return lambda solved: float(getattr(solved.result, name))


def _of_menisci(name: str) -> Callable[[Solved], float]:
    return lambda solved: float(getattr(solved.wet, name))


def _of_theory(solved: Solved) -> float:
    """Meniscus force in N of the theory of summits; NaN where it has none."""
    if solved.wet is None:
        return math.nan
    try:
        return wet_theory(solved.wet).meniscus_force
    except InputError:
        return math.nan


def _largest(parts: str, peak: str) -> Callable[[Solved], float]:
    """Largest value of the ``peak`` in all ``parts`` of the survey of stresses; NaN where there are none."""
    found = attrgetter(parts)
    return lambda solved: max((getattr(part, peak).value for part in found(solved.stress)), default=math.nan)


STIFFNESS = "normal_stiffness"
"""The quantity that costs about one more solve."""

MEASURES = (
    *(Measure(q, _of_result(q.name)) for q in SCALARS),
    *(Measure(q, _of_menisci(q.name), "film") for q in WET_SCALARS),
    Measure(
        Quantity("statistical_meniscus_force", "N", "meniscus force of the theory of summits", costly=True),
        _of_theory,
        "film",
    ),
    Measure(
        Quantity("max_displacement", "m", "largest displacement"),
        lambda solved: float(solved.result.displacement.max()),
    ),
    Measure(
        Quantity("rms_height", "m", "rms height of the profile"),
        lambda solved: float(solved.result.problem.profile().std()),
    ),
    Measure(
        Quantity("contact_modulus", "Pa", "contact modulus E*"), lambda solved: solved.result.problem.contact_modulus
    ),
    Measure(Quantity("max_von_mises", "Pa", "largest von Mises stress"), _largest("maxima", "von_mises"), "stress"),
    Measure(Quantity("max_tension", "Pa", "largest tension (σ₁)"), _largest("maxima", "tension"), "stress"),
    Measure(Quantity("max_shear", "Pa", "largest shear stress"), _largest("maxima", "shear"), "stress"),
    Measure(
        Quantity("max_interface_shear", "Pa", "largest shear on an interface"),
        _largest("interfaces", "shear"),
        "stress",
    ),
    Measure(
        Quantity("max_interface_peel", "Pa", "largest peel of an interface"), _largest("interfaces", "peel"), "stress"
    ),
    Measure(
        Quantity("yield_load_factor", "1", "factor on the stresses at yield"),
        attrgetter("stress.yielding.load_factor"),
        "stress",
    ),
)
"""Every quantity in the order of tables."""


def measure(name: str) -> Measure:
    """The quantity ``name``."""
    return next(item for item in MEASURES if item.name == name)


def computed(document: ProblemDocument, asked: Iterable[str]) -> tuple[str, ...]:
    """Names of the quantities that are computed of each case: all that cost nothing, and the costly ones ``asked`` for.

    Raises
    ------
    InputError
        If one that is asked for is unknown, or needs a table that the document lacks.
    """
    wanted = tuple(asked)
    known = {item.name: item for item in MEASURES}
    for name in wanted:
        if name not in known:
            near = difflib.get_close_matches(name, known, n=3, cutoff=0.4)
            hint = f"did you mean {' or '.join(near)}?" if near else f"known are {', '.join(known)}."
            raise InputError(f"quantities must be names of results, but {name!r} is none; {hint}")
        table = known[name].table
        if table and getattr(document, table) is None:
            raise InputError(f"quantity {name} needs the table [{table}] in the problem, but it is missing; add it.")
    there = (item for item in MEASURES if not item.table or getattr(document, item.table) is not None)
    return tuple(item.name for item in there if not item.quantity.costly or item.name in wanted)
