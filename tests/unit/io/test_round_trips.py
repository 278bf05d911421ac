"""Every type of result comes back from its file to the bit, the state of every step too, and goes
on in a fresh process as if there had been no break."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, ClassVar

import h5py
import numpy as np
import pytest
from refusals import refused
from stored_cases import CASES, GO_ON, goes_on, ground, told

import asperity as asp
from asperity.contact.answer import Answer
from asperity.contact.couplings.protocol import Coupling, Exchange, Share
from asperity.contact.problem import Physics
from asperity.core.errors import FileFormatError
from asperity.core.quantity import measured

PROBLEM = asp.ContactProblem(ground(), asp.Elastic(1e11, 0.3))


def without(facts: dict[str, str], *names: str) -> dict[str, str]:
    return {key: value for key, value in facts.items() if key.rsplit(".", 1)[-1] not in names}


@pytest.fixture(scope="module")
def solved() -> dict[str, Any]:
    return {name: made() for name, made in CASES.items()}


@pytest.mark.parametrize("name", CASES)
def test_a_round_trip(name: str, solved: dict[str, Any], tmp_path: Path) -> None:
    result = solved[name]
    asp.save(result, tmp_path / "r.nc")
    again = asp.load(tmp_path / "r.nc")
    assert told(again) == told(result)
    asp.save(again, tmp_path / "again.nc")
    assert told(asp.load(tmp_path / "again.nc")) == told(result)


@pytest.mark.parametrize("name", ["wet", "adhesive", "creeping", "sticking", "flowing"])
def test_a_path_that_is_written_step_by_step(
    name: str, solved: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where later steps have what the first one has not, and some have it no more."""
    monkeypatch.setattr("asperity.io.paths.BLOCK", 1.0)
    path = solved[name]
    odd = path.steps[0]  # the energies of adhesion, and bodies that relax, are not known without
    if name not in ("adhesive", "creeping"):
        plain = asp.solve(replace(path.last.problem, physics=()), asp.Force(0.5 * path.last.force))
        odd = replace(plain, problem=path.last.problem, citation_keys=path.last.citation_keys)
    back = ("displacement", "gap")  # of pressures alone, to a rounding: test_path_files
    for steps in (path.steps, (odd, *path.steps, odd), (*path.steps, odd)):
        wanted = replace(path, steps=tuple(replace(step, earlier=None) if step is odd else step for step in steps))
        asp.save(wanted, tmp_path / "r.nc", overwrite=True)
        assert without(told(asp.load(tmp_path / "r.nc")), *back) == without(told(wanted), *back)
    asp.save(path, tmp_path / "whole.nc")
    assert told(asp.load(tmp_path / "whole.nc")) == told(path)


@pytest.mark.parametrize("step", [0, 1])
@pytest.mark.parametrize("name", ["wet", "adhesive", "creeping", "sticking", "flowing"])
def test_a_single_contact_and_its_state(name: str, step: int, solved: dict[str, Any], tmp_path: Path) -> None:
    result = solved[name][step]
    asp.save(result, tmp_path / "r.nc")
    assert told(asp.load(tmp_path / "r.nc")) == told(result)


@pytest.mark.parametrize("name", ["wet", "adhesive", "creeping", "sticking", "flowing", "single", *GO_ON])
def test_a_restart_in_a_fresh_process(name: str, solved: dict[str, Any], tmp_path: Path) -> None:
    """From the state of the first step of a path, or from another result, in another process: what
    follows to the bit."""
    path = solved[name]
    asp.save(path, tmp_path / "path.nc")
    code = (
        "import json, sys\nimport asperity as asp\nfrom stored_cases import goes_on, told\n"
        "found = goes_on(asp.load(sys.argv[1]), sys.argv[2])\njson.dump(told(found), sys.stdout)\n"
    )
    asked = [sys.executable, "-c", code, str(tmp_path / "path.nc"), name]
    places = [Path(__file__).parents[2], Path(asp.__file__).parents[1]]
    there = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, places))}
    done = subprocess.run(asked, capture_output=True, text=True, check=False, env=there)
    assert done.returncode == 0, done.stderr
    # the bound of the pressure's error is made of sums whose order may be another in a process that
    # has just begun
    times = ("wall_time", "peak_memory", "pressure_error")
    assert without(json.loads(done.stdout), *times) == without(told(goes_on(path, name)), *times)


# A physics of one's own.


@dataclass(frozen=True, eq=False)
class Glued(Answer):
    """Force of the glue, and where it is."""

    force: float = measured("N", "force of the glue")
    where: asp.core.arrays.RealArray = measured("1", "whether there is glue", "x", "y")

    def pulls(self) -> float:
        return self.force


@dataclass(frozen=True)
class GlueCoupling(Coupling):
    """A constant force."""

    force: float
    name: ClassVar[str] = "glue"
    feedback: ClassVar[bool] = False
    remedy: ClassVar[str] = ""

    def begin(self, posed: Any, memory: Any) -> Exchange:
        x = np.asarray(self.force)
        return Exchange(x, x, 0.0, 1.0)

    def share(self, exchange: Any) -> Any:
        return Share(load=self.force)

    def reply(self, exchange: Any, contact: Any) -> Any:
        return exchange

    def settled(self, exchange: Any) -> str:
        return "The glue holds"

    def unsettled(self, exchange: Any) -> str:
        return ""

    def end(self, exchange: Any, contact: Any) -> Any:
        memory = {"cured": np.arange(3.0), "count": np.asarray(2)}
        return memory, Glued(self.force, (contact.gap < 1e-9).astype(float))


@dataclass(frozen=True)
class TapeCoupling(GlueCoupling):
    """Another one."""

    name: ClassVar[str] = "tape"


@dataclass(frozen=True)
class Glue(Physics):
    """Glue of one's own."""

    force: float
    attracts: ClassVar[bool] = True

    def couplings(self, problem: Any, operator: Any, how: Any) -> Any:
        yield (TapeCoupling if isinstance(self, Tape) else GlueCoupling)(self.force)


@dataclass(frozen=True)
class Tape(Glue):
    """Another one."""


def test_two_physics_of_ones_own_stand_beside_each_other(tmp_path: Path) -> None:
    problem = asp.ContactProblem(PROBLEM.surface, PROBLEM.body, physics=[Glue(1e-7), Tape(2e-7)])
    path = asp.solve(problem, asp.History([asp.MeanPressure(p) for p in (1e8, 2e8)]))
    assert set(path.last.couplings) >= {"glue", "tape"}
    asp.save(path, tmp_path / "r.nc")
    again = asp.load(tmp_path / "r.nc")
    assert again.last.problem.physics == problem.physics
    back = ("displacement", "gap")  # of pressures alone, to a rounding: test_path_files
    assert without(told(again), *back) == without(told(path), *back)
    assert asp.files.open_tree(tmp_path / "r.nc")["path/couplings/tape/force"].values.tolist() == [2e-7, 2e-7]
    code = (
        "import sys, asperity as asp\ntry:\n    asp.load(sys.argv[1])\nexcept asp.errors.FileFormatError "
        "as error:\n    print(error)\n"
    )
    there = {**os.environ, "PYTHONPATH": str(Path(asp.__file__).parents[1])}
    asked = [sys.executable, "-c", code, str(tmp_path / "r.nc")]
    told_by = subprocess.run(asked, capture_output=True, text=True, check=True, env=there)
    assert "test_round_trips:Glue" in told_by.stdout


def test_an_answer_that_no_one_has_defined_is_refused(solved: dict[str, Any], tmp_path: Path) -> None:
    asp.save(solved["wet"], tmp_path / "r.nc")
    with h5py.File(tmp_path / "r.nc", "r+") as file:
        file["path/couplings/menisci"].attrs["kind"] = "os:system"
    with refused(FileFormatError, "answer in a result file", "'os:system'"):
        asp.load(tmp_path / "r.nc")
