"""Solve the judge's problems, and say what came of each."""

from __future__ import annotations

import re
from dataclasses import dataclass

from judge.problems import Case

import asperity as asp


@dataclass(frozen=True, eq=False)
class Solved:
    """Results of the steps that were solved, or why there are none: ``cause`` of a refusal or of no
    convergence."""

    results: tuple[asp.ContactResult, ...] = ()
    rolling: asp.rolling.RollingContact | None = None
    refused: str = ""
    not_converged: str = ""

    @property
    def converged(self) -> bool:
        """Whether all of it is called converged."""
        return not (self.refused or self.not_converged)


def solved(case: Case) -> Solved:
    """What comes of ``case``."""
    engine = asp.engines.CpuEngine(threads=1)
    try:
        if case.rolled is not None:
            rolled = case.rolled
            found = asp.roll(
                case.problem,
                case.steps[0].normal,
                rolled.creepage,
                direction=rolled.direction,
                method=rolled.method,
            )
            return Solved((found.normal,), found)
        history = asp.History(case.steps)
        results = asp.solve(case.problem, history, on_failure="return", time_steps=case.time_steps, engine=engine).steps
    except asp.ConvergenceError as error:
        return Solved(not_converged=_first(str(error)))
    except asp.InputError as error:
        return Solved(refused=f"{type(error).__name__}: {error.subject}")
    for number, result in enumerate(results):
        if not result.converged:
            return Solved(results[:number], not_converged=_cause(result))
    return Solved(results)


def _first(text: str) -> str:
    """Beginning of a message without its numbers."""
    words = re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?( %)?", "", text.split(":")[0])
    return " ".join(words.split(". ")[0].rstrip(".").split())


def _cause(result: asp.ContactResult) -> str:
    unsettled = [check.name for check in result.certificate.couplings if check.residual > check.tolerance]
    return f"{result.status.outcome}: {', '.join(unsettled) or _first(result.status.message)}"
