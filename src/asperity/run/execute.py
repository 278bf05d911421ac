"""The one executor: a problem document is built, solved and analysed. Command line, studies and Python all end here."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from ..contact.history import HistoryResult
from ..contact.operators import Operator, prepare_operator
from ..contact.result import ContactResult, follows_from_pressure, stiffness_of
from ..contact.solve import Keep, solve, steps
from ..contact.state import InterfaceState
from ..core.errors import AsperityError, ConvergenceError
from ..core.quantity import Labelled
from ..core.status import Advice, Status
from ..parts.contact import STIFFNESS
from ..parts.part import Found, Part, Solved, Stage, Words, no_stage
from ..parts.registry import parts, with_own
from .build import Case, build
from .document import TRACTIONS, ProblemDocument, checked, read_table

if TYPE_CHECKING:
    from ..plots.picture import Figure


@dataclass(frozen=True, eq=False)
class Outcome:
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

    @property
    def converged(self) -> bool:
        """Whether the contact, every step of its path and its couplings reached their tolerances."""
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

    @property
    def sections(self) -> Iterator[tuple[Part, Words]]:
        """Every part with words, and these."""
        for part in self.parts:
            if part.name in self.found and (
                words := self.found[part.name].words or part.words(self.found[part.name], self.solved)
            ):
                yield part, words

    @cached_property
    def figures(self) -> dict[str, tuple[Figure, ...]]:
        """Figures of each part, by its name."""
        return {
            part.name: part.figures(self.found[part.name], self.solved)
            for part in self.parts
            if part.name in self.found
        }

    @cached_property
    def pictures(self) -> tuple[Figure, ...]:
        """Figures of the contact itself."""
        from ..plots.contact import contact_figures

        return contact_figures(self.result)

    @property
    def all_figures(self) -> tuple[Figure, ...]:
        """Those of the contact and of all parts."""
        return (*self.pictures, *chain.from_iterable(self.figures.values()))

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers behind the numbers."""
        return tuple(dict.fromkeys(key for found in self.found.values() for key in found.citation_keys))


@dataclass(eq=False)
class Warm:
    """What cases that differ in their load alone share: the prepared operator, and the contacts solved so far."""

    operator: Operator | None = None
    last: ContactResult | None = None

    def state(self) -> InterfaceState | None:
        """A virgin interface with the pressures that the last contacts suggest."""
        last = self.last
        return (
            None if last is None else InterfaceState(last.pressure, earlier=last.earlier, deflections=last.deflections)
        )


def run(
    document: ProblemDocument | Mapping[str, Any] | str | os.PathLike[str],
    base_folder: str | os.PathLike[str] | None = None,
    *,
    parts: Iterable[object] = (),
    stage: Stage = no_stage,
    on_failure: Literal["raise", "return"] = "raise",
) -> Outcome:
    """Solve the problem of a document and carry out every analysis that it requests.

    Parameters
    ----------
    document
        Path of a TOML or JSON file, the name of one of this package (``document.PRESETS``), its content as nested dictionaries, or a document as ``load_document`` gives it. With a table
        ``[tractions]`` it prescribes loads on a body, without any contact, and the ``result`` is a ``LoadedBody``.
    base_folder
        Where relative paths in the document start; by default the folder of the file, or the working folder.
    parts
        Parts of your own that no installed package adds, each a ``Part``: their tables may stand in the document, and their values are
        in the outcome as those of other parts are.
    stage
        Gives the progress of the stage of that name.
    on_failure
        ``"raise"`` a ConvergenceError if the solve does not converge, or ``"return"`` it with its status.

    Raises
    ------
    InputError
        If the document has problems, or requests something that its problem does not have, or a part cannot be used.
    NoSolutionError
        If the load has no solution.
    ConvergenceError
        If the solve does not converge and ``on_failure`` is ``"raise"``.
    """
    folder = Path() if base_folder is None else Path(base_folder)
    where = "problem document"
    if isinstance(document, str | os.PathLike):
        folder, where = Path(document).parent if base_folder is None else folder, f"{where} {document}"
        document = read_table(document)
    if isinstance(document, Mapping) and TRACTIONS in document:
        from .tractions import checked_tractions, run_tractions

        return run_tractions(checked_tractions(document, where), folder, stage=stage)
    known = with_own(parts)
    if not isinstance(document, ProblemDocument):
        document = checked(document, where, known=known)
    return execute(build(document, folder, known), stage=stage, on_failure=on_failure)


def execute(
    case: Case,
    *,
    warm: Warm | None = None,
    wanted: Iterable[str] | None = None,
    lines: bool = True,
    threads: int | None = None,
    stage: Stage = no_stage,
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
        Names of the quantities that are wanted, so that costly ones may be left out; all by default.
    lines
        Whether parts keep the fields that only pictures show.
    threads
        Number of threads instead of that of the document.
    stage, on_failure
        As for ``run``.
    """
    names = None if wanted is None else frozenset(wanted)
    solving = _Solving(case, warm or Warm(), threads or case.threads, names, lines, stage, on_failure)
    solved = solving.solved()
    status = solved.result.status
    found, failed = _found(case.asks, solved, case.parts)
    findings = (*(finding for item in found.values() for finding in item.findings), *failed)
    statuses = [item.status for item in found.values() if item.status is not None]
    worst = next((item for item in statuses if not item.converged), next(iter(statuses), status))
    return Outcome(case, replace(solved, found=found), found, findings, worst if status.converged else status)


def analysed(
    result: ContactResult, asks: Mapping[str, Any], path: HistoryResult | None = None, **options: Any
) -> Outcome:
    """What the parts that are asked for find in a ``result`` that was solved before, the end of ``path`` if one is given.

    ``options`` are fields of ``Solved``.
    """
    solved = Solved(result.problem, result.control, result, path, **options)
    found, failed = _found(asks, solved, parts())
    findings = (*(finding for item in found.values() for finding in item.findings), *failed)
    return Outcome(None, replace(solved, found=found), found, findings, result.status)


def _found(
    asks: Mapping[str, Any], solved: Solved, known: tuple[Part, ...]
) -> tuple[dict[str, Found], tuple[Advice, ...]]:
    """What the parts find in a ``solved`` contact; a part that fails is a finding and ends no other, unless it is essential."""
    found: dict[str, Found] = {}
    failed: list[Advice] = []
    for part in known:
        if part.name in asks and _is_wanted(part, solved.wanted):
            try:
                found[part.name] = part.compute(asks[part.name], replace(solved, found=found))
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


def _is_wanted(part: Part, wanted: frozenset[str] | None) -> bool:
    """Whether the ``part`` has a quantity that costs nothing, or is ``wanted``."""
    return wanted is None or any(not item.costly or item.name in wanted for item in part.quantities)


@dataclass(frozen=True, eq=False)
class _Solving:
    """One case on its way through the solver."""

    case: Case
    warm: Warm
    threads: int | None
    wanted: frozenset[str] | None
    lines: bool
    stage: Stage
    on_failure: Literal["raise", "return"]

    def solved(self) -> Solved:
        """The contact with all its physics, at the end of the load path if there is one."""
        case = self.case
        path, result = self._path() if case.path else (None, self._single())
        return Solved(
            case.problem,
            case.control,
            result,
            path,
            solver=case.solver,
            threads=self.threads,
            wanted=self.wanted,
            lines=self.lines,
            stage=self.stage,
        )

    @property
    def _stiffness(self) -> bool:
        return self.wanted is None or STIFFNESS in self.wanted

    def _options(self) -> dict[str, Any]:
        if self.warm.operator is None:
            problem, engine = self.case.problem, self.case.engine(self.threads)
            self.warm.operator = prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
        options: dict[str, Any] = {
            "operator": self.warm.operator,
            "on_failure": self.on_failure,
            "solver": self.case.solver,
        }
        for part in self.case.parts:
            options |= part.options(self.case.asks[part.name]) if part.name in self.case.asks else {}
        return options

    def _single(self) -> ContactResult:
        case, keep = self.case, Keep(stiffness=self._stiffness)
        with self.stage("solving") as progress:
            state = self.warm.state()
            result = solve(case.problem, case.control, keep=keep, state=state, progress=progress, **self._options())
        self.warm.last = result
        return result

    def _path(self) -> tuple[HistoryResult | None, ContactResult]:
        """The load path, which is kept for pictures only, and its end."""
        case = self.case
        with self.stage(f"solving {len(case.path)} steps") as progress:
            stream = steps(case.problem, case.path, progress=progress, **self._options())
            whole = self.lines or any(part.whole_path for part in case.parts if part.name in case.asks)
            results = list(deque(stream, maxlen=None if whole else 1))
        last = results[-1]
        if self._stiffness and follows_from_pressure(last):
            results[-1] = replace(last, normal_stiffness=stiffness_of(last, operator=self.warm.operator))
        return (HistoryResult(tuple(results)) if len(results) == len(case.path) else None), results[-1]
