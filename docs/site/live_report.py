"""The report of `asperity demo`, made when the site is built and shown in a frame of its first
page."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

from typer.testing import CliRunner

from asperity.cli.main import app

NAME = "demo-report.html"
"""File of the report, beside the first page."""

MARK = "<!-- the live report -->"
"""Stands in the first page where the site shows the report; in a checkout it is not seen."""

FRAME = f"""```{{raw}} html
<iframe class="report" src="{NAME}" title="Report of asperity demo" loading="lazy"></iframe>
<p class="report"><a href="{NAME}">The report on a page of its own</a></p>
```
"""


def write(folder: Path) -> Path:
    """Run `asperity demo` and keep its report in ``folder``; returns the file."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as run:
        result = CliRunner().invoke(app, ["demo", "--out", str(Path(run) / "demo")])
        if result.exit_code:
            raise RuntimeError(result.output)
        shutil.copy(Path(run) / "demo" / "report.html", folder / NAME)
    return folder / NAME
