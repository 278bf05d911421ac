"""Parameters of a contact fitted to a measured curve, with what the curve says of them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import ConvergenceError, InputError
from ..core.scipy_parts import optimize
from ..core.units import percent
from ..io.schemas.calibration import CalibrationTable
from ..io.schemas.design import DesignTable
from ..io.schemas.study import AxisTable
from ..run.build import stated_points
from .calibration import Calibration, CurvePoint, Fitted
from .curve import Curve, read_curve
from .design.evaluation import Evaluation
from .design.optimise import Progress, evaluating, loaded_study
from .design.problem import Criterion, DesignProblem, Site, make_design
from .design.search import Search
from .design.searches import starts
from .documents import LoadedStudy
from .plan import measures

CORRELATED, UNKNOWN = 0.95, 0.25
"""Correlation of two parameters, and relative standard deviation of one, from which a curve does
not tell them."""

LIKELY = 3.8414588
"""Rise of the sum of squares at the ends of an interval of 95 % (chi squared of one parameter)."""

FAR, NEAR = 4.0, 0.02
"""How far a profile reaches in standard deviations, and the least width in logarithms."""


def calibrate(
    study: str | Path | Mapping[str, Any],
    folder: str | Path | None = None,
    *,
    workers: int = 1,
    retry: bool = False,
    progress: Progress | None = None,
) -> Calibration:
    """Fit modulus, thickness, hardness or work of adhesion to a measured curve.

    The study document has a table ``[calibration]``: a CSV file of load and approach, load and
    area, or approach and force, with units in its head, and the scalars of the problem to be fitted
    within bounds. Their logarithms are sought by least squares (Levenberg & Marquardt in a trust
    region), each value weighted by its standard deviation; the Jacobian is that of the contact on
    its set where it has one, else from central differences. Priors are further residuals. The
    covariance is (JᵀJ)⁻¹; where it says that the curve does not tell the parameters, their
    intervals are those of the profile likelihood.

    Parameters
    ----------
    study
        Study document (TOML or JSON file), or its content as nested dictionaries, whose relative
        paths begin here.
    folder, workers, retry, progress
        As for ``optimise``.

    Raises
    ------
    InputError
        If a parameter leads nowhere or is not positive, a column of the curve is no quantity or has
        no unit, or there are fewer values than parameters.
    FileFormatError
        If the curve cannot be read.
    ConvergenceError
        If no contact could be computed.
    """
    loaded, target = loaded_study(study, folder)
    table = loaded.document.calibration
    if table is None:
        raise InputError("study of a calibration must have the table [calibration], but has none.")
    file = (loaded.folder / table.curve).absolute()
    curve = read_curve(file, loaded, table.noise)
    table = table.model_copy(update={"curve": str(file)})
    loaded = replace(loaded, document=loaded.document.model_copy(update={"calibration": table}))
    problem = make_design(_as_design(loaded, table, curve))
    if any(not each.log for each in problem.numbers):
        name = next(each.place.path for each in problem.numbers if not each.log)
        raise InputError(f"low of {name} must be above zero to be fitted, but is not.")
    with evaluating(problem, (loaded, target), workers=workers, retry=retry, progress=progress) as evaluation:
        return _Fit(problem, evaluation, table, curve).answer()


def _as_design(study: LoadedStudy, table: CalibrationTable, curve: Curve) -> LoadedStudy:
    """The study whose variables are the parameters, and whose cases are the points of the curve."""
    keys = ("path", "name", "low", "high", "start", "also")
    variables = [{key: getattr(item, key) for key in keys if getattr(item, key)} for item in table.parameters]
    first = next(iter(curve.values))
    settings = {"minimise": first, "variables": variables, "step": table.step, "starts": table.starts}
    design = DesignTable.model_validate({**settings, "seed": table.seed, "tolerance": table.tolerance})
    axis = AxisTable(path=curve.path, name="point", values=tuple(_value(text) for text in curve.texts))
    update = {"design": design, "calibration": None, "axes": (axis,), "quantities": tuple(curve.values)}
    return LoadedStudy(study.document.model_copy(update=update), study.problem, study.folder)


def _value(text: str) -> str | float:
    return text if " " in text else float(text)


@dataclass(eq=False)
class _Fit:
    """Least squares of one curve."""

    problem: DesignProblem
    evaluation: Evaluation
    table: CalibrationTable
    curve: Curve

    def __post_init__(self) -> None:
        known, count = measures(), len(self.curve.loads)
        cases = tuple(range(count))
        self.criteria = [
            Criterion(name, known[name].unit, known[name].label, larger=False, over="each", cases=cases)
            for name in self.curve.values
        ]
        self.search = Search(self.problem, self.evaluation)
        self.priors = [
            (n, math.log(each.place.number(item.prior)), float(item.deviation))
            for n, (each, item) in enumerate(zip(self.problem.numbers, self.table.parameters, strict=True))
            if item.prior is not None and item.deviation is not None
        ]
        least = len(self.problem.numbers)
        there = count * len(self.criteria) + len(self.priors)
        if there < least:
            raise InputError(f"curve of a calibration must hold at least {least} values, but holds {there}.")

    def residuals(self, shares: RealArray) -> RealArray:
        """Differences of model and curve over their deviations, and those of the priors."""
        site = self.problem.place((), shares)
        (found,) = self.evaluation([site])
        if found.error:
            return np.full(sum(map(len, self.curve.values.values())) + len(self.priors), 1e3)
        rows = [
            (self.evaluation.value(each, found) - self.curve.values[each.name]) / self.curve.deviations[each.name]
            for each in self.criteria
        ]
        known = [(math.log(site.values[n]) - mean) / deviation for n, mean, deviation in self.priors]
        return np.asarray(np.nan_to_num(np.concatenate([*rows, np.array(known)]), nan=1e3))

    def jacobian(self, shares: RealArray) -> RealArray:
        """Derivatives of the residuals to the shares of the ranges."""
        site = self.problem.place((), shares)
        (found,) = self.evaluation([site])
        numbers = range(len(self.problem.numbers))
        known = {(c.name, n): self.evaluation.slope(c, found, n) for c in self.criteria for n in numbers}
        lacking = [n for n in numbers if any(known[each.name, n] is None for each in self.criteria)]
        around = self.search.neighbours(site, lacking)
        self.evaluation([one for pair in around.values() for one in pair])
        columns = []
        for n in numbers:
            each, parts = self.problem.numbers[n], []
            for criterion in self.criteria:
                slope = known[criterion.name, n]
                if slope is None:
                    low, high = self.evaluation(around[n])
                    width = each.share(high.site.values[n]) - each.share(low.site.values[n])
                    slope = (self.evaluation.value(criterion, high) - self.evaluation.value(criterion, low)) / width
                else:
                    slope = slope * each.rate(site.values[n])
                parts.append(slope / self.curve.deviations[criterion.name])
            parts.append(np.array([float(n == at) * each.width / deviation for at, _, deviation in self.priors]))
            columns.append(np.concatenate(parts))
        return np.asarray(np.nan_to_num(np.stack(columns, axis=-1)))

    def fitted(self, first: RealArray, fixed: dict[int, float] | None = None) -> Any:
        """Answer of the least squares from the shares ``first``, some of them ``fixed``."""
        fixed = fixed or {}
        free = [n for n in range(len(first)) if n not in fixed]

        def whole(part: RealArray) -> RealArray:
            made = np.array(first, dtype=float)
            made[free] = part
            for n, value in fixed.items():
                made[n] = value
            return made

        least_squares: Any = optimize.least_squares
        accuracy = self.table.tolerance
        return least_squares(
            lambda part: self.residuals(whole(part)),
            np.clip(np.asarray(first)[free], 1e-6, 1.0 - 1e-6),
            jac=lambda part: self.jacobian(whole(part))[:, free],
            bounds=(0.0, 1.0),
            xtol=accuracy / max(each.width for each in self.problem.numbers),
            ftol=accuracy**2,
            gtol=1e-12,
            max_nfev=min(self.table.max_iterations, FEW) if fixed else self.table.max_iterations,
        )

    def answer(self) -> Calibration:
        """Parameters with their deviations, correlations and intervals."""
        fits = sorted((self.fitted(first) for first in starts(self.search)), key=lambda fit: float(fit.cost))
        best, numbers = fits[0], self.problem.numbers
        site = self.problem.place((), best.x)
        (found,) = self.evaluation([site])
        if found.error:
            raise ConvergenceError(f"No contact could be computed; the first failed: {found.error}")
        told = self._told(self.problem.shares(site))
        deviations, telling = told.deviations, _findings([each.name for each in numbers], told)
        profiles = {n: self.profile(n, best.x, float(best.cost), told) for n in telling.doubtful}
        factors = np.exp(np.outer(1.96 * deviations, (-1.0, 1.0)))
        intervals = [profiles[n][1] if n in profiles else factors[n] * site.values[n] for n in range(len(numbers))]
        chi = 2.0 * float(best.cost)
        freedom = best.fun.size - len(numbers)
        findings = [
            f"{each.name} lies at the {end} end of its range: give a wider one, if that can be."
            for each, share in zip(numbers, best.x, strict=True)
            for end, gap in (("lower", share), ("upper", 1.0 - share))
            if gap < AT_END
        ]
        findings += telling.texts
        findings += [
            f"The interval of {numbers[n].name} is open at the {end} end of its range, where the curve still allows it."
            for n in profiles
            for end, bound, limit in zip(
                ("lower", "upper"), intervals[n], (numbers[n].low, numbers[n].high), strict=True
            )
            if abs(math.log(bound / limit)) < AT_END * numbers[n].width
        ]
        findings += self._coarse(site)
        if freedom > 0 and chi / freedom > 4.0:
            off = math.sqrt(chi / freedom)
            text = f"The fit is {off:.2g} deviations off on the mean: model or noise are not right."
            findings.append(text)
        return Calibration(
            title=self.problem.plan.document.title,
            parameters=tuple(
                Fitted(each.name, each.place.path, each.place.unit, value, float(deviation), *map(float, interval))
                for each, value, deviation, interval in zip(numbers, site.values, deviations, intervals, strict=True)
            ),
            correlation=tuple(tuple(map(float, row)) for row in told.correlation),
            singular_values=tuple(map(float, told.singular)),
            directions=tuple(tuple(map(float, row)) for row in told.directions),
            chi_squared=chi,
            freedom=freedom,
            curve=tuple(self._points(site)),
            profiles={numbers[n].name: profile for n, (profile, _) in profiles.items()},
            findings=tuple(findings),
            identifiable=not telling.doubtful,
            converged=bool(best.status > 0),
            agreeing=sum(float(fit.cost) <= 1.01 * float(best.cost) + 0.01 for fit in fits),
            starts=len(fits),
            solves=self.evaluation.solved,
            reused=self.evaluation.reused,
        )

    def _coarse(self, site: Site) -> list[str]:
        """Words on a contact of so few points that their grid alone moves the fit."""
        grid = stated_points(self.problem.plan.base.document.surface)
        least = grid * float(np.min(self.evaluation.recorded(site, "area_fraction")))
        if not 0.0 < least < FEWEST:
            return []
        return [
            f"The smallest contact of the curve is {least:.0f} points of the grid. Below {FEWEST} the approach "
            "of a sphere is off by 0.1 % and more, of 20 points by 0.8 %, which moves parameters that the curve does "
            "not tell apart. Give more points."
        ]

    def _told(self, shares: RealArray) -> _Told:
        """What the Jacobian to the logarithms at ``shares`` tells, by its singular values."""
        widths = np.array([each.width for each in self.problem.numbers])
        _, singular, right = np.linalg.svd(self.jacobian(shares) / widths, full_matrices=False)
        spread = right.T / np.maximum(singular, 1e-12 * max(float(singular[0]), 1.0))
        covariance = spread @ spread.T
        deviations = np.sqrt(np.diag(covariance))
        return _Told(deviations, covariance / np.outer(deviations, deviations), singular, right)

    def _points(self, site: Site) -> list[CurvePoint]:
        (found,) = self.evaluation([site])
        made = []
        for each in self.criteria:
            model = self.evaluation.value(each, found)
            columns = self.curve.loads, self.curve.values[each.name], self.curve.deviations[each.name], model
            rows = zip(*columns, strict=True)
            made += [CurvePoint(self.curve.path, each.name, each.unit, *map(float, row)) for row in rows]
        return made

    def profile(
        self, number: int, best: RealArray, cost: float, told: _Told
    ) -> tuple[tuple[tuple[float, float], ...], tuple[float, float]]:
        """Values of a parameter with the rise of the sum of squares when all others are fitted to
        them, and the interval in which it is below that of 95 %."""
        each, points, ends = self.problem.numbers[number], [(float(best[number]), 0.0)], list[float]()
        reach = min(max(FAR * float(told.deviations[number]), NEAR), each.width) / each.width
        for side in (-1.0, 1.0):
            inside, outside = (np.array(best), 0.0), (np.array(best), 0.0)
            for step in (0.06, 0.15, 0.4, 1.0):
                share = float(np.clip(best[number] + side * step * reach, 0.0, 1.0))
                if abs(share - inside[0][number]) < 1e-9:
                    break
                outside = self.risen(number, share, inside[0], cost, told)
                points.append((share, outside[1]))
                if outside[1] > LIKELY:
                    break
                inside = outside
            for _ in range(CLOSER):
                if outside[1] <= LIKELY or min(outside[1] - LIKELY, LIKELY - inside[1]) < 0.05 * LIKELY:
                    break
                # far from the best fit the root of the rise is no straight line
                between = self.risen(number, _crossing(number, inside, outside, 0.3), inside[0], cost, told)
                points.append((float(between[0][number]), between[1]))
                inside, outside = (inside, between) if between[1] > LIKELY else (between, outside)
            ends.append(_crossing(number, inside, outside) if outside[1] > LIKELY else float(outside[0][number]))
        made = tuple((each.value(share), float(rise)) for share, rise in sorted(points))
        return made, (each.value(ends[0]), each.value(ends[1]))

    def risen(self, number: int, share: float, near: RealArray, cost: float, told: _Told) -> tuple[RealArray, float]:
        """Shares with that of a parameter held and the others fitted, from those ``near`` and
        along the covariance, and the rise of the sum of squares."""
        widths = np.array([one.width for one in self.problem.numbers])
        along = told.correlation[number] * told.deviations / told.deviations[number] * widths[number] / widths
        # a fit that begins at the end of a range stays there: at most half of the way to it
        first = np.clip(near + (share - near[number]) * along, 0.5 * near, 0.5 * (1.0 + near))
        first[number] = share
        if len(near) == 1:
            return first, max(float((self.residuals(first) ** 2).sum()) - 2.0 * cost, 0.0)
        found = self.fitted(first, {number: share})
        first[[n for n in range(len(near)) if n != number]] = found.x
        return first, max(2.0 * (float(found.cost) - cost), 0.0)


def _crossing(
    number: int, inside: tuple[RealArray, float], outside: tuple[RealArray, float], least: float = 0.0
) -> float:
    """Share of a parameter at which the rise passes ``LIKELY``, its root being linear between, or
    the ``least`` part of the way from either end."""
    (near, low), (far, high) = inside, outside
    part = (math.sqrt(LIKELY) - math.sqrt(low)) / (math.sqrt(high) - math.sqrt(low))
    part = min(max(part, least), 1.0 - least)
    return float(near[number] + part * (far[number] - near[number]))


AT_END = 1e-3
"""Share of the range within which a value counts as one at its end."""

FEWEST = 60
"""Points in contact below which a finding names them."""

FEW, CLOSER = 10, 6
"""Steps of a fit of a profile, which begins at the one beside it, and such fits at most on each
side to find the end of the interval."""


class _Told(NamedTuple):
    """Relative standard deviations (n,), correlation (n, n), singular values (n,) and directions
    (n, n) of the parameters."""

    deviations: RealArray
    correlation: RealArray
    singular: RealArray
    directions: RealArray


class _Telling(NamedTuple):
    doubtful: tuple[int, ...]
    texts: tuple[str, ...]


def _findings(names: Sequence[str], told: _Told) -> _Telling:
    """Parameters that the curve does not tell, and words on why."""
    texts, doubtful = [], set[int]()
    deviations, correlation = told.deviations, told.correlation
    for n, deviation in enumerate(deviations):
        if not deviation <= UNKNOWN:
            doubtful.add(n)
            shown = percent(float(deviation), 2) if deviation < 1.0 else "more than 100 %"
            texts.append(f"The curve does not tell {names[n]}: its standard deviation is {shown}.")
        for k in range(n):
            if abs(correlation[n, k]) > CORRELATED:
                doubtful |= {n, k}
                texts.append(
                    f"The curve does not tell {names[k]} and {names[n]} apart: their correlation is "
                    f"{correlation[n, k]:.3f}. Give a prior for one of them, or a wider range of loads."
                )
    return _Telling(tuple(sorted(doubtful)), tuple(texts))
