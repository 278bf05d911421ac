"""Derivatives of the normal compliance of a body with respect to its moduli, Poisson ratios and
thicknesses."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.grid import Grid
from ...core.interpolation import LogTable, covering_grid, log_table
from ..elastic import Elastic
from ..layers import Layer, Layered
from .halfspace import Compliance, HalfSpace
from .influence import (
    Limits,
    PointKernel,
    line_kernel,
    patch_coefficients,
    point_kernel,
    strip_coefficients,
    wavenumber_grid,
    wavenumbers,
)
from .layered import (
    Modulus,
    PlaneCompliance,
    PlaneVector,
    half_space,
    interface_compliances,
    layer_matrices,
    lowered,
    raised,
)

# What lies below a plane k answers the tractions tau_k there, under unit pressure on the surface,
# with its compliance C_k. By reciprocity a change of one layer changes the compliance of the
# surface by
#
# dc = tau_k . dC_k tau_k,
#
# with dC_k that of the top of this layer while nothing changes below it. So one sweep down gives
# the derivatives of all layers. Those of C_k follow from a complex step (Squire & Trapp 1998):
# every entry is analytic in modulus, Poisson's ratio and thickness, and nothing is subtracted.

_STEP = 1e-30
"""Imaginary step, relative to a modulus or a thickness: its square is lost in rounding."""

Kind: TypeAlias = Literal["youngs_modulus", "poisson_ratio", "thickness"]
"""A constant of a layer or base."""

UNITS: dict[Kind, str] = {"youngs_modulus": "Pa", "poisson_ratio": "1", "thickness": "m"}


class Constant(NamedTuple):
    """One constant of a body that takes part: its ``kind``, its ``value`` (SI), and the number of
    its layer in the reduced body from the surface down, that of the layers for the base."""

    kind: Kind
    layer: int
    value: float


def constants(stack: Layered) -> tuple[Constant, ...]:
    """Constants of the layers of a reduced ``stack`` from the surface down, then those of its base
    if that is elastic."""
    found: list[Constant] = []
    for k, layer in enumerate(stack.layers):
        found += [
            Constant("youngs_modulus", k, layer.material.youngs_modulus),
            Constant("poisson_ratio", k, layer.material.poisson_ratio),
            Constant("thickness", k, layer.thickness),
        ]
    if isinstance(stack.base, Elastic):
        last = len(stack.layers)
        found += [
            Constant("youngs_modulus", last, stack.base.youngs_modulus),
            Constant("poisson_ratio", last, stack.base.poisson_ratio),
        ]
    return tuple(found)


class _Stepped(NamedTuple):
    """Shear modulus, Poisson's ratio and thickness, one of them with an imaginary ``step``."""

    G: Modulus
    nu: Modulus
    thickness: Modulus
    step: float


def _stepped(material: Elastic, thickness: float | None = None) -> Iterator[_Stepped]:
    """Step in E, in nu, and where there is one in the ``thickness``."""
    E, nu = material.youngs_modulus, material.poisson_ratio
    yield _Stepped(0.5 * complex(E, _STEP * E) / (1.0 + nu), nu, thickness, _STEP * E)
    complex_nu = complex(nu, _STEP)
    yield _Stepped(0.5 * E / (1.0 + complex_nu), complex_nu, thickness, _STEP)
    if thickness is not None:
        yield _Stepped(material.shear_modulus, nu, complex(thickness, _STEP * thickness), _STEP * thickness)


def normal_rates(stack: Layered, alpha: ArrayLike) -> RealArray:
    """Derivatives of C_zz(alpha) of the surface, m/Pa per unit of each of the ``constants``: an
    array (constants, *shape of alpha).

    ``stack``: a reduced body; ``alpha``: wavenumbers in rad/m, > 0. All of them take about as long
    as the compliance four times.
    """
    alpha = np.asarray(alpha, dtype=float)
    matrices = [
        layer_matrices(
            alpha, layer.thickness, shear_modulus=layer.material.shear_modulus, nu=layer.material.poisson_ratio
        )
        for layer in stack.layers
    ]
    below = interface_compliances(stack, alpha, matrices)
    traction, rates = PlaneVector(np.zeros_like(alpha), np.ones_like(alpha), np.zeros_like(alpha)), []
    for layer, own, under in zip(stack.layers, matrices, below[1:], strict=True):
        for G, nu, thickness, step in _stepped(layer.material, layer.thickness):
            if nu == layer.material.poisson_ratio and thickness == layer.thickness:  # the modulus is but their unit
                moved = replace(own, g_alpha=G * alpha)
            else:
                moved = layer_matrices(alpha, thickness, shear_modulus=G, nu=nu)
            rates.append(_answer(raised(under, moved, layer.interface), traction, step))
        traction = lowered(traction, under, own, layer.interface)
    if isinstance(stack.base, Elastic):
        for G, nu, _, step in _stepped(stack.base):
            rates.append(_answer(half_space(alpha, shear_modulus=G, nu=nu), traction, step))
    return np.array(rates)


def _answer(below: PlaneCompliance, traction: PlaneVector, step: float) -> RealArray:
    """tau . dC tau of a compliance that was found with an imaginary ``step``."""
    L, z = traction.L, traction.z
    LL, zz, Lz = (np.imag(component) / step for component in (below.LL, below.zz, below.Lz))
    return np.asarray(LL * L * L + 2.0 * Lz * L * z + zz * z * z)


def _strength_rate(material: Elastic, kind: Kind) -> float:
    """Derivative of alpha c = 2 (1 - nu²)/E of a half-space."""
    E, nu = material.youngs_modulus, material.poisson_ratio
    if kind == "youngs_modulus":
        return -2.0 * (1.0 - nu * nu) / E**2
    return -4.0 * nu / E if kind == "poisson_ratio" else 0.0


def _compression_rate(layer: Layer, kind: Kind) -> float:
    """Derivative of h/M, M = E (1 - nu)/[(1 + nu)(1 - 2 nu)]: the compression per pressure without
    lateral strain."""
    E, nu, h = layer.material.youngs_modulus, layer.material.poisson_ratio, layer.thickness
    per_modulus = (1.0 + nu) * (1.0 - 2.0 * nu) / (1.0 - nu)
    if kind == "thickness":
        return per_modulus / E
    if kind == "youngs_modulus":
        return -h * per_modulus / E**2
    return h / E * (-2.0 * nu * (2.0 - nu)) / (1.0 - nu) ** 2


class StackRates:
    """Derivatives of the compliance of a reduced ``stack`` of one layer and more."""

    def __init__(self, stack: Layered) -> None:
        self.stack = stack
        self.constants = constants(stack)
        self._known: tuple[tuple[float, float], list[LogTable]] | None = None

    def tables(self, low: float, high: float) -> list[LogTable]:
        """q dc/d(constant) from the wavenumber ``low`` to ``high``; the last ones are kept."""
        if self._known is None or self._known[0] != (low, high):
            nodes = covering_grid(low, high)
            self._known = (low, high), [log_table(nodes[0], rate * nodes) for rate in normal_rates(self.stack, nodes)]
        return self._known[1]

    @cached_property
    def samples(self) -> RealArray:
        """q dc/d(constant) on the ``wavenumber_grid`` about the thickness of the stack."""
        alpha = wavenumber_grid(self.stack.thickness)
        return np.asarray(normal_rates(self.stack, alpha) * alpha)

    def limits(self, number: int) -> Limits:
        """Limits of the same for the constant of this ``number``."""
        stack, (kind, layer, _) = self.stack, self.constants[number]
        top, base = stack.layers[0].material, stack.base
        high = _strength_rate(top, kind) if layer == 0 else 0.0
        of_base = layer == len(stack.layers) and isinstance(base, Elastic)
        return Limits(high, _strength_rate(base, kind) if of_base else 0.0, stack.thickness)  # type: ignore[arg-type]


@dataclass(frozen=True, eq=False)
class ComplianceRate:
    """Derivative of the compliance of a layered body with respect to one constant, of this
    ``number``, as a compliance per unit of the constant."""

    rates: StackRates
    number: int
    citation_keys: ClassVar[tuple[str, ...]] = ()

    def spectral(self, wavenumber: ArrayLike) -> RealArray:
        """dc(q) at ``wavenumber`` q > 0 (rad/m); between wavenumbers of a large array interpolated
        in a table of its own, with a relative error below 1e-12 of the largest."""
        q = wavenumbers(wavenumber)
        if q.size < 2 or q.size <= covering_grid(float(q.min()), float(q.max())).size:
            return np.asarray(normal_rates(self.rates.stack, q)[self.number])
        return np.asarray(self.rates.tables(float(q.min()), float(q.max()))[self.number](q) / q)

    def mean_mode(self) -> float:
        """dc(0); 0 on a half-space, whose datum is the mean displacement."""
        stack, (kind, layer, _) = self.rates.stack, self.rates.constants[self.number]
        return 0.0 if isinstance(stack.base, Elastic) else _compression_rate(stack.layers[layer], kind)

    def influence(self, grid: Grid) -> RealArray:
        """Derivative of the displacement at pixel offsets (0…nx-1, 0…ny-1) from a pixel under unit
        pressure, (nx, ny)."""
        return patch_coefficients(self.point(), grid)

    def point(self) -> PointKernel:
        """Derivative of the displacement at a distance from a point force."""
        return point_kernel(self.rates.samples[self.number], self.rates.limits(self.number))

    def line_influence(self, grid: Grid, datum: float) -> RealArray:
        """The same for strips in plane strain, (nx, 1), relative to that at the ``datum`` (m)."""
        kernel = line_kernel(self.rates.samples[self.number], self.rates.limits(self.number))
        if isinstance(self.rates.stack.base, Elastic):
            kernel = replace(kernel, infinity=math.inf)  # the datum is that of the compliance
        return strip_coefficients(kernel, grid, datum)


class Rate(NamedTuple):
    """Derivative of a compliance with respect to a ``constant``: ``factor`` times the
    ``compliance``."""

    constant: Constant
    compliance: Compliance
    factor: float


def compliance_rates(body: Elastic | Layered) -> tuple[Rate, ...]:
    """Derivatives of the normal compliance of ``body`` for all constants that take part (see
    ``constants`` of the reduced body); those of a homogeneous one share one compliance."""
    stack = body.reduced if isinstance(body, Layered) else Layered((), body)
    if not stack.layers:
        unit = HalfSpace(1.0)
        return tuple(
            Rate(each, unit, 0.5 * _strength_rate(stack.base, each.kind))
            for each in constants(stack)
            if isinstance(stack.base, Elastic)
        )
    rates = StackRates(stack)
    return tuple(Rate(each, ComplianceRate(rates, number), 1.0) for number, each in enumerate(rates.constants))
