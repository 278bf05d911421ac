"""Periodic maps that are sums of a few waves, with their summits in
tests/reference/summit_map_*.csv."""

from __future__ import annotations

import numpy as np
from reference_data import reference

import asperity as asp

MAPS = sorted({row["map"] for row in reference("summit_map_modes")})


def summit_map(number: float) -> asp.Surface:
    """The map ``number``."""
    modes = [row for row in reference("summit_map_modes") if row["map"] == number]
    n = int(modes[0]["N"])
    i, j = np.arange(n)[:, None], np.arange(n)[None, :]
    waves = [
        row["amplitude_m"] * np.cos(2.0 * np.pi * (row["m"] * i + row["n"] * j) / n + row["phase_rad"]) for row in modes
    ]
    return asp.Surface(sum(waves), modes[0]["dx_m"], periodic=True)
