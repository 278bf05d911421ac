"""Pictures after published figures, drawn from the cases of the pages.

Usage: python validation/pictures.py FOLDER [NAME …]
"""

from __future__ import annotations

import argparse
from pathlib import Path

import block_pictures
import conductance_pictures
import peng_pictures
import sealing_pictures
import sliding_pictures

from asperity.plots import style

DPI = 75

FIGURES = (
    peng_pictures.FIGURES
    | block_pictures.FIGURES
    | sliding_pictures.FIGURES
    | conductance_pictures.FIGURES
    | sealing_pictures.FIGURES
)
"""Name of the file -> how to draw it, width and height in inches."""


def draw(name: str, folder: Path) -> Path:
    """Write the picture ``name`` into ``folder``."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    path = folder / f"{name}.png"
    fill, size = FIGURES[name]
    with style():
        figure = Figure(figsize=size)
        FigureCanvasAgg(figure)
        fill(figure)
        figure.savefig(path, dpi=DPI, bbox_inches="tight", pad_inches=0.06)
    return path


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Pictures after published figures.")
    parser.add_argument("folder", type=Path, help="where the PNG files go; made if missing")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(FIGURES)} (default: all)")
    given = parser.parse_args()
    if unknown := [name for name in given.names if name not in FIGURES]:
        parser.error(f"no picture {', '.join(unknown)}; choose from {', '.join(FIGURES)}")
    given.folder.mkdir(parents=True, exist_ok=True)
    for chosen in given.names or FIGURES:
        print(draw(chosen, given.folder))
