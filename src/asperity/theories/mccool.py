"""McCool (1986): the theory of Greenwood & Williamson with the summits of a Gaussian surface of given moments."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Self

from numpy.typing import ArrayLike

from .greenwood_williamson import GreenwoodWilliamson
from .limits import area_limit, blunt_summits, gentle_slopes, isotropic_bandwidth
from .nayak import NayakSummits
from .protocol import E_STAR, Input, Limit, Prediction
from .roughness import Roughness

MOMENTS = (
    Input("m0", "m^2", "mean square height"),
    Input("m2", "", "mean square slope of a profile"),
    Input("m4", "1/m^2", "mean square second derivative of a profile"),
)
"""The three moments that theories of isotropic Gaussian surfaces are made from."""


@dataclass(frozen=True)
class McCool:
    """Greenwood and Williamson with η, R, σ_s and z̄_s of Nayak's summits and Gaussian heights (McCool 1986).

    Every summit has the mean curvature, although the highest are the sharpest: for narrow spectra the area at light load
    is too large (α = 2: by 38 % at a separation of three standard deviations), and it has no linear limit.

    Parameters
    ----------
    E_star
        Contact modulus in Pa.
    m0, m2, m4
        Moments of an isotropic Gaussian surface, see ``NayakSummits``.

    Raises
    ------
    InputError
        If a parameter is not positive or m0 m4/m2² < 1.5.
    """

    E_star: float
    m0: float
    m2: float
    m4: float
    name: ClassVar[str] = "mccool"
    title: ClassVar[str] = "Greenwood-Williamson with McCool's parameters"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood1966", "McCool1986", "Nayak1971")
    inputs: ClassVar[tuple[Input, ...]] = (E_STAR, *MOMENTS)

    def __post_init__(self) -> None:
        self.equivalent()

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float) -> Self:
        """Theory for the moments of ``roughness``."""
        return cls(E_star, roughness.m0, roughness.m2, roughness.m4)

    def equivalent(self) -> GreenwoodWilliamson:
        """The theory with summits of one radius that this one stands for."""
        summits = NayakSummits(self.m0, self.m2, self.m4)
        return GreenwoodWilliamson(
            self.E_star, summits.density, summits.radius, summits.height_deviation, summits.mean_height
        )

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane of the surface."""
        return self.equivalent().at_separation(separation)

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, see ``GreenwoodWilliamson.at_pressure``."""
        return self.equivalent().at_pressure(pressure)

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """Few contacts, blunt summits, gentle slopes, moments of an isotropic surface."""
        return (
            area_limit(prediction),
            blunt_summits(prediction, self.equivalent().roughness_ratio),
            gentle_slopes(prediction, math.sqrt(2.0 * self.m2)),
            isotropic_bandwidth(prediction, self.m0 * self.m4 / self.m2**2),
        )
