"""Meniscus force of rough contacts while the menisci grow: summits near the film are caught one after the other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from .meniscus_growth import MeniscusGrowth
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

    def at(self, time: float, pressure: RealArray) -> WetPrediction:
        """Balance at ``time`` in s (>= 0) under external pressures (n,) in Pa, > 0."""
        height = float(self.growth.height(require.not_negative(time, "time (s)")))
        contact, film = self.statistical.contact, self.statistical.film_thickness
        unit = contact.height_deviation

        def pull(separation: RealArray) -> RealArray:
            D = contact.standardised(separation)
            return np.asarray(self.statistical.largest * caught(contact.heights, D, film / unit, height / unit))

        return balance(contact, pull, np.atleast_1d(np.asarray(pressure, dtype=float)))


def caught(heights: SummitHeights, D: RealArray, film: float, height: float) -> RealArray:
    """∫_D^∞ p ds + ∫_(D-H)^D [1 - (D - s)/S] p ds: mean force of a summit over that of one that touches.

    ``D`` (any shape) separation, ``film`` H and meniscus ``height`` S >= H, all in standard deviations.
    """
    lowest = np.asarray(D, dtype=float) - film
    reached = heights.tail_moment(lowest, 0.0)
    # mean gap of the summits between film and contact, by parts
    gaps = film * reached - heights.tail_moment(lowest, 1.0) + heights.tail_moment(np.asarray(D, dtype=float), 1.0)
    return np.asarray(reached - gaps / height)
