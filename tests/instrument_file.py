"""A small file in a format of instruments."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from asperity.core.arrays import RealArray


def bcr(path: Path) -> RealArray:
    """Write a small map in a format of instruments (BCR-STM), the 26th that the library tries; its
    heights [x, y], y upwards."""
    steps = np.random.default_rng(3).integers(-500, 500, (6, 9)).astype("<i2")  # top row first
    header = (
        "fileformat = bcrstm\nheadersize = 2048\nxpixels = 9\nypixels = 6\nxlength = 90\nylength = 60\nxunit = nm\n"
    )
    header += "yunit = nm\nzunit = nm\nbit2nm = 0.5\nxoffset = 0\nyoffset = 0\nintelmode = 1\n"
    path.write_bytes(header.encode().ljust(2048, b" ") + steps.tobytes())
    return 0.5e-9 * steps[::-1].T
