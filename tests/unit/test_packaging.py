"""What pyproject.toml, the constraints of the lowest versions and the commands of a developer say
agrees."""

from __future__ import annotations

import importlib.util
import re
import tomllib
from pathlib import Path

import pytest

import asperity

ROOT = Path(__file__).parents[2]
SPEC = importlib.util.spec_from_file_location("release_check", ROOT / ".ci" / "release_check.py")
assert SPEC is not None
assert SPEC.loader is not None
release_check = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(release_check)
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
    assert called >= {
        "style",
        "layout",
        "types",
        "lint",
        "test",
        "test-lowest",
        "test-plain",
        "coverage",
        "release-check",
    }
    assert called - targets == set()


def test_the_hosted_checks_run_every_supported_python() -> None:
    supported = re.search(r"python: \[(.*)\]", (ROOT / ".github/workflows/ci.yml").read_text(encoding="utf-8"))
    assert supported is not None
    assert [text.strip(' "') for text in supported[1].split(",")] == ["3.11", "3.12", "3.13", "3.14"]
    assert PROJECT["requires-python"] == ">=3.11"
    versions = [text.rpartition(" :: ")[2] for text in PROJECT["classifiers"] if "Python :: 3." in text]
    assert versions == ["3.11", "3.12", "3.13", "3.14"]


def test_the_version_is_the_same_everywhere_and_the_changelog_has_its_section() -> None:
    assert release_check.version() == PROJECT["version"] == asperity.__version__


def test_a_version_that_stands_alone_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("pyproject.toml", "CITATION.cff", "CHANGELOG.md", "src/asperity/__init__.py"):
        target = tmp_path / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text((ROOT / name).read_text(encoding="utf-8"), encoding="utf-8")
    monkeypatch.setattr(release_check, "ROOT", tmp_path)
    assert release_check.version() == PROJECT["version"]
    citation = tmp_path / "CITATION.cff"
    citation.write_text(citation.read_text(encoding="utf-8").replace(PROJECT["version"], "9.9.9"), encoding="utf-8")
    with pytest.raises(SystemExit):
        release_check.version()
