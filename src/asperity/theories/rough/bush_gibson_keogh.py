"""Contacts on all summits of an anisotropic Gaussian surface (Bush, Gibson & Keogh 1979)."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal, Self

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.parameters import Help
from ...core.quadrature import gauss
from ...core.quantity import Quantity
from ...core.scipy_parts import interpolate
from ...core.values import Number, Positive
from ..protocol import FEW_CONTACTS, GENTLE_SLOPES, Bound, MeanSquareHeight, Modulus, SeparationTheory
from ..single.hertz import ellipse
from ..statistics.heights import GaussianHeights
from ..statistics.roughness import MomentTensor, Roughness

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

# Means over the summits of a Gaussian surface with principal axes x and y (Bush, Gibson & Keogh
# 1979; Gibson 1982; McCool 1986). At a point the gradient and (z, ∇∇z) are
# independent; given the curvatures the height z is normal about a mean that is linear in them.
#
# Curvatures are scaled by the roots of m40 and m04,
#
# z_xx = -sqrt(m40) T (1 + ϱ cos ψ), z_yy = -sqrt(m04) T (1 - ϱ cos ψ), z_xy = (m40 m04)^(1/4) T ϱ
# sin ψ,
#
# so that summits are T > 0, 0 <= ϱ < 1. With T = τ/sqrt(Q) the density over a direction (ϱ, ψ) is
# exp(-τ²/2), and the height depends on τ and one number of the direction, its correlation with z.


_SHAPES, _TURNS = 48, 64  # Gauss nodes in ϱ and steps in ψ; they leave 1e-11 at m20/m02 = 25
_FINE_TURNS = 4096  # of plain curvatures, whose density is the sharper the more anisotropic the surface is
_FEW, _MANY = 64, 192  # nodes in the correlation of height and direction; many where it is nearly one
_NARROW = 0.98  # correlation above which they are many
_NODES = 16  # Gauss nodes of each panel in τ
_WIDTH = 9.0  # standard deviations within which the curvatures of touching summits lie
_LOWEST, _HIGHEST = -12.0, 35.0  # separations in sqrt(m00) between which pressures are inverted
_SLIM = -13.0  # ln(b/a) of the slimmest ellipse
_TABLE = 3000  # ellipses between it and the circle
_FINE, _SPAN = 0.01, 60.0  # step and ends of the table of the moments of heights
_NUMBERS_END = 36.0  # t at which F_k is 1e-284
_FEWEST = 1e-9  # rest variance of the height over m00 that is still told from none

Closure = Literal["stretched", "separable"]
MixedBend = Annotated[float, Number("1/m^2")]


@dataclass(frozen=True, eq=False)
class _Directions:
    """Shapes of summits as nodes in the correlation ``angle`` (c,) of height and direction: their
    c = tan(angle), and for number, area and load ``weights`` (c,) of a unit integral over τ."""

    slope: RealArray
    number: RealArray
    area: RealArray
    load: RealArray


@dataclass(frozen=True)
class BushGibsonKeogh(SeparationTheory):
    """Elliptical contacts on all summits of an anisotropic Gaussian surface, at any separation.

    m_jk are the mean products of wavenumbers q_x^j q_y^k over the spectrum, in the principal axes
    of the gradient. At a point the second derivatives H are normal and independent of the gradient,
    and given them the height is normal with the mean μ and the deviation s,

        X/A_a = (1/(2 π sqrt(m_20 m_02))) ∫ |H| p(H) <X_1> d³H,
        μ = -(m_20, m_02, 0) C^(-1) (z_xx, z_yy, z_xy),
        s² = m_00 - (m_20, m_02, 0) C^(-1) (m_20, m_02, 0),

    over all H of a summit; |H| is the determinant, C the covariances of z_xx, z_yy and z_xy. Each
    summit of mean curvature κ_m, relative difference r of its curvatures and t = (h - μ)/s gives
    F_0(t) to the number, and with f_A, f_P of Hertz's ellipse

        A_1 = (π s/κ_m) f_A(r) F_1(t),  p_1 = (4/3) E* s^(3/2) κ_m^(-1/2) f_P(r) F_(3/2)(t).

    Five moments, as they are often given, leave m22 open: ``closure`` takes that of a stretched
    isotropic surface, sqrt(m40 m04)/3, or of a product of two profiles, m20 m02/m0. At m20/m02 = 4
    they differ by 17 % in the number of summits, 1 % in the area at the mean plane: measure m22.
    High summits tend to ``anisotropic-summits``. McCool (1986) has simulated the same statistics.

    InputError if no Gaussian surface has such moments: m40 m04 < m22², or a height that the
    curvatures leave no freedom.

    Examples
    --------
    A surface with four times the mean square slope along x, beside the isotropic surface of the
    same geometric means:

    >>> from asperity.theories import BushGibsonThomas
    >>> lay = BushGibsonKeogh(1e11, 1e-16, m20=2e-2, m02=0.5e-2, m40=8e12, m04=0.5e12)
    >>> even = BushGibsonThomas(1e11, 1e-16, m2=1e-2, m4=2e12)
    >>> f"{(even.at_pressure(1e7).area_fraction / lay.at_pressure(1e7).area_fraction).item():.2f}"
    '1.06'
    """

    E_star: Modulus
    m0: MeanSquareHeight
    m20: Annotated[Positive, "mean square slope along x, a principal axis of the slopes"]
    m02: Annotated[Positive, "mean square slope along y"]
    m40: Annotated[float, Number("1/m^2", above=0.0), "mean square second derivative along x"]
    m04: Annotated[float, Number("1/m^2", above=0.0), "mean square second derivative along y"]
    m22: Annotated[MixedBend | None, "mean product of both second derivatives; by the closure if not given"] = None
    m31: Annotated[MixedBend, "mean product of the second derivative along x and the mixed one"] = 0.0
    m13: Annotated[MixedBend, "mean product of the second derivative along y and the mixed one"] = 0.0
    closure: Annotated[Closure, Help("m22 where it is not given", of="choice")] = "stretched"
    name: ClassVar[str] = "bush-gibson-keogh"
    title: ClassVar[str] = "Bush-Gibson-Keogh, all summits of anisotropic surfaces"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bush1979", "McCool1986", "Johnson1985")
    limits: ClassVar[tuple[Bound, ...]] = (FEW_CONTACTS, GENTLE_SLOPES)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("density", "1/m^2", "summits per area"),
        Quantity("mean_height", "m", "mean height of the summits above the mean plane"),
        Quantity("height_deviation", "m", "standard deviation of the summit heights"),
        Quantity("mean_curvature", "1/m", "mean over the summits of their mean curvature"),
        Quantity("mean_geometric_curvature", "1/m", "mean of the geometric mean of the curvatures of a summit"),
        Quantity("mean_difference", "1", "mean relative difference of the curvatures of a summit"),
        Quantity("curvature_x", "1/m", "mean curvature of the summits along x"),
        Quantity("curvature_y", "1/m", "mean curvature of the summits along y"),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        covariance = self._covariance
        if not np.linalg.eigvalsh(covariance)[0] > 0.0:
            raise InputError(
                "moments of an anisotropic surface must have m40 m04 > m22^2 and small m31, m13, but have m40 m04 = "
                f"{self.m40 * self.m04:.6g} 1/m^4 and m22^2 = {self._m22**2:.6g} 1/m^4. Finite differences on a coarse "
                "grid can give this."
            )
        if not self._rest > _FEWEST * self.m0:
            raise InputError(
                f"mean square height m0 (m^2) must be more than {self.m0 - self._rest:.6g}, which the curvatures "
                f"explain, but is {self.m0:.6g}: no Gaussian surface has such moments."
            )

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *, closure: Closure = "stretched") -> Self:
        """Theory for the moments by direction of ``roughness``, turned to the principal axes of the
        slopes; ``closure`` for m22 where it is not known.

        InputError without second and fourth moments, or if it is a grating.
        """
        found = roughness.known(roughness.moments, "moments by direction", cls.name)
        turned = in_principal_axes(found)
        roughness.known(None if math.isnan(turned.m40 + turned.m04) else turned, "fourth moments", cls.name)
        mixed = [None if math.isnan(value) else value for value in (turned.m22, turned.m31, turned.m13)]
        numbers = (turned.m20, turned.m02, turned.m40, turned.m04)
        return cls(E_star, roughness.m0, *numbers, mixed[0], mixed[1] or 0.0, mixed[2] or 0.0, closure)

    @property
    def rms_gradient(self) -> float:
        """sqrt(m20 + m02)."""
        return math.sqrt(self.m20 + self.m02)

    @property
    def density(self) -> float:
        """Summits per area in 1/m²."""
        return self._mean_of(4.0)

    @property
    def mean_height(self) -> float:
        """Mean height of the summits above the mean plane in m."""
        return self._mean_of(5.0, self._height) / self.density

    @property
    def height_deviation(self) -> float:
        """Standard deviation of the summit heights in m."""
        return math.sqrt(self._rest + self._mean_of(6.0, self._height**2) / self.density - self.mean_height**2)

    @property
    def mean_curvature(self) -> float:
        """Mean of κ_m over the summits in 1/m."""
        return self._mean_of(5.0, self._summits[2]) / self.density

    @property
    def mean_geometric_curvature(self) -> float:
        """Mean of sqrt(κ1 κ2) over the summits in 1/m."""
        spherical = math.sqrt(self._scale) * np.sqrt(1.0 - self._nodes[0] ** 2)
        return self._mean_of(5.0, spherical) / self.density

    @property
    def mean_difference(self) -> float:
        """Mean of r = (κ1 - κ2)/(κ1 + κ2) over the summits."""
        # r is no smooth function of (ϱ, ψ) where the curvatures are equal: about that place
        y, weight = gauss(np.array([0.0, 1.0]), _SHAPES)
        r = (1.0 - (1.0 - y) ** 2)[:, None]
        turn = 2.0 * math.pi * np.arange(_FINE_TURNS) / _FINE_TURNS
        scaled = np.stack(np.broadcast_arrays(-1.0 - r * np.cos(turn), r * np.cos(turn) - 1.0, r * np.sin(turn)))
        scaled /= self._roots[:, None, None]
        Q = np.sum(scaled * np.tensordot(np.linalg.inv(self._covariance), scaled, 1), axis=0)
        share = np.mean(Q**-2.5, axis=1) * weight * (1.0 - y) * r[:, 0] * (1.0 - r[:, 0] ** 2)
        return float(share @ r[:, 0]) / float(share.sum())

    @property
    def curvature_x(self) -> float:
        """Mean of -∂²z/∂x² over the summits in 1/m."""
        return self._mean_of(5.0, -self._directions[0]) / self.density

    @property
    def curvature_y(self) -> float:
        """Mean of -∂²z/∂y² over the summits in 1/m."""
        return self._mean_of(5.0, -self._directions[1]) / self.density

    @property
    def _ends(self) -> tuple[float, float, float]:
        unit = math.sqrt(self.m0)
        return unit * _LOWEST, unit * _HIGHEST, unit

    def _law(self, h: RealArray) -> tuple[RealArray, RealArray]:
        unit = 4.0 / 3.0 * self.E_star * self._rest**0.75
        load = self._weights.load
        slope = 1.5 * unit / math.sqrt(self._rest)
        return unit * self._sum(h, 3.5, 1.5, load), slope * self._sum(h, 3.5, 0.5, load)

    def _contacts(self, h: RealArray) -> tuple[RealArray, RealArray]:
        area = math.pi * math.sqrt(self._rest) * self._sum(h, 3.0, 1.0, self._weights.area)
        return area, self._sum(h, 4.0, 0.0, self._weights.number)

    # Covariances.

    @property
    def _m22(self) -> float:
        if self.m22 is not None:
            return self.m22
        return self._scale / 3.0 if self.closure == "stretched" else self.m20 * self.m02 / self.m0

    @property
    def _scale(self) -> float:
        """sqrt(m40 m04)."""
        return math.sqrt(self.m40 * self.m04)

    @property
    def _covariance(self) -> RealArray:
        """Of z_xx, z_yy and z_xy, over what scales them."""
        m22 = self._m22
        raw = np.array([[self.m40, m22, self.m31], [m22, self.m04, self.m13], [self.m31, self.m13, m22]])
        roots = self._roots
        return np.asarray(raw / np.multiply.outer(roots, roots))

    @property
    def _roots(self) -> RealArray:
        return np.array([math.sqrt(self.m40), math.sqrt(self.m04), math.sqrt(self._scale)])

    @cached_property
    def _regression(self) -> RealArray:
        """-C^(-1) (m20, m02, 0) for scaled curvatures, in m."""
        return np.asarray(np.linalg.solve(self._covariance, np.array([self.m20, self.m02, 0.0]) / self._roots))

    @property
    def _rest(self) -> float:
        """s² in m²."""
        return self.m0 - float(self._regression @ (np.array([self.m20, self.m02, 0.0]) / self._roots))

    # Quadrature over the shapes of summits.

    @cached_property
    def _nodes(self) -> tuple[RealArray, RealArray, RealArray]:
        """ϱ and ψ (n,) of the rule, and its weights of ϱ dϱ dψ."""
        y, weight = gauss(np.array([0.0, 1.0]), _SHAPES)
        rho = 1.0 - (1.0 - y) ** 2
        weight = weight * 2.0 * (1.0 - y) * rho
        psi = 2.0 * math.pi * np.arange(_TURNS) / _TURNS
        columns = np.broadcast_arrays(rho[:, None], psi[None], weight[:, None] * 2.0 * math.pi / _TURNS)
        return columns[0].ravel(), columns[1].ravel(), columns[2].ravel()

    @cached_property
    def _directions(self) -> RealArray:
        """(3, n) z_xx, z_yy and z_xy of T = 1."""
        rho, psi, _ = self._nodes
        a, b = rho * np.cos(psi), rho * np.sin(psi)
        return self._roots[:, None] * np.stack([-1.0 - a, a - 1.0, b])

    @cached_property
    def _height(self) -> RealArray:
        """(n,) mean height in m of the summits of T = 1."""
        return np.asarray(self._regression @ (-self._directions / self._roots[:, None]))

    @cached_property
    def _summits(self) -> tuple[RealArray, RealArray, RealArray, RealArray]:
        """Q, weights of a unit integral over τ, κ_m of T = 1 and r, (n,) each."""
        rho, _, weight = self._nodes
        scaled = self._directions / self._roots[:, None]
        Q = np.sum(scaled * np.linalg.solve(self._covariance, scaled), axis=0)
        unit = 2.0 * self._scale / (2.0 * math.pi * math.sqrt(self.m20 * self.m02))
        unit /= (2.0 * math.pi) ** 1.5 * math.sqrt(float(np.linalg.det(self._covariance)))
        xx, yy, xy = self._directions
        mean = -0.5 * (xx + yy)
        r = np.hypot(0.5 * (xx - yy), xy) / mean
        return Q, unit * weight * (1.0 - rho**2), mean, r

    def _mean_of(self, power: float, values: RealArray | float = 1.0) -> float:
        """Sum over all summits of ``values`` T^(power - 4), per area."""
        Q, weight, _, _ = self._summits
        moment = math.pow(2.0, 0.5 * (power - 1.0)) * math.gamma(0.5 * (power + 1.0))
        return moment * float(np.sum(weight * values * Q ** (-0.5 * (power + 1.0))))

    @cached_property
    def _weights(self) -> _Directions:
        """The directions as Chebyshev nodes in the angle whose tangent is the slope of the height
        in τ over s: Lagrange's polynomials take their weights to the nodes."""
        Q, weight, mean, r = self._summits
        angle = np.arctan(self._height / np.sqrt(Q * self._rest))
        low, high = float(angle.min()), float(angle.max())
        many = _MANY if max(-math.sin(low), math.sin(high)) > _NARROW else _FEW
        at = np.cos(math.pi * (np.arange(many) + 0.5) / many)
        place = (2.0 * angle - low - high) / (high - low) if high > low else np.zeros_like(angle)
        # discrete orthogonality of the polynomials: sum over degrees of T_k(node) T_k(place)
        degrees = np.polynomial.chebyshev.chebvander(at, many - 1)
        degrees[:, 0] *= 0.5
        area, load = _ellipses(r)
        share = np.stack(
            [
                weight * Q**-2.5,
                weight * area / mean * Q**-2.0,
                weight * load / np.sqrt(mean) * Q**-2.25,
            ]
        )
        taken = share @ np.polynomial.chebyshev.chebvander(place, many - 1)
        sums = 2.0 / many * taken @ degrees.T
        return _Directions(np.tan(0.5 * (low + high) + 0.5 * (high - low) * at), *sums)

    def _sum(self, h: RealArray, power: float, k: float, weights: RealArray) -> RealArray:
        """∫ τ^power exp(-τ²/2) F_k(h/s - c τ) dτ over the nodes c with their ``weights``, for
        separations (n,)."""
        x = h / math.sqrt(self._rest)
        return np.array([weights @ self._integrals(float(one), power, k) for one in x])

    def _integrals(self, x: float, power: float, k: float) -> RealArray:
        """∫ τ^power exp(-τ²/2) F_k(x - c τ) dτ for the slopes c (m,).

        The integrand is largest about τ = c x/(1 + c²), and changes about x/c within 1/c.
        """
        c = self._weights.slope
        peak = np.maximum(c * x / (1.0 + c * c), 0.0) if x > 0.0 else np.zeros_like(c)
        low, high = np.maximum(peak - _WIDTH, 0.0), peak + _WIDTH
        steep = np.maximum(np.abs(c), 1.0)
        with np.errstate(divide="ignore", invalid="ignore"):
            edge = np.where(c != 0.0, x / c, 0.0)
        edge = np.clip(edge, low, high)
        offsets = (edge - 4.0 / steep, edge, edge + 4.0 / steep, peak - 3.0, peak, peak + 3.0)
        breaks = np.sort(np.clip(np.stack([low, *offsets, high], axis=-1), low[:, None], high[:, None]), axis=-1)
        root, weight = gauss(np.sqrt(breaks), _NODES)  # over the root of τ, in which half powers are smooth
        tau = root * root
        logs = _log_moment(k)(x - c[:, None] * tau) - 0.5 * tau * tau
        return np.asarray(np.sum(2.0 * weight * root * tau**power * np.exp(logs), axis=-1))


@functools.cache
def _log_moment(k: float) -> CubicSpline:
    """ln F_k(t) as a spline, to 1e-11 of F_k; beyond where numbers end by its asymptote."""
    t = np.arange(-_SPAN, _SPAN, _FINE)
    far = t > _NUMBERS_END
    logs = np.log(GaussianHeights().tail_moment(np.where(far, _NUMBERS_END, t), k))
    rest = -0.5 * (t * t - _NUMBERS_END**2) - (k + 1.0) * np.log(np.maximum(t, 1.0) / _NUMBERS_END)
    return interpolate.CubicSpline(t, logs + np.where(far, rest, 0.0))


@functools.cache
def _log_ellipse() -> CubicSpline:
    """ln f_A and ln f_P of Hertz's ellipse as a spline of the logarithm of the ratio of the
    curvatures."""
    shape = ellipse(np.exp(np.linspace(_SLIM, 0.0, _TABLE)[::-1]))
    ratio = np.log1p(shape.r) - np.log1p(-shape.r)
    return interpolate.CubicSpline(ratio, np.log(np.stack([shape.area, shape.load], axis=-1)))


def _ellipses(r: RealArray) -> tuple[RealArray, RealArray]:
    """f_A and f_P of Hertz's ellipse for relative differences ``r`` of the curvatures, (n,)."""
    spline = _log_ellipse()
    ratio = np.log1p(r) - np.log1p(-np.minimum(r, 1.0 - 1e-15))
    area, load = np.exp(spline(np.minimum(ratio, spline.x[-1]))).T
    return area, load


def in_principal_axes(moments: MomentTensor) -> MomentTensor:
    """The moments in axes along which the slopes are independent, the steepest first.

    Fourth moments of which one is not known are NaN but for m40 and m04 of axes that need no
    turning; those of m31 and m13 count as zero there.
    """
    steep, gentle = moments.principal_slopes
    angle = 0.5 * math.atan2(2.0 * moments.m11, moments.m20 - moments.m02)
    c, s = math.cos(angle), math.sin(angle)
    fourth = np.array([moments.m40, moments.m31, moments.m22, moments.m13, moments.m04])

    def turned(along: int) -> float:
        product = np.array([1.0])
        for number in range(4):
            product = np.convolve(product, [c, s] if number < along else [-s, c])
        return float(product @ fourth)

    return MomentTensor(steep, 0.0, gentle, *(turned(along) for along in (4, 3, 2, 1, 0)))
