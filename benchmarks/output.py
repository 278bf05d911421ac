"""What the files of a run take beside its solve: the whole command and ``asp.save`` alone, in
times of the solve, with the size of the result file and the largest memory.

A coated path of 40 loads with friction and a vertical section, as in ``explore.py``. Every run is a
fresh process, which also times its own solve; ratios are those of one process, their least and
median over the rounds are shown. Processor time counts imports and the processes that draw, and
other work on the machine matters little to it; by the clock some processes draw while another one
writes.

Usage: python benchmarks/output.py [--sizes 1024] [--steps 40] [--rounds 3] [--write]
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from explore import DOCUMENT
from tables import add_option, made, show


def now() -> tuple[float, float]:
    """Processor time of this process and those that have ended under it, and time by the clock."""
    return sum(os.times()[:4]), time.perf_counter()


def spent(started: tuple[float, float]) -> dict[str, float]:
    """Both since they ``started``."""
    return dict(zip(("processor", "clock"), (b - a for a, b in zip(started, now(), strict=True)), strict=True))


def command(folder: Path) -> dict[str, Any]:
    """Times in s of ``asperity contact --out`` in this process, from its imports to its end."""
    started = 0.0, time.perf_counter()  # Python itself and its imports count too
    from asperity.cli import contact, main

    solving, stage = list[dict[str, float]](), contact.stage

    @contextmanager
    def timed(name: str) -> Iterator[Any]:
        begun = now()
        with stage(name) as told:
            yield told
        if name.startswith("solving"):
            solving.append(spent(begun))

    contact.stage = timed
    words = ["contact", "--from", str(folder / "problem.toml"), "--out", str(folder / "run"), "--force", "--yes"]
    try:
        main.app(words)
    except SystemExit as ended:
        if ended.code:
            raise
    return {"solve": solving[0], "whole": spent(started), "bytes": (folder / "run" / "result.nc").stat().st_size}


def saved(folder: Path) -> dict[str, Any]:
    """Times in s of the solve and of ``asp.save`` of its path."""
    import asperity as asp
    from asperity.run.build import build
    from asperity.run.document import loads

    case = build(loads((folder / "problem.toml").read_text(encoding="utf-8")), folder)
    begun = now()
    path = asp.solve(case.problem, asp.History(case.path), solver=case.solver)
    solve, begun = spent(begun), now()
    asp.save(path, folder / "path.nc", overwrite=True)
    return {"solve": solve, "whole": spent(begun), "bytes": (folder / "path.nc").stat().st_size}


WAYS = {"command": command, "save": saved}


def measured(way: str, folder: Path) -> dict[str, Any]:
    """What one run of this ``way`` takes, in a process of its own."""
    words = [sys.executable, __file__, "--way", way, "--folder", str(folder)]
    printed = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    return dict(json.loads(printed.splitlines()[-1]))


def row(n: int, steps: int, way: str, rounds: int) -> list[str]:
    """Row of one ``way``."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "problem.toml").write_text(DOCUMENT.format(n=n, steps=steps), encoding="utf-8")
        runs = [measured(way, folder) for _ in range(rounds)]
    shown = []
    for by in ("processor", "clock"):
        solve, whole = (min(run[key][by] for run in runs) for key in ("solve", "whole"))
        ratios = [run["whole"][by] / run["solve"][by] for run in runs]
        shown += [f"{value:.2f}" for value in (solve, whole, min(ratios), statistics.median(ratios))]
    most = max(run["memory"] for run in runs)
    return [str(n), way, *shown, f"{runs[-1]['bytes'] / 1e6:.0f}", f"{most / 1e9:.2f}"]


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[1024])
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--ways", nargs="+", choices=list(WAYS), default=list(WAYS))
    parser.add_argument("--way", help=argparse.SUPPRESS)
    parser.add_argument("--folder", type=Path, help=argparse.SUPPRESS)
    add_option(parser)
    given = parser.parse_args()
    if given.way:
        found = WAYS[given.way](given.folder)
        usages = (resource.getrusage(who).ru_maxrss for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
        found["memory"] = 1024 * max(usages)
        print("\n" + json.dumps(found))
        return
    rows = [row(n, given.steps, way, given.rounds) for n in given.sizes for way in given.ways]
    times = [f"{text}, {by}" for by in ("processor", "clock") for text in ("solve (s)", "it (s)", "ratio", "median")]
    columns = ("n", "what", *times, "result file (MB)", "memory (GB)")
    show(made("output", columns, rows), write=given.write)


if __name__ == "__main__":
    main()
