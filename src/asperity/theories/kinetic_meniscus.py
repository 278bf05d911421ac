"""Meniscus force of rough contacts while the menisci grow: summits near the film are caught one after the other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import RealArray
from .meniscus_growth import MeniscusGrowth
from .protocol import curve
from .statistical_meniscus import StatisticalMeniscus, WetPrediction, balance
from .summit_heights import SummitHeights


@dataclass(frozen=True)
class KineticMeniscus:
    """Statistical meniscus force at a time after contact.

    The force of a sphere that touches does not depend on the height of its meniscus; that of a summit at the distance
    d - z from the solid grows as 1 - (d - z)/s. So the force rises from that of the film to that of ``statistical``.

    Parameters
    ----------
    statistical
        Summits, liquid and film.
    growth
        Growth of one meniscus, of the same film.
    """

    statistical: StatisticalMeniscus
    growth: MeniscusGrowth
    citation_keys: ClassVar[tuple[str, ...]] = ("BhushanKotwal1998", "Gao1995")

    def at(self, time: ArrayLike, pressure: ArrayLike) -> WetPrediction:
        """Balance at ``time`` in s (>= 0) under external pressures in Pa, > 0; numbers or (n,), broadcast."""
        times, loads = np.broadcast_arrays(curve(time, "times (s)"), curve(pressure, "pressures (Pa)", positive=True))
        height = self.growth.height(times)[:, None]
        contact, film = self.statistical.contact, self.statistical.film_thickness
        unit = contact.height_deviation

        def pull(separation: RealArray) -> RealArray:
            D = contact.standardised(separation)
            return np.asarray(self.statistical.largest * caught(contact.heights, D, film / unit, height / unit))

        return balance(contact, pull, loads)


def caught(heights: SummitHeights, D: RealArray, film: float, height: ArrayLike) -> RealArray:
    """∫_D^∞ p ds + ∫_(D-H)^D [1 - (D - s)/S] p ds: mean force of a summit over that of one that touches.

    ``D`` separation, ``film`` H and meniscus ``height`` S >= H, all in standard deviations; D and S broadcast.
    """
    lowest = np.asarray(D, dtype=float) - film
    reached = heights.tail_moment(lowest, 0.0)
    # mean gap of the summits between film and contact, by parts
    gaps = film * reached - heights.tail_moment(lowest, 1.0) + heights.tail_moment(np.asarray(D, dtype=float), 1.0)
    return np.asarray(reached - gaps / np.asarray(height))
