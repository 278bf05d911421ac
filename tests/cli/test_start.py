"""Starting up: version, help, and no heavy import before a command runs."""

from __future__ import annotations

import importlib
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from cli.conftest import Runner
from heavy_imports import HEAVY, NOT_FOR_COMMANDS
from instrument_file import bcr

from asperity.cli.main import COMMANDS as PROGRAM
from asperity.cli.main import Program


def test_help_imports_nothing_heavy() -> None:
    code = (
        "import sys, json\n"
        "from asperity.cli.main import app\n"
        "try: app(['--help'])\n"
        "except SystemExit as end: assert end.code == 0\n"
        f"sys.stderr.write(json.dumps([m for m in {HEAVY!r} if m in sys.modules]))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    assert json.loads(done.stderr) == []


LIGHT = {"asperity.core"} | {f"asperity.core.{name}" for name in ("errors", "late", "units", "words")}


def test_help_imports_of_the_library_only_the_commands() -> None:
    """What the commands do lies in other folders; of those only what declares options, and the late
    names."""
    code = (
        "import sys, json\n"
        "from asperity.cli.main import app\n"
        "try: app(['--help'])\n"
        "except SystemExit: pass\n"
        "sys.stderr.write(json.dumps([m for m in sys.modules if m.startswith('asperity.')]))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    elsewhere = {module for module in json.loads(done.stderr) if not module.startswith("asperity.cli")}
    assert elsewhere <= LIGHT


@pytest.mark.parametrize("command", [("info",), ("contact", "--body", "DLC", "--pressure", "50MPa")])
def test_commands_without_output_import_only_what_they_need(tmp_path: Path, command: tuple[str, ...]) -> None:
    scan = tmp_path / "scan.bcr"
    bcr(scan)
    code = (
        "import sys, json\n"
        "from asperity.cli.main import app\n"
        f"try: app([{command[0]!r}, {str(scan)!r}, *{command[1:]!r}])\n"
        "except SystemExit as end: assert end.code in (0, None)\n"
        f"sys.stderr.write('|' + json.dumps([m for m in {NOT_FOR_COMMANDS!r} if m in sys.modules]))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    assert json.loads(done.stderr.rpartition("|")[2]) == []


MOST_FILES = 60


@pytest.mark.slow
def test_a_contact_runs_through_few_files(tmp_path: Path) -> None:
    """Of this package, imports left out: a reader who follows the command opens them."""
    scan = tmp_path / "scan.bcr"
    bcr(scan)
    code = (
        "import cProfile, contextlib, json, pathlib, pstats, sys\n"
        "import asperity\n"
        "from asperity.cli.main import app\n"
        "def command():\n"
        "    with contextlib.suppress(SystemExit):\n"
        f"        app(['contact', {str(scan)!r}, '--body', 'DLC', '--pressure', '50MPa'])\n"
        "command()\n"
        "profile = cProfile.Profile()\n"
        "profile.runcall(command)\n"
        "home = str(pathlib.Path(asperity.__file__).parent)\n"
        "ran = {f for f, _, n in pstats.Stats(profile).stats if f.startswith(home) and not n.startswith('<')}\n"
        "sys.stderr.write('|' + json.dumps(sorted(ran)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    ran = json.loads(done.stderr.rpartition("|")[2])
    assert 30 < len(ran) <= MOST_FILES, ran


def test_module_is_the_program() -> None:
    done = subprocess.run([sys.executable, "-m", "asperity", "--version"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0
    assert done.stdout.startswith("asperity ")


def test_help_lists_every_command(run: Runner) -> None:
    result = run("--help")
    assert result.exit_code == 0
    assert all(command in result.stdout for command in PROGRAM)
    assert "130" in result.stdout


def test_every_command_has_help(run: Runner) -> None:
    for name, line in Program.lines().items():
        command = getattr(importlib.import_module(f"asperity.cli.{PROGRAM[name]}"), name)
        assert command.__doc__.partition("\n")[0] == line, "the list of commands and the page agree"
        page = " ".join(run(name, "-h").stdout.split())
        assert f"Usage: root {name}" in page or f"Usage: asperity {name}" in page, name


def test_advanced_options_are_left_to_help_all(run: Runner) -> None:
    brief, whole = run("contact", "-h").stdout, run("contact", "--help-all").stdout
    for option in ("--pressure", "--body", "--friction", "--out"):
        assert option in brief
    for option in ("--despike", "--max-iterations", "--stress-nc", "--datum"):
        assert option not in brief
        assert option in whole
    assert "--help-all" in brief
    assert "Advanced: " in whole
    assert "ASPERITY_THREADS" in run("-h").stdout


def test_a_mistyped_command_is_answered_by_a_near_one(run: Runner) -> None:
    found = run("contcat", "scan.di")
    assert found.exit_code == 2
    assert "contact?" in found.stderr


def test_quiet_prints_nothing_but_warnings(run: Runner, matrix: Path) -> None:
    found = run(
        "contact", matrix, "--size", "8um x 6um", "--height-unit", "nm", "--body", "DLC", "--pressure", "1MPa", "-q"
    )
    assert (found.exit_code, found.stdout) == (0, "")
    assert "(resolution)" in found.stderr
    assert run("materials", "--quiet").stdout == ""


def test_shells_complete_commands_and_options() -> None:
    for words, wanted in (("asperity ma", "materials"), ("asperity contact --pres", "--pressure")):
        told = {"_ASPERITY_COMPLETE": "complete_bash", "COMP_WORDS": words, "COMP_CWORD": str(words.count(" "))}
        done = subprocess.run(
            [sys.executable, "-m", "asperity"], env={**os.environ, **told}, capture_output=True, text=True, timeout=60
        )
        assert wanted in done.stdout.split(), done.stderr
