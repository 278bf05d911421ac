"""Worker processes and a Dask cluster: nothing is lost when a worker dies, and nothing is left
behind."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from refusals import refused
from study_cases import CRASHING, LOADS, PROBLEM, QUICK, SLOW, InProcess, plan, workers_of

import asperity as asp
from asperity.core.errors import InputError
from asperity.studies import local
from asperity.studies.cluster import DaskCluster
from asperity.studies.collect import dataset, state
from asperity.studies.local import LocalProcesses
from asperity.studies.run import carry_out
from asperity.studies.store import records

LONG = {"path": "surface.seed", "first": 1, "last": 40, "count": 40}


linux = pytest.mark.skipif(
    not Path("/proc/self/stat").exists(), reason="processes are counted in /proc, which is Linux"
)


def by_key(path: Path) -> dict:
    return {record["key"]: record["values"] for record in records(path)}


@pytest.mark.slow
@linux
def test_a_worker_that_is_killed_loses_nothing(tmp_path):
    made = plan(axes=[LONG])
    carry_out(made, tmp_path / "straight.log", InProcess(), function=QUICK)
    killed = []

    class Killer:
        def update(self, done: int, failed: int, found: int, total: int) -> None:
            if done in (2, 9):
                killed.append(min(workers_of(os.getpid())))
                os.kill(killed[-1], signal.SIGKILL)

    summary = carry_out(made, tmp_path / "killed.log", LocalProcesses(2), function=SLOW, watch=Killer())
    assert len(killed) == 2
    assert (summary.done, summary.failed) == (40, 0)
    assert by_key(tmp_path / "killed.log") == by_key(tmp_path / "straight.log")
    assert workers_of(os.getpid()) == set(), "no worker is left"


@linux
def test_closing_stops_the_workers_before_they_have_done_all():
    tasks = ({"cases": [], "quantities": [], "number": number} for number in range(100))
    stream = LocalProcesses(2).run(SLOW, tasks)
    next(stream)
    stream.close()
    assert workers_of(os.getpid()) == set()
    assert next(tasks)["number"] < 6, "tasks are taken one by one"


def test_cases_that_end_their_worker_are_failed_records_grouped_by_cause(tmp_path):
    made = plan(axes=[{**LONG, "count": 6, "last": 6}])
    summary = carry_out(made, tmp_path / "r.log", LocalProcesses(2), function=CRASHING)
    doomed = [case.key for path in made.paths() for case in path if int(case.key[1], 16) < 8]
    assert 0 < len(doomed) < 6, "the test needs both kinds"
    assert (summary.done, summary.failed) == (6, len(doomed))
    (cause,) = state(made, tmp_path / "r.log").causes
    assert (cause.kind, cause.count) == ("WorkerLost", len(doomed))
    assert cause.first.message == "the worker ended with exit code 7: out of luck"
    data = dataset(made, tmp_path / "r.log")
    assert int((data["outcome"] == 1).sum()) == int(data["approach"].isnull().sum()) == len(doomed)


def test_one_process_serves_all_cases_of_a_worker(tmp_path, monkeypatch):
    """Starting Python takes as long as hundreds of answers: 20 cases of one worker start it once,
    and each is sent once."""
    started, sent = [], []

    class Process(subprocess.Popen):
        def __init__(self, *args, **options):
            super().__init__(*args, **options)
            started.append(self.pid)
            write = self.stdin.write
            self.stdin.write = lambda order: (sent.append(json.loads(order)["task"]["cases"][0]["key"]), write(order))[
                1
            ]

    monkeypatch.setattr(local.subprocess, "Popen", Process)
    made = plan(axes=[{**LONG, "count": 20, "last": 20}])
    carry_out(made, tmp_path / "r.log", LocalProcesses(1), function=QUICK)
    assert len(started) == 1
    assert sorted(sent) == sorted(case.key for path in made.paths() for case in path)
    assert len(sent) == 20


def test_an_error_of_the_executor_itself_reaches_the_caller():
    tasks = iter([{"not json": object()}])
    with pytest.raises(TypeError, match="JSON"):
        list(LocalProcesses(1).run(QUICK, tasks))


def test_no_workers_are_refused():
    with refused(InputError, "number of workers", "1"):
        LocalProcesses(0)


class Cluster:
    """A scheduler and workers of their own on this machine, as a user would start them."""

    def __init__(self, folder: Path, workers: int) -> None:
        self._folder, self._scheduler_file = folder, folder / "scheduler.json"
        self._processes: list[subprocess.Popen[bytes]] = []
        self.scheduler = self._start("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--no-show")
        self.workers = [
            self._start("worker", "--nthreads", "1", "--no-nanny", "--no-dashboard", "--host", "127.0.0.1")
            for _ in range(workers)
        ]

    def _start(self, *words: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", "distributed.cli.dask_" + words[0], *words[1:]]
        command += ["--scheduler-file", str(self._scheduler_file)]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
        with (self._folder / "dask.txt").open("ab") as said:
            process = subprocess.Popen(command, stdout=said, stderr=said, env=environment, cwd=self._folder)
        self._processes.append(process)
        return process

    @property
    def address(self) -> str:
        while not self._scheduler_file.exists() or not self._scheduler_file.read_text().strip():
            assert self.scheduler.poll() is None, (self._folder / "dask.txt").read_text()
            time.sleep(0.05)
        return str(json.loads(self._scheduler_file.read_text())["address"])

    def stop(self) -> None:
        for process in reversed(self._processes):
            process.kill()
        for process in self._processes:
            process.wait()


@pytest.mark.slow
def test_a_cluster_gives_the_same_bits_also_when_a_worker_is_killed(tmp_path):
    """A real scheduler with two workers on loopback, one of which is killed amid the study; and
    worker processes here."""
    pytest.importorskip("distributed", reason="the extra dask is not installed")
    made = plan(axes=[{**LONG, "count": 8, "last": 8}, LOADS])
    cluster = Cluster(tmp_path, 2)
    killed = []

    class Killer:
        def update(self, done: int, failed: int, found: int, total: int) -> None:
            if done >= 6 and not killed:
                killed.append(cluster.workers[0])
                cluster.workers[0].kill()

    try:
        summary = carry_out(made, tmp_path / "dask.log", DaskCluster(cluster.address), watch=Killer())
    finally:
        cluster.stop()
    assert killed
    assert (summary.done, summary.failed) == (24, 0)
    carry_out(made, tmp_path / "local.log", LocalProcesses(2))
    assert by_key(tmp_path / "dask.log") == by_key(tmp_path / "local.log")
    for name, value in dataset(made, tmp_path / "local.log").data_vars.items():
        if name not in ("wall_time", "outcome"):
            assert value.notnull().all()


@pytest.mark.slow
def test_a_design_on_a_cluster_is_the_same(tmp_path):
    pytest.importorskip("distributed", reason="the extra dask is not installed")
    heights = {"path": "surface.spectrum.rms_height", "low": "0.5 nm", "high": "4 nm"}
    limits = [{"quantity": "mean_gap", "at_least": "1.5 nm"}]
    design = {"minimise": "max_pressure", "variables": [heights], "constraints": limits}
    table = {"version": 1, "problem": PROBLEM, "design": design}
    cluster = Cluster(tmp_path, 2)
    try:
        found = asp.optimise(table, dask=cluster.address)
    finally:
        cluster.stop()
    assert found.record() == asp.optimise(table).record()


def test_a_scheduler_that_does_not_answer_is_said(monkeypatch):
    distributed = pytest.importorskip("distributed", reason="the extra dask is not installed")

    class Silent:
        def __init__(self, *arguments: object, **options: object) -> None:
            raise OSError("Timed out trying to connect")

    monkeypatch.setattr(distributed, "Client", Silent)
    with refused(InputError, "Dask scheduler", "'tcp://127.0.0.1:1'"):
        next(DaskCluster("tcp://127.0.0.1:1").run(QUICK, iter([{}])))
