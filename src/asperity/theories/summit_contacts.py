"""Contacts on all summits of an isotropic Gaussian surface, with the two curvatures of each (Nayak 1971).

With α = m0 m4/m2², ρ = sqrt(3/(2α)), D = h/sqrt(m0), the mean curvature t of a summit in sqrt(2 m4/3) and the relative
difference r of its curvatures, the summits of Nayak's density carry

    A_r/A_a = sqrt(α/6) ∫ φ(t)/t G_A(t) H_1(t) dt,
    p/(E* sqrt(m2)) = (4/9π) (3/2)^(1/4) α^(3/4) ∫ φ(t)/sqrt(t) G_P(t) H_(3/2)(t) dt,
    n m2/m4 = (1/3π) ∫ φ(t) (t² - 1 + e^(-t²)) H_0(t) dt,
    G(t) = ∫₀¹ t⁴ (1 - r²) 2r exp(-t² r²) f(r) dr,  H_k(t) = (1 - ρ²)^(k/2) F_k[(D - ρt)/sqrt(1 - ρ²)].
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..core.arrays import RealArray
from ..core.quadrature import gauss
from .elliptic_asperity import ellipse
from .inversion import separation_at
from .nayak import NayakSummits
from .protocol import Prediction, prediction
from .summit_heights import GaussianHeights

_LOWEST, _HIGHEST = -12.0, 35.0  # separations in sqrt(m0) between which pressures are inverted
_WIDTH = 9.0  # standard deviations within which the curvatures of touching summits lie
_FEWEST = 1e-9  # rest variance of the height at given curvature, which is zero for a single wavelength
_NODES = 16  # in each panel; they leave 1e-13
_FINE = (-9.0, -3.0, 0.0, 1.0, 3.0, 9.0)  # panels about an edge in deviations, for narrow spectra
_EVEN = (0.0, 0.03, 0.2, 0.4, 0.6, 0.8, 1.0)  # panels from the lowest to the highest curvature; t^3.5 starts at zero
_RATIOS = (-13.0, -4.0, -1.5, -0.5, -0.15, 0.0)  # panels of ln(b/a); slimmer ellipses hold 1e-17 of the area


@dataclass(frozen=True, eq=False)
class SummitShapes:
    """Rule over the shapes of summits: ``r2`` (n,) squares of r; weights (n, 2) for G_A and G_P."""

    r2: RealArray
    weights: RealArray


def elliptic_shapes() -> SummitShapes:
    """Each contact the ellipse of its summit, f_A and f_P as in ``Ellipse``."""
    return _shapes(circles=False)


def circular_shapes() -> SummitShapes:
    """Each contact a circle with the curvature sqrt(κ1 κ2): f_A = (1 - r²)^(-1/2), f_P = (1 - r²)^(-1/4)."""
    return _shapes(circles=True)


@dataclass(frozen=True, eq=False)
class SummitContacts:
    """The surface with moments ``m0`` (m²), ``m2``, ``m4`` (1/m²) and contacts of the given ``shapes``; ``E_star`` in Pa.

    Raises
    ------
    InputError
        If a moment is not positive or m0 m4/m2² < 1.5.
    """

    E_star: float
    m0: float
    m2: float
    m4: float
    shapes: SummitShapes

    def __post_init__(self) -> None:
        NayakSummits(self.m0, self.m2, self.m4)

    @property
    def alpha(self) -> float:
        """Nayak's bandwidth parameter m0 m4/m2²."""
        return self.m0 * self.m4 / self.m2**2

    def at_separation(self, h: RealArray) -> Prediction:
        """Prediction at separations ``h`` (n,) in m from the mean plane of the surface."""
        t, weight = self._curvatures(h)
        plain = weight * np.exp(-0.5 * t * t) / math.sqrt(2.0 * math.pi)
        shape = self._shape(t)
        area = np.sum(plain * t**3 * shape[..., 0] * self._heights(h, t, 1.0), axis=-1)
        number = np.sum(plain * (t * t + np.expm1(-t * t)) * self._heights(h, t, 0.0), axis=-1)
        pressure, stiffness = self._loads(h, t, plain * t**3.5 * shape[..., 1])
        return prediction(
            pressure,
            area_fraction=math.sqrt(self.alpha / 6.0) * area,
            contact_density=self.m4 / self.m2 / (3.0 * math.pi) * number,
            separation=h,
            stiffness=stiffness,
        )

    def at_pressure(self, pressure: RealArray) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, positive.

        Raises
        ------
        InputError
            If a pressure is larger than at 12 standard deviations below the mean plane.
        """
        unit = math.sqrt(self.m0)
        return self.at_separation(separation_at(pressure, self._law, unit * _LOWEST, unit * _HIGHEST, unit=unit))

    def _law(self, h: RealArray) -> tuple[RealArray, RealArray]:
        t, weight = self._curvatures(h)
        plain = weight * np.exp(-0.5 * t * t) / math.sqrt(2.0 * math.pi)
        return self._loads(h, t, plain * t**3.5 * self._shape(t)[..., 1])

    def _loads(self, h: RealArray, t: RealArray, weight: RealArray) -> tuple[RealArray, RealArray]:
        unit = 4.0 / (9.0 * math.pi) * 1.5**0.25 * self.alpha**0.75 * self.E_star * math.sqrt(self.m2)
        pressure = unit * np.sum(weight * self._heights(h, t, 1.5), axis=-1)
        return pressure, 1.5 * unit / math.sqrt(self.m0) * np.sum(weight * self._heights(h, t, 0.5), axis=-1)

    @property
    def _rho(self) -> float:
        return NayakSummits(self.m0, self.m2, self.m4).correlation

    @property
    def _rest(self) -> float:
        """sqrt(1 - ρ²), the deviation of the height of a summit about its regression on the curvature."""
        return math.sqrt(max(1.0 - self._rho**2, _FEWEST))

    def _heights(self, h: RealArray, t: RealArray, k: float) -> RealArray:
        """H_k(t) for separations (n,) and curvatures (n, nodes)."""
        depth = (h[:, None] / math.sqrt(self.m0) - self._rho * t) / self._rest
        values: RealArray = self._rest**k * GaussianHeights().tail_moment(depth, k)
        return values

    def _shape(self, t: RealArray) -> RealArray:
        """G_A/t⁴ and G_P/t⁴, (…, 2)."""
        values: RealArray = np.exp(-(t[..., None] ** 2) * self.shapes.r2) @ self.shapes.weights
        return values

    def _curvatures(self, h: RealArray) -> tuple[RealArray, RealArray]:
        """Nodes t (n, nodes) where the touching summits lie, with weights.

        About t = D/ρ the heights H change within sqrt(1 - ρ²)/ρ, as a half-integer power beyond it for narrow spectra:
        there panels are fine, and above it they run over sqrt(t - D/ρ).
        """
        D = h[:, None] / math.sqrt(self.m0)
        edge, spread = D / self._rho, self._rest / self._rho
        low = np.maximum(0.0, self._rho * np.maximum(D, 0.0) - _WIDTH)
        high = self._rho * np.maximum(D, 0.0) + _WIDTH
        fine = edge + spread * np.array(_FINE if spread < 1.0 else (0.0,))
        even = low + (high - low) * np.array(_EVEN)
        breaks = np.sort(np.clip(np.concatenate([fine, even], axis=-1), low, high), axis=-1)
        below, weight_below = gauss(np.minimum(breaks, edge), _NODES)
        root, weight_above = gauss(np.sqrt(np.maximum(breaks - edge, 0.0)), _NODES)
        is_above = root > 0.0
        t = np.maximum(np.where(is_above, edge + root * root, below), 0.0)
        return t, np.where(is_above, 2.0 * root * weight_above, weight_below)


def _shapes(*, circles: bool) -> SummitShapes:
    log_k, weight = gauss(np.array(_RATIOS), _NODES)
    shape = ellipse(np.exp(log_k))
    spherical = 1.0 - shape.r**2
    area, load = (spherical**-0.5, spherical**-0.25) if circles else (shape.area, shape.load)
    common = -weight * shape.slope * 2.0 * shape.r * spherical
    return SummitShapes(shape.r**2, np.stack([common * area, common * load], axis=-1))
