"""Searches for the best design from one start: by gradients, and for the root of one bound."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from ...core.arrays import RealArray
from ...core.scipy_parts import optimize
from .evaluation import MOST, Computed, Evaluation, Scaled
from .problem import Criterion, DesignProblem, Site

WIDEST = 0.25
"""Largest step of differences as a share of the range."""

FAILED = 5.0
"""Scaled violation that stands for a design that could not be computed."""

ROUNDS = 40
"""Steps of a search for a root."""

ACTIVE = 0.01
"""Margin up to which a constraint counts as active."""


@dataclass(frozen=True)
class Aim:
    """An ``objective`` under ``constraints``."""

    objective: Criterion
    constraints: tuple[Criterion, ...]


class Rows(NamedTuple):
    """Scaled numbers of a design: ``objective`` (n,), the largest of which is to be small, and
    ``limits`` (m,), which must not be negative."""

    objective: RealArray
    limits: RealArray

    @property
    def violation(self) -> float:
        """How far the worst limit is missed; zero where all hold."""
        return max(0.0, -float(self.limits.min(initial=0.0)))


@dataclass(frozen=True)
class Start:
    """Where a search from one start has ended.

    ``converged`` by its own criterion, with its ``message``; ``objective`` is scaled, smaller is
    better, ``violation`` as in ``Rows``.
    """

    site: Site
    objective: float
    violation: float
    converged: bool
    message: str


@dataclass(eq=False)
class Search:
    """Searches of one design problem.

    Attributes
    ----------
    problem, evaluation
        What is asked, and what computes it.
    visited
        Designs in the order in which searches met them, without those of differences.
    """

    problem: DesignProblem
    evaluation: Evaluation
    visited: list[Site] = field(default_factory=list)
    scales: dict[str, Scaled] = field(default_factory=dict)

    @property
    def tolerance(self) -> float:
        """Relative change at which a search ends, and by which a limit may be missed."""
        return self.problem.table.tolerance

    def met(self, site: Site) -> Computed:
        """The design at ``site``, noted as visited."""
        if not self.visited or self.visited[-1] != site:
            self.visited.append(site)
        return self.evaluation([site])[0]

    def rows(self, aim: Aim, found: Computed) -> Rows:
        """Scaled numbers of a design; of one that failed those of a large violation."""
        objective = self._scaled(aim.objective, found)[0]
        limits = np.concatenate([np.zeros(0), *(self._scaled(each, found)[0] for each in aim.constraints)])
        objective = np.where(np.isfinite(objective), objective, FAILED)
        bad = not np.isfinite(limits).all() or found.error
        return Rows(objective, np.where(np.isfinite(limits), limits, -FAILED) if bad else limits)

    def _scaled(self, criterion: Criterion, found: Computed) -> tuple[RealArray, RealArray]:
        """Scaled rows of ``criterion`` with their derivative to its values."""
        value = self.evaluation.value(criterion, found)
        objective = math.isnan(criterion.limit)
        if objective and criterion.name not in self.scales:
            worst = self.evaluation.worst(criterion, found)
            if math.isfinite(worst):
                self.scales[criterion.name] = Scaled.of(worst)
        scale = (
            self.scales.get(criterion.name, Scaled(1.0, positive=False)) if objective else Scaled.of(criterion.limit)
        )
        rows, slope = scale(value)
        if objective:
            return (-rows, -slope) if criterion.larger else (rows, slope)
        limit = scale(np.array([criterion.limit]))[0]
        return (rows - limit, slope) if criterion.larger else (limit - rows, -slope)

    def gradient(self, aim: Aim, site: Site) -> tuple[RealArray, RealArray]:
        """Derivatives of both rows to the shares of the ranges, (rows, numbers): by the
        sensitivities of the contact where these are known, else by central differences."""
        found, numbers = self.evaluation([site])[0], self.problem.numbers
        criteria = (aim.objective, *aim.constraints)
        known = {
            (c, n): self.evaluation.slope(each, found, n)
            for c, each in enumerate(criteria)
            for n in range(len(numbers))
        }
        lacking = [n for n in range(len(numbers)) if any(known[c, n] is None for c in range(len(criteria)))]
        around = self.neighbours(site, lacking)
        self.evaluation([one for pair in around.values() for one in pair])
        columns = []
        for n, each in enumerate(numbers):
            parts = []
            for c, criterion in enumerate(criteria):
                slope = known[c, n]
                if slope is not None:
                    parts.append(slope * self._scaled(criterion, found)[1] * each.rate(site.values[n]))
                    continue
                (low, high) = around[n]
                rows = [self._scaled(criterion, one)[0] for one in self.evaluation([low, high])]
                width = each.share(high.values[n]) - each.share(low.values[n])
                parts.append((rows[1] - rows[0]) / width if width else np.zeros(rows[0].shape))
            columns.append(np.concatenate(parts))
        matrix = np.nan_to_num(np.stack(columns, axis=-1), posinf=0.0, neginf=0.0)
        count = self.evaluation.value(aim.objective, found).size
        return matrix[:count], matrix[count:]

    def neighbours(self, site: Site, numbers: Sequence[int]) -> dict[int, tuple[Site, Site]]:
        """Designs a step below and above in each of the ``numbers``, within the bounds."""
        found = {}
        for n in numbers:
            each = self.problem.numbers[n]
            step = min(self.problem.table.step / each.width if each.log else 0.5 * self.problem.table.step, WIDEST)
            middle = each.share(site.values[n])
            ends = []
            for share in (middle - step, middle + step):
                values = list(site.values)
                values[n] = each.value(share)
                ends.append(Site(site.choice, tuple(values)))
            found[n] = (ends[0], ends[1])
        return found

    # One start of a search by gradients.

    def local(
        self, aim: Aim, choice: tuple[int, ...], first: RealArray, method: str, *, nearest: bool = False
    ) -> Start:
        """Search from the shares ``first`` by sequential quadratic programmes (``slsqp``) or a
        trust region; ``nearest`` for the least violation of the limits instead of the best
        objective."""
        local = _Local(self, aim, choice, nearest)
        outcome, best = local.run(first, method), local.best()
        for _ in range(AGAIN):
            outcome, end = local.run(self.problem.shares(best.site), method), local.best()
            ranks = [(one.violation, one.objective) if nearest else self.rank(one) for one in (best, end)]
            gain = ranks[0][0] - ranks[1][0] or ranks[0][1] - ranks[1][1]
            best = end
            if gain <= self.tolerance:
                return replace(best, converged=True, message="no better design within the tolerance")
        return replace(best, converged=False, message=str(outcome.message))

    # One number, and a limit that decides about it.

    def root(self, aim: Aim, choice: tuple[int, ...], shares: Sequence[float]) -> Start:
        """The end of the range of the only number up to which the limits hold: a root, by Newton's
        method kept within a bracket where derivatives are known, else by Brent's."""
        back = aim.objective.larger

        def at(t: float) -> Site:
            return self.problem.place(choice, np.array([1.0 - t if back else t]))

        def margin(t: float) -> float:
            return float(self.rows(aim, self.met(at(t))).limits.min(initial=MOST))

        places = sorted({0.0, 1.0, *(1.0 - share if back else share for share in shares)})
        self.evaluation([at(t) for t in places])
        margins = [margin(t) for t in places]
        good = next((number for number, value in enumerate(margins) if value >= 0.0), None)
        if good is None:
            number = int(np.argmax(margins))
            return self.ended(aim, at(places[number]), converged=False, message="no start meets all limits")
        if good == 0:
            return self.ended(aim, at(places[0]), converged=True, message="the limits hold up to the bound")
        each = self.problem.numbers[0]
        accuracy = self.tolerance / (each.width if each.log else 1.0)
        low, high = places[good - 1], places[good]

        def slope(t: float) -> float | None:
            found = self.met(at(t))
            limits = self.rows(aim, found).limits
            rates = [self._known_rate(criterion, found) for criterion in aim.constraints]
            if any(rate is None for rate in rates):
                return None
            along = float(np.concatenate([rate for rate in rates if rate is not None])[int(np.argmin(limits))])
            return -along if back else along

        end, done = _newton(margin, slope, (low, high), accuracy)
        return self.ended(aim, at(end), converged=done, message="root of the limit")

    def _known_rate(self, criterion: Criterion, found: Computed) -> RealArray | None:
        slope = self.evaluation.slope(criterion, found, 0)
        if slope is None:
            return None
        return slope * self._scaled(criterion, found)[1] * self.problem.numbers[0].rate(found.site.values[0])

    def ended(self, aim: Aim, site: Site, *, converged: bool, message: str) -> Start:
        """A search that has ended at ``site``."""
        rows = self.rows(aim, self.met(site))
        return Start(site, float(rows.objective.max()), rows.violation, converged, message)

    def rank(self, start: Start) -> tuple[float, float]:
        """What is smaller for the better one of two ends: the violation, and then the objective."""
        return (start.violation if start.violation > self.tolerance else 0.0, start.objective)


def _newton(
    margin: Callable[[float], float],
    slope: Callable[[float], float | None],
    bracket: tuple[float, float],
    accuracy: float,
) -> tuple[float, bool]:
    """Root of ``margin`` between a negative and a positive end, and whether it was found to
    ``accuracy``."""
    low, high = bracket
    if slope(high) is None:
        end, report = optimize.brentq(
            margin, low, high, xtol=accuracy, rtol=1e-12, maxiter=ROUNDS, full_output=True, disp=False
        )
        return float(end), bool(report.converged)
    at = low + (high - low) * abs(margin(low)) / (abs(margin(low)) + abs(margin(high)))
    for _ in range(ROUNDS):
        value = margin(at)
        low, high = (at, high) if value < 0.0 else (low, at)
        along = slope(at)
        following = at - value / along if along else 0.5 * (low + high)
        if not low <= following <= high:
            following = 0.5 * (low + high)
        if abs(following - at) <= accuracy:
            margin(following)
            return following, True
        at = following
    return at, False


AGAIN = 4
"""Searches that begin again at the best design so far, until none gains more than the tolerance."""

PATIENCE = 12
"""Designs that a search by gradients computes without a better one, a quarter as many more for each
number, before it ends."""


class _Enough(Exception):
    """No better design has been met for long."""


@dataclass(frozen=True)
class _End:
    """What stands for the answer of ``minimize`` where a search was ended."""

    success: bool = False
    message: str = "no better design for long"


class _Local:
    """Functions of one search by gradients, of shares z and, with several rows of the objective or
    for the least violation, a bound t on them."""

    def __init__(self, search: Search, aim: Aim, choice: tuple[int, ...], nearest: bool) -> None:
        self.search, self.aim, self.choice, self.nearest = search, aim, choice, nearest
        self.n = len(search.problem.numbers)
        self.sites: list[Site] = []
        self.rank, self.waited = (math.inf, math.inf), 0
        several = aim.objective.variable is None and aim.objective.over != "mean" and len(aim.objective.cases) > 1
        self.bound = nearest or several

    def run(self, first: RealArray, method: str) -> Any:
        """What ``minimize`` of scipy answers."""
        rows = self._rows(first)
        x0, bounds = np.clip(first, 0.0, 1.0), [(0.0, 1.0)] * self.n
        if self.bound:
            x0 = np.append(x0, rows.violation if self.nearest else rows.objective.max())
            bounds.append((0.0, MOST) if self.nearest else (-MOST, MOST))
        table = self.search.problem.table
        options: dict[str, Any] = {"maxiter": table.max_iterations}
        limits: Any = ()
        count = self._limits(x0).size
        if method == "slsqp":
            options["ftol"] = table.tolerance
            limits = [{"type": "ineq", "fun": self._limits, "jac": self._limit_slopes}] if count else ()
        else:
            # with the usual barrier of 0.1 it ends that far from a limit or bound
            options |= dict.fromkeys(("initial_barrier_parameter", "initial_barrier_tolerance"), 0.1 * table.tolerance)
            options |= {"gtol": 0.1 * table.tolerance, "xtol": table.tolerance}
            if count:
                limits = [optimize.NonlinearConstraint(self._limits, 0.0, np.inf, jac=self._limit_slopes)]
        name = "SLSQP" if method == "slsqp" else "trust-constr"
        minimize: Any = optimize.minimize
        self.waited = 0
        try:
            return minimize(
                self._value, x0, jac=self._slope, bounds=bounds, constraints=limits, method=name, options=options
            )
        except _Enough:
            return _End()

    def best(self) -> Start:
        """The best design that was met."""
        ends = []
        for site in self.sites:
            rows = self.search.rows(self.aim, self.search.evaluation([site])[0])
            ends.append(Start(site, float(rows.objective.max()), rows.violation, converged=False, message=""))
        if self.nearest:
            return min(ends, key=lambda end: (end.violation, end.objective))
        return min(ends, key=self.search.rank)

    def _site(self, x: RealArray) -> Site:
        return self.search.problem.place(self.choice, x[: self.n])

    def _rows(self, x: RealArray) -> Rows:
        site = self._site(x)
        rows = self.search.rows(self.aim, self.search.met(site))
        if site not in self.sites:
            self.sites.append(site)
            self.waited += 1
            end = Start(site, float(rows.objective.max()), rows.violation, converged=False, message="")
            rank = (end.violation, end.objective) if self.nearest else self.search.rank(end)
            room = 0.1 * self.search.tolerance
            if rank[0] < self.rank[0] - room or (rank[0] <= self.rank[0] and rank[1] < self.rank[1] - room):
                self.rank, self.waited = rank, 0
            if self.waited > PATIENCE * (1.0 + 0.25 * self.n):
                raise _Enough
        return rows

    def _value(self, x: RealArray) -> float:
        return float(x[-1]) if self.bound else float(self._rows(x).objective[0])

    def _slope(self, x: RealArray) -> RealArray:
        if self.bound:
            return np.append(np.zeros(self.n), 1.0)
        return np.asarray(self.search.gradient(self.aim, self._site(x))[0][0])

    def _limits(self, x: RealArray) -> RealArray:
        rows = self._rows(x)
        if self.nearest:
            return np.asarray(rows.limits + x[-1])
        return np.concatenate([rows.limits, x[-1] - rows.objective]) if self.bound else rows.limits

    def _limit_slopes(self, x: RealArray) -> RealArray:
        objective, limits = self.search.gradient(self.aim, self._site(x))
        if self.nearest:
            return np.column_stack([limits, np.ones(len(limits))])
        if not self.bound:
            return limits
        last = np.append(np.zeros(len(limits)), np.ones(len(objective)))
        return np.column_stack([np.concatenate([limits, -objective]), last])
