"""The program without what only Linux and macOS have, and with what Windows refuses; the rest of
other systems is left to the hosted checks, which run there."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
import tomli_w
from study_cases import LOADS, study

SYSTEM = Path(__file__).parents[1] / "other_systems"
pytestmark = pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="open files are read from /proc (Linux)")

AGAIN = """
import sys
import numpy as np
import asperity as asp

path = sys.argv[1]
result = asp.load(path)
asp.save(result, path, overwrite=True)
pressure = np.array(asp.load(path).pressure)
assert np.array_equal(pressure, result.pressure)
"""
"""A result is read and written over its own file, from which its fields are read at first use."""


def python(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """What an interpreter of such a system prints, in the letters of its console."""
    paths = os.pathsep.join([str(SYSTEM), *filter(None, sys.path)])
    environment = {**os.environ, "PYTHONPATH": paths, "PYTHONIOENCODING": "cp1252"}
    command = [sys.executable, *arguments]
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, encoding="cp1252", timeout=240, check=False
    )


def program(folder: Path, *arguments: str) -> str:
    done = python(folder, "-m", "asperity", *arguments)
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr
    return done.stdout


def test_the_stand_in_refuses_what_windows_refuses(tmp_path: Path) -> None:
    """It would prove nothing if it refused nothing."""
    lines = {
        "import fcntl": "ModuleNotFoundError",
        "import os; os.fork()": "OSError",
        "import os; os.killpg(0, 0)": "AttributeError",
        "import signal; signal.SIGKILL": "AttributeError",
        "import os; f = open('a', 'w'); os.replace('a', 'b')": "PermissionError",
        "import os; os.mkdir('c'); f = open('c/a', 'w'); os.rename('c', 'd')": "PermissionError",
        "open('10:30', 'w')": "OSError",
    }
    for line, kind in lines.items():
        assert kind in python(tmp_path, "-c", line).stderr.splitlines()[-1], line


@pytest.mark.slow
def test_results_are_written_replaced_and_read(tmp_path: Path) -> None:
    program(tmp_path, "demo", "--out", "run")
    (tmp_path / "run" / "note.txt").write_text("kept", encoding="ascii")
    before = sorted(path.relative_to(tmp_path) for path in tmp_path.rglob("*"))
    program(tmp_path, "demo", "--out", "run", "--force")
    assert sorted(path.relative_to(tmp_path) for path in tmp_path.rglob("*")) == before
    program(tmp_path, "report", "run/result.nc", "--out", "run/report.html", "--force")
    program(tmp_path, "plot", "run/result.nc", "--out", "run/plots", "--force")
    program(tmp_path, "contact", "--from", "run/problem.toml", "--out", "run", "--force")
    again = python(tmp_path, "-c", AGAIN, "run/result.nc")
    assert again.returncode == 0, again.stderr


@pytest.mark.slow
def test_studies_run_on_workers_and_are_collected(tmp_path: Path) -> None:
    (tmp_path / "study.toml").write_text(tomli_w.dumps(study(axes=[LOADS])), encoding="utf-8")
    program(tmp_path, "run", "study.toml", "--workers", "2")
    assert "3" in program(tmp_path, "status", "study.toml")
    program(tmp_path, "collect", "study.toml")
    program(tmp_path, "collect", "study.toml")
