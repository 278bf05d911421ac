"""What the search of the built site finds; ``make docs`` fails where a task leads to another page
than its how-to."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path

HERE = Path(__file__).parent
INDEX = HERE.parent / "how-to" / "index.md"

WORDS = (
    "coating",
    "pull-off",
    "creep",
    "scan",
    "humidity",
    "stiction",
    "hardness",
    "yield",
    "friction",
    "material",
    "cluster",
    "fretting",
    "rubber",
    "thickness",
    "solve",
    "AFM",
    "viscoelastic",
    "layer",
    "filter",
    "hysteresis",
    "sweep",
    "film",
    "residual stress",
    "shakedown",
    "Monte-Carlo",
    "indentation",
)
"""What somebody with a task may ask for; the first page found must be a how-to, whichever."""


def tasks() -> dict[str, str]:
    """Page by task: words of the links in the contents of the how-to."""
    links = re.findall(r"\[([^\]]+)\]\(([\w-]+)\.md\)", INDEX.read_text(encoding="utf-8"))
    return {words: f"how-to/{page}" for words, page in links}


def found(site: Path, queries: list[str]) -> dict[str, list[str]]:
    """Pages that the search of the built ``site`` finds for each of ``queries``, best first,
    without anchors; needs Node.js."""
    command = ["node", str(HERE / "search.js"), str(site), *queries]
    answer = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    pages = [[place.partition("#")[0] for place in places] for places in json.loads(answer)]
    return {query: list(dict.fromkeys(one)) for query, one in zip(queries, pages, strict=True)}


def misled(site: Path) -> list[str]:
    """Queries whose first page is not the how-to, with what is found instead; of the built
    ``site``."""
    wanted = tasks()
    answers = found(site, [*wanted, *WORDS])
    lost = [
        f"{query}: {answers[query][:3]}, not {page}" for query, page in wanted.items() if answers[query][:1] != [page]
    ]
    return lost + [
        f"{word}: {answers[word][:3]}" for word in WORDS if not "".join(answers[word][:1]).startswith("how-to/")
    ]


def can_run() -> bool:
    """Whether there is a Node.js that runs the search."""
    return shutil.which("node") is not None
