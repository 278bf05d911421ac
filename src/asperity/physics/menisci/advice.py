"""Checks of menisci: pixels in them, and molecules."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ...core.status import Advice
from ...theories.wet.meniscus import wetting_factor
from .film import LiquidFilm, Wetting

FEWEST_MENISCUS_PIXELS = 5.0
"""Radius of an island in pixels below which counting errs by more than about 2 %; 10 pixels give 1 %."""

CONTINUUM = 1e-9
"""Radius in m below which a meniscus of water is a few molecules across: 50 % relative humidity."""

MOLECULE = 0.28e-9
"""Diameter of a molecule of water in m; other liquids have larger ones."""


def findings(film: LiquidFilm, wetting: Wetting) -> Iterator[Advice]:
    """What should be known of menisci of ``film`` that stand as ``wetting`` says."""
    yield from _meniscus_pixels(wetting)
    yield from _molecules(film)


def _meniscus_pixels(wetting: Wetting) -> Iterator[Advice]:
    if wetting.regime == "dry":
        return
    # the mean over the area: many islands of a pixel or two hardly pull
    pixels = np.bincount(wetting.labels.ravel())[1:].astype(float)
    radius = math.sqrt(float((pixels**2).sum() / pixels.sum()) / math.pi)
    if radius < FEWEST_MENISCUS_PIXELS:
        yield Advice(
            "warning",
            "meniscus pixels",
            f"Menisci are counted in pixels, but have a radius of {radius:.2g} pixels (less than {FEWEST_MENISCUS_PIXELS:g}): the force "
            "may be off by several per cent. Refine the grid, or generate the surface with more points.",
        )


def _molecules(film: LiquidFilm) -> Iterator[Advice]:
    radius = film.meniscus_height / wetting_factor(*film.contact_angles)
    remarks = []
    if radius < CONTINUUM:
        remarks.append(
            f"The menisci have a radius of {1e9 * radius:.2g} nm: below about 1 nm Laplace's equation is a formality."
        )
    if film.thickness < MOLECULE:
        remarks.append(
            f"The film is {1e9 * film.thickness:.2g} nm thick, less than a molecule of water ({1e9 * MOLECULE:.2g} nm): it "
            "covers the surface in part only."
        )
    if remarks:
        yield Advice("note", "molecules", " ".join(remarks))
