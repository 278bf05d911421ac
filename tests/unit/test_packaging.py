"""What pyproject.toml, the constraints of the lowest versions and the commands of a developer say
agrees."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
REQUIREMENT = re.compile(r"([\w-]+)(?:\[[\w,]+\])?>=([\d.]+)")


def test_the_constraints_are_the_lowest_versions_that_are_admitted() -> None:
    extras = PROJECT["optional-dependencies"]
    stated = [*PROJECT["dependencies"], *extras["fast"], *extras["dask"]]
    lowest = dict(match.groups() for text in stated if (match := REQUIREMENT.fullmatch(text)))
    assert len(lowest) == len(stated), "every dependency states one lowest version and no other condition"
    lines = (ROOT / ".ci" / "lowest.txt").read_text(encoding="utf-8").splitlines()
    pinned = dict(line.split("==") for line in lines if line and not line.startswith("#"))
    assert {name: _numbers(version) for name, version in pinned.items()} == {
        name: _numbers(version) for name, version in lowest.items()
    }


def _numbers(version: str) -> tuple[int, ...]:
    """Parts of ``version`` without zeros at the end, since 2.1 and 2.1.0 are the same."""
    parts = [int(part) for part in version.split(".")]
    while parts and parts[-1] == 0:
        parts.pop()
    return tuple(parts)


def test_every_hook_and_every_step_of_the_hosted_checks_is_a_make_target() -> None:
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"^([a-z-]+):", makefile, re.MULTILINE))
    texts = [
        (ROOT / name).read_text(encoding="utf-8") for name in (".pre-commit-config.yaml", ".github/workflows/ci.yml")
    ]
    called = {name for text in texts for name in re.findall(r"\bmake (?:--silent )?([a-z-]+)", text)}
    assert called >= {"style", "layout", "types", "lint", "test", "test-lowest", "test-plain", "coverage", "package"}
    assert called - targets == set()


def test_the_hosted_checks_run_every_supported_python() -> None:
    supported = re.search(r"python: \[(.*)\]", (ROOT / ".github/workflows/ci.yml").read_text(encoding="utf-8"))
    assert supported is not None
    assert [text.strip(' "') for text in supported[1].split(",")] == ["3.11", "3.12", "3.13", "3.14"]
    assert PROJECT["requires-python"] == ">=3.11"
