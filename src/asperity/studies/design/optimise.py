"""The best design of a study document with a table [design]."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ...core.errors import ConvergenceError
from ...core.units import percent
from ..campaign import RECORDS, make, require_own, write_study
from ..cluster import DaskCluster
from ..documents import LoadedStudy, load_study, study_from_table
from ..executors import Executor
from ..local import LocalProcesses
from ..store import Record, Store, records
from .answer import Change, Design, DesignVariable, FrontPoint, Margin, Objective, Trial, Value
from .evaluation import Evaluation, Here
from .front import front
from .problem import Criterion, DesignProblem, Site, make_design, rounded
from .search import ACTIVE, Aim, Search, Start
from .searches import searched

CHANGE = 0.1
"""Relative change of each number whose effect is told."""

Progress = Callable[[int, int], None]
"""Is given the numbers of contacts that were solved, and that were kept from before."""


def optimise(
    study: str | Path | Mapping[str, Any],
    folder: str | Path | None = None,
    *,
    workers: int = 1,
    dask: str | None = None,
    retry: bool = False,
    progress: Progress | None = None,
) -> Design:
    """Find the best design that a study document with a table ``[design]`` asks for.

    Numbers are sought by gradients (sequential quadratic programmes, Kraft 1988; or a trust region)
    from several starts, in logarithms and with scaled objective and constraints; choices are all
    tried, or evolve together with the numbers (differential evolution, Storn & Price 1997). The
    derivatives are those of the contact on its set where it has them, else central differences with
    a step above the jumps of the area from pixel to pixel. One number with a limit is a root. All
    designs are computed with the same samples. See the how-to page on designs for the document.

    Parameters
    ----------
    study
        Study document (TOML or JSON file), or its content as nested dictionaries, whose relative
        paths begin here.
    folder
        Where every contact that is solved is kept: a search that is run again there repeats none.
        By default beside the document, named after it; of dictionaries nowhere.
    workers
        Number of worker processes; 1 computes in this process. With several, cases, starts,
        choices, points of a front and designs of a generation are computed at once; what is found
        is the same.
    dask
        Address of a Dask scheduler whose workers are used instead.
    retry
        Whether contacts that failed in an earlier run are solved again.
    progress
        Is called after every batch of contacts.

    Raises
    ------
    InputError
        If a variable leads nowhere, its bounds cannot be used, a quantity is unknown or lacks data
        such as a yield stress, or a limit has another unit; before anything is solved.
    OutputError
        If the folder holds something else, or cannot be written.
    ConvergenceError
        If no design could be computed.
    """
    loaded, target = loaded_study(study, folder)
    problem = make_design(loaded)
    with evaluating(
        problem, (loaded, target), workers=workers, dask=dask, retry=retry, progress=progress
    ) as evaluation:
        return _design(Search(problem, evaluation))


@contextmanager
def evaluating(
    problem: DesignProblem,
    place: tuple[LoadedStudy, Path | None],
    *,
    workers: int,
    retry: bool,
    progress: Progress | None,
    dask: str | None = None,
) -> Iterator[Evaluation]:
    """What computes designs of ``problem``, with its workers and, where the study has a
    folder (``place``), the store there; errors as of ``optimise``."""
    loaded, target = place
    with ExitStack() as stack:
        executor: Executor = Here()
        if dask is not None:
            executor = stack.enter_context(DaskCluster(dask).kept())
        elif workers != 1:
            executor = stack.enter_context(LocalProcesses(workers).kept())
        store, known = None, dict[str, Record]()
        if target is not None:
            store, known = stack.enter_context(_kept(target, loaded, retry=retry))
        yield Evaluation(problem, executor, store, known, progress or (lambda solved, found: None))


def loaded_study(study: str | Path | Mapping[str, Any], folder: str | Path | None) -> tuple[LoadedStudy, Path | None]:
    """A study, and the folder of its results; None for nowhere."""
    if isinstance(study, Mapping):
        return study_from_table(study, Path()), None if folder is None else Path(folder)
    return load_study(study), folder_of(study, folder)


def folder_of(study: str | Path, folder: str | Path | None = None) -> Path:
    """Folder of the results of the document ``study``: ``folder``, or one beside it."""
    place = Path(study)
    return place.with_name(f"{place.stem}-results") if folder is None else Path(folder)


@contextmanager
def _kept(folder: Path, study: LoadedStudy, *, retry: bool) -> Iterator[tuple[Store, dict[str, Record]]]:
    """Store in the ``folder`` of a ``study``, made if it is missing, and the records it holds;
    errors as of ``optimise``."""
    require_own(folder)
    make(folder)
    write_study(study, folder)
    with Store(folder / RECORDS) as store:
        found = {record["key"]: record for record in records(folder / RECORDS)}
        yield store, {key: record for key, record in found.items() if record["error"] is None or not retry}


def _design(search: Search) -> Design:
    """The answer of all searches of a problem."""
    problem, evaluation = search.problem, search.evaluation
    aim = Aim(problem.objective, problem.constraints)
    trials = searched(search, aim)
    visited = tuple(search.visited)
    best, computed = trials[0], [found for found in evaluation.seen.values() if not found.error]
    if not computed:
        first = next(iter(evaluation.seen.values()))
        raise ConvergenceError(f"No design could be computed; the first failed: {first.error}")
    feasible = best.violation <= search.tolerance
    points = front(search, best) if problem.second is not None and feasible else ()
    site = best.site
    margins = _margins(search, aim, site, feasible=feasible)
    changes = tuple(_changes(search, site))
    failed = [found.error for found in evaluation.seen.values() if found.error]
    return Design(
        title=problem.plan.document.title,
        variables=tuple(_variable(problem, site, number) for number in range(len(problem.variables))),
        objective=_objective(search, problem.objective, site),
        constraints=margins,
        limits=tuple(f"{each.name} {each.goal}" for each in problem.constraints),
        changes=changes,
        trials=tuple(_trial(search, start) for start in trials),
        history=tuple(_history(search, aim, visited)),
        feasible=feasible,
        converged=best.converged,
        second=None if problem.second is None else _objective(search, problem.second, site),
        front=tuple(_point(search, one) for one in points),
        unmet=() if feasible else tuple(_unmet(search, margins)),
        solves=evaluation.solved,
        reused=evaluation.reused,
        failed=len(failed),
        failure=failed[0] if failed else "",
        tolerance=search.tolerance,
        citation_keys=evaluation.citation_keys(site),
    )


def _values(problem: DesignProblem, site: Site) -> tuple[Value, ...]:
    chosen = (each.points[n].coordinate for each, n in zip(problem.choices, site.choice, strict=True))
    return (*site.values, *chosen)


def _variable(problem: DesignProblem, site: Site, number: int) -> DesignVariable:
    each, value = problem.variables[number], _values(problem, site)[number]
    bound = "low" if value == each.low else "high" if value == each.high else ""
    return DesignVariable(each.name, each.place.path, each.place.unit, value, each.low, each.high, bound)


def _objective(search: Search, criterion: Criterion, site: Site) -> Objective:
    value = search.evaluation.worst(criterion, search.evaluation([site])[0])
    return Objective(criterion.name, criterion.label, criterion.unit, criterion.goal, value)


def _trial(search: Search, start: Start) -> Trial:
    value = search.evaluation.worst(search.problem.objective, search.evaluation([start.site])[0])
    feasible = start.violation <= search.tolerance
    return Trial(_values(search.problem, start.site), value, feasible, start.converged, start.message)


def _history(search: Search, aim: Aim, visited: Sequence[Site]) -> Iterator[tuple[float, float]]:
    for site in visited:
        found = search.evaluation([site])[0]
        yield search.evaluation.worst(aim.objective, found), search.rows(aim, found).violation


def _point(search: Search, site: Site) -> FrontPoint:
    assert search.problem.second is not None
    found = search.evaluation([site])[0]
    first, second = (search.evaluation.worst(each, found) for each in (search.problem.objective, search.problem.second))
    return FrontPoint(_values(search.problem, site), first, second)


def _margins(search: Search, aim: Aim, site: Site, *, feasible: bool) -> tuple[Margin, ...]:
    """Every constraint at ``site``; one ``over`` each of the cases is a row for each."""
    problem, found = search.problem, search.evaluation([site])[0]
    names, made = problem.case_names, []
    rows = [
        (number, replace(each, cases=(case,)) if each.over == "each" else each)
        for number, each in enumerate(aim.constraints)
        for case in (each.cases if each.over == "each" else each.cases[:1])
    ]
    for _, each in rows:
        values = search.evaluation.value(each, found)
        at = int(np.argmin(values) if each.larger else np.argmax(values))
        value, margin = float(values[at]), search.evaluation.margin(each, found)
        met = margin >= -search.tolerance
        case = "mean of the cases" if each.over == "mean" and len(each.cases) > 1 else names[each.cases[at]]
        made.append(
            Margin(
                each.name,
                each.label,
                each.unit,
                each.goal,
                each.limit,
                value,
                margin,
                met=met,
                active=met and margin <= ACTIVE,
                case=case,
            )
        )
    prices = _prices(search, aim, site, rows, made) if feasible and problem.numbers else {}
    return tuple(replace(each, price=prices.get(n, math.nan)) for n, each in enumerate(made))


def _prices(
    search: Search, aim: Aim, site: Site, rows: Sequence[tuple[int, Criterion]], made: Sequence[Margin]
) -> dict[int, float]:
    """Change of the objective by a relative change of each active limit, by the number of its row:
    the multipliers of the optimum, least squares over the numbers that are at no bound (Nocedal &
    Wright 2006, section 12.4)."""
    active = [n for n, each in enumerate(made) if each.active and each.limit > 0.0]
    inside = [n for n, each in enumerate(search.problem.numbers) if each.low < site.values[n] < each.high]
    if not active or not inside:
        return {}
    found = search.evaluation([site])[0]
    rates = []
    for _, each in (rows[n] for n in active):
        slopes = search.gradient(Aim(aim.objective, (each,)), site)[1]
        rates.append(slopes[int(np.argmin(search.rows(Aim(aim.objective, (each,)), found).limits))])
    objective = search.gradient(aim, site)[0]
    worst = objective[int(np.argmax(search.rows(aim, found).objective))]
    multipliers = np.linalg.lstsq(np.array(rates)[:, inside].T, worst[inside], rcond=1e-6)[0]
    # rows are logarithms: the better one falls with a limit that is relaxed, the larger one rises
    sign = -1.0 if aim.objective.larger else 1.0
    return {
        n: sign * float(max(each, 0.0)) * (1.0 if made[n].goal == "at least" else -1.0)
        for n, each in zip(active, multipliers, strict=True)
    }


def _changes(search: Search, site: Site) -> Iterator[Change]:
    """Each number a tenth less and more, and each other choice, the rest as recommended."""
    problem, others = search.problem, list[tuple[str, Value, Site]]()
    for n, each in enumerate(problem.numbers):
        for factor in (1.0 - CHANGE, 1.0 + CHANGE):
            value = rounded(site.values[n] * factor)
            values = (*site.values[:n], value, *site.values[n + 1 :])
            if each.low <= value <= each.high:
                others.append((each.name, value, Site(site.choice, values)))
    for n, each in enumerate(problem.choices):
        for at, point in enumerate(each.points):
            if at != site.choice[n]:
                choice = (*site.choice[:n], at, *site.choice[n + 1 :])
                others.append((each.name, point.coordinate, Site(choice, site.values)))
    for (name, new, _), found in zip(others, search.evaluation([one for *_, one in others]), strict=True):
        margins = tuple(search.evaluation.margin(each, found) for each in problem.constraints)
        yield Change(name, new, search.evaluation.worst(problem.objective, found), margins)


def _unmet(search: Search, margins: Sequence[Margin]) -> Iterator[str]:
    """Words on each constraint that the least violated design misses."""
    seen = [found for found in search.evaluation.seen.values() if not found.error]
    by_name = {(each.name, each.goal): each for each in search.problem.constraints}
    for each in (each for each in margins if not each.met):
        tried = [search.evaluation.margin(by_name[each.name, each.goal], found) for found in seen]
        best = max((margin for margin in tried if math.isfinite(margin)), default=math.nan)
        alone = "no design that was computed meets it" if not best >= 0.0 else "other designs meet it, but not the rest"
        yield f"{each.words} is missed by {percent(abs(each.margin))} ({alone})"
