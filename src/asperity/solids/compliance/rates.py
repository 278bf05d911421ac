"""Derivatives of the normal compliance of a body with respect to its moduli, Poisson ratios and
thicknesses."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, ClassVar, Literal, NamedTuple, TypeAlias, TypeVar

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
    LayerMatrices,
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


def normal_rates(stack: Layered, alpha: ArrayLike) -> RealArray:
    """Derivatives of C_zz(alpha) of the surface, m/Pa per unit of each of the ``constants``: an
    array (constants, *shape of alpha).

    ``stack``: a reduced body; ``alpha``: wavenumbers in rad/m, > 0. All layers are computed at
    once: of many the time goes into the overhead of arrays.
    """
    alpha, layers = np.asarray(alpha, dtype=float), stack.layers
    own = layer_matrices(
        alpha,
        _column([layer.thickness for layer in layers], alpha),
        shear_modulus=_column([layer.material.shear_modulus for layer in layers], alpha),
        nu=_column([layer.material.poisson_ratio for layer in layers], alpha),
    )
    by_layer = [_some(own, k) for k in range(len(layers))]
    below = interface_compliances(stack, alpha, by_layer)
    # on the top of each layer and of the base, under unit pressure on the surface
    tractions = [PlaneVector(np.zeros_like(alpha), np.ones_like(alpha), np.zeros_like(alpha))]
    for layer, matrices, under in zip(layers, by_layer, below[1:], strict=True):
        tractions.append(lowered(tractions[-1], under, matrices, layer.interface))
    rates = [_rates_of_layers(stack, alpha, own, _together(below[1:]), _together(tractions[:-1]))]
    if isinstance(stack.base, Elastic):
        E, nu = stack.base.youngs_modulus, stack.base.poisson_ratio
        steps = ((complex(E, _STEP * E), nu, _STEP * E), (E, complex(nu, _STEP), _STEP))
        for modulus, ratio, step in steps:
            of_base = half_space(alpha, shear_modulus=0.5 * modulus / (1.0 + ratio), nu=ratio)
            rates.append(_answer(of_base, tractions[-1], step)[None])
    return np.concatenate(rates)


def _column(values: Sequence[Modulus], alpha: RealArray) -> Any:
    """One value for each layer, broadcast against ``alpha``."""
    return np.array(values)[(...,) + (None,) * alpha.ndim]


_Fields = TypeVar("_Fields", LayerMatrices, PlaneCompliance, PlaneVector)


def _some(whole: _Fields, which: Any) -> _Fields:
    """Those layers only of matrices, compliances or tractions of all."""
    return type(whole)(*(getattr(whole, each.name)[which] for each in fields(whole)))


def _rates_of_layers(
    stack: Layered, alpha: RealArray, own: LayerMatrices, under: PlaneCompliance, carried: PlaneVector
) -> RealArray:
    """Derivatives to modulus, Poisson's ratio and thickness of each layer, (3 · layers, *shape of
    alpha), from its ``own`` matrices, the compliance ``under`` it and the traction that is
    ``carried`` by its top."""
    layers = stack.layers
    E = _column([layer.material.youngs_modulus for layer in layers], alpha)
    nu = _column([layer.material.poisson_ratio for layer in layers], alpha)
    h = _column([layer.thickness for layer in layers], alpha)
    stepped_E, stepped_nu, stepped_h = E * complex(1.0, _STEP), nu + complex(0.0, _STEP), h * complex(1.0, _STEP)
    moved = (
        (replace(own, g_alpha=0.5 * stepped_E / (1.0 + nu) * alpha), _STEP * E),  # the modulus is but their unit
        (layer_matrices(alpha, h, shear_modulus=0.5 * E / (1.0 + stepped_nu), nu=stepped_nu), _STEP),
        (layer_matrices(alpha, stepped_h, shear_modulus=0.5 * E / (1.0 + nu), nu=nu), _STEP * h),
    )
    rates = np.empty((len(layers), 3, *alpha.shape))
    for interface in dict.fromkeys(layer.interface for layer in layers):
        which = [k for k, layer in enumerate(layers) if layer.interface == interface]
        for kind, (matrices, step) in enumerate(moved):
            top = raised(_some(under, which), _some(matrices, which), interface)
            steps = step if isinstance(step, float) else step[which]
            rates[which, kind] = _answer(top, _some(carried, which), steps)
    return rates.reshape(-1, *alpha.shape)


def _together(several: Sequence[_Fields]) -> _Fields:
    """Arrays of several layers as one, (layers, *shape)."""
    first = several[0]
    return type(first)(*(np.stack([getattr(each, one.name) for each in several]) for one in fields(first)))


def _answer(below: PlaneCompliance, traction: PlaneVector, step: float | RealArray) -> RealArray:
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
