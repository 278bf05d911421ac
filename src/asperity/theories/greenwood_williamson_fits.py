"""Power laws fitted to the Gaussian theory of Greenwood & Williamson (Bhushan 1998, table 1)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from .greenwood_williamson import GreenwoodWilliamson
from .limits import area_limit
from .protocol import E_STAR, Input, Limit, Prediction, curve, prediction
from .roughness import Roughness

LARGEST = 0.57
"""P_a at D = 0, where the fit of the separation ends."""

FORMS = {"power": (1e-6, 0.1), "linear": (1e-4, 1e-2)}
"""Forms of the laws and the P_a between which they are within a fifth (power) or a half (linear) of the integrals."""


@dataclass(frozen=True)
class FittedLaws:
    """Quantities of the Gaussian theory as fitted functions of P_a; logarithms are decimal.

    ``"power"``: D = 1.40 [log(0.57/P_a)]^0.65, p_r = 0.42 P_a^0.04, A_r = 2.40 P_a^0.96, n = 1.21 P_a^0.88,
    A_r/n = 2.00 P_a^0.08; ``"linear"``: p_r = 0.32, A_r = 3.20 P_a, n = 2.64 P_a, A_r/n = 1.21, no separation.
    """

    form: str = "power"

    def __post_init__(self) -> None:
        require.one_of(self.form, FORMS, "form of the fitted laws")

    def separation(self, P_a: RealArray) -> RealArray:
        """D, NaN for P_a >= 0.57 and for the linear form."""
        inside = (P_a < LARGEST) & (self.form == "power")
        D: RealArray = np.where(inside, 1.40 * np.log10(LARGEST / np.where(inside, P_a, LARGEST)) ** 0.65, np.nan)
        return D

    def real_pressure(self, P_a: RealArray) -> RealArray:
        """p_r/[E* (σ_s/R)^(1/2)]."""
        return self._law(P_a, (0.42, 0.04), (0.32, 0.0))

    def area(self, P_a: RealArray) -> RealArray:
        """A_r/(A_a η R σ_s)."""
        return self._law(P_a, (2.40, 0.96), (3.20, 1.0))

    def number(self, P_a: RealArray) -> RealArray:
        """n/(η A_a)."""
        return self._law(P_a, (1.21, 0.88), (2.64, 1.0))

    def mean_area(self, P_a: RealArray) -> RealArray:
        """(A_r/n)/(R σ_s)."""
        return self._law(P_a, (2.00, 0.08), (1.21, 0.0))

    def _law(self, P_a: RealArray, power: tuple[float, float], linear: tuple[float, float]) -> RealArray:
        factor, exponent = power if self.form == "power" else linear
        values: RealArray = factor * P_a**exponent
        return values


@dataclass(frozen=True)
class FittedGreenwoodWilliamson:
    """Greenwood and Williamson with the fits of table 1 in place of the integrals; for comparison with the literature.

    Real area and real pressure are fits of their own: their product is the load within a few per cent only.

    Parameters
    ----------
    E_star, density, radius, height_deviation, mean_height
        As for ``GreenwoodWilliamson``; heights are Gaussian.
    form
        ``"power"`` or ``"linear"``.

    Raises
    ------
    InputError
        If a parameter is not positive (the mean height may have any sign), or the form unknown.
    """

    E_star: float
    density: float
    radius: float
    height_deviation: float
    mean_height: float = 0.0
    form: str = "power"
    name: ClassVar[str] = "greenwood-williamson-fits"
    title: ClassVar[str] = "Greenwood-Williamson, fitted power laws"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1998", "Greenwood1966")
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        *GreenwoodWilliamson.inputs[1:5],
        Input("form", "", "fitted laws", of="choice", default="power", choices=tuple((f, f) for f in FORMS)),
    )

    def __post_init__(self) -> None:
        self._exact()
        FittedLaws(self.form)

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *, form: str = "power") -> Self:
        """Theory for the summits of a map, as ``GreenwoodWilliamson.from_roughness``."""
        exact = GreenwoodWilliamson.from_roughness(roughness, E_star)
        return cls(E_star, exact.density, exact.radius, exact.height_deviation, exact.mean_height, form)

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa."""
        p = curve(pressure, "pressures (Pa)", positive=True)
        exact, laws = self._exact(), FittedLaws(self.form)
        P_a = p / exact.pressure_unit
        return prediction(
            p,
            area_fraction=self.density * self.radius * self.height_deviation * laws.area(P_a),
            contact_density=self.density * laws.number(P_a),
            mean_real_pressure=self.E_star * exact.roughness_ratio**0.5 * laws.real_pressure(P_a),
            separation=self.mean_height + self.height_deviation * laws.separation(P_a),
        )

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """The range of the fits, and that of the theory."""
        P_a = prediction.pressure / self._exact().pressure_unit
        message = "The fits leave the integrals they replace by more than a fifth (power) or a half (linear)."
        return (Limit("P_a", P_a, *FORMS[self.form], "Bhushan1998", message), area_limit(prediction))

    def _exact(self) -> GreenwoodWilliamson:
        return GreenwoodWilliamson(self.E_star, self.density, self.radius, self.height_deviation, self.mean_height)
