"""Judge random problems: solve each, and hold what is called converged against the equations of its physics."""

from __future__ import annotations

import traceback
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from judge.checks import LARGEST_RATIO, Check
from judge.equations import equations
from judge.problems import problem
from judge.solved import solved


@dataclass(frozen=True)
class Verdict:
    """What came of the problem of a ``seed``: refused or not converged by a ``cause``, else the ``worst`` equation."""

    seed: int
    kind: str
    outcome: str
    cause: str = ""
    worst: Check | None = None

    @property
    def false(self) -> bool:
        """Whether it was wrongly called converged, or the program failed otherwise."""
        return self.outcome in ("false", "failed")


def judged(seed: int) -> Verdict:
    """Verdict on the problem of the ``seed``."""
    case = problem(seed)
    try:
        found = solved(case)
    except Exception as error:  # an error of the program, which is none of its own kinds
        return Verdict(seed, case.kind, "failed", f"{type(error).__name__} in {_place(error)}")
    if found.refused:
        return Verdict(seed, case.kind, "refused", found.refused)
    if found.not_converged:
        return Verdict(seed, case.kind, "not converged", found.not_converged)
    checks = equations(case, found)
    worst = max(checks, key=lambda check: check.ratio, default=None)
    wrong = worst is not None and not worst.ratio <= LARGEST_RATIO
    return Verdict(seed, case.kind, "false" if wrong else "right", worst.name if wrong and worst else "", worst)


def _place(error: BaseException) -> str:
    return traceback.extract_tb(error.__traceback__)[-1].name


def counted(verdicts: Iterable[Verdict]) -> Counter[tuple[str, str]]:
    """Number of problems by kind and outcome."""
    return Counter((each.kind, each.outcome) for each in verdicts)
