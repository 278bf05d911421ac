"""Checks that this tree can be released: ``make release-check``.

In turn: the version is the same wherever it stands and the changelog has its section; wheel and
source archive are built and pass ``twine check``; each of them installs in an empty environment
with the newest and with the lowest admitted versions of all dependencies, tells its version and
runs the demo; the site is built, and its links lead somewhere (``--external`` asks other sites
too).
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LOWEST = ROOT / ".ci" / "lowest.txt"
DEPENDENCIES = {"newest": (), "lowest": ("--constraint", str(LOWEST))}


def run(*command: str | Path, folder: Path = ROOT) -> str:
    """Output of a ``command`` in ``folder``; whatever fails ends the check and is shown."""
    done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def version() -> str:
    """The version of the project; refuses one that other files do not share."""
    stated = str(tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"])
    places = {
        "src/asperity/__init__.py": r'^__version__ = "(.*)"$',
        "CITATION.cff": r"^version: (.*)$",
        "CHANGELOG.md": r"^## \[(\d.*)\]",
    }
    for name, pattern in places.items():
        found = re.search(pattern, (ROOT / name).read_text(encoding="utf-8"), re.MULTILINE)
        if found is None or found[1] != stated:
            sys.exit(f"pyproject.toml states version {stated}, but {name} {found[1] if found else 'none'}")
    return stated


def built(folder: Path) -> Sequence[Path]:
    """Wheel and source archive in ``folder``, which has nothing else then."""
    shutil.rmtree(folder, ignore_errors=True)
    run(sys.executable, "-m", "build", "--quiet", "--outdir", folder)
    archives = sorted([*folder.glob("*.whl"), *folder.glob("*.tar.gz")])
    run(sys.executable, "-m", "twine", "check", "--strict", *archives)
    return archives


def install(archive: Path, constraint: Sequence[str], stated: str) -> None:
    """Install an ``archive`` in an empty environment and use it from an empty folder."""
    with tempfile.TemporaryDirectory() as name:
        room = Path(name)
        run(sys.executable, "-m", "venv", room / "venv")
        programs = room / "venv" / ("Scripts" if sys.platform == "win32" else "bin")
        pip = (programs / "python", "-m", "pip", "--disable-pip-version-check")
        run(*pip, "install", "--quiet", archive, *constraint)
        run(*pip, "check")
        told = run(programs / "asperity", "--version", folder=room).split()[-1]
        if told != stated:
            sys.exit(f"{archive.name} says it is version {told}")
        run(programs / "asperity", "demo", "--out", "demo-run", folder=room)
        if not (room / "demo-run" / "report.html").stat().st_size:
            sys.exit(f"{archive.name}: the demo wrote no report")


def main() -> None:
    """Run all checks, each told as it passes."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--external", action="store_true", help="follow the links to other sites as well")
    options = parser.parse_args()
    stated = version()
    print(f"version {stated} everywhere, with its section in the changelog", flush=True)
    for archive in built(ROOT / "dist"):
        for kind, constraint in DEPENDENCIES.items():
            if kind == "lowest" and sys.version_info[:2] != (3, 11):
                print(f"{archive.name}: lowest versions are those of Python 3.11, not tried on this one", flush=True)
                continue
            install(archive, constraint, stated)
            print(f"{archive.name}: installed with the {kind} versions, demo done", flush=True)
    run(sys.executable, "docs/site/build.py")
    site = ROOT / "build" / "docs" / "html"
    more = ["--check-extern"] if options.external else []
    run(Path(sys.executable).with_name("linkchecker"), "--no-status", "--no-warnings", *more, site / "index.html")
    print("site built, its links lead somewhere")


if __name__ == "__main__":
    main()
