"""Designs computed: each is the cases of its study, solved once and kept in the store of the
campaign."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from copy import copy
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...core.arrays import RealArray
from ...io.description import software
from ..derived import Scalars, derived_slopes, derived_values
from ..executors import Executor, Lost, Task, call
from ..places import plain
from ..plan import StudyCase
from ..run import FUNCTION, lost
from ..slopes import differentiable, slope_name
from ..store import Record, Store
from .problem import Criterion, DesignProblem, Site

LEAST, MOST = 1e-6, 50.0
"""Ratio below which its logarithm is continued as a straight line, and the largest scaled value."""


class Here:
    """Executor that does everything in this process."""

    def run(self, function: str, tasks: Iterator[Task]) -> Iterator[tuple[Task, Any]]:
        """Every task with its answer."""
        for task in tasks:
            yield task, call(function, task)


@dataclass(frozen=True, eq=False)
class Computed:
    """A design with its cases.

    Attributes
    ----------
    site
        The design.
    values
        Each quantity, (samples, cases), NaN where a case failed.
    slopes
        Derivative of each quantity to each number, (samples, cases), by quantity and number; only
        those that there are.
    error
        Why a case failed; empty if none did.
    """

    site: Site
    values: dict[str, RealArray]
    slopes: dict[tuple[str, int], RealArray]
    error: str = ""


@dataclass(eq=False)
class Evaluation:
    """Computes designs, each once.

    Attributes
    ----------
    problem
        What is asked.
    executor
        Where cases are solved.
    store
        Where they are kept; None for nowhere.
    known
        Records by their keys.
    report
        Is given the numbers of cases that were solved and that were there already, after each
        batch.
    """

    problem: DesignProblem
    executor: Executor
    store: Store | None = None
    known: dict[str, Record] = field(default_factory=dict)
    report: Callable[[int, int], None] = lambda solved, found: None
    solved: int = 0
    reused: int = 0
    seen: dict[Site, Computed] = field(default_factory=dict)
    ask: Callable[[Sequence[Site]], None] | None = field(default=None, init=False)

    def __post_init__(self) -> None:
        asked = self.problem.plan.quantities
        # what an axis sets by an expression may change with a number, beside what the number sets
        self._ruled = any(axis.rule is not None for axis in self.problem.plan.axes)
        self._sloped = differentiable(self._needed) if asked and not self._ruled else ()
        self._slopes = self.problem.paths if self._sloped else ()
        self._indices = [[case.index for case in path] for path in self.problem.plan.paths()]

    @property
    def _needed(self) -> tuple[str, ...]:
        """Quantities of objectives and constraints, and those that are asked for beside."""
        return self.problem.plan.document.quantities

    def __call__(self, sites: Sequence[Site]) -> list[Computed]:
        """The designs at ``sites``, computed together where they are not known."""
        new = [site for site in dict.fromkeys(sites) if site not in self.seen]
        if new:
            (self.ask or self._compute)(new)
        return [self.seen[site] for site in sites]

    @property
    def several(self) -> bool:
        """Whether more than one design can be computed at a time."""
        return not isinstance(self.executor, Here)

    def asking(self, ask: Callable[[Sequence[Site]], None]) -> Evaluation:
        """The same, but what is not known is computed by ``ask``."""
        made = copy(self)
        made.ask = ask
        return made

    def _compute(self, new: Sequence[Site]) -> None:
        paths = {site: self._paths(site) for site in new}
        cases = [case for site in new for path in paths[site] for case in path]
        there = sum(case.key in self.known for case in cases)
        tasks = [one for site in new for path in paths[site] if (one := self._task(path)) is not None]
        for task, answer in self.executor.run(FUNCTION, iter(tasks)):
            found: list[Record] = lost(task, answer) if isinstance(answer, Lost) else answer
            if self.store is not None:
                self.store.append(found)
            self.known |= {record["key"]: record for record in found}
            self.solved += len(found)
        self.reused += there
        self.report(self.solved, self.reused)
        self.seen |= {site: self._gathered(site, paths[site]) for site in new}

    def _paths(self, site: Site) -> list[list[StudyCase]]:
        """Cases of the design, those that differ in the load alone together."""
        plan, changes, mark = self.problem.plan, self.problem.edits(site), ":".join((*self._slopes, *self._sloped))
        scalars, found = plan.scalars.after(changes), list[list[StudyCase]]()
        for path in self._indices:
            edits = [(*changes, *plan.edits(index, scalars)) for index in path]
            found.append([StudyCase(index, own, plan.key(own, mark)) for index, own in zip(path, edits, strict=True)])
        return found

    def _task(self, path: Sequence[StudyCase]) -> Task | None:
        missing = [case for case in path if case.key not in self.known]
        if not missing:
            return None
        plan = self.problem.plan
        return {
            "table": plan.table,
            "folder": str(plan.base.folder.absolute()),
            "quantities": list(plan.quantities),
            "version": software()["asperity"],
            "slopes": list(self._slopes),
            "sloped": list(self._sloped),
            "cases": [
                {"key": case.key, "index": list(case.index), "edits": [plain(edit) for edit in case.edits]}
                for case in missing
            ],
        }

    def _gathered(self, site: Site, paths: Sequence[Sequence[StudyCase]]) -> Computed:
        plan, numbers = self.problem.plan, self.problem.numbers
        shape = (self.problem.samples, plan.n_cases // self.problem.samples)
        names = self._needed
        values = {name: np.full(shape, np.nan) for name in names}
        slopes = {(name, n): np.full(shape, np.nan) for name in names for n in range(len(numbers))}
        error = ""
        for case in (case for path in paths for case in path):
            record = self.known[case.key]
            at = np.unravel_index(int(np.ravel_multi_index(case.index, plan.shape)) if plan.shape else 0, shape)
            if record["error"] is not None:
                error = error or f"{record['error']['type']}: {record['error']['message']}"
            for name in names:
                values[name][at] = record["values"].get(name, math.nan)
                for n, each in enumerate(numbers):
                    terms = [(each.place.path, 1.0), *((place.path, factor) for place, factor in each.also)]
                    slopes[name, n][at] = sum(
                        factor * record["values"].get(slope_name(name, path), math.nan) for path, factor in terms
                    )
        known = {key: array for key, array in slopes.items() if np.all(np.isfinite(array))}
        if plan.derived:
            self._derive(site, values, known)
        return Computed(site, values, known, error)

    def _derive(self, site: Site, values: dict[str, RealArray], slopes: dict[tuple[str, int], RealArray]) -> None:
        """Add what is derived to the ``values`` and ``slopes`` of a design, (samples, cases)."""
        plan = self.problem.plan
        scalars: Scalars = plan.scalars.after(self.problem.edits(site))
        shape = (self.problem.samples, plan.n_cases // self.problem.samples)
        made = derived_values(plan.derived, scalars, {name: each.reshape(plan.shape) for name, each in values.items()})
        values |= {name: each.reshape(shape) for name, each in made.items()}
        if self._ruled:
            return
        names = {name for item in plan.derived for name in item.expression.names} & scalars.units.keys()
        known = values | {name: scalars.named(name).reshape(shape) for name in names}
        for n, each in enumerate(self.problem.numbers):
            factors = {each.place.keys: 1.0} | {place.keys: factor for place, factor in each.also}
            places = {name: scalars.letters[name].keys if name in scalars.letters else () for name in names}
            along = {name: np.full(shape, factors.get(places[name], 0.0)) for name in names}
            along |= {name: slope for (name, number), slope in slopes.items() if number == n and name not in names}
            found = derived_slopes(plan.derived, known, along)
            slopes |= {(name, n): np.broadcast_to(slope, shape) for name, slope in found.items()}

    def citation_keys(self, site: Site) -> tuple[str, ...]:
        """Keys of the sources behind the cases of a design that is computed."""
        records = (self.known[case.key] for path in self._paths(site) for case in path)
        return tuple(dict.fromkeys(key for record in records for key in record["citations"]))

    def recorded(self, site: Site, name: str) -> RealArray:
        """Any quantity ``name`` that costs nothing, in all cases of the design at ``site``, (n,);
        NaN where it is not known."""
        self([site])
        records = [self.known[case.key] for path in self._paths(site) for case in path]
        return np.array([record["values"].get(name, math.nan) for record in records])

    def value(self, criterion: Criterion, found: Computed) -> RealArray:
        """Value of ``criterion`` in each of its cases, (n,), or their mean: of samples the mean,
        less or more some standard deviations."""
        if criterion.variable is not None:
            return np.array([found.site.values[criterion.variable]])
        return self._over(criterion, self._robust(criterion, found.values[criterion.name]))

    def slope(self, criterion: Criterion, found: Computed, number: int) -> RealArray | None:
        """Derivative of ``value`` to the number with that ``number``, (n,); None where it is not
        known."""
        if criterion.variable is not None:
            return np.array([float(criterion.variable == number)])
        known = found.slopes.get((criterion.name, number))
        if known is None:
            return None
        values = found.values[criterion.name]
        mean = known.mean(axis=0)
        k = self.problem.table.robust
        if k and len(values) > 1:
            deviation = values.std(axis=0, ddof=1)
            along = ((values - values.mean(axis=0)) * known).sum(axis=0) / (len(values) - 1)
            change = np.divide(along, deviation, out=np.zeros_like(along), where=deviation > 0.0)
            mean = mean - k * change if criterion.larger else mean + k * change
        return self._over(criterion, mean)

    def _robust(self, criterion: Criterion, values: RealArray) -> RealArray:
        mean = values.mean(axis=0)
        if len(values) < 2 or not self.problem.table.robust:
            return np.asarray(mean)
        spread = self.problem.table.robust * values.std(axis=0, ddof=1)
        return np.asarray(mean - spread if criterion.larger else mean + spread)

    def _over(self, criterion: Criterion, values: RealArray) -> RealArray:
        chosen = values[list(criterion.cases)]
        return np.array([chosen.mean()]) if criterion.over == "mean" else chosen

    def worst(self, criterion: Criterion, found: Computed) -> float:
        """The least good of the values of ``criterion``; NaN if one is."""
        values = self.value(criterion, found)
        return float(values.min() if criterion.larger else values.max())

    def margin(self, criterion: Criterion, found: Computed) -> float:
        """How far the worst value is within the limit, as a share of it; negative where it is not;
        NaN where it is not known."""
        value, limit = self.worst(criterion, found), criterion.limit
        gap = value - limit if criterion.larger else limit - value
        return gap / abs(limit) if limit else gap


@dataclass(frozen=True)
class Scaled:
    """A number scaled for a search: the logarithm of its ratio to ``scale`` where it is
    ``positive``, continued below, else the ratio."""

    scale: float
    positive: bool

    @classmethod
    def of(cls, value: float) -> Scaled:
        """Scale of a number that is ``value`` at the start, or has this limit."""
        good = math.isfinite(value) and value != 0.0
        return cls(abs(value) if good else 1.0, good and value > 0.0)

    def __call__(self, value: RealArray) -> tuple[RealArray, RealArray]:
        """Scaled values, and their derivative."""
        ratio = np.asarray(value, dtype=float) / self.scale
        if not self.positive:
            return np.clip(ratio, -MOST, MOST), np.full(ratio.shape, 1.0 / self.scale)
        inside = np.maximum(ratio, LEAST)
        found = np.log(inside) + np.minimum(ratio - LEAST, 0.0) / LEAST
        return np.clip(found, -MOST, MOST), 1.0 / (inside * self.scale)
