"""HDF5 files of strangers: data of other files are not read, and damaged references do not reach
the library."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core.errors import FileFormatError


def _saved(path: Path) -> Path:
    x = np.arange(8) - 4.0
    surface = asp.Surface(-5e-9 * (x[:, None] ** 2 + x**2), 1e-6)
    problem = asp.ContactProblem(surface, asp.Layered([], asp.Elastic(1e9, 0.3)))
    asp.save(asp.solve(problem, asp.Force(1e-4)), path)
    return path


def _numbers(file: Any, name: str, value: Any) -> None:
    for item in (file["contact/pressure"], file["contact/x"]):
        if name in item.attrs:
            del item.attrs[name]
            item.attrs[name] = value
            return
    raise AssertionError(name)


@pytest.mark.parametrize("name", ["DIMENSION_LIST", "REFERENCE_LIST"])
@pytest.mark.parametrize("value", [np.arange(64.0), np.int8(1), "text", np.zeros((2, 2), "i8")])
def test_a_damaged_reference_is_refused(tmp_path: Path, name: str, value: Any) -> None:
    path = _saved(tmp_path / "r.nc")
    with h5py.File(path, "r+") as file:
        _numbers(file, name, value)
    with refused(FileFormatError, "result file", name):
        asp.load(path)


@pytest.mark.parametrize("count", [1, 3])
def test_a_list_of_another_length_is_refused(tmp_path: Path, count: int) -> None:
    path = _saved(tmp_path / "r.nc")
    with h5py.File(path, "r+") as file:
        item = file["contact/pressure"]
        one = item.attrs["DIMENSION_LIST"][0]
        del item.attrs["DIMENSION_LIST"]
        kind = h5py.vlen_dtype(h5py.ref_dtype)
        lists = np.empty(count, dtype=object)
        for number in range(count):
            lists[number] = one
        item.attrs.create("DIMENSION_LIST", lists, dtype=kind)
    with refused(FileFormatError, "result file", "DIMENSION_LIST"):
        asp.load(path)


def _external(file: h5py.File, other: Path) -> None:
    file.create_dataset("more", (4, 4), "f8", external=[(str(other), 0, 128)])


def _link(file: h5py.File, other: Path) -> None:
    file["more"] = h5py.ExternalLink(str(other), "/heights")


def _virtual(file: h5py.File, other: Path) -> None:
    layout = h5py.VirtualLayout((4, 4), "f8")
    layout[:] = h5py.VirtualSource(str(other), "heights", (4, 4))
    file.create_virtual_dataset("more", layout)


@pytest.mark.parametrize("foreign", [_external, _link, _virtual])
@pytest.mark.parametrize("block", [0, 1024])
def test_a_surface_holds_its_data_itself(
    tmp_path: Path, foreign: Callable[[h5py.File, Path], None], block: int
) -> None:
    other, path = tmp_path / "other.h5", tmp_path / "s.h5"
    with h5py.File(other, "w") as file:
        file["heights"] = np.ones((4, 4))
    with h5py.File(path, "w", userblock_size=block) as file:
        foreign(file.create_group("deep"), other)
    for read in (asp.read, asp.surfaces.channels):
        with refused(FileFormatError, f"file {path}", "hold its data itself", "'more'"):
            read(path)
