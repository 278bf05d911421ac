"""The normal contact on a GPU from the command line and from documents; the GPU is emulated."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from cli.conftest import BODY, LOAD, SCALE, Runner
from emulated_gpu import EmulatedGpu
from refusals import subject_of

from asperity.io.results import load
from asperity.run import build
from asperity.run.document import load_document

pytestmark = pytest.mark.usefixtures("undrawn")


def test_a_contact_and_its_document_run_on_the_gpu(
    run: Runner, matrix: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(build, "GpuEngine", EmulatedGpu)
    tight = ("--tolerance", 1e-10)
    for machine in ("cpu", "gpu"):
        found = run("contact", matrix, *SCALE, *BODY, *LOAD, *tight, "--machine", machine, "--out", tmp_path / machine)
        assert found.exit_code == 0, found.stderr
    assert load_document(tmp_path / "gpu" / "problem.toml").solver.machine == "gpu"
    again = run("contact", "--from", tmp_path / "gpu" / "problem.toml", "--out", tmp_path / "again")
    assert again.exit_code == 0, again.stderr
    cpu, gpu, repeated = (load(tmp_path / name / "result.nc") for name in ("cpu", "gpu", "again"))
    np.testing.assert_array_equal(gpu.pressure, repeated.pressure)
    apart = np.linalg.norm(gpu.pressure - cpu.pressure) / np.linalg.norm(cpu.pressure)
    assert 0.0 < apart < 1e-5, "other roundings, the same contact"


def test_a_comparison_runs_on_the_gpu(run: Runner, matrix: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = []
    monkeypatch.setattr(build, "GpuEngine", lambda: made.append(EmulatedGpu()) or made[-1])
    compared = run("compare", matrix, *SCALE, *BODY, "--pressures", "1MPa..2MPa", "--loads", 2, "--machine", "gpu")
    assert compared.exit_code == 0, compared.stderr
    assert len(made) == 1


def test_without_cupy_it_is_refused(run: Runner, matrix: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "cupy", None)
    found = run("contact", matrix, *SCALE, *BODY, *LOAD, "--machine", "gpu")
    assert subject_of(found) == "library of GpuEngine"
