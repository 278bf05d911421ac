"""Thumbnails of the gallery: of a figure much wider than a thumbnail its first panel, which is
legible at that size."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

SIZE = (400, 280)
"""Pixels of a thumbnail, see ``thumbnail_size`` of the gallery."""

WIDE = 1.9
"""Width over height from which a figure is cut: two panels side by side."""

LEAST = 0.9
"""Width over height of what is left of it at least."""

WHITE = 250


def first_panel(figure: Image.Image) -> Image.Image:
    """The left part of a wide ``figure`` as far as the first gap between panels; others as they
    are."""
    width, height = figure.size
    if width < WIDE * height:
        return figure
    blank = (np.asarray(figure.convert("L")) >= WHITE).all(axis=0)
    gaps = np.flatnonzero(np.diff(np.concatenate([[0], blank.astype(int), [0]]))).reshape(-1, 2)
    inner = gaps[(gaps[:, 0] > LEAST * height) & (gaps[:, 1] < width)]
    widths = np.ptp(inner, axis=1)  # those beside labels are narrower than those between panels
    between = inner[widths > 0.6 * widths.max(initial=0)].mean(axis=1)
    end = between[0] if between.size else height * SIZE[0] / SIZE[1]
    return figure.crop((0, 0, round(float(end)), height))


def make_legible(gallery: Path) -> None:
    """Make the thumbnails of wide figures in the folder ``gallery`` anew."""
    for thumbnail in sorted(gallery.glob("**/images/thumb/sphx_glr_*_thumb.png")):
        whole = thumbnail.parents[1] / thumbnail.name.replace("_thumb.png", "_001.png")
        if not whole.exists():
            continue
        with Image.open(whole) as figure:
            part = first_panel(figure.convert("RGB"))
        if part.size == figure.size:
            continue
        part.thumbnail(SIZE, Image.Resampling.LANCZOS)
        shown = Image.new("RGB", SIZE, "white")
        shown.paste(part, ((SIZE[0] - part.width) // 2, (SIZE[1] - part.height) // 2))
        shown.save(thumbnail)
