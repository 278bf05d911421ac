"""Preconditioned conjugate gradients on the free set, and the arrays of a problem that they
correct.

The linear system of a step is K d = r on the free set; at prescribed load it holds up to a constant
(the multiplier of the load), with d summing to zero.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ....core.arrays import RealArray
from ....core.engine import Convolution, Engine, FreeSet, Products, Splines, Survey, UnevenSplines
from ...operators import Operator
from ..protocol import ContactQP, FixedOffset, heights_near_contact
from .spline_model import OWN_YIELDING, SplineCompliance, spline_compliance

# The compliance and the arrays of a problem.


@dataclass(frozen=True, eq=False)
class ScaledOperator:
    """The compliance over ``scale`` (m/Pa) in the precision ``dtype``, with its preconditioners and
    two work arrays.

    ``product`` is the product with it, from ``field`` to ``response``. Nothing in the work arrays
    outlasts a step but zeros in ``field``.
    """

    operator: Operator
    engine: Engine
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
        return cls(operator, engine, dtype, scale, operator.convolution(dtype, scale), *fields)

    @cached_property
    def modelled(self) -> SplineCompliance:
        """Model of it by nested splines."""
        return spline_compliance(self.operator, self.scale)

    @cached_property
    def splines(self) -> Splines:
        """Nested splines that model it."""
        return self.engine.splines(self.operator.grid.shape, self.modelled.model, self.dtype)

    @cached_property
    def uneven(self) -> tuple[UnevenSplines, RealArray] | None:
        """The splines, and factors (nx, ny) to how points yield to their own load in the inverse;
        None where all are alike, or the machine has no such splines."""
        beside, splines = self.operator.beside, self.splines
        if beside is None or not isinstance(splines, UnevenSplines):
            return None
        own = OWN_YIELDING / self.modelled.model.stiffness * self.scale
        return splines, (own / (own + beside)).astype(self.dtype)


@dataclass(frozen=True, eq=False)
class Workspace:
    """Arrays of one problem and the scaled operator for its corrections.

    ``pressure`` and ``deflection`` (Pa, m; in the precision ``dtype``) are the iterate, changed in
    place; ``exact`` is the convolution that makes the one from the other. A deflection over
    ``scaled.scale`` is a pressure in units of ``unit`` (Pa). ``load`` is the sum of the pressure
    (Pa) that is prescribed, so that corrections must sum to zero; None at a prescribed position.
    """

    qp: ContactQP
    engine: Engine
    unit: float
    load: float | None
    scaled: ScaledOperator
    dtype: str
    heights: Any
    cap: Any
    exact: Convolution
    pressure: Any
    deflection: Any

    @classmethod
    def of(cls, qp: ContactQP, precision: str, start: RealArray, deflection: RealArray | None = None) -> Workspace:
        """Workspace of ``qp`` with the pressure ``start`` (Pa) and its ``deflection`` (m), if it is
        known, both of which it may take over.

        ``precision`` is ``"double"``, ``"single"``, or ``"mixed"`` for corrections in single and
        the rest in double.
        """
        operator, engine, shape = qp.operator, qp.operator.engine, qp.operator.grid.shape
        dtype = "float32" if precision == "single" else "float64"
        pressure, exact = engine.array(start, dtype), operator.convolution(dtype)
        if deflection is None:
            begun = engine.zeros(shape, dtype)
            exact.apply(pressure, begun)
        else:
            begun = engine.array(deflection, dtype)
        scale, constraint = operator.largest or 1.0, qp.constraint
        if isinstance(constraint, FixedOffset):
            load, heights = None, qp.profile - constraint.offset if constraint.offset else qp.profile
        else:
            load, heights = constraint.mean_pressure * qp.profile.size, heights_near_contact(qp)
            if precision == "single" and heights is qp.profile:
                heights = heights - float(heights.mean())
        return cls(
            qp=qp,
            engine=engine,
            unit=qp.height_scale / scale,
            load=load,
            scaled=ScaledOperator.of(operator, "float64" if precision == "double" else "float32", scale),
            dtype=dtype,
            heights=engine.array(heights, dtype),
            cap=None if qp.elastic else engine.array(np.asarray(qp.cap, dtype=float).reshape(-1), dtype),
            exact=exact,
            pressure=pressure,
            deflection=begun,
        )

    def survey(self) -> Survey:
        """Sums over the iterate."""
        return self.engine.survey(self.pressure, self.deflection, self.heights, self.cap)

    def copy(self) -> Workspace:
        """Workspace with arrays of its own for the iterate; the work arrays of corrections are
        shared."""
        pressure, deflection = self.engine.copy(self.pressure), self.engine.copy(self.deflection)
        return replace(self, pressure=pressure, deflection=deflection)


# The linear system of a step, and its preconditioner.


_MODEL_STEPS = 3
"""Steps on the model of a compliance whose inverse is refined, each as dear as two uses of its
inverse: for films so stiff that the inverse alone is poor."""

_FIRST_STEPS = 1
"""Further such steps for a direction whose length is not measured, since no product corrects it."""

_LAST_LENGTH = 0.85
"""Length of the last of these steps over that of the one before, which spares a product with the
model."""

_STEP_LENGTH = 1.0
"""Length of a step along the preconditioned residual where none can be measured: the model has the
scale of the compliance."""


@dataclass(frozen=True, eq=False)
class LinearSystem:
    """Equations K d = r on the set ``free``; if ``zero_sum`` up to a constant, d summing to zero.
    If ``modelled``, K is the compliance of nested splines."""

    scaled: ScaledOperator
    free: FreeSet
    zero_sum: bool
    modelled: bool = False

    def mean(self, total: float) -> float:
        """Mean of a vector that sums to ``total``, where it is to be taken out."""
        return total / self.free.size if self.zero_sum and self.free.size else 0.0

    @cached_property
    def _uneven(self) -> tuple[UnevenSplines, Any] | None:
        """The splines, and the factors (n,) to how points of the set yield to their own load."""
        found = self.scaled.uneven
        return None if found is None else (found[0], self.free.gather(found[1])[0])

    def factorise(self) -> None:
        """Prepare the preconditioner for the set."""
        if self._uneven is None:
            self.scaled.splines.factorise(self.free)
        else:
            splines, factors = self._uneven
            splines.factorise(self.free, factors)

    def _inverse(self, r: Any, other: Any, out: Any) -> Products:
        """Approximate inverse of the model times ``r``, and its products with ``r`` and
        ``other``."""
        if self._uneven is None:
            return self.scaled.splines.solve(self.free, r, other, out)
        splines, factors = self._uneven
        return self.free.products(splines.solve_with(self.free, r, factors), r, other)

    def preconditioned(self, r: Any, other: Any, out: Any, *, more: int = 0) -> Products:
        """Approximate inverse of K times ``r``, better by some ``more`` steps on the model, and its
        products with ``r`` and ``other``."""
        scaled = self.scaled
        steps = (_MODEL_STEPS if scaled.modelled.refined else 1) + more  # one is the approximate inverse of the model
        if self.modelled or steps == 1:
            return self._inverse(r, other, out)
        model, stopping = replace(self, modelled=True), Stopping(0.0, steps - 1)
        found = conjugate_gradients(model, self.free.copy(r), stopping, further=_LAST_LENGTH).d
        return self._inverse(r, other, out) if found is None else self.free.products(found, r, other)


# Conjugate gradients.


class Stopping(NamedTuple):
    """When to stop: at this ``reduction`` of the residual, or after ``max_steps``; if there are
    none, a single direction without a product is taken.

    It counts in the norm of the preconditioner, or in the plain one if that is the first to be
    reduced: it is known before the next use of the preconditioner, a quarter of which are not
    needed then.

    ``ending``, if given: conjugate gradients stop at this reduction of the largest residual
    instead, and a last step follows whose length is not measured and whose deflection is not
    computed, but estimated (see ``Correction.open``). A single direction takes so many ``more``
    steps on the model.
    """

    reduction: float
    max_steps: int
    ending: float | None = None
    more: int = 0


class PressureChange(NamedTuple):
    """``values`` by which the pressure on the set ``free`` has changed, in the units of a
    correction."""

    free: FreeSet
    values: Any


class Correction(NamedTuple):
    """Vector ``d``, None where no step was possible; FFT ``pairs`` it took; whether the reduction
    was ``reached``.

    ``open``: d holds a last step that ``on_step`` was not told of. Else r - K d is the ``residual``
    plus the ``level``, a constant, as the steps carry both along.
    """

    d: Any
    pairs: float
    reached: bool
    open: bool = False
    residual: Any = None
    level: float = 0.0


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
    further: float = 0.0,
) -> Correction:
    """Solve the ``system`` for the residual ``r``, which may be overwritten.

    ``pending`` is a change whose deflection is not in the residual yet: the first product with the
    compliance includes it. ``on_step`` receives the length of every step while its product with the
    compliance is in ``response``. ``further``: length of one more step without a product, over that
    before; for changes whose deflection is computed anyway. None if zero.
    """
    free, scaled = system.free, system.scaled
    pairs = 0.0 if system.modelled else scaled.operator.pairs_per_application
    last: _Direction | None = None
    # what the pending change leaves of the residual, as the model predicts it
    predicted = r if pending is None else scaled.splines.predicted_residual(free, r, pending.free, pending.values)
    if not system.modelled:
        system.factorise()
    if stopping.max_steps == 0:
        none = Correction(free.zeros(), 0.0, True, open=stopping.ending is not None)
        return _unmeasured(system, predicted, None, _STEP_LENGTH, none, stopping.more)
    ending = None if stopping.ending is None else stopping.ending * free.largest(r)
    enough = stopping.reduction**2 * free.square(predicted) if stopping.reduction and stopping.max_steps > 1 else 0.0
    d, z, first, left = free.zeros(), free.empty(), 0.0, 0.0
    if pending is not None:
        # a step by one product with the compliance, which gives the deflection by the pending
        # change as well: its direction t is the preconditioned residual that the change will leave,
        # and the field holds t + change / length
        begun = system.preconditioned(predicted, predicted, z, more=_FIRST_STEPS)
        t, _ = _next_direction(system, r, begun, None)
        pending.free.scatter_add(pending.values, 1.0 / _STEP_LENGTH, scaled.field)
        scaled.product.apply(scaled.field, scaled.response)
        scaled.engine.clear_field(pending.free, scaled.field)
        z, total, _, _ = free.gather_products(scaled.response, t, t, begun.vector)
        if on_step is not None:
            on_step(_STEP_LENGTH)
        d, r, left = free.update_solution(_STEP_LENGTH, t, z, system.mean(total), d, r)
        first = begun.first
    taken, length, reached, level = int(pending is not None), _STEP_LENGTH, False, 0.0
    while taken < stopping.max_steps:
        if taken > 0 and ending is not None and free.largest(r) <= ending:
            return _unmeasured(system, r, last, length, Correction(d, taken * pairs, True, open=True))
        if reached := taken > 0 and left < enough:
            break
        preconditioned = system.preconditioned(r, r if last is None else last.kt, z)
        z, product = preconditioned.vector, preconditioned.first
        if reached := product <= 0.0 or (taken > 0 and product < stopping.reduction**2 * first):
            break
        first = first or product
        t, slope = _next_direction(system, r, preconditioned, last)
        out = free.empty() if last is None else last.kt
        if system.modelled:
            kt, total, curvature, _ = scaled.splines.deflection(free, t, t, out)
        else:
            scaled.product.apply(scaled.field, scaled.response)
            kt, total, curvature, _ = free.gather_products(scaled.response, t, t, out)
        if curvature <= 0.0:
            break
        last = _Direction(t, kt, curvature, total)
        taken, length = taken + 1, slope / curvature
        if on_step is not None:
            on_step(length)
        level -= length * system.mean(total)
        d, r, left = free.update_solution(length, t, kt, system.mean(total), d, r)
    found = Correction(d if taken else None, taken * pairs, reached, residual=r, level=level)
    return _unmeasured(system, r, last, further * length, found) if further and taken else found


def _unmeasured(
    system: LinearSystem, r: Any, last: _Direction | None, length: float, found: Correction, more: int = 0
) -> Correction:
    """``found`` and one more step of this ``length``, without a product, with so many ``more``
    steps on the model if it is the first; no step where rounding leaves no direction that goes
    down."""
    other, steps = (r, _FIRST_STEPS + more) if last is None else (last.kt, 0)
    t, slope = _next_direction(system, r, system.preconditioned(r, other, system.free.empty(), more=steps), last)
    if not slope > 0.0:  # not a number either
        return found._replace(d=None if last is None else found.d, open=False)
    return found._replace(d=system.free.update_solution(length, t, t, 0.0, found.d, r)[0])


def _next_direction(system: LinearSystem, r: Any, z: Products, last: _Direction | None) -> tuple[Any, float]:
    """Search direction, set in the field unless for the model, which needs none, and its product
    with ``r``.

    ``z`` is the preconditioned residual; its second product is that with K ``last``, to which the
    direction is conjugate.
    """
    mean, ratio = system.mean(z.total), 0.0
    if last is not None:
        ratio = -(z.second - mean * last.total) / last.curvature
    t = system.free.zeros() if last is None else last.t
    field = None if system.modelled else system.scaled.field
    return system.free.update_direction(z.vector, mean, ratio, t, r, field)
