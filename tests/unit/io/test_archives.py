"""Archives of problems: nothing is lost on the way to another machine, and nothing gets out of the
folder into which a stranger's one is unpacked."""

from __future__ import annotations

import stat
import warnings
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w
from refusals import refused

from asperity.core.errors import FileFormatError
from asperity.core.grid import Grid
from asperity.files import save_surface
from asperity.generate import ExponentialAutocorrelation, gaussian
from asperity.run.archive import carried, gathered, unpack, write_archive
from asperity.run.build import build
from asperity.run.document import PROBLEM, checked, files_named, files_of, is_archive, load_document, with_files

ARCHIVE = "archive of a problem"


@pytest.fixture
def scans(tmp_path: Path) -> Path:
    """Folder with files of heights, two of them of one name."""
    for number, name in enumerate(("one/scan 7.nc", "two/scan 7.nc", "two/other.nc")):
        file = tmp_path / "here" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        model = ExponentialAutocorrelation(1e-9, 2e-7)
        save_surface(gaussian(Grid((64, 64), (5e-8, 5e-8)), model, seed=number), file)
    return tmp_path / "here"


def document(scans: Path) -> Any:
    """A problem with files at every place that may name one."""
    spectrum = {"kind": "scans", "scans": [{"path": "one/scan 7.nc"}, {"path": str(scans / "two" / "other.nc")}]}
    rough = {"kind": "rough", "points": "64x64", "size": "3.2 um x 3.2 um", "seed": 1, "spectrum": spectrum}
    frequency = np.geomspace(0.1, 1e3, 12)
    rows = "\n".join(f"{f},{3 + f / (f + 10)},{10 * f / (f * f + 100)}" for f in frequency)
    (scans / "rubber.csv").write_text(f"frequency (Hz), storage modulus (MPa), loss modulus (MPa)\n{rows}\n")
    relaxation = {"kind": "measured", "moduli_file": "rubber.csv"}
    return checked(
        {
            "version": 2,
            "surface": rough,
            "counter_surface": {"kind": "file", "path": "two/scan 7.nc", "mirror": "none"},
            "body": {"poisson_ratio": 0.49, "relaxation": relaxation},
            "control": {"mean_pressure": "1 MPa"},
        }
    )


def test_a_problem_is_the_same_on_another_machine(scans: Path, tmp_path: Path) -> None:
    asked = document(scans)
    before = build(asked, scans)
    write_archive(tmp_path / "problem.zip", asked, scans, {})
    assert is_archive(tmp_path / "problem.zip")
    scans.rename(tmp_path / "gone")
    there = tmp_path / "there"
    there.mkdir()
    problem = unpack(tmp_path / "problem.zip", there)
    found = load_document(problem)
    names = [path.relative_to(there).as_posix() for path in files_of(found, there)]
    assert sorted(names) == ["other.nc", "rubber.csv", "scan 7 (2).nc", "scan 7.nc"]
    after = build(found, there)
    np.testing.assert_array_equal(before.problem.surface.heights, after.problem.surface.heights)
    np.testing.assert_array_equal(before.problem.counter_surface.heights, after.problem.counter_surface.heights)
    assert before.problem.body == after.problem.body


def test_files_get_no_name_that_is_taken(scans: Path, tmp_path: Path) -> None:
    asked = checked(
        {
            "version": 2,
            "surface": {"kind": "file", "path": "two/other.nc"},
            "counter_surface": {"kind": "file", "path": "two/../two/other.nc", "mirror": "none"},
            "body": "DLC",
            "control": {"mean_pressure": "1 MPa"},
        }
    )
    found, files = gathered(asked, scans, taken=("OTHER.nc",))
    assert files == {"other (2).nc": (scans / "two" / "other.nc").resolve()}
    assert {path.name for path in files_of(found, Path())} == {"other (2).nc"}
    out = tmp_path / "out"
    out.mkdir()
    there = carried(asked, scans, out, within=scans / "one")
    assert [*out.iterdir()] == []
    assert [str(path) for path in files_of(there, out)] == [str(scans.resolve() / "two" / "other.nc")] * 2


def packed(file: Path, entries: dict[str, bytes], named: str = "scan.txt") -> Path:
    """An archive with a document that names a file, and these entries."""
    table = {"version": 2, "surface": {"kind": "file", "path": named}}
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr(PROBLEM, tomli_w.dumps(table))
        for name, content in entries.items():
            archive.writestr(name, content)
    return file


def test_only_what_the_document_names_is_taken_out(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    entries = {"../../evil.txt": b"1", "/tmp/evil.txt": b"1", "more.sh": b"1", "a/scan.txt": b"1 2\n3 4\n"}
    unpack(packed(tmp_path / "a.zip", entries, "a/scan.txt"), tmp_path / "out")
    found = sorted(path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file())
    assert found == ["a.zip", "out/a/scan.txt", "out/problem.toml"]


OUTSIDE = (
    "../evil.txt",
    "a/../../evil.txt",
    "/etc/passwd",
    "C:\\evil.txt",
    "..\\evil.txt",
    "C:evil.txt",
    "a//b.txt",
    "./scan.txt",
    "",
    PROBLEM,
)


@pytest.mark.parametrize("name", OUTSIDE)
def test_names_that_lead_elsewhere_are_refused(name: str, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    archive = packed(tmp_path / "a.zip", {} if name == PROBLEM else {name or "x": b"1 2\n3 4\n"}, name)
    with refused(FileFormatError, ARCHIVE):
        unpack(archive, tmp_path / "out")
    found = {path.name for path in tmp_path.rglob("*") if path.is_file()}
    assert found == {"a.zip", PROBLEM}


def linked(file: Path) -> Path:
    packed(file, {})
    entry = zipfile.ZipInfo("scan.txt")
    entry.external_attr = (stat.S_IFLNK | 0o777) << 16
    with zipfile.ZipFile(file, "a") as archive:
        archive.writestr(entry, "/etc/passwd")
    return file


def twice(file: Path) -> Path:
    packed(file, {"scan.txt": b"1 2\n3 4\n"})
    with zipfile.ZipFile(file, "a") as archive, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        archive.writestr("scan.txt", "5 6\n7 8\n")
    return file


def cut(file: Path) -> Path:
    content = packed(file, {"scan.txt": bytes(10_000)}).read_bytes()
    file.write_bytes(content[:400] + b"\1" * 50 + content[450:])
    return file


def encrypted(file: Path) -> Path:
    content = bytearray(packed(file, {"scan.txt": b"1 2\n3 4\n"}).read_bytes())
    at = content.rindex(b"PK\x01\x02")
    content[at + 8] |= 1
    file.write_bytes(content)
    return file


def no_zip(file: Path) -> Path:
    file.write_bytes(b"PK\x03\x04" + bytes(100))
    return file


DAMAGED: tuple[Callable[[Path], Path], ...] = (linked, twice, cut, encrypted, no_zip, lambda file: packed(file, {}))


@pytest.mark.parametrize("make", DAMAGED)
def test_entries_that_are_no_plain_files_are_refused(make: Callable[[Path], Path], tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    with refused(FileFormatError, ARCHIVE):
        unpack(make(tmp_path / "a.zip"), tmp_path / "out")


def test_what_is_larger_than_there_is_room_for_is_refused(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    bomb = tmp_path / "a.zip"
    with zipfile.ZipFile(bomb, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(PROBLEM, tomli_w.dumps({"version": 2, "surface": {"kind": "file", "path": "scan.txt"}}))
        archive.writestr("scan.txt", bytes(5_000_000))
    with refused(FileFormatError, ARCHIVE, "scan.txt"):
        unpack(bomb, tmp_path / "out", largest=4_000_000)
    assert not (tmp_path / "out" / "scan.txt").exists()


def test_files_in_texts_are_named_and_renamed() -> None:
    table = {
        "surface": {"path": "a.di", "spectrum": {"scans": ["b.txt, size=5um", {"path": "c, d.txt"}]}},
        "body": "nu=0.5,moduli=e.csv:1um/steel",
        "counter_body": {"base": "moduli=f.csv,nu=0.5", "layers": ["DLC:5nm"]},
        "path": ["1 MPa", "0 Pa"],
        "title": "a.di",
    }
    names = ["a.di", "b.txt", "c, d.txt", "e.csv", "f.csv"]
    assert sorted(set(files_named(table))) == names
    moved = with_files(table, lambda name: f"there/{name}")
    assert sorted(set(files_named(moved))) == [
        f"there/{name}" for name in ("a.di", "b.txt", "c, d.txt", "e.csv", "f.csv")
    ]
    assert (moved["title"], moved["path"]) == ("a.di", ["1 MPa", "0 Pa"])


def test_a_zip_file_without_a_document_is_none(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr("scan.txt", "1 2")
    assert not is_archive(tmp_path / "a.zip")
    (tmp_path / "b.zip").write_bytes(b"PK")
    assert not is_archive(tmp_path / "b.zip")
    assert not is_archive(tmp_path / "c.zip")
