"""Stresses below Hertz contacts of spheres, cylinders and ellipsoids, normal and sliding."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import ComplexArray, RealArray
from ...core.parameters import Help
from ...core.quadrature import gauss
from ...core.tensor import Displacement, ElasticFields, StressTensor
from ...core.values import Length, Number
from ..ask import ALONG_X, ALONG_Y, DEPTH, STRESS, StressAnswer, Way, asked, places
from ..protocol import Modulus, PoissonOfSolid, Radius, Theory
from ..single.hertz import HertzEllipse, HertzLine, HertzPoint, RadiusX, RadiusY

# Circular Hertz contact, pressed and sliding: displacement and stress in closed form.
#
# The semi-ellipsoidal traction is a row of point sources on an imaginary axis: ∫ sqrt(1 - s²/a²)/ρ
# dA equals (π/2a) ∫ (a² - t²)/sqrt(r² + (z + it)²) dt over -a < t < a. The integrals of Boussinesq
# and Cerruti (Johnson 1985, sec. 3.2) are then elementary functions of one complex root; they are
# Hamilton's (1983), in a form without 0/0 on the axis.


def hertz_normal(
    x: RealArray, y: RealArray, z: RealArray | float, contact_radius: float, *, shear: float, nu: float
) -> ElasticFields:
    """Displacement (m/Pa) and stress under the pressure sqrt(1 - r²/a²) per unit peak on r < a =
    ``contact_radius``.

    ``x``, ``y``, ``z``: field points in m, broadcast against each other, z >= 0;
    ``contact_radius``: a in m; ``shear``, ``nu``: shear modulus G in Pa and Poisson's ratio, up to
    0.5.
    """
    x, y, z = np.broadcast_arrays(x, y, z)
    f = _Potentials.of(x, y, z, contact_radius)
    k = 1.0 - 2.0 * nu
    along_r = -(k * f.chi_1 + z * f.V_1)
    displacement = Displacement(x * along_r, y * along_r, 2.0 * (1.0 - nu) * f.V - z * f.V_z)
    bend = -(z * f.V_2 + k * f.chi_2)
    common = 2.0 * nu * f.V_z - z * f.V_1 - k * f.chi_1
    stress = StressTensor(
        xx=common + x**2 * bend,
        yy=common + y**2 * bend,
        zz=f.V_z - z * f.V_zz,
        xy=x * y * bend,
        xz=-z * x * f.V_1z,
        yz=-z * y * f.V_1z,
    )
    return ElasticFields(displacement * (0.25 / (np.pi * shear)), stress * (0.5 / np.pi))


def hertz_shear(
    x: RealArray, y: RealArray, z: RealArray | float, contact_radius: float, *, shear: float, nu: float
) -> ElasticFields:
    """Displacement (m/Pa) and stress under the shear traction sqrt(1 - r²/a²) along +x on r < a.

    Parameters and units as for ``hertz_normal``. With friction μ and peak pressure p0 the sliding
    contact has ``hertz_normal(...) * p0 + hertz_shear(...) * (μ * p0)``: the counter-body moves
    toward +x, the trailing edge is at -a.
    """
    x, y, z = np.broadcast_arrays(x, y, z)
    f = _Potentials.of(x, y, z, contact_radius)
    displacement = Displacement(
        2.0 * f.V + 2.0 * nu * (f.Xi_1 + x**2 * f.Xi_2) - z * (f.chi_1 + x**2 * f.chi_2),
        x * y * (2.0 * nu * f.Xi_2 - z * f.chi_2),
        x * ((1.0 - 2.0 * nu) * f.chi_1 - z * f.V_1),
    )
    second = 2.0 * nu * f.Xi_2 - z * f.chi_2
    third = 2.0 * nu * f.Xi_3 - z * f.chi_3
    stress = StressTensor(
        xx=x * (2.0 * (1.0 + nu) * f.V_1 + 3.0 * second + x**2 * third),
        yy=x * (2.0 * nu * f.V_1 + second + y**2 * third),
        zz=-z * x * f.V_1z,
        xy=y * (f.V_1 + second + x**2 * third),
        xz=f.V_z - z * (f.V_1 + x**2 * f.V_2),
        yz=-z * x * y * f.V_2,
    )
    return ElasticFields(displacement * (0.25 / (np.pi * shear)), stress * (0.5 / np.pi))


@dataclass(frozen=True, eq=False)
class _Potentials:
    """V = ∫ p/ρ dA, χ and Ξ with ∂χ/∂z = V, ∂Ξ/∂z = χ; the digit is the number of applications of
    D = (1/r) ∂/∂r."""

    V: RealArray
    V_z: RealArray
    V_zz: RealArray
    V_1: RealArray
    V_1z: RealArray
    V_2: RealArray
    chi_1: RealArray
    chi_2: RealArray
    chi_3: RealArray
    Xi_1: RealArray
    Xi_2: RealArray
    Xi_3: RealArray

    @classmethod
    def of(cls, x: RealArray, y: RealArray, z: RealArray, a: float) -> _Potentials:
        """At the points ``x``, ``y``, ``z`` in m, z >= 0.

        For a kernel f(r, z) of the point source, two integrations by parts leave (2π/a) Im[f⁻³ - i
        a f⁻²] at ζ = z + ia, f⁻ⁿ being the n-th antiderivative by ζ. Those of 1/R, R² = r² + ζ²,
        and what D makes of them, hold R, L = ln(ζ + R) and k = 1/(ζ + R) alone.
        """
        r2 = x**2 + y**2
        zeta: ComplexArray = np.asarray(z + 1j * a)
        R: ComplexArray = np.sqrt(r2 + zeta**2)
        R = np.where(R == 0.0, 1e-150, R)  # the edge: 1/R comes with a factor z = 0
        L: ComplexArray = np.log(zeta + R)
        k: ComplexArray = 1.0 / (zeta + R)
        c: ComplexArray = zeta * k

        def value(third: ComplexArray | RealArray, second: ComplexArray | RealArray) -> RealArray:
            return 2.0 * np.pi / a * (third - 1j * a * second).imag

        h0, h1, h2, h3 = 1.0 / R, L, zeta * L - R, 0.25 * ((2.0 * zeta**2 - r2) * L - 3.0 * zeta * R)
        # D once: g, twice: e, three times: d
        g1, g2, g3 = k / R, -k, -0.5 * (L + c)
        g4 = -0.5 * (zeta * L - 2.0 / 3.0 * R + zeta * c / 3.0)
        g5 = -0.5 * ((0.5 * zeta**2 - 0.125 * r2) * L - 13.0 / 24.0 * zeta * R + zeta**2 * c / 12.0)
        e2, e3, e4, e5 = k**2 / R, -0.5 * k**2, k * (2.0 - c) / 6.0, 0.125 * L + c * (5.0 - c) / 24.0
        d3, d4, d5 = k**3 / R, -(k**3) / 3.0, k**2 * (3.0 - 2.0 * c) / 24.0
        return cls(
            V=value(h3, h2),
            V_z=value(h2, h1),
            V_zz=value(h1, h0),
            V_1=value(g3, g2),
            V_1z=value(g2, g1),
            V_2=value(e3, e2),
            chi_1=value(g4, g3),
            chi_2=value(e4, e3),
            chi_3=value(d4, d3),
            Xi_1=value(g5, g4),
            Xi_2=value(e5, e4),
            Xi_3=value(d5, d4),
        )


# Displacement and stress below a Hertz line contact, pressed and sliding, in plane strain (McEwen
# 1949; Johnson 1985, sec. 4.2c).
#
# With w = x + iz the row of line forces sums to S(w) = ∫ p(s) ds/(w - s) = (π/a)(w - sqrt(w² - a²))
# for p = sqrt(1 - s²/a²); every component is a combination of S, its derivative and its integral.


def hertz_line_normal(
    x: RealArray, z: RealArray | float, half_width: float, *, shear: float, nu: float
) -> ElasticFields:
    """Displacement (m/Pa) and stress under the pressure sqrt(1 - x²/a²) per unit peak on |x| < a =
    ``half_width`` (m).

    ``x``, ``z``: field points in m, broadcast against each other, z >= 0; ``half_width``: a in m;
    ``shear``, ``nu``: Shear modulus G in Pa and Poisson's ratio, up to 0.5. Displacements along the
    force are multiples of ln r far away, as those of a line force at the origin.
    """
    x, z = np.broadcast_arrays(x, z)
    S, slope, T = _sums(x, z, half_width)
    force = 0.5 * np.pi * half_width
    angle = 0.5 * np.pi * force - T.imag  # of the line forces with the z axis
    u = Displacement(-(1.0 - 2.0 * nu) * angle + z * S.real, 0.0 * x, -2.0 * (1.0 - nu) * T.real - z * S.imag)
    stress = _plane_strain(S.imag + z * slope.real, S.imag - z * slope.real, -z * slope.imag, nu)
    return ElasticFields(u * (0.5 / (np.pi * shear)), stress)


def hertz_line_shear(
    x: RealArray, z: RealArray | float, half_width: float, *, shear: float, nu: float
) -> ElasticFields:
    """Displacement (m/Pa) and stress under the shear traction sqrt(1 - x²/a²) along +x on |x| < a.

    Parameters and units as for ``hertz_line_normal``.
    """
    x, z = np.broadcast_arrays(x, z)
    S, slope, T = _sums(x, z, half_width)
    angle = 0.25 * np.pi**2 * half_width - T.imag
    u = Displacement(-2.0 * (1.0 - nu) * T.real + z * S.imag, 0.0 * x, (1.0 - 2.0 * nu) * angle + z * S.real)
    stress = _plane_strain(-2.0 * S.real + z * slope.imag, -z * slope.imag, S.imag + z * slope.real, nu)
    return ElasticFields(u * (0.5 / (np.pi * shear)), stress)


def _sums(x: RealArray, z: RealArray, a: float) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """S, dS/dw and T = ∫ p(s) ln(w - s) ds at w = x + iz."""
    w = x + 1j * z
    root = np.sqrt(w - a) * np.sqrt(w + a)
    safe = np.where(root == 0.0, 1e-150, root)  # the edge: the slope comes with a factor z = 0
    force = 0.5 * math.pi * a
    # w - root loses digits far away, a²/(w + root) does not
    S = math.pi * a / (w + root)
    slope = -S / safe
    T = 0.5 * w * S + force * (np.log(w + root) - math.log(2.0) - 0.5)
    return S, slope, T


def _plane_strain(xx: RealArray, zz: RealArray, xz: RealArray, nu: float) -> StressTensor:
    """Plane strain from π times the components in the plane."""
    xx, zz, xz = xx / np.pi, zz / np.pi, xz / np.pi
    return StressTensor(xx=xx, yy=nu * (xx + zz), zz=zz, xy=0.0 * xx, xz=xz, yz=0.0 * xx)


# Stress below an elliptical Hertz contact, on and off axis (Hertz 1882; Johnson 1985, secs. 3.4,
# 4.2).
#
# The potential of the semi-ellipsoidal pressure and its derivatives are Carlson's symmetric
# integrals. What compressible bodies need besides, the second derivatives of ∫ V dz, is one more
# integral, along z, of elementary functions of these.


_BREAKS = (0.0, 0.002, 0.01, 0.04, 0.15, 0.5, 1.5, 4.0)
"""Ends of the panels along z in minor semi-axes; the last one continues to infinity in 1/z."""

_NODES = 16


def hertz_ellipse_normal(
    x: RealArray, y: RealArray, z: RealArray | float, semi_axes: tuple[float, float], *, nu: float
) -> StressTensor:
    """Stress under the pressure sqrt(1 - x²/a² - y²/b²) per unit peak; error below 1e-11 of it.

    On the very edge of the contact, where stresses have a kink, the error is 5e-4.

    ``x``, ``y``, ``z``: field points in m, broadcast against each other, z >= 0; ``semi_axes``:
    (a, b) along x and y in m, in any order of size, see ``HertzEllipse.semi_axes``; ``nu``:
    Poisson's ratio, up to 0.5.
    """
    x, y, z = (np.asarray(values, dtype=float) for values in np.broadcast_arrays(x, y, z))
    f = _Potential.of(x, y, z, semi_axes)
    k = 1.0 - 2.0 * nu
    chi_xx, chi_yy, chi_xy = _integrals(x, y, z, semi_axes) if k > 0.0 else (0.0 * x, 0.0 * x, 0.0 * x)
    stress = StressTensor(
        xx=2.0 * nu * f.V_z - z * f.V_xx - k * chi_xx,
        yy=2.0 * nu * f.V_z - z * f.V_yy - k * chi_yy,
        zz=f.V_z + z * (f.V_xx + f.V_yy),
        xy=-z * f.V_xy - k * chi_xy,
        xz=-z * f.V_xz,
        yz=-z * f.V_yz,
    )
    return stress * (0.5 / math.pi)


@dataclass(frozen=True, eq=False)
class _Potential:
    """Derivatives of V = ∫ p/ρ dA = (πab/2) ∫ [1 - x²/(a² + s) - y²/(b² + s) - z²/s]/Δ ds over s >
    λ.

    Δ² = (a² + s)(b² + s)s, and λ is the confocal ellipsoid through the point, x²/(a² + λ) +
    y²/(b² + λ) + z²/λ = 1.
    """

    V_z: RealArray
    V_xx: RealArray
    V_yy: RealArray
    V_xy: RealArray
    V_xz: RealArray
    V_yz: RealArray

    @classmethod
    def of(cls, x: RealArray, y: RealArray, z: RealArray, semi_axes: tuple[float, float]) -> _Potential:
        from scipy.special import elliprd

        a, b = semi_axes
        # λ >= 0 in m², the largest root of a cubic, by Newton's method from above, where the cubic
        # is convex
        a2, b2 = a**2, b**2
        s = x**2 + y**2 + z**2
        for _ in range(60):
            value = s * (a2 + s) * (b2 + s) - x**2 * s * (b2 + s) - y**2 * s * (a2 + s) - z**2 * (a2 + s) * (b2 + s)
            slope = (
                (a2 + s) * (b2 + s)
                + s * (a2 + b2 + 2.0 * s)
                - x**2 * (b2 + 2.0 * s)
                - y**2 * (a2 + 2.0 * s)
                - z**2 * (a2 + b2 + 2.0 * s)
            )
            new = np.maximum(s - np.divide(value, slope, out=np.zeros_like(s), where=slope > 0.0), 0.0)
            if np.all(np.abs(new - s) <= 1e-15 * s):
                break
            s = new
        A, B = a2 + s, b2 + s
        root = np.sqrt(A * B)
        # z/√λ, which inside of the contact on the surface is the root of the pressure
        inside = np.sqrt(np.maximum(1.0 - x**2 / A - y**2 / B, 0.0))
        w = np.where(s > 0.0, z / np.sqrt(np.where(s > 0.0, s, 1.0)), inside)
        along_x, along_y = 2.0 / 3.0 * elliprd(B, s, A), 2.0 / 3.0 * elliprd(A, s, B)
        spread = s * ((x / A) ** 2 + (y / B) ** 2) + w**2
        spread = np.where(spread > 0.0, spread, 1.0)  # the edge itself
        bend = 2.0 * np.sqrt(s) / (root * spread)
        tilt = 2.0 * w / (root * spread)
        scale = math.pi * a * b
        return cls(
            V_z=-scale * (2.0 * w / root - z * (along_x + along_y)),
            V_xx=-scale * (along_x - (x / A) ** 2 * bend),
            V_yy=-scale * (along_y - (y / B) ** 2 * bend),
            V_xy=scale * x * y / (A * B) * bend,
            V_xz=scale * x / A * tilt,
            V_yz=scale * y / B * tilt,
        )


def _integrals(
    x: RealArray, y: RealArray, z: RealArray, semi_axes: tuple[float, float]
) -> tuple[RealArray, RealArray, RealArray]:
    """χ_xx, χ_yy, χ_xy with χ_z = V: minus the integrals of V_xx, V_yy, V_xy from z on."""
    unit = min(semi_axes)
    # the fields change at the short half-axis, at the long one, and where the point is
    farthest = 4.0 * max(*semi_axes, *(float(np.abs(place).max()) for place in (x, y, z))) / unit
    further = max(0, math.ceil(math.log(farthest / _BREAKS[-1], 3.0)))
    breaks = np.concatenate([_BREAKS, _BREAKS[-1] * 3.0 ** np.arange(1, further + 1)])
    near, near_weight = gauss(breaks, _NODES)
    # beyond, u = 1/t: the fields are powers of t
    t, t_weight = gauss(np.array([0.0, 0.1, 0.4, 1.0]) / breaks[-1], _NODES)
    depth = unit * np.concatenate([near, 1.0 / t])
    weight = unit * np.concatenate([near_weight, t_weight / t**2])
    f = _Potential.of(x[..., None], y[..., None], z[..., None] + depth, semi_axes)
    chi_xx, chi_yy, chi_xy = (-np.sum(weight * values, axis=-1) for values in (f.V_xx, f.V_yy, f.V_xy))
    return chi_xx, chi_yy, chi_xy


# Theories of the catalogue: stresses below point, line and elliptical contacts.


PoissonsRatio: TypeAlias = Annotated[PoissonOfSolid, Help("Poisson's ratio, 0 to 0.5", of="bodies")]
Friction: TypeAlias = Annotated[
    float, Number(least=0.0), Help("friction coefficient; the counter-body moves toward +x", of="bodies")
]

LOAD = asked("load", "N", "normal force")
SOME_SHEAR = 1.0
"""Shear modulus in Pa of the fields; stresses under a given traction do not depend on it."""


@dataclass(frozen=True)
class HertzStress(Theory):
    """Stresses below a sphere that is pressed, and slides with the traction μp (Hamilton 1983;
    Johnson 1985, secs. 3.4, 7.1).

    On the axis, without friction,

        σ_z = -p_0/(1 + z²/a²),
        σ_r = -p_0 {(1 + ν) [1 - (z/a) arctan(a/z)] - 1/(2 (1 + z²/a²))}.
    """

    E_star: Modulus
    radius: Radius
    nu: PoissonsRatio = 0.3
    friction: Friction = 0.0
    name: ClassVar[str] = "hertz-stress"
    title: ClassVar[str] = "Hertz, stresses below a sphere"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hamilton1983", "Hertz1882", "Johnson1985")
    ways: ClassVar[tuple[Way, ...]] = (Way(DEPTH, "at_depth", STRESS, (LOAD, ALONG_X, ALONG_Y)),)

    def at_depth(self, depth: ArrayLike, load: float, x: float = 0.0, y: float = 0.0) -> StressAnswer:
        """Stress at ``depth`` (n,) in m below the point ``x``, ``y`` in m of the surface under
        ``load`` in N, > 0."""
        contact = HertzPoint(self.E_star, self.radius).at_load(require.positive(load, "load (N)"))
        a, peak = float(contact.radius), float(contact.max_pressure)
        X, Y, Z = places(depth, x, y)
        pressed = hertz_normal(X, Y, Z, a, shear=SOME_SHEAR, nu=self.nu).stress
        dragged = hertz_shear(X, Y, Z, a, shear=SOME_SHEAR, nu=self.nu).stress
        return StressAnswer((pressed + dragged * self.friction) * peak)


@dataclass(frozen=True)
class HertzLineStress(Theory):
    """Stresses below a cylinder in plane strain that is pressed and slides (McEwen 1949; Johnson
    1985, secs. 4.2c, 7.1).

    On the axis, without friction,

        σ_z = -p_0 a/sqrt(a² + z²),  σ_x = -(p_0/a) [(a² + 2 z²)/sqrt(a² + z²) - 2 z].

    Parameters as for ``HertzStress``.
    """

    E_star: Modulus
    radius: Annotated[Length, "relative radius of curvature"]
    nu: Annotated[PoissonOfSolid, Help("Poisson's ratio of the body", of="bodies")] = 0.3
    friction: Friction = 0.0
    name: ClassVar[str] = "hertz-line-stress"
    title: ClassVar[str] = "Hertz, stresses below a cylinder"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hertz1882", "Johnson1985", "McEwen1949")
    ways: ClassVar[tuple[Way, ...]] = (
        Way(DEPTH, "at_depth", STRESS, (asked("load", "N/m", "normal force per length"), ALONG_X)),
    )

    def at_depth(self, depth: ArrayLike, load: float, x: float = 0.0) -> StressAnswer:
        """Stress at ``depth`` (n,) in m below the place ``x`` in m of the surface under ``load`` in
        N/m, > 0."""
        contact = HertzLine(self.E_star, self.radius).at_load(require.positive(load, "load per length (N/m)"))
        (X, Z), a = places(depth, x), float(contact.radius)
        pressed = hertz_line_normal(X, Z, a, shear=SOME_SHEAR, nu=self.nu).stress
        dragged = hertz_line_shear(X, Z, a, shear=SOME_SHEAR, nu=self.nu).stress
        return StressAnswer((pressed + dragged * self.friction) * float(contact.max_pressure))


@dataclass(frozen=True)
class HertzEllipseStress(Theory):
    """Stresses below an elliptical contact (Johnson 1985, sec. 3.5).

    On the axis,

        σ_z = -p_0 a b/sqrt((a² + z²) (b² + z²)).
    """

    E_star: Modulus
    radius_x: RadiusX
    radius_y: RadiusY
    nu: PoissonsRatio = 0.3
    name: ClassVar[str] = "hertz-ellipse-stress"
    title: ClassVar[str] = "Hertz, stresses below an ellipse"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hertz1882", "Johnson1985")
    ways: ClassVar[tuple[Way, ...]] = (Way(DEPTH, "at_depth", STRESS, (LOAD, ALONG_X, ALONG_Y)),)

    def at_depth(self, depth: ArrayLike, load: float, x: float = 0.0, y: float = 0.0) -> StressAnswer:
        """Stress at ``depth`` (n,) in m below the point ``x``, ``y`` in m of the surface under
        ``load`` in N, > 0."""
        contact = HertzEllipse(self.E_star, self.radius_x, self.radius_y)
        first, second = (float(np.squeeze(axis)) for axis in contact.semi_axes(require.positive(load, "load (N)")))
        peak = float(contact.at_load(load).max_pressure)
        X, Y, Z = places(depth, x, y)
        found = hertz_ellipse_normal(X, Y, Z, (first, second), nu=self.nu)
        return StressAnswer(found * peak)
