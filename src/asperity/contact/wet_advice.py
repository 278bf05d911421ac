"""Checks of resolution and regime of a wet contact, after it is solved."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..core.status import Advice
from ..theories.wet.meniscus import wetting_factor
from .wet_result import WetContactResult

FEWEST_PIXELS = 5.0
"""Radius of an island in pixels below which counting errs by more than about 2 %; 10 pixels give 1 %."""

CONTINUUM = 1e-9
"""Radius in m below which a meniscus of water is a few molecules across: 50 % relative humidity."""

MOLECULE = 0.28e-9
"""Diameter of a molecule of water in m; other liquids have larger ones."""


def review_wet(result: WetContactResult) -> tuple[Advice, ...]:
    """Findings on the menisci of ``result``: islands of few pixels, menisci and films of a few molecules."""
    return (*_few_pixels(result), *_molecules(result))


def _few_pixels(result: WetContactResult) -> Iterator[Advice]:
    if result.wetting.regime == "dry":
        return
    # the mean over the area: many islands of a pixel or two hardly pull
    pixels = np.bincount(result.wetting.labels.ravel())[1:].astype(float)
    radius = math.sqrt(float((pixels**2).sum() / pixels.sum()) / math.pi)
    if radius < FEWEST_PIXELS:
        yield Advice(
            "warning",
            "meniscus pixels",
            f"Menisci are counted in pixels, but have a radius of {radius:.2g} pixels (less than {FEWEST_PIXELS:g}): the force "
            "may be off by several per cent. Refine the grid, or generate the surface with more points.",
        )


def _molecules(result: WetContactResult) -> Iterator[Advice]:
    film = result.film
    radius = film.meniscus_height / wetting_factor(*film.contact_angles)
    said = []
    if radius < CONTINUUM:
        said.append(
            f"The menisci have a radius of {1e9 * radius:.2g} nm: below about 1 nm Laplace's equation is a formality."
        )
    if film.thickness < MOLECULE:
        said.append(
            f"The film is {1e9 * film.thickness:.2g} nm thick, less than a molecule of water ({1e9 * MOLECULE:.2g} nm): it "
            "covers the surface in part only."
        )
    if said:
        yield Advice("note", "molecules", " ".join(said))
