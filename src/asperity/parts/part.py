"""What a part is: one physics or analysis with its settings, what it computes, its quantities,
figures and words."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, TypeAlias

from ..core.errors import InputError
from ..core.registry import home
from ..core.status import NoProgress, Progress
from ..core.units import show

if TYPE_CHECKING:
    from ..contact.controls import Control, Step
    from ..contact.history import HistoryResult
    from ..contact.problem import ContactProblem
    from ..contact.result import ContactResult
    from ..contact.solvers.protocol import Solver
    from ..core.quantity import Quantity
    from ..core.settings import Settings
    from ..core.status import Advice, Status
    from ..plots.picture import Figure

Stage: TypeAlias = Callable[[str], AbstractContextManager[Progress]]
"""Gives the progress of the stage of that name."""

Rows: TypeAlias = list[tuple[str, str]]
"""Label and text of each row of a table."""


def no_stage(name: str) -> AbstractContextManager[Progress]:
    """Progress that reports nothing."""
    return nullcontext(NoProgress())


@dataclass(frozen=True)
class Table:
    """Headings and rows of text."""

    headings: tuple[str, ...]
    cells: tuple[tuple[str, ...], ...]


@dataclass(frozen=True, eq=False)
class Found:
    """What a part has found in a solved contact.

    Attributes
    ----------
    values
        Numbers, text and arrays by the names of the part's quantities, SI.
    detail
        The object they were taken from, for words, figures and files; None if there is none.
    findings
        What the user should know before using them.
    citation_keys
        Keys of the papers behind them.
    status
        How the part's own computation ended; None if it has no such thing.
    words
        Text of the part, where it comes from a file; None where it is still to be written.
    """

    values: Mapping[str, Any] = field(default_factory=dict)
    detail: Any = None
    findings: tuple[Advice, ...] = ()
    citation_keys: tuple[str, ...] = ()
    status: Status | None = None
    words: Words | None = None

    def columns(self, prefix: str) -> dict[str, Any]:
        """Values whose names begin with ``prefix``, as arrays of one dimension or more by the rest
        of their names."""
        import numpy as np

        return {
            name.removeprefix(prefix): np.atleast_1d(np.asarray(values))
            for name, values in self.values.items()
            if name.startswith(prefix)
        }


@dataclass(frozen=True, eq=False)
class Stored:
    """What a file keeps of a part beside the values of its quantities, for figures.

    ``fields`` are stress fields by name, or their planes one after the other; ``facts`` are numbers
    and text by name, as in JSON.
    """

    fields: Mapping[str, Any] = field(default_factory=dict)
    facts: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Solved:
    """A solved contact, as parts see it.

    Attributes
    ----------
    problem, control
        What was asked for; the control is the last of a load path.
    result
        The contact under it.
    path
        The load path that ends there, if there is one.
    found
        What earlier parts have found, by their names.
    solver, threads
        Method and number of threads for further solves; None for the default.
    wanted
        Names of the quantities that are asked for; None for all.
    lines
        Whether pictures will be drawn, so that a part keeps the fields that only these show.
    stage
        Gives the progress of a stage.
    """

    problem: ContactProblem
    control: Control
    result: ContactResult
    path: HistoryResult | None = None
    found: Mapping[str, Found] = field(default_factory=dict)
    solver: Solver | None = None
    threads: int | None = None
    wanted: frozenset[str] | None = None
    lines: bool = True
    stage: Stage = no_stage

    def at(self, step: float | str = "peak") -> Reached:
        """The contact at a ``step`` of the load path: ``"peak"`` for that of the largest force,
        ``"last"``, or its number from 1.

        Raises
        ------
        InputError
            If the path has no such step, or its steps were not kept.
        """
        if self.path is None:
            if not isinstance(step, str) and int(step) != 1:
                raise InputError(f"step must be one of a load path, but there is no path and it is {step:g}.")
            return Reached(self.result, 1, 1)
        steps = self.path.steps
        named = {"peak": self.path.peak + 1, "last": len(steps)}
        number = named[step] if isinstance(step, str) else int(step)
        if not 1 <= number <= len(steps):
            raise InputError(f"step must be from 1 to {len(steps)}, those of the load path, but is {number}.")
        return Reached(steps[number - 1], number, len(steps))

    def step_of(self, shown: Any) -> int | None:
        """Number, from 1, of the step of the load path that is ``shown``: a contact of the path, or
        that number itself.

        None for anything else, and where there is but one load.
        """
        if self.path is None or len(self.path.steps) < 2:
            return None
        if isinstance(shown, int):
            return shown if 1 <= shown <= len(self.path.steps) else None
        found = (number for number, step in enumerate(self.path.steps, 1) if step is shown)
        return next(found, len(self.path.steps) if shown is self.result else None)


def require_step(step: float | str, controls: Sequence[Any], what: str, last: str) -> None:
    """Refuse a ``step`` of the load path, as of ``Solved.at``, beyond the ``controls`` that are
    solved, before they are; ``what`` it is and how to ask for the ``last`` are said.

    Raises
    ------
    InputError
        If it is not among them.
    """
    most = max(1, len(controls))
    if not isinstance(step, str) and int(step) > most:
        raise InputError(
            f"{what} must be from 1 to {most}, those of the load, but is {step:g}; take the last ({last})."
        )


class Reached(NamedTuple):
    """The contact at one step: its ``number`` from 1, and how ``many`` steps there are."""

    result: ContactResult
    number: int
    many: int

    @property
    def where(self) -> str:
        """Step and load in words; empty where there are no others."""
        if self.many == 1:
            return ""
        return f"step {self.number} of {self.many}, mean pressure {show(self.result.mean_pressure, 'Pa')}"


@dataclass(frozen=True, eq=False)
class Words:
    """Text of a part for report and terminal.

    Attributes
    ----------
    sentence
        What matters most.
    headline
        Label and text of what people look for first.
    rows
        Label and text of settings and results.
    tables
        Further tables with their headings.
    remarks
        What to know before using the numbers.
    alarming
        Whether something does not hold.
    holds
        Whether the bodies hold: what yields, flows, cracks or wears, and where; empty where this is
        not what was asked.
    """

    sentence: str = ""
    headline: Rows = field(default_factory=list)
    rows: Rows = field(default_factory=list)
    tables: tuple[tuple[str, Table], ...] = ()
    remarks: tuple[str, ...] = ()
    alarming: bool = False
    holds: str = ""

    def __bool__(self) -> bool:
        return bool(self.sentence or self.holds or self.rows or self.tables or self.remarks)


class Work:
    """What is done for a part that is asked for: check, computation, words and figures. It holds no
    state."""

    citation_keys: ClassVar[tuple[str, ...]] = ()
    """Papers that its numbers rest on, whatever is asked for."""

    def check(self, ask: Any, problem: ContactProblem) -> None:
        """Refuse with an ``InputError`` what ``problem`` does not have, before it is solved."""

    def unknown(self, ask: Any, problem: ContactProblem) -> Mapping[str, str]:
        """Names of quantities that mean nothing for ``problem``, since it lacks data: each with
        what is missing, and how to give it."""
        return {}

    def course(self, ask: Any, controls: tuple[Step | Control, ...]) -> tuple[Step | Control, ...]:
        """The steps that are solved, for those that the load and the parts before this one ask
        for."""
        return controls

    def altered(self, ask: Any, problem: ContactProblem) -> ContactProblem:
        """The problem that is solved, where this part changes its bodies."""
        return problem

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Values of the quantities."""
        return Found()

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Figures for report and folder."""
        return ()

    def words(self, found: Found, solved: Solved) -> Words:
        """Sentence and tables for report and terminal."""
        return Words()

    def stored(self, found: Found) -> Stored:
        """What a file keeps for the figures."""
        return Stored()

    def restored(self, stored: Stored, solved: Solved) -> Any:
        """Detail of what was found, for the figures, from what a file has ``stored``."""
        return None

    def step(self, found: Found, solved: Solved) -> int | None:
        """Number, from 1, of the step of the load path that its words are about; None where they
        are about all of it, or say themselves."""
        return None

    def made_from(self, result: ContactResult) -> Found | None:
        """What it finds in a ``result`` alone, where that takes no settings; None where it is
        computed as ever."""
        return None

    def citations(self, ask: Any, problem: ContactProblem) -> tuple[str, ...]:
        """Keys of the papers that the numbers will rest on."""
        return self.citation_keys


class WithFacts(Work):
    """What is done for a part whose detail is numbers and text by name, which files keep as they
    are."""

    def stored(self, found: Found) -> Stored:
        """The detail."""
        return Stored(facts=found.detail or {})

    def restored(self, stored: Stored, solved: Solved) -> Any:
        """The same again."""
        return dict(stored.facts)


class Part(Work):
    """Base of all parts, which hold no state.

    A part is asked for by its ``table`` in the document, of which one part declares the
    ``settings`` and others may share them; without a table it is always asked for. A table with
    defaults for everything may be ``in_every_document``. Where what an ``essential`` part asks for
    cannot be computed, the run fails; of others that is a finding. The part is computed after the
    solve, in the order of the registry, and reads what the parts before it have found.

    All parts are imported with the first document, the help of the command line or the form: they
    declare, and what is done for them stands at ``work``, which is imported where the part is asked
    for. A part without ``work`` does it itself.
    """

    name: ClassVar[str] = ""
    title: ClassVar[str] = ""
    purpose: ClassVar[str] = ""
    """What it answers, one plain sentence for forms. A picture that forms show beside it, lines of
    the colour of the text, may stand beside the module as ``<table>.svg``."""
    table: ClassVar[str] = ""
    needs: ClassVar[str] = ""
    """Key that its table must give for the part to be asked for; empty where the table is
    enough."""
    settings: ClassVar[type[Settings] | None] = None
    in_every_document: ClassVar[bool] = False
    essential: ClassVar[bool] = False
    quantities: ClassVar[tuple[Quantity, ...]] = ()
    basic: ClassVar[tuple[str, ...]] = ()
    """Keys of its table whose options the help of a command shows first."""
    headline: ClassVar[str] = ""
    """Name of the quantity that the table of a study of many files shows where it is asked for;
    empty for none."""
    takes_friction: ClassVar[bool] = False
    """Whether friction is given for its sake. Where it is for no part, a command with friction asks
    for the stresses too."""
    static_friction: ClassVar[bool] = False
    """Whether what it adds gives the contact a static friction."""
    moved: ClassVar[Mapping[str, str]] = MappingProxyType({})
    """Keys of its table in documents of version 1, and where version 2 has them."""
    unmoved: ClassVar[Mapping[str, Any]] = MappingProxyType({})
    """What such a table says in version 2 where another table had the friction, and it had none."""
    work: ClassVar[str] = ""
    """Module and name of the ``Work`` of a part of this package, such as
    ``physics.rolling.work:RollingWork``."""
    sheet: ClassVar[tuple[str, str]] = ("", "")
    """Name of the table that a run leaves in its folder, for other programs, and the axis of the
    quantities that are its columns; empty for none."""
    whole_path: ClassVar[bool] = False
    """Whether it needs all steps of a load path."""
    answers: ClassVar[bool] = True
    """Whether its sentence says what was found, rather than how well."""
    of_result: ClassVar[str] = ""
    """Name of the coupling whose answer a result must have for the part to be made from the result
    alone; empty if that is not enough."""

    @property
    def at_work(self) -> Work:
        """What is done for the part."""
        made: Work = home(self.work)() if self.work else self
        return made

    @staticmethod
    def implied(document: Any, /) -> bool:
        """Whether a ``document`` without the table of this part asks for it, with the defaults of
        its settings."""
        return False

    def settings_in(self, document: Any) -> Any:
        """The settings that ``document`` holds in the table of this part; None if it holds none,
        True without a table."""
        found = document
        for key in filter(None, self.table.split(".")):
            found = getattr(found, key)
        if found is None and self.settings is not None and self.implied(document):
            return self.settings()
        if self.needs and found is not None and getattr(found, self.needs) is None:
            return None
        return found if self.table else True

    def asked(self, document: Any, folder: Path) -> Any:
        """What a ``document`` with the settings of this part, whose relative paths start at
        ``folder``, requests of it; None for nothing."""
        return self.settings_in(document)

    def coupling(self, ask: Any) -> Mapping[str, Any]:
        """By what this part joins the solve, by name; nothing for an analysis."""
        return {}

    def options(self, ask: Any) -> Mapping[str, Any]:
        """Keywords of ``solve`` that this part sets."""
        return {}
