"""Judge random problems: solve each, hold what is called converged against the equations of its
physics, and count."""

from __future__ import annotations

import traceback
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context

from judge.checks import LARGEST_RATIO, Check
from judge.equations import equations
from judge.problems import KINDS, problem
from judge.solved import solved

LARGEST_SHARE = 0.02
"""Share of problems that are refused or not converged at most."""


@dataclass(frozen=True)
class Verdict:
    """What came of the problem of a ``seed``: ``right``, ``false``, ``refused``, ``not converged``
    or ``failed``, by its ``cause``; and the ``worst`` equation."""

    seed: int
    kind: str
    outcome: str
    cause: str = ""
    worst: Check = Check("none", 0.0, 1.0)

    @property
    def wrong(self) -> bool:
        """Whether it was wrongly called converged, or the program ended by an error that it does
        not know."""
        return self.outcome in ("false", "failed")


def judged(seed: int) -> Verdict:
    """Verdict on the problem of the ``seed``."""
    case = problem(seed)
    try:
        found = solved(case)
    except Exception as error:  # one that is none of the program's own
        place = traceback.extract_tb(error.__traceback__)[-1].name
        return Verdict(seed, case.kind, "failed", f"{type(error).__name__} in {place}")
    if found.refused:
        return Verdict(seed, case.kind, "refused", found.refused)
    if found.not_converged:
        return Verdict(seed, case.kind, "not converged", found.not_converged)
    worst = max(equations(case, found), key=lambda check: check.ratio)
    if worst.ratio <= LARGEST_RATIO:
        return Verdict(seed, case.kind, "right", worst=worst)
    return Verdict(seed, case.kind, "false", f"{worst.name}: {worst.error:.1e}, stated {worst.stated:.1e}", worst)


def all_judged(seeds: Sequence[int], processes: int = 1) -> Iterator[Verdict]:
    """Verdicts on all ``seeds``, in order; those that are asked for."""
    if processes == 1:
        yield from map(judged, seeds)
        return
    pool = ProcessPoolExecutor(processes, mp_context=get_context("spawn"))
    try:
        yield from pool.map(judged, seeds, chunksize=20)
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def failures(verdicts: Sequence[Verdict]) -> list[str]:
    """Those wrongly called converged with their seeds, and what else a collection must not be."""
    found = [f"seed {each.seed} ({each.kind}): {each.cause}" for each in verdicts if each.wrong]
    ended = [f"seed {each.seed}: {each.cause}" for each in verdicts if each.outcome in ("refused", "not converged")]
    if len(ended) > LARGEST_SHARE * len(verdicts):
        found.append(f"{len(ended)} of {len(verdicts)} refused or not converged: {ended}")
    kinds = Counter(each.kind for each in verdicts)
    found += [f"too few problems: {kind}" for kind in sorted(set(KINDS)) if kinds[kind] < 0.05 * len(verdicts)]
    return found


COLUMNS = ("problems", "right", "refused", "not converged", "false", "failed")


def table(verdicts: Sequence[Verdict]) -> str:
    """Two tables in Markdown: problems of each kind by what came of them, with the largest error
    over what is stated; and the causes."""
    counts = Counter((each.kind, each.outcome) for each in verdicts)
    lines = [
        f"| physics | {' | '.join(COLUMNS)} | largest error / stated | equation |",
        "|---|" + "---|" * (len(COLUMNS) + 2),
    ]
    for kind in dict.fromkeys(KINDS):
        of_kind = [each for each in verdicts if each.kind == kind]
        right = [each for each in of_kind if each.outcome in ("right", "false")]
        worst = max(right, key=lambda each: each.worst.ratio, default=None)
        numbers = [len(of_kind), *(counts[kind, outcome] for outcome in COLUMNS[1:])]
        ratio = "" if worst is None else f"{worst.worst.ratio:.2g} | {worst.worst.name}"
        lines.append(f"| {kind} | {' | '.join(map(str, numbers))} | {ratio} |")
    totals = [len(verdicts), *(sum(each.outcome == outcome for each in verdicts) for outcome in COLUMNS[1:])]
    lines += [
        f"| all | {' | '.join(map(str, totals))} | | |",
        "",
        "| physics | outcome | cause | problems |",
        "|---|---|---|---|",
    ]
    causes = Counter(
        (each.kind, each.outcome, each.worst.name if each.outcome == "false" else each.cause)
        for each in verdicts
        if each.outcome != "right"
    )
    lines += [f"| {kind} | {outcome} | {cause} | {count} |" for (kind, outcome, cause), count in sorted(causes.items())]
    return "\n".join(lines) + "\n"
