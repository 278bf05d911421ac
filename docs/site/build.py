"""Builds the site in build/docs/html; `make docs` calls it. Warnings are errors; no network is
used."""

from __future__ import annotations

import sys
from pathlib import Path

import search
from assemble import HERE, ROOT, assemble
from sphinx.cmd.build import build_main

FOLDER = ROOT / "build" / "docs"


def build(folder: Path = FOLDER) -> int:
    """Gather the pages and run Sphinx; returns its exit status."""
    assemble(folder)
    extra = f"html_extra_path={folder / 'extra'}"
    options = ["-b", "html", "-c", HERE, "-d", folder / "doctrees", "-D", extra, "-W", "--keep-going", "-q"]
    status = build_main([str(word) for word in [*options, folder / "source", folder / "html"]])
    if status == 0 and search.can_run() and (lost := search.misled(folder / "html")):
        print("the search leads elsewhere than to the how-to:", *lost, sep="\n  ", file=sys.stderr)
        return 1
    if status == 0:
        print(f"site built: {folder / 'html' / 'index.html'}")
    return status


if __name__ == "__main__":
    sys.exit(build())
