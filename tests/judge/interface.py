"""Equations of the interface beside the pressure: menisci, attraction."""

from __future__ import annotations

import math

import numpy as np
from judge.checks import ROUNDING, Check, norm, over
from judge.normal import Pressed, bounds, complementarity, gaps, yielding
from scipy import ndimage

import asperity as asp
from asperity.contact.controls import mean_pressure
from asperity.contact.operators import Operator
from asperity.core.arrays import BoolArray, RealArray

WET_BALANCE = 1e-4
"""Share of the force between the solids to which external force and menisci balance it: ten times
as much is wrong."""


def islands(cut: BoolArray, wraps: tuple[bool, bool]) -> RealArray:
    """Number of the island of each pixel of ``cut``, zero elsewhere; pixels with a common edge
    belong together."""
    labels, _ = ndimage.label(cut)
    for axis, wrap in enumerate(wraps):
        if not wrap:
            continue
        first, last = np.take(labels, 0, axis), np.take(labels, -1, axis)
        for one, other in zip(first, last, strict=True):
            if one and other and one != other:
                labels[labels == other] = one
                first[first == other], last[last == other] = one, one
    return np.asarray(labels)


MARGINAL = 1e-3
"""Distance over the height of the menisci from contact or from that height, and pressure over the
largest, within which a pixel may be under liquid in part."""


def meniscus_pixels(gap: RealArray, touching: BoolArray, film: asp.LiquidFilm, wraps: tuple[bool, bool]) -> BoolArray:
    """Pixels that the suction acts on: without contact, on islands of gaps up to the meniscus
    height that hold liquid."""
    labels = islands((gap <= film.meniscus_height) | touching, wraps)
    wet = (gap <= film.thickness) | touching
    kept = np.isin(labels, np.unique(labels[wet & (labels > 0)])) & (labels > 0)
    return np.asarray(kept & ~touching)


def menisci(of: Pressed, control: object) -> list[Check]:
    """The force between the solids is the external one and the suction times the area of the
    menisci that the gap makes.

    Where that jumps, a pixel which comes to touch, or to the height of the menisci, may be under
    liquid on the share that is stated.
    """
    result = of.result
    film, found = result.problem.film, result.require_menisci()
    assert film is not None
    grid, p = result.problem.grid, of.pressure
    touching, wraps = p > 0.0, result.problem.boundary.wraps
    doubt = of.resolved + of.placed + result.certificate.field_error * of.length
    partly, height = found.wetting.partly, film.meniscus_height
    filled = float(found.wetting.filled[partly].sum())
    stand = [meniscus_pixels(np.maximum(of.gap + shift, 0.0), touching, film, wraps) for shift in (-doubt, 0.0, doubt)]
    pulls = [film.suction * grid.pixel_area * (np.count_nonzero(pixels & ~partly) + filled) for pixels in stand]
    at_height = np.minimum(np.abs(of.gap - height), np.abs(of.gap)) <= MARGINAL * height + doubt
    barely = touching & (p <= MARGINAL * p.max())
    inside = float(np.count_nonzero(partly & ~at_height & ~barely))
    force = float(p.sum()) * grid.pixel_area
    away = [abs(found.meniscus_force - pull) for pull in pulls]
    size = max(force, pulls[1])
    checks = [
        Check("force of the menisci", over(min(away), size), WET_BALANCE),
        Check("pixels under liquid in part that are not at an edge", inside, WET_BALANCE),
    ]
    if isinstance(control, asp.MeanPressure | asp.Force | asp.Unloaded):
        external = 0.0 if isinstance(control, asp.Unloaded) else mean_pressure(control, grid) * grid.area
        missed = min(abs(force - external - pull) for pull in pulls)
        checks.append(Check("balance of force", over(missed, size), WET_BALANCE))
    return checks


# Attraction.


def step_compliance(operator: Operator) -> float:
    """Compliance (m/Pa) of a point at a step of the edge: geometric mean of the symbol over all
    waves but the mean (Helson & Lowdenslager 1958)."""
    shape = operator.padded
    rows, columns = np.meshgrid(np.arange(shape[0]), np.arange(shape[1]), indexing="ij")
    mirrored = columns > shape[1] // 2
    rows = np.where(mirrored, (-rows) % shape[0], rows)
    columns = np.where(mirrored, shape[1] - columns, columns)
    symbol = np.asarray(operator.kernel)[rows, columns].ravel()[1:]
    return float(np.exp(np.log(symbol[symbol > 0.0]).mean()))


def adhesion(of: Pressed, control: object) -> list[Check]:
    """Attraction by its law, closed points beside it, balance of force, energies."""
    result = of.result
    found, grid = result.require_adhesion(), result.problem.grid
    law, traction = found.law, of.pressure - found.attraction
    checks = [*bounds(of), *yielding(of)]
    if law.spacing > 0.0:
        checks += _soft_core(of, traction)
    elif isinstance(law, asp.adhesion.JKRAdhesion):
        checks += [*complementarity(of), *_edge(of, traction)]
    else:
        checks += [*complementarity(of), *gaps(of), *_by_law(of)]
    force = float(traction.sum()) * grid.pixel_area
    return [*checks, *_held(of, control, force), *_energies(of, traction)]


def _slack(of: Pressed) -> float:
    """Error (m) of the gap: rounding, and that of the deflection by the error of the traction that
    the certificate states."""
    return of.resolved + of.placed + of.result.certificate.field_error * of.length


def _stated(of: Pressed) -> float:
    checks = [check.tolerance for check in of.result.certificate.couplings if check.name == "adhesion"]
    return checks[0] if checks else 1e-5


def _gap(of: Pressed) -> RealArray:
    """Gap (nx, ny) in m of bodies beside a wall, zero where there is pressure."""
    return np.where(of.pressure > 0.0, 0.0, np.maximum(of.gap, 0.0))


def _by_law(of: Pressed) -> list[Check]:
    found = of.result.require_adhesion()
    law = found.law
    gap = _gap(of)
    miss = np.abs(found.attraction - law.attraction(gap))
    slack = _slack(of)
    low, high = law.attraction(np.maximum(gap - slack, 0.0)), law.attraction(gap + slack)
    allowed = _stated(of) * law.strength + np.where(of.pressure > 0.0, 0.0, low - high)
    return [Check("law of adhesion", float((miss / allowed).max()), 1.0)]


def _soft_core(of: Pressed, traction: RealArray) -> list[Check]:
    """Net traction -σ(g) everywhere; a point is off by no more than the tolerance, or than what the
    error of its gap makes of it."""
    law = of.result.require_adhesion().law
    gap = of.operator.apply(traction) + of.depth - of.result.approach + law.spacing
    if not (gap > 0.0).all():
        return [Check("law of adhesion", float("inf"), 1.0)]
    miss = np.abs(traction + law.attraction(gap))
    slack = _slack(of) + ROUNDING * (float(np.abs(of.depth).max()) + law.spacing)
    steep = np.abs(law.slope(gap)) * slack
    size = law.strength + np.abs(traction)
    return [Check("law of adhesion", float((miss / (_stated(of) * size + steep)).max()), 1.0)]


def _edge(of: Pressed, traction: RealArray) -> list[Check]:
    """Closed points bear no more tension than the edge of a contact does, open ones none, and
    nowhere do bodies overlap."""
    found = of.result.require_adhesion()
    law = found.law
    assert isinstance(law, asp.adhesion.JKRAdhesion)
    most = math.sqrt(2.0 * law.work / step_compliance(of.operator))
    closed = of.pressure > 0.0
    tension = float(np.maximum(-traction, 0.0)[closed].max(initial=0.0))
    stray = float(np.abs(traction)[~closed].max(initial=0.0))
    return [
        Check("tension at the edge", max(tension / most - 1.0, 0.0), 1e-3),
        Check("no tension where the surfaces are apart", stray / most, ROUNDING),
    ]


def _held(of: Pressed, control: object, force: float) -> list[Check]:
    result, grid = of.result, of.result.problem.grid
    if isinstance(control, asp.MeanGap):
        mean = float(_gap(of).mean())
        return [Check("position", abs(mean - control.value), _slack(of) + 1e-7 * control.value)]
    if isinstance(control, asp.FixedGrips | asp.Approach):
        wanted = control.value - (force / control.stiffness if isinstance(control, asp.FixedGrips) else 0.0)
        size = max(abs(control.value), abs(result.approach), float(of.depth.max()))
        stated = _slack(of) + 1e-7 * size
        return [Check("position", abs(result.approach - wanted), stated)]
    wanted = -control.value if isinstance(control, asp.contact.Pull) else 0.0
    if isinstance(control, asp.MeanPressure | asp.Force):
        wanted = mean_pressure(control, grid) * grid.area
    size = max(
        float(np.maximum(of.pressure, result.require_adhesion().attraction).sum()) * grid.pixel_area, abs(wanted)
    )
    stated = result.certificate.load_imbalance + 1e-7
    return [Check("balance of force", over(abs(force - wanted), size), stated)]


def _energies(of: Pressed, traction: RealArray) -> list[Check]:
    """Elastic energy and that of the interface are those of traction and gap; no step makes
    energy."""
    found, pixel = of.result.require_adhesion(), of.result.problem.grid.pixel_area
    elastic = 0.5 * float((traction * of.operator.apply(traction)).sum()) * pixel
    size = norm(traction) * norm(of.operator.apply(traction)) * pixel
    checks = [Check("elastic energy", over(abs(elastic - found.elastic_energy), size), 1e3 * ROUNDING)]
    law = found.law
    if law.spacing == 0.0:
        gap = np.where(of.pressure > 0.0, 0.0, np.maximum(of.gap, 1e-300))
        interface = float(law.energy(gap).sum()) * pixel
        slack = law.strength * _slack(of) * gap.size * pixel if math.isfinite(law.strength) else 0.0
        stated = 1e3 * ROUNDING + over(slack, law.work * gap.size * pixel)
        size = law.work * gap.size * pixel
        checks.append(Check("energy of the interface", over(abs(interface - found.interface_energy), size), stated))
    scale = abs(found.elastic_energy) + abs(found.interface_energy)
    made = max(-(found.dissipated + found.dissipated_error), 0.0)
    return [*checks, Check("no energy out of nothing", over(made, scale), 1e-5)]
