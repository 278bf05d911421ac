"""The commands run, status and collect: resumable whatever stops them, with exit codes and
files."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import tomli_w
import xarray
from cli.conftest import Runner
from refusals import subject_of
from study_cases import LOADS, PROBLEM, SEEDS, study, workers_of

from asperity.cli.campaigns import BETWEEN_LINES, Lines, Pace, duration, watched
from asperity.studies.campaign import open_study, prepare_study
from asperity.studies.store import records

ELASTIC = {**PROBLEM, "law": {"kind": "hardness", "hardness": "1 GPa"}}


def written(folder: Path, **tables) -> Path:
    path = folder / "s.toml"
    path.write_text(tomli_w.dumps({**study(), **tables}), encoding="utf-8")
    return path


def started(path: Path, workers: int) -> subprocess.Popen[str]:
    """The program on the study at ``path`` as a process of its own, in a group of its own as in a
    terminal.

    A shell starts what runs in the background with SIGINT ignored, and children inherit that: the
    handler is set first.
    """
    program = (
        "import runpy, signal; signal.signal(signal.SIGINT, signal.default_int_handler); "
        "runpy.run_module('asperity', run_name='__main__', alter_sys=True)"
    )
    command = [sys.executable, "-c", program, "run", str(path), "--workers", str(workers)]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    return subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment, start_new_session=True
    )


def wait_for_records(log: Path, count: int, process: subprocess.Popen[str]) -> None:
    while len(list(records(log))) < count:
        assert process.poll() is None, process.communicate()
        time.sleep(0.02)


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="processes are counted in /proc, which is Linux")
def test_a_kill_at_any_moment_loses_nothing_that_was_finished(tmp_path, run: Runner):
    """Killed by -9 twice, then finished: every case is computed once, and the workers end with
    their driver."""
    seeds = {"path": "surface.seed", "first": 1, "last": 60, "count": 60}
    problem = {**PROBLEM, "surface": {**PROBLEM["surface"], "points": [96, 96]}}
    path = written(tmp_path, problem=problem, axes=[seeds])
    log = tmp_path / "s-results" / "records.log"
    for kill in (1, 2):
        process = started(path, 2)
        wait_for_records(log, len(list(records(log))) + kill * 3, process)
        orphans = workers_of(process.pid)
        assert len(orphans) == 2
        process.send_signal(signal.SIGKILL)
        process.communicate()
        deadline = time.monotonic() + 20.0
        while any(Path(f"/proc/{orphan}").exists() for orphan in orphans) and time.monotonic() < deadline:
            time.sleep(0.05)
        assert not any(Path(f"/proc/{orphan}").exists() for orphan in orphans), "workers end with their driver"
    found = [record["key"] for record in records(log)]
    assert 9 <= len(found) < 60
    result = run("run", path)
    assert result.exit_code == 0, result.output
    assert str(60 - len(found)) in result.stdout
    assert str(len(found)) in result.stdout
    keys = [record["key"] for record in records(log)]
    assert keys[: len(found)] == found
    assert len(keys) == len(set(keys)) == 60


@pytest.mark.slow
def test_ctrl_c_leaves_a_resumable_state(tmp_path):
    seeds = {"path": "surface.seed", "first": 1, "last": 2000, "count": 2000}
    path = written(tmp_path, axes=[seeds])
    process = started(path, 1)
    log = tmp_path / "s-results" / "records.log"
    wait_for_records(log, 3, process)
    os.killpg(process.pid, signal.SIGINT)
    out, error = process.communicate(timeout=30)
    assert process.returncode == 130, error
    assert f"asperity run {path}" in out
    assert "Traceback" not in error
    state = open_study(path).state()
    assert 3 <= state.done < 2000
    assert (state.failed, state.missing) == (0, 2000 - state.done)


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A study of two loads and two seeds, one load of which is beyond the hardness."""
    folder = tmp_path_factory.mktemp("finished")
    loads = {**LOADS, "values": ["1 MPa", "2 GPa"]}
    path = written(folder, title="Loads", problem=ELASTIC, axes=[{**SEEDS, "values": [1, 2]}, loads])
    from typer.testing import CliRunner

    from asperity.cli.main import app

    return path, CliRunner().invoke(app, ["run", str(path), "--workers", "1"])


def test_failed_cases_are_grouped_and_told_by_the_exit_code(finished):
    path, result = finished
    assert result.exit_code == 1, result.output
    assert "NoSolutionError: " in result.stdout
    state = open_study(path).state()
    assert (state.done, state.failed, state.missing) == (2, 2, 0)
    assert [(cause.kind, cause.count) for cause in state.causes] == [("NoSolutionError", 2)]


def test_what_a_run_leaves(finished):
    path, _ = finished
    folder = path.with_name("s-results")
    assert {item.name for item in folder.iterdir()} == {
        "study.toml", "records.log", "results.nc", "cases.csv", "plots", "report.html",
    }  # fmt: skip
    with xarray.open_dataset(folder / "results.nc", engine="h5netcdf") as data:
        told = {name: text for name, text in data["max_pressure"].attrs.items() if name != "sha256"}
        assert told == {"units": "Pa", "long_name": "maximum pressure"}
        assert data["control_mean_pressure"].attrs["units"] == "Pa"
        assert data.attrs["title"] == "Loads"
        assert "[[axes]]" in data.attrs["study"]
        assert "asperity" in data.attrs["software"]
    lines = (folder / "cases.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0].startswith("seed,control_mean_pressure,area_fraction_corrected,")
    assert len(lines) == 5
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "http://" not in page.replace("http://www.w3.org", "")


def test_status_and_collect(finished, run: Runner):
    path, _ = finished
    said = run("status", path.with_name("s-results"))
    assert said.exit_code == 0
    again = run("collect", path)
    assert again.exit_code == 1
    assert "report.html" in again.stdout


def test_a_study_that_has_not_been_run(tmp_path, run: Runner):
    said = run("status", tmp_path)
    assert subject_of(said) == "results of a study"


def test_a_bad_path_is_refused_before_anything_is_written(tmp_path, run: Runner):
    path = written(tmp_path, axes=[{"path": "control.pressure", "values": ["1 MPa"]}])
    said = run("run", path)
    assert subject_of(said) == "path"
    assert "control.mean_pressure" in said.stderr
    assert sorted(item.name for item in tmp_path.iterdir()) == ["s.toml"]


def test_a_folder_with_other_things_is_left_alone(tmp_path, run: Runner):
    path = written(tmp_path, axes=[LOADS])
    said = run("run", path, "--out", tmp_path)
    assert subject_of(said) == "folder of a study"
    assert [item.name for item in tmp_path.iterdir()] == ["s.toml"]


def test_a_problem_may_be_a_file_and_the_folder_may_move(tmp_path):
    (tmp_path / "base").mkdir()
    (tmp_path / "base" / "a.txt").write_text("1 2 3\n2 1 2\n3 2 9\n")
    surface = {"kind": "file", "path": "a.txt", "size": "3 um", "height_unit": "nm"}
    (tmp_path / "base" / "p.toml").write_text(tomli_w.dumps({**PROBLEM, "surface": surface}), encoding="utf-8")
    path = tmp_path / "s.toml"
    path.write_text(tomli_w.dumps({"version": 1, "problem": "base/p.toml", "axes": [LOADS]}), encoding="utf-8")
    campaign = prepare_study(path, tmp_path / "deep" / "er")
    again = open_study(tmp_path / "deep" / "er")
    keys = [[case.key for way in made.plan.paths() for case in way] for made in (campaign, again)]
    assert keys[0] == keys[1]


def test_lines_say_rate_and_time_left_now_and_then():
    now, said = [0.0], []
    lines = Lines(said.append, lambda: now[0])
    for done in range(1, 41):
        now[0] += 1.0
        lines.update(done, 2 if done > 15 else 0, 10, 50)
    assert len(said) == 40 / BETWEEN_LINES
    assert said[0] == "20 of 50 cases, 1 cases/s, 30 s left"
    assert said[1] == "30 of 50 cases, 2 failed, 1 cases/s, 20 s left"
    assert said[-1] == "50 of 50 cases, 2 failed, 1 cases/s, 0 s left"


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(3.2, "3 s"), (125.0, "2 min 05 s"), (4800.0, "1 h 20 min"), (float("inf"), "unknown time")],
)
def test_durations(seconds, text):
    assert duration(seconds) == text


def test_pace_before_the_first_case():
    assert Pace(lambda: 0.0).text(0, 0, 0, 5) == ("0 of 5 cases, 0 cases/min, unknown time left", 0.0)


def test_quiet_shows_no_progress(tmp_path, run: Runner):
    said = run("run", written(tmp_path, axes=[LOADS]), "--workers", 1, "--quiet")
    assert (said.exit_code, said.stdout) == (0, "")
    assert " of 3 cases" not in said.stderr
    assert "cases/min" not in said.stderr


def test_records_of_a_changed_study_are_not_counted(tmp_path, run: Runner):
    folder = tmp_path / "results"
    assert run("run", written(tmp_path, axes=[LOADS]), "--out", folder, "--workers", 1).exit_code == 0
    other = {**LOADS, "values": ["1 MPa", "3 MPa", "4 MPa"]}
    said = run("run", written(tmp_path, axes=[other]), "--out", folder, "--workers", 1)
    assert said.exit_code == 0
    lines = [line for line in said.stderr.splitlines() if " of 3 cases" in line]
    assert len(lines) == 1, said.stderr
    assert ": 3 of 3 cases" in lines[0]


def test_a_bar_on_a_terminal(monkeypatch, capsys):
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    with watched("study") as watch:
        watch.update(1, 0, 2, 10)
    assert "\x1b[" in capsys.readouterr().err, "a bar moves the cursor"
