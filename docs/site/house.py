"""Draw the house: ``python docs/site/house.py`` writes ``docs/develop/architecture.svg`` from the
source and the table of layers of the tests."""

from __future__ import annotations

import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests"))

from architecture.source import ROOT as PACKAGE  # noqa: E402 - found by the line above
from architecture.test_layers import LAYERS, folder_of  # noqa: E402

WIDTH, HEIGHT, GAP = 900, 62, 10
"""Of the picture and of one floor, and between floors, px."""

ABOUT = {
    "cli": "shells: parse, call, format",
    "studies": "campaigns over documents",
    "report": "a page made of an outcome",
    "run": "document, the one executor, outcome",
    "parts": "doors: part.py and work.py of each physics, the plain contact",
    "plots": "figures, also figures.py of each physics",
    "io": "files of surfaces and results, units of text",
    "physics": "laws, couplings, answers, solvers; a room each, in thousands of lines with its doors and figures:",
    "contact": "the normal contact, which every physics joins; finite elements",
    "surfaces": "topographies, bodies, theories",
    "core": "arrays, transforms, grid, units, errors, citations, registry",
}
"""What is on each floor, by its first folder."""


def lines() -> tuple[dict[str, int], dict[str, int]]:
    """Lines of source by the folder whose layer they are of, and by physics, with its doors and
    figures."""
    layers, rooms = Counter[str](), Counter[str]()
    for path in PACKAGE.rglob("*.py"):
        parts = ["asperity", *path.relative_to(PACKAGE).with_suffix("").parts]
        count = len(path.read_text(encoding="utf-8").splitlines())
        layers[folder_of(parts)] += count
        if parts[1] == "physics" and len(parts) > 3:
            rooms[parts[2]] += count
    return layers, rooms


def picture() -> str:
    """The house as SVG: a floor for each layer, a room for each physics, with thousands of
    lines."""
    layers, rooms = lines()
    floors = sorted(LAYERS, reverse=True)
    height = len(floors) * (HEIGHT + GAP) + 60
    shapes = [f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>']
    y = GAP
    for floor in floors:
        folders = LAYERS[floor]
        tall = HEIGHT + 60 if "physics" in folders else HEIGHT
        shapes.append(f'<rect class="f" x="20" y="{y}" width="{WIDTH - 40}" height="{tall}"/>')
        names = ", ".join(f"{name} {layers[name] / 1e3:.1f}" for name in folders)
        shapes.append(f'<text class="n" x="34" y="{y + 24}">{names}</text>')
        shapes.append(f'<text class="t" x="34" y="{y + 46}">{ABOUT[folders[0]]}</text>')
        if "physics" in folders:
            wide = (WIDTH - 60) / len(rooms)
            for number, (room, count) in enumerate(sorted(rooms.items())):
                x = 30 + number * wide
                shapes.append(f'<rect class="p" x="{x:.0f}" y="{y + 60}" width="{wide - 6:.0f}" height="50"/>')
                label = room.replace("_", " ")
                shapes.append(f'<text class="t" x="{x + 6:.0f}" y="{y + 80}" font-size="11">{label}</text>')
                shapes.append(f'<text class="t" x="{x + 6:.0f}" y="{y + 100}" font-size="11">{count / 1e3:.1f}</text>')
        y += tall + GAP
    style = (
        ".f{fill:#eef3f7;stroke:#5b7488}.n{fill:#1d3547;font-weight:bold}"
        ".t{fill:#33485a}.p{fill:#fdf0dd;stroke:#b9813a}"
    )
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y}" font-family="sans-serif" font-size="15">'
    return "\n".join([head, f"<style>{style}</style>", *shapes, "</svg>", ""])


if __name__ == "__main__":
    (ROOT / "docs" / "develop" / "architecture.svg").write_text(picture(), encoding="utf-8")
