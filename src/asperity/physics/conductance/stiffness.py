"""Conductance from stiffness: the incremental problem of frictionless contact is that of
conduction (Barber 2003)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...contact.history import HistoryResult
from ...contact.result import ContactResult, follows_from_pressure
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...solids.layers import Body, Layered
from .operator import Flow, harmonic_mean


def from_stiffness(result: ContactResult, flow: Flow) -> float:
    """G = (k_s/E*) dP/dδ of a contact in S or W/K, from its normal stiffness.

    Raises
    ------
    InputError
        If a body is layered, points have yielded, more than the pressure bears load, or a
        conductivity is not known.
    """
    why = why_not(result)
    if why:
        raise InputError(f"contact must be homogeneous and elastic for its stiffness to be its conductance, but {why}.")
    problem = result.problem
    k_s = harmonic_mean(problem.body, problem.counter_body, flow)
    return k_s / problem.contact_modulus * result.normal_stiffness * problem.grid.area


def why_not(result: ContactResult) -> str:
    """Why the conductance of ``result`` does not follow from its stiffness; empty if it does."""
    problem = result.problem
    for body, which in ((problem.body, "body"), (problem.counter_body, "counter body")):
        if _layered(body):
            return f"the {which} is layered"
    if result.plastic.any():
        return "points have yielded"
    if not follows_from_pressure(result):
        return "more than the pressure bears load"
    return ""


def _layered(body: Body) -> bool:
    return isinstance(body, Layered) and bool(body.reduced.layers)


class SlopeBounds(NamedTuple):
    """Bounds (n,) of a derivative; infinite or zero where there is none."""

    lower: RealArray
    upper: RealArray


def convex_bounds(approach: RealArray, force: RealArray) -> SlopeBounds:
    """Bounds of dP/dδ in N/m at each of a rising series of ``approach`` (m) and ``force`` (N),
    (n,): P(δ) is convex, so that the slope lies between those of the secants on either side.

    The first has the lower bound zero, the last no upper bound.

    Raises
    ------
    InputError
        If the approach does not rise.
    """
    rise = np.diff(np.asarray(approach, dtype=float))
    if not np.all(rise > 0.0):
        raise InputError("approach must rise from step to step for bounds of the slope, but does not.")
    slope = np.diff(np.asarray(force, dtype=float)) / rise
    return SlopeBounds(np.concatenate([[0.0], slope]), np.concatenate([slope, [math.inf]]))


def conductance_bounds(path: HistoryResult, flow: Flow) -> SlopeBounds:
    """Bounds of the conductance (S or W/K) at each step of an elastic ``path`` of rising load, from
    its forces and approaches alone (Barber 2003).

    Raises
    ------
    InputError
        If the load falls, or stiffness is not conductance (``from_stiffness``).
    """
    for step in path.steps:
        if why := why_not(step):
            raise InputError(f"contact must be homogeneous and elastic for bounds of its conductance, but {why}.")
    problem = path.steps[0].problem
    factor = harmonic_mean(problem.body, problem.counter_body, flow) / problem.contact_modulus
    found = convex_bounds(
        np.array([step.approach for step in path.steps]), np.array([step.force for step in path.steps])
    )
    return SlopeBounds(factor * found.lower, factor * found.upper)


def smooth_bounds(k_s: float, radius: float, force: float, height: float, E_star: float) -> tuple[float, float]:
    """Bounds of the conductance of a rough sphere of ``radius`` R (m) under a ``force`` (N) whose
    roughness is ``height`` s from peak to valley (m), by those of smooth spheres (Barber 2003).

    The approach is between those of the smooth sphere at the same force, δ_0 and δ_0 + s, and P(δ)
    is convex and between P_0(δ - s) and P_0(δ), P_0 = 4/3 E* R^1/2 δ^3/2. With the height zero both
    are 2 k_s a.
    """
    scale = 4.0 / 3.0 * E_star * math.sqrt(radius)
    start = (force / scale) ** (2.0 / 3.0)
    if not height:
        both = k_s / E_star * 1.5 * scale * math.sqrt(start)
        return both, both
    share = np.linspace(1e-4, 4.0, 4000)
    lower, upper = math.inf, 0.0
    for approach in np.linspace(start, start + height, 21):
        # secants to smooth spheres deeper or less deep: the tightest of each side
        before = approach - share * (approach + height)
        after = approach + share * (approach + height)
        low = (force - scale * np.maximum(before, 0.0) ** 1.5) / (approach - before)
        high = (scale * after**1.5 - force) / (after - approach)
        lower, upper = min(lower, float(low.max())), max(upper, float(high.min()))
    return k_s / E_star * lower, k_s / E_star * upper
