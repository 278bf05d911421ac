"""Search over choices and numbers together: differential evolution with whole numbers."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...core.arrays import RealArray
from ...core.scipy_parts import optimize
from .problem import Site
from .search import Aim, Rows, Search, Start

EVEN = 10.0
"""Deviation of the objectives of a population, over the tolerance, at which an evolution ends: the
best of it are improved by gradients after it."""


def evolved(search: Search, aim: Aim) -> list[Start]:
    """The best design of each combination of choices that an evolution has met, the best first.

    Differential evolution (Storn & Price 1997) with the rules of Lampinen (2002) for limits;
    choices are whole numbers, in the order in which they are given. It begins with the problem's
    own values and a Latin hypercube, both of the ``seed``, and ends after the stated number of
    generations or when the population is as good as even. Whole generations are computed together.

    Parameters
    ----------
    search
        Searches of the problem.
    aim
        What is to be best, and what must hold.
    """
    problem, table = search.problem, search.problem.table
    n, met = len(problem.numbers), dict[Site, Rows]()

    def rows(x: RealArray) -> list[Rows]:
        columns = np.atleast_2d(x.T)
        sites = [problem.place(tuple(round(float(k)) for k in each[n:]), each[:n]) for each in columns]
        search.visited += [site for site in dict.fromkeys(sites) if site not in met]
        found = [search.rows(aim, each) for each in search.evaluation(sites)]
        met.update(zip(sites, found, strict=True))
        return found

    def value(x: RealArray) -> RealArray:
        return np.array([each.objective.max() for each in rows(x)])

    def limits(x: RealArray) -> RealArray:
        found = np.stack([each.limits for each in rows(x)], axis=-1)
        return found if x.ndim > 1 else found[:, 0]

    first = _population(search)
    whole = [False] * n + [True] * len(problem.choices)
    bounded: Any = ()
    if rows(first[:1].T)[0].limits.size:
        bounded = optimize.NonlinearConstraint(limits, 0.0, np.inf)
    evolve: Any = optimize.differential_evolution
    outcome = evolve(
        value,
        [(0.0, 1.0)] * n + [(0, len(each.points) - 1) for each in problem.choices],
        maxiter=table.generations,
        tol=0.0,
        atol=EVEN * search.tolerance,
        init=first,
        seed=np.random.default_rng(table.seed),
        polish=False,
        updating="deferred",
        vectorized=True,
        constraints=bounded,
        integrality=whole,
    )
    text = f"evolution: {outcome.nit} generations of {len(first)} designs"
    best: dict[tuple[int, ...], Start] = {}
    for site, each in met.items():
        start = Start(site, float(each.objective.max()), each.violation, bool(outcome.success), text)
        if site.choice not in best or search.rank(start) < search.rank(best[site.choice]):
            best[site.choice] = start
    return sorted(best.values(), key=search.rank)


def _population(search: Search) -> RealArray:
    """Shares of numbers and places of choices of the first generation, (designs, variables)."""
    from scipy.stats import qmc

    problem = search.problem
    counts, n = np.array([len(each.points) for each in problem.choices]), len(problem.numbers)
    drawer = qmc.LatinHypercube(n + counts.size, seed=np.random.default_rng(problem.table.seed))
    drawn = np.asarray(drawer.random(problem.population))
    drawn[:, n:] = np.floor(drawn[:, n:] * counts)
    drawn[0] = [*(each.share(each.start) for each in problem.numbers), *np.zeros(counts.size)]
    return drawn
