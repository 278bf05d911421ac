"""The one executor: a problem document is built, solved and analysed. Command line, studies and
Python all end here."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from html import escape
from itertools import chain
from typing import TYPE_CHECKING, Any, Literal

from ..contact.history import HistoryResult
from ..contact.operators import Operator, prepare_operator
from ..contact.result import ContactResult, follows_from_pressure, stiffness_of
from ..contact.solve import Keep, solve, steps
from ..contact.state import InterfaceState
from ..core.errors import AsperityError, ConvergenceError
from ..core.late import Drawn, Judged
from ..core.quantity import Labelled
from ..core.status import Advice, Status
from ..io.words import Rows, finding_rows
from ..parts.contact import STIFFNESS
from ..parts.part import Found, Part, Solved, Stage, Words, no_stage
from ..parts.registry import parts
from .build import Case

if TYPE_CHECKING:
    from ..plots.picture import Figure


@dataclass(frozen=True, eq=False, repr=False)
class Outcome(Judged, Drawn):
    """What came out of a problem document.

    Attributes
    ----------
    case
        What was asked for; None for the parts of a contact that was solved before.
    solved
        The contact, as parts see it.
    found
        What each part has found, by its name.
    findings
        What the user should know before using the numbers, of all parts.
    status
        Whether everything that had to settle did.
    stored
        Attributes of the file that it comes from; empty for an outcome of this run.
    """

    case: Case | None
    solved: Solved
    found: Mapping[str, Found]
    findings: tuple[Advice, ...]
    status: Status
    stored: Mapping[str, Any] = field(default_factory=dict)

    @property
    def result(self) -> ContactResult:
        """The contact at the end of the load, or of the load path."""
        return self.solved.result

    @property
    def path(self) -> HistoryResult | None:
        """The load path, if the document has one and its steps were kept."""
        return self.solved.path

    def in_words(self) -> tuple[str, Rows]:
        """Heading, verdict, findings, and the numbers that people look for first."""
        given = self.verdict
        title = self.stored.get("report_title") or "Outcome"
        return str(title), [
            *given.rows,
            *finding_rows(given),
            *given.headline,
            ("status", self.status.message),
        ]

    def _repr_html_(self) -> str:
        return super()._repr_html_() if isinstance(self.result, ContactResult) else f"<pre>{escape(repr(self))}</pre>"

    @property
    def drawn(self) -> ContactResult | HistoryResult:
        """What its card shows."""
        return self.path or self.solved.at().result

    @property
    def converged(self) -> bool:
        """Whether the contact, every step of its path and its couplings reached their
        tolerances."""
        return self.status.converged and (self.path is None or self.path.converged)

    @property
    def parts(self) -> tuple[Part, ...]:
        """The parts that were known: those that are installed, and those that ``run`` was given."""
        return parts() if self.case is None else self.case.parts

    @property
    def scalars(self) -> list[Labelled]:
        """Every scalar with its quantity."""
        found = ((part, self.found[part.name].values) for part in self.parts if part.name in self.found)
        return [
            Labelled(q, values[q.name])
            for part, values in found
            for q in part.quantities
            if q.name in values and not q.dims
        ]

    @property
    def values(self) -> dict[str, Any]:
        """Every scalar by the name of its quantity, SI."""
        return {item.quantity.name: item.values for item in self.scalars}

    @cached_property
    def sections(self) -> tuple[tuple[Part, Words], ...]:
        """Every part with words, and these."""
        found = ((part, self.found[part.name]) for part in self.parts if part.name in self.found)
        told = ((part, item.words or part.at_work.words(item, self.solved)) for part, item in found)
        return tuple((part, words) for part, words in told if words)

    @cached_property
    def figures(self) -> dict[str, tuple[Figure, ...]]:
        """Figures of each part, by its name."""
        return {
            part.name: part.at_work.figures(self.found[part.name], self.solved)
            for part in self.parts
            if part.name in self.found
        }

    @cached_property
    def pictures(self) -> tuple[Figure, ...]:
        """Figures of the contact itself, at the step of the largest load."""
        from ..plots.contact import contact_figures

        return contact_figures(self.solved.at().result)

    @property
    def all_figures(self) -> tuple[Figure, ...]:
        """Those of the contact and of all parts."""
        return (*self.pictures, *chain.from_iterable(self.figures.values()))

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers behind the numbers."""
        of_parts = (key for found in self.found.values() for key in found.citation_keys)
        return tuple(dict.fromkeys((*getattr(self.result, "citation_keys", ()), *of_parts)))


@dataclass(eq=False)
class Warm:
    """What cases that differ in their load alone share: the prepared operator, and the contacts
    solved so far."""

    operator: Operator | None = None
    last: ContactResult | None = None

    def state(self) -> InterfaceState | None:
        """A virgin interface with the pressures that the last contacts suggest."""
        last = self.last
        return (
            None if last is None else InterfaceState(last.pressure, earlier=last.earlier, deflections=last.deflections)
        )


def execute(
    case: Case,
    *,
    warm: Warm | None = None,
    wanted: Iterable[str] | None = None,
    lines: bool = True,
    threads: int | None = None,
    stage: Stage = no_stage,
    reached: Callable[[Solved], None] | None = None,
    on_failure: Literal["raise", "return"] = "return",
) -> Outcome:
    """Solve ``case`` and compute its parts.

    Parameters
    ----------
    case
        What to solve.
    warm
        What earlier cases that differ in the load alone have left; it is brought up to date.
    wanted
        Names of the quantities that are wanted, so that costly ones may be left out; all by
        default.
    lines
        Whether parts keep the fields that only pictures show.
    threads
        Number of threads instead of that of the document.
    reached
        Is given the contact, with the load path so far, after every step that is solved, before
        anything else is computed of it.
    stage, on_failure
        As for ``run``.
    """
    names = None if wanted is None else frozenset(wanted)
    problem, asked = case.problem, [part for part in case.parts if part.name in case.asks]
    threads, warm = threads or case.threads, warm or Warm()
    stiffness = names is None or STIFFNESS in names
    path: HistoryResult | None = None
    with stage(f"solving {len(case.path)} steps" if case.path else "solving") as progress:
        if warm.operator is None:
            engine = case.engine(threads)
            warm.operator = prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
        options: dict[str, Any] = {"operator": warm.operator, "on_failure": on_failure, "solver": case.solver}
        for part in asked:
            options |= part.options(case.asks[part.name])
        if case.path:
            whole = lines or any(part.whole_path for part in asked)
            stream = steps(problem, case.path, progress=progress, **options)
            results: deque[ContactResult] = deque(maxlen=None if whole else 1)
            for result in stream:
                results.append(result)
                if reached is not None and whole:
                    reached(Solved(problem, result.control, result, HistoryResult(tuple(results))))
        else:
            keep, state = Keep(stiffness=stiffness), warm.state()
            result = solve(problem, case.control, keep=keep, state=state, progress=progress, **options)
            warm.last = result
            if reached is not None:
                reached(Solved(problem, case.control, result))
    if case.path:
        if stiffness and follows_from_pressure(result):
            result = replace(result, normal_stiffness=stiffness_of(result, operator=warm.operator))
        if len(results) == len(case.path):
            path = HistoryResult((*list(results)[:-1], result))
    solved = Solved(
        problem,
        case.control,
        result,
        path,
        solver=case.solver,
        threads=threads,
        wanted=names,
        lines=lines,
        stage=stage,
    )
    status = result.status
    found, failed = _found(case.asks, solved, case.parts)
    findings = (*(finding for item in found.values() for finding in item.findings), *failed)
    statuses = [item.status for item in found.values() if item.status is not None]
    worst = next((item for item in statuses if not item.converged), next(iter(statuses), status))
    return Outcome(case, replace(solved, found=found), found, findings, worst if status.converged else status)


def analysed(
    result: ContactResult, asks: Mapping[str, Any], path: HistoryResult | None = None, **options: Any
) -> Outcome:
    """What the parts that are asked for find in a ``result`` that was solved before, the end of
    ``path`` if one is given.

    ``options`` are fields of ``Solved``.
    """
    solved = Solved(result.problem, result.control, result, path, **options)
    found, failed = _found(asks, solved, parts())
    findings = (*(finding for item in found.values() for finding in item.findings), *failed)
    return Outcome(None, replace(solved, found=found), found, findings, result.status)


def answered(result: ContactResult, path: HistoryResult | None, *asked: str) -> Outcome:
    """What the parts ``asked`` for, and all that need nothing but the result, find in a ``result``,
    the end of ``path`` if one is given."""
    there = [part for part in parts() if part.of_result in result.couplings]
    made = {part.name: part.at_work.made_from(result) for part in there}
    outcome = analysed(
        result, dict.fromkeys((*asked, *(name for name, item in made.items() if item is None)), True), path
    )
    found = {**outcome.found} | {name: item for name, item in made.items() if item is not None}
    return replace(outcome, found=found, solved=replace(outcome.solved, found=found))


def _found(
    asks: Mapping[str, Any], solved: Solved, known: tuple[Part, ...]
) -> tuple[dict[str, Found], tuple[Advice, ...]]:
    """What the parts find in a ``solved`` contact; a part that fails is a finding and ends no
    other, unless it is essential."""
    found: dict[str, Found] = {}
    failed: list[Advice] = []
    for part in known:
        if part.name not in asks:
            continue
        if solved.wanted is not None and all(q.costly and q.name not in solved.wanted for q in part.quantities):
            continue
        try:
            found[part.name] = part.at_work.compute(asks[part.name], replace(solved, found=found))
        except Exception as error:
            if isinstance(error, MemoryError) or (part.essential and isinstance(error, AsperityError)):
                raise
            if part.essential:
                raise ConvergenceError(
                    f"{part.title} could not be computed: {type(error).__name__}: {error}"
                ) from error
            kind = "" if isinstance(error, AsperityError) else f"{type(error).__name__}: "
            text = f"{part.title} could not be computed: {kind}{' '.join(str(error).split())}"
            failed.append(Advice("warning", part.name.replace("_", " "), text))
    return found, tuple(failed)
