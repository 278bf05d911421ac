"""Equations of the normal contact: gap and pressure, bounds, load, position, yielding, elastic
energy.

With the operator K in double precision, heights h counted from the highest point (d below it), what
lifts the surfaces beside the pressure, l, the permanent indentation w and the approach δ,

    gap = K p + l + d + w - δ >= 0,   0 <= p <= cap,   p gap = 0,
    w grows only where p is at the cap.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from judge.checks import EPS, ROUNDING, Check, norm, over

import asperity as asp
from asperity.contact.controls import mean_pressure
from asperity.contact.operators import Operator
from asperity.core.arrays import RealArray

UNRESOLVED, OF_DEFLECTION, MOST_DEFLECTIONS = 1e-5, 1e-4, 30.0
"""Lengths that errors are relative to at least: of the deflection of the mean pressure in the
longest wave, and of the deflection under load; and at most, deflections under load
(``solvers.protocol.scaled_error``)."""


@dataclass(frozen=True, eq=False)
class Pressed:
    """A result with what its fields make: in m and Pa, (nx, ny).

    ``lift`` is the displacement that is not by the pressure, known to ``lift_error`` (norm over all
    points); ``factor`` what the operator is to be multiplied by; ``dent`` the permanent indentation
    and imprint after the step, ``before`` the indentation before it.
    """

    result: asp.ContactResult
    operator: Operator
    lift: RealArray
    lift_error: float = 0.0
    factor: float = 1.0
    imprint: RealArray | float = 0.0
    before: RealArray | float = 0.0
    deflection: RealArray = field(init=False)
    pressure: RealArray = field(init=False)
    depth: RealArray = field(init=False)

    def __post_init__(self) -> None:
        pressure = np.asarray(self.result.pressure, dtype=float)
        profile = self.result.problem.profile()
        object.__setattr__(self, "pressure", pressure)
        object.__setattr__(self, "deflection", self.factor * self.operator.apply(pressure))
        object.__setattr__(self, "depth", profile.max() - profile)

    @property
    def indentation(self) -> RealArray:
        """Permanent indentation after the step."""
        return np.asarray(self.result.permanent_indentation, dtype=float)

    @property
    def cap(self) -> float | RealArray:
        """Largest pressure that each point bears at the indentation reached."""
        law = self.result.problem.law
        if isinstance(law, asp.plasticity.LayeredHardness):
            return law.cap_at(self.indentation)
        return law.pressure_cap()

    @property
    def apart(self) -> RealArray:
        """K p + l + d + w: the gap at no approach."""
        return self.deflection + self.lift + self.depth + self.indentation + self.imprint

    @property
    def gap(self) -> RealArray:
        """The gap, of either sign."""
        return self.apart - self.result.approach

    @property
    def energy(self) -> float:
        """Complementary energy per pixel area (Pa m) of the pressure, by which errors of it are
        relative."""
        p = self.pressure
        yielded = float((p * (self.indentation - self.before)).sum())
        elastic = 0.5 * float((p * self.deflection).sum())
        least = UNRESOLVED * self.factor * self.operator.largest * float(p.mean()) * float(p.sum())
        return max(elastic + yielded, least)

    @property
    def length(self) -> float:
        """Length (m) to which the errors of the certificate are relative: the rms height; of flat
        bodies what they deform by; at least what is resolved."""
        p = self.pressure
        rms = float(self.result.problem.profile().std())
        if rms == 0.0:
            rms = float(np.abs(self.operator.apply(np.full(p.shape, p.mean()))).max())
        return max(rms, self.least)

    @property
    def least(self) -> float:
        """Length (m) that is resolved: shares of the deflections by the mean pressure and under
        load."""
        return max(
            UNRESOLVED * self.factor * self.operator.largest * float(self.pressure.mean()),
            OF_DEFLECTION * self.deflected,
        )

    @property
    def deflected(self) -> float:
        """Half of the mean deflection (m) under load."""
        return over(0.5 * float((self.pressure * self.deflection).sum()), float(self.pressure.sum()))

    @property
    def placed(self) -> float:
        """Error (m) of a position or level that the tolerance of the solver allows."""
        deflections = MOST_DEFLECTIONS * self.deflected
        return self.result.certificate.tolerance * max(min(self.length, deflections), self.least)

    @property
    def resolved(self) -> float:
        """Rounding (m) of the gap, whose approach and offset are differences of heights."""
        return float(self.rounding.max()) + ROUNDING * float(np.abs(self.result.problem.profile()).max())

    @property
    def rounding(self) -> RealArray:
        """Rounding (m) at each point of the gap at no approach."""
        sizes = np.abs(self.deflection).max() + np.abs(self.lift).max()
        return ROUNDING * (sizes + np.abs(self.depth) + self.indentation + np.abs(self.imprint))


def bounds(of: Pressed) -> list[Check]:
    """The pressure is neither negative nor above what points bear."""
    p, cap = of.pressure, of.cap
    largest = float(p.max(initial=0.0))
    stated = max(EPS, float(np.finfo(of.result.pressure.dtype).eps))
    checks = [Check("pressure not negative", over(float(np.maximum(-p, 0.0).max()), largest), stated)]
    if np.isfinite(np.max(cap)):
        tolerance = _tolerance(of.result, "hardness")
        checks.append(Check("pressure below the hardness", float((p / cap - 1.0).max()), 4.0 * stated + tolerance))
    return checks


def _tolerance(result: asp.ContactResult, name: str) -> float:
    found = [check.tolerance for check in result.certificate.couplings if check.name == name]
    return found[0] if found else 0.0


def complementarity(of: Pressed) -> list[Check]:
    """The duality gap, relative to the energy, at the level of the bodies at which it is least; and
    the largest overlap."""
    p, cap, result = of.pressure, of.cap, of.result
    total = float(p.sum())
    if total == 0.0:
        return [Check("no overlap", over(float(np.maximum(-of.gap, 0.0).max()), of.resolved), 1.0)]
    levels = of.apart - of.indentation + of.before
    hard = bool(np.isfinite(np.max(cap)))
    found = _least(p, levels, cap) if hard else float((p * (levels - levels.min())).sum())
    rounding = float((p * of.rounding).sum())
    if hard:
        worked = np.maximum(of.indentation - of.before, 0.0)
        spare = np.asarray(cap - p)
        rounding += float((np.maximum(spare, 0.0) * of.rounding * (p > 0.0)).sum())
        rounding += _tolerance(result, "hardness") * float((cap * worked).sum())
        rounding += float(np.finfo(result.pressure.dtype).eps) * float((cap * worked).sum())
    lifted = of.lift_error * norm(p)
    stated = result.certificate.duality_gap + over(rounding + lifted, of.energy)
    return [Check("duality gap", over(found, of.energy), stated)]


def _least(p: RealArray, r: RealArray, cap: float | RealArray) -> float:
    """Least of Σ (r - λ)+ p + (λ - r)+ (cap - p) over the level λ, which it has at one of the
    values of r."""
    values, p_, spare = r.ravel(), p.ravel(), np.maximum(np.asarray(cap - p), 0.0).ravel()
    order = np.argsort(values)
    values, p_, spare = values[order], p_[order], spare[order]
    beyond = np.cumsum((p_ * values)[::-1])[::-1] - values * np.cumsum(p_[::-1])[::-1]
    below = values * np.cumsum(spare) - np.cumsum(spare * values)
    best = int(np.argmin(beyond + below))
    at = values[best]
    above = float((np.maximum(values - at, 0.0) * p_).sum())
    return above + float((np.maximum(at - values, 0.0) * spare).sum())


def gaps(of: Pressed) -> list[Check]:
    """The gap that the result states is that of its pressure; where there is pressure it is
    closed."""
    result, p, g = of.result, of.pressure, of.gap
    total = float(p.sum())
    if total == 0.0:
        return []
    certificate = result.certificate
    length = of.length
    stated = (
        certificate.penetration * length + certificate.field_error * length + of.resolved + of.lift_error + of.placed
    )
    stated += float(np.finfo(result.pressure.dtype).eps) * float(np.abs(of.deflection).max())
    error = float(np.abs(np.asarray(result.gap, dtype=float) - np.maximum(g, 0.0)).max())
    open_ = float((p * np.abs(g)).sum())
    closed = (certificate.field_error * length + of.resolved + of.placed) * total + of.lift_error * norm(p)
    return [Check("stated gap", error, stated), Check("gap under pressure", open_, closed)]


def load(of: Pressed, control: object, *, pulled: float = 0.0) -> list[Check]:
    """The mean pressure, less what is ``pulled`` beside it (Pa), is the prescribed one; or the
    position."""
    result = of.result
    p, grid = of.pressure, result.problem.grid
    mean = float(p.mean())
    if isinstance(control, asp.MeanPressure | asp.Force):
        wanted = mean_pressure(control, grid) + pulled
        stated = result.certificate.load_imbalance + max(ROUNDING, float(np.finfo(result.pressure.dtype).eps))
        return [Check("balance of force", abs(mean - wanted) / wanted, stated)]
    if isinstance(control, asp.Unloaded):
        return [Check("balance of force", mean - pulled, EPS)]
    return _position(of, control)


def _position(of: Pressed, control: object) -> list[Check]:
    result, p = of.result, of.pressure
    tolerance = _tolerance(result, "position")
    if isinstance(control, asp.MeanGap):
        touch = float(of.depth.mean())
        size = min(control.value, max(touch - control.value, EPS * touch))
        found, wanted = float(np.maximum(of.gap, 0.0).mean()), control.value
    elif isinstance(control, asp.Approach):
        free = (p > 0.0) & (p < of.cap)
        if not free.any():
            return []
        found, wanted = float((p * of.apart)[free].sum() / p[free].sum()), control.value
        size = wanted
    else:
        return []
    stated = tolerance * size + of.placed + of.resolved + of.lift_error
    return [Check("position", abs(found - wanted), stated)]


def yielding(of: Pressed) -> list[Check]:
    """Points are indented for good at the hardness alone, and by the work that is stated."""
    result, p, cap = of.result, of.pressure, of.cap
    if not np.isfinite(np.max(cap)):
        return []
    added = of.indentation - of.before
    eps = float(np.finfo(result.pressure.dtype).eps)
    tolerance = _tolerance(result, "hardness") + 4.0 * eps
    below = float(np.where(added > 0.0, 1.0 - p / cap, 0.0).max())
    healed = over(float(np.maximum(-added, 0.0).max()), float(np.max(of.indentation)))
    law, pixel = result.problem.law, result.problem.grid.pixel_area
    if isinstance(law, asp.plasticity.LayeredHardness):
        done = law.work_at(of.indentation) - law.work_at(np.broadcast_to(of.before, p.shape))
    else:
        done = cap * added
    work = float(np.sum(done)) * pixel
    size = max(abs(result.total_plastic_work), abs(work))
    return [
        Check("yielding at the hardness", below, tolerance),
        Check("no healing", healed, EPS),
        Check("plastic work", over(abs(result.plastic_work - work), size), 1e3 * ROUNDING),
    ]


def elastic_energy(of: Pressed, stored: float | None = None) -> list[Check]:
    """Half of pressure times displacement."""
    pixel, p = of.result.problem.grid.pixel_area, of.pressure
    found = 0.5 * float((p * (of.deflection + of.lift)).sum()) * pixel
    wanted = of.result.elastic_energy if stored is None else stored
    size = 0.5 * float((p * (np.abs(of.deflection) + np.abs(of.lift))).sum()) * pixel
    eps = float(np.finfo(of.result.pressure.dtype).eps)
    lifted = over(of.lift_error * norm(p) * pixel, size)
    stated = ROUNDING + 4.0 * eps + math.sqrt(EPS) * of.result.certificate.duality_gap + lifted
    return [Check("elastic energy", over(abs(found - wanted), size), stated)]
