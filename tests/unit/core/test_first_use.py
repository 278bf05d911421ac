"""A second process compiles what the first solve in an environment needs, with the very types that
it needs."""

from __future__ import annotations

import os
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

SOLVE = """
import numpy as np
from numba.core import event

compiled = []


class Recorder(event.Listener):
    def on_start(self, what):
        pass

    def on_end(self, what):
        function = what.data["dispatcher"].py_func
        if function.__module__.startswith("asperity"):
            compiled.append(function.__name__)


event.register("numba:compile", Recorder())
import asperity as asp
surface = asp.Surface(np.random.default_rng(1).standard_normal((128, 128)), 1.0, periodic=True)
result = asp.solve(asp.ContactProblem(surface, asp.Elastic(1.0, 0.3)), asp.MeanPressure(0.01))
result.n_spots
print(*sorted(compiled))
"""

LATE = [
    "_around",
    "at_points",
    "fall",
    "gather",
    "add",
    "add_unclipped",
    "clear_tension",
    "gather_products",
    "products",
    "prolong_pressure",
    "scale_spectrum",
    "scatter",
    "scatter_add",
    "update_direction",
    "update_solution",
    "violation",
]


def printed(folder: Path, *arguments: str, threads: int = 1) -> str:
    variables = {**os.environ, "NUMBA_CACHE_DIR": str(folder), "ASPERITY_THREADS": str(threads)}
    done = subprocess.run([sys.executable, *arguments], env=variables, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.slow
def test_the_later_half_of_the_passes_is_compiled_with_the_types_of_a_solve(tmp_path: Path) -> None:
    """What the second process has compiled is found by a solve; alone, a solve compiles all of
    it."""
    alone = printed(tmp_path / "alone", "-c", SOLVE).split()
    printed(tmp_path / "beside", "-m", "asperity.core.engine.first_use")
    left = printed(tmp_path / "beside", "-c", SOLVE).split()
    assert Counter(alone) == Counter(left) + Counter(LATE)
    assert printed(tmp_path / "beside", "-c", SOLVE, threads=2).split() == []


FIRST_SOLVE = """
import os, subprocess, sys, threading
from pathlib import Path
if sys.argv[1] == "not compiled":
    os.environ["NUMBA_DISABLE_JIT"] = "1"
started = []
subprocess.call = lambda command, **unseen: started.append(command)
import numpy as np
import asperity as asp
from asperity.core.engine import CpuEngine

case = sys.argv[1]
if case == "frozen":
    sys.frozen = True
if case in ("compiled", "outdated"):
    from asperity.core.engine import kernels
    index = Path(kernels.survey.stats.cache_path) / "kernels.survey-1.py{0}{1}.1.nbi".format(*sys.version_info)
    index.parent.mkdir(parents=True, exist_ok=True)
    index.touch()
    if case == "outdated":
        os.utime(index, (1.0, 1.0))
for _ in range(2):
    CpuEngine().blocks.kernels
for thread in threading.enumerate():
    if thread is not threading.current_thread():
        thread.join()
print(*(command[-1] for command in started))
"""


@pytest.mark.parametrize(
    ("installed", "threads", "expected"),
    [
        ("plain", 2, "asperity.core.engine.first_use"),
        ("plain", 1, ""),
        ("frozen", 2, ""),
        ("not compiled", 2, ""),
        ("compiled", 2, ""),
        ("outdated", 2, "asperity.core.engine.first_use"),
    ],
)
def test_it_is_started_once_where_there_are_threads_and_an_interpreter(
    tmp_path: Path, installed: str, threads: int, expected: str
) -> None:
    """A frozen application would start itself; one thread has no second core to compile on; Numba
    may be told not to compile, or has done so from the same source."""
    assert printed(tmp_path, "-c", FIRST_SOLVE, installed, threads=threads).strip() == expected
