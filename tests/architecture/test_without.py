"""Each physics can be left out: without its folder and its lines in the registry the package
solves, saves, tells and prints all else."""

from __future__ import annotations

import ast
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

import pytest
from architecture.source import ROOT, imports, library
from architecture.test_layers import NAMED

from asperity.core.registry import NEEDS
from asperity.parts.registry import parts

PHYSICS = tuple(sorted(path.parent.name for path in ROOT.glob("physics/*/__init__.py") if path.parent.name != "pairs"))
"""Folders."""

ONLY_FOR = {
    "asperity.run.tractions": ("stress",),
    "asperity.report.tractions": ("stress",),
    "asperity.report.animation": ("indentation", "plastic_flow"),
    "asperity.report.animation_wear": ("wear",),
    "asperity.cli.predict": ("prediction",),
}
"""Modules outside the folders that serve some physics alone: loads without a contact, pictures of
plastic zones, commands."""

NOT_YET = {
    "asperity.cli.results": "the command `stress` stands beside those on all results",
    "asperity.web.tasks": "stresses on request",
    "asperity.web.views": "maps of stresses",
}
"""Modules that import a physics at the top though they do more. An entry that is not in use
fails."""

QUICK = ("tests/unit/contact/test_measure.py", "tests/unit/io/test_layered_results.py")
"""Tests that concern no physics and end soon."""

FULL = ("tests/laws", "tests/unit/contact", "tests/unit/io", "tests/unit/plots", "tests/unit/core", "tests/unit/solids")
"""Folders from which files that do not concern a physics are run, slowly."""

EVERY = 40
"""Of these files each physics has every fortieth, each another one to begin with: all take minutes
for each physics."""


OF_ALL = ("test_every_reference_is_named_by_the_code", "test_examples", "test_format2")
"""Tests, and files of them, of the whole package that no physics can be left out of: papers are
listed whoever rests on them, examples and files of an older version are of several physics."""


def left_out(physics: str) -> frozenset[str]:
    """The folder of ``physics`` and those that cannot be without it."""
    found = {physics}
    while more := {name for name, needed in NEEDS.items() if found & {*needed}} - found:
        found |= more
    return frozenset(found)


def registry_without(text: str, folders: Iterable[str]) -> str:
    """The ``text`` of the registry without the entries of its lists that name one of the
    ``folders``."""
    pattern, tree, gone = re.compile(rf"\bphysics\.({'|'.join(folders)})\b"), ast.parse(text), 0
    for node in ast.walk(tree):
        if isinstance(node, ast.Dict):
            kept = [(key, item) for key, item in zip(node.keys, node.values, strict=True) if not names(item, pattern)]
            gone += len(node.values) - len(kept)
            node.keys, node.values = [key for key, _ in kept], [item for _, item in kept]
        elif isinstance(node, ast.Tuple):
            left = [item for item in node.elts if not names(item, pattern)]
            gone += len(node.elts) - len(left)
            node.elts = left
    assert gone, f"the registry names none of {sorted(folders)}"
    return ast.unparse(tree)


def names(entry: ast.expr, pattern: re.Pattern[str]) -> bool:
    """Whether an ``entry`` of a list names what the ``pattern`` looks like."""
    return pattern.search(ast.unparse(entry)) is not None


def modules_without(folders: frozenset[str]) -> list[str]:
    """Modules outside the ``folders`` that serve these alone."""
    return [module for module, served in ONLY_FOR.items() if folders & {*served}]


def stub_without(text: str, folders: frozenset[str]) -> str:
    """The ``text`` of a stub without the names that come from one of the ``folders``, and from what
    serves these alone."""
    places = "|".join(re.escape(module.partition(".")[2]) for module in modules_without(folders))
    if places:
        text = re.sub(rf"^from \.+({places}) import (\([^)]*\)|.*)\n", "", text, flags=re.MULTILINE)
    names = "|".join(folders)
    text = re.sub(rf"^from \.+physics\.({names})\b\S* import (\([^)]*\)|.*)\n", "", text, flags=re.MULTILINE)
    return re.sub(rf"^from \.+physics import ({names})\n", "", text, flags=re.MULTILINE)


def copy_without(folders: frozenset[str], to: Path) -> Path:
    """A copy of the package without the ``folders``, with which ``PYTHONPATH`` may begin."""
    package = to / "asperity"
    shutil.copytree(ROOT, package)
    for name in folders:
        shutil.rmtree(package / "physics" / name)
    for module in modules_without(folders):
        package.joinpath(*module.split(".")[1:]).with_suffix(".py").unlink()
    registry = package / "core" / "registry.py"
    registry.write_text(registry_without(registry.read_text(encoding="utf-8"), folders), encoding="utf-8")
    for stub in package.rglob("*.pyi"):
        stub.write_text(stub_without(stub.read_text(encoding="utf-8"), folders), encoding="utf-8")
    return to


SCRIPT = """
import io, os, sys
from pathlib import Path
import numpy as np
import pytest
import asperity as asp
from asperity.cli.main import app
from typer.testing import CliRunner

folder, gone = Path(sys.argv[1]), sys.argv[2].split()
for name in gone:
    try:
        __import__(f"asperity.physics.{name}")
    except ModuleNotFoundError:
        continue
    raise SystemExit(f"{name} is still there")
for name in asp.__all__:
    getattr(asp, name)
heights = np.random.default_rng(1).normal(size=(16, 12)) * 1e-9
surface = asp.Surface(heights, 2e-8, periodic=True)
problem = asp.ContactProblem(surface, asp.Elastic(1e11, 0.3), law=asp.Hardness(8e9))
single = asp.solve(problem, asp.MeanPressure(1e8))
path = asp.solve(problem, asp.History([asp.MeanPressure(p) for p in (1e8, 2e8, 5e7)]))
for result in (single, path):
    asp.save(result, folder / "r.nc", overwrite=True)
    again = asp.load(folder / "r.nc")
    for one, other in zip(getattr(result, "steps", [result]), getattr(again, "steps", [again])):
        for field in ("pressure", "permanent_indentation", "plastic"):
            assert getattr(one, field).tobytes() == getattr(other, field).tobytes(), field
        assert one.approach == other.approach and one.status == other.status
    assert repr(result) == repr(again) and len(repr(result).splitlines()) > 5
    assert repr(getattr(result, "last", result).problem)
    asp.files.export_csv(result, folder / "r.csv", overwrite=True)
    result.to_xarray()
    result.plot()
np.savetxt(folder / "rough.txt", heights / 1e-9)
asked = ["contact", "rough.txt", "--size", "320nm x 240nm", "--height-unit", "nm"]
asked += ["--body", "E=100GPa,nu=0.3,H=5GPa", "--pressure", "100MPa"]
begun = Path.cwd()
os.chdir(folder)
done = CliRunner().invoke(app, [*asked, "--out", "run"])
assert done.exit_code == 0, (done.stdout, done.stderr, done.exception)
asp.load(folder / "run" / "result.nc")
os.chdir(begun)
raise SystemExit(pytest.main(["-q", "-x", "-p", "no:randomly", "-p", "no:cacheprovider", *sys.argv[3:]]))
"""
"""What works without any physics."""


def run_in(copy: Path, *arguments: str) -> None:
    """Run Python in the ``copy`` of the package and require that it succeeds."""
    tests = ROOT.parents[1] / "tests"
    there = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, (copy, tests))), "MPLBACKEND": "Agg"}
    done = subprocess.run(
        [sys.executable, *arguments], capture_output=True, text=True, check=False, env=there, cwd=tests.parent
    )
    assert done.returncode == 0, f"{done.stdout[-3000:]}\n{done.stderr[-3000:]}"


def test_no_module_needs_a_physics_at_its_top() -> None:
    """Outside the folder, but for those that serve it alone, and inside folders that the registry
    says to need it."""
    used, wrong = set(), []
    for module in library():
        own = module.name.split(".")[2:3] if module.name.startswith("asperity.physics.") else []
        for item in imports(module):
            parts = item.target.split(".")
            if (
                item.late
                or item.typing
                or parts[:2] != ["asperity", "physics"]
                or len(parts) < 3
                or module.name in NAMED
            ):
                continue
            needed = {name for each in own for name in (each, *NEEDS.get(each, ()))}
            if parts[2] in needed or module.name in ONLY_FOR:
                continue
            used.add(module.name)
            if module.name not in NOT_YET:
                wrong.append(f"{module.name}:{item.line} imports {item.target}")
    assert wrong == []
    assert used == set(NOT_YET), "remove the entries of NOT_YET that are no longer needed"


@pytest.mark.parametrize("physics", PHYSICS)
def test_all_else_works(physics: str, tmp_path: Path) -> None:
    folders = left_out(physics)
    copy = copy_without(folders, tmp_path / "copy")
    run_in(copy, "-c", SCRIPT, str(tmp_path), " ".join(folders), *QUICK)


@pytest.mark.slow
@pytest.mark.parametrize("physics", PHYSICS)
def test_tests_that_do_not_concern_it_pass(physics: str, tmp_path: Path) -> None:
    folders = left_out(physics)
    chosen = [str(path) for path in unconcerned(folders)][PHYSICS.index(physics) :: EVERY]
    assert chosen
    copy = copy_without(folders, tmp_path / "copy")
    others = " and ".join(f"not {name}" for name in OF_ALL)
    quiet = ("-q", "-x", "-p", "no:randomly", "-p", "no:cacheprovider")
    run_in(copy, "-m", "pytest", *quiet, "-m", "not slow", "-k", others, *chosen)


@cache
def files_of_tests() -> tuple[tuple[Path, str], ...]:
    """All files of tests and their texts."""
    return tuple((path, path.read_text(encoding="utf-8")) for path in (ROOT.parents[1] / "tests").rglob("*.py"))


@cache
def imported(text: str) -> frozenset[str]:
    """Names of modules, and of packages around them, after ``from`` or ``import`` in a ``text``."""
    found = re.findall(r"\b(?:from|import) ((?:\w+\.)*\w+)", text)
    return frozenset(name for path in found for name in path.split("."))


def unconcerned(folders: frozenset[str]) -> Iterator[Path]:
    """Files of tests in ``FULL`` that neither import from the ``folders`` nor name what comes from
    them, nor have a helper that does."""
    gone: set[str] = set()
    for stub in ROOT.rglob("*.pyi"):
        origins = (
            item for item in ast.parse(stub.read_text(encoding="utf-8")).body if isinstance(item, ast.ImportFrom)
        )
        gone |= {
            alias.name
            for item in origins
            if (item.module or "").startswith("physics.") and (item.module or "").split(".")[1] in folders
            for alias in item.names
        }
    tables = {
        part.table.split(".")[0] for part in parts() if type(part).__module__.split(".")[2] in folders and part.table
    }
    asked = (rf"[\"\[]{name}\b|\b{name}=" for name in tables | folders)
    served = (rf"{module.rpartition('.')[2]}\b" for module in modules_without(folders))
    named = (*(rf"physics\.{name}\b" for name in folders), *(rf"\b{name}\b" for name in gone))
    words = re.compile("|".join([*named, *asked, *served]))
    bad = {path.stem for path, text in files_of_tests() if words.search(f"{path.stem}\n{text}")}
    while more := {path.stem for path, text in files_of_tests() if path.stem not in bad and bad & imported(text)}:
        bad |= more
    tests = ROOT.parents[1] / "tests"
    for place in FULL:
        yield from sorted(path for path in (tests.parent / place).rglob("test_*.py") if path.stem not in bad)
