"""Files of a load path: every step, labelled, with units; energies; a table."""

from __future__ import annotations

import csv
import gc
import json
import weakref
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from refusals import refused
from stored_cases import CASES, FILM, told

import asperity as asp
from asperity.contact.result import OF_EDGES, SCALARS
from asperity.contact.solve import steps
from asperity.core.errors import OutputError
from asperity.io.description import rebuild
from asperity.io.words import FIELDS

BACK = ("displacement", "gap")
"""Fields that come back from the pressures."""


@pytest.fixture(scope="module")
def path() -> asp.HistoryResult:
    noise = np.random.default_rng(7).standard_normal((16, 12))
    heights = sum(np.roll(noise, (i, j), (0, 1)) for i in range(3) for j in range(3)) * 1e-9
    surface = asp.Surface(heights, 2e-8, 1e-8, periodic=True)
    strong, soft = (asp.Elastic(1e11, 0.3, asp.Strength(hardness=h)) for h in (6e9, 3e9))
    body = asp.Layered([asp.Layer(strong, 2e-9)], soft)
    problem = asp.ContactProblem(surface, body, law=asp.plasticity.LayeredHardness(body))
    return asp.solve(problem, asp.History.ramps(asp.MeanPressure, [8e8, 0.0], steps=3))


def test_every_step_is_in_the_file(path: asp.HistoryResult, tmp_path: Path) -> None:
    asp.save(path, tmp_path / "path.nc", document="version = 1")
    data = asp.files.open_tree(tmp_path / "path.nc")["path"].to_dataset()
    assert {dim: data.sizes[dim] for dim in ("step", "x", "y")} == {"step": 6, "x": 16, "y": 12}
    assert asp.files.open_tree(tmp_path / "path.nc").attrs["document"] == "version = 1"
    for item in FIELDS:
        if item.name in BACK:
            assert item.name not in data
            continue
        assert data[item.name].attrs["units"] == item.unit
        for step, result in enumerate(path.steps):
            np.testing.assert_array_equal(data[item.name][step], getattr(result, item.name))
    assert data["rounding"].attrs["units"] == "m"
    assert (data["rounding"] < 1e-9 * np.ptp(path.last.problem.surface.heights)).all()
    for item in SCALARS:
        np.testing.assert_array_equal(data[item.name], [getattr(r, item.name) for r in path.steps])
    balance = path.energies
    np.testing.assert_array_equal(data["path_external_work"], balance.external_work)
    np.testing.assert_array_equal(data["path_residual"], balance.residual)
    assert data["converged"].all()
    controls = [rebuild(json.loads(text)) for text in data["control"].values]
    assert controls == [result.control for result in path.steps]
    assert all("units" in data[name].attrs for name in data.data_vars)
    with pytest.raises(OutputError):
        asp.save(path, tmp_path / "path.nc")


def test_a_path_is_read_back_whole(path: asp.HistoryResult, tmp_path: Path) -> None:
    asp.save(path, tmp_path / "path.nc")
    again = asp.load(tmp_path / "path.nc")
    assert len(again.steps) == len(path.steps)
    for found, result in zip(again.steps, path.steps, strict=True):
        assert (found.control, found.status, found.certificate) == (result.control, result.status, result.certificate)
        exact = [item.name for item in (*SCALARS, *FIELDS) if item.name not in (*BACK, *OF_EDGES)]
        for name in exact:
            np.testing.assert_array_equal(getattr(found, name), getattr(result, name))
        for name in (*OF_EDGES, "spot_areas"):  # follow from the gap, which comes back within its rounding
            np.testing.assert_allclose(getattr(found, name), getattr(result, name), rtol=1e-12)
        np.testing.assert_array_equal(found.plastic, result.plastic)
    np.testing.assert_array_equal(again.energies.residual, path.energies.residual)


@pytest.mark.parametrize("precision", ["single", "double"])
def test_displacement_and_gap_come_back_within_the_stated_rounding(precision: str, tmp_path: Path) -> None:
    """On rough surfaces, through loads that each start from the one before, in chains too."""
    noise = np.random.default_rng(7).standard_normal((64, 48))
    heights = sum(np.roll(noise, (i, j), (0, 1)) for i in range(3) for j in range(3)) * 1e-9
    body = asp.Layered([asp.Layer(asp.Elastic(2e11, 0.25), 2e-8)], asp.Elastic(1e11, 0.3))
    for boundary in (asp.Periodic(), asp.Free()):
        surface = asp.Surface(heights, 2e-8, periodic=isinstance(boundary, asp.Periodic))
        problem = asp.ContactProblem(surface, body, boundary=boundary, law=asp.Hardness(8e9))
        loads = [asp.Force(f) for f in np.linspace(1e-6, 3e-4, 17)]
        solver = asp.solvers.ActiveSet(precision=precision)
        path = asp.solve(problem, asp.History(loads), solver=solver)
        asp.save(path, tmp_path / "path.nc", overwrite=True)
        stated = asp.files.open_tree(tmp_path / "path.nc")["path/rounding"].values
        for found, result, bound in zip(asp.load(tmp_path / "path.nc"), path, stated, strict=True):
            for name in BACK:
                assert getattr(found, name).dtype == getattr(result, name).dtype
                assert np.abs(getattr(found, name) - getattr(result, name)).max() <= bound, name


@pytest.mark.parametrize("block", [1.0, 1e9])
def test_steps_are_written_while_they_are_solved(
    path: asp.HistoryResult, block: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The same file as of the whole path but for the energies, and no more than a block of steps is
    held."""
    monkeypatch.setattr("asperity.io.paths.BLOCK", block)
    held, most = list[weakref.ref[asp.ContactResult]](), [0]
    gc.collect()
    gc.freeze()  # what is there already need not be searched at every step

    def solved() -> Iterator[asp.ContactResult]:
        for step in path.steps:
            made = replace(step, couplings=dict(step.couplings))
            held.append(weakref.ref(made))
            gc.collect()
            most[0] = max(most[0], sum(one() is not None for one in held))
            yield made
            del made

    asp.save(solved(), tmp_path / "steps.nc")
    gc.unfreeze()
    assert most[0] <= (3 if block == 1.0 else len(path))
    asp.save(path, tmp_path / "path.nc")
    assert told(asp.load(tmp_path / "steps.nc")) == told(asp.load(tmp_path / "path.nc"))
    np.testing.assert_array_equal(asp.load(tmp_path / "steps.nc").energies.residual, path.energies.residual)
    kept = {
        name for name in asp.files.open_tree(tmp_path / "path.nc")["path"].data_vars if not name.startswith("path_")
    }
    assert set(asp.files.open_tree(tmp_path / "steps.nc")["path"].data_vars) == kept
    begin = path.steps[0].state
    rest = steps(path.last.problem, [step.control for step in path.steps[1:]], state=begin)
    asp.save(rest, tmp_path / "rest.nc", start=begin)
    np.testing.assert_array_equal(asp.load(tmp_path / "rest.nc").start.pressure, begin.pressure)
    with refused(asp.InputError, "load path to save"):
        asp.save(iter(()), tmp_path / "none.nc")
    assert not (tmp_path / "none.nc").exists()


@pytest.mark.parametrize("block", [1.0, 1e9])
def test_what_some_steps_have_is_read_back(block: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Wherever they stand, and whether the steps are written one by one: what the others have no
    more, or not yet, is not made up."""
    monkeypatch.setattr("asperity.io.paths.BLOCK", block)
    heights = 1e-9 * np.random.default_rng(7).standard_normal((16, 12))
    surface = asp.Surface(heights, 2e-8, 2e-8, periodic=True)
    problem = asp.ContactProblem(surface, asp.Elastic(1e11, 0.3), friction=asp.friction.Coulomb(0.3))
    sheared = asp.solve(problem, asp.Step(asp.MeanPressure(1e8), asp.Shift(1e-10)))
    sliding, more = (asp.solve(problem, asp.MeanPressure(load)) for load in (2e8, 3e8))
    for steps_of in ((sheared, sliding, more), (sliding, sheared, more), (sliding, more, sheared)):
        path = asp.HistoryResult(steps_of)
        asp.save(path, tmp_path / "path.nc", overwrite=True)
        for found, result in zip(asp.load(tmp_path / "path.nc"), path, strict=True):
            assert list(found.couplings) == list(result.couplings)
            np.testing.assert_array_equal(found.pressure, result.pressure)
            if result.stick_slip is not None:
                np.testing.assert_array_equal(found.stick_slip.traction, result.stick_slip.traction)


def test_the_table_has_a_row_for_each_step(path: asp.HistoryResult, tmp_path: Path) -> None:
    asp.files.export_csv(path, tmp_path / "path.csv")
    with (tmp_path / "path.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["step"] for row in rows] == ["1", "2", "3", "4", "5", "6"]
    assert [float(row["plastic_volume (m**3)"]) for row in rows] == [r.plastic_volume for r in path.steps]
    assert [float(row["path_plastic_work (J)"]) for row in rows] == list(np.cumsum(path.plastic_work))
    assert {row["converged"] for row in rows} == {"True"}


def test_a_result_of_a_path_is_read_back(path: asp.HistoryResult, tmp_path: Path) -> None:
    for number, result in enumerate((path.steps[2], path.steps[-1])):
        asp.save(result, tmp_path / f"{number}.nc")
        again = asp.load(tmp_path / f"{number}.nc")
        assert again.control == result.control
        assert repr(again.problem.law) == repr(result.problem.law)  # nan is not nan
        np.testing.assert_array_equal(again.plastic, result.plastic)
        np.testing.assert_array_equal(again.state.permanent_indentation, result.permanent_indentation)
        assert again.state.plastic_work == result.total_plastic_work > 0.0


def test_adhesive_paths_say_what_pulls(tmp_path: Path) -> None:
    """In the table of the steps and in the file: external force, attraction, grips, margin and
    jumps of every step."""
    path = CASES["adhesive"]()
    asp.files.export_csv(path, tmp_path / "path.csv")
    asp.save(path, tmp_path / "path.nc")
    with (tmp_path / "path.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    group = asp.files.open_tree(tmp_path / "path.nc")["path/couplings/adhesion"]
    units = {"external_force": "N", "attractive_force": "N", "grips": "m", "margin": "1", "jumps": "1"}
    for name, unit in units.items():
        wanted = [getattr(step.adhesion, name) for step in path]
        assert [float(row[f"{name} ({unit})"]) for row in rows] == wanted
        assert group[name].values.tolist() == wanted
        assert group[name].attrs["units"] == unit
    np.testing.assert_array_equal(group["attraction"], [step.adhesion.attraction for step in path])


def test_a_name_that_two_couplings_have_stands_twice_in_the_table(tmp_path: Path) -> None:
    wet = CASES["wet"]()
    law = asp.ExponentialAdhesion(0.01, 1e-9)
    both = asp.ContactProblem(wet.last.problem.surface, asp.Elastic(1e11, 0.3), film=FILM, adhesion=law)
    path = asp.solve(both, asp.History([asp.MeanPressure(1e8), asp.MeanPressure(5e7)]))
    asp.files.export_csv(path, tmp_path / "path.csv")
    with (tmp_path / "path.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row, step in zip(rows, path, strict=True):
        assert float(row["external_force (N)"]) == step.menisci.external_force
        assert float(row["adhesion_external_force (N)"]) == step.adhesion.external_force
