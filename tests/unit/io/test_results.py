"""A result file carries the whole result, exactly, and refuses everything else by name."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest
import xarray
from refusals import refused

import asperity as asp
from asperity.contact.couplings.protocol import Deflections
from asperity.contact.result import SCALARS
from asperity.core.errors import FileFormatError, OutputError
from asperity.io.results import load, open_tree, result_tree, save
from asperity.io.tree import FORMAT_VERSION, Node, write_tree


def same(first: object, second: object) -> bool:
    """Equal to the last bit and of equal type, all the way down but for products at hand, which no
    file holds; NaN equals NaN."""
    if isinstance(first, Deflections) or isinstance(second, Deflections):
        return all(one is None or isinstance(one, Deflections) for one in (first, second))
    if isinstance(first, np.ndarray) and isinstance(second, np.ndarray):
        return first.dtype == second.dtype and first.shape == second.shape and first.tobytes() == second.tobytes()
    if isinstance(first, float) and isinstance(second, float) and first != first:
        return second != second
    if hasattr(first, "__dataclass_fields__"):
        names = [f.name for f in fields(first)]  # type: ignore[arg-type]
        return type(first) is type(second) and all(same(getattr(first, n), getattr(second, n)) for n in names)
    if isinstance(first, tuple) and isinstance(second, tuple):
        return len(first) == len(second) and all(map(same, first, second))
    return (type(first) is type(second) and first == second) or dict_like(first, second)


def dict_like(first: object, second: object) -> bool:
    return hasattr(first, "keys") and hasattr(second, "keys") and dict(first) == dict(second)  # type: ignore[call-overload]


def test_comparison_can_fail(elastic: asp.ContactResult) -> None:
    assert same(elastic, replace(elastic))
    assert not same(elastic, replace(elastic, pressure=np.nextafter(elastic.pressure, 1.0)))
    assert not same(elastic, replace(elastic, control=asp.Force(elastic.control.value)))
    body = asp.Elastic(1e11, 0.3, name="x")
    assert not same(elastic, replace(elastic, problem=replace(elastic.problem, body=body)))


def test_round_trip_is_exact(result: asp.ContactResult, tmp_path: Path) -> None:
    save(result, tmp_path / "r.nc", document="[contact]\nname = 'ü'\n")
    again = load(tmp_path / "r.nc")
    for item in fields(result):
        assert same(getattr(result, item.name), getattr(again, item.name)), item.name
    assert again.problem.grid == result.problem.grid
    assert sorted(path.name for path in tmp_path.iterdir()) == ["r.nc"]


def test_loaded_result_can_be_saved_and_solved_again(plastic: asp.ContactResult, tmp_path: Path) -> None:
    save(plastic, tmp_path / "a.nc")
    again = load(tmp_path / "a.nc")
    save(again, tmp_path / "b.nc")
    assert same(load(tmp_path / "b.nc"), plastic)
    repeated = asp.solve(again.problem, again.control)
    assert repeated.area_fraction == plastic.area_fraction
    np.testing.assert_allclose(repeated.pressure, plastic.pressure, rtol=1e-9, atol=1.0)


def test_no_contact_spots_and_huge_text_are_kept(elastic: asp.ContactResult, tmp_path: Path) -> None:
    names = ("force", "mean_pressure", "max_pressure", "area_fraction")
    nothing = dict.fromkeys(names, 0.0)
    bare = replace(elastic, pressure=np.zeros_like(elastic.pressure), **nothing)
    bare = replace(bare, certificate=replace(bare.certificate, duality_gap=np.inf), normal_stiffness=np.inf)
    document = "# long\n" + "x = 1\n" * 100_000
    save(bare, tmp_path / "r.nc", document=document)
    assert same(load(tmp_path / "r.nc"), bare)
    assert open_tree(tmp_path / "r.nc").attrs["document"] == document


def test_dataset_is_labelled(plastic: asp.ContactResult, tmp_path: Path) -> None:
    save(plastic, tmp_path / "r.nc")
    tree, same_tree = open_tree(tmp_path / "r.nc"), plastic.to_xarray()
    assert tree.groups == same_tree.groups == ("/", "/contact")
    data = tree["contact"].to_dataset()
    xarray.testing.assert_identical(
        data.drop_attrs(deep=False), same_tree["contact"].to_dataset().drop_attrs(deep=False)
    )
    grid = plastic.problem.grid
    assert data.pressure.dims == ("x", "y")
    np.testing.assert_array_equal(data.x, np.arange(18) * grid.spacing[0])
    np.testing.assert_array_equal(data.y, np.arange(12) * grid.spacing[1])
    assert all({"units", "long_name"} <= set(data[name].attrs) for name in data.variables)
    units = {name: data[name].attrs["units"] for name in ("x", "pressure", "gap", "spot_areas", "counter_heights")}
    assert units == {"x": "m", "pressure": "Pa", "gap": "m", "spot_areas": "m**2", "counter_heights": "m"}
    assert data.contact.dtype == bool
    assert float(data.contact.mean()) == plastic.area_fraction
    for quantity in SCALARS:
        assert data[quantity.name].attrs == {"units": quantity.unit, "long_name": quantity.label}
    assert json.loads(data.attrs["body"])["youngs_modulus"] == 2.1e11
    assert json.loads(data.attrs["control"]) == {"type": "Force", "value": 2e-5}
    assert data.attrs["certificate_duality_gap"] == plastic.certificate.duality_gap
    assert data.attrs["status_outcome"] == "converged"
    assert json.loads(tree.attrs["provenance"])["surface"]["source"] == "disk <1> & ü.x3p"
    assert data.attrs["citation_keys"].split() == list(plastic.citation_keys)


def test_plain_netcdf_reader_sees_the_same(plastic: asp.ContactResult, tmp_path: Path) -> None:
    import h5netcdf

    save(plastic, tmp_path / "r.nc")
    with h5netcdf.File(tmp_path / "r.nc") as file:
        group = file.groups["contact"]
        assert group.variables["pressure"][...].tobytes() == plastic.pressure.tobytes()
        assert {name: dimension.size for name, dimension in group.dimensions.items()} == {
            "x": 18,
            "y": 12,
            "spot": plastic.n_spots,
        }


def test_existing_file_is_kept_unless_overwritten(elastic: asp.ContactResult, tmp_path: Path) -> None:
    path = tmp_path / "r.nc"
    path.write_text("mine")
    with refused(OutputError, "output file"):
        save(elastic, path)
    assert path.read_text() == "mine"
    save(elastic, path, overwrite=True)
    assert same(load(path), elastic)


def test_law_of_ones_own_is_refused_before_writing(elastic: asp.ContactResult, tmp_path: Path) -> None:
    class Mine:
        name = "mine"
        citation_keys = ()

        def pressure_cap(self) -> float:
            return 1.0

    odd = replace(elastic, problem=replace(elastic.problem, law=Mine()))
    with refused(asp.InputError, "every part of a result to be saved"):
        save(odd, tmp_path / "r.nc")
    assert list(tmp_path.iterdir()) == []


def test_missing_and_foreign_files_are_named(tmp_path: Path) -> None:
    with refused(FileFormatError, "result file", "none.nc"):
        load(tmp_path / "none.nc")
    (tmp_path / "text.nc").write_text("hello")
    with refused(FileFormatError, "result file", "text.nc"):
        load(tmp_path / "text.nc")
    (tmp_path / "empty.nc").write_bytes(b"")
    with refused(FileFormatError, "result file"):
        load(tmp_path / "empty.nc")
    xarray.Dataset({"a": ("x", [1.0])}).to_netcdf(tmp_path / "other.nc", engine="h5netcdf")
    with refused(FileFormatError, "result file"):
        load(tmp_path / "other.nc")


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9, 0.999])
def test_truncated_file_is_refused(elastic: asp.ContactResult, tmp_path: Path, share: float) -> None:
    save(elastic, tmp_path / "r.nc")
    whole = (tmp_path / "r.nc").read_bytes()
    (tmp_path / "r.nc").write_bytes(whole[: int(share * len(whole))])
    with pytest.raises(FileFormatError):
        load(tmp_path / "r.nc")


def test_newer_format_is_refused(elastic: asp.ContactResult, tmp_path: Path) -> None:
    data = xarray.Dataset({"a": ("x", [1.0])}, attrs={"asperity_format": FORMAT_VERSION + 1})
    data.to_netcdf(tmp_path / "r.nc", engine="h5netcdf")
    with refused(FileFormatError, "result file"):
        open_tree(tmp_path / "r.nc")


def changed(result: asp.ContactResult, **attributes: object) -> Node:
    """Tree of ``result`` with other attributes of the contact; None takes away, a value or an
    attribute."""
    tree = result_tree(result)
    group = tree.children["contact"]
    values = tuple(item for item in group.values if attributes.get(item.quantity.name, ...) is not None)
    kept = {name: value for name, value in {**group.attributes, **attributes}.items() if value is not None}
    return replace(tree, children={"contact": Node(values, kept)})


@pytest.mark.parametrize("loss", ["pressure", "offset", "body", "status_outcome", "certificate_solver", "surface"])
def test_incomplete_file_is_refused(elastic: asp.ContactResult, tmp_path: Path, loss: str) -> None:
    write_tree(changed(elastic, **{loss: None}), tmp_path / "r.nc")
    with refused(FileFormatError, "result file", loss):
        load(tmp_path / "r.nc")


def test_changed_heights_and_unknown_types_are_refused(elastic: asp.ContactResult, tmp_path: Path) -> None:
    text = json.loads(str(result_tree(elastic).children["contact"].attributes["surface"]))
    write_tree(changed(elastic, surface=json.dumps(text | {"digest": "0"})), tmp_path / "a.nc")
    with refused(FileFormatError, "result file"):
        load(tmp_path / "a.nc")
    write_tree(changed(elastic, body='{"type": "Magic"}'), tmp_path / "b.nc")
    with refused(FileFormatError, "type in a result file", "'Magic'"):
        load(tmp_path / "b.nc")


def test_other_endings_are_refused_by_name(elastic: asp.ContactResult, tmp_path: Path) -> None:
    with refused(OutputError, "result file", "export_csv"):
        save(elastic, tmp_path / "a.csv")
    with refused(asp.InputError, "result to save"):
        save(elastic.problem, tmp_path / "a.nc")  # type: ignore[arg-type]
    assert list(tmp_path.iterdir()) == []


FULL_DISK = """
import resource, signal, sys
import numpy as np
import asperity as asp

signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
heights = np.random.default_rng(1).normal(size=(64, 64)) * 1e-9
problem = asp.ContactProblem(asp.Surface(heights, 1e-8, periodic=True), asp.Elastic(1e11, 0.3))
result = asp.solve(problem, asp.MeanPressure(1e8))
for room in map(int, sys.argv[2:]):
    resource.setrlimit(resource.RLIMIT_FSIZE, (room, resource.RLIM_INFINITY))
    try:
        asp.save(result, sys.argv[1])
    except asp.errors.OutputError as error:
        print(room, "refused:", error)
"""


def test_a_full_disk_ends_in_one_sentence(tmp_path: Path) -> None:
    """Whatever room is left."""
    file, rooms = tmp_path / "r.nc", ("500", "30000", "120000")
    unmeasured = {key: value for key, value in os.environ.items() if not key.startswith("COVERAGE_PROCESS")}
    ended = subprocess.run(
        [sys.executable, "-c", FULL_DISK, str(file), *rooms],
        capture_output=True,
        text=True,
        check=False,
        env=unmeasured,  # the data of a coverage run would not fit on the full disk either
    )
    assert ended.returncode == 0, ended.stderr
    lines = ended.stdout.splitlines()
    assert [line.split(" refused:")[0] for line in lines] == list(rooms)
    assert all("cannot be written" in line for line in lines)
    assert ended.stderr == ""
    assert list(tmp_path.iterdir()) == []
