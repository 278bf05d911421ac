"""From the cases of one load path to records: built, solved, measured. This is what workers do."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import InputError
from ..io.description import software
from ..run.build import Case, build
from ..run.document import checked
from ..run.execute import Warm, execute
from .places import edited, from_plain
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
        self._built: Case | None = None
        self._warm = Warm()

    def record(self, case: Mapping[str, Any]) -> Record:
        """Record of one ``case``."""
        try:
            with warnings.catch_warnings(), np.errstate(all="ignore"):
                warnings.simplefilter("ignore")  # the findings of a case are in its record
                return {"key": case["key"], **self._answer(self._case(case["edits"])), "error": None}
        except Exception as error:
            failure = {"type": type(error).__name__, "message": " ".join(str(error).split())}
            return {"key": case["key"], "values": {}, "work": {}, "citations": [], "error": failure}

    def _case(self, edits: list[Any]) -> Case:
        document = checked(edited(self._table, map(from_plain, edits)), "problem of this case")
        if self._built is None:
            self._built = build(document, self._folder)
        return self._built.under(document)

    def _answer(self, case: Case) -> dict[str, Any]:
        outcome = execute(
            case,
            warm=self._warm,
            wanted=self._quantities,
            lines=False,
            threads=case.threads or 1,
            on_failure="raise",
        )
        values, certificate = outcome.values, outcome.result.certificate
        return {
            "values": {name: float(values.get(name, np.nan)) for name in self._quantities},
            "work": {name: getattr(certificate, name) for name in CHECKS},
            "citations": list(outcome.citation_keys),
            "findings": [[item.level, item.criterion, item.message] for item in outcome.findings],
        }
