"""Small studies, an executor without processes, and stand-ins for what workers do."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from asperity.studies.documents import study_from_table
from asperity.studies.executors import Task, call
from asperity.studies.plan import Plan, make_plan

PROBLEM: dict[str, Any] = {
    "version": 1,
    "surface": {
        "kind": "rough",
        "points": [32, 32],
        "size": "10 um",
        "seed": 1,
        "spectrum": {"kind": "gaussian", "rms_height": "1 nm", "correlation_length": "1 um"},
    },
    "body": "E=100GPa,nu=0.3,H=5GPa:100nm/E=200GPa,nu=0.3,H=9GPa",
    "control": {"mean_pressure": "2 MPa"},
}
"""A coated rough body on 32 x 32 points, solved in milliseconds."""

LOADS = {"path": "control.mean_pressure", "values": ["1 MPa", "2 MPa", "5 MPa"]}
SEEDS = {"path": "surface.seed", "values": [1, 2, 3, 4]}
QUICK, CRASHING, SLOW = ("study_cases:quick", "study_cases:crashing", "study_cases:slow")
"""Functions by the names that executors take."""


def study(**tables: Any) -> dict[str, Any]:
    """Table of a study of ``PROBLEM``."""
    return {"version": 1, "problem": PROBLEM, **tables}


def plan(folder: Path = Path(), **tables: Any) -> Plan:
    """Plan of a study of ``PROBLEM``."""
    return make_plan(study_from_table(study(**tables), folder))


def workers_of(parent: int) -> set[int]:
    """Living worker processes that the process ``parent`` has started (Linux)."""
    return {int(path.name) for path in Path("/proc").glob("[0-9]*") if _is_worker_of(path, parent)}


def _is_worker_of(process: Path, parent: int) -> bool:
    try:
        fields = (process / "stat").read_text().rpartition(")")[2].split()
        return int(fields[1]) == parent and fields[0] != "Z" and b"studies.worker" in (process / "cmdline").read_bytes()
    except OSError:  # it has ended meanwhile
        return False


class InProcess:
    """Executor that does everything at once, in this process."""

    def run(self, function: str, tasks: Iterator[Task]) -> Iterator[tuple[Task, Any]]:
        for task in tasks:
            yield task, call(function, task)


def quick(task: Task) -> list[dict[str, Any]]:
    """Records that hold the last four digits of the key as a number, without solving anything."""
    return [
        {
            "key": case["key"],
            "values": dict.fromkeys(task["quantities"], int(case["key"][-4:], 16) / 65536.0),
            "work": {},
            "citations": [],
            "error": None,
        }
        for case in task["cases"]
    ]


def slow(task: Task) -> list[dict[str, Any]]:
    """The same after a tenth of a second."""
    time.sleep(0.1)
    return quick(task)


def crashing(task: Task) -> list[dict[str, Any]]:
    """The same, but the process dies where the second digit of the key is one of the first half."""
    if int(task["cases"][0]["key"][1], 16) < 8:
        os.write(2, b"out of luck\n")
        os._exit(7)
    return quick(task)
