"""Starting up: version, help, and no heavy import before a command runs."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest
from cli.conftest import Runner
from heavy_imports import HEAVY

COMMANDS = (
    *("contact", "demo", "info", "materials", "liquids", "plot", "export", "cite", "generate"),
    *("run", "status", "collect"),
)


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


LIGHT = {"asperity.core"} | {f"asperity.core.{name}" for name in ("errors", "late", "parameters", "units", "values")}


def test_help_imports_of_the_library_only_the_commands() -> None:
    """What the commands do lies in other folders; of those only what declares options, and the late names."""
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


def test_module_is_the_program() -> None:
    done = subprocess.run([sys.executable, "-m", "asperity", "--version"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0
    assert done.stdout.startswith("asperity ")


def test_help_lists_every_command(run: Runner) -> None:
    result = run("--help")
    assert result.exit_code == 0
    assert all(command in result.stdout for command in COMMANDS)
    assert "130 interrupted" in " ".join(result.stdout.split())


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help(run: Runner, command: str) -> None:
    result = run(command, "--help")
    assert result.exit_code == 0
    assert "Usage: asperity" in result.stdout or f"Usage: root {command}" in result.stdout
