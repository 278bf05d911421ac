"""Gathers the pages of the site: those of docs/, validation/ and benchmarks/, and those made from
declarations.

``python docs/site/assemble.py FOLDER`` writes them. Links between files of the repository become
links between pages.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
from pathlib import Path, PurePosixPath

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))

import live_report  # noqa: E402 - found by the line above

LEVELS = ("beginner", "intermediate", "advanced", "expert")
"""Folders of examples, in the order of the gallery."""

CONTENTS = "\n```{toctree}\n:hidden:\n:glob:\n\n*\n```\n"

Texts = dict[str, str]


def homes() -> dict[str, str]:
    """Where the files of the repository are on the site: path in the repository, page."""
    found = {f"docs/{path}": path for path in _below(ROOT / "docs", "*.md")}
    found |= {f"validation/{path}": f"validation/{path}" for path in _below(ROOT / "validation", "*.md")}
    return found | {
        "validation/README.md": "validation/index.md",
        "benchmarks/README.md": "speed/index.md",
        "CONTRIBUTING.md": "develop/contributing.md",
        "CHANGELOG.md": "develop/changes.md",
        "SECURITY.md": "develop/security.md",
    }


ELSEWHERE = {"examples/README.md": "gallery/index.md", "examples": "gallery/index.md"}
"""Files of the repository in whose place the site has a page of its own."""


def _below(folder: Path, pattern: str) -> list[str]:
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob(pattern))


def made() -> Texts:
    """Text of the pages made from declarations.

    Where ``docs/`` has a page of the same place, it says how to read the same in a checkout, and
    the site shows this one.
    """
    import commands
    import documents
    import interface
    import theories

    pages = {"reference/theories.md": theories.page(), "reference/commands.md": commands.page()}
    return pages | documents.pages() | interface.pages()


def examples() -> Texts:
    """The scripts of the gallery and the heads of their levels."""
    scripts = {level: sorted((ROOT / "examples" / level).glob("*.py")) for level in LEVELS}
    if not any(scripts.values()):
        return {}
    found = {"GALLERY_HEADER.rst": (HERE / "gallery.rst").read_text(encoding="utf-8")}
    for level, paths in scripts.items():
        if not paths:
            continue
        own = [path for path in (ROOT / "examples" / level).iterdir() if path.stem in ("GALLERY_HEADER", "README")]
        title = level.capitalize()
        found[f"{level}/GALLERY_HEADER.rst"] = f"{title}\n{'-' * len(title)}\n"
        found |= {
            f"{level}/GALLERY_HEADER{path.suffix}": path.read_text(encoding="utf-8")
            for path in own
            if path.suffix == ".rst"
        }
        found |= {f"{level}/{path.name}": path.read_text(encoding="utf-8") for path in paths}
    return found


def gallery() -> str:
    """The first page of the gallery, which the gallery makes itself where there are examples."""
    return "gallery/index.rst" if examples() else "gallery/index.md"


def pages() -> Texts:
    """Every page of the site, its path and text, links between pages included; the gallery makes
    its own."""
    known = homes()
    found = {home: linked((ROOT / path).read_text(encoding="utf-8"), path, known) for path, home in known.items()}
    found["validation/index.md"] += CONTENTS
    found["index.md"] = found["index.md"].replace(live_report.MARK, live_report.FRAME)
    if not examples():
        found["gallery/index.md"] = "# Gallery\n\nThe examples are in the folder `examples` of the repository.\n"
    return found | made()


def linked(text: str, path: str, known: dict[str, str]) -> str:
    """``text`` of the file at ``path`` of the repository with links to pages of the site.

    What the site does not hold is named, not linked. Raises ValueError if a link leads nowhere.
    """
    folder, page = PurePosixPath(path).parent, PurePosixPath(known[path])

    def replaced(found: re.Match[str]) -> str:
        words, target, place = found[1], found[2], found[3] or ""
        if re.match(r"\w+:", target):
            return found[0]
        aim = PurePosixPath(os.path.normpath(folder / target)).as_posix()
        if aim + "/index.md" in known:
            aim += "/index.md"
        home = (known | ELSEWHERE).get(aim) or (aim.removeprefix("docs/") if _is_picture(aim) else None)
        if home is not None:
            home = gallery() if home == "gallery/index.md" else home
            return f"{'!' if found[0].startswith('!') else ''}[{words}]({os.path.relpath(home, page.parent)}{place})"
        if not (ROOT / aim).exists():
            raise ValueError(f"{path} links to {target}, which does not exist")
        return words if f"`{aim}`" == words or words == aim else f"{words} (`{aim}`)"

    parts = re.split(r"(^[ ]*```.*?^[ ]*```[ ]*$)", text, flags=re.DOTALL | re.MULTILINE)
    link = re.compile(r"!?\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)#\s]+)(#[^)\s]*)?\)")
    return "".join(part if place % 2 else link.sub(replaced, part) for place, part in enumerate(parts))


def _is_picture(path: str) -> bool:
    return path.startswith("docs/") and path.endswith((".png", ".svg", ".webp")) and (ROOT / path).exists()


def assemble(folder: Path) -> None:
    """Write pages to ``folder``/source, scripts of the gallery to ``folder``/examples, the report
    of the first page to ``folder``/extra.

    What is unchanged is left alone.
    """
    for place, texts in (("source", pages()), ("examples", examples())):
        home = folder / place
        for path, text in texts.items():
            _write(home / path, text)
        kept = {home / path for path in texts}
        for path in sorted(home.rglob("*")) if home.exists() else ():
            own = path.suffix in (".md", ".rst", ".py") and "gallery" not in path.relative_to(home).parts
            if path.is_file() and own and path not in kept:
                path.unlink()
    for picture in [*(ROOT / "docs").rglob("*.png"), *(ROOT / "docs").rglob("*.svg")]:
        copy = folder / "source" / picture.relative_to(ROOT / "docs")
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(picture, copy)
    live_report.write(folder / "extra")
    if examples():
        (folder / "source" / "gallery" / "index.md").unlink(missing_ok=True)


def _write(path: Path, text: str) -> None:
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    assemble(Path(sys.argv[1]))
