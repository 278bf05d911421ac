"""Instrument files are read with the one reader they need, and heights are those of the whole
library."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from instrument_file import bcr
from refusals import refused

from asperity.core.errors import FileFormatError
from asperity.surfaces import reader_library
from asperity.surfaces.read import channels, read

BEHIND = ("scipy.stats", "scipy.signal", "scipy.optimize", "pandas", "SurfaceTopography.IO.NMM")
"""What the whole library imports and no reader before that of the file needs."""

CODE = f"""
import json, sys
import numpy as np
from asperity.surfaces import formats, reader_library
from asperity.surfaces.read import read
first = {{path: read(path) for path in sys.argv[1:]}}
early = [name for name in {BEHIND!r} if name in sys.modules]
formats.opened_by_first_reader = reader_library.opened_by_library
whole = {{path: read(path) for path in sys.argv[1:]}}
import SurfaceTopography, SurfaceTopography.IO
same = [
    np.array_equal(a.heights, b.heights, equal_nan=True) and (a.size, a.origin) == (b.size, b.origin)
    for a, b in zip(first.values(), whole.values())
]
order = reader_library._order(SurfaceTopography.IO)
now = [r.__name__ for r in SurfaceTopography.IO.readers]
print(json.dumps([early, same, now == order, SurfaceTopography.__version__]))
"""


def compared(*files: Path) -> tuple[list[str], list[bool], bool]:
    """In a fresh Python: what was imported by reading ``files``, whether each has the heights that
    the whole library gives, and whether the order of its readers is the one that we use."""
    command = [sys.executable, "-c", CODE, *map(str, files)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    early, same, order, version = json.loads(done.stdout)
    assert version, "the library that was imported in parts is whole when it is asked for"
    return early, same, order


def test_a_file_has_the_heights_of_the_whole_library_without_its_import(tmp_path: Path) -> None:
    heights = bcr(tmp_path / "map.bcr")
    assert compared(tmp_path / "map.bcr") == ([], [True], True)
    surface = read(tmp_path / "map.bcr")
    np.testing.assert_allclose(surface.heights, heights, rtol=1e-12)
    assert surface.size == pytest.approx((90e-9, 60e-9))


@pytest.mark.parametrize("reads", [1, 2])
def test_the_library_is_whole_for_others_after_a_file_was_read(tmp_path: Path, reads: int) -> None:
    """Its classes have their analyses, which it adds with its own code."""
    bcr(tmp_path / "map.bcr")
    code = f"""
import sys
from asperity.surfaces.read import read
for _ in range({reads}):
    read(sys.argv[1])
from SurfaceTopography import Topography, UniformLineScan
import numpy as np
print(Topography(np.eye(4), (1.0, 1.0)).Sq() > 0.0, UniformLineScan(np.arange(4.0), 1.0).Rq() > 0.0)
read(sys.argv[1])
"""
    done = subprocess.run([sys.executable, "-c", code, str(tmp_path / "map.bcr")], capture_output=True, text=True)
    assert done.stdout.split() == ["True", "True"], done.stderr


@pytest.mark.slow
def test_measured_files_have_the_heights_of_the_whole_library_without_its_import(shared_data: Path) -> None:
    files = [path for path in sorted(shared_data.iterdir()) if path.suffix != ".md"]
    assert compared(*files) == ([], [True] * len(files), True)


@pytest.mark.parametrize("changed", ["no list of readers", "a reader that needs more of the library"])
def test_what_a_reader_alone_cannot_read_the_whole_library_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, changed: str
) -> None:
    expected = bcr(tmp_path / "map.bcr")
    if changed == "no list of readers":
        monkeypatch.setattr(reader_library, "_order", lambda package: ())
    else:

        class Incomplete:
            """A reader that opens anything, but is unable to list its channels."""

            @staticmethod
            def can_read(start: bytes) -> object:
                from SurfaceTopography.IO.Reader import MagicMatch

                return MagicMatch.YES

            def __init__(self, path: str) -> None: ...
            def __enter__(self) -> Incomplete:
                return self

            def __exit__(self, *raised: object) -> None: ...

        import SurfaceTopography.IO

        monkeypatch.setattr(SurfaceTopography.IO, "Incomplete", Incomplete, raising=False)
        monkeypatch.setattr(reader_library, "_order", lambda package: ("Incomplete",))
    np.testing.assert_allclose(read(tmp_path / "map.bcr").heights, expected, rtol=1e-12)
    assert channels(tmp_path / "map.bcr")[0].shape == expected.shape


def test_the_list_of_readers_must_stand_once_in_the_source(monkeypatch: pytest.MonkeyPatch) -> None:
    once = "readers = [\n    # a remark\n    AReader,\n    BReader,\n]\n"
    for text, names in ((once, ["AReader", "BReader"]), (once * 2, ()), ("readers = find()\n", ())):
        monkeypatch.setattr(reader_library, "_source", lambda package, text=text: text)
        assert reader_library._order(reader_library) == names


def test_a_file_that_no_reader_knows_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "noise.dat2"
    path.write_bytes(np.random.default_rng(1).bytes(5001))
    with refused(FileFormatError, f"file {path}"):
        read(path)
