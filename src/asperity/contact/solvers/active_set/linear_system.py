"""Preconditioned conjugate gradients on the free set, and the arrays of a problem that they correct.

The linear system of a step is K d = r on the free set; at prescribed load it holds up to a constant (the multiplier of the
load), with d summing to zero.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple, Protocol

import numpy as np

from ....core.arrays import RealArray
from ....core.engine import Cells, Convolution, Engine, FreeSet, Products, Survey
from ...operators import Operator
from ..protocol import ContactQP, FixedMean, FixedOffset, heights_near_contact
from .cells import PIXEL_SHARE, PIXEL_SHARE_COARSE, CoarseCorrection, coarse_correction, hierarchies, pixel_compliance


@dataclass(frozen=True, eq=False)
class ScaledOperator:
    """The compliance over ``scale`` (m/Pa) in the precision ``dtype``, with its preconditioners and two work arrays.

    ``product`` is the product with it, from ``field`` to ``response``. Nothing in the work arrays outlasts a step but zeros
    in ``field``.
    """

    operator: Operator
    dtype: str
    scale: float
    product: Convolution
    field: Any
    response: Any

    @classmethod
    def of(cls, operator: Operator, dtype: str, scale: float) -> ScaledOperator:
        """Scaled ``operator`` with work arrays of its own."""
        engine, shape = operator.engine, operator.grid.shape
        fields = engine.field(shape, dtype), engine.field(shape, dtype)
        return cls(operator, dtype, scale, operator.convolution(dtype, scale), *fields)

    @property
    def engine(self) -> Engine:
        """Machine that computes it."""
        return self.operator.engine

    @cached_property
    def coarse(self) -> CoarseCorrection | None:
        """Coarse correction of the nested cells, where it pays."""
        return coarse_correction(self.operator)

    @property
    def _share(self) -> float:
        return PIXEL_SHARE if self.coarse is None else PIXEL_SHARE_COARSE

    @cached_property
    def cells(self) -> Cells:
        """Nested cells that model it."""
        operator = self.operator
        periodic = all(operator.boundary.wraps)
        nested = hierarchies(operator.octaves, operator.grid, periodic=periodic, share=self._share)
        coarse = None if self.coarse is None else self.coarse.form
        return self.engine.cells(operator.grid.shape, nested, coarse, self.dtype)

    @cached_property
    def pixel_compliance(self) -> float:
        """Deflection of a point under its own load in the model of nested cells, over ``scale``."""
        return self._share * pixel_compliance(self.operator.octaves, self.operator.grid) / self.scale

    @cached_property
    def inverse(self) -> Convolution:
        """Convolution whose ``solve`` divides by it: exact on a periodic grid, nearly so on a free one."""
        return self.operator.preconditioner(self.product, self.dtype, self.scale)


@dataclass(frozen=True, eq=False)
class Workspace:
    """Arrays of one problem and the scaled operator for its corrections.

    ``pressure`` and ``deflection`` (Pa, m; in the precision ``dtype``) are the iterate, changed in place; ``exact`` is
    the convolution that makes the one from the other. A deflection over ``scaled.scale`` is a pressure in units of ``unit``.
    """

    qp: ContactQP
    scaled: ScaledOperator
    dtype: str
    heights: Any
    cap: Any
    exact: Convolution
    pressure: Any
    deflection: Any

    @classmethod
    def of(cls, qp: ContactQP, precision: str, start: RealArray) -> Workspace:
        """Workspace of ``qp`` with the pressure ``start`` (Pa), which it may take over.

        ``precision`` is ``"double"``, ``"single"``, or ``"mixed"`` for corrections in single and the rest in double.
        """
        operator, engine, shape = qp.operator, qp.operator.engine, qp.operator.grid.shape
        dtype = "float32" if precision == "single" else "float64"
        pressure, deflection = engine.array(start, dtype), engine.zeros(shape, dtype)
        exact = operator.convolution(dtype)
        exact.apply(pressure, deflection)
        scale = float(operator.kernel.max()) or 1.0
        return cls(
            qp=qp,
            scaled=ScaledOperator.of(operator, "float64" if precision == "double" else "float32", scale),
            dtype=dtype,
            heights=engine.array(_heights(qp, centred=precision == "single"), dtype),
            cap=None if qp.elastic else engine.array(np.asarray(qp.cap, dtype=float).reshape(-1), dtype),
            exact=exact,
            pressure=pressure,
            deflection=deflection,
        )

    @property
    def unit(self) -> float:
        """Pressure (Pa) of one in a correction."""
        return self.qp.height_scale / self.scaled.scale

    @property
    def engine(self) -> Engine:
        """Machine it is on."""
        return self.scaled.engine

    @property
    def load_prescribed(self) -> bool:
        """Whether corrections must sum to zero."""
        return isinstance(self.qp.constraint, FixedMean)

    def survey(self) -> Survey:
        """Sums over the iterate."""
        return self.engine.survey(self.pressure, self.deflection, self.heights, self.cap)

    def copy(self) -> Workspace:
        """Workspace with arrays of its own for the iterate; the work arrays of corrections are shared."""
        pressure, deflection = self.engine.copy(self.pressure), self.engine.copy(self.deflection)
        return replace(self, pressure=pressure, deflection=deflection)


def _heights(qp: ContactQP, *, centred: bool) -> RealArray:
    """Heights from a level near the contact; ``centred`` in any case if the load is prescribed."""
    if isinstance(qp.constraint, FixedOffset):
        return qp.profile - qp.constraint.offset if qp.constraint.offset else qp.profile
    heights = heights_near_contact(qp)
    return heights - float(heights.mean()) if centred and heights is qp.profile else heights


# Preconditioners: approximate inverses of the compliance on a free set.


_NEARLY_FULL = 0.998
"""Share of the points of a periodic grid from which on the inverse in Fourier space serves. FFT pairs for a reduction of the
residual to 1e-6 on self-affine surfaces: nested cells 10 at any area (film of E 10, h 4 pixels: 20); the restricted inverse
25 (53) at 90 % of the area, 19 (37) at 99 %, 15 (21) at 99.8 %, 11 (17) at 99.95 %. With a free boundary it is nowhere
exact, and takes more than twice those of nested cells."""

_STEP_LENGTH = 0.7
"""Length, times the inverse of the pixel's compliance, of a step along the preconditioned residual where none can be measured.
Lengths measured on self-affine surfaces scatter about it. Mean pairs at 512² for 0.4, 0.55, 0.7, 0.85, 1: 15.2, 14.7, 13.9,
15.6, 16.3; free at 256² 46, 44.5, 43.8, 47.5, 49.8; films of E 10 at 512² 21.4, 22.9, 22.8, 23, 23."""


class Preconditioner(Protocol):
    """Approximate inverse, symmetric and positive definite, on one free set."""

    @property
    def pairs(self) -> float:
        """FFT pairs of the grid that one use costs."""

    @property
    def step_length(self) -> float:
        """Length of a step along inverse times residual that is about right where none can be measured."""

    def solve(self, r: Any, other: Any, out: Any) -> Products:
        """Vector z = inverse times r, its sum, z·r and z·other; in the memory of ``out`` where that can be."""

    def predicted_residual(self, r: Any, loaded: FreeSet, change: Any) -> Any:
        """Vector r less about the deflection by ``change`` on the set ``loaded``; None where that takes transforms."""


class NestedCells:
    """Inverse of the compliance of nested cells, and of the coarse correction of the larger of them (see ``cells``)."""

    def __init__(self, scaled: ScaledOperator, free: FreeSet) -> None:
        self.pairs = 0.0 if scaled.coarse is None else scaled.coarse.pairs
        self.step_length = _STEP_LENGTH / scaled.pixel_compliance
        self._cells = scaled.cells
        self._unit = scaled.pixel_compliance
        self._free = free
        self._factorised = False

    def solve(self, r: Any, other: Any, out: Any) -> Products:
        """Inverse times ``r``."""
        if not self._factorised:
            self._cells.factorise(self._free)
            self._factorised = True
        return self._cells.solve(self._free, r, other, out)

    def predicted_residual(self, r: Any, loaded: FreeSet, change: Any) -> Any:
        """``r`` less the deflection of the cells."""
        self._factorised = False
        return self._cells.predicted_residual(self._free, r, loaded, change, self._unit)


class RestrictedInverse:
    """Inverse of the compliance of the whole grid in Fourier space, restricted to the set: exact in full contact."""

    pairs = 1.0
    step_length = 1.0

    def __init__(self, scaled: ScaledOperator, free: FreeSet) -> None:
        self._scaled = scaled
        self._free = free

    def solve(self, r: Any, other: Any, out: Any) -> Products:
        """Inverse times ``r``."""
        scaled = self._scaled
        self._free.scatter(r, scaled.field)
        scaled.inverse.solve(scaled.field, scaled.response)
        return self._free.gather_products(scaled.response, r, other, out)

    def predicted_residual(self, r: Any, loaded: FreeSet, change: Any) -> Any:
        """None: any deflection takes a transform."""
        return None


def preconditioner(scaled: ScaledOperator, free: FreeSet) -> Preconditioner:
    """The inverse in Fourier space on nearly full periodic contact, else nested cells."""
    operator = scaled.operator
    nearly_full = all(operator.boundary.wraps) and free.size > _NEARLY_FULL * operator.grid.n_points
    return RestrictedInverse(scaled, free) if nearly_full else NestedCells(scaled, free)


# Conjugate gradients.


@dataclass(frozen=True, eq=False)
class LinearSystem:
    """Equations K d = r on the set ``free``; if ``zero_sum`` up to a constant, d summing to zero."""

    scaled: ScaledOperator
    free: FreeSet
    zero_sum: bool

    def mean(self, total: float) -> float:
        """Mean of a vector that sums to ``total``, where it is to be taken out."""
        return total / self.free.size if self.zero_sum else 0.0


class Stopping(NamedTuple):
    """When to stop: at this ``reduction`` of the residual in the norm of the preconditioner, or after ``max_steps``."""

    reduction: float
    max_steps: int


class PressureChange(NamedTuple):
    """``values`` by which the pressure on the set ``free`` has changed, in the units of a correction."""

    free: FreeSet
    values: Any


class Correction(NamedTuple):
    """Vector ``d``, None where no step was possible; FFT ``pairs`` it took; whether the reduction was ``reached``."""

    d: Any
    pairs: float
    reached: bool


class _Direction(NamedTuple):
    """Search direction ``t``, K t, their product and the sum of K t."""

    t: Any
    kt: Any
    curvature: float
    total: float


def conjugate_gradients(
    system: LinearSystem,
    r: Any,
    stopping: Stopping,
    *,
    pending: PressureChange | None = None,
    on_step: Callable[[float], None] | None = None,
) -> Correction:
    """Solve the ``system`` for the residual ``r``, which may be overwritten.

    ``pending`` is a change whose deflection is not in the residual yet: the first product with the compliance includes it.
    ``on_step`` is told the length of every step while its product with the compliance is in ``response``.
    """
    scaled, free = system.scaled, system.free
    inverse = preconditioner(scaled, free)
    last: _Direction | None = None
    first, pairs, taken, reached = 0.0, 0.0, 0, False
    if pending is None:
        d = free.zeros()
    else:
        d, r, first = _combined_step(system, inverse, r, pending, on_step)
        taken = 1
        pairs = scaled.operator.pairs_per_application + (inverse.pairs if first else 0.0)
    z = free.zeros()
    while taken < stopping.max_steps:
        preconditioned = inverse.solve(r, r if last is None else last.kt, z)
        z, product = preconditioned.vector, preconditioned.first
        pairs += inverse.pairs
        reached = product <= 0.0 or (taken > 0 and product < stopping.reduction**2 * first)
        if reached:
            break
        first = first or product
        t, slope = _next_direction(system, r, preconditioned, last)
        scaled.product.apply(scaled.field, scaled.response)
        pairs += scaled.operator.pairs_per_application
        kt, total, curvature, _ = free.gather_products(scaled.response, t, t, free.zeros() if last is None else last.kt)
        if curvature <= 0.0:
            break
        last = _Direction(t, kt, curvature, total)
        taken += 1
        if on_step is not None:
            on_step(slope / curvature)
        d, r = free.update_solution(slope / curvature, t, kt, system.mean(total), d, r)
    return Correction(d if taken else None, pairs, reached)


def _next_direction(system: LinearSystem, r: Any, z: Products, last: _Direction | None) -> tuple[Any, float]:
    """Search direction, set in the field, and its product with ``r``.

    ``z`` is the preconditioned residual; its second product is that with K ``last``, to which the direction is conjugate.
    """
    mean, ratio = system.mean(z.total), 0.0
    if last is not None:
        ratio = -(z.second - mean * last.total) / last.curvature
    t = system.free.zeros() if last is None else last.t
    return system.free.update_direction(z.vector, mean, ratio, t, r, system.scaled.field)


class _FirstStep(NamedTuple):
    """Vector ``d``, the residual ``r`` after it, and ``product``: the predicted residual times its preconditioned self."""

    d: Any
    r: Any
    product: float


def _combined_step(
    system: LinearSystem,
    inverse: Preconditioner,
    r: Any,
    pending: PressureChange,
    on_step: Callable[[float], None] | None,
) -> _FirstStep:
    """Step of fixed length by one product with the compliance, which gives the deflection by the pending change as well.

    Its direction t is the preconditioned residual that the change will leave, as predicted by the preconditioner; the field
    holds t + change / length. Where no prediction is possible without transforms, t is zero.
    """
    scaled, free = system.scaled, system.free
    length, product = inverse.step_length, 0.0
    predicted = inverse.predicted_residual(r, pending.free, pending.values)
    if predicted is None:
        t = free.zeros()
    else:
        z = inverse.solve(predicted, predicted, free.zeros())
        t, _ = _next_direction(system, r, z, None)
        product = z.first
    pending.free.scatter_add(pending.values, 1.0 / length, scaled.field)
    scaled.product.apply(scaled.field, scaled.response)
    scaled.engine.clear_field(pending.free, scaled.field)
    response = free.gather_products(scaled.response, t, t, free.zeros())
    if on_step is not None:
        on_step(length)
    d, r = free.update_solution(length, t, response.vector, system.mean(response.total), free.zeros(), r)
    return _FirstStep(d, r, product)


# A linear solve of its own.


_STIFFNESS_STOPPING = Stopping(reduction=1e-4, max_steps=500)


def normal_stiffness(operator: Operator, pressure: RealArray, cap: float | RealArray) -> float:
    """Incremental stiffness d(mean pressure)/d(approach) in Pa/m, from one linear solve on the elastic contact.

    Infinite for full contact on a periodic half-space, zero without elastic contact points, NaN if the linear solve
    does not converge. Points at the cap yield and carry no increment (loading). The error is of second order in the
    relative residual, which is 1e-4: what remains is the rounding of single precision, below 1e-6.
    """
    engine, shape = operator.engine, operator.grid.shape
    scaled = ScaledOperator.of(operator, "float32", float(operator.kernel.max()) or 1.0)
    p, flat = engine.array(pressure, "float64"), engine.zeros(shape, "float64")
    bound = None if np.all(np.isinf(cap)) else engine.array(np.asarray(cap, dtype=float).reshape(-1), "float64")
    survey = engine.survey(p, flat, flat, bound)  # u = h: no point enters
    free = survey.free_set(np.zeros((*survey.squares.shape[:2], 2)), 0.0, 1.0, scaled.dtype)
    if free.size == 0:
        return 0.0
    if free.size == operator.grid.n_points and operator.zero_mean_mode:
        return math.inf
    unit, _ = free.gather(engine.array(np.ones(shape), scaled.dtype))
    found = conjugate_gradients(LinearSystem(scaled, free, zero_sum=False), unit, _STIFFNESS_STOPPING)
    if not found.reached or found.d is None:
        return math.nan
    free.scatter(found.d, scaled.field)
    _, total = free.gather(scaled.field)
    return total / scaled.scale / operator.grid.n_points
