"""Pages of measured numbers are those that were stored, and the constants on theirs are those of
the source."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
BENCHMARKS = ROOT / "benchmarks"


def checked(script: str) -> str:
    """What ``script`` says of a page that is out of date; empty if it is not."""
    done = subprocess.run(
        [sys.executable, str(BENCHMARKS / script), "--check"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    return "" if done.returncode == 0 else done.stderr or f"{script} --check ended with {done.returncode}"


def test_tables_of_the_page_are_the_stored_ones() -> None:
    assert checked("tables.py") == ""


def test_constants_of_the_page_are_those_of_the_source() -> None:
    assert checked("constants.py") == ""


def test_a_broken_run_leaves_the_page_whole(tmp_path: Path) -> None:
    """The last thing a script does is to replace files whole; a process that ends before leaves the
    old ones."""
    code = f"""
import sys
sys.path.insert(0, {str(BENCHMARKS)!r})
import tables
from pathlib import Path
tables.PAGE, tables.RESULTS = Path("README.md"), Path("results")
first, second = (tables.made("one", ("n", "empty"), [[n, None]]) for n in (1, 2))
tables.show(first, write=True)
tables.json.dumps = None  # the next one breaks off
tables.show(second, write=True)
"""
    page = tmp_path / "README.md"
    page.write_text("before\n<!-- table one -->\n<!-- end -->\nbetween\n<!-- table two -->\nold\n<!-- end -->\nafter\n")
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert "TypeError" in done.stderr
    text = page.read_text(encoding="utf-8")
    assert "| n |\n|---|\n| 1 |\n<!-- end -->" in text
    assert text.startswith("before\n<!-- table one -->\n")
    assert text.endswith("between\n<!-- table two -->\nold\n<!-- end -->\nafter\n")
    assert sorted(path.name for path in tmp_path.rglob("*") if path.is_file()) == ["README.md", "one.json"]


def test_every_command_of_the_benchmarks_has_its_script() -> None:
    listed = [
        subprocess.run(
            [sys.executable, str(BENCHMARKS / "bench.py"), "--list", *options],
            capture_output=True,
            text=True,
            check=True,
        ).stdout.splitlines()
        for options in ([], ["--full"])
    ]
    page = (BENCHMARKS / "README.md").read_text(encoding="utf-8")
    for command in [*listed[0], *listed[1], *re.findall(r"^(?:python|`python) (benchmarks/\S+)", page, re.MULTILINE)]:
        words = shlex.split(command.strip("`"))
        assert (ROOT / (words[1] if words[0] == "python" else words[0])).is_file(), command
