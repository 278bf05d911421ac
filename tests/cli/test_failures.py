"""Tracebacks only on demand, unforeseen errors, interruption."""

from __future__ import annotations

import importlib
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from cli.conftest import Runner

from asperity import ConvergenceError
from asperity.cli.interrupt import INTERRUPTED
from asperity.cli.main import INTERNAL_ERROR, diagnosis

pytestmark = pytest.mark.usefixtures("undrawn")


def test_debug_shows_the_traceback(run: Runner, tmp_path: Path) -> None:
    quiet = run("info", tmp_path / "none.txt")
    loud = run("--debug", "info", tmp_path / "none.txt")
    assert quiet.exit_code == loud.exit_code == 2
    assert "Traceback" not in quiet.stderr
    assert "Traceback" in loud.stderr
    assert loud.stderr.endswith(quiet.stderr)


def test_unforeseen_error_is_one_line(run: Runner, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError("two\nlines [/] with brackets")

    monkeypatch.setattr(importlib.import_module("asperity.cli.info"), "read_doubtful", broken)
    result = run("info", tmp_path / "x.txt")
    assert result.exit_code == INTERNAL_ERROR
    assert len(result.stderr.splitlines()) == 1
    assert "ZeroDivisionError" in result.stderr
    assert "[/]" in result.stderr
    assert "--debug" in result.stderr
    assert "broken" in run("--debug", "info", tmp_path / "x.txt").stderr


def test_codes() -> None:
    assert diagnosis(ConvergenceError("no"))[0] == 1
    assert diagnosis(MemoryError())[0] == 2
    assert diagnosis(RuntimeError())[0] == INTERNAL_ERROR


def test_interrupt_in_process(run: Runner, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("asperity.solvers.ActiveSet.step", interrupted)
    result = run("demo", "--out", tmp_path / "run")
    assert result.exit_code == INTERRUPTED
    assert len(result.stderr.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


LONG = """
version = 1
[surface]
kind = "rough"
points = [1024, 1024]
size = "20 um"
seed = 1
[surface.spectrum]
kind = "exponential"
rms_height = "1 nm"
correlation_length = "0.5 um"
[body]
youngs_modulus = "100 GPa"
poisson_ratio = 0.3
[control]
mean_gap = "1 nm"
[solver]
tolerance = 1e-30
max_iterations = 1000000
"""


INTERRUPTING = """
import runpy, sys

class Interrupt:
    def find_spec(self, name, path=None, target=None):
        if name == late:
            sys.meta_path.remove(self)
            raise KeyboardInterrupt

late = sys.argv.pop()
sys.meta_path.insert(0, Interrupt())
runpy.run_module("asperity", run_name="__main__", alter_sys=True)
"""


@pytest.mark.parametrize("late", ["typer", "rich.console", "numpy", "scipy", "asperity.contact.solve", "matplotlib"])
def test_ctrl_c_while_libraries_are_imported(late: str, tmp_path: Path) -> None:
    """As in the middle of the work: an interrupt at whichever import ends with 130 and one
    sentence."""
    command = [sys.executable, "-c", INTERRUPTING, "demo", "--out", "run", late]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == INTERRUPTED, done.stderr
    assert done.stderr.endswith("asperity: Interrupted: the work was stopped and nothing is half-written.\n")
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "run").exists()


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to another process")
def test_ctrl_c_in_the_middle_of_a_solve_leaves_nothing(tmp_path: Path) -> None:
    (tmp_path / "long.toml").write_text(LONG)
    code = (
        "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "from asperity.cli.main import run; run()"
    )
    command = [sys.executable, "-c", code, "contact", "--from", "long.toml", "--out", "run"]
    with subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        deadline = time.monotonic() + 60.0
        while len(list(tmp_path.iterdir())) < 2 and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.05)
        partial = [path.name for path in tmp_path.iterdir() if path.name != "long.toml"]
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        out, error = process.communicate(timeout=60)
    assert len(partial) == 1, error
    assert process.returncode == INTERRUPTED
    assert error == "asperity: Interrupted: the work was stopped and nothing is half-written.\n"
    assert out == ""
    assert [path.name for path in tmp_path.iterdir()] == ["long.toml"]
