"""Where the text goes: a closed, full or narrow-minded output."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from asperity.cli.main import BAD_INPUT, diagnosis

PROGRAM = f'"{sys.executable}" -m asperity'
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs a POSIX shell")


def shell(line: str, **variables: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["bash", "-c", f"set -o pipefail; {line}"],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        env=os.environ | variables,
    )


def test_a_reader_that_leaves_is_no_failure() -> None:
    done = shell(f"({PROGRAM} materials; echo code=$? >&2) | true")
    assert done.stderr == "code=0\n"


def test_closed_output_is_no_failure() -> None:
    done = shell(f"{PROGRAM} materials >&-")
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.skipif(not Path("/dev/full").is_char_device(), reason="no /dev/full")
def test_full_output_is_one_sentence() -> None:
    done = shell(f"{PROGRAM} materials > /dev/full")
    assert done.returncode == BAD_INPUT
    assert done.stderr.startswith("asperity: Output cannot be written: No space left on device.")
    assert len(done.stderr.splitlines()) == 1


def test_other_operating_system_errors_stay_unforeseen() -> None:
    assert diagnosis(OSError("odd"))[0] != BAD_INPUT


def test_output_in_ascii_shows_codes_of_letters() -> None:
    done = shell(f"{PROGRAM} materials", PYTHONIOENCODING="ascii")
    assert (done.returncode, done.stderr) == (0, "")
    assert "\\u03bd" in done.stdout
