"""Draw which theory becomes which: ``python docs/site/map_of_theories.py`` writes
``docs/start/theories.svg``.

Every theory of the catalogue has a place, by what it is about. A line joins two that agree in a
limit, by the rows of ``tests/agreement``; pointing at it shows the limit where the picture stands
on its own.
"""

from __future__ import annotations

import sys
import textwrap
from html import escape
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests"))

from agreement.conductance import CONDUCTANCE  # noqa: E402 - found by the line above
from agreement.fields_and_films import FIELDS_AND_FILMS  # noqa: E402
from agreement.heating import HEATING  # noqa: E402
from agreement.matrix import MATRIX  # noqa: E402
from agreement.sealing import SEALING  # noqa: E402
from agreement.single_contacts import SINGLE_CONTACTS  # noqa: E402
from agreement.wear import WEAR  # noqa: E402

from asperity.theories.catalogue import FAMILIES, THEORIES  # noqa: E402
from asperity.theories.protocol import Described  # noqa: E402

PAGE = ROOT / "docs" / "start" / "theories.svg"

COLUMNS: tuple[dict[str, str], ...] = (
    {
        "Rough surfaces": "Rough surfaces",
        "Rubber friction": "Rubber friction",
        "Menisci": "Menisci",
        "Conductance": "Conductance",
        "Frictional heating": "Frictional heating",
        "Sealing": "Sealing",
        "Wear": "Wear",
        "Plasticity and hardness": "Plasticity and hardness",
        "Statistics of surfaces": "Statistics",
    },
    {
        "single": "One contact",
        "rough": "One contact that yields",
        "Waves": "Waves",
        "Below the surface": "Below the surface",
    },
    {"adhesion": "One contact with adhesion", "Stickiness": "Stickiness", "friction": "One contact with friction"},
)
"""Groups of theories from left to right and their titles: families of the catalogue, or folders of
its single contacts."""

HUES = (28, 140, 265)
"""Of the columns."""

WIDE, ROW, GAP, HEAD, MARGIN = 224, 14, 50, 30, 14
"""Width of a column, height of a line of text, gutter between columns, height of a title, and
margin, px."""

LETTERS = 32
"""Of a line of text."""


def group_of(kind: type[Described]) -> str:
    """Family of a theory, or the folder of its code if it is of one contact."""
    family = next(name for name, kinds in FAMILIES.items() if kind in kinds)
    return kind.__module__.split(".")[2] if family == "One contact" else family


def limits() -> dict[tuple[str, str], list[str]]:
    """Limits in which two theories of the catalogue agree, by their names."""
    found: dict[tuple[str, str], list[str]] = {}
    for row in (*MATRIX, *SINGLE_CONTACTS, *FIELDS_AND_FILMS, *CONDUCTANCE, *HEATING, *SEALING, *WEAR):
        if row.other in THEORIES and row.other != row.theory:
            found.setdefault((row.theory, row.other), []).append(row.limit)
    return found


def lines(name: str) -> list[str]:
    """Title of a theory in lines."""
    return textwrap.wrap(THEORIES[name].title, LETTERS, break_on_hyphens=False)


def places() -> tuple[dict[str, tuple[int, float]], list[tuple[int, float, str]], float]:
    """Column and middle of the box of each theory, place and text of each title, and height of the
    picture, px."""
    boxes: dict[str, tuple[int, float]] = {}
    titles = []
    height = 0.0
    for column, groups in enumerate(COLUMNS):
        y = float(MARGIN)
        for group, title in groups.items():
            titles.append((column, y + 0.6 * HEAD, title))
            y += HEAD
            for name in (name for name, kind in THEORIES.items() if group_of(kind) == group):
                tall = ROW * len(lines(name)) + 7
                boxes[name] = column, y + 0.5 * tall
                y += tall
            y += 0.5 * HEAD
        height = max(height, y)
    return boxes, titles, height + 0.5 * MARGIN


def left(column: int) -> float:
    """Left edge of a column, px."""
    return MARGIN + 0.75 * GAP + column * (WIDE + GAP)


def line(first: tuple[int, float], second: tuple[int, float]) -> str:
    """Path between two boxes: an arc on the left within a column, else through the gutters."""
    (i, y), (j, z) = sorted((first, second))
    if i == j:
        x = left(i)
        out = x - min(0.9 * GAP, 12.0 + 0.11 * abs(z - y))
        return f"M{x:.0f} {y:.1f}C{out:.0f} {y:.1f} {out:.0f} {z:.1f} {x:.0f} {z:.1f}"
    start, end = left(i) + WIDE, left(j)
    bend = 0.5 * GAP
    return f"M{start:.0f} {y:.1f}C{start + bend:.0f} {y:.1f} {end - bend:.0f} {z:.1f} {end:.0f} {z:.1f}"


def picture() -> str:
    """The map as SVG."""
    rows, titles, height = places()
    joined = limits()
    width = left(len(COLUMNS) - 1) + WIDE + MARGIN
    shapes = [f'<rect width="{width:.0f}" height="{height:.0f}" fill="#fff"/>']
    for (theory, other), words in joined.items():
        tip = escape(f"{theory} - {other}: {'; '.join(words)}")
        shapes.append(f'<path class="l" d="{line(rows[theory], rows[other])}"><title>{tip}</title></path>')
    for column, y, title in titles:
        colour = f"hsl({HUES[column]},55%,28%)"
        shapes.append(f'<text class="h" x="{left(column):.0f}" y="{y:.0f}" fill="{colour}">{escape(title)}</text>')
    for name, (column, y) in rows.items():
        x, text = left(column), lines(name)
        fill = f"hsl({HUES[column]},60%,{90 if any(name in pair for pair in joined) else 97}%)"
        tall = ROW * len(text) + 4
        shapes.append(
            f'<rect x="{x:.0f}" y="{y - 0.5 * tall:.1f}" width="{WIDE}" height="{tall}" rx="4" fill="{fill}"/>'
        )
        for number, part in enumerate(text):
            below = y + 4.0 + ROW * (number - 0.5 * (len(text) - 1))
            shapes.append(f'<text x="{x + 7:.0f}" y="{below:.1f}">{escape(part)}</text>')
    style = ".l{fill:none;stroke:#7a8794;stroke-width:1.3}.h{font-weight:bold;font-size:14px}text{fill:#1d2630}"
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
        f'width="{width:.0f}" height="{height:.0f}" font-family="sans-serif" font-size="12">'
    )
    return "\n".join([head, f"<style>{style}</style>", *shapes, "</svg>", ""])


if __name__ == "__main__":
    PAGE.write_text(picture(), encoding="utf-8")
