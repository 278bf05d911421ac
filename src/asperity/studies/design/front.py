"""The front of two objectives: the best of the first at limits of the second."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from .problem import Criterion, Site
from .search import Aim, Search, Start
from .searches import Job, each_of, searched


def front(search: Search, best: Start) -> tuple[Site, ...]:
    """Designs of which none is better in one objective without being worse in the other, sorted by
    the second.

    The ends are the best of each objective; between them the best of the first is sought at equally
    spaced limits of the second (epsilon constraint, Haimes et al. 1971), each from a place between
    the ends. Of choices alone all are compared.

    Parameters
    ----------
    search
        Searches of the problem, whose second objective is given.
    best
        The best design of the first objective.
    """
    problem = search.problem
    assert problem.second is not None
    aim, second = Aim(problem.objective, problem.constraints), problem.second
    if not problem.numbers and not problem.evolves:
        return _undominated(search, [Site(choice, ()) for choice in problem.combinations()])
    other = searched(search, Aim(second, problem.constraints))[0]
    ends = [search.evaluation.worst(second, search.met(site)) for site in (best.site, other.site)]
    limits = _between(ends[0], ends[1], problem.table.pareto.points if problem.table.pareto else 3)
    aims = [Aim(aim.objective, (*aim.constraints, replace(second, limit=limit))) for limit in limits]
    if problem.evolves:
        found = [start for bounded in aims for start in searched(search, bounded)]
    else:
        shares = np.linspace(problem.shares(best.site), problem.shares(other.site), len(aims) + 2)[1:-1]
        jobs: list[Job] = [
            partial(Search.local, aim=bounded, choice=choice, first=first, method="slsqp")
            for bounded, first in zip(aims, shares, strict=True)
            for choice in problem.combinations()
        ]
        found = each_of(search, aim, jobs)
    return _undominated(search, [best.site, *(start.site for start in found), other.site])


def _between(first: float, last: float, count: int) -> list[float]:
    """Limits between two ends, on a logarithmic scale where both are positive."""
    if not (math.isfinite(first) and math.isfinite(last)):
        return []
    spaced = np.geomspace(first, last, count) if min(first, last) > 0.0 else np.linspace(first, last, count)
    return [float(limit) for limit in spaced[1:-1]]


def _undominated(search: Search, sites: Sequence[Site]) -> tuple[Site, ...]:
    problem, tolerance = search.problem, search.tolerance
    assert problem.second is not None
    kept: list[tuple[Site, float, float]] = []
    for site in dict.fromkeys(sites):
        found = search.evaluation([site])[0]
        rows = search.rows(Aim(problem.objective, problem.constraints), found)
        pair = [_smaller(search, each, site) for each in (problem.objective, problem.second)]
        if rows.violation <= tolerance and all(map(math.isfinite, pair)):
            kept.append((site, pair[0], pair[1]))

    def beaten(one: tuple[Site, float, float]) -> bool:
        room = [tolerance * abs(value) for value in one[1:]]
        return any(
            other[1] <= one[1] + room[0]
            and other[2] <= one[2] + room[1]
            and (other[1] < one[1] - room[0] or other[2] < one[2] - room[1])
            for other in kept
        )

    return tuple(site for site, _, _ in sorted((one for one in kept if not beaten(one)), key=lambda one: one[2]))


def _smaller(search: Search, criterion: Criterion, site: Site) -> float:
    value = search.evaluation.worst(criterion, search.evaluation([site])[0])
    return -value if criterion.larger else value
