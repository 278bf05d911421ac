"""Greenwood & Williamson's summits on a patch whose mean plane sinks under the load."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar, Literal, Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.parameters import Help
from ...core.values import Length
from ..protocol import (
    BLUNT_SUMMITS,
    FEW_CONTACTS,
    Bound,
    HeightDeviation,
    HeightsLaw,
    MeanHeight,
    Modulus,
    Prediction,
    SummitDensity,
    SummitRadius,
    Theory,
    bisected,
    curve,
)
from ..statistics.heights import GaussianHeights
from ..statistics.roughness import Roughness
from .greenwood_williamson import GreenwoodWilliamson

# The mean plane sinks under a patch that carries a pressure: Greenwood & Williamson's theory at a
# larger separation (first order of Ciavarella, Greenwood & Paggi 2008, from its abstract).


SINKING = {
    "mean": 4.0 / math.pi * (math.log(1.0 + math.sqrt(2.0)) - (math.sqrt(2.0) - 1.0) / 3.0),
    "centre": 4.0 / math.pi * math.log(1.0 + math.sqrt(2.0)),
}
"""Displacement of a free square of side L under the uniform pressure p over p L/E*: its mean, and
that of its centre."""

Where: TypeAlias = Literal["mean", "centre"]


def sunk(found: Prediction, E_star: float, side: float, where: Where = "mean") -> Prediction:
    """``found`` of any theory of a patch whose mean plane sinks: its separations and stiffnesses
    change, all else stays.

        h = h_0 - c p L/E*,  1/k = 1/k_0 + c L/E*.

    ``E_star`` in Pa; ``side`` L of the square patch in m, > 0; ``where`` c is that of the ``mean``
    of the square or of its ``centre``. InputError if a number is not positive or the place unknown.
    """
    modulus, length = require.positive(E_star, "contact modulus E* (Pa)"), require.positive(side, "side (m)")
    compliance = SINKING[require.one_of(where, SINKING, "place of a patch")] * length / modulus
    return replace(
        found,
        separation=found.separation - compliance * found.pressure,
        stiffness=found.stiffness / (1.0 + compliance * found.stiffness),
    )


@dataclass(frozen=True)
class MeanFieldSummits(Theory):
    """Greenwood and Williamson's summits on a free square patch of side L, whose mean plane sinks
    under the load.

    With the pressure p_GW(h) of ``greenwood-williamson`` the pressure at the separation h is

        p = p_GW(h + c p L/E*),  c = (4/π) [ln(1 + √2) - (√2 - 1)/3] = 0.9464,

    or c = (4/π) ln(1 + √2) = 1.1222 for the ``centre`` of the patch. Area and number of contacts at
    a pressure stay as they are: only separation and stiffness change, and have no limit for a wide
    patch. A cell that repeats does not sink, by the convention for its mean plane.

    The displacement of contacts that cluster is larger: by 34 % with 8 contacts, 4 % with 66. This
    is the first order of the theory of Ciavarella, Greenwood & Paggi (2008), not a transcription;
    ``sunk`` gives the same shift for the prediction of any theory.

    Examples
    --------
    >>> gw = GreenwoodWilliamson(1e11, 1e12, 1e-6, 1e-8).at_pressure([1e6, 1e7])
    >>> mean = MeanFieldSummits(1e11, 1e12, 1e-6, 1e-8, side=1e-4).at_pressure([1e6, 1e7])
    >>> bool((mean.area_fraction == gw.area_fraction).all())
    True
    >>> ((gw.separation - mean.separation) * 1e9).round(2)
    array([0.95, 9.46])
    """

    E_star: Modulus
    density: SummitDensity
    radius: SummitRadius
    height_deviation: HeightDeviation
    side: Annotated[Length, "side L of the square patch"]
    mean_height: MeanHeight = 0.0
    heights: HeightsLaw = GaussianHeights()
    where: Annotated[Where, Help("place that counts as the mean plane", of="choice")] = "mean"
    name: ClassVar[str] = "mean-field-summits"
    title: ClassVar[str] = "Greenwood-Williamson with a mean plane that sinks"
    citation_keys: ClassVar[tuple[str, ...]] = ("Ciavarella2008", "Greenwood1966", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = (FEW_CONTACTS, BLUNT_SUMMITS)

    @classmethod
    def of_roughness(cls, roughness: Roughness, E_star: float, *, where: Where = "mean") -> Self:
        """Theory for the summits of a map, as ``GreenwoodWilliamson.from_roughness``, which is the
        patch."""
        alone = GreenwoodWilliamson.from_roughness(roughness, E_star)
        side = math.sqrt(require.positive(roughness.area, "nominal area (m^2)"))
        numbers = (alone.density, alone.radius, alone.height_deviation)
        return cls(E_star, *numbers, side, alone.mean_height, where=where)

    @property
    def alone(self) -> GreenwoodWilliamson:
        """The same summits on a mean plane that stays."""
        numbers = (self.density, self.radius, self.height_deviation, self.mean_height)
        return GreenwoodWilliamson(self.E_star, *numbers, self.heights)

    @property
    def roughness_ratio(self) -> float:
        """σ_s/R."""
        return self.height_deviation / self.radius

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, see ``GreenwoodWilliamson.at_pressure``."""
        return sunk(self.alone.at_pressure(pressure), self.E_star, self.side, self.where)

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane of the undeformed patch."""
        h = curve(separation, "separations (m)")
        alone, compliance = self.alone, SINKING[self.where] * self.side / self.E_star
        # the mean plane sinks by no more than it would at the same separation of a plane that stays
        most = compliance * alone.borne(h)
        shift = bisected(lambda u: u - compliance * alone.borne(h + u), np.zeros_like(h), most)
        found = sunk(alone.at_separation(h + shift), self.E_star, self.side, self.where)
        return replace(found, separation=h)
