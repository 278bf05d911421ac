"""The reference values of line scans in tests/reference/profiles are all in use, and equal to the
shared ones they were copied from."""

from __future__ import annotations

from pathlib import Path

import pytest
from reference_data import FOLDER

PROFILES = sorted((FOLDER / "profiles").iterdir())
TESTS = Path(__file__).parents[2]


@pytest.mark.parametrize("path", PROFILES, ids=lambda path: path.name)
def test_every_file_is_read_by_a_test(path: Path) -> None:
    names = (f"profiles/{path.stem}", path.name)
    users = [one.read_text(encoding="utf-8") for one in TESTS.rglob("test_*.py") if one.name != Path(__file__).name]
    assert any(name in text for text in users for name in names), f"no test names {path.name}"


@pytest.mark.parametrize("path", PROFILES, ids=lambda path: path.name)
def test_copies_are_those_that_are_shared(path: Path, shared_data: Path) -> None:
    shared = shared_data.parent / "reference" / "profiles" / path.name
    if not shared.exists():
        pytest.skip(f"the shared reference values are not at {shared}")
    assert path.read_bytes() == shared.read_bytes()


def test_no_shared_table_is_left_out(shared_data: Path) -> None:
    folder = shared_data.parent / "reference" / "profiles"
    shared = {path.name for path in folder.glob("*") if path.suffix in (".csv", ".npz")}
    if not shared:
        pytest.skip(f"the shared reference values are not at {folder}")
    assert shared == {path.name for path in PROFILES}
