"""Reading the pages of docs/: code, commands and links."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
BLOCK = re.compile(r"^[ ]*```.*?^[ ]*```", re.DOTALL | re.MULTILINE)


def blocks(page: Path, language: str) -> list[str]:
    """Blocks of code of a page in one language."""
    return re.findall(rf"^[ ]*```{language}\n(.*?)^[ ]*```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def prose(page: Path) -> str:
    """Text of a page without its blocks of code and the code within its lines."""
    return re.sub(r"`[^`\n]*`", "", BLOCK.sub("", page.read_text(encoding="utf-8")))


def links(page: Path) -> list[str]:
    """What a page links to, as it is written; those within code not."""
    return re.findall(r"\]\(([^)\s]+)\)", prose(page))


def linked(page: Path) -> set[Path]:
    """Files that a page links to."""
    return {(page.parent / aim.partition("#")[0]).resolve() for aim in links(page) if not re.match(r"\w+:", aim)}
