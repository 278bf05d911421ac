"""What a contact is expected to be, with error and scatter."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from ...core.quantity import Quantity
from ...core.status import Advice
from ...theories.rough.predictor import Expected, Groups
from .waves import Waves

MEANING = {
    "y": "mean pressure / rms pressure of full contact",
    "X": "mean pressure × 10 % length / (modulus × rms height × ε)",
    "nayak": "bandwidth α",
    "nayak, layered": "bandwidth α of a surface on a layered body",
    "size": "side / 10 % length",
    "ratio": "modulus of the layer / that of its base",
    "thickness": "thickness of the layer / 10 % length",
}
"""Groups in words."""


@dataclass(frozen=True)
class Prediction:
    """What a contact is expected to be, without solving it.

    Each number is an ``Expected``: mean over surfaces of the same statistics, standard error of
    that mean, standard deviation from one surface to the next, and ``band`` of both.

    Attributes
    ----------
    area_fraction
        Real contact area over nominal area, freed of the size of the pixels by the perimeter
        (Yastrebov, Anciaux & Molinari 2017). ``area_fraction_corrected`` of a result finds the
        edges between pixels instead.
    area_fraction_pixels
        Pixels in contact over all: ``area_fraction`` of a result.
    peak_pressure
        Largest pressure of a pixel in Pa; an extreme value, for which the band says more than the
        mean.
    mean_gap
        In m; NaN, as the counted pixels, of surfaces without an exponential autocorrelation, and
        where much of the contact is at the hardness.
    max_sqrtJ2, max_sqrtJ2_layer, max_sqrtJ2_base
        Largest √J₂ below the surface in Pa, and in a layer and its base; NaN of several layers and
        at the hardness.
    yield_factor
        Factor on the stresses at which a body first yields, the least Y/(√3 √J₂); NaN where no
        yield stress is known.
    yield_load, yield_load_layer, yield_load_base
        Factor on the load at which a body, the layer and its base first yield. Pressures rise
        slowly with the load, so that the band is wide. NaN where no yield stress is known, with a
        pull, and outside of the loads of the table, which a finding says.
    pull_pressure
        Pull over nominal area in Pa, added to the load; NaN where nothing pulls.
    pressure
        Mean pressure in Pa that is prescribed.
    groups
        The groups y, X, α, size, and those of a layer, by which the table is read.
    waves
        Sums over the waves of the surface, among them the rms pressure of full contact.
    findings
        What should be known before the numbers are used.
    """

    area_fraction: Expected
    area_fraction_pixels: Expected
    peak_pressure: Expected
    mean_gap: Expected
    max_sqrtJ2: Expected
    max_sqrtJ2_layer: Expected
    max_sqrtJ2_base: Expected
    yield_factor: Expected
    yield_load: Expected
    yield_load_layer: Expected
    yield_load_base: Expected
    pull_pressure: Expected
    pressure: float
    groups: Groups
    waves: Waves
    findings: tuple[Advice, ...] = ()
    citation_keys: ClassVar[tuple[str, ...]] = ("Nayak1971", "Peng2001", "Yastrebov2017")

    def values(self) -> list[tuple[Quantity, Expected]]:
        """Every number that is known, with name, unit and label."""
        found = [(quantity, getattr(self, quantity.name)) for quantity in QUANTITIES]
        return [(quantity, value) for quantity, value in found if math.isfinite(value.value)]


QUANTITIES = (
    Quantity("area_fraction", "1", "real contact area / nominal area"),
    Quantity("area_fraction_pixels", "1", "pixels in contact / all pixels"),
    Quantity("peak_pressure", "Pa", "largest pressure of a pixel"),
    Quantity("mean_gap", "m", "mean gap"),
    Quantity("max_sqrtJ2", "Pa", "largest √J₂ below the surface"),
    Quantity("max_sqrtJ2_layer", "Pa", "largest √J₂ in the layer"),
    Quantity("max_sqrtJ2_base", "Pa", "largest √J₂ in the base"),
    Quantity("yield_factor", "1", "factor on the stresses at first yield"),
    Quantity("yield_load", "1", "factor on the load at first yield"),
    Quantity("yield_load_layer", "1", "factor on the load at first yield of the layer"),
    Quantity("yield_load_base", "1", "factor on the load at first yield of the base"),
    Quantity("pull_pressure", "Pa", "pull / nominal area"),
)
"""Numbers of a prediction, in their order."""
