"""What workers of a study do: the cases of one load path are built, solved and measured, and become
records."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import InputError
from ..core.words import speaking
from ..io.description import software
from ..run.build import Case, build
from ..run.document import checked
from ..run.execute import Warm, execute
from ..run.verdict import verdict
from .places import edited, from_plain
from .slopes import slopes
from .store import Record

CHECKS = ("duality_gap", "field_error", "penetration", "load_imbalance", "iterations", "fft_pairs", "wall_time")
"""Entries of the certificate that are kept."""


def evaluate_path(task: Mapping[str, Any]) -> list[Record]:
    """Records of the cases of ``task``, which differ in the load alone, in its order.

    Each case starts from the virgin surfaces; one with a load path follows it, and its last step
    counts. The operator is prepared once, and the pressures of the cases before are the first
    guess. A case that fails is a record with its exception.

    Parameters
    ----------
    task
        ``table`` of the base problem, ``folder`` at which its relative paths start, ``quantities``,
        and ``cases`` with ``key`` and ``edits``, and the ``version`` of asperity: plain values, so
        that it can be sent to another machine. With ``slopes``, paths of scalars, records hold the
        derivatives of the quantities ``sloped`` to these too, where there are any.

    Raises
    ------
    InputError
        If this is another version of asperity than the one that gives the task.
    """
    own = software()["asperity"]
    if task["version"] != own:
        raise InputError(
            f"workers of a study must have the version {task['version']} of asperity, but one has {own}; "
            "install the same."
        )
    quantities, warm = tuple(task["quantities"]), Warm()
    built: Case | None = None
    made: list[Record] = []
    for case in task["cases"]:
        try:
            with warnings.catch_warnings(), np.errstate(all="ignore"), speaking("python"):
                warnings.simplefilter("ignore")  # the findings of a case are in its record
                document = checked(edited(task["table"], map(from_plain, case["edits"])), "problem of this case")
                if built is None:
                    built = build(document, Path(task["folder"]))
                now = built.under(document)
                threads = now.threads or 1
                outcome = execute(now, warm=warm, wanted=quantities, lines=False, threads=threads, on_failure="raise")
                values, certificate = outcome.values, outcome.result.certificate
                with speaking("kept"):
                    given = verdict(outcome)
                record: Record = {
                    "key": case["key"],
                    "values": {name: float(values.get(name, np.nan)) for name in quantities}
                    | slopes(outcome, task.get("sloped", ()), task.get("slopes", ())),
                    "work": {name: getattr(certificate, name) for name in CHECKS},
                    "citations": list(outcome.citation_keys),
                    "findings": [
                        [one.level, one.criterion, f"{one.fact} {one.remedy}".rstrip()] for one in outcome.findings
                    ],
                    "verdict": [given.grade, *(text for _, text in given.rows)],
                    "error": None,
                }
        except Exception as error:
            failure = {"type": type(error).__name__, "message": " ".join(str(error).split())}
            record = {"key": case["key"], "values": {}, "work": {}, "citations": [], "error": failure}
        made.append(record)
    return made
