"""From the cases of one load path to records: built, solved, measured. This is what workers do."""

from __future__ import annotations

import warnings
from collections import deque
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..contact.operators import Operator, prepare_operator
from ..contact.path import predicted, steps
from ..contact.result import ContactResult
from ..contact.sliding import solve_sliding
from ..contact.solve import Keep, solve
from ..contact.state import InterfaceState
from ..contact.wet import solve_wet
from ..contact.wet_result import WetContactResult
from ..contact.wetting import LiquidFilm
from ..core.engine import CpuEngine
from ..core.errors import InputError
from ..io.build import Case, build, build_load
from ..io.documents import checked
from ..io.provenance import software
from ..stress.survey import survey
from .edits import edited, from_plain
from .quantities import STIFFNESS, Solved, measure
from .store import Record

CHECKS = ("duality_gap", "field_error", "penetration", "load_imbalance", "iterations", "fft_pairs", "wall_time")
"""Entries of the certificate that are kept."""


def evaluate_path(task: Mapping[str, Any]) -> list[Record]:
    """Records of the cases of ``task``, which differ in the load alone, in its order.

    Each case starts from the virgin surfaces; one with a load path follows it, and its last step counts. The operator is
    prepared once, and the pressures of the cases before are the first guess. A case that fails is a record with its
    exception.

    Parameters
    ----------
    task
        ``table`` of the base problem, ``folder`` at which its relative paths start, ``quantities``, and ``cases`` with
        ``key`` and ``edits``, and the ``version`` of asperity: plain values, so that it can be sent to another machine.

    Raises
    ------
    InputError
        If this is another version of asperity than the one that gives the task.
    """
    own = software()["asperity"]
    if task["version"] != own:
        raise InputError(
            f"workers of a study must have the version {task['version']} of asperity, but one has {own}; install the same."
        )
    path = _LoadPath(task)
    return [path.record(case) for case in task["cases"]]


class _LoadPath:
    """What the cases of a path share, kept from one to the next."""

    def __init__(self, task: Mapping[str, Any]) -> None:
        self._table, self._folder = task["table"], Path(task["folder"])
        self._quantities = tuple(task["quantities"])
        self._keep = Keep(stiffness=STIFFNESS in self._quantities)
        self._built: Case | None = None
        self._operator: Operator | None = None
        self._last: list[ContactResult] = []

    def record(self, case: Mapping[str, Any]) -> Record:
        """Record of one ``case``."""
        try:
            with warnings.catch_warnings(), np.errstate(all="ignore"):
                warnings.simplefilter("ignore")  # what a case has to say is in its record
                return {"key": case["key"], **self._answer(self._case(case["edits"])), "error": None}
        except Exception as error:
            said = {"type": type(error).__name__, "message": " ".join(str(error).split())}
            return {"key": case["key"], "values": {}, "work": {}, "citations": [], "error": said}

    def _case(self, edits: list[Any]) -> Case:
        document = checked(edited(self._table, map(from_plain, edits)), "problem of this case")
        if self._built is None:
            self._built = build(document, self._folder)
        control, path = build_load(document.control)
        return replace(self._built, control=control, path=path)

    def _answer(self, case: Case) -> dict[str, Any]:
        wet = None if case.film is None else self._wetted(case, case.film)
        result = self._solved(case) if wet is None else wet.contact
        stress = None
        if case.stress is not None:
            stress = survey(case.stress, result, lines=False, threads=case.threads or 1)
        solved = Solved(case, result, stress, wet)
        return {
            "values": {name: measure(name).of(solved) for name in self._quantities},
            "work": {name: getattr(result.certificate, name) for name in CHECKS},
            "citations": list(
                dict.fromkeys((*(wet or result).citation_keys, *(() if stress is None else stress.citation_keys)))
            ),
        }

    def _solved(self, case: Case) -> ContactResult:
        stress = case.stress
        if stress is not None and stress.coupled and stress.friction:
            if case.path:
                raise InputError(
                    "stress.coupled must be left out with a load path: a coupled contact is solved for one load."
                )
            engine = CpuEngine(case.threads or 1)
            return solve_sliding(
                case.problem, case.control, stress.friction, direction=stress.direction, engine=engine
            ).contact
        if case.path:
            options: dict[str, Any] = {"solver": case.solver, "keep": self._keep, "operator": self._prepared(case)}
            return deque(steps(case.problem, case.path, **options), maxlen=1)[0]
        return self._loaded(case, self._keep)

    def _loaded(self, case: Case, keep: Keep) -> ContactResult:
        """Dry contact under the load of ``case``, started from the cases before."""
        options: dict[str, Any] = {"solver": case.solver, "keep": keep, "operator": self._prepared(case)}
        result = solve(case.problem, case.control, state=self._guess(case), **options)
        self._last = [*self._last[-1:], result]
        return result

    def _wetted(self, case: Case, film: LiquidFilm) -> WetContactResult:
        """Contact of ``case`` with its ``film``, which starts from the dry one of the same load."""
        start = _virgin(self._loaded(case, Keep(stiffness=False)).state)
        options: dict[str, Any] = {"solver": case.solver, "operator": self._prepared(case), "state": start}
        return solve_wet(case.problem, case.control, film, friction=case.friction, **options)

    def _prepared(self, case: Case) -> Operator:
        """Operator of all cases."""
        if self._operator is None:
            problem, engine = case.problem, CpuEngine(case.threads or 1)
            self._operator = prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
        return self._operator

    def _guess(self, case: Case) -> InterfaceState | None:
        """Virgin interface with the pressures that the cases before suggest."""
        if not self._last:
            return None
        return _virgin(predicted(case.problem, case.control, self._last))


def _virgin(state: InterfaceState) -> InterfaceState:
    """An interface never loaded, with the pressures of ``state`` as a first guess."""
    return InterfaceState(np.zeros(state.pressure.shape), state.pressure)
