"""From a study document to its cases: axes, their combinations, and what identifies each case by
content."""

from __future__ import annotations

import difflib
import itertools
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import prod
from typing import Any

from ..core import require, units
from ..core.arrays import content_digest
from ..core.errors import InputError
from ..core.quantity import Limit, Quantity
from ..core.status import is_large, require_memory, room_text
from ..io.description import software
from ..io.schemas.axis_values import LimitTable
from ..io.schemas.study import AxisTable, RandomTable, StudyDocument
from ..parts.registry import parts, versions
from ..run.build import stated_points
from ..run.document import ProblemDocument
from ..run.refusals import refusals
from .axes import Axis, Base, Coordinate, listed, make_axis
from .convergence import level_axis
from .critical_thickness import thickness_axis
from .derived import Derived, Scalars, derived_numbers, located, ruled_axis
from .documents import LoadedStudy
from .local import available_cores
from .monte_carlo import sample_axis
from .places import Edit, content, edited, problem_table
from .sensitivity import parameter_axis


@dataclass(frozen=True)
class StudyCase:
    """One case: its place on the axes, its changes of the base problem, and the ``key`` that its
    content gives it."""

    index: tuple[int, ...]
    edits: tuple[Edit, ...]
    key: str


@dataclass(frozen=True)
class Plan:
    """Everything that a study is going to compute.

    Parameters
    ----------
    document
        The study.
    base
        The problem it starts from.
    axes
        Dimensions, the slowest first.
    quantities
        What is computed of each case.
    scalars
        Scalars over all cases, by the letters of the study.
    derived
        What is derived from these and the quantities.
    limits
        Names of quantities, and the limits that they are held against.
    """

    document: StudyDocument
    base: Base
    axes: tuple[Axis, ...]
    quantities: tuple[str, ...]
    scalars: Scalars
    derived: tuple[Derived, ...] = ()
    limits: tuple[tuple[str, Limit], ...] = ()

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of points of each axis."""
        return tuple(len(item) for item in self.axes)

    @property
    def n_cases(self) -> int:
        """Number of cases; of a study that stops by itself the largest."""
        return prod(self.shape)

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the results of a case: quantities asked for, and what is derived from them."""
        return (*self.document.quantities, *(item.quantity.name for item in self.derived if item.measured))

    @property
    def known(self) -> dict[str, Quantity]:
        """Every number of a case that can be asked about: quantities, and what is derived."""
        return measures() | {item.quantity.name: item.quantity for item in self.derived}

    @cached_property
    def table(self) -> dict[str, Any]:
        """The base problem as nested dictionaries."""
        return problem_table(self.base.document)

    def refused(self) -> str:
        """Why every case would be refused, by the first of them; empty where one would not, or
        where there are more than are looked at."""
        text = ""
        for number, index in enumerate(itertools.product(*map(range, self.shape))):
            if number == MOST_LOOKED_AT:
                return ""
            found = refusals(edited(self.table, self.edits(index)), self.base.folder)
            if not found:
                return ""
            text = text or found[0].text
        return text

    @cached_property
    def _content(self) -> dict[str, Any]:
        return content(self.base.document, self.base.folder)

    @cached_property
    def _made_by(self) -> list[Any]:
        """What else the numbers of a case depend on: version, those of packages that add parts, and
        quantities."""
        return [software()["asperity"], *versions().items(), list(self.quantities)]

    def paths(self) -> Iterator[tuple[StudyCase, ...]]:
        """Cases that differ in the load alone, together: the unit of work, in the order of the
        axes, made on the way.

        Loads rise along a path whatever their order on the axis.
        """
        outer = [number for number, item in enumerate(self.axes) if not item.is_load]
        inner = [number for number, item in enumerate(self.axes) if item.is_load]
        loads = list(itertools.product(*(range(len(self.axes[i])) for i in inner)))
        for fixed in itertools.product(*(range(len(self.axes[i])) for i in outer)):
            path = []
            for load in loads:
                at = dict(zip(outer, fixed, strict=True)) | dict(zip(inner, load, strict=True))
                index = tuple(at[i] for i in range(len(self.axes)))
                edits = self.edits(index)
                path.append(StudyCase(index, edits, self.key(edits)))
            path.sort(key=_load)
            yield tuple(path)

    def edits(self, index: Sequence[int], scalars: Scalars | None = None) -> tuple[Edit, ...]:
        """Changes of the base problem that make the case at ``index``; expressions take other
        ``scalars`` than those of the plan where these are given."""
        points = (item.points[at] for item, at in zip(self.axes, index, strict=True))
        return (scalars or self.scalars).ruled(index, tuple(edit for point in points for edit in point.edits))

    def key(self, edits: Sequence[Edit], beside: str = "") -> str:
        """Digest of the content of a case: its problem, the quantities, what is computed ``beside``
        them, and the version of the program."""
        made_by = [*self._made_by, beside] if beside else self._made_by
        return content_digest([edited(self._content, edits, by_content=True), made_by])

    def coordinates(self, index: Sequence[int]) -> dict[str, Coordinate]:
        """Where the case at ``index`` lies, by name of axis and column."""
        found: dict[str, Coordinate] = {}
        for item, number in zip(self.axes, index, strict=True):
            point = item.points[number]
            found |= {item.name: point.coordinate, **point.columns}
        return found


def _load(case: StudyCase) -> list[Any]:
    """What puts the cases of a path in the order of their loads."""
    return [(edit.keys[-1], edit.content) for edit in case.edits if edit.keys[0] == "control"]


def make_plan(study: LoadedStudy, edits: Sequence[Edit] = ()) -> Plan:
    """Plan of ``study``; all values are checked, one at a time with the others as in the base
    problem. Expressions take the scalars of the base problem after ``edits``.

    Raises
    ------
    InputError
        If a path leads nowhere, a value cannot be used, a quantity is unknown, names clash, or
        there are too many cases.
    """
    document, base = study.document, Base(study.problem, study.folder)
    counts, cases, memory = _extent(document)
    if max(counts, default=0) > MOST_POINTS:
        raise InputError(f"axis of a study must have at most {MOST_POINTS} points, but one has {max(counts)}.")
    require_memory(memory, "study", f"{cases:.3g} cases", "give fewer points or samples")
    names = _names(document)
    axes = [
        make_axis(base, table, name) if table.expression is None else ruled_axis(base, table, name)
        for table, name in zip(document.axes, names, strict=False)
    ]
    if document.combine == "list" and axes:
        axes = [listed(axes)]
    if document.monte_carlo is not None:
        axes.insert(0, sample_axis(base, document.monte_carlo, names[len(document.axes) :]))
    if document.convergence is not None:
        axes.append(level_axis(base, document.convergence))
    if document.critical_thickness is not None:
        axes.append(thickness_axis(base, document.critical_thickness))
    if document.sensitivity is not None:
        axes.append(parameter_axis(base, document.sensitivity))
    seen: dict[tuple[Any, ...], str] = {}
    for item in axes:
        set_here = [edit.keys for point in item.points[:3] for edit in point.edits]
        for own in [*set_here, *([] if item.rule is None else [item.rule.place.keys])]:
            keys = ("control",) if own[0] == "control" else own
            for known, name in seen.items():
                shared = min(len(known), len(keys))
                if known[:shared] == keys[:shared] and name != item.name:
                    shown = ".".join(map(str, own))
                    raise InputError(f"axes must vary different scalars, but {name} and {item.name} both set {shown}.")
            seen[keys] = item.name
    stop = None if document.monte_carlo is None else document.monte_carlo.stop
    asked = (*document.quantities, *(() if stop is None else (stop.quantity,)))
    scalars = Scalars(base, tuple(axes), located(base, document.letters), tuple(edits))
    scalars.require_rules()
    derived = derived_numbers(document.derived, scalars, measures()) if document.derived else ()
    limited = tuple(_limit(table, derived) for table in document.limits)
    taken = (*(name for item in derived for name in item.expression.names), *(name for name, _ in limited))
    asked = (*asked, *(name for name in taken if name in measures()))
    return Plan(document, base, tuple(axes), computed(study.problem, asked), scalars, derived, limited)


def _limit(table: LimitTable, derived: Iterable[Derived]) -> tuple[str, Limit]:
    """The quantity that ``table`` limits, and the limit in SI."""
    known = measures() | {item.quantity.name: item.quantity for item in derived}
    if table.quantity not in known:
        near = difflib.get_close_matches(table.quantity, known, n=3, cutoff=0.4)
        raise InputError(
            f"quantity of a limit must be a result or a derived number, but {table.quantity!r} is none"
            f"{'; did you mean ' + ' or '.join(near) + '?' if near else '.'}"
        )
    least = table.at_least is not None
    text = table.at_least if least else table.at_most
    value = limit_of(text, known[table.quantity].unit, f"limit of {table.quantity}")
    return table.quantity, Limit(value, least)


def limit_of(text: str | float | None, unit: str, what: str) -> float:
    """SI value of a limit: text with a unit where the quantity has one."""
    if unit == "1" and not isinstance(text, str):
        return require.finite(float(text) if text is not None else math.nan, what)
    if not isinstance(text, str):
        raise InputError(
            f'{what} must be text with a number and a unit, such as "{units.show(1.0, unit)}", but is {text!r}.'
        )
    return units.parse(text, "number", what) if unit == "1" else units.parse_in(text, unit, what)


MOST_LOOKED_AT = 256
"""Cases that are looked at before the first is solved, up to one that is not refused: a study whose
first case can be prepared takes no time for it."""

MOST_POINTS = 100_000
"""Points of an axis that is no axis of samples; each is checked before the first case, which takes
about a millisecond."""

BYTES_OF_A_POINT, BYTES_OF_A_CASE = 3000, 200
"""Memory of a point of an axis, and of a case without its quantities."""

BYTES_OF_A_RECORD = 1500
"""Disk space of a case: its record, and its place in the tables."""


SECONDS_OF_A_POINT, SECONDS_OF_A_CASE = 4e-6, 0.05
"""Time of one core for a case, for each point of its grid and besides; a map of 512 x 512 points
takes about a second."""

LONG = 4 * 3600.0
"""Seconds of work for each core from which a study is confirmed: half a working day, of an estimate
right within a factor of five."""


def large_study(plan: Plan, free_disk: float) -> str:
    """What ``plan`` takes of time, memory and ``free_disk`` (bytes), if that is much; else
    empty."""
    grid = stated_points(plan.base.document.surface) or 512 * 512
    seconds = plan.n_cases * (SECONDS_OF_A_CASE + SECONDS_OF_A_POINT * grid)
    (_, _, memory), disk = _extent(plan.document), BYTES_OF_A_RECORD * plan.n_cases
    cores = available_cores()
    if seconds <= LONG * cores and not is_large(memory) and not is_large(disk, free_disk):
        return ""
    return (
        f"The study has {plan.n_cases} cases: about {seconds / cores / 3600.0:.2g} h of work on {cores} cores "
        f"(on grids of {grid} points), {room_text(memory)} in memory, {room_text(disk, free_disk)} on the disk."
    )


def _extent(document: StudyDocument) -> tuple[list[int], int, float]:
    """Numbers of points of the axes of a study, samples aside, and of its cases, and the memory in
    bytes of both."""
    counts = [len(table.values) if table.values is not None else table.count or 0 for table in document.axes]
    if document.combine == "list":
        counts = counts[:1]
    if document.convergence is not None:
        counts.append(len(document.convergence.levels))
    if document.critical_thickness is not None:
        found = document.critical_thickness
        counts.append(2 + (len(found.values) if found.values is not None else found.count or 0))
    if document.sensitivity is not None:
        counts.append(1 + 2 * len(document.sensitivity.parameters))
    cases = prod(counts) * (1 if document.monte_carlo is None else document.monte_carlo.samples)
    memory = BYTES_OF_A_POINT * sum(counts) + cases * (BYTES_OF_A_CASE + 24 * (len(document.quantities) + 4))
    return counts, cases, memory


def _names(document: StudyDocument) -> list[str]:
    """Names of the axes and then of the random scalars: as given, or as many of the last keys of
    the path as are needed to be unlike the others."""
    tables: list[AxisTable | RandomTable] = [*document.axes]
    own = {"sample", "case", "level", "parameter", "value", "outcome", "error", "work"}
    if document.monte_carlo is not None:
        tables += document.monte_carlo.random
    if document.critical_thickness is not None:
        own.add("thickness")
    reserved = {*measures()} | own
    names: list[str] = []
    for table in tables:
        words, taken = table.path.split("."), reserved | set(names)
        short = ("_".join(words[-count:]) for count in range(1, len(words) + 1))
        free = next((name for name in short if name not in taken and not name[0].isdigit()), "_".join(words))
        name = table.name or free
        if "/" in name or not name.isprintable() or name != name.strip():
            raise InputError(
                f"name of the axis {table.path} must be printable, without / and spaces at its ends, but is "
                f"{name!r}: it names a variable of the result file."
            )
        if name in names or name in reserved:
            raise InputError(
                f"name of the axis {table.path} must differ from other axes and from quantities, but is {name!r}; "
                "give it another name."
            )
        names.append(name)
    return names


def measures() -> dict[str, Quantity]:
    """Every quantity that a part finds, by its name, in the order of tables."""
    return {item.name: item for part in parts() for item in part.quantities if not item.dims}


def computed(document: ProblemDocument, asked: Iterable[str]) -> tuple[str, ...]:
    """Names of the quantities that are computed of each case: all that cost nothing, and the costly
    ones ``asked`` for.

    Raises
    ------
    InputError
        If one that is asked for is unknown, or needs a table that the document lacks.
    """
    wanted = tuple(asked)
    there: dict[str, bool] = {}
    for part in parts():
        given = part.settings_in(document) is not None
        for item in (item for item in part.quantities if not item.dims):
            there[item.name] = given
            if item.name in wanted and not given:
                raise InputError(
                    f"quantity {item.name} needs the table [{part.table}] in the problem, but it is missing; add it.",
                    subject=f"quantity {item.name}",
                )
    for name in wanted:
        if name not in there:
            near = difflib.get_close_matches(name, there, n=3, cutoff=0.4)
            hint = f"did you mean {' or '.join(near)}?" if near else f"known are {', '.join(there)}."
            raise InputError(f"quantities must be names of results, but {name!r} is none; {hint}")
    known = measures()
    return tuple(name for name, item in known.items() if there[name] and (not item.costly or name in wanted))
