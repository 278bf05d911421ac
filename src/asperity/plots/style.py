"""One look for all figures: colours that colour-blind readers tell apart, SI-prefixed axes, print resolution."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..core import units
from ..core.arrays import RealArray

BLACK, ORANGE, SKY, GREEN, YELLOW, BLUE, VERMILLION, PURPLE = (
    "#000000",
    "#E69F00",
    "#56B4E9",
    "#009E73",
    "#F0E442",
    "#0072B2",
    "#D55E00",
    "#CC79A7",
)
"""Colours of Okabe & Ito, distinct under every common colour blindness."""

NO_CONTACT = "#ECECEC"
"""Light grey of points without contact or without a value."""

HEIGHT_MAP, PRESSURE_MAP, GAP_MAP = "cividis", "viridis", "cividis"
"""Colour maps of even lightness."""

DPI = 200
"""Resolution of pictures in dots per inch."""

SETTINGS: Any = {
    "font.size": 9.0,
    "axes.titlesize": 9.0,
    "axes.linewidth": 0.7,
    "axes.grid": False,
    "axes.formatter.useoffset": False,
    "lines.linewidth": 1.2,
    "xtick.direction": "out",
    "ytick.direction": "out",
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "image.origin": "lower",
}
"""Settings of figures that this package makes; axes handed in by a caller keep the caller's."""

KINDS = {
    unit: kind
    for kind, unit in units.DIMENSIONS.items()
    if kind in ("length", "pressure", "force", "energy", "time", "area")
} | {"Pa/m": "stiffness", "N/m": "surface tension"}
"""Kind of quantity by SI unit, of those that are drawn with prefixes."""


@dataclass(frozen=True)
class Scale:
    """Prefixed unit in which values are drawn: ``symbol`` for labels, SI value of one unit in ``factor``."""

    symbol: str
    factor: float

    def __call__(self, values: Any) -> Any:
        """``values`` (SI) in this unit."""
        return np.asarray(values, dtype=float) / self.factor


def scale(values: RealArray | float, unit: str) -> Scale:
    """Scale in which the largest finite magnitude of ``values`` (SI ``unit``) lies between 1 and 1000.

    A unit that takes no prefixes stays, and that of plain numbers ("1") is empty.
    """
    if unit not in KINDS:
        return Scale("" if unit == "1" else unit, 1.0)
    magnitude = np.abs(np.asarray(values, dtype=float))
    largest = float(magnitude.max(initial=0.0, where=np.isfinite(magnitude)))
    symbol = units.show(largest, unit).split(" ")[1]
    return Scale(symbol, units.unit_factor(symbol, KINDS[unit], "unit of an axis"))


@contextmanager
def style() -> Iterator[None]:
    """Within it, matplotlib draws in the style of this package; outside nothing changes."""
    from matplotlib import rc_context

    with rc_context(SETTINGS):
        yield
