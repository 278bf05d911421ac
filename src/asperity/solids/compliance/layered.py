"""Normal compliance of a body of any number of layers on a half-space or a rigid base."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import ComplexArray, RealArray
from ...core.grid import Grid
from ...core.interpolation import covering_grid, log_table
from ..elastic import Elastic
from ..layers import Bonded, Frictionless, Interface, Layered
from ..viscoelastic import Viscoelastic
from .influence import (
    Limits,
    LineKernel,
    PointKernel,
    line_kernel,
    patch_coefficients,
    point_kernel,
    strip_coefficients,
    wavenumber_grid,
    wavenumbers,
)

# Compliance of a stack of layers in the wavenumber domain by hybrid layer matrices (after Tan 2006,
# for waves).
#
# Each wavevector splits the problem into an in-plane part with the real amplitudes (U, W), u_L = i
# U, u_z = W, sigma_Lz = -i tau_L, sigma_zz = -tau_z, and an antiplane part u_T, sigma_Tz = -tau_T,
# where L points along the wavevector, T across it and z into the body. Everything here is a
# function of arrays of wavenumbers alpha > 0 that broadcast.
#
# A layer is described by "traction given on top, displacement given at the bottom",
#
# v_top = A tau_top + B v_bot,        tau_bot = B^T tau_top - D v_bot,
#
# which stays regular for thin and for thick layers, where transfer and stiffness matrices fail.
# Compliances of layers and of what lies below combine by sums of positive quantities only, so their
# relative accuracy is that of the arithmetic. Products of two compliances are formed times (G
# alpha)², so G alpha may lie anywhere in 1e-280 … 1e280. One case loses digits: an exactly
# incompressible layer that can slip, whose squeezing and stretching are the same motion, is
# accurate to 1e-16/(alpha h)² only.


Amplitude = RealArray | ComplexArray

Modulus: TypeAlias = float | Any
"""Modulus or Poisson's ratio: a number, or complex numbers of a viscoelastic solid."""

_VANISHED = 400.0  # alpha h from which exp(-2 alpha h) is below the smallest double: the layer is a half-space
_SERIES = 0.5  # alpha h below which sinh cosh - x is summed as a series


@dataclass(frozen=True, eq=False)
class PlaneVector:
    """Amplitudes of a traction (tau_L, tau_z, tau_T) in Pa or of a displacement (U, W, u_T) in
    m."""

    L: Amplitude
    z: Amplitude
    T: Amplitude


@dataclass(frozen=True, eq=False)
class PlaneCompliance:
    """Symmetric compliance in m/Pa of everything below a plane: v = C tau in the plane, u_T = C_T
    tau_T across it."""

    LL: RealArray
    zz: RealArray
    Lz: RealArray
    T: RealArray

    def displacement(self, traction: PlaneVector) -> PlaneVector:
        """Displacement of the plane under ``traction``."""
        return PlaneVector(
            self.LL * traction.L + self.Lz * traction.z,
            self.Lz * traction.L + self.zz * traction.z,
            self.T * traction.T,
        )

    def scaled(self, factor: ArrayLike) -> PlaneCompliance:
        """Compliance times ``factor``."""
        f = np.asarray(factor)
        return PlaneCompliance(self.LL * f, self.zz * f, self.Lz * f, self.T * f)


@dataclass(frozen=True, eq=False)
class LayerMatrices:
    """Hybrid matrices of one layer, dimensionless: A times G alpha, B, and D over G alpha.

    ``g_alpha`` is G alpha in Pa/m. A and D are symmetric, ``B_Lz`` and ``B_zL`` differ.
    """

    g_alpha: RealArray
    A_LL: RealArray
    A_zz: RealArray
    A_Lz: RealArray
    A_T: RealArray
    B_LL: RealArray
    B_zz: RealArray
    B_Lz: RealArray
    B_zL: RealArray
    B_T: RealArray
    D_LL: RealArray
    D_zz: RealArray
    D_Lz: RealArray
    D_T: RealArray


def layer_matrices(alpha: ArrayLike, thickness: ArrayLike, *, shear_modulus: Modulus, nu: Modulus) -> LayerMatrices:
    """Hybrid matrices of an isotropic layer, evaluated times exp(-2 alpha h) so that nothing
    overflows or cancels.

    ``alpha``: wavenumbers in rad/m, > 0; ``thickness``: h in m, >= 0, infinite allowed; broadcast
    against ``alpha``; ``shear_modulus``, ``nu``: G in Pa, > 0, and Poisson's ratio, -1 < nu <= 0.5;
    complex ones, numbers or arrays like ``alpha``, give the matrices of a viscoelastic layer.
    """
    alpha = np.asarray(alpha, dtype=float)
    x = np.minimum(alpha * thickness, _VANISHED)
    n, k, kappa = 2.0 * (1.0 - nu), 1.0 - 2.0 * nu, 3.0 - 4.0 * nu
    e, m = np.exp(-x), np.expm1(-2.0 * x)
    E2 = e * e
    S2 = 0.25 * m * m  # sinh²
    SH = -0.25 * m * (m + 2.0)  # sinh cosh
    x1, x2 = x * E2, x * x * E2
    H, S = 0.5 * (1.0 + E2) * e, -0.5 * m * e
    # (sinh x cosh x - x) exp(-2x), for small x by the series of (sinh 2x - 2x)/2
    y = 4.0 * np.minimum(x, _SERIES) ** 2
    series: RealArray = np.ones_like(y)
    for power in range(19, 3, -2):
        series = 1.0 + y / (power * (power - 1.0)) * series
    difference = np.where(x > _SERIES, SH - x1, E2 * x * y * series / 6.0)
    # (sinh x - x cosh x) exp(-2x), for small x by the series -(x³/3 + x⁵/30 + …)
    y = np.minimum(x, _SERIES) ** 2
    series = np.polynomial.polynomial.polyval(y, [2.0 * j / math.factorial(2 * j + 1) for j in range(1, 9)])
    flexure = np.where(x > _SERIES, S - x * H, -E2 * x * y * series)
    scale = 1.0 / (kappa * S2 + x2 + n * n * E2)
    a, b, d = 0.5 * n * scale, n * scale, 2.0 * n * scale
    tanh = -m / (1.0 + E2)
    return LayerMatrices(
        g_alpha=shear_modulus * alpha,
        A_LL=a * (kappa * SH + x1),
        A_zz=a * (2.0 * k * SH + difference),
        A_Lz=0.5 * scale * (k * kappa * S2 - x2),
        A_T=tanh,
        B_LL=b * (n * H - x * S),
        B_zz=b * (n * H + x * S),
        B_Lz=b * (k * S + x * H),
        B_zL=b * (flexure - 2.0 * nu * S),  # k S - x H, which for nu = 0 is of third order in x
        B_T=2.0 * e / (1.0 + E2),
        D_LL=d * (SH + x1),
        D_zz=d * difference,
        D_Lz=2.0 * scale * (k * S2 + x2),
        D_T=tanh,
    )


def half_space(alpha: ArrayLike, *, shear_modulus: Modulus, nu: Modulus) -> PlaneCompliance:
    """Homogeneous half-space: C_LL = C_zz = (1 - nu)/(G alpha), C_Lz = (1 - 2nu)/(2G alpha), C_T =
    1/(G alpha)."""
    T = 1.0 / (shear_modulus * np.asarray(alpha, dtype=float))
    normal = (1.0 - nu) * T
    return PlaneCompliance(LL=normal, zz=normal, Lz=(0.5 - nu) * T, T=T)


def rigid(alpha: ArrayLike) -> PlaneCompliance:
    """Undeformable base: zero at every wavenumber."""
    zero = np.zeros(np.shape(alpha))
    return PlaneCompliance(zero, zero, zero, zero)


def raised(below: PlaneCompliance, layer: LayerMatrices, interface: Interface = Bonded()) -> PlaneCompliance:
    """Compliance of the top of ``layer`` on what has the compliance ``below``: C = A + B X B^T.

    X relates the displacement of the layer's lower face to the traction B^T tau; bonded, X =
    (C^-1 + D)^-1, with no inverse of C needed; frictionless, X = (D + diag(0, 1/C_zz))^-1, which is
    infinite in a layer of zero thickness.
    """
    m, c = layer, below.scaled(layer.g_alpha)
    X_LL, X_zz, X_Lz, X_T = _lower_face_compliance(c, m, interface)
    P_LL, P_Lz = m.B_LL * X_LL + m.B_Lz * X_Lz, m.B_LL * X_Lz + m.B_Lz * X_zz  # rows of B X
    P_zL, P_zz = m.B_zL * X_LL + m.B_zz * X_Lz, m.B_zL * X_Lz + m.B_zz * X_zz
    return PlaneCompliance(
        LL=m.A_LL + P_LL * m.B_LL + P_Lz * m.B_Lz,
        zz=m.A_zz + P_zL * m.B_zL + P_zz * m.B_zz,
        Lz=m.A_Lz + P_LL * m.B_zL + P_Lz * m.B_zz,
        T=m.A_T + m.B_T**2 * X_T,
    ).scaled(1.0 / m.g_alpha)


def lowered(
    traction: PlaneVector, below: PlaneCompliance, layer: LayerMatrices, interface: Interface = Bonded()
) -> PlaneVector:
    """Traction under ``layer`` from the ``traction`` on its top, what lies below having the
    compliance ``below``.

    Bonded, tau_bot = (I + D C)^-1 B^T tau_top and tau_T,bot = B_T tau_T / (1 + D_T C_T);
    frictionless, tau_bot = (0, W_bot / C_zz). The displacement of what lies below is
    ``below.displacement`` of the result.
    """
    m, c = layer, below.scaled(layer.g_alpha)
    t_L, t_z = m.B_LL * traction.L + m.B_zL * traction.z, m.B_Lz * traction.L + m.B_zz * traction.z
    if isinstance(interface, Frictionless):
        pressure = (m.D_LL * t_z - m.D_Lz * t_L) / (c.zz * _det_D(m) + m.D_LL)
        return PlaneVector(np.zeros_like(pressure), pressure, np.zeros_like(m.B_T * traction.T))
    F_LL, F_Lz = 1.0 + m.D_LL * c.LL + m.D_Lz * c.Lz, m.D_LL * c.Lz + m.D_Lz * c.zz
    F_zL, F_zz = m.D_Lz * c.LL + m.D_zz * c.Lz, 1.0 + m.D_Lz * c.Lz + m.D_zz * c.zz
    scale = 1.0 / _det_one_plus_CD(c, m)
    return PlaneVector(
        (F_zz * t_L - F_Lz * t_z) * scale,
        (F_LL * t_z - F_zL * t_L) * scale,
        m.B_T / (1.0 + m.D_T * c.T) * traction.T,
    )


def lower_face(
    traction: PlaneVector, below: PlaneCompliance, layer: LayerMatrices, interface: Interface = Bonded()
) -> PlaneVector:
    """Displacement X B^T tau of the lower face of ``layer``; over a frictionless interface it slips
    on what is below."""
    m = layer
    X_LL, X_zz, X_Lz, X_T = _lower_face_compliance(below.scaled(m.g_alpha), m, interface)
    t_L, t_z = m.B_LL * traction.L + m.B_zL * traction.z, m.B_Lz * traction.L + m.B_zz * traction.z
    scale = 1.0 / m.g_alpha
    return PlaneVector(
        (X_LL * t_L + X_Lz * t_z) * scale, (X_Lz * t_L + X_zz * t_z) * scale, X_T * m.B_T * traction.T * scale
    )


def interface_compliances(
    stack: Layered, alpha: ArrayLike, matrices: Sequence[LayerMatrices] | None = None
) -> tuple[PlaneCompliance, ...]:
    """Compliance at the top of every layer of ``stack`` and of its base, index 0 the surface, N the
    top of the base.

    ``stack``: layers and base; layers of zero thickness pass on the compliance below them
    unchanged; ``alpha``: Wavenumbers in rad/m, > 0; ``matrices``: those of all layers, where they
    are known.
    """
    return _compliances(stack, alpha, lambda solid: (solid.shear_modulus, solid.poisson_ratio), matrices)


def operational_plane(stack: Layered, alpha: ArrayLike, s: ArrayLike) -> PlaneCompliance:
    """Compliance (m/Pa, complex) of the surface of a viscoelastic ``stack`` in operational form:
    its moduli replaced by those at complex ``s`` (1/s).

    ``alpha``: wavenumbers in rad/m, > 0; ``s``: broadcast against them; at s = i omega the response
    to tractions that vary as exp(i omega t). Elastic materials do not change with ``s``.
    """
    return _compliances(stack, alpha, lambda solid: operational_moduli(solid, s))[0]


def operational_moduli(solid: Elastic, s: ArrayLike) -> tuple[Modulus, Modulus]:
    """Shear modulus (Pa) and Poisson's ratio of ``solid`` in operational form at complex ``s``
    (1/s)."""
    return solid.operational(s) if isinstance(solid, Viscoelastic) else (solid.shear_modulus, solid.poisson_ratio)


def _compliances(
    stack: Layered,
    alpha: ArrayLike,
    moduli: Callable[[Elastic], tuple[Modulus, Modulus]],
    matrices: Sequence[LayerMatrices] | None = None,
) -> tuple[PlaneCompliance, ...]:
    """Compliance at the top of every layer and of the base, with the ``moduli`` G and nu of each
    material."""
    if isinstance(stack.base, Elastic):
        G, nu = moduli(stack.base)
        compliance = half_space(alpha, shear_modulus=G, nu=nu)
    else:
        compliance = rigid(alpha)
    found = [compliance]
    known: Sequence[LayerMatrices | None] = matrices or [None] * len(stack.layers)
    for layer, own in zip(reversed(stack.layers), reversed(known), strict=True):
        if layer.thickness > 0.0:
            if own is None:
                G, nu = moduli(layer.material)
                own = layer_matrices(alpha, layer.thickness, shear_modulus=G, nu=nu)
            compliance = raised(compliance, own, layer.interface)
        found.append(compliance)
    return tuple(reversed(found))


def _lower_face_compliance(
    c: PlaneCompliance, m: LayerMatrices, interface: Interface
) -> tuple[RealArray, RealArray, RealArray, RealArray]:
    """LL, zz, Lz of X and X_T, all times G alpha, as is ``c``."""
    det_C, det_D = c.LL * c.zz - c.Lz**2, _det_D(m)
    if isinstance(interface, Frictionless):
        free = 1.0 / (c.zz * det_D + m.D_LL)
        return (1.0 + c.zz * m.D_zz) * free, c.zz * m.D_LL * free, -c.zz * m.D_Lz * free, 1.0 / m.D_T
    scale = 1.0 / _det_one_plus_CD(c, m)
    return (
        (c.LL + det_C * m.D_zz) * scale,
        (c.zz + det_C * m.D_LL) * scale,
        (c.Lz - det_C * m.D_Lz) * scale,
        c.T / (1.0 + m.D_T * c.T),
    )


def _det_D(m: LayerMatrices) -> RealArray:
    return m.D_LL * m.D_zz - m.D_Lz**2


def _det_one_plus_CD(c: PlaneCompliance, m: LayerMatrices) -> RealArray:
    """1 + tr(C D) + det C det D."""
    det_C = c.LL * c.zz - c.Lz**2
    return 1.0 + c.LL * m.D_LL + c.zz * m.D_zz + 2.0 * c.Lz * m.D_Lz + det_C * _det_D(m)


# Compliance of a body on a logarithmic grid of wavenumbers, with its limits: all that responses in
# real space need.


Component = Callable[[PlaneCompliance], RealArray]
"""Picks or combines components of a compliance."""


@dataclass(frozen=True, eq=False)
class Samples:
    """``values`` of alpha C (1/Pa) on ``wavenumber_grid(depth)`` and its limits at short (``high``)
    and long wavelengths."""

    depth: float
    values: PlaneCompliance
    high: PlaneCompliance
    low: PlaneCompliance

    def limits(self, component: Component) -> Limits:
        """Limits of one ``component``."""
        return Limits(float(component(self.high)), float(component(self.low)), self.depth)

    def kernel(self, component: Component, order: int = 0) -> PointKernel:
        """Response to a point force of one ``component`` with the angular ``order``."""
        return point_kernel(component(self.values), self.limits(component), order)


def samples(body: Elastic | Layered, depth: float) -> Samples:
    """Samples of ``body`` around the wavenumber 1/``depth`` (m), which for layers should be about
    their thickness."""
    stack = body.reduced if isinstance(body, Layered) else Layered((), body)
    alpha = wavenumber_grid(depth)
    values = interface_compliances(stack, alpha)[0].scaled(alpha)
    base = low = _strength(stack.base) if isinstance(stack.base, Elastic) else rigid(np.ones(()))
    if stack.slips:
        # the layers above carry a shear traction as a sheet does, and their Poisson contraction
        # moves the surface: for one layer C_Lz alpha tends to -nu/2G; displacements along the
        # surface grow without limit
        low = PlaneCompliance(np.array(np.inf), base.zz, values.Lz[0], np.array(np.inf))
    return Samples(depth, values, _strength(stack.layers[0].material) if stack.layers else base, low)


def _strength(material: Elastic) -> PlaneCompliance:
    """alpha C of a half-space, which is the same at every wavenumber."""
    return half_space(np.ones(()), shear_modulus=material.shear_modulus, nu=material.poisson_ratio)


@dataclass(frozen=True)
class LayerStack:
    """Compliance of ``body``, which has at least one layer of finite thickness; names and strengths
    are left out of it.

    The spectrum of a large map is interpolated between a few hundred wavenumbers, equal steps in
    their logarithm apart, with a relative error below 1e-13: a map of 1024² points costs about two
    Fourier transforms, whatever the number of layers. Influence coefficients come from the same
    spectrum, with a relative error below 1e-8.
    """

    body: Layered
    citation_keys: ClassVar[tuple[str, ...]] = ("Burmister1945", "OSullivan1988", "Tan2006", "Hamilton2000")
    """Layered elasticity, the mixed layer matrices, the logarithmic Hankel transform."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "body", self.body.bare)

    def spectral(self, wavenumber: ArrayLike) -> RealArray:
        """C_zz(q) in m/Pa at ``wavenumber`` q > 0 (rad/m)."""
        return self._interpolated(wavenumber, lambda c: (c.zz,))[0]

    def plane(self, wavenumber: ArrayLike) -> PlaneCompliance:
        """All components of C(q) in m/Pa at ``wavenumber`` q > 0 (rad/m)."""
        return PlaneCompliance(*self._interpolated(wavenumber, lambda c: (c.LL, c.zz, c.Lz, c.T)))

    def mean_mode(self) -> float:
        """Compression of the layers per pressure in m/Pa on a rigid base; 0 on a half-space, whose
        datum is the mean.

        Without lateral strain each layer gives h/M, M = 2G (1 - nu)/(1 - 2nu).
        """
        if isinstance(self.body.base, Elastic):
            return 0.0
        return sum(
            layer.thickness * (1.0 - 2.0 * nu) / (2.0 * layer.material.shear_modulus * (1.0 - nu))
            for layer in self.body.layers
            for nu in (layer.material.poisson_ratio,)
        )

    def influence(self, grid: Grid) -> RealArray:
        """Coefficients in m/Pa, shape (nx, ny), for constant pressure on each pixel."""
        return patch_coefficients(self._point, grid)

    def line_influence(self, grid: Grid, datum: float) -> RealArray:
        """Coefficients in m/Pa, shape (nx, 1), for constant pressure on strips of width dx (plane
        strain)."""
        return strip_coefficients(self._line, grid, datum)

    @cached_property
    def _samples(self) -> Samples:
        return samples(self.body, self.body.thickness)

    @cached_property
    def _point(self) -> PointKernel:
        return self._samples.kernel(lambda c: c.zz)

    @cached_property
    def _line(self) -> LineKernel:
        return line_kernel(self._samples.values.zz, self._samples.limits(lambda c: c.zz))

    def _interpolated(
        self, wavenumber: ArrayLike, components: Callable[[PlaneCompliance], tuple[RealArray, ...]]
    ) -> list[RealArray]:
        """Some ``components`` of C(q), from a table of q C where the array is larger than the
        table."""
        q = wavenumbers(wavenumber)
        nodes = covering_grid(float(q.min()), float(q.max())) if q.size > 1 else q
        if q.size <= nodes.size:
            return list(components(interface_compliances(self.body, q)[0]))
        tables = [log_table(nodes[0], c) for c in components(interface_compliances(self.body, nodes)[0].scaled(nodes))]
        found = [table(q) for table in tables]
        for values in found:
            values /= q
        return found
