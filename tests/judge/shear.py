"""Equations of friction: the cone, the direction of slip, points that stick; of steps with stick
and slip and of steady rolling.

Of the step the slip is s = shift - (u - u0), u = C q + D p along the surface; |q| <= B(p), and B
|s| = q·s: no slip below the bound, slip along the traction at it.
"""

from __future__ import annotations

import numpy as np
from judge.checks import EPS, ROUNDING, Check, norm, over

import asperity as asp
from asperity.contact.tangential import about_centre
from asperity.core.arrays import RealArray
from asperity.physics.friction.operator import TangentialOperator
from asperity.physics.rolling.rolling import DIRECTIONS

TOLERANCE = 1e-5
"""Relative change of the displacement by shear at which steps with stick and slip are settled."""

SLIDING = 1e-6
"""The same where everything slides."""

INACTIVE = 10.0
"""Bounds over the largest traction from which on they count as this many times it."""

TRANSIENT = 100.0
"""Distance from the steady state over the last change of the transient method, as ``roll`` states
it."""


def operator_of(problem: asp.ContactProblem) -> TangentialOperator:
    """Tangential compliance of the bodies of ``problem``."""
    return TangentialOperator(
        problem.grid, (problem.body, problem.counter_body), problem.boundary, engine=asp.engines.CpuEngine(1)
    )


def along(operator: TangentialOperator, traction: RealArray, pressure: RealArray) -> RealArray:
    """Displacement (2, nx, ny) in m along the surface under both."""
    return operator.displacement(traction) + operator.drawn(pressure)


def cone(traction: RealArray, bound: RealArray) -> Check:
    """No traction is beyond its bound."""
    size = np.hypot(*traction)
    finite = np.where(np.isfinite(bound), bound, size)
    most = float(np.max(finite, initial=0.0))
    return Check("friction cone", over(float(np.maximum(size - finite, 0.0).max()), most), ROUNDING)


def by_friction(
    traction: RealArray, bound: RealArray, slip: RealArray, elastic: float, stated: float, rounding: float
) -> Check:
    """Σ (B |s| - q·s) over the ``elastic`` energy per pixel area (Pa m) and the work of the slip:
    no slip below the bound, and along the traction at it.

    ``rounding`` is that of the slip, in m.
    """
    size = np.hypot(*slip)
    largest = float(np.hypot(*traction).max())
    limit = np.minimum(bound, INACTIVE * largest) if largest > 0.0 else np.where(np.isfinite(bound), bound, 0.0)
    missed = float((limit * size).sum() - np.einsum("kij,kij->", traction, slip))
    scale = elastic + float((limit * size).sum())
    return Check("friction law", over(max(missed, 0.0), scale), stated + over(float(limit.sum()) * rounding, scale))


def _elastic(operator: TangentialOperator, traction: RealArray) -> float:
    """Elastic energy per pixel area (Pa m) of a ``traction`` (2, nx, ny) alone."""
    return 0.5 * float(np.einsum("kij,kij->", traction, operator.displacement(traction)))


def _moved(result: asp.ContactResult, before: asp.ContactResult | None) -> RealArray:
    """Displacement (2, nx, ny) in m of the rigid counter body in the step; NaN where it is not
    determined."""
    now, then = result.require_stick_slip(), None if before is None else before.require_stick_slip()
    values = np.array([now.shift_x, now.shift_y, now.twist])
    if then is not None:
        values = values - [then.shift_x, then.shift_y, then.twist]
    x, y = about_centre(result.problem.grid)
    shape = result.problem.grid.shape
    moved = np.empty((2, *shape))
    moved[0], moved[1] = values[0] - values[2] * y, values[1] + values[2] * x
    return moved


def stick_slip(
    operator: TangentialOperator, result: asp.ContactResult, before: asp.ContactResult | None, control: object
) -> list[Check]:
    """Cone, slip, force, lift and heat of a step."""
    found, pressure = result.require_stick_slip(), np.asarray(result.pressure, dtype=float)
    law, grid, traction = found.law, result.problem.grid, found.traction
    bound = law.bound(pressure)
    displacement = along(operator, traction, pressure)
    start = np.zeros_like(displacement)
    if before is not None:
        start = along(operator, before.require_stick_slip().traction, np.asarray(before.pressure, dtype=float))
    moved = _moved(result, before)
    slip = np.where(pressure > 0.0, moved - (displacement - start), 0.0)
    residual = max([check.tolerance for check in result.certificate.couplings], default=0.0)
    rounding = ROUNDING * float(max(np.abs(each).max() for each in (displacement, start, moved)))
    checks = [cone(traction, bound)]
    if np.isfinite(slip).all():
        stated = found.duality_gap + max(residual, TOLERANCE)
        elastic = _elastic(operator, traction)
        checks.append(by_friction(traction, bound, slip, elastic, stated, rounding))
        heat = float(np.einsum("kij,kij->", traction, slip)) * grid.pixel_area
        scale = elastic * grid.pixel_area + abs(heat)
        slipped = rounding * float(np.hypot(*traction).sum()) * grid.pixel_area
        checks.append(Check("heat of slip", over(abs(heat - found.dissipated), scale), stated + over(slipped, scale)))
    if isinstance(control, asp.TangentialForce):
        force = traction.sum(axis=(1, 2)) * grid.pixel_area
        missed = float(np.hypot(*(force - [control.x, control.y])))
        checks.append(Check("tangential force", over(missed, found.friction_limit), TOLERANCE))
    lift = operator.lift(traction)
    checks.append(Check("lift by shear", over(norm(lift - found.shear_displacement), norm(lift)), residual + EPS))
    made = max(-found.dissipated, 0.0)
    return [*checks, Check("no heat out of nothing", over(made, abs(found.tangential_energy)), TOLERANCE)]


def lift_error(operator: TangentialOperator, result: asp.ContactResult) -> float:
    """Norm (m) of what the lift by shear may still change by."""
    residual = max([check.tolerance for check in result.certificate.couplings], default=0.0)
    return residual * norm(operator.lift(result.require_stick_slip().traction))


def sliding(operator: TangentialOperator, result: asp.ContactResult) -> tuple[RealArray, list[Check]]:
    """Displacement (nx, ny) in m by the shear of a contact in which everything slides, and that it
    is the one stated."""
    friction = result.problem.friction
    assert isinstance(friction, asp.Coulomb)
    bound = friction.bound(np.asarray(result.pressure, dtype=float))
    way = np.array([np.cos(friction.direction), np.sin(friction.direction)])
    lift = operator.lift(way[:, None, None] * bound)
    stated = np.zeros_like(lift) if result.sliding is None else result.sliding.shear_displacement
    return lift, [Check("lift by shear", over(norm(lift - stated), norm(lift)), SLIDING)]


def rolling(operator: TangentialOperator, found: asp.rolling.RollingContact, *, transient: bool) -> list[Check]:
    """Steady traction: what material slips while it moves by a pixel is along the traction where
    that is at its bound, and nothing elsewhere."""
    grid, pressure = found.normal.problem.grid, np.asarray(found.normal.pressure, dtype=float)
    direction = DIRECTIONS[found.direction]
    pixel = grid.spacing[direction.axis]
    bound, traction = found.law.bound(pressure), found.traction
    displacement = along(operator, traction, pressure)
    x, y = about_centre(grid)
    along_x, along_y = found.creepage.along_axes(direction)
    rigid = np.empty_like(traction)
    rigid[0], rigid[1] = along_x - found.creepage.spin * y, along_y + found.creepage.spin * x
    axis = direction.axis + 1
    ahead = np.roll(displacement, -direction.sign, axis)
    edge = -1 if direction.sign > 0 else 0
    index = [slice(None)] * 3
    index[axis] = edge  # type: ignore[call-overload]
    ahead[tuple(index)] = displacement[tuple(index)]
    slip = np.where(pressure > 0.0, rigid * pixel + ahead - displacement, 0.0)
    rounding = ROUNDING * float(np.abs(displacement).max())
    stated = (TRANSIENT if transient else 1.0) * found.steadiness + (1e-4 if operator.coupled else 0.0) + EPS
    checks = [cone(traction, bound), by_friction(traction, bound, slip, _elastic(operator, traction), stated, rounding)]
    forces = traction.sum(axis=(1, 2)) * grid.pixel_area
    torque = float((x * traction[1] - y * traction[0]).sum()) * grid.pixel_area
    power = float(forces @ [along_x, along_y]) + torque * found.creepage.spin
    size = found.friction_limit * (abs(along_x) + abs(along_y) + abs(found.creepage.spin) * max(grid.size))
    checks.append(Check("heat of rolling", over(abs(power - found.dissipated), size), 1e3 * ROUNDING))
    return checks
