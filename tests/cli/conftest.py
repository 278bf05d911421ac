"""A runner of the program and small inputs."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest
from typer.testing import CliRunner, Result

from asperity.cli.main import app

Runner: TypeAlias = Callable[..., Result]


@pytest.fixture(autouse=True)
def plain_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("FORCE_COLOR", "PY_COLORS", "GITHUB_ACTIONS", "TTY_COMPATIBLE", "TERMINAL_WIDTH"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("NO_COLOR", "1")


@pytest.fixture(autouse=True, scope="module")
def quick_pictures(unrendered: None) -> None:
    """A test of pictures takes the fixture ``rendered``."""


@pytest.fixture
def run() -> Runner:
    """Run the program in this process on arguments of any type."""

    def runner(*arguments: object) -> Result:
        return CliRunner().invoke(app, [str(argument) for argument in arguments])

    return runner


@pytest.fixture
def matrix(tmp_path: Path) -> Path:
    """A rough map of 32 x 24 points as a text matrix in nm."""
    heights = np.random.default_rng(1).normal(size=(24, 32))
    path = tmp_path / "rough.txt"
    np.savetxt(path, heights)
    return path


SCALE = ("--size", "8um x 6um", "--height-unit", "nm")
BODY = ("--body", "E=100GPa,nu=0.3,H=5GPa")
LOAD = ("--pressure", "1MPa")
