"""All searches of a design problem: from all starts for all choices, or an evolution and what
gradients make of its best."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import TypeAlias

import numpy as np

from ...core.arrays import RealArray
from .evaluation import Evaluation
from .evolution import evolved
from .problem import Site
from .search import Aim, Search, Start
from .together import at_once

Job: TypeAlias = Callable[[Search], Start]
"""One search, which is given what it computes designs by."""

MOST_AT_ONCE = 32
"""Searches that go on at once where there are several workers."""


def searched(search: Search, aim: Aim) -> list[Start]:
    """Where the searches have ended, the best first."""
    problem, table = search.problem, search.problem.table
    if problem.evolves:
        found = _evolution(search, aim)
    elif not problem.numbers:
        sites = [Site(choice, ()) for choice in problem.combinations()]
        search.evaluation(sites)
        found = [search.ended(aim, site, converged=True, message="computed") for site in sites]
    else:
        shares, choices = starts(search), list(problem.combinations())
        single = len(problem.numbers) == 1 and aim.objective.variable == 0 and aim.constraints
        jobs: list[Job] = []
        if single and table.method == "auto":
            at = [float(share) for share in shares[:, 0]]
            jobs = [partial(Search.root, aim=aim, choice=choice, shares=at) for choice in choices]
        else:
            method = "slsqp" if table.method == "auto" else table.method
            jobs = [
                partial(Search.local, aim=aim, choice=choice, first=first, method=method)
                for choice in choices
                for first in shares
            ]
            search.evaluation([problem.place(choice, first) for choice in choices for first in shares])
        search.rows(aim, search.met(problem.place(choices[0], shares[0])))  # which sets the scales
        found = each_of(search, aim, jobs)
    found = sorted(found, key=search.rank)
    if problem.numbers and found[0].violation > search.tolerance:
        first = problem.shares(found[0].site)
        found.insert(0, search.local(aim, found[0].site.choice, first, "slsqp", nearest=True))
        found = sorted(found, key=search.rank)
    return found


def _evolution(search: Search, aim: Aim) -> list[Start]:
    """What an evolution ends with, and the best of it improved by gradients: of as many
    combinations of choices as there are ``starts``."""
    best, problem = evolved(search, aim), search.problem
    if not problem.numbers:
        return best[: problem.table.starts]
    jobs: list[Job] = [
        partial(Search.local, aim=aim, choice=each.site.choice, first=problem.shares(each.site), method="slsqp")
        for each in best[: problem.table.starts]
    ]
    return each_of(search, aim, jobs)


def each_of(search: Search, aim: Aim, jobs: Sequence[Job]) -> list[Start]:
    """What all ``jobs`` find, in their order; at once where there are several workers."""
    parts = [replace(search, visited=[], scales=dict(search.scales)) for _ in jobs]

    def run(job: Job, part: Search, evaluation: Evaluation) -> Start:
        part.evaluation = evaluation
        return job(part)

    ready = [partial(run, job, part) for job, part in zip(jobs, parts, strict=True)]
    if search.evaluation.several:
        found = [
            start
            for number in range(0, len(ready), MOST_AT_ONCE)
            for start in at_once(search.evaluation, ready[number : number + MOST_AT_ONCE])
        ]
    else:
        found = [one(search.evaluation) for one in ready]
    for part in parts:
        search.visited += part.visited
    # on one scale, even where the first designs of all have failed
    computed = search.evaluation([start.site for start in found])
    return [
        replace(start, objective=float(search.rows(aim, one).objective.max()))
        for start, one in zip(found, computed, strict=True)
    ]


def starts(search: Search) -> RealArray:
    """Shares of the ranges to start from, (starts, numbers): those of the problem, and a Latin
    hypercube (McKay, Beckman & Conover 1979)."""
    from scipy.stats import qmc

    numbers, table = search.problem.numbers, search.problem.table
    first = np.array([[each.share(each.start) for each in numbers]])
    if table.starts == 1:
        return first
    drawn = qmc.LatinHypercube(len(numbers), seed=np.random.default_rng(table.seed)).random(table.starts - 1)
    return np.concatenate([first, drawn])
