"""When a run can be explored in the application: ``python benchmarks/explore.py --sizes 512 1024``.

A coated path of 40 loads with friction and a vertical section, as a worker of the application runs
it, in a fresh process that imports nothing first. *Maps* can be explored after the first step, and
all steps of them so many seconds after the last; the whole *page*, with verdict, stresses and
tables, so many seconds after the stresses, while report, pictures and files are still written.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tables import add_option, made, show

DOCUMENT = """
version = 2
surface.kind = "rough"
surface.points = [{n}, {n}]
surface.size = "10 um x 10 um"
surface.seed = 1
surface.spectrum.kind = "self_affine"
surface.spectrum.hurst = 0.8
surface.spectrum.rms_height = "20 nm"
surface.spectrum.shortest_wavelength = "80 nm"
surface.spectrum.rolloff_wavelength = "2.5 um"
body = {{ layers = [{{ material = "DLC", thickness = "50 nm" }}], base = {{ material = "steel" }} }}
counter_body = {{ rigid = true }}
control = {{ path = {{ mean_pressure = ["200 MPa"], steps = {steps} }} }}
friction = {{ coefficient = 0.3 }}
stress = {{ sections = ["y=max"] }}
"""


def measured(n: int, steps: int) -> dict[str, float]:
    """Times of one run in this process, in s."""
    from asperity.web import progress, tasks

    ends: dict[str, float] = {}
    stage, reached = progress.Watch.stage, progress.Watch.reached
    first: list[float] = []
    solved = [0.0]

    @contextmanager
    def timed(self: Any, name: str) -> Iterator[Any]:
        with stage(self, name) as told:
            yield told
        ends[name] = time.perf_counter()

    def told(self: Any, contact: Any) -> None:
        solved[0] = time.perf_counter()
        reached(self, contact)
        first.append(time.perf_counter())

    progress.Watch.stage, progress.Watch.reached = timed, told  # type: ignore[method-assign, assignment]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        document = folder / "problem.toml"
        document.write_text(DOCUMENT.format(n=n, steps=steps), encoding="utf-8")
        places = {"out": "run", "views": "views", "progress": "progress"}
        task = {key: str(folder / place) for key, place in places.items()}
        start = time.perf_counter()
        answer = tasks.contact({"document": str(document), "folder": name, **task})
        if "error" in answer:
            raise SystemExit(answer["error"])
        end = time.perf_counter()
    solving = next(value for key, value in ends.items() if key.startswith("solving"))
    return {
        "first": first[0] - start,
        "solving": solving - start,
        "maps": first[-1] - solved[0],
        "stresses": ends["stresses"] - solving,
        "page": ends["making it explorable"] - ends["stresses"],
        "files": end - ends["making it explorable"],
    }


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024])
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--one", type=int, help=argparse.SUPPRESS)
    add_option(parser)
    given = parser.parse_args()
    if given.one:
        print(json.dumps(measured(given.one, given.steps)))
        return
    rows = []
    for n in given.sizes:
        command = [sys.executable, __file__, "--one", str(n), "--steps", str(given.steps)]
        runs = [
            json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()[-1])
            for _ in range(given.repeats)
        ]
        least = {key: min(run[key] for run in runs) for key in runs[0]}
        shown = [f"{least[key]:.2f}" for key in ("first", "solving", "maps", "stresses", "page", "files")]
        rows.append([str(n), *shown])
    columns = (
        "n",
        "first maps (s)",
        "40 steps solved (s)",
        "maps of all after them (s)",
        "stresses (s)",
        "page after them (s)",
        "files behind (s)",
    )
    show(made("explore", columns, rows), write=given.write)


if __name__ == "__main__":
    main()
