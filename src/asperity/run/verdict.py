"""The verdict on what was computed: what was found, whether the bodies hold, and whether it can be
trusted; the same in every interface."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np

from ..contact.history import HistoryResult
from ..contact.result import ContactResult
from ..core.status import GRADES, Advice, Verdict
from ..core.units import percent, show, times
from ..io.words import area_text, headline_rows, limit_text
from ..parts.advice import DOUBT, findings
from ..parts.part import Part, Reached, Words
from ..solids.elastic import TABOR
from ..solids.layers import strength_of
from .execute import Outcome, answered

FIRST_YIELD = 1.6 / TABOR
"""Largest pressure over hardness at which a half-space yields beneath a sphere: 1.6 Y (Johnson
1985, sec. 6.1) at 2.8 Y for the hardness."""

WEIGHT = (
    "load",
    "hardness",
    "yield everywhere",
    "slope",
    "",
    "periodic edges",
    "pressure at the seam",
    "patch against period",
    "contact pixels",
    "resolution",
    "asperity radius",
    "layer against pixel",
)
"""Criteria of findings in the order in which they matter; those of a physics stand at the empty
name."""


def verdict(thing: ContactResult | HistoryResult | Outcome | str | Path) -> Verdict:
    """The verdict on a result, a history, an outcome, or what a result file holds.

    Raises
    ------
    FileFormatError
        If the file is missing, damaged, or holds no contact.
    """
    if isinstance(thing, str | Path):
        from .stored import load_outcome

        thing = load_outcome(thing)
    if isinstance(thing, Outcome):
        outcome = thing
    else:
        outcome = answered(thing.last, thing) if isinstance(thing, HistoryResult) else answered(thing, None)
    said = outcome.sections
    if not isinstance(outcome.result, ContactResult):
        return _of_tractions(said)
    reached = outcome.solved.at()
    # all findings, each once, that on its energy first
    own = () if "contact" in outcome.found else findings(outcome.path or outcome.result)
    told = tuple(sorted(dict.fromkeys((*outcome.findings, *own)), key=lambda item: item.criterion != DOUBT))
    names = doubted(told, reached.result)
    grade, trust = _trust(outcome, reached.result, told)
    holds, fails = _holds(outcome, reached.result, said, names)
    what = " ".join(
        [
            _contact(reached, outcome),
            *(words.sentence for part, words in said if part.answers and words.sentence and not words.holds),
        ]
    )
    headline = [*headline_rows(reached.result, names), *(row for _, words in said for row in words.headline)]
    trusted = f"{GRADES[grade]}: {trust}"
    return Verdict(what, holds, trusted, grade, fails, reached.number, reached.many, headline, told, names)


def _of_tractions(said: Sequence[tuple[Part, Words]]) -> Verdict:
    """On stresses under prescribed tractions, which need no solution."""
    what, trust = (
        "The stresses are those under the prescribed tractions.",
        f"{GRADES['good']}: nothing had to be solved.",
    )
    holds = " ".join(words.holds for _, words in said if words.holds) or "Yielding not checked."
    fails = any(words.alarming for _, words in said)
    return Verdict(what, holds, trust, "good", fails, 1, 1, [row for _, words in said for row in words.headline])


def doubted(told: Iterable[Advice], result: ContactResult) -> tuple[str, ...]:
    """Beginnings of the names of all quantities of ``result`` that findings put in doubt."""
    return tuple(dict.fromkeys(name for item in told if not _unreached(item, result) for name in item.concerns))


def _unreached(item: Advice, result: ContactResult) -> bool:
    """Whether the finding is about a limit of the pressure that no point of ``result`` reaches."""
    limits = [item.numbers[name] for name in ("limit", "hardness") if name in item.numbers]
    return "limit" in item.numbers and result.max_pressure < min(limits) * (1.0 - 1e-9)


def _contact(reached: Reached, outcome: Outcome) -> str:
    """The contact at the decisive step, and where the path ends if that is another."""
    result, last = reached.result, outcome.result
    if result.contact.any():
        under = f"under a mean pressure of {show(result.mean_pressure, 'Pa')} ({show(result.force, 'N')})"
        approach = f", approach {show(result.approach, 'm')}" if math.isfinite(result.approach) else ""
        text = (
            f"bodies touch on {area_text(result)} of the nominal area, "
            f"{show(result.contact_area, 'm**2')}, {under}{approach}."
        )
    else:
        text = f"bodies do not touch; the mean gap is {show(result.mean_gap, 'm')}."
    text = f"At step {reached.number} of {reached.many} the {text}" if reached.many > 1 else f"The {text}"
    if reached.number == reached.many:
        return text
    touch = f"touch on {percent(last.area_fraction_corrected)} of it" if last.contact.any() else "do not touch"
    dents = (
        f", and an indentation of up to {show(last.max_permanent_indentation, 'm')} stays"
        if last.indented.any()
        else ""
    )
    return f"{text} At the end they {touch}{dents}."


def _holds(
    outcome: Outcome, result: ContactResult, said: Sequence[tuple[Part, Words]], names: tuple[str, ...]
) -> tuple[str, bool]:
    """What does not hold, by all that was computed, and whether there is any of it; ``names`` begin
    those of doubted quantities."""
    texts, fails = list[str](), False
    for part, words in said:
        if words.holds:
            doubtful = names and any(
                _known(outcome.found[part.name].values, q.name) for q in part.quantities if q.name.startswith(names)
            )
            texts.append(f"{words.holds[:-1]} (doubtful)." if doubtful else words.holds)
            fails |= words.alarming
    limit = limit_text(result.problem)
    if limit:
        share = f"{percent(result.plastic_area_fraction)} of the real contact area"
        reach = (
            f"{share} is at the pressure limit, {limit}"
            if result.plastic.any()
            else f"no point reaches the pressure limit, {limit}"
        )
        plastic = result.is_plastic
        texts.insert(0, f"{'Plastic' if plastic else 'Elastic'}: {reach}.")
        fails |= plastic
    elif not texts and result.contact.any():
        text, fails = _strength(result)
        texts.append(text)
    return " ".join(texts) or "Nothing touches, so nothing yields.", fails


def _known(values: Mapping[str, Any], name: str) -> bool:
    """Whether the ``values`` hold a number ``name``."""
    value = values.get(name)
    return isinstance(value, float | int | np.number) and math.isfinite(value)


def _strength(result: ContactResult) -> tuple[str, bool]:
    """The largest pressure against what the surfaces of the bodies bear, where nothing limits
    it."""
    found = strength_of(result.problem.body, result.problem.counter_body)
    known = {item.known_as: result.max_pressure / item.pressure for item in found if item.pressure}
    unknown = dict.fromkeys(item.material for item in found if not item.pressure)
    texts, worst = list[str](), max(known.values(), default=0.0)
    if known:
        said = " and ".join(f"{times(ratio, 3)} times {name}" for name, ratio in known.items())
        state = "Would yield" if worst > 1.0 else "Near yield" if worst > FIRST_YIELD else "Elastic"
        near = f"; beneath a smooth contact yielding starts at {FIRST_YIELD:.2g}" if state == "Near yield" else ""
        texts.append(f"{state}: the largest pressure, {show(result.max_pressure, 'Pa')}, is {said}{near}.")
    if unknown:
        texts.append(f"Yielding not checked: strength of {' and '.join(unknown)} unknown, give Y or H.")
    return " ".join(texts) or "The surfaces are of materials that do not yield.", worst > 1.0


def _trust(
    outcome: Outcome, result: ContactResult, told: Sequence[Advice]
) -> tuple[Literal["good", "doubtful", "not"], str]:
    """The grade, and the reason that matters most with its remedy."""
    if not outcome.status.converged:
        return "not", f"{outcome.status.message} {outcome.status.remedy}".rstrip()
    failed = [] if outcome.path is None else [n for n, step in enumerate(outcome.path.steps, 1) if not step.converged]
    if failed:
        status = outcome.path.steps[failed[0] - 1].status if outcome.path else outcome.status
        numbers = ", ".join(map(str, failed))
        return (
            "not",
            f"not converged in step{'s' * (len(failed) > 1)} {numbers}. {status.message} {status.remedy}".rstrip(),
        )
    if told and told[0].criterion == DOUBT:
        return "not", told[0].message
    reasons = [item for item in told if (item.level == "warning" or item.concerns) and not _unreached(item, result)]
    if reasons:
        place = {name: number for number, name in enumerate(WEIGHT)}
        worst = min(reasons, key=lambda item: (item.level != "warning", place.get(item.criterion, place[""])))
        more = f" ({len(reasons) - 1} more finding{'s' * (len(reasons) > 2)})" if len(reasons) > 1 else ""
        return "doubtful", worst.message + more
    area = (
        f", the area to {percent(result.area_fraction_error / result.area_fraction_corrected, 2)}"
        if result.contact.any()
        else ""
    )
    return (
        "good",
        f"converged; the energy is known to {max(result.certificate.duality_gap, 1e-16):.1g} of itself{area}.",
    )
