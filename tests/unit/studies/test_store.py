"""The append-only store: whole whatever happens, quick to open, small in memory."""

from __future__ import annotations

import errno
import hashlib
import os
import tracemalloc

import numpy as np
import pytest
from refusals import refused
from study_cases import QUICK, InProcess, plan

from asperity.core.errors import OutputError
from asperity.studies.collect import dataset
from asperity.studies.run import carry_out
from asperity.studies.store import Finished, Store, records


def record(number: int, *, failed: bool = False, value: float | None = None):
    key = hashlib.sha256(str(number).encode()).hexdigest()
    error = {"type": "ValueError", "message": "no"} if failed else None
    values = {} if failed else {"approach": float(number) if value is None else value}
    return {"key": key, "values": values, "work": {}, "citations": [], "error": error}


@pytest.fixture
def path(tmp_path):
    with Store(tmp_path / "r.log") as store:
        store.append(record(number) for number in range(3))
    return tmp_path / "r.log"


def test_records_come_back_exactly(path):
    odd = record(9, value=0.1 + 0.2)
    with Store(path) as store:
        store.append([odd])
    assert list(records(path)) == [record(0), record(1), record(2), odd]
    assert record(9)["key"] in Finished(path)
    assert record(8)["key"] not in Finished(path)


@pytest.mark.parametrize("cut", [1, 2, 30, 120])
def test_a_torn_last_record_is_dropped_and_written_anew(path, cut):
    whole = path.read_bytes()
    path.write_bytes(whole[:-cut])
    assert [r["key"] for r in records(path)] == [record(0)["key"], record(1)["key"]]
    with Store(path) as store:
        assert record(2)["key"] not in Finished(path)
        store.append([record(2)])
    assert path.read_bytes() == whole


def test_every_length_of_a_torn_file_is_read(path):
    whole = path.read_bytes()
    ends = [i + 1 for i, letter in enumerate(whole) if letter == ord("\n")]
    for length in range(len(whole)):
        path.write_bytes(whole[:length])
        assert len(list(records(path))) == sum(end <= length for end in ends)


def test_a_damaged_record_in_the_middle_is_missing_and_the_others_are_kept(path):
    text = bytearray(path.read_bytes())
    text[text.index(b"\n") + 120] ^= 1
    path.write_bytes(text)
    with Store(path) as store:
        assert [r["key"] for r in records(path)] == [record(0)["key"], record(2)["key"]]
        store.append([record(1)])
    assert len(Finished(path)) == 3


def test_a_failed_case_counts_unless_it_is_to_be_tried_again(path):
    with Store(path) as store:
        store.append([record(7, failed=True)])
    key = record(7)["key"]
    assert key in Finished(path)
    assert key not in Finished(path, retry=True)
    with Store(path) as store:
        store.append([record(7)])
    assert key in Finished(path, retry=True)
    assert Finished(path, quantity="approach").value(key) == 7.0


def test_two_processes_do_not_write_one_file(path):
    pytest.importorskip("fcntl", reason="the system has no file locks of this kind")
    with Store(path), refused(OutputError, f"results {path}", "process"):
        Store(path)
    with Store(path):
        pass


def test_a_folder_that_is_not_there_is_said(tmp_path):
    path = tmp_path / "none" / "r.log"
    with refused(OutputError, f"results {path}", os.strerror(errno.ENOENT)):
        Store(path)


RANDOM = [{"path": "surface.seed", "distribution": "seed"}]


def campaign(samples: int):
    return plan(monte_carlo={"seed": 1, "samples": samples, "random": RANDOM})


@pytest.mark.slow
def test_ten_thousand_finished_cases_are_reopened(tmp_path):
    made, path = campaign(10_000), tmp_path / "r.log"
    assert carry_out(made, path, InProcess(), function=QUICK).done == 10_000
    again = campaign(10_000)
    summary = carry_out(again, path, InProcess(), function=QUICK)
    assert (summary.done, summary.found) == (0, 10_000)
    data = dataset(again, path)
    assert data.sizes == {"sample": 10_000}
    assert np.isfinite(data["approach"]).all()


@pytest.mark.slow
def test_the_memory_of_a_run_hardly_grows_with_the_number_of_cases(tmp_path):
    """8 bytes for the key of each finished case are allowed, four times over while they are sorted,
    and nothing else."""
    peaks = {}
    for samples in (300, 3000):
        made, path = campaign(samples), tmp_path / f"{samples}.log"
        tracemalloc.start()
        carry_out(made, path, InProcess(), function=QUICK)
        first = tracemalloc.get_traced_memory()[1]
        tracemalloc.reset_peak()
        carry_out(made, path, InProcess(), function=QUICK)  # finds all
        peaks[samples] = (first, tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    for small, large in zip(peaks[300], peaks[3000], strict=True):
        assert large - small < 4 * (8 + 16) * 2700 + 0.2 * small
