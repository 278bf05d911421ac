"""Builds the site in build/docs/html; `make docs` calls it. Warnings are errors; no network is
used."""

from __future__ import annotations

import sys
from pathlib import Path

from assemble import HERE, ROOT, assemble
from sphinx.cmd.build import build_main

FOLDER = ROOT / "build" / "docs"


def build(folder: Path = FOLDER) -> int:
    """Gather the pages and run Sphinx; returns its exit status."""
    assemble(folder)
    options = ["-b", "html", "-c", HERE, "-d", folder / "doctrees", "-W", "--keep-going", "-q"]
    status = build_main([str(word) for word in [*options, folder / "source", folder / "html"]])
    if status == 0:
        print(f"site built: {folder / 'html' / 'index.html'}")
    return status


if __name__ == "__main__":
    sys.exit(build())
