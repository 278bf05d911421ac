"""Result files whose numbers cannot be, or contradict each other, are refused; what ended without
convergence loads."""

from __future__ import annotations

import hashlib
from pathlib import Path

import h5py
import numpy as np
import pytest
from refusals import refused

import asperity as asp

RNG = np.random.default_rng(3)
GROUND = asp.Surface(1e-9 * RNG.standard_normal((12, 16)), 1e-8, periodic=True)
STEEL = asp.Elastic(2e11, 0.3)


def contact() -> asp.ContactResult:
    return asp.solve(asp.ContactProblem(GROUND, STEEL, law=asp.Hardness(5e9)), asp.MeanPressure(3e8))


def path() -> asp.HistoryResult:
    return asp.solve(asp.ContactProblem(GROUND, STEEL), asp.History([asp.MeanPressure(p) for p in (1e8, 3e8, 2e8)]))


def wet() -> asp.HistoryResult:
    film = asp.LiquidFilm(surface_tension=0.025, thickness=0.4e-9, meniscus_height=0.8e-9)
    return asp.solve(
        asp.ContactProblem(GROUND, STEEL, film=film), asp.History([asp.MeanPressure(p) for p in (3e8, 1e8)])
    )


@pytest.fixture(scope="module")
def stored(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("stored")
    found = {"contact": contact(), "path": path()}
    for name, result in found.items():
        asp.save(result, folder / f"{name}.nc")
    return {name: folder / f"{name}.nc" for name in found}


def edited(
    source: Path, target: Path, group: str, name: str, place: object, value: float, *, forged: bool = True
) -> Path:
    """The file with another value at a place of a variable, and a digest that fits it where it is
    ``forged``."""
    target.write_bytes(source.read_bytes())
    with h5py.File(target, "r+") as file:
        values = file[group][name]
        values[place] = value
        if forged and values.ndim:
            values.attrs["sha256"] = hashlib.sha256(values[...].tobytes()).hexdigest()
    return target


@pytest.mark.parametrize("group", ["contact", "path", "path/couplings/menisci", "path/memory/menisci"])
def test_every_changed_array_is_refused(group: str, tmp_path: Path) -> None:
    """Some of each group, and however little has changed."""
    asp.save(wet(), tmp_path / "whole.nc")
    with h5py.File(tmp_path / "whole.nc") as file:
        arrays = [n for n, v in file[group].items() if isinstance(v, h5py.Dataset) and v.ndim and v.dtype.kind in "iuf"]
        arrays = [name for name in arrays if file[group][name].size and np.isfinite(file[group][name][...]).any()]
        bare = {name for name in arrays if b"netCDF dimension but not" in file[group][name].attrs.get("NAME", b"")}
    arrays = [name for name in arrays if name not in bare]
    assert len(arrays) > 1
    arrays = [*arrays[:: max(1, len(arrays) // 4)], *({"pressure", "gap"} & set(arrays))]
    for name in arrays:
        with h5py.File(tmp_path / "whole.nc") as file:
            values = file[group][name]
            place = tuple(np.argwhere(np.isfinite(values[...]))[0])
            value = values[place] + 1 if values.dtype.kind in "iu" else np.nextafter(values[place], np.inf)
        bad = edited(tmp_path / "whole.nc", tmp_path / "bad.nc", group, name, place, value, forged=False)
        with refused(asp.errors.FileFormatError, "result file", repr(name), str(bad)):
            asp.load(bad)


@pytest.mark.parametrize("value", [np.nan, np.inf, 1e12, -1e9])
@pytest.mark.parametrize("name", ["pressure", "gap", "displacement"])
def test_fields_that_cannot_be(name: str, value: float, stored: dict[str, Path], tmp_path: Path) -> None:
    """A displacement may have any finite value; it has no scalar of its own."""
    bad = edited(stored["contact"], tmp_path / "bad.nc", "contact", name, (2, 3), value)
    if name == "displacement" and np.isfinite(value):
        asp.load(bad)
        return
    with refused(asp.errors.FileFormatError, "result file", str(bad)):
        asp.load(bad)


@pytest.mark.parametrize("name", ["force", "mean_pressure", "max_pressure", "mean_gap", "area_fraction", "approach"])
@pytest.mark.parametrize("value", [np.nan, 1.0001])
def test_scalars_that_contradict_their_fields(name: str, value: float, stored: dict[str, Path], tmp_path: Path) -> None:
    with h5py.File(stored["contact"]) as file:
        now = float(file["contact"][name][()])
    if name == "approach" and np.isfinite(value):
        return  # follows from no field of the file
    bad = edited(stored["contact"], tmp_path / "bad.nc", "contact", name, (), value * now)
    with refused(asp.errors.FileFormatError, "result file", name):
        asp.load(bad)


@pytest.mark.parametrize("step", [0, 1, 2])
def test_every_step_of_a_path(step: int, stored: dict[str, Path], tmp_path: Path) -> None:
    before = sum(int(each.contact.sum()) for each in path().steps[:step])
    bad = edited(stored["path"], tmp_path / "bad.nc", "path", "pressure", before, 1e12)
    with refused(asp.errors.FileFormatError, "result file", "force"):
        asp.load(bad)


def test_a_mean_gap_that_is_not_that_of_the_pressures(stored: dict[str, Path], tmp_path: Path) -> None:
    """It is found when the gap is first read."""
    with h5py.File(stored["path"]) as file:
        now = float(file["path"]["mean_gap"][1])
    bad = asp.load(edited(stored["path"], tmp_path / "bad.nc", "path", "mean_gap", 1, 1.0001 * now))
    assert bad.steps[0].gap.mean() == pytest.approx(bad.steps[0].mean_gap, rel=1e-12)
    with refused(asp.errors.FileFormatError, "mean gap of a step in a result file"):
        _ = bad.steps[1].gap


def test_what_is_whole_loads(stored: dict[str, Path]) -> None:
    assert asp.load(stored["contact"]).converged
    assert len(asp.load(stored["path"])) == 3


@pytest.mark.parametrize("precision", ["single", "double"])
def test_precision_and_failures(precision: str, tmp_path: Path) -> None:
    """Single precision, and a solve that ended early, whose gap is clipped and whose load is
    met."""
    heights = 1e-9 * np.random.default_rng(5).standard_normal((48, 48))
    problem = asp.ContactProblem(asp.Surface(heights, 1e-8, periodic=True), STEEL)
    for solver in (asp.solvers.ActiveSet(precision=precision), asp.solvers.ConjugateGradient(max_iterations=2)):
        found = asp.solve(problem, asp.MeanPressure(1e9), solver=solver, on_failure="return")
        asp.save(found, tmp_path / "result.nc", overwrite=True)
        again = asp.load(tmp_path / "result.nc")
        assert again.converged == found.converged
        assert again.force == found.force
    assert not found.converged
