"""Summits of random heights and curvatures: McCool, Bush, Gibson and Thomas, and anisotropic
ones."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Annotated, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.quadrature import gauss
from ...core.values import Positive
from ..protocol import (
    BLUNT_SUMMITS,
    FEW_CONTACTS,
    GENTLE_SLOPES,
    ISOTROPY,
    Bound,
    MeanSquareBend,
    MeanSquareHeight,
    MeanSquareSlope,
    Modulus,
    Prediction,
    SeparationTheory,
)
from ..single.hertz import Ellipse, ellipse, ellipse_of_curvatures
from ..statistics.heights import GaussianHeights
from ..statistics.nayak import NARROWEST, ROUNDING, NayakSummits
from ..statistics.roughness import MomentTensor, Roughness
from .greenwood_williamson import GreenwoodWilliamson

ISOTROPIC_BANDWIDTH = Bound(
    "bandwidth alpha",
    lambda theory, answer: theory.alpha,
    NARROWEST * (1.0 - ROUNDING),
    math.inf,
    "Nayak1971",
    "No isotropic Gaussian surface has such moments; the map is anisotropic, not Gaussian or not resolved.",
)


@dataclass(frozen=True)
class _OfMoments(SeparationTheory):
    """Base of theories that are made from the moments of an isotropic Gaussian surface."""

    E_star: Modulus
    m0: MeanSquareHeight
    m2: MeanSquareSlope
    m4: MeanSquareBend

    def __post_init__(self) -> None:
        super().__post_init__()
        _ = self._nayak  # moments that no isotropic surface has

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float) -> Self:
        """Theory for the moments of ``roughness``."""
        return cls(E_star, roughness.m0, roughness.m2, roughness.m4)

    @cached_property
    def _nayak(self) -> NayakSummits:
        """Statistics of the summits."""
        return NayakSummits(self.m0, self.m2, self.m4)

    @property
    def alpha(self) -> float:
        """Nayak's bandwidth parameter m0 m4/m2²."""
        return self.m0 * self.m4 / self.m2**2

    @property
    def rms_gradient(self) -> float:
        """sqrt(2 m2)."""
        return math.sqrt(2.0 * self.m2)


# McCool (1986): the theory of Greenwood & Williamson with the summits of a Gaussian surface of
# given moments.


@dataclass(frozen=True)
class McCool(_OfMoments):
    """Greenwood and Williamson with η, R, σ_s and z̄_s of Nayak's summits and Gaussian heights
    (McCool 1986).

        η = m_4/(6 π √3 m_2),  R = (3/8) sqrt(π/m_4),
        σ_s² = (1 - 0.8968/α) m_0,  z̄_s = 4 sqrt(m_0/(π α)),  α = m_0 m_4/m_2².

    Every summit has the mean curvature, although the highest are the sharpest: for narrow spectra
    the area at light load is too large (α = 2: by 38 % at a separation of three standard
    deviations), and it has no linear limit. InputError if m0 m4/m2² < 1.5.
    """

    name: ClassVar[str] = "mccool"
    title: ClassVar[str] = "Greenwood-Williamson with McCool's parameters"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood1966", "McCool1986", "Nayak1971")
    limits: ClassVar[tuple[Bound, ...]] = (FEW_CONTACTS, BLUNT_SUMMITS, GENTLE_SLOPES, ISOTROPIC_BANDWIDTH, ISOTROPY)

    def equivalent(self) -> GreenwoodWilliamson:
        """The theory with summits of one radius that this one stands for."""
        s = self._nayak
        return GreenwoodWilliamson(self.E_star, s.density, s.radius, s.height_deviation, s.mean_height)

    @property
    def roughness_ratio(self) -> float:
        """σ_s/R."""
        return self.equivalent().roughness_ratio

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m from the mean plane of the surface."""
        return self.equivalent().at_separation(separation)

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, see ``GreenwoodWilliamson.at_pressure``."""
        return self.equivalent().at_pressure(pressure)


# Contacts on all summits of an isotropic Gaussian surface, with the two curvatures of each (Nayak
# 1971); see BushGibsonThomas.


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


class _OnSummits(_OfMoments):
    """Base of theories of contacts on all summits, which differ by the shape of a contact:
    ``circles`` or ellipses.

    Circles have the curvature sqrt(κ1 κ2): f_A = (1 - r²)^(-1/2), f_P = (1 - r²)^(-1/4).
    """

    circles: ClassVar[bool]
    limits: ClassVar[tuple[Bound, ...]] = (
        replace(FEW_CONTACTS, citation="Carbone2008"),
        GENTLE_SLOPES,
        ISOTROPIC_BANDWIDTH,
        ISOTROPY,
    )

    @cached_property
    def _shapes(self) -> SummitShapes:
        log_k, weight = gauss(np.array(_RATIOS), _NODES)
        shape = ellipse(np.exp(log_k))
        spherical = 1.0 - shape.r**2
        area, load = (spherical**-0.5, spherical**-0.25) if self.circles else (shape.area, shape.load)
        common = -weight * shape.slope * 2.0 * shape.r * spherical
        return SummitShapes(shape.r**2, np.stack([common * area, common * load], axis=-1))

    @property
    def _ends(self) -> tuple[float, float, float]:
        unit = math.sqrt(self.m0)
        return unit * _LOWEST, unit * _HIGHEST, unit

    def _contacts(self, h: RealArray) -> tuple[RealArray, RealArray]:
        t, weight = self._curvatures(h)
        area = np.sum(weight * t**3 * self._shape(t)[..., 0] * self._heights(h, t, 1.0), axis=-1)
        number = np.sum(weight * (t * t + np.expm1(-t * t)) * self._heights(h, t, 0.0), axis=-1)
        return math.sqrt(self.alpha / 6.0) * area, self.m4 / self.m2 / (3.0 * math.pi) * number

    def _law(self, h: RealArray) -> tuple[RealArray, RealArray]:
        t, weight = self._curvatures(h)
        weight = weight * t**3.5 * self._shape(t)[..., 1]
        unit = 4.0 / (9.0 * math.pi) * 1.5**0.25 * self.alpha**0.75 * self.E_star * math.sqrt(self.m2)
        pressure = unit * np.sum(weight * self._heights(h, t, 1.5), axis=-1)
        return pressure, 1.5 * unit / math.sqrt(self.m0) * np.sum(weight * self._heights(h, t, 0.5), axis=-1)

    @property
    def _rest(self) -> float:
        """sqrt(1 - ρ²), the deviation of the height of a summit about its regression on the
        curvature."""
        return math.sqrt(max(1.0 - self._nayak.correlation**2, _FEWEST))

    def _heights(self, h: RealArray, t: RealArray, k: float) -> RealArray:
        """H_k(t) for separations (n,) and curvatures (n, nodes)."""
        depth = (h[:, None] / math.sqrt(self.m0) - self._nayak.correlation * t) / self._rest
        return np.asarray(self._rest**k * GaussianHeights().tail_moment(depth, k))

    def _shape(self, t: RealArray) -> RealArray:
        """G_A/t⁴ and G_P/t⁴, (…, 2)."""
        return np.asarray(np.exp(-(t[..., None] ** 2) * self._shapes.r2) @ self._shapes.weights)

    def _curvatures(self, h: RealArray) -> tuple[RealArray, RealArray]:
        """Nodes t (n, nodes) where the touching summits lie, with weights that hold φ(t).

        About t = D/ρ the heights H change within sqrt(1 - ρ²)/ρ, as a half-integer power beyond it
        for narrow spectra: there panels are fine, and above it they run over sqrt(t - D/ρ).
        """
        D = h[:, None] / math.sqrt(self.m0)
        edge, spread = D / self._nayak.correlation, self._rest / self._nayak.correlation
        low = np.maximum(0.0, self._nayak.correlation * np.maximum(D, 0.0) - _WIDTH)
        high = self._nayak.correlation * np.maximum(D, 0.0) + _WIDTH
        fine = edge + spread * np.array(_FINE if spread < 1.0 else (0.0,))
        even = low + (high - low) * np.array(_EVEN)
        breaks = np.sort(np.clip(np.concatenate([fine, even], axis=-1), low, high), axis=-1)
        below, weight_below = gauss(np.minimum(breaks, edge), _NODES)
        root, weight_above = gauss(np.sqrt(np.maximum(breaks - edge, 0.0)), _NODES)
        is_above = root > 0.0
        t = np.maximum(np.where(is_above, edge + root * root, below), 0.0)
        weight = np.where(is_above, 2.0 * root * weight_above, weight_below)
        return t, weight * np.exp(-0.5 * t * t) / math.sqrt(2.0 * math.pi)


# Bush, Gibson & Thomas (1975): all summits of an isotropic Gaussian surface, each an elliptical
# Hertz contact.


ASYMPTOTE = math.sqrt(2.0 * math.pi)
"""A_r/A_a E* h'_rms/p at vanishing load, for every bandwidth; h'_rms = sqrt(2 m2)."""


@dataclass(frozen=True)
class BushGibsonThomas(_OnSummits):
    """Elliptical contacts on all summits of an isotropic Gaussian surface.

    With α = m0 m4/m2², ρ² = 3/(2α), D = h/sqrt(m0), the mean curvature t of a summit in sqrt(2
    m4/3) and the relative difference r of its curvatures,

        A_r/A_a = sqrt(α/6) ∫ (φ(t)/t) G_A(t) H_1(t) dt,
        p = (4/(9 π)) (3/2)^(1/4) α^(3/4) E* sqrt(m_2) ∫ (φ(t)/sqrt(t)) G_P(t) H_(3/2)(t) dt,
        n = (m_4/(3 π m_2)) ∫ φ(t) (t² - 1 + e^(-t²)) H_0(t) dt,
        G(t) = 2 ∫_0^1 t⁴ (1 - r²) r exp(-t² r²) f(r) dr,
        H_k(t) = (1 - ρ²)^(k/2) F_k[(D - ρ t)/sqrt(1 - ρ²)],

    f_A and f_P of Hertz's ellipse. The area tends to sqrt(2π) p/(E* h'_rms) at vanishing load, very
    slowly for wide spectra (Carbone & Bottiglione 2008). On the summed moments of two surfaces this
    is the elastic part of Francis's (1977) theory of their sum; for the irreversible part take
    ``kogut-etsion`` or ``jackson-green`` on the same moments. InputError if m0 m4/m2² < 1.5.
    """

    name: ClassVar[str] = "bush-gibson-thomas"
    title: ClassVar[str] = "Bush-Gibson-Thomas"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bush1975", "Carbone2008", "Francis1977", "Nayak1971")
    circles: ClassVar[bool] = False


@dataclass(frozen=True)
class GreenwoodElliptic(_OnSummits):
    """Greenwood's simplified elliptic model: on every summit a circle of the geometric mean
    curvature sqrt(κ1 κ2).

    The formulas of ``BushGibsonThomas`` with

        f_A(r) = (1 - r²)^(-1/2),  f_P(r) = (1 - r²)^(-1/4).

    Area and load are within 2 % and 3 % of ``BushGibsonThomas`` at the same separation, and the
    limit at vanishing load is the same. InputError if m0 m4/m2² < 1.5.
    """

    name: ClassVar[str] = "greenwood-elliptic"
    title: ClassVar[str] = "Greenwood's simplified elliptic model"
    citation_keys: ClassVar[tuple[str, ...]] = ("Greenwood2006", "Nayak1971")
    circles: ClassVar[bool] = True


# High summits of an anisotropic Gaussian surface: the limit of Bush, Gibson & Keogh (1979) at large
# separation.


HIGH = 3.0
"""Separation in sqrt(m0) above which the limit is meant to hold; for an isotropic surface of α = 2
it then is 3 % off."""

_CLOSEST, _FARTHEST = 0.0, 36.0  # separations in sqrt(m0) between which its pressures are inverted


@dataclass(frozen=True)
class AnisotropicSummits(SeparationTheory):
    """High summits are alike: their curvatures are (z/m0)(m20, m02), whatever the rest of the
    spectrum.

    With g = m20/m02, D = h/sqrt(m0), f_A and f_P of the Hertz contact of curvatures in the ratio g,
    and r = (g - 1)/(g + 1),

        A_r/A_a = (1/2) f_A sqrt(1 - r²) Q(D) = sqrt(2π) (f_A/f_P) p/(E* h'_rms),
        (h'_rms)² = m_(20) + m_(02),

    Q the bearing area, and n = sqrt(m20 m02)/(2π m0) D φ(D) contacts per area. At constant gradient
    anisotropy raises the area slightly: by 1.3 % at g = 2, 12 % at g = 10.
    """

    E_star: Modulus
    m0: MeanSquareHeight
    steepest: Annotated[Positive, "mean square slope of profiles along the steepest direction"]
    gentlest: Annotated[Positive, "mean square slope of profiles across it"]
    name: ClassVar[str] = "anisotropic-summits"
    title: ClassVar[str] = "Bush-Gibson-Keogh, high summits of anisotropic surfaces"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bush1979", "Johnson1985", "Nayak1971")
    limits: ClassVar[tuple[Bound, ...]] = (
        Bound(
            "separation over rms height",
            lambda theory, answer: answer.separation / math.sqrt(theory.m0),
            HIGH,
            math.inf,
            "Bush1979",
            "Lower summits touch, whose curvatures scatter and depend on the whole spectrum.",
        ),
        FEW_CONTACTS,
        GENTLE_SLOPES,
    )

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float) -> Self:
        """Theory for the principal slopes of ``roughness``; InputError without moments by
        direction, or if it is a grating."""
        moments = roughness.known(roughness.moments, "moments by direction", cls.name)
        return cls(E_star, roughness.m0, *moments.principal_slopes)

    @property
    def ellipse(self) -> Ellipse:
        """Contact ellipse of a high summit."""
        ratio = self.steepest / self.gentlest
        return ellipse_of_curvatures(max(ratio, 1.0 / ratio))

    @property
    def bearing_share(self) -> float:
        """A_r over the bearing area, 1/2 for an isotropic surface."""
        shape = self.ellipse
        return 0.5 * float(shape.area * np.sqrt(1.0 - shape.r**2))

    @property
    def coefficient(self) -> float:
        """A_r/A_a E* h'_rms/p, sqrt(2π) for an isotropic surface."""
        shape = self.ellipse
        return math.sqrt(2.0 * math.pi) * float(shape.area / shape.load)

    @property
    def rms_gradient(self) -> float:
        """sqrt(m20 + m02)."""
        return math.sqrt(self.steepest + self.gentlest)

    @property
    def _ends(self) -> tuple[float, float, float]:  # up to the mean plane, far beyond the validity of the limit
        unit = math.sqrt(self.m0)
        return unit * _CLOSEST, unit * _FARTHEST, unit

    def _law(self, h: RealArray) -> tuple[RealArray, RealArray]:
        D, gaussian = h / math.sqrt(self.m0), GaussianHeights()
        unit = self.E_star * self.rms_gradient * self.bearing_share / self.coefficient
        return unit * gaussian.tail_moment(D, 0.0), unit / math.sqrt(self.m0) * gaussian.density(D)

    def _contacts(self, h: RealArray) -> tuple[RealArray, RealArray]:
        D, gaussian = h / math.sqrt(self.m0), GaussianHeights()
        density = math.sqrt(self.steepest * self.gentlest) / (2.0 * math.pi * self.m0)
        return self.bearing_share * gaussian.tail_moment(D, 0.0), density * np.maximum(D, 0.0) * gaussian.density(D)


def equivalent_isotropic(moments: MomentTensor) -> tuple[float, float]:
    """m2 = sqrt(m20 m02) and m4 = sqrt(m40 m04) (1/m²), McCool's (1986) isotropic substitute of an
    anisotropic surface.

    In the limit of large separation it makes the area 1.7 % too large at m20/m02 = 2 and 18 % at
    10; the mean (m20 + m02)/2, which ``Roughness`` holds, makes it 1.3 % and 11 % too small.

    ``moments``: moments in the principal axes of the texture: ``m11`` is left out.
    """
    return math.sqrt(moments.m20 * moments.m02), math.sqrt(moments.m40 * moments.m04)
