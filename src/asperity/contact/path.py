"""Load paths by their earlier name: histories of controls."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from .control import Control
from .history import HistoryResult
from .problem import ContactProblem
from .result import ContactResult
from .solve import steps as history_steps
from .state import InterfaceState


@dataclass(frozen=True, eq=False, repr=False)
class LoadPath(HistoryResult):
    """Results of the steps of a load path, in order."""

    @property
    def results(self) -> tuple[ContactResult, ...]:
        """One for each control."""
        return self.steps


def solve_path(problem: ContactProblem, controls: Iterable[Control], **options: Any) -> LoadPath:
    """Solve one control after the other, see ``solve`` with a ``History``."""
    return LoadPath(tuple(steps(problem, controls, **options)), options.get("state"))


def steps(problem: ContactProblem, controls: Iterable[Control], **options: Any) -> Iterator[ContactResult]:
    """Results of ``solve_path`` one by one."""
    return history_steps(problem, controls, **options)


def predicted(problem: ContactProblem, control: Control, last: list[ContactResult]) -> InterfaceState:
    """Interface to start from after the ``last`` results."""
    earlier = last[-2].pressure if len(last) > 1 else None
    return InterfaceState(last[-1].pressure, last[-1].state.memory, earlier)
