"""Files, documents and stores of strangers: refused in one sentence, soon, and without being
followed elsewhere."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import zlib
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from refusals import refused
from study_cases import PROBLEM, plan

import asperity as asp
from asperity.core import require, units
from asperity.core.errors import AsperityError, FileFormatError, InputError, OutputError, UnitError
from asperity.core.text import LARGEST, read_text
from asperity.core.words import printable
from asperity.run.build import build
from asperity.run.document import checked, read_table
from asperity.run.stored import load_outcome, save_outcome
from asperity.studies.store import Finished, Store, records
from asperity.surfaces.surface import Origin


def test_only_units_reach_the_library_of_units() -> None:
    for good in ("nm", "N/m", "Pa*s", "1/m**2", "um**-2", "m^-1", "N/(m*s)", "cm**3/mol", "m**0.5", "µm", "°", "%"):
        assert units._GRAMMAR.fullmatch(good), good
    for bad in ("m*9**9**9**9", "m**99", "9**9", "m**m", "x" * 70, "m;m", "__import__", "m/m/m/m/m/m/m/m", "m\x1b"):
        with refused(UnitError, "length", repr(bad)):
            units.parse(f"1 {bad}", "length", "length")


def test_control_characters_are_shown() -> None:
    assert printable("a\x1b[31m\n\u202eb", keep="\n") == "a\\x1b[31m\n\\u202eb"
    unassigned, private = "\U000e11b3", "\ue000"
    assert printable(f"{unassigned}{private} µ") == "\\U000e11b3\\ue000 µ"
    surface = asp.Surface(np.eye(4), 1.0, origin=Origin(source="scan\x1b]0;owned\x07.txt"))
    body = asp.Layered([asp.Layer(asp.Elastic(1e9, 0.3, name="a\x1b[2J"), 1e-9)], asp.Elastic(1e9, 0.3))
    page = asp.solve(asp.ContactProblem(surface, body), asp.MeanPressure(1e6))._repr_html_()
    for shown in (repr(surface), repr(body), page):
        assert "\x1b" not in shown
        assert "\x07" not in shown


def test_integers_beyond_every_float() -> None:
    huge = 10**400
    for number in (huge, -huge):
        with refused(InputError, "Poisson's ratio", "308"):
            require.within(number, -1.0, 0.5, "Poisson's ratio")
    with refused(InputError, "value of surface.seed", "308"):
        plan(axes=[{"path": "surface.seed", "values": [1, huge]}])


@pytest.mark.parametrize("form", ["toml", "json"])
def test_documents_that_are_none(tmp_path: Path, form: str) -> None:
    """Pipes, devices, folders, huge and deep ones, impossible names."""
    file = tmp_path / f"a.{form}"
    deep = {"toml": "a = " + "[" * 50 + "]" * 50, "json": '{"a":' * 50 + "1" + "}" * 50}[form]
    dotted = {"toml": ".".join(["a"] * 100_000) + " = 1", "json": "[" * 100_000 + "]" * 100_000}[form]
    number = {"toml": "a = " + "9" * 5000, "json": '{"a": ' + "9" * 5000 + "}"}[form]
    for content in (deep, dotted, number, "#" * (LARGEST + 1), "\x00", ""):
        file.write_text(content, encoding="utf-8")
        if content:
            with pytest.raises(FileFormatError):
                read_table(file)
    file.write_bytes(b'a = "\xff"')
    with refused(FileFormatError, "problem document", "UTF-8"):
        read_table(file)
    for name in ("none", "x" * 300, "a\0b", ".", "/dev/zero"):
        with pytest.raises(FileFormatError):
            read_table(tmp_path / name)
        with pytest.raises(FileFormatError):
            asp.material("steel", library=tmp_path / name)
    if hasattr(os, "mkfifo"):
        os.mkfifo(tmp_path / f"pipe.{form}")
        with refused(FileFormatError, "document", "pipe"):
            read_text(tmp_path / f"pipe.{form}", "document")


def test_grids_and_studies_that_no_machine_holds() -> None:
    surface = {**PROBLEM["surface"], "points": [400_000, 400_000]}  # type: ignore[dict-item]
    with refused(InputError, "points of the surface", "400000 x 400000"):
        build(checked({**PROBLEM, "surface": surface}))
    axis = {"path": "control.mean_pressure", "first": "1 MPa", "last": "2 MPa"}
    with refused(InputError, "axis of a study", "100000", "1000000000"):
        plan(axes=[{**axis, "count": 1_000_000_000}])
    many = {"seed": 1, "samples": 8_100_000_000_000, "random": [{"path": "surface.seed", "distribution": "seed"}]}
    with refused(InputError, "study", "8.1e+12"):
        plan(monte_carlo=many)


@pytest.fixture(scope="module")
def stored(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Result file of a small contact with a film and stresses."""
    path = tmp_path_factory.mktemp("stored") / "r.nc"
    film = {"film": {"liquid": "water", "humidity": "60%"}, "stress": {"depths": ["10 nm"]}}
    surface = {**PROBLEM["surface"], "points": [8, 8]}
    save_outcome(asp.run({**PROBLEM, "version": 2, "surface": surface, **film}), path, document="version = 2\n")
    return path


def test_results_are_not_followed_elsewhere(tmp_path: Path) -> None:
    """Links out of the file, raw data of other files, groups within themselves, more data than
    there is memory."""

    def link(file: Any) -> None:
        file["a"] = h5py.ExternalLink("/etc/passwd", "/")

    def raw(file: Any) -> None:
        file.create_dataset("a", (16,), "u1", external=[("/etc/hostname", 0, 16)])

    def virtual(file: Any) -> None:
        layout = h5py.VirtualLayout((16,), "u1")
        layout[...] = h5py.VirtualSource("/etc/hostname", "x", (16,))
        file.create_virtual_dataset("a", layout)

    def circle(file: Any) -> None:
        file.create_group("a")["b"] = file["/"]

    def huge(file: Any) -> None:
        file.create_dataset("a", (10**13,), "f8", chunks=(1024,))

    for make, shown in (
        (link, "link"),
        (raw, "another file"),
        (virtual, "another file"),
        (circle, "twice"),
        (huge, "fit"),
    ):
        with h5py.File(tmp_path / "r.nc", "w") as file:
            file.attrs["asperity_format"] = 2
            make(file)
        for read in (asp.load, asp.files.open_tree, load_outcome):
            with refused(FileFormatError, "result file", shown):
                read(tmp_path / "r.nc")


@pytest.mark.slow
def test_results_with_anything_in_them(stored: Path, tmp_path: Path) -> None:
    """Wrong types in every attribute and variable: an answer or one sentence."""
    bad: tuple[Any, ...] = (
        2**63 - 1,
        "",
        "[]",
        "9" * 400,
        '{"a":' * 500,
        '{"type":["a"]}',
        '{"array":[]}',
        '{"type":"Elastic"}',
    )
    with h5py.File(stored) as file:
        places = ["/"]
        file.visit(places.append)
        own = [(place, name) for place in places for name in file[place].attrs if name.islower()]
        arrays = [place for place in places if isinstance(file[place], h5py.Dataset)]
    path, whole = tmp_path / "r.nc", stored.read_bytes()
    changes = [
        (place, name, bad[number % len(bad)]) for number, (place, name) in enumerate(own) if name != "_NCProperties"
    ]
    changes += [(place, None, (np.zeros((3, 2, 2)), "x", None)[number % 3]) for number, place in enumerate(arrays)]
    refused = 0
    for place, name, value in changes[::29]:  # prime to the number of wrong values
        path.write_bytes(whole)
        with h5py.File(path, "r+") as file:
            if name is not None:
                file[place].attrs[name] = value
            else:
                del file[place]
                if value is not None:
                    file[place] = value
        try:
            load_outcome(path)
        except AsperityError:
            refused += 1
    assert refused > 2


@pytest.mark.slow
def test_damaged_results_leave_no_tail(stored: Path, tmp_path: Path) -> None:
    """Neither 'Exception ignored' nor a crash follows the sentence when the process ends."""
    content = stored.read_bytes()
    for number in range(6):
        (tmp_path / f"{number}.nc").write_bytes(content[: len(content) * (number + 2) // 9])
        damaged = bytearray(content)
        damaged[40 + 500 * number : 540 + 500 * number] = bytes(500)
        (tmp_path / f"{number}d.nc").write_bytes(damaged)
    code = (
        "import sys, asperity as asp\nfrom asperity.core.errors import AsperityError\n"
        "for name in sys.argv[1:]:\n"
        "    for read in (asp.load, asp.files.open_tree):\n"
        "        try:\n            read(name)\n"
        "        except AsperityError:\n            pass\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, *tmp_path.glob("*.nc")], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")


def test_records_of_a_wrong_shape_are_none(tmp_path: Path) -> None:
    """A valid checksum does not make a record; the cases are done again."""
    good: dict[str, Any] = {"key": "a" * 64, "values": {"x": 1.0}, "work": {}, "citations": [], "error": None}
    wrong: list[Any] = [
        [],
        1,
        {},
        {**good, "values": {"x": "y"}},
        {**good, "values": []},
        {**good, "error": 1},
        {**good, "error": {}},
        {**good, "citations": [1]},
        {**good, "findings": [["a"]]},
        {**good, "values": {"x": 10**400}},
        {**good, "key": 5},
        {**good, "key": "b" * 64},
        {**good, "key": "../x"},
    ]
    path = tmp_path / "records.log"
    lines = []
    for record in (good, *wrong):
        payload = json.dumps(record).encode()
        lines.append(b"%s done %08x %s\n" % (b"a" * 64, zlib.crc32(payload), payload))
    lines.append(b"x" * 3_000_000 + b"\n")
    deep = b"[" * 100_000
    lines.append(b"%s done %08x %s\n" % (b"a" * 64, zlib.crc32(deep), deep))
    path.write_bytes(b"".join(lines))
    assert list(records(path)) == [good]
    assert len(Finished(path, quantity="x")) == 1
    if hasattr(os, "mkfifo"):
        os.mkfifo(tmp_path / "pipe")
        assert list(records(tmp_path / "pipe")) == []
        with pytest.raises(OutputError):
            Store(tmp_path / "pipe")
